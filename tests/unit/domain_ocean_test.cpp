// SPDX-License-Identifier: BSD-3-Clause
#include "domain/ocean.hpp"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <functional>

#include "domain/bodies.hpp"
#include "domain/transects.hpp"
#include "dual/digest.hpp"
#include "dual/validate.hpp"
#include "partition/kway.hpp"
#include "support/expect_error.hpp"
#include "support/sample_grids.hpp"

using namespace delos;

namespace {

const Ellipsoid kEarth = Ellipsoid::sphere(6371220.0);

// 2562 cells about 4.5 degrees wide.
Grid made_grid() { return samples::grid_of(kEarth, samples::shaken(kEarth, 4, 0.08, 3)); }

double lat_deg(const Grid& grid, Index cell) {
  return grid.cell_lon_lat[at(cell)].lat_rad * kDegPerRad;
}

/// In (-180, 180].
double lon_deg(const Grid& grid, Index cell) {
  const double lon = grid.cell_lon_lat[at(cell)].lon_rad * kDegPerRad;
  return lon > 180.0 ? lon - 360.0 : lon;
}

using Law = std::function<bool(double lon, double lat)>;

Array<double> wet_where(const Grid& grid, const Law& is_sea) {
  Array<double> wet(grid.cell_position.size());
  for (Index cell = 0; cell < grid.n_cells(); ++cell) {
    wet[at(cell)] = is_sea(lon_deg(grid, cell), lat_deg(grid, cell)) ? 1.0 : 0.0;
  }
  return wet;
}

domain::Ocean ocean_of(const Grid& grid, const Array<double>& wet,
                       const domain::OceanOptions& options = {}, int threads = 1) {
  parallel::Executor exec(threads);
  return domain::select_ocean(exec, grid, wet, options);
}

/// Sea around the equator, land else, a lake in the north.
bool is_belt(double, double lat) { return std::abs(lat) < 25.0; }
bool is_belt_and_lake(double lon, double lat) {
  return is_belt(lon, lat) || (lat > 50.0 && lat < 70.0 && std::abs(lon) < 40.0);
}

bool holds_cell_at(const Grid& grid, double lon, double lat) {
  const Vec3 p = grid.surface.point({lon * kRadPerDeg, lat * kRadPerDeg}, grid.latitude);
  const Index cell = domain::cell_at(grid, p);
  double width = 0.0;
  for (const Index vertex : grid.vertices_on_cell.row(cell)) {
    width =
        std::max(width, (grid.vertex_position[at(vertex)] - grid.cell_position[at(cell)]).norm());
  }
  return (grid.cell_position[at(cell)] - p).norm() <= width;
}

void expect_sound(const Grid& grid) {
  parallel::Executor exec(1);
  Monitor monitor;
  Context context{exec, monitor};
  for (const BrokenRule& rule : check_grid(context, grid)) FAIL_CHECK(to_string(rule));
}

LonLatLine meridian(const char* name, double lon, double south, double north) {
  return {name, {lon, lon}, {south, north}};
}

}  // namespace

TEST_CASE("of two bodies the larger is the ocean, all on request, or the one with a point") {
  const Grid grid = made_grid();
  const auto wet = wet_where(grid, is_belt_and_lake);
  const domain::Ocean ocean = ocean_of(grid, wet);
  CHECK(ocean.report.n_bodies == 2);
  CHECK(ocean.report.n_bodies_kept == 1);
  CHECK(holds_cell_at(ocean.culled.grid, 100.0, 0.0));
  CHECK_FALSE(holds_cell_at(ocean.culled.grid, 0.0, 60.0));
  expect_sound(ocean.culled.grid);
  double area = 0.0;
  for (const double a : ocean.culled.grid.cell_area_m2) area += a;
  CHECK(ocean.report.area_m2 == doctest::Approx(area).epsilon(1e-12));
  CHECK(ocean.report.n_border_edges > 100);

  domain::OceanOptions options;
  options.bodies = domain::BodyRule::all;
  const domain::Ocean both = ocean_of(grid, wet, options);
  CHECK(both.report.n_bodies_kept == 2);
  CHECK(both.report.n_cells == ocean.report.n_cells + ocean.report.n_cells_of_other_bodies);

  options.bodies = domain::BodyRule::named;
  options.body_points = {{0.0, 60.0 * kRadPerDeg}};
  const domain::Ocean lake = ocean_of(grid, wet, options);
  CHECK(lake.report.n_cells == ocean.report.n_cells_of_other_bodies);
  CHECK(holds_cell_at(lake.culled.grid, 0.0, 60.0));
  expect_sound(lake.culled.grid);

  options.body_points = {{0.0, -60.0 * kRadPerDeg}};
  testing::expect_error(ErrorKind::input, {"lat -60", "is land", "open water"},
                        [&] { ocean_of(grid, wet, options); });
}

