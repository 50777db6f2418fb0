// SPDX-License-Identifier: BSD-3-Clause
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <delos/delos.hpp>
#include <numeric>
#include <string>
#include <vector>

#include "support/sent_part.hpp"

using delos::Location;
using delos::testing::same;
using delos::testing::sent;

namespace {

constexpr const char* kOcean = "{kind: z_level, levels: {shape: uniform, n: 30, depth: 6000 m}}";
constexpr const char* kAtmosphere = "{kind: terrain_following, n: 20}";

delos::Grid grid_with(const char* layers) {
  const std::string base = "generator: icosahedral\nsubdivisions: 8\ndata_path: [/none]\n";
  return delos::generate(delos::Config::from_text(base + "layers: " + layers + "\n"),
                         {.threads = 1});
}

/// The values of `whole`, `width` a cell, that a part must have.
template <class Values, class Part>
bool picked(const Values& whole, const Part& part, const delos::LocalGrid& of, std::size_t width) {
  const auto ids = of.global_id(Location::cell);
  if (part.size() != ids.size() * width) return false;
  for (std::size_t i = 0; i < part.size(); ++i) {
    const auto cell = static_cast<std::size_t>(ids[i / width]);
    if (part[i] != whole[cell * width + i % width]) return false;
  }
  return true;
}

}  // namespace

TEST_CASE("an ocean's layers lie on its bottom") {
  const delos::Grid grid = grid_with(kOcean);
  const auto n_cells = static_cast<std::size_t>(grid.n_cells());
  const auto interface_m = grid.level_interface_m();
  const auto bottom_m = grid.bottom_depth_m();
  const auto deepest = grid.max_level_cell();
  REQUIRE(interface_m.size() == 31);
  CHECK(interface_m.front() == 0.0);
  CHECK(interface_m.back() == doctest::Approx(6000.0));
  REQUIRE(bottom_m.size() == n_cells);
  REQUIRE(deepest.size() == n_cells);
  CHECK(grid.ground_height_m().empty());
  CHECK(grid.ground_influence().empty());
  const std::vector<double> thickness_m = grid.layer_thickness_m();
  const std::vector<double> height_m = grid.interface_height_m();
  REQUIRE(thickness_m.size() == 30 * n_cells);
  REQUIRE(height_m.size() == 31 * n_cells);
  std::size_t n_wet = 0, n_partial = 0;
  for (std::size_t cell = 0; cell < n_cells; ++cell) {
    const auto column = std::span(thickness_m).subspan(30 * cell, 30);
    CHECK(std::accumulate(column.begin(), column.end(), 0.0) == doctest::Approx(bottom_m[cell]));
    const auto n = std::count_if(column.begin(), column.end(), [](double h) { return h > 0.0; });
    CHECK(n == deepest[cell]);
    CHECK(height_m[31 * cell] == 0.0);
    CHECK(height_m[31 * cell + 30] == -bottom_m[cell]);
    n_wet += n > 0;
    n_partial += n > 0 && column[static_cast<std::size_t>(n) - 1] < 199.0;
  }
  CHECK(n_wet > n_cells / 2);
  CHECK(n_wet < n_cells);
  CHECK(n_partial > n_wet / 2);
}

TEST_CASE("an atmosphere's layers begin at the ground and end level") {
  const delos::Grid grid = grid_with(kAtmosphere);
  const auto n_cells = static_cast<std::size_t>(grid.n_cells());
  const auto ground_m = grid.ground_height_m();
  REQUIRE(ground_m.size() == n_cells);
  REQUIRE(grid.level_interface_m().size() == 21);
  REQUIRE(grid.ground_influence().size() == 21);
  CHECK(grid.ground_influence().front() == 1.0);
  CHECK(grid.max_level_cell().empty());
  CHECK(grid.bottom_depth_m().empty());
  CHECK(*std::max_element(ground_m.begin(), ground_m.end()) > 1000.0);
  const std::vector<double> height_m = grid.interface_height_m();
  const std::vector<double> thickness_m = grid.layer_thickness_m();
  REQUIRE(height_m.size() == 21 * n_cells);
  REQUIRE(thickness_m.size() == 20 * n_cells);
  for (std::size_t cell = 0; cell < n_cells; ++cell) {
    CHECK(height_m[21 * cell] == ground_m[cell]);
    CHECK(height_m[21 * cell + 20] == doctest::Approx(grid.level_interface_m().back()));
    for (std::size_t k = 0; k < 20; ++k) {
      CHECK(thickness_m[20 * cell + k] > 0.0);
      CHECK(thickness_m[20 * cell + k] == height_m[21 * cell + k + 1] - height_m[21 * cell + k]);
    }
  }
}

TEST_CASE("each part has the layers of its cells, at the other end of a message too") {
  for (const char* const layers : {kOcean, kAtmosphere}) {
    const delos::Grid grid = grid_with(layers);
    const std::size_t n_levels = grid.level_interface_m().size() - 1;
    const delos::LocalGrid part = sent(delos::Partition(grid, {.n_parts = 3}).part(1));
    CHECK(same(part.level_interface_m(), grid.level_interface_m()));
    CHECK(same(part.ground_influence(), grid.ground_influence()));
    const bool is_ocean = !grid.max_level_cell().empty();
    CHECK(picked(grid.max_level_cell(), part.max_level_cell(), part, 1) == is_ocean);
    CHECK(picked(grid.bottom_depth_m(), part.bottom_depth_m(), part, 1) == is_ocean);
    CHECK(picked(grid.ground_height_m(), part.ground_height_m(), part, 1) != is_ocean);
    CHECK(picked(grid.layer_thickness_m(), part.layer_thickness_m(), part, n_levels));
    CHECK(picked(grid.interface_height_m(), part.interface_height_m(), part, n_levels + 1));
  }
}

TEST_CASE("a grid without layers has none to hand out") {
  const delos::Grid grid =
      delos::generate(delos::Config::from_text("generator: icosahedral\nsubdivisions: 4\n"));
  CHECK(grid.level_interface_m().empty());
  CHECK(grid.max_level_cell().empty());
  CHECK(grid.bottom_depth_m().empty());
  CHECK(grid.layer_thickness_m().empty());
  CHECK(grid.interface_height_m().empty());
  const delos::LocalGrid part = delos::Partition(grid, {.n_parts = 2}).part(0);
  CHECK(part.level_interface_m().empty());
  CHECK(part.layer_thickness_m().empty());
}
