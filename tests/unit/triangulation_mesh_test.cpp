// SPDX-License-Identifier: BSD-3-Clause
#include "triangulation/mesh.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "geometry/predicates.hpp"
#include "triangulation/delaunay.hpp"
#include "triangulation/flip.hpp"
#include "triangulation/insert.hpp"
#include "triangulation/locate.hpp"
#include "triangulation/seeds.hpp"
#include "triangulation/validate.hpp"

using namespace delos;

namespace {

Mesh icosahedron() {
  parallel::Executor exec(1);
  return delaunay(exec, icosahedral_points(1));
}

bool has(const std::vector<Defect>& defects, DefectKind kind, Index id) {
  for (const Defect& defect : defects) {
    if (defect.kind == kind && defect.id == id && !defect.text.empty()) return true;
  }
  return false;
}

const Ellipsoid kSphere;

}  // namespace

TEST_CASE("triangle_at_vertex is the lowest triangle of each vertex") {
  const Mesh mesh = icosahedron();
  const std::vector<Index> at = triangle_at_vertex(mesh);
  parallel::Executor exec(4);
  CHECK(triangle_at_vertex(exec, mesh) == at);
  for (Index v = 0; v < mesh.n_vertices(); ++v) {
    Index lowest = kNone;
    for (Index tri = mesh.n_triangles() - 1; tri >= 0; --tri) {
      if (corner_at(mesh.triangle(tri), v) >= 0) lowest = tri;
    }
    CHECK(at[static_cast<std::size_t>(v)] == lowest);
  }
}

TEST_CASE("the digest sees every position bit and every corner, not the spacing") {
  const Mesh mesh = icosahedron();
  Mesh other = mesh;
  CHECK(digest(other) == digest(mesh));
  other.vertices[3].spacing = 7;
  CHECK(digest(other) == digest(mesh));
  other.vertices[3].x += 1e-16;
  other.vertices[3].x = other.vertices[3].x * (1 + 1e-15);
  CHECK(digest(other) != digest(mesh));
  other = mesh;
  std::swap(other.triangles[0].vertex[0], other.triangles[0].vertex[1]);
  CHECK(digest(other) != digest(mesh));
}

TEST_CASE("two flips of one side restore the diagonal") {
  const Mesh before = icosahedron();
  Mesh mesh = before;
  const Triangle t = mesh.triangle(5);
  const Index p = opposite_vertex(mesh, 5, 1);
  flip(mesh, 5, 1);
  CHECK(corner_at(mesh.triangle(5), p) >= 0);
  CHECK(corner_at(mesh.triangle(5), t.vertex[1]) >= 0);
  CHECK_FALSE(has(validate(mesh, kSphere), DefectKind::asymmetric, 5));
  flip(mesh, 5, side_towards(mesh.triangle(5), t.neighbour[1]));
  const auto defects = validate(mesh, kSphere);
  CHECK(summary(defects) == "");
}

TEST_CASE("validate names every kind of damage") {
  const Mesh good = icosahedron();
  CHECK(validate(good, kSphere).empty());
  Mesh mesh = good;
  mesh.triangles[4].vertex[1] = 12;
  CHECK(has(validate(mesh, kSphere), DefectKind::bad_id, 4));
  mesh = good;
  mesh.triangles[4].neighbour[2] = kNone;
  CHECK(has(validate(mesh, kSphere), DefectKind::bad_id, 4));
  mesh = good;
  std::swap(mesh.triangles[6].neighbour[0], mesh.triangles[6].neighbour[1]);
  CHECK(has(validate(mesh, kSphere), DefectKind::asymmetric, 6));
  mesh = good;
  for (Triangle& t : mesh.triangles) {  // inside out
    std::swap(t.vertex[0], t.vertex[1]);
    std::swap(t.neighbour[0], t.neighbour[1]);
  }
  CHECK(has(validate(mesh, kSphere), DefectKind::orientation, 0));
  mesh = good;
  mesh.vertices.push_back({0, 0.6, 0.8, 0});
  const auto defects = validate(mesh, kSphere);
  CHECK(has(defects, DefectKind::unreferenced, 12));
  CHECK(has(defects, DefectKind::euler, kNone));
  mesh = good;
  mesh.vertices[5].x *= 1 + 1e-11;
  mesh.vertices[5].y *= 1 + 1e-11;
  mesh.vertices[5].z *= 1 + 1e-11;
  CHECK(has(validate(mesh, kSphere), DefectKind::off_surface, 5));
  mesh = good;
  mesh.vertices[7] = mesh.vertices[2];
  CHECK(has(validate(mesh, kSphere), DefectKind::duplicate, 2));
  mesh = good;
  flip(mesh, 3, 0);
  ValidateOptions topology;
  topology.delaunay = false;
  CHECK(validate(mesh, kSphere, topology).empty());
  CHECK(has(validate(mesh, kSphere), DefectKind::not_delaunay,
            std::min(mesh.triangle(3).neighbour[1], Index{3})));
  topology.max_defects = 1;
  mesh.vertices.clear();
  CHECK(validate(mesh, kSphere, topology).size() == 1);
}

