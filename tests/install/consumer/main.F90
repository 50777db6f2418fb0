! SPDX-License-Identifier: BSD-3-Clause
! The same through the Fortran module.
program fortran_consumer
  use delos
  implicit none
  type(delos_config) :: config
  type(delos_grid) :: grid
  integer :: ierr
  call config%from_text("sizing: {sources: [{type: constant, spacing: 600 km}]}", ierr=ierr)
  call grid%generate(config, ierr=ierr)
  if (ierr /= DELOS_SUCCESS) error stop 1
  print "(a, i0, a, es17.10, a)", "in Fortran: ", grid%n_cells(), " cells, total area ", &
    sum(grid%cell_area_m2()), " m2"
  if (grid%n_cells() < 1000) error stop 1
  call grid%destroy()
  call config%destroy()
end program
