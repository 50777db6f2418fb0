/* SPDX-License-Identifier: BSD-3-Clause */
/* A C99 model whose component remeshes: why it did, and its fields on the new grid. Prints only
 * what fails; with the argument "values": the bits of those that it carried. */
#include <delos/delos.h>
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "c_check.h"

static const char yaml[] =
    "sizing: {sources: [{type: constant, spacing: 900 km}], gradient_limit: 0.3,\n"
    "         resolution: 4 deg, clamp: {min: 300 km, max: 2000 km}}\n"
    "refine: {tile_vertices: 500}\n"
    "remesh:\n"
    "  interval: P2D\n"
    "  sources: [{type: eke, quiet: [0.05 m/s, 900 km], energetic: [0.5 m/s, 500 km]}]\n";

typedef struct model {
  delos_context* context;
  delos_component* component;
  delos_state *imports, *exports;
  delos_clock* clock;
} model;

static model created(void) {
  model made = {NULL, NULL, NULL, NULL, NULL};
  delos_config* config = NULL;
  CHECK(delos_context_create(&made.context) == DELOS_SUCCESS);
  CHECK(delos_config_from_text(made.context, yaml, NULL, NULL, &config) == DELOS_SUCCESS);
  CHECK(delos_component_create(made.context, config, &made.component) == DELOS_SUCCESS);
  CHECK(delos_component_import_state(made.component, &made.imports) == DELOS_SUCCESS);
  CHECK(delos_component_export_state(made.component, &made.exports) == DELOS_SUCCESS);
  CHECK(delos_clock_create(made.context, NULL, "2001-01-01", "P1D", &made.clock) == DELOS_SUCCESS);
  CHECK(delos_component_initialize(made.component) == DELOS_SUCCESS);
  return made;
}

static double* new_values(int64_t n) {
  double* const values = (double*)calloc((size_t)n, sizeof(double));
  CHECK(values != NULL);
  return values;
}

/* A day of a velocity that swings in the north. */
static void run_day(const model* host, int day) {
  delos_grid* grid = NULL;
  delos_field *u = NULL, *v = NULL;
  const double* places = NULL;
  int64_t n = 0;
  CHECK(delos_component_grid(host->component, &grid) == DELOS_SUCCESS);
  CHECK(delos_grid_cell_position(grid, &places, &n) == DELOS_SUCCESS);
  n /= 3;
  double* const values = new_values(n);
  CHECK(delos_state_field(host->imports, "surface_northward_sea_water_velocity", &v) ==
        DELOS_SUCCESS);
  CHECK(delos_field_store(v, values, n) == DELOS_SUCCESS);
  for (int64_t i = 0; i < n; ++i) {
    if (places[3 * i + 2] > 0.6) values[i] = day % 2 == 0 ? 0.6 : -0.6;
  }
  CHECK(delos_state_field(host->imports, "surface_eastward_sea_water_velocity", &u) ==
        DELOS_SUCCESS);
  CHECK(delos_field_store(u, values, n) == DELOS_SUCCESS);
  free(values);
  CHECK(delos_component_run(host->component, host->imports, host->exports, host->clock) ==
        DELOS_SUCCESS);
  CHECK(delos_clock_advance(host->clock) == DELOS_SUCCESS);
}

static double mass(const delos_grid* grid, const double* values, double* least) {
  const double* area_m2 = NULL;
  int64_t n = 0;
  double sum = 0.0;
  CHECK(delos_grid_cell_area_m2(grid, &area_m2, &n) == DELOS_SUCCESS);
  *least = values[0];
  for (int64_t i = 0; i < n; ++i) {
    sum += area_m2[i] * values[i];
    if (values[i] < *least) *least = values[i];
  }
  return sum;
}

/* Depths, 1 + the squared height over the equator. */
static double* depths(const delos_grid* grid, int64_t* n) {
  const double* places = NULL;
  CHECK(delos_grid_cell_position(grid, &places, n) == DELOS_SUCCESS);
  *n /= 3;
  double* const values = new_values(*n);
  for (int64_t i = 0; i < *n; ++i) values[i] = 1.0 + places[3 * i + 2] * places[3 * i + 2];
  return values;
}

