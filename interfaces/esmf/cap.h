/* SPDX-License-Identifier: BSD-3-Clause */
/* What the NUOPC cap asks of delos, phase by phase, in C: no type of ESMF or MPI. Not installed.
 *
 * Every function returns a code of ESMF: 0, or what delos::esmf_code says; delos_cap_message has
 * the text. Pointers handed out are valid until the next phase. */
#ifndef DELOS_CAP_H
#define DELOS_CAP_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct delos_cap delos_cap;

enum { DELOS_CAP_IMPORT = 0, DELOS_CAP_EXPORT = 1 };

typedef struct delos_cap_item {
  const char* name; /* also the name in NUOPC's field dictionary */
  const char* units;
} delos_cap_item;

/* What ESMF_MeshCreate wants of one process: its cells as elements, and their corners as nodes. Ids
 * from 1, over all processes; element_nodes counts this process's nodes from 1. The element type
 * is the number of corners, which run counter-clockwise. */
typedef struct delos_cap_mesh {
  int32_t n_nodes, n_elements, n_corners;
  const int32_t* node_ids;        /* [n_nodes] */
  const int32_t* node_owners;     /* [n_nodes] process, from 0 */
  const double* node_lon_lat_deg; /* [n_nodes, 2] */
  const int32_t* element_ids;     /* [n_elements] ascending, and above those of lower processes */
  const int32_t* element_corners; /* [n_elements] */
  const int32_t* element_nodes;   /* [n_corners] */
  const double* element_area;     /* [n_elements] square radians: 4 pi over the whole sphere */
  const double* element_lon_lat_deg; /* [n_elements, 2] */
} delos_cap_mesh;

/* A time as ESMF_TimeGet takes it apart: the last two are a fraction of a second. */
typedef struct delos_cap_time {
  int64_t year, month, day, hour, minute, second, numerator, denominator;
} delos_cap_time;

/* Reads the configuration. *cap is a cap even after a failure, for its message; null without
 * memory. */
int delos_cap_create(const char* config_file, delos_cap** cap);
/* Null does nothing. */
void delos_cap_destroy(delos_cap* cap);
/* Of the last failure; never null. */
const char* delos_cap_message(const delos_cap* cap);

int delos_cap_advertise(delos_cap* cap);
/* The index-th item, from 0; 41 (ESMF_RC_NOT_FOUND), without a message, after the last. */
int delos_cap_get_item(delos_cap* cap, int intent, int index, delos_cap_item* item);
/* Makes the grid on the first process and this process's part of the mesh. `communicator` is MPI's
 * Fortran handle, the component's own; without MPI it is not looked at. Collective, as are
 * set_import, advance and finalize: what fails on one process fails on all. */
int delos_cap_realize(delos_cap* cap, int communicator, int n_processes);
int delos_cap_get_mesh(delos_cap* cap, delos_cap_mesh* mesh);
/* The process's values of an export, [n_elements]. */
int delos_cap_get_export(delos_cap* cap, const char* name, double* values, int64_t n_values);
/* The process's values of an import, [n_elements]; copied. */
int delos_cap_set_import(delos_cap* cap, const char* name, const double* values, int64_t n_values);
/* The mesh stays when the grid is made anew here: cell_spacing becomes the mean of the new grid's
 * over each element, grid_generation its number, and imports are carried to it conservatively.
 * From one time to a later one; `calendar` is 0 gregorian, 1 julian, 2 noleap, 3 360_day. */
int delos_cap_advance(delos_cap* cap, const delos_cap_time* from, const delos_cap_time* until,
                      int calendar);
/* Of the grid, on every process; 0 without one. */
int64_t delos_cap_generation(const delos_cap* cap);
int delos_cap_finalize(delos_cap* cap);

#ifdef __cplusplus
}
#endif

#endif
