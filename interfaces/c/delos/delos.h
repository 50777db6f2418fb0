/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef DELOS_DELOS_H
#define DELOS_DELOS_H
/* delos for C99 and everything that speaks C: configuration -> grid arrays, in memory. What a
 * coupled model needs beside, delos/component.h, and what carries its fields to a new grid,
 * delos/transfer.h, are included at the end.
 *
 *   delos_context* context;  delos_config* config;  delos_grid* grid;  const double* area_m2;
 *   delos_context_create(&context);
 *   delos_config_from_file(context, "world_ocean.yaml", &config);
 *   if (delos_generate(context, config, &grid) != DELOS_SUCCESS) puts(delos_last_error(context));
 *   delos_grid_cell_area_m2(grid, &area_m2, &n_cells);
 *   delos_context_destroy(context);
 *
 * Every function but the four that return text or a version returns a delos_status. After an
 * error the numbers asked for are unchanged, handles and pointers asked for are NULL, and
 * delos_last_error() says what went wrong, where, and what to do. Nothing is printed, no
 * exception leaves a function.
 *
 * Handles: a context owns everything made in it. A destroyed handle is recognised
 * (DELOS_ERROR_STATE) until its context goes or a hundred others of its kind were destroyed after
 * it; a destroyed context is not, for certain. One thread at a time works in a context and on its
 * handles, but for delos_context_cancel, and for the const arrays and numbers of a grid, which any
 * number of threads may ask for.
 *
 * Strings: what goes in is copied. What comes out belongs to the handle; its life is said there.
 */
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define DELOS_C_API __attribute__((visibility("default")))

/* Grows when a program compiled with an older header can't use the library: compare it with
 * delos_abi_version() once, at the start. */
#define DELOS_ABI_VERSION 4
DELOS_C_API int delos_abi_version(void);
/* "major.minor.patch" of the library that runs; static storage. */
DELOS_C_API const char* delos_version(void);

/* What every function returns. The numbers are ESMF's own where it has one of the meaning, so
 * that a cap hands them on as they are. */
typedef enum delos_status {
  DELOS_SUCCESS = 0,
  DELOS_ERROR_STATE =
      42, /* ESMF_RC_NOT_VALID: a wrong order of calls, a stale handle or one of the wrong kind */
  DELOS_ERROR_ARGUMENT = 6,    /* ESMF_RC_ARG_BAD: an argument is NULL or out of range */
  DELOS_ERROR_CONFIG = 9,      /* ESMF_RC_ARG_VALUE: a setting is missing, unknown or wrong */
  DELOS_ERROR_INPUT = 21,      /* ESMF_RC_FILE_READ: an input file is missing or unusable */
  DELOS_ERROR_OUTPUT = 22,     /* ESMF_RC_FILE_WRITE: an output can't be written */
  DELOS_ERROR_RESOURCE = 30,   /* ESMF_RC_MEM: does not fit memory, disk or 32-bit ids */
  DELOS_ERROR_NOT_FOUND = 41,  /* ESMF_RC_NOT_FOUND: a state has no such item */
  DELOS_ERROR_INTERNAL = 45,   /* ESMF_RC_INTNRL_BAD: a bug in delos, or a callback that threw */
  DELOS_ERROR_QUALITY = 54,    /* ESMF_RC_VAL_WRONG: what `require:` asks for is not met */
  DELOS_ERROR_CANCELLED = 1001 /* none in ESMF (1..1000): the caller asked to stop */
} delos_status;

/* The status in one word: "success", "state", "argument", "config", ...; static storage. */
DELOS_C_API const char* delos_status_name(int status);

typedef struct delos_context delos_context; /* errors, callbacks, threads; owner of the others */
typedef struct delos_config delos_config;   /* a grid's recipe */
typedef struct delos_grid delos_grid;       /* a finished, immutable grid */

/* Text of the last call on this handle that failed, "" before. `handle` is of any type
 * of this interface. What could not make a handle (delos_config_from_*, delos_generate) left its
 * text on the context. Valid until the next failing call on the handle. Never NULL. */