static void test_errors(delos_context* context, delos_transfer* transfer, const delos_grid* before,
                        const delos_grid* after) {
  double values[4] = {0.0, 0.0, 0.0, 0.0};
  delos_transfer_options options = {0, 0, 0, 0, 0};
  delos_transfer* none = NULL;
  CHECK(delos_transfer_check(transfer, before, after) == DELOS_SUCCESS);
  CHECK_FAILS(delos_transfer_check(transfer, after, before), DELOS_ERROR_STATE, transfer,
              "generation 2");
  CHECK_FAILS(delos_transfer_apply(transfer, values, 4, values, 4, NULL), DELOS_ERROR_INPUT,
              transfer, "generation 1");
  CHECK_FAILS(delos_transfer_apply(transfer, NULL, 4, values, 4, NULL), DELOS_ERROR_ARGUMENT,
              transfer, "from is NULL");
  CHECK_FAILS(delos_transfer_apply(transfer, values, -1, values, 4, NULL), DELOS_ERROR_ARGUMENT,
              transfer, "must be >= 0");
  options.limiter = 7;
  CHECK_FAILS(delos_transfer_apply(transfer, values, 4, values, 4, &options), DELOS_ERROR_ARGUMENT,
              transfer, "limiter = 7");
  options.limiter = 0;
  options.normalization = 2;
  CHECK_FAILS(delos_transfer_apply(transfer, values, 4, values, 4, &options), DELOS_ERROR_ARGUMENT,
              transfer, "normalization = 2");
  options.normalization = 0;
  options.velocity = -1;
  CHECK_FAILS(delos_transfer_apply_velocity(transfer, values, 4, values, 4, &options),
              DELOS_ERROR_ARGUMENT, transfer, "velocity = -1");
  CHECK(delos_transfer_create(NULL, before, after, &none) == DELOS_ERROR_ARGUMENT);
  CHECK_FAILS(delos_transfer_create(context, NULL, after, &none), DELOS_ERROR_ARGUMENT, context,
              "from is NULL");
  CHECK(delos_context_cancel(context) == DELOS_SUCCESS);
  CHECK(delos_transfer_create(context, before, after, &none) == DELOS_ERROR_CANCELLED);
  CHECK(none == NULL);
}

/* Its bits. */
static void show(double value) {
  uint64_t bits = 0;
  memcpy(&bits, &value, sizeof bits);
  printf("%016" PRIX64 "\n", bits);
}

static void test_values(const delos_transfer* transfer, const delos_grid* before,
                        const delos_grid* after, int is_shown) {
  int64_t n_before = 0, n_after = 0, n_edges_before = 0, n_edges_after = 0, n = 0;
  double least_before = 0.0, least_after = 0.0;
  delos_transfer_options options = {0, 0, DELOS_VELOCITY_STREAM_FUNCTION, 0, 0};
  double *old = depths(before, &n_before), *wanted = depths(after, &n_after);
  double* depth = new_values(n_after);
  CHECK(delos_transfer_n_overlaps(transfer, &n) == DELOS_SUCCESS && n >= n_after);
  CHECK(delos_transfer_n_unchanged(transfer, &n) == DELOS_SUCCESS && n > 0 && n < n_after);
  CHECK(delos_transfer_n_unmapped(transfer, &n) == DELOS_SUCCESS && n == 0);
  CHECK(delos_transfer_apply(transfer, old, n_before, depth, n_after, NULL) == DELOS_SUCCESS);
  CHECK(fabs(mass(after, depth, &least_after) / mass(before, old, &least_before) - 1.0) < 1e-14);
  CHECK(least_after >= least_before);
  for (int64_t i = 0; i < n_after; ++i) {
    CHECK(fabs(depth[i] - wanted[i]) < 0.03);
    if (is_shown) show(depth[i]);
  }
  CHECK(delos_grid_n_edges(before, &n_edges_before) == DELOS_SUCCESS);
  CHECK(delos_grid_n_edges(after, &n_edges_after) == DELOS_SUCCESS);
  double *u = new_values(n_edges_before), *u_after = new_values(n_edges_after);
  u[0] = 1.0;
  CHECK(delos_transfer_apply_velocity(transfer, u, n_edges_before, u_after, n_edges_after,
                                      &options) == DELOS_SUCCESS);
  CHECK(mass(after, u_after, &least_after) != 0.0);
  options.velocity = DELOS_VELOCITY_HELMHOLTZ;
  double* diverging = new_values(n_edges_after);
  CHECK(delos_transfer_apply_velocity(transfer, u, n_edges_before, diverging, n_edges_after,
                                      &options) == DELOS_SUCCESS);
  CHECK(memcmp(diverging, u_after, (size_t)n_edges_after * sizeof(double)) != 0);
  free(diverging);
  free(u_after);
  free(u);
  free(depth);
  free(wanted);
  free(old);
}

static delos_grid* grid_of(delos_context* context, delos_config* config) {
  delos_grid* grid = NULL;
  CHECK(delos_generate(context, config, &grid) == DELOS_SUCCESS);
  return grid;
}

