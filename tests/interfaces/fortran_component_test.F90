! SPDX-License-Identifier: BSD-3-Clause
! A Fortran model with delos as its component. Prints only what fails. Its argument: a restart file
! to write.
module fortran_component_test
  use, intrinsic :: iso_fortran_env, only: error_unit
  use delos
  implicit none
  integer :: n_failed = 0

contains

  subroutine expect(condition, what)
    logical, intent(in) :: condition
    character(len=*), intent(in) :: what
    if (condition) return
    write (error_unit, "(2a)") "fortran_component_test: not: ", what
    n_failed = n_failed + 1
  end subroutine

  subroutine create(component, clock, threads)
    type(delos_component), intent(inout) :: component
    type(delos_clock), intent(inout) :: clock
    integer, intent(in) :: threads
    type(delos_config) :: config
    integer :: ierr
    call config%from_text("sizing: {sources: [{type: constant, spacing: 1500 km}]}"//new_line("a")// &
                          "refine: {tile_vertices: 500}")
    call component%create(config, threads=threads, ierr=ierr)
    call expect(ierr == DELOS_SUCCESS, "the component is made")
    call clock%create("2000-02-27", "P1D", stop="2000-03-03", calendar="noleap", ierr=ierr)
    call expect(ierr == DELOS_SUCCESS, "the clock is made")
  end subroutine

  subroutine step(component, clock)
    type(delos_component), intent(inout) :: component
    type(delos_clock), intent(inout) :: clock
    integer :: ierr
    call component%run(component%import_state(), component%export_state(), clock, ierr)
    call expect(ierr == DELOS_SUCCESS, "run succeeds")
    call clock%advance()
  end subroutine

  subroutine test_clock()
    type(delos_clock) :: clock
    integer :: ierr, monthly, once
    call clock%create("2001-02-29", "P1D", ierr=ierr)
    call expect(ierr == DELOS_ERROR_CONFIG .and. .not. clock%is_made(), "no such day")
    call expect(index(clock%message(), "2001-02-29") > 0, "the message has it")
    call clock%create("2000-01-31", "P1M", ierr=ierr)
    call expect(clock%calendar() == "gregorian" .and. clock%stop() == "", "the defaults")
    call expect(clock%next() == "2000-02-29T00:00:00", "the day is clipped")
    monthly = clock%add_alarm(interval="P1M")
    once = clock%add_alarm(ring_time="2000-03-29", sticky=.false.)
    call expect(monthly == 0 .and. once == 1 .and. clock%n_alarms() == 2, "two alarms")
    call expect(clock%add_alarm(ierr=ierr) == -1 .and. ierr == DELOS_ERROR_CONFIG, "never rings")
    call clock%advance()
    call expect(clock%is_ringing(monthly) .and. .not. clock%is_ringing(once), "one rings")
    call expect(clock%is_sticky(monthly) .and. .not. clock%is_sticky(once), "one is sticky")
    call clock%ringer_off(monthly)
    call expect(clock%ring_time(monthly) == "2000-03-29T00:00:00", "the next ring time")
    call clock%set_stop("2000-03-29", ierr)
    call expect(ierr == DELOS_SUCCESS .and. .not. clock%is_done(), "not done")
    call clock%advance()
    call expect(clock%is_done() .and. clock%is_ringing(once), "done")
    call expect(clock%was_ringing(monthly) .and. clock%advance_count() == 2, "two steps")
    call clock%set_stop()
    call expect(.not. clock%is_done(), "never done without a stop")
    call clock%disable(monthly)
    call clock%ringer_on(monthly, ierr)
    call expect(ierr == DELOS_ERROR_STATE .and. .not. clock%is_enabled(monthly), "disabled")
    call expect(.not. clock%is_ringing(7, ierr) .and. ierr == DELOS_ERROR_STATE, "no alarm 7")
    call clock%destroy()
    call clock%advance(ierr)
    call expect(ierr == DELOS_ERROR_ARGUMENT, "a destroyed clock is empty")
  end subroutine

  subroutine test_states()
    type(delos_component) :: component
    type(delos_clock) :: clock
    type(delos_grid) :: grid
    type(delos_state) :: imports, exports
    type(delos_field) :: area, u
    real(c_double), pointer :: values(:), areas(:)
    real(c_double), allocatable, target :: own(:)
    real(c_double), target :: six(6)
    integer :: ierr
    integer(c_int64_t) :: n
    call create(component, clock, 2)
    imports = component%import_state()
    exports = component%export_state()
    call component%run(imports, exports, clock, ierr)
    call expect(ierr == DELOS_ERROR_STATE, "no run before initialize")
    call expect(index(component%message(), "initialize(advertise)") > 0, "what is expected")
    call component%advertise(ierr)
    call expect(exports%size() == 5 .and. exports%name(1) == "cell_area", "the exports")
    area = exports%field("cell_area", ierr)
    call expect(.not. associated(area%data(ierr)) .and. ierr == DELOS_ERROR_STATE, "no grid yet")
    call component%realize(ierr)
    call expect(ierr == DELOS_SUCCESS .and. component%generation() == 1, "the grid is made")
    area = exports%field("salt", ierr)
    call expect(ierr == DELOS_ERROR_NOT_FOUND .and. .not. area%is_made(), "no salt")
    call expect(index(exports%message(), "cell_area") > 0, "what there is")
    area = exports%field("cell_area")
    call component%get_grid(grid, ierr)
    areas => grid%cell_area_m2()
    values => area%data()
    call expect(associated(values, areas), "the field is the grid's array")
    call expect(area%units() == "m2" .and. area%location() == DELOS_LOCATION_CELL, "units and place")
    call expect(area%standard_name() == "cell_area" .and. len(area%long_name()) > 0, "names")
    call expect(area%generation() == 1 .and. area%n_components() == 1, "numbers")
    n = area%n_points()
    call expect(n == grid%n_cells(), "one value a cell")
    u = imports%field("surface_eastward_sea_water_velocity")
    allocate (own(n), source=0.25d0)
    call u%bind(own(:n - 1), ierr)
    call expect(ierr == DELOS_ERROR_INPUT .and. index(u%message(), "needs") > 0, "the size counts")
    call u%bind(own, ierr)
    own(2) = 7
    values => u%data()
    call expect(abs(values(2) - 7) < 1d-12, "no copy")
    call u%store(own, ierr)
    own(2) = 8
    values => u%data()
    call expect(abs(values(2) - 7) < 1d-12, "a copy")
    call u%stamp("2000-02-27", "noleap", ierr)
    call expect(u%is_updated() .and. u%time_stamp() == "2000-02-27T00:00:00", "the stamp")
    u = imports%field("eddy_kinetic_energy")
    call u%place_on_lat_lon([0d0, 120d0, 240d0], [-45d0, 45d0], ierr)
    six = 0
    call u%bind(six, ierr)
    call expect(ierr == DELOS_SUCCESS .and. u%location() == DELOS_LOCATION_LAT_LON, "on lat-lon")
    call step(component, clock)
    call expect(area%time_stamp() == "2000-02-28T00:00:00" .and. area%has_data(), "run stamps")
    call expect(component%current_time() == "2000-02-28T00:00:00", "run moves")
    call component%finalize(ierr)
    call expect(ierr == DELOS_SUCCESS .and. .not. area%has_data(), "finalize takes the values")
    call expect(.not. associated(area%data(ierr)), "and says so")
    call expect(index(area%message(), "generation 1") > 0, "naming the generation")
    call grid%destroy()
    call component%destroy()
    call clock%destroy()
  end subroutine

  subroutine test_restart(path)
    character(len=*), intent(in) :: path
    type(delos_component) :: first, second
    type(delos_clock) :: clock, again
    type(delos_grid) :: one, other
    integer :: ierr, alarm
    call create(first, clock, 1)
    call create(second, again, 2)
    alarm = clock%add_alarm(interval="P2D")
    call first%initialize(ierr)
    call step(first, clock)
    call step(first, clock)
    call first%write_restart(path, clock, ierr)
    call expect(ierr == DELOS_SUCCESS, "a restart file is written")
    call second%read_restart(path, again, ierr)
    call expect(ierr == DELOS_ERROR_STATE, "advertise comes first")
    call second%advertise()
    call second%read_restart("nowhere.nc", again, ierr)
    call expect(ierr == DELOS_ERROR_INPUT .and. index(second%message(), "nowhere.nc") > 0, "no file")
    call second%read_restart(path, again, ierr)
    call expect(ierr == DELOS_SUCCESS, "the restart file is read")
    call expect(again%current() == "2000-03-01T00:00:00" .and. again%is_ringing(alarm), "the clock")
    do while (.not. again%is_done())
      call step(first, clock)
      call step(second, again)
    end do
    call expect(again%current() == clock%current(), "both end")
    call first%get_grid(one)
    call second%get_grid(other)
    call expect(one%digest() == other%digest() .and. len(one%digest()) == 64, "on the same grid")
  end subroutine
end module fortran_component_test

program main
  use fortran_component_test
  implicit none
  character(len=4096) :: path
  integer :: unit
  call get_command_argument(1, path)
  call test_clock()
  call test_states()
  call test_restart(trim(path))
  open (newunit=unit, file=trim(path))
  close (unit, status="delete")
  if (n_failed > 0) error stop 1
end program
