/* SPDX-License-Identifier: BSD-3-Clause */
/* A C99 host: a grid, its arrays, its errors. Prints only what fails. */
#include <delos/delos.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "c_check.h"

static const char small_yaml[] =
    "sizing: {sources: [{type: constant, spacing: 600 km}]}\n"
    "refine: {tile_vertices: 500}\n";

typedef struct heard {
  delos_context* to_cancel;
  int n_progress, n_messages;
} heard;

static void on_progress(const delos_progress* progress, void* user_data) {
  heard* const all = (heard*)user_data;
  if (progress->phase[0] != '\0' && progress->done >= 0) ++all->n_progress;
  if (all->to_cancel != NULL) delos_context_cancel(all->to_cancel);
}

static void on_log(int level, const char* message, void* user_data) {
  if (level <= DELOS_LOG_ERROR && message[0] != '\0') ++((heard*)user_data)->n_messages;
}

static delos_grid* small_grid(delos_context* context) {
  delos_config* config = NULL;
  delos_grid* grid = NULL;
  CHECK(delos_config_from_text(context, small_yaml, NULL, NULL, &config) == DELOS_SUCCESS);
  CHECK(delos_generate(context, config, &grid) == DELOS_SUCCESS);
  CHECK(delos_config_destroy(config) == DELOS_SUCCESS);
  return grid;
}

static void test_counts_and_measures(const delos_grid* grid) {
  int64_t n_cells = 0, n_edges = 0, n_vertices = 0, max_edges = 0, generation = 0, size = 0;
  const double* values = NULL;
  double total_m2 = 0.0, radii_m[3], centre_m[3], scale_m = 0.0, earth_m2;
  CHECK(delos_grid_n_cells(grid, &n_cells) == DELOS_SUCCESS);
  CHECK(delos_grid_n_edges(grid, &n_edges) == DELOS_SUCCESS);
  CHECK(delos_grid_n_vertices(grid, &n_vertices) == DELOS_SUCCESS);
  CHECK(delos_grid_max_edges(grid, &max_edges) == DELOS_SUCCESS);
  CHECK(delos_grid_generation(grid, &generation) == DELOS_SUCCESS);
  CHECK(n_cells > 1000 && n_cells - n_edges + n_vertices == 2);
  CHECK(max_edges >= 6 && generation == 1);
  CHECK(delos_grid_radii_m(grid, radii_m) == DELOS_SUCCESS);
  CHECK(delos_grid_centre_m(grid, centre_m) == DELOS_SUCCESS);
  CHECK(delos_grid_scale_m(grid, &scale_m) == DELOS_SUCCESS);
  CHECK(fabs(radii_m[0] - 6371220.0) < 1e-3 && radii_m[0] == scale_m && centre_m[2] == 0.0);
  CHECK(delos_grid_cell_area_m2(grid, &values, &size) == DELOS_SUCCESS);
  CHECK(size == n_cells);
  for (int64_t i = 0; i < size; ++i) total_m2 += values[i];
  earth_m2 = 4.0 * acos(-1.0) * radii_m[0] * radii_m[0];
  CHECK(fabs(total_m2 / earth_m2 - 1.0) < 1e-12);
  total_m2 = 0.0;
  CHECK(delos_grid_kite_area_m2(grid, &values, &size) == DELOS_SUCCESS);
  CHECK(size == 3 * n_vertices);
  for (int64_t i = 0; i < size; ++i) total_m2 += values[i];
  CHECK(fabs(total_m2 / earth_m2 - 1.0) < 1e-9);
}

typedef int (*reals)(const delos_grid*, const double**, int64_t*);
typedef int (*ids)(const delos_grid*, const int32_t**, int64_t*);
typedef int (*offsets)(const delos_grid*, const int64_t**, int64_t*);

