// SPDX-License-Identifier: BSD-3-Clause
#include "relax/neighbours.hpp"

#include <algorithm>
#include <utility>

namespace delos {
namespace {

constexpr std::int64_t kRowGrain = 8192;  // vertices a task: about half a millisecond

using Overflow = NeighbourRows::Overflow;

// Walks around the vertex; returns how many neighbours there are.
std::size_t fill_row(const Mesh& mesh, Index vertex, Index first,
                     std::array<Index, NeighbourRows::kWidth>& row, std::vector<Index>* beyond) {
  row.fill(vertex);
  std::size_t n = 0;
  for_each_neighbour(mesh, first, vertex, [&](Index neighbour) {
    if (n < NeighbourRows::kWidth) {
      row[n] = neighbour;
    } else if (beyond != nullptr) {
      beyond->push_back(neighbour);
    }
    ++n;
  });
  return n;
}

}  // namespace

NeighbourRows::NeighbourRows(parallel::Executor& exec, const Mesh& mesh)
    : has_all_(true), rows_(mesh.vertices.size()) {
  fill(exec, mesh, triangle_at_vertex(mesh));
}

NeighbourRows::NeighbourRows(parallel::Executor& exec, const Mesh& mesh,
                             const std::vector<Index>& at_vertex, std::vector<Index> vertices)
    : has_all_(false), vertices_(std::move(vertices)), rows_(vertices_.size()) {
  fill(exec, mesh, at_vertex);
}

void NeighbourRows::fill(parallel::Executor& exec, const Mesh& mesh,
                         const std::vector<Index>& at_vertex) {
  overflow_ = parallel::collect<Overflow>(
      exec, static_cast<std::int64_t>(rows_.size()), kRowGrain,
      [&](std::int64_t begin, std::int64_t end, std::vector<Overflow>& found) {
        for (std::int64_t i = begin; i < end; ++i) {
          const auto place = static_cast<std::size_t>(i);
          const auto vertex = vertex_at(static_cast<Index>(i));
          const Index first = at_vertex[static_cast<std::size_t>(vertex)];
          if (fill_row(mesh, vertex, first, rows_[place], nullptr) > kWidth) {
            found.push_back({vertex, {}});
            fill_row(mesh, vertex, first, rows_[place], &found.back().neighbours);
          }
        }
      });
}

Index NeighbourRows::place_of(Index vertex) const {
  if (has_all_) return vertex;
  const auto found = std::lower_bound(vertices_.begin(), vertices_.end(), vertex);
  return found != vertices_.end() && *found == vertex
             ? static_cast<Index>(found - vertices_.begin())
             : kNone;
}

void NeighbourRows::update(const Mesh& mesh, const std::vector<Index>& triangles) {
  // The lowest triangle of the list at each vertex, so that the row does not depend on the order.
  std::vector<std::pair<Index, Index>> corners;
  for (const Index tri : triangles) {
    for (const Index v : mesh.triangle(tri).vertex) corners.emplace_back(v, tri);
  }
  std::sort(corners.begin(), corners.end());
  const auto is_same_vertex = [](const auto& a, const auto& b) { return a.first == b.first; };
  corners.erase(std::unique(corners.begin(), corners.end(), is_same_vertex), corners.end());
  for (const auto& corner : corners) {
    const Index vertex = corner.first;
    const Index place = place_of(vertex);
    if (place == kNone) continue;
    std::erase_if(overflow_, [&](const Overflow& entry) { return entry.vertex == vertex; });
    Overflow beyond{vertex, {}};
    auto& row = rows_[static_cast<std::size_t>(place)];
    if (fill_row(mesh, vertex, corner.second, row, &beyond.neighbours) <= kWidth) continue;
    overflow_.insert(
        std::lower_bound(overflow_.begin(), overflow_.end(), vertex,
                         [](const Overflow& entry, Index id) { return entry.vertex < id; }),
        std::move(beyond));
  }
}

const Overflow* NeighbourRows::overflow_of(Index vertex) const {
  const auto found =
      std::lower_bound(overflow_.begin(), overflow_.end(), vertex,
                       [](const Overflow& entry, Index id) { return entry.vertex < id; });
  return found != overflow_.end() && found->vertex == vertex ? &*found : nullptr;
}

}  // namespace delos
