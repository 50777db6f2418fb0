/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef DELOS_TRANSFER_H
#define DELOS_TRANSFER_H
/* Fields of one grid on another: a model's state after its component has made a new grid; part of
 * delos/delos.h.
 *
 *   delos_component_grid(component, &before);
 *   delos_component_run(component, imports, exports, clock);
 *   delos_component_grid(component, &after);
 *   if (after != before) {                                   (a handle for each generation)
 *     delos_transfer_create(context, before, after, &transfer);
 *     delos_transfer_apply(transfer, old_depth, n_before, depth, n_after, NULL);
 *     delos_transfer_destroy(transfer);
 *     delos_grid_destroy(before);
 *   }
 */
#include <delos/delos.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct delos_transfer delos_transfer; /* from one grid to another, for many fields */

enum {
  DELOS_ORDER_SECOND = 0, /* linear in each cell */
  DELOS_ORDER_FIRST = 1   /* constant in each cell */
};
/* To second order; values of the first leave no range. */
enum {
  DELOS_LIMITER_GRADIENT = 0, /* gradients are shortened: local, no new extremes */
  DELOS_LIMITER_NONE = 1,     /* none */
  DELOS_LIMITER_ASSURED_SUM =
      2 /* values are clipped, others take it: keeps the order at extremes */
};
enum {
  DELOS_VELOCITY_VECTORS = 0, /* by Cartesian vectors at the cells */
  /* The part without divergence by its stream function, so that it gets none; the rest as vectors.
   * Takes some forty rounds of a solver for a flow with divergence. */
  DELOS_VELOCITY_STREAM_FUNCTION = 1,
  /* Both parts by their potentials: a flow without divergence gets none, and of any flow every cell
   * gets the divergence that delos_transfer_apply makes of the old cells' with the same order and
   * limiter (gradient for assured sum), within 1e-10 of velocity over spacing. Takes some
   * forty rounds of a solver, then some twenty. */
  DELOS_VELOCITY_HELMHOLTZ = 2
};
/* Of a cell that the other grid, which has a border, covers in part. */
enum {
  DELOS_NORMALIZATION_COVERED = 0, /* the mean over what is covered ("fracarea"): keeps constants */
  /* That mean times the covered fraction ("destarea"): area times value keeps the mass. */
  DELOS_NORMALIZATION_WHOLE = 1
};

/* All 0 is the default, and so is NULL. Members are added at the end only, and with them
 * DELOS_ABI_VERSION grows. */
typedef struct delos_transfer_options {
  int32_t order;         /* DELOS_ORDER_... */
  int32_t limiter;       /* DELOS_LIMITER_... */
  int32_t velocity;      /* DELOS_VELOCITY_..., of delos_transfer_apply_velocity */
  int64_t n_levels;      /* values of a cell or an edge, which stand together; 0 = 1 */
  int32_t normalization; /* DELOS_NORMALIZATION_..., of delos_transfer_apply */
} delos_transfer_options;

/* With the context's threads as they are now; its progress and delos_context_cancel serve this
 * call. The grids may be other contexts', and may be destroyed afterwards: the transfer keeps their
 * arrays. DELOS_ERROR_INPUT when they lie on different surfaces. They may have a border. */
DELOS_C_API int delos_transfer_create(delos_context* context, const delos_grid* from,
                                      const delos_grid* to, delos_transfer** transfer);
/* Frees it but for a small shell. NULL is allowed. */
DELOS_C_API int delos_transfer_destroy(delos_transfer* transfer);
/* DELOS_ERROR_STATE, naming the generations, unless it was made for these two grids. */
DELOS_C_API int delos_transfer_check(const delos_transfer* transfer, const delos_grid* from,
                                     const delos_grid* to);
/* Means over cells, [n_cells, n_levels] of each grid: n_values = n_cells * n_levels. The sum of
 * value times area is kept within 1e-14, a constant and cells that did not change to the last bit;
 * with a limiter, or to first order, no value leaves the range of the cells below it and (second
 * order) of their neighbours. Values must be finite. The same bits for any number of threads.
 * Between grids with a border a cell gets the mean over what the first grid covers of it, or that
 * times the covered fraction (options->normalization), NaN where that is nothing. DELOS_ERROR_INPUT
 * when a size does not fit, or for DELOS_LIMITER_ASSURED_SUM when a grid has a border. */
DELOS_C_API int delos_transfer_apply(const delos_transfer* transfer, const double* from,
                                     int64_t n_from_values, double* to, int64_t n_to_values,
                                     const delos_transfer_options* options);
/* Velocities along the edges' normals, [n_edges, n_levels] of each grid. Edges between cells that
 * did not change keep theirs to the last bit, with the sign of the normal. DELOS_ERROR_INPUT when a
 * size does not fit. With a border nothing flows through the border's edges of the second grid, and
 * - DELOS_VELOCITY_HELMHOLTZ is DELOS_ERROR_INPUT;
 * - by vectors, what the first grid has at its border's edges counts in its cells, and edges
 * between two cells that it does not cover get NaN;
 * - by the stream function, which is one number on each connected coast, a flow without divergence
 *   that goes through no border gets none, in cells that the first grid does not cover too (there
 *   is no NaN); what flows between two coasts that both grids have stays. Where a coast is new, or
 *   lost a passage, edges beside it change even between cells that did not. */
DELOS_C_API int delos_transfer_apply_velocity(const delos_transfer* transfer, const double* from,
                                              int64_t n_from_values, double* to,
                                              int64_t n_to_values,
                                              const delos_transfer_options* options);
/* Pairs of cells that overlap. */
DELOS_C_API int delos_transfer_n_overlaps(const delos_transfer* transfer, int64_t* n);
/* Cells of the second grid that are cells of the first. */
DELOS_C_API int delos_transfer_n_unchanged(const delos_transfer* transfer, int64_t* n);
/* Cells of the second grid that the first does not cover: they get NaN. */
DELOS_C_API int delos_transfer_n_unmapped(const delos_transfer* transfer, int64_t* n);

#ifdef __cplusplus
}
#endif
#endif