static void test_shapes(const delos_grid* grid, int64_t cells, int64_t edges, int64_t vertices) {
  const int64_t *cell_offsets = NULL, *edge_offsets = NULL;
  int64_t n_weights = 0, size = 0;
  CHECK(delos_grid_cell_offsets(grid, &cell_offsets, &size) == DELOS_SUCCESS);
  CHECK(size == cells + 1 && cell_offsets[0] == 0 && cell_offsets[cells] == 2 * edges);
  CHECK(delos_grid_edge_offsets(grid, &edge_offsets, &size) == DELOS_SUCCESS);
  CHECK(size == edges + 1);
  n_weights = edge_offsets[edges];
  const struct {
    reals get;
    int64_t size;
  } real_arrays[] = {
      {delos_grid_cell_position, 3 * cells},      {delos_grid_edge_position, 3 * edges},
      {delos_grid_vertex_position, 3 * vertices}, {delos_grid_cell_lon_lat, 2 * cells},
      {delos_grid_edge_lon_lat, 2 * edges},       {delos_grid_vertex_lon_lat, 2 * vertices},
      {delos_grid_weights_on_edge, n_weights},    {delos_grid_cell_spacing_m, cells},
      {delos_grid_edge_spacing_m, edges},         {delos_grid_triangle_area_m2, vertices},
      {delos_grid_cell_distance_m, edges},        {delos_grid_vertex_distance_m, edges},
      {delos_grid_edge_angle_rad, edges}};
  const struct {
    ids get;
    int64_t size, end;
  } id_arrays[] = {{delos_grid_edges_on_cell, 2 * edges, edges},
                   {delos_grid_vertices_on_cell, 2 * edges, vertices},
                   {delos_grid_cells_on_cell, 2 * edges, cells},
                   {delos_grid_cells_on_edge, 2 * edges, cells},
                   {delos_grid_vertices_on_edge, 2 * edges, vertices},
                   {delos_grid_cells_on_vertex, 3 * vertices, cells},
                   {delos_grid_edges_on_vertex, 3 * vertices, edges},
                   {delos_grid_edges_on_edge, n_weights, edges}};
  for (size_t a = 0; a < sizeof real_arrays / sizeof real_arrays[0]; ++a) {
    const double* values = NULL;
    CHECK(real_arrays[a].get(grid, &values, &size) == DELOS_SUCCESS);
    CHECK(values != NULL && size == real_arrays[a].size && isfinite(values[size - 1]));
    CHECK(real_arrays[a].get(grid, &values, NULL) == DELOS_SUCCESS);
  }
  for (size_t a = 0; a < sizeof id_arrays / sizeof id_arrays[0]; ++a) {
    const int32_t* values = NULL;
    int64_t largest = 0;
    CHECK(id_arrays[a].get(grid, &values, &size) == DELOS_SUCCESS);
    CHECK(size == id_arrays[a].size);
    for (int64_t i = 0; i < size; ++i) {
      if (values[i] < 0) ++n_failed;
      if (values[i] > largest) largest = values[i];
    }
    CHECK(largest == id_arrays[a].end - 1); /* base 0, and each is somewhere */
  }
}

/* Each edge of a cell names the cell, and the neighbour across it is the other one. */
static void test_connectivity(const delos_grid* grid, int64_t n_cells) {
  const int64_t* begin = NULL;
  const int32_t *edges = NULL, *neighbours = NULL, *cells = NULL;
  int64_t n_wrong = 0;
  delos_grid_cell_offsets(grid, &begin, NULL);
  delos_grid_edges_on_cell(grid, &edges, NULL);
  delos_grid_cells_on_cell(grid, &neighbours, NULL);
  delos_grid_cells_on_edge(grid, &cells, NULL);
  for (int64_t cell = 0; cell < n_cells; ++cell) {
    for (int64_t k = begin[cell]; k < begin[cell + 1]; ++k) {
      const int32_t* const pair = cells + 2 * (int64_t)edges[k];
      n_wrong += !((pair[0] == cell && pair[1] == neighbours[k]) ||
                   (pair[1] == cell && pair[0] == neighbours[k]));
    }
  }
  CHECK(n_wrong == 0);
}

