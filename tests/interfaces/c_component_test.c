/* SPDX-License-Identifier: BSD-3-Clause */
/* A C99 model with delos as its component: phases, states, clock, restart, wrong orders, cycles.
 * Prints only what fails. Its argument: a restart file to write. */
#include <delos/delos.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "c_check.h"
#if defined(__GLIBC__) && (__GLIBC__ > 2 || __GLIBC_MINOR__ >= 33)
#define DELOS_HAS_MALLINFO2
#include <malloc.h>
#endif

static const char yaml[] =
    "sizing: {sources: [{type: constant, spacing: 1500 km}]}\n"
    "refine: {tile_vertices: 500}\n";
static const char u_name[] = "surface_eastward_sea_water_velocity";

/* A component with all that its host has of it. */
typedef struct model {
  delos_context* context;
  delos_component* component;
  delos_state *imports, *exports;
  delos_clock* clock;
} model;

static delos_config* config_of(delos_context* context) {
  delos_config* config = NULL;
  CHECK(delos_config_from_text(context, yaml, NULL, NULL, &config) == DELOS_SUCCESS);
  return config;
}

static model created(int n_threads) {
  model made = {NULL, NULL, NULL, NULL, NULL};
  CHECK(delos_context_create(&made.context) == DELOS_SUCCESS);
  CHECK(delos_context_set_threads(made.context, n_threads) == DELOS_SUCCESS);
  delos_config* const config = config_of(made.context);
  CHECK(delos_component_create(made.context, config, &made.component) == DELOS_SUCCESS);
  CHECK(delos_config_destroy(config) == DELOS_SUCCESS);
  CHECK(delos_component_import_state(made.component, &made.imports) == DELOS_SUCCESS);
  CHECK(delos_component_export_state(made.component, &made.exports) == DELOS_SUCCESS);
  CHECK(delos_clock_create(made.context, "noleap", "2000-02-27", "P1D", &made.clock) ==
        DELOS_SUCCESS);
  CHECK(delos_clock_set_stop(made.clock, "2000-03-03") == DELOS_SUCCESS);
  return made;
}

static int run(const model* host) {
  return delos_component_run(host->component, host->imports, host->exports, host->clock);
}

static void step(const model* host) {
  CHECK(run(host) == DELOS_SUCCESS);
  CHECK(delos_clock_advance(host->clock) == DELOS_SUCCESS);
}

static const char* digest_of(const model* host) {
  delos_grid* grid = NULL;
  const char* text = "";
  CHECK(delos_component_grid(host->component, &grid) == DELOS_SUCCESS);
  CHECK(delos_grid_digest(grid, &text) == DELOS_SUCCESS);
  return text;
}

/* Whether the call gives this text in `text`. */
#define IS_TEXT(call, text, wanted) \
  ((call) == DELOS_SUCCESS && (text) != NULL && strcmp(text, wanted) == 0)

