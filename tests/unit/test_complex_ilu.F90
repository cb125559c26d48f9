#define SCALAR complex(dp)
#define VALUE(re, im) cmplx(re, im, dp)
!> Incomplete factors of complex stencil matrices, and GMRES with them.
module complex_ilu_checks
   use ehlwave_complex_gmres, only: gmres_t, linear_system_t
   use ehlwave_complex_ilu, only: ilu_t, new_ilu
   use ehlwave_kinds, only: dp, sp
   use sample_contact, only: noise
   use testing, only: test_t
   implicit none (type, external)
   private
   public :: check_all

#include "ilu_checks.inc"

end module complex_ilu_checks

program test_complex_ilu
   use complex_ilu_checks, only: check_all
   use testing, only: test_t
   implicit none (type, external)
   type(test_t) :: test
   call check_all(test)
   call test%finish()
end program test_complex_ilu
