// SPDX-License-Identifier: BSD-3-Clause
#include "remap/transfer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/prefetch.hpp"
#include "remap/first_seen.hpp"

namespace delos::remap {
namespace {

constexpr std::int64_t kOverlapGrain = 4096;  // sources or targets of a few overlaps each, 0.1 ms

struct Range {
  double low, high;
  void add(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
  void add(const Range& other) {
    low = std::min(low, other.low);
    high = std::max(high, other.high);
  }
};

struct Rows {
  const Overlaps& overlaps;
  std::int64_t begin(std::int64_t i) const { return overlaps.offsets[at(i)]; }
  std::int64_t end(std::int64_t i) const { return overlaps.offsets[at(i) + 1]; }
  bool is_copy(std::int64_t i) const { return overlaps.is_copy(i); }
  Index source(std::int64_t k) const { return overlaps.source[at(k)]; }
};

// Range of each source and its neighbours.
Array<Range> ranges(parallel::Executor& exec, const GradientStencils& stencils,
                    std::span<const double> field) {
  Array<Range> result(field.size());
  parallel::for_index(
      exec, static_cast<std::int64_t>(field.size()), kOverlapGrain, [&](std::int64_t j) {
        Range range{field[at(j)], field[at(j)]};
        for (auto k = stencils.offsets[at(j)]; k < stencils.offsets[at(j) + 1]; ++k) {
          range.add(field[at(stencils.neighbour[at(k)])]);
        }
        result[at(j)] = range;
      });
  return result;
}

// The largest part of the gradient that keeps a source's overlaps in its range.
double part_in_range(const Overlaps& overlaps, std::span<const std::int64_t> entries,
                     const Vec3& gradient, const Range& room) {
  double part = 1.0;
  for (const std::int64_t entry : entries) {
    const double rise = gradient.dot(overlaps.middle[at(entry)]);
    if (rise > room.high) part = std::min(part, room.high / rise);
    if (rise < room.low) part = std::min(part, room.low / rise);
  }
  return part;
}

// Mean of r + (source's value - r) + gradient . middle over a target, r a value of the row: what
// makes constants exact.
double row_value(const Rows& rows, std::int64_t i, std::span<const double> field,
                 std::span<const Vec3> gradients) {
  const Overlaps& overlaps = rows.overlaps;
  std::int64_t largest = rows.begin(i);
  double area = 0.0;
  for (std::int64_t k = rows.begin(i); k < rows.end(i); ++k) {
    if (overlaps.area_m2[at(k)] > overlaps.area_m2[at(largest)]) largest = k;
    area += overlaps.area_m2[at(k)];
  }
  const double reference = field[at(rows.source(largest))];
  double sum = 0.0;
  for (std::int64_t k = rows.begin(i); k < rows.end(i); ++k) {
    const std::size_t source = at(rows.source(k));
    double value = field[source] - reference;
    if (!gradients.empty()) value += gradients[source].dot(overlaps.middle[at(k)]);
    sum += overlaps.area_m2[at(k)] * value;
  }
  return reference + sum / area;
}

// The same over the sources that are not missing.
double valid_value(const Rows& rows, std::int64_t i, std::span<const double> field,
                   std::span<const Vec3> gradients, double least_valid) {
  const Overlaps& overlaps = rows.overlaps;
  double area = 0.0, valid = 0.0, sum = 0.0, reference = 0.0, largest = 0.0;
  for (std::int64_t k = rows.begin(i); k < rows.end(i); ++k) {
    area += overlaps.area_m2[at(k)];
    const double value = field[at(rows.source(k))];
    if (std::isnan(value)) continue;
    valid += overlaps.area_m2[at(k)];
    if (overlaps.area_m2[at(k)] <= largest) continue;
    largest = overlaps.area_m2[at(k)];
    reference = value;
  }
  if (valid == 0.0 || valid < least_valid * area) return std::numeric_limits<double>::quiet_NaN();
  for (std::int64_t k = rows.begin(i); k < rows.end(i); ++k) {
    const std::size_t source = at(rows.source(k));
    if (std::isnan(field[source])) continue;
    sum += overlaps.area_m2[at(k)] *
           (field[source] - reference + gradients[source].dot(overlaps.middle[at(k)]));
  }
  return reference + sum / valid;
}

// Range of the sources that a target covers; to second order with those of their neighbours.
template <class RangeOf>
Range row_range(const Rows& rows, std::int64_t i, RangeOf&& range_of) {
  Range range = range_of(rows.source(rows.begin(i)));
  for (std::int64_t k = rows.begin(i) + 1; k < rows.end(i); ++k) {
    range.add(range_of(rows.source(k)));
  }
  return range;
}

// Moves what clipping took from or gave to the targets into the room that others have.
void assure_sum(parallel::Executor& exec, const Overlaps& overlaps, std::span<const Range> bounds,
                std::span<double> target) {
  const auto area = [&](std::int64_t i) { return overlaps.target_area_m2[at(i)]; };
  const auto clipped = [&](std::int64_t i) {
    return std::clamp(target[at(i)], bounds[at(i)].low, bounds[at(i)].high);
  };
  const double missing =
      parallel::sum(exec, overlaps.n_targets, kOverlapGrain,
                    [&](std::int64_t i) { return area(i) * (target[at(i)] - clipped(i)); });
  const auto limit = [&](std::int64_t i) {
    return missing > 0.0 ? bounds[at(i)].high : bounds[at(i)].low;
  };
  const double room = parallel::sum(exec, overlaps.n_targets, kOverlapGrain, [&](std::int64_t i) {
    return area(i) * (limit(i) - clipped(i));
  });
  // The transfer of first order is in range with the same mass, so there is room for all of it.
  const double part = room == 0.0 ? 0.0 : std::min(1.0, missing / room);
  parallel::for_index(exec, overlaps.n_targets, kOverlapGrain, [&](std::int64_t i) {
    const double value = clipped(i);
    target[at(i)] =
        std::clamp(value + part * (limit(i) - value), bounds[at(i)].low, bounds[at(i)].high);
  });
}

// What the rows after this one will need, in two steps of which the later needs the first.
void prefetch_stencils(const Rows& rows, const GradientStencils& stencils, std::int64_t i) {
  constexpr std::int64_t kRowsAhead = 2, kOffsetsAhead = 4;
  if (i + kOffsetsAhead >= rows.overlaps.n_targets) return;
  for (auto k = rows.begin(i + kOffsetsAhead); k < rows.end(i + kOffsetsAhead); ++k) {
    prefetch(stencils.offsets[at(rows.source(k))]);
  }
  for (auto k = rows.begin(i + kRowsAhead); k < rows.end(i + kRowsAhead); ++k) {
    const std::size_t first = at(stencils.offsets[at(rows.source(k))]);
    prefetch(stencils.neighbour[first]);
    prefetch(stencils.coefficient[first]);
    prefetch(stencils.coefficient[first + 2].z());
  }
}

struct Weight {
  Index column;
  double value;
};

// Weights of one target to second order, columns ascending and each once.
class SecondOrderRow {
 public:
  const std::vector<Weight>& make(const Rows& rows, const GradientStencils& stencils,
                                  std::int64_t i) {
    row_.clear();
    columns_.clear();
    double area = 0.0;
    for (std::int64_t k = rows.begin(i); k < rows.end(i); ++k) area += rows.overlaps.area_m2[at(k)];
    for (std::int64_t k = rows.begin(i); k < rows.end(i); ++k) {
      const double weight = rows.overlaps.area_m2[at(k)] / area;
      double own = weight;
      if (!rows.is_copy(i)) {
        const Vec3& middle = rows.overlaps.middle[at(k)];
        const std::int64_t source = rows.source(k);
        for (auto l = stencils.offsets[at(source)]; l < stencils.offsets[at(source) + 1]; ++l) {
          const double part = weight * middle.dot(stencils.coefficient[at(l)]);
          own -= part;
          add(stencils.neighbour[at(l)], part);
        }
      }
      add(rows.source(k), own);
    }
    std::sort(row_.begin(), row_.end(),
              [](const Weight& a, const Weight& b) { return a.column < b.column; });
    return row_;
  }

