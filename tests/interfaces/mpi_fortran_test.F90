! SPDX-License-Identifier: BSD-3-Clause
! A Fortran host on some processes; prints nothing but its failures.
module weights
  use, intrinsic :: iso_c_binding, only: c_ptr
  use delos_mpi
  implicit none
contains
  function north_only(n_cells, lon_lat, weight, user_data) bind(c) result(status)
    integer(c_int64_t), value :: n_cells
    real(c_double), intent(in) :: lon_lat(2, n_cells)
    real(c_double), intent(out) :: weight(n_cells)
    type(c_ptr), value :: user_data
    integer(c_int) :: status
    weight = merge(60, 1, lon_lat(2, :) > 0)
    status = merge(0, 1, size(weight) > 0)
  end function
end module

program mpi_fortran_test
  use, intrinsic :: iso_fortran_env, only: error_unit
  use mpi
  use delos_mpi
  use weights
  implicit none
  character(len=*), parameter :: SMALL = &
    "sizing: {sources: [{type: constant, spacing: 600 km}]}"//new_line("a")// &
    "refine: {tile_vertices: 500}"//new_line("a")
  character(len=*), parameter :: OCEAN = &
    "generator: icosahedral"//new_line("a")//"subdivisions: 4"//new_line("a")//"data_path: [/none]"//new_line("a")// &
    "layers: {kind: z_level, levels: {shape: uniform, n: 5, depth: 5000 m}}"//new_line("a")
  type(delos_mpi_grid) :: grid, other
  real(c_double), pointer :: area_m2(:)
  integer :: rank, n_ranks, ierr, n_failed = 0
  call MPI_Init(ierr)
  call MPI_Comm_rank(MPI_COMM_WORLD, rank, ierr)
  call MPI_Comm_size(MPI_COMM_WORLD, n_ranks, ierr)

  area_m2 => grid%cell_area_m2(ierr)
  call check(ierr /= DELOS_SUCCESS .and. .not. associated(area_m2), "an empty object has no arrays")
  call grid%set_options(threads=1, root=n_ranks - 1, halo_layers=2)
  call grid%set_weight(north_only)
  call grid%generate_from_text(MPI_COMM_WORLD, SMALL, ierr=ierr)
  call check(ierr == DELOS_SUCCESS, "generate: "//grid%message())
  call check_tables()
  call check_fields()
  other = grid
  call check(other%n_local(DELOS_MPI_CELL) == 0, "an assigned object stays empty")
  call other%set_options(work=DELOS_MPI_WORK_LAYERS)
  call other%generate_from_text(MPI_COMM_WORLD, SMALL, ierr=ierr)
  call check(ierr == DELOS_ERROR_CONFIG .and. index(other%message(), "section layers") > 0, &
             "there are no layers to count: "//other%message())
  call other%set_options()
  call other%generate_from_text(MPI_COMM_WORLD, OCEAN, ierr=ierr)
  call check(ierr == DELOS_SUCCESS, "generate an ocean: "//other%message())
  call check_layers()
  call other%destroy()

  call grid%generate(MPI_COMM_WORLD, "/nowhere.yaml", ierr)
  call check(ierr == DELOS_ERROR_INPUT, "a missing file is an input error")
  call check(index(grid%message(), "/nowhere.yaml") > 0, "and named: "//grid%message())
  call grid%generate_from_text(MPI_COMM_NULL, SMALL, ierr=ierr)
  call check(ierr == DELOS_ERROR_STATE, "MPI_COMM_NULL is a state error")
  call check(index(grid%message(), "MPI_COMM_NULL") > 0, "and named: "//grid%message())
  call grid%destroy()
  call MPI_Finalize(ierr)
  if (n_failed > 0) error stop 1

contains

  subroutine check(holds, what)
    logical, intent(in) :: holds
    character(len=*), intent(in) :: what
    if (holds) return
    n_failed = n_failed + 1
    write (error_unit, "(a, i0, 2a)") "rank ", rank, ": not so: ", what
  end subroutine

  ! Every table has its size, and an owned cell all its neighbours.
  subroutine check_tables()
    integer :: n_cells, n_edges, n_vertices
    integer(c_int64_t), pointer :: offsets(:)
    integer(c_int32_t), pointer :: neighbours(:), ids(:)
    integer(c_int32_t), allocatable :: cells(:)
    n_cells = int(grid%n_local(DELOS_MPI_CELL))
    n_edges = int(grid%n_local(DELOS_MPI_EDGE))
    n_vertices = int(grid%n_local(DELOS_MPI_VERTEX))
    offsets => grid%cell_offsets()
    call check(size(offsets) == n_cells + 1, "cell_offsets")
    call check(size(grid%edges_on_cell()) == offsets(n_cells + 1), "edges_on_cell")
    call check(size(grid%vertices_on_cell()) == offsets(n_cells + 1), "vertices_on_cell")
    cells = delos_one_based(grid%cells_on_cell())
    call check(all(cells(:offsets(grid%n_owned(DELOS_MPI_CELL) + 1)) > 0), "cells_on_cell")
    call check(all(cells >= 0 .and. cells <= n_cells), "cells_on_cell in range")
    call check(all(shape(grid%cells_on_edge()) == [2, n_edges]), "cells_on_edge")
    call check(all(shape(grid%vertices_on_edge()) == [2, n_edges]), "vertices_on_edge")
    call check(all(shape(grid%cells_on_vertex()) == [3, n_vertices]), "cells_on_vertex")
    call check(all(shape(grid%edges_on_vertex()) == [3, n_vertices]), "edges_on_vertex")
    call check(size(grid%edges_on_edge()) == size(grid%weights_on_edge()), "weights_on_edge")
    call check(all(shape(grid%cell_position()) == [3, n_cells]), "cell_position")
    call check(all(shape(grid%kite_area_m2()) == [3, n_vertices]), "kite_area_m2")
    call check(size(grid%triangle_area_m2()) == n_vertices, "triangle_area_m2")
    call check(size(grid%edge_angle_rad()) == n_edges, "edge_angle_rad")
    call check(size(grid%layer_offsets(DELOS_MPI_CELL)) == 4, "layer_offsets")
    call check(len(grid%digest()) == 64 .and. grid%generation() == 1, "digest, generation")
    neighbours => grid%neighbours(DELOS_MPI_EDGE)
    call check(associated(neighbours) .and. all(neighbours /= rank), "neighbours")
    offsets => grid%receive_offsets(DELOS_MPI_EDGE)
    ids => grid%receive_ids(DELOS_MPI_EDGE)
    call check(size(offsets) == size(neighbours) + 1, "receive_offsets")
    call check(size(ids) == n_edges - grid%n_owned(DELOS_MPI_EDGE), "receive_ids")
    ids => grid%owner(9)
    call check(.not. associated(ids), "a wrong location has no list")
  end subroutine

  subroutine check_layers()
    real(c_double), allocatable :: thickness_m(:, :)
    call other%layer_thickness_m(thickness_m, ierr)
    call check(ierr == DELOS_SUCCESS .and. other%n_levels() == 5, "layer_thickness_m")
    call check(all(shape(thickness_m) == [5, int(other%n_local(DELOS_MPI_CELL))]), "its shape")
    call check(all(abs(sum(thickness_m, 1) - other%bottom_depth_m()) < 1d-9), "bottom_depth_m")
    call check(all(count(thickness_m > 0, 1) == other%max_level_cell()), "max_level_cell")
    call check(.not. associated(grid%bottom_depth_m()), "a grid without layers has no bottom")
  end subroutine

  subroutine check_fields()
    integer(c_int32_t), pointer :: id(:)
    real(c_double), allocatable :: field(:), table(:, :), whole(:)
    integer(c_int64_t) :: n_owned
    id => grid%global_id(DELOS_MPI_VERTEX)
    n_owned = grid%n_owned(DELOS_MPI_VERTEX)
    field = real(id, c_double)
    field(n_owned + 1:) = -1
    call grid%exchange(field, DELOS_MPI_VERTEX, ierr)
    call check(ierr == DELOS_SUCCESS .and. all(field == id), "exchange of numbers")
    allocate (table(2, size(id)), source=-1.0_c_double)
    table(1, :n_owned) = id(:n_owned)
    table(2, :n_owned) = 2*id(:n_owned)
    call grid%exchange(table, DELOS_MPI_VERTEX, ierr)
    call check(ierr == DELOS_SUCCESS .and. all(table(1, :) == id) .and. all(table(2, :) == 2*id), &
               "exchange of pairs")
    allocate (whole(merge(grid%n_global(DELOS_MPI_VERTEX), 0_c_int64_t, rank == n_ranks - 1)))
    call grid%gather(field(:n_owned), DELOS_MPI_VERTEX, whole, ierr)
    call check(ierr == DELOS_SUCCESS, "gather")
    if (rank == n_ranks - 1) call check(nint(maxval(whole)) == size(whole) - 1, "gathered values")
    field = -1
    call grid%scatter(whole, DELOS_MPI_VERTEX, field, ierr)
    call check(ierr == DELOS_SUCCESS .and. all(field == id), "scatter")
    call grid%exchange(field, 5, ierr)
    call check(ierr == DELOS_ERROR_CONFIG, "a wrong location is refused")
  end subroutine
end program
