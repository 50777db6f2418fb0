// SPDX-License-Identifier: BSD-3-Clause
#include <doctest/doctest.h>

#include <algorithm>
#include <delos/delos.hpp>
#include <fstream>
#include <iterator>
#include <numeric>
#include <string>
#include <vector>

#include "support/sent_part.hpp"
#include "support/temporary_folder.hpp"

using delos::Location;
using delos::testing::same;
using delos::testing::sent;

namespace {

delos::Grid small_grid() {
  return delos::generate(delos::Config::from_text("generator: icosahedral\nsubdivisions: 8\n"));
}

}  // namespace

TEST_CASE("the owned cells of all parts are the grid, and their areas its area") {
  const delos::Grid grid = small_grid();
  delos::Partition partition(grid, {.n_parts = 5, .halo_layers = 2});
  REQUIRE(static_cast<std::int64_t>(partition.part_of_cell().size()) == grid.n_cells());
  std::vector<int> n_owners(static_cast<std::size_t>(grid.n_cells()), 0);
  for (int number = 0; number < 5; ++number) {
    const delos::LocalGrid part = partition.part(number);
    CHECK(part.part() == number);
    CHECK(part.n_parts() == 5);
    CHECK(part.halo_layers() == 2);
    CHECK(part.layer_offsets(Location::cell).size() == 4);
    CHECK(part.n_global(Location::edge) == grid.n_edges());
    for (std::int64_t i = 0; i < part.n_owned(Location::cell); ++i) {
      const auto id =
          static_cast<std::size_t>(part.global_id(Location::cell)[static_cast<std::size_t>(i)]);
      ++n_owners[id];
      CHECK(partition.part_of_cell()[id] == number);
      CHECK(part.cell_area_m2()[static_cast<std::size_t>(i)] == grid.cell_area_m2()[id]);
    }
  }
  CHECK(std::all_of(n_owners.begin(), n_owners.end(), [](int n) { return n == 1; }));
}

TEST_CASE("a part is the same at the other end of a message") {
  const delos::Grid grid = small_grid();
  const delos::LocalGrid part = delos::Partition(grid, {.n_parts = 3}).part(1);
  const delos::LocalGrid other = sent(part);
  CHECK(other.layout() == part.layout());
  CHECK(other.part() == 1);
  CHECK(other.radii_m() == grid.radii_m());
  CHECK(other.centre_m() == grid.centre_m());
  CHECK(other.scale_m() == grid.scale_m());
  const auto here = part.buffers(), there = other.buffers();
  REQUIRE(here.size() == there.size());
  for (std::size_t i = 0; i < here.size(); ++i) CHECK(same(here[i], there[i]));
  CHECK(same(part.edges_on_edge(), other.edges_on_edge()));
  CHECK(same(part.kite_area_m2(), other.kite_area_m2()));
  CHECK(same(part.send_ids(Location::vertex), other.send_ids(Location::vertex)));
}

TEST_CASE("cells count their wet layers where there are some, as in the files") {
  const delos::testing::TemporaryFolder folder;
  const auto config = delos::Config::from_text(R"(
generator: icosahedral
subdivisions: 12
layers: {kind: z_level, levels: {shape: uniform, n: 30, depth: 6000 m}}
output: {name: a, formats: [mpas], partitions: [3]}
)");
  const delos::Grid grid = delos::generate(config, {.threads = 1});
  const auto parts = [&](delos::CellWork work) {
    const delos::Partition partition(grid, {.n_parts = 3, .work = work});
    return std::vector<std::int32_t>(partition.part_of_cell().begin(),
                                     partition.part_of_cell().end());
  };
  static_cast<void>(grid.write_outputs(folder.file("out")));
  std::ifstream file(folder.file("out/a.graph.info.part.3"));
  const std::vector<std::int32_t> written{std::istream_iterator<std::int32_t>(file), {}};
  CHECK(parts(delos::CellWork::layers) == written);
  CHECK(parts(delos::CellWork::automatic) == written);
  CHECK(parts(delos::CellWork::cells) != written);
  const delos::Grid plain = small_grid();
  CHECK(
      same(delos::Partition(plain, {.n_parts = 3}).part_of_cell(),
           delos::Partition(plain, {.n_parts = 3, .work = delos::CellWork::cells}).part_of_cell()));
  try {
    const delos::Partition refused(plain, {.n_parts = 3, .work = delos::CellWork::layers});
    FAIL("layers of a grid without any were taken");
  } catch (const delos::Error& error) {
    CHECK(error.kind() == delos::ErrorKind::config);
    CHECK(std::string(error.what()).find("section layers") != std::string::npos);
  }
}

TEST_CASE("what is no part of a grid is refused") {
  const delos::Grid grid = small_grid();
  const auto kind_of = [](auto&& action) {
    try {
      action();
    } catch (const delos::Error& error) {
      return std::string(delos::to_string(error.kind()));
    }
    return std::string("none");
  };
  std::array<std::int64_t, delos::LocalGrid::kLayoutSize> zeros{};
  CHECK(kind_of([&] {
          static_cast<void>(delos::LocalGrid::received(zeros, [](std::span<std::byte>) {}));
        }) == "input");
  CHECK(kind_of([&] { delos::Partition(grid, {.n_parts = grid.n_cells() + 1}); }) == "config");
  CHECK(kind_of([&] { delos::Partition(grid, {.n_parts = 2, .halo_layers = 0}); }) == "config");
  // More layers than any grid has: the parts would be cut for hours.
  CHECK(kind_of([&] {
          delos::Partition(grid, {.n_parts = 2, .halo_layers = 2'000'000'000}).part(0);
        }) == "config");
  delos::Partition partition(grid, {.n_parts = 2});
  CHECK(kind_of([&] { static_cast<void>(partition.part(2)); }) == "config");
  CHECK(kind_of([&] { static_cast<void>(partition.part(0).n_local(Location::grid)); }) == "config");
}