TEST_CASE("the wet share that makes a cell sea is an option") {
  const Grid grid = made_grid();
  Array<double> wet = wet_where(grid, is_belt);
  for (double& share : wet) share = share > 0.0 ? 0.4 : 0.0;
  domain::OceanOptions options;
  testing::expect_error(ErrorKind::input, {"no cell of the grid is sea"},
                        [&] { ocean_of(grid, wet, options); });
  options.least_wet = 0.3;
  CHECK(ocean_of(grid, wet, options).report.n_cells > 500);
}

TEST_CASE("a passage joins two seas, and a blockage parts them") {
  const Grid grid = made_grid();
  // A wall of land across the belt on the meridians of 0 and 180 degrees makes two seas.
  const auto wet = wet_where(grid, [](double lon, double lat) {
    return is_belt(lon, lat) && std::abs(lon) > 6.0 && std::abs(lon) < 174.0;
  });
  REQUIRE(ocean_of(grid, wet).report.n_bodies == 2);
  domain::OceanOptions options;
  options.passages = {{"canal", {-15.0, 15.0}, {2.0, 4.0}}};
  const domain::Ocean joined = ocean_of(grid, wet, options);
  CHECK(joined.report.n_bodies == 1);
  REQUIRE(joined.report.passages.size() == 1);
  const domain::LineReport& canal = joined.report.passages[0];
  CHECK(canal.name == "canal");
  CHECK(canal.holds);
  CHECK(canal.n_changed >= 2);
  CHECK(canal.n_changed < canal.n_cells);
  expect_sound(joined.culled.grid);

  options.blockages = {meridian("dam", 90.0, -35.0, 35.0),
                       meridian("other dam", -90.0, -35.0, 35.0)};
  const domain::Ocean parted = ocean_of(grid, wet, options);
  CHECK(parted.report.n_bodies == 3);
  for (const domain::LineReport& dam : parted.report.blockages) {
    CHECK(dam.holds);
    CHECK(dam.n_changed > 5);
  }
  CHECK_FALSE(holds_cell_at(parted.culled.grid, 90.0, 0.0));

  // A passage through a dam wins where they cross.
  options.passages.push_back({"lock", {80.0, 100.0}, {1.0, 1.0}});
  const domain::Ocean locked = ocean_of(grid, wet, options);
  CHECK(locked.report.n_bodies == 2);
  CHECK_FALSE(locked.report.blockages[0].holds);
  CHECK(locked.report.blockages[1].holds);
}

TEST_CASE("a passage leads around a blockage that it can go around") {
  const Grid grid = made_grid();
  const auto wet = wet_where(grid, is_belt);
  domain::OceanOptions options;
  options.passages = {{"strait", {-30.0, 30.0}, {0.0, 0.0}}};
  options.blockages = {{"island", {0.0, 0.0}, {-1.0, 1.0}}};
  const domain::Ocean ocean = ocean_of(grid, wet, options);
  CHECK(ocean.report.passages[0].holds);
  CHECK(ocean.report.blockages[0].holds);
  CHECK(ocean.report.n_bodies == 1);
  CHECK_FALSE(holds_cell_at(ocean.culled.grid, 0.0, 0.0));
  // Where it ends in one it is shorter.
  options.blockages = {{"island", {30.0, 30.0}, {-1.0, 1.0}}};
  const domain::Ocean shorter = ocean_of(grid, wet, options);
  CHECK(shorter.report.passages[0].holds);
  CHECK(shorter.report.blockages[0].holds);
}

