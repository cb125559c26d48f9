!> Interpolation by polynomials between equidistant samples.
module ehlwave_lagrange
   use ehlwave_kinds, only: dp
   implicit none (type, external)
   private
   public :: lagrange_weights

contains

   !> Weights of the samples 0, 1, ..., points - 1 at place t, counted in their distances: exact for polynomials of
   !> degree points - 1.
   pure function lagrange_weights(points, t) result(weights)
      integer, intent(in) :: points
      real(dp), intent(in) :: t
      real(dp) :: weights(0:points - 1)
      integer :: j, m
      do m = 0, points - 1
         weights(m) = product([((t - j)/(m - j), j=0, m - 1)])*product([((t - j)/(m - j), j=m + 1, points - 1)])
      end do
   end function lagrange_weights

end module ehlwave_lagrange
