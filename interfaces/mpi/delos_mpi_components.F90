! SPDX-License-Identifier: BSD-3-Clause
! A component over processes. mpi/delos/mpi_component.h says what each procedure does; all but the
! questions, set_import, get_export and get_grid are collective.
module delos_mpi_components
  use, intrinsic :: iso_c_binding, only: c_double, c_f_pointer, c_int, c_int64_t, c_null_ptr, c_ptr
  use delos_binding, only: DELOS_SUCCESS
  use delos_clocks, only: delos_clock
  use delos_mpi_component_binding
  use delos_mpi_grids, only: delos_mpi_grid
  use delos_mpi_objects, only: delos_mpi_object
  use delos_objects, only: count_of, from_c, report_status, text_of, to_c
  use delos_transfers, only: transfer_options
  implicit none
  private
  public :: delos_mpi_component, delos_mpi_item

  ! What an item of a state is; location is one of DELOS_LOCATION_*.
  type :: delos_mpi_item
    character(len=:), allocatable :: name, standard_name, units, long_name
    integer :: location = 0, n_components = 0
  end type

  type, extends(delos_mpi_object) :: delos_mpi_component
  contains
    procedure :: create
    procedure :: create_from_text
    procedure :: destroy
    procedure :: message
    procedure :: advertise
    procedure :: realize
    procedure :: initialize
    procedure :: run
    procedure :: write_restart
    procedure :: read_restart
    procedure :: finalize
    procedure, private :: transfer_vector, transfer_table
    generic :: transfer => transfer_vector, transfer_table
    procedure :: transfer_velocity
    procedure :: get_import_item     ! (i, item) the i-th import, from 1
    procedure :: get_export_item     ! (i, item) likewise
    procedure :: set_import          ! (name, values) of the owned places
    procedure :: get_export          ! (name) -> (n_components * n_local), or of the whole grid
    procedure :: get_grid
    procedure :: generation
    procedure :: current_time
    procedure :: remesh_decision
    procedure :: remesh_failure
  end type

  integer(c_int), parameter :: imports = 0, exports = 1

