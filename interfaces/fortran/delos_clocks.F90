! SPDX-License-Identifier: BSD-3-Clause
! Clocks and alarms of module delos. c/delos/component.h says what each does and what it answers.
module delos_clocks
  use, intrinsic :: iso_c_binding, only: c_char, c_int, c_int32_t, c_int64_t, c_loc, c_null_char, &
    c_null_ptr, c_ptr
  use delos_binding
  use delos_component_binding
  use delos_objects
  implicit none
  private
  public :: delos_clock

  ! The host's clock with its alarms, which have ids from 0. Times and intervals are ISO 8601.
  type, extends(delos_object) :: delos_clock
  contains
    procedure :: create => clock_create               ! start, step; stop and calendar on wish
    procedure :: set_stop => clock_set_stop           ! after start; without one never done
    procedure :: set_step => clock_set_step           ! of all later steps, forward
    procedure :: advance => clock_advance             ! one step, then all alarms; beyond stop, too
    procedure :: is_done => clock_is_done             ! whether stop is reached or passed
    procedure :: advance_count => clock_advance_count ! steps since start
    procedure :: calendar => clock_calendar           ! gregorian, julian, noleap or 360_day
    procedure :: start => clock_start                 ! "2000-02-29T06:30:00"
    procedure :: stop => clock_stop                   ! "" without one
    procedure :: step => clock_step                   ! "P0Y1M0DT0H0M0S"
    procedure :: current => clock_current             ! as start
    procedure :: previous => clock_previous           ! the current time before the last step
    procedure :: next => clock_next                   ! the current time after the next step
    procedure :: add_alarm                            ! its id, from 0; -1 when it fails
    procedure :: n_alarms => clock_n_alarms           ! alarms are never removed
    procedure :: is_ringing                           ! as of the last step
    procedure :: was_ringing                          ! right after the last step but one
    procedure :: is_enabled                           ! else it is silent
    procedure :: is_sticky                            ! rings until it is switched off
    procedure :: ring_time                            ! the next one, or its only one
    procedure :: interval                             ! zero when it rings once
    procedure :: enable                               ! rings again, from its next ring time on
    procedure :: disable                              ! also stops the ringing
    procedure :: ringer_on                            ! rings from the current time on
    procedure :: ringer_off                           ! until the next ring time
    final :: finish_clock
  end type

