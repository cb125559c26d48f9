!> Ree-Eyring oil: shear rate = (tau0/eta) sinh(tau/tau0).
module ehlwave_eyring_law
   use ehlwave_flow_law, only: flow_law_t
   use ehlwave_kinds, only: dp
   implicit none (type, external)
   private

   !> s = sinh(|sigma|)/|sigma|, theory eq. (S9); Ree and Eyring, Journal of Applied Physics 26, 1955, 793-800.
   type, extends(flow_law_t), public :: eyring_law_t
      private
      real(dp) :: largest_stress = 300   !! |sigma| beyond which s is continued: exp(300)^2 is finite
   contains
      procedure :: shear_factor
      procedure :: first_stress
      procedure :: largest_variation
   end type eyring_law_t

   real(dp), parameter :: c(0:6) = 1/[1.0_dp, 6.0_dp, 120.0_dp, 5040.0_dp, 362880.0_dp, 39916800.0_dp, 6227020800.0_dp]
                                   ! sinh(r)/r = sum c_n r^(2n)
   ! r^2 where the closed form takes over: rounding is 2e-15 of the slope there
   real(dp), parameter :: joint = 0.25_dp
   real(dp), parameter :: short_reach = 1e-3_dp   ! r^2 up to which four terms of the series are enough
   real(dp), parameter :: s_at_joint = 2*sinh(0.5_dp), slope_at_joint = 2*(cosh(0.5_dp) - s_at_joint)

contains

   !> Power series up to |sigma|^2 = 1/4, and the remainder of the closed form beyond. The loop has no branches, so
   !> that exp is vectorised. Most blocks need only one of the two.
   pure subroutine shear_factor(self, n, stress2, s, slope)
      class(eyring_law_t), intent(in) :: self
      integer, intent(in) :: n
      real(dp), intent(in) :: stress2(n)
      real(dp), intent(out) :: s(n), slope(n)
      real(dp) :: grown, inverse, largest2, r, s_beyond, x
      integer :: i

      if (all(stress2 <= short_reach)) then
         do i = 1, n
            x = stress2(i)
            s(i) = c(0) + x*(c(1) + x*(c(2) + x*c(3)))
            slope(i) = c(1) + x*(2*c(2) + x*(3*c(3) + x*4*c(4)))
         end do
         return
      end if
      s = s_at_joint
      slope = slope_at_joint
      if (any(stress2 < joint)) then
         do i = 1, n
            x = min(stress2(i), joint)
            s(i) = c(0) + x*(c(1) + x*(c(2) + x*(c(3) + x*(c(4) + x*(c(5) + x*c(6))))))
            slope(i) = c(1) + x*(2*c(2) + x*(3*c(3) + x*(4*c(4) + x*(5*c(5) + x*6*c(6)))))
         end do
      end if
      if (all(stress2 <= joint)) return
      largest2 = self%largest_stress**2
      do i = 1, n
         x = min(max(stress2(i), joint), largest2)
         r = sqrt(x)
         grown = exp(r)
         inverse = 1/(grown*x)
         s_beyond = 0.5_dp*(grown - inverse*x)*(inverse*grown)*r
         slope(i) = slope(i) + (0.25_dp*(grown + inverse*x - 2*s_beyond)*(inverse*grown) - slope_at_joint)
         s(i) = s(i) + (s_beyond - s_at_joint) + slope(i)*max(stress2(i) - largest2, 0.0_dp)
      end do
   end subroutine shear_factor

   !> asinh, written so that it is vectorised.
   pure subroutine first_stress(self, n, rate, stress)
      class(eyring_law_t), intent(in) :: self
      integer, intent(in) :: n
      real(dp), intent(in) :: rate(n)
      real(dp), intent(out) :: stress(n)
      integer :: i
      do i = 1, n
         stress(i) = min(log(rate(i) + sqrt(1 + rate(i)**2)), self%largest_stress)
      end do
   end subroutine first_stress

   !> The flow is exact to 1e-11 or better, with sigma_m up to 14; beyond 16 points they go about as the square.
   elemental real(dp) function largest_variation(self, points)
      class(eyring_law_t), intent(in) :: self
      integer, intent(in) :: points
      select case (points)
      case (:3)
         largest_variation = 1e-5_dp
      case (4:5)
         largest_variation = 0.12_dp
      case (6:7)
         largest_variation = 0.85_dp
      case (8:11)
         largest_variation = 2.4_dp
      case (12:15)
         largest_variation = 7
      case default
         largest_variation = (points/4.5_dp)**2
         if (largest_variation > self%largest_stress) largest_variation = huge(largest_variation)
      end select
   end function largest_variation

end module ehlwave_eyring_law
