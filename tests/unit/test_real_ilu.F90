#define SCALAR real(dp)
#define VALUE(re, im) re
!> Incomplete factors of real stencil matrices, and GMRES with them.
module real_ilu_checks
   use ehlwave_real_gmres, only: gmres_t, linear_system_t
   use ehlwave_real_ilu, only: ilu_t, new_ilu
   use ehlwave_kinds, only: dp, sp
   use sample_contact, only: noise
   use testing, only: test_t
   implicit none (type, external)
   private
   public :: check_all

#include "ilu_checks.inc"

end module real_ilu_checks

program test_real_ilu
   use real_ilu_checks, only: check_all
   use testing, only: test_t
   implicit none (type, external)
   type(test_t) :: test
   call check_all(test)
   call test%finish()
end program test_real_ilu
