!> A law of flow that the program does not know.
module added_law
   use ehlwave_flow_law, only: flow_law_t
   use ehlwave_kinds, only: dp
   implicit none (type, external)
   private

   !> Rabinowitsch: shear rate = (tau0/eta) (1 + |sigma|^2) sigma, a power law of the exponent 1/3 under large stresses.
   type, extends(flow_law_t), public :: cubic_law_t
   contains
      procedure :: shear_factor
      procedure :: first_stress
      procedure :: largest_variation
   end type cubic_law_t

contains

   pure subroutine shear_factor(self, n, stress2, s, slope)
      class(cubic_law_t), intent(in) :: self
      integer, intent(in) :: n
      real(dp), intent(in) :: stress2(n)
      real(dp), intent(out) :: s(n), slope(n)
      s = 1 + stress2
      slope = 1
   end subroutine shear_factor

   pure subroutine first_stress(self, n, rate, stress)
      class(cubic_law_t), intent(in) :: self
      integer, intent(in) :: n
      real(dp), intent(in) :: rate(n)
      real(dp), intent(out) :: stress(n)
      stress = min(rate, rate**(1/3.0_dp))
      if (self%is_newtonian) stress = rate
   end subroutine first_stress

   elemental real(dp) function largest_variation(self, points)
      class(cubic_law_t), intent(in) :: self
      integer, intent(in) :: points
      largest_variation = merge(huge(1.0_dp), 0.0_dp, points > 2 .or. self%is_newtonian)
   end function largest_variation

end module added_law
