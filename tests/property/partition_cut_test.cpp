// SPDX-License-Identifier: BSD-3-Clause
#include "partition/cut.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <set>

#include "core/hash.hpp"
#include "dual/digest.hpp"
#include "partition/partition.hpp"
#include "support/expect_error.hpp"
#include "support/sample_grids.hpp"

using namespace delos;

namespace {

/// Each cell's part by a throw of dice: every part touches every other, and has holes and islands.
std::vector<Index> scattered(const Grid& grid, Index n_parts, std::uint64_t seed) {
  std::vector<Index> part(at(grid.n_cells()));
  for (std::size_t i = 0; i < part.size(); ++i) {
    part[i] = static_cast<Index>(hash64(seed, i) % static_cast<std::uint64_t>(n_parts));
  }
  return part;
}

std::vector<Subgrid> cut_all(const Grid& grid, const std::vector<Index>& part, CutOptions options) {
  Cutter cutter(grid, part, options);
  std::vector<Subgrid> out(at(options.n_parts));
  for (Index p = 0; p < options.n_parts; ++p) out[at(p)] = cutter.cut(p);
  return out;
}

/// Steps from the part's cells to each cell, by looking at every edge of the grid again and again.
std::vector<Index> steps_from(const Grid& grid, const std::vector<Index>& part, Index own) {
  constexpr Index kFar = 1000000;
  std::vector<Index> steps(part.size(), kFar);
  for (std::size_t i = 0; i < part.size(); ++i) steps[i] = part[i] == own ? 0 : kFar;
  for (bool changed = true; changed;) {
    changed = false;
    for (const auto& [a, b] : grid.cells_on_edge) {
      for (const auto& [from, to] : {std::pair{a, b}, std::pair{b, a}}) {
        if (steps[at(to)] <= steps[at(from)] + 1) continue;
        steps[at(to)] = steps[at(from)] + 1;
        changed = true;
      }
    }
  }
  return steps;
}

/// The layer that the documentation promises for each entity on these cells, -1 for none.
template <class Rows>
std::vector<Index> layers_of(const Rows& cells_on, const std::vector<Index>& part,
                             const std::vector<Index>& steps, const Subgrid& sub) {
  std::vector<Index> out;
  for (const auto& cells : cells_on) {
    Index nearest = steps[at(cells[0])];
    for (const Index cell : cells) nearest = std::min(nearest, steps[at(cell)]);
    const bool is_own = part[at(cells[0])] == sub.part;
    out.push_back(is_own ? 0 : nearest <= sub.n_halo_layers ? nearest + 1 : -1);
  }
  return out;
}

void check_layers(const LocalEntities& entities, const std::vector<Index>& expected) {
  std::vector<Index> found(expected.size(), -1);
  bool is_sorted = true;
  for (std::size_t layer = 0; layer + 1 < entities.layer_offsets.size(); ++layer) {
    for (std::int64_t i = entities.layer_offsets[layer]; i < entities.layer_offsets[layer + 1];
         ++i) {
      found[at(entities.global_id[at(i)])] = static_cast<Index>(layer);
      const bool is_first = i == entities.layer_offsets[layer];
      is_sorted =
          is_sorted && (is_first || entities.global_id[at(i - 1)] < entities.global_id[at(i)]);
    }
  }
  CHECK(is_sorted);
  CHECK((found == expected));
  CHECK(static_cast<std::int64_t>(expected.size()) == entities.n_global);
  CHECK(entities.layer_offsets.back() == static_cast<std::int64_t>(entities.global_id.size()));
}

std::vector<Index> local_ids(const LocalEntities& entities) {
  std::vector<Index> out(at(entities.n_global), kNone);
  for (std::size_t i = 0; i < entities.global_id.size(); ++i) {
    out[at(entities.global_id[i])] = static_cast<Index>(i);
  }
  return out;
}

/// Rows of local ids against the whole grid's: the same where the target is local, kNone elsewhere.
template <class RowOf, class LocalRowOf>
bool same_rows(const LocalEntities& rows, const std::vector<Index>& local, RowOf&& row_of,
               LocalRowOf&& local_row_of) {
  for (std::size_t i = 0; i < rows.global_id.size(); ++i) {
    const auto& whole = row_of(rows.global_id[i]);
    const auto& part = local_row_of(static_cast<Index>(i));
    if (whole.size() != part.size()) return false;
    for (std::size_t j = 0; j < whole.size(); ++j) {
      if (part[j] != local[at(whole[j])]) return false;
    }
  }
  return true;
}

template <class T>
std::span<const T> row(const Array<std::int64_t>& offsets, const Array<T>& values, Index i) {
  return std::span<const T>(values).subspan(at(offsets[at(i)]),
                                            at(offsets[at(i) + 1] - offsets[at(i)]));
}

void check_tables(const Grid& grid, const Subgrid& sub) {
  const LocalArrays& own = sub.arrays;
  const auto cells = local_ids(sub.cells), edges = local_ids(sub.edges),
             vertices = local_ids(sub.vertices);
#define DELOS_SAME_RAGGED(rows, offsets, table, ids)             \
  CHECK(same_rows(                                               \
      sub.rows, ids, [&](Index i) { return grid.table.row(i); }, \
      [&](Index i) { return row(own.offsets, own.table, i); }))
#define DELOS_SAME_ROWS(rows, table, ids)                                       \
  CHECK(same_rows(                                                              \
      sub.rows, ids, [&](Index i) -> const auto& { return grid.table[at(i)]; }, \
      [&](Index i) -> const auto& { return own.table[at(i)]; }))
  DELOS_SAME_RAGGED(cells, cell_offsets, edges_on_cell, edges);
  DELOS_SAME_RAGGED(cells, cell_offsets, vertices_on_cell, vertices);
  DELOS_SAME_RAGGED(cells, cell_offsets, cells_on_cell, cells);
  DELOS_SAME_RAGGED(edges, edge_offsets, edges_on_edge, edges);
  DELOS_SAME_ROWS(edges, cells_on_edge, cells);
  DELOS_SAME_ROWS(edges, vertices_on_edge, vertices);
  DELOS_SAME_ROWS(vertices, cells_on_vertex, cells);
  DELOS_SAME_ROWS(vertices, edges_on_vertex, edges);
#undef DELOS_SAME_RAGGED
#undef DELOS_SAME_ROWS
  const auto is_complete = [](const auto& ids) {
    return std::find(ids.begin(), ids.end(), kNone) == ids.end();
  };
  CHECK(is_complete(own.edges_on_cell));
  CHECK(is_complete(own.vertices_on_cell));
  // What a C-grid model computes at every edge and vertex of its own cells from one halo layer.
  for (Index edge = 0; edge < sub.edges.layer_offsets[2]; ++edge) {
    REQUIRE(is_complete(row(own.edge_offsets, own.edges_on_edge, edge)));
    REQUIRE(is_complete(own.cells_on_edge[at(edge)]));
  }
  for (Index vertex = 0; vertex < sub.vertices.layer_offsets[2]; ++vertex) {
    REQUIRE(is_complete(own.edges_on_vertex[at(vertex)]));
  }
}

/// The owned values of all parts in their global places, bit for bit.
template <class From, class To>
void collect(const LocalEntities& entities, const From& from, To& to) {
  to.resize(at(entities.n_global));
  for (std::int64_t i = 0; i < entities.n_owned(); ++i) {
    to[at(entities.global_id[at(i)])] = from[at(i)];
  }
}

void check_values(const Grid& grid, const std::vector<Subgrid>& subgrids) {
  Grid whole = grid;
  const auto clear = [](auto&... values) { (values.clear(), ...); };
  clear(whole.cell_position, whole.edge_position, whole.vertex_position, whole.cell_lon_lat,
        whole.edge_lon_lat, whole.vertex_lon_lat, whole.cell_area_m2, whole.cell_spacing_m,
        whole.triangle_area_m2, whole.kite_area_m2, whole.cell_distance_m, whole.vertex_distance_m,
        whole.edge_angle_rad);
  for (const Subgrid& sub : subgrids) {
    collect(sub.cells, sub.arrays.cell_position, whole.cell_position);
    collect(sub.cells, sub.arrays.cell_lon_lat, whole.cell_lon_lat);
    collect(sub.cells, sub.arrays.cell_area_m2, whole.cell_area_m2);
    collect(sub.cells, sub.arrays.cell_spacing_m, whole.cell_spacing_m);
    collect(sub.edges, sub.arrays.edge_position, whole.edge_position);
    collect(sub.edges, sub.arrays.edge_lon_lat, whole.edge_lon_lat);
    collect(sub.edges, sub.arrays.cell_distance_m, whole.cell_distance_m);
    collect(sub.edges, sub.arrays.vertex_distance_m, whole.vertex_distance_m);
    collect(sub.edges, sub.arrays.edge_angle_rad, whole.edge_angle_rad);
    collect(sub.vertices, sub.arrays.vertex_position, whole.vertex_position);
    collect(sub.vertices, sub.arrays.vertex_lon_lat, whole.vertex_lon_lat);
    collect(sub.vertices, sub.arrays.triangle_area_m2, whole.triangle_area_m2);
    collect(sub.vertices, sub.arrays.kite_area_m2, whole.kite_area_m2);
    bool same_weights = true;
    for (std::size_t i = 0; i < sub.edges.global_id.size(); ++i) {
      const auto mine =
          row(sub.arrays.edge_offsets, sub.arrays.weights_on_edge, static_cast<Index>(i));
      const auto all = grid.weights_on_edge.row(sub.edges.global_id[i]);
      same_weights = same_weights && std::equal(mine.begin(), mine.end(), all.begin(), all.end());
    }
    CHECK(same_weights);
  }
  parallel::Executor exec(1);
  CHECK(digest(exec, whole) == digest(exec, grid));
}

using Ids = std::vector<Index>;

/// Global ids of one neighbour's share of a list.
Ids share(const LocalEntities& entities, Index neighbour, bool is_send) {
  const ExchangeLists& lists = entities.exchange;
  const auto found = std::lower_bound(lists.neighbours.begin(), lists.neighbours.end(), neighbour);
  if (found == lists.neighbours.end() || *found != neighbour) return {};
  const auto k = at(found - lists.neighbours.begin());
  const auto& offsets = is_send ? lists.send_offsets : lists.receive_offsets;
  const auto& ids = is_send ? lists.send : lists.receive;
  Ids out;
  for (std::int64_t i = offsets[k]; i < offsets[k + 1]; ++i) {
    out.push_back(entities.global_id[at(ids[at(i)])]);
  }
  return out;
}

void check_exchange(const std::vector<Subgrid>& subgrids, LocalEntities Subgrid::*kind) {
  std::set<Index> owned;
  for (const Subgrid& sub : subgrids) {
    const LocalEntities& mine = sub.*kind;
    for (std::int64_t i = 0; i < mine.n_owned(); ++i) {
      REQUIRE(owned.insert(mine.global_id[at(i)]).second);
      REQUIRE(mine.owner[at(i)] == sub.part);
    }
    std::size_t n_received = 0;
    for (const Subgrid& other : subgrids) {
      const Ids received = share(mine, other.part, false);
      n_received += received.size();
      CHECK((received == share(other.*kind, sub.part, true)));
      CHECK(std::is_sorted(received.begin(), received.end()));
      Ids halo;
      for (std::size_t i = at(mine.n_owned()); i < mine.owner.size(); ++i) {
        if (mine.owner[i] == other.part) halo.push_back(mine.global_id[i]);
      }
      std::sort(halo.begin(), halo.end());
      CHECK((received == halo));
    }
    CHECK(n_received == mine.global_id.size() - at(mine.n_owned()));
  }
  CHECK(static_cast<std::int64_t>(owned.size()) == (subgrids.front().*kind).n_global);
}

void check_subgrids(const Grid& grid, const std::vector<Index>& part, const CutOptions& options) {
  const std::vector<Subgrid> subgrids = cut_all(grid, part, options);
  for (const Subgrid& sub : subgrids) {
    CAPTURE(sub.part);
    const auto steps = steps_from(grid, part, sub.part);
    std::vector<Index> cell_layer = steps;
    for (Index& s : cell_layer) s = s <= options.n_halo_layers ? s : -1;
    check_layers(sub.cells, cell_layer);
    check_layers(sub.edges, layers_of(grid.cells_on_edge, part, steps, sub));
    check_layers(sub.vertices, layers_of(grid.cells_on_vertex, part, steps, sub));
    check_tables(grid, sub);
  }
  for (const auto kind : {&Subgrid::cells, &Subgrid::edges, &Subgrid::vertices}) {
    check_exchange(subgrids, kind);
  }
  check_values(grid, subgrids);
}

}  // namespace

