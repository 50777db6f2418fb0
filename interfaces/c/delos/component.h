/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef DELOS_COMPONENT_H
#define DELOS_COMPONENT_H
/* The grid as a component of a coupled model, in ESMF's phases; part of delos/delos.h.
 *
 *   delos_clock_create(context, "noleap", "2000-01-01", "PT6H", &clock);
 *   delos_clock_set_stop(clock, "2000-02-01");
 *   delos_component_create(context, config, &component);
 *   delos_component_initialize(component);                      (advertise, then realize)
 *   delos_component_import_state(component, &imports);  delos_component_export_state(...);
 *   for (delos_clock_is_done(clock, &done); !done; delos_clock_is_done(clock, &done)) {
 *     delos_component_run(component, imports, exports, clock);
 *     delos_clock_advance(clock);
 *   }
 *   delos_component_finalize(component);
 *
 * A call in the wrong order is DELOS_ERROR_STATE, whose text says which call is expected; a phase
 * that is done already does nothing when it is repeated; what fails changes nothing. Times and
 * intervals are ISO 8601: "2000-02-29T06:30:00", "P1Y2M10DT2H30M"; one that can't be read or does
 * not exist is DELOS_ERROR_CONFIG. Flags are 0 or 1.
 */
#include <delos/delos.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct delos_component delos_component; /* one instance */
typedef struct delos_state delos_state;         /* its import or export state */
typedef struct delos_field delos_field;         /* an item of a state */
typedef struct delos_clock delos_clock;         /* the host's clock with its alarms */

/* --- clock: its texts are valid until the next call of the same function on the clock */

/* calendar: "gregorian", "julian", "noleap" or "360_day", or CF's names (NULL = gregorian). Without
 * a stop it is never done. */
DELOS_C_API int delos_clock_create(delos_context* context, const char* calendar, const char* start,
                                   const char* step, delos_clock** clock);
/* NULL is allowed. */
DELOS_C_API int delos_clock_destroy(delos_clock* clock);
/* After start and not before the current time, else DELOS_ERROR_CONFIG; NULL = none. */
DELOS_C_API int delos_clock_set_stop(delos_clock* clock, const char* stop);
/* Of all later steps: forward, else DELOS_ERROR_CONFIG; may have months. */
DELOS_C_API int delos_clock_set_step(delos_clock* clock, const char* step);
/* One step, then all alarms are checked. Beyond stop, too; DELOS_ERROR_CONFIG beyond the range of
 * years. */
DELOS_C_API int delos_clock_advance(delos_clock* clock);
/* Whether stop is reached or passed. */
DELOS_C_API int delos_clock_is_done(const delos_clock* clock, int* is_done);
/* Steps since start. */
DELOS_C_API int delos_clock_advance_count(const delos_clock* clock, int64_t* n_steps);
/* "gregorian", "julian", "noleap" or "360_day". */
DELOS_C_API int delos_clock_calendar(const delos_clock* clock, const char** text);
DELOS_C_API int delos_clock_start(const delos_clock* clock, const char** text);
/* "" without one. */
DELOS_C_API int delos_clock_stop(const delos_clock* clock, const char** text);
DELOS_C_API int delos_clock_step(const delos_clock* clock, const char** text);
DELOS_C_API int delos_clock_current(const delos_clock* clock, const char** text);
/* The current time before the last step; after the next one. */
DELOS_C_API int delos_clock_previous(const delos_clock* clock, const char** text);
DELOS_C_API int delos_clock_next(const delos_clock* clock, const char** text);

/* --- alarms of a clock, by id from 0; an unknown id is DELOS_ERROR_STATE */

typedef struct delos_alarm_options {
  const char* ring_time;     /* first; NULL = an interval after the current time */
  const char* interval;      /* from one ring to the next; NULL = rings once, at ring_time */
  const char* ring_duration; /* of one that is not sticky; NULL = one step */
  int32_t not_sticky;        /* 0: rings until it is switched off */
  int32_t disabled;          /* 1: silent until it is enabled */
} delos_alarm_options;
/* One of ring_time and interval must be given; DELOS_ERROR_CONFIG for options that contradict each
 * other. `id` may be NULL. */
DELOS_C_API int delos_clock_add_alarm(delos_clock* clock, const delos_alarm_options* options,
                                      int* id);
