!> A density that does not depend on pressure.
module ehlwave_incompressible_density
   use ehlwave_density_law, only: density_law_t
   use ehlwave_kinds, only: dp
   implicit none (type, external)
   private

   !> rho/rho0 = 1 - eps (T - T0).
   type, extends(density_law_t), public :: incompressible_density_t
      real(dp) :: expansion_per_k = 0   !! eps, 1/K
   contains
      procedure :: evaluate
   end type incompressible_density_t

contains

   pure subroutine evaluate(self, n, p_pa, rise_k, rho, slope_per_pa, slope_per_k)
      class(incompressible_density_t), intent(in) :: self
      integer, intent(in) :: n
      real(dp), intent(in) :: p_pa(n), rise_k(n)
      real(dp), intent(out) :: rho(n), slope_per_pa(n), slope_per_k(n)
      rho = 1 - self%expansion_per_k*rise_k
      slope_per_pa = 0*p_pa
      slope_per_k = -self%expansion_per_k
   end subroutine evaluate

end module ehlwave_incompressible_density
