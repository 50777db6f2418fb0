// SPDX-License-Identifier: BSD-3-Clause
#include "domain/bathymetry.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/error.hpp"

namespace delos::domain {
namespace {

constexpr std::int64_t kEdgeGrain = 4096;

double r_factor(double a, double b) { return std::abs(a - b) / (a + b); }

/// Edges between two wet cells.
std::vector<Index> wet_edges(const Grid& grid, std::span<const std::uint8_t> is_wet) {
  std::vector<Index> out;
  for (Index edge = 0; edge < grid.n_edges(); ++edge) {
    const auto [a, b] = grid.cells_on_edge[at(edge)];
    if (a != kNone && b != kNone && is_wet[at(a)] != 0 && is_wet[at(b)] != 0) out.push_back(edge);
  }
  return out;
}

double largest_r_factor(Context& context, const Grid& grid, const std::vector<Index>& edges,
                        const Array<double>& depth_m) {
  return parallel::reduce(
      context.exec, static_cast<std::int64_t>(edges.size()), kEdgeGrain, 0.0,
      [&](std::int64_t begin, std::int64_t end) {
        double most = 0.0;
        for (std::int64_t i = begin; i < end; ++i) {
          const auto [a, b] = grid.cells_on_edge[at(edges[at(i)])];
          most = std::max(most, r_factor(depth_m[at(a)], depth_m[at(b)]));
        }
        return most;
      },
      [](double total, double more) { return std::max(total, more); });
}

/// Brings a pair to the factor r and keeps its volume.
void level_out(double area_a, double area_b, double r, double& a, double& b) {
  const double volume = area_a * a + area_b * b;
  // The deeper is (1 + r) / (1 - r) times the shallower.
  const double ratio = (1.0 + r) / (1.0 - r);
  if (a > b) {
    b = volume / (area_a * ratio + area_b);
    a = ratio * b;
  } else {
    a = volume / (area_a + area_b * ratio);
    b = ratio * a;
  }
}

void smooth(Context& context, const Grid& grid, const BathymetryOptions& options,
            const std::vector<Index>& edges, ShapedDepth& out) {
  // A little below the bound, so that a chain of pairs ends in finite rounds.
  const double aim = 0.999 * options.max_r_factor;
  Array<double>& depth_m = out.depth_m;
  std::vector<std::uint8_t> is_changed(depth_m.size(), 0);
  bool goes_on = true;
  while (goes_on && out.report.rounds < options.max_rounds) {
    context.monitor.check_cancelled();
    goes_on = false;
    for (const Index edge : edges) {
      const auto [a, b] = grid.cells_on_edge[at(edge)];
      if (r_factor(depth_m[at(a)], depth_m[at(b)]) <= options.max_r_factor) continue;
      level_out(grid.cell_area_m2[at(a)], grid.cell_area_m2[at(b)], aim, depth_m[at(a)],
                depth_m[at(b)]);
      is_changed[at(a)] = is_changed[at(b)] = 1;
      goes_on = true;
    }
    if (goes_on) ++out.report.rounds;
  }
  out.report.n_smoothed = std::count(is_changed.begin(), is_changed.end(), 1);
}

}  // namespace

ShapedDepth shape_bathymetry(Context& context, const Grid& grid, const CellMeans& means,
                             std::span<const std::uint8_t> is_wet,
                             const BathymetryOptions& options) {
  const std::int64_t n_cells = grid.n_cells();
  DELOS_ASSERT(static_cast<std::int64_t>(is_wet.size()) == n_cells);
  ShapedDepth out;
  out.depth_m.assign(at(n_cells), 0.0);
  BathymetryReport& report = out.report;
  for (std::int64_t i = 0; i < n_cells; ++i) {
    if (is_wet[at(i)] == 0) continue;
    const double depth_m = means.wet_depth_m[at(i)];
    out.depth_m[at(i)] = std::clamp(depth_m, options.min_depth_m, options.max_depth_m);
    ++report.n_wet;
    report.n_deepened += depth_m < options.min_depth_m ? 1 : 0;
    report.n_cut += depth_m > options.max_depth_m ? 1 : 0;
  }
  const std::vector<Index> edges = wet_edges(grid, is_wet);
  report.r_factor_before = largest_r_factor(context, grid, edges, out.depth_m);
  if (options.max_r_factor > 0.0) smooth(context, grid, options, edges, out);
  report.r_factor = largest_r_factor(context, grid, edges, out.depth_m);
  report.wet_volume_m3 = parallel::sum(context.exec, n_cells, kEdgeGrain, [&](std::int64_t i) {
    return grid.cell_area_m2[at(i)] * means.wet_fraction[at(i)] * means.wet_depth_m[at(i)];
  });
  report.volume_m3 = parallel::sum(context.exec, n_cells, kEdgeGrain, [&](std::int64_t i) {
    return grid.cell_area_m2[at(i)] * out.depth_m[at(i)];
  });
  return out;
}

}  // namespace delos::domain
