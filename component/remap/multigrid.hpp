// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Ever smaller networks, whose potentials correct those of the larger ones.
#include <span>
#include <vector>

#include "remap/laplace.hpp"

namespace delos::remap {

/// A symmetric positive approximation of the inverse of a network's Laplacian: one W cycle over
/// networks whose nodes are groups of about four of the next finer one, the nodes joined most
/// strongly first (Notay 2010, section 3; corrections stretched as in Braess 1995,
/// doi:10.1007/BF02238488). Gauss-Seidel sweeps within fixed blocks of nodes, forward on the way
/// down, backward on the way up. The same bits for any number of threads.
class Multigrid {
 public:
  /// Keeps a reference to the network. Linear in its joints.
  Multigrid(parallel::Executor& exec, const Network& network);

  /// x for about L x = right, both [size()].
  void apply(std::span<const double> right, std::span<double> x);

 private:
  struct Level {
    Network own;            // of all levels but the finest
    Array<double> inverse;  // of the diagonal, 0 for a node that nothing is joined to
    Array<Index> group;     // of each node, a node of the next coarser level; empty: there is none
    Array<std::int64_t> begin;  // members of group g: member[begin[g]] .. member[begin[g + 1]]
    Array<Index> member;
    Array<double> right, x, old, residual;  // scratch; those of the finest level's ends are given
  };

  const Network& network_of(std::size_t depth) const {
    return depth == 0 ? finest_ : levels_[depth].own;
  }
  bool add_coarser();
  void cycle(std::size_t depth, std::span<const double> right, std::span<double> x);
  void add_correction(std::size_t depth, std::span<const double> right, std::span<double> x);

  parallel::Executor& exec_;
  const Network& finest_;
  std::vector<Level> levels_;
};

}  // namespace delos::remap
