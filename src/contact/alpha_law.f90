!> Viscosity laws whose pressure-viscosity coefficient alpha is given.
module ehlwave_alpha_law
   use ehlwave_kinds, only: dp
   use ehlwave_viscosity_law, only: viscosity_law_t
   implicit none (type, external)
   private

   !> Such a law has the temperature-viscosity coefficient beta besides: -d ln(eta)/dT at ambient pressure and T0.
   type, abstract, extends(viscosity_law_t), public :: alpha_law_t
      real(dp) :: alpha_per_pa = 0   !! alpha, 1/Pa
      real(dp) :: beta_per_k = 0     !! beta, 1/K; 0: the viscosity does not depend on temperature
   contains
      procedure :: coefficient => given_coefficient
   end type alpha_law_t

contains

   !> alpha as it is given. It sets ph = alphabar/alpha, also where the law makes no use of it.
   pure real(dp) function given_coefficient(law) result(alpha)
      class(alpha_law_t), intent(in) :: law
      alpha = law%alpha_per_pa
   end function given_coefficient

end module ehlwave_alpha_law
