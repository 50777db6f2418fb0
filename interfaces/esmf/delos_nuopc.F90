! SPDX-License-Identifier: BSD-3-Clause
! The NUOPC cap: a model whose mesh is the grid. All that can be done without ESMF is done in cap.cpp.
!
! Attributes of the component: `delos_config`, the configuration's file ("delos.yaml"); with any
! `Verbosity`, sums and bounds of this process's values go to ESMF's log.
module delos_nuopc
  use, intrinsic :: iso_c_binding
  use ESMF
  use NUOPC
  use NUOPC_Model, modelSS => SetServices
  implicit none
  private
  public :: SetServices, SetVM

  integer(c_int), parameter :: imports = 0, exports = 1
  integer, parameter :: name_length = 128, path_length = 4096, text_length = 4096

  ! One component's own.
  type :: cap_state
    type(c_ptr) :: cap = c_null_ptr
    integer :: verbosity = 0
  end type

  type :: cap_wrap
    type(cap_state), pointer :: it => null()
  end type

  ! As in cap.h.
  type, bind(c) :: cap_item
    type(c_ptr) :: name, units
  end type

  type, bind(c) :: cap_mesh
    integer(c_int32_t) :: n_nodes, n_elements, n_corners
    type(c_ptr) :: node_ids, node_owners, node_lon_lat_deg
    type(c_ptr) :: element_ids, element_corners, element_nodes, element_area, element_lon_lat_deg
  end type

  type, bind(c) :: cap_time
    integer(c_int64_t) :: year, month, day, hour, minute, second, numerator, denominator
  end type

  interface
    integer(c_int) function cap_create(config_file, cap) bind(c, name="delos_cap_create")
      import
      character(kind=c_char), intent(in) :: config_file(*)
      type(c_ptr), intent(out) :: cap
    end function
    subroutine cap_destroy(cap) bind(c, name="delos_cap_destroy")
      import
      type(c_ptr), value :: cap
    end subroutine
    type(c_ptr) function cap_message(cap) bind(c, name="delos_cap_message")
      import
      type(c_ptr), value :: cap
    end function
    integer(c_int) function cap_advertise(cap) bind(c, name="delos_cap_advertise")
      import
      type(c_ptr), value :: cap
    end function
    integer(c_int) function cap_get_item(cap, intent, index, item) bind(c, name="delos_cap_get_item")
      import
      type(c_ptr), value :: cap
      integer(c_int), value :: intent, index
      type(cap_item), intent(out) :: item
    end function
    integer(c_int) function cap_realize(cap, communicator, n_processes) bind(c, name="delos_cap_realize")
      import
      type(c_ptr), value :: cap
      integer(c_int), value :: communicator, n_processes
    end function
    integer(c_int) function cap_get_mesh(cap, mesh) bind(c, name="delos_cap_get_mesh")
      import
      type(c_ptr), value :: cap
      type(cap_mesh), intent(out) :: mesh
    end function
    integer(c_int) function cap_get_export(cap, name, values, n) bind(c, name="delos_cap_get_export")
      import
      type(c_ptr), value :: cap
      character(kind=c_char), intent(in) :: name(*)
      real(c_double), intent(out) :: values(*)
      integer(c_int64_t), value :: n
    end function
    integer(c_int) function cap_set_import(cap, name, values, n) bind(c, name="delos_cap_set_import")
      import
      type(c_ptr), value :: cap
      character(kind=c_char), intent(in) :: name(*)
      real(c_double), intent(in) :: values(*)
      integer(c_int64_t), value :: n
    end function
    integer(c_int) function cap_advance(cap, from, until, calendar) bind(c, name="delos_cap_advance")
      import
      type(c_ptr), value :: cap
      type(cap_time), intent(in) :: from, until
      integer(c_int), value :: calendar
    end function
    integer(c_int) function cap_finalize(cap) bind(c, name="delos_cap_finalize")
      import
      type(c_ptr), value :: cap
    end function
  end interface

