! SPDX-License-Identifier: BSD-3-Clause
! What the types of module delos are made of: handles of the C layer, and the texts they give.
module delos_objects
  use, intrinsic :: iso_c_binding, only: c_associated, c_char, c_f_pointer, c_int, c_int64_t, &
    c_null_char, c_null_ptr, c_ptr
  use delos_binding
  implicit none
  private
  public :: delos_object, delos_view, from_c, to_c, renewed, report_status, count_of, &
    number_of, text_of

  ! A handle of the C layer in a context of its own. The parts are for the modules of this folder.
  type, abstract :: delos_object
    type(c_ptr) :: context = c_null_ptr, handle = c_null_ptr
  contains
    procedure :: is_made
    procedure :: message
    procedure :: destroy
    procedure, private :: refuse_assignment
    generic :: assignment(=) => refuse_assignment
  end type

  ! A handle that belongs to another object, and is good as long as that one lives.
  type, abstract :: delos_view
    type(c_ptr) :: handle = c_null_ptr
  contains
    procedure :: is_made => is_view
    procedure :: message => message_of_view
  end type

contains

  ! Whether the call that makes it has succeeded.
  pure function is_made(self)
    class(delos_object), intent(in) :: self
    logical :: is_made
    is_made = c_associated(self%handle)
  end function

  function message(self)
    class(delos_object), intent(in) :: self
    character(len=:), allocatable :: message
    if (c_associated(self%handle)) then
      message = from_c(c_last_error(self%handle))
    else
      message = from_c(c_last_error(self%context))
    end if
  end function

  ! Frees all; the object may be used anew.
  subroutine destroy(self)
    class(delos_object), intent(inout) :: self
    integer(c_int) :: status
    status = c_context_destroy(self%context)
    if (status == DELOS_SUCCESS) self%context = c_null_ptr
    self%handle = c_null_ptr
  end subroutine

  ! Two objects of one handle would free it twice: the left side becomes empty.
  subroutine refuse_assignment(self, other)
    class(delos_object), intent(inout) :: self
    class(delos_object), intent(in) :: other
    if (.not. c_associated(self%context, other%context)) call self%destroy()
  end subroutine

  pure function is_view(self)
    class(delos_view), intent(in) :: self
    logical :: is_view
    is_view = c_associated(self%handle)
  end function

  function message_of_view(self) result(message)
    class(delos_view), intent(in) :: self
    character(len=:), allocatable :: message
    message = from_c(c_last_error(self%handle))
  end function

  ! An empty object in a fresh context.
  function renewed(self) result(status)
    class(delos_object), intent(inout) :: self
    integer(c_int) :: status
    call self%destroy()
    status = c_context_create(self%context)
  end function

  subroutine report_status(status, ierr)
    integer(c_int), intent(in) :: status
    integer, intent(out), optional :: ierr
    if (present(ierr)) ierr = int(status)
  end subroutine

  function from_c(text) result(string)
    type(c_ptr), intent(in) :: text
    character(len=:), allocatable :: string
    character(kind=c_char), pointer :: characters(:)
    integer :: i
    if (.not. c_associated(text)) then
      string = ""
      return
    end if
    call c_f_pointer(text, characters, [c_strlen(text)])
    allocate (character(len=size(characters)) :: string)
    do i = 1, size(characters)
      string(i:i) = characters(i)
    end do
  end function

  ! Without the blanks at its end.
  function to_c(text) result(string)
    character(len=*), intent(in) :: text
    character(len=:), allocatable :: string
    string = trim(text)//c_null_char
  end function

  function count_of(handle, getter, ierr) result(n)
    type(c_ptr), intent(in) :: handle
    procedure(count_getter) :: getter
    integer, intent(out), optional :: ierr
    integer(c_int64_t) :: n
    n = 0
    call report_status(getter(handle, n), ierr)
  end function

  function number_of(handle, getter, ierr) result(number)
    type(c_ptr), intent(in) :: handle
    procedure(flag_getter) :: getter
    integer, intent(out), optional :: ierr
    integer :: number
    integer(c_int) :: value
    value = 0
    call report_status(getter(handle, value), ierr)
    number = int(value)
  end function

  function text_of(handle, getter, ierr) result(string)
    type(c_ptr), intent(in) :: handle
    procedure(text_getter) :: getter
    integer, intent(out), optional :: ierr
    character(len=:), allocatable :: string
    type(c_ptr) :: text
    call report_status(getter(handle, text), ierr)
    string = from_c(text)
  end function
end module delos_objects
