! SPDX-License-Identifier: BSD-3-Clause
! The arrays of a process's part of a grid.
module delos_mpi_parts
  use, intrinsic :: iso_c_binding, only: c_double, c_int32_t, c_int64_t
  use delos_arrays, only: get_id_table, get_ids, get_offsets, get_real_table, get_reals
  use delos_mpi_binding
  use delos_mpi_lists, only: delos_mpi_lists_of_part
  implicit none
  private
  public :: delos_mpi_part

  type, extends(delos_mpi_lists_of_part) :: delos_mpi_part
  contains
    procedure :: cell_position
    procedure :: edge_position
    procedure :: vertex_position
    procedure :: cell_lon_lat
    procedure :: edge_lon_lat
    procedure :: vertex_lon_lat
    procedure :: cell_offsets
    procedure :: edges_on_cell
    procedure :: vertices_on_cell
    procedure :: cells_on_cell
    procedure :: cells_on_edge
    procedure :: vertices_on_edge
    procedure :: cells_on_vertex
    procedure :: edges_on_vertex
    procedure :: edge_offsets
    procedure :: edges_on_edge
    procedure :: weights_on_edge
    procedure :: cell_area_m2
    procedure :: cell_spacing_m
    procedure :: edge_spacing_m
    procedure :: cell_ring
    procedure :: triangle_area_m2
    procedure :: kite_area_m2
    procedure :: cell_distance_m
    procedure :: vertex_distance_m
    procedure :: edge_angle_rad
  end type