TEST_CASE("a passage steps past an island of one cell between two neighbours") {
  const Grid grid = made_grid();
  const Index before = domain::cell_at(grid, grid.surface.point({0.0, 0.0}, grid.latitude));
  const Index island = grid.cells_on_cell.row(before)[0];
  const Index behind = grid.cells_on_cell.row(before)[1];  // next to both
  LonLatLine strait{"strait", {}, {}};
  for (const Index cell : {before, island, behind}) {
    strait.lon_deg.push_back(lon_deg(grid, cell));
    strait.lat_deg.push_back(lat_deg(grid, cell));
  }
  domain::OceanOptions options;
  options.passages = {strait};
  options.blockages = {{"island", {strait.lon_deg[1]}, {strait.lat_deg[1]}}};
  const domain::OceanReport report = ocean_of(grid, wet_where(grid, is_belt), options).report;
  CHECK(report.passages[0].holds);
  CHECK(report.passages[0].n_cells == 2);
  CHECK(report.blockages[0].holds);
}

TEST_CASE("a passage through the cell of a blockage leaves the cells across it shut") {
  const Grid grid = made_grid();
  auto wet = wet_where(grid, [](double lon, double lat) {
    return is_belt(lon, lat) && std::abs(lon) > 20.0 && std::abs(lon) < 160.0;
  });
  domain::OceanOptions options;
  options.passages = {{"canal", {-25.0, 25.0}, {2.0, 2.0}},
                      {"other canal", {155.0, 205.0}, {2.0, 2.0}}};
  const std::vector<Index> canal = domain::cells_along(grid, options.passages[0]);
  const auto are_beside = [&](Index a, Index b) {
    const auto row = grid.cells_on_cell.row(a);
    return std::find(row.begin(), row.end(), b) != row.end();
  };
  // A cell in the middle that the canal can't do without, and one beside it that is no way around.
  std::size_t i = canal.size() / 2;
  while (are_beside(canal[i - 1], canal[i + 1])) ++i;
  REQUIRE(i + 2 < canal.size());
  const Index middle = canal[i];
  const auto row = grid.cells_on_cell.row(middle);
  const Index pond = *std::find_if(row.begin(), row.end(), [&](Index cell) {
    return std::find(canal.begin(), canal.end(), cell) == canal.end() &&
           !(are_beside(cell, canal[i - 1]) && are_beside(cell, canal[i + 1]));
  });
  wet[at(pond)] = 1.0;
  REQUIRE(ocean_of(grid, wet, options).report.n_bodies == 1);
  // A short line in the canal's cell, across the link to the pond.
  const Vec3 &a = grid.cell_position[at(middle)], &b = grid.cell_position[at(pond)];
  const Vec3 along = 0.1 * a.cross(b - a);
  LonLatLine wall{"wall", {}, {}};
  for (const Vec3& p : {Vec3(a + 0.4 * (b - a) + along), Vec3(a + 0.4 * (b - a) - along)}) {
    const LonLat place = grid.surface.lon_lat(grid.surface.project(p), grid.latitude);
    wall.lon_deg.push_back(place.lon_rad * kDegPerRad);
    wall.lat_deg.push_back(place.lat_rad * kDegPerRad);
  }
  const std::vector<Index> cells = domain::cells_along(grid, wall);
  REQUIRE(cells == std::vector<Index>{middle});
  CHECK(domain::links_across(grid, wall, cells) ==
        std::vector<domain::Link>{{std::min(middle, pond), std::max(middle, pond)}});
  options.blockages = {wall};
  const domain::Ocean ocean = ocean_of(grid, wet, options);
  CHECK(ocean.report.passages[0].holds);
  CHECK(ocean.report.blockages[0].holds);
  CHECK(ocean.report.blockages[0].n_shared == 1);
  CHECK(std::count(ocean.culled.old_cell.begin(), ocean.culled.old_cell.end(), middle) == 1);
  CHECK(std::count(ocean.culled.old_cell.begin(), ocean.culled.old_cell.end(), pond) == 0);
}

