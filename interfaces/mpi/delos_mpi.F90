! SPDX-License-Identifier: BSD-3-Clause
! delos over MPI for Fortran 2008: a grid made once by one process of a communicator, handed out part
! by part. Adapts delos/delos_mpi.h.
!
!   use delos_mpi
!   type(delos_mpi_grid) :: grid
!   call grid%generate(MPI_COMM_WORLD, "world_ocean.yaml", ierr=ierr)    ! an integer communicator
!   if (ierr /= DELOS_SUCCESS) call model_stop(grid%message())
!   area_m2 => grid%cell_area_m2()                    ! owned cells first, then the halo
!   call grid%exchange(thickness_m, DELOS_MPI_CELL)   ! the halo from its owners
!   call grid%destroy()                               ! before MPI_Finalize
!
! A communicator of module mpi_f08 gives its integer as comm%MPI_VAL. generate, destroy, exchange,
! gather and scatter are collective. ierr as in module delos: optional, 0 or a status; message() is
! the text of the last failure. Ids are local with base 0, -1 beyond the halo; delos_one_based()
! copies them with base 1, 0 beyond the halo. Pointers are valid until destroy() or generate().
module delos_mpi
  use, intrinsic :: iso_c_binding, only: c_associated, c_char, c_double, c_f_pointer, c_funloc, &
    c_int, c_int32_t, c_int64_t, c_null_char, c_null_ptr, c_ptr
  use delos, only: delos_one_based, DELOS_SUCCESS, DELOS_ERROR_STATE, DELOS_ERROR_ARGUMENT, &
    DELOS_ERROR_CONFIG, DELOS_ERROR_INPUT, DELOS_ERROR_OUTPUT, DELOS_ERROR_RESOURCE, &
    DELOS_ERROR_INTERNAL, DELOS_ERROR_QUALITY, DELOS_ERROR_CANCELLED
  use delos_mpi_binding
  implicit none
  private
  public :: delos_mpi_grid, delos_mpi_weight, delos_one_based, c_double, c_int, c_int32_t, c_int64_t
  public :: DELOS_SUCCESS, DELOS_ERROR_STATE, DELOS_ERROR_ARGUMENT, DELOS_ERROR_CONFIG, &
    DELOS_ERROR_INPUT, DELOS_ERROR_OUTPUT, DELOS_ERROR_RESOURCE, DELOS_ERROR_INTERNAL, &
    DELOS_ERROR_QUALITY, DELOS_ERROR_CANCELLED

  ! Where a field's values are.
  integer, parameter, public :: DELOS_MPI_CELL = 0, DELOS_MPI_EDGE = 1, DELOS_MPI_VERTEX = 2
  ! How cells are shared out: automatic is METIS's k-way method where delos has it, else the curve.
  integer, parameter, public :: DELOS_MPI_AUTOMATIC = 0, DELOS_MPI_KWAY = 1, DELOS_MPI_CURVE = 2

  abstract interface
    ! The work of each cell, e.g. its wet layers, from lon_lat (2, n_cells) in radians; called on
    ! the generating process. 0, or another number to fail.
    function delos_mpi_weight(n_cells, lon_lat, weight, user_data) bind(c) result(status)
      import :: c_double, c_int, c_int64_t, c_ptr
      integer(c_int64_t), value :: n_cells
      real(c_double), intent(in) :: lon_lat(2, n_cells)
      real(c_double), intent(out) :: weight(n_cells)
      type(c_ptr), value :: user_data
      integer(c_int) :: status
    end function
  end interface

  ! What an empty list points to.
  integer(c_int32_t), target, save :: no_ids(0)

  type :: delos_mpi_grid
    private
    type(c_ptr) :: handle = c_null_ptr
    type(c_options) :: options
  contains
    procedure :: set_options
    procedure :: set_weight
    procedure :: generate
    procedure :: generate_from_text
    procedure :: destroy
    procedure :: message
    procedure :: generation
    procedure :: digest
    procedure :: n_local          ! (location) owned and halo
    procedure :: n_owned          ! (location) the first ones
    procedure :: n_global         ! (location) of the whole grid
    procedure :: global_id        ! (location) -> (n_local) base 0
    procedure :: owner            ! (location) -> (n_local) rank
    procedure :: layer_offsets    ! (location) where the halo's layers begin, base 0; 0 is owned
    procedure :: neighbours       ! (location) ranks to exchange with
    procedure :: send_offsets     ! (location) -> (n_neighbours + 1) into send_ids
    procedure :: send_ids         ! (location) what a neighbour needs
    procedure :: receive_offsets  ! (location) -> (n_neighbours + 1) into receive_ids
    procedure :: receive_ids      ! (location) what comes from it
    procedure :: cell_position
    procedure :: edge_position
    procedure :: vertex_position
    procedure :: cell_lon_lat
    procedure :: edge_lon_lat
    procedure :: vertex_lon_lat
    procedure :: cell_offsets
    procedure :: edges_on_cell
    procedure :: vertices_on_cell
    procedure :: cells_on_cell
    procedure :: cells_on_edge
    procedure :: vertices_on_edge
    procedure :: cells_on_vertex
    procedure :: edges_on_vertex
    procedure :: edge_offsets
    procedure :: edges_on_edge
    procedure :: weights_on_edge
    procedure :: cell_area_m2
    procedure :: cell_spacing_m
    procedure :: edge_spacing_m
    procedure :: triangle_area_m2
    procedure :: kite_area_m2
    procedure :: cell_distance_m
    procedure :: vertex_distance_m
    procedure :: edge_angle_rad
    procedure, private :: exchange_vector, exchange_table
    generic :: exchange => exchange_vector, exchange_table
    procedure :: gather
    procedure :: scatter
    procedure, private :: refuse_assignment
    generic :: assignment(=) => refuse_assignment
  end type

