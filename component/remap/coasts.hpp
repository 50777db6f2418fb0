// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The coasts of a grid with a border, as its stream functions see them.
#include <span>

#include "core/array.hpp"
#include "dual/grid.hpp"

namespace delos::remap {

/// A stream function's unknowns: each vertex away from the border, and each connected coast, since
/// nothing flows through it. A grid without a border has its vertices, in their order.
struct StreamNodes {
  Array<Index> of_vertex;       ///< [n_vertices]
  Array<std::int64_t> offsets;  ///< [size() + 1]
  Array<Index> vertices;        ///< of each node; those of a coast by distance from its lowest one
  std::int64_t n_single = 0;    ///< nodes from here on are coasts

  std::int64_t size() const { return static_cast<std::int64_t>(offsets.size()) - 1; }
  std::span<const Index> row(std::int64_t node) const {
    return {vertices.data() + offsets[at(node)], at(offsets[at(node) + 1] - offsets[at(node)])};
  }
  bool is_coast(std::int64_t node) const { return node >= n_single; }
};

StreamNodes stream_nodes(const Grid& grid);

}  // namespace delos::remap
