! SPDX-License-Identifier: BSD-3-Clause
! Grids of module delos, which says how they are used.
module delos_grids
  use, intrinsic :: iso_c_binding, only: c_funloc, c_funptr, c_int, c_null_char, c_null_funptr, &
    c_null_ptr
  use delos_levels, only: delos_grid_levels
  use delos_binding
  use delos_configs, only: delos_config
  use delos_logs, only: delos_log_callback, log_link
  use delos_objects
  implicit none
  private
  public :: delos_grid, delos_version

  ! A finished grid: its arrays are those of delos_grid_arrays and
  ! delos_grid_levels.
  type, extends(delos_grid_levels) :: delos_grid
    private
    type(c_funptr) :: on_progress = c_null_funptr
    type(log_link) :: log
  contains
    procedure :: generate              ! makes the grid
    procedure :: set_progress          ! for later generates
    procedure :: set_log               ! from now on
    procedure :: cancel                ! the generate that runs
    procedure :: quality               ! numbers over the whole grid
    procedure :: certificate           ! as in every file
    procedure :: write_mpas            ! whole or not at all, as all files
    procedure :: write_ugrid_cells     ! the Voronoi cells as faces
    procedure :: write_ugrid_triangles ! the triangles as faces
    procedure :: write_report          ! as JSON
    procedure :: write_outputs         ! what section output names
    final :: finish_grid
  end type

contains

  impure elemental subroutine finish_grid(self)
    type(delos_grid), intent(inout) :: self
    call self%destroy()
  end subroutine

  function delos_version() result(version)
    character(len=:), allocatable :: version
    version = from_c(c_version())
  end function

  ! The former grid of this object is gone, whatever happens. threads: 0 = as configured.
  subroutine generate(self, config, threads, ierr)
    class(delos_grid), intent(inout) :: self
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
    if (status == DELOS_SUCCESS) status = c_generate(self%context, config%handle, self%handle)
    call report_status(status, ierr)
  end subroutine

  ! For every generate of this object; without a callback: none.
  subroutine set_progress(self, callback)
    class(delos_grid), intent(inout) :: self
    procedure(delos_progress_callback), optional :: callback
    self%on_progress = c_null_funptr
    if (present(callback)) self%on_progress = c_funloc(callback)
  end subroutine

  ! Messages of every generate of this object go to the procedure; without a callback: nowhere, as at
  ! first.
  subroutine set_log(self, callback)
    class(delos_grid), intent(inout) :: self
    procedure(delos_log_callback), optional :: callback
    call self%log%point(self%context, callback)
  end subroutine

  ! Stops the generate that runs, from its callback or another thread.
  subroutine cancel(self, ierr)
    class(delos_grid), intent(in) :: self
    integer, intent(out), optional :: ierr
    call report_status(c_context_cancel(self%context), ierr)
  end subroutine

  function quality(self, ierr)
    class(delos_grid), intent(in) :: self
    integer, intent(out), optional :: ierr
    type(delos_quality) :: quality
    call report_status(c_quality(self%handle, quality), ierr)
  end function

  function certificate(self, ierr)
    class(delos_grid), intent(in) :: self
    integer, intent(out), optional :: ierr
    type(delos_certificate) :: certificate
    call report_status(c_certificate(self%handle, certificate), ierr)
  end function

  subroutine write_mpas(self, path, ierr)
    class(delos_grid), intent(in) :: self
    character(len=*), intent(in) :: path
    integer, intent(out), optional :: ierr
    call report_status(c_write_mpas(self%handle, trim(path)//c_null_char), ierr)
  end subroutine

  subroutine write_ugrid_cells(self, path, ierr)
    class(delos_grid), intent(in) :: self
    character(len=*), intent(in) :: path
    integer, intent(out), optional :: ierr
    call report_status(c_write_ugrid_cells(self%handle, trim(path)//c_null_char), ierr)
  end subroutine

  subroutine write_ugrid_triangles(self, path, ierr)
    class(delos_grid), intent(in) :: self
    character(len=*), intent(in) :: path
    integer, intent(out), optional :: ierr
    call report_status(c_write_ugrid_triangles(self%handle, trim(path)//c_null_char), ierr)
  end subroutine

  subroutine write_report(self, path, ierr)
    class(delos_grid), intent(in) :: self
    character(len=*), intent(in) :: path
    integer, intent(out), optional :: ierr
    call report_status(c_write_report(self%handle, trim(path)//c_null_char), ierr)
  end subroutine

  ! What the configuration's `output` section names, all or nothing.
  subroutine write_outputs(self, directory, ierr)
    class(delos_grid), intent(in) :: self
    character(len=*), intent(in), optional :: directory
    integer, intent(out), optional :: ierr
    character(len=:), allocatable :: folder
    folder = ""
    if (present(directory)) folder = trim(directory)
    call report_status(c_write_outputs(self%handle, folder//c_null_char, c_null_ptr), ierr)
  end subroutine
end module delos_grids
