// SPDX-License-Identifier: BSD-3-Clause
#include "lifecycle/convert.hpp"

#include <doctest/doctest.h>

#include <algorithm>

#include "io/fesom.hpp"
#include "io/mpas_layers.hpp"
#include "lifecycle/generate.hpp"
#include "lifecycle/outputs.hpp"
#include "lifecycle/settings_tree.hpp"
#include "support/temporary_folder.hpp"

using namespace delos;
using delos::testing::TemporaryFolder;

namespace {

struct Host {
  parallel::Executor exec{2};
  Monitor monitor;
  Context context{exec, monitor};

  void write(const std::string& layers, const std::string& folder) {
    const std::string yaml =
        "sizing: {sources: [{type: constant, spacing: 2500 km}]}\n"
        "refine: {tile_vertices: 500}\n"
        "output: {name: a, formats: [mpas, fesom]}\n" +
        layers;
    const Product product =
        generate(context, read_settings(parse_config(yaml, "test.yaml"), "."), {});
    write_outputs(context, output_content(product, "test"), folder);
  }
  void convert(const std::string& from, const std::string& to) {
    convert_grid_file(context, {from, to, file_kind_of(to, ""), "test"});
  }
};

void check_same(const MpasVertical& one, const MpasVertical& other) {
  CHECK(one.interface_m == other.interface_m);
  CHECK(one.n_layers == other.n_layers);
  CHECK(one.bottom_depth_m == other.bottom_depth_m);
  CHECK(one.thickness_m == other.thickness_m);
  CHECK(one.ground_m == other.ground_m);
  CHECK(one.height_m == other.height_m);
}

}  // namespace

TEST_CASE("the layers of an ocean go along between MPAS and FESOM2") {
  const TemporaryFolder folder;
  Host host;
  host.write("layers: {kind: z_level}\n", folder.file("made"));
  const std::string mpas = folder.file("made/a.mpas.nc");
  const MpasVertical made = read_mpas_vertical(mpas);
  REQUIRE(made.ocean());
  CHECK(*std::max_element(made.n_layers.begin(), made.n_layers.end()) > 10);
  host.convert(mpas, folder.file("b.mpas.nc"));
  check_same(read_mpas_vertical(folder.file("b.mpas.nc")), made);
  host.convert(mpas, folder.file("b.fesom"));
  host.convert(folder.file("b.fesom"), folder.file("c.mpas.nc"));
  for (const char* const path : {"made/a.fesom", "b.fesom"}) {
    CAPTURE(path);
    const TriangleSet set = read_fesom(folder.file(path));
    CHECK(set.depth_m == made.bottom_depth_m);
    CHECK(set.level_m == made.interface_m);
  }
  check_same(read_mpas_vertical(folder.file("c.mpas.nc")), made);
}

TEST_CASE("the layers of an atmosphere go along from MPAS to MPAS, and none come from nowhere") {
  const TemporaryFolder folder;
  Host host;
  host.write("layers: {kind: terrain_following}\n", folder.file("made"));
  const MpasVertical made = read_mpas_vertical(folder.file("made/a.mpas.nc"));
  REQUIRE(made.terrain());
  host.convert(folder.file("made/a.mpas.nc"), folder.file("b.mpas.nc"));
  check_same(read_mpas_vertical(folder.file("b.mpas.nc")), made);
  host.convert(folder.file("b.mpas.nc"), folder.file("b.fesom"));
  CHECK(read_fesom(folder.file("b.fesom")).depth_m.empty());
  host.write("", folder.file("flat"));
  const MpasVertical none = read_mpas_vertical(folder.file("flat/a.mpas.nc"));
  CHECK_FALSE(none.ocean());
  CHECK_FALSE(none.terrain());
}
