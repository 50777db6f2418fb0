! SPDX-License-Identifier: BSD-3-Clause
! The vertical of a process's part of a grid.
module delos_mpi_levels
  use, intrinsic :: iso_c_binding, only: c_associated, c_double, c_f_pointer, c_int, c_int32_t, &
    c_int64_t, c_ptr
  use delos_mpi_parts, only: delos_mpi_part
  use delos_mpi_binding, only: array_getter, level_filler, c_level_interface_m, c_max_level_cell, &
    c_bottom_depth_m, c_ground_height_m, c_ground_influence, c_layer_thickness_m, c_interface_height_m
  use delos_binding, only: DELOS_SUCCESS
  use delos_objects, only: report_status
  implicit none
  private
  public :: delos_mpi_levels_of_part

  ! Without a section `layers` the pointers are not associated and the tables have no levels. Metres.
  type, extends(delos_mpi_part) :: delos_mpi_levels_of_part
  contains
    procedure :: n_levels           ! 0 without layers
    procedure :: level_interface_m  ! (n_levels + 1) 0 first: an ocean's depths, an atmosphere's heights
    procedure :: max_level_cell     ! (n_local) of an ocean: the deepest layer of each cell; 0 on land
    procedure :: bottom_depth_m     ! (n_local) of an ocean: positive down; 0 on land
    procedure :: ground_height_m    ! (n_local) of an atmosphere, above sea level
    procedure :: ground_influence   ! (n_levels + 1) of an atmosphere: interface k of cell i is at
    !                                 level_interface_m(k) + ground_influence(k)*ground_height_m(i)
    procedure :: layer_thickness_m  ! subroutine: (n_levels, n_local) values: at rest; 0 below an ocean's bottom
    procedure :: interface_height_m ! subroutine: (n_levels + 1, n_local) values: above sea level; MPAS's zgrid
  end type

contains

  function n_levels(self, ierr) result(n)
    class(delos_mpi_levels_of_part), intent(in) :: self
    integer, intent(out), optional :: ierr
    integer :: n
    real(c_double), pointer :: interface_m(:)
    interface_m => self%level_interface_m(ierr)
    n = 0
    if (associated(interface_m)) n = size(interface_m) - 1
  end function

  function level_interface_m(self, ierr) result(values)
    class(delos_mpi_levels_of_part), intent(in) :: self
    integer, intent(out), optional :: ierr
    real(c_double), pointer :: values(:)
    call get_levels(self, c_level_interface_m, values, ierr)
  end function

  function bottom_depth_m(self, ierr) result(values)
    class(delos_mpi_levels_of_part), intent(in) :: self
    integer, intent(out), optional :: ierr
    real(c_double), pointer :: values(:)
    call get_levels(self, c_bottom_depth_m, values, ierr)
  end function

  function ground_height_m(self, ierr) result(values)
    class(delos_mpi_levels_of_part), intent(in) :: self
    integer, intent(out), optional :: ierr
    real(c_double), pointer :: values(:)
    call get_levels(self, c_ground_height_m, values, ierr)
  end function

  function ground_influence(self, ierr) result(values)
    class(delos_mpi_levels_of_part), intent(in) :: self
    integer, intent(out), optional :: ierr
    real(c_double), pointer :: values(:)
    call get_levels(self, c_ground_influence, values, ierr)
  end function

  function max_level_cell(self, ierr) result(values)
    class(delos_mpi_levels_of_part), intent(in) :: self
    integer, intent(out), optional :: ierr
    integer(c_int32_t), pointer :: values(:)
    type(c_ptr) :: first
    integer(c_int64_t) :: n
    integer(c_int) :: status
    status = c_max_level_cell(self%handle, first, n)
    values => null()
    if (status == DELOS_SUCCESS) then
      if (c_associated(first)) call c_f_pointer(first, values, [n])
    end if
    call report_status(status, ierr)
  end function

  subroutine layer_thickness_m(self, values, ierr)
    class(delos_mpi_levels_of_part), intent(in) :: self
    real(c_double), allocatable, intent(out) :: values(:, :)
    integer, intent(out), optional :: ierr
    call fill_levels(self, c_layer_thickness_m, 0, values, ierr)
  end subroutine

  subroutine interface_height_m(self, values, ierr)
    class(delos_mpi_levels_of_part), intent(in) :: self
    real(c_double), allocatable, intent(out) :: values(:, :)
    integer, intent(out), optional :: ierr
    call fill_levels(self, c_interface_height_m, 1, values, ierr)
  end subroutine

  subroutine get_levels(self, getter, values, ierr)
    class(delos_mpi_levels_of_part), intent(in) :: self
    procedure(array_getter) :: getter
    real(c_double), pointer, intent(out) :: values(:)
    integer, intent(out), optional :: ierr
    type(c_ptr) :: first
    integer(c_int64_t) :: n
    integer(c_int) :: status
    status = getter(self%handle, first, n)
    values => null()
    if (status == DELOS_SUCCESS) then
      if (c_associated(first)) call c_f_pointer(first, values, [n])
    end if
    call report_status(status, ierr)
  end subroutine

  ! more: interfaces beyond the levels.
  subroutine fill_levels(self, filler, more, values, ierr)
    class(delos_mpi_levels_of_part), intent(in) :: self
    procedure(level_filler) :: filler
    integer, intent(in) :: more
    real(c_double), allocatable, intent(out) :: values(:, :)
    integer, intent(out), optional :: ierr
    real(c_double), pointer :: bottom_m(:), ground_m(:)
    integer :: n, n_columns
    n = self%n_levels(ierr)
    n_columns = 0
    if (n > 0) then
      bottom_m => self%bottom_depth_m()
      ground_m => self%ground_height_m()
      if (associated(bottom_m)) n_columns = size(bottom_m)
      if (associated(ground_m)) n_columns = size(ground_m)
      n = n + more
    end if
    allocate(values(n, n_columns))
    if (n > 0) call report_status(filler(self%handle, values, size(values, kind=c_int64_t)), ierr)
  end subroutine
end module delos_mpi_levels
