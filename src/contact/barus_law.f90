!> Barus' viscosity law.
module ehlwave_barus_law
   use ehlwave_alpha_law, only: alpha_law_t
   use ehlwave_kinds, only: dp
   use ehlwave_viscosity_law, only: largest_exponent
   implicit none (type, external)
   private

   !> eta = eta0 exp(alpha p - beta (T - T0)): Barus, American Journal of Science 45, 1893, 87-96; theory eq. (R3).
   type, extends(alpha_law_t), public :: barus_law_t
   contains
      procedure :: evaluate
   end type barus_law_t

contains

   pure subroutine evaluate(self, n, p_pa, rise_k, exponent, slope_per_pa, slope_per_k)
      class(barus_law_t), intent(in) :: self
      integer, intent(in) :: n
      real(dp), intent(in) :: p_pa(n), rise_k(n)
      real(dp), intent(out) :: exponent(n), slope_per_pa(n), slope_per_k(n)
      exponent = min(self%alpha_per_pa*p_pa - self%beta_per_k*rise_k, largest_exponent)
      slope_per_pa = self%alpha_per_pa
      slope_per_k = -self%beta_per_k
   end subroutine evaluate

end module ehlwave_barus_law