DELOS_C_API int delos_clock_n_alarms(const delos_clock* clock, int64_t* n);
DELOS_C_API int delos_alarm_is_ringing(const delos_clock* clock, int id, int* flag);
/* Whether it rang right after the clock's last step but one. */
DELOS_C_API int delos_alarm_was_ringing(const delos_clock* clock, int id, int* flag);
DELOS_C_API int delos_alarm_is_enabled(const delos_clock* clock, int id, int* flag);
DELOS_C_API int delos_alarm_is_sticky(const delos_clock* clock, int id, int* flag);
/* The next one; of an alarm that rings once its only one, past or not. */
DELOS_C_API int delos_alarm_ring_time(const delos_clock* clock, int id, const char** text);
/* Zero when it rings once. */
DELOS_C_API int delos_alarm_interval(const delos_clock* clock, int id, const char** text);
/* Rings again, from its next ring time on. */
DELOS_C_API int delos_alarm_enable(delos_clock* clock, int id);
/* Also stops the ringing; ring times go by unheard. */
DELOS_C_API int delos_alarm_disable(delos_clock* clock, int id);
/* Rings from the clock's current time on; DELOS_ERROR_STATE when it is disabled. */
DELOS_C_API int delos_alarm_ringer_on(delos_clock* clock, int id);
DELOS_C_API int delos_alarm_ringer_off(delos_clock* clock, int id);

/* --- component */

/* With the context's threads as they are now; callbacks and delos_context_cancel of the context
 * serve realize and read_restart. The configuration may be destroyed or changed afterwards. */
DELOS_C_API int delos_component_create(delos_context* context, const delos_config* config,
                                       delos_component** component);
/* Destroys its states and fields, too; grids stay. NULL is allowed. */
DELOS_C_API int delos_component_destroy(delos_component* component);
/* Declares the fields; allocates nothing large, opens no file. */
DELOS_C_API int delos_component_advertise(delos_component* component);
/* Makes the grid, as delos_generate, and fails as that; exports have values from here on. */
DELOS_C_API int delos_component_realize(delos_component* component);
/* Both. */
DELOS_C_API int delos_component_initialize(delos_component* component);
/* From the clock's current time to its next, before the host advances it. The states are the
 * component's own, and a run begins where the last one ended, else DELOS_ERROR_STATE. Exports are
 * then of that time. With a section `remesh` the imports, as they stand, go into its statistics
 * (DELOS_ERROR_INPUT for values that are not finite), and at its alarm the grid may be made anew:
 * compare delos_component_generation. */
DELOS_C_API int delos_component_run(delos_component* component, const delos_state* import_state,
                                    const delos_state* export_state, const delos_clock* clock);
/* Gives the grid back. The component may be initialized again, with the next generation. */
DELOS_C_API int delos_component_finalize(delos_component* component);
/* Grid, clock with alarms, the component's time, generation and configuration in one file: whole or
 * not at all. After realize, and after the host has advanced its clock. DELOS_ERROR_OUTPUT names
 * the path. */
DELOS_C_API int delos_component_write_restart(const delos_component* component, const char* path,
                                              const delos_clock* clock);
/* In the place of realize: goes on to the last bit. `clock`, of the same calendar, becomes the one
 * written, with its alarms. DELOS_ERROR_INPUT names a file that is missing, no restart file, cut
 * off, altered, or of another version or configuration. */
DELOS_C_API int delos_component_read_restart(delos_component* component, const char* path,
                                             delos_clock* clock);
/* Of the current grid, from 1; 0 without one. */
DELOS_C_API int delos_component_generation(const delos_component* component, int64_t* generation);
/* Where the last run ended; "" before the first. Valid until the next call of this function. */
DELOS_C_API int delos_component_current_time(delos_component* component, const char** text);
/* Why the last alarm of section `remesh` made a new grid, or none: one line, with the numbers; ""
 * before the first. Why the remesh that it decided on failed, and the grid stayed; "" when it did
 * not. Valid until the next call of the same function. delos/transfer.h carries the host's fields
 * to a new grid. */
DELOS_C_API int delos_component_remesh_decision(delos_component* component, const char** text);
DELOS_C_API int delos_component_remesh_failure(delos_component* component, const char** text);
/* The same handle as long as the generation is the same. It shares the component's arrays and keeps
 * them when the component goes on or ends: destroy it when it is not used any more. */
