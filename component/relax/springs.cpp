// SPDX-License-Identifier: BSD-3-Clause
#include "relax/springs.hpp"

#include <algorithm>
#include <cmath>

namespace delos {
namespace {

constexpr double kTimeStep = 0.27;    // of Eq. 2 with beta = 1; springs of six neighbours are
                                      // stable below 1/3, the best of a scan
constexpr double kMomentum = 0.4;     // of the last move; 0 needs twice the rounds, 0.6 swings
constexpr double kNoLength = 1e-300;  // keeps the empty places of a row (length 0) finite

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

struct Springs {
  double momentum = kMomentum;

  Vec3 step(const Array<Vertex>& vertices, const NeighbourRows& rows, Index place) const {
    const Index vertex = rows.vertex_at(place);
    const auto& row = rows.row(place);
    Vec3 step = kTimeStep * row_force(vertices, vertices[static_cast<std::size_t>(vertex)], row);
    if (row[kWidth - 1] != vertex && !rows.overflow().empty()) {
      step += kTimeStep * overflow_force(vertices, vertex, rows);
    }
    return step;
  }
};

}  // namespace

void spring_round(parallel::Executor& exec, const Target& target, Moving& moving, Mesh& mesh) {
  move_round(exec, target, Springs{}, moving, mesh);
}

}  // namespace delos
