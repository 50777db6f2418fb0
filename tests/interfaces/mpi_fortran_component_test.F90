! SPDX-License-Identifier: BSD-3-Clause
! A Fortran model on some processes: a component that remeshes and restarts; prints nothing but its
! failures.
!   mpiexec -n N mpi_fortran_model RESTART_FILE
program mpi_fortran_component_test
  use, intrinsic :: iso_fortran_env, only: error_unit
  use mpi
  use delos_mpi
  implicit none
  character(len=*), parameter :: CONFIG = &
    "sizing: {sources: [{type: constant, spacing: 1200 km}], gradient_limit: 0.3,"//new_line("a")// &
    "         resolution: 4 deg, clamp: {min: 300 km, max: 2000 km}}"//new_line("a")// &
    "refine: {tile_vertices: 500}"//new_line("a")// &
    "remesh:"//new_line("a")// &
    "  interval: P2D"//new_line("a")// &
    "  sources: [{type: eke, quiet: [0.05 m/s, 1200 km], energetic: [0.5 m/s, 500 km]}]"//new_line("a")
  type(delos_mpi_component) :: component, restarted
  type(delos_mpi_grid) :: before, after, again
  type(delos_clock) :: clock
  real(c_double), allocatable :: depth_m(:, :), moved_m(:, :), velocity(:), moved(:)
  real(c_double), pointer :: area_m2(:)
  logical :: is_new
  integer :: rank, n_ranks, ierr, n_failed = 0
  character(len=4096) :: path
  call MPI_Init(ierr)
  call MPI_Comm_rank(MPI_COMM_WORLD, rank, ierr)
  call MPI_Comm_size(MPI_COMM_WORLD, n_ranks, ierr)
  call get_command_argument(1, path)

  call clock%create("2001-01-01", "P1D", ierr=ierr)
  call component%set_options(threads=1)
  call component%create_from_text(MPI_COMM_WORLD, CONFIG, ierr=ierr)
  call check(ierr == DELOS_SUCCESS, "create: "//component%message())
  call component%run(clock, ierr=ierr)
  call check(ierr == DELOS_ERROR_STATE .and. index(component%message(), "created") > 0, "order")
  call component%advertise(ierr)
  call component%realize(ierr)
  call component%initialize(ierr)
  call check(ierr == DELOS_SUCCESS, "initialize: "//component%message())
  call check_items()
  call run_day(component, is_new)
  call check(.not. is_new .and. component%current_time() == "2001-01-02T00:00:00", "a day")
  call component%write_restart(path, clock, ierr)
  call check(ierr == DELOS_SUCCESS, "write_restart: "//component%message())

  call component%get_grid(before, ierr)
  allocate (depth_m(2, before%n_owned(DELOS_MPI_CELL)), source=4000.0_c_double)
  allocate (velocity(before%n_local(DELOS_MPI_EDGE)), source=0.0_c_double)
  call run_day(component, is_new)
  call check(is_new .and. component%generation() == 2, "a new grid")
  call check(index(component%remesh_decision(), "remesh at 2001-01-03") == 1, "decision")
  call check(component%remesh_failure() == "", "no failure")
  call component%get_grid(after, ierr)
  allocate (moved_m(2, after%n_local(DELOS_MPI_CELL)), moved(after%n_local(DELOS_MPI_EDGE)))
  call component%transfer(depth_m, moved_m, order=DELOS_ORDER_FIRST, ierr=ierr)
  call check(ierr == DELOS_SUCCESS .and. all(abs(moved_m - 4000) < 1e-9_c_double), "transfer")
  call component%transfer(depth_m(1, :), moved_m(1, :), ierr=ierr)
  call check(ierr == DELOS_SUCCESS .and. all(abs(moved_m - 4000) < 1e-9_c_double), "of a vector")
  call component%transfer_velocity(velocity, moved, DELOS_VELOCITY_VECTORS, ierr)
  call check(ierr == DELOS_SUCCESS .and. all(abs(moved) < 1e-30_c_double), "of velocities")
  call component%transfer(depth_m(:, 2:), moved_m, ierr=ierr)
  call check(ierr == DELOS_ERROR_INPUT, "a wrong size")

  call restarted%set_options(threads=1, root=n_ranks - 1)
  call restarted%create_from_text(MPI_COMM_WORLD, CONFIG, ierr=ierr)
  call restarted%advertise()
  call MPI_Barrier(MPI_COMM_WORLD, ierr)
  call restarted%read_restart(path, clock, ierr)
  call check(ierr == DELOS_SUCCESS, "read_restart: "//restarted%message())
  call check(clock%current() == "2001-01-02T00:00:00", "the clock written")
  call run_day(restarted, is_new)
  call restarted%get_grid(again)
  call check(is_new .and. again%digest() == after%digest(), "the same grid")
  call restarted%finalize(ierr)
  call check(ierr == DELOS_SUCCESS .and. restarted%generation() == 0, "finalize")
  call component%create(MPI_COMM_WORLD, "/nowhere.yaml", ierr)
  call check(ierr == DELOS_ERROR_INPUT, "a missing file is an input error")
  call check(index(component%message(), "/nowhere.yaml") > 0, "and named: "//component%message())

  call before%destroy()
  call after%destroy()
  call again%destroy()
  call restarted%destroy()
  call component%destroy()
  call MPI_Finalize(ierr)
  if (n_failed > 0) error stop 1

contains

  subroutine check(holds, what)
    logical, intent(in) :: holds
    character(len=*), intent(in) :: what
    if (holds) return
    n_failed = n_failed + 1
    write (error_unit, "(a, i0, 2a)") "rank ", rank, ": not so: ", what
  end subroutine

  subroutine check_items()
    type(delos_mpi_item) :: item
    call component%get_import_item(1, item, ierr)
    call check(item%name == "surface_eastward_sea_water_velocity", "an import's name")
    call component%get_export_item(1, item, ierr)
    call check(item%name == "cell_area" .and. item%units == "m2", "an export")
    call check(item%location == DELOS_LOCATION_CELL .and. item%n_components == 1, "its place")
    call component%get_export_item(99, item, ierr)
    call check(ierr == DELOS_ERROR_NOT_FOUND, "no such export")
    call component%get_grid(before, ierr)
    area_m2 => component%get_export("cell_area", ierr)
    call check(all(abs(area_m2 - before%cell_area_m2()) <= 0), "areas")
    area_m2 => component%get_export("x", ierr)
    call check(ierr == DELOS_ERROR_STATE .and. .not. associated(area_m2), "an unknown export")
  end subroutine

  ! Currents to and fro in the north.
  subroutine run_day(model, is_new_grid)
    type(delos_mpi_component), intent(inout) :: model
    logical, intent(out) :: is_new_grid
    type(delos_mpi_grid) :: grid
    real(c_double), pointer :: position(:, :)
    real(c_double), allocatable :: east(:)
    real(c_double) :: speed
    integer :: n
    call model%get_grid(grid)
    n = int(grid%n_owned(DELOS_MPI_CELL))
    position => grid%cell_position()
    speed = merge(0.6_c_double, -0.6_c_double, mod(clock%advance_count(), 2_c_int64_t) == 0)
    east = merge(speed, 0.0_c_double, position(3, :n) > 0)
    call model%set_import("surface_eastward_sea_water_velocity", east)
    call model%set_import("surface_northward_sea_water_velocity", 0*east)
    call model%run(clock, is_new_grid, ierr)
    call check(ierr == DELOS_SUCCESS, "run: "//model%message())
    call clock%advance()
    call grid%destroy()
  end subroutine
end program
