! SPDX-License-Identifier: BSD-3-Clause
! Clocks, components, states and fields of module delos. c/delos/component.h says what each does.
module delos_components
  use, intrinsic :: iso_c_binding, only: c_char, c_double, c_f_pointer, c_funloc, c_funptr, c_int, &
    c_int32_t, c_int64_t, c_loc, c_null_char, c_null_funptr, c_null_ptr, c_ptr
  use delos_binding
  use delos_component_binding
  use delos_grids, only: delos_config, delos_grid
  use delos_objects
  implicit none
  private
  public :: delos_clock, delos_component, delos_state, delos_field
  public :: DELOS_LOCATION_CELL, DELOS_LOCATION_EDGE, DELOS_LOCATION_VERTEX, &
    DELOS_LOCATION_LAT_LON, DELOS_LOCATION_GRID

  ! The host's clock with its alarms, which have ids from 0. Times and intervals are ISO 8601.
  type, extends(delos_object) :: delos_clock
  contains
    procedure :: create => clock_create
    procedure :: set_stop => clock_set_stop
    procedure :: set_step => clock_set_step
    procedure :: advance => clock_advance
    procedure :: is_done => clock_is_done
    procedure :: advance_count => clock_advance_count
    procedure :: calendar => clock_calendar
    procedure :: start => clock_start
    procedure :: stop => clock_stop
    procedure :: step => clock_step
    procedure :: current => clock_current
    procedure :: previous => clock_previous
    procedure :: next => clock_next
    procedure :: add_alarm
    procedure :: n_alarms => clock_n_alarms
    procedure :: is_ringing
    procedure :: was_ringing
    procedure :: is_enabled
    procedure :: is_sticky
    procedure :: ring_time
    procedure :: interval
    procedure :: enable
    procedure :: disable
    procedure :: ringer_on
    procedure :: ringer_off
    final :: finish_clock
  end type

  ! An item of a state, a view of the component's: take it from its state where it is used, as it
  ! belongs to one generation of the grid. It may be assigned.
  type, extends(delos_view) :: delos_field
  contains
    procedure :: name => field_name
    procedure :: standard_name => field_standard_name
    procedure :: units => field_units
    procedure :: long_name => field_long_name
    procedure :: time_stamp => field_time_stamp
    procedure :: location => field_location
    procedure :: n_components => field_n_components
    procedure :: n_points => field_n_points
    procedure :: generation => field_generation
    procedure :: has_data => field_has_data
    procedure :: is_updated => field_is_updated
    procedure :: data => field_data        ! (n_components * n_points), no copy
    procedure :: place_on_lat_lon
    procedure :: bind => field_bind        ! refers to the host's values
    procedure :: store => field_store      ! copies them
    procedure :: stamp => field_stamp
  end type

  ! The component's import or export state, a view of it. It may be assigned.
  type, extends(delos_view) :: delos_state
  contains
    procedure :: size => state_size
    procedure :: name => state_name        ! of item i, from 1
    procedure :: contains => state_contains
    procedure :: field => state_field
  end type

  ! One instance, in ESMF's phases. States and fields are good until it is destroyed.
  type, extends(delos_object) :: delos_component
    private
    type(c_funptr) :: on_progress = c_null_funptr
  contains
    procedure :: create => component_create
    procedure :: set_progress => component_set_progress
    procedure :: cancel => component_cancel
    procedure :: advertise => component_advertise
    procedure :: realize => component_realize
    procedure :: initialize => component_initialize
    procedure :: run => component_run
    procedure :: finalize => component_finalize
    procedure :: write_restart => component_write_restart
    procedure :: read_restart => component_read_restart
    procedure :: generation => component_generation
    procedure :: current_time => component_current_time
    procedure :: remesh_decision
    procedure :: remesh_failure
    procedure :: get_grid
    procedure :: import_state => component_import_state
    procedure :: export_state => component_export_state
    final :: finish_component
  end type

