#define SCALAR complex(dp)
!> Wedge and squeeze terms with complex weights.
module ehlwave_complex_wedge
   use ehlwave_kinds, only: dp
   implicit none (type, external)
   private
   public :: fold, new_wedge

#include "wedge.inc"

end module ehlwave_complex_wedge
