// SPDX-License-Identifier: BSD-3-Clause
#include "remap/velocities.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "remap/potential.hpp"
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
  if (d == kNone) return {};
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

// The flow of one level on the source, and how it goes.
struct LevelFlow {
  std::span<const double> normal;
  VelocityRoute route;
  const TransferOptions& options;
};

// The part of a flow without divergence, on the target, and what it leaves, on the source; and the
// stream functions of both.
struct Parts {
  Array<double> solenoidal, rest;
  Array<double> psi, target_psi;
};

Parts parts_of(Context& context, const Overlaps& overlaps, const GridPair& grids,
               std::span<const double> normal) {
  parallel::Executor& exec = context.exec;
  StreamFunction stream = stream_function(context, grids.source, normal);
  Array<double> rest = flow_of(exec, grids.source, stream.psi);
  parallel::for_index(exec, grids.source.n_edges(), kEdgeGrain, [&](std::int64_t edge) {
    rest[at(edge)] = normal[at(edge)] - rest[at(edge)];
  });
  Array<double> psi =
      overlaps.is_open
          ? transfer_stream_function(exec, overlaps, grids.source, grids.target, stream.psi)
          : transfer_stream_function(exec, grids.source, grids.target, stream.psi);
  return {flow_of(exec, grids.target, psi), std::move(rest), std::move(stream.psi), std::move(psi)};
}

void add_flow(parallel::Executor& exec, std::span<const double> more, std::span<double> flow) {
  parallel::for_index(exec, static_cast<std::int64_t>(flow.size()), kEdgeGrain,
                      [&](std::int64_t edge) { flow[at(edge)] += more[at(edge)]; });
}

// Where a coast's psi has changed, the flow beside it has to.
void drop_changed(parallel::Executor& exec, const GridPair& grids, const Parts& parts,
                  std::span<Twin> twins) {
  parallel::for_index(exec, static_cast<std::int64_t>(twins.size()), kEdgeGrain,
                      [&](std::int64_t edge) {
                        Twin& twin = twins[at(edge)];
                        if (twin.edge == kNone) return;
                        const auto [v, w] = grids.target.vertices_on_edge[at(edge)];
                        auto [a, b] = grids.source.vertices_on_edge[at(twin.edge)];
                        if (twin.sign < 0.0) std::swap(a, b);
                        if (parts.target_psi[at(v)] != parts.psi[at(a)] ||
                            parts.target_psi[at(w)] != parts.psi[at(b)]) {
                          twin = {};
                        }
                      });
}

// `twins` lose what can't be kept.
Array<double> by_stream_function(Context& context, const Transfer& transfer, const GridPair& grids,
                                 const LevelFlow& flow, std::span<Twin> twins) {
  parallel::Executor& exec = context.exec;
  const Overlaps& overlaps = transfer.overlaps();
  Parts parts = parts_of(context, overlaps, grids, flow.normal);
  Array<double> rest = by_vectors(exec, transfer, grids, parts.rest, flow.options);
  if (overlaps.is_open) {
    drop_changed(exec, grids, parts, twins);
    for (double& value : rest) value = std::isnan(value) ? 0.0 : value;  // between bare cells
  }
  add_flow(exec, rest, parts.solenoidal);
  return std::move(parts.solenoidal);
}

// Good to second order, but for the divergence.
Array<double> by_potentials(Context& context, const Overlaps& overlaps, const GridPair& grids,
                            std::span<const double> normal) {
  parallel::Executor& exec = context.exec;
  Parts parts = parts_of(context, overlaps, grids, normal);
  const Array<double> chi = transfer_potential(exec, grids.source, grids.target,
                                               velocity_potential(grids.source, parts.rest));
  add_flow(exec, gradient_of(exec, grids.target, chi), parts.solenoidal);
  return std::move(parts.solenoidal);
}

