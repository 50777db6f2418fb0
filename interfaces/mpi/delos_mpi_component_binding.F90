! SPDX-License-Identifier: BSD-3-Clause
! The functions of delos/mpi_component.h as Fortran sees them.
module delos_mpi_component_binding
  use, intrinsic :: iso_c_binding, only: c_char, c_double, c_int, c_int64_t, c_null_ptr, c_ptr
  use delos_binding, only: count_getter, text_getter
  use delos_mpi_binding, only: c_options
  use delos_transfer_binding, only: delos_transfer_options
  implicit none
  public
  private :: c_char, c_double, c_int, c_int64_t, c_null_ptr, c_ptr, count_getter, text_getter, &
    c_options, delos_transfer_options

  type, bind(c) :: c_item
    type(c_ptr) :: name = c_null_ptr, standard_name = c_null_ptr, units = c_null_ptr, &
      long_name = c_null_ptr
    integer(c_int) :: location = 0, n_components = 0
  end type

  abstract interface
    function phase(component) bind(c) result(status)
      import :: c_int, c_ptr
      type(c_ptr), value :: component
      integer(c_int) :: status
    end function

    function restart_phase(component, path, clock) bind(c) result(status)
      import :: c_char, c_int, c_ptr
      type(c_ptr), value :: component, clock
      character(kind=c_char), intent(in) :: path(*)
      integer(c_int) :: status
    end function
  end interface

  interface
    function c_create_file(comm, path, options, component) &
      bind(c, name="delos_mpi_component_create_file_f") result(status)
      import :: c_char, c_int, c_options, c_ptr
      integer(c_int), value :: comm
      character(kind=c_char), intent(in) :: path(*)
      type(c_options), intent(in) :: options
      type(c_ptr), intent(out) :: component
      integer(c_int) :: status
    end function

    function c_create_text(comm, yaml, folder, options, component) &
      bind(c, name="delos_mpi_component_create_text_f") result(status)
      import :: c_char, c_int, c_options, c_ptr
      integer(c_int), value :: comm
      character(kind=c_char), intent(in) :: yaml(*), folder(*)
      type(c_options), intent(in) :: options
      type(c_ptr), intent(out) :: component
      integer(c_int) :: status
    end function

    function c_component_error(component) bind(c, name="delos_mpi_component_last_error") result(text)
      import :: c_ptr
      type(c_ptr), value :: component
      type(c_ptr) :: text
    end function

    function c_run(component, clock, is_new_grid) bind(c, name="delos_mpi_component_run") &
      result(status)
      import :: c_int, c_ptr
      type(c_ptr), value :: component, clock
      integer(c_int), intent(out) :: is_new_grid
      integer(c_int) :: status
    end function

    function c_item_of(component, intent, i, item) bind(c, name="delos_mpi_component_item") &
      result(status)
      import :: c_int, c_item, c_ptr
      type(c_ptr), value :: component
      integer(c_int), value :: intent, i
      type(c_item), intent(inout) :: item
      integer(c_int) :: status
    end function

    function c_set_import(component, name, values, n) &
      bind(c, name="delos_mpi_component_set_import") result(status)
      import :: c_char, c_double, c_int, c_int64_t, c_ptr
      type(c_ptr), value :: component
      character(kind=c_char), intent(in) :: name(*)
      real(c_double), intent(in) :: values(*)
      integer(c_int64_t), value :: n
      integer(c_int) :: status
    end function

    function c_get_export(component, name, values, n) &
      bind(c, name="delos_mpi_component_get_export") result(status)
      import :: c_char, c_int, c_int64_t, c_ptr
      type(c_ptr), value :: component
      character(kind=c_char), intent(in) :: name(*)
      type(c_ptr), intent(out) :: values
      integer(c_int64_t), intent(out) :: n
      integer(c_int) :: status
    end function

    function c_component_grid(component, grid) bind(c, name="delos_mpi_component_grid") &
      result(status)
      import :: c_int, c_ptr
      type(c_ptr), value :: component
      type(c_ptr), intent(out) :: grid
      integer(c_int) :: status
    end function

    function c_transfer(component, former, n_former, values, n_values, options) &
      bind(c, name="delos_mpi_component_transfer") result(status)
      import :: c_double, c_int, c_int64_t, c_ptr, delos_transfer_options
      type(c_ptr), value :: component
      real(c_double), intent(in) :: former(*)
      integer(c_int64_t), value :: n_former, n_values
      real(c_double), intent(inout) :: values(*)
      type(delos_transfer_options), intent(in) :: options
      integer(c_int) :: status
    end function

    function c_transfer_velocity(component, former, n_former, values, n_values, options) &
      bind(c, name="delos_mpi_component_transfer_velocity") result(status)
      import :: c_double, c_int, c_int64_t, c_ptr, delos_transfer_options
      type(c_ptr), value :: component
      real(c_double), intent(in) :: former(*)
      integer(c_int64_t), value :: n_former, n_values
      real(c_double), intent(inout) :: values(*)
      type(delos_transfer_options), intent(in) :: options
      integer(c_int) :: status
    end function
  end interface

  procedure(phase), bind(c, name="delos_mpi_component_destroy") :: c_component_destroy
  procedure(phase), bind(c, name="delos_mpi_component_advertise") :: c_advertise
  procedure(phase), bind(c, name="delos_mpi_component_realize") :: c_realize
  procedure(phase), bind(c, name="delos_mpi_component_initialize") :: c_initialize
  procedure(phase), bind(c, name="delos_mpi_component_finalize") :: c_finalize
  procedure(restart_phase), bind(c, name="delos_mpi_component_write_restart") :: c_write_restart
  procedure(restart_phase), bind(c, name="delos_mpi_component_read_restart") :: c_read_restart
  procedure(count_getter), bind(c, name="delos_mpi_component_generation") :: c_component_generation
  procedure(text_getter), bind(c, name="delos_mpi_component_current_time") :: c_current_time
  procedure(text_getter), bind(c, name="delos_mpi_component_remesh_decision") :: c_remesh_decision
  procedure(text_getter), bind(c, name="delos_mpi_component_remesh_failure") :: c_remesh_failure
end module delos_mpi_component_binding