DELOS_C_API const char* delos_last_error(const void* handle);

/* --- context */

/* DELOS_ERROR_RESOURCE without memory. */
DELOS_C_API int delos_context_create(delos_context** context);
/* Destroys everything made in it too. NULL is allowed. */
DELOS_C_API int delos_context_destroy(delos_context* context);
/* Threads of delos_generate and of components made later, 0 (at first) = what the configuration
 * says. The grid does not depend on it, to the last bit. */
DELOS_C_API int delos_context_set_threads(delos_context* context, int n_threads);

typedef struct delos_progress {
  const char* phase; /* e.g. "refine"; valid during the callback */
  int64_t done;      /* items finished */
  int64_t total;     /* items expected (an estimate, done may pass it); 0 = unknown */
  double elapsed_s;  /* since the phase began */
} delos_progress;
/* Called from any thread, one call at a time, at most ten times a second. */
typedef void (*delos_progress_callback)(const delos_progress* progress, void* user_data);

enum { DELOS_LOG_DEBUG = 0, DELOS_LOG_INFO = 1, DELOS_LOG_WARNING = 2, DELOS_LOG_ERROR = 3 };
/* `message` is valid during the callback and has no line end. */
typedef void (*delos_log_callback)(int level, const char* message, void* user_data);

/* NULL switches a callback off. */
DELOS_C_API int delos_context_set_progress(delos_context* context, delos_progress_callback callback,
                                           void* user_data);
DELOS_C_API int delos_context_set_log(delos_context* context, delos_log_callback callback,
                                      void* user_data);
/* Stops what makes a grid (delos_generate, delos_component_realize and _read_restart) or a transfer
 * (delos_transfer_create), the call
 * that runs or the next one, with DELOS_ERROR_CANCELLED soon after. May be called from callbacks,
 * other threads and signal handlers. Used up when that call ends. */
DELOS_C_API int delos_context_cancel(delos_context* context);

/* --- configuration: YAML; config/defaults.yaml explains every key. DELOS_ERROR_CONFIG's text
 *     begins with "file:line key.path:" */

/* File names in it are relative to the file's folder. */
DELOS_C_API int delos_config_from_file(delos_context* context, const char* path,
                                       delos_config** config);
/* `name` stands for the file in messages (NULL = "configuration"); file names are relative to
 * `folder` (NULL = "."). */
DELOS_C_API int delos_config_from_text(delos_context* context, const char* yaml, const char* name,
                                       const char* folder, delos_config** config);
/* Frees it but for a small shell. NULL is allowed. */
DELOS_C_API int delos_config_destroy(delos_config* config);
/* Sets one key, e.g. ("sizing.sources.0.spacing", "60 km"); the value is YAML. A list (from 0)
 * grows by one when the index is its length. */
DELOS_C_API int delos_config_set(delos_config* config, const char* key, const char* value);
/* Checks every key and value as delos_generate does; no file is opened. */
DELOS_C_API int delos_config_check(delos_config* config);
/* The effective configuration, defaults included, as YAML. Valid until the next call of this
 * function on the handle, or its end. */
DELOS_C_API int delos_config_text(delos_config* config, const char** text);

/* --- grid */

/* Reads the files that the configuration names, sizes, refines, relaxes, and builds the dual.
 * Writes nothing. The configuration may be destroyed or changed afterwards, and may be another
 * context's. DELOS_ERROR_CONFIG for a setting, _INPUT for a file, _RESOURCE, before anything large
 * is allocated, for a grid that does not fit, _QUALITY when a `require:` is missed, _CANCELLED. */
DELOS_C_API int delos_generate(delos_context* context, const delos_config* config,
                               delos_grid** grid);
/* Frees it, and its arrays and strings, but for a small shell. NULL is allowed. */
DELOS_C_API int delos_grid_destroy(delos_grid* grid);
/* Another handle, of `context`, of the same grid, which may be another context's: arrays are
 * shared, and live as long as one of the handles. */
