! SPDX-License-Identifier: BSD-3-Clause
! What the types of module delos_mpi have in common: a handle, and options for making what it holds.
module delos_mpi_objects
  use, intrinsic :: iso_c_binding, only: c_associated, c_double, c_funloc, c_int, c_int64_t, &
    c_null_ptr, c_ptr
  use delos_mpi_binding, only: c_options
  implicit none
  private
  public :: delos_mpi_object, delos_mpi_weight

  ! Where a field's values are.
  integer, parameter, public :: DELOS_MPI_CELL = 0, DELOS_MPI_EDGE = 1, DELOS_MPI_VERTEX = 2
  ! How cells are shared out: automatic is METIS's k-way method where delos has it, else the curve.
  integer, parameter, public :: DELOS_MPI_AUTOMATIC = 0, DELOS_MPI_KWAY = 1, DELOS_MPI_CURVE = 2
  ! What a cell counts: automatic is its wet layers where the grid has them, else each the same.
  integer, parameter, public :: DELOS_MPI_WORK_AUTOMATIC = 0, DELOS_MPI_WORK_CELLS = 1, &
    DELOS_MPI_WORK_LAYERS = 2

  abstract interface
    ! The work of each cell from lon_lat (2, n_cells) in radians; called on
    ! the generating process. 0, or another number to fail.
    function delos_mpi_weight(n_cells, lon_lat, weight, user_data) bind(c) result(status)
      import :: c_double, c_int, c_int64_t, c_ptr
      integer(c_int64_t), value :: n_cells
      real(c_double), intent(in) :: lon_lat(2, n_cells)
      real(c_double), intent(out) :: weight(n_cells)
      type(c_ptr), value :: user_data
      integer(c_int) :: status
    end function
  end interface

  ! The parts are for the modules of this folder.
  type, abstract :: delos_mpi_object
    type(c_ptr) :: handle = c_null_ptr
    type(c_options) :: options
  contains
    procedure :: set_options
    procedure :: set_weight
    procedure, private :: refuse_assignment
    generic :: assignment(=) => refuse_assignment
  end type

contains

  ! For what is made next; without an argument: the default (threads as configured, root 0, one halo
  ! layer). root and halo_layers must be the same everywhere.
  subroutine set_options(self, threads, root, halo_layers, method, work)
    class(delos_mpi_object), intent(inout) :: self
    integer, intent(in), optional :: threads, root, halo_layers, method, work
    self%options%n_threads = 0
    self%options%root = 0
    self%options%halo_layers = 1
    self%options%method = DELOS_MPI_AUTOMATIC
    self%options%work = DELOS_MPI_WORK_AUTOMATIC
    if (present(threads)) self%options%n_threads = int(threads, c_int)
    if (present(root)) self%options%root = int(root, c_int)
    if (present(halo_layers)) self%options%halo_layers = int(halo_layers, c_int)
    if (present(method)) self%options%method = int(method, c_int)
    if (present(work)) self%options%work = int(work, c_int)
  end subroutine

  ! The work of the cells, for what is made next, in the place of `work`.
  subroutine set_weight(self, weight)
    class(delos_mpi_object), intent(inout) :: self
    procedure(delos_mpi_weight) :: weight
    self%options%cell_weight = c_funloc(weight)
  end subroutine

  ! Two objects of one handle would free it twice: the left side stays as it is.
  subroutine refuse_assignment(self, other)
    class(delos_mpi_object), intent(inout) :: self
    class(delos_mpi_object), intent(in) :: other
    if (.not. c_associated(self%handle, other%handle)) return
  end subroutine
end module delos_mpi_objects
