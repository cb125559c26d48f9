#define SCALAR real(dp)
!> Wedge and squeeze terms with real weights.
module ehlwave_real_wedge
   use ehlwave_kinds, only: dp
   implicit none (type, external)
   private
   public :: fold, new_wedge

#include "wedge.inc"

end module ehlwave_real_wedge
