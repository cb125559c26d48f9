!> The improved Yasutomi viscosity law.
module ehlwave_yasutomi_law
   use ehlwave_kinds, only: dp
   use ehlwave_viscosity_law, only: largest_exponent, viscosity_law_t
   implicit none (type, external)
   private

   !> log10(eta/eta_g) = -C1 (T - Tg) F/(C2 + (T - Tg) F),  Tg = Tg0 + A1 ln(1 + A2 p),  F = (1 + b1 p)^b2:
   !> Bair, Mary, Bouscharain and Vergne, Proc. IMechE J: Journal of Engineering Tribology 227, 2013, 1056-1060; theory
   !> eq. (R6). eta_g, the viscosity at the glass transition, drops out of eta/eta0.
   type, extends(viscosity_law_t), public :: yasutomi_law_t
      real(dp) :: c1 = 0, c2_k = 0                          !! C1, C2 in K
      real(dp) :: above_glass_k = 0                         !! T0 - Tg0, K
      real(dp) :: a1_k = 0, a2_per_pa = 0                   !! A1 in K, A2 in 1/Pa
      real(dp) :: b1_per_pa = 0, b2 = 0                     !! b1 in 1/Pa, b2 < 0
   contains
      procedure :: evaluate
   end type yasutomi_law_t

contains

   !> Where the pole of the law is near the exponent stays at its limit.
   pure subroutine evaluate(self, n, p_pa, rise_k, exponent, slope_per_pa, slope_per_k)
      class(yasutomi_law_t), intent(in) :: self
      integer, intent(in) :: n
      real(dp), intent(in) :: p_pa(n), rise_k(n)
      real(dp), intent(out) :: exponent(n), slope_per_pa(n), slope_per_k(n)
      real(dp) :: ambient, above, f, least, scale, slope, total, x
      integer :: i

      scale = log(10.0_dp)*self%c1
      ambient = self%c2_k + self%above_glass_k
      least = 1/(largest_exponent/(scale*self%c2_k) + 1/ambient)
      do i = 1, n
         above = self%above_glass_k + rise_k(i) - self%a1_k*log(1 + self%a2_per_pa*p_pa(i))
         x = 1 + self%b1_per_pa*p_pa(i)
         f = x**self%b2
         slope = -self%a1_k*self%a2_per_pa/(1 + self%a2_per_pa*p_pa(i))*f + above*self%b2*self%b1_per_pa*f/x
         total = max(self%c2_k + above*f, least)
         exponent(i) = min(scale*self%c2_k*(1/total - 1/ambient), largest_exponent)
         slope_per_pa(i) = -scale*self%c2_k*slope/total**2
         slope_per_k(i) = -scale*self%c2_k*f/total**2
      end do
   end subroutine evaluate

end module ehlwave_yasutomi_law
