// SPDX-License-Identifier: BSD-3-Clause
#include "domain/stack.hpp"

#include <algorithm>
#include <limits>

#include "core/error.hpp"

namespace delos::domain {
namespace {

constexpr std::int64_t kStackGrain = 4096;

/// The bottom of a sea cell that should be at depth_m.
double bottom_m(const Levels& levels, double depth_m, const StackOptions& options) {
  const auto& z = levels.interface_m;
  const double least_m = z[at(options.min_levels)];
  if (depth_m <= least_m) return least_m;
  if (depth_m >= levels.depth_m()) return levels.depth_m();
  const auto k = std::upper_bound(z.begin(), z.end(), depth_m) - z.begin() - 1;
  const double top_m = levels.top_m(k), full_m = levels.thickness_m(k);
  const double part_m = depth_m - top_m;
  if (!options.has_partial_bottom) return part_m < 0.5 * full_m ? top_m : levels.bottom_m(k);
  const double thinnest_m = options.min_fraction * full_m;
  if (part_m >= thinnest_m) return depth_m;
  return part_m < 0.5 * thinnest_m ? top_m : top_m + thinnest_m;
}

/// Layers above a bottom: interfaces above it.
Index layers_above(const Levels& levels, double bottom_m) {
  const auto& z = levels.interface_m;
  return static_cast<Index>(std::lower_bound(z.begin(), z.end(), bottom_m) - z.begin());
}

}  // namespace

Stack build_stack(Context& context, const Levels& levels, std::span<const double> depth_m,
                  const StackOptions& options) {
  DELOS_CHECK(options.min_levels >= 1 && options.min_levels <= levels.n_levels(), ErrorKind::config,
              "minimum_levels = ", options.min_levels,
              ": there must be one at least, and no more than the ", levels.n_levels(), " levels.");
  Array<double> bottom_depth_m(depth_m.size());
  const auto n = static_cast<std::int64_t>(depth_m.size());
  parallel::for_index(context.exec, n, kStackGrain, [&](std::int64_t i) {
    bottom_depth_m[at(i)] = depth_m[at(i)] > 0.0 ? bottom_m(levels, depth_m[at(i)], options) : 0.0;
  });
  return stack_above(levels, std::move(bottom_depth_m));
}

Stack stack_above(const Levels& levels, Array<double> bottom_depth_m) {
  Stack out{levels, {}, std::move(bottom_depth_m)};
  out.n_layers.reserve(out.bottom_depth_m.size());
  for (const double depth_m : out.bottom_depth_m) {
    out.n_layers.push_back(layers_above(levels, depth_m));
  }
  return out;
}

StackReport measure_stack(Context& context, const Grid& grid, const Stack& stack) {
  StackReport out;
  double thinnest_m = std::numeric_limits<double>::infinity();
  for (std::int64_t i = 0; i < grid.n_cells(); ++i) {
    const std::int64_t n = stack.n_layers[at(i)];
    if (n == 0) continue;
    const double bottom_layer_m = stack.thickness_m(i, n - 1);
    ++out.n_wet;
    out.n_layers += n;
    out.n_full += stack.bottom_depth_m[at(i)] == stack.levels.bottom_m(n - 1) ? 1 : 0;
    thinnest_m = std::min(thinnest_m, bottom_layer_m);
  }
  if (out.n_wet > 0) out.min_bottom_layer_m = thinnest_m;
  out.volume_m3 = parallel::sum(context.exec, grid.n_cells(), kStackGrain, [&](std::int64_t i) {
    return grid.cell_area_m2[at(i)] * stack.bottom_depth_m[at(i)];
  });
  return out;
}

}  // namespace delos::domain
