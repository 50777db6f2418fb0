! SPDX-License-Identifier: BSD-3-Clause
! Configurations of module delos, which says how they are used.
module delos_configs
  use, intrinsic :: iso_c_binding, only: c_int, c_null_char
  use delos_binding
  use delos_objects
  implicit none
  private
  public :: delos_config

  ! A recipe: YAML whose every key config/defaults.yaml explains.
  type, extends(delos_object) :: delos_config
  contains
    procedure :: from_file ! reads YAML
    procedure :: from_text ! likewise from a string
    procedure :: set       ! one key
    procedure :: check     ! all keys and values; no file is opened
    procedure :: text      ! with defaults, as YAML
    final :: finish_config
  end type

contains

  impure elemental subroutine finish_config(self)
    type(delos_config), intent(inout) :: self
    call self%destroy()
  end subroutine

  ! File names in it are relative to the file's folder.
  subroutine from_file(self, path, ierr)
    class(delos_config), intent(inout) :: self
    character(len=*), intent(in) :: path
    integer, intent(out), optional :: ierr
    integer(c_int) :: status
    status = renewed(self)
    if (status == DELOS_SUCCESS) then
      status = c_from_file(self%context, trim(path)//c_null_char, self%handle)
    end if
    call report_status(status, ierr)
  end subroutine

  ! YAML with new_line() between lines. `name` stands for the file in messages.
  subroutine from_text(self, yaml, name, folder, ierr)
    class(delos_config), intent(inout) :: self
    character(len=*), intent(in) :: yaml
    character(len=*), intent(in), optional :: name, folder
    integer, intent(out), optional :: ierr
    character(len=:), allocatable :: file, base
    integer(c_int) :: status
    file = "configuration"
    if (present(name)) file = trim(name)
    base = "."
    if (present(folder)) base = trim(folder)
    status = renewed(self)
    if (status == DELOS_SUCCESS) then
      status = c_from_text(self%context, yaml//c_null_char, file//c_null_char, &
                           base//c_null_char, self%handle)
    end if
    call report_status(status, ierr)
  end subroutine

  ! One key, e.g. ("sizing.sources.0.spacing", "60 km").
  subroutine set(self, key, value, ierr)
    class(delos_config), intent(inout) :: self
    character(len=*), intent(in) :: key, value
    integer, intent(out), optional :: ierr
    call report_status(c_config_set(self%handle, trim(key)//c_null_char, &
                                    trim(value)//c_null_char), ierr)
  end subroutine

  ! Checks every key and value as generate does; no file is opened.
  subroutine check(self, ierr)
    class(delos_config), intent(in) :: self
    integer, intent(out), optional :: ierr
    call report_status(c_config_check(self%handle), ierr)
  end subroutine

  ! The effective configuration, defaults included, as YAML.
  function text(self, ierr)
    class(delos_config), intent(in) :: self
    integer, intent(out), optional :: ierr
    character(len=:), allocatable :: text
    text = text_of(self%handle, c_text, ierr)
  end function
end module delos_configs