TEST_CASE("parts share a grid: each entity has one owner, halos and lists fit together") {
  const Ellipsoid surface = Ellipsoid::wgs84();
  const Grid grid = samples::grid_of(surface, samples::shaken(surface, 3, 0.2, 7));
  parallel::Executor exec(1);
  for (Index n_parts = 1; n_parts <= 7; ++n_parts) {
    for (Index n_halo_layers = 1; n_halo_layers <= 3; ++n_halo_layers) {
      CAPTURE(n_parts);
      CAPTURE(n_halo_layers);
      for (const auto method : {PartitionMethod::automatic, PartitionMethod::curve}) {
        CAPTURE(to_string(method));
        check_subgrids(grid, partition(exec, grid, {n_parts, method, {}}),
                       {n_parts, n_halo_layers});
      }
    }
  }
}

TEST_CASE("parts of any shape fit together, scattered ones too") {
  const Ellipsoid surface;
  const Grid grid = samples::grid_of(surface, samples::bisected_icosahedron(surface, 2));
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    for (const Index n_parts : {2, 5, 40}) {
      for (const Index n_halo_layers : {1, 2, 9}) {
        CAPTURE(seed);
        CAPTURE(n_parts);
        CAPTURE(n_halo_layers);
        check_subgrids(grid, scattered(grid, n_parts, seed), {n_parts, n_halo_layers});
      }
    }
  }
  // A part without cells is allowed here, and holds nothing.
  const std::vector<Index> all_in_one(at(grid.n_cells()), 0);
  check_subgrids(grid, all_in_one, {2, 1});
}

