!> How a generalised Newtonian oil shears: the interface of its flow laws. A new law is one module that extends it.
module ehlwave_flow_law
   use ehlwave_kinds, only: dp
   implicit none (type, external)
   private

   !> Shear rate = (tau0/eta) s(|sigma|) sigma under the stress sigma = tau/tau0, with s -> 1 for small stresses
   !> (Newton). tau0 is the stress by which the law is made dimensionless.
   type, abstract, public :: flow_law_t
      logical :: is_power = .false.   !! s varies as a power of the stress, near enough to linearly over its size; else
                                      !! over 1
      logical :: is_newtonian = .false.   !! s = 1
   contains
      procedure(shear_factor), deferred :: shear_factor
      procedure(first_stress), deferred :: first_stress
      procedure(largest_variation), deferred :: largest_variation
   end type flow_law_t

   abstract interface
      !> s and its derivative by |sigma|^2. Finite for any argument: continued linearly in |sigma|^2 where s would
      !> overflow.
      pure subroutine shear_factor(self, n, stress2, s, slope)
         import :: dp, flow_law_t
         implicit none (type, external)
         class(flow_law_t), intent(in) :: self
         integer, intent(in) :: n
         real(dp), intent(in) :: stress2(n)    !! |sigma|^2
         real(dp), intent(out) :: s(n)         !! s >= 1
         real(dp), intent(out) :: slope(n)     !! ds/d(|sigma|^2)
      end subroutine shear_factor

      !> The stress whose dimensionless shear rate s(|sigma|) |sigma| is `rate`; a first guess, so a few digits suffice.
      pure subroutine first_stress(self, n, rate, stress)
         import :: dp, flow_law_t
         implicit none (type, external)
         class(flow_law_t), intent(in) :: self
         integer, intent(in) :: n
         real(dp), intent(in) :: rate(n)       !! > 0
         real(dp), intent(out) :: stress(n)    !! |sigma|
      end subroutine first_stress

      !> Largest |Sigma|, half the change of sigma across the film, at which so many Gauss points keep the error of
      !> integrals across it below 1e-12 of them.
      elemental real(dp) function largest_variation(self, points)
         import :: dp, flow_law_t
         implicit none (type, external)
         class(flow_law_t), intent(in) :: self
         integer, intent(in) :: points         !! 2, 4 or more
      end function largest_variation
   end interface

end module ehlwave_flow_law
