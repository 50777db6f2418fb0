// SPDX-License-Identifier: BSD-3-Clause
#include "partition/cut.hpp"

#include <algorithm>
#include <iterator>

#include "core/error.hpp"

namespace delos {
namespace {

/// What both sides of an exchange are made from: (neighbour, local id) in this order.
struct Entry {
  Index neighbour, id;
  bool operator<(const Entry& other) const {
    return neighbour != other.neighbour ? neighbour < other.neighbour : id < other.id;
  }
};

void add_side(const std::vector<Entry>& entries, const std::vector<Index>& neighbours,
              std::vector<std::int64_t>& offsets, std::vector<Index>& ids) {
  offsets.assign(1, 0);
  ids.clear();
  auto next = entries.begin();
  for (const Index neighbour : neighbours) {
    for (; next != entries.end() && next->neighbour == neighbour; ++next) ids.push_back(next->id);
    offsets.push_back(static_cast<std::int64_t>(ids.size()));
  }
}

/// `send` in order; what is received is every entity that another owns.
ExchangeLists exchange_lists(const LocalEntities& entities, const std::vector<Entry>& send) {
  std::vector<Entry> receive;
  for (std::int64_t i = entities.n_owned(); i < static_cast<std::int64_t>(entities.owner.size());
       ++i) {
    receive.push_back({entities.owner[at(i)], static_cast<Index>(i)});
  }
  // Local ids follow the global ones within a layer only.
  std::sort(receive.begin(), receive.end(), [&](const Entry& a, const Entry& b) {
    if (a.neighbour != b.neighbour) return a.neighbour < b.neighbour;
    return entities.global_id[at(a.id)] < entities.global_id[at(b.id)];
  });
  ExchangeLists out;
  for (const Entry& entry : send) out.neighbours.push_back(entry.neighbour);
  for (const Entry& entry : receive) out.neighbours.push_back(entry.neighbour);
  std::sort(out.neighbours.begin(), out.neighbours.end());
  out.neighbours.erase(std::unique(out.neighbours.begin(), out.neighbours.end()),
                       out.neighbours.end());
  add_side(send, out.neighbours, out.send_offsets, out.send);
  add_side(receive, out.neighbours, out.receive_offsets, out.receive);
  return out;
}

/// The values of the listed entities; none where the grid has none.
template <class Values, class T>
void pick(const Values& from, const std::vector<Index>& global_id, Array<T>& to) {
  if (from.empty()) return;
  to.resize(global_id.size());
  for (std::size_t i = 0; i < global_id.size(); ++i) to[i] = from[at(global_id[i])];
}

/// As pick, and the ids in the rows become local ones, or kNone.
template <class Rows, class T>
void pick_local(const Rows& from, const std::vector<Index>& global_id,
                const std::vector<Index>& local, Array<T>& to) {
  pick(from, global_id, to);
  for (T& row : to) {
    for (Index& id : row) id = id == kNone ? kNone : local[at(id)];
  }
}

template <class T>
Array<std::int64_t> pick_offsets(const Ragged<T>& from, const std::vector<Index>& global_id) {
  Array<std::int64_t> offsets(global_id.size() + 1);
  offsets[0] = 0;
  for (std::size_t i = 0; i < global_id.size(); ++i) {
    offsets[i + 1] = offsets[i] + static_cast<std::int64_t>(from.row(global_id[i]).size());
  }
  return offsets;
}

/// The rows of the listed entities, one after the other.
template <class T>
void pick_rows(const Ragged<T>& from, const std::vector<Index>& global_id,
               const Array<std::int64_t>& offsets, Array<T>& to) {
  to.resize(at(offsets.back()));
  for (std::size_t i = 0; i < global_id.size(); ++i) {
    const auto row = from.row(global_id[i]);
    std::copy(row.begin(), row.end(), to.begin() + offsets[i]);
  }
}

void localise(const std::vector<Index>& local, Array<Index>& ids) {
  for (Index& id : ids) id = id == kNone ? kNone : local[at(id)];
}

/// The first cell of a vertex that is there.
Index first_cell(const std::array<Index, 3>& cells) {
  return cells[0] != kNone ? cells[0] : cells[1] != kNone ? cells[1] : cells[2];
}

}  // namespace

struct Cutter::Impl {
  Impl(const Grid& of, std::span<const Index> parts, const CutOptions& how);