TEST_CASE("the smallest grids can be cut cell by cell") {
  const Ellipsoid surface;
  for (const Mesh& mesh : {samples::tetrahedron(surface), samples::split_cube(surface)}) {
    const Grid grid = samples::grid_of(surface, mesh);
    std::vector<Index> part(at(grid.n_cells()));
    for (std::size_t i = 0; i < part.size(); ++i) part[i] = static_cast<Index>(i);
    check_subgrids(grid, part, {static_cast<Index>(part.size()), 1});
  }
}

TEST_CASE("cuts that can't be are refused") {
  using delos::testing::expect_error;
  const Ellipsoid surface;
  const Grid grid = samples::grid_of(surface, samples::bisected_icosahedron(surface, 1));
  const auto cut = [&](std::size_t n, Index value, CutOptions options, Index part) {
    const std::vector<Index> parts(n, value);
    Cutter cutter(grid, parts, options);
    static_cast<void>(cutter.cut(part));
  };
  expect_error(ErrorKind::config, {"halo_layers = 0: must be between 1 and 1000"}, [&] {
    cut(42, 0, {2, 0}, 0);
  });
  expect_error(ErrorKind::config, {"parts of 41 cells for a grid of 42"}, [&] {
    cut(41, 0, {2, 1}, 0);
  });
  expect_error(ErrorKind::config, {"part 2 of a cell: must be in [0, 2)"}, [&] {
    cut(42, 2, {2, 1}, 0);
  });
  expect_error(ErrorKind::config, {"part = 2: must be in [0, 2)"}, [&] { cut(42, 1, {2, 1}, 2); });
}
