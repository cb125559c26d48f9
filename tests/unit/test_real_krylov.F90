#define SCALAR real(dp)
#define VALUE(re, im) re
!> Factors of real band and stencil matrices, and GMRES with the latter.
module real_krylov_checks
   use ehlwave_real_band, only: band_t, new_band
   use ehlwave_real_gmres, only: gmres_t, linear_system_t
   use ehlwave_real_ilu, only: ilu_t, new_ilu
   use ehlwave_kinds, only: dp, sp
   use sample_contact, only: noise
   use testing, only: test_t
   implicit none (type, external)
   private
   public :: check_all

#include "krylov_checks.inc"

end module real_krylov_checks

program test_real_krylov
   use real_krylov_checks, only: check_all
   use testing, only: test_t
   implicit none (type, external)
   type(test_t) :: test
   call check_all(test)
   call test%finish()
end program test_real_krylov
