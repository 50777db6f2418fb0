// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <span>

#include "handle.hpp"

using delos::c::call;
using delos::c::fill;
using delos::c::need;
using delos::c::need_handle;

namespace {

template <class Number>
void hand_out(std::span<const Number> array, const Number** values, int64_t* size) {
  *values = array.data();
  if (size != nullptr) *size = static_cast<int64_t>(array.size());
}

delos_worst plain(const delos::Worst& worst) {
  return {worst.value, worst.id, {worst.cells[0], worst.cells[1]}, worst.lon_rad, worst.lat_rad};
}

}  // namespace

int delos_generate(delos_context* context, const delos_config* config, delos_grid** grid) {
  if (grid != nullptr) *grid = nullptr;
  return call(context, __func__, [&] {
    need_handle(config, "config");
    need(grid, "grid");
    const delos::c::CancelReset reset(*context);
    *grid = context->grids.keep(std::make_unique<delos_grid>(
        *context, delos::generate(*config->config, delos::c::options_of(*context))));
  });
}

int delos_grid_destroy(delos_grid* grid) {
  if (grid == nullptr) return DELOS_SUCCESS;
  return call(grid, __func__, [&] {
    grid->grid.reset();
    grid->paths = std::string();
    grid->context.components.each([&](delos_component& component) {
      if (component.grid == grid) component.grid = nullptr;
    });
    grid->context.grids.retire(grid);
  });
}

int delos_grid_share(delos_context* context, const delos_grid* grid, delos_grid** shared) {
  if (shared != nullptr) *shared = nullptr;
  return call(context, __func__, [&] {
    need_handle(grid, "grid");
    need(shared, "shared");
    *shared = context->grids.keep(std::make_unique<delos_grid>(*context, *grid->grid));
  });
}

// NOLINTBEGIN(bugprone-macro-parentheses): a type can't stand in them
#define DELOS_NUMBER(name, type)                               \
  int delos_grid_##name(const delos_grid* grid, type* value) { \
    return call(grid, __func__, [&] {                          \
      need(value, "the result");                               \
      *value = grid->grid->name();                             \
    });                                                        \
  }
DELOS_NUMBER(n_cells, int64_t)
DELOS_NUMBER(n_edges, int64_t)
DELOS_NUMBER(n_vertices, int64_t)
DELOS_NUMBER(max_edges, int64_t)
DELOS_NUMBER(generation, int64_t)
DELOS_NUMBER(scale_m, double)
#undef DELOS_NUMBER
// NOLINTEND(bugprone-macro-parentheses)

#define DELOS_TEXT(name)                                             \
  int delos_grid_##name(const delos_grid* grid, const char** text) { \
    if (text != nullptr) *text = nullptr;                            \
    return call(grid, __func__, [&] {                                \
      need(text, "text");                                            \
      *text = grid->grid->name().c_str();                            \
    });                                                              \
  }
DELOS_TEXT(digest)
DELOS_TEXT(config_text)
DELOS_TEXT(report)
DELOS_TEXT(report_json)
#undef DELOS_TEXT

#define DELOS_VECTOR(name)                                          \
  int delos_grid_##name(const delos_grid* grid, double vector[3]) { \
    return call(grid, __func__, [&] {                               \
      need(vector, #name);                                          \
      const std::array<double, 3> value = grid->grid->name();       \
      std::copy(value.begin(), value.end(), vector);                \
    });                                                             \
  }
DELOS_VECTOR(radii_m)
DELOS_VECTOR(centre_m)
#undef DELOS_VECTOR

#define DELOS_ARRAY(name, type)                                                       \
  int delos_grid_##name(const delos_grid* grid, const type** values, int64_t* size) { \
    if (values != nullptr) *values = nullptr;                                         \
    return call(grid, __func__, [&] {                                                 \
      need(values, "values");                                                         \
      hand_out(grid->grid->name(), values, size);                                     \
    });                                                                               \
  }
#include "arrays.inc"
#undef DELOS_ARRAY

int delos_grid_quality(const delos_grid* grid, delos_quality* quality) {
  return call(grid, __func__, [&] {
    need(quality, "quality");
    const delos::Quality& own = grid->grid->quality();
    *quality = {.n_obtuse = own.n_obtuse,
                .min_angle_deg = own.min_angle_deg,
                .max_angle_deg = own.max_angle_deg,
                .min_area_length = own.min_area_length,
                .mean_area_length = own.mean_area_length,
                .min_relative_edge = own.min_relative_edge,
                .max_relative_edge = own.max_relative_edge,
                .min_dual_ratio = own.min_dual_ratio,
                .degree_6_fraction = own.degree_6_fraction};
  });
}

#define DELOS_LEVELS(name)                                                        \
  int delos_grid_##name(const delos_grid* grid, double* values, int64_t size) {   \
    return call(grid, __func__, [&] { fill(grid->grid->name(), values, size); }); \
  }
DELOS_LEVELS(layer_thickness_m)
DELOS_LEVELS(interface_height_m)
#undef DELOS_LEVELS

int delos_grid_certificate(const delos_grid* grid, delos_certificate* certificate) {
  return call(grid, __func__, [&] {
    need(certificate, "certificate");
    const delos::Certificate& own = grid->grid->certificate();
    *certificate = {.well_centred = own.well_centred ? 1 : 0,
                    .spacing_kept = own.spacing_kept ? 1 : 0,
                    .well_centred_fraction = own.well_centred_fraction,
                    .n_obtuse = own.n_obtuse,
                    .relative_edge_bound = own.relative_edge_bound,
                    .relative_edge_min = plain(own.relative_edge_min),
                    .dual_ratio_min = plain(own.dual_ratio_min),
                    .stagger_max = plain(own.stagger_max),
                    .angle_max_deg = plain(own.angle_max_deg)};
  });
}

#define DELOS_FILE(name)                                            \
  int delos_grid_##name(const delos_grid* grid, const char* path) { \
    return call(grid, __func__, [&] {                               \
      need(path, "path");                                           \
      grid->grid->name(path);                                       \
    });                                                             \
  }
DELOS_FILE(write_mpas)
DELOS_FILE(write_ugrid_cells)
DELOS_FILE(write_ugrid_triangles)
DELOS_FILE(write_report)
#undef DELOS_FILE

int delos_grid_write_outputs(delos_grid* grid, const char* directory, const char** paths) {
  if (paths != nullptr) *paths = nullptr;
  return call(grid, __func__, [&] {
    std::string all;
    for (const std::string& path : grid->grid->write_outputs(directory == nullptr ? "" : directory))
      all += path + "\n";
    grid->paths = std::move(all);
    if (paths != nullptr) *paths = grid->paths.c_str();
  });
}
