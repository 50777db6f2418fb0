! SPDX-License-Identifier: BSD-3-Clause
! Components of module delos. c/delos/component.h says what each does and what it answers.
module delos_components
  use, intrinsic :: iso_c_binding, only: c_funloc, c_funptr, c_int, c_int64_t, c_null_funptr, &
    c_null_ptr, c_ptr
  use delos_binding
  use delos_clocks, only: delos_clock
  use delos_component_binding
  use delos_configs, only: delos_config
  use delos_grids, only: delos_grid
  use delos_logs, only: delos_log_callback, log_link
  use delos_objects
  use delos_states, only: delos_state
  implicit none
  private
  public :: delos_component

  ! One instance, in ESMF's phases. States and fields are good until it is destroyed.
  type, extends(delos_object) :: delos_component
    private
    type(c_funptr) :: on_progress = c_null_funptr
    type(log_link) :: log
  contains
    procedure :: create => component_create               ! of a configuration
    procedure :: set_progress => component_set_progress   ! before create
    procedure :: set_log => component_set_log             ! from now on
    procedure :: cancel => component_cancel               ! what makes a grid, that runs or is next
    procedure :: advertise => component_advertise         ! declares the fields, opens no file
    procedure :: realize => component_realize             ! makes the grid
    procedure :: initialize => component_initialize       ! both
    procedure :: run => component_run                     ! from the clock's current to its next time
    procedure :: finalize => component_finalize           ! gives the grid back
    procedure :: write_restart => component_write_restart ! everything into one file, after realize
    procedure :: read_restart => component_read_restart   ! in the place of realize; sets the clock
    procedure :: generation => component_generation       ! of the grid, from 1; 0 without one
    procedure :: current_time => component_current_time   ! where the last run ended, or ""
    procedure :: remesh_decision                          ! why there is a new grid, or none
    procedure :: remesh_failure                           ! why a remesh failed, or ""
    procedure :: get_grid                                 ! which stays when the component goes on
    procedure :: import_state => component_import_state   ! what the host gives
    procedure :: export_state => component_export_state   ! what it gets
    final :: finish_component
  end type

contains

  impure elemental subroutine finish_component(self)
    type(delos_component), intent(inout) :: self
    call self%destroy()
  end subroutine

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
    if (status == DELOS_SUCCESS) status = self%log%attach(self%context)
    if (status == DELOS_SUCCESS) then
      status = c_component_create(self%context, config%handle, self%handle)
    end if
    call report_status(status, ierr)
  end subroutine

  ! Before create; without a callback: none.
  subroutine component_set_progress(self, callback)
    class(delos_component), intent(inout) :: self
    procedure(delos_progress_callback), optional :: callback
    self%on_progress = c_null_funptr
    if (present(callback)) self%on_progress = c_funloc(callback)
  end subroutine

  ! Messages of this object go to the procedure; without a callback: nowhere, as at first.
  subroutine component_set_log(self, callback)
    class(delos_component), intent(inout) :: self
    procedure(delos_log_callback), optional :: callback
    call self%log%point(self%context, callback)
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
end module delos_components
