! SPDX-License-Identifier: BSD-3-Clause
! Configurations and grids of module delos, which says how they are used.
module delos_grids
  use, intrinsic :: iso_c_binding, only: c_double, c_f_pointer, c_funloc, c_funptr, c_int, &
    c_int32_t, c_int64_t, c_null_char, c_null_funptr, c_null_ptr, c_ptr
  use delos_binding
  use delos_objects
  implicit none
  private
  public :: delos_config, delos_grid, delos_one_based, delos_version

  ! A recipe: YAML whose every key config/defaults.yaml explains.
  type, extends(delos_object) :: delos_config
  contains
    procedure :: from_file
    procedure :: from_text
    procedure :: set
    procedure :: check
    procedure :: text
    final :: finish_config
  end type

  ! Ids have base 0, as in C; delos_one_based() copies them with base 1. Arrays are not copied:
  ! the pointers are valid until the grid is destroyed or generated anew. Metres and radians.
  type, extends(delos_object) :: delos_grid
    private
    type(c_funptr) :: on_progress = c_null_funptr
  contains
    procedure :: generate
    procedure :: set_progress
    procedure :: cancel
    procedure :: n_cells
    procedure :: n_edges
    procedure :: n_vertices
    procedure :: max_edges
    procedure :: generation
    procedure :: digest
    procedure :: config_text
    procedure :: report
    procedure :: report_json
    procedure :: radii_m
    procedure :: centre_m
    procedure :: scale_m
    procedure :: cell_position     ! (3, n_cells) Cartesian, relative to the centre, in units of scale_m
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
    procedure :: triangle_area_m2  ! (n_vertices)
    procedure :: kite_area_m2      ! (3, n_vertices) as cells_on_vertex
    procedure :: cell_distance_m   ! (n_edges) between the two cells
    procedure :: vertex_distance_m ! (n_edges) between the two vertices
    procedure :: edge_angle_rad    ! (n_edges) of the normal, from east
    procedure :: quality
    procedure :: certificate
    procedure :: write_mpas
    procedure :: write_ugrid_cells
    procedure :: write_ugrid_triangles
    procedure :: write_report
    procedure :: write_outputs
    final :: finish_grid
  end type

  ! A copy with base 1: of ids, or of offsets (list i is then values(offsets(i):offsets(i + 1) - 1)).
  interface delos_one_based
    module procedure one_based_ids, one_based_table, one_based_offsets
  end interface

