/* SPDX-License-Identifier: BSD-3-Clause */
/* A C99 model on some processes: a component that remeshes and restarts; prints nothing but its
 * failures.
 *   mpiexec -n N mpi_c_model RESTART_FILE */
#include <delos/delos_mpi.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char* const kConfig =
    "sizing: {sources: [{type: constant, spacing: 1200 km}], gradient_limit: 0.3,\n"
    "         resolution: 4 deg, clamp: {min: 300 km, max: 2000 km}}\n"
    "refine: {tile_vertices: 500}\n"
    "remesh:\n"
    "  interval: P2D\n"
    "  sources: [{type: eke, quiet: [0.05 m/s, 1200 km], energetic: [0.5 m/s, 500 km]}]\n";
static const char* const kEast = "surface_eastward_sea_water_velocity";
static const char* const kNorth = "surface_northward_sea_water_velocity";
static int rank, n_ranks, n_failed = 0;

#define CHECK(condition)                                                             \
  do {                                                                               \
    if (!(condition)) {                                                              \
      fprintf(stderr, "rank %d, line %d: not so: %s\n", rank, __LINE__, #condition); \
      ++n_failed;                                                                    \
    }                                                                                \
  } while (0)
#define OK(call) CHECK((call) == DELOS_SUCCESS)

typedef struct model {
  delos_context* context;
  delos_clock* clock;
  delos_mpi_component* component;
} model;

static void start(model* it, int root) {
  delos_mpi_options options = {0};
  options.n_threads = 1;
  options.root = root;
  OK(delos_context_create(&it->context));
  OK(delos_clock_create(it->context, NULL, "2001-01-01", "P1D", &it->clock));
  OK(delos_mpi_component_create_text(MPI_COMM_WORLD, rank == root ? kConfig : NULL, NULL, &options,
                                     &it->component));
}

static void stop(model* it) {
  OK(delos_mpi_component_destroy(it->component));
  OK(delos_context_destroy(it->context));
}

/* A day of currents to and fro in the north; whether there is a new grid. */
static int run_day(model* it) {
  delos_mpi_grid* grid = NULL;
  const double* position = NULL;
  int64_t n_owned = 0, day = 0;
  int is_new = 0;
  OK(delos_clock_advance_count(it->clock, &day));
  OK(delos_mpi_component_grid(it->component, &grid));
  OK(delos_mpi_grid_n_owned(grid, DELOS_MPI_CELL, &n_owned));
  OK(delos_mpi_grid_cell_position(grid, &position, NULL));
  double* values = calloc((size_t)n_owned, sizeof *values);
  OK(delos_mpi_component_set_import(it->component, kNorth, values, n_owned));
  for (int64_t i = 0; i < n_owned; ++i) {
    values[i] = position[3 * i + 2] > 0.0 ? (day % 2 == 0 ? 0.6 : -0.6) : 0.0;
  }
  OK(delos_mpi_component_set_import(it->component, kEast, values, n_owned));
  OK(delos_mpi_component_run(it->component, it->clock, &is_new));
  OK(delos_clock_advance(it->clock));
  free(values);
  OK(delos_mpi_grid_destroy(grid));
  return is_new;
}

static void check_items(delos_mpi_component* component) {
  delos_mpi_item item;
  const double* area_m2 = NULL;
  const double* generation = NULL;
  int64_t n = 0, size = 0;
  delos_mpi_grid* grid = NULL;
  OK(delos_mpi_component_item(component, DELOS_MPI_EXPORT, 0, &item));
  CHECK(strcmp(item.name, "cell_area") == 0 && strcmp(item.units, "m2") == 0);
  CHECK(item.location == DELOS_LOCATION_CELL && item.n_components == 1);
  OK(delos_mpi_component_item(component, DELOS_MPI_IMPORT, 2, &item));
  CHECK(strcmp(item.name, "eddy_kinetic_energy") == 0);
  CHECK(delos_mpi_component_item(component, DELOS_MPI_IMPORT, 3, &item) == DELOS_ERROR_NOT_FOUND);
  CHECK(delos_mpi_component_item(component, 7, 0, &item) == DELOS_ERROR_ARGUMENT);
  OK(delos_mpi_component_grid(component, &grid));
  OK(delos_mpi_grid_n_local(grid, DELOS_MPI_CELL, &n));
  OK(delos_mpi_component_get_export(component, "cell_area", &area_m2, &size));
  CHECK(size == n && area_m2[0] > 0.0 && area_m2[n - 1] > 0.0);
  OK(delos_mpi_component_get_export(component, "grid_generation", &generation, &size));
  CHECK(size == 1 && generation[0] == 1.0);
  OK(delos_mpi_grid_destroy(grid));
}

/* A constant stays one, and a velocity of none. */
static void check_transfer(delos_mpi_component* component, int64_t n_cells, int64_t n_edges) {
  delos_mpi_grid* grid = NULL;
  int64_t n = 0, n_new_edges = 0;
  delos_transfer_options options = {0};
  OK(delos_mpi_component_grid(component, &grid));
  OK(delos_mpi_grid_n_local(grid, DELOS_MPI_CELL, &n));
  OK(delos_mpi_grid_n_local(grid, DELOS_MPI_EDGE, &n_new_edges));
  double* former = malloc((size_t)(n_cells + n_edges) * sizeof *former);
  double* values = malloc((size_t)(n + n_new_edges) * sizeof *values);
  for (int64_t i = 0; i < n_cells; ++i) former[i] = 7.25;
  options.order = DELOS_ORDER_FIRST;
  OK(delos_mpi_component_transfer(component, former, n_cells, values, n, &options));
  for (int64_t i = 0; i < n; ++i) CHECK(values[i] == 7.25);
  for (int64_t i = 0; i < n_edges; ++i) former[i] = 0.0;
  OK(delos_mpi_component_transfer_velocity(component, former, n_edges, values, n_new_edges, NULL));
  for (int64_t i = 0; i < n_new_edges; ++i) CHECK(values[i] == 0.0);
  CHECK(delos_mpi_component_transfer(component, former, n_cells, values, n + 1, NULL) ==
        DELOS_ERROR_ARGUMENT);
  options.order = 9;
  const int is_wrong = rank == n_ranks - 1;
  const int status = delos_mpi_component_transfer(component, former, n_cells, values, n,
                                                  is_wrong ? &options : NULL);
  CHECK(status == (is_wrong ? DELOS_ERROR_ARGUMENT : DELOS_ERROR_STATE));
  CHECK(strstr(delos_mpi_component_last_error(component),
               is_wrong ? "order = 9" : "arguments that can't be used") != NULL);
  free(former);
  free(values);
  OK(delos_mpi_grid_destroy(grid));
}

static void check_errors(model* it) {
  const char* text = NULL;
  CHECK(delos_mpi_component_run(it->component, NULL, NULL) == DELOS_ERROR_ARGUMENT);
  CHECK(strstr(delos_mpi_component_last_error(it->component), "clock is NULL") != NULL);
  OK(delos_mpi_component_current_time(it->component, &text));
  CHECK(strcmp(text, "") == 0);
  CHECK(delos_mpi_component_set_import(it->component, "x", NULL, 0) == DELOS_ERROR_STATE);
  OK(delos_mpi_component_set_import(it->component, kEast, NULL, 0));
  CHECK(delos_mpi_component_run(it->component, it->clock, NULL) == DELOS_ERROR_INPUT);
  CHECK(strstr(delos_mpi_component_last_error(it->component), "process 0 gave 0 values") != NULL);
}

int main(int argc, char** argv) {
  model first, second;
  int64_t generation = 0, n_cells = 0, n_edges = 0;
  delos_mpi_grid *before = NULL, *after = NULL;
  const char *text = NULL, *digest = NULL, *expected = NULL;
  if (argc < 2) return 2;
  MPI_Init(&argc, &argv);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &n_ranks);

  start(&first, 0);
  CHECK(delos_mpi_component_run(first.component, first.clock, NULL) == DELOS_ERROR_STATE);
  CHECK(strstr(delos_mpi_component_last_error(first.component), "is created") != NULL);
  CHECK(delos_mpi_component_grid(first.component, &before) == DELOS_ERROR_STATE && before == NULL);
  OK(delos_mpi_component_advertise(first.component));
  OK(delos_mpi_component_realize(first.component));
  OK(delos_mpi_component_initialize(first.component));
  check_items(first.component);
  check_errors(&first);
  CHECK(run_day(&first) == 0);
  OK(delos_mpi_component_write_restart(first.component, argv[1], first.clock));
  OK(delos_mpi_component_grid(first.component, &before));
  OK(delos_mpi_grid_n_owned(before, DELOS_MPI_CELL, &n_cells));
  OK(delos_mpi_grid_n_owned(before, DELOS_MPI_EDGE, &n_edges));
  CHECK(run_day(&first) == 1);
  check_transfer(first.component, n_cells, n_edges);
  OK(delos_mpi_component_generation(first.component, &generation));
  CHECK(generation == 2);
  OK(delos_mpi_component_remesh_decision(first.component, &text));
  CHECK(strstr(text, "remesh at 2001-01-03") != NULL);
  OK(delos_mpi_component_remesh_failure(first.component, &text));
  CHECK(strcmp(text, "") == 0);

  start(&second, n_ranks - 1);
  OK(delos_mpi_component_advertise(second.component));
  MPI_Barrier(MPI_COMM_WORLD);
  OK(delos_mpi_component_read_restart(second.component, argv[1], second.clock));
  OK(delos_clock_current(second.clock, &text));
  CHECK(strcmp(text, "2001-01-02T00:00:00") == 0);
  CHECK(run_day(&second) == 1);
  OK(delos_mpi_component_grid(first.component, &after));
  OK(delos_mpi_grid_digest(after, &expected));
  OK(delos_mpi_grid_destroy(before));
  OK(delos_mpi_component_grid(second.component, &before));
  OK(delos_mpi_grid_digest(before, &digest));
  CHECK(strcmp(digest, expected) == 0);
  OK(delos_mpi_grid_destroy(before));
  OK(delos_mpi_component_finalize(second.component));
  stop(&second);
  stop(&first);
  /* A part outlives its component. */
  OK(delos_mpi_grid_n_owned(after, DELOS_MPI_CELL, &n_cells));
  CHECK(n_cells > 0);
  OK(delos_mpi_grid_destroy(after));

  CHECK(delos_mpi_component_create_file(MPI_COMM_WORLD, "/nowhere.yaml", NULL, &first.component) ==
        DELOS_ERROR_INPUT);
  CHECK(strstr(delos_mpi_component_last_error(first.component), "/nowhere.yaml") != NULL);
  CHECK(delos_mpi_component_finalize(first.component) == DELOS_ERROR_STATE);
  OK(delos_mpi_component_destroy(first.component));
  MPI_Finalize();
  return n_failed == 0 ? 0 : 1;
}