static void test_clock(delos_context* context) {
  delos_clock* clock = NULL;
  const char *text = NULL, *other = NULL;
  int flag = -1, id = -1;
  int64_t n = -1;
  CHECK_FAILS(delos_clock_create(context, NULL, "2001-02-29", "P1D", &clock), DELOS_ERROR_CONFIG,
              context, "2001-02-29");
  CHECK_FAILS(delos_clock_create(context, "lunar", "2001-02-28", "P1D", &clock), DELOS_ERROR_CONFIG,
              context, "lunar");
  CHECK_FAILS(delos_clock_create(context, NULL, "2001-02-28", "-P1D", &clock), DELOS_ERROR_CONFIG,
              context, "step");
  CHECK_FAILS(delos_clock_create(context, NULL, NULL, "P1D", &clock), DELOS_ERROR_ARGUMENT, context,
              "start is NULL");
  CHECK(clock == NULL);
  CHECK(delos_clock_create(context, NULL, "2000-01-31", "P1M", &clock) == DELOS_SUCCESS);
  CHECK(IS_TEXT(delos_clock_calendar(clock, &text), text, "gregorian"));
  CHECK(IS_TEXT(delos_clock_stop(clock, &text), text, ""));
  CHECK(IS_TEXT(delos_clock_step(clock, &text), text, "P0Y1M0DT0H0M0S"));
  CHECK(IS_TEXT(delos_clock_next(clock, &text), text, "2000-02-29T00:00:00"));
  CHECK(IS_TEXT(delos_clock_current(clock, &other), other, "2000-01-31T00:00:00"));
  CHECK(strcmp(text, "2000-02-29T00:00:00") == 0); /* each function keeps its own text */
  CHECK_FAILS(delos_clock_set_stop(clock, "1999-01-01"), DELOS_ERROR_CONFIG, clock, "1999-01-01");
  CHECK(delos_clock_set_stop(clock, "2000-03-01") == DELOS_SUCCESS);
  const delos_alarm_options monthly = {.interval = "P1M"};
  const delos_alarm_options once = {.ring_time = "2000-03-29", .not_sticky = 1};
  const delos_alarm_options nothing = {NULL, NULL, NULL, 0, 0};
  CHECK(delos_clock_add_alarm(clock, &monthly, &id) == DELOS_SUCCESS && id == 0);
  CHECK(delos_clock_add_alarm(clock, &once, NULL) == DELOS_SUCCESS);
  CHECK_FAILS(delos_clock_add_alarm(clock, &nothing, &id), DELOS_ERROR_CONFIG, clock, "neither");
  CHECK(id == 0 && delos_clock_n_alarms(clock, &n) == DELOS_SUCCESS && n == 2);
  CHECK(delos_alarm_is_sticky(clock, 1, &flag) == DELOS_SUCCESS && flag == 0);
  CHECK(delos_clock_advance(clock) == DELOS_SUCCESS);
  CHECK(delos_alarm_is_ringing(clock, 0, &flag) == DELOS_SUCCESS && flag == 1);
  CHECK(delos_alarm_is_ringing(clock, 1, &flag) == DELOS_SUCCESS && flag == 0);
  CHECK(delos_clock_is_done(clock, &flag) == DELOS_SUCCESS && flag == 0);
  CHECK(delos_alarm_ringer_off(clock, 0) == DELOS_SUCCESS);
  CHECK(IS_TEXT(delos_alarm_ring_time(clock, 0, &text), text, "2000-03-29T00:00:00"));
  CHECK(delos_clock_advance(clock) == DELOS_SUCCESS);
  CHECK(delos_alarm_is_ringing(clock, 1, &flag) == DELOS_SUCCESS && flag == 1);
  CHECK(delos_alarm_was_ringing(clock, 0, &flag) == DELOS_SUCCESS && flag == 1);
  CHECK(delos_clock_is_done(clock, &flag) == DELOS_SUCCESS && flag == 1);
  CHECK(IS_TEXT(delos_clock_previous(clock, &text), text, "2000-02-29T00:00:00"));
  CHECK(delos_clock_advance_count(clock, &n) == DELOS_SUCCESS && n == 2);
  CHECK(delos_alarm_disable(clock, 0) == DELOS_SUCCESS);
  CHECK_FAILS(delos_alarm_ringer_on(clock, 0), DELOS_ERROR_STATE, clock, "disabled");
  CHECK(delos_alarm_enable(clock, 0) == DELOS_SUCCESS);
  CHECK(delos_alarm_ringer_on(clock, 0) == DELOS_SUCCESS);
  CHECK(delos_alarm_is_enabled(clock, 0, &flag) == DELOS_SUCCESS && flag == 1);
  CHECK_FAILS(delos_alarm_is_ringing(clock, 2, &flag), DELOS_ERROR_STATE, clock, "no alarm 2");
  CHECK_FAILS(delos_alarm_interval(clock, -1, &text), DELOS_ERROR_STATE, clock, "no alarm -1");
  CHECK(text == NULL);
  CHECK_FAILS(delos_clock_is_done(clock, NULL), DELOS_ERROR_ARGUMENT, clock, "flag is NULL");
  CHECK(delos_clock_destroy(clock) == DELOS_SUCCESS && delos_clock_destroy(NULL) == DELOS_SUCCESS);
  CHECK_FAILS(delos_clock_advance(clock), DELOS_ERROR_STATE, clock, "destroyed");
}

