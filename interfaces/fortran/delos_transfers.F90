! SPDX-License-Identifier: BSD-3-Clause
! Transfers of module delos: fields of one grid on another. c/delos/transfer.h says what each does.
!
!   call component%get_grid(before)
!   call component%run(imports, exports, clock, ierr)
!   if (component%generation() /= before%generation()) then
!     call component%get_grid(after)
!     call transfer%create(before, after, ierr=ierr)
!     call transfer%apply(old_depth, depth, ierr=ierr)     ! (n_cells), or (n_levels, n_cells)
!     call transfer%apply_velocity(old_u, u, route=DELOS_VELOCITY_HELMHOLTZ, ierr=ierr)
!   end if
module delos_transfers
  use, intrinsic :: iso_c_binding, only: c_double, c_int, c_int32_t, c_int64_t
  use delos_binding
  use delos_grids, only: delos_grid
  use delos_objects
  use delos_transfer_binding
  implicit none
  private
  public :: delos_transfer, transfer_options, DELOS_ORDER_SECOND, DELOS_ORDER_FIRST, &
    DELOS_LIMITER_GRADIENT, DELOS_LIMITER_NONE, DELOS_LIMITER_ASSURED_SUM, &
    DELOS_VELOCITY_VECTORS, DELOS_VELOCITY_STREAM_FUNCTION, DELOS_VELOCITY_HELMHOLTZ, &
    DELOS_NORMALIZATION_COVERED, DELOS_NORMALIZATION_WHOLE

  ! Made once for a pair of grids, used for many fields. Keeps both grids' arrays, so that the grids
  ! may be destroyed. Without an order, a limiter, a route: the second, of gradients, by vectors.
  type, extends(delos_object) :: delos_transfer
  contains
    procedure :: create
    procedure :: check
    procedure, private :: apply_to_values, apply_to_levels
    procedure, private :: velocity_of_values, velocity_of_levels
    generic :: apply => apply_to_values, apply_to_levels
    generic :: apply_velocity => velocity_of_values, velocity_of_levels
    procedure :: n_overlaps
    procedure :: n_unchanged
    procedure :: n_unmapped
    final :: finish_transfer
  end type

contains

  impure elemental subroutine finish_transfer(self)
    type(delos_transfer), intent(inout) :: self
    call self%destroy()
  end subroutine

  ! The former transfer of this object is gone, whatever happens. threads: 0 = as configured.
  subroutine create(self, from, to, threads, ierr)
    class(delos_transfer), intent(inout) :: self
    type(delos_grid), intent(in) :: from, to
    integer, intent(in), optional :: threads
    integer, intent(out), optional :: ierr
    integer(c_int) :: status
    status = renewed(self)
    if (status == DELOS_SUCCESS .and. present(threads)) then
      status = c_set_threads(self%context, int(threads, c_int))
    end if
    if (status == DELOS_SUCCESS) then
      status = c_transfer_create(self%context, from%handle, to%handle, self%handle)
    end if
    call report_status(status, ierr)
  end subroutine

  ! DELOS_ERROR_STATE unless it was made for these two grids.
  subroutine check(self, from, to, ierr)
    class(delos_transfer), intent(in) :: self
    type(delos_grid), intent(in) :: from, to
    integer, intent(out), optional :: ierr
    call report_status(c_transfer_check(self%handle, from%handle, to%handle), ierr)
  end subroutine

  pure function transfer_options(n_levels, order, limiter, route, normalization) result(options)
    integer, intent(in) :: n_levels
    integer, intent(in), optional :: order, limiter, route, normalization
    type(delos_transfer_options) :: options
    options%n_levels = int(n_levels, c_int64_t)
    if (present(order)) options%order = int(order, c_int32_t)
    if (present(limiter)) options%limiter = int(limiter, c_int32_t)
    if (present(route)) options%velocity = int(route, c_int32_t)
    if (present(normalization)) options%normalization = int(normalization, c_int32_t)
  end function

  ! Means over cells, (n_cells) of each grid.
  subroutine apply_to_values(self, from, to, order, limiter, normalization, ierr)
    class(delos_transfer), intent(in) :: self
    real(c_double), intent(in) :: from(:)
    real(c_double), intent(inout) :: to(:)
    integer, intent(in), optional :: order, limiter, normalization
    integer, intent(out), optional :: ierr
    call report_status(c_transfer_apply(self%handle, from, size(from, kind=c_int64_t), to, &
                                        size(to, kind=c_int64_t), &
                                        transfer_options(1, order, limiter, &
                                                         normalization=normalization)), ierr)
  end subroutine

  ! (n_levels, n_cells) of each grid.
  subroutine apply_to_levels(self, from, to, order, limiter, normalization, ierr)
    class(delos_transfer), intent(in) :: self
    real(c_double), intent(in) :: from(:, :)
    real(c_double), intent(inout) :: to(:, :)
    integer, intent(in), optional :: order, limiter, normalization
    integer, intent(out), optional :: ierr
    call report_status(c_transfer_apply(self%handle, from, size(from, kind=c_int64_t), to, &
                                        size(to, kind=c_int64_t), &
                                        transfer_options(size(from, 1), order, limiter, &
                                                         normalization=normalization)), ierr)
  end subroutine

  ! Velocities along the edges' normals, (n_edges) of each grid.
  subroutine velocity_of_values(self, from, to, route, order, limiter, ierr)
    class(delos_transfer), intent(in) :: self
    real(c_double), intent(in) :: from(:)
    real(c_double), intent(inout) :: to(:)
    integer, intent(in), optional :: route, order, limiter
    integer, intent(out), optional :: ierr
    call report_status(c_transfer_velocity(self%handle, from, size(from, kind=c_int64_t), to, &
                                           size(to, kind=c_int64_t), &
                                           transfer_options(1, order, limiter, route)), ierr)
  end subroutine

  ! (n_levels, n_edges) of each grid.
  subroutine velocity_of_levels(self, from, to, route, order, limiter, ierr)
    class(delos_transfer), intent(in) :: self
    real(c_double), intent(in) :: from(:, :)
    real(c_double), intent(inout) :: to(:, :)
    integer, intent(in), optional :: route, order, limiter
    integer, intent(out), optional :: ierr
    call report_status(c_transfer_velocity(self%handle, from, size(from, kind=c_int64_t), to, &
                                           size(to, kind=c_int64_t), &
                                           transfer_options(size(from, 1), order, limiter, route)), ierr)
  end subroutine

  ! Pairs of cells that overlap.
  function n_overlaps(self, ierr) result(n)
    class(delos_transfer), intent(in) :: self
    integer, intent(out), optional :: ierr
    integer(c_int64_t) :: n
    n = count_of(self%handle, c_n_overlaps, ierr)
  end function

  ! Cells of the second grid that are cells of the first.
  function n_unchanged(self, ierr) result(n)
    class(delos_transfer), intent(in) :: self
    integer, intent(out), optional :: ierr
    integer(c_int64_t) :: n
    n = count_of(self%handle, c_n_unchanged, ierr)
  end function

  ! Cells of the second grid that the first does not cover: they get NaN.
  function n_unmapped(self, ierr) result(n)
    class(delos_transfer), intent(in) :: self
    integer, intent(out), optional :: ierr
    integer(c_int64_t) :: n
    n = count_of(self%handle, c_n_unmapped, ierr)
  end function
end module delos_transfers
