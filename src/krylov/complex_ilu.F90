#define SCALAR(kind) complex(kind)
#define PARTS 2
#define SPLIT(z) [real(z, sp), real(aimag(z), sp)]
#define A_AT(f, m, s) cmplx(a(f, 1, m, s), a(f, 2, m, s), sp)
#define X_AT(f, s) cmplx(x(f, 1, s), x(f, 2, s), sp)
!> Incomplete factors of complex stencil matrices.
module ehlwave_complex_ilu
   use ehlwave_kinds, only: dp, sp
   implicit none (type, external)
   private
   public :: new_ilu

#include "ilu.inc"

end module ehlwave_complex_ilu