/* Every call in every stage: what is allowed there and what is not. */
static void test_orders(void) {
  const model host = created(1);
  delos_component* const component = host.component;
  delos_grid* grid = NULL;
  const char* text = NULL;
  int64_t n = -1;
  CHECK(delos_state_size(host.exports, &n) == DELOS_SUCCESS && n == 0);
  CHECK(delos_component_generation(component, &n) == DELOS_SUCCESS && n == 0);
  CHECK(IS_TEXT(delos_component_current_time(component, &text), text, ""));
  const char advertise_first[] = "expected: initialize(advertise)";
  CHECK_FAILS(delos_component_realize(component), DELOS_ERROR_STATE, component, advertise_first);
  CHECK_FAILS(run(&host), DELOS_ERROR_STATE, component, advertise_first);
  CHECK_FAILS(delos_component_finalize(component), DELOS_ERROR_STATE, component, advertise_first);
  CHECK_FAILS(delos_component_grid(component, &grid), DELOS_ERROR_STATE, component,
              advertise_first);
  CHECK_FAILS(delos_component_write_restart(component, "a.nc", host.clock), DELOS_ERROR_STATE,
              component, advertise_first);
  CHECK_FAILS(delos_component_read_restart(component, "a.nc", host.clock), DELOS_ERROR_STATE,
              component, advertise_first);
  CHECK(delos_component_advertise(component) == DELOS_SUCCESS);
  CHECK(delos_component_advertise(component) == DELOS_SUCCESS);
  CHECK_FAILS(run(&host), DELOS_ERROR_STATE, component, "expected: initialize(realize)");
  CHECK_FAILS(delos_component_grid(component, &grid), DELOS_ERROR_STATE, component, "advertised");
  CHECK_FAILS(delos_component_write_restart(component, "a.nc", host.clock), DELOS_ERROR_STATE,
              component, "advertised");
  CHECK(delos_component_realize(component) == DELOS_SUCCESS);
  CHECK(delos_component_realize(component) == DELOS_SUCCESS);
  CHECK_FAILS(delos_component_advertise(component), DELOS_ERROR_STATE, component,
              "expected: run or finalize");
  CHECK_FAILS(delos_component_read_restart(component, "a.nc", host.clock), DELOS_ERROR_STATE,
              component, "realized");
  CHECK_FAILS(delos_component_run(component, host.exports, host.imports, host.clock),
              DELOS_ERROR_STATE, component, "import state");
  CHECK_FAILS(delos_component_run(component, host.imports, NULL, host.clock), DELOS_ERROR_ARGUMENT,
              component, "export_state is NULL");
  CHECK_FAILS(
      delos_component_run(component, host.imports, host.exports, (delos_clock*)host.imports),
      DELOS_ERROR_STATE, component, "clock is no clock");
  CHECK(run(&host) == DELOS_SUCCESS);
  CHECK_FAILS(run(&host), DELOS_ERROR_STATE, component, "stands at 2000-02-28");
  CHECK_FAILS(delos_component_initialize(component), DELOS_ERROR_STATE, component, "running");
  CHECK_FAILS(delos_component_write_restart(component, "a.nc", host.clock), DELOS_ERROR_STATE,
              component, "advance the clock");
  CHECK(delos_component_finalize(component) == DELOS_SUCCESS);
  CHECK(delos_component_finalize(component) == DELOS_SUCCESS);
  CHECK_FAILS(run(&host), DELOS_ERROR_STATE, component, "finalized");
  CHECK(delos_component_initialize(component) == DELOS_SUCCESS);
  CHECK(delos_component_generation(component, &n) == DELOS_SUCCESS && n == 2);
  CHECK(delos_context_destroy(host.context) == DELOS_SUCCESS);
}

