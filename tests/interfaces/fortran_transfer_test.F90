! SPDX-License-Identifier: BSD-3-Clause
! A Fortran model whose component remeshes: why it did, and its fields on the new grid. Prints only
! what fails; with the argument "values": the bits of those that it carried.
module fortran_transfer_test
  use, intrinsic :: iso_fortran_env, only: error_unit, output_unit
  use, intrinsic :: iso_c_binding, only: c_double, c_int64_t
  use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
  use delos
  implicit none
  integer :: n_failed = 0
  logical :: has_heard = .false.
  character(len=:), allocatable :: decision

contains

  ! Keeps what the component says of its alarm.
  subroutine on_log(level, message)
    integer, intent(in) :: level
    character(len=*), intent(in) :: message
    has_heard = .true.
    if (level == DELOS_LOG_INFO .and. index(message, "2001-01-03") > 0) decision = message
  end subroutine

  subroutine expect(condition, what)
    logical, intent(in) :: condition
    character(len=*), intent(in) :: what
    if (condition) return
    write (error_unit, "(2a)") "fortran_transfer_test: not: ", what
    n_failed = n_failed + 1
  end subroutine

  subroutine create(component, clock)
    type(delos_component), intent(inout) :: component
    type(delos_clock), intent(inout) :: clock
    character, parameter :: line = new_line("a")
    type(delos_config) :: config
    integer :: ierr
    call config%from_text( &
      "sizing: {sources: [{type: constant, spacing: 900 km}], gradient_limit: 0.3,"//line// &
      "         resolution: 4 deg, clamp: {min: 300 km, max: 2000 km}}"//line// &
      "refine: {tile_vertices: 500}"//line// &
      "remesh:"//line// &
      "  interval: P2D"//line// &
      "  sources: [{type: eke, quiet: [0.05 m/s, 900 km], energetic: [0.5 m/s, 500 km]}]")
    call component%create(config, threads=2, ierr=ierr)
    call component%initialize(ierr)
    call expect(ierr == DELOS_SUCCESS, "the component is made: "//component%message())
    call clock%create("2001-01-01", "P1D", ierr=ierr)
  end subroutine

  ! A day of a velocity that swings in the north.
  subroutine run_day(component, clock, day)
    type(delos_component), intent(inout) :: component
    type(delos_clock), intent(inout) :: clock
    integer, intent(in) :: day
    type(delos_grid) :: grid
    type(delos_state) :: imports
    type(delos_field) :: field
    real(c_double), pointer :: places(:, :)
    real(c_double), allocatable, target :: values(:)
    integer :: ierr
    call component%get_grid(grid)
    places => grid%cell_position()
    allocate (values(grid%n_cells()), source=0d0)
    imports = component%import_state()
    field = imports%field("surface_northward_sea_water_velocity")
    call field%store(values, ierr)
    where (places(3, :) > 0.6d0) values = merge(0.6d0, -0.6d0, mod(day, 2) == 0)
    field = imports%field("surface_eastward_sea_water_velocity")
    call field%store(values, ierr)
    call component%run(imports, component%export_state(), clock, ierr)
    call expect(ierr == DELOS_SUCCESS, "run succeeds: "//component%message())
    call clock%advance()
  end subroutine

  subroutine test_values(carrier, before, after, is_shown)
    type(delos_transfer), intent(in) :: carrier
    type(delos_grid), intent(in) :: before, after
    logical, intent(in) :: is_shown
    real(c_double), pointer :: places(:, :), old_area_m2(:), area_m2(:)
    real(c_double), allocatable :: old(:), depth(:), old_levels(:, :), levels(:, :)
    real(c_double), allocatable :: old_u(:), u(:), by_stream(:)
    integer :: ierr
    places => before%cell_position()
    old = 1 + places(3, :)**2
    allocate (depth(after%n_cells()))
    call carrier%apply(old, depth, ierr=ierr)
    call expect(ierr == DELOS_SUCCESS, "a field is carried: "//carrier%message())
    if (is_shown) call show(depth)
    old_area_m2 => before%cell_area_m2()
    area_m2 => after%cell_area_m2()
    call expect(abs(sum(depth*area_m2)/sum(old*old_area_m2) - 1) < 1d-14, "the mass is kept")
    call expect(minval(depth) >= minval(old), "no new extremes")
    allocate (old_levels(2, size(old)), levels(2, size(depth)))
    old_levels(1, :) = old
    old_levels(2, :) = 1
    call carrier%apply(old_levels, levels, ierr=ierr)
    call expect(ierr == DELOS_SUCCESS .and. all(abs(levels(1, :) - depth) <= 0), "level by level")
    call expect(all(abs(levels(2, :) - 1) <= 0), "a constant stays")
    call carrier%apply(old, depth, order=DELOS_ORDER_FIRST, limiter=DELOS_LIMITER_NONE, ierr=ierr)
    call expect(ierr == DELOS_SUCCESS .and. any(abs(levels(1, :) - depth) > 0), "the first order")
    allocate (old_u(before%n_edges()), source=0d0)
    allocate (u(after%n_edges()))
    old_u(1) = 1
    call carrier%apply_velocity(old_u, u, route=DELOS_VELOCITY_STREAM_FUNCTION, ierr=ierr)
    call expect(ierr == DELOS_SUCCESS .and. any(abs(u) > 0), "velocities")
    allocate (by_stream, source=u)
    call carrier%apply_velocity(old_u, u, route=DELOS_VELOCITY_HELMHOLTZ, ierr=ierr)
    call expect(ierr == DELOS_SUCCESS .and. any(abs(u - by_stream) > 0), "by their potentials")
    call carrier%apply_velocity(old, u, ierr=ierr)
    call expect(ierr == DELOS_ERROR_INPUT, "sizes count")
    call expect(index(carrier%message(), "generation 1") > 0, "and the message has the grids")
  end subroutine

  ! From the cells of a disc to those of the whole sphere.
  subroutine test_border()
    type(delos_config) :: config
    type(delos_grid) :: part, whole
    type(delos_transfer) :: carrier
    real(c_double), pointer :: part_m2(:), whole_m2(:)
    real(c_double), allocatable :: ones(:), means(:), shares(:)
    integer :: ierr
    integer(c_int64_t) :: n_bare
    call config%from_text("sizing: {sources: [{type: constant, spacing: 900 km}]}"//new_line("a")// &
                          "refine: {tile_vertices: 500}")
    call whole%generate(config)
    call config%set("region", "{disc: {centre: [10 deg, 50 deg], radius: 3000 km}}")
    call config%set("sizing.sources.0.spacing", "500 km")
    call part%generate(config, ierr=ierr)
    call expect(ierr == DELOS_SUCCESS, "a part: "//part%message())
    call carrier%create(part, whole, ierr=ierr)
    n_bare = carrier%n_unmapped()
    call expect(n_bare > 0 .and. n_bare < whole%n_cells(), "some cells are bare")
    allocate (ones(part%n_cells()), source=1d0)
    allocate (means(whole%n_cells()), shares(whole%n_cells()))
    call carrier%apply(ones, means, ierr=ierr)
    call expect(ierr == DELOS_SUCCESS .and. count(ieee_is_nan(means)) == n_bare, "bare cells get NaN")
    call expect(all(ieee_is_nan(means) .or. abs(means - 1) <= 0), "a constant stays where there is any")
    call carrier%apply(ones, shares, normalization=DELOS_NORMALIZATION_WHOLE, ierr=ierr)
    part_m2 => part%cell_area_m2()
    whole_m2 => whole%cell_area_m2()
    call expect(abs(sum(shares*whole_m2, .not. ieee_is_nan(shares))/sum(part_m2) - 1) < 1d-13, &
                "the mass is kept")
    call carrier%apply(ones, means, limiter=DELOS_LIMITER_ASSURED_SUM, ierr=ierr)
    call expect(ierr == DELOS_ERROR_INPUT, "no assured sum with a border")
    call carrier%apply(ones, means, normalization=2, ierr=ierr)
    call expect(ierr == DELOS_ERROR_ARGUMENT .and. index(carrier%message(), "normalization = 2") > 0, &
                "no such normalization")
  end subroutine

  ! Their bits.
  subroutine show(values)
    real(c_double), intent(in) :: values(:)
    integer :: i
    do i = 1, size(values)
      write (output_unit, "(z16.16)") transfer(values(i), 0_c_int64_t)
    end do
  end subroutine
end module fortran_transfer_test

program main
  use fortran_transfer_test
  implicit none
  type(delos_component) :: component
  type(delos_clock) :: clock
  type(delos_grid) :: before, after
  type(delos_transfer) :: carrier
  character(len=16) :: argument
  integer :: ierr
  call get_command_argument(1, argument)
  call create(component, clock)
  call component%set_log(on_log)
  call component%get_grid(before)
  call expect(component%remesh_decision() == "", "no alarm yet")
  call run_day(component, clock, 0)
  call run_day(component, clock, 1)
  call expect(index(component%remesh_decision(), "remesh") > 0, "why it remeshed")
  call expect(component%remesh_failure() == "", "it did not fail")
  call expect(has_heard .and. decision == component%remesh_decision(), "the log has the decision")
  call component%get_grid(after, ierr)
  call expect(before%generation() == 1 .and. after%generation() == 2, "two generations")
  call carrier%create(before, after, ierr=ierr)
  call expect(ierr == DELOS_SUCCESS, "a transfer: "//carrier%message())
  call carrier%check(after, before, ierr)
  call expect(ierr == DELOS_ERROR_STATE, "the wrong way round")
  call expect(carrier%n_overlaps() >= after%n_cells() .and. carrier%n_unchanged() > 0 &
              .and. carrier%n_unmapped() == 0, "numbers")
  call component%destroy()
  call expect(len(before%digest()) == 64, "a grid outlives its component")
  call test_values(carrier, before, after, argument == "values")
  if (argument /= "values") call test_border()
  call carrier%destroy()
  call expect(carrier%n_overlaps() == 0, "a destroyed transfer is empty")
  call before%destroy()
  call after%destroy()
  call clock%destroy()
  if (n_failed > 0) error stop 1
end program
