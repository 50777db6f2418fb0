// SPDX-License-Identifier: BSD-3-Clause
#include "remap/stream.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "remap/coasts.hpp"
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
    const bool is_border = grid.cells_on_edge[at(edge)][1] == kNone;
    result.flux[at(edge)] = is_border ? 0.0 : normal[at(edge)] * dv;
    result.weight[at(edge)] = dc / std::max(dv, kShortestEdge * dc);
  });
  return result;
}

// What holds together, and a sum along paths in it.
struct Tree {
  Array<double> psi;   // [n_vertices]
  Array<Index> body;   // [n_vertices]
  Array<Index> first;  // of each body, its lowest vertex
};

// Breadth first from the lowest vertex of each body; short paths keep rounding small.
Tree sum_along_tree(const Grid& grid, const StreamNodes& nodes, std::span<const double> flux) {
  Tree tree;
  tree.psi.resize(at(grid.n_vertices()));
  tree.body.assign(at(grid.n_vertices()), kNone);
  std::vector<Index> queue;
  queue.reserve(at(grid.n_vertices()));
  const auto reach = [&](Index vertex, double psi) {
    for (const Index v : nodes.row(nodes.of_vertex[at(vertex)])) {
      tree.psi[at(v)] = psi;
      tree.body[at(v)] = static_cast<Index>(tree.first.size()) - 1;
      queue.push_back(v);
    }
  };
  std::size_t next = 0;
  for (Index start = 0; start < grid.n_vertices(); ++start) {
    if (tree.body[at(start)] != kNone) continue;
    tree.first.push_back(start);
    reach(start, 0.0);
    for (; next < queue.size(); ++next) {
      for (const Index edge : grid.edges_on_vertex[at(queue[next])]) {
        if (edge == kNone) continue;
        const auto [v, w] = grid.vertices_on_edge[at(edge)];
        const bool forward = v == queue[next];
        const Index other = forward ? w : v;
        if (tree.body[at(other)] != kNone) continue;
        reach(other, tree.psi[at(queue[next])] + (forward ? -flux[at(edge)] : flux[at(edge)]));
      }
    }
  }
  return tree;
}

// visit(edge, sign, other node) for the edges from a node to others, + where it is their second.
template <class Visit>
void for_joints(const Grid& grid, const StreamNodes& nodes, std::int64_t node, Visit&& visit) {
  for (const Index vertex : nodes.row(node)) {
    for (const Index edge : grid.edges_on_vertex[at(vertex)]) {
      if (edge == kNone) continue;
      const auto [v, w] = grid.vertices_on_edge[at(edge)];
      const Index other = nodes.of_vertex[at(v == vertex ? w : v)];
      if (other != node) visit(edge, w == vertex ? 1.0 : -1.0, other);
    }
  }
}

// The sum along the tree plus what the projection's normal equations ask for beyond it.
void descend(Context& context, const Projection& p, const StreamNodes& nodes, Array<double>& psi) {
  const Network network = make_network(p.exec, nodes.size(), [&](std::int64_t node, auto&& put) {
    for_joints(p.grid, nodes, node,
               [&](Index edge, double, Index other) { put(other, p.weight[at(edge)]); });
  });
  Array<double> residual(at(nodes.size()));
  parallel::for_index(p.exec, nodes.size(), kStreamGrain, [&](std::int64_t node) {
    double sum = 0.0;
    for_joints(p.grid, nodes, node, [&](Index edge, double sign, Index) {
      sum -= sign * (p.weight[at(edge)] * p.misfit(edge, psi));
    });
    residual[at(node)] = sum;
  });
  const double size = p.sum([&](std::int64_t edge) { return p.flux[at(edge)]; });
  DELOS_CHECK(std::isfinite(size), ErrorKind::input,
              "the flow holds normal velocities that are not finite, which have no potentials: "
              "give edges without a flow 0.");
  const Array<double> more = solve_laplace(context, network, residual, kArrived * std::sqrt(size));
  parallel::for_index(p.exec, p.grid.n_vertices(), kStreamGrain,
                      [&](std::int64_t v) { psi[at(v)] += more[at(nodes.of_vertex[at(v)])]; });
}

