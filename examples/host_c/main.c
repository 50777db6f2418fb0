/* SPDX-License-Identifier: BSD-3-Clause */
/* A C model that makes its grid when it starts and takes delos along as a component: no file
 * between configuration and arrays. */
#include <delos/delos.h>
#include <stdio.h>
#include <stdlib.h>

/* The model: its component, and one velocity a cell. */
typedef struct model {
  delos_component* component;
  delos_state *imports, *exports;
  delos_clock* clock;
  double* u_m_s;
  int64_t n_cells;
} model;

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

/* Hands the model's velocity to the component without a copy. */
static int couple(model* host) {
  delos_field* u = NULL;
  if (failed(delos_state_field(host->imports, "surface_eastward_sea_water_velocity", &u),
             host->imports))
    return 1;
  if (failed(delos_field_n_points(u, &host->n_cells), u)) return 1;
  host->u_m_s = calloc((size_t)host->n_cells, sizeof *host->u_m_s);
  return host->u_m_s == NULL || failed(delos_field_bind(u, host->u_m_s, host->n_cells), u);
}

/* One day of the model, then the component's; fields are taken from the state where they are used,
 * as each belongs to one generation of the grid. */
static int step(model* host) {
  delos_field* latitude = NULL;
  const double* lat_deg = NULL;
  if (failed(delos_state_field(host->exports, "cell_latitude", &latitude), host->exports)) return 1;
  if (failed(delos_field_data(latitude, &lat_deg, NULL), latitude)) return 1;
  for (int64_t i = 0; i < host->n_cells; ++i) host->u_m_s[i] += 1e-3 * (45.0 - lat_deg[i]) / 45.0;
  if (failed(delos_component_run(host->component, host->imports, host->exports, host->clock),
             host->component))
    return 1;
  return failed(delos_clock_advance(host->clock), host->clock);
}

static int simulate(model* host) {
  const delos_alarm_options weekly = {.interval = "P7D"};
  delos_grid* grid = NULL;
  const char* now = NULL;
  int alarm = 0, is_done = 0, is_ringing = 0;
  if (failed(delos_component_initialize(host->component), host->component)) return 1;
  fprintf(stderr, "\n");
  if (failed(delos_component_grid(host->component, &grid), host->component) || use(grid)) return 1;
  if (failed(delos_component_import_state(host->component, &host->imports), host->component) ||
      failed(delos_component_export_state(host->component, &host->exports), host->component) ||
      couple(host))
    return 1;
  if (failed(delos_clock_set_stop(host->clock, "2000-03-14"), host->clock)) return 1;
  if (failed(delos_clock_add_alarm(host->clock, &weekly, &alarm), host->clock)) return 1;
  while (!failed(delos_clock_is_done(host->clock, &is_done), host->clock) && !is_done) {
    if (step(host)) return 1;
    if (failed(delos_alarm_is_ringing(host->clock, alarm, &is_ringing), host->clock)) return 1;
    if (!is_ringing) continue;
    delos_alarm_ringer_off(host->clock, alarm);
    delos_clock_current(host->clock, &now);
    printf("%s: %.4f m/s in the first cell\n", now, host->u_m_s[0]);
  }
  return failed(delos_component_finalize(host->component), host->component);
}

int main(int argc, char** argv) {
  delos_context* context = NULL;
  delos_config* config = NULL;
  model host = {NULL, NULL, NULL, NULL, NULL, 0};
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
      !failed(delos_component_create(context, config, &host.component), context) &&
      !failed(delos_clock_create(context, "noleap", "2000-02-28", "P1D", &host.clock), context)) {
    status = simulate(&host);
  }
  delos_context_destroy(context); /* with all that was made in it */
  free(host.u_m_s);
  return status;
}