TEST_CASE("what pruning takes beyond the ends of a passage comes back as far as it is needed") {
  const Grid grid = made_grid();
  Array<double> wet = wet_where(grid, is_belt);
  for (const Index cell : domain::cells_along(grid, meridian("inlet", 90.0, 20.0, 45.0))) {
    wet[at(cell)] = 1.0;
  }
  domain::OceanOptions options;
  options.prune = {true, true};
  const std::int64_t n_without = ocean_of(grid, wet, options).report.n_cells;
  options.passages = {meridian("river", 90.0, 45.0, 70.0)};
  const domain::Ocean ocean = ocean_of(grid, wet, options);
  CHECK(ocean.report.passages[0].holds);
  CHECK(ocean.report.n_cells_given_back > 0);
  CHECK(ocean.report.n_cells <=
        n_without + ocean.report.n_cells_given_back + ocean.report.passages[0].n_cells + 1);
  CHECK(ocean.report.n_bodies == 1);
  CHECK(holds_cell_at(ocean.culled.grid, 90.0, 70.0));
  CHECK(holds_cell_at(ocean.culled.grid, 90.0, 35.0));
  // No way leads from a lake without an outlet.
  options.passages = {{"lake", {-90.0, -80.0}, {60.0, 60.0}}};
  CHECK_FALSE(ocean_of(grid, wet, options).report.passages[0].holds);
}

TEST_CASE("a line's cells hang together across the date line, near a pole and in long strides") {
  const Grid grid = made_grid();
  for (const LonLatLine& line :
       {LonLatLine{"date line", {170.0, 195.0, -170.0}, {10.0, -5.0, -20.0}},
        LonLatLine{"pole", {0.0, 120.0, 240.0}, {85.0, 84.0, 86.0}},
        LonLatLine{"long", {0.0, 170.0}, {-60.0, 70.0}}, LonLatLine{"point", {12.0}, {5.0}}}) {
    CAPTURE(line.name);
    const std::vector<Index> cells = domain::cells_along(grid, line);
    REQUIRE_FALSE(cells.empty());
    domain::Mask on_line(grid.cell_position.size(), 0);
    for (const Index cell : cells) on_line[at(cell)] = 1;
    CHECK(domain::find_bodies(grid, on_line).bodies.size() == 1);
    for (std::size_t i = 0; i < line.lon_deg.size(); ++i) {
      const Vec3 p = grid.surface.point(
          {line.lon_deg[i] * kRadPerDeg, line.lat_deg[i] * kRadPerDeg}, grid.latitude);
      CHECK(on_line[at(domain::cell_at(grid, p))] == 1);
    }
  }
}

