/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef DELOS_DELOS_MPI_H
#define DELOS_DELOS_MPI_H
/* delos over MPI, for C99: a grid made once by one process of a communicator, handed out part by
 * part. A component of a model over MPI, delos/mpi_component.h, is included at the end.
 *
 *   delos_mpi_grid* grid;  const double* area_m2;  int64_t n;
 *   if (delos_mpi_generate_file(comm, "world_ocean.yaml", NULL, &grid) != DELOS_SUCCESS)
 *     puts(delos_mpi_last_error(grid));
 *   delos_mpi_grid_cell_area_m2(grid, &area_m2, &n);         owned cells first, then the halo
 *   delos_mpi_exchange(grid, thickness_m, n, DELOS_MPI_CELL, 1);
 *   delos_mpi_grid_destroy(grid);
 *
 * Every function but delos_mpi_last_error returns a delos_status of delos.h. The host starts and
 * ends MPI; delos works with a duplicate of the communicator, in the calling thread. What is
 * marked collective is called by all processes of it, and fails for all with the same text. */
#include <mpi.h>
#include <stdint.h>

#include "delos/delos.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct delos_mpi_grid delos_mpi_grid;

enum { DELOS_MPI_CELL = 0, DELOS_MPI_EDGE = 1, DELOS_MPI_VERTEX = 2 };
/* automatic: kway where delos was built with METIS, else curve (pieces of a Hilbert curve) */
enum { DELOS_MPI_AUTOMATIC = 0, DELOS_MPI_KWAY = 1, DELOS_MPI_CURVE = 2 };
/* What a cell counts. automatic: its wet layers where the configuration has a section `layers` of
 * an ocean, else each cell the same; layers without such a section is DELOS_ERROR_CONFIG */
enum { DELOS_MPI_WORK_AUTOMATIC = 0, DELOS_MPI_WORK_CELLS = 1, DELOS_MPI_WORK_LAYERS = 2 };

/* The work of each cell into weight[n_cells] (finite, >= 0), from lon_lat
 * [n_cells, 2] in radians. Called on the generating process; not 0 = it failed. */
typedef int (*delos_mpi_weight_callback)(int64_t n_cells, const double* lon_lat, double* weight,
                                         void* user_data);

/* Zeros are the defaults. root and halo_layers must be the same everywhere. */
typedef struct delos_mpi_options {
  int n_threads;   /* of the generating process; 0 = what the configuration says */
  int root;        /* rank of the generating process */
  int halo_layers; /* 0 = 1 */
  int method;      /* DELOS_MPI_AUTOMATIC, ... */
  delos_mpi_weight_callback cell_weight; /* NULL = as `work` says */
  void* user_data;
  int work; /* DELOS_MPI_WORK_AUTOMATIC, ... */
} delos_mpi_options;

/* Collective. The file is read by the generating process only; `path`, `yaml` and `folder` (NULL =
 * ".") are looked at there only. `options` may be NULL. *grid is made whether they succeed or not,
 * unless memory lacks (then NULL): it holds the text of the error, and is to be destroyed. Never
 * NULL for `grid`. The functions ending in _f take a Fortran communicator. */
DELOS_C_API int delos_mpi_generate_file(MPI_Comm comm, const char* path,
                                        const delos_mpi_options* options, delos_mpi_grid** grid);
DELOS_C_API int delos_mpi_generate_file_f(MPI_Fint comm, const char* path,
                                          const delos_mpi_options* options, delos_mpi_grid** grid);
DELOS_C_API int delos_mpi_generate_text(MPI_Comm comm, const char* yaml, const char* folder,
                                        const delos_mpi_options* options, delos_mpi_grid** grid);
DELOS_C_API int delos_mpi_generate_text_f(MPI_Fint comm, const char* yaml, const char* folder,
                                          const delos_mpi_options* options, delos_mpi_grid** grid);
/* Collective, before MPI_Finalize. NULL is allowed. */
DELOS_C_API int delos_mpi_grid_destroy(delos_mpi_grid* grid);
/* Text of the last call on this grid that failed, "" before; valid until the next one. */
DELOS_C_API const char* delos_mpi_last_error(const delos_mpi_grid* grid);

/* --- the part */

/* Of DELOS_MPI_CELL, _EDGE or _VERTEX: owned and halo; owned, the first ones; of the whole grid. */
DELOS_C_API int delos_mpi_grid_n_local(delos_mpi_grid* grid, int location, int64_t* n);
DELOS_C_API int delos_mpi_grid_n_owned(delos_mpi_grid* grid, int location, int64_t* n);
DELOS_C_API int delos_mpi_grid_n_global(delos_mpi_grid* grid, int location, int64_t* n);
/* 1 for a fresh grid; grows when a component rebuilds it. */
DELOS_C_API int delos_mpi_grid_generation(delos_mpi_grid* grid, int64_t* generation);
/* SHA-256 of the whole grid in 64 hex digits; valid until the grid is destroyed. */
DELOS_C_API int delos_mpi_grid_digest(delos_mpi_grid* grid, const char** text);

/* Arrays: *values points into the part, valid until it is destroyed; *size is the number of values,
 * and `size` may be NULL. Ids are local with base 0, -1 beyond the halo; global ids have base 0. */
