! SPDX-License-Identifier: BSD-3-Clause
! A Fortran model that makes its grid when it starts: no file between configuration and arrays.
program host_fortran
  use, intrinsic :: iso_fortran_env, only: error_unit
  use delos
  implicit none
  type(delos_config) :: config
  type(delos_grid) :: grid
  character(len=4096) :: path
  integer :: ierr

  if (command_argument_count() /= 1) then
    write (error_unit, "(a)") "usage: host_fortran CONFIG.yaml"
    error stop 2
  end if
  call get_command_argument(1, path)
  call config%from_file(path, ierr)
  call check(ierr, config%message())
  call grid%generate(config, ierr=ierr)
  call check(ierr, grid%message())
  call use_grid()
  call grid%destroy()
  call config%destroy()

contains

  ! One place that looks at every status.
  subroutine check(status, message)
    integer, intent(in) :: status
    character(len=*), intent(in) :: message
    if (status == DELOS_SUCCESS) return
    write (error_unit, "(2a)") "host_fortran: ", message
    error stop 1
  end subroutine

  ! What a model does with the arrays; here it sums them up.
  subroutine use_grid()
    real(c_double), pointer :: area_m2(:), distance_m(:)
    integer(c_int32_t), allocatable :: cells_on_edge(:, :)
    integer :: shortest
    area_m2 => grid%cell_area_m2(ierr)                      ! no copy: a pointer into the grid
    call check(ierr, grid%message())
    distance_m => grid%cell_distance_m(ierr)
    call check(ierr, grid%message())
    allocate (cells_on_edge, source=delos_one_based(grid%cells_on_edge()))   ! a copy with base 1
    shortest = minloc(distance_m, dim=1)
    print "(a, i0)", "cells: ", size(area_m2)
    print "(a, es17.10e2, a)", "total area: ", sum(area_m2), " m2"
    print "(a, i0, a, i0, a, f0.1, a)", "closest cells: ", cells_on_edge(1, shortest), " and ", &
      cells_on_edge(2, shortest), ", ", distance_m(shortest)/1000, " km"
  end subroutine
end program