// 0 on each body's longest coast, or at its lowest vertex where it has none.
void level_bodies(const StreamNodes& nodes, const Tree& tree, Array<double>& psi) {
  Array<Index> reference(tree.first);
  for (std::int64_t node = nodes.n_single; node < nodes.size(); ++node) {
    Index& best = reference[at(tree.body[at(nodes.row(node)[0])])];
    const Index there = nodes.of_vertex[at(best)];
    if (!nodes.is_coast(there) || nodes.row(there).size() < nodes.row(node).size()) {
      best = nodes.row(node)[0];
    }
  }
  Array<double> level(reference.size());
  for (std::size_t body = 0; body < level.size(); ++body) level[body] = psi[at(reference[body])];
  for (std::size_t v = 0; v < psi.size(); ++v) psi[v] -= level[at(tree.body[v])];
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
    if (beside == kNone) continue;
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

// A vertex of the target as the source sees it.
struct Seen {
  double psi = std::numeric_limits<double>::quiet_NaN();  // as on a bare cell
  Index coast = kNone;                                    // of the source, nearby
};

// How far p is outside of a cell, scaled; not above 0 inside.
double outside(const Tiling& cells, Index cell, const Vec3& p) {
  const auto corners = cells.corners(cell);
  double most = -1.0;
  Vec3 from = cells.corner(corners.back());
  for (const Index id : corners) {
    const Vec3& to = cells.corner(id);
    const Vec3 normal = from.cross(to - from);
    const double size = normal.norm();
    if (size > 0.0) most = std::max(most, -normal.dot(p - from) / size);
    from = to;
  }
  return most;
}

// What a border leaves of psi: on land it is the coast's.
struct Shore {
  const Tiling& cells;  // of the source
  const StreamNodes& nodes;
  const Scattered& psi;

  // `near`: source cells that may hold p, ascending; `ids` is scratch.
  Seen at_point(const Vec3& p, std::span<const Index> near, std::vector<Index>& ids) const {
    if (near.empty()) return {};
    constexpr double kInside = 1e-12;  // of the radius: rounding
    Index best = kNone, beside = kNone;
    double least = 4.0, nearest = 16.0;
    for (const Index cell : near) {
      const double out = outside(cells, cell, p);
      if (out < least) {
        least = out;
        best = cell;
      }
      for (const Index id : cells.corners(cell)) {
        const double square = (psi.places[at(id)] - p).squaredNorm();
        if (!nodes.is_coast(nodes.of_vertex[at(id)]) || square >= nearest) continue;
        nearest = square;
        beside = id;
      }
    }
    const Index coast = beside == kNone ? kNone : nodes.of_vertex[at(beside)];
    if (least > kInside && beside != kNone) return {psi.values[at(beside)], coast};
    return {psi_at(cells, psi, best, p, ids), coast};
  }
};

// Vertices of cells that no source covers get what those around have: one coast's.
void flood(const Grid& grid, Array<Seen>& seen) {
  std::vector<Index> queue;
  for (Index v = 0; v < grid.n_vertices(); ++v) {
    if (!std::isnan(seen[at(v)].psi)) queue.push_back(v);
  }
  for (std::size_t next = 0; next < queue.size(); ++next) {
    for (const Index edge : grid.edges_on_vertex[at(queue[next])]) {
      if (edge == kNone) continue;
      const auto [v, w] = grid.vertices_on_edge[at(edge)];
      const Index other = v == queue[next] ? w : v;
      if (!std::isnan(seen[at(other)].psi)) continue;
      seen[at(other)] = seen[at(queue[next])];
      queue.push_back(other);
    }
  }
  for (Seen& vertex : seen) {
    if (std::isnan(vertex.psi)) vertex.psi = 0.0;  // of a body that is new
  }
}

// A coast's psi: that of the source's coast that most of it lies at, else the mean along it.
double psi_of_coast(std::span<const Index> vertices, std::span<const Seen> seen,
                    const StreamNodes& source, std::span<const double> psi) {
  std::vector<Index> coasts;
  double sum = 0.0;
  for (const Index v : vertices) {
    sum += seen[at(v)].psi;
    if (seen[at(v)].coast != kNone) coasts.push_back(seen[at(v)].coast);
  }
  if (coasts.empty()) return sum / static_cast<double>(vertices.size());
  std::sort(coasts.begin(), coasts.end());
  std::size_t longest = 0;
  Index most = kNone;
  for (std::size_t begin = 0, end = 0; begin < coasts.size(); begin = end) {
    while (end < coasts.size() && coasts[end] == coasts[begin]) ++end;
    if (end - begin <= longest) continue;
    longest = end - begin;
    most = coasts[begin];
  }
  return psi[at(source.row(most)[0])];
}

}  // namespace

StreamFunction stream_function(Context& context, const Grid& grid, std::span<const double> normal) {
  DELOS_CHECK(static_cast<std::int64_t>(normal.size()) == grid.n_edges(), ErrorKind::input,
              "a flow of ", normal.size(), " normal velocities was given for ", grid.n_edges(),
              " edges: it belongs to another grid.");
  const Projection projection = project(context.exec, grid, normal);
  const StreamNodes nodes = stream_nodes(grid);
  Tree tree = sum_along_tree(grid, nodes, projection.flux);
  StreamFunction result;
  result.psi = std::move(tree.psi);
  descend(context, projection, nodes, result.psi);
  level_bodies(nodes, tree, result.psi);
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

Array<double> transfer_stream_function(parallel::Executor& exec, const Overlaps& overlaps,
                                       const Grid& source, const Grid& target,
                                       std::span<const double> psi) {
  const Tiling cells = Tiling::cells(exec, source);
  const StreamNodes nodes = stream_nodes(source), target_nodes = stream_nodes(target);
  const Scattered scattered{source.vertex_position, psi};
  const Shore shore{cells, nodes, scattered};
  Array<Seen> seen(at(target.n_vertices()));
  parallel::for_range(exec, target.n_vertices(), kFitBlock, [&](auto begin, auto end) {
    std::vector<Index> near, ids;
    for (std::int64_t v = begin; v < end; ++v) {
      near.clear();
      for (const Index cell : target.cells_on_vertex[at(v)]) {
        if (cell == kNone) continue;
        near.insert(near.end(), overlaps.source.begin() + overlaps.offsets[at(cell)],
                    overlaps.source.begin() + overlaps.offsets[at(cell) + 1]);
      }
      std::sort(near.begin(), near.end());
      near.erase(std::unique(near.begin(), near.end()), near.end());
      seen[at(v)] = shore.at_point(target.vertex_position[at(v)], near, ids);
    }
  });
  flood(target, seen);
  Array<double> result(seen.size());
  for (std::int64_t node = 0; node < target_nodes.size(); ++node) {
    const auto vertices = target_nodes.row(node);
    const double value = target_nodes.is_coast(node) ? psi_of_coast(vertices, seen, nodes, psi)
                                                     : seen[at(vertices[0])].psi;
    for (const Index v : vertices) result[at(v)] = value;
  }
  return result;
}

}  // namespace delos::remap