TEST_CASE("bays and channels one cell wide go on request, but for passages") {
  const Grid grid = made_grid();
  // Two belts, joined by a channel; an inlet into the land in the north.
  Array<double> wet = wet_where(grid, [](double, double lat) {
    return (lat > 10.0 && lat < 30.0) || (lat < -10.0 && lat > -30.0);
  });
  const auto dig = [&](const LonLatLine& line) {
    for (const Index cell : domain::cells_along(grid, line)) wet[at(cell)] = 1.0;
  };
  dig(meridian("channel", 0.0, -15.0, 15.0));
  dig(meridian("inlet", 90.0, 25.0, 60.0));
  const domain::Ocean plain = ocean_of(grid, wet);
  CHECK(plain.report.n_bodies == 1);
  CHECK(holds_cell_at(plain.culled.grid, 90.0, 60.0));

  domain::OceanOptions options;
  options.prune.bays = true;
  const domain::Ocean no_bays = ocean_of(grid, wet, options);
  CHECK(no_bays.report.n_bodies == 1);
  CHECK(no_bays.report.pruned.n_bays > 3);
  CHECK(no_bays.report.pruned.n_channels == 0);
  CHECK_FALSE(holds_cell_at(no_bays.culled.grid, 90.0, 45.0));
  CHECK(holds_cell_at(no_bays.culled.grid, 0.0, 0.0));

  options.prune.channels = true;
  const domain::Ocean neither = ocean_of(grid, wet, options);
  CHECK(neither.report.n_bodies == 2);
  CHECK(neither.report.pruned.n_channels > 0);
  CHECK_FALSE(holds_cell_at(neither.culled.grid, 0.0, 0.0));
  expect_sound(neither.culled.grid);
  for (Index cell = 0; cell < neither.report.n_cells; ++cell) {
    const auto row = neither.culled.grid.cells_on_cell.row(cell);
    REQUIRE(std::count(row.begin(), row.end(), kNone) <=
            static_cast<std::ptrdiff_t>(row.size()) - 2);
  }

  options.passages = {meridian("channel", 0.0, -15.0, 15.0)};
  const domain::Ocean kept = ocean_of(grid, wet, options);
  CHECK(kept.report.n_bodies == 1);
  CHECK(kept.report.passages[0].holds);
}

TEST_CASE("the order of the cells changes no cell, and a curve keeps neighbours near") {
  const Grid grid = made_grid();
  const auto wet = wet_where(grid, is_belt);
  const auto stride = [](const Grid& g) {
    double sum = 0.0;
    for (const auto& cells : g.cells_on_edge) sum += cells[1] == kNone ? 0 : cells[1] - cells[0];
    return sum / static_cast<double>(g.n_edges());
  };
  domain::OceanOptions options;
  options.order = domain::CellOrder::kept;
  const domain::Ocean plain = ocean_of(grid, wet, options);
  CHECK(std::is_sorted(plain.culled.old_cell.begin(), plain.culled.old_cell.end()));
  options.order = domain::CellOrder::hilbert;
  const domain::Ocean along = ocean_of(grid, wet, options);
  CHECK(stride(along.culled.grid) < 0.5 * stride(plain.culled.grid));
  options.order = domain::CellOrder::metis;
  options.n_parts = 8;
  if (!kway::is_available()) {
    testing::expect_error(ErrorKind::config, {"METIS"}, [&] { ocean_of(grid, wet, options); });
    return;
  }
  const domain::Ocean parts = ocean_of(grid, wet, options);
  expect_sound(parts.culled.grid);
  for (const domain::Ocean* ocean : {&along, &parts}) {
    Array<Index> cells = ocean->culled.old_cell;
    std::sort(cells.begin(), cells.end());
    CHECK(cells == plain.culled.old_cell);
  }
}

TEST_CASE("land polygons make a mask like an elevation") {
  PolygonSet land;
  land.source = "made";
  land.rings = {{{-60.0, 60.0, 60.0, -60.0}, {-40.0, -40.0, 40.0, 40.0}, 0}};
  parallel::Executor exec(1);
  const LatLonField elevation = domain::elevation_of(exec, land, kRadPerDeg);
  CHECK(elevation.values[elevation.at(90, 180)] == 1.0);
  CHECK(elevation.values[elevation.at(90, 0)] == -1.0);
  land.rings.clear();
  testing::expect_error(ErrorKind::input, {"made", "no polygon"},
                        [&] { domain::elevation_of(exec, land, kRadPerDeg); });
}

TEST_CASE("an ocean has the same bits for any number of threads") {
  const Grid grid = made_grid();
  const auto wet = wet_where(grid, is_belt_and_lake);
  domain::OceanOptions options;
  options.prune = {true, true};
  const std::string one = digest(ocean_of(grid, wet, options).culled.grid);
  for (const int threads : {2, 5, 8}) {
    CHECK(digest(ocean_of(grid, wet, options, threads).culled.grid) == one);
  }
}
