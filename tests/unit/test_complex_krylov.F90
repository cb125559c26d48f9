#define SCALAR complex(dp)
#define VALUE(re, im) cmplx(re, im, dp)
!> Factors of complex band and stencil matrices, and GMRES with the latter.
module complex_krylov_checks
   use ehlwave_complex_band, only: band_t, new_band
   use ehlwave_complex_gmres, only: gmres_t, linear_system_t
   use ehlwave_complex_ilu, only: ilu_t, new_ilu
   use ehlwave_kinds, only: dp, sp
   use sample_contact, only: noise
   use testing, only: test_t
   implicit none (type, external)
   private
   public :: check_all

#include "krylov_checks.inc"

end module complex_krylov_checks

program test_complex_krylov
   use complex_krylov_checks, only: check_all
   use testing, only: test_t
   implicit none (type, external)
   type(test_t) :: test
   call check_all(test)
   call test%finish()
end program test_complex_krylov