// The source's divergence on the target's cells. A sum that is assured over the whole grid would
// leave parts between unchanged cells with another one than flows in.
Array<double> carried_divergence(parallel::Executor& exec, const Transfer& transfer,
                                 const GridPair& grids, std::span<const double> normal,
                                 const TransferOptions& options) {
  const bool is_limited = options.limiter != Limiter::none;
  Array<double> result(at(grids.target.n_cells()));
  transfer.apply(exec, divergence(exec, grids.source, normal), result,
                 {options.order, is_limited ? Limiter::gradient : Limiter::none});
  return result;
}

void copy_unchanged(parallel::Executor& exec, std::span<const Twin> twins,
                    std::span<const double> normal, std::span<double> moved) {
  parallel::for_index(exec, static_cast<std::int64_t>(moved.size()), kEdgeGrain,
                      [&](std::int64_t edge) {
                        const Twin& twin = twins[at(edge)];
                        if (twin.edge != kNone) moved[at(edge)] = twin.sign * normal[at(twin.edge)];
                      });
}

// On all edges of the target, as if none were the source's.
Array<double> by_route(Context& context, const Transfer& transfer, const GridPair& grids,
                       const LevelFlow& flow, std::span<Twin> twins) {
  switch (flow.route) {
    case VelocityRoute::stream_function:
      return by_stream_function(context, transfer, grids, flow, twins);
    case VelocityRoute::helmholtz:
      return by_potentials(context, transfer.overlaps(), grids, flow.normal);
    case VelocityRoute::vectors:
      break;
  }
  return by_vectors(context.exec, transfer, grids, flow.normal, flow.options);
}

}  // namespace

Array<double> transfer_velocities(Context& context, const Transfer& transfer, const GridPair& grids,
                                  std::span<const double> normal, const VelocityOptions& options) {
  const std::int64_t n_levels = options.transfer.n_levels;
  const std::int64_t n_sources = grids.source.n_edges(), n_targets = grids.target.n_edges();
  DELOS_CHECK(n_levels >= 1, ErrorKind::input, "n_levels = ", n_levels,
              ": an edge has at least one value.");
  DELOS_CHECK(!transfer.overlaps().is_open || options.route != VelocityRoute::helmholtz,
              ErrorKind::input,
              "one of the grids has a border, where no velocity potential is known: carry the flow "
              "by its stream function, or by vectors.");
  DELOS_CHECK(static_cast<std::int64_t>(normal.size()) == n_levels * n_sources, ErrorKind::input,
              "a transfer of velocities from ", n_sources, " edges of ", n_levels,
              " values was given ", normal.size(), " values: they belong to another grid.");
  parallel::Executor& exec = context.exec;
  const Array<Twin> twins = twins_of(exec, transfer.overlaps(), grids);
  Array<char> is_free(twins.size());
  parallel::for_index(exec, n_targets, kEdgeGrain, [&](std::int64_t edge) {
    is_free[at(edge)] = twins[at(edge)].edge == kNone ? 1 : 0;
  });
  Array<double> result(at(n_levels * n_targets)), from(at(n_sources));
  for (std::int64_t level = 0; level < n_levels; ++level) {
    parallel::for_index(exec, n_sources, kEdgeGrain, [&](std::int64_t edge) {
      from[at(edge)] = normal[at(edge * n_levels + level)];
    });
    Array<Twin> kept = twins;
    Array<double> moved =
        by_route(context, transfer, grids, {from, options.route, options.transfer}, kept);
    copy_unchanged(exec, kept, from, moved);
    if (options.route == VelocityRoute::helmholtz) {
      const auto wanted = carried_divergence(exec, transfer, grids, from, options.transfer);
      impose_divergence(context, grids.target, {wanted, is_free}, moved);
    }
    parallel::for_index(exec, n_targets, kEdgeGrain, [&](std::int64_t edge) {
      result[at(edge * n_levels + level)] = moved[at(edge)];
    });
  }
  return result;
}

}  // namespace delos::remap
