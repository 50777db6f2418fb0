! SPDX-License-Identifier: BSD-3-Clause
! The numbers and arrays of a grid of module delos, and copies of ids with base 1.
module delos_arrays
  use, intrinsic :: iso_c_binding, only: c_associated, c_double, c_f_pointer, c_int, c_int32_t, c_int64_t, c_ptr
  use delos_binding
  use delos_objects
  implicit none
  private
  public :: delos_grid_arrays, delos_one_based
  ! For the modules of delos.
  public :: get_reals, get_real_table, get_ids, get_id_table, get_offsets

  ! Ids have base 0, as in C; delos_one_based() copies them with base 1. Arrays are not copied:
  ! the pointers are valid until the grid is destroyed or generated anew. Metres and radians.
  type, abstract, extends(delos_object) :: delos_grid_arrays
  contains
    procedure :: n_cells           ! Voronoi polygons
    procedure :: n_edges           ! between two cells
    procedure :: n_vertices        ! corners of cells, one a triangle
    procedure :: max_edges         ! edges of the cell that has most
    procedure :: generation        ! 1 when fresh; grows with remeshes
    procedure :: digest            ! SHA-256, equal iff two grids are the same to the last bit
    procedure :: config_text       ! the effective configuration
    procedure :: report            ! on one screen
    procedure :: report_json       ! the same as JSON
    procedure :: radii_m           ! (3)
    procedure :: centre_m          ! (3)
    procedure :: scale_m           ! x = centre_m + scale_m*position; the largest radius
    procedure :: cell_position     ! (3, n_cells) Cartesian, from the centre, in units of scale_m
    procedure :: edge_position     ! (3, n_edges)
    procedure :: vertex_position   ! (3, n_vertices)
    procedure :: cell_lon_lat      ! (2, n_cells) longitude in [0, 2 pi) and latitude, radians
    procedure :: edge_lon_lat      ! (2, n_edges)
    procedure :: vertex_lon_lat    ! (2, n_vertices)
    procedure :: cell_offsets      ! (n_cells + 1) where the lists around a cell begin
    procedure :: edges_on_cell     ! (2 n_edges) ragged, counter-clockwise
    procedure :: vertices_on_cell  ! (2 n_edges) edge j joins vertex j - 1 to vertex j
    procedure :: cells_on_cell     ! (2 n_edges) across edge j
    procedure :: cells_on_edge     ! (2, n_edges) the normal: from the first to the second
    procedure :: vertices_on_edge  ! (2, n_edges) left of the normal
    procedure :: cells_on_vertex   ! (3, n_vertices)
    procedure :: edges_on_vertex   ! (3, n_vertices) edge j before cell j
    procedure :: edge_offsets      ! (n_edges + 1) where an edge's reconstruction begins
    procedure :: edges_on_edge     ! (edge_offsets(n_edges + 1)) ragged
    procedure :: weights_on_edge   ! as edges_on_edge
    procedure :: cell_area_m2      ! (n_cells) sums to the surface's area
    procedure :: cell_spacing_m    ! (n_cells) the spacing asked for
    procedure :: edge_spacing_m    ! (n_edges) the same amid the two cells
    procedure :: cell_ring         ! (n_cells) of a region, 0 inside; else not associated
    procedure :: triangle_area_m2  ! (n_vertices)
    procedure :: kite_area_m2      ! (3, n_vertices) as cells_on_vertex
    procedure :: cell_distance_m   ! (n_edges) between the two cells
    procedure :: vertex_distance_m ! (n_edges) between the two vertices
    procedure :: edge_angle_rad    ! (n_edges) of the normal, from east
  end type

  ! A copy with base 1: of ids, or of offsets (list i is then values(offsets(i):offsets(i + 1) - 1)).
  interface delos_one_based
    module procedure one_based_ids, one_based_table, one_based_offsets
  end interface

