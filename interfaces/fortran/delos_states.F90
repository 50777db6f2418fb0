! SPDX-License-Identifier: BSD-3-Clause
! States and fields of module delos. c/delos/component.h says what each does and what it answers.
module delos_states
  use, intrinsic :: iso_c_binding, only: c_double, c_f_pointer, c_int, c_int64_t, c_loc, &
    c_null_ptr, c_ptr
  use delos_binding
  use delos_component_binding
  use delos_objects
  implicit none
  private
  public :: delos_state, delos_field
  public :: DELOS_LOCATION_CELL, DELOS_LOCATION_EDGE, DELOS_LOCATION_VERTEX, &
    DELOS_LOCATION_LAT_LON, DELOS_LOCATION_GRID

  ! An item of a state, a view of the component's: take it from its state where it is used, as it
  ! belongs to one generation of the grid. It may be assigned.
  type, extends(delos_view) :: delos_field
  contains
    procedure :: name => field_name
    procedure :: standard_name => field_standard_name ! CF's, or ""
    procedure :: units => field_units                 ! as UDUNITS reads them
    procedure :: long_name => field_long_name         ! for people
    procedure :: time_stamp => field_time_stamp       ! model time of the values, or ""
    procedure :: location => field_location           ! one of DELOS_LOCATION_*
    procedure :: n_components => field_n_components   ! values of each place
    procedure :: n_points => field_n_points           ! cells or other places
    procedure :: generation => field_generation       ! of the grid, at which it was taken; 0 before
    procedure :: has_data => field_has_data           ! of its generation
    procedure :: is_updated => field_is_updated       ! made by the component, or stamped
    procedure :: data => field_data                   ! (n_components * n_points), no copy
    procedure :: place_on_lat_lon                     ! imports: (n_lon, n_lat) values, degrees
    procedure :: bind => field_bind                   ! refers to the host's values
    procedure :: store => field_store                 ! copies them
    procedure :: stamp => field_stamp                 ! the values are those of this time
  end type

  ! The component's import or export state, a view of it. It may be assigned.
  type, extends(delos_view) :: delos_state
  contains
    procedure :: size => state_size         ! items
    procedure :: name => state_name         ! of item i, from 1
    procedure :: contains => state_contains ! by name, else by standard name
    procedure :: field => state_field       ! the same; DELOS_ERROR_NOT_FOUND when absent
  end type

contains

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
end module delos_states
