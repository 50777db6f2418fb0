// SPDX-License-Identifier: BSD-3-Clause
// First-order transfer beside CDO's conservative remapping (remapcon) of the same cells.
#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "io/netcdf.hpp"
#include "io/ugrid.hpp"
#include "remap/transfer.hpp"
#include "support/run_command.hpp"
#include "support/sample_fields.hpp"
#include "support/temporary_folder.hpp"

using namespace delos;
using delos::testing::Outcome;
using delos::testing::run;

namespace {

bool has_cdo() {
  if (run("command -v cdo").status == 0) return true;
  MESSAGE("skipped: there is no cdo");
  return false;
}

}  // namespace

TEST_CASE("CDO's conservative remapping of the same cells gives the same values") {
  if (!has_cdo()) return;
  const testing::TemporaryFolder folder;
  const Ellipsoid sphere = Ellipsoid::sphere(6371000.0);  // CDO's own radius
  const Grid a = samples::grid_of(sphere, samples::shaken(sphere, 4, 0.15, 1));
  const Grid b = samples::grid_of(sphere, samples::shaken(sphere, 3, 0.15, 2));
  write_ugrid_cells(folder.file("a.nc"), a, {});
  write_ugrid_cells(folder.file("b.nc"), b, {});
  const Outcome described =
      run("cdo -s griddes -selname,area " + folder.file("b.nc") + " > " + folder.file("b.txt"));
  REQUIRE_MESSAGE(described.status == 0, described.output);
  // The area of a shaken cell is as rough a field as any.
  const Outcome remapped =
      run("cdo -s -b F64 -f nc remapcon," + folder.file("b.txt") + " -selname,area " +
          folder.file("a.nc") + " " + folder.file("out.nc"));
  REQUIRE_MESSAGE(remapped.status == 0, remapped.output);
  const std::vector<double> theirs = netcdf::Reader(folder.file("out.nc")).read_double("area");
  REQUIRE(theirs.size() == b.cell_area_m2.size());
  parallel::Executor exec(1);
  std::vector<double> ours(theirs.size());
  remap::apply(exec, remap::first_order_weights(exec, samples::overlaps_of(a, b)), a.cell_area_m2,
               ours);
  double worst = 0.0;
  for (std::size_t i = 0; i < ours.size(); ++i) {
    worst = std::max(worst, std::abs(ours[i] / theirs[i] - 1.0));
  }
  CHECK(worst < 1e-12);  // measured 8e-15
}