static void test_numbers_and_texts(const delos_grid* grid) {
  delos_quality quality;
  delos_certificate certificate;
  const char* text = NULL;
  CHECK(delos_grid_quality(grid, &quality) == DELOS_SUCCESS);
  CHECK(quality.n_obtuse == 0 && quality.max_angle_deg > 60.0 && quality.max_angle_deg < 90.0);
  CHECK(quality.min_angle_deg > 30.0 && quality.degree_6_fraction > 0.9);
  CHECK(delos_grid_certificate(grid, &certificate) == DELOS_SUCCESS);
  CHECK(certificate.well_centred == 1 && certificate.spacing_kept == 1);
  CHECK(certificate.well_centred_fraction == 1.0 && certificate.relative_edge_bound == 0.65);
  CHECK(certificate.relative_edge_min.value == quality.min_relative_edge);
  CHECK(certificate.dual_ratio_min.value == quality.min_dual_ratio);
  CHECK(certificate.angle_max_deg.value == quality.max_angle_deg);
  CHECK(certificate.angle_max_deg.cells[0] == -1 && certificate.stagger_max.cells[1] >= 0);
  CHECK(delos_grid_digest(grid, &text) == DELOS_SUCCESS && strlen(text) == 64);
  CHECK(delos_grid_config_text(grid, &text) == DELOS_SUCCESS && strstr(text, "600 km") != NULL);
  CHECK(delos_grid_report(grid, &text) == DELOS_SUCCESS && strlen(text) > 100);
  CHECK(delos_grid_report_json(grid, &text) == DELOS_SUCCESS && text[0] == '{');
}

static void test_config(delos_context* context) {
  delos_config* config = (delos_config*)context;
  const char* text = NULL;
  CHECK_FAILS(delos_config_from_text(context, "sizing: [", "mine.yaml", NULL, &config),
              DELOS_ERROR_CONFIG, context, "mine.yaml:");
  CHECK(config == NULL);
  CHECK(delos_config_from_file(context, "no such file.yaml", &config) != DELOS_SUCCESS);
  CHECK(config == NULL && strstr(delos_last_error(context), "no such file.yaml") != NULL);
  CHECK(delos_config_from_text(context, "sizing:\n  sorces: []\n", "mine.yaml", NULL, &config) ==
        DELOS_SUCCESS);
  CHECK_FAILS(delos_config_check(config), DELOS_ERROR_CONFIG, config, "mine.yaml:2 sizing.sorces");
  CHECK(delos_config_destroy(config) == DELOS_SUCCESS);
  CHECK(delos_config_from_text(context, small_yaml, NULL, NULL, &config) == DELOS_SUCCESS);
  CHECK(strcmp(delos_last_error(config), "") == 0);
  CHECK(delos_config_set(config, "sizing.sources.0.spacing", "500 km") == DELOS_SUCCESS);
  CHECK(delos_config_text(config, &text) == DELOS_SUCCESS && strstr(text, "500 km") != NULL);
  CHECK_FAILS(delos_config_set(config, NULL, "1"), DELOS_ERROR_ARGUMENT, config, "key is NULL");
  CHECK_FAILS(delos_config_text(config, NULL), DELOS_ERROR_ARGUMENT, config, "text is NULL");
  CHECK(delos_config_destroy(config) == DELOS_SUCCESS);
  CHECK_FAILS(delos_config_check(config), DELOS_ERROR_STATE, config, "destroyed");
  CHECK_FAILS(delos_config_destroy(config), DELOS_ERROR_STATE, config, "delos_config_destroy");
}

