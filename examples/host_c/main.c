/* SPDX-License-Identifier: BSD-3-Clause */
/* A C model that makes its grid when it starts: no file between configuration and arrays. */
#include <delos/delos.h>
#include <stdio.h>

/* One place that looks at every status. */
static int failed(int status, const void* handle) {
  if (status == DELOS_SUCCESS) return 0;
  fprintf(stderr, "host_c: %s: %s\n", delos_status_name(status), delos_last_error(handle));
  return 1;
}

static void show_progress(const delos_progress* progress, void* user_data) {
  (void)user_data;
  fprintf(stderr, "\r%-12s %10lld", progress->phase, (long long)progress->done);
}

/* What a model does with the arrays; here it sums them up. */
static int use(const delos_grid* grid) {
  const double *area_m2 = NULL, *distance_m = NULL;
  const int32_t* cells_on_edge = NULL;
  int64_t n_cells = 0, n_edges = 0;
  double total_m2 = 0.0, shortest_m = 1e30;
  int64_t first = 0;
  if (failed(delos_grid_n_edges(grid, &n_edges), grid)) return 1;
  if (failed(delos_grid_cell_area_m2(grid, &area_m2, &n_cells), grid)) return 1;
  if (failed(delos_grid_cell_distance_m(grid, &distance_m, NULL), grid)) return 1;
  if (failed(delos_grid_cells_on_edge(grid, &cells_on_edge, NULL), grid)) return 1;
  for (int64_t cell = 0; cell < n_cells; ++cell) total_m2 += area_m2[cell];
  for (int64_t edge = 0; edge < n_edges; ++edge) {
    if (distance_m[edge] < shortest_m) {
      shortest_m = distance_m[edge];
      first = edge;
    }
  }
  printf("cells: %lld\ntotal area: %.10e m2\n", (long long)n_cells, total_m2);
  printf("closest cells: %ld and %ld, %.1f km\n", (long)cells_on_edge[2 * first],
         (long)cells_on_edge[2 * first + 1], shortest_m / 1000.0);
  return 0;
}

int main(int argc, char** argv) {
  delos_context* context = NULL;
  delos_config* config = NULL;
  delos_grid* grid = NULL;
  int status = 1;
  if (argc != 2) {
    fprintf(stderr, "usage: host_c CONFIG.yaml\n");
    return 2;
  }
  if (delos_abi_version() != DELOS_ABI_VERSION) {
    fprintf(stderr, "host_c: compiled for another libdelos than %s\n", delos_version());
    return 1;
  }
  if (failed(delos_context_create(&context), context)) return 1;
  delos_context_set_progress(context, show_progress, NULL);
  if (!failed(delos_config_from_file(context, argv[1], &config), context) &&
      !failed(delos_generate(context, config, &grid), context)) {
    fprintf(stderr, "\n");
    status = use(grid);
  }
  delos_context_destroy(context); /* with the configuration and the grid */
  return status;
}