contains

  impure elemental subroutine finish_clock(self)
    type(delos_clock), intent(inout) :: self
    call self%destroy()
  end subroutine

  impure elemental subroutine finish_component(self)
    type(delos_component), intent(inout) :: self
    call self%destroy()
  end subroutine

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

  ! --- clock

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

  ! --- component

  ! threads: 0 = as configured. The configuration may be destroyed or changed afterwards.
  subroutine component_create(self, config, threads, ierr)
    class(delos_component), intent(inout) :: self
    type(delos_config), intent(in) :: config
    integer, intent(in), optional :: threads
    integer, intent(out), optional :: ierr
    integer(c_int) :: status
    status = renewed(self)
    if (status == DELOS_SUCCESS .and. present(threads)) then
      status = c_set_threads(self%context, int(threads, c_int))
    end if
    if (status == DELOS_SUCCESS) then
      status = c_set_progress(self%context, self%on_progress, c_null_ptr)
    end if
    if (status == DELOS_SUCCESS) status = c_component_create(self%context, config%handle, self%handle)
    call report_status(status, ierr)
  end subroutine

  ! Before create; without a callback: none.
  subroutine component_set_progress(self, callback)
    class(delos_component), intent(inout) :: self
    procedure(delos_progress_callback), optional :: callback
    self%on_progress = c_null_funptr
    if (present(callback)) self%on_progress = c_funloc(callback)
  end subroutine

  ! Stops the realize or read_restart that runs, or the next one.
  subroutine component_cancel(self, ierr)
    class(delos_component), intent(in) :: self
    integer, intent(out), optional :: ierr
    call report_status(c_context_cancel(self%context), ierr)
  end subroutine

  subroutine component_advertise(self, ierr)
    class(delos_component), intent(inout) :: self
    integer, intent(out), optional :: ierr
    call report_status(c_advertise(self%handle), ierr)
  end subroutine

  subroutine component_realize(self, ierr)
    class(delos_component), intent(inout) :: self
    integer, intent(out), optional :: ierr
    call report_status(c_realize(self%handle), ierr)
  end subroutine

  subroutine component_initialize(self, ierr)
    class(delos_component), intent(inout) :: self
    integer, intent(out), optional :: ierr
    call report_status(c_initialize(self%handle), ierr)
  end subroutine

  subroutine component_finalize(self, ierr)
    class(delos_component), intent(inout) :: self
    integer, intent(out), optional :: ierr
    call report_status(c_finalize(self%handle), ierr)
  end subroutine

  ! From the clock's current time to its next, before the host advances it.
  subroutine component_run(self, import_state, export_state, clock, ierr)
    class(delos_component), intent(inout) :: self
    type(delos_state), intent(in) :: import_state, export_state
    type(delos_clock), intent(in) :: clock
    integer, intent(out), optional :: ierr
    call report_status(c_run(self%handle, import_state%handle, export_state%handle, clock%handle), &
                       ierr)
  end subroutine

  subroutine component_write_restart(self, path, clock, ierr)
    class(delos_component), intent(in) :: self
    character(len=*), intent(in) :: path
    type(delos_clock), intent(in) :: clock
    integer, intent(out), optional :: ierr
    call report_status(c_write_restart(self%handle, to_c(path), clock%handle), ierr)
  end subroutine

  ! In the place of realize; the clock becomes the one written.
  subroutine component_read_restart(self, path, clock, ierr)
    class(delos_component), intent(inout) :: self
    character(len=*), intent(in) :: path
    type(delos_clock), intent(inout) :: clock
    integer, intent(out), optional :: ierr
    call report_status(c_read_restart(self%handle, to_c(path), clock%handle), ierr)
  end subroutine

  function component_generation(self, ierr) result(n)
    class(delos_component), intent(in) :: self
    integer, intent(out), optional :: ierr
    integer(c_int64_t) :: n
    n = count_of(self%handle, c_component_generation, ierr)
  end function

  function component_current_time(self, ierr) result(text)
    class(delos_component), intent(in) :: self
    integer, intent(out), optional :: ierr
    character(len=:), allocatable :: text
    text = text_of(self%handle, c_current_time, ierr)
  end function

  ! Why the last alarm of section remesh made a new grid, or none; "" before the first.
  function remesh_decision(self, ierr) result(text)
    class(delos_component), intent(in) :: self
    integer, intent(out), optional :: ierr
    character(len=:), allocatable :: text
    text = text_of(self%handle, c_remesh_decision, ierr)
  end function

  ! Why the remesh that it decided on failed, and the grid stayed; "" when it did not.
  function remesh_failure(self, ierr) result(text)
    class(delos_component), intent(in) :: self
    integer, intent(out), optional :: ierr
    character(len=:), allocatable :: text
    text = text_of(self%handle, c_remesh_failure, ierr)
  end function

  ! The current grid. It shares the component's arrays and keeps them when the component goes on or
  ! ends: `before` and `after` a remesh are two objects.
  subroutine get_grid(self, grid, ierr)
    class(delos_component), intent(in) :: self
    type(delos_grid), intent(inout) :: grid
    integer, intent(out), optional :: ierr
    type(c_ptr) :: own
    integer(c_int) :: status, unused
    status = renewed(grid)
    if (status == DELOS_SUCCESS) status = c_component_grid(self%handle, own)
    if (status == DELOS_SUCCESS) then
      status = c_grid_share(grid%context, own, grid%handle)
      ! Else the component's context would keep the handles of all generations.
      unused = c_grid_destroy(own)
    end if
    call report_status(status, ierr)
  end subroutine

  function component_import_state(self, ierr) result(state)
    class(delos_component), intent(in) :: self
    integer, intent(out), optional :: ierr
    type(delos_state) :: state
    call report_status(c_import_state(self%handle, state%handle), ierr)
  end function

  function component_export_state(self, ierr) result(state)
    class(delos_component), intent(in) :: self
    integer, intent(out), optional :: ierr
    type(delos_state) :: state
    call report_status(c_export_state(self%handle, state%handle), ierr)
  end function

  ! --- state

  function state_size(self, ierr) result(n)
    class(delos_state), intent(in) :: self
    integer, intent(out), optional :: ierr
    integer(c_int64_t) :: n
    n = count_of(self%handle, c_state_size, ierr)
  end function

  function state_name(self, i, ierr) result(name)
    class(delos_state), intent(in) :: self
    integer, intent(in) :: i
    integer, intent(out), optional :: ierr
    character(len=:), allocatable :: name
    type(c_ptr) :: text
    call report_status(c_state_name(self%handle, int(i - 1, c_int64_t), text), ierr)
    name = from_c(text)
  end function

  ! By name, else by CF standard name.
  function state_contains(self, name, ierr) result(flag)
    class(delos_state), intent(in) :: self
    character(len=*), intent(in) :: name
    integer, intent(out), optional :: ierr
    logical :: flag
    integer(c_int) :: value
    value = 0
    call report_status(c_contains(self%handle, to_c(name), value), ierr)
    flag = value == 1
  end function

  ! DELOS_ERROR_NOT_FOUND when it is absent; the text is on the state.
  function state_field(self, name, ierr) result(field)
    class(delos_state), intent(in) :: self
    character(len=*), intent(in) :: name
    integer, intent(out), optional :: ierr
    type(delos_field) :: field
    call report_status(c_state_field(self%handle, to_c(name), field%handle), ierr)
  end function

  ! --- field

  function field_name(self, ierr) result(text)
    class(delos_field), intent(in) :: self
    integer, intent(out), optional :: ierr
    character(len=:), allocatable :: text
    text = text_of(self%handle, c_field_name, ierr)
  end function

  function field_standard_name(self, ierr) result(text)
    class(delos_field), intent(in) :: self
    integer, intent(out), optional :: ierr
    character(len=:), allocatable :: text
    text = text_of(self%handle, c_field_standard_name, ierr)
  end function

  function field_units(self, ierr) result(text)
    class(delos_field), intent(in) :: self
    integer, intent(out), optional :: ierr
    character(len=:), allocatable :: text
    text = text_of(self%handle, c_field_units, ierr)
  end function

  function field_long_name(self, ierr) result(text)
    class(delos_field), intent(in) :: self
    integer, intent(out), optional :: ierr
    character(len=:), allocatable :: text
    text = text_of(self%handle, c_field_long_name, ierr)
  end function

  function field_time_stamp(self, ierr) result(text)
    class(delos_field), intent(in) :: self
    integer, intent(out), optional :: ierr
    character(len=:), allocatable :: text
    text = text_of(self%handle, c_field_time_stamp, ierr)
  end function

  function field_n_components(self, ierr) result(n)
    class(delos_field), intent(in) :: self
    integer, intent(out), optional :: ierr
    integer(c_int64_t) :: n
    n = count_of(self%handle, c_field_n_components, ierr)
  end function

  function field_n_points(self, ierr) result(n)
    class(delos_field), intent(in) :: self
    integer, intent(out), optional :: ierr
    integer(c_int64_t) :: n
    n = count_of(self%handle, c_field_n_points, ierr)
  end function

  function field_generation(self, ierr) result(n)
    class(delos_field), intent(in) :: self
    integer, intent(out), optional :: ierr
    integer(c_int64_t) :: n
    n = count_of(self%handle, c_field_generation, ierr)
  end function

  function field_has_data(self, ierr) result(flag)
    class(delos_field), intent(in) :: self
    integer, intent(out), optional :: ierr
    logical :: flag
    flag = number_of(self%handle, c_field_has_data, ierr) == 1
  end function

  function field_is_updated(self, ierr) result(flag)
    class(delos_field), intent(in) :: self
    integer, intent(out), optional :: ierr
    logical :: flag
    flag = number_of(self%handle, c_field_is_updated, ierr) == 1
  end function

  ! One of DELOS_LOCATION_*.
  function field_location(self, ierr) result(location)
    class(delos_field), intent(in) :: self
    integer, intent(out), optional :: ierr
    integer :: location
    location = number_of(self%handle, c_field_location, ierr)
  end function

  function field_data(self, ierr) result(values)
    class(delos_field), intent(in) :: self
    integer, intent(out), optional :: ierr
    real(c_double), pointer :: values(:)
    type(c_ptr) :: first
    integer(c_int64_t) :: n
    integer(c_int) :: status
    status = c_field_data(self%handle, first, n)
    values => null()
    if (status == DELOS_SUCCESS) call c_f_pointer(first, values, [n])
    call report_status(status, ierr)
  end function

  ! The values will come on this grid, longitudes next to each other.
  subroutine place_on_lat_lon(self, lon_deg, lat_deg, ierr)
    class(delos_field), intent(in) :: self
    real(c_double), contiguous, intent(in) :: lon_deg(:), lat_deg(:)
    integer, intent(out), optional :: ierr
    call report_status(c_place_on_lat_lon(self%handle, lon_deg, size(lon_deg, kind=c_int64_t), &
                                          lat_deg, size(lat_deg, kind=c_int64_t)), ierr)
  end subroutine

  ! The values must be a target, and live until the next bind or store, or the next grid.
  subroutine field_bind(self, values, ierr)
    class(delos_field), intent(in) :: self
    real(c_double), target, contiguous, intent(in) :: values(:)
    integer, intent(out), optional :: ierr
    type(c_ptr) :: first
    first = c_null_ptr
    if (size(values) > 0) first = c_loc(values)
    call report_status(c_field_bind(self%handle, first, size(values, kind=c_int64_t)), ierr)
  end subroutine

  subroutine field_store(self, values, ierr)
    class(delos_field), intent(in) :: self
    real(c_double), target, contiguous, intent(in) :: values(:)
    integer, intent(out), optional :: ierr
    type(c_ptr) :: first
    first = c_null_ptr
    if (size(values) > 0) first = c_loc(values)
    call report_status(c_field_store(self%handle, first, size(values, kind=c_int64_t)), ierr)
  end subroutine

  subroutine field_stamp(self, time, calendar, ierr)
    class(delos_field), intent(in) :: self
    character(len=*), intent(in) :: time
    character(len=*), intent(in), optional :: calendar
    integer, intent(out), optional :: ierr
    character(len=:), allocatable :: counted
    counted = "gregorian"
    if (present(calendar)) counted = calendar
    call report_status(c_field_stamp(self%handle, to_c(time), to_c(counted)), ierr)
  end subroutine
end module delos_components
