// SPDX-License-Identifier: BSD-3-Clause
#include "remap/laplace.hpp"

#include "remap/multigrid.hpp"

namespace delos::remap {
namespace {

constexpr std::int64_t kNodeGrain = 8192;        // 0.1 ms; part of the answer
constexpr std::int64_t kMostSolverRounds = 500;  // fifteen to forty are usual

}  // namespace

Array<double> inverse_diagonal(parallel::Executor& exec, const Network& network) {
  Array<double> result(at(network.size()));
  parallel::for_index(exec, network.size(), kNodeGrain, [&](std::int64_t i) {
    double total = 0.0;
    for (auto k = network.offsets[at(i)]; k < network.offsets[at(i) + 1]; ++k) {
      total += network.weight[at(k)];
    }
    result[at(i)] = total > 0.0 ? 1.0 / total : 0.0;
  });
  return result;
}

void apply_laplace(parallel::Executor& exec, const Network& network, std::span<const double> x,
                   std::span<double> image) {
  parallel::for_index(exec, network.size(), kNodeGrain, [&](std::int64_t i) {
    double total = 0.0;
    for (auto k = network.offsets[at(i)]; k < network.offsets[at(i) + 1]; ++k) {
      total += network.weight[at(k)] * (x[at(i)] - x[at(network.neighbour[at(k)])]);
    }
    image[at(i)] = total;
  });
}

Array<double> solve_laplace(Context& context, const Network& network, std::span<const double> right,
                            double arrived) {
  parallel::Executor& exec = context.exec;
  const auto sum = [&](auto&& term) {
    return parallel::sum(exec, network.size(), kNodeGrain, term);
  };
  const auto each = [&](auto&& body) {
    parallel::for_index(exec, network.size(), kNodeGrain, body);
  };
  const std::size_t n = right.size();
  const Array<double> inverse = inverse_diagonal(exec, network);
  Array<double> x, residual(n), scaled(n), direction, image(n);
  x.assign(n, 0.0);
  direction.assign(n, 0.0);
  each([&](std::int64_t i) { residual[at(i)] = right[at(i)]; });
  const auto is_there = [&] {
    return sum([&](std::int64_t i) {
             return residual[at(i)] * residual[at(i)] * inverse[at(i)];
           }) <= arrived * arrived;
  };
  if (is_there()) return x;
  Multigrid multigrid(exec, network);
  double before = 0.0;
  for (std::int64_t round = 0; round < kMostSolverRounds && !is_there(); ++round) {
    context.monitor.check_cancelled();
    multigrid.apply(residual, scaled);
    const double now = sum([&](std::int64_t i) { return residual[at(i)] * scaled[at(i)]; });
    const double keep = round == 0 ? 0.0 : now / before;
    each([&](std::int64_t i) { direction[at(i)] = scaled[at(i)] + keep * direction[at(i)]; });
    apply_laplace(exec, network, direction, image);
    const double step = now / sum([&](std::int64_t i) { return direction[at(i)] * image[at(i)]; });
    each([&](std::int64_t i) {
      x[at(i)] += step * direction[at(i)];
      residual[at(i)] -= step * image[at(i)];
    });
    before = now;
  }
  return x;
}

}  // namespace delos::remap