contains

  impure elemental subroutine finish_config(self)
    type(delos_config), intent(inout) :: self
    call self%destroy()
  end subroutine

  impure elemental subroutine finish_grid(self)
    type(delos_grid), intent(inout) :: self
    call self%destroy()
  end subroutine

  function delos_version() result(version)
    character(len=:), allocatable :: version
    version = from_c(c_version())
  end function

  ! --- configuration

  ! File names in it are relative to the file's folder.
  subroutine from_file(self, path, ierr)
    class(delos_config), intent(inout) :: self
    character(len=*), intent(in) :: path
    integer, intent(out), optional :: ierr
    integer(c_int) :: status
    status = renewed(self)
    if (status == DELOS_SUCCESS) then
      status = c_from_file(self%context, trim(path)//c_null_char, self%handle)
    end if
    call report_status(status, ierr)
  end subroutine

  ! YAML with new_line() between lines. `name` stands for the file in messages.
  subroutine from_text(self, yaml, name, folder, ierr)
    class(delos_config), intent(inout) :: self
    character(len=*), intent(in) :: yaml
    character(len=*), intent(in), optional :: name, folder
    integer, intent(out), optional :: ierr
    character(len=:), allocatable :: file, base
    integer(c_int) :: status
    file = "configuration"
    if (present(name)) file = trim(name)
    base = "."
    if (present(folder)) base = trim(folder)
    status = renewed(self)
    if (status == DELOS_SUCCESS) then
      status = c_from_text(self%context, yaml//c_null_char, file//c_null_char, &
                           base//c_null_char, self%handle)
    end if
    call report_status(status, ierr)
  end subroutine

  ! One key, e.g. ("sizing.sources.0.spacing", "60 km").
  subroutine set(self, key, value, ierr)
    class(delos_config), intent(inout) :: self
    character(len=*), intent(in) :: key, value
    integer, intent(out), optional :: ierr
    call report_status(c_config_set(self%handle, trim(key)//c_null_char, &
                                    trim(value)//c_null_char), ierr)
  end subroutine

  ! Checks every key and value as generate does; no file is opened.
  subroutine check(self, ierr)
    class(delos_config), intent(in) :: self
    integer, intent(out), optional :: ierr
    call report_status(c_config_check(self%handle), ierr)
  end subroutine

  ! The effective configuration, defaults included, as YAML.
  function text(self, ierr)
    class(delos_config), intent(in) :: self
    integer, intent(out), optional :: ierr
    character(len=:), allocatable :: text
    text = text_of(self%handle, c_text, ierr)
  end function

  ! --- grid

  ! The former grid of this object is gone, whatever happens. threads: 0 = as configured.
  subroutine generate(self, config, threads, ierr)
    class(delos_grid), intent(inout) :: self
    type(delos_config), intent(in) :: config
    integer, intent(in), optional :: threads
    integer, intent(out), optional :: ierr
    integer(c_int) :: status
    status = renewed(self)
    if (status == DELOS_SUCCESS .and. present(threads)) then
      status = c_set_threads(self%context, int(threads, c_int))
    end if
    if (status == DELOS_SUCCESS) then
      status = c_set_progress(self%context, self%on_progress, c_null_ptr)
    end if
    if (status == DELOS_SUCCESS) status = c_generate(self%context, config%handle, self%handle)
    call report_status(status, ierr)
  end subroutine

  ! For every generate of this object; without a callback: none.
  subroutine set_progress(self, callback)
    class(delos_grid), intent(inout) :: self
    procedure(delos_progress_callback), optional :: callback
    self%on_progress = c_null_funptr
    if (present(callback)) self%on_progress = c_funloc(callback)
  end subroutine

  ! Stops the generate that runs, from its callback or another thread.
  subroutine cancel(self, ierr)
    class(delos_grid), intent(in) :: self
    integer, intent(out), optional :: ierr
    call report_status(c_context_cancel(self%context), ierr)
  end subroutine

  subroutine get_reals(self, getter, values, ierr)
    class(delos_grid), intent(in) :: self
    procedure(array_getter) :: getter
    real(c_double), pointer, intent(out) :: values(:)
    integer, intent(out), optional :: ierr
    type(c_ptr) :: first
    integer(c_int64_t) :: n
    integer(c_int) :: status
    status = getter(self%handle, first, n)
    values => null()
    if (status == DELOS_SUCCESS) call c_f_pointer(first, values, [n])
    call report_status(status, ierr)
  end subroutine

  subroutine get_real_table(self, getter, columns, values, ierr)
    class(delos_grid), intent(in) :: self
    procedure(array_getter) :: getter
    integer, intent(in) :: columns
    real(c_double), pointer, intent(out) :: values(:, :)
    integer, intent(out), optional :: ierr
    type(c_ptr) :: first
    integer(c_int64_t) :: n
    integer(c_int) :: status
    status = getter(self%handle, first, n)
    values => null()
    if (status == DELOS_SUCCESS) call c_f_pointer(first, values, [int(columns, c_int64_t), n/columns])
    call report_status(status, ierr)
  end subroutine

  subroutine get_ids(self, getter, values, ierr)
    class(delos_grid), intent(in) :: self
    procedure(array_getter) :: getter
    integer(c_int32_t), pointer, intent(out) :: values(:)
    integer, intent(out), optional :: ierr
    type(c_ptr) :: first
    integer(c_int64_t) :: n
    integer(c_int) :: status
    status = getter(self%handle, first, n)
    values => null()
    if (status == DELOS_SUCCESS) call c_f_pointer(first, values, [n])
    call report_status(status, ierr)
  end subroutine

  subroutine get_id_table(self, getter, columns, values, ierr)
    class(delos_grid), intent(in) :: self
    procedure(array_getter) :: getter
    integer, intent(in) :: columns
    integer(c_int32_t), pointer, intent(out) :: values(:, :)
    integer, intent(out), optional :: ierr
    type(c_ptr) :: first
    integer(c_int64_t) :: n
    integer(c_int) :: status
    status = getter(self%handle, first, n)
    values => null()
    if (status == DELOS_SUCCESS) call c_f_pointer(first, values, [int(columns, c_int64_t), n/columns])
    call report_status(status, ierr)
  end subroutine

  subroutine get_offsets(self, getter, values, ierr)
    class(delos_grid), intent(in) :: self
    procedure(array_getter) :: getter
    integer(c_int64_t), pointer, intent(out) :: values(:)
    integer, intent(out), optional :: ierr
    type(c_ptr) :: first
    integer(c_int64_t) :: n
    integer(c_int) :: status
    status = getter(self%handle, first, n)
    values => null()
    if (status == DELOS_SUCCESS) call c_f_pointer(first, values, [n])
    call report_status(status, ierr)
  end subroutine

  function n_cells(self, ierr) result(n)
    class(delos_grid), intent(in) :: self
    integer, intent(out), optional :: ierr
    integer(c_int64_t) :: n
    n = count_of(self%handle, c_n_cells, ierr)
  end function

  function n_edges(self, ierr) result(n)
    class(delos_grid), intent(in) :: self
    integer, intent(out), optional :: ierr
    integer(c_int64_t) :: n
    n = count_of(self%handle, c_n_edges, ierr)
  end function

  function n_vertices(self, ierr) result(n)
    class(delos_grid), intent(in) :: self
    integer, intent(out), optional :: ierr
    integer(c_int64_t) :: n
    n = count_of(self%handle, c_n_vertices, ierr)
  end function

  function max_edges(self, ierr) result(n)
    class(delos_grid), intent(in) :: self
    integer, intent(out), optional :: ierr
    integer(c_int64_t) :: n
    n = count_of(self%handle, c_max_edges, ierr)
  end function

  function generation(self, ierr) result(n)
    class(delos_grid), intent(in) :: self
    integer, intent(out), optional :: ierr
    integer(c_int64_t) :: n
    n = count_of(self%handle, c_generation, ierr)
  end function

  function digest(self, ierr) result(string)
    class(delos_grid), intent(in) :: self
    integer, intent(out), optional :: ierr
    character(len=:), allocatable :: string
    string = text_of(self%handle, c_digest, ierr)
  end function

  function config_text(self, ierr) result(string)
    class(delos_grid), intent(in) :: self
    integer, intent(out), optional :: ierr
    character(len=:), allocatable :: string
    string = text_of(self%handle, c_config_text, ierr)
  end function

  function report(self, ierr) result(string)
    class(delos_grid), intent(in) :: self
    integer, intent(out), optional :: ierr
    character(len=:), allocatable :: string
    string = text_of(self%handle, c_report, ierr)
  end function

  function report_json(self, ierr) result(string)
    class(delos_grid), intent(in) :: self
    integer, intent(out), optional :: ierr
    character(len=:), allocatable :: string
    string = text_of(self%handle, c_report_json, ierr)
  end function

  function radii_m(self, ierr) result(vector)
    class(delos_grid), intent(in) :: self
    integer, intent(out), optional :: ierr
    real(c_double) :: vector(3)
    vector = 0
    call report_status(c_radii_m(self%handle, vector), ierr)
  end function

  function centre_m(self, ierr) result(vector)
    class(delos_grid), intent(in) :: self
    integer, intent(out), optional :: ierr
    real(c_double) :: vector(3)
    vector = 0
    call report_status(c_centre_m(self%handle, vector), ierr)
  end function

  ! Metres per unit of the positions: x = centre_m + scale_m * position.
  function scale_m(self, ierr)
    class(delos_grid), intent(in) :: self
    integer, intent(out), optional :: ierr
    real(c_double) :: scale_m, one(1)
    one = 0
    call report_status(c_scale_m(self%handle, one), ierr)
    scale_m = one(1)
  end function

  function cell_position(self, ierr) result(values)
    class(delos_grid), intent(in) :: self
    integer, intent(out), optional :: ierr
    real(c_double), pointer :: values(:, :)
    call get_real_table(self, c_cell_position, 3, values, ierr)
  end function

  function edge_position(self, ierr) result(values)
    class(delos_grid), intent(in) :: self
    integer, intent(out), optional :: ierr
    real(c_double), pointer :: values(:, :)
    call get_real_table(self, c_edge_position, 3, values, ierr)
  end function

  function vertex_position(self, ierr) result(values)
    class(delos_grid), intent(in) :: self
    integer, intent(out), optional :: ierr
    real(c_double), pointer :: values(:, :)
    call get_real_table(self, c_vertex_position, 3, values, ierr)
  end function

  function cell_lon_lat(self, ierr) result(values)
    class(delos_grid), intent(in) :: self
    integer, intent(out), optional :: ierr
    real(c_double), pointer :: values(:, :)
    call get_real_table(self, c_cell_lon_lat, 2, values, ierr)
  end function

  function edge_lon_lat(self, ierr) result(values)
    class(delos_grid), intent(in) :: self
    integer, intent(out), optional :: ierr
    real(c_double), pointer :: values(:, :)
    call get_real_table(self, c_edge_lon_lat, 2, values, ierr)
  end function

  function vertex_lon_lat(self, ierr) result(values)
    class(delos_grid), intent(in) :: self
    integer, intent(out), optional :: ierr
    real(c_double), pointer :: values(:, :)
    call get_real_table(self, c_vertex_lon_lat, 2, values, ierr)
  end function

  function cell_offsets(self, ierr) result(values)
    class(delos_grid), intent(in) :: self
    integer, intent(out), optional :: ierr
    integer(c_int64_t), pointer :: values(:)
    call get_offsets(self, c_cell_offsets, values, ierr)
  end function

  function edges_on_cell(self, ierr) result(values)
    class(delos_grid), intent(in) :: self
    integer, intent(out), optional :: ierr
    integer(c_int32_t), pointer :: values(:)
    call get_ids(self, c_edges_on_cell, values, ierr)
  end function

  function vertices_on_cell(self, ierr) result(values)
    class(delos_grid), intent(in) :: self
    integer, intent(out), optional :: ierr
    integer(c_int32_t), pointer :: values(:)
    call get_ids(self, c_vertices_on_cell, values, ierr)
  end function

  function cells_on_cell(self, ierr) result(values)
    class(delos_grid), intent(in) :: self
    integer, intent(out), optional :: ierr
    integer(c_int32_t), pointer :: values(:)
    call get_ids(self, c_cells_on_cell, values, ierr)
  end function

  function cells_on_edge(self, ierr) result(values)
    class(delos_grid), intent(in) :: self
    integer, intent(out), optional :: ierr
    integer(c_int32_t), pointer :: values(:, :)
    call get_id_table(self, c_cells_on_edge, 2, values, ierr)
  end function

  function vertices_on_edge(self, ierr) result(values)
    class(delos_grid), intent(in) :: self
    integer, intent(out), optional :: ierr
    integer(c_int32_t), pointer :: values(:, :)
    call get_id_table(self, c_vertices_on_edge, 2, values, ierr)
  end function

  function cells_on_vertex(self, ierr) result(values)
    class(delos_grid), intent(in) :: self
    integer, intent(out), optional :: ierr
    integer(c_int32_t), pointer :: values(:, :)
    call get_id_table(self, c_cells_on_vertex, 3, values, ierr)
  end function

  function edges_on_vertex(self, ierr) result(values)
    class(delos_grid), intent(in) :: self
    integer, intent(out), optional :: ierr
    integer(c_int32_t), pointer :: values(:, :)
    call get_id_table(self, c_edges_on_vertex, 3, values, ierr)
  end function

  function edge_offsets(self, ierr) result(values)
    class(delos_grid), intent(in) :: self
    integer, intent(out), optional :: ierr
    integer(c_int64_t), pointer :: values(:)
    call get_offsets(self, c_edge_offsets, values, ierr)
  end function

  function edges_on_edge(self, ierr) result(values)
    class(delos_grid), intent(in) :: self
    integer, intent(out), optional :: ierr
    integer(c_int32_t), pointer :: values(:)
    call get_ids(self, c_edges_on_edge, values, ierr)
  end function

  function weights_on_edge(self, ierr) result(values)
    class(delos_grid), intent(in) :: self
    integer, intent(out), optional :: ierr
    real(c_double), pointer :: values(:)
    call get_reals(self, c_weights_on_edge, values, ierr)
  end function

  function cell_area_m2(self, ierr) result(values)
    class(delos_grid), intent(in) :: self
    integer, intent(out), optional :: ierr
    real(c_double), pointer :: values(:)
    call get_reals(self, c_cell_area_m2, values, ierr)
  end function

  function cell_spacing_m(self, ierr) result(values)
    class(delos_grid), intent(in) :: self
    integer, intent(out), optional :: ierr
    real(c_double), pointer :: values(:)
    call get_reals(self, c_cell_spacing_m, values, ierr)
  end function

  function edge_spacing_m(self, ierr) result(values)
    class(delos_grid), intent(in) :: self
    integer, intent(out), optional :: ierr
    real(c_double), pointer :: values(:)
    call get_reals(self, c_edge_spacing_m, values, ierr)
  end function

  function triangle_area_m2(self, ierr) result(values)
    class(delos_grid), intent(in) :: self
    integer, intent(out), optional :: ierr
    real(c_double), pointer :: values(:)
    call get_reals(self, c_triangle_area_m2, values, ierr)
  end function

  function kite_area_m2(self, ierr) result(values)
    class(delos_grid), intent(in) :: self
    integer, intent(out), optional :: ierr
    real(c_double), pointer :: values(:, :)
    call get_real_table(self, c_kite_area_m2, 3, values, ierr)
  end function

  function cell_distance_m(self, ierr) result(values)
    class(delos_grid), intent(in) :: self
    integer, intent(out), optional :: ierr
    real(c_double), pointer :: values(:)
    call get_reals(self, c_cell_distance_m, values, ierr)
  end function

  function vertex_distance_m(self, ierr) result(values)
    class(delos_grid), intent(in) :: self
    integer, intent(out), optional :: ierr
    real(c_double), pointer :: values(:)
    call get_reals(self, c_vertex_distance_m, values, ierr)
  end function

  function edge_angle_rad(self, ierr) result(values)
    class(delos_grid), intent(in) :: self
    integer, intent(out), optional :: ierr
    real(c_double), pointer :: values(:)
    call get_reals(self, c_edge_angle_rad, values, ierr)
  end function

  function quality(self, ierr)
    class(delos_grid), intent(in) :: self
    integer, intent(out), optional :: ierr
    type(delos_quality) :: quality
    call report_status(c_quality(self%handle, quality), ierr)
  end function

  function certificate(self, ierr)
    class(delos_grid), intent(in) :: self
    integer, intent(out), optional :: ierr
    type(delos_certificate) :: certificate
    call report_status(c_certificate(self%handle, certificate), ierr)
  end function

  subroutine write_mpas(self, path, ierr)
    class(delos_grid), intent(in) :: self
    character(len=*), intent(in) :: path
    integer, intent(out), optional :: ierr
    call report_status(c_write_mpas(self%handle, trim(path)//c_null_char), ierr)
  end subroutine

  subroutine write_ugrid_cells(self, path, ierr)
    class(delos_grid), intent(in) :: self
    character(len=*), intent(in) :: path
    integer, intent(out), optional :: ierr
    call report_status(c_write_ugrid_cells(self%handle, trim(path)//c_null_char), ierr)
  end subroutine

  subroutine write_ugrid_triangles(self, path, ierr)
    class(delos_grid), intent(in) :: self
    character(len=*), intent(in) :: path
    integer, intent(out), optional :: ierr
    call report_status(c_write_ugrid_triangles(self%handle, trim(path)//c_null_char), ierr)
  end subroutine

  subroutine write_report(self, path, ierr)
    class(delos_grid), intent(in) :: self
    character(len=*), intent(in) :: path
    integer, intent(out), optional :: ierr
    call report_status(c_write_report(self%handle, trim(path)//c_null_char), ierr)
  end subroutine

  ! What the configuration's `output` section names, all or nothing.
  subroutine write_outputs(self, directory, ierr)
    class(delos_grid), intent(in) :: self
    character(len=*), intent(in), optional :: directory
    integer, intent(out), optional :: ierr
    character(len=:), allocatable :: folder
    folder = ""
    if (present(directory)) folder = trim(directory)
    call report_status(c_write_outputs(self%handle, folder//c_null_char, c_null_ptr), ierr)
  end subroutine

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
end module delos_grids
