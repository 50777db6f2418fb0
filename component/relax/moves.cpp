// SPDX-License-Identifier: BSD-3-Clause
#include "relax/moves.hpp"

namespace delos {
namespace {

constexpr double kFlattest =
    0.1;  // twice the area over the mean squared side: an angle of 5 degrees
constexpr std::int64_t kTurnGrain = 16384;  // triangles a task: about 0.2 ms

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

// Places of the vertices that have to go back, with repetition.
std::vector<Index> find_spoilt(parallel::Executor& exec, const Moving& moving, const Mesh& mesh) {
  const auto n = moving.triangles == nullptr ? std::int64_t{mesh.n_triangles()}
                                             : static_cast<std::int64_t>(moving.triangles->size());
  return parallel::collect<Index>(
      exec, n, kTurnGrain, [&](std::int64_t begin, std::int64_t end, std::vector<Index>& found) {
        for (std::int64_t i = begin; i < end; ++i) {
          const Triangle& t = mesh.triangle(moving.triangles == nullptr
                                                ? static_cast<Index>(i)
                                                : (*moving.triangles)[static_cast<std::size_t>(i)]);
          if (!is_flat_or_turned(t, mesh.vertices)) continue;
          for (const Index v : t.vertex) {
            const Index place = moving.rows.place_of(v);
            if (place != kNone && !is_same_place(mesh.vertices[static_cast<std::size_t>(v)],
                                                 moving.before[static_cast<std::size_t>(place)])) {
              found.push_back(place);
            }
          }
        }
      });
}

}  // namespace

void take_back_spoilt(parallel::Executor& exec, const Moving& moving, Mesh& mesh) {
  // Each pass puts at least one more vertex back, so this ends; one pass is the rule.
  for (std::vector<Index> spoilt = find_spoilt(exec, moving, mesh); !spoilt.empty();
       spoilt = find_spoilt(exec, moving, mesh)) {
    for (const Index place : spoilt) {
      mesh.vertices[static_cast<std::size_t>(moving.rows.vertex_at(place))] =
          moving.before[static_cast<std::size_t>(place)];
    }
  }
}

}  // namespace delos