static void test_states(void) {
  const model host = created(2);
  delos_field *area = NULL, *u = NULL, *energy = NULL;
  const double *values = NULL, *areas = NULL;
  const char* text = NULL;
  int64_t n = -1, n_cells = 0;
  int flag = -1;
  delos_grid *grid = NULL, *same = NULL;
  CHECK(delos_component_advertise(host.component) == DELOS_SUCCESS);
  CHECK(delos_state_size(host.exports, &n) == DELOS_SUCCESS && n == 5);
  CHECK(IS_TEXT(delos_state_name(host.exports, 0, &text), text, "cell_area"));
  CHECK_FAILS(delos_state_name(host.exports, 5, &text), DELOS_ERROR_ARGUMENT, host.exports,
              "5 items");
  CHECK(delos_state_contains(host.exports, "longitude", &flag) == DELOS_SUCCESS && flag == 1);
  CHECK(delos_state_contains(host.exports, "salt", &flag) == DELOS_SUCCESS && flag == 0);
  CHECK_FAILS(delos_state_field(host.exports, "salt", &area), DELOS_ERROR_NOT_FOUND, host.exports,
              "it has cell_area, ");
  CHECK(area == NULL && DELOS_ERROR_NOT_FOUND == 41);
  CHECK(delos_state_field(host.exports, "cell_area", &area) == DELOS_SUCCESS);
  CHECK_FAILS(delos_field_data(area, &values, &n), DELOS_ERROR_STATE, area, "no grid");
  CHECK(delos_component_realize(host.component) == DELOS_SUCCESS);
  CHECK_FAILS(delos_field_data(area, &values, &n), DELOS_ERROR_STATE, area, "generation 1");
  CHECK(delos_field_has_data(area, &flag) == DELOS_SUCCESS && flag == 0);
  delos_field* const before = area;
  CHECK(delos_state_field(host.exports, "cell_area", &area) == DELOS_SUCCESS && area == before);
  CHECK(delos_component_grid(host.component, &grid) == DELOS_SUCCESS);
  CHECK(delos_component_grid(host.component, &same) == DELOS_SUCCESS && same == grid);
  CHECK(delos_grid_cell_area_m2(grid, &areas, &n_cells) == DELOS_SUCCESS);
  CHECK(delos_field_data(area, &values, &n) == DELOS_SUCCESS);
  CHECK(values == areas && n == n_cells && n_cells > 100); /* no copy */
  CHECK(delos_field_n_points(area, &n) == DELOS_SUCCESS && n == n_cells);
  CHECK(delos_field_n_components(area, &n) == DELOS_SUCCESS && n == 1);
  CHECK(delos_field_generation(area, &n) == DELOS_SUCCESS && n == 1);
  CHECK(delos_field_location(area, &flag) == DELOS_SUCCESS && flag == DELOS_LOCATION_CELL);
  CHECK(IS_TEXT(delos_field_name(area, &text), text, "cell_area"));
  CHECK(IS_TEXT(delos_field_standard_name(area, &text), text, "cell_area"));
  CHECK(IS_TEXT(delos_field_units(area, &text), text, "m2"));
  CHECK(delos_field_long_name(area, &text) == DELOS_SUCCESS && strlen(text) > 0);
  CHECK(IS_TEXT(delos_field_time_stamp(area, &text), text, ""));
  CHECK_FAILS(delos_field_stamp(area, "2000-01-01", NULL), DELOS_ERROR_STATE, area, "belongs");
  CHECK_FAILS(delos_field_bind(area, values, n_cells), DELOS_ERROR_STATE, area, "only imports");

  double* const own = calloc((size_t)n_cells, sizeof *own);
  CHECK(delos_state_field(host.imports, u_name, &u) == DELOS_SUCCESS);
  CHECK_FAILS(delos_field_bind(u, own, n_cells - 1), DELOS_ERROR_INPUT, u, "needs");
  CHECK_FAILS(delos_field_bind(u, NULL, n_cells), DELOS_ERROR_ARGUMENT, u, "values is NULL");
  CHECK_FAILS(delos_field_store(u, own, -1), DELOS_ERROR_ARGUMENT, u, "size = -1");
  CHECK(delos_field_bind(u, own, n_cells) == DELOS_SUCCESS);
  CHECK(delos_field_data(u, &values, NULL) == DELOS_SUCCESS && values == own);
  CHECK(delos_field_store(u, own, n_cells) == DELOS_SUCCESS);
  CHECK(delos_field_data(u, &values, NULL) == DELOS_SUCCESS && values != own);
  CHECK(delos_field_stamp(u, "2000-02-27", "noleap") == DELOS_SUCCESS);
  CHECK(delos_field_is_updated(u, &flag) == DELOS_SUCCESS && flag == 1);
  CHECK(IS_TEXT(delos_field_time_stamp(u, &text), text, "2000-02-27T00:00:00"));
  const double lon_deg[] = {0.0, 120.0, 240.0}, lat_deg[] = {-45.0, 45.0};
  CHECK(delos_state_field(host.imports, "eddy_kinetic_energy", &energy) == DELOS_SUCCESS);
  CHECK_FAILS(delos_field_place_on_lat_lon(energy, lon_deg, 1, lat_deg, 2), DELOS_ERROR_INPUT,
              energy, "lon_deg");
  CHECK(delos_field_place_on_lat_lon(energy, lon_deg, 3, lat_deg, 2) == DELOS_SUCCESS);
  CHECK(delos_field_location(energy, &flag) == DELOS_SUCCESS && flag == DELOS_LOCATION_LAT_LON);
  CHECK(delos_field_store(energy, own, 6) == DELOS_SUCCESS);
  step(&host);
  CHECK(IS_TEXT(delos_field_time_stamp(area, &text), text, "2000-02-28T00:00:00"));
  CHECK(IS_TEXT(delos_component_current_time(host.component, &text), text, "2000-02-28T00:00:00"));
  free(own);

  CHECK(delos_component_finalize(host.component) == DELOS_SUCCESS);
  CHECK_FAILS(delos_field_data(area, &values, &n), DELOS_ERROR_STATE, area, "finalized");
  CHECK(delos_grid_cell_area_m2(grid, &values, &n) == DELOS_SUCCESS && values == areas);
  CHECK(delos_component_initialize(host.component) == DELOS_SUCCESS);
  CHECK(delos_component_grid(host.component, &same) == DELOS_SUCCESS && same != grid);
  CHECK(delos_grid_destroy(same) == DELOS_SUCCESS);
  CHECK(delos_component_grid(host.component, &same) == DELOS_SUCCESS);
  CHECK(delos_grid_generation(same, &n) == DELOS_SUCCESS && n == 2);
  CHECK(delos_component_destroy(host.component) == DELOS_SUCCESS);
  CHECK(delos_component_destroy(NULL) == DELOS_SUCCESS);
  CHECK_FAILS(run(&host), DELOS_ERROR_STATE, host.component, "destroyed");
  CHECK_FAILS(delos_state_size(host.exports, &n), DELOS_ERROR_STATE, host.exports, "destroyed");
  CHECK_FAILS(delos_field_data(area, &values, &n), DELOS_ERROR_STATE, area, "destroyed");
  CHECK_FAILS(delos_field_data((delos_field*)host.clock, &values, &n), DELOS_ERROR_STATE,
              host.clock, "is a clock, it must be a field");
  CHECK(delos_grid_destroy(same) == DELOS_SUCCESS && delos_grid_destroy(grid) == DELOS_SUCCESS);
  CHECK(delos_context_destroy(host.context) == DELOS_SUCCESS);
}