static void test_misuse(delos_context* context, delos_grid* grid) {
  delos_grid* other = grid;
  int64_t n = -7;
  const double* values = &(const double){0.0};
  CHECK(delos_context_create(NULL) == DELOS_ERROR_ARGUMENT);
  CHECK(delos_context_destroy(NULL) == DELOS_SUCCESS && delos_grid_destroy(NULL) == DELOS_SUCCESS);
  CHECK(strlen(delos_last_error(NULL)) > 0);
  CHECK_FAILS(delos_context_set_threads(context, -1), DELOS_ERROR_ARGUMENT, context, "= -1");
  CHECK_FAILS(delos_generate(context, NULL, &other), DELOS_ERROR_ARGUMENT, context, "config");
  CHECK(other == NULL);
  CHECK_FAILS(delos_generate(context, (delos_config*)grid, &other), DELOS_ERROR_STATE, context,
              "no configuration");
  CHECK_FAILS(delos_config_from_text(context, NULL, NULL, NULL, NULL), DELOS_ERROR_ARGUMENT,
              context, "yaml is NULL");
  CHECK_FAILS(delos_config_from_text(context, "", NULL, NULL, NULL), DELOS_ERROR_ARGUMENT, context,
              "config is NULL");
  CHECK_FAILS(delos_grid_n_cells((delos_grid*)context, &n), DELOS_ERROR_STATE, context,
              "the handle is a context, it must be a grid");
  CHECK_FAILS(delos_grid_n_cells(grid, NULL), DELOS_ERROR_ARGUMENT, grid, "NULL");
  CHECK_FAILS(delos_grid_write_mpas(grid, "no such folder/a.nc"), DELOS_ERROR_OUTPUT, grid,
              "no such folder");
  CHECK(delos_grid_n_cells(NULL, &n) == DELOS_ERROR_ARGUMENT && n == -7);
  CHECK(delos_grid_destroy(grid) == DELOS_SUCCESS);
  CHECK_FAILS(delos_grid_n_cells(grid, &n), DELOS_ERROR_STATE, grid, "destroyed");
  CHECK(n == -7);
  CHECK_FAILS(delos_grid_cell_area_m2(grid, &values, &n), DELOS_ERROR_STATE, grid, "cell_area_m2");
  CHECK(values == NULL && n == -7);
  CHECK_FAILS(delos_grid_destroy(grid), DELOS_ERROR_STATE, grid, "destroyed");
}

static void test_callbacks(delos_context* context) {
  heard all = {NULL, 0, 0};
  delos_config* config = NULL;
  delos_grid* grid = NULL;
  CHECK(delos_config_from_text(context, small_yaml, NULL, NULL, &config) == DELOS_SUCCESS);
  CHECK(delos_context_set_progress(context, on_progress, &all) == DELOS_SUCCESS);
  CHECK(delos_context_set_log(context, on_log, &all) == DELOS_SUCCESS);
  CHECK(delos_context_set_threads(context, 2) == DELOS_SUCCESS);
  CHECK(delos_generate(context, config, &grid) == DELOS_SUCCESS);
  CHECK(all.n_progress > 0 && all.n_messages > 0);
  all.to_cancel = context;
  CHECK_FAILS(delos_generate(context, config, &grid), DELOS_ERROR_CANCELLED, context, "");
  CHECK(grid == NULL && strlen(delos_last_error(context)) > 0);
  all.to_cancel = NULL; /* the request is used up */
  CHECK(delos_generate(context, config, &grid) == DELOS_SUCCESS);
  CHECK(delos_context_set_progress(context, NULL, NULL) == DELOS_SUCCESS);
  CHECK(delos_context_cancel(context) == DELOS_SUCCESS);
  CHECK(delos_generate(context, config, &grid) == DELOS_ERROR_CANCELLED);
  CHECK(delos_config_set(config, "require.angle_max", "60.5 deg") == DELOS_SUCCESS);
  CHECK_FAILS(delos_generate(context, config, &grid), DELOS_ERROR_QUALITY, context, "angle_max");
}

