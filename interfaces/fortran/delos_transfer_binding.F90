! SPDX-License-Identifier: BSD-3-Clause
! The functions of c/delos/transfer.h as Fortran sees them.
module delos_transfer_binding
  use, intrinsic :: iso_c_binding, only: c_double, c_int, c_int32_t, c_int64_t, c_ptr
  use delos_binding, only: count_getter
  implicit none
  public
  private :: c_double, c_int, c_int32_t, c_int64_t, c_ptr, count_getter

  integer, parameter :: DELOS_ORDER_SECOND = 0, DELOS_ORDER_FIRST = 1
  integer, parameter :: DELOS_LIMITER_GRADIENT = 0, DELOS_LIMITER_NONE = 1, &
    DELOS_LIMITER_ASSURED_SUM = 2
  integer, parameter :: DELOS_VELOCITY_VECTORS = 0, DELOS_VELOCITY_STREAM_FUNCTION = 1, &
    DELOS_VELOCITY_HELMHOLTZ = 2
  integer, parameter :: DELOS_NORMALIZATION_COVERED = 0, DELOS_NORMALIZATION_WHOLE = 1

  type, bind(c) :: delos_transfer_options
    integer(c_int32_t) :: order = 0, limiter = 0, velocity = 0
    integer(c_int64_t) :: n_levels = 0
    integer(c_int32_t) :: normalization = 0
  end type

  interface
    function c_transfer_create(context, from, to, transfer) &
      bind(c, name="delos_transfer_create") result(status)
      import :: c_ptr, c_int
      type(c_ptr), value :: context, from, to
      type(c_ptr), intent(out) :: transfer
      integer(c_int) :: status
    end function

    function c_transfer_check(transfer, from, to) bind(c, name="delos_transfer_check") result(status)
      import :: c_ptr, c_int
      type(c_ptr), value :: transfer, from, to
      integer(c_int) :: status
    end function

    function c_transfer_apply(transfer, from, n_from, to, n_to, options) &
      bind(c, name="delos_transfer_apply") result(status)
      import :: c_ptr, c_int, c_int64_t, c_double, delos_transfer_options
      type(c_ptr), value :: transfer
      real(c_double), intent(in) :: from(*)
      integer(c_int64_t), value :: n_from, n_to
      real(c_double), intent(inout) :: to(*)
      type(delos_transfer_options), intent(in) :: options
      integer(c_int) :: status
    end function

    function c_transfer_velocity(transfer, from, n_from, to, n_to, options) &
      bind(c, name="delos_transfer_apply_velocity") result(status)
      import :: c_ptr, c_int, c_int64_t, c_double, delos_transfer_options
      type(c_ptr), value :: transfer
      real(c_double), intent(in) :: from(*)
      integer(c_int64_t), value :: n_from, n_to
      real(c_double), intent(inout) :: to(*)
      type(delos_transfer_options), intent(in) :: options
      integer(c_int) :: status
    end function
  end interface

  procedure(count_getter), bind(c, name="delos_transfer_n_overlaps") :: c_n_overlaps
  procedure(count_getter), bind(c, name="delos_transfer_n_unchanged") :: c_n_unchanged
  procedure(count_getter), bind(c, name="delos_transfer_n_unmapped") :: c_n_unmapped
end module delos_transfer_binding