contains

  ! An array of a handle's, as a pointer; null() where there is none.
  subroutine get_reals(handle, getter, values, ierr)
    type(c_ptr), intent(in) :: handle
    procedure(array_getter) :: getter
    real(c_double), pointer, intent(out) :: values(:)
    integer, intent(out), optional :: ierr
    type(c_ptr) :: first
    integer(c_int64_t) :: n
    integer(c_int) :: status
    status = getter(handle, first, n)
    values => null()
    if (status == DELOS_SUCCESS) then
      if (c_associated(first)) call c_f_pointer(first, values, [n])
    end if
    call report_status(status, ierr)
  end subroutine

  subroutine get_real_table(handle, getter, columns, values, ierr)
    type(c_ptr), intent(in) :: handle
    procedure(array_getter) :: getter
    integer, intent(in) :: columns
    real(c_double), pointer, intent(out) :: values(:, :)
    integer, intent(out), optional :: ierr
    type(c_ptr) :: first
    integer(c_int64_t) :: n
    integer(c_int) :: status
    status = getter(handle, first, n)
    values => null()
    if (status == DELOS_SUCCESS) then
      if (c_associated(first)) call c_f_pointer(first, values, [int(columns, c_int64_t), n/columns])
    end if
    call report_status(status, ierr)
  end subroutine

  subroutine get_ids(handle, getter, values, ierr)
    type(c_ptr), intent(in) :: handle
    procedure(array_getter) :: getter
    integer(c_int32_t), pointer, intent(out) :: values(:)
    integer, intent(out), optional :: ierr
    type(c_ptr) :: first
    integer(c_int64_t) :: n
    integer(c_int) :: status
    status = getter(handle, first, n)
    values => null()
    if (status == DELOS_SUCCESS) then
      if (c_associated(first)) call c_f_pointer(first, values, [n])
    end if
    call report_status(status, ierr)
  end subroutine

  subroutine get_id_table(handle, getter, columns, values, ierr)
    type(c_ptr), intent(in) :: handle
    procedure(array_getter) :: getter
    integer, intent(in) :: columns
    integer(c_int32_t), pointer, intent(out) :: values(:, :)
    integer, intent(out), optional :: ierr
    type(c_ptr) :: first
    integer(c_int64_t) :: n
    integer(c_int) :: status
    status = getter(handle, first, n)
    values => null()
    if (status == DELOS_SUCCESS) then
      if (c_associated(first)) call c_f_pointer(first, values, [int(columns, c_int64_t), n/columns])
    end if
    call report_status(status, ierr)
  end subroutine

  subroutine get_offsets(handle, getter, values, ierr)
    type(c_ptr), intent(in) :: handle
    procedure(array_getter) :: getter
    integer(c_int64_t), pointer, intent(out) :: values(:)
    integer, intent(out), optional :: ierr
    type(c_ptr) :: first
    integer(c_int64_t) :: n
    integer(c_int) :: status
    status = getter(handle, first, n)
    values => null()
    if (status == DELOS_SUCCESS) then
      if (c_associated(first)) call c_f_pointer(first, values, [n])
    end if
    call report_status(status, ierr)
  end subroutine

  function n_cells(self, ierr) result(n)
    class(delos_grid_arrays), intent(in) :: self
    integer, intent(out), optional :: ierr
    integer(c_int64_t) :: n
    n = count_of(self%handle, c_n_cells, ierr)
  end function

  function n_edges(self, ierr) result(n)
    class(delos_grid_arrays), intent(in) :: self
    integer, intent(out), optional :: ierr
    integer(c_int64_t) :: n
    n = count_of(self%handle, c_n_edges, ierr)
  end function

  function n_vertices(self, ierr) result(n)
    class(delos_grid_arrays), intent(in) :: self
    integer, intent(out), optional :: ierr
    integer(c_int64_t) :: n
    n = count_of(self%handle, c_n_vertices, ierr)
  end function

  function max_edges(self, ierr) result(n)
    class(delos_grid_arrays), intent(in) :: self
    integer, intent(out), optional :: ierr
    integer(c_int64_t) :: n
    n = count_of(self%handle, c_max_edges, ierr)
  end function

  function generation(self, ierr) result(n)
    class(delos_grid_arrays), intent(in) :: self
    integer, intent(out), optional :: ierr
    integer(c_int64_t) :: n
    n = count_of(self%handle, c_generation, ierr)
  end function

  function digest(self, ierr) result(string)
    class(delos_grid_arrays), intent(in) :: self
    integer, intent(out), optional :: ierr
    character(len=:), allocatable :: string
    string = text_of(self%handle, c_digest, ierr)
  end function

  function config_text(self, ierr) result(string)
    class(delos_grid_arrays), intent(in) :: self
    integer, intent(out), optional :: ierr
    character(len=:), allocatable :: string
    string = text_of(self%handle, c_config_text, ierr)
  end function

  function report(self, ierr) result(string)
    class(delos_grid_arrays), intent(in) :: self
    integer, intent(out), optional :: ierr
    character(len=:), allocatable :: string
    string = text_of(self%handle, c_report, ierr)
  end function

  function report_json(self, ierr) result(string)
    class(delos_grid_arrays), intent(in) :: self
    integer, intent(out), optional :: ierr
    character(len=:), allocatable :: string
    string = text_of(self%handle, c_report_json, ierr)
  end function

  function radii_m(self, ierr) result(vector)
    class(delos_grid_arrays), intent(in) :: self
    integer, intent(out), optional :: ierr
    real(c_double) :: vector(3)
    vector = 0
    call report_status(c_radii_m(self%handle, vector), ierr)
  end function

  function centre_m(self, ierr) result(vector)
    class(delos_grid_arrays), intent(in) :: self
    integer, intent(out), optional :: ierr
    real(c_double) :: vector(3)
    vector = 0
    call report_status(c_centre_m(self%handle, vector), ierr)
  end function

  ! Metres per unit of the positions: x = centre_m + scale_m * position.
  function scale_m(self, ierr)
    class(delos_grid_arrays), intent(in) :: self
    integer, intent(out), optional :: ierr
    real(c_double) :: scale_m, one(1)
    one = 0
    call report_status(c_scale_m(self%handle, one), ierr)
    scale_m = one(1)
  end function

  function cell_position(self, ierr) result(values)
    class(delos_grid_arrays), intent(in) :: self
    integer, intent(out), optional :: ierr
    real(c_double), pointer :: values(:, :)
    call get_real_table(self%handle, c_cell_position, 3, values, ierr)
  end function

  function edge_position(self, ierr) result(values)
    class(delos_grid_arrays), intent(in) :: self
    integer, intent(out), optional :: ierr
    real(c_double), pointer :: values(:, :)
    call get_real_table(self%handle, c_edge_position, 3, values, ierr)
  end function

  function vertex_position(self, ierr) result(values)
    class(delos_grid_arrays), intent(in) :: self
    integer, intent(out), optional :: ierr
    real(c_double), pointer :: values(:, :)
    call get_real_table(self%handle, c_vertex_position, 3, values, ierr)
  end function

  function cell_lon_lat(self, ierr) result(values)
    class(delos_grid_arrays), intent(in) :: self
    integer, intent(out), optional :: ierr
    real(c_double), pointer :: values(:, :)
    call get_real_table(self%handle, c_cell_lon_lat, 2, values, ierr)
  end function

  function edge_lon_lat(self, ierr) result(values)
    class(delos_grid_arrays), intent(in) :: self
    integer, intent(out), optional :: ierr
    real(c_double), pointer :: values(:, :)
    call get_real_table(self%handle, c_edge_lon_lat, 2, values, ierr)
  end function

  function vertex_lon_lat(self, ierr) result(values)
    class(delos_grid_arrays), intent(in) :: self
    integer, intent(out), optional :: ierr
    real(c_double), pointer :: values(:, :)
    call get_real_table(self%handle, c_vertex_lon_lat, 2, values, ierr)
  end function

  function cell_offsets(self, ierr) result(values)
    class(delos_grid_arrays), intent(in) :: self
    integer, intent(out), optional :: ierr
    integer(c_int64_t), pointer :: values(:)
    call get_offsets(self%handle, c_cell_offsets, values, ierr)
  end function

  function edges_on_cell(self, ierr) result(values)
    class(delos_grid_arrays), intent(in) :: self
    integer, intent(out), optional :: ierr
    integer(c_int32_t), pointer :: values(:)
    call get_ids(self%handle, c_edges_on_cell, values, ierr)
  end function

  function vertices_on_cell(self, ierr) result(values)
    class(delos_grid_arrays), intent(in) :: self
    integer, intent(out), optional :: ierr
    integer(c_int32_t), pointer :: values(:)
    call get_ids(self%handle, c_vertices_on_cell, values, ierr)
  end function

  function cells_on_cell(self, ierr) result(values)
    class(delos_grid_arrays), intent(in) :: self
    integer, intent(out), optional :: ierr
    integer(c_int32_t), pointer :: values(:)
    call get_ids(self%handle, c_cells_on_cell, values, ierr)
  end function

  function cells_on_edge(self, ierr) result(values)
    class(delos_grid_arrays), intent(in) :: self
    integer, intent(out), optional :: ierr
    integer(c_int32_t), pointer :: values(:, :)
    call get_id_table(self%handle, c_cells_on_edge, 2, values, ierr)
  end function

  function vertices_on_edge(self, ierr) result(values)
    class(delos_grid_arrays), intent(in) :: self
    integer, intent(out), optional :: ierr
    integer(c_int32_t), pointer :: values(:, :)
    call get_id_table(self%handle, c_vertices_on_edge, 2, values, ierr)
  end function

  function cells_on_vertex(self, ierr) result(values)
    class(delos_grid_arrays), intent(in) :: self
    integer, intent(out), optional :: ierr
    integer(c_int32_t), pointer :: values(:, :)
    call get_id_table(self%handle, c_cells_on_vertex, 3, values, ierr)
  end function

  function edges_on_vertex(self, ierr) result(values)
    class(delos_grid_arrays), intent(in) :: self
    integer, intent(out), optional :: ierr
    integer(c_int32_t), pointer :: values(:, :)
    call get_id_table(self%handle, c_edges_on_vertex, 3, values, ierr)
  end function

  function edge_offsets(self, ierr) result(values)
    class(delos_grid_arrays), intent(in) :: self
    integer, intent(out), optional :: ierr
    integer(c_int64_t), pointer :: values(:)
    call get_offsets(self%handle, c_edge_offsets, values, ierr)
  end function

  function edges_on_edge(self, ierr) result(values)
    class(delos_grid_arrays), intent(in) :: self
    integer, intent(out), optional :: ierr
    integer(c_int32_t), pointer :: values(:)
    call get_ids(self%handle, c_edges_on_edge, values, ierr)
  end function

  function weights_on_edge(self, ierr) result(values)
    class(delos_grid_arrays), intent(in) :: self
    integer, intent(out), optional :: ierr
    real(c_double), pointer :: values(:)
    call get_reals(self%handle, c_weights_on_edge, values, ierr)
  end function

  function cell_area_m2(self, ierr) result(values)
    class(delos_grid_arrays), intent(in) :: self
    integer, intent(out), optional :: ierr
    real(c_double), pointer :: values(:)
    call get_reals(self%handle, c_cell_area_m2, values, ierr)
  end function

  function cell_spacing_m(self, ierr) result(values)
    class(delos_grid_arrays), intent(in) :: self
    integer, intent(out), optional :: ierr
    real(c_double), pointer :: values(:)
    call get_reals(self%handle, c_cell_spacing_m, values, ierr)
  end function

  function cell_ring(self, ierr) result(values)
    class(delos_grid_arrays), intent(in) :: self
    integer, intent(out), optional :: ierr
    integer(c_int32_t), pointer :: values(:)
    call get_ids(self%handle, c_cell_ring, values, ierr)
  end function

  function edge_spacing_m(self, ierr) result(values)
    class(delos_grid_arrays), intent(in) :: self
    integer, intent(out), optional :: ierr
    real(c_double), pointer :: values(:)
    call get_reals(self%handle, c_edge_spacing_m, values, ierr)
  end function

  function triangle_area_m2(self, ierr) result(values)
    class(delos_grid_arrays), intent(in) :: self
    integer, intent(out), optional :: ierr
    real(c_double), pointer :: values(:)
    call get_reals(self%handle, c_triangle_area_m2, values, ierr)
  end function

  function kite_area_m2(self, ierr) result(values)
    class(delos_grid_arrays), intent(in) :: self
    integer, intent(out), optional :: ierr
    real(c_double), pointer :: values(:, :)
    call get_real_table(self%handle, c_kite_area_m2, 3, values, ierr)
  end function

  function cell_distance_m(self, ierr) result(values)
    class(delos_grid_arrays), intent(in) :: self
    integer, intent(out), optional :: ierr
    real(c_double), pointer :: values(:)
    call get_reals(self%handle, c_cell_distance_m, values, ierr)
  end function

  function vertex_distance_m(self, ierr) result(values)
    class(delos_grid_arrays), intent(in) :: self
    integer, intent(out), optional :: ierr
    real(c_double), pointer :: values(:)
    call get_reals(self%handle, c_vertex_distance_m, values, ierr)
  end function

  function edge_angle_rad(self, ierr) result(values)
    class(delos_grid_arrays), intent(in) :: self
    integer, intent(out), optional :: ierr
    real(c_double), pointer :: values(:)
    call get_reals(self%handle, c_edge_angle_rad, values, ierr)
  end function

  ! --- base 1

  pure function one_based_ids(ids) result(copy)
    integer(c_int32_t), intent(in) :: ids(:)
    integer(c_int32_t), allocatable :: copy(:)
    copy = ids + 1_c_int32_t
  end function

  pure function one_based_table(ids) result(copy)
    integer(c_int32_t), intent(in) :: ids(:, :)
    integer(c_int32_t), allocatable :: copy(:, :)
    copy = ids + 1_c_int32_t
  end function

  pure function one_based_offsets(offsets) result(copy)
    integer(c_int64_t), intent(in) :: offsets(:)
    integer(c_int64_t), allocatable :: copy(:)
    copy = offsets + 1_c_int64_t
  end function
end module delos_arrays
