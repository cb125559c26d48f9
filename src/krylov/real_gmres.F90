#define SCALAR real(dp)
#define SHORT real(sp)
#define CONJUGATE(z) z
!> Flexible GMRES for real linear systems.
module ehlwave_real_gmres
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ehlwave_kinds, only: dp, sp
   use ehlwave_memory, only: many_nodes
   implicit none (type, external)
   private
   public :: dot, norm

#include "gmres.inc"

   !> Scalar product with eight partial sums, so that it is vectorised and the same on every run.
   pure real(dp) function dot_of_block(a, b) result(dot)
      real(dp), intent(in), contiguous :: a(:), b(:)
      real(dp) :: part(8)
      integer :: i, n
      part = 0
      n = size(a) - modulo(size(a), 8)
      do i = 1, n, 8
         part = part + a(i:i + 7)*b(i:i + 7)
      end do
      dot = sum(part)
      do i = n + 1, size(a)
         dot = dot + a(i)*b(i)
      end do
   end function dot_of_block

end module ehlwave_real_gmres
