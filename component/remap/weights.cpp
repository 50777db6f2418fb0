// SPDX-License-Identifier: BSD-3-Clause
#include "remap/weights.hpp"

#include <cmath>
#include <utility>

#include "core/error.hpp"

namespace delos::remap {
namespace {

constexpr std::int64_t kRowGrain = 4096;  // rows of a few weights each, 0.1 ms

double row_value(const Weights& weights, std::int64_t row, std::span<const double> source) {
  const std::int64_t begin = weights.offsets[at(row)], end = weights.offsets[at(row) + 1];
  std::int64_t largest = begin;
  for (std::int64_t k = begin; k < end; ++k) {
    if (std::abs(weights.value[at(k)]) > std::abs(weights.value[at(largest)])) largest = k;
  }
  // Differences make constants exact, where weights add up to 1.
  const double reference = weights.adds_to_one ? source[at(weights.column[at(largest)])] : 0.0;
  double sum = 0.0;
  for (std::int64_t k = begin; k < end; ++k) {
    sum += weights.value[at(k)] * (source[at(weights.column[at(k)])] - reference);
  }
  return reference + sum;
}

}  // namespace

Weights first_order_weights(parallel::Executor& exec, const Overlaps& overlaps) {
  Weights weights;
  weights.n_columns = overlaps.n_sources;
  weights.offsets = overlaps.offsets;
  weights.column = overlaps.source;
  weights.value.resize(overlaps.source.size());
  parallel::for_index(exec, overlaps.n_targets, kRowGrain, [&](std::int64_t row) {
    const std::int64_t begin = overlaps.offsets[at(row)], end = overlaps.offsets[at(row) + 1];
    double sum = 0.0;
    for (std::int64_t k = begin; k < end; ++k) sum += overlaps.area_m2[at(k)];
    for (std::int64_t k = begin; k < end; ++k) weights.value[at(k)] = overlaps.area_m2[at(k)] / sum;
  });
  return weights;
}

void apply(parallel::Executor& exec, const Weights& weights, std::span<const double> source,
           std::span<double> target) {
  DELOS_CHECK(static_cast<std::int64_t>(source.size()) == weights.n_columns &&
                  static_cast<std::int64_t>(target.size()) == weights.n_rows(),
              ErrorKind::input, "weights from ", weights.n_columns, " to ", weights.n_rows(),
              " values were given fields of ", source.size(), " and ", target.size(),
              " values: the fields belong to other grids.");
  parallel::for_index(exec, weights.n_rows(), kRowGrain, [&](std::int64_t row) {
    target[at(row)] = weights.offsets[at(row)] == weights.offsets[at(row) + 1]
                          ? 0.0
                          : row_value(weights, row, source);
  });
}

Weights transpose(parallel::Executor& exec, const Weights& weights) {
  Array<Index> row_of(weights.column.size());
  parallel::for_index(exec, weights.n_rows(), kRowGrain, [&](std::int64_t row) {
    for (auto k = weights.offsets[at(row)]; k < weights.offsets[at(row) + 1]; ++k) {
      row_of[at(k)] = static_cast<Index>(row);
    }
  });
  ByKey by_column = sort_by_key(exec, weights.column, weights.n_columns);
  Weights result;
  result.n_columns = weights.n_rows();
  result.adds_to_one = false;
  result.offsets = std::move(by_column.offsets);
  result.column.resize(weights.column.size());
  result.value.resize(weights.value.size());
  parallel::for_index(exec, static_cast<std::int64_t>(row_of.size()), kRowGrain,
                      [&](std::int64_t k) {
                        const std::size_t entry = at(by_column.entry[at(k)]);
                        result.column[at(k)] = row_of[entry];
                        result.value[at(k)] = weights.value[entry];
                      });
  return result;
}

}  // namespace delos::remap
