// SPDX-License-Identifier: BSD-3-Clause
#include "relax/springs.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

namespace delos {
namespace {

constexpr double kTimeStep = 0.27;    // of Eq. 2 with beta = 1; springs of six neighbours are
                                      // stable below 1/3, the best of a scan
constexpr double kMomentum = 0.4;     // of the last move; 0 needs twice the rounds, 0.6 swings
constexpr double kLongestStep = 0.2;  // of the spacing
constexpr double kNoLength = 1e-300;  // keeps the empty places of a row (length 0) finite
constexpr std::int64_t kSpringGrain = 4096;  // vertices a task: about 0.2 ms

constexpr double kFlattest =
    0.1;  // twice the area over the mean squared side: an angle of 5 degrees
constexpr std::int64_t kTurnGrain = 16384;  // triangles a task: about 0.2 ms

constexpr std::size_t kWidth = NeighbourRows::kWidth;

// Sum over a row of (1 - h_ij / l_ij) (x_j - x_i); places that hold the vertex itself add 0.
Vec3 row_force(const Array<Vertex>& vertices, const Vertex& p,
               const std::array<Index, kWidth>& row) {
  alignas(64) double dx[kWidth], dy[kWidth], dz[kWidth], h[kWidth];
  for (std::size_t j = 0; j < kWidth; ++j) {
    const Vertex& q = vertices[static_cast<std::size_t>(row[j])];
    dx[j] = q.x - p.x;
    dy[j] = q.y - p.y;
    dz[j] = q.z - p.z;
    h[j] = 0.5 * (q.spacing + p.spacing);
  }
  for (std::size_t j = 0; j < kWidth; ++j) {
    const double square = dx[j] * dx[j] + dy[j] * dy[j] + dz[j] * dz[j];
    const double pull = 1.0 - h[j] / std::sqrt(square + kNoLength);
    dx[j] *= pull;
    dy[j] *= pull;
    dz[j] *= pull;
  }
  const auto total = [](const double* d) {
    return ((d[0] + d[1]) + (d[2] + d[3])) + ((d[4] + d[5]) + (d[6] + d[7]));
  };
  return {total(dx), total(dy), total(dz)};
}

Vec3 overflow_force(const Array<Vertex>& vertices, Index vertex, const NeighbourRows& neighbours) {
  Vec3 force(0, 0, 0);
  const NeighbourRows::Overflow* more = neighbours.overflow_of(vertex);
  if (more == nullptr) return force;
  for (std::size_t first = 0; first < more->neighbours.size(); first += kWidth) {
    std::array<Index, kWidth> row;
    row.fill(vertex);
    const std::size_t n = std::min(kWidth, more->neighbours.size() - first);
    std::copy_n(more->neighbours.begin() + static_cast<std::ptrdiff_t>(first), n, row.begin());
    force += row_force(vertices, vertices[static_cast<std::size_t>(vertex)], row);
  }
  return force;
}

// What all vertices of a round share.
struct Round {
  const Target& target;
  const NeighbourRows& rows;
  const Array<Vertex>& vertices;
  double momentum;
};

// `before` is where the vertex was a round ago; it is read only when there is momentum.
Vertex move(const Round& round, Index place, const Vertex& before) {
  const Index vertex = round.rows.vertex_at(place);
  const Vertex& p = round.vertices[static_cast<std::size_t>(vertex)];
  const auto& row = round.rows.row(place);
  Vec3 step = kTimeStep * row_force(round.vertices, p, row);
  if (row[kWidth - 1] != vertex && !round.rows.overflow().empty()) {
    step += kTimeStep * overflow_force(round.vertices, vertex, round.rows);
  }
  if (round.momentum > 0.0) step += round.momentum * (p.position() - before.position());
  const double length = std::sqrt(step.squaredNorm());
  const double longest = kLongestStep * p.spacing;
  if (length > longest) step *= longest / length;
  const Vec3 q = round.target.surface.project(p.position() + step);
  return {q.x(), q.y(), q.z(), p.spacing};
}

void move_all(parallel::Executor& exec, const Round& round, Array<Vertex>& other) {
  const auto n = static_cast<std::int64_t>(other.size());
  parallel::for_range(exec, n, kSpringGrain, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i < end; ++i) {
      Vertex& v = other[static_cast<std::size_t>(i)];
      const auto place = static_cast<Index>(i);
      v = move(round, place, v);
    }
    round.target.spacing.evaluate(std::span(other).subspan(static_cast<std::size_t>(begin),
                                                           static_cast<std::size_t>(end - begin)));
  });
}

bool is_same_place(const Vertex& a, const Vertex& b) {
  return a.x == b.x && a.y == b.y && a.z == b.z;
}

