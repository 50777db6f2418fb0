// SPDX-License-Identifier: BSD-3-Clause
#include "pictures/zoom.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "core/hash.hpp"
#include "support/sample_grids.hpp"
#include "support/sample_meshes.hpp"

using namespace delos;
using namespace delos::pictures;

namespace {

const Ellipsoid kEarth = Ellipsoid::sphere(6371220.0);

LonLat degrees(double lon, double lat) { return {lon * kRadPerDeg, lat * kRadPerDeg}; }

Vec3 point(const LonLat& place) { return kEarth.point(place, LatitudeKind::geodetic); }

/// What of the cells within 20 degrees of a place tells where they are.
Grid cap_around(const LonLat& place) {
  const Grid grid = samples::grid_of(kEarth, samples::bisected_icosahedron(kEarth, 3));
  const Vec3 axis = grid.surface.point(place, grid.latitude);
  Grid part;
  for (Index cell = 0; cell < grid.n_cells(); ++cell) {
    if (grid.cell_position[at(cell)].dot(axis) < std::cos(20.0 * kRadPerDeg)) continue;
    part.cell_lon_lat.push_back(grid.cell_lon_lat[at(cell)]);
    part.cell_area_m2.push_back(grid.cell_area_m2[at(cell)]);
    for (const Index vertex : grid.vertices_on_cell.row(cell)) {
      part.vertex_lon_lat.push_back(grid.vertex_lon_lat[at(vertex)]);
    }
  }
  part.cells_on_edge.push_back({0, kNone});
  return part;
}

}  // namespace

TEST_CASE("the azimuthal map keeps areas and leads back, at poles and over the date line") {
  for (const LonLat& centre : {degrees(180, -17), degrees(30, 89.9), degrees(0, -90)}) {
    const AzimuthalMap map(centre);
    for (std::uint64_t i = 0; i < 200; ++i) {
      const LonLat place = degrees(360.0 * uniform01(1, i) - 180.0, 178.0 * uniform01(2, i) - 89.0);
      if (!map.shows(place)) continue;
      const LonLat back = map.inverse(map.forward(place));
      CHECK((point(back) - point(place)).norm() < 1e-12);
      constexpr double kStep = 1e-4;
      const Point p = map.forward(place),
                  east = map.forward({place.lon_rad + kStep, place.lat_rad}),
                  north = map.forward({place.lon_rad, place.lat_rad + kStep});
      const double area = (east.x - p.x) * (north.y - p.y) - (east.y - p.y) * (north.x - p.x);
      CHECK(area / (kStep * kStep * std::cos(place.lat_rad)) == doctest::Approx(1.0).epsilon(0.05));
    }
  }
}

TEST_CASE("a region is shown around its middle, over a pole and the date line too") {
  for (const LonLat& place : {degrees(180, 0), degrees(10, 90), degrees(-60, -50)}) {
    const Grid grid = cap_around(place);
    const auto zoom = zoom_of(grid, {});
    REQUIRE(zoom);
    CHECK((point(zoom->centre) - point(place)).norm() < 0.05);
    CHECK(zoom->radius_rad == doctest::Approx(22.0 * kRadPerDeg).epsilon(0.2));
  }
}

TEST_CASE("a whole grid is shown close up on request alone") {
  const Grid grid = samples::grid_of(kEarth, samples::bisected_icosahedron(kEarth, 2));
  PictureOptions options;
  CHECK_FALSE(zoom_of(grid, options));
  options.view_lon_deg = 170.0;
  options.view_lat_deg = -5.0;
  options.view_radius_deg = 10.0;
  const auto zoom = zoom_of(grid, options);
  REQUIRE(zoom);
  CHECK(zoom->radius_rad == doctest::Approx(10.0 * kRadPerDeg));
  CHECK(zoom->centre.lon_rad == doctest::Approx(170.0 * kRadPerDeg));
}

TEST_CASE("lines of a graticule are a handful, fewer meridians near a pole") {
  CHECK(graticule_step(360.0) == 30.0);
  CHECK(graticule_step(40.0) == 10.0);
  CHECK(graticule_step(1.0) == 0.2);
  CHECK(meridian_step({degrees(0, 86), 15.0 * kRadPerDeg}) == 30.0);
  CHECK(meridian_step({degrees(0, 0), 15.0 * kRadPerDeg}) == graticule_step(30.0));
}
