#define SCALAR(kind) complex(kind)
#define SINGLE(z) cmplx(z, kind=sp)
#define PARTS 2
#define AT(a, f, k) cmplx(a(f, 1, k), a(f, 2, k), sp)
#define STORE(a, f, k, z) a(f, 1, k) = real(z); a(f, 2, k) = aimag(z)
!> Incomplete factors of complex stencil matrices.
module ehlwave_complex_ilu
   use ehlwave_kinds, only: dp, sp
   use ehlwave_threads, only: announce, await, is_shared, team_size, thread_count, thread_number
   implicit none (type, external)
   private
   public :: new_ilu

#include "ilu.inc"
#include "ilu_solve.inc"

end module ehlwave_complex_ilu
