! SPDX-License-Identifier: BSD-3-Clause
! Messages of grids and components to a Fortran procedure: for the modules of this folder.
module delos_logs
  use, intrinsic :: iso_c_binding, only: c_associated, c_f_pointer, c_funloc, c_int, c_loc, c_ptr
  use delos_binding
  use delos_objects, only: from_c
  implicit none
  private
  public :: delos_log_callback, log_link

  abstract interface
    ! level: DELOS_LOG_...; the message has no line end. Called from any thread, one call at a time.
    subroutine delos_log_callback(level, message)
      integer, intent(in) :: level
      character(len=*), intent(in) :: message
    end subroutine
  end interface

  ! Where messages go. C holds its address, so that it stays in its place.
  type :: log_sink
    procedure(delos_log_callback), pointer, nopass :: write => null()
  end type

  ! What an object with a log holds.
  type :: log_link
    private
    type(log_sink), pointer :: sink => null()
  contains
    procedure :: point      ! to another procedure, or to none
    procedure :: attach     ! to a new context of the object
    final :: finish_link
  end type

contains

  ! After the end of the context, which the object's own finalization brings about before.
  impure elemental subroutine finish_link(self)
    type(log_link), intent(inout) :: self
    if (associated(self%sink)) deallocate (self%sink)
  end subroutine

  subroutine point(self, context, callback)
    class(log_link), intent(inout) :: self
    type(c_ptr), intent(in) :: context
    procedure(delos_log_callback), optional :: callback
    integer(c_int) :: status
    if (.not. associated(self%sink)) allocate (self%sink)
    self%sink%write => null()
    if (present(callback)) self%sink%write => callback
    status = self%attach(context)
  end subroutine

  ! Nothing where nobody listens, or there is no context yet.
  function attach(self, context) result(status)
    class(log_link), intent(in) :: self
    type(c_ptr), intent(in) :: context
    integer(c_int) :: status
    status = DELOS_SUCCESS
    if (.not. associated(self%sink) .or. .not. c_associated(context)) return
    status = c_set_log(context, c_funloc(forward), c_loc(self%sink))
  end function

  ! What C calls.
  subroutine forward(level, message, user_data) bind(c, name="")
    integer(c_int), value :: level
    type(c_ptr), value :: message, user_data
    type(log_sink), pointer :: sink
    call c_f_pointer(user_data, sink)
    if (associated(sink%write)) call sink%write(int(level), from_c(message))
  end subroutine
end module delos_logs
