!> Responses to the waves of two surfaces together.
module ehlwave_pair_responses
   use ehlwave_harmonic_response, only: harmonic_response_t
   use ehlwave_kinds, only: dp, no_value
   use ehlwave_mean_film, only: find_mean_change, mean_change_t
   use ehlwave_pair_result, only: pair_result_t
   use ehlwave_shared_steady, only: shared_steady_t
   use ehlwave_status, only: status_converged
   use ehlwave_surfaces, only: surfaces_t
   implicit none (type, external)
   private
   public :: take_pair_responses

contains

   !> Take the joint effect of both waves, after the response to each. Waves of different frequencies change the mean
   !> independently, theory eq. (W15). Waves of equal frequency, with crests at X = 0 at T = 0, act as a single pattern.
   subroutine take_pair_responses(self, surfaces, central_film, steady, responses, means)
      type(pair_result_t), intent(inout) :: self
      type(surfaces_t), intent(in) :: surfaces
      real(dp), intent(in) :: central_film                   !! smooth H(0,0)
      type(shared_steady_t), intent(inout) :: steady
      type(harmonic_response_t), intent(in) :: responses(:)  !! responses of each surface, converged
      type(mean_change_t), intent(in) :: means(:)            !! changes of the mean, likewise
      real(dp), allocatable :: film(:, :)
      real(dp) :: amplitudes(2)
      type(harmonic_response_t) :: together
      type(mean_change_t) :: both
      integer :: n

      amplitudes = [(surfaces%list(n)%amplitude(central_film), n=1, 2)]
      self%film_rms = norm2(amplitudes*abs(responses%film))/(sqrt(2.0_dp)*central_film)
      if (any(means%status /= status_converged)) return
      self%mean_rise = sum(means%film)/amplitudes(1)
      self%cross_rise = 0
      film = means(1)%state%h + means(2)%state%h
      if (are_tied(surfaces, steady%multigrid%levels(1)%problem%grid%is_line)) then
         together = responses(1)
         together%p = together%p + amplitudes(2)/amplitudes(1)*responses(2)%p
         together%h = together%h + amplitudes(2)/amplitudes(1)*responses(2)%h
         together%approach = together%approach + amplitudes(2)/amplitudes(1)*responses(2)%approach
         call find_mean_change(steady%response%tangent, steady%multigrid%levels, together, surfaces%list(1), &
                               amplitudes(1), both)
         self%cross_rise = no_value
         if (both%status == status_converged) self%cross_rise = both%film/amplitudes(1) - self%mean_rise
         self%mean_rise = self%mean_rise + self%cross_rise
         film = both%state%h
      end if
      film = film + steady%response%tangent%state%h - amplitudes(1)*abs(responses(1)%h) &
             - amplitudes(2)*abs(responses(2)%h)
      self%surfaces_touch = .not. minval(film) > 0
      if (.not. self%surfaces_touch) self%smallest_film = minval(film)
   end subroutine take_pair_responses

   !> Whether the waves have equal frequency, and both or neither vary along Y only; on a line contact also equal
   !> wave number along it, over which the mean is taken.
   pure logical function are_tied(surfaces, is_line)
      type(surfaces_t), intent(in) :: surfaces
      logical, intent(in) :: is_line
      associate (first => surfaces%list(1), second => surfaces%list(2))
         are_tied = first%is_longitudinal() .eqv. second%is_longitudinal()   ! shifts along X and along Y are free
         are_tied = are_tied .and. .not. abs(first%frequency() - second%frequency()) > 0
         if (is_line) are_tied = are_tied .and. .not. abs(first%wavelength_y - second%wavelength_y) > 0
      end associate
   end function are_tied

end module ehlwave_pair_responses
