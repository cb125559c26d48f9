#define SCALAR(kind) real(kind)
#define PARTS 1
#define SPLIT(z) [real(z, sp)]
#define A_AT(f, m, s) a(f, 1, m, s)
#define X_AT(f, s) x(f, 1, s)
!> Incomplete factors of real stencil matrices.
module ehlwave_real_ilu
   use ehlwave_kinds, only: dp, sp
   implicit none (type, external)
   private
   public :: new_ilu

#include "ilu.inc"

end module ehlwave_real_ilu