  std::span<const Index> cells_of(Index part) const {
    const std::size_t begin = part_begin[at(part)];
    return {by_part.data() + begin, part_begin[at(part) + 1] - begin};
  }
  void grow(Index part);
  LocalEntities number_cells() const;
  template <class OwnerOf, class Touching>
  LocalEntities number(Index part, std::int64_t n_global, OwnerOf&& owner_of, Touching&& touching,
                       std::vector<Index>& local) const;
  void find_sends(Subgrid& out);
  void reach(Index neighbour, std::span<const Index> sources);
  void fill_cells(const std::vector<Index>& cells, LocalArrays& out) const;
  void fill_edges(const std::vector<Index>& edges, LocalArrays& out) const;
  void fill_vertices(const std::vector<Index>& vertices, LocalArrays& out) const;
  void forget(const Subgrid& out);

  const Grid& grid;
  std::span<const Index> part_of_cell;
  CutOptions options;
  std::vector<Index> by_part;           // cells, part after part, ascending
  std::vector<std::size_t> part_begin;  // [n_parts + 1]

  // --- of the part in work; kNone for all else, and for all between two parts
  std::vector<Index> slot;  // [n_cells] place in `region`
  std::vector<Index> local_cell, local_edge, local_vertex;
  // Cells up to one layer beyond the halo, since that one decides which edges of a neighbour's
  // outermost layer are ours; layer after layer, ascending in each.
  std::vector<Index> region;
  std::vector<std::size_t> layer_begin;
  std::vector<Index> reached_by;  // [region] the neighbour whose halo or own cells this is in
  std::vector<Index> reached;     // slots
};

Cutter::Impl::Impl(const Grid& of, std::span<const Index> parts, const CutOptions& how)
    : grid(of), part_of_cell(parts), options(how) {
  // A stencil has a few; each costs an entry of the offsets, whether it has cells or not.
  constexpr int kMaxHaloLayers = 1000;
  DELOS_CHECK(options.n_halo_layers >= 1 && options.n_halo_layers <= kMaxHaloLayers,
              ErrorKind::config, "halo_layers = ", options.n_halo_layers,
              ": must be between 1 and ", kMaxHaloLayers, ".");
  DELOS_CHECK(static_cast<std::int64_t>(parts.size()) == grid.n_cells(), ErrorKind::config,
              "there are parts of ", parts.size(), " cells for a grid of ", grid.n_cells(),
              ": give one for each cell.");
  part_begin.assign(at(options.n_parts) + 1, 0);
  for (const Index part : parts) {
    DELOS_CHECK(part >= 0 && part < options.n_parts, ErrorKind::config, "part ", part,
                " of a cell: must be in [0, ", options.n_parts, ").");
    ++part_begin[at(part) + 1];
  }
  for (std::size_t p = 1; p < part_begin.size(); ++p) part_begin[p] += part_begin[p - 1];
  by_part.resize(parts.size());
  std::vector<std::size_t> next(part_begin.begin(), part_begin.end() - 1);
  for (std::size_t cell = 0; cell < parts.size(); ++cell) {
    by_part[next[at(parts[cell])]++] = static_cast<Index>(cell);
  }
  slot.assign(parts.size(), kNone);
  local_cell.assign(parts.size(), kNone);
  local_edge.assign(at(grid.n_edges()), kNone);
  local_vertex.assign(at(grid.n_vertices()), kNone);
}

/// The cells within n_halo_layers + 1 steps of the part.
void Cutter::Impl::grow(Index part) {
  const auto own = cells_of(part);
  region.assign(own.begin(), own.end());
  layer_begin.assign({0, region.size()});
  for (const Index cell : own) slot[at(cell)] = 0;  // seen; its place follows
  for (Index layer = 0; layer <= options.n_halo_layers; ++layer) {
    const std::size_t begin = layer_begin[layer_begin.size() - 2], end = layer_begin.back();
    for (std::size_t i = begin; i < end; ++i) {
      for (const Index next : grid.cells_on_cell.row(region[i])) {
        if (next == kNone || slot[at(next)] != kNone) continue;
        slot[at(next)] = 0;
        region.push_back(next);
      }
    }
    std::sort(region.begin() + static_cast<std::ptrdiff_t>(end), region.end());
    layer_begin.push_back(region.size());
  }
  for (std::size_t i = 0; i < region.size(); ++i) slot[at(region[i])] = static_cast<Index>(i);
}

LocalEntities Cutter::Impl::number_cells() const {
  LocalEntities out;
  out.n_global = grid.n_cells();
  const auto end =
      region.begin() + static_cast<std::ptrdiff_t>(layer_begin[layer_begin.size() - 2]);
  out.global_id.assign(region.begin(), end);
  out.layer_offsets.assign(layer_begin.begin(), layer_begin.end() - 1);
  for (const Index cell : out.global_id) out.owner.push_back(part_of_cell[at(cell)]);
  return out;
}

/// Edges or vertices: touching(cell) are those of a cell, owner_of(id) their owner. Sets `local`.
template <class OwnerOf, class Touching>
LocalEntities Cutter::Impl::number(Index part, std::int64_t n_global, OwnerOf&& owner_of,
                                   Touching&& touching, std::vector<Index>& local) const {
  LocalEntities out;
  out.n_global = n_global;
  std::vector<Index>& ids = out.global_id;
  out.layer_offsets.assign(1, 0);
  for (std::size_t layer = 0; layer + 2 < layer_begin.size(); ++layer) {
    const std::size_t before = ids.size();
    for (std::size_t i = layer_begin[layer]; i < layer_begin[layer + 1]; ++i) {
      for (const Index id : touching(region[i])) {
        if (local[at(id)] != kNone) continue;
        local[at(id)] = 0;  // seen; its number follows
        ids.push_back(id);
      }
    }
    const auto begin = ids.begin() + static_cast<std::ptrdiff_t>(before);
    std::sort(begin, ids.end(), [&](Index a, Index b) {
      const bool a_is_other = owner_of(a) != part, b_is_other = owner_of(b) != part;
      return a_is_other != b_is_other ? b_is_other : a < b;
    });
    if (layer == 0) {
      const auto others =
          std::find_if(begin, ids.end(), [&](Index id) { return owner_of(id) != part; });
      out.layer_offsets.push_back(others - ids.begin());
    }
    out.layer_offsets.push_back(static_cast<std::int64_t>(ids.size()));
  }
  for (std::size_t i = 0; i < ids.size(); ++i) {
    local[at(ids[i])] = static_cast<Index>(i);
    out.owner.push_back(owner_of(ids[i]));
  }
  return out;
}

/// Marks what `neighbour` has of our region: its own cells, `sources`, and those around them. A way
/// of n_halo_layers steps that ends within one step of our cells never leaves the region.
void Cutter::Impl::reach(Index neighbour, std::span<const Index> sources) {
  reached.assign(sources.begin(), sources.end());
  for (const Index source : sources) reached_by[at(source)] = neighbour;
  std::size_t begin = 0;
  for (Index layer = 0; layer < options.n_halo_layers; ++layer) {
    const std::size_t end = reached.size();
    for (; begin < end; ++begin) {
      for (const Index next : grid.cells_on_cell.row(region[at(reached[begin])])) {
        const Index place = next == kNone ? kNone : slot[at(next)];
        if (place == kNone || reached_by[at(place)] == neighbour) continue;
        reached_by[at(place)] = neighbour;
        reached.push_back(place);
      }
    }
  }
}

/// Each neighbour's halo holds the cells that it reaches, and their edges and vertices.
void Cutter::Impl::find_sends(Subgrid& out) {
  std::vector<Index> others(region.size() - layer_begin[1]);
  for (std::size_t i = 0; i < others.size(); ++i)
    others[i] = static_cast<Index>(layer_begin[1] + i);
  const auto owner = [&](Index place) { return part_of_cell[at(region[at(place)])]; };
  std::sort(others.begin(), others.end(),
            [&](Index a, Index b) { return owner(a) != owner(b) ? owner(a) < owner(b) : a < b; });
  reached_by.assign(region.size(), kNone);
  const auto n_near = static_cast<Index>(layer_begin[2]);  // only these have edges of ours
  std::vector<Entry> cells, edges, vertices;
  const auto add = [&](std::span<const Index> ids, const std::vector<Index>& local,
                       std::int64_t n_owned, Index neighbour, std::vector<Entry>& list) {
    for (const Index id : ids) {
      const Index mine = local[at(id)];
      if (mine != kNone && mine < n_owned) list.push_back({neighbour, mine});
    }
  };
  for (auto first = others.begin(); first != others.end();) {
    const Index neighbour = owner(*first);
    const auto last =
        std::find_if(first, others.end(), [&](Index place) { return owner(place) != neighbour; });
    reach(neighbour, {first, last});
    first = last;
    for (const Index place : reached) {
      if (place >= n_near) continue;
      const Index cell = region[at(place)];
      add({&cell, 1}, local_cell, out.cells.n_owned(), neighbour, cells);
      add(grid.edges_on_cell.row(cell), local_edge, out.edges.n_owned(), neighbour, edges);
      add(grid.vertices_on_cell.row(cell), local_vertex, out.vertices.n_owned(), neighbour,
          vertices);
    }
  }
  const auto finish = [](std::vector<Entry>& list, LocalEntities& entities) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end(),
                           [](const Entry& a, const Entry& b) { return !(a < b) && !(b < a); }),
               list.end());
    entities.exchange = exchange_lists(entities, list);
  };
  finish(cells, out.cells);
  finish(edges, out.edges);
  finish(vertices, out.vertices);
}

