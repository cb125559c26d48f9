!> Carreau oil, with the shear stress as the argument.
module ehlwave_carreau_law
   use ehlwave_flow_law, only: flow_law_t
   use ehlwave_kinds, only: dp
   implicit none (type, external)
   private
   public :: new_carreau_law

   !> s = (1 + |sigma|^2)^((1/n - 1)/2), sigma = tau/G: Bair, High Pressure Rheology for Quantitative
   !> Elastohydrodynamics, 2nd ed., 2019, chapter 6; theory eq. (S10). n = 1 is Newton's law.
   type, extends(flow_law_t), public :: carreau_law_t
      private
      real(dp) :: power = 0   !! (1/n - 1)/2
   contains
      procedure :: shear_factor
      procedure :: first_stress
      procedure :: largest_variation
   end type carreau_law_t

   real(dp), parameter :: largest_exponent = 300      ! exp(300)^2 is finite

contains

   pure function new_carreau_law(exponent) result(self)
      real(dp), intent(in) :: exponent   !! n, above 0 and at most 1
      type(carreau_law_t) :: self
      self%power = 0.5_dp*(1/exponent - 1)
      self%is_power = .true.
      self%is_newtonian = .not. self%power > 0
   end function new_carreau_law

   pure subroutine shear_factor(self, n, stress2, s, slope)
      class(carreau_law_t), intent(in) :: self
      integer, intent(in) :: n
      real(dp), intent(in) :: stress2(n)
      real(dp), intent(out) :: s(n), slope(n)
      real(dp) :: excess, largest, x
      integer :: i

      if (self%is_newtonian) then
         s = 1
         slope = 0
         return
      end if
      largest = exp(largest_exponent/max(self%power, 1.0_dp))
      do i = 1, n
         x = 1 + min(stress2(i), largest)
         excess = 1 + stress2(i) - x
         s(i) = exp(self%power*log(x))
         slope(i) = self%power*s(i)/x
         s(i) = s(i) + slope(i)*excess
      end do
   end subroutine shear_factor

   !> Newton for the logarithms, from the smaller of the two asymptotes; the error is below 1e-3.
   pure subroutine first_stress(self, n, rate, stress)
      class(carreau_law_t), intent(in) :: self
      integer, intent(in) :: n
      real(dp), intent(in) :: rate(n)
      real(dp), intent(out) :: stress(n)
      real(dp) :: r, x
      integer :: i, step

      if (self%is_newtonian) then
         stress = rate
         return
      end if
      do i = 1, n
         r = log(rate(i))
         x = min(r, r/(2*self%power + 1))
         do step = 1, 4
            x = x + (r - x - self%power*log(1 + exp(2*x)))/(1 + 2*self%power/(1 + exp(-2*x)))
         end do
         stress(i) = exp(x)
      end do
   end subroutine first_stress

   !> Measured for n = 0.5 to 0.8: 6, 8, 16, 32, 64 and 128 points up to |Sigma| = 0.14, 0.32, 1.06, 2.4, 5.1 and 10.6.
   !> s branches at sigma = +-i, that is at a distance 1/|Sigma| from the film, hence the straight line.
   elemental real(dp) function largest_variation(self, points)
      class(carreau_law_t), intent(in) :: self
      integer, intent(in) :: points
      largest_variation = (points - 5)/12.5_dp
      if (points == 4) largest_variation = 0.02_dp
      if (points < 4) largest_variation = 1e-6_dp
      if (.not. self%power > 0) largest_variation = huge(self%power)
   end function largest_variation

end module ehlwave_carreau_law
