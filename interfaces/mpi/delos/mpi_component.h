/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef DELOS_MPI_COMPONENT_H
#define DELOS_MPI_COMPONENT_H
/* The grid as a component of a model on many processes; part of delos/delos_mpi.h. What each call
 * does stands in delos/component.h, and in delos/distributed.hpp what is different here.
 *
 *   delos_mpi_component_create_file(comm, "world_ocean.yaml", NULL, &component);
 *   delos_mpi_component_initialize(component);
 *   for (...; delos_clock_advance(clock)) {
 *     delos_mpi_component_set_import(component, "eddy_kinetic_energy", eke, n_owned);
 *     delos_mpi_component_run(component, clock, &is_new);
 *     if (!is_new) continue;
 *     delos_mpi_component_grid(component, &grid);                   my part of the new grid
 *     delos_mpi_component_transfer(component, old, n_old, depth, n_local, NULL);
 *   }
 *   delos_mpi_component_finalize(component);  delos_mpi_component_destroy(component);
 *
 * All is collective but what is marked "here only". What goes wrong on one process fails on all
 * with the same status and text; where a wrong argument keeps one from its call, the others get
 * DELOS_ERROR_STATE. */
#include <delos/delos_mpi.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct delos_mpi_component delos_mpi_component;

/* As delos_mpi_generate_file and its sisters: the file is read by the generating process only, the
 * callback of the options is called whenever a grid is handed out, and *component is made whether
 * they succeed or not. */
DELOS_C_API int delos_mpi_component_create_file(MPI_Comm comm, const char* path,
                                                const delos_mpi_options* options,
                                                delos_mpi_component** component);
DELOS_C_API int delos_mpi_component_create_file_f(MPI_Fint comm, const char* path,
                                                  const delos_mpi_options* options,
                                                  delos_mpi_component** component);
DELOS_C_API int delos_mpi_component_create_text(MPI_Comm comm, const char* yaml, const char* folder,
                                                const delos_mpi_options* options,
                                                delos_mpi_component** component);
DELOS_C_API int delos_mpi_component_create_text_f(MPI_Fint comm, const char* yaml,
                                                  const char* folder,
                                                  const delos_mpi_options* options,
                                                  delos_mpi_component** component);
/* Before MPI_Finalize. NULL is allowed. */
DELOS_C_API int delos_mpi_component_destroy(delos_mpi_component* component);
/* Here only: text of the last call that failed, "" before; valid until the next one. */
DELOS_C_API const char* delos_mpi_component_last_error(const delos_mpi_component* component);

DELOS_C_API int delos_mpi_component_advertise(delos_mpi_component* component);
DELOS_C_API int delos_mpi_component_realize(delos_mpi_component* component);
DELOS_C_API int delos_mpi_component_initialize(delos_mpi_component* component);
/* `is_new_grid` (may be NULL): 1 when the grid was made anew. */
DELOS_C_API int delos_mpi_component_run(delos_mpi_component* component, const delos_clock* clock,
                                        int* is_new_grid);
/* `path` is looked at on the generating process only. */
DELOS_C_API int delos_mpi_component_write_restart(delos_mpi_component* component, const char* path,
                                                  const delos_clock* clock);
DELOS_C_API int delos_mpi_component_read_restart(delos_mpi_component* component, const char* path,
                                                 delos_clock* clock);
DELOS_C_API int delos_mpi_component_finalize(delos_mpi_component* component);

/* After a run that made a new grid, until the next one: values of the former one's cells, owned or
 * all local ones -> values[n_local, n_levels] of the new one's cells. Sizes count numbers. */
DELOS_C_API int delos_mpi_component_transfer(delos_mpi_component* component, const double* former,
                                             int64_t n_former, double* values, int64_t n_values,
                                             const delos_transfer_options* options);
/* Likewise velocities along the normals of edges. */
DELOS_C_API int delos_mpi_component_transfer_velocity(delos_mpi_component* component,
                                                      const double* former, int64_t n_former,
                                                      double* values, int64_t n_values,
                                                      const delos_transfer_options* options);

/* --- here only */

enum { DELOS_MPI_IMPORT = 0, DELOS_MPI_EXPORT = 1 };

typedef struct delos_mpi_item {
  const char* name;          /* valid until the component is destroyed */
  const char* standard_name; /* CF's, or "" */
  const char* units;
  const char* long_name;
  int location; /* DELOS_LOCATION_CELL, ... */
  int n_components;
} delos_mpi_item;

/* The i-th item of a state, from 0; DELOS_ERROR_NOT_FOUND after the last. */
DELOS_C_API int delos_mpi_component_item(delos_mpi_component* component, int intent, int i,
                                         delos_mpi_item* item);
/* Of the places that this process owns, size = n_owned * n_components; copied. The next run judges
 * them, for all. */
DELOS_C_API int delos_mpi_component_set_import(delos_mpi_component* component, const char* name,
                                               const double* values, int64_t size);
/* [n_local, n_components], halo included, or one value of the whole grid; valid until the next run
 * or finalize. `size` may be NULL. */
DELOS_C_API int delos_mpi_component_get_export(delos_mpi_component* component, const char* name,
                                               const double** values, int64_t* size);
/* A handle of this process's part of the current grid, made anew in each call. It keeps the part
 * when the component goes on: destroy it, on all processes. *grid is NULL when there is none. */
DELOS_C_API int delos_mpi_component_grid(delos_mpi_component* component, delos_mpi_grid** grid);
/* Of the current grid, from 1; 0 without one. */
DELOS_C_API int delos_mpi_component_generation(delos_mpi_component* component, int64_t* generation);
/* Where the last run ended; "" before the first. Valid until the next call of this function. */
DELOS_C_API int delos_mpi_component_current_time(delos_mpi_component* component, const char** text);
/* As delos_component_remesh_decision and delos_component_remesh_failure; valid until the next run.
 */
DELOS_C_API int delos_mpi_component_remesh_decision(delos_mpi_component* component,
                                                    const char** text);
DELOS_C_API int delos_mpi_component_remesh_failure(delos_mpi_component* component,
                                                   const char** text);

#ifdef __cplusplus
}
#endif
#endif
