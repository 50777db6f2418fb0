// SPDX-License-Identifier: BSD-3-Clause
#include "remap/potential.hpp"

#include <algorithm>
#include <cmath>

#include "remap/laplace.hpp"
#include "remap/quadratic_fit.hpp"

namespace delos::remap {
namespace {

constexpr std::int64_t kCellGrain = 4096;  // 0.1 ms; part of the answer
// Residual of the potential against the flow at which it has arrived; 1e-12 is promised.
constexpr double kPotentialArrived = 1e-14;
// Net outflow of a connected part, against what crosses its edges, that is rounding of the areas
// and of the sums; the balance of the overlaps is 1e-14.
constexpr double kUnbalanced = 1e-12;

// The cell, its neighbours and theirs, ascending.
void gather_rings(const Tiling& cells, Index cell, std::vector<Index>& ids) {
  ids.assign(1, cell);
  for (const Index near : cells.neighbours(cell)) {
    ids.push_back(near);
    const auto more = cells.neighbours(near);
    ids.insert(ids.end(), more.begin(), more.end());
  }
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
}

// The cells that have a free edge, as nodes.
struct FreeCells {
  std::vector<Index> cells;  // ascending
  std::vector<Index> node;   // of each cell, kNone of others
};

FreeCells free_cells(parallel::Executor& exec, const Grid& grid, std::span<const char> is_free) {
  FreeCells result;
  result.cells = parallel::collect<Index>(
      exec, grid.n_cells(), kCellGrain,
      [&](std::int64_t begin, std::int64_t end, std::vector<Index>& found) {
        for (std::int64_t i = begin; i < end; ++i) {
          const auto edges = grid.edges_on_cell.row(i);
          if (std::any_of(edges.begin(), edges.end(), [&](Index e) { return is_free[at(e)] != 0; }))
            found.push_back(static_cast<Index>(i));
        }
      });
  result.node.assign(at(grid.n_cells()), kNone);
  for (std::size_t k = 0; k < result.cells.size(); ++k) {
    result.node[at(result.cells[k])] = static_cast<Index>(k);
  }
  return result;
}

Network network_of(parallel::Executor& exec, const Grid& grid, std::span<const char> is_free,
                   const FreeCells& free) {
  return make_network(
      exec, static_cast<std::int64_t>(free.cells.size()), [&](std::int64_t i, auto&& put) {
        const Index cell = free.cells[at(i)];
        const auto edges = grid.edges_on_cell.row(cell), beside = grid.cells_on_cell.row(cell);
        for (std::size_t k = 0; k < edges.size(); ++k) {
          const double dv = grid.vertex_distance_m[at(edges[k])];
          if (is_free[at(edges[k])] == 0 || dv <= 0.0) continue;
          put(free.node[at(beside[k])], dv / grid.cell_distance_m[at(edges[k])]);
        }
      });
}

// Outflow that cells have too much of, m2/s.
Array<double> surplus_of(parallel::Executor& exec, const Grid& grid, const WantedDivergence& wanted,
                         const FreeCells& free, std::span<const double> normal) {
  Array<double> result(free.cells.size());
  parallel::for_index(
      exec, static_cast<std::int64_t>(result.size()), kCellGrain, [&](std::int64_t i) {
        const Index cell = free.cells[at(i)];
        double outflow = -wanted.divergence_s[at(cell)] * grid.cell_area_m2[at(cell)];
        for (const Index edge : grid.edges_on_cell.row(cell)) {
          const double flux = normal[at(edge)] * grid.vertex_distance_m[at(edge)];
          outflow += grid.cells_on_edge[at(edge)][0] == cell ? flux : -flux;
        }
        result[at(i)] = outflow;
      });
  return result;
}

// Takes from each connected part the mean of its surplus, which is rounding: the potential can move
// it about, but not away. `scale` is what a cell's edges let through.
void level_parts(const Network& network, double scale, std::span<double> surplus) {
  std::vector<char> is_seen(surplus.size(), 0);
  std::vector<Index> part;
  for (std::size_t start = 0; start < surplus.size(); ++start) {
    if (is_seen[start] != 0) continue;
    part.assign(1, static_cast<Index>(start));
    is_seen[start] = 1;
    double total = 0.0;
    for (std::size_t next = 0; next < part.size(); ++next) {
      const std::size_t node = at(part[next]);
      total += surplus[node];
      for (auto k = network.offsets[node]; k < network.offsets[node + 1]; ++k) {
        const Index other = network.neighbour[at(k)];
        if (is_seen[at(other)] != 0) continue;
        is_seen[at(other)] = 1;
        part.push_back(other);
      }
    }
    const double mean = total / static_cast<double>(part.size());
    DELOS_CHECK(std::abs(mean) <= kUnbalanced * scale, ErrorKind::input, "in a part of ",
                part.size(), " cells, whose border keeps its velocities, ", total,
                " m2/s flow out that the wanted divergence does not hold: carry the divergence "
                "with the transfer that says which edges stay, without moving sums between parts.");
    for (const Index node : part) surplus[at(node)] -= mean;
  }
}

}  // namespace

Array<double> velocity_potential(const Grid& grid, std::span<const double> gradient) {
  Array<double> chi(at(grid.n_cells()));
  std::vector<char> is_known(at(grid.n_cells()), 0);
  std::vector<Index> queue{0};
  queue.reserve(at(grid.n_cells()));
  chi[0] = 0.0;
  is_known[0] = 1;
  for (std::size_t next = 0; next < queue.size(); ++next) {
    const Index cell = queue[next];
    const auto edges = grid.edges_on_cell.row(cell), beside = grid.cells_on_cell.row(cell);
    for (std::size_t k = 0; k < edges.size(); ++k) {
      if (is_known[at(beside[k])] != 0) continue;
      is_known[at(beside[k])] = 1;
      const double rise = gradient[at(edges[k])] * grid.cell_distance_m[at(edges[k])];
      const bool forward = grid.cells_on_edge[at(edges[k])][0] == cell;
      chi[at(beside[k])] = chi[at(cell)] + (forward ? rise : -rise);
      queue.push_back(beside[k]);
    }
  }
  return chi;
}

Array<double> gradient_of(parallel::Executor& exec, const Grid& grid, std::span<const double> chi) {
  Array<double> normal(at(grid.n_edges()));
  parallel::for_index(exec, grid.n_edges(), kCellGrain, [&](std::int64_t edge) {
    const auto [c, d] = grid.cells_on_edge[at(edge)];
    normal[at(edge)] = (chi[at(d)] - chi[at(c)]) / grid.cell_distance_m[at(edge)];
  });
  return normal;
}

Array<double> transfer_potential(parallel::Executor& exec, const Grid& source, const Grid& target,
                                 std::span<const double> chi) {
  DELOS_CHECK(static_cast<std::int64_t>(chi.size()) == source.n_cells(), ErrorKind::input,
              "a velocity potential of ", chi.size(), " values was given for ", source.n_cells(),
              " cells: it belongs to another grid.");
  const Tiling cells = Tiling::cells(exec, source);
  return fit_at_points(exec, cells, target.cell_position,
                       [&](Index here, const Vec3& p, std::vector<Index>& ids) {
                         if (is_same_point(source.cell_position[at(here)], p)) return chi[at(here)];
                         gather_rings(cells, here, ids);
                         return quadratic_fit({source.cell_position, chi}, ids, p, chi[at(here)]);
                       });
}

void impose_divergence(Context& context, const Grid& grid, const WantedDivergence& wanted,
                       Array<double>& normal) {
  parallel::Executor& exec = context.exec;
  DELOS_CHECK(static_cast<std::int64_t>(wanted.divergence_s.size()) == grid.n_cells() &&
                  static_cast<std::int64_t>(wanted.is_free.size()) == grid.n_edges() &&
                  static_cast<std::int64_t>(normal.size()) == grid.n_edges(),
              ErrorKind::input, "a divergence of ", wanted.divergence_s.size(), " values, ",
              wanted.is_free.size(), " marks and ", normal.size(),
              " normal velocities were given for ", grid.n_cells(), " cells and ", grid.n_edges(),
              " edges: they belong to another grid.");
  const FreeCells free = free_cells(exec, grid, wanted.is_free);
  if (free.cells.empty()) return;
  const Network network = network_of(exec, grid, wanted.is_free, free);
  // Root of the mean over cells of the sum of dc dv u^2 over their edges: about what crosses an
  // edge, and the size of the residual, which is scaled by the diagonal.
  const double size = std::sqrt(parallel::sum(exec, grid.n_edges(), kCellGrain, [&](auto edge) {
    const double u = normal[at(edge)];
    return grid.cell_distance_m[at(edge)] * grid.vertex_distance_m[at(edge)] * u * u;
  }));
  Array<double> surplus = surplus_of(exec, grid, wanted, free, normal);
  level_parts(network, size, surplus);
  const Array<double> chi = solve_laplace(context, network, surplus, kPotentialArrived * size);
  parallel::for_index(exec, grid.n_edges(), kCellGrain, [&](std::int64_t edge) {
    if (wanted.is_free[at(edge)] == 0) return;
    const auto [c, d] = grid.cells_on_edge[at(edge)];
    const double rise = chi[at(free.node[at(d)])] - chi[at(free.node[at(c)])];
    normal[at(edge)] += rise / grid.cell_distance_m[at(edge)];
  });
}

}  // namespace delos::remap