DELOS_C_API int delos_component_grid(delos_component* component, delos_grid** grid);
/* Valid until the component is destroyed; empty before advertise. */
DELOS_C_API int delos_component_import_state(delos_component* component, delos_state** state);
DELOS_C_API int delos_component_export_state(delos_component* component, delos_state** state);

/* --- states: items by unique name, in the order of their declaration */

/* Items. */
DELOS_C_API int delos_state_size(const delos_state* state, int64_t* n);
/* Of item i, from 0; valid until the component is destroyed. */
DELOS_C_API int delos_state_name(delos_state* state, int64_t i, const char** name);
/* By name, else by CF standard name. */
DELOS_C_API int delos_state_contains(const delos_state* state, const char* name, int* flag);
/* As delos_state_contains; DELOS_ERROR_NOT_FOUND with the items that there are. The handle of one
 * item is always the same one, and valid until the component is destroyed; asking for it takes it
 * at the current generation of the grid. */
DELOS_C_API int delos_state_field(delos_state* state, const char* name, delos_field** field);

/* --- fields. A handle belongs to the generation at which it was taken: when the component has a
 *     new grid or none, data, bind, store and stamp are DELOS_ERROR_STATE, naming both
 *     generations, until it is taken again. Lat-lon fields don't depend on the grid. */

typedef enum delos_location {
  DELOS_LOCATION_CELL = 0,
  DELOS_LOCATION_EDGE = 1,
  DELOS_LOCATION_VERTEX = 2,
  DELOS_LOCATION_LAT_LON = 3,
  DELOS_LOCATION_GRID = 4 /* one value for the whole grid */
} delos_location;

/* Valid until the component is destroyed. The standard name is CF's, or "". */
DELOS_C_API int delos_field_name(const delos_field* field, const char** text);
DELOS_C_API int delos_field_standard_name(const delos_field* field, const char** text);
DELOS_C_API int delos_field_units(const delos_field* field, const char** text);
DELOS_C_API int delos_field_long_name(const delos_field* field, const char** text);
/* One of delos_location. */
DELOS_C_API int delos_field_location(const delos_field* field, int* location);
/* Values of each place, which stand together. */
DELOS_C_API int delos_field_n_components(const delos_field* field, int64_t* n);
/* Cells or other places; 0 before there is a grid. */
DELOS_C_API int delos_field_n_points(const delos_field* field, int64_t* n);
/* At which the handle was taken; 0 before there was a grid. */
DELOS_C_API int delos_field_generation(const delos_field* field, int64_t* generation);
/* Of the handle's generation. */
DELOS_C_API int delos_field_has_data(const delos_field* field, int* flag);
/* Whether the values are new: made by the component, or stamped. */
DELOS_C_API int delos_field_is_updated(const delos_field* field, int* flag);
/* The model time of the values, "" when nobody said so. Valid until the next call. */
DELOS_C_API int delos_field_time_stamp(delos_field* field, const char** text);
/* [n_points, n_components], no copy; valid until the next generation, or until the host binds or
 * stores other values. `size` may be NULL. */
DELOS_C_API int delos_field_data(const delos_field* field, const double** values, int64_t* size);

/* Imports only; exports belong to the component and are DELOS_ERROR_STATE. A wrong size, or axes
 * that can't be used, are DELOS_ERROR_INPUT. */
/* The values will come as [n_lat, n_lon] on this grid (degrees), not on cells: at least two of
 * each, strictly rising or falling, less than one turn. */
DELOS_C_API int delos_field_place_on_lat_lon(delos_field* field, const double* lon_deg,
                                             int64_t n_lon, const double* lat_deg, int64_t n_lat);
/* Refers to the host's values, which must live until the next bind or store, the next generation or
 * finalize. `size` = n_points * n_components. */
DELOS_C_API int delos_field_bind(delos_field* field, const double* values, int64_t size);
/* As bind, but copies the values. */
DELOS_C_API int delos_field_store(delos_field* field, const double* values, int64_t size);
/* The values are those of this time; calendar as in delos_clock_create. */
DELOS_C_API int delos_field_stamp(delos_field* field, const char* time, const char* calendar);

#ifdef __cplusplus
}
#endif
#endif
