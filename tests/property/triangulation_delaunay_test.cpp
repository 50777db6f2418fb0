// SPDX-License-Identifier: BSD-3-Clause
#include "triangulation/delaunay.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "core/hash.hpp"
#include "geometry/predicates.hpp"
#include "triangulation/flip.hpp"
#include "triangulation/insert.hpp"
#include "triangulation/locate.hpp"
#include "triangulation/seeds.hpp"
#include "triangulation/validate.hpp"

using namespace delos;

namespace {

Vec3 random_direction(std::uint64_t seed, std::uint64_t id) {
  for (std::uint64_t round = 0;; round += 3) {
    const Vec3 p(2 * uniform01(seed, id, round) - 1, 2 * uniform01(seed, id, round + 1) - 1,
                 2 * uniform01(seed, id, round + 2) - 1);
    if (p.squaredNorm() < 1 && p.squaredNorm() > 0.01) return p.normalized();
  }
}

std::vector<Vec3> random_points(std::uint64_t seed, std::size_t n) {
  std::vector<Vec3> points(n);
  for (std::size_t i = 0; i < n; ++i) points[i] = random_direction(seed, i);
  return points;
}

/// Distances from a centre between 1e-4 and 1, evenly in the logarithm.
std::vector<Vec3> clustered_points(std::uint64_t seed, std::size_t n) {
  std::vector<Vec3> points = fibonacci_points(64);
  for (std::size_t i = points.size(); i < n; ++i) {
    const Vec3 centre(0.6, -0.48, 0.64);
    const double distance = std::pow(10.0, -4 * uniform01(seed, i, 99));
    points.push_back((centre + distance * random_direction(seed, i)).normalized());
  }
  return points;
}

/// Rings of exactly symmetric points, both poles, the date line.
std::vector<Vec3> lat_lon_points(int n) {
  const Ellipsoid sphere;
  std::vector<Vec3> points = {{0, 0, 1}, {0, 0, -1}};
  for (int j = 1; j < n; ++j) {
    for (int i = 0; i < 2 * n; ++i) {
      points.push_back(
          sphere.point({kPi * (i - n + 1) / n, kPi * j / n - kPi / 2}, LatitudeKind::geocentric));
    }
  }
  return points;
}

void shuffle(std::vector<Vec3>& points, std::uint64_t seed) {
  for (std::size_t i = points.size(); i > 1; --i) {
    std::swap(points[i - 1], points[hash64(seed, i) % i]);
  }
}

/// The triangles as a set, every one rotated to begin with its lowest id.
std::set<std::array<Index, 3>> triangle_set(const Mesh& mesh) {
  std::set<std::array<Index, 3>> out;
  for (const Triangle& t : mesh.triangles) {
    std::array<Index, 3> v = t.vertex;
    std::rotate(v.begin(), std::min_element(v.begin(), v.end()), v.end());
    out.insert(v);
  }
  return out;
}

std::string defects(const Mesh& mesh, const Ellipsoid& surface = {}) {
  return summary(validate(mesh, surface));
}

Vertex vertex_at(const Vec3& p) { return {p.x(), p.y(), p.z(), 0}; }

}  // namespace

TEST_CASE("random, clustered and exactly symmetric points all give sound Delaunay meshes") {
  parallel::Executor exec(2);
  std::vector<std::vector<Vec3>> sets = {random_points(1, 20000), clustered_points(2, 20000),
                                         cubed_sphere_points(40), icosahedral_points(32),
                                         icosahedral_points(21),  lat_lon_points(40),
                                         fibonacci_points(20000), random_points(3, 5),
                                         cubed_sphere_points(1),  icosahedral_points(1)};
  for (std::size_t k = 0; k < sets.size(); ++k) {
    CAPTURE(k);
    for (const bool shuffled : {false, true}) {
      if (shuffled) shuffle(sets[k], 7);
      DelaunayReport report;
      const bool small_random = sets[k].size() == 5;
      if (small_random)
        sets[k] = {{1, 0, 0}, {-0.5, 0.8, 0}, {-0.5, -0.8, 0}, {0, 0, 1}, {0, 0, -1}};
      const Mesh mesh = delaunay(exec, sets[k], &report);
      CHECK(mesh.n_triangles() == 2 * mesh.n_vertices() - 4);
      if (!small_random) CHECK(defects(mesh) == "");
    }
  }
}

TEST_CASE("every vertex is outside every circumcircle: brute force on symmetric points") {
  parallel::Executor exec(1);
  for (const std::vector<Vec3>& points :
       {cubed_sphere_points(4), lat_lon_points(5), icosahedral_points(4), random_points(5, 100)}) {
    const Mesh mesh = delaunay(exec, points);
    for (const Triangle& t : mesh.triangles) {
      for (Index v = 0; v < mesh.n_vertices(); ++v) {
        if (corner_at(t, v) >= 0) continue;
        const auto site = [&](Index i) { return predicates::Site{mesh.position(i), i}; };
        REQUIRE_FALSE(predicates::in_circle(site(t.vertex[0]), site(t.vertex[1]), site(t.vertex[2]),
                                            site(v)));
      }
    }
  }
}

