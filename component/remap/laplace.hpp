// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Potentials on a network: nodes that are joined by weighted edges.
#include <span>

#include "core/array.hpp"
#include "core/progress.hpp"

namespace delos::remap {

/// Row i: the nodes that i is joined to, and the weights of the joints, > 0 and the same from both
/// ends.
struct Network {
  Array<std::int64_t> offsets;  ///< [size() + 1]
  Array<Index> neighbour;
  Array<double> weight;

  std::int64_t size() const { return static_cast<std::int64_t>(offsets.size()) - 1; }
};

/// Network of the rows `add(i, put)` gives: put(neighbour, weight) for each joint of node i.
template <class Add>
Network make_network(parallel::Executor& exec, std::int64_t n, Add&& add) {
  constexpr std::int64_t kGrain = 4096;  // rows of some six joints, 0.1 ms
  Network result;
  result.offsets.resize(static_cast<std::size_t>(n) + 1);
  parallel::for_index(exec, n, kGrain, [&](std::int64_t i) {
    std::int64_t count = 0;
    add(i, [&](Index, double) { ++count; });
    result.offsets[at(i)] = count;
  });
  parallel::scan_counts(exec, kGrain, result.offsets);
  result.neighbour.resize(at(result.offsets.back()));
  result.weight.resize(at(result.offsets.back()));
  parallel::for_index(exec, n, kGrain, [&](std::int64_t i) {
    std::size_t k = at(result.offsets[at(i)]);
    add(i, [&](Index neighbour, double weight) {
      result.neighbour[k] = neighbour;
      result.weight[k++] = weight;
    });
  });
  return result;
}

/// 1 over the sum of each node's weights; 0 for a node without joints.
Array<double> inverse_diagonal(parallel::Executor& exec, const Network& network);

/// image[i] = sum over joints of weight (x[i] - x[j]).
void apply_laplace(parallel::Executor& exec, const Network& network, std::span<const double> x,
                   std::span<double> image);

/// x with sum over joints of weight (x[i] - x[j]) = right[i], by conjugate gradients with a
/// multigrid cycle as preconditioner: linear in the number of joints. In each connected part the
/// sum of `right` has to be rounding, and x is known but for a constant. Ends when sum r^2 /
/// diagonal is at most `arrived`^2, after 500 rounds at the latest. The same bits for any number
/// of threads. Error(cancelled).
Array<double> solve_laplace(Context& context, const Network& network, std::span<const double> right,
                            double arrived);

}  // namespace delos::remap