TEST_CASE("validate sees two bodies and a pinched vertex") {
  const Mesh one = icosahedron();
  Mesh two = one;
  const Index n_triangles = one.n_triangles();
  const Index n_vertices = one.n_vertices();
  two.vertices.insert(two.vertices.end(), one.vertices.begin(), one.vertices.end());
  for (Triangle t : one.triangles) {
    for (Index& v : t.vertex) v += n_vertices;
    for (Index& n : t.neighbour) n += n_triangles;
    two.triangles.push_back(t);
  }
  CHECK(has(validate(two, kSphere), DefectKind::disconnected, n_triangles));
  for (Triangle& t : two.triangles) {  // both bodies hang on vertex 0
    for (Index& v : t.vertex) v = v == n_vertices ? 0 : v;
  }
  CHECK(has(validate(two, kSphere), DefectKind::pinched, 0));
}

TEST_CASE("a vertex inserted twice is refused and one of a tetrahedron can't be removed") {
  Mesh mesh = icosahedron();
  CHECK_THROWS_AS(insert_vertex(mesh, kSphere, mesh.vertices[3], 0), Error);
  CHECK(mesh.n_vertices() == 12);
  parallel::Executor exec(1);
  const double s = std::sqrt(1.0 / 3);
  Mesh tetrahedron =
      delaunay(exec, std::vector<Vec3>{{s, s, s}, {s, -s, -s}, {-s, s, -s}, {-s, -s, s}});
  CHECK_FALSE(remove_vertex(tetrahedron, kSphere, 1, 0));
  CHECK(validate(tetrahedron, kSphere).empty());
}

TEST_CASE("a vertex that keeps the centre inside the hull is not removed") {
  parallel::Executor exec(1);
  Mesh octahedron = delaunay(
      exec, std::vector<Vec3>{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}});
  CHECK_FALSE(remove_vertex(octahedron, kSphere, 4, 0));
  CHECK(summary(validate(octahedron, kSphere)) == "");
  // With a second vertex on that side it can go.
  insert_vertex(octahedron, kSphere, {0.6, 0, 0.8, 0}, 0);
  CHECK(remove_vertex(octahedron, kSphere, 4, 0));
  CHECK(octahedron.n_vertices() == 6);
  CHECK(summary(validate(octahedron, kSphere)) == "");
}

TEST_CASE("the last vertex takes the id of a removed one") {
  Mesh mesh = icosahedron();
  const Vec3 last = mesh.position(11);
  CHECK(remove_vertex(mesh, kSphere, 4, 0));
  CHECK(mesh.n_vertices() == 11);
  CHECK(mesh.n_triangles() == 18);
  CHECK(mesh.position(4) == last);
  CHECK(summary(validate(mesh, kSphere)) == "");
}

TEST_CASE("locate ends at once in the triangle that holds the point") {
  const Mesh mesh = icosahedron();
  for (Index tri = 0; tri < mesh.n_triangles(); ++tri) {
    const auto& v = mesh.triangle(tri).vertex;
    const Vec3 centre = mesh.position(v[0]) + mesh.position(v[1]) + mesh.position(v[2]);
    for (Index start = 0; start < mesh.n_triangles(); ++start) {
      CHECK(locate(mesh, centre, start) == tri);
    }
  }
}
