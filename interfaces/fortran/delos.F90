! SPDX-License-Identifier: BSD-3-Clause
! delos for Fortran 2008: configuration -> grid arrays, in memory. Adapts c/delos/delos.h.
!
!   use delos
!   type(delos_config) :: config
!   type(delos_grid) :: grid
!   real(c_double), pointer :: area_m2(:)
!   call config%from_file("world_ocean.yaml", ierr)
!   call grid%generate(config, ierr=ierr)
!   if (ierr /= DELOS_SUCCESS) call model_stop(grid%message())
!   area_m2 => grid%cell_area_m2()
!
! What each type has stands in delos_configs.F90, delos_grids.F90, delos_arrays.F90 and
! delos_levels.F90. A coupled model takes delos_component (delos_components.F90), delos_clock (delos_clocks.F90), delos_state
! and delos_field (delos_states.F90).
! delos_transfer carries its fields to a new grid: delos_transfers.F90.
!
! ierr is optional everywhere: 0 or one of the statuses below. message() is the text of the last
! failure. A pointer function that fails returns null(), a count 0, a text "". Nothing is printed
! or stopped. Objects free what they hold when they go out of scope, or by destroy(); they can't be
! assigned to each other.
module delos
  use, intrinsic :: iso_c_binding, only: c_double, c_int32_t, c_int64_t
  use delos_binding, only: delos_quality, delos_worst, delos_certificate, delos_progress, &
    delos_progress_callback, DELOS_LOG_DEBUG, DELOS_LOG_INFO, DELOS_LOG_WARNING, DELOS_LOG_ERROR, &
    DELOS_SUCCESS, DELOS_ERROR_STATE, DELOS_ERROR_ARGUMENT, &
    DELOS_ERROR_CONFIG, DELOS_ERROR_INPUT, DELOS_ERROR_OUTPUT, DELOS_ERROR_RESOURCE, &
    DELOS_ERROR_NOT_FOUND, DELOS_ERROR_INTERNAL, DELOS_ERROR_QUALITY, DELOS_ERROR_CANCELLED
  use delos_arrays, only: delos_one_based
  use delos_configs, only: delos_config
  use delos_grids, only: delos_grid, delos_version
  use delos_logs, only: delos_log_callback
  use delos_clocks, only: delos_clock
  use delos_states, only: delos_state, delos_field, DELOS_LOCATION_CELL, DELOS_LOCATION_EDGE, &
    DELOS_LOCATION_VERTEX, DELOS_LOCATION_LAT_LON, DELOS_LOCATION_GRID
  use delos_components, only: delos_component
  use delos_transfers, only: delos_transfer, DELOS_ORDER_SECOND, DELOS_ORDER_FIRST, &
    DELOS_LIMITER_GRADIENT, DELOS_LIMITER_NONE, DELOS_LIMITER_ASSURED_SUM, DELOS_VELOCITY_VECTORS, &
    DELOS_VELOCITY_STREAM_FUNCTION, DELOS_VELOCITY_HELMHOLTZ, DELOS_NORMALIZATION_COVERED, &
    DELOS_NORMALIZATION_WHOLE
  implicit none
  public
end module delos