static void test_restart(const char* path) {
  const model first = created(1), second = created(2);
  const delos_alarm_options every_two = {.interval = "P2D"};
  const char *text = NULL, *other = NULL;
  int flag = -1;
  CHECK(delos_clock_add_alarm(first.clock, &every_two, NULL) == DELOS_SUCCESS);
  CHECK(delos_component_initialize(first.component) == DELOS_SUCCESS);
  step(&first);
  step(&first);
  CHECK_FAILS(delos_component_write_restart(first.component, "no such folder/a.nc", first.clock),
              DELOS_ERROR_OUTPUT, first.component, "no such folder");
  CHECK(delos_component_write_restart(first.component, path, first.clock) == DELOS_SUCCESS);
  CHECK(delos_component_advertise(second.component) == DELOS_SUCCESS);
  CHECK_FAILS(delos_component_read_restart(second.component, "nowhere.nc", second.clock),
              DELOS_ERROR_INPUT, second.component, "nowhere.nc");
  CHECK(delos_component_read_restart(second.component, path, second.clock) == DELOS_SUCCESS);
  CHECK(IS_TEXT(delos_clock_current(second.clock, &text), text, "2000-03-01T00:00:00"));
  CHECK(delos_alarm_is_ringing(second.clock, 0, &flag) == DELOS_SUCCESS && flag == 1);
  while (delos_clock_is_done(second.clock, &flag) == DELOS_SUCCESS && flag == 0) {
    step(&first);
    step(&second);
  }
  CHECK(delos_clock_current(first.clock, &other) == DELOS_SUCCESS);
  CHECK(IS_TEXT(delos_clock_current(second.clock, &text), text, other));
  CHECK(strcmp(digest_of(&first), digest_of(&second)) == 0);
  CHECK(delos_context_destroy(first.context) == DELOS_SUCCESS);
  CHECK(delos_context_destroy(second.context) == DELOS_SUCCESS);
}