DELOS_C_API int delos_grid_share(delos_context* context, const delos_grid* grid,
                                 delos_grid** shared);

/* Cells are Voronoi polygons, vertices their corners (one for each triangle), edges lie between
 * two cells. Ids are 32-bit with base 0, counts are 64-bit. Lists around a cell or a vertex run
 * counter-clockwise seen from outside. Lengths in metres, angles in radians. */
DELOS_C_API int delos_grid_n_cells(const delos_grid* grid, int64_t* n);
DELOS_C_API int delos_grid_n_edges(const delos_grid* grid, int64_t* n);
DELOS_C_API int delos_grid_n_vertices(const delos_grid* grid, int64_t* n);
/* Edges of the cell that has most. */
DELOS_C_API int delos_grid_max_edges(const delos_grid* grid, int64_t* n);
/* 1 for a fresh grid; grows when a component rebuilds it. */
DELOS_C_API int delos_grid_generation(const delos_grid* grid, int64_t* generation);

/* Valid until the grid is destroyed: SHA-256 in 64 hex digits, equal iff two grids are the same
 * to the last bit; the effective configuration; the report as text and as JSON. */
DELOS_C_API int delos_grid_digest(const delos_grid* grid, const char** text);
DELOS_C_API int delos_grid_config_text(const delos_grid* grid, const char** text);
DELOS_C_API int delos_grid_report(const delos_grid* grid, const char** text);
DELOS_C_API int delos_grid_report_json(const delos_grid* grid, const char** text);

/* The surface: x = centre_m + scale_m * position; scale_m is the largest of the three radii. */
DELOS_C_API int delos_grid_radii_m(const delos_grid* grid, double radii_m[3]);
DELOS_C_API int delos_grid_centre_m(const delos_grid* grid, double centre_m[3]);
DELOS_C_API int delos_grid_scale_m(const delos_grid* grid, double* scale_m);

/* Arrays: *values points into the grid, no copy; valid until the grid is destroyed. *size is the
 * number of values, columns included (C order: [n, 2] means value[2 * i + column]). `size` may be
 * NULL. */

/* Cartesian positions relative to the centre, in units of scale_m: [n, 3] */
DELOS_C_API int delos_grid_cell_position(const delos_grid* grid, const double** values,
                                         int64_t* size);
DELOS_C_API int delos_grid_edge_position(const delos_grid* grid, const double** values,
                                         int64_t* size);
DELOS_C_API int delos_grid_vertex_position(const delos_grid* grid, const double** values,
                                           int64_t* size);
/* Longitude in [0, 2 pi) and latitude of the configured kind, radians: [n, 2] */
DELOS_C_API int delos_grid_cell_lon_lat(const delos_grid* grid, const double** values,
                                        int64_t* size);
DELOS_C_API int delos_grid_edge_lon_lat(const delos_grid* grid, const double** values,
                                        int64_t* size);
DELOS_C_API int delos_grid_vertex_lon_lat(const delos_grid* grid, const double** values,
                                          int64_t* size);

/* Tables around a cell are ragged: those of cell i are values offsets[i] .. offsets[i + 1] - 1;
 * entry j of each belongs to edge j, which joins vertex j - 1 to vertex j. Ids from 0. With a
 * section `domain` the grid has a border: -1 stands in cells_on_cell, in the second of
 * cells_on_edge (the normal points out), in cells_on_vertex and edges_on_vertex where there is
 * nothing, a kite there is 0, and the ragged tables are shorter than 2 n_edges. */
/* [n_cells + 1] */
DELOS_C_API int delos_grid_cell_offsets(const delos_grid* grid, const int64_t** values,
                                        int64_t* size);
/* [2 n_edges] */
DELOS_C_API int delos_grid_edges_on_cell(const delos_grid* grid, const int32_t** values,
                                         int64_t* size);
/* [2 n_edges] */
DELOS_C_API int delos_grid_vertices_on_cell(const delos_grid* grid, const int32_t** values,
                                            int64_t* size);
