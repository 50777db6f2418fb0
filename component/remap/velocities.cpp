// SPDX-License-Identifier: BSD-3-Clause
#include "remap/velocities.hpp"

#include <algorithm>

#include "remap/stream.hpp"
#include "remap/vectors.hpp"

namespace delos::remap {
namespace {

constexpr std::int64_t kEdgeGrain = 4096;  // about 0.1 ms

// The source's edge that a target's edge is, and the sign of its value there; kNone where one of
// the cells has changed.
struct Twin {
  Index edge = kNone;
  double sign = 1.0;
};

Twin twin_of(const Overlaps& overlaps, const GridPair& grids, std::int64_t edge) {
  const auto [c, d] = grids.target.cells_on_edge[at(edge)];
  if (!overlaps.is_copy(c) || !overlaps.is_copy(d)) return {};
  const Index from = overlaps.source[at(overlaps.offsets[at(c)])];
  const Index to = overlaps.source[at(overlaps.offsets[at(d)])];
  const auto neighbours = grids.source.cells_on_cell.row(from);
  const auto found = std::find(neighbours.begin(), neighbours.end(), to);
  if (found == neighbours.end()) return {};
  const Index twin = grids.source.edges_on_cell.row(from)[at(found - neighbours.begin())];
  return {twin, grids.source.cells_on_edge[at(twin)][0] == from ? 1.0 : -1.0};
}

Array<Twin> twins_of(parallel::Executor& exec, const Overlaps& overlaps, const GridPair& grids) {
  Array<Twin> twins(at(grids.target.n_edges()));
  parallel::for_index(exec, grids.target.n_edges(), kEdgeGrain,
                      [&](std::int64_t edge) { twins[at(edge)] = twin_of(overlaps, grids, edge); });
  return twins;
}

Array<double> by_vectors(parallel::Executor& exec, const Transfer& transfer, const GridPair& grids,
                         std::span<const double> normal, const TransferOptions& options) {
  const Array<Vec3> vectors =
      transfer_vectors(exec, transfer, grids.target, cell_velocities(exec, grids.source, normal),
                       {options.order, options.limiter});
  return normal_velocities(exec, grids.target, vectors);
}

Array<double> by_stream_function(Context& context, const Transfer& transfer, const GridPair& grids,
                                 std::span<const double> normal, const TransferOptions& options) {
  parallel::Executor& exec = context.exec;
  const StreamFunction stream = stream_function(context, grids.source, normal);
  const Array<double> solenoidal = flow_of(exec, grids.source, stream.psi);
  Array<double> rest(normal.size());
  parallel::for_index(exec, grids.source.n_edges(), kEdgeGrain, [&](std::int64_t edge) {
    rest[at(edge)] = normal[at(edge)] - solenoidal[at(edge)];
  });
  Array<double> result = flow_of(
      exec, grids.target, transfer_stream_function(exec, grids.source, grids.target, stream.psi));
  const Array<double> more = by_vectors(exec, transfer, grids, rest, options);
  parallel::for_index(exec, grids.target.n_edges(), kEdgeGrain,
                      [&](std::int64_t edge) { result[at(edge)] += more[at(edge)]; });
  return result;
}

}  // namespace

Array<double> transfer_velocities(Context& context, const Transfer& transfer, const GridPair& grids,
                                  std::span<const double> normal, const VelocityOptions& options) {
  const std::int64_t n_levels = options.transfer.n_levels;
  const std::int64_t n_sources = grids.source.n_edges(), n_targets = grids.target.n_edges();
  DELOS_CHECK(n_levels >= 1, ErrorKind::input, "n_levels = ", n_levels,
              ": an edge has at least one value.");
  DELOS_CHECK(static_cast<std::int64_t>(normal.size()) == n_levels * n_sources, ErrorKind::input,
              "a transfer of velocities from ", n_sources, " edges of ", n_levels,
              " values was given ", normal.size(), " values: they belong to another grid.");
  const Array<Twin> twins = twins_of(context.exec, transfer.overlaps(), grids);
  Array<double> result(at(n_levels * n_targets)), level_values(at(n_sources));
  for (std::int64_t level = 0; level < n_levels; ++level) {
    parallel::for_index(context.exec, n_sources, kEdgeGrain, [&](std::int64_t edge) {
      level_values[at(edge)] = normal[at(edge * n_levels + level)];
    });
    const Array<double> moved =
        options.route == VelocityRoute::vectors
            ? by_vectors(context.exec, transfer, grids, level_values, options.transfer)
            : by_stream_function(context, transfer, grids, level_values, options.transfer);
    parallel::for_index(context.exec, n_targets, kEdgeGrain, [&](std::int64_t edge) {
      const Twin& twin = twins[at(edge)];
      result[at(edge * n_levels + level)] =
          twin.edge == kNone ? moved[at(edge)] : twin.sign * level_values[at(twin.edge)];
    });
  }
  return result;
}

}  // namespace delos::remap
