! SPDX-License-Identifier: BSD-3-Clause
! A Fortran model that makes its grid when it starts and takes delos along as a component: no file
! between configuration and arrays.
program host_fortran
  use, intrinsic :: iso_fortran_env, only: error_unit
  use delos
  implicit none
  type(delos_config) :: config
  type(delos_component) :: component
  type(delos_clock) :: clock
  type(delos_grid) :: grid
  real(c_double), allocatable, target :: u_m_s(:)
  character(len=4096) :: path
  integer :: ierr

  if (command_argument_count() /= 1) then
    write (error_unit, "(a)") "usage: host_fortran CONFIG.yaml"
    error stop 2
  end if
  call get_command_argument(1, path)
  call config%from_file(path, ierr)
  call check(ierr, config%message())
  call component%create(config, ierr=ierr)
  call check(ierr, component%message())
  call component%initialize(ierr)
  call check(ierr, component%message())
  call component%get_grid(grid, ierr)
  call check(ierr, component%message())
  call use_grid()
  call simulate()
  call grid%destroy()
  call component%destroy()
  call clock%destroy()
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

  ! The model's clock loop: its velocity goes to the component without a copy.
  subroutine simulate()
    type(delos_state) :: imports, exports
    type(delos_field) :: field
    real(c_double), pointer :: lat_deg(:)
    integer :: weekly
    imports = component%import_state()
    exports = component%export_state()
    field = imports%field("surface_eastward_sea_water_velocity", ierr)
    call check(ierr, imports%message())
    allocate (u_m_s(field%n_points()), source=0d0)
    call field%bind(u_m_s, ierr)
    call check(ierr, field%message())
    call clock%create("2000-02-28", "P1D", stop="2000-03-14", calendar="noleap", ierr=ierr)
    call check(ierr, clock%message())
    weekly = clock%add_alarm(interval="P7D", ierr=ierr)
    call check(ierr, clock%message())
    do while (.not. clock%is_done())
      field = exports%field("cell_latitude", ierr)          ! taken where it is used
      call check(ierr, exports%message())
      lat_deg => field%data(ierr)
      call check(ierr, field%message())
      u_m_s = u_m_s + 1d-3*(45 - lat_deg)/45
      call component%run(imports, exports, clock, ierr)
      call check(ierr, component%message())
      call clock%advance(ierr)
      call check(ierr, clock%message())
      if (.not. clock%is_ringing(weekly)) cycle
      call clock%ringer_off(weekly)
      print "(2a, f0.4, a)", clock%current(), ": ", u_m_s(1), " m/s in the first cell"
    end do
    call component%finalize(ierr)
    call check(ierr, component%message())
  end subroutine
end program
