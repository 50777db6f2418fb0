! SPDX-License-Identifier: BSD-3-Clause
! A Fortran host: a grid, its arrays, its errors. Prints only what fails; with a word: the digest.
module fortran_grid_test
  use, intrinsic :: iso_c_binding, only: c_ptr
  use, intrinsic :: iso_fortran_env, only: error_unit
  use delos
  implicit none
  integer :: n_failed = 0
  integer :: n_progress = 0, n_messages = 0, n_bad_messages = 0
  logical :: wants_stop = .false., has_estimate = .false.
  type(delos_grid) :: watched

contains

  subroutine expect(condition, what)
    logical, intent(in) :: condition
    character(len=*), intent(in) :: what
    if (condition) return
    write (error_unit, "(2a)") "fortran_grid_test: not: ", what
    n_failed = n_failed + 1
  end subroutine

  subroutine on_progress(progress, user_data) bind(c)
    type(delos_progress), intent(in) :: progress
    type(c_ptr), value :: user_data
    associate (unused => user_data)
    end associate
    if (progress%done >= 0) n_progress = n_progress + 1
    if (wants_stop) call watched%cancel()
  end subroutine

  function small_yaml() result(yaml)
    character(len=:), allocatable :: yaml
    yaml = "sizing: {sources: [{type: constant, spacing: 600 km}]}"//new_line("a")// &
           "refine: {tile_vertices: 500}"
  end function

  subroutine test_arrays(grid)
    type(delos_grid), intent(in) :: grid
    real(c_double), pointer :: area_m2(:), kite_m2(:, :), lon_lat(:, :), position(:, :), weights(:)
    real(c_double) :: radii_m(3), earth_m2
    integer :: ierr
    radii_m = grid%radii_m(ierr)
    call expect(ierr == DELOS_SUCCESS, "radii_m succeeds")
    call expect(abs(radii_m(1) - 6371220d0) < 1d-3 .and. abs(grid%scale_m() - radii_m(1)) < 1d-9, &
                "the radius is the Earth's")
    earth_m2 = 4*acos(-1d0)*radii_m(1)**2
    area_m2 => grid%cell_area_m2(ierr)
    call expect(ierr == DELOS_SUCCESS, "cell_area_m2 succeeds")
    call expect(size(area_m2) == grid%n_cells(), "an area for each cell")
    call expect(abs(sum(area_m2)/earth_m2 - 1) < 1d-12, "the areas sum to the surface")
    kite_m2 => grid%kite_area_m2()
    call expect(all(shape(kite_m2) == [3_c_int64_t, grid%n_vertices()]), "three kites a vertex")
    call expect(abs(sum(kite_m2)/earth_m2 - 1) < 1d-9, "the kites sum to the surface")
    lon_lat => grid%cell_lon_lat()
    position => grid%cell_position()
    call expect(size(position, 1) == 3 .and. size(lon_lat, 1) == 2, "columns come first")
    call expect(maxval(abs(sin(lon_lat(2, :)) - position(3, :))) < 1d-12, "latitude fits position")
    weights => grid%weights_on_edge()
    call expect(size(weights) == size(grid%edges_on_edge()), "a weight for each neighbour")
  end subroutine

  ! With base 1: each edge of a cell names the cell.
  subroutine test_connectivity(grid)
    type(delos_grid), intent(in) :: grid
    integer(c_int64_t), allocatable :: begin(:)
    integer(c_int32_t), allocatable :: edges(:), cells(:, :)
    integer(c_int64_t) :: cell, k, n_wrong
    allocate (begin, source=delos_one_based(grid%cell_offsets()))
    allocate (edges, source=delos_one_based(grid%edges_on_cell()))
    allocate (cells, source=delos_one_based(grid%cells_on_edge()))
    call expect(grid%n_cells() - grid%n_edges() + grid%n_vertices() == 2, "Euler's formula holds")
    call expect(minval(edges) == 1 .and. maxval(edges) == grid%n_edges(), "edges have base 1")
    call expect(minval(cells) == 1 .and. maxval(cells) == grid%n_cells(), "cells have base 1")
    n_wrong = 0
    do cell = 1, grid%n_cells()
      do k = begin(cell), begin(cell + 1) - 1
        if (.not. any(cells(:, edges(k)) == cell)) n_wrong = n_wrong + 1
      end do
    end do
    call expect(n_wrong == 0, "each edge of a cell names the cell")
  end subroutine

  subroutine test_numbers(grid)
    type(delos_grid), intent(in) :: grid
    type(delos_quality) :: quality
    type(delos_certificate) :: certificate
    quality = grid%quality()
    certificate = grid%certificate()
    call expect(certificate%well_centred == 1 .and. certificate%n_obtuse == 0, "well centred")
    call expect(quality%n_obtuse == 0 .and. quality%max_angle_deg < 90, "no obtuse angle")
    call expect(certificate%angle_max_deg%value > 60 .and. certificate%angle_max_deg%cells(1) == -1 &
                .and. certificate%stagger_max%cells(2) >= 0, "the worst elements are named")
    call expect(abs(certificate%angle_max_deg%value - quality%max_angle_deg) < 1d-12, "one angle")
    call expect(grid%generation() == 1 .and. grid%max_edges() >= 6, "first generation")
    call expect(index(grid%report_json(), "{") == 1 .and. len(grid%report()) > 100, "the reports")
    call expect(index(grid%config_text(), "600 km") > 0, "the configuration is kept")
  end subroutine

  subroutine test_errors(grid)
    type(delos_grid), intent(inout) :: grid
    type(delos_grid) :: second
    type(delos_config) :: config
    real(c_double), pointer :: area_m2(:)
    integer :: ierr
    call config%from_text("sizing: [", "mine.yaml", ierr=ierr)
    call expect(ierr == DELOS_ERROR_CONFIG .and. .not. config%is_made(), "bad YAML is refused")
    call expect(index(config%message(), "mine.yaml:") == 1, "the message names the place")
    call config%check(ierr)
    call expect(ierr == DELOS_ERROR_ARGUMENT, "no configuration is an error")
    call second%generate(config, ierr=ierr)
    call expect(ierr == DELOS_ERROR_ARGUMENT, "no grid without a configuration")
    call expect(index(second%message(), "config is NULL") > 0, "the message says so")
    call config%from_text(small_yaml(), ierr=ierr)
    call second%generate(config, threads=-1, ierr=ierr)
    call expect(ierr == DELOS_ERROR_ARGUMENT, "threads must not be negative")
    call config%set("sizing.sources.0.spacing", "500 km", ierr)
    call expect(ierr == DELOS_SUCCESS .and. index(config%text(), "500 km") > 0, "set is heard")
    call config%set("require.angle_max", "60.5 deg")
    call second%generate(config, ierr=ierr)
    call expect(ierr == DELOS_ERROR_QUALITY, "a missed requirement is an error")
    call grid%write_mpas("no such folder/a.nc", ierr)
    call expect(ierr == DELOS_ERROR_OUTPUT .and. len(grid%message()) > 0, "no file in no folder")
    second = grid
    call expect(.not. second%is_made() .and. grid%is_made(), "grids can't be assigned")
    call grid%destroy()
    area_m2 => grid%cell_area_m2(ierr)
    call expect(ierr == DELOS_ERROR_ARGUMENT .and. .not. associated(area_m2), "destroyed is empty")
    call expect(grid%n_cells() == 0 .and. grid%digest() == "", "and has no cells")
    call grid%destroy()
  end subroutine

  subroutine test_progress()
    type(delos_config) :: config
    integer :: ierr
    call config%from_text(small_yaml())
    call watched%set_progress(on_progress)
    call watched%generate(config, threads=2, ierr=ierr)
    call expect(ierr == DELOS_SUCCESS .and. n_progress > 0, "progress is heard")
    wants_stop = .true.
    call watched%generate(config, ierr=ierr)
    call expect(ierr == DELOS_ERROR_CANCELLED, "the callback stops generate")
    call expect(.not. watched%is_made(), "and there is no grid")
    call watched%destroy()
  end subroutine

  subroutine on_log(level, message)
    integer, intent(in) :: level
    character(len=*), intent(in) :: message
    n_messages = n_messages + 1
    if (level < DELOS_LOG_DEBUG .or. level > DELOS_LOG_ERROR .or. len(message) == 0 &
        .or. scan(message, new_line("a")//achar(0)) > 0) n_bad_messages = n_bad_messages + 1
    if (index(message, "expecting ") == 1) has_estimate = .true.
  end subroutine

  ! Messages come whole, until the procedure is taken away.
  subroutine test_log()
    type(delos_grid) :: grid
    type(delos_config) :: config
    integer :: ierr, n_before
    call config%from_text(small_yaml())
    call grid%set_log(on_log)
    call grid%generate(config, threads=2, ierr=ierr)
    call expect(ierr == DELOS_SUCCESS .and. n_messages > 0, "messages are heard")
    call expect(n_bad_messages == 0, "with a level and a text, without a line end")
    call expect(has_estimate, "and they are what delos says")
    n_before = n_messages
    call grid%generate(config, ierr=ierr)
    call expect(n_messages >= 2*n_before, "by later generates too")
    n_before = n_messages
    call grid%set_log()
    call grid%generate(config, ierr=ierr)
    call expect(ierr == DELOS_SUCCESS .and. n_messages == n_before, "nobody listens any more")
    call grid%destroy()
    call grid%set_log(on_log)
    call grid%generate(config, ierr=ierr)
    call expect(n_messages > n_before, "and again, after destroy")
  end subroutine

  subroutine test_layers(plain)
    type(delos_grid), intent(in) :: plain
    type(delos_config) :: config
    type(delos_grid) :: grid
    real(c_double), pointer :: bottom_m(:)
    integer(c_int32_t), pointer :: deepest(:)
    real(c_double), allocatable :: thickness_m(:, :), height_m(:, :)
    integer :: ierr
    bottom_m => plain%bottom_depth_m(ierr)
    call plain%layer_thickness_m(thickness_m)
    call expect(ierr == DELOS_SUCCESS .and. .not. associated(bottom_m) .and. plain%n_levels() == 0 &
                .and. size(thickness_m) == 0, "a grid without layers has none")
    call config%from_text("generator: icosahedral"//new_line("a")//"subdivisions: 4"//new_line("a")// &
                          "data_path: [/none]"//new_line("a")// &
                          "layers: {kind: z_level, levels: {shape: uniform, n: 5, depth: 5000 m}}")
    call grid%generate(config, ierr=ierr)
    call expect(ierr == DELOS_SUCCESS, "a grid with layers is made")
    call expect(grid%n_levels() == 5, "five levels")
    bottom_m => grid%bottom_depth_m()
    deepest => grid%max_level_cell()
    call grid%layer_thickness_m(thickness_m, ierr)
    call expect(ierr == DELOS_SUCCESS .and. all(shape(thickness_m) == [5, 162]), "thickness of layers")
    call expect(all(abs(sum(thickness_m, 1) - bottom_m) < 1d-9), "layers lie on the bottom")
    call expect(all(count(thickness_m > 0, 1) == deepest), "layers down to the deepest")
    call grid%interface_height_m(height_m, ierr)
    call expect(all(abs(height_m(6, :) + bottom_m) < 1d-9), "the last interface is the bottom")
    call expect(.not. associated(grid%ground_height_m()), "an ocean has no ground")
  end subroutine
end module fortran_grid_test

program main
  use fortran_grid_test
  implicit none
  type(delos_config) :: config
  type(delos_grid) :: grid
  integer :: ierr
  call config%from_text(small_yaml(), ierr=ierr)
  call expect(ierr == DELOS_SUCCESS, "the configuration is read")
  call grid%generate(config, ierr=ierr)
  call expect(ierr == DELOS_SUCCESS, "the grid is made")
  if (command_argument_count() > 0) then
    print "(a)", grid%digest()
  else
    call test_arrays(grid)
    call test_layers(grid)
    call test_connectivity(grid)
    call test_numbers(grid)
    call test_errors(grid)
    call test_progress()
    call test_log()
  end if
  call grid%destroy()
  call config%destroy()
  if (n_failed > 0) error stop 1
end program