void Cutter::Impl::fill_cells(const std::vector<Index>& cells, LocalArrays& out) const {
  pick(grid.cell_position, cells, out.cell_position);
  pick(grid.cell_lon_lat, cells, out.cell_lon_lat);
  pick(grid.cell_area_m2, cells, out.cell_area_m2);
  pick(grid.cell_spacing_m, cells, out.cell_spacing_m);
  pick(grid.cell_ring, cells, out.cell_ring);
  out.cell_offsets = pick_offsets(grid.edges_on_cell, cells);
  pick_rows(grid.edges_on_cell, cells, out.cell_offsets, out.edges_on_cell);
  pick_rows(grid.vertices_on_cell, cells, out.cell_offsets, out.vertices_on_cell);
  pick_rows(grid.cells_on_cell, cells, out.cell_offsets, out.cells_on_cell);
  localise(local_edge, out.edges_on_cell);
  localise(local_vertex, out.vertices_on_cell);
  localise(local_cell, out.cells_on_cell);
}

void Cutter::Impl::fill_edges(const std::vector<Index>& edges, LocalArrays& out) const {
  pick(grid.edge_position, edges, out.edge_position);
  pick(grid.edge_lon_lat, edges, out.edge_lon_lat);
  pick_local(grid.cells_on_edge, edges, local_cell, out.cells_on_edge);
  pick_local(grid.vertices_on_edge, edges, local_vertex, out.vertices_on_edge);
  out.edge_offsets = pick_offsets(grid.edges_on_edge, edges);
  pick_rows(grid.edges_on_edge, edges, out.edge_offsets, out.edges_on_edge);
  pick_rows(grid.weights_on_edge, edges, out.edge_offsets, out.weights_on_edge);
  localise(local_edge, out.edges_on_edge);
  pick(grid.cell_distance_m, edges, out.cell_distance_m);
  pick(grid.vertex_distance_m, edges, out.vertex_distance_m);
  pick(grid.edge_angle_rad, edges, out.edge_angle_rad);
  pick(grid.edge_spacing_m, edges, out.edge_spacing_m);
}

