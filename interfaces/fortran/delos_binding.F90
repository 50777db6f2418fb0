! SPDX-License-Identifier: BSD-3-Clause
! The functions and structures of c/delos/delos.h as Fortran sees them; module delos is built on it
! and is what a model uses.
module delos_binding
  use, intrinsic :: iso_c_binding, only: c_char, c_double, c_funptr, c_int, c_int32_t, &
    c_int64_t, c_null_ptr, c_ptr, c_size_t
  implicit none
  public
  private :: c_char, c_double, c_funptr, c_int, c_int32_t, c_int64_t, c_null_ptr, c_ptr, c_size_t

  ! As delos_status in delos.h, which says what they mean.
  integer, parameter :: DELOS_SUCCESS = 0, DELOS_ERROR_STATE = 42, &
    DELOS_ERROR_ARGUMENT = 6, DELOS_ERROR_CONFIG = 9, DELOS_ERROR_INPUT = 21, &
    DELOS_ERROR_OUTPUT = 22, DELOS_ERROR_RESOURCE = 30, DELOS_ERROR_NOT_FOUND = 41, &
    DELOS_ERROR_INTERNAL = 45, &
    DELOS_ERROR_QUALITY = 54, DELOS_ERROR_CANCELLED = 1001

  ! Of a message.
  integer, parameter :: DELOS_LOG_DEBUG = 0, DELOS_LOG_INFO = 1, DELOS_LOG_WARNING = 2, &
    DELOS_LOG_ERROR = 3

  ! The structures of delos.h, member by member.
  type, bind(c) :: delos_quality
    integer(c_int64_t) :: n_obtuse = 0
    real(c_double) :: min_angle_deg = 0, max_angle_deg = 0, min_area_length = 0
    real(c_double) :: mean_area_length = 0, min_relative_edge = 0, max_relative_edge = 0
    real(c_double) :: min_dual_ratio = 0, degree_6_fraction = 0
  end type

  type, bind(c) :: delos_worst
    real(c_double) :: value = 0
    integer(c_int64_t) :: id = -1          ! from 0, as in the arrays
    integer(c_int64_t) :: cells(2) = -1    ! from 0; -1 for a vertex
    real(c_double) :: lon_rad = 0, lat_rad = 0
  end type

  type, bind(c) :: delos_certificate
    integer(c_int32_t) :: well_centred = 0, spacing_kept = 0    ! 0 or 1
    real(c_double) :: well_centred_fraction = 0
    integer(c_int64_t) :: n_obtuse = 0
    real(c_double) :: relative_edge_bound = 0
    type(delos_worst) :: relative_edge_min, dual_ratio_min, stagger_max, angle_max_deg
  end type

  type, bind(c) :: delos_progress
    type(c_ptr) :: phase = c_null_ptr      ! C string
    integer(c_int64_t) :: done = 0, total = 0
    real(c_double) :: elapsed_s = 0
  end type

  abstract interface
    ! Called from any thread, one call at a time, at most ten times a second.
    subroutine delos_progress_callback(progress, user_data) bind(c)
      import :: delos_progress, c_ptr
      type(delos_progress), intent(in) :: progress
      type(c_ptr), value :: user_data
    end subroutine

    function array_getter(grid, values, n) bind(c) result(status)
      import :: c_ptr, c_int, c_int64_t
      type(c_ptr), value :: grid
      type(c_ptr), intent(out) :: values
      integer(c_int64_t), intent(out) :: n
      integer(c_int) :: status
    end function

    function level_filler(grid, values, n) bind(c) result(status)
      import :: c_double, c_int, c_int64_t, c_ptr
      type(c_ptr), value :: grid
      real(c_double), intent(inout) :: values(*)
      integer(c_int64_t), value :: n
      integer(c_int) :: status
    end function

    function count_getter(grid, n) bind(c) result(status)
      import :: c_ptr, c_int, c_int64_t
      type(c_ptr), value :: grid
      integer(c_int64_t), intent(inout) :: n
      integer(c_int) :: status
    end function

    function flag_getter(handle, flag) bind(c) result(status)
      import :: c_ptr, c_int
      type(c_ptr), value :: handle
      integer(c_int), intent(inout) :: flag
      integer(c_int) :: status
    end function

    function text_getter(handle, text) bind(c) result(status)
      import :: c_ptr, c_int
      type(c_ptr), value :: handle
      type(c_ptr), intent(out) :: text
      integer(c_int) :: status
    end function

    function vector_getter(grid, vector) bind(c) result(status)
      import :: c_ptr, c_int, c_double
      type(c_ptr), value :: grid
      real(c_double), intent(inout) :: vector(*)
      integer(c_int) :: status
    end function

    function handle_call(handle) bind(c) result(status)
      import :: c_ptr, c_int
      type(c_ptr), value :: handle
      integer(c_int) :: status
    end function

    function path_call(handle, path) bind(c) result(status)
      import :: c_ptr, c_int, c_char
      type(c_ptr), value :: handle
      character(kind=c_char), intent(in) :: path(*)
      integer(c_int) :: status
    end function
  end interface

  interface
    function c_context_create(context) bind(c, name="delos_context_create") result(status)
      import :: c_ptr, c_int
      type(c_ptr), intent(out) :: context
      integer(c_int) :: status
    end function

    function c_set_threads(context, n) bind(c, name="delos_context_set_threads") result(status)
      import :: c_ptr, c_int
      type(c_ptr), value :: context
      integer(c_int), value :: n
      integer(c_int) :: status
    end function

    function c_set_progress(context, callback, user_data) &
      bind(c, name="delos_context_set_progress") result(status)
      import :: c_ptr, c_funptr, c_int
      type(c_ptr), value :: context, user_data
      type(c_funptr), value :: callback
      integer(c_int) :: status
    end function

    function c_set_log(context, callback, user_data) &
      bind(c, name="delos_context_set_log") result(status)
      import :: c_ptr, c_funptr, c_int
      type(c_ptr), value :: context, user_data
      type(c_funptr), value :: callback
      integer(c_int) :: status
    end function

    function c_from_file(context, path, config) bind(c, name="delos_config_from_file") result(status)
      import :: c_ptr, c_int, c_char
      type(c_ptr), value :: context
      character(kind=c_char), intent(in) :: path(*)
      type(c_ptr), intent(out) :: config
      integer(c_int) :: status
    end function

    function c_from_text(context, yaml, name, folder, config) &
      bind(c, name="delos_config_from_text") result(status)
      import :: c_ptr, c_int, c_char
      type(c_ptr), value :: context
      character(kind=c_char), intent(in) :: yaml(*), name(*), folder(*)
      type(c_ptr), intent(out) :: config
      integer(c_int) :: status
    end function

    function c_config_set(config, key, value) bind(c, name="delos_config_set") result(status)
      import :: c_ptr, c_int, c_char
      type(c_ptr), value :: config
      character(kind=c_char), intent(in) :: key(*), value(*)
      integer(c_int) :: status
    end function

    function c_generate(context, config, grid) bind(c, name="delos_generate") result(status)
      import :: c_ptr, c_int
      type(c_ptr), value :: context, config
      type(c_ptr), intent(out) :: grid
      integer(c_int) :: status
    end function

    function c_quality(grid, quality) bind(c, name="delos_grid_quality") result(status)
      import :: c_ptr, c_int, delos_quality
      type(c_ptr), value :: grid
      type(delos_quality), intent(inout) :: quality
      integer(c_int) :: status
    end function

    function c_certificate(grid, certificate) bind(c, name="delos_grid_certificate") result(status)
      import :: c_ptr, c_int, delos_certificate
      type(c_ptr), value :: grid
      type(delos_certificate), intent(inout) :: certificate
      integer(c_int) :: status
    end function

    function c_write_outputs(grid, directory, paths) &
      bind(c, name="delos_grid_write_outputs") result(status)
      import :: c_ptr, c_int, c_char
      type(c_ptr), value :: grid, paths
      character(kind=c_char), intent(in) :: directory(*)
      integer(c_int) :: status
    end function

    function c_last_error(handle) bind(c, name="delos_last_error") result(text)
      import :: c_ptr
      type(c_ptr), value :: handle
      type(c_ptr) :: text
    end function

    function c_version() bind(c, name="delos_version") result(text)
      import :: c_ptr
      type(c_ptr) :: text
    end function

    pure function c_strlen(text) bind(c, name="strlen") result(n)
      import :: c_ptr, c_size_t
      type(c_ptr), value :: text
      integer(c_size_t) :: n
    end function
  end interface

  procedure(handle_call), bind(c, name="delos_context_destroy") :: c_context_destroy
  procedure(handle_call), bind(c, name="delos_context_cancel") :: c_context_cancel
  procedure(handle_call), bind(c, name="delos_config_check") :: c_config_check
  procedure(text_getter), bind(c, name="delos_config_text") :: c_text
  procedure(count_getter), bind(c, name="delos_grid_n_cells") :: c_n_cells
  procedure(count_getter), bind(c, name="delos_grid_n_edges") :: c_n_edges
  procedure(count_getter), bind(c, name="delos_grid_n_vertices") :: c_n_vertices
  procedure(count_getter), bind(c, name="delos_grid_max_edges") :: c_max_edges
  procedure(count_getter), bind(c, name="delos_grid_generation") :: c_generation
  procedure(text_getter), bind(c, name="delos_grid_digest") :: c_digest
  procedure(text_getter), bind(c, name="delos_grid_config_text") :: c_config_text
  procedure(text_getter), bind(c, name="delos_grid_report") :: c_report
  procedure(text_getter), bind(c, name="delos_grid_report_json") :: c_report_json
  procedure(vector_getter), bind(c, name="delos_grid_radii_m") :: c_radii_m
  procedure(vector_getter), bind(c, name="delos_grid_centre_m") :: c_centre_m
  procedure(vector_getter), bind(c, name="delos_grid_scale_m") :: c_scale_m
  procedure(array_getter), bind(c, name="delos_grid_cell_position") :: c_cell_position
  procedure(array_getter), bind(c, name="delos_grid_edge_position") :: c_edge_position
  procedure(array_getter), bind(c, name="delos_grid_vertex_position") :: c_vertex_position
  procedure(array_getter), bind(c, name="delos_grid_cell_lon_lat") :: c_cell_lon_lat
  procedure(array_getter), bind(c, name="delos_grid_edge_lon_lat") :: c_edge_lon_lat
  procedure(array_getter), bind(c, name="delos_grid_vertex_lon_lat") :: c_vertex_lon_lat
  procedure(array_getter), bind(c, name="delos_grid_cell_offsets") :: c_cell_offsets
  procedure(array_getter), bind(c, name="delos_grid_edges_on_cell") :: c_edges_on_cell
  procedure(array_getter), bind(c, name="delos_grid_vertices_on_cell") :: c_vertices_on_cell
  procedure(array_getter), bind(c, name="delos_grid_cells_on_cell") :: c_cells_on_cell
  procedure(array_getter), bind(c, name="delos_grid_cells_on_edge") :: c_cells_on_edge
  procedure(array_getter), bind(c, name="delos_grid_vertices_on_edge") :: c_vertices_on_edge
  procedure(array_getter), bind(c, name="delos_grid_cells_on_vertex") :: c_cells_on_vertex
  procedure(array_getter), bind(c, name="delos_grid_edges_on_vertex") :: c_edges_on_vertex
  procedure(array_getter), bind(c, name="delos_grid_edge_offsets") :: c_edge_offsets
  procedure(array_getter), bind(c, name="delos_grid_edges_on_edge") :: c_edges_on_edge
  procedure(array_getter), bind(c, name="delos_grid_weights_on_edge") :: c_weights_on_edge
  procedure(array_getter), bind(c, name="delos_grid_cell_area_m2") :: c_cell_area_m2
  procedure(array_getter), bind(c, name="delos_grid_cell_spacing_m") :: c_cell_spacing_m
  procedure(array_getter), bind(c, name="delos_grid_edge_spacing_m") :: c_edge_spacing_m
  procedure(array_getter), bind(c, name="delos_grid_cell_ring") :: c_cell_ring
  procedure(array_getter), bind(c, name="delos_grid_triangle_area_m2") :: c_triangle_area_m2
  procedure(array_getter), bind(c, name="delos_grid_kite_area_m2") :: c_kite_area_m2
  procedure(array_getter), bind(c, name="delos_grid_cell_distance_m") :: c_cell_distance_m
  procedure(array_getter), bind(c, name="delos_grid_vertex_distance_m") :: c_vertex_distance_m
  procedure(array_getter), bind(c, name="delos_grid_edge_angle_rad") :: c_edge_angle_rad
  procedure(array_getter), bind(c, name="delos_grid_level_interface_m") :: c_level_interface_m
  procedure(array_getter), bind(c, name="delos_grid_max_level_cell") :: c_max_level_cell
  procedure(array_getter), bind(c, name="delos_grid_bottom_depth_m") :: c_bottom_depth_m
  procedure(array_getter), bind(c, name="delos_grid_ground_height_m") :: c_ground_height_m
  procedure(array_getter), bind(c, name="delos_grid_ground_influence") :: c_ground_influence
  procedure(level_filler), bind(c, name="delos_grid_layer_thickness_m") :: c_layer_thickness_m
  procedure(level_filler), bind(c, name="delos_grid_interface_height_m") :: c_interface_height_m
  procedure(path_call), bind(c, name="delos_grid_write_mpas") :: c_write_mpas
  procedure(path_call), bind(c, name="delos_grid_write_ugrid_cells") :: c_write_ugrid_cells
  procedure(path_call), bind(c, name="delos_grid_write_ugrid_triangles") :: c_write_ugrid_triangles
  procedure(path_call), bind(c, name="delos_grid_write_report") :: c_write_report
end module delos_binding