 private:
  void add(Index column, double value) {
    const std::size_t place = columns_.place_of(column);
    if (place == row_.size()) {
      row_.push_back({column, value});
    } else {
      row_[place].value += value;
    }
  }
  std::vector<Weight> row_;
  FirstSeen columns_;
};

}  // namespace

Transfer::Transfer(Context& context, const Tiling& source, const Tiling& target, Order highest)
    : overlaps_(intersect(context, source, target)) {
  if (highest == Order::second) add_second_order(context.exec, source);
}

void Transfer::add_second_order(parallel::Executor& exec, const Tiling& source) {
  if (!stencils_.offsets.empty()) return;
  by_source_ = by_source(exec, overlaps_);
  stencils_ = gradient_stencils(exec, source, overlaps_);
}

void Transfer::require(Order order) const {
  DELOS_CHECK(order == Order::first || !stencils_.offsets.empty(), ErrorKind::state,
              "a transfer made for the first order was asked for the second: make it for the "
              "second order, or add_second_order() first.");
}

Weights Transfer::weights(parallel::Executor& exec, Order order,
                          Normalization normalization) const {
  require(order);
  Weights weights =
      order == Order::first ? first_order_weights(exec, overlaps_) : second_order_weights(exec);
  if (normalization == Normalization::covered || !overlaps_.is_open) return weights;
  weights.adds_to_one = false;
  parallel::for_index(exec, overlaps_.n_targets, kOverlapGrain, [&](std::int64_t i) {
    const double fraction = overlaps_.covered_fraction(i);
    for (auto k = weights.offsets[at(i)]; k < weights.offsets[at(i) + 1]; ++k) {
      weights.value[at(k)] *= fraction;
    }
  });
  return weights;
}

Weights Transfer::second_order_weights(parallel::Executor& exec) const {
  const Rows rows{overlaps_};
  const std::int64_t n = overlaps_.n_targets;
  std::vector<std::vector<Weight>> blocks(at((n + kOverlapGrain - 1) / kOverlapGrain));
  Weights weights;
  weights.n_columns = overlaps_.n_sources;
  weights.offsets.resize(at(n) + 1);
  weights.offsets[0] = 0;
  parallel::for_range(exec, n, kOverlapGrain, [&](std::int64_t begin, std::int64_t end) {
    SecondOrderRow maker;
    auto& block = blocks[at(begin / kOverlapGrain)];
    for (std::int64_t i = begin; i < end; ++i) {
      prefetch_stencils(rows, stencils_, i);
      const std::vector<Weight>& row = maker.make(rows, stencils_, i);
      weights.offsets[at(i) + 1] = static_cast<std::int64_t>(row.size());
      block.insert(block.end(), row.begin(), row.end());
    }
  });
  for (std::int64_t i = 0; i < n; ++i) weights.offsets[at(i) + 1] += weights.offsets[at(i)];
  weights.column.resize(at(weights.offsets.back()));
  weights.value.resize(at(weights.offsets.back()));
  parallel::for_range(exec, n, kOverlapGrain, [&](std::int64_t begin, std::int64_t) {
    std::size_t k = at(weights.offsets[at(begin)]);
    for (const Weight& weight : blocks[at(begin / kOverlapGrain)]) {
      weights.column[k] = weight.column;
      weights.value[k++] = weight.value;
    }
  });
  return weights;
}

void Transfer::check_sizes(std::size_t n_source, std::size_t n_target,
                           std::int64_t n_levels) const {
  DELOS_CHECK(n_levels >= 1, ErrorKind::input, "n_levels = ", n_levels,
              ": a polygon has at least one value.");
  DELOS_CHECK(static_cast<std::int64_t>(n_source) == n_levels * overlaps_.n_sources &&
                  static_cast<std::int64_t>(n_target) == n_levels * overlaps_.n_targets,
              ErrorKind::input, "a transfer from ", overlaps_.n_sources, " to ",
              overlaps_.n_targets, " polygons of ", n_levels, " values was given fields of ",
              n_source, " and ", n_target, " values: the fields belong to other grids.");
}

void Transfer::apply(parallel::Executor& exec, std::span<const double> source,
                     std::span<double> target, const TransferOptions& options) const {
  const std::int64_t n_levels = options.n_levels;
  check_sizes(source.size(), target.size(), n_levels);
  require(options.order);
  if (n_levels == 1) return apply_level(exec, source, target, options);
  Array<double> from(at(overlaps_.n_sources)), to(at(overlaps_.n_targets));
  for (std::int64_t level = 0; level < n_levels; ++level) {
    parallel::for_index(exec, overlaps_.n_sources, kOverlapGrain,
                        [&](std::int64_t j) { from[at(j)] = source[at(j * n_levels + level)]; });
    apply_level(exec, from, to, options);
    parallel::for_index(exec, overlaps_.n_targets, kOverlapGrain,
                        [&](std::int64_t i) { target[at(i * n_levels + level)] = to[at(i)]; });
  }
}

void Transfer::apply_level(parallel::Executor& exec, std::span<const double> source,
                           std::span<double> target, const TransferOptions& options) const {
  const Rows rows{overlaps_};
  const bool is_first = options.order == Order::first;
  DELOS_CHECK(!overlaps_.is_open || options.limiter != Limiter::assured_sum, ErrorKind::input,
              "between grids of which one has a border a sum can't be assured: take the limiter of "
              "gradients.");
  const bool is_limited = options.limiter != Limiter::none && !is_first;
  const Array<Vec3> slopes = is_first ? Array<Vec3>{} : limited_gradients(exec, source, options);
  const Array<Range> near = is_limited ? ranges(exec, stencils_, source) : Array<Range>{};
  const auto range_of = [&](Index j) {
    return is_first ? Range{source[at(j)], source[at(j)]} : near[at(j)];
  };
  const bool is_assured = is_limited && options.limiter == Limiter::assured_sum;
  Array<Range> bounds(is_assured ? target.size() : 0);
  parallel::for_index(exec, overlaps_.n_targets, kOverlapGrain, [&](std::int64_t i) {
    if (rows.begin(i) == rows.end(i)) {
      target[at(i)] = std::numeric_limits<double>::quiet_NaN();
      return;
    }
    const double value = row_value(rows, i, source, slopes);
    target[at(i)] = value;
    if (!is_first && !is_limited) return;
    const Range range = rows.is_copy(i) ? Range{value, value} : row_range(rows, i, range_of);
    if (is_assured) {
      bounds[at(i)] = range;
    } else {
      target[at(i)] = std::clamp(value, range.low, range.high);  // of rounding
    }
  });
  if (is_assured) assure_sum(exec, overlaps_, bounds, target);
  if (options.normalization == Normalization::whole) scale_to_whole(exec, target);
}

void Transfer::scale_to_whole(parallel::Executor& exec, std::span<double> target) const {
  if (!overlaps_.is_open) return;
  parallel::for_index(exec, overlaps_.n_targets, kOverlapGrain,
                      [&](std::int64_t i) { target[at(i)] *= overlaps_.covered_fraction(i); });
}

// NOLINTNEXTLINE(readability-function-size): two fields, and what is done with what they lack
void Transfer::apply_valid(parallel::Executor& exec, std::span<const double> source,
                           std::span<double> target, const TransferOptions& options,
                           double least_valid) const {
  check_sizes(source.size(), target.size(), options.n_levels);
  require(options.order);
  DELOS_CHECK(options.n_levels == 1 && options.limiter != Limiter::assured_sum, ErrorKind::input,
              "a field with missing values can't be given an assured sum, nor be one of several "
              "levels: take the limiter of gradients, and each level by itself.");
  Array<Vec3> slopes(source.size(), Vec3(0, 0, 0));
  const bool is_second = options.order == Order::second;
  if (is_second) slopes = limited_gradients(exec, source, options);
  // A missing neighbour has made the gradient NaN.
  parallel::for_index(exec, overlaps_.n_sources, kOverlapGrain, [&](std::int64_t j) {
    if (!slopes[at(j)].allFinite()) slopes[at(j)] = Vec3::Zero();
  });
  const bool is_limited = is_second && options.limiter == Limiter::gradient;
  const Array<Range> near = is_limited ? ranges(exec, stencils_, source) : Array<Range>{};
  parallel::for_index(exec, overlaps_.n_targets, kOverlapGrain, [&](std::int64_t i) {
    target[at(i)] = valid_value({overlaps_}, i, source, slopes, least_valid);
    if (!is_limited || std::isnan(target[at(i)])) return;
    Range range{target[at(i)], target[at(i)]};
    bool has_any = false;
    for (auto k = overlaps_.offsets[at(i)]; k < overlaps_.offsets[at(i) + 1]; ++k) {
      const std::size_t j = at(overlaps_.source[at(k)]);
      if (std::isnan(source[j])) continue;
      if (!has_any) range = near[j];
      range.add(near[j]);
      has_any = true;
    }
    target[at(i)] = std::clamp(target[at(i)], range.low, range.high);  // of rounding
  });
  if (options.normalization == Normalization::whole) scale_to_whole(exec, target);
}

Array<Vec3> Transfer::limited_gradients(parallel::Executor& exec, std::span<const double> source,
                                        const TransferOptions& options) const {
  Array<Vec3> slopes = gradients(exec, stencils_, source);
  if (options.limiter != Limiter::gradient) return slopes;
  const Array<Range> near = ranges(exec, stencils_, source);
  parallel::for_index(exec, overlaps_.n_sources, kOverlapGrain, [&](std::int64_t j) {
    const auto begin = at(by_source_.offsets[at(j)]), end = at(by_source_.offsets[at(j) + 1]);
    const Range room{near[at(j)].low - source[at(j)], near[at(j)].high - source[at(j)]};
    slopes[at(j)] *= part_in_range(overlaps_, {by_source_.entry.data() + begin, end - begin},
                                   slopes[at(j)], room);
  });
  return slopes;
}

}  // namespace delos::remap