TEST_CASE("the triangulation does not depend on threads, and ties follow the ids") {
  parallel::Executor one(1);
  parallel::Executor many(5);
  for (const std::vector<Vec3>& points : {random_points(11, 30000), cubed_sphere_points(50)}) {
    CHECK(digest(delaunay(one, points)) == digest(delaunay(many, points)));
  }
  // Rotating the ids of an asymmetric set renames the triangles and changes nothing else.
  const std::vector<Vec3> points = random_points(12, 3000);
  std::vector<Vec3> rotated = points;
  std::rotate(rotated.begin(), rotated.begin() + 1000, rotated.end());
  Mesh renamed = delaunay(one, rotated);
  for (Triangle& t : renamed.triangles) {
    for (Index& v : t.vertex) v = (v + 1000) % 3000;
  }
  CHECK(triangle_set(renamed) == triangle_set(delaunay(one, points)));
}

TEST_CASE("Lawson flips turn any triangulation into the same Delaunay mesh, ties included") {
  parallel::Executor exec(2);
  const Ellipsoid sphere;
  for (const std::vector<Vec3>& points :
       {random_points(21, 3000), cubed_sphere_points(20), lat_lon_points(20)}) {
    const Mesh good = delaunay(exec, points);
    Mesh mesh = good;
    for (std::uint64_t i = 0; i < 20000; ++i) {  // random flips that keep every triangle positive
      const auto tri = static_cast<Index>(hash64(22, i) % mesh.triangles.size());
      const int side = static_cast<int>(hash64(23, i) % 3);
      if (can_flip(mesh, tri, side)) flip(mesh, tri, side);
    }
    CHECK_FALSE(validate(mesh, sphere).empty());
    const std::int64_t n_flips = restore_delaunay_everywhere(exec, mesh, sphere);
    CHECK(n_flips > 1000);
    CHECK(defects(mesh) == "");
    CHECK(triangle_set(mesh) == triangle_set(good));
  }
}

TEST_CASE("restoring everywhere gives the same bits for any number of threads") {
  const Ellipsoid surface({7645.464e3, 6371.22e3, 5096.976e3}, {0, 0, 0});
  parallel::Executor one(1);
  const Mesh start = delaunay(one, fibonacci_points(30000, surface));
  Mesh reference = start;
  CHECK(restore_delaunay_everywhere(one, reference, surface) > 0);
  CHECK(defects(reference, surface) == "");
  for (const int n_threads : {2, 5, 8}) {
    parallel::Executor exec(n_threads);
    Mesh mesh = start;
    restore_delaunay_everywhere(exec, mesh, surface);
    CHECK(digest(mesh) == digest(reference));
  }
}

TEST_CASE("meshes of ellipsoids reach the surface Delaunay property by flips") {
  parallel::Executor exec(1);
  const Ellipsoid triaxial({1, 0.84, 0.69}, {0, 0, 0});
  const Ellipsoid wgs84 = Ellipsoid::wgs84();
  for (const Ellipsoid* surface : {&wgs84, &triaxial}) {
    std::vector<Vec3> points = random_points(31, 10000);
    for (Vec3& p : points) p = surface->project(p);
    Mesh mesh = delaunay(exec, points);
    restore_delaunay_everywhere(exec, mesh, *surface);
    CHECK(defects(mesh, *surface) == "");
    // The surface ball of nearly every triangle is empty of the vertices across its sides.
    int n_inside = 0;
    for (Index tri = 0; tri < mesh.n_triangles(); ++tri) {
      const auto& v = mesh.triangle(tri).vertex;
      const Vec3 a = mesh.position(v[0]);
      const Vec3 centre = surface->ball_centre(a, mesh.position(v[1]), mesh.position(v[2]));
      for (int side = 0; side < 3; ++side) {
        const Vec3 d = mesh.position(opposite_vertex(mesh, tri, side));
        n_inside += (d - centre).norm() < (a - centre).norm() * (1 - 1e-9) ? 1 : 0;
      }
    }
    CHECK(n_inside < mesh.n_triangles() * 0.005);
  }
}

