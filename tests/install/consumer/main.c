/* SPDX-License-Identifier: BSD-3-Clause */
/* The same through the C header: a grid, its area, and an error. */
#include <delos/delos.h>
#include <stdio.h>

static const char yaml[] =
    "surface: {shape: sphere, radius: 6371.22 km}\n"
    "sizing: {sources: [{type: constant, spacing: 600 km}]}\n";

int main(void) {
  delos_context* context = NULL;
  delos_config* config = NULL;
  delos_grid* grid = NULL;
  const double* area_m2 = NULL;
  int64_t n_cells = 0;
  double total_m2 = 0.0;
  if (delos_abi_version() != DELOS_ABI_VERSION) return 1;
  if (delos_context_create(&context) != DELOS_SUCCESS) return 1;
  if (delos_config_from_text(context, yaml, NULL, NULL, &config) != DELOS_SUCCESS ||
      delos_generate(context, config, &grid) != DELOS_SUCCESS) {
    fprintf(stderr, "%s\n", delos_last_error(context));
    return 1;
  }
  if (delos_grid_cell_area_m2(grid, &area_m2, &n_cells) != DELOS_SUCCESS) return 1;
  for (int64_t i = 0; i < n_cells; ++i) total_m2 += area_m2[i];
  printf("in C: %lld cells, total area %.10g m2\n", (long long)n_cells, total_m2);
  if (n_cells < 1000 || total_m2 < 5.1e14 || total_m2 > 5.11e14) return 1;
  if (delos_config_set(config, "sizing.sorces", "1") == DELOS_SUCCESS &&
      delos_config_check(config) != DELOS_ERROR_CONFIG) {
    return 1;
  }
  printf("a typo is refused: %s\n", delos_last_error(config));
  return delos_context_destroy(context);
}
