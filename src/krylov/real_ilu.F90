#define SCALAR(kind) real(kind)
#define SINGLE(z) real(z, sp)
#define PARTS 1
#define AT(a, f, k) a(f, 1, k)
#define STORE(a, f, k, z) a(f, 1, k) = z
!> Incomplete factors of real stencil matrices.
module ehlwave_real_ilu
   use ehlwave_kinds, only: dp, sp
   use ehlwave_threads, only: announce, await, is_shared, team_size, thread_count, thread_number
   implicit none (type, external)
   private
   public :: new_ilu

#include "ilu.inc"
#include "ilu_solve.inc"

end module ehlwave_real_ilu