contains

  function cell_position(self, ierr) result(values)
    class(delos_mpi_part), intent(in) :: self
    integer, intent(out), optional :: ierr
    real(c_double), pointer :: values(:, :)
    call get_real_table(self%handle, c_cell_position, 3, values, ierr)
  end function

  function edge_position(self, ierr) result(values)
    class(delos_mpi_part), intent(in) :: self
    integer, intent(out), optional :: ierr
    real(c_double), pointer :: values(:, :)
    call get_real_table(self%handle, c_edge_position, 3, values, ierr)
  end function

  function vertex_position(self, ierr) result(values)
    class(delos_mpi_part), intent(in) :: self
    integer, intent(out), optional :: ierr
    real(c_double), pointer :: values(:, :)
    call get_real_table(self%handle, c_vertex_position, 3, values, ierr)
  end function

  function cell_lon_lat(self, ierr) result(values)
    class(delos_mpi_part), intent(in) :: self
    integer, intent(out), optional :: ierr
    real(c_double), pointer :: values(:, :)
    call get_real_table(self%handle, c_cell_lon_lat, 2, values, ierr)
  end function

  function edge_lon_lat(self, ierr) result(values)
    class(delos_mpi_part), intent(in) :: self
    integer, intent(out), optional :: ierr
    real(c_double), pointer :: values(:, :)
    call get_real_table(self%handle, c_edge_lon_lat, 2, values, ierr)
  end function

  function vertex_lon_lat(self, ierr) result(values)
    class(delos_mpi_part), intent(in) :: self
    integer, intent(out), optional :: ierr
    real(c_double), pointer :: values(:, :)
    call get_real_table(self%handle, c_vertex_lon_lat, 2, values, ierr)
  end function

  function kite_area_m2(self, ierr) result(values)
    class(delos_mpi_part), intent(in) :: self
    integer, intent(out), optional :: ierr
    real(c_double), pointer :: values(:, :)
    call get_real_table(self%handle, c_kite_area_m2, 3, values, ierr)
  end function

  function cell_offsets(self, ierr) result(values)
    class(delos_mpi_part), intent(in) :: self
    integer, intent(out), optional :: ierr
    integer(c_int64_t), pointer :: values(:)
    call get_offsets(self%handle, c_cell_offsets, values, ierr)
  end function

  function edge_offsets(self, ierr) result(values)
    class(delos_mpi_part), intent(in) :: self
    integer, intent(out), optional :: ierr
    integer(c_int64_t), pointer :: values(:)
    call get_offsets(self%handle, c_edge_offsets, values, ierr)
  end function

  function edges_on_cell(self, ierr) result(values)
    class(delos_mpi_part), intent(in) :: self
    integer, intent(out), optional :: ierr
    integer(c_int32_t), pointer :: values(:)
    call get_ids(self%handle, c_edges_on_cell, values, ierr)
  end function

  function vertices_on_cell(self, ierr) result(values)
    class(delos_mpi_part), intent(in) :: self
    integer, intent(out), optional :: ierr
    integer(c_int32_t), pointer :: values(:)
    call get_ids(self%handle, c_vertices_on_cell, values, ierr)
  end function

  function cells_on_cell(self, ierr) result(values)
    class(delos_mpi_part), intent(in) :: self
    integer, intent(out), optional :: ierr
    integer(c_int32_t), pointer :: values(:)
    call get_ids(self%handle, c_cells_on_cell, values, ierr)
  end function

  function edges_on_edge(self, ierr) result(values)
    class(delos_mpi_part), intent(in) :: self
    integer, intent(out), optional :: ierr
    integer(c_int32_t), pointer :: values(:)
    call get_ids(self%handle, c_edges_on_edge, values, ierr)
  end function

  function cells_on_edge(self, ierr) result(values)
    class(delos_mpi_part), intent(in) :: self
    integer, intent(out), optional :: ierr
    integer(c_int32_t), pointer :: values(:, :)
    call get_id_table(self%handle, c_cells_on_edge, 2, values, ierr)
  end function

  function vertices_on_edge(self, ierr) result(values)
    class(delos_mpi_part), intent(in) :: self
    integer, intent(out), optional :: ierr
    integer(c_int32_t), pointer :: values(:, :)
    call get_id_table(self%handle, c_vertices_on_edge, 2, values, ierr)
  end function

  function cells_on_vertex(self, ierr) result(values)
    class(delos_mpi_part), intent(in) :: self
    integer, intent(out), optional :: ierr
    integer(c_int32_t), pointer :: values(:, :)
    call get_id_table(self%handle, c_cells_on_vertex, 3, values, ierr)
  end function

  function edges_on_vertex(self, ierr) result(values)
    class(delos_mpi_part), intent(in) :: self
    integer, intent(out), optional :: ierr
    integer(c_int32_t), pointer :: values(:, :)
    call get_id_table(self%handle, c_edges_on_vertex, 3, values, ierr)
  end function

  function weights_on_edge(self, ierr) result(values)
    class(delos_mpi_part), intent(in) :: self
    integer, intent(out), optional :: ierr
    real(c_double), pointer :: values(:)
    call get_reals(self%handle, c_weights_on_edge, values, ierr)
  end function

  function cell_area_m2(self, ierr) result(values)
    class(delos_mpi_part), intent(in) :: self
    integer, intent(out), optional :: ierr
    real(c_double), pointer :: values(:)
    call get_reals(self%handle, c_cell_area_m2, values, ierr)
  end function

  function cell_spacing_m(self, ierr) result(values)
    class(delos_mpi_part), intent(in) :: self
    integer, intent(out), optional :: ierr
    real(c_double), pointer :: values(:)
    call get_reals(self%handle, c_cell_spacing_m, values, ierr)
  end function

  function edge_spacing_m(self, ierr) result(values)
    class(delos_mpi_part), intent(in) :: self
    integer, intent(out), optional :: ierr
    real(c_double), pointer :: values(:)
    call get_reals(self%handle, c_edge_spacing_m, values, ierr)
  end function

  function cell_ring(self, ierr) result(values)
    class(delos_mpi_part), intent(in) :: self
    integer, intent(out), optional :: ierr
    integer(c_int32_t), pointer :: values(:)
    call get_ids(self%handle, c_cell_ring, values, ierr)
  end function

  function triangle_area_m2(self, ierr) result(values)
    class(delos_mpi_part), intent(in) :: self
    integer, intent(out), optional :: ierr
    real(c_double), pointer :: values(:)
    call get_reals(self%handle, c_triangle_area_m2, values, ierr)
  end function

  function cell_distance_m(self, ierr) result(values)
    class(delos_mpi_part), intent(in) :: self
    integer, intent(out), optional :: ierr
    real(c_double), pointer :: values(:)
    call get_reals(self%handle, c_cell_distance_m, values, ierr)
  end function

  function vertex_distance_m(self, ierr) result(values)
    class(delos_mpi_part), intent(in) :: self
    integer, intent(out), optional :: ierr
    real(c_double), pointer :: values(:)
    call get_reals(self%handle, c_vertex_distance_m, values, ierr)
  end function

  function edge_angle_rad(self, ierr) result(values)
    class(delos_mpi_part), intent(in) :: self
    integer, intent(out), optional :: ierr
    real(c_double), pointer :: values(:)
    call get_reals(self%handle, c_edge_angle_rad, values, ierr)
  end function
end module delos_mpi_parts
