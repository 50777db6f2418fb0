// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "geometry/expansion.hpp"
#include "remap/overlap.hpp"

namespace delos::remap {
namespace {

constexpr std::int64_t kSumGrain = 4096;  // rows or columns of a few overlaps each, 0.1 ms

// Rounds of columns and rows: rounding needs about five, a fold in a grid all of them.
constexpr int kMostRounds = 60;
// Misfit of a column at which to stop: sums of a few terms are no better.
constexpr double kBalanced = 2e-15;
// Corrections are stretched (successive over-relaxation): misfits of opposite sign in neighbours
// would level out slowly.
constexpr double kStretch = 1.5;

std::size_t at(std::int64_t i) { return static_cast<std::size_t>(i); }

double sum_of_column(const Transposed& by_source, const Overlaps& overlaps, std::int64_t source) {
  double sum = 0.0;
  for (auto k = by_source.offsets[at(source)]; k < by_source.offsets[at(source) + 1]; ++k) {
    sum += overlaps.area_m2[at(by_source.entry[at(k)])];
  }
  return sum;
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

double largest_misfit(parallel::Executor& exec, const Transposed& by_source,
                      const Overlaps& overlaps, double ratio) {
  const auto misfit = [&](std::int64_t begin, std::int64_t end) {
    double largest = 0.0;
    for (std::int64_t i = begin; i < end; ++i) {
      const double wanted = ratio * overlaps.source_area_m2[at(i)];
      largest = std::max(largest, std::abs(sum_of_column(by_source, overlaps, i) / wanted - 1.0));
    }
    return largest;
  };
  return parallel::reduce(exec, overlaps.n_sources, kSumGrain, 0.0, misfit,
                          [](double a, double b) { return std::max(a, b); });
}

void scale_rows(parallel::Executor& exec, double stretch, Overlaps& overlaps) {
  parallel::for_index(exec, overlaps.n_targets, kSumGrain, [&](std::int64_t i) {
    const auto begin = overlaps.offsets[at(i)], end = overlaps.offsets[at(i) + 1];
    double sum = 0.0;
    for (auto k = begin; k < end; ++k) sum += overlaps.area_m2[at(k)];
    const double factor = 1.0 + stretch * (overlaps.target_area_m2[at(i)] / sum - 1.0);
    for (auto k = begin; k < end; ++k) overlaps.area_m2[at(k)] *= factor;
  });
}

void scale_columns(parallel::Executor& exec, const Transposed& by_source, double ratio,
                   Overlaps& overlaps) {
  parallel::for_index(exec, overlaps.n_sources, kSumGrain, [&](std::int64_t i) {
    const double wanted = ratio * overlaps.source_area_m2[at(i)];
    const double sum = sum_of_column(by_source, overlaps, i);
    const double factor = 1.0 + kStretch * (wanted / sum - 1.0);
    for (auto k = by_source.offsets[at(i)]; k < by_source.offsets[at(i) + 1]; ++k) {
      overlaps.area_m2[at(by_source.entry[at(k)])] *= factor;
    }
  });
}

}  // namespace

Transposed transpose(const Overlaps& overlaps) {
  Transposed result;
  result.offsets.assign(at(overlaps.n_sources) + 1, 0);
  for (const Index source : overlaps.source) ++result.offsets[at(source) + 1];
  for (std::size_t i = 1; i < result.offsets.size(); ++i) {
    result.offsets[i] += result.offsets[i - 1];
  }
  Array<std::int64_t> next(result.offsets.begin(), result.offsets.end() - 1);
  result.entry.resize(overlaps.source.size());
  for (std::size_t entry = 0; entry < overlaps.source.size(); ++entry) {
    const auto place = next[at(overlaps.source[entry])]++;
    result.entry[at(place)] = static_cast<std::int64_t>(entry);
  }
  return result;
}

int balance(parallel::Executor& exec, const Transposed& by_source, Overlaps& overlaps) {
  // The grids' own areas of the surface differ by rounding; sums of rows and of columns can't.
  const double ratio = total(exec, overlaps.target_area_m2) / total(exec, overlaps.source_area_m2);
  int round = 0;
  for (; round < kMostRounds; ++round) {
    scale_rows(exec, 1.0, overlaps);
    if (largest_misfit(exec, by_source, overlaps, ratio) <= kBalanced) break;
    scale_columns(exec, by_source, ratio, overlaps);
    scale_rows(exec, kStretch, overlaps);
  }
  scale_rows(exec, 1.0, overlaps);
  return round;
}

}  // namespace delos::remap
