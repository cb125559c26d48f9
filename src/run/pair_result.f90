!> Results of two rough surfaces besides those of the first.
module ehlwave_pair_result
   use ehlwave_harmonic_result, only: harmonic_result_t
   use ehlwave_kinds, only: dp, no_value
   implicit none (type, external)
   private

   !> Numbers are NaN where they are not computed.
   type, public :: pair_result_t
      real(dp) :: ratio_fit = no_value       !! Ad/Ai of the waves of surface 2 in time, and their phase, as those of
      real(dp) :: phase_fit = no_value       !! the first
      real(dp) :: overtone_error = 0         !! relative error of Ad/Ai by overtones of the other surface's waves
      real(dp), allocatable :: surface_position(:)   !! of a measured surface 2, at the contact centre, m
      type(harmonic_result_t) :: harmonic    !! linear response to the waves of surface 2
      real(dp) :: film_rms = no_value        !! rms of H(0,0) by both waves over its mean, phases free, linear
      real(dp) :: mean_rise = no_value       !! change of the mean of H(0,0) by both over the Ai of the first, second
                                             !! order
      real(dp) :: cross_rise = no_value      !! part of it that neither surface has alone
      real(dp) :: smallest_film = no_value   !! smallest H with both waves, second order; none where they would touch
      logical, allocatable :: surfaces_touch !! unallocated: not known
   end type pair_result_t

end module ehlwave_pair_result