void Cutter::Impl::fill_vertices(const std::vector<Index>& vertices, LocalArrays& out) const {
  pick(grid.vertex_position, vertices, out.vertex_position);
  pick(grid.vertex_lon_lat, vertices, out.vertex_lon_lat);
  pick_local(grid.cells_on_vertex, vertices, local_cell, out.cells_on_vertex);
  pick_local(grid.edges_on_vertex, vertices, local_edge, out.edges_on_vertex);
  pick(grid.triangle_area_m2, vertices, out.triangle_area_m2);
  pick(grid.kite_area_m2, vertices, out.kite_area_m2);
}

void Cutter::Impl::forget(const Subgrid& out) {
  for (const Index cell : region) slot[at(cell)] = local_cell[at(cell)] = kNone;
  for (const Index edge : out.edges.global_id) local_edge[at(edge)] = kNone;
  for (const Index vertex : out.vertices.global_id) local_vertex[at(vertex)] = kNone;
}

Cutter::Cutter(const Grid& grid, std::span<const Index> part_of_cell, const CutOptions& options)
    : impl_(std::make_unique<Impl>(grid, part_of_cell, options)) {}
Cutter::~Cutter() = default;

Subgrid Cutter::cut(Index part) {
  DELOS_CHECK(part >= 0 && part < impl_->options.n_parts, ErrorKind::config, "part = ", part,
              ": must be in [0, ", impl_->options.n_parts, ").");
  const Grid& grid = impl_->grid;
  Subgrid out;
  out.part = part;
  out.n_parts = impl_->options.n_parts;
  out.n_halo_layers = impl_->options.n_halo_layers;
  impl_->grow(part);
  out.cells = impl_->number_cells();
  for (std::size_t i = 0; i < out.cells.global_id.size(); ++i) {
    impl_->local_cell[at(out.cells.global_id[i])] = static_cast<Index>(i);
  }
  const auto owner = [&](Index cell) { return impl_->part_of_cell[at(cell)]; };
  out.edges = impl_->number(
      part, grid.n_edges(), [&](Index edge) { return owner(grid.cells_on_edge[at(edge)][0]); },
      [&](Index cell) { return grid.edges_on_cell.row(cell); }, impl_->local_edge);
  out.vertices = impl_->number(
      part, grid.n_vertices(),
      [&](Index vertex) { return owner(first_cell(grid.cells_on_vertex[at(vertex)])); },
      [&](Index cell) { return grid.vertices_on_cell.row(cell); }, impl_->local_vertex);
  impl_->find_sends(out);
  impl_->fill_cells(out.cells.global_id, out.arrays);
  impl_->fill_edges(out.edges.global_id, out.arrays);
  impl_->fill_vertices(out.vertices.global_id, out.arrays);
  impl_->forget(out);
  return out;
}

}  // namespace delos
