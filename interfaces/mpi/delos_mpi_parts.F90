! SPDX-License-Identifier: BSD-3-Clause
! The arrays of a process's part of a grid.
module delos_mpi_parts
  use, intrinsic :: iso_c_binding, only: c_associated, c_double, c_f_pointer, c_int, c_int32_t, &
    c_int64_t, c_null_ptr, c_ptr
  use delos_binding, only: DELOS_SUCCESS
  use delos_mpi_binding
  use delos_mpi_lists, only: delos_mpi_lists_of_part
  use delos_objects, only: report_status
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

  ! An array of any kind, as its address and the number of its values.
  subroutine get_array(self, getter, first, n, ierr)
    class(delos_mpi_part), intent(in) :: self
    procedure(array_getter) :: getter
    type(c_ptr), intent(out) :: first
    integer(c_int64_t), intent(out) :: n
    integer, intent(out), optional :: ierr
    integer(c_int) :: status
    status = getter(self%handle, first, n)
    if (status /= DELOS_SUCCESS) first = c_null_ptr
    call report_status(status, ierr)
  end subroutine

  function cell_position(self, ierr) result(values)
    class(delos_mpi_part), intent(in) :: self
    integer, intent(out), optional :: ierr
    real(c_double), pointer :: values(:, :)
    type(c_ptr) :: first
    integer(c_int64_t) :: n
    call get_array(self, c_cell_position, first, n, ierr)
    values => null()
    if (c_associated(first)) call c_f_pointer(first, values, [3_c_int64_t, n/3])
  end function

  function edge_position(self, ierr) result(values)
    class(delos_mpi_part), intent(in) :: self
    integer, intent(out), optional :: ierr
    real(c_double), pointer :: values(:, :)
    type(c_ptr) :: first
    integer(c_int64_t) :: n
    call get_array(self, c_edge_position, first, n, ierr)
    values => null()
    if (c_associated(first)) call c_f_pointer(first, values, [3_c_int64_t, n/3])
  end function

  function vertex_position(self, ierr) result(values)
    class(delos_mpi_part), intent(in) :: self
    integer, intent(out), optional :: ierr
    real(c_double), pointer :: values(:, :)
    type(c_ptr) :: first
    integer(c_int64_t) :: n
    call get_array(self, c_vertex_position, first, n, ierr)
    values => null()
    if (c_associated(first)) call c_f_pointer(first, values, [3_c_int64_t, n/3])
  end function

  function cell_lon_lat(self, ierr) result(values)
    class(delos_mpi_part), intent(in) :: self
    integer, intent(out), optional :: ierr
    real(c_double), pointer :: values(:, :)
    type(c_ptr) :: first
    integer(c_int64_t) :: n
    call get_array(self, c_cell_lon_lat, first, n, ierr)
    values => null()
    if (c_associated(first)) call c_f_pointer(first, values, [2_c_int64_t, n/2])
  end function

  function edge_lon_lat(self, ierr) result(values)
    class(delos_mpi_part), intent(in) :: self
    integer, intent(out), optional :: ierr
    real(c_double), pointer :: values(:, :)
    type(c_ptr) :: first
    integer(c_int64_t) :: n
    call get_array(self, c_edge_lon_lat, first, n, ierr)
    values => null()
    if (c_associated(first)) call c_f_pointer(first, values, [2_c_int64_t, n/2])
  end function

  function vertex_lon_lat(self, ierr) result(values)
    class(delos_mpi_part), intent(in) :: self
    integer, intent(out), optional :: ierr
    real(c_double), pointer :: values(:, :)
    type(c_ptr) :: first
    integer(c_int64_t) :: n
    call get_array(self, c_vertex_lon_lat, first, n, ierr)
    values => null()
    if (c_associated(first)) call c_f_pointer(first, values, [2_c_int64_t, n/2])
  end function

  function kite_area_m2(self, ierr) result(values)
    class(delos_mpi_part), intent(in) :: self
    integer, intent(out), optional :: ierr
    real(c_double), pointer :: values(:, :)
    type(c_ptr) :: first
    integer(c_int64_t) :: n
    call get_array(self, c_kite_area_m2, first, n, ierr)
    values => null()
    if (c_associated(first)) call c_f_pointer(first, values, [3_c_int64_t, n/3])
  end function

  function cell_offsets(self, ierr) result(values)
    class(delos_mpi_part), intent(in) :: self
    integer, intent(out), optional :: ierr
    integer(c_int64_t), pointer :: values(:)
    type(c_ptr) :: first
    integer(c_int64_t) :: n
    call get_array(self, c_cell_offsets, first, n, ierr)
    values => null()
    if (c_associated(first)) call c_f_pointer(first, values, [n])
  end function

  function edge_offsets(self, ierr) result(values)
    class(delos_mpi_part), intent(in) :: self
    integer, intent(out), optional :: ierr
    integer(c_int64_t), pointer :: values(:)
    type(c_ptr) :: first
    integer(c_int64_t) :: n
    call get_array(self, c_edge_offsets, first, n, ierr)
    values => null()
    if (c_associated(first)) call c_f_pointer(first, values, [n])
  end function

  function edges_on_cell(self, ierr) result(values)
    class(delos_mpi_part), intent(in) :: self
    integer, intent(out), optional :: ierr
    integer(c_int32_t), pointer :: values(:)
    type(c_ptr) :: first
    integer(c_int64_t) :: n
    call get_array(self, c_edges_on_cell, first, n, ierr)
    values => null()
    if (c_associated(first)) call c_f_pointer(first, values, [n])
  end function

  function vertices_on_cell(self, ierr) result(values)
    class(delos_mpi_part), intent(in) :: self
    integer, intent(out), optional :: ierr
    integer(c_int32_t), pointer :: values(:)
    type(c_ptr) :: first
    integer(c_int64_t) :: n
    call get_array(self, c_vertices_on_cell, first, n, ierr)
    values => null()
    if (c_associated(first)) call c_f_pointer(first, values, [n])
  end function

  function cells_on_cell(self, ierr) result(values)
    class(delos_mpi_part), intent(in) :: self
    integer, intent(out), optional :: ierr
    integer(c_int32_t), pointer :: values(:)
    type(c_ptr) :: first
    integer(c_int64_t) :: n
    call get_array(self, c_cells_on_cell, first, n, ierr)
    values => null()
    if (c_associated(first)) call c_f_pointer(first, values, [n])
  end function

  function edges_on_edge(self, ierr) result(values)
    class(delos_mpi_part), intent(in) :: self
    integer, intent(out), optional :: ierr
    integer(c_int32_t), pointer :: values(:)
    type(c_ptr) :: first
    integer(c_int64_t) :: n
    call get_array(self, c_edges_on_edge, first, n, ierr)
    values => null()
    if (c_associated(first)) call c_f_pointer(first, values, [n])
  end function

  function cells_on_edge(self, ierr) result(values)
    class(delos_mpi_part), intent(in) :: self
    integer, intent(out), optional :: ierr
    integer(c_int32_t), pointer :: values(:, :)
    type(c_ptr) :: first
    integer(c_int64_t) :: n
    call get_array(self, c_cells_on_edge, first, n, ierr)
    values => null()
    if (c_associated(first)) call c_f_pointer(first, values, [2_c_int64_t, n/2])
  end function

  function vertices_on_edge(self, ierr) result(values)
    class(delos_mpi_part), intent(in) :: self
    integer, intent(out), optional :: ierr
    integer(c_int32_t), pointer :: values(:, :)
    type(c_ptr) :: first
    integer(c_int64_t) :: n
    call get_array(self, c_vertices_on_edge, first, n, ierr)
    values => null()
    if (c_associated(first)) call c_f_pointer(first, values, [2_c_int64_t, n/2])
  end function

  function cells_on_vertex(self, ierr) result(values)
    class(delos_mpi_part), intent(in) :: self
    integer, intent(out), optional :: ierr
    integer(c_int32_t), pointer :: values(:, :)
    type(c_ptr) :: first
    integer(c_int64_t) :: n
    call get_array(self, c_cells_on_vertex, first, n, ierr)
    values => null()
    if (c_associated(first)) call c_f_pointer(first, values, [3_c_int64_t, n/3])
  end function

  function edges_on_vertex(self, ierr) result(values)
    class(delos_mpi_part), intent(in) :: self
    integer, intent(out), optional :: ierr
    integer(c_int32_t), pointer :: values(:, :)
    type(c_ptr) :: first
    integer(c_int64_t) :: n
    call get_array(self, c_edges_on_vertex, first, n, ierr)
    values => null()
    if (c_associated(first)) call c_f_pointer(first, values, [3_c_int64_t, n/3])
  end function

  function weights_on_edge(self, ierr) result(values)
    class(delos_mpi_part), intent(in) :: self
    integer, intent(out), optional :: ierr
    real(c_double), pointer :: values(:)
    type(c_ptr) :: first
    integer(c_int64_t) :: n
    call get_array(self, c_weights_on_edge, first, n, ierr)
    values => null()
    if (c_associated(first)) call c_f_pointer(first, values, [n])
  end function

  function cell_area_m2(self, ierr) result(values)
    class(delos_mpi_part), intent(in) :: self
    integer, intent(out), optional :: ierr
    real(c_double), pointer :: values(:)
    type(c_ptr) :: first
    integer(c_int64_t) :: n
    call get_array(self, c_cell_area_m2, first, n, ierr)
    values => null()
    if (c_associated(first)) call c_f_pointer(first, values, [n])
  end function

  function cell_spacing_m(self, ierr) result(values)
    class(delos_mpi_part), intent(in) :: self
    integer, intent(out), optional :: ierr
    real(c_double), pointer :: values(:)
    type(c_ptr) :: first
    integer(c_int64_t) :: n
    call get_array(self, c_cell_spacing_m, first, n, ierr)
    values => null()
    if (c_associated(first)) call c_f_pointer(first, values, [n])
  end function

  function edge_spacing_m(self, ierr) result(values)
    class(delos_mpi_part), intent(in) :: self
    integer, intent(out), optional :: ierr
    real(c_double), pointer :: values(:)
    type(c_ptr) :: first
    integer(c_int64_t) :: n
    call get_array(self, c_edge_spacing_m, first, n, ierr)
    values => null()
    if (c_associated(first)) call c_f_pointer(first, values, [n])
  end function

  function cell_ring(self, ierr) result(values)
    class(delos_mpi_part), intent(in) :: self
    integer, intent(out), optional :: ierr
    integer(c_int32_t), pointer :: values(:)
    type(c_ptr) :: first
    integer(c_int64_t) :: n
    call get_array(self, c_cell_ring, first, n, ierr)
    values => null()
    if (c_associated(first)) call c_f_pointer(first, values, [n])
  end function

  function triangle_area_m2(self, ierr) result(values)
    class(delos_mpi_part), intent(in) :: self
    integer, intent(out), optional :: ierr
    real(c_double), pointer :: values(:)
    type(c_ptr) :: first
    integer(c_int64_t) :: n
    call get_array(self, c_triangle_area_m2, first, n, ierr)
    values => null()
    if (c_associated(first)) call c_f_pointer(first, values, [n])
  end function

  function cell_distance_m(self, ierr) result(values)
    class(delos_mpi_part), intent(in) :: self
    integer, intent(out), optional :: ierr
    real(c_double), pointer :: values(:)
    type(c_ptr) :: first
    integer(c_int64_t) :: n
    call get_array(self, c_cell_distance_m, first, n, ierr)
    values => null()
    if (c_associated(first)) call c_f_pointer(first, values, [n])
  end function

  function vertex_distance_m(self, ierr) result(values)
    class(delos_mpi_part), intent(in) :: self
    integer, intent(out), optional :: ierr
    real(c_double), pointer :: values(:)
    type(c_ptr) :: first
    integer(c_int64_t) :: n
    call get_array(self, c_vertex_distance_m, first, n, ierr)
    values => null()
    if (c_associated(first)) call c_f_pointer(first, values, [n])
  end function

  function edge_angle_rad(self, ierr) result(values)
    class(delos_mpi_part), intent(in) :: self
    integer, intent(out), optional :: ierr
    real(c_double), pointer :: values(:)
    type(c_ptr) :: first
    integer(c_int64_t) :: n
    call get_array(self, c_edge_angle_rad, first, n, ierr)
    values => null()
    if (c_associated(first)) call c_f_pointer(first, values, [n])
  end function
end module delos_mpi_parts