/* [2 n_edges] across edge j */
DELOS_C_API int delos_grid_cells_on_cell(const delos_grid* grid, const int32_t** values,
                                         int64_t* size);
/* [n_edges, 2] the normal points from the first to the second */
DELOS_C_API int delos_grid_cells_on_edge(const delos_grid* grid, const int32_t** values,
                                         int64_t* size);
/* [n_edges, 2] from the first to the second is left of the normal */
DELOS_C_API int delos_grid_vertices_on_edge(const delos_grid* grid, const int32_t** values,
                                            int64_t* size);
/* [n_vertices, 3] */
DELOS_C_API int delos_grid_cells_on_vertex(const delos_grid* grid, const int32_t** values,
                                           int64_t* size);
/* [n_vertices, 3] edge j lies before cell j */
DELOS_C_API int delos_grid_edges_on_vertex(const delos_grid* grid, const int32_t** values,
                                           int64_t* size);
/* Tangential reconstruction, ragged too: first the edges of an edge's first cell, then of its
 * second. [n_edges + 1] */
DELOS_C_API int delos_grid_edge_offsets(const delos_grid* grid, const int64_t** values,
                                        int64_t* size);
/* [edge_offsets[n_edges]] */
DELOS_C_API int delos_grid_edges_on_edge(const delos_grid* grid, const int32_t** values,
                                         int64_t* size);
/* as edges_on_edge */
DELOS_C_API int delos_grid_weights_on_edge(const delos_grid* grid, const double** values,
                                           int64_t* size);

/* [n_cells] sums to the surface's area */
DELOS_C_API int delos_grid_cell_area_m2(const delos_grid* grid, const double** values,
                                        int64_t* size);
/* [n_cells] the spacing asked for */
DELOS_C_API int delos_grid_cell_spacing_m(const delos_grid* grid, const double** values,
                                          int64_t* size);
/* [n_edges] the same amid the two cells */
DELOS_C_API int delos_grid_edge_spacing_m(const delos_grid* grid, const double** values,
                                          int64_t* size);
/* [n_cells] with a section `region`: 0 inside, 1, 2, ... in the rings from there to the border;
 * else of size 0 */
DELOS_C_API int delos_grid_cell_ring(const delos_grid* grid, const int32_t** values, int64_t* size);
/* [n_vertices] */
DELOS_C_API int delos_grid_triangle_area_m2(const delos_grid* grid, const double** values,
                                            int64_t* size);
/* [n_vertices, 3] as cells_on_vertex */
DELOS_C_API int delos_grid_kite_area_m2(const delos_grid* grid, const double** values,
                                        int64_t* size);
/* [n_edges] between the two cells */
DELOS_C_API int delos_grid_cell_distance_m(const delos_grid* grid, const double** values,
                                           int64_t* size);
/* [n_edges] between the two vertices */
DELOS_C_API int delos_grid_vertex_distance_m(const delos_grid* grid, const double** values,
                                             int64_t* size);
/* [n_edges] of the normal, from east */
DELOS_C_API int delos_grid_edge_angle_rad(const delos_grid* grid, const double** values,
                                          int64_t* size);

/* --- the vertical, with a section `layers`; else all of size 0 */

/* [n_levels + 1] ascending, 0 first: of an ocean (kind z_level) the depth of the interfaces between
 * levels, of an atmosphere (terrain_following) their height over flat ground */
DELOS_C_API int delos_grid_level_interface_m(const delos_grid* grid, const double** values,
                                             int64_t* size);
/* of an ocean, [n_cells]: the layers of each cell from the surface down; 0 on land. The number of
 * the deepest one from 1, as MPAS's maxLevelCell */
DELOS_C_API int delos_grid_max_level_cell(const delos_grid* grid, const int32_t** values,
                                          int64_t* size);
/* of an ocean, [n_cells]: positive down, of the partial bottom cell; 0 on land */
DELOS_C_API int delos_grid_bottom_depth_m(const delos_grid* grid, const double** values,
                                          int64_t* size);
