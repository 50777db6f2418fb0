// SPDX-License-Identifier: BSD-3-Clause
#include "core/hash.hpp"
#include "dual/rules.hpp"

namespace delos::dual {
namespace {

// The energy-conserving antisymmetry of the weights is exact but for rounding.
constexpr double kAntisymmetry = 1e-12;
// A coarser tolerance than this means a grid of someone else, weights rounded likewise.
constexpr double kOwnTolerance = 1e-8;

double weight_of(const Grid& g, Index edge, Index other) {
  const auto row = g.edges_on_edge.row(edge);
  const auto weights = g.weights_on_edge.row(edge);
  double sum = 0.0;  // two edges of a triangle-shaped cell pair can meet twice
  for (std::size_t j = 0; j < row.size(); ++j) sum += row[j] == other ? weights[j] : 0.0;
  return sum;
}

double antisymmetry_error(const Grid& g, std::int64_t i) {
  const auto edge = static_cast<Index>(i);
  double error = 0.0;
  for (const Index other : g.edges_on_edge.row(i)) {
    const double there =
        weight_of(g, edge, other) * g.cell_distance_m[at(edge)] / g.vertex_distance_m[at(other)];
    const double back =
        weight_of(g, other, edge) * g.cell_distance_m[at(other)] / g.vertex_distance_m[at(edge)];
    error = worse(error, std::abs(there + back));
  }
  return error;
}

// A random flow, its tangential flux along every dual edge and its divergence on every cell.
struct Flow {
  std::vector<double> normal, tangential, outflow_m;  // outflow: sum of u dv over the cell's edges
};

Flow random_flow(Context& context, const Grid& g) {
  Flow flow;
  flow.normal.resize(at(g.n_edges()));
  flow.tangential.resize(at(g.n_edges()));
  flow.outflow_m.resize(at(g.n_cells()));
  parallel::for_index(context.exec, g.n_edges(), Rules::kGrain, [&](std::int64_t i) {
    flow.normal[at(i)] = 2.0 * uniform01(0, static_cast<std::uint64_t>(i)) - 1.0;
  });
  parallel::for_index(context.exec, g.n_edges(), Rules::kGrain, [&](std::int64_t i) {
    const auto row = g.edges_on_edge.row(i);
    const auto weights = g.weights_on_edge.row(i);
    double sum = 0.0;
    for (std::size_t j = 0; j < row.size(); ++j) sum += weights[j] * flow.normal[at(row[j])];
    flow.tangential[at(i)] = sum;
  });
  parallel::for_index(context.exec, g.n_cells(), Rules::kGrain, [&](std::int64_t i) {
    double sum = 0.0;
    for (const Index edge : g.edges_on_cell.row(i)) {
      const double sign = g.cells_on_edge[at(edge)][0] == i ? 1.0 : -1.0;
      sum += sign * flow.normal[at(edge)] * g.vertex_distance_m[at(edge)];
    }
    flow.outflow_m[at(i)] = sum;
  });
  return flow;
}

// div_dual(W u) - kite mean of div(u) on a vertex, both times the triangle's area, against the
// largest outflow of its cells (Thuburn et al. 2009: geostrophic modes stay where they are).
double divergence_error(const Grid& g, const Flow& flow, std::int64_t i) {
  if (!is_complete(g.cells_on_vertex[at(i)])) return 0.0;
  double dual = 0.0, primal = 0.0, size = 0.0;
  for (std::size_t j = 0; j < 3; ++j) {
    const Index edge = g.edges_on_vertex[at(i)][j];
    const double out = g.vertices_on_edge[at(edge)][0] == i ? 1.0 : -1.0;
    dual += out * flow.tangential[at(edge)] * g.cell_distance_m[at(edge)];
    size += g.cell_distance_m[at(edge)];
    const Index cell = g.cells_on_vertex[at(i)][j];
    primal += g.kite_area_m2[at(i)][j] / g.cell_area_m2[at(cell)] * flow.outflow_m[at(cell)];
  }
  return std::abs(dual - primal) / size;
}

}  // namespace

void check_weights(Context& context, const Grid& g, double tolerance, Rules& rules) {
  rules.check("weights are antisymmetric (the Coriolis force does no work)", g.n_edges(),
              tolerance > kOwnTolerance ? tolerance : kAntisymmetry,
              [&](std::int64_t i) { return antisymmetry_error(g, i); });
  const Flow flow = random_flow(context, g);
  rules.check("divergence on a vertex is the kite mean of that on its cells", g.n_vertices(),
              tolerance, [&](std::int64_t i) { return divergence_error(g, flow, i); });
}

}  // namespace delos::dual
