#define SCALAR real(dp)
!> Factors of real band matrices.
module ehlwave_real_band
   use ehlwave_kinds, only: dp
   implicit none (type, external)
   private
   public :: new_band

#include "band.inc"

end module ehlwave_real_band
