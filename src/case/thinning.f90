!> Expected errors and work of an oil that is not Newtonian, relative to a Newtonian oil.
!>
!> Its film is thinner, its inlet steeper by the same factor, and the flow across the film needs more points. Measured:
!> H(0,0) on 64 to 192 cells of 60 random contacts (M 8 to 250, L 2 to 17, D 0.05 to 1, S 0.2 to 1.8, Ree-Eyring 0.1 to
!> 20 MPa, Carreau n 0.35 to 1). The error over the Newtonian model's is the Newtonian film over the film. Both are
!> about 1 + 0.15 (1 - n) ph^2/(E' tau0), theory eq. (E7):
!>
!>     ph^2/(E' tau0)             0.6    2.5    3.4    10     17     23 (n = 0.57)   79      216 (n = 0.46)
!>     error over the model       1.2    1.25   1.6    2.6    3.9    2.0             17      10.8
!>     1 + 0.15 (1 - n) ...       1.1    1.4    1.5    2.5    3.5    2.5             12.8    18
!>
!> (at 34 with S = 0.98 it is 2.6 in place of 6). Work over the Newtonian model's is the same without n up to 20 (3 at
!> 20; 29 for the Carreau oil of 216). With sliding many cases above 10 need the rescue ladder: 32 times at 14, 30 to
!> 220 times at 40, 43 to 70 times at 58 with B = 2.6, 600 times at 79 with B = 10, where B = (lambdabar/3) abs(S - 1)
!> ph^2/(E' tau0)/H is the rate of shear in the film of the formula. The cost is a compromise: direct solutions take
!> down to a fifth of it, rescued solutions up to ten times as much.
module ehlwave_thinning
   use ehlwave_conditions, only: conditions_t
   use ehlwave_film_flow, only: film_flow_t
   use ehlwave_formula, only: expected_film
   use ehlwave_kinds, only: dp
   use ehlwave_rheology, only: rheology_t
   implicit none (type, external)
   private
   public :: new_thinning

   type, public :: thinning_t
      real(dp) :: steepness = 1   !! error on the same grid over a Newtonian oil's
      real(dp) :: cost = 1        !! work over an oil whose flow takes least
      real(dp) :: cost_factor = 2 !! factor within which 17 of 20 random cases agree with the plan
   end type thinning_t

   real(dp), parameter :: factor = 0.15_dp
   real(dp), parameter :: rescue_factor = 0.6_dp, rescue_stress = 5   !! value of ph^2/(E' tau0), from which on rescues
                                                                      !! are to
                                                                      !! be expected

   !> The work of 84 to 86 per cent of cases was within a factor of 2 of the plan with 328 Newtonian oils, within 3 with
   !> 140 that thin below `rescue_stress`, within 10 with 25 beyond.
   real(dp), parameter :: factor_mild = 3, factor_strong = 10

contains

   !> Thinning of an oil; 1 for a Newtonian oil.
   pure function new_thinning(rheology, conditions, exponent) result(self)
      type(rheology_t), intent(in) :: rheology
      type(conditions_t), intent(in) :: conditions
      real(dp), intent(in) :: exponent         !! n of the Carreau law, else 0
      type(thinning_t) :: self
      type(film_flow_t) :: flow
      real(dp) :: rate, stress                 ! B, ph^2/(E' tau0)

      if (rheology%is_newtonian()) return
      flow = rheology%film_flow(conditions%elliptic%k, conditions%lambdabar, conditions%slip_parameter)
      stress = flow%n0/conditions%elliptic%k
      rate = conditions%lambdabar/3*abs(conditions%slip_parameter - 1)*stress/expected_film(conditions)
      self%steepness = 1 + factor*(1 - exponent)*stress
      self%cost_factor = merge(factor_strong, factor_mild, stress > rescue_stress)
      self%cost = 1 + factor*stress*(1 + rate) + rescue_factor*max(0.0_dp, stress - rescue_stress)
   end function new_thinning

end module ehlwave_thinning
