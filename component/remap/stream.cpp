// SPDX-License-Identifier: BSD-3-Clause
#include "remap/stream.hpp"

#include <algorithm>
#include <cmath>

#include "remap/laplace.hpp"
#include "remap/quadratic_fit.hpp"

namespace delos::remap {
namespace {

constexpr std::int64_t kStreamGrain = 8192;  // 0.1 ms; part of the answer

// A dual edge shorter than this part of its edge would make the projection's weights unbounded.
constexpr double kShortestEdge = 1e-6;
// Gradient of the projection against the flow at which it has arrived; 1e-10 is promised.
constexpr double kArrived = 1e-13;

// min over psi of sum (dc / dv) (flux + psi[v1] - psi[v0])^2.
struct Projection {
  parallel::Executor& exec;
  const Grid& grid;
  Array<double> flux;    // [n_edges] m2/s
  Array<double> weight;  // [n_edges] dc / dv

  double misfit(std::int64_t edge, std::span<const double> psi) const {
    const auto [v, w] = grid.vertices_on_edge[at(edge)];
    return flux[at(edge)] + (psi[at(w)] - psi[at(v)]);
  }
  // Of weight times the square of what `value` gives for each edge.
  template <class Value>
  double sum(Value&& value) const {
    return parallel::sum(exec, grid.n_edges(), kStreamGrain, [&](std::int64_t edge) {
      return weight[at(edge)] * value(edge) * value(edge);
    });
  }
};

Projection project(parallel::Executor& exec, const Grid& grid, std::span<const double> normal) {
  Projection result{exec, grid, {}, {}};
  result.flux.resize(at(grid.n_edges()));
  result.weight.resize(at(grid.n_edges()));
  parallel::for_index(exec, grid.n_edges(), kStreamGrain, [&](std::int64_t edge) {
    const double dv = grid.vertex_distance_m[at(edge)], dc = grid.cell_distance_m[at(edge)];
    result.flux[at(edge)] = normal[at(edge)] * dv;
    result.weight[at(edge)] = dc / std::max(dv, kShortestEdge * dc);
  });
  return result;
}

// Breadth first from vertex 0; short paths keep rounding small.
Array<double> sum_along_tree(const Grid& grid, std::span<const double> flux) {
  Array<double> psi(at(grid.n_vertices()));
  std::vector<char> is_known(at(grid.n_vertices()), 0);
  std::vector<Index> queue{0};
  queue.reserve(at(grid.n_vertices()));
  psi[0] = 0.0;
  is_known[0] = 1;
  for (std::size_t next = 0; next < queue.size(); ++next) {
    for (const Index edge : grid.edges_on_vertex[at(queue[next])]) {
      const auto [v, w] = grid.vertices_on_edge[at(edge)];
      const bool forward = v == queue[next];
      const Index other = forward ? w : v;
      if (is_known[at(other)]) continue;
      is_known[at(other)] = 1;
      psi[at(other)] = psi[at(queue[next])] + (forward ? -flux[at(edge)] : flux[at(edge)]);
      queue.push_back(other);
    }
  }
  return psi;
}

// out[v] = sum over its edges of +- weight times value(edge), + where v is the edge's second.
template <class Value>
void gather(const Projection& p, Value&& value, Array<double>& out) {
  parallel::for_index(p.exec, p.grid.n_vertices(), kStreamGrain, [&](std::int64_t v) {
    double sum = 0.0;
    for (const Index edge : p.grid.edges_on_vertex[at(v)]) {
      const double term = p.weight[at(edge)] * value(edge);
      sum += p.grid.vertices_on_edge[at(edge)][1] == v ? term : -term;
    }
    out[at(v)] = sum;
  });
}

// The sum along the tree plus what the projection's normal equations ask for beyond it.
void descend(Context& context, const Projection& p, Array<double>& psi) {
  const Network network =
      make_network(p.exec, p.grid.n_vertices(), [&](std::int64_t v, auto&& put) {
        for (const Index edge : p.grid.edges_on_vertex[at(v)]) {
          const auto [a, b] = p.grid.vertices_on_edge[at(edge)];
          put(a == v ? b : a, p.weight[at(edge)]);
        }
      });
  Array<double> residual(psi.size());
  gather(
      p, [&](Index edge) { return -p.misfit(edge, psi); }, residual);
  const double size = p.sum([&](std::int64_t edge) { return p.flux[at(edge)]; });
  DELOS_CHECK(std::isfinite(size), ErrorKind::input,
              "the flow holds normal velocities that are not finite, which have no potentials: "
              "give edges without a flow 0.");
  const Array<double> more = solve_laplace(context, network, residual, kArrived * std::sqrt(size));
  parallel::for_index(p.exec, p.grid.n_vertices(), kStreamGrain,
                      [&](std::int64_t v) { psi[at(v)] += more[at(v)]; });
}

double remainder(const Projection& p, std::span<const double> psi) {
  const double rest = p.sum([&](std::int64_t edge) { return p.misfit(edge, psi); });
  const double size = p.sum([&](std::int64_t edge) { return p.flux[at(edge)]; });
  return size > 0.0 ? std::sqrt(rest / size) : 0.0;
}

// The corners of a cell and of its neighbours, ascending.
void gather_corners(const Tiling& cells, Index cell, std::vector<Index>& ids) {
  ids.assign(cells.corners(cell).begin(), cells.corners(cell).end());
  for (const Index beside : cells.neighbours(cell)) {
    const auto more = cells.corners(beside);
    ids.insert(ids.end(), more.begin(), more.end());
  }
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
}

// psi at p, a point in a cell; `ids` is scratch.
double psi_at(const Tiling& cells, const Scattered& psi, Index cell, const Vec3& p,
              std::vector<Index>& ids) {
  const auto corners = cells.corners(cell);
  for (const Index id : corners) {
    if (is_same_point(psi.places[at(id)], p)) return psi.values[at(id)];
  }
  gather_corners(cells, cell, ids);
  return quadratic_fit(psi, ids, p, psi.values[at(corners[0])]);
}

}  // namespace

StreamFunction stream_function(Context& context, const Grid& grid, std::span<const double> normal) {
  DELOS_CHECK(static_cast<std::int64_t>(normal.size()) == grid.n_edges(), ErrorKind::input,
              "a flow of ", normal.size(), " normal velocities was given for ", grid.n_edges(),
              " edges: it belongs to another grid.");
  const Projection projection = project(context.exec, grid, normal);
  StreamFunction result;
  result.psi = sum_along_tree(grid, projection.flux);
  descend(context, projection, result.psi);
  const double first = result.psi[0];
  for (double& value : result.psi) value -= first;
  result.remainder = remainder(projection, result.psi);
  return result;
}

Array<double> flow_of(parallel::Executor& exec, const Grid& grid, std::span<const double> psi) {
  Array<double> normal(at(grid.n_edges()));
  parallel::for_index(exec, grid.n_edges(), kStreamGrain, [&](std::int64_t edge) {
    const auto [v, w] = grid.vertices_on_edge[at(edge)];
    const double dv = grid.vertex_distance_m[at(edge)];
    normal[at(edge)] = dv > 0.0 ? (psi[at(v)] - psi[at(w)]) / dv : 0.0;
  });
  return normal;
}

Array<double> transfer_stream_function(parallel::Executor& exec, const Grid& source,
                                       const Grid& target, std::span<const double> psi) {
  DELOS_CHECK(static_cast<std::int64_t>(psi.size()) == source.n_vertices(), ErrorKind::input,
              "a stream function of ", psi.size(), " values was given for ", source.n_vertices(),
              " vertices: it belongs to another grid.");
  const Tiling cells = Tiling::cells(exec, source);
  return fit_at_points(exec, cells, target.vertex_position,
                       [&](Index here, const Vec3& p, std::vector<Index>& ids) {
                         return psi_at(cells, {source.vertex_position, psi}, here, p, ids);
                       });
}

}  // namespace delos::remap