contains

  ! For the next generate; without an argument: the default (threads as configured, root 0, one halo
  ! layer). root and halo_layers must be the same everywhere.
  subroutine set_options(self, threads, root, halo_layers, method)
    class(delos_mpi_grid), intent(inout) :: self
    integer, intent(in), optional :: threads, root, halo_layers, method
    self%options%n_threads = 0
    self%options%root = 0
    self%options%halo_layers = 1
    self%options%method = DELOS_MPI_AUTOMATIC
    if (present(threads)) self%options%n_threads = int(threads, c_int)
    if (present(root)) self%options%root = int(root, c_int)
    if (present(halo_layers)) self%options%halo_layers = int(halo_layers, c_int)
    if (present(method)) self%options%method = int(method, c_int)
  end subroutine

  ! The work of the cells, for the next generate.
  subroutine set_weight(self, weight)
    class(delos_mpi_grid), intent(inout) :: self
    procedure(delos_mpi_weight) :: weight
    self%options%cell_weight = c_funloc(weight)
  end subroutine

  ! The file is read by the generating process only. The former grid of this object is gone.
  subroutine generate(self, comm, path, ierr)
    class(delos_mpi_grid), intent(inout) :: self
    integer, intent(in) :: comm
    character(len=*), intent(in) :: path
    integer, intent(out), optional :: ierr
    call self%destroy()
    call report(c_generate_file(int(comm, c_int), trim(path)//c_null_char, self%options, &
                                self%handle), ierr)
  end subroutine

  ! YAML with new_line() between lines; file names in it are relative to `folder`.
  subroutine generate_from_text(self, comm, yaml, folder, ierr)
    class(delos_mpi_grid), intent(inout) :: self
    integer, intent(in) :: comm
    character(len=*), intent(in) :: yaml
    character(len=*), intent(in), optional :: folder
    integer, intent(out), optional :: ierr
    character(len=:), allocatable :: base
    base = "."
    if (present(folder)) base = trim(folder)
    call self%destroy()
    call report(c_generate_text(int(comm, c_int), yaml//c_null_char, base//c_null_char, &
                                self%options, self%handle), ierr)
  end subroutine

  ! Collective, and not left to the end of a scope: that end comes at other times elsewhere, or
  ! after MPI_Finalize.
  subroutine destroy(self)
    class(delos_mpi_grid), intent(inout) :: self
    integer(c_int) :: status
    status = c_destroy(self%handle)
    if (status == DELOS_SUCCESS) self%handle = c_null_ptr
  end subroutine

  ! Two objects of one handle would free it twice: the left side stays as it is.
  subroutine refuse_assignment(self, other)
    class(delos_mpi_grid), intent(inout) :: self
    class(delos_mpi_grid), intent(in) :: other
    if (.not. c_associated(self%handle, other%handle)) return
  end subroutine

  function message(self)
    class(delos_mpi_grid), intent(in) :: self
    character(len=:), allocatable :: message
    message = from_c(c_last_error(self%handle))
  end function

  subroutine report(status, ierr)
    integer(c_int), intent(in) :: status
    integer, intent(out), optional :: ierr
    if (present(ierr)) ierr = int(status)
  end subroutine

  function from_c(text) result(string)
    type(c_ptr), intent(in) :: text
    character(len=:), allocatable :: string
    character(kind=c_char), pointer :: characters(:)
    integer :: i
    if (.not. c_associated(text)) then
      string = ""
      return
    end if
    call c_f_pointer(text, characters, [c_strlen(text)])
    allocate (character(len=size(characters)) :: string)
    do i = 1, size(characters)
      string(i:i) = characters(i)
    end do
  end function

  function generation(self, ierr) result(n)
    class(delos_mpi_grid), intent(in) :: self
    integer, intent(out), optional :: ierr
    integer(c_int64_t) :: n
    n = 0
    call report(c_generation(self%handle, n), ierr)
  end function

  ! SHA-256 of the whole grid.
  function digest(self, ierr) result(string)
    class(delos_mpi_grid), intent(in) :: self
    integer, intent(out), optional :: ierr
    character(len=:), allocatable :: string
    type(c_ptr) :: text
    call report(c_digest(self%handle, text), ierr)
    string = from_c(text)
  end function

  ! --- fields: (n_local) or (n_components, n_local), owned ones first

  ! Sets the halo to the owners' values.
  subroutine exchange_vector(self, values, location, ierr)
    class(delos_mpi_grid), intent(in) :: self
    real(c_double), intent(inout), contiguous :: values(:)
    integer, intent(in) :: location
    integer, intent(out), optional :: ierr
    call report(c_exchange(self%handle, values, size(values, kind=c_int64_t), &
                           int(location, c_int), 1_c_int), ierr)
  end subroutine

  subroutine exchange_table(self, values, location, ierr)
    class(delos_mpi_grid), intent(in) :: self
    real(c_double), intent(inout), contiguous :: values(:, :)
    integer, intent(in) :: location
    integer, intent(out), optional :: ierr
    call report(c_exchange(self%handle, values, size(values, kind=c_int64_t), &
                           int(location, c_int), size(values, 1, c_int)), ierr)
  end subroutine

  ! The owned or all local values -> whole (n_global) on the generating process; elsewhere `whole`
  ! may have any size.
  subroutine gather(self, values, location, whole, ierr)
    class(delos_mpi_grid), intent(in) :: self
    real(c_double), intent(in), contiguous :: values(:)
    integer, intent(in) :: location
    real(c_double), intent(inout), contiguous :: whole(:)
    integer, intent(out), optional :: ierr
    call report(c_gather(self%handle, values, size(values, kind=c_int64_t), int(location, c_int), &
                         1_c_int, whole), ierr)
  end subroutine

  ! And back, into all local places.
  subroutine scatter(self, whole, location, values, ierr)
    class(delos_mpi_grid), intent(in) :: self
    real(c_double), intent(in), contiguous :: whole(:)
    integer, intent(in) :: location
    real(c_double), intent(inout), contiguous :: values(:)
    integer, intent(out), optional :: ierr
    call report(c_scatter(self%handle, whole, int(location, c_int), 1_c_int, values, &
                          size(values, kind=c_int64_t)), ierr)
  end subroutine

  ! --- numbers and arrays of the part

  function count_of(self, getter, location, ierr) result(n)
    class(delos_mpi_grid), intent(in) :: self
    procedure(count_getter) :: getter
    integer, intent(in) :: location
    integer, intent(out), optional :: ierr
    integer(c_int64_t) :: n
    n = 0
    call report(getter(self%handle, int(location, c_int), n), ierr)
  end function

  ! An array of any kind, as its address and the number of its values.
  subroutine get_array(self, getter, first, n, ierr)
    class(delos_mpi_grid), intent(in) :: self
    procedure(array_getter) :: getter
    type(c_ptr), intent(out) :: first
    integer(c_int64_t), intent(out) :: n
    integer, intent(out), optional :: ierr
    integer(c_int) :: status
    status = getter(self%handle, first, n)
    if (status /= DELOS_SUCCESS) first = c_null_ptr
    call report(status, ierr)
  end subroutine

  subroutine get_list(self, getter, location, ids, ierr)
    class(delos_mpi_grid), intent(in) :: self
    procedure(list_getter) :: getter
    integer, intent(in) :: location
    integer(c_int32_t), pointer, intent(out) :: ids(:)
    integer, intent(out), optional :: ierr
    type(c_ptr) :: first
    integer(c_int64_t) :: n
    integer(c_int) :: status
    status = getter(self%handle, int(location, c_int), first, n)
    ids => null()
    if (status == DELOS_SUCCESS .and. n == 0) ids => no_ids
    if (status == DELOS_SUCCESS .and. n > 0) call c_f_pointer(first, ids, [n])
    call report(status, ierr)
  end subroutine

  subroutine get_offsets(self, getter, location, offsets, ierr)
    class(delos_mpi_grid), intent(in) :: self
    procedure(list_getter) :: getter
    integer, intent(in) :: location
    integer(c_int64_t), pointer, intent(out) :: offsets(:)
    integer, intent(out), optional :: ierr
    type(c_ptr) :: first
    integer(c_int64_t) :: n
    integer(c_int) :: status
    status = getter(self%handle, int(location, c_int), first, n)
    offsets => null()
    if (status == DELOS_SUCCESS) call c_f_pointer(first, offsets, [n])
    call report(status, ierr)
  end subroutine

  function n_local(self, location, ierr) result(n)
    class(delos_mpi_grid), intent(in) :: self
    integer, intent(in) :: location
    integer, intent(out), optional :: ierr
    integer(c_int64_t) :: n
    n = count_of(self, c_n_local, location, ierr)
  end function

  function n_owned(self, location, ierr) result(n)
    class(delos_mpi_grid), intent(in) :: self
    integer, intent(in) :: location
    integer, intent(out), optional :: ierr
    integer(c_int64_t) :: n
    n = count_of(self, c_n_owned, location, ierr)
  end function

  function n_global(self, location, ierr) result(n)
    class(delos_mpi_grid), intent(in) :: self
    integer, intent(in) :: location
    integer, intent(out), optional :: ierr
    integer(c_int64_t) :: n
    n = count_of(self, c_n_global, location, ierr)
  end function

  function global_id(self, location, ierr) result(ids)
    class(delos_mpi_grid), intent(in) :: self
    integer, intent(in) :: location
    integer, intent(out), optional :: ierr
    integer(c_int32_t), pointer :: ids(:)
    call get_list(self, c_global_id, location, ids, ierr)
  end function

  function owner(self, location, ierr) result(ids)
    class(delos_mpi_grid), intent(in) :: self
    integer, intent(in) :: location
    integer, intent(out), optional :: ierr
    integer(c_int32_t), pointer :: ids(:)
    call get_list(self, c_owner, location, ids, ierr)
  end function

  function neighbours(self, location, ierr) result(ids)
    class(delos_mpi_grid), intent(in) :: self
    integer, intent(in) :: location
    integer, intent(out), optional :: ierr
    integer(c_int32_t), pointer :: ids(:)
    call get_list(self, c_neighbours, location, ids, ierr)
  end function

  function send_ids(self, location, ierr) result(ids)
    class(delos_mpi_grid), intent(in) :: self
    integer, intent(in) :: location
    integer, intent(out), optional :: ierr
    integer(c_int32_t), pointer :: ids(:)
    call get_list(self, c_send_ids, location, ids, ierr)
  end function

  function receive_ids(self, location, ierr) result(ids)
    class(delos_mpi_grid), intent(in) :: self
    integer, intent(in) :: location
    integer, intent(out), optional :: ierr
    integer(c_int32_t), pointer :: ids(:)
    call get_list(self, c_receive_ids, location, ids, ierr)
  end function

  function layer_offsets(self, location, ierr) result(offsets)
    class(delos_mpi_grid), intent(in) :: self
    integer, intent(in) :: location
    integer, intent(out), optional :: ierr
    integer(c_int64_t), pointer :: offsets(:)
    call get_offsets(self, c_layer_offsets, location, offsets, ierr)
  end function

  function send_offsets(self, location, ierr) result(offsets)
    class(delos_mpi_grid), intent(in) :: self
    integer, intent(in) :: location
    integer, intent(out), optional :: ierr
    integer(c_int64_t), pointer :: offsets(:)
    call get_offsets(self, c_send_offsets, location, offsets, ierr)
  end function

  function receive_offsets(self, location, ierr) result(offsets)
    class(delos_mpi_grid), intent(in) :: self
    integer, intent(in) :: location
    integer, intent(out), optional :: ierr
    integer(c_int64_t), pointer :: offsets(:)
    call get_offsets(self, c_receive_offsets, location, offsets, ierr)
  end function

  function cell_position(self, ierr) result(values)
    class(delos_mpi_grid), intent(in) :: self
    integer, intent(out), optional :: ierr
    real(c_double), pointer :: values(:, :)
    type(c_ptr) :: first
    integer(c_int64_t) :: n
    call get_array(self, c_cell_position, first, n, ierr)
    values => null()
    if (c_associated(first)) call c_f_pointer(first, values, [3_c_int64_t, n/3])
  end function

  function edge_position(self, ierr) result(values)
    class(delos_mpi_grid), intent(in) :: self
    integer, intent(out), optional :: ierr
    real(c_double), pointer :: values(:, :)
    type(c_ptr) :: first
    integer(c_int64_t) :: n
    call get_array(self, c_edge_position, first, n, ierr)
    values => null()
    if (c_associated(first)) call c_f_pointer(first, values, [3_c_int64_t, n/3])
  end function

  function vertex_position(self, ierr) result(values)
    class(delos_mpi_grid), intent(in) :: self
    integer, intent(out), optional :: ierr
    real(c_double), pointer :: values(:, :)
    type(c_ptr) :: first
    integer(c_int64_t) :: n
    call get_array(self, c_vertex_position, first, n, ierr)
    values => null()
    if (c_associated(first)) call c_f_pointer(first, values, [3_c_int64_t, n/3])
  end function

  function cell_lon_lat(self, ierr) result(values)
    class(delos_mpi_grid), intent(in) :: self
    integer, intent(out), optional :: ierr
    real(c_double), pointer :: values(:, :)
    type(c_ptr) :: first
    integer(c_int64_t) :: n
    call get_array(self, c_cell_lon_lat, first, n, ierr)
    values => null()
    if (c_associated(first)) call c_f_pointer(first, values, [2_c_int64_t, n/2])
  end function

  function edge_lon_lat(self, ierr) result(values)
    class(delos_mpi_grid), intent(in) :: self
    integer, intent(out), optional :: ierr
    real(c_double), pointer :: values(:, :)
    type(c_ptr) :: first
    integer(c_int64_t) :: n
    call get_array(self, c_edge_lon_lat, first, n, ierr)
    values => null()
    if (c_associated(first)) call c_f_pointer(first, values, [2_c_int64_t, n/2])
  end function

  function vertex_lon_lat(self, ierr) result(values)
    class(delos_mpi_grid), intent(in) :: self
    integer, intent(out), optional :: ierr
    real(c_double), pointer :: values(:, :)
    type(c_ptr) :: first
    integer(c_int64_t) :: n
    call get_array(self, c_vertex_lon_lat, first, n, ierr)
    values => null()
    if (c_associated(first)) call c_f_pointer(first, values, [2_c_int64_t, n/2])
  end function

  function kite_area_m2(self, ierr) result(values)
    class(delos_mpi_grid), intent(in) :: self
    integer, intent(out), optional :: ierr
    real(c_double), pointer :: values(:, :)
    type(c_ptr) :: first
    integer(c_int64_t) :: n
    call get_array(self, c_kite_area_m2, first, n, ierr)
    values => null()
    if (c_associated(first)) call c_f_pointer(first, values, [3_c_int64_t, n/3])
  end function

  function cell_offsets(self, ierr) result(values)
    class(delos_mpi_grid), intent(in) :: self
    integer, intent(out), optional :: ierr
    integer(c_int64_t), pointer :: values(:)
    type(c_ptr) :: first
    integer(c_int64_t) :: n
    call get_array(self, c_cell_offsets, first, n, ierr)
    values => null()
    if (c_associated(first)) call c_f_pointer(first, values, [n])
  end function

  function edge_offsets(self, ierr) result(values)
    class(delos_mpi_grid), intent(in) :: self
    integer, intent(out), optional :: ierr
    integer(c_int64_t), pointer :: values(:)
    type(c_ptr) :: first
    integer(c_int64_t) :: n
    call get_array(self, c_edge_offsets, first, n, ierr)
    values => null()
    if (c_associated(first)) call c_f_pointer(first, values, [n])
  end function

  function edges_on_cell(self, ierr) result(values)
    class(delos_mpi_grid), intent(in) :: self
    integer, intent(out), optional :: ierr
    integer(c_int32_t), pointer :: values(:)
    type(c_ptr) :: first
    integer(c_int64_t) :: n
    call get_array(self, c_edges_on_cell, first, n, ierr)
    values => null()
    if (c_associated(first)) call c_f_pointer(first, values, [n])
  end function

  function vertices_on_cell(self, ierr) result(values)
    class(delos_mpi_grid), intent(in) :: self
    integer, intent(out), optional :: ierr
    integer(c_int32_t), pointer :: values(:)
    type(c_ptr) :: first
    integer(c_int64_t) :: n
    call get_array(self, c_vertices_on_cell, first, n, ierr)
    values => null()
    if (c_associated(first)) call c_f_pointer(first, values, [n])
  end function

  function cells_on_cell(self, ierr) result(values)
    class(delos_mpi_grid), intent(in) :: self
    integer, intent(out), optional :: ierr
    integer(c_int32_t), pointer :: values(:)
    type(c_ptr) :: first
    integer(c_int64_t) :: n
    call get_array(self, c_cells_on_cell, first, n, ierr)
    values => null()
    if (c_associated(first)) call c_f_pointer(first, values, [n])
  end function

  function edges_on_edge(self, ierr) result(values)
    class(delos_mpi_grid), intent(in) :: self
    integer, intent(out), optional :: ierr
    integer(c_int32_t), pointer :: values(:)
    type(c_ptr) :: first
    integer(c_int64_t) :: n
    call get_array(self, c_edges_on_edge, first, n, ierr)
    values => null()
    if (c_associated(first)) call c_f_pointer(first, values, [n])
  end function

  function cells_on_edge(self, ierr) result(values)
    class(delos_mpi_grid), intent(in) :: self
    integer, intent(out), optional :: ierr
    integer(c_int32_t), pointer :: values(:, :)
    type(c_ptr) :: first
    integer(c_int64_t) :: n
    call get_array(self, c_cells_on_edge, first, n, ierr)
    values => null()
    if (c_associated(first)) call c_f_pointer(first, values, [2_c_int64_t, n/2])
  end function

  function vertices_on_edge(self, ierr) result(values)
    class(delos_mpi_grid), intent(in) :: self
    integer, intent(out), optional :: ierr
    integer(c_int32_t), pointer :: values(:, :)
    type(c_ptr) :: first
    integer(c_int64_t) :: n
    call get_array(self, c_vertices_on_edge, first, n, ierr)
    values => null()
    if (c_associated(first)) call c_f_pointer(first, values, [2_c_int64_t, n/2])
  end function

  function cells_on_vertex(self, ierr) result(values)
    class(delos_mpi_grid), intent(in) :: self
    integer, intent(out), optional :: ierr
    integer(c_int32_t), pointer :: values(:, :)
    type(c_ptr) :: first
    integer(c_int64_t) :: n
    call get_array(self, c_cells_on_vertex, first, n, ierr)
    values => null()
    if (c_associated(first)) call c_f_pointer(first, values, [3_c_int64_t, n/3])
  end function

  function edges_on_vertex(self, ierr) result(values)
    class(delos_mpi_grid), intent(in) :: self
    integer, intent(out), optional :: ierr
    integer(c_int32_t), pointer :: values(:, :)
    type(c_ptr) :: first
    integer(c_int64_t) :: n
    call get_array(self, c_edges_on_vertex, first, n, ierr)
    values => null()
    if (c_associated(first)) call c_f_pointer(first, values, [3_c_int64_t, n/3])
  end function

  function weights_on_edge(self, ierr) result(values)
    class(delos_mpi_grid), intent(in) :: self
    integer, intent(out), optional :: ierr
    real(c_double), pointer :: values(:)
    type(c_ptr) :: first
    integer(c_int64_t) :: n
    call get_array(self, c_weights_on_edge, first, n, ierr)
    values => null()
    if (c_associated(first)) call c_f_pointer(first, values, [n])
  end function

  function cell_area_m2(self, ierr) result(values)
    class(delos_mpi_grid), intent(in) :: self
    integer, intent(out), optional :: ierr
    real(c_double), pointer :: values(:)
    type(c_ptr) :: first
    integer(c_int64_t) :: n
    call get_array(self, c_cell_area_m2, first, n, ierr)
    values => null()
    if (c_associated(first)) call c_f_pointer(first, values, [n])
  end function

  function cell_spacing_m(self, ierr) result(values)
    class(delos_mpi_grid), intent(in) :: self
    integer, intent(out), optional :: ierr
    real(c_double), pointer :: values(:)
    type(c_ptr) :: first
    integer(c_int64_t) :: n
    call get_array(self, c_cell_spacing_m, first, n, ierr)
    values => null()
    if (c_associated(first)) call c_f_pointer(first, values, [n])
  end function

  function edge_spacing_m(self, ierr) result(values)
    class(delos_mpi_grid), intent(in) :: self
    integer, intent(out), optional :: ierr
    real(c_double), pointer :: values(:)
    type(c_ptr) :: first
    integer(c_int64_t) :: n
    call get_array(self, c_edge_spacing_m, first, n, ierr)
    values => null()
    if (c_associated(first)) call c_f_pointer(first, values, [n])
  end function

  function triangle_area_m2(self, ierr) result(values)
    class(delos_mpi_grid), intent(in) :: self
    integer, intent(out), optional :: ierr
    real(c_double), pointer :: values(:)
    type(c_ptr) :: first
    integer(c_int64_t) :: n
    call get_array(self, c_triangle_area_m2, first, n, ierr)
    values => null()
    if (c_associated(first)) call c_f_pointer(first, values, [n])
  end function

  function cell_distance_m(self, ierr) result(values)
    class(delos_mpi_grid), intent(in) :: self
    integer, intent(out), optional :: ierr
    real(c_double), pointer :: values(:)
    type(c_ptr) :: first
    integer(c_int64_t) :: n
    call get_array(self, c_cell_distance_m, first, n, ierr)
    values => null()
    if (c_associated(first)) call c_f_pointer(first, values, [n])
  end function

  function vertex_distance_m(self, ierr) result(values)
    class(delos_mpi_grid), intent(in) :: self
    integer, intent(out), optional :: ierr
    real(c_double), pointer :: values(:)
    type(c_ptr) :: first
    integer(c_int64_t) :: n
    call get_array(self, c_vertex_distance_m, first, n, ierr)
    values => null()
    if (c_associated(first)) call c_f_pointer(first, values, [n])
  end function

  function edge_angle_rad(self, ierr) result(values)
    class(delos_mpi_grid), intent(in) :: self
    integer, intent(out), optional :: ierr
    real(c_double), pointer :: values(:)
    type(c_ptr) :: first
    integer(c_int64_t) :: n
    call get_array(self, c_edge_angle_rad, first, n, ierr)
    values => null()
    if (c_associated(first)) call c_f_pointer(first, values, [n])
  end function
end module delos_mpi
