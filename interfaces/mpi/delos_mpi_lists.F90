! SPDX-License-Identifier: BSD-3-Clause
! The numbers and lists of a process's part of a grid: how many, which ones, whose, what is exchanged.
module delos_mpi_lists
  use, intrinsic :: iso_c_binding, only: c_associated, c_double, c_f_pointer, c_int, c_int32_t, &
    c_int64_t, c_null_ptr, c_ptr
  use delos_binding, only: DELOS_SUCCESS
  use delos_mpi_binding
  use delos_mpi_objects, only: delos_mpi_object
  use delos_objects, only: from_c, report_status
  implicit none
  private
  public :: delos_mpi_lists_of_part

  ! What an empty list points to.
  integer(c_int32_t), target, save :: no_ids(0)

  type, extends(delos_mpi_object) :: delos_mpi_lists_of_part
  contains
    procedure :: generation
    procedure :: digest
    procedure :: n_local          ! (location) owned and halo
    procedure :: n_owned          ! (location) the first ones
    procedure :: n_global         ! (location) of the whole grid
    procedure :: global_id        ! (location) -> (n_local) base 0
    procedure :: owner            ! (location) -> (n_local) rank
    procedure :: layer_offsets    ! (location) where the halo's layers begin, base 0; 0 is owned
    procedure :: neighbours       ! (location) ranks to exchange with
    procedure :: send_offsets     ! (location) -> (n_neighbours + 1) into send_ids
    procedure :: send_ids         ! (location) what a neighbour needs
    procedure :: receive_offsets  ! (location) -> (n_neighbours + 1) into receive_ids
    procedure :: receive_ids      ! (location) what comes from it
  end type

contains

  function generation(self, ierr) result(n)
    class(delos_mpi_lists_of_part), intent(in) :: self
    integer, intent(out), optional :: ierr
    integer(c_int64_t) :: n
    n = 0
    call report_status(c_generation(self%handle, n), ierr)
  end function

  ! SHA-256 of the whole grid.
  function digest(self, ierr) result(string)
    class(delos_mpi_lists_of_part), intent(in) :: self
    integer, intent(out), optional :: ierr
    character(len=:), allocatable :: string
    type(c_ptr) :: text
    call report_status(c_digest(self%handle, text), ierr)
    string = from_c(text)
  end function

  ! --- numbers and arrays of the part

  function count_of(self, getter, location, ierr) result(n)
    class(delos_mpi_lists_of_part), intent(in) :: self
    procedure(count_getter) :: getter
    integer, intent(in) :: location
    integer, intent(out), optional :: ierr
    integer(c_int64_t) :: n
    n = 0
    call report_status(getter(self%handle, int(location, c_int), n), ierr)
  end function

  subroutine get_list(self, getter, location, ids, ierr)
    class(delos_mpi_lists_of_part), intent(in) :: self
    procedure(list_getter) :: getter
    integer, intent(in) :: location
    integer(c_int32_t), pointer, intent(out) :: ids(:)
    integer, intent(out), optional :: ierr
    type(c_ptr) :: first
    integer(c_int64_t) :: n
    integer(c_int) :: status
    status = getter(self%handle, int(location, c_int), first, n)
    ids => null()
    if (status == DELOS_SUCCESS .and. n == 0) ids => no_ids
    if (status == DELOS_SUCCESS .and. n > 0) call c_f_pointer(first, ids, [n])
    call report_status(status, ierr)
  end subroutine

  subroutine get_offsets(self, getter, location, offsets, ierr)
    class(delos_mpi_lists_of_part), intent(in) :: self
    procedure(list_getter) :: getter
    integer, intent(in) :: location
    integer(c_int64_t), pointer, intent(out) :: offsets(:)
    integer, intent(out), optional :: ierr
    type(c_ptr) :: first
    integer(c_int64_t) :: n
    integer(c_int) :: status
    status = getter(self%handle, int(location, c_int), first, n)
    offsets => null()
    if (status == DELOS_SUCCESS) call c_f_pointer(first, offsets, [n])
    call report_status(status, ierr)
  end subroutine

  function n_local(self, location, ierr) result(n)
    class(delos_mpi_lists_of_part), intent(in) :: self
    integer, intent(in) :: location
    integer, intent(out), optional :: ierr
    integer(c_int64_t) :: n
    n = count_of(self, c_n_local, location, ierr)
  end function

  function n_owned(self, location, ierr) result(n)
    class(delos_mpi_lists_of_part), intent(in) :: self
    integer, intent(in) :: location
    integer, intent(out), optional :: ierr
    integer(c_int64_t) :: n
    n = count_of(self, c_n_owned, location, ierr)
  end function

  function n_global(self, location, ierr) result(n)
    class(delos_mpi_lists_of_part), intent(in) :: self
    integer, intent(in) :: location
    integer, intent(out), optional :: ierr
    integer(c_int64_t) :: n
    n = count_of(self, c_n_global, location, ierr)
  end function

  function global_id(self, location, ierr) result(ids)
    class(delos_mpi_lists_of_part), intent(in) :: self
    integer, intent(in) :: location
    integer, intent(out), optional :: ierr
    integer(c_int32_t), pointer :: ids(:)
    call get_list(self, c_global_id, location, ids, ierr)
  end function

  function owner(self, location, ierr) result(ids)
    class(delos_mpi_lists_of_part), intent(in) :: self
    integer, intent(in) :: location
    integer, intent(out), optional :: ierr
    integer(c_int32_t), pointer :: ids(:)
    call get_list(self, c_owner, location, ids, ierr)
  end function

  function neighbours(self, location, ierr) result(ids)
    class(delos_mpi_lists_of_part), intent(in) :: self
    integer, intent(in) :: location
    integer, intent(out), optional :: ierr
    integer(c_int32_t), pointer :: ids(:)
    call get_list(self, c_neighbours, location, ids, ierr)
  end function

  function send_ids(self, location, ierr) result(ids)
    class(delos_mpi_lists_of_part), intent(in) :: self
    integer, intent(in) :: location
    integer, intent(out), optional :: ierr
    integer(c_int32_t), pointer :: ids(:)
    call get_list(self, c_send_ids, location, ids, ierr)
  end function

  function receive_ids(self, location, ierr) result(ids)
    class(delos_mpi_lists_of_part), intent(in) :: self
    integer, intent(in) :: location
    integer, intent(out), optional :: ierr
    integer(c_int32_t), pointer :: ids(:)
    call get_list(self, c_receive_ids, location, ids, ierr)
  end function

  function layer_offsets(self, location, ierr) result(offsets)
    class(delos_mpi_lists_of_part), intent(in) :: self
    integer, intent(in) :: location
    integer, intent(out), optional :: ierr
    integer(c_int64_t), pointer :: offsets(:)
    call get_offsets(self, c_layer_offsets, location, offsets, ierr)
  end function

  function send_offsets(self, location, ierr) result(offsets)
    class(delos_mpi_lists_of_part), intent(in) :: self
    integer, intent(in) :: location
    integer, intent(out), optional :: ierr
    integer(c_int64_t), pointer :: offsets(:)
    call get_offsets(self, c_send_offsets, location, offsets, ierr)
  end function

  function receive_offsets(self, location, ierr) result(offsets)
    class(delos_mpi_lists_of_part), intent(in) :: self
    integer, intent(in) :: location
    integer, intent(out), optional :: ierr
    integer(c_int64_t), pointer :: offsets(:)
    call get_offsets(self, c_receive_offsets, location, offsets, ierr)
  end function
end module delos_mpi_lists
