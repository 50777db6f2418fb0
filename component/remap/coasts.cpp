// SPDX-License-Identifier: BSD-3-Clause
#include "remap/coasts.hpp"

#include <algorithm>

namespace delos::remap {
namespace {

bool is_on_border(const Grid& grid, std::int64_t vertex) {
  const auto& cells = grid.cells_on_vertex[at(vertex)];
  return std::find(cells.begin(), cells.end(), kNone) != cells.end();
}

// Gives the coast of a vertex the node, over edges of the border.
void add_coast(const Grid& grid, Index first, StreamNodes& nodes) {
  const auto node = static_cast<Index>(nodes.size());
  std::size_t next = nodes.vertices.size();
  nodes.vertices.push_back(first);
  nodes.of_vertex[at(first)] = node;
  for (; next < nodes.vertices.size(); ++next) {
    const Index here = nodes.vertices[next];
    for (const Index edge : grid.edges_on_vertex[at(here)]) {
      if (edge == kNone || grid.cells_on_edge[at(edge)][1] != kNone) continue;
      const auto [v, w] = grid.vertices_on_edge[at(edge)];
      const Index other = v == here ? w : v;
      if (nodes.of_vertex[at(other)] != kNone) continue;
      nodes.of_vertex[at(other)] = node;
      nodes.vertices.push_back(other);
    }
  }
  nodes.offsets.push_back(static_cast<std::int64_t>(nodes.vertices.size()));
}

}  // namespace

StreamNodes stream_nodes(const Grid& grid) {
  StreamNodes nodes;
  nodes.of_vertex.assign(at(grid.n_vertices()), kNone);
  nodes.vertices.reserve(at(grid.n_vertices()));
  nodes.offsets.reserve(at(grid.n_vertices()) + 1);
  nodes.offsets.push_back(0);
  for (Index v = 0; v < grid.n_vertices(); ++v) {
    if (is_on_border(grid, v)) continue;
    nodes.of_vertex[at(v)] = static_cast<Index>(nodes.vertices.size());
    nodes.vertices.push_back(v);
    nodes.offsets.push_back(static_cast<std::int64_t>(nodes.vertices.size()));
  }
  nodes.n_single = nodes.size();
  for (Index v = 0; v < grid.n_vertices(); ++v) {
    if (nodes.of_vertex[at(v)] == kNone) add_coast(grid, v, nodes);
  }
  return nodes;
}

}  // namespace delos::remap