#define DELOS_MPI_LIST(name, type)                                                               \
  DELOS_C_API int delos_mpi_grid_##name(delos_mpi_grid* grid, int location, const type** values, \
                                        int64_t* size);
DELOS_MPI_LIST(global_id, int32_t)     /* [n_local] */
DELOS_MPI_LIST(owner, int32_t)         /* [n_local] rank */
DELOS_MPI_LIST(layer_offsets, int64_t) /* [n_layers + 1] layer l: [l] .. [l + 1] - 1; 0 is owned */
DELOS_MPI_LIST(neighbours, int32_t)    /* [n_neighbours] ranks to exchange with, ascending */
DELOS_MPI_LIST(send_offsets, int64_t)  /* [n_neighbours + 1] into send_ids */
DELOS_MPI_LIST(send_ids, int32_t)      /* local ids that a neighbour needs */
DELOS_MPI_LIST(receive_offsets, int64_t) /* [n_neighbours + 1] into receive_ids */
DELOS_MPI_LIST(receive_ids, int32_t)     /* local ids that come from it */
#undef DELOS_MPI_LIST

/* As the functions of the same names of delos.h, [n_local] of their kind. */
#define DELOS_MPI_ARRAY(name, type) \
  DELOS_C_API int delos_mpi_grid_##name(delos_mpi_grid* grid, const type** values, int64_t* size);
DELOS_MPI_ARRAY(cell_position, double)
DELOS_MPI_ARRAY(edge_position, double)
DELOS_MPI_ARRAY(vertex_position, double)
DELOS_MPI_ARRAY(cell_lon_lat, double)
DELOS_MPI_ARRAY(edge_lon_lat, double)
DELOS_MPI_ARRAY(vertex_lon_lat, double)
DELOS_MPI_ARRAY(cell_offsets, int64_t)
DELOS_MPI_ARRAY(edges_on_cell, int32_t)
DELOS_MPI_ARRAY(vertices_on_cell, int32_t)
DELOS_MPI_ARRAY(cells_on_cell, int32_t)
DELOS_MPI_ARRAY(cells_on_edge, int32_t)
DELOS_MPI_ARRAY(vertices_on_edge, int32_t)
DELOS_MPI_ARRAY(cells_on_vertex, int32_t)
DELOS_MPI_ARRAY(edges_on_vertex, int32_t)
DELOS_MPI_ARRAY(edge_offsets, int64_t)
DELOS_MPI_ARRAY(edges_on_edge, int32_t)
DELOS_MPI_ARRAY(weights_on_edge, double)
DELOS_MPI_ARRAY(cell_area_m2, double)
DELOS_MPI_ARRAY(cell_spacing_m, double)
DELOS_MPI_ARRAY(edge_spacing_m, double)
DELOS_MPI_ARRAY(cell_ring, int32_t)
DELOS_MPI_ARRAY(triangle_area_m2, double)
DELOS_MPI_ARRAY(kite_area_m2, double)
DELOS_MPI_ARRAY(cell_distance_m, double)
DELOS_MPI_ARRAY(vertex_distance_m, double)
DELOS_MPI_ARRAY(edge_angle_rad, double)
DELOS_MPI_ARRAY(level_interface_m, double) /* [n_levels + 1], as ground_influence */
DELOS_MPI_ARRAY(max_level_cell, int32_t)
DELOS_MPI_ARRAY(bottom_depth_m, double)
DELOS_MPI_ARRAY(ground_height_m, double)
DELOS_MPI_ARRAY(ground_influence, double)
#undef DELOS_MPI_ARRAY
/* Into values[n_local, n_levels] and [n_local, n_levels + 1]; `size` counts the numbers. */
DELOS_C_API int delos_mpi_grid_layer_thickness_m(delos_mpi_grid* grid, double* values,
                                                 int64_t size);
DELOS_C_API int delos_mpi_grid_interface_height_m(delos_mpi_grid* grid, double* values,
                                                  int64_t size);

/* --- fields: [n_local, n_components], owned ones first. `size` counts numbers. Collective. */

/* Sets the halo to the owners' values. A wrong size is refused where it is, not elsewhere. */
DELOS_C_API int delos_mpi_exchange(delos_mpi_grid* grid, double* values, int64_t size, int location,
                                   int n_components);
DELOS_C_API int delos_mpi_exchange_float(delos_mpi_grid* grid, float* values, int64_t size,
                                         int location, int n_components);
DELOS_C_API int delos_mpi_exchange_int32(delos_mpi_grid* grid, int32_t* values, int64_t size,
                                         int location, int n_components);
/* The owned or all local values -> whole[n_global, n_components] on the generating process, where
 * alone `whole` is looked at. */
DELOS_C_API int delos_mpi_gather(delos_mpi_grid* grid, const double* values, int64_t size,
                                 int location, int n_components, double* whole);
/* And back, into values[n_local, n_components]. */
DELOS_C_API int delos_mpi_scatter(delos_mpi_grid* grid, const double* whole, int location,
                                  int n_components, double* values, int64_t size);

#ifdef __cplusplus
}
#endif

#include <delos/mpi_component.h>
#endif
