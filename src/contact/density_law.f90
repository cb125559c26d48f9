!> The interface of density laws. A new law is one module that extends it.
module ehlwave_density_law
   use ehlwave_kinds, only: dp
   implicit none (type, external)
   private

   !> Density against pressure and temperature. rho0 is the density at ambient pressure and the reference temperature
   !> T0.
   type, abstract, public :: density_law_t
   contains
      procedure(evaluate), deferred :: evaluate
   end type density_law_t

   abstract interface
      !> rho/rho0 and its derivatives by pressure and temperature.
      pure subroutine evaluate(self, n, p_pa, rise_k, rho, slope_per_pa, slope_per_k)
         import :: density_law_t, dp
         implicit none (type, external)
         class(density_law_t), intent(in) :: self
         integer, intent(in) :: n
         real(dp), intent(in) :: p_pa(n)            !! pressure >= 0, Pa
         real(dp), intent(in) :: rise_k(n)          !! T - T0, K
         real(dp), intent(out) :: rho(n)            !! rho/rho0
         real(dp), intent(out) :: slope_per_pa(n)   !! d(rho/rho0)/dp, 1/Pa
         real(dp), intent(out) :: slope_per_k(n)    !! d(rho/rho0)/dT, 1/K
      end subroutine evaluate
   end interface

end module ehlwave_density_law
