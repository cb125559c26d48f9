!> Results of the waves or heights of one surface.
module ehlwave_surface_result
   use ehlwave_harmonic_result, only: harmonic_result_t
   use ehlwave_kinds, only: dp, no_value
   implicit none (type, external)
   private

   !> Numbers are NaN where they are not computed.
   type, public :: surface_result_t
      real(dp) :: amplitude_ratio_fit = no_value     !! Ad/Ai by harmonic fit
      real(dp) :: phase_fit = no_value               !! radian by which H(0,0) follows the pattern there, by harmonic
                                                     !! fit
      type(harmonic_result_t) :: harmonic            !! linear response, if asked for
      real(dp), allocatable :: surface_position(:)   !! position on a measured surface, at the contact centre, m
   end type surface_result_t

end module ehlwave_surface_result
