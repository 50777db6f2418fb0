// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A round in which all vertices move at once (Jacobi, so the order of evaluation can't matter):
// what springs and centroids share.
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "core/parallel.hpp"
#include "relax/neighbours.hpp"
#include "relax/target.hpp"
#include "triangulation/mesh.hpp"

namespace delos {

/// What may move: the vertices that have rows.
struct Moving {
  NeighbourRows rows;
  /// All triangles that have one of them as a corner; null: every triangle of the mesh.
  const std::vector<Index>* triangles = nullptr;
  /// Where each was before the last round, by place in the rows; empty before the first.
  Array<Vertex> before = {};
};

/// Puts vertices that have flattened a triangle or turned it over back to where they were before
/// the round, until every triangle is counter-clockwise as it was.
void take_back_spoilt(parallel::Executor& exec, const Moving& moving, Mesh& mesh);

/// The vertex after a step, which is limited to a fraction of h; its spacing stays.
inline Vertex moved(const Target& target, const Vertex& p, Vec3 step) {
  constexpr double kLongestStep = 0.2;  // of the spacing
  const double length = std::sqrt(step.squaredNorm());
  const double longest = kLongestStep * p.spacing;
  if (length > longest) step *= longest / length;
  const Vec3 q = target.surface.project(p.position() + step);
  return {q.x(), q.y(), q.z(), p.spacing};
}

/// One round: x <- project(x + rule.step + rule.momentum (x - x')), x' where the vertex was a round
/// ago (heavy ball: Polyak 1964, doi:10.1016/0041-5553(64)90137-5), in the first round without
/// momentum. Spacings are looked up anew, and take_back_spoilt has its say. Fixed vertices stay.
/// rule.step(vertices, rows, place): Vec3, of the vertex of that row.
template <class Rule>
void move_round(parallel::Executor& exec, const Target& target, const Rule& rule, Moving& moving,
                Mesh& mesh) {
  constexpr std::int64_t kMoveGrain = 4096;  // vertices a task: about 0.2 ms
  const std::int64_t n = moving.rows.size();
  const Index n_fixed = mesh.fixed.n_vertices();
  const bool has_past = !moving.before.empty();
  moving.before.resize(static_cast<std::size_t>(n));
  parallel::for_range(exec, n, kMoveGrain, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i < end; ++i) {
      const auto place = static_cast<Index>(i);
      const auto vertex = static_cast<std::size_t>(moving.rows.vertex_at(place));
      const Vertex& p = mesh.vertices[vertex];
      Vertex& v = moving.before[static_cast<std::size_t>(i)];
      Vec3 step = rule.step(mesh.vertices, moving.rows, place);
      if (has_past) step += rule.momentum * (p.position() - v.position());
      v = moving.rows.vertex_at(place) < n_fixed ? p : moved(target, p, step);
    }
    target.spacing.evaluate(
        std::span(moving.before)
            .subspan(static_cast<std::size_t>(begin), static_cast<std::size_t>(end - begin)));
  });
  if (moving.triangles == nullptr) {
    std::swap(mesh.vertices, moving.before);
  } else {
    parallel::for_index(exec, n, kMoveGrain, [&](std::int64_t i) {
      const auto vertex = static_cast<std::size_t>(moving.rows.vertex_at(static_cast<Index>(i)));
      std::swap(mesh.vertices[vertex], moving.before[static_cast<std::size_t>(i)]);
    });
  }
  take_back_spoilt(exec, moving, mesh);
}

}  // namespace delos
