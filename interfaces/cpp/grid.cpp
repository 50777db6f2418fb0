// SPDX-License-Identifier: BSD-3-Clause
#include "delos/grid.hpp"

#include <algorithm>
#include <type_traits>

#include "flat.hpp"
#include "grid_access.hpp"
#include "io/atomic_file.hpp"
#include "io/face_mesh.hpp"
#include "lifecycle/outputs.hpp"
#include "metrics/certificate.hpp"
#include "translate.hpp"
#include "vertical.hpp"

namespace delos::api {
namespace {

std::span<const double> flat(const Array<Vec3>& points) {
  static_assert(sizeof(Vec3) == 3 * sizeof(double));
  return {points.empty() ? nullptr : points.front().data(), 3 * points.size()};
}

Quality summary(const delos::Quality& quality) {
  return {.well_centred = quality.n_obtuse == 0,
          .n_obtuse = quality.n_obtuse,
          .min_angle_deg = quality.angle_min_deg.value,
          .max_angle_deg = quality.angle_max_deg.value,
          .min_area_length = quality.area_length_min.value,
          .mean_area_length = quality.area_length_mean,
          .min_relative_edge = quality.relative_edge_min.value,
          .max_relative_edge = quality.relative_edge_max.value,
          .min_dual_ratio = quality.dual_ratio_min.value,
          .degree_6_fraction = quality.degree_6};
}

/// The edge between two neighbouring cells.
std::int64_t edge_between(const delos::Grid& grid, Index a, Index b) {
  const auto edges = grid.edges_on_cell.row(a);
  const auto neighbours = grid.cells_on_cell.row(a);
  const auto found = std::find(neighbours.begin(), neighbours.end(), b);
  DELOS_ASSERT(found != neighbours.end());
  return edges[static_cast<std::size_t>(found - neighbours.begin())];
}

Worst worst(const delos::Grid& grid, const Extreme& extreme) {
  const bool is_edge = extreme.element == Element::edge && extreme.id != kNone;
  const double lon_rad = extreme.where.lon_rad;
  return {extreme.value,
          is_edge ? edge_between(grid, extreme.id, extreme.other) : extreme.id,
          {is_edge ? extreme.id : kNone, is_edge ? extreme.other : kNone},
          lon_rad < 0.0 ? lon_rad + 2.0 * kPi : lon_rad,
          extreme.where.lat_rad};
}

Certificate public_certificate(const Product& product) {
  const delos::Certificate own = certificate(product.report.quality);
  const auto at = [&](const Extreme& extreme) { return worst(*product.grid, extreme); };
  return {.well_centred = own.is_well_centred(),
          .well_centred_fraction = own.well_centred,
          .n_obtuse = own.n_obtuse,
          .spacing_kept = own.keeps_spacing(),
          .relative_edge_bound = kRelativeEdgeBound,
          .relative_edge_min = at(*own.relative_edge_min),
          .dual_ratio_min = at(own.dual_ratio_min),
          .stagger_max = at(own.stagger_max),
          .angle_max_deg = at(own.angle_max_deg)};
}

std::array<double, 3> as_array(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

/// Runs `write` with threads of its own; nothing listens.
template <class Write>
auto with_context(const Product& product, Write&& write) {
  parallel::Executor exec(product.report.n_threads);
  Monitor monitor;
  Context context{exec, monitor};
  return write(context, output_content(product, text("libdelos ", product.report.version)));
}

void write_file(const Product& product, FileKind kind, const std::string& path) {
  translated([&] {
    with_context(product, [&](Context& context, const OutputContent& content) {
      write_grid_file(context, content, kind, path);
    });
  });
}

}  // namespace

Grid GridAccess::make(std::shared_ptr<const Product> product, std::int64_t generation) {
  auto impl = std::make_shared<Grid::Impl>(std::move(product), generation);
  const Product& own = impl->product;
  const RowOffsets& offsets = own.grid->edges_on_cell.offsets;
  impl->max_edges = static_cast<std::int64_t>(longest_row(offsets));
  impl->quality = summary(own.report.quality);
  impl->certificate = public_certificate(own);
  impl->report = report_text(own.report);
  impl->report_json = report_json(own.report);
  return Grid(std::move(impl));
}

Grid::Grid(std::shared_ptr<const Impl> impl) : impl_(std::move(impl)) {}
Grid::Grid(const Grid& other) = default;
Grid::Grid(Grid&& other) noexcept = default;
Grid& Grid::operator=(const Grid& other) = default;
Grid& Grid::operator=(Grid&& other) noexcept = default;
Grid::~Grid() = default;

std::int64_t Grid::n_cells() const { return impl_->product.grid->n_cells(); }
std::int64_t Grid::n_edges() const { return impl_->product.grid->n_edges(); }
std::int64_t Grid::n_vertices() const { return impl_->product.grid->n_vertices(); }
std::int64_t Grid::max_edges() const { return impl_->max_edges; }
std::int64_t Grid::generation() const { return impl_->generation; }
const std::string& Grid::digest() const { return impl_->product.report.digest; }
const Quality& Grid::quality() const { return impl_->quality; }
const Certificate& Grid::certificate() const { return impl_->certificate; }
const std::string& Grid::config_text() const { return impl_->product.settings.text; }
const std::string& Grid::report() const { return impl_->report; }
const std::string& Grid::report_json() const { return impl_->report_json; }

std::array<double, 3> Grid::radii_m() const {
  const Ellipsoid& surface = impl_->product.grid->surface;
  return as_array(surface.scale_m() * surface.radii());
}
std::array<double, 3> Grid::centre_m() const {
  return as_array(impl_->product.grid->surface.centre_m());
}
double Grid::scale_m() const { return impl_->product.grid->surface.scale_m(); }

#define DELOS_FLAT(type, name, member) \
  std::span<const type> Grid::name() const { return flat<type>(impl_->product.grid->member); }
DELOS_FLAT(double, cell_lon_lat, cell_lon_lat)
DELOS_FLAT(double, edge_lon_lat, edge_lon_lat)
DELOS_FLAT(double, vertex_lon_lat, vertex_lon_lat)
DELOS_FLAT(std::int64_t, cell_offsets, edges_on_cell.offsets.positions())
DELOS_FLAT(std::int32_t, edges_on_cell, edges_on_cell.values)
DELOS_FLAT(std::int32_t, vertices_on_cell, vertices_on_cell.values)
DELOS_FLAT(std::int32_t, cells_on_cell, cells_on_cell.values)
DELOS_FLAT(std::int32_t, cells_on_edge, cells_on_edge)
DELOS_FLAT(std::int32_t, vertices_on_edge, vertices_on_edge)
DELOS_FLAT(std::int32_t, cells_on_vertex, cells_on_vertex)
DELOS_FLAT(std::int32_t, edges_on_vertex, edges_on_vertex)
DELOS_FLAT(std::int64_t, edge_offsets, edges_on_edge.offsets.positions())
DELOS_FLAT(std::int32_t, edges_on_edge, edges_on_edge.values)
DELOS_FLAT(double, weights_on_edge, weights_on_edge.values)
DELOS_FLAT(double, cell_area_m2, cell_area_m2)
DELOS_FLAT(double, cell_spacing_m, cell_spacing_m)
DELOS_FLAT(double, edge_spacing_m, edge_spacing_m)
DELOS_FLAT(std::int32_t, cell_ring, cell_ring)
DELOS_FLAT(double, triangle_area_m2, triangle_area_m2)
DELOS_FLAT(double, kite_area_m2, kite_area_m2)
DELOS_FLAT(double, cell_distance_m, cell_distance_m)
DELOS_FLAT(double, vertex_distance_m, vertex_distance_m)
DELOS_FLAT(double, edge_angle_rad, edge_angle_rad)
#undef DELOS_FLAT

std::span<const double> Grid::cell_position() const {
  return flat(impl_->product.grid->cell_position);
}
std::span<const double> Grid::edge_position() const {
  return flat(impl_->product.grid->edge_position);
}
std::span<const double> Grid::vertex_position() const {
  return flat(impl_->product.grid->vertex_position);
}

// Empty where the grid has no layers, or those of the other kind.
#define DELOS_LEVELS(type, name, kind, expression) \
  std::span<const type> Grid::name() const {       \
    const auto& layers = impl_->product.layers;    \
    if (!layers || !layers->kind) return {};       \
    return flat<type>(layers->kind->expression);   \
  }
DELOS_LEVELS(std::int32_t, max_level_cell, ocean, n_layers)
DELOS_LEVELS(double, bottom_depth_m, ocean, bottom_depth_m)
DELOS_LEVELS(double, ground_height_m, terrain, ground_m)
#undef DELOS_LEVELS

std::span<const double> Grid::ground_influence() const {
  const auto& layers = impl_->product.layers;
  if (!layers || !layers->terrain) return {};
  return layers->terrain->influence;
}
std::span<const double> Grid::level_interface_m() const {
  const auto& layers = impl_->product.layers;
  if (!layers) return {};
  return layers->ocean ? layers->ocean->levels.interface_m : layers->terrain->zeta_m;
}
std::vector<double> Grid::layer_thickness_m() const {
  return translated([&] { return api::layer_thickness_m(vertical_of(*this)); });
}
std::vector<double> Grid::interface_height_m() const {
  return translated([&] { return api::interface_height_m(vertical_of(*this)); });
}

void Grid::write_mpas(const std::string& path) const {
  write_file(impl_->product, FileKind::mpas, path);
}
void Grid::write_ugrid_cells(const std::string& path) const {
  write_file(impl_->product, FileKind::ugrid_cells, path);
}
void Grid::write_ugrid_triangles(const std::string& path) const {
  write_file(impl_->product, FileKind::ugrid_triangles, path);
}
void Grid::write_report(const std::string& path) const {
  translated([&] { write_text_atomically(path, impl_->report_json); });
}

std::vector<std::string> Grid::write_outputs(const std::string& directory) const {
  return translated([&] {
    return with_context(impl_->product, [&](Context& context, const OutputContent& content) {
      return delos::write_outputs(
          context, content,
          directory.empty() ? impl_->product.settings.output.directory : directory);
    });
  });
}

}  // namespace delos::api
