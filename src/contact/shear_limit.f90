!> The largest shear stress that an oil bears, in proportion to the pressure.
!>
!> Below it the shear rate of the flow law is multiplied by
!>
!>     w = 1/(1 - x^m),   x = |sigma|^2/sigma_L^2,
!>
!> theory eq. (S15): the rate grows without bound as the stress nears sigma_L, so that a given rate of sliding never
!> needs more than it. m follows from the width: at (1 - width) of the limit the rate is twice the rate of the flow
!> law.
!>
!>     sigma_L^2 = (limit P)^2 + (limit floor)^2 + (2 |Sigma|)^2
!>
!> with the stress Sigma of the pressure gradient and a small floor: at the edges of the film the gradient needs a
!> stress where there is hardly any pressure. Where |Sigma| is below half of the limit, the mean stress stays below
!> limit P.
module ehlwave_shear_limit
   use ehlwave_kinds, only: dp
   implicit none (type, external)
   private
   public :: new_shear_limit

   type, public :: shear_limit_t
      real(dp) :: over_pressure = 0           !! sigma_L/P
      real(dp) :: power = 1                   !! m
      real(dp) :: largest = 0                 !! x beyond which w is continued linearly
   contains
      procedure :: inverse_square
      procedure :: factor
   end type shear_limit_t

   real(dp), parameter, public :: limit_floor = 0.02_dp   !! share of P that is the smallest limit
   real(dp), parameter :: gradient_share = 4              ! share of |Sigma|^2
   real(dp), parameter :: largest_factor = 1e7_dp         ! w there

contains

   pure function new_shear_limit(over_pressure, width) result(self)
      real(dp), intent(in) :: over_pressure   !! limit of the stress over tau0, for P = 1
      real(dp), intent(in) :: width           !! above 0 and below 1
      type(shear_limit_t) :: self
      self%over_pressure = over_pressure
      self%power = 0.5_dp*log(0.5_dp)/log(1 - width)
      self%largest = (1 - 1/largest_factor)**(1/self%power)
   end function new_shear_limit

   !> 1/sigma_L^2 and its derivatives by P and by |Sigma|^2.
   elemental subroutine inverse_square(self, p, sigma2, inverse, by_p, by_sigma2)
      class(shear_limit_t), intent(in) :: self
      real(dp), intent(in) :: p               !! P
      real(dp), intent(in) :: sigma2          !! |Sigma|^2
      real(dp), intent(out) :: inverse, by_p, by_sigma2
      real(dp) :: bearing
      bearing = max(p, 0.0_dp)
      inverse = 1/(self%over_pressure**2*(bearing**2 + limit_floor**2) + gradient_share*sigma2)
      by_p = -2*bearing*self%over_pressure**2*inverse**2
      by_sigma2 = -gradient_share*inverse**2
   end subroutine inverse_square

   !> w and its derivative by x.
   elemental subroutine factor(self, x, w, slope)
      class(shear_limit_t), intent(in) :: self
      real(dp), intent(in) :: x               !! |sigma|^2/sigma_L^2
      real(dp), intent(out) :: w, slope
      real(dp) :: power, within
      within = max(min(x, self%largest), tiny(x))
      power = exp(self%power*log(within))
      w = 1/(1 - power)
      slope = self%power*power/within*w**2
      w = w + slope*(max(x, within) - within)
   end subroutine factor

end module ehlwave_shear_limit
