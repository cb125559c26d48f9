!> Surfaces that move fast under heat.
module fast_surface
   use ehlwave_kinds, only: dp, pi
   use ehlwave_moving_source, only: source_weights
   implicit none (type, external)
   private
   public :: fast_limit

contains

   !> Weights of X^(-1/2): a source that moves fast.
   function fast_limit(n, h) result(w)
      integer, intent(in) :: n
      real(dp), intent(in) :: h
      real(dp), parameter :: peclet = 1e7_dp
      real(dp) :: all(-n:n, 0:0), w(0:n)
      all = sqrt(2*pi*peclet)*source_weights(n, 0, h, h, peclet, .true.)
      w = all(0:, 0)
   end function fast_limit

end module fast_surface
