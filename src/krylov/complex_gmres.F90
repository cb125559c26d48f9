#define SCALAR complex(dp)
#define SHORT complex(sp)
#define CONJUGATE(z) conjg(z)
!> Flexible GMRES for complex linear systems.
module ehlwave_complex_gmres
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ehlwave_kinds, only: dp, sp
   use ehlwave_memory, only: many_nodes
   implicit none (type, external)
   private
   public :: dot, norm

#include "gmres.inc"

   !> conj(a) b with four partial sums each of real and imaginary parts, so that it is vectorised and the same on every
   !> run.
   pure complex(dp) function dot_of_block(a, b) result(dot)
      complex(dp), intent(in), contiguous :: a(:), b(:)
      real(dp) :: re(4), im(4)
      integer :: i, n
      re = 0
      im = 0
      n = size(a) - modulo(size(a), 4)
      do i = 1, n, 4
         re = re + real(a(i:i + 3))*real(b(i:i + 3)) + aimag(a(i:i + 3))*aimag(b(i:i + 3))
         im = im + real(a(i:i + 3))*aimag(b(i:i + 3)) - aimag(a(i:i + 3))*real(b(i:i + 3))
      end do
      dot = cmplx(sum(re), sum(im), dp)
      do i = n + 1, size(a)
         dot = dot + conjg(a(i))*b(i)
      end do
   end function dot_of_block

end module ehlwave_complex_gmres