TEST_CASE("inserting one by one ends in the mesh of the whole, ties included") {
  parallel::Executor exec(1);
  const Ellipsoid sphere;
  for (const std::vector<Vec3>& points :
       {random_points(41, 2000), cubed_sphere_points(12), lat_lon_points(12)}) {
    const std::size_t n_first = points.size() / 2;
    // The first half of a shuffled set encloses the centre.
    std::vector<Vec3> shuffled = points;
    shuffle(shuffled, 42);
    Mesh mesh = delaunay(exec, std::span(shuffled).first(n_first));
    for (std::size_t i = n_first; i < shuffled.size(); ++i) {
      const Index id = insert_vertex(mesh, sphere, vertex_at(shuffled[i]), 0);
      REQUIRE(id == static_cast<Index>(i));
    }
    CHECK(defects(mesh) == "");
    CHECK(triangle_set(mesh) == triangle_set(delaunay(exec, shuffled)));
  }
}

TEST_CASE("vertices inserted exactly on edges and next to corners keep the mesh sound") {
  parallel::Executor exec(1);
  const Ellipsoid sphere;
  Mesh mesh = delaunay(exec, icosahedral_points(2));
  for (std::uint64_t i = 0; i < 500; ++i) {
    const auto tri = static_cast<Index>(hash64(51, i) % mesh.triangles.size());
    const Triangle t = mesh.triangle(tri);
    const Vec3 a = mesh.position(t.vertex[0]);
    const Vec3 b = mesh.position(t.vertex[1]);
    // Not so close that rounding takes the points off a convex surface.
    if ((b - a).norm() < 0.01) continue;
    const double along = i % 5 == 0 ? 1e-4 : 0.5;
    insert_vertex(mesh, sphere, vertex_at((a + along * (b - a)).normalized()), 0);
  }
  CHECK(defects(mesh) == "");
}

TEST_CASE("removing vertices gives the Delaunay mesh of the rest, ties included") {
  parallel::Executor exec(1);
  const Ellipsoid sphere;
  for (std::vector<Vec3> points :
       {random_points(61, 2000), cubed_sphere_points(12), lat_lon_points(12)}) {
    shuffle(points, 62);
    Mesh mesh = delaunay(exec, points);
    Mesh batch = mesh;
    std::vector<Index> gone;
    std::vector<Vec3> rest;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (hash64(63, i) % 3 == 0) {
        gone.push_back(static_cast<Index>(i));
      } else {
        rest.push_back(points[i]);
      }
    }
    std::vector<Index> new_id;
    REQUIRE(remove_vertices(batch, sphere, gone, new_id) == static_cast<std::int64_t>(gone.size()));
    CHECK(defects(batch) == "");
    CHECK(triangle_set(batch) == triangle_set(delaunay(exec, rest)));
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (new_id[i] != kNone) REQUIRE(batch.position(new_id[i]) == points[i]);
    }
    // One at a time, from the highest id down so that ids to come stay put.
    for (std::size_t k = gone.size(); k-- > 0;) {
      REQUIRE(remove_vertex(mesh, sphere, gone[k], 0));
    }
    CHECK(mesh.n_vertices() == static_cast<Index>(rest.size()));
    CHECK(defects(mesh) == "");
  }
}

TEST_CASE("insertion and removal work on an ellipsoid") {
  parallel::Executor exec(1);
  const Ellipsoid surface({1, 0.84, 0.69}, {0, 0, 0});
  Mesh mesh = delaunay(exec, fibonacci_points(1000, surface));
  restore_delaunay_everywhere(exec, mesh, surface);
  for (std::uint64_t i = 0; i < 1000; ++i) {
    if (i % 3 < 2) {
      insert_vertex(mesh, surface, vertex_at(surface.project(random_direction(71, i))), 0);
    } else {
      const auto vertex = static_cast<Index>(hash64(72, i) % mesh.vertices.size());
      REQUIRE(remove_vertex(mesh, surface, vertex, 0));
    }
  }
  CHECK(defects(mesh, surface) == "");
}

TEST_CASE("the walk finds the triangle of every point from anywhere, corners and sides included") {
  parallel::Executor exec(1);
  const Mesh mesh = delaunay(exec, cubed_sphere_points(20));
  const auto holds = [&](Index tri, const Vec3& p) {
    const auto& v = mesh.triangle(tri).vertex;
    for (std::size_t k = 0; k < 3; ++k) {
      if (predicates::orient_origin(mesh.position(v[k]), mesh.position(v[(k + 1) % 3]), p) < 0) {
        return false;
      }
    }
    return true;
  };
  for (std::uint64_t i = 0; i < 2000; ++i) {
    const auto start = static_cast<Index>(hash64(81, i) % mesh.triangles.size());
    const Vec3 p = random_direction(82, i);
    REQUIRE(holds(locate(mesh, p, start), p));
    const Vec3 corner = mesh.position(static_cast<Index>(i % mesh.vertices.size()));
    REQUIRE(holds(locate(mesh, corner, start), corner));
    const Triangle& t = mesh.triangle(start);
    const Vec3 between = (mesh.position(t.vertex[0]) + mesh.position(t.vertex[1])).normalized();
    REQUIRE(holds(locate(mesh, between, 0), between));
  }
}
