// SPDX-License-Identifier: BSD-3-Clause
#include "delos/partition.hpp"

#include <bit>
#include <type_traits>
#include <utility>

#include "flat.hpp"
#include "grid_access.hpp"
#include "partition/cut.hpp"
#include "partition/partition.hpp"
#include "partition/subgrid.hpp"
#include "translate.hpp"
#include "vertical.hpp"

namespace delos::api {
namespace {

static_assert(static_cast<int>(PartitionMethod::automatic) ==
              static_cast<int>(delos::PartitionMethod::automatic));
static_assert(static_cast<int>(PartitionMethod::kway) ==
              static_cast<int>(delos::PartitionMethod::kway));
static_assert(static_cast<int>(PartitionMethod::curve) ==
              static_cast<int>(delos::PartitionMethod::curve));

// The first number of a layout; the last digits change with the list of arrays.
constexpr std::int64_t kLayoutMagic = 0x64656c6f734c4703;

template <class Rows>
std::span<const std::byte> bytes_of(const Rows& rows) {
  return std::as_bytes(std::span(rows));
}

/// Work of each cell; empty = the same.
std::vector<double> work_of(const Product& product, const PartitionOptions& options) {
  if (!options.cell_weight.empty() || options.work == CellWork::cells) return options.cell_weight;
  std::vector<double> layers = cell_weights(product.layers);
  DELOS_CHECK(options.work == CellWork::automatic || !layers.empty(), delos::ErrorKind::config,
              "parts by wet layers were asked for, but the grid has no layers of an ocean: add a "
              "section layers of kind z_level to the configuration.");
  return layers;
}

/// The surface in metres, as a Grid shows it.
struct Surface {
  std::array<double, 3> radii_m, centre_m;
  double scale_m = 1.0;
};

Surface surface_of(const Grid& grid) { return {grid.radii_m(), grid.centre_m(), grid.scale_m()}; }

/// The layers of a part's cells, and what all cells share.
struct LocalLayers {
  std::vector<double> level_interface_m;
  std::vector<std::int32_t> max_level_cell;
  std::vector<double> bottom_depth_m, ground_height_m, ground_influence;
};

LocalLayers layers_of(const VerticalView& whole, std::span<const Index> cells) {
  const auto pick = [&](const auto& values) {
    std::vector<typename std::decay_t<decltype(values)>::value_type> out;
    if (values.empty()) return out;
    out.reserve(cells.size());
    for (const Index cell : cells) out.push_back(values[at(cell)]);
    return out;
  };
  const auto copy = [](std::span<const double> values) {
    return std::vector<double>(values.begin(), values.end());
  };
  return {copy(whole.level_interface_m), pick(whole.max_level_cell), pick(whole.bottom_depth_m),
          pick(whole.ground_height_m), copy(whole.ground_influence)};
}

/// visit(number) for the numbers of a subgrid that are not in arrays, always in the same order.
template <class AnySubgrid, class AnySurface, class Visit>
void for_each_number(AnySubgrid& subgrid, AnySurface& surface, Visit&& visit) {
  visit(subgrid.part);
  visit(subgrid.n_parts);
  visit(subgrid.n_halo_layers);
  visit(subgrid.cells.n_global);
  visit(subgrid.edges.n_global);
  visit(subgrid.vertices.n_global);
  for (auto& value : surface.radii_m) visit(value);
  for (auto& value : surface.centre_m) visit(value);
  visit(surface.scale_m);
}

std::int64_t packed(double value) { return std::bit_cast<std::int64_t>(value); }
template <class Integer>
std::int64_t packed(Integer value) {
  return static_cast<std::int64_t>(value);
}
void unpack(std::int64_t from, double& to) { to = std::bit_cast<double>(from); }
template <class Integer>
void unpack(std::int64_t from, Integer& to) {
  to = static_cast<Integer>(from);
}

}  // namespace

struct LocalGrid::Impl {
  Subgrid subgrid;
  Surface surface;
  LocalLayers layers;
  /// visit(array) for all of them, always in the same order: what crosses to another process.
  template <class AnyImpl, class Visit>
  static void for_each_array(AnyImpl& impl, Visit&& visit) {
    delos::for_each_array(impl.subgrid, visit);
    visit(impl.layers.level_interface_m);
    visit(impl.layers.max_level_cell);
    visit(impl.layers.bottom_depth_m);
    visit(impl.layers.ground_height_m);
    visit(impl.layers.ground_influence);
  }
  const LocalEntities& entities(Location location) const {
    DELOS_CHECK(
        location == Location::cell || location == Location::edge || location == Location::vertex,
        delos::ErrorKind::config, "location \"", to_string(location),
        "\": a part has cells, edges and vertices only.");
    return location == Location::cell   ? subgrid.cells
           : location == Location::edge ? subgrid.edges
                                        : subgrid.vertices;
  }
};

LocalGrid::LocalGrid(std::shared_ptr<const Impl> impl) : impl_(std::move(impl)) {}

int LocalGrid::part() const { return impl_->subgrid.part; }
int LocalGrid::n_parts() const { return impl_->subgrid.n_parts; }
int LocalGrid::halo_layers() const { return impl_->subgrid.n_halo_layers; }

#define DELOS_OF_ENTITIES(type, name, expression)                \
  type LocalGrid::name(Location location) const {                \
    return translated([&]() -> type {                            \
      const LocalEntities& entities = impl_->entities(location); \
      return expression;                                         \
    });                                                          \
  }
DELOS_OF_ENTITIES(std::int64_t, n_local, static_cast<std::int64_t>(entities.global_id.size()))
DELOS_OF_ENTITIES(std::int64_t, n_owned, entities.n_owned())
DELOS_OF_ENTITIES(std::int64_t, n_global, entities.n_global)
DELOS_OF_ENTITIES(std::span<const std::int32_t>, global_id, entities.global_id)
DELOS_OF_ENTITIES(std::span<const std::int32_t>, owner, entities.owner)
DELOS_OF_ENTITIES(std::span<const std::int64_t>, layer_offsets, entities.layer_offsets)
DELOS_OF_ENTITIES(std::span<const std::int32_t>, neighbours, entities.exchange.neighbours)
DELOS_OF_ENTITIES(std::span<const std::int64_t>, send_offsets, entities.exchange.send_offsets)
DELOS_OF_ENTITIES(std::span<const std::int32_t>, send_ids, entities.exchange.send)
DELOS_OF_ENTITIES(std::span<const std::int64_t>, receive_offsets, entities.exchange.receive_offsets)
DELOS_OF_ENTITIES(std::span<const std::int32_t>, receive_ids, entities.exchange.receive)
#undef DELOS_OF_ENTITIES

std::array<double, 3> LocalGrid::radii_m() const { return impl_->surface.radii_m; }
std::array<double, 3> LocalGrid::centre_m() const { return impl_->surface.centre_m; }
double LocalGrid::scale_m() const { return impl_->surface.scale_m; }

#define DELOS_FLAT(type, name) \
  std::span<const type> LocalGrid::name() const { return flat<type>(impl_->subgrid.arrays.name); }
DELOS_FLAT(double, cell_position)
DELOS_FLAT(double, edge_position)
DELOS_FLAT(double, vertex_position)
DELOS_FLAT(double, cell_lon_lat)
DELOS_FLAT(double, edge_lon_lat)
DELOS_FLAT(double, vertex_lon_lat)
DELOS_FLAT(std::int64_t, cell_offsets)
DELOS_FLAT(std::int32_t, edges_on_cell)
DELOS_FLAT(std::int32_t, vertices_on_cell)
DELOS_FLAT(std::int32_t, cells_on_cell)
DELOS_FLAT(std::int32_t, cells_on_edge)
DELOS_FLAT(std::int32_t, vertices_on_edge)
DELOS_FLAT(std::int32_t, cells_on_vertex)
DELOS_FLAT(std::int32_t, edges_on_vertex)
DELOS_FLAT(std::int64_t, edge_offsets)
DELOS_FLAT(std::int32_t, edges_on_edge)
DELOS_FLAT(double, weights_on_edge)
DELOS_FLAT(double, cell_area_m2)
DELOS_FLAT(double, cell_spacing_m)
DELOS_FLAT(double, edge_spacing_m)
DELOS_FLAT(std::int32_t, cell_ring)
DELOS_FLAT(double, triangle_area_m2)
DELOS_FLAT(double, kite_area_m2)
DELOS_FLAT(double, cell_distance_m)
DELOS_FLAT(double, vertex_distance_m)
DELOS_FLAT(double, edge_angle_rad)
#undef DELOS_FLAT

#define DELOS_LEVELS(type, name) \
  std::span<const type> LocalGrid::name() const { return impl_->layers.name; }
DELOS_LEVELS(double, level_interface_m)
DELOS_LEVELS(std::int32_t, max_level_cell)
DELOS_LEVELS(double, bottom_depth_m)
DELOS_LEVELS(double, ground_height_m)
DELOS_LEVELS(double, ground_influence)
#undef DELOS_LEVELS

std::vector<double> LocalGrid::layer_thickness_m() const {
  return translated([&] { return api::layer_thickness_m(vertical_of(*this)); });
}
std::vector<double> LocalGrid::interface_height_m() const {
  return translated([&] { return api::interface_height_m(vertical_of(*this)); });
}

std::array<std::int64_t, LocalGrid::kLayoutSize> LocalGrid::layout() const {
  std::array<std::int64_t, kLayoutSize> out{};
  std::size_t n = 0;
  out[n++] = kLayoutMagic;
  for_each_number(impl_->subgrid, impl_->surface, [&](auto value) { out.at(n++) = packed(value); });
  Impl::for_each_array(
      *impl_, [&](const auto& array) { out.at(n++) = static_cast<std::int64_t>(array.size()); });
  return out;
}

std::vector<std::span<const std::byte>> LocalGrid::buffers() const {
  std::vector<std::span<const std::byte>> out;
  Impl::for_each_array(*impl_, [&](const auto& array) { out.push_back(bytes_of(array)); });
  return out;
}

LocalGrid LocalGrid::with_layout(const std::array<std::int64_t, kLayoutSize>& layout,
                                 std::vector<std::span<std::byte>>& buffers) {
  return translated([&] {
    DELOS_CHECK(layout[0] == kLayoutMagic, delos::ErrorKind::input,
                "these numbers are no layout of a part of a grid: is another version of delos at "
                "the other end?");
    auto impl = std::make_shared<Impl>();
    std::size_t n = 1;
    for_each_number(impl->subgrid, impl->surface,
                    [&](auto& value) { unpack(layout.at(n++), value); });
    Impl::for_each_array(*impl, [&](auto& array) {
      array.resize(static_cast<std::size_t>(layout.at(n++)));
      buffers.push_back(std::as_writable_bytes(std::span(array)));
    });
    return LocalGrid(std::move(impl));
  });
}

struct Partition::Impl {
  Impl(const Grid& of, const PartitionOptions& options)
      : grid(of),
        part_of_cell(parts(GridAccess::product(of), options)),
        cutter(*GridAccess::product(of).grid, part_of_cell,
               {static_cast<Index>(options.n_parts), options.halo_layers}) {}
  static std::vector<Index> parts(const Product& product, const PartitionOptions& options) {
    // A cut costs little beside the grid: no threads are started for it.
    parallel::Executor exec(1);
    const std::vector<double> work = work_of(product, options);
    return delos::partition(
        exec, *product.grid,
        {options.n_parts, static_cast<delos::PartitionMethod>(options.method), work});
  }
  Grid grid;
  std::vector<Index> part_of_cell;
  Cutter cutter;
};

Partition::Partition(const Grid& grid, const PartitionOptions& options)
    : impl_(translated([&] { return std::make_unique<Impl>(grid, options); })) {}
Partition::Partition(Partition&& other) noexcept = default;
Partition& Partition::operator=(Partition&& other) noexcept = default;
Partition::~Partition() = default;

std::span<const std::int32_t> Partition::part_of_cell() const { return impl_->part_of_cell; }

LocalGrid Partition::part(int number) {
  return translated([&] {
    auto out = std::make_shared<LocalGrid::Impl>();
    out->subgrid = impl_->cutter.cut(number);
    out->surface = surface_of(impl_->grid);
    out->layers = layers_of(vertical_of(impl_->grid), out->subgrid.cells.global_id);
    return LocalGrid(std::move(out));
  });
}

}  // namespace delos::api
