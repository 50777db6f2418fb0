! SPDX-License-Identifier: BSD-3-Clause
! The vertical of a grid of module delos.
module delos_levels
  use, intrinsic :: iso_c_binding, only: c_double, c_int32_t, c_int64_t, c_ptr
  use delos_arrays, only: delos_grid_arrays, get_ids, get_reals
  use delos_binding, only: c_bottom_depth_m, c_ground_height_m, c_ground_influence, &
    c_interface_height_m, c_layer_thickness_m, c_level_interface_m, c_max_level_cell, level_filler
  use delos_objects, only: report_status
  implicit none
  private
  public :: delos_grid_levels
  public :: fill_levels ! for the modules of delos

  ! Without a section `layers` the pointers are not associated and the tables have no levels. Metres.
  type, abstract, extends(delos_grid_arrays) :: delos_grid_levels
  contains
    procedure :: n_levels           ! 0 without layers
    procedure :: level_interface_m  ! (n_levels + 1) 0 first: an ocean's depths, an atmosphere's heights
    procedure :: max_level_cell     ! (n_cells) of an ocean: the deepest layer of each cell; 0 on land
    procedure :: bottom_depth_m     ! (n_cells) of an ocean: positive down; 0 on land
    procedure :: ground_height_m    ! (n_cells) of an atmosphere, above sea level
    procedure :: ground_influence   ! (n_levels + 1) of an atmosphere: interface k of cell i is at
    !                                 level_interface_m(k) + ground_influence(k)*ground_height_m(i)
    procedure :: layer_thickness_m  ! subroutine: (n_levels, n_cells) values: at rest; 0 below an ocean's bottom
    procedure :: interface_height_m ! subroutine: (n_levels + 1, n_cells) values: above sea level; MPAS's zgrid
  end type

contains

  function n_levels(self, ierr) result(n)
    class(delos_grid_levels), intent(in) :: self
    integer, intent(out), optional :: ierr
    integer :: n
    real(c_double), pointer :: interface_m(:)
    interface_m => self%level_interface_m(ierr)
    n = 0
    if (associated(interface_m)) n = size(interface_m) - 1
  end function

  function level_interface_m(self, ierr) result(values)
    class(delos_grid_levels), intent(in) :: self
    integer, intent(out), optional :: ierr
    real(c_double), pointer :: values(:)
    call get_reals(self%handle, c_level_interface_m, values, ierr)
  end function

  function bottom_depth_m(self, ierr) result(values)
    class(delos_grid_levels), intent(in) :: self
    integer, intent(out), optional :: ierr
    real(c_double), pointer :: values(:)
    call get_reals(self%handle, c_bottom_depth_m, values, ierr)
  end function

  function ground_height_m(self, ierr) result(values)
    class(delos_grid_levels), intent(in) :: self
    integer, intent(out), optional :: ierr
    real(c_double), pointer :: values(:)
    call get_reals(self%handle, c_ground_height_m, values, ierr)
  end function

  function ground_influence(self, ierr) result(values)
    class(delos_grid_levels), intent(in) :: self
    integer, intent(out), optional :: ierr
    real(c_double), pointer :: values(:)
    call get_reals(self%handle, c_ground_influence, values, ierr)
  end function

  function max_level_cell(self, ierr) result(values)
    class(delos_grid_levels), intent(in) :: self
    integer, intent(out), optional :: ierr
    integer(c_int32_t), pointer :: values(:)
    call get_ids(self%handle, c_max_level_cell, values, ierr)
  end function

  subroutine layer_thickness_m(self, values, ierr)
    class(delos_grid_levels), intent(in) :: self
    real(c_double), allocatable, intent(out) :: values(:, :)
    integer, intent(out), optional :: ierr
    call fill_levels(self%handle, c_layer_thickness_m, n_rows(self, 0), n_columns(self), values, ierr)
  end subroutine

  subroutine interface_height_m(self, values, ierr)
    class(delos_grid_levels), intent(in) :: self
    real(c_double), allocatable, intent(out) :: values(:, :)
    integer, intent(out), optional :: ierr
    call fill_levels(self%handle, c_interface_height_m, n_rows(self, 1), n_columns(self), values, ierr)
  end subroutine

  ! Levels of the tables and `more`; none without layers.
  integer function n_rows(self, more)
    class(delos_grid_levels), intent(in) :: self
    integer, intent(in) :: more
    n_rows = self%n_levels()
    if (n_rows > 0) n_rows = n_rows + more
  end function

  integer function n_columns(self)
    class(delos_grid_levels), intent(in) :: self
    n_columns = 0
    if (self%n_levels() > 0) n_columns = int(self%n_cells())
  end function

  ! A new table of so many rows and columns.
  subroutine fill_levels(handle, filler, n_rows, n_columns, values, ierr)
    type(c_ptr), intent(in) :: handle
    procedure(level_filler) :: filler
    integer, intent(in) :: n_rows, n_columns
    real(c_double), allocatable, intent(out) :: values(:, :)
    integer, intent(out), optional :: ierr
    allocate (values(n_rows, n_columns))
    call report_status(filler(handle, values, size(values, kind=c_int64_t)), ierr)
  end subroutine
end module delos_levels