contains

  impure elemental subroutine finish_clock(self)
    type(delos_clock), intent(inout) :: self
    call self%destroy()
  end subroutine

  ! A text for C that lives as long as `storage`; NULL when it is absent.
  function optional_text(text, storage) result(first)
    character(len=*), intent(in), optional :: text
    character(kind=c_char), allocatable, target, intent(out) :: storage(:)
    type(c_ptr) :: first
    integer :: i
    first = c_null_ptr
    if (.not. present(text)) return
    allocate (storage(len_trim(text) + 1))
    do i = 1, len_trim(text)
      storage(i) = text(i:i)
    end do
    storage(size(storage)) = c_null_char
    first = c_loc(storage)
  end function

  ! calendar: gregorian (without one), julian, noleap or 360_day. Without a stop it is never done.
  subroutine clock_create(self, start, step, stop, calendar, ierr)
    class(delos_clock), intent(inout) :: self
    character(len=*), intent(in) :: start, step
    character(len=*), intent(in), optional :: stop, calendar
    integer, intent(out), optional :: ierr
    character(len=:), allocatable :: counted
    integer(c_int) :: status
    integer :: stop_status
    counted = "gregorian"
    if (present(calendar)) counted = calendar
    status = renewed(self)
    if (status == DELOS_SUCCESS) then
      status = c_clock_create(self%context, to_c(counted), to_c(start), to_c(step), self%handle)
    end if
    if (status == DELOS_SUCCESS .and. present(stop)) then
      call self%set_stop(stop, stop_status)
      status = int(stop_status, c_int)
    end if
    call report_status(status, ierr)
  end subroutine

  ! Without a stop the clock is never done.
  subroutine clock_set_stop(self, stop, ierr)
    class(delos_clock), intent(inout) :: self
    character(len=*), intent(in), optional :: stop
    integer, intent(out), optional :: ierr
    character(kind=c_char), allocatable, target :: storage(:)
    call report_status(c_clock_set_stop(self%handle, optional_text(stop, storage)), ierr)
  end subroutine

  subroutine clock_set_step(self, step, ierr)
    class(delos_clock), intent(inout) :: self
    character(len=*), intent(in) :: step
    integer, intent(out), optional :: ierr
    call report_status(c_clock_set_step(self%handle, to_c(step)), ierr)
  end subroutine

  subroutine clock_advance(self, ierr)
    class(delos_clock), intent(inout) :: self
    integer, intent(out), optional :: ierr
    call report_status(c_clock_advance(self%handle), ierr)
  end subroutine

  function clock_is_done(self, ierr) result(flag)
    class(delos_clock), intent(in) :: self
    integer, intent(out), optional :: ierr
    logical :: flag
    flag = number_of(self%handle, c_clock_is_done, ierr) == 1
  end function

  function clock_advance_count(self, ierr) result(n)
    class(delos_clock), intent(in) :: self
    integer, intent(out), optional :: ierr
    integer(c_int64_t) :: n
    n = count_of(self%handle, c_advance_count, ierr)
  end function

  function clock_calendar(self, ierr) result(text)
    class(delos_clock), intent(in) :: self
    integer, intent(out), optional :: ierr
    character(len=:), allocatable :: text
    text = text_of(self%handle, c_clock_calendar, ierr)
  end function

  function clock_start(self, ierr) result(text)
    class(delos_clock), intent(in) :: self
    integer, intent(out), optional :: ierr
    character(len=:), allocatable :: text
    text = text_of(self%handle, c_clock_start, ierr)
  end function

  function clock_stop(self, ierr) result(text)
    class(delos_clock), intent(in) :: self
    integer, intent(out), optional :: ierr
    character(len=:), allocatable :: text
    text = text_of(self%handle, c_clock_stop, ierr)
  end function

  function clock_step(self, ierr) result(text)
    class(delos_clock), intent(in) :: self
    integer, intent(out), optional :: ierr
    character(len=:), allocatable :: text
    text = text_of(self%handle, c_clock_step, ierr)
  end function

  function clock_current(self, ierr) result(text)
    class(delos_clock), intent(in) :: self
    integer, intent(out), optional :: ierr
    character(len=:), allocatable :: text
    text = text_of(self%handle, c_clock_current, ierr)
  end function

  function clock_previous(self, ierr) result(text)
    class(delos_clock), intent(in) :: self
    integer, intent(out), optional :: ierr
    character(len=:), allocatable :: text
    text = text_of(self%handle, c_clock_previous, ierr)
  end function

  function clock_next(self, ierr) result(text)
    class(delos_clock), intent(in) :: self
    integer, intent(out), optional :: ierr
    character(len=:), allocatable :: text
    text = text_of(self%handle, c_clock_next, ierr)
  end function

  ! Its id; -1 when it fails. One of ring_time and interval must be given.
  function add_alarm(self, ring_time, interval, ring_duration, sticky, enabled, ierr) result(id)
    class(delos_clock), intent(inout) :: self
    character(len=*), intent(in), optional :: ring_time, interval, ring_duration
    logical, intent(in), optional :: sticky, enabled
    integer, intent(out), optional :: ierr
    integer :: id
    character(kind=c_char), allocatable, target :: first(:), every(:), duration(:)
    type(delos_alarm_options) :: options
    integer(c_int) :: made
    options%ring_time = optional_text(ring_time, first)
    options%interval = optional_text(interval, every)
    options%ring_duration = optional_text(ring_duration, duration)
    if (present(sticky)) options%not_sticky = merge(0_c_int32_t, 1_c_int32_t, sticky)
    if (present(enabled)) options%disabled = merge(0_c_int32_t, 1_c_int32_t, enabled)
    made = -1
    call report_status(c_add_alarm(self%handle, options, made), ierr)
    id = int(made)
  end function

  function clock_n_alarms(self, ierr) result(n)
    class(delos_clock), intent(in) :: self
    integer, intent(out), optional :: ierr
    integer(c_int64_t) :: n
    n = count_of(self%handle, c_n_alarms, ierr)
  end function

  function alarm_flag(self, id, getter, ierr) result(flag)
    class(delos_clock), intent(in) :: self
    integer, intent(in) :: id
    procedure(alarm_flag_getter) :: getter
    integer, intent(out), optional :: ierr
    logical :: flag
    integer(c_int) :: value
    value = 0
    call report_status(getter(self%handle, int(id, c_int), value), ierr)
    flag = value == 1
  end function

  function alarm_text(self, id, getter, ierr) result(string)
    class(delos_clock), intent(in) :: self
    integer, intent(in) :: id
    procedure(alarm_text_getter) :: getter
    integer, intent(out), optional :: ierr
    character(len=:), allocatable :: string
    type(c_ptr) :: text
    call report_status(getter(self%handle, int(id, c_int), text), ierr)
    string = from_c(text)
  end function

  function is_ringing(self, id, ierr) result(flag)
    class(delos_clock), intent(in) :: self
    integer, intent(in) :: id
    integer, intent(out), optional :: ierr
    logical :: flag
    flag = alarm_flag(self, id, c_is_ringing, ierr)
  end function

  function was_ringing(self, id, ierr) result(flag)
    class(delos_clock), intent(in) :: self
    integer, intent(in) :: id
    integer, intent(out), optional :: ierr
    logical :: flag
    flag = alarm_flag(self, id, c_was_ringing, ierr)
  end function

  function is_enabled(self, id, ierr) result(flag)
    class(delos_clock), intent(in) :: self
    integer, intent(in) :: id
    integer, intent(out), optional :: ierr
    logical :: flag
    flag = alarm_flag(self, id, c_is_enabled, ierr)
  end function

  function is_sticky(self, id, ierr) result(flag)
    class(delos_clock), intent(in) :: self
    integer, intent(in) :: id
    integer, intent(out), optional :: ierr
    logical :: flag
    flag = alarm_flag(self, id, c_is_sticky, ierr)
  end function

  function ring_time(self, id, ierr) result(text)
    class(delos_clock), intent(in) :: self
    integer, intent(in) :: id
    integer, intent(out), optional :: ierr
    character(len=:), allocatable :: text
    text = alarm_text(self, id, c_ring_time, ierr)
  end function

  function interval(self, id, ierr) result(text)
    class(delos_clock), intent(in) :: self
    integer, intent(in) :: id
    integer, intent(out), optional :: ierr
    character(len=:), allocatable :: text
    text = alarm_text(self, id, c_interval, ierr)
  end function

  subroutine enable(self, id, ierr)
    class(delos_clock), intent(inout) :: self
    integer, intent(in) :: id
    integer, intent(out), optional :: ierr
    call report_status(c_enable(self%handle, int(id, c_int)), ierr)
  end subroutine

  subroutine disable(self, id, ierr)
    class(delos_clock), intent(inout) :: self
    integer, intent(in) :: id
    integer, intent(out), optional :: ierr
    call report_status(c_disable(self%handle, int(id, c_int)), ierr)
  end subroutine

  subroutine ringer_on(self, id, ierr)
    class(delos_clock), intent(inout) :: self
    integer, intent(in) :: id
    integer, intent(out), optional :: ierr
    call report_status(c_ringer_on(self%handle, int(id, c_int)), ierr)
  end subroutine

  subroutine ringer_off(self, id, ierr)
    class(delos_clock), intent(inout) :: self
    integer, intent(in) :: id
    integer, intent(out), optional :: ierr
    call report_status(c_ringer_off(self%handle, int(id, c_int)), ierr)
  end subroutine
end module delos_clocks
