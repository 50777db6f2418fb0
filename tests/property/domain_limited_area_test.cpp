// SPDX-License-Identifier: BSD-3-Clause
// Regional grids from the spacing to the culled grid.
#include "domain/limited_area.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <memory>

#include "domain/cull.hpp"
#include "dual/build.hpp"
#include "refine/refine.hpp"
#include "relax/relax.hpp"
#include "sizing/sources.hpp"
#include "support/expect_error.hpp"
#include "support/sample_spacings.hpp"

using namespace delos;

namespace {

const Ellipsoid kEarth = Ellipsoid::sphere(6371220.0);
constexpr double kSpacing = 180e3;

struct Regional {
  Grid whole;
  domain::LimitedArea area;
};

/// A grid made for the region only.
Regional regional(const RegionShape& region, const domain::RingWidths& widths) {
  TestRun run(2);
  SpacingRecipe recipe;
  recipe.sources = {{"constant", ConstantSource{kSpacing}}};
  recipe.region = region;
  recipe.outside.n_rings = widths.total();
  const SpacingField spacing = build_spacing(run.context, kEarth, recipe);
  RefineReport refined;
  Mesh mesh = refine(run.context, kEarth, spacing, {}, refined);
  relax(run.context, kEarth, spacing, {}, mesh);
  Regional out{build_grid(run.context, kEarth, LatitudeKind::geodetic, mesh), {}};
  out.area = domain::limited_area(run.exec, out.whole,
                                  inside_region(run.exec, region, out.whole.cell_lon_lat), widths);
  return out;
}

RegionShape disc_over_pole() { return RegionDisc{{0.3, 1.55}, 28.0 * kRadPerDeg}; }

RegionShape box_over_date_line() {
  PolygonSet set;
  set.source = "box";
  set.rings = {{{155, 205, 205, 155}, {-25, -25, 25, 25}, 0}};
  return std::make_shared<const PolygonSet>(set);
}

std::int32_t ring_at(const Regional& made, Index cell) {
  return made.area.ring[static_cast<std::size_t>(cell)];
}

/// Every ring touches the one before and none nearer; the last alone touches what is left out; no
/// cell hangs by one edge.
void check_rings(const Regional& made, int last) {
  for (Index cell = 0; cell < made.whole.n_cells(); ++cell) {
    const std::int32_t ring = ring_at(made, cell);
    if (ring == kNone) continue;
    std::int32_t least = ring, most = ring, n_there = 0;
    for (const Index other : made.whole.cells_on_cell.row(cell)) {
      const std::int32_t next = ring_at(made, other) == kNone ? last + 1 : ring_at(made, other);
      least = std::min(least, next);
      most = std::max(most, next);
      n_there += next <= last ? 1 : 0;
    }
    if (ring > 0) CHECK(least == ring - 1);
    CHECK(most <= ring + 1);
    CHECK(n_there >= 2);
  }
}

Grid even_grid(TestRun& run, double spacing_m) {
  RefineReport refined;
  const SpacingField spacing = SpacingField::constant(kEarth, spacing_m);
  const Mesh mesh = refine(run.context, kEarth, spacing, {}, refined);
  return build_grid(run.context, kEarth, LatitudeKind::geodetic, mesh);
}

}  // namespace

TEST_CASE("a regional grid has even rings and costs little more than its cells") {
  for (const RegionShape& region : {disc_over_pole(), box_over_date_line()}) {
    CAPTURE(region.index());
    const domain::RingWidths widths;
    const Regional made = regional(region, widths);
    check_rings(made, widths.total());
    std::int64_t n = 0;
    for (const std::int64_t n_in_ring : made.area.n_cells) n += n_in_ring;
    MESSAGE("cells of the region ", n, ", made ", made.whole.n_cells());
    CHECK(made.whole.n_cells() <= n + 15 * made.area.n_cells.back() + 300);
    CHECK(made.area.n_parts == 1);
    // The region and its rings are of the wanted size: what lies behind is not.
    for (Index cell = 0; cell < made.whole.n_cells(); ++cell) {
      if (ring_at(made, cell) == kNone) continue;
      CHECK(made.whole.cell_area_m2[static_cast<std::size_t>(cell)] <
            1.6 * 0.866 * kSpacing * kSpacing);
    }
  }
}

TEST_CASE("regions without a cell or without room for their rings are refused") {
  TestRun run(1);
  const Grid grid = even_grid(run, 1000e3);
  std::vector<char> inside(static_cast<std::size_t>(grid.n_cells()), 0);
  testing::expect_error(ErrorKind::input, {"smaller than a few cells"},
                        [&] { domain::limited_area(run.exec, grid, inside, {}); });
  std::fill(inside.begin(), inside.end() - 30, 1);
  testing::expect_error(ErrorKind::input, {"no room for ring"},
                        [&] { domain::limited_area(run.exec, grid, inside, {}); });
}

TEST_CASE("a cell that hangs on a region leaves it, a hole of one cell is filled") {
  TestRun run(1);
  const Grid grid = even_grid(run, 600e3);
  const RegionShape disc = RegionDisc{{1.0, 0.2}, 0.5};
  std::vector<char> inside = inside_region(run.exec, disc, grid.cell_lon_lat);
  const domain::RingWidths one{1, 0};
  const domain::LimitedArea even = domain::limited_area(run.exec, grid, inside, one);
  // A chain of two cells outwards from the rim, and a hole far from the rim.
  const auto is_ring = [&](Index cell, std::int32_t ring) {
    return even.ring[static_cast<std::size_t>(cell)] == ring;
  };
  Index hole = kNone;
  for (Index cell = 0; cell < grid.n_cells() && hole == kNone; ++cell) {
    const auto around = grid.cells_on_cell.row(cell);
    const bool is_deep =
        std::all_of(around.begin(), around.end(), [&](Index other) { return is_ring(other, 0); });
    if (is_ring(cell, 0) && is_deep) hole = cell;
  }
  REQUIRE(hole != kNone);
  inside[static_cast<std::size_t>(hole)] = 0;
  for (Index cell = 0; cell < grid.n_cells(); ++cell) {
    if (!is_ring(cell, kNone)) continue;
    inside[static_cast<std::size_t>(cell)] = 1;  // alone, beyond the ring
    break;
  }
  CHECK(domain::limited_area(run.exec, grid, inside, one).ring == even.ring);
}