contains

  subroutine SetServices(gcomp, rc)
    type(ESMF_GridComp) :: gcomp
    integer, intent(out) :: rc
    type(cap_wrap) :: wrap
    call NUOPC_CompDerive(gcomp, modelSS, rc=rc)
    if (failed(rc, __LINE__)) return
    call NUOPC_CompSpecialize(gcomp, specLabel=label_Advertise, specRoutine=advertise, rc=rc)
    if (failed(rc, __LINE__)) return
    call NUOPC_CompSpecialize(gcomp, specLabel=label_RealizeProvided, specRoutine=realize, rc=rc)
    if (failed(rc, __LINE__)) return
    call NUOPC_CompSpecialize(gcomp, specLabel=label_DataInitialize, specRoutine=data_initialize, rc=rc)
    if (failed(rc, __LINE__)) return
    call NUOPC_CompSpecialize(gcomp, specLabel=label_Advance, specRoutine=advance, rc=rc)
    if (failed(rc, __LINE__)) return
    call NUOPC_CompSpecialize(gcomp, specLabel=label_Finalize, specRoutine=finalize, rc=rc)
    if (failed(rc, __LINE__)) return
    allocate(wrap%it)
    call ESMF_GridCompSetInternalState(gcomp, wrap, rc)
    if (failed(rc, __LINE__)) return
  end subroutine

  ! --- phases

  subroutine advertise(gcomp, rc)
    type(ESMF_GridComp) :: gcomp
    integer, intent(out) :: rc
    type(cap_state), pointer :: it
    type(ESMF_State) :: states(0:1)
    character(len=path_length) :: config_file
    character(len=name_length) :: name, units
    logical :: is_set
    integer :: intent, i
    call own_state(gcomp, it, rc)
    if (failed(rc, __LINE__)) return
    call NUOPC_CompGet(gcomp, verbosity=it%verbosity, rc=rc)
    if (failed(rc, __LINE__)) return
    call NUOPC_CompAttributeGet(gcomp, name="delos_config", value=config_file, isSet=is_set, rc=rc)
    if (failed(rc, __LINE__)) return
    if (.not. is_set) config_file = "delos.yaml"
    if (refused(it, cap_create(trim(config_file) // c_null_char, it%cap), __LINE__, rc)) return
    if (refused(it, cap_advertise(it%cap), __LINE__, rc)) return
    call NUOPC_ModelGet(gcomp, importState=states(imports), exportState=states(exports), rc=rc)
    if (failed(rc, __LINE__)) return
    do intent = imports, exports
      i = 0
      do while (has_item(it, intent, i, name, units))
        call know_name(name, units, rc)
        if (failed(rc, __LINE__)) return
        call NUOPC_Advertise(states(intent), StandardName=trim(name), Units=trim(units), &
          name=trim(name), TransferOfferGeomObject="will provide", rc=rc)
        if (failed(rc, __LINE__)) return
        i = i + 1
      end do
    end do
  end subroutine

  ! The grid, the mesh, and a field for each item that somebody is connected to.
  subroutine realize(gcomp, rc)
    type(ESMF_GridComp) :: gcomp
    integer, intent(out) :: rc
    type(cap_state), pointer :: it
    type(ESMF_State) :: states(0:1)
    type(ESMF_VM) :: vm
    type(ESMF_Mesh) :: mesh
    type(ESMF_Field) :: field
    character(len=name_length) :: name, units
    integer :: intent, i, communicator, n_processes
    call own_state(gcomp, it, rc)
    if (failed(rc, __LINE__)) return
    call ESMF_GridCompGet(gcomp, vm=vm, rc=rc)
    if (failed(rc, __LINE__)) return
    call ESMF_VMGet(vm, petCount=n_processes, mpiCommunicator=communicator, rc=rc)
    if (failed(rc, __LINE__)) return
    if (refused(it, cap_realize(it%cap, communicator, n_processes), __LINE__, rc)) return
    call make_mesh(it, mesh, rc)
    if (failed(rc, __LINE__)) return
    call NUOPC_ModelGet(gcomp, importState=states(imports), exportState=states(exports), rc=rc)
    if (failed(rc, __LINE__)) return
    do intent = imports, exports
      i = 0
      do while (has_item(it, intent, i, name, units))
        if (NUOPC_IsConnected(states(intent), fieldName=trim(name), rc=rc)) then
          field = ESMF_FieldCreate(mesh, ESMF_TYPEKIND_R8, meshloc=ESMF_MESHLOC_ELEMENT, &
            name=trim(name), rc=rc)
          if (failed(rc, __LINE__)) return
          call NUOPC_Realize(states(intent), field=field, rc=rc)
        else
          call ESMF_StateRemove(states(intent), [trim(name)], rc=rc)
        end if
        if (failed(rc, __LINE__)) return
        i = i + 1
      end do
    end do
  end subroutine

  subroutine data_initialize(gcomp, rc)
    type(ESMF_GridComp) :: gcomp
    integer, intent(out) :: rc
    type(ESMF_State) :: state
    type(cap_state), pointer :: it
    call own_state(gcomp, it, rc)
    if (failed(rc, __LINE__)) return
    call NUOPC_ModelGet(gcomp, exportState=state, rc=rc)
    if (failed(rc, __LINE__)) return
    call give_exports(it, state, rc)
    if (failed(rc, __LINE__)) return
    call NUOPC_CompAttributeSet(gcomp, name="InitializeDataComplete", value="true", rc=rc)
    if (failed(rc, __LINE__)) return
  end subroutine

  subroutine advance(gcomp, rc)
    type(ESMF_GridComp) :: gcomp
    integer, intent(out) :: rc
    type(cap_state), pointer :: it
    type(ESMF_State) :: states(0:1)
    type(ESMF_Clock) :: clock
    type(ESMF_Time) :: now
    type(ESMF_TimeInterval) :: step
    type(cap_time) :: from, until
    integer(c_int) :: calendar
    call own_state(gcomp, it, rc)
    if (failed(rc, __LINE__)) return
    call NUOPC_ModelGet(gcomp, modelClock=clock, importState=states(imports), &
      exportState=states(exports), rc=rc)
    if (failed(rc, __LINE__)) return
    call take_imports(it, states(imports), rc)
    if (failed(rc, __LINE__)) return
    call ESMF_ClockGet(clock, currTime=now, timeStep=step, rc=rc)
    if (failed(rc, __LINE__)) return
    call take_apart(now, from, calendar, rc)
    if (failed(rc, __LINE__)) return
    call take_apart(now + step, until, calendar, rc)
    if (failed(rc, __LINE__)) return
    if (refused(it, cap_advance(it%cap, from, until, calendar), __LINE__, rc)) return
    call give_exports(it, states(exports), rc)
    if (failed(rc, __LINE__)) return
  end subroutine

  subroutine finalize(gcomp, rc)
    type(ESMF_GridComp) :: gcomp
    integer, intent(out) :: rc
    type(cap_wrap) :: wrap
    call ESMF_GridCompGetInternalState(gcomp, wrap, rc)
    if (failed(rc, __LINE__)) return
    if (.not. associated(wrap%it)) return
    if (refused(wrap%it, cap_finalize(wrap%it%cap), __LINE__, rc)) return
    call cap_destroy(wrap%it%cap)
    deallocate(wrap%it)
    call ESMF_GridCompSetInternalState(gcomp, wrap, rc)
    if (failed(rc, __LINE__)) return
  end subroutine

  ! --- what the phases are made of

  subroutine make_mesh(it, mesh, rc)
    type(cap_state), intent(in) :: it
    type(ESMF_Mesh), intent(out) :: mesh
    integer, intent(out) :: rc
    type(cap_mesh) :: part
    integer(c_int32_t), pointer :: node_ids(:), owners(:), ids(:), corners(:), nodes(:)
    real(c_double), pointer :: node_places(:), areas(:), places(:)
    if (refused(it, cap_get_mesh(it%cap, part), __LINE__, rc)) return
    call c_f_pointer(part%node_ids, node_ids, [part%n_nodes])
    call c_f_pointer(part%node_owners, owners, [part%n_nodes])
    call c_f_pointer(part%node_lon_lat_deg, node_places, [2 * part%n_nodes])
    call c_f_pointer(part%element_ids, ids, [part%n_elements])
    call c_f_pointer(part%element_corners, corners, [part%n_elements])
    call c_f_pointer(part%element_nodes, nodes, [part%n_corners])
    call c_f_pointer(part%element_area, areas, [part%n_elements])
    call c_f_pointer(part%element_lon_lat_deg, places, [2 * part%n_elements])
    mesh = ESMF_MeshCreate(parametricDim=2, spatialDim=2, coordSys=ESMF_COORDSYS_SPH_DEG, &
      nodeIds=node_ids, nodeCoords=node_places, nodeOwners=owners, elementIds=ids, &
      elementTypes=corners, elementConn=nodes, elementArea=areas, elementCoords=places, rc=rc)
    if (failed(rc, __LINE__)) return
  end subroutine

  subroutine give_exports(it, state, rc)
    type(cap_state), intent(in) :: it
    type(ESMF_State), intent(inout) :: state
    integer, intent(out) :: rc
    type(ESMF_Field) :: field
    character(len=name_length) :: name, units
    real(ESMF_KIND_R8), pointer :: values(:)
    logical :: is_there
    integer :: i
    i = 0
    rc = ESMF_SUCCESS
    do while (has_item(it, exports, i, name, units))
      i = i + 1
      call find_field(state, name, field, is_there, values, rc)
      if (failed(rc, __LINE__)) return
      if (.not. is_there) cycle
      if (refused(it, cap_get_export(it%cap, trim(name) // c_null_char, values, &
        int(size(values), c_int64_t)), __LINE__, rc)) return
      call NUOPC_SetAttribute(field, name="Updated", value="true", rc=rc)
      if (failed(rc, __LINE__)) return
      call report(it, "export " // trim(name), values, units, rc)
      if (failed(rc, __LINE__)) return
    end do
  end subroutine

  subroutine take_imports(it, state, rc)
    type(cap_state), intent(in) :: it
    type(ESMF_State), intent(inout) :: state
    integer, intent(out) :: rc
    type(ESMF_Field) :: field
    character(len=name_length) :: name, units
    real(ESMF_KIND_R8), pointer :: values(:)
    logical :: is_there
    integer :: i
    i = 0
    rc = ESMF_SUCCESS
    do while (has_item(it, imports, i, name, units))
      i = i + 1
      call find_field(state, name, field, is_there, values, rc)
      if (failed(rc, __LINE__)) return
      if (.not. is_there) cycle
      call report(it, "import " // trim(name), values, units, rc)
      if (failed(rc, __LINE__)) return
      if (refused(it, cap_set_import(it%cap, trim(name) // c_null_char, values, &
        int(size(values), c_int64_t)), __LINE__, rc)) return
    end do
  end subroutine

  subroutine report(it, what, values, units, rc)
    type(cap_state), intent(in) :: it
    character(len=*), intent(in) :: what, units
    real(ESMF_KIND_R8), intent(in) :: values(:)
    integer, intent(out) :: rc
    character(len=text_length) :: line
    rc = ESMF_SUCCESS
    if (it%verbosity == 0) return
    write (line, "(3a, i0, 3(a, es23.16), 2a)") "delos: ", what, ": ", size(values), &
      " elements, sum ", sum(values), ", least ", minval(values), ", largest ", maxval(values), &
      " ", trim(units)
    call ESMF_LogWrite(trim(line), ESMF_LOGMSG_INFO, rc=rc)
    if (failed(rc, __LINE__)) return
  end subroutine

  ! Not there: nobody was connected to it.
  subroutine find_field(state, name, field, is_there, values, rc)
    type(ESMF_State), intent(in) :: state
    character(len=*), intent(in) :: name
    type(ESMF_Field), intent(out) :: field
    logical, intent(out) :: is_there
    real(ESMF_KIND_R8), pointer, intent(out) :: values(:)
    integer, intent(out) :: rc
    type(ESMF_StateItem_Flag) :: kind
    call ESMF_StateGet(state, itemName=trim(name), itemType=kind, rc=rc)
    if (failed(rc, __LINE__)) return
    is_there = kind == ESMF_STATEITEM_FIELD
    if (.not. is_there) return
    call ESMF_StateGet(state, itemName=trim(name), field=field, rc=rc)
    if (failed(rc, __LINE__)) return
    call ESMF_FieldGet(field, farrayPtr=values, rc=rc)
    if (failed(rc, __LINE__)) return
  end subroutine

  ! A name that the field dictionary does not have yet; delos_fields.yaml has them all.
  subroutine know_name(name, units, rc)
    character(len=*), intent(in) :: name, units
    integer, intent(out) :: rc
    logical :: is_known
    is_known = NUOPC_FieldDictionaryHasEntry(trim(name), rc=rc)
    if (failed(rc, __LINE__)) return
    if (is_known) return
    call NUOPC_FieldDictionaryAddEntry(trim(name), trim(units), rc=rc)
    if (failed(rc, __LINE__)) return
  end subroutine

  subroutine take_apart(time, parts, calendar, rc)
    type(ESMF_Time), intent(in) :: time
    type(cap_time), intent(out) :: parts
    integer(c_int), intent(out) :: calendar
    integer, intent(out) :: rc
    type(ESMF_CalKind_Flag) :: kind
    integer(ESMF_KIND_I8) :: year, second, numerator, denominator
    integer :: month, day, hour, minute
    calendar = -1
    call ESMF_TimeGet(time, yy_i8=year, mm=month, dd=day, h=hour, m=minute, s_i8=second, &
      sN_i8=numerator, sD_i8=denominator, calkindflag=kind, rc=rc)
    if (failed(rc, __LINE__)) return
    parts = cap_time(year, month, day, hour, minute, second, numerator, denominator)
    if (kind == ESMF_CALKIND_GREGORIAN) calendar = 0
    if (kind == ESMF_CALKIND_JULIAN) calendar = 1
    if (kind == ESMF_CALKIND_NOLEAP) calendar = 2
    if (kind == ESMF_CALKIND_360DAY) calendar = 3
    if (calendar < 0) call ESMF_LogSetError(ESMF_RC_ARG_VALUE, msg="delos: the clock's calendar " // &
      "must be gregorian, julian, noleap or 360_day", line=__LINE__, file=__FILE__, rcToReturn=rc)
  end subroutine

  ! The i-th item of a state, from 0.
  function has_item(it, intent, i, name, units)
    type(cap_state), intent(in) :: it
    integer, intent(in) :: intent, i
    character(len=*), intent(out) :: name, units
    logical :: has_item
    type(cap_item) :: item
    has_item = cap_get_item(it%cap, intent, i, item) == 0
    if (.not. has_item) return
    name = text_of(item%name)
    units = text_of(item%units)
  end function

  subroutine own_state(gcomp, it, rc)
    type(ESMF_GridComp) :: gcomp
    type(cap_state), pointer, intent(out) :: it
    integer, intent(out) :: rc
    type(cap_wrap) :: wrap
    it => null()
    call ESMF_GridCompGetInternalState(gcomp, wrap, rc)
    if (failed(rc, __LINE__)) return
    it => wrap%it
  end subroutine

  ! Whether ESMF failed; notes the place in its log.
  function failed(rc, line)
    integer, intent(in) :: rc, line
    logical :: failed
    failed = ESMF_LogFoundError(rcToCheck=rc, msg=ESMF_LOGERR_PASSTHRU, line=line, file=__FILE__)
  end function

  ! Whether delos failed; its text goes to ESMF's log, its code to rc.
  function refused(it, status, line, rc)
    type(cap_state), intent(in) :: it
    integer(c_int), intent(in) :: status
    integer, intent(in) :: line
    integer, intent(out) :: rc
    logical :: refused
    rc = ESMF_SUCCESS
    refused = status /= 0
    if (refused) call ESMF_LogSetError(status, msg="delos: " // text_of(cap_message(it%cap)), &
      line=line, file=__FILE__, rcToReturn=rc)
  end function

  function text_of(address)
    type(c_ptr), intent(in) :: address
    character(len=:), allocatable :: text_of
    character(kind=c_char), pointer :: letters(:)
    integer :: n, i
    call c_f_pointer(address, letters, [text_length])
    n = 0
    do while (n < text_length)
      if (letters(n + 1) == c_null_char) exit
      n = n + 1
    end do
    allocate(character(len=n) :: text_of)
    do i = 1, n
      text_of(i:i) = letters(i)
    end do
  end function
end module
