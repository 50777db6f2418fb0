! SPDX-License-Identifier: BSD-3-Clause
! delos over MPI for Fortran 2008: a grid made once by one process of a communicator, handed out part
! by part, or a component over them. Adapts delos/delos_mpi.h.
!
!   use delos_mpi
!   type(delos_mpi_grid) :: grid
!   call grid%generate(MPI_COMM_WORLD, "world_ocean.yaml", ierr=ierr)    ! an integer communicator
!   if (ierr /= DELOS_SUCCESS) call model_stop(grid%message())
!   area_m2 => grid%cell_area_m2()                    ! owned cells first, then the halo
!   call grid%exchange(thickness_m, DELOS_MPI_CELL)   ! the halo from its owners
!   call grid%destroy()                               ! before MPI_Finalize
!
!   call component%create(MPI_COMM_WORLD, "world_ocean.yaml", ierr)
!   call component%initialize(ierr)
!   call component%get_grid(grid)                     ! my part, until there is a new grid
!   do while (.not. clock%is_done())                  ! a delos_clock of module delos
!     call component%set_import("eddy_kinetic_energy", eke)            ! of the owned cells
!     call component%run(clock, ierr=ierr)
!     call clock%advance()
!   end do
!
! A communicator of module mpi_f08 gives its integer as comm%MPI_VAL. generate, destroy, exchange,
! gather and scatter are collective; of the component all but its questions, set_import and get_grid. ierr as in module delos: optional, 0 or a status; message() is
! the text of the last failure. Ids are local with base 0, -1 beyond the halo; delos_one_based()
! copies them with base 1, 0 beyond the halo. Pointers are valid until destroy() or generate().
module delos_mpi
  use, intrinsic :: iso_c_binding, only: c_double, c_int, c_int32_t, c_int64_t
  use delos
  use delos_mpi_components, only: delos_mpi_component, delos_mpi_item
  use delos_mpi_grids, only: delos_mpi_grid
  use delos_mpi_objects
  implicit none
  public
end module delos_mpi