bool is_flat_or_turned(const Triangle& t, const Array<Vertex>& vertices) {
  const Vec3 a = vertices[static_cast<std::size_t>(t.vertex[0])].position();
  const Vec3 ab = vertices[static_cast<std::size_t>(t.vertex[1])].position() - a;
  const Vec3 ac = vertices[static_cast<std::size_t>(t.vertex[2])].position() - a;
  const double squares = ab.squaredNorm() + ac.squaredNorm() + (ac - ab).squaredNorm();
  // The normal of a sound triangle is nearly parallel to a; |a| <= 1, which spares most the root.
  const double height = ab.cross(ac).dot(a), least = kFlattest / 3.0 * squares;
  return !(height > least) && !(height > least * std::sqrt(a.squaredNorm()));
}

// Triangles that a move has spoilt, ascending.
std::vector<Index> find_spoilt(parallel::Executor& exec, const Mesh& mesh,
                               const Array<Vertex>& moved) {
  return parallel::collect<Index>(
      exec, mesh.n_triangles(), kTurnGrain,
      [&](std::int64_t begin, std::int64_t end, std::vector<Index>& found) {
        for (auto tri = static_cast<Index>(begin); tri < end; ++tri) {
          const Triangle& t = mesh.triangle(tri);
          if (!is_flat_or_turned(t, moved)) continue;
          const bool has_moved = std::any_of(t.vertex.begin(), t.vertex.end(), [&](Index v) {
            return !is_same_place(moved[static_cast<std::size_t>(v)],
                                  mesh.vertices[static_cast<std::size_t>(v)]);
          });
          if (has_moved) found.push_back(tri);
        }
      });
}

// The same for a part that has been moved in the mesh: places of the vertices that have to go back
// to `before`, with repetition.
std::vector<Index> find_spoilt(parallel::Executor& exec, const Mesh& mesh, const SpringPart& part,
                               const Array<Vertex>& before) {
  return parallel::collect<Index>(
      exec, static_cast<std::int64_t>(part.triangles.size()), kTurnGrain,
      [&](std::int64_t begin, std::int64_t end, std::vector<Index>& found) {
        for (std::int64_t i = begin; i < end; ++i) {
          const Triangle& t = mesh.triangle(part.triangles[static_cast<std::size_t>(i)]);
          if (!is_flat_or_turned(t, mesh.vertices)) continue;
          for (const Index v : t.vertex) {
            const Index place = part.rows.place_of(v);
            if (place != kNone && !is_same_place(mesh.vertices[static_cast<std::size_t>(v)],
                                                 before[static_cast<std::size_t>(place)])) {
              found.push_back(place);
            }
          }
        }
      });
}

}  // namespace

void spring_round(parallel::Executor& exec, const Target& target, const NeighbourRows& rows,
                  const Mesh& mesh, Array<Vertex>& other) {
  const bool has_past = other.size() == mesh.vertices.size();
  if (!has_past) other.resize(mesh.vertices.size());
  move_all(exec, {target, rows, mesh.vertices, has_past ? kMomentum : 0.0}, other);
  // Each pass puts at least one more vertex back, so this ends; one pass is the rule.
  for (std::vector<Index> spoilt = find_spoilt(exec, mesh, other); !spoilt.empty();
       spoilt = find_spoilt(exec, mesh, other)) {
    for (const Index tri : spoilt) {
      for (const Index v : mesh.triangle(tri).vertex) {
        other[static_cast<std::size_t>(v)] = mesh.vertices[static_cast<std::size_t>(v)];
      }
    }
  }
}

void spring_round(parallel::Executor& exec, const Target& target, const SpringPart& part,
                  Mesh& mesh, Array<Vertex>& other) {
  const auto n = static_cast<std::size_t>(part.rows.size());
  const bool has_past = other.size() == n;
  if (!has_past) other.resize(n);
  move_all(exec, {target, part.rows, mesh.vertices, has_past ? kMomentum : 0.0}, other);
  const auto vertex_at = [&](std::int64_t place) -> Vertex& {
    return mesh.vertices[static_cast<std::size_t>(part.rows.vertex_at(static_cast<Index>(place)))];
  };
  parallel::for_index(exec, part.rows.size(), kSpringGrain, [&](std::int64_t place) {
    std::swap(vertex_at(place), other[static_cast<std::size_t>(place)]);
  });
  // `other` now holds the places before the round. As above, one pass is the rule.
  for (std::vector<Index> spoilt = find_spoilt(exec, mesh, part, other); !spoilt.empty();
       spoilt = find_spoilt(exec, mesh, part, other)) {
    for (const Index place : spoilt) vertex_at(place) = other[static_cast<std::size_t>(place)];
  }
}

}  // namespace delos
