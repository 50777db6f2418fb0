// SPDX-License-Identifier: BSD-3-Clause
#include "refine/assemble.hpp"

#include <algorithm>

#include "refine/room.hpp"

namespace delos {
namespace {

constexpr std::int64_t kSideGrain = 4096;  // half-segments a task: about a quarter millisecond
constexpr double kRoom = 1.03;             // the count is within 3 % of the expected one

}  // namespace

Assembler::Assembler(parallel::Executor& exec, const Skeleton& skeleton, double expected_vertices)
    : exec_(exec), skeleton_(skeleton), at_half_(2 * skeleton.segments.size()) {
  const auto room = static_cast<std::size_t>(kRoom * expected_vertices);
  reserve_pages(out_.mesh.vertices, room);
  reserve_pages(out_.mesh.triangles, 2 * room);
  out_.mesh.vertices = skeleton.mesh.vertices;
}

// What lies across a side of the tile stays kNone until finish() knows the other tile.
void Assembler::append(const TileMesh& tile) {
  Mesh& mesh = out_.mesh;
  const std::vector<Index>& border = skeleton_.tile_half_segments[n_tiles_++];
  const auto n_shared = static_cast<Index>(tile.skeleton_vertices.size());
  const Index vertex_shift = mesh.n_vertices() - n_shared;
  const Index triangle_shift = mesh.n_triangles();
  mesh.vertices.insert(mesh.vertices.end(), tile.inserted.begin(), tile.inserted.end());
  for (Triangle tri : tile.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Index v = tri.vertex[k], n = tri.neighbour[k];
      tri.vertex[k] = v < n_shared ? tile.skeleton_vertices[at(v)] : v + vertex_shift;
      tri.neighbour[k] = n >= 0 ? n + triangle_shift : kNone;
    }
    mesh.triangles.push_back(tri);
  }
  for (const Index tri : tile.off_bounds) out_.off_bounds.push_back(triangle_shift + tri);
  for (std::size_t slot = 0; slot < border.size(); ++slot) {
    const TriangleSide& local = tile.border[slot];
    at_half_[at(border[slot])] = {triangle_shift + local.triangle, local.side};
  }
}

Assembly Assembler::finish() {
  out_.side_triangles.resize(at_half_.size());
  parallel::for_index(exec_, static_cast<std::int64_t>(at_half_.size()), kSideGrain,
                      [&](std::int64_t half) {
                        const TriangleSide& here = at_half_[at(half)];
                        out_.mesh.triangle(here.triangle).neighbour[at(here.side)] =
                            at_half_[at(half ^ 1)].triangle;
                        out_.side_triangles[at(half)] = here.triangle;
                      });
  return std::move(out_);
}

}  // namespace delos