static void test_cancel(void) {
  const model host = created(1);
  CHECK(delos_component_advertise(host.component) == DELOS_SUCCESS);
  CHECK(delos_context_cancel(host.context) == DELOS_SUCCESS);
  CHECK(delos_component_realize(host.component) == DELOS_ERROR_CANCELLED);
  CHECK(delos_component_realize(host.component) == DELOS_SUCCESS); /* the request is used up */
  CHECK(delos_context_destroy(host.context) == DELOS_SUCCESS);
}

/* Bytes in use; 0 where the C library does not tell. */
static size_t bytes_in_use(void) {
#ifdef DELOS_HAS_MALLINFO2
  return mallinfo2().uordblks;
#else
  return 0;
#endif
}

/* A whole life; the grid is made on wish. */
static void live(delos_context* context, const delos_config* config, int with_grid) {
  delos_component* component = NULL;
  delos_clock* clock = NULL;
  delos_state *imports = NULL, *exports = NULL;
  delos_field* area = NULL;
  CHECK(delos_component_create(context, config, &component) == DELOS_SUCCESS);
  CHECK(delos_clock_create(context, NULL, "2000-01-01", "PT1H", &clock) == DELOS_SUCCESS);
  CHECK(delos_component_advertise(component) == DELOS_SUCCESS);
  CHECK(delos_component_import_state(component, &imports) == DELOS_SUCCESS);
  CHECK(delos_component_export_state(component, &exports) == DELOS_SUCCESS);
  if (with_grid) {
    CHECK(delos_component_realize(component) == DELOS_SUCCESS);
    CHECK(delos_component_run(component, imports, exports, clock) == DELOS_SUCCESS);
  }
  CHECK(delos_state_field(exports, "cell_area", &area) == DELOS_SUCCESS);
  CHECK(delos_component_finalize(component) == DELOS_SUCCESS);
  CHECK(delos_clock_destroy(clock) == DELOS_SUCCESS);
  CHECK(delos_component_destroy(component) == DELOS_SUCCESS);
}

/* Neither within one context nor with one each does memory grow. */
static void test_cycles(void) {
  enum { n_cycles = 1000, n_warm_up = 200, n_bytes = 40000 };
  delos_context* shared = NULL;
  size_t begin = 0, end = 0;
  CHECK(delos_context_create(&shared) == DELOS_SUCCESS);
  const delos_config* const config = config_of(shared);
  for (int i = 0; i < n_warm_up + n_cycles; ++i) {
    if (i == n_warm_up) begin = bytes_in_use();
    live(shared, config, i % 100 == 0); /* a grid in one of a hundred */
    delos_context* own = NULL;
    CHECK(delos_context_create(&own) == DELOS_SUCCESS);
    const delos_config* const again = config_of(own);
    live(own, again, i % 100 == 50);
    CHECK(delos_context_destroy(own) == DELOS_SUCCESS);
  }
  end = bytes_in_use();
  if (end > begin + n_bytes) {
    fprintf(stderr, "%d cycles left %zu bytes more\n", n_cycles, end - begin);
    ++n_failed;
  }
  CHECK(delos_context_destroy(shared) == DELOS_SUCCESS);
}

/* For a tool that counts what is lost. */
static void live_often(int n_cycles) {
  for (int i = 0; i < n_cycles; ++i) {
    delos_context* context = NULL;
    CHECK(delos_context_create(&context) == DELOS_SUCCESS);
    live(context, config_of(context), 1);
    CHECK(delos_context_destroy(context) == DELOS_SUCCESS);
  }
}

/*   c_model RESTART_FILE        all tests
 *   c_model cycles N            N lives, nothing else */
int main(int argc, char** argv) {
  delos_context* context = NULL;
  if (argc == 3 && strcmp(argv[1], "cycles") == 0) {
    live_often(atoi(argv[2]));
    return n_failed == 0 ? 0 : 1;
  }
  if (argc != 2) return 2;
  CHECK(delos_context_create(&context) == DELOS_SUCCESS);
  test_clock(context);
  CHECK(delos_context_destroy(context) == DELOS_SUCCESS);
  test_orders();
  test_states();
  test_restart(argv[1]);
  test_cancel();
  test_cycles();
  remove(argv[1]);
  return n_failed == 0 ? 0 : 1;
}
