! SPDX-License-Identifier: BSD-3-Clause
! A Fortran model on many processes: the grid is made when it starts, each process gets its part, and
! a clock loop diffuses a tracer with one halo exchange a step.
program host_mpi_fortran
  use, intrinsic :: iso_fortran_env, only: error_unit
  use mpi
  use delos_mpi
  implicit none
  real(c_double), parameter :: STEP_S = 3600, STOP_S = 86400, DIFFUSIVITY_M2_S = 1e5_c_double
  type(delos_mpi_grid) :: grid
  real(c_double), pointer :: area_m2(:), length_m(:), distance_m(:), lon_lat(:, :)
  integer(c_int64_t), allocatable :: first(:)
  integer(c_int32_t), allocatable :: edges(:), neighbours(:)
  real(c_double), allocatable :: tracer(:)
  real(c_double) :: time_s
  integer :: rank, ierr, thread_level, n_owned
  character(len=4096) :: path

  ! The threads of delos work on rank 0 while MPI is called from this one alone.
  call MPI_Init_thread(MPI_THREAD_FUNNELED, thread_level, ierr)
  call MPI_Comm_rank(MPI_COMM_WORLD, rank, ierr)
  call get_command_argument(1, path)
  call grid%generate(MPI_COMM_WORLD, path, ierr)
  call check(ierr)
  call read_grid()
  call start_tracer()
  call print_totals("start")

  time_s = 0
  do while (time_s < STOP_S)
    call diffuse()
    call grid%exchange(tracer, DELOS_MPI_CELL, ierr)      ! the halo from its owners
    call check(ierr)
    time_s = time_s + STEP_S
  end do

  call print_totals("end")
  call grid%destroy()
  call MPI_Finalize(ierr)

contains

  ! A failure anywhere is everywhere: one process says it.
  subroutine check(status)
    integer, intent(in) :: status
    integer :: ignored
    if (status == DELOS_SUCCESS) return
    if (rank == 0) write (error_unit, "(2a)") "host_mpi_fortran: ", grid%message()
    call grid%destroy()
    call MPI_Finalize(ignored)
    error stop 1
  end subroutine

  ! Areas and lengths are pointers into the part; ids are copied with base 1, 0 beyond the halo.
  subroutine read_grid()
    n_owned = int(grid%n_owned(DELOS_MPI_CELL))
    area_m2 => grid%cell_area_m2()
    lon_lat => grid%cell_lon_lat()
    length_m => grid%vertex_distance_m()
    distance_m => grid%cell_distance_m()
    allocate (first, source=delos_one_based(grid%cell_offsets()))
    allocate (edges, source=delos_one_based(grid%edges_on_cell()))
    allocate (neighbours, source=delos_one_based(grid%cells_on_cell()))
  end subroutine

  ! Warm in the north.
  subroutine start_tracer()
    allocate (tracer(size(area_m2)))
    tracer = merge(1, 0, lon_lat(2, :) > 0)
  end subroutine

  ! What leaves a cell through an edge comes to the other: the flux is the same seen from both.
  subroutine diffuse()
    real(c_double) :: flux
    real(c_double), allocatable :: change(:)
    integer(c_int64_t) :: j
    integer :: cell
    allocate (change(n_owned))
    do cell = 1, n_owned
      change(cell) = 0
      do j = first(cell), first(cell + 1) - 1
        flux = DIFFUSIVITY_M2_S*length_m(edges(j))/distance_m(edges(j))
        change(cell) = change(cell) + flux*(tracer(neighbours(j)) - tracer(cell))
      end do
    end do
    tracer(:n_owned) = tracer(:n_owned) + STEP_S*change/area_m2(:n_owned)
  end subroutine

  ! Each process counts what it owns, so that nothing counts twice.
  subroutine print_totals(when)
    character(len=*), intent(in) :: when
    real(c_double) :: mine(3), all(3)
    integer :: ignored
    mine = [real(n_owned, c_double), sum(area_m2(:n_owned)), &
            sum(area_m2(:n_owned)*tracer(:n_owned))]
    call MPI_Reduce(mine, all, 3, MPI_DOUBLE_PRECISION, MPI_SUM, 0, MPI_COMM_WORLD, ignored)
    if (rank /= 0) return
    if (when == "start") then
      print "(a, i0)", "cells: ", nint(all(1))
      print "(a, es17.10e2, a)", "total area: ", all(2), " m2"
    end if
    print "(3a, f12.10)", "tracer at the ", when, ": ", all(3)/all(2)
  end subroutine
end program
