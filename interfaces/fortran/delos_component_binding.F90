! SPDX-License-Identifier: BSD-3-Clause
! The functions of c/delos/component.h as Fortran sees them.
module delos_component_binding
  use, intrinsic :: iso_c_binding, only: c_char, c_double, c_int, c_int32_t, c_int64_t, c_null_ptr, &
    c_ptr
  use delos_binding, only: count_getter, flag_getter, handle_call, path_call, text_getter
  implicit none
  public
  private :: c_char, c_double, c_int, c_int32_t, c_int64_t, c_null_ptr, c_ptr
  private :: count_getter, flag_getter, handle_call, path_call, text_getter

  integer, parameter :: DELOS_LOCATION_CELL = 0, DELOS_LOCATION_EDGE = 1, &
    DELOS_LOCATION_VERTEX = 2, DELOS_LOCATION_LAT_LON = 3, DELOS_LOCATION_GRID = 4

  type, bind(c) :: delos_alarm_options
    type(c_ptr) :: ring_time = c_null_ptr, interval = c_null_ptr, ring_duration = c_null_ptr
    integer(c_int32_t) :: not_sticky = 0, disabled = 0
  end type

  abstract interface
    function alarm_flag_getter(clock, id, flag) bind(c) result(status)
      import :: c_ptr, c_int
      type(c_ptr), value :: clock
      integer(c_int), value :: id
      integer(c_int), intent(inout) :: flag
      integer(c_int) :: status
    end function

    function alarm_text_getter(clock, id, text) bind(c) result(status)
      import :: c_ptr, c_int
      type(c_ptr), value :: clock
      integer(c_int), value :: id
      type(c_ptr), intent(out) :: text
      integer(c_int) :: status
    end function

    function alarm_call(clock, id) bind(c) result(status)
      import :: c_ptr, c_int
      type(c_ptr), value :: clock
      integer(c_int), value :: id
      integer(c_int) :: status
    end function

    function handle_getter(component, handle) bind(c) result(status)
      import :: c_ptr, c_int
      type(c_ptr), value :: component
      type(c_ptr), intent(out) :: handle
      integer(c_int) :: status
    end function

    function restart_call(component, path, clock) bind(c) result(status)
      import :: c_ptr, c_int, c_char
      type(c_ptr), value :: component, clock
      character(kind=c_char), intent(in) :: path(*)
      integer(c_int) :: status
    end function

    function values_call(field, values, size) bind(c) result(status)
      import :: c_ptr, c_int, c_int64_t
      type(c_ptr), value :: field, values
      integer(c_int64_t), value :: size
      integer(c_int) :: status
    end function
  end interface

  interface
    function c_clock_create(context, calendar, start, step, clock) &
      bind(c, name="delos_clock_create") result(status)
      import :: c_ptr, c_int, c_char
      type(c_ptr), value :: context
      character(kind=c_char), intent(in) :: calendar(*), start(*), step(*)
      type(c_ptr), intent(out) :: clock
      integer(c_int) :: status
    end function

    function c_clock_set_stop(clock, stop) bind(c, name="delos_clock_set_stop") result(status)
      import :: c_ptr, c_int
      type(c_ptr), value :: clock, stop
      integer(c_int) :: status
    end function

    function c_add_alarm(clock, options, id) bind(c, name="delos_clock_add_alarm") result(status)
      import :: c_ptr, c_int, delos_alarm_options
      type(c_ptr), value :: clock
      type(delos_alarm_options), intent(in) :: options
      integer(c_int), intent(inout) :: id
      integer(c_int) :: status
    end function

    function c_grid_share(context, grid, shared) bind(c, name="delos_grid_share") result(status)
      import :: c_ptr, c_int
      type(c_ptr), value :: context, grid
      type(c_ptr), intent(out) :: shared
      integer(c_int) :: status
    end function

    function c_component_create(context, config, component) &
      bind(c, name="delos_component_create") result(status)
      import :: c_ptr, c_int
      type(c_ptr), value :: context, config
      type(c_ptr), intent(out) :: component
      integer(c_int) :: status
    end function

    function c_run(component, imports, exports, clock) &
      bind(c, name="delos_component_run") result(status)
      import :: c_ptr, c_int
      type(c_ptr), value :: component, imports, exports, clock
      integer(c_int) :: status
    end function

    function c_state_name(state, i, name) bind(c, name="delos_state_name") result(status)
      import :: c_ptr, c_int, c_int64_t
      type(c_ptr), value :: state
      integer(c_int64_t), value :: i
      type(c_ptr), intent(out) :: name
      integer(c_int) :: status
    end function

    function c_contains(state, name, flag) bind(c, name="delos_state_contains") result(status)
      import :: c_ptr, c_int, c_char
      type(c_ptr), value :: state
      character(kind=c_char), intent(in) :: name(*)
      integer(c_int), intent(inout) :: flag
      integer(c_int) :: status
    end function

    function c_state_field(state, name, field) bind(c, name="delos_state_field") result(status)
      import :: c_ptr, c_int, c_char
      type(c_ptr), value :: state
      character(kind=c_char), intent(in) :: name(*)
      type(c_ptr), intent(out) :: field
      integer(c_int) :: status
    end function

    function c_field_data(field, values, n) bind(c, name="delos_field_data") result(status)
      import :: c_ptr, c_int, c_int64_t
      type(c_ptr), value :: field
      type(c_ptr), intent(out) :: values
      integer(c_int64_t), intent(out) :: n
      integer(c_int) :: status
    end function

    function c_place_on_lat_lon(field, lon_deg, n_lon, lat_deg, n_lat) &
      bind(c, name="delos_field_place_on_lat_lon") result(status)
      import :: c_ptr, c_int, c_int64_t, c_double
      type(c_ptr), value :: field
      real(c_double), intent(in) :: lon_deg(*), lat_deg(*)
      integer(c_int64_t), value :: n_lon, n_lat
      integer(c_int) :: status
    end function

    function c_field_stamp(field, time, calendar) bind(c, name="delos_field_stamp") result(status)
      import :: c_ptr, c_int, c_char
      type(c_ptr), value :: field
      character(kind=c_char), intent(in) :: time(*), calendar(*)
      integer(c_int) :: status
    end function
  end interface

  procedure(path_call), bind(c, name="delos_clock_set_step") :: c_clock_set_step
  procedure(handle_call), bind(c, name="delos_clock_advance") :: c_clock_advance
  procedure(flag_getter), bind(c, name="delos_clock_is_done") :: c_clock_is_done
  procedure(count_getter), bind(c, name="delos_clock_advance_count") :: c_advance_count
  procedure(count_getter), bind(c, name="delos_clock_n_alarms") :: c_n_alarms
  procedure(text_getter), bind(c, name="delos_clock_calendar") :: c_clock_calendar
  procedure(text_getter), bind(c, name="delos_clock_start") :: c_clock_start
  procedure(text_getter), bind(c, name="delos_clock_stop") :: c_clock_stop
  procedure(text_getter), bind(c, name="delos_clock_step") :: c_clock_step
  procedure(text_getter), bind(c, name="delos_clock_current") :: c_clock_current
  procedure(text_getter), bind(c, name="delos_clock_previous") :: c_clock_previous
  procedure(text_getter), bind(c, name="delos_clock_next") :: c_clock_next
  procedure(alarm_flag_getter), bind(c, name="delos_alarm_is_ringing") :: c_is_ringing
  procedure(alarm_flag_getter), bind(c, name="delos_alarm_was_ringing") :: c_was_ringing
  procedure(alarm_flag_getter), bind(c, name="delos_alarm_is_enabled") :: c_is_enabled
  procedure(alarm_flag_getter), bind(c, name="delos_alarm_is_sticky") :: c_is_sticky
  procedure(alarm_text_getter), bind(c, name="delos_alarm_ring_time") :: c_ring_time
  procedure(alarm_text_getter), bind(c, name="delos_alarm_interval") :: c_interval
  procedure(alarm_call), bind(c, name="delos_alarm_enable") :: c_enable
  procedure(alarm_call), bind(c, name="delos_alarm_disable") :: c_disable
  procedure(alarm_call), bind(c, name="delos_alarm_ringer_on") :: c_ringer_on
  procedure(alarm_call), bind(c, name="delos_alarm_ringer_off") :: c_ringer_off
  procedure(handle_call), bind(c, name="delos_component_advertise") :: c_advertise
  procedure(handle_call), bind(c, name="delos_component_realize") :: c_realize
  procedure(handle_call), bind(c, name="delos_component_initialize") :: c_initialize
  procedure(handle_call), bind(c, name="delos_component_finalize") :: c_finalize
  procedure(restart_call), bind(c, name="delos_component_write_restart") :: c_write_restart
  procedure(restart_call), bind(c, name="delos_component_read_restart") :: c_read_restart
  procedure(count_getter), bind(c, name="delos_component_generation") :: c_component_generation
  procedure(text_getter), bind(c, name="delos_component_current_time") :: c_current_time
  procedure(text_getter), bind(c, name="delos_component_remesh_decision") :: c_remesh_decision
  procedure(text_getter), bind(c, name="delos_component_remesh_failure") :: c_remesh_failure
  procedure(handle_call), bind(c, name="delos_grid_destroy") :: c_grid_destroy
  procedure(handle_getter), bind(c, name="delos_component_grid") :: c_component_grid
  procedure(handle_getter), bind(c, name="delos_component_import_state") :: c_import_state
  procedure(handle_getter), bind(c, name="delos_component_export_state") :: c_export_state
  procedure(count_getter), bind(c, name="delos_state_size") :: c_state_size
  procedure(text_getter), bind(c, name="delos_field_name") :: c_field_name
  procedure(text_getter), bind(c, name="delos_field_standard_name") :: c_field_standard_name
  procedure(text_getter), bind(c, name="delos_field_units") :: c_field_units
  procedure(text_getter), bind(c, name="delos_field_long_name") :: c_field_long_name
  procedure(text_getter), bind(c, name="delos_field_time_stamp") :: c_field_time_stamp
  procedure(flag_getter), bind(c, name="delos_field_location") :: c_field_location
  procedure(flag_getter), bind(c, name="delos_field_has_data") :: c_field_has_data
  procedure(flag_getter), bind(c, name="delos_field_is_updated") :: c_field_is_updated
  procedure(count_getter), bind(c, name="delos_field_n_components") :: c_field_n_components
  procedure(count_getter), bind(c, name="delos_field_n_points") :: c_field_n_points
  procedure(count_getter), bind(c, name="delos_field_generation") :: c_field_generation
  procedure(values_call), bind(c, name="delos_field_bind") :: c_field_bind
  procedure(values_call), bind(c, name="delos_field_store") :: c_field_store
end module delos_component_binding
