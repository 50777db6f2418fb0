// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The common refinement of two grids of one surface: which cells overlap, how much, and where.
#include <span>

#include "core/array.hpp"
#include "core/progress.hpp"
#include "remap/by_key.hpp"
#include "remap/tiling.hpp"

namespace delos::remap {

/// Overlaps, sorted by (target, source). An unchanged polygon (the same corners to 1e-15 of the
/// radius) overlaps its twin alone, with the twin's whole area.
struct Overlaps {
  std::int64_t n_sources = 0, n_targets = 0;
  Array<std::int64_t> offsets;  ///< [n_targets + 1] those of target i: offsets[i] .. offsets[i + 1]
  Array<Index> source;          ///< [size()]
  Array<double> area_m2;        ///< [size()] balanced, see balance()
  Array<Vec3> middle;           ///< [size()] scaled: its middle, relative to its source's
  Array<Vec3> source_middle;    ///< [n_sources] scaled: area-weighted mean of its overlaps' middles
  Array<double> source_area_m2, target_area_m2;  ///< [n_sources], [n_targets] as in the grids
  std::int64_t n_unchanged = 0;
  bool is_open = false;         ///< one of the grids has a border: polygons may be covered in part
  std::int64_t n_unmapped = 0;  ///< targets that no source covers
  double largest_gap = 0.0;  ///< of a target, before balancing: |sum / area - 1|; open: excess only
  int n_balancing = 0;       ///< rounds that balancing took

  std::int64_t size() const { return static_cast<std::int64_t>(source.size()); }
  /// What sources cover of target i: 1 when all, but for rounding.
  double covered_fraction(std::int64_t i) const;
  /// Target i is one source and all of it, not a part of one.
  bool is_copy(std::int64_t i) const {
    const auto first = static_cast<std::size_t>(offsets[static_cast<std::size_t>(i)]);
    return offsets[static_cast<std::size_t>(i) + 1] == offsets[static_cast<std::size_t>(i)] + 1 &&
           middle[first] == Vec3(0, 0, 0);
  }
};

/// From this part on a polygon counts as covered by the other grid: what is missing is rounding.
inline constexpr double kWhole = 1.0 - 1e-11;

/// Intersects two tilings of the same surface. Sums over targets give each source's area, sums over
/// sources each target's, to 1e-14 of the area, where the other grid covers it. Middles of a source
/// that is covered in part are relative to the mean of its overlaps' all the same, but its
/// source_middle is its centre. The same bits for any number of threads.
/// O(n log n) for the order, the rest linear in the number of overlaps; advances the phase that the
/// caller has begun by one for each target. Error(input) when the surfaces differ or one of the
/// tilings has holes or folds wider than rounding.
Overlaps intersect(Context& context, const Tiling& source, const Tiling& target);

/// Overlaps seen from the sources: sorted by (source, target).
inline ByKey by_source(parallel::Executor& exec, const Overlaps& overlaps) {
  return sort_by_key(exec, overlaps.source, overlaps.n_sources);
}

/// Scales the areas by rows and columns (Sinkhorn 1964, doi:10.1214/aoms/1177703591) until both
/// sums are those of the grids: rounding alone is spread. Returns the number of rounds.
int balance(parallel::Executor& exec, const ByKey& by_source, Overlaps& overlaps);

}  // namespace delos::remap
