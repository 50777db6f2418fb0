! SPDX-License-Identifier: BSD-3-Clause
! The functions of delos_mpi.h as Fortran sees them; module delos_mpi is built on it and is what a
! model uses.
module delos_mpi_binding
  use, intrinsic :: iso_c_binding, only: c_char, c_double, c_funptr, c_int, c_int32_t, &
    c_int64_t, c_null_funptr, c_null_ptr, c_ptr
  use delos_binding, only: array_getter, level_filler
  implicit none
  public
  private :: c_char, c_double, c_funptr, c_int, c_int32_t, c_int64_t, c_null_funptr, c_null_ptr, &
    c_ptr

  ! delos_mpi_options, member by member.
  type, bind(c) :: c_options
    integer(c_int) :: n_threads = 0, root = 0, halo_layers = 0, method = 0
    type(c_funptr) :: cell_weight = c_null_funptr
    type(c_ptr) :: user_data = c_null_ptr
    integer(c_int) :: work = 0
  end type

  abstract interface
    function list_getter(grid, location, values, n) bind(c) result(status)
      import :: c_ptr, c_int, c_int64_t
      type(c_ptr), value :: grid
      integer(c_int), value :: location
      type(c_ptr), intent(out) :: values
      integer(c_int64_t), intent(out) :: n
      integer(c_int) :: status
    end function

    function count_getter(grid, location, n) bind(c) result(status)
      import :: c_ptr, c_int, c_int64_t
      type(c_ptr), value :: grid
      integer(c_int), value :: location
      integer(c_int64_t), intent(inout) :: n
      integer(c_int) :: status
    end function
  end interface

  interface
    function c_generate_file(comm, path, options, grid) &
      bind(c, name="delos_mpi_generate_file_f") result(status)
      import :: c_char, c_int, c_options, c_ptr
      integer(c_int), value :: comm
      character(kind=c_char), intent(in) :: path(*)
      type(c_options), intent(in) :: options
      type(c_ptr), intent(out) :: grid
      integer(c_int) :: status
    end function

    function c_generate_text(comm, yaml, folder, options, grid) &
      bind(c, name="delos_mpi_generate_text_f") result(status)
      import :: c_char, c_int, c_options, c_ptr
      integer(c_int), value :: comm
      character(kind=c_char), intent(in) :: yaml(*), folder(*)
      type(c_options), intent(in) :: options
      type(c_ptr), intent(out) :: grid
      integer(c_int) :: status
    end function

    function c_destroy(grid) bind(c, name="delos_mpi_grid_destroy") result(status)
      import :: c_int, c_ptr
      type(c_ptr), value :: grid
      integer(c_int) :: status
    end function

    function c_last_error(grid) bind(c, name="delos_mpi_last_error") result(text)
      import :: c_ptr
      type(c_ptr), value :: grid
      type(c_ptr) :: text
    end function

    function c_generation(grid, generation) bind(c, name="delos_mpi_grid_generation") result(status)
      import :: c_int, c_int64_t, c_ptr
      type(c_ptr), value :: grid
      integer(c_int64_t), intent(inout) :: generation
      integer(c_int) :: status
    end function

    function c_digest(grid, text) bind(c, name="delos_mpi_grid_digest") result(status)
      import :: c_int, c_ptr
      type(c_ptr), value :: grid
      type(c_ptr), intent(out) :: text
      integer(c_int) :: status
    end function

    function c_exchange(grid, values, n, location, n_components) &
      bind(c, name="delos_mpi_exchange") result(status)
      import :: c_double, c_int, c_int64_t, c_ptr
      type(c_ptr), value :: grid
      real(c_double), intent(inout) :: values(*)
      integer(c_int64_t), value :: n
      integer(c_int), value :: location, n_components
      integer(c_int) :: status
    end function

    function c_gather(grid, values, n, location, n_components, whole) &
      bind(c, name="delos_mpi_gather") result(status)
      import :: c_double, c_int, c_int64_t, c_ptr
      type(c_ptr), value :: grid
      real(c_double), intent(in) :: values(*)
      integer(c_int64_t), value :: n
      integer(c_int), value :: location, n_components
      real(c_double), intent(inout) :: whole(*)
      integer(c_int) :: status
    end function

    function c_scatter(grid, whole, location, n_components, values, n) &
      bind(c, name="delos_mpi_scatter") result(status)
      import :: c_double, c_int, c_int64_t, c_ptr
      type(c_ptr), value :: grid
      real(c_double), intent(in) :: whole(*)
      integer(c_int), value :: location, n_components
      real(c_double), intent(inout) :: values(*)
      integer(c_int64_t), value :: n
      integer(c_int) :: status
    end function
  end interface

  procedure(count_getter), bind(c, name="delos_mpi_grid_n_local") :: c_n_local
  procedure(count_getter), bind(c, name="delos_mpi_grid_n_owned") :: c_n_owned
  procedure(count_getter), bind(c, name="delos_mpi_grid_n_global") :: c_n_global
  procedure(list_getter), bind(c, name="delos_mpi_grid_global_id") :: c_global_id
  procedure(list_getter), bind(c, name="delos_mpi_grid_owner") :: c_owner
  procedure(list_getter), bind(c, name="delos_mpi_grid_neighbours") :: c_neighbours
  procedure(list_getter), bind(c, name="delos_mpi_grid_send_ids") :: c_send_ids
  procedure(list_getter), bind(c, name="delos_mpi_grid_receive_ids") :: c_receive_ids
  procedure(list_getter), bind(c, name="delos_mpi_grid_layer_offsets") :: c_layer_offsets
  procedure(list_getter), bind(c, name="delos_mpi_grid_send_offsets") :: c_send_offsets
  procedure(list_getter), bind(c, name="delos_mpi_grid_receive_offsets") :: c_receive_offsets
  procedure(array_getter), bind(c, name="delos_mpi_grid_weights_on_edge") :: c_weights_on_edge
  procedure(array_getter), bind(c, name="delos_mpi_grid_cell_area_m2") :: c_cell_area_m2
  procedure(array_getter), bind(c, name="delos_mpi_grid_cell_spacing_m") :: c_cell_spacing_m
  procedure(array_getter), bind(c, name="delos_mpi_grid_edge_spacing_m") :: c_edge_spacing_m
  procedure(array_getter), bind(c, name="delos_mpi_grid_cell_ring") :: c_cell_ring
  procedure(array_getter), bind(c, name="delos_mpi_grid_triangle_area_m2") :: c_triangle_area_m2
  procedure(array_getter), bind(c, name="delos_mpi_grid_cell_distance_m") :: c_cell_distance_m
  procedure(array_getter), bind(c, name="delos_mpi_grid_vertex_distance_m") :: c_vertex_distance_m
  procedure(array_getter), bind(c, name="delos_mpi_grid_edge_angle_rad") :: c_edge_angle_rad
  procedure(array_getter), bind(c, name="delos_mpi_grid_level_interface_m") :: c_level_interface_m
  procedure(array_getter), bind(c, name="delos_mpi_grid_max_level_cell") :: c_max_level_cell
  procedure(array_getter), bind(c, name="delos_mpi_grid_bottom_depth_m") :: c_bottom_depth_m
  procedure(array_getter), bind(c, name="delos_mpi_grid_ground_height_m") :: c_ground_height_m
  procedure(array_getter), bind(c, name="delos_mpi_grid_ground_influence") :: c_ground_influence
  procedure(level_filler), bind(c, name="delos_mpi_grid_layer_thickness_m") :: c_layer_thickness_m
  procedure(level_filler), bind(c, name="delos_mpi_grid_interface_height_m") :: c_interface_height_m
  procedure(array_getter), bind(c, name="delos_mpi_grid_cell_position") :: c_cell_position
  procedure(array_getter), bind(c, name="delos_mpi_grid_edge_position") :: c_edge_position
  procedure(array_getter), bind(c, name="delos_mpi_grid_vertex_position") :: c_vertex_position
  procedure(array_getter), bind(c, name="delos_mpi_grid_cell_lon_lat") :: c_cell_lon_lat
  procedure(array_getter), bind(c, name="delos_mpi_grid_edge_lon_lat") :: c_edge_lon_lat
  procedure(array_getter), bind(c, name="delos_mpi_grid_vertex_lon_lat") :: c_vertex_lon_lat
  procedure(array_getter), bind(c, name="delos_mpi_grid_kite_area_m2") :: c_kite_area_m2
  procedure(array_getter), bind(c, name="delos_mpi_grid_edges_on_cell") :: c_edges_on_cell
  procedure(array_getter), bind(c, name="delos_mpi_grid_vertices_on_cell") :: c_vertices_on_cell
  procedure(array_getter), bind(c, name="delos_mpi_grid_cells_on_cell") :: c_cells_on_cell
  procedure(array_getter), bind(c, name="delos_mpi_grid_edges_on_edge") :: c_edges_on_edge
  procedure(array_getter), bind(c, name="delos_mpi_grid_cells_on_edge") :: c_cells_on_edge
  procedure(array_getter), bind(c, name="delos_mpi_grid_vertices_on_edge") :: c_vertices_on_edge
  procedure(array_getter), bind(c, name="delos_mpi_grid_cells_on_vertex") :: c_cells_on_vertex
  procedure(array_getter), bind(c, name="delos_mpi_grid_edges_on_vertex") :: c_edges_on_vertex
  procedure(array_getter), bind(c, name="delos_mpi_grid_cell_offsets") :: c_cell_offsets
  procedure(array_getter), bind(c, name="delos_mpi_grid_edge_offsets") :: c_edge_offsets
end module delos_mpi_binding
