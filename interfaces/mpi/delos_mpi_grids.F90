! SPDX-License-Identifier: BSD-3-Clause
! A grid over processes, and its fields.
module delos_mpi_grids
  use, intrinsic :: iso_c_binding, only: c_double, c_int, c_int64_t, c_null_ptr
  use delos_binding, only: DELOS_SUCCESS
  use delos_mpi_binding
  use delos_mpi_levels, only: delos_mpi_levels_of_part
  use delos_objects, only: from_c, report_status, to_c
  implicit none
  private
  public :: delos_mpi_grid

  type, extends(delos_mpi_levels_of_part) :: delos_mpi_grid
  contains
    procedure :: generate
    procedure :: generate_from_text
    procedure :: destroy
    procedure :: message
    procedure, private :: exchange_vector, exchange_table
    generic :: exchange => exchange_vector, exchange_table
    procedure :: gather
    procedure :: scatter
  end type

contains

  ! The file is read by the generating process only. The former grid of this object is gone.
  subroutine generate(self, comm, path, ierr)
    class(delos_mpi_grid), intent(inout) :: self
    integer, intent(in) :: comm
    character(len=*), intent(in) :: path
    integer, intent(out), optional :: ierr
    call self%destroy()
    call report_status(c_generate_file(int(comm, c_int), to_c(path), self%options, self%handle), ierr)
  end subroutine

  ! YAML with new_line() between lines; file names in it are relative to `folder`.
  subroutine generate_from_text(self, comm, yaml, folder, ierr)
    class(delos_mpi_grid), intent(inout) :: self
    integer, intent(in) :: comm
    character(len=*), intent(in) :: yaml
    character(len=*), intent(in), optional :: folder
    integer, intent(out), optional :: ierr
    character(len=:), allocatable :: base
    base = "."
    if (present(folder)) base = trim(folder)
    call self%destroy()
    call report_status(c_generate_text(int(comm, c_int), to_c(yaml), to_c(base), &
                                       self%options, self%handle), ierr)
  end subroutine

  ! Collective, and not left to the end of a scope: that end comes at other times elsewhere, or
  ! after MPI_Finalize.
  subroutine destroy(self)
    class(delos_mpi_grid), intent(inout) :: self
    integer(c_int) :: status
    status = c_destroy(self%handle)
    if (status == DELOS_SUCCESS) self%handle = c_null_ptr
  end subroutine

  function message(self)
    class(delos_mpi_grid), intent(in) :: self
    character(len=:), allocatable :: message
    message = from_c(c_last_error(self%handle))
  end function

  ! --- fields: (n_local) or (n_components, n_local), owned ones first

  ! Sets the halo to the owners' values.
  subroutine exchange_vector(self, values, location, ierr)
    class(delos_mpi_grid), intent(in) :: self
    real(c_double), intent(inout), contiguous :: values(:)
    integer, intent(in) :: location
    integer, intent(out), optional :: ierr
    call report_status(c_exchange(self%handle, values, size(values, kind=c_int64_t), &
                           int(location, c_int), 1_c_int), ierr)
  end subroutine

  subroutine exchange_table(self, values, location, ierr)
    class(delos_mpi_grid), intent(in) :: self
    real(c_double), intent(inout), contiguous :: values(:, :)
    integer, intent(in) :: location
    integer, intent(out), optional :: ierr
    call report_status(c_exchange(self%handle, values, size(values, kind=c_int64_t), &
                           int(location, c_int), size(values, 1, c_int)), ierr)
  end subroutine

  ! The owned or all local values -> whole (n_global) on the generating process; elsewhere `whole`
  ! may have any size.
  subroutine gather(self, values, location, whole, ierr)
    class(delos_mpi_grid), intent(in) :: self
    real(c_double), intent(in), contiguous :: values(:)
    integer, intent(in) :: location
    real(c_double), intent(inout), contiguous :: whole(:)
    integer, intent(out), optional :: ierr
    call report_status(c_gather(self%handle, values, size(values, kind=c_int64_t), int(location, c_int), &
                         1_c_int, whole), ierr)
  end subroutine

  ! And back, into all local places.
  subroutine scatter(self, whole, location, values, ierr)
    class(delos_mpi_grid), intent(in) :: self
    real(c_double), intent(in), contiguous :: whole(:)
    integer, intent(in) :: location
    real(c_double), intent(inout), contiguous :: values(:)
    integer, intent(out), optional :: ierr
    call report_status(c_scatter(self%handle, whole, int(location, c_int), 1_c_int, values, &
                          size(values, kind=c_int64_t)), ierr)
  end subroutine
end module delos_mpi_grids