/* With a word: prints the digest, for the comparison with other languages. */
static void test_layers(delos_context* context) {
  static const char yaml[] =
      "generator: icosahedral\nsubdivisions: 4\ndata_path: [/none]\n"
      "layers: {kind: z_level, levels: {shape: uniform, n: 5, depth: 5000 m}}\n";
  enum { n_levels = 5, n_cells = 162 };
  static double thickness_m[n_levels * n_cells];
  delos_config* config = NULL;
  delos_grid* grid = NULL;
  const double *interface_m = NULL, *bottom_m = NULL, *ground_m = NULL;
  const int32_t* deepest = NULL;
  int64_t size = 0;
  CHECK(delos_config_from_text(context, yaml, NULL, NULL, &config) == DELOS_SUCCESS);
  CHECK(delos_generate(context, config, &grid) == DELOS_SUCCESS);
  CHECK(delos_grid_level_interface_m(grid, &interface_m, &size) == DELOS_SUCCESS);
  CHECK(size == n_levels + 1 && interface_m[0] == 0.0);
  CHECK(delos_grid_bottom_depth_m(grid, &bottom_m, &size) == DELOS_SUCCESS && size == n_cells);
  CHECK(delos_grid_max_level_cell(grid, &deepest, &size) == DELOS_SUCCESS && size == n_cells);
  CHECK(delos_grid_ground_height_m(grid, &ground_m, &size) == DELOS_SUCCESS && size == 0);
  CHECK(delos_grid_layer_thickness_m(grid, thickness_m, n_levels * n_cells) == DELOS_SUCCESS);
  for (int i = 0; i < n_cells; ++i) {
    double depth_m = 0.0;
    for (int k = 0; k < n_levels; ++k) {
      depth_m += thickness_m[n_levels * i + k];
      CHECK((thickness_m[n_levels * i + k] > 0.0) == (k < deepest[i]));
    }
    CHECK(fabs(depth_m - bottom_m[i]) < 1e-9);
  }
  CHECK(delos_grid_interface_height_m(grid, thickness_m, 3) == DELOS_ERROR_ARGUMENT);
  CHECK(strstr(delos_last_error(grid), "size = 3: must be 972") != NULL);
  CHECK(delos_grid_layer_thickness_m(grid, NULL, n_levels * n_cells) == DELOS_ERROR_ARGUMENT);
  CHECK(delos_grid_destroy(grid) == DELOS_SUCCESS);
  CHECK(delos_config_destroy(config) == DELOS_SUCCESS);
}

int main(int argc, char** argv) {
  delos_context* context = NULL;
  delos_grid* grid = NULL;
  int64_t n_cells = 0, n_edges = 0, n_vertices = 0;
  const char* digest = NULL;
  (void)argv;
  CHECK(delos_abi_version() == DELOS_ABI_VERSION && strchr(delos_version(), '.') != NULL);
  CHECK(strcmp(delos_status_name(DELOS_ERROR_QUALITY), "quality") == 0);
  CHECK(delos_context_create(&context) == DELOS_SUCCESS);
  grid = small_grid(context);
  if (argc > 1) {
    CHECK(delos_grid_digest(grid, &digest) == DELOS_SUCCESS);
    if (digest != NULL) puts(digest);
  } else {
    delos_grid_n_cells(grid, &n_cells);
    delos_grid_n_edges(grid, &n_edges);
    delos_grid_n_vertices(grid, &n_vertices);
    test_counts_and_measures(grid);
    test_shapes(grid, n_cells, n_edges, n_vertices);
    test_connectivity(grid, n_cells);
    test_numbers_and_texts(grid);
    test_config(context);
    test_misuse(context, grid);
    test_callbacks(context);
    test_layers(context);
  }
  CHECK(delos_context_destroy(context) == DELOS_SUCCESS);
  return n_failed == 0 ? 0 : 1;
}
