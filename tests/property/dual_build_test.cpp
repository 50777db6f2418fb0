// SPDX-License-Identifier: BSD-3-Clause
#include "dual/build.hpp"
#include "dual/digest.hpp"

#include <doctest/doctest.h>

#include "dual/validate.hpp"
#include "support/sample_meshes.hpp"

using namespace delos;

namespace {

const std::vector<Ellipsoid> kSurfaces{Ellipsoid::sphere(6371220.0), Ellipsoid::wgs84(),
                                       Ellipsoid(Vec3(1.2, 1.0, 0.8) * 6e6, Vec3(10, 20, 30)),
                                       Ellipsoid(Vec3(0.7, 1.0, 0.4), Vec3::Zero())};

std::string broken_rules(Context& context, const Grid& grid) {
  std::string all;
  for (const BrokenRule& rule : check_grid(context, grid)) all += to_string(rule) + "\n";
  return all;
}

double relative_sum(std::span<const double> areas, const Ellipsoid& surface) {
  double sum = 0.0;
  for (const double area : areas) sum += area;
  return std::abs(sum / (surface.area() * surface.scale_m() * surface.scale_m()) - 1.0);
}

}  // namespace

TEST_CASE("a well-centred grid keeps every identity on every surface") {
  parallel::Executor exec(2);
  Monitor monitor;
  Context context{exec, monitor};
  for (const Ellipsoid& surface : kSurfaces) {
    CAPTURE(surface.radii().transpose());
    const int levels = surface.radii().minCoeff() < 0.5 ? 0 : 4;
    for (const auto latitude :
         {LatitudeKind::geodetic, LatitudeKind::geocentric, LatitudeKind::parametric}) {
      const Mesh mesh = samples::make_delaunay(samples::bisected_icosahedron(surface, levels));
      const Grid grid = build_grid(context, surface, latitude, mesh);
      const std::string broken = broken_rules(context, grid);
      if (surface.radii().minCoeff() > 0.7) CHECK(broken == "");
      CHECK(relative_sum(grid.cell_area_m2, surface) < 1e-13);
      CHECK(relative_sum(grid.triangle_area_m2, surface) < 1e-13);
    }
  }
}

TEST_CASE("a mesh with obtuse triangles breaks no rule but that of being well centred") {
  parallel::Executor exec(2);
  Monitor monitor;
  Context context{exec, monitor};
  for (const Ellipsoid& surface : kSurfaces) {
    for (std::uint64_t seed = 1; seed <= 2; ++seed) {
      CAPTURE(surface.radii().transpose());
      CAPTURE(seed);
      const Mesh mesh = samples::shaken(surface, 3, 0.25, seed);
      const Grid grid = build_grid(context, surface, LatitudeKind::geodetic, mesh);
      for (const BrokenRule& rule : check_grid(context, grid, 1e-7)) {
        CAPTURE(to_string(rule));
        const bool is_expected = rule.rule.starts_with("kites are positive") ||
                                 rule.rule.starts_with("a vertex lies inside") ||
                                 // Beyond 1 : .8 the flips are not quite the surface Delaunay.
                                 surface.radii().minCoeff() < 0.8;
        CHECK(is_expected);
      }
      CHECK(relative_sum(grid.cell_area_m2, surface) < 1e-13);
      CHECK(relative_sum(grid.triangle_area_m2, surface) < 1e-13);
    }
  }
}

TEST_CASE("the grid has the same bits for any number of threads") {
  for (const Ellipsoid& surface : kSurfaces) {
    const Mesh mesh = samples::shaken(surface, 5, 0.2, 3);
    std::string first;
    for (const int threads : {1, 2, 5, 8}) {
      parallel::Executor exec(threads);
      Monitor monitor;
      Context context{exec, monitor};
      const std::string bits =
          digest(exec, build_grid(context, surface, LatitudeKind::geodetic, mesh));
      if (first.empty()) first = bits;
      CHECK(bits == first);
    }
  }
}

TEST_CASE("longitudes lie from 0 to 2 pi, poles and date line included") {
  parallel::Executor exec(1);
  Monitor monitor;
  Context context{exec, monitor};
  const Ellipsoid surface;
  // Tilted so that vertices come to lie at both poles and on the meridians 0 and 180.
  Mesh mesh = samples::bisected_icosahedron(surface, 3);
  const Vec3 pole = mesh.position(0);
  const Vec3 x = pole.cross(Vec3(1, 0, 0)).normalized(), y = pole.cross(x);
  for (Vertex& v : mesh.vertices) {
    const Vec3 p =
        surface.project(Vec3(v.position().dot(x), v.position().dot(y), v.position().dot(pole)));
    v = {p.x(), p.y(), p.z(), v.spacing};
  }
  const Grid grid = build_grid(context, surface, LatitudeKind::geodetic, mesh);
  for (const auto* places : {&grid.cell_lon_lat, &grid.edge_lon_lat, &grid.vertex_lon_lat}) {
    for (const LonLat& place : *places) {
      CHECK(place.lon_rad >= 0.0);
      CHECK(place.lon_rad < 2.0 * kPi);
    }
  }
  CHECK(broken_rules(context, grid) == "");
}
