/* SPDX-License-Identifier: BSD-3-Clause */
/* A C99 host on some processes; prints nothing but its failures. */
#include <delos/delos_mpi.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char* const kSmall =
    "sizing: {sources: [{type: constant, spacing: 600 km}]}\nrefine: {tile_vertices: 500}\n";
static const char* const kOcean =
    "generator: icosahedral\nsubdivisions: 4\ndata_path: [/none]\n"
    "layers: {kind: z_level, levels: {shape: uniform, n: 5, depth: 5000 m}}\n";
static int rank, n_ranks, n_failed = 0;

#define CHECK(condition)                                                             \
  do {                                                                               \
    if (!(condition)) {                                                              \
      fprintf(stderr, "rank %d, line %d: not so: %s\n", rank, __LINE__, #condition); \
      ++n_failed;                                                                    \
    }                                                                                \
  } while (0)
#define OK(call) CHECK((call) == DELOS_SUCCESS)

static int north_only(int64_t n_cells, const double* lon_lat, double* weight, void* user_data) {
  ++*(int*)user_data;
  for (int64_t i = 0; i < n_cells; ++i) weight[i] = lon_lat[2 * i + 1] > 0 ? 60.0 : 1.0;
  return 0;
}
static int failing(int64_t n_cells, const double* lon_lat, double* weight, void* user_data) {
  (void)n_cells, (void)lon_lat, (void)weight, (void)user_data;
  return 17;
}

static double sum_over_all(double mine) {
  double all = 0.0;
  MPI_Allreduce(&mine, &all, 1, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
  return all;
}

static void check_part(delos_mpi_grid* grid) {
  int64_t n_owned = 0, n_local = 0, n_global = 0, size = 0, generation = 0;
  const double* area_m2 = NULL;
  const int32_t *id = NULL, *owner = NULL;
  const char* digest = NULL;
  OK(delos_mpi_grid_n_owned(grid, DELOS_MPI_CELL, &n_owned));
  OK(delos_mpi_grid_n_local(grid, DELOS_MPI_CELL, &n_local));
  OK(delos_mpi_grid_n_global(grid, DELOS_MPI_CELL, &n_global));
  OK(delos_mpi_grid_cell_area_m2(grid, &area_m2, &size));
  CHECK(size == n_local);
  OK(delos_mpi_grid_global_id(grid, DELOS_MPI_CELL, &id, NULL));
  OK(delos_mpi_grid_owner(grid, DELOS_MPI_CELL, &owner, NULL));
  OK(delos_mpi_grid_generation(grid, &generation));
  CHECK(generation == 1);
  OK(delos_mpi_grid_digest(grid, &digest));
  CHECK(strlen(digest) == 64);
  double area = 0.0;
  for (int64_t i = 0; i < n_owned; ++i) area += area_m2[i];
  CHECK(fabs(sum_over_all(area) / (4.0 * 3.14159265358979323846 * 6371220.0 * 6371220.0) - 1.0) <
        1e-12);

  double* values = malloc((size_t)n_local * sizeof *values);
  double* whole = malloc((size_t)n_global * sizeof *whole);
  for (int64_t i = 0; i < n_local; ++i) values[i] = i < n_owned ? id[i] : -1.0;
  OK(delos_mpi_exchange(grid, values, n_local, DELOS_MPI_CELL, 1));
  for (int64_t i = 0; i < n_local; ++i) CHECK(values[i] == id[i]);
  for (int64_t i = 0; i < n_local; ++i) CHECK((owner[i] == rank) == (i < n_owned));
  OK(delos_mpi_gather(grid, values, n_owned, DELOS_MPI_CELL, 1, rank == 0 ? whole : NULL));
  for (int64_t i = 0; rank == 0 && i < n_global; ++i) CHECK(whole[i] == (double)i);
  memset(values, 0, (size_t)n_local * sizeof *values);
  OK(delos_mpi_scatter(grid, rank == 0 ? whole : NULL, DELOS_MPI_CELL, 1, values, n_local));
  for (int64_t i = 0; i < n_local; ++i) CHECK(values[i] == id[i]);
  CHECK(delos_mpi_exchange(grid, values, n_local + 1, DELOS_MPI_CELL, 1) == DELOS_ERROR_INPUT);
  CHECK(strstr(delos_mpi_last_error(grid), "the field has") != NULL);
  CHECK(delos_mpi_gather(grid, NULL, 0, DELOS_MPI_CELL, 1, whole) == DELOS_ERROR_INPUT);
  CHECK(delos_mpi_exchange(grid, values, n_local, 7, 1) == DELOS_ERROR_CONFIG);
  CHECK(delos_mpi_grid_cell_area_m2(grid, NULL, NULL) == DELOS_ERROR_ARGUMENT);
  free(values);
  free(whole);
}

static void check_layers(delos_mpi_grid* grid) {
  const double *interface_m = NULL, *bottom_m = NULL;
  const int32_t* deepest = NULL;
  int64_t n_local = 0, size = 0;
  OK(delos_mpi_grid_n_local(grid, DELOS_MPI_CELL, &n_local));
  OK(delos_mpi_grid_level_interface_m(grid, &interface_m, &size));
  CHECK(size == 6 && interface_m[0] == 0.0);
  OK(delos_mpi_grid_bottom_depth_m(grid, &bottom_m, &size));
  CHECK(size == n_local);
  OK(delos_mpi_grid_max_level_cell(grid, &deepest, &size));
  double* thickness_m = malloc((size_t)(5 * n_local) * sizeof *thickness_m);
  OK(delos_mpi_grid_layer_thickness_m(grid, thickness_m, 5 * n_local));
  for (int64_t i = 0; i < n_local; ++i) {
    double depth_m = 0.0;
    for (int64_t k = 0; k < 5; ++k) {
      depth_m += thickness_m[5 * i + k];
      CHECK((thickness_m[5 * i + k] > 0.0) == (k < deepest[i]));
    }
    CHECK(fabs(depth_m - bottom_m[i]) < 1e-9);
  }
  CHECK(delos_mpi_grid_interface_height_m(grid, thickness_m, 5 * n_local) == DELOS_ERROR_ARGUMENT);
  free(thickness_m);
}

/* `made` is where the call that gave `status` left its handle. */
static void check_failure(int status, delos_mpi_grid** made, int expected, const char* says) {
  delos_mpi_grid* const grid = *made;
  int64_t n = 0;
  CHECK(status == expected);
  CHECK(strstr(delos_mpi_last_error(grid), says) != NULL);
  CHECK(delos_mpi_grid_n_local(grid, DELOS_MPI_CELL, &n) == DELOS_ERROR_STATE);
  OK(delos_mpi_grid_destroy(grid));
}

int main(int argc, char** argv) {
  delos_mpi_grid* grid = NULL;
  check_failure(delos_mpi_generate_text(MPI_COMM_WORLD, kSmall, NULL, NULL, &grid), &grid,
                DELOS_ERROR_STATE, "MPI is not initialized");
  MPI_Init(&argc, &argv);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &n_ranks);

  OK(delos_mpi_generate_text(MPI_COMM_WORLD, rank == 0 ? kSmall : NULL, NULL, NULL, &grid));
  check_part(grid);
  OK(delos_mpi_grid_destroy(grid));

  OK(delos_mpi_generate_text(MPI_COMM_WORLD, rank == 0 ? kOcean : NULL, NULL, NULL, &grid));
  check_layers(grid);
  OK(delos_mpi_grid_destroy(grid));

  int n_calls = 0;
  delos_mpi_options options = {0};
  options.root = n_ranks - 1;
  options.halo_layers = 2;
  options.method = DELOS_MPI_CURVE;
  options.cell_weight = north_only;
  options.user_data = &n_calls;
  OK(delos_mpi_generate_text_f(MPI_Comm_c2f(MPI_COMM_WORLD), kSmall, NULL, &options, &grid));
  CHECK(n_calls == (rank == n_ranks - 1 ? 1 : 0));
  OK(delos_mpi_grid_destroy(grid));

  options.cell_weight = failing;
  check_failure(delos_mpi_generate_text(MPI_COMM_WORLD, kSmall, NULL, &options, &grid), &grid,
                DELOS_ERROR_INPUT, "returned 17");
  options.cell_weight = NULL;
  options.work = DELOS_MPI_WORK_LAYERS;
  check_failure(delos_mpi_generate_text(MPI_COMM_WORLD, kSmall, NULL, &options, &grid), &grid,
                DELOS_ERROR_CONFIG, "section layers");
  check_failure(delos_mpi_generate_file(MPI_COMM_WORLD, "/nowhere.yaml", NULL, &grid), &grid,
                DELOS_ERROR_INPUT, "/nowhere.yaml");
  check_failure(delos_mpi_generate_file(MPI_COMM_WORLD, NULL, NULL, &grid), &grid,
                DELOS_ERROR_CONFIG, "path is NULL");
  check_failure(delos_mpi_generate_text(MPI_COMM_NULL, kSmall, NULL, NULL, &grid), &grid,
                DELOS_ERROR_STATE, "MPI_COMM_NULL");
  CHECK(delos_mpi_generate_file(MPI_COMM_WORLD, "x", NULL, NULL) == DELOS_ERROR_ARGUMENT);
  OK(delos_mpi_grid_destroy(NULL));
  MPI_Finalize();
  return n_failed == 0 ? 0 : 1;
}