/* From the cells of a disc to those of the whole sphere. */
static void test_border(delos_context* context) {
  delos_config* config = NULL;
  delos_transfer* transfer = NULL;
  delos_transfer_options options = {0, 0, 0, 0, DELOS_NORMALIZATION_WHOLE};
  const double *part_m2 = NULL, *whole_m2 = NULL;
  double covered_m2 = 0.0, all_m2 = 0.0;
  int64_t n_part = 0, n_whole = 0, n_bare = 0, n_nan = 0;
  CHECK(delos_config_from_text(context,
                               "sizing: {sources: [{type: constant, spacing: 900 km}]}\n"
                               "refine: {tile_vertices: 500}\n",
                               NULL, NULL, &config) == DELOS_SUCCESS);
  delos_grid* const whole = grid_of(context, config);
  CHECK(delos_config_set(config, "region", "{disc: {centre: [10 deg, 50 deg], radius: 3000 km}}") ==
        DELOS_SUCCESS);
  CHECK(delos_config_set(config, "sizing.sources.0.spacing", "500 km") == DELOS_SUCCESS);
  delos_grid* const part = grid_of(context, config);
  CHECK(delos_transfer_create(context, part, whole, &transfer) == DELOS_SUCCESS);
  CHECK(delos_grid_cell_area_m2(part, &part_m2, &n_part) == DELOS_SUCCESS);
  CHECK(delos_grid_cell_area_m2(whole, &whole_m2, &n_whole) == DELOS_SUCCESS);
  CHECK(delos_transfer_n_unmapped(transfer, &n_bare) == DELOS_SUCCESS && n_bare > 0 &&
        n_bare < n_whole);
  double *ones = new_values(n_part), *means = new_values(n_whole), *shares = new_values(n_whole);
  for (int64_t i = 0; i < n_part; ++i) {
    ones[i] = 1.0;
    all_m2 += part_m2[i];
  }
  CHECK(delos_transfer_apply(transfer, ones, n_part, means, n_whole, NULL) == DELOS_SUCCESS);
  CHECK(delos_transfer_apply(transfer, ones, n_part, shares, n_whole, &options) == DELOS_SUCCESS);
  for (int64_t i = 0; i < n_whole; ++i) {
    CHECK(isnan(means[i]) ? isnan(shares[i]) : means[i] == 1.0 && shares[i] <= 1.0);
    if (isnan(means[i])) {
      ++n_nan;
    } else {
      covered_m2 += whole_m2[i] * shares[i];
    }
  }
  CHECK(n_nan == n_bare);
  CHECK(fabs(covered_m2 / all_m2 - 1.0) < 1e-13);
  options.limiter = DELOS_LIMITER_ASSURED_SUM;
  CHECK_FAILS(delos_transfer_apply(transfer, ones, n_part, means, n_whole, &options),
              DELOS_ERROR_INPUT, transfer, "border");
  free(shares);
  free(means);
  free(ones);
  CHECK(delos_transfer_destroy(transfer) == DELOS_SUCCESS);
}

int main(int argc, char** argv) {
  const int is_shown = argc == 2 && strcmp(argv[1], "values") == 0;
  delos_grid *before = NULL, *after = NULL, *shared = NULL;
  delos_context* other = NULL;
  delos_transfer* transfer = NULL;
  const char *text = NULL, *digest = NULL;
  const model host = created();
  CHECK(delos_component_grid(host.component, &before) == DELOS_SUCCESS);
  CHECK(delos_component_remesh_decision(host.component, &text) == DELOS_SUCCESS &&
        strcmp(text, "") == 0);
  run_day(&host, 0);
  run_day(&host, 1);
  CHECK(delos_component_remesh_decision(host.component, &text) == DELOS_SUCCESS &&
        strstr(text, "remesh") != NULL);
  CHECK(delos_component_remesh_failure(host.component, &text) == DELOS_SUCCESS &&
        strcmp(text, "") == 0);
  CHECK(delos_component_grid(host.component, &after) == DELOS_SUCCESS);
  CHECK(after != before);

  /* The transfer and a shared handle outlive the model. */
  CHECK(delos_context_create(&other) == DELOS_SUCCESS);
  CHECK(delos_grid_share(other, before, &shared) == DELOS_SUCCESS);
  CHECK(delos_transfer_create(other, before, after, &transfer) == DELOS_SUCCESS);
  CHECK(delos_grid_digest(after, &digest) == DELOS_SUCCESS && strlen(digest) == 64);
  test_errors(other, transfer, before, after);
  test_values(transfer, before, after, is_shown);
  CHECK(delos_grid_destroy(before) == DELOS_SUCCESS);
  CHECK(delos_context_destroy(host.context) == DELOS_SUCCESS);
  CHECK(delos_grid_digest(shared, &digest) == DELOS_SUCCESS && strlen(digest) == 64);
  if (!is_shown) test_border(other);
  CHECK(delos_transfer_destroy(transfer) == DELOS_SUCCESS);
  CHECK_FAILS(delos_transfer_check(transfer, shared, shared), DELOS_ERROR_STATE, transfer,
              "destroyed");
  CHECK(delos_context_destroy(other) == DELOS_SUCCESS);
  return n_failed == 0 ? 0 : 1;
}
