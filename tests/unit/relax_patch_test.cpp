// SPDX-License-Identifier: BSD-3-Clause
#include "relax/patch.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "refine/refine.hpp"
#include "relax/hill_climb.hpp"
#include "relax/repair.hpp"
#include "triangulation/validate.hpp"

using namespace delos;

namespace {

const Ellipsoid kSphere;

struct Sample {
  parallel::Executor exec{1};
  Monitor monitor;
  Context context{exec, monitor};
  SpacingField spacing = SpacingField::constant(kSphere, 0.1);
  Mesh mesh;
  Sample() {
    RefineReport report;
    mesh = refine(context, kSphere, spacing, {}, report);
  }
};

// The vertex and its neighbours, ascending.
std::vector<Index> ball(const Mesh& mesh, Index vertex) {
  std::vector<Index> out;
  for (const Triangle& t : mesh.triangles) {
    if (corner_at(t, vertex) >= 0) out.insert(out.end(), t.vertex.begin(), t.vertex.end());
  }
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

ExtractedPatch patch_at(const Mesh& mesh, Index vertex) {
  return extract_patch(mesh, triangle_at_vertex(mesh), ball(mesh, vertex));
}

std::string commit(const Sample& sample, const ExtractedPatch& edited) {
  Mesh mesh = sample.mesh;
  TriangleAtVertex at_vertex = triangle_at_vertex(mesh);
  MeshEdits edits;
  commit_patch(mesh, at_vertex, edited, edits);
  parallel::Executor exec(1);
  compact(exec, mesh, edits);
  return summary(validate(mesh, kSphere, {.delaunay = false}));
}

}  // namespace

TEST_CASE(
    "area_length is 1 for equilateral, 0.866 at the first right angle, negative when turned") {
  const Vec3 up(0, 0, 1);
  const Vec3 a = up, b = up + Vec3(1e-3, 0, 0), c = up + Vec3(0.5e-3, std::sqrt(0.75) * 1e-3, 0);
  CHECK(area_length(a, b, c) == doctest::Approx(1.0));
  CHECK(area_length(a, c, b) == doctest::Approx(-1.0));
  CHECK(area_length(a, b, up + Vec3(0, 1e-3, 0)) == doctest::Approx(std::sqrt(0.75)));
}

TEST_CASE("a patch that is committed unchanged leaves the mesh as it was") {
  const Sample sample;
  Mesh mesh = sample.mesh;
  TriangleAtVertex at_vertex = triangle_at_vertex(mesh);
  MeshEdits edits;
  commit_patch(mesh, at_vertex, patch_at(mesh, 100), edits);
  CHECK(digest(mesh) == digest(sample.mesh));
  CHECK(edits.dead_vertices.empty());
}

TEST_CASE("vertices can be taken out of a patch and put into it, one after the other") {
  const Sample sample;
  for (const Index vertex : {0, 11, 57, 300, 700}) {
    CAPTURE(vertex);
    ExtractedPatch edited = patch_at(sample.mesh, vertex);
    const auto n_triangles = edited.patch.n_triangles();
    REQUIRE(patch::remove_vertex(edited.patch, 0));
    CHECK(edited.patch.n_triangles() == n_triangles - 2);
    patch::restore_delaunay(edited.patch);
    CHECK(commit(sample, edited) == "");
    const Vec3 p =
        kSphere.project(edited.patch.vertex(edited.patch.triangle(0).vertex[0]).position() +
                        edited.patch.vertex(edited.patch.triangle(0).vertex[1]).position() +
                        edited.patch.vertex(edited.patch.triangle(0).vertex[2]).position());
    patch::insert_vertex(edited.patch, 0, {p.x(), p.y(), p.z(), 0.1});
    patch::insert_vertex(edited.patch, 1, {p.x(), p.y() + 1e-3, p.z(), 0.1});
    CHECK(edited.patch.n_triangles() == n_triangles + 2);
    CHECK(edited.patch.n_free == static_cast<Index>(ball(sample.mesh, vertex).size()) + 1);
  }
}

TEST_CASE("a vertex pushed aside is brought back by hill climbing") {
  const Sample sample;
  ExtractedPatch edited = patch_at(sample.mesh, 500);
  Patch& patch = edited.patch;
  const std::vector<Index> free_ids = ball(sample.mesh, 500);
  const auto centre = std::find(free_ids.begin(), free_ids.end(), 500) - free_ids.begin();
  Vertex& pushed = patch.vertices[static_cast<std::size_t>(centre)];
  const Vec3 q = kSphere.project(pushed.position() + Vec3(0.05, -0.05, 0.03));
  pushed = {q.x(), q.y(), q.z(), 0.1};
  const double before = patch.worst().first;
  hill_climb({kSphere, sample.spacing}, {}, patch);
  CHECK(before < 0.9);
  CHECK(patch.worst().first > 0.93);
}

TEST_CASE("repair never lowers the worst score and says when it gained nothing") {
  const Sample sample;
  for (Index vertex = 0; vertex < sample.mesh.n_vertices(); vertex += 37) {
    ExtractedPatch edited = patch_at(sample.mesh, vertex);
    const double before = edited.patch.worst().first;
    const Patch copy = edited.patch;
    const bool is_better = repair_patch({kSphere, sample.spacing}, {0.95, true}, edited.patch);
    const double after = edited.patch.worst().first;
    CHECK(after >= before);
    CHECK(is_better == (after > before));
    CHECK(commit(sample, edited) == "");
  }
}