contains

  ! The file is read by the generating process only. The former component of this object is gone.
  subroutine create(self, comm, path, ierr)
    class(delos_mpi_component), intent(inout) :: self
    integer, intent(in) :: comm
    character(len=*), intent(in) :: path
    integer, intent(out), optional :: ierr
    call self%destroy()
    call report_status(c_create_file(int(comm, c_int), to_c(path), self%options, self%handle), ierr)
  end subroutine

  ! YAML with new_line() between lines; file names in it are relative to `folder`.
  subroutine create_from_text(self, comm, yaml, folder, ierr)
    class(delos_mpi_component), intent(inout) :: self
    integer, intent(in) :: comm
    character(len=*), intent(in) :: yaml
    character(len=*), intent(in), optional :: folder
    integer, intent(out), optional :: ierr
    character(len=:), allocatable :: base
    base = "."
    if (present(folder)) base = folder
    call self%destroy()
    call report_status(c_create_text(int(comm, c_int), to_c(yaml), to_c(base), self%options, &
                                     self%handle), ierr)
  end subroutine

  ! Before MPI_Finalize, and not left to the end of a scope.
  subroutine destroy(self)
    class(delos_mpi_component), intent(inout) :: self
    integer(c_int) :: status
    status = c_component_destroy(self%handle)
    if (status == DELOS_SUCCESS) self%handle = c_null_ptr
  end subroutine

  function message(self)
    class(delos_mpi_component), intent(in) :: self
    character(len=:), allocatable :: message
    message = from_c(c_component_error(self%handle))
  end function

  subroutine advertise(self, ierr)
    class(delos_mpi_component), intent(inout) :: self
    integer, intent(out), optional :: ierr
    call report_status(c_advertise(self%handle), ierr)
  end subroutine

  subroutine realize(self, ierr)
    class(delos_mpi_component), intent(inout) :: self
    integer, intent(out), optional :: ierr
    call report_status(c_realize(self%handle), ierr)
  end subroutine

  subroutine initialize(self, ierr)
    class(delos_mpi_component), intent(inout) :: self
    integer, intent(out), optional :: ierr
    call report_status(c_initialize(self%handle), ierr)
  end subroutine

  subroutine finalize(self, ierr)
    class(delos_mpi_component), intent(inout) :: self
    integer, intent(out), optional :: ierr
    call report_status(c_finalize(self%handle), ierr)
  end subroutine

  ! From the clock's current time to its next; whether the grid was made anew.
  subroutine run(self, clock, is_new_grid, ierr)
    class(delos_mpi_component), intent(inout) :: self
    type(delos_clock), intent(in) :: clock
    logical, intent(out), optional :: is_new_grid
    integer, intent(out), optional :: ierr
    integer(c_int) :: is_new, status
    status = c_run(self%handle, clock%handle, is_new)
    if (present(is_new_grid)) is_new_grid = status == DELOS_SUCCESS .and. is_new == 1
    call report_status(status, ierr)
  end subroutine

  subroutine write_restart(self, path, clock, ierr)
    class(delos_mpi_component), intent(in) :: self
    character(len=*), intent(in) :: path
    type(delos_clock), intent(in) :: clock
    integer, intent(out), optional :: ierr
    call report_status(c_write_restart(self%handle, to_c(path), clock%handle), ierr)
  end subroutine

  ! In the place of realize; every clock becomes the one written.
  subroutine read_restart(self, path, clock, ierr)
    class(delos_mpi_component), intent(inout) :: self
    character(len=*), intent(in) :: path
    type(delos_clock), intent(inout) :: clock
    integer, intent(out), optional :: ierr
    call report_status(c_read_restart(self%handle, to_c(path), clock%handle), ierr)
  end subroutine

  ! Means over cells, (n_owned) or more of the former grid -> (n_local) of the new one. Without an
  ! order, a limiter and a normalization: the second, of gradients, covered.
  subroutine transfer_vector(self, former, values, order, limiter, normalization, ierr)
    class(delos_mpi_component), intent(in) :: self
    real(c_double), intent(in), contiguous :: former(:)
    real(c_double), intent(inout), contiguous :: values(:)
    integer, intent(in), optional :: order, limiter, normalization
    integer, intent(out), optional :: ierr
    call report_status(c_transfer(self%handle, former, size(former, kind=c_int64_t), values, &
                                  size(values, kind=c_int64_t), &
                                  transfer_options(1, order, limiter, &
                                                   normalization=normalization)), ierr)
  end subroutine

  ! (n_levels, n_owned) -> (n_levels, n_local).
  subroutine transfer_table(self, former, values, order, limiter, normalization, ierr)
    class(delos_mpi_component), intent(in) :: self
    real(c_double), intent(in), contiguous :: former(:, :)
    real(c_double), intent(inout), contiguous :: values(:, :)
    integer, intent(in), optional :: order, limiter, normalization
    integer, intent(out), optional :: ierr
    call report_status(c_transfer(self%handle, former, size(former, kind=c_int64_t), values, &
                                  size(values, kind=c_int64_t), &
                                  transfer_options(size(former, 1), order, limiter, &
                                                   normalization=normalization)), ierr)
  end subroutine

  ! Velocities along the normals of edges.
  subroutine transfer_velocity(self, former, values, route, ierr)
    class(delos_mpi_component), intent(in) :: self
    real(c_double), intent(in), contiguous :: former(:)
    real(c_double), intent(inout), contiguous :: values(:)
    integer, intent(in), optional :: route
    integer, intent(out), optional :: ierr
    call report_status(c_transfer_velocity(self%handle, former, size(former, kind=c_int64_t), &
                                           values, size(values, kind=c_int64_t), &
                                           transfer_options(1, route=route)), ierr)
  end subroutine

  ! --- known to each process

  subroutine get_item(self, intent, i, item, ierr)
    class(delos_mpi_component), intent(in) :: self
    integer(c_int), intent(in) :: intent
    integer, intent(in) :: i
    type(delos_mpi_item), intent(out) :: item
    integer, intent(out), optional :: ierr
    type(c_item) :: from
    integer(c_int) :: status
    status = c_item_of(self%handle, intent, int(i - 1, c_int), from)
    item%name = from_c(from%name)
    item%standard_name = from_c(from%standard_name)
    item%units = from_c(from%units)
    item%long_name = from_c(from%long_name)
    item%location = int(from%location)
    item%n_components = int(from%n_components)
    call report_status(status, ierr)
  end subroutine

  ! DELOS_ERROR_NOT_FOUND after the last.
  subroutine get_import_item(self, i, item, ierr)
    class(delos_mpi_component), intent(in) :: self
    integer, intent(in) :: i
    type(delos_mpi_item), intent(out) :: item
    integer, intent(out), optional :: ierr
    call get_item(self, imports, i, item, ierr)
  end subroutine

  subroutine get_export_item(self, i, item, ierr)
    class(delos_mpi_component), intent(in) :: self
    integer, intent(in) :: i
    type(delos_mpi_item), intent(out) :: item
    integer, intent(out), optional :: ierr
    call get_item(self, exports, i, item, ierr)
  end subroutine

  ! Copied; the next run judges them, for all processes.
  subroutine set_import(self, name, values, ierr)
    class(delos_mpi_component), intent(inout) :: self
    character(len=*), intent(in) :: name
    real(c_double), intent(in), contiguous :: values(:)
    integer, intent(out), optional :: ierr
    call report_status(c_set_import(self%handle, to_c(name), values, &
                                    size(values, kind=c_int64_t)), ierr)
  end subroutine

  ! Valid until the next run or finalize.
  function get_export(self, name, ierr) result(values)
    class(delos_mpi_component), intent(in) :: self
    character(len=*), intent(in) :: name
    integer, intent(out), optional :: ierr
    real(c_double), pointer :: values(:)
    type(c_ptr) :: first
    integer(c_int64_t) :: n
    integer(c_int) :: status
    status = c_get_export(self%handle, to_c(name), first, n)
    values => null()
    if (status == DELOS_SUCCESS) call c_f_pointer(first, values, [n])
    call report_status(status, ierr)
  end function

  ! This process's part of the current grid, which keeps it when the component goes on: to be
  ! destroyed on all processes.
  subroutine get_grid(self, grid, ierr)
    class(delos_mpi_component), intent(in) :: self
    type(delos_mpi_grid), intent(inout) :: grid
    integer, intent(out), optional :: ierr
    call grid%destroy()
    call report_status(c_component_grid(self%handle, grid%handle), ierr)
  end subroutine

  function generation(self, ierr) result(n)
    class(delos_mpi_component), intent(in) :: self
    integer, intent(out), optional :: ierr
    integer(c_int64_t) :: n
    n = count_of(self%handle, c_component_generation, ierr)
  end function

  ! Where the last run ended; "" before the first.
  function current_time(self, ierr) result(text)
    class(delos_mpi_component), intent(in) :: self
    integer, intent(out), optional :: ierr
    character(len=:), allocatable :: text
    text = text_of(self%handle, c_current_time, ierr)
  end function

  function remesh_decision(self, ierr) result(text)
    class(delos_mpi_component), intent(in) :: self
    integer, intent(out), optional :: ierr
    character(len=:), allocatable :: text
    text = text_of(self%handle, c_remesh_decision, ierr)
  end function

  function remesh_failure(self, ierr) result(text)
    class(delos_mpi_component), intent(in) :: self
    integer, intent(out), optional :: ierr
    character(len=:), allocatable :: text
    text = text_of(self%handle, c_remesh_failure, ierr)
  end function
end module delos_mpi_components
