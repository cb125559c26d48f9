!> A viscosity that does not depend on pressure.
module ehlwave_isoviscous_law
   use ehlwave_alpha_law, only: alpha_law_t
   use ehlwave_kinds, only: dp
   implicit none (type, external)
   private

   !> eta = eta0 exp(-beta (T - T0)).
   type, extends(alpha_law_t), public :: isoviscous_law_t
   contains
      procedure :: evaluate
   end type isoviscous_law_t

contains

   pure subroutine evaluate(self, n, p_pa, rise_k, exponent, slope_per_pa, slope_per_k)
      class(isoviscous_law_t), intent(in) :: self
      integer, intent(in) :: n
      real(dp), intent(in) :: p_pa(n), rise_k(n)
      real(dp), intent(out) :: exponent(n), slope_per_pa(n), slope_per_k(n)
      exponent = -self%beta_per_k*rise_k
      slope_per_pa = 0*p_pa
      slope_per_k = -self%beta_per_k
   end subroutine evaluate

end module ehlwave_isoviscous_law
