!> The parts of the relative error of a number.
module ehlwave_error_parts
   use ehlwave_effects_keys, only: effect_count
   use ehlwave_kinds, only: dp
   implicit none (type, external)
   private

   !> Expected by a plan, or estimated after a run. `accuracy` limits their sum.
   type, public :: error_parts_t
      real(dp) :: mesh = 0         !! by the mesh, and of moving waves by time steps that follow it
      real(dp) :: by_effect(effect_count) = 0   !! by each physical effect, of first order in the mesh size
      real(dp) :: domain = 0       !! by the edges of the domain; truncated edges are requested, and reported
                                   !! besides
      real(dp) :: time = 0         !! by time steps longer than hX
      real(dp) :: amplitude = 0    !! error of waves in time by the difference of Ad/Ai from small waves
      real(dp) :: settling = 0     !! error of waves in time by the change of Ad/Ai from period to period
      real(dp) :: algebraic = 0    !! by the tolerances
   contains
      procedure :: total
   end type error_parts_t

contains

   !> The sum of all parts, NaN where a part is unknown.
   elemental real(dp) function total(self)
      class(error_parts_t), intent(in) :: self
      total = self%mesh + sum(self%by_effect) + self%domain + self%time + self%amplitude + self%settling &
              + self%algebraic
   end function total

end module ehlwave_error_parts
