// SPDX-License-Identifier: BSD-3-Clause
// Regional grids from the spacing to the culled grid.
#include "domain/limited_area.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <memory>

#include "domain/cull.hpp"
#include "dual/build.hpp"
#include "dual/validate.hpp"
#include "refine/refine.hpp"
#include "relax/relax.hpp"
#include "sizing/region.hpp"
#include "support/expect_error.hpp"
#include "support/sample_spacings.hpp"

using namespace delos;

namespace {

const Ellipsoid kEarth = Ellipsoid::sphere(6371220.0);

struct Regional {
  Grid whole;
  domain::LimitedArea area;
};

/// A grid of 60 km made for the region only.
Regional regional(const Region& region) {
  TestRun run(2);
  LatLonField field = make_table(0.5 * kRadPerDeg), distance = field;
  std::fill(field.values.begin(), field.values.end(), 60e3);
  distance_to_region(run.exec, region, distance);
  coarsen_outside(run.exec, kEarth, distance, {}, field);
  const SpacingField spacing = SpacingField::table(kEarth, LatitudeKind::geodetic, field);
  RefineReport refined;
  Mesh mesh = refine(run.context, kEarth, spacing, {}, refined);
  relax(run.context, kEarth, spacing, {}, mesh);
  Regional out{build_grid(run.context, kEarth, LatitudeKind::geodetic, mesh), {}};
  out.area =
      domain::limited_area(out.whole, inside_region(run.exec, region, out.whole.cell_lon_lat));
  return out;
}

Region disc_over_pole() { return RegionDisc{{0.3, 1.55}, 28.0 * kRadPerDeg}; }

Region box_over_date_line() {
  PolygonSet set;
  set.source = "box";
  set.rings = {{{155, 205, 205, 155}, {-25, -25, 25, 25}, 0}};
  return std::make_shared<const PolygonSet>(set);
}

/// Every ring touches the one before and none nearer; ring 7 alone touches what is left out.
void check_rings(const Regional& regional) {
  const auto& [whole, area] = regional;
  std::vector<int> ring_of(static_cast<std::size_t>(whole.n_cells()), domain::kBoundaryRings + 1);
  for (std::size_t i = 0; i < area.cells.size(); ++i) {
    ring_of[static_cast<std::size_t>(area.cells[i])] = area.ring[i];
  }
  for (std::size_t i = 0; i < area.cells.size(); ++i) {
    int least = area.ring[i], most = least;
    for (const Index other : whole.cells_on_cell.row(area.cells[i])) {
      least = std::min(least, ring_of[static_cast<std::size_t>(other)]);
      most = std::max(most, ring_of[static_cast<std::size_t>(other)]);
    }
    if (area.ring[i] > 0) CHECK(least == area.ring[i] - 1);
    CHECK(most <= area.ring[i] + 1);
  }
}

}  // namespace

TEST_CASE("a regional grid has seven rings and costs little more than its cells") {
  for (const Region& region : {disc_over_pole(), box_over_date_line()}) {
    CAPTURE(region.index());
    const Regional made = regional(region);
    check_rings(made);
    const auto n = static_cast<std::int64_t>(made.area.cells.size());
    MESSAGE("cells of the region ", n, ", of the whole computation ", made.whole.n_cells());
    CHECK(made.whole.n_cells() <= 1.3 * static_cast<double>(n) + 300.0);
    // All cells of the region are of the wanted size: those outside are not.
    for (const Index cell : made.area.cells) {
      CHECK(made.whole.cell_area_m2[static_cast<std::size_t>(cell)] < 1.6 * 0.866 * 60e3 * 60e3);
    }
    parallel::Executor exec(2);
    const domain::Culled culled = domain::cull(exec, made.whole, made.area.cells);
    CHECK(culled.grid.n_cells() == n);
  }
}

TEST_CASE("regions without a cell or without room for their rings are refused") {
  TestRun run(1);
  RefineReport refined;
  const SpacingField spacing = SpacingField::constant(kEarth, 1000e3);
  const Mesh mesh = refine(run.context, kEarth, spacing, {}, refined);
  const Grid grid = build_grid(run.context, kEarth, LatitudeKind::geodetic, mesh);
  std::vector<char> inside(static_cast<std::size_t>(grid.n_cells()), 0);
  testing::expect_error(ErrorKind::input, {"no cell has its centre in the region"},
                        [&] { domain::limited_area(grid, inside); });
  std::fill(inside.begin(), inside.end() - 3, 1);
  testing::expect_error(ErrorKind::input, {"no room for ring"},
                        [&] { domain::limited_area(grid, inside); });
}
