!> McEwen's viscosity law.
module ehlwave_mcewen_law
   use ehlwave_kinds, only: dp
   use ehlwave_viscosity_law, only: largest_exponent, viscosity_law_t
   implicit none (type, external)
   private

   !> eta = eta0 (1 + alpha0 p/q)^q exp(-beta (T - T0)): McEwen, Journal of the Institute of Petroleum 38, 1952,
   !> 646-654; Bair, High Pressure Rheology for Quantitative Elastohydrodynamics, 2nd ed., 2019, chapter 6; theory
   !> eq. (R5). q -> inf is Barus' law.
   type, extends(viscosity_law_t), public :: mcewen_law_t
      real(dp) :: alpha0_per_pa = 0   !! d ln(eta)/dp at ambient pressure, 1/Pa
      real(dp) :: exponent = 0        !! q, above 1
      real(dp) :: beta_per_k = 0      !! beta, 1/K; 0: the viscosity does not depend on temperature
   contains
      procedure :: evaluate
   end type mcewen_law_t

contains

   pure subroutine evaluate(self, n, p_pa, rise_k, exponent, slope_per_pa, slope_per_k)
      class(mcewen_law_t), intent(in) :: self
      integer, intent(in) :: n
      real(dp), intent(in) :: p_pa(n), rise_k(n)
      real(dp), intent(out) :: exponent(n), slope_per_pa(n), slope_per_k(n)
      real(dp) :: x
      integer :: i
      do i = 1, n
         x = 1 + self%alpha0_per_pa*p_pa(i)/self%exponent
         exponent(i) = min(self%exponent*log(x) - self%beta_per_k*rise_k(i), largest_exponent)
         slope_per_pa(i) = self%alpha0_per_pa/x
         slope_per_k(i) = -self%beta_per_k
      end do
   end subroutine evaluate

end module ehlwave_mcewen_law
