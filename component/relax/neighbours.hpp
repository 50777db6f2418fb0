// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The neighbours of every vertex in rows of eight, the form in which the spring pass reads them
// from one half cache line.
#include <vector>

#include "core/array.hpp"
#include "core/parallel.hpp"
#include "triangulation/mesh.hpp"

namespace delos {

class NeighbourRows {
 public:
  static constexpr std::size_t kWidth = 8;

  /// Neighbours of every vertex, counter-clockwise from the one that its lowest triangle names.
  NeighbourRows(parallel::Executor& exec, const Mesh& mesh);
  /// The same for some vertices, ascending ids; at_vertex: one triangle at each vertex of the mesh.
  NeighbourRows(parallel::Executor& exec, const Mesh& mesh, const std::vector<Index>& at_vertex,
                std::vector<Index> vertices);

  /// Renews the rows of the corners of these triangles, which flips have changed.
  void update(const Mesh& mesh, const std::vector<Index>& triangles);

  /// First eight neighbours of a vertex, by the place of its row; unused places of the row hold the
  /// vertex itself.
  const std::array<Index, kWidth>& row(Index place) const {
    return rows_[static_cast<std::size_t>(place)];
  }
  /// The vertex of a row, and the row of a vertex (kNone when it has none).
  Index vertex_at(Index place) const {
    return has_all_ ? place : vertices_[static_cast<std::size_t>(place)];
  }
  Index place_of(Index vertex) const;
  std::int64_t size() const { return static_cast<std::int64_t>(rows_.size()); }
  /// Vertices of more than eight neighbours, ascending, with those beyond the eighth.
  struct Overflow {
    Index vertex;
    std::vector<Index> neighbours;
  };
  const std::vector<Overflow>& overflow() const { return overflow_; }
  /// The overflow of a vertex, or null.
  const Overflow* overflow_of(Index vertex) const;

 private:
  void fill(parallel::Executor& exec, const Mesh& mesh, const std::vector<Index>& at_vertex);

  bool has_all_;                 ///< rows for all vertices, each at its id
  std::vector<Index> vertices_;  ///< else those that have rows
  Array<std::array<Index, kWidth>> rows_;
  std::vector<Overflow> overflow_;
};

}  // namespace delos
