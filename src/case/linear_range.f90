!> Up to which amplitude waves respond as small ones do.
!>
!> Fitted to marches beside linear responses (`scripts/linearity`): the difference of Ad/Ai grows with the square of Ai, in pure
!> rolling slowly, under slip the faster the more the surfaces slide; a Ree-Eyring oil thins where it is sheared and is less stiff.
module ehlwave_linear_range
   use ehlwave_case_definition, only: case_t
   use ehlwave_kinds, only: dp
   implicit none (type, external)
   private
   public :: expected_nonlinearity, linear_limit

   real(dp), parameter, public :: tolerated_difference = 0.01_dp   !! of Ad/Ai, relative, within the linear range
   real(dp), parameter :: rolling_factor = 0.05_dp                 !! of (Ai over the film)^2
   real(dp), parameter :: slip_factor(2) = [30.0_dp, 10.0_dp]      !! the same over |S - 1|: Newtonian oil, others

contains

   !> Relative difference to expect between Ad/Ai of the waves of a case and that of small ones.
   elemental real(dp) function expected_nonlinearity(case) result(difference)
      type(case_t), intent(in) :: case
      difference = curvature(case)*case%amplitude_over_film**2
   end function expected_nonlinearity

   !> Largest Ai over the film within the linear range.
   elemental real(dp) function linear_limit(case)
      type(case_t), intent(in) :: case
      linear_limit = min(1.0_dp, sqrt(tolerated_difference/curvature(case)))
   end function linear_limit

   elemental real(dp) function curvature(case)
      type(case_t), intent(in) :: case
      curvature = rolling_factor + slip_factor(merge(1, 2, case%flow_law == 'newtonian'))*abs(case%slip_parameter - 1)
   end function curvature

end module ehlwave_linear_range
