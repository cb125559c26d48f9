#define SCALAR complex(dp)
!> Factors of complex band matrices.
module ehlwave_complex_band
   use ehlwave_kinds, only: dp
   implicit none (type, external)
   private
   public :: new_band

#include "band.inc"

end module ehlwave_complex_band
