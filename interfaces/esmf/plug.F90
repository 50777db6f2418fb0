! SPDX-License-Identifier: BSD-3-Clause
! setservices_ and setvm_, by which NUOPC and ESMX load the cap from libdelos_nuopc.so at run time.
subroutine SetServices(gcomp, rc)
  use ESMF, only: ESMF_GridComp
  use delos_nuopc, only: cap => SetServices
  implicit none
  type(ESMF_GridComp) :: gcomp
  integer, intent(out) :: rc
  call cap(gcomp, rc)
end subroutine

subroutine SetVM(gcomp, rc)
  use ESMF, only: ESMF_GridComp
  use delos_nuopc, only: cap => SetVM
  implicit none
  type(ESMF_GridComp) :: gcomp
  integer, intent(out) :: rc
  call cap(gcomp, rc)
end subroutine