/* of an atmosphere, [n_cells]: the smoothed ground above sea level */
DELOS_C_API int delos_grid_ground_height_m(const delos_grid* grid, const double** values,
                                           int64_t* size);
/* of an atmosphere, [n_levels + 1]: interface k of a cell is at level_interface_m[k] +
 * ground_influence[k] * ground_height_m of the cell; 1 first */
DELOS_C_API int delos_grid_ground_influence(const delos_grid* grid, const double** values,
                                            int64_t* size);
/* Into the host's values[n_cells, n_levels], `size` numbers: the thickness at rest; 0 below an
 * ocean's bottom. */
DELOS_C_API int delos_grid_layer_thickness_m(const delos_grid* grid, double* values, int64_t size);
/* Into the host's values[n_cells, n_levels + 1]: the height of each interface above sea level, an
 * atmosphere's from the ground up (MPAS's zgrid), an ocean's from 0 down to the bottom. */
DELOS_C_API int delos_grid_interface_height_m(const delos_grid* grid, double* values, int64_t size);

/* --- numbers of the certificate and the report; flags are 0 or 1 */

typedef struct delos_quality {
  int64_t n_obtuse; /* triangles with an angle >= 90 degrees; 0 = well centred */
  double min_angle_deg;
  double max_angle_deg;
  double min_area_length; /* 4 sqrt(3)/3 area / rms(edge)^2, 1 = equilateral */
  double mean_area_length;
  double min_relative_edge; /* edge length / wanted spacing */
  double max_relative_edge;
  double min_dual_ratio;    /* shortest dual edge / its primal edge */
  double degree_6_fraction; /* share of hexagons */
} delos_quality;
/* Over the whole grid. */
DELOS_C_API int delos_grid_quality(const delos_grid* grid, delos_quality* quality);

/* The worst element of one measure. */
typedef struct delos_worst {
  double value;
  int64_t id;       /* from 0: a vertex or an edge */
  int64_t cells[2]; /* of the edge, from 0; -1 for a vertex */
  double lon_rad, lat_rad;
} delos_worst;

typedef struct delos_certificate {
  int32_t well_centred;          /* every triangle is acute: every dual edge crosses its primal */
  int32_t spacing_kept;          /* relative_edge_min.value >= relative_edge_bound */
  double well_centred_fraction;  /* of the triangles */
  int64_t n_obtuse;              /* the others */
  double relative_edge_bound;    /* 0.65 */
  delos_worst relative_edge_min; /* an edge: length / wanted spacing */
  delos_worst dual_ratio_min;    /* an edge: its dual's length / its own */
  delos_worst stagger_max;       /* an edge: distance of its middle from its dual's / its length */
  delos_worst angle_max_deg;     /* a vertex (triangle): largest angle */
} delos_certificate;
/* The numbers that every file and the report have, too. */
DELOS_C_API int delos_grid_certificate(const delos_grid* grid, delos_certificate* certificate);

/* --- files: each appears whole or not at all; DELOS_ERROR_OUTPUT's text says why not */

DELOS_C_API int delos_grid_write_mpas(const delos_grid* grid, const char* path);
/* The Voronoi cells, or the triangles, as UGRID faces. */
DELOS_C_API int delos_grid_write_ugrid_cells(const delos_grid* grid, const char* path);
DELOS_C_API int delos_grid_write_ugrid_triangles(const delos_grid* grid, const char* path);
/* The report as JSON. */
DELOS_C_API int delos_grid_write_report(const delos_grid* grid, const char* path);
/* What the configuration's `output` section names, all or nothing, into `directory` (NULL = the
 * configured one). *paths (may be NULL) lists the files, each followed by a line end; valid until
 * the next call of this function on the grid, or its end. */
DELOS_C_API int delos_grid_write_outputs(delos_grid* grid, const char* directory,
                                         const char** paths);

#ifdef __cplusplus
}
#endif

#include <delos/component.h>
#include <delos/transfer.h>
#endif
