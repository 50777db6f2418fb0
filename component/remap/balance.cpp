// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "geometry/expansion.hpp"
#include "remap/overlap.hpp"

namespace delos::remap {
namespace {

constexpr std::int64_t kSumGrain = 4096;  // rows or columns of a few overlaps each, 0.1 ms

// Rounds of columns and rows: rounding needs about three, a fold in a grid all of them.
constexpr int kMostRounds = 60;
// Misfit of a column at which to stop: sums of a few terms are hardly better, so that to halve it
// takes as many rounds again.
constexpr double kBalanced = 4e-15;
// Corrections are stretched (successive over-relaxation): misfits of opposite sign in neighbours
// would level out slowly.
constexpr double kStretch = 1.5;

// A polygon that the other grid covers in part has what it has.
bool counts(const Overlaps& overlaps, double sum, double area) {
  return !overlaps.is_open || sum >= kWhole * area;
}

// Summed in two parts: a plain sum is not good to the last place.
double total(parallel::Executor& exec, const Array<double>& areas) {
  const auto part = [&](std::int64_t begin, std::int64_t end) {
    expansion::Two sum{0.0, 0.0};
    for (std::int64_t i = begin; i < end; ++i) sum = expansion::add(sum, {areas[at(i)], 0.0});
    return sum;
  };
  return parallel::reduce(exec, static_cast<std::int64_t>(areas.size()), kSumGrain,
                          expansion::Two{0.0, 0.0}, part,
                          [](auto a, auto b) { return expansion::add(a, b); })
      .hi;
}

// Scales entries by the factors of their columns, then rows to their sums.
void scale_rows(parallel::Executor& exec, std::span<const double> factor, Overlaps& overlaps) {
  parallel::for_index(exec, overlaps.n_targets, kSumGrain, [&](std::int64_t i) {
    const auto begin = overlaps.offsets[at(i)], end = overlaps.offsets[at(i) + 1];
    double sum = 0.0;
    for (auto k = begin; k < end; ++k) {
      overlaps.area_m2[at(k)] *= factor[at(overlaps.source[at(k)])];
      sum += overlaps.area_m2[at(k)];
    }
    if (!counts(overlaps, sum, overlaps.target_area_m2[at(i)])) return;
    const double scale = overlaps.target_area_m2[at(i)] / sum;
    for (auto k = begin; k < end; ++k) overlaps.area_m2[at(k)] *= scale;
  });
}

// What columns are to be scaled by, stretched; the largest misfit before.
double find_factors(parallel::Executor& exec, const ByKey& by_source, const Overlaps& overlaps,
                    double ratio, std::span<double> factor) {
  const auto block = [&](std::int64_t begin, std::int64_t end) {
    double largest = 0.0;
    for (std::int64_t i = begin; i < end; ++i) {
      double sum = 0.0;
      for (auto k = by_source.offsets[at(i)]; k < by_source.offsets[at(i) + 1]; ++k) {
        sum += overlaps.area_m2[at(by_source.entry[at(k)])];
      }
      factor[at(i)] = 1.0;
      if (!counts(overlaps, sum, overlaps.source_area_m2[at(i)])) continue;
      const double misfit = ratio * overlaps.source_area_m2[at(i)] / sum - 1.0;
      largest = std::max(largest, std::abs(misfit));
      factor[at(i)] = 1.0 + kStretch * misfit;
    }
    return largest;
  };
  return parallel::reduce(exec, overlaps.n_sources, kSumGrain, 0.0, block,
                          [](double a, double b) { return std::max(a, b); });
}

}  // namespace

int balance(parallel::Executor& exec, const ByKey& by_source, Overlaps& overlaps) {
  // The grids' own areas of the surface differ by rounding; sums of rows and of columns can't.
  const double ratio = overlaps.is_open ? 1.0
                                        : total(exec, overlaps.target_area_m2) /
                                              total(exec, overlaps.source_area_m2);
  Array<double> factor(at(overlaps.n_sources), 1.0);
  for (int round = 0;; ++round) {
    scale_rows(exec, factor, overlaps);
    const double misfit = find_factors(exec, by_source, overlaps, ratio, factor);
    if (misfit <= kBalanced || round == kMostRounds) return round;
  }
}

}  // namespace delos::remap
