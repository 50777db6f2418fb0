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

  /// Renews the rows of the corners of these triangles, which flips have changed.
  void update(const Mesh& mesh, const std::vector<Index>& triangles);

  /// First eight neighbours; unused places hold the vertex itself.
  const std::array<Index, kWidth>& row(Index vertex) const {
    return rows_[static_cast<std::size_t>(vertex)];
  }
  /// Vertices of more than eight neighbours, ascending, with those beyond the eighth.
  struct Overflow {
    Index vertex;
    std::vector<Index> neighbours;
  };
  const std::vector<Overflow>& overflow() const { return overflow_; }
  /// The overflow of a vertex, or null.
  const Overflow* overflow_of(Index vertex) const;

 private:
  Array<std::array<Index, kWidth>> rows_;
  std::vector<Overflow> overflow_;
};

}  // namespace delos
