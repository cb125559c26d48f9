!> The second rough surface in the result of a case: its own waves, and both together.
module ehlwave_second_surface_result
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ehlwave_case_definition, only: case_t
   use ehlwave_effect_result, only: after_waves, effect_result_t
   use ehlwave_harmonic_response, only: harmonic_response_t
   use ehlwave_hdf5_file, only: hdf5_file_t
   use ehlwave_hierarchy, only: level_t
   use ehlwave_kinds, only: dp, no_value
   use ehlwave_mean_film, only: find_mean_change, mean_change_t
   use ehlwave_planned_case, only: case_plan_t
   use ehlwave_quantity, only: quantity_list_t
   use ehlwave_response_fields, only: write_response
   use ehlwave_status, only: status_converged
   use ehlwave_steady_tangent, only: steady_tangent_t
   use ehlwave_surface_result, only: surface_result_t
   use ehlwave_surfaces, only: surfaces_t
   use ehlwave_text, only: to_text
   use ehlwave_wave_quantities, only: add_response
   implicit none (type, external)
   private

   !> Numbers are NaN where they are not computed.
   type, extends(effect_result_t), public :: second_surface_result_t
      type(surface_result_t) :: surface
      real(dp) :: film_rms = no_value        !! rms of H(0,0) by both waves over its mean, phases free, linear
      real(dp) :: mean_rise = no_value       !! change of the mean of H(0,0) by both over the Ai of the first, second
                                             !! order
      real(dp) :: cross_rise = no_value      !! part of it that neither surface has alone
      real(dp) :: smallest_film = no_value   !! smallest H with both waves, second order; none where they would touch
      logical, allocatable :: surfaces_touch !! unallocated: not known
   contains
      procedure, nopass :: place
      procedure :: take_responses
      procedure :: touching_text
      procedure :: write_fields
      procedure :: add_quantities
      procedure :: print
   end type second_surface_result_t

contains

   pure integer function place()
      place = after_waves
   end function place

   !> Take the joint effect of both waves, after the response to each. Waves of different frequencies change the mean
   !> independently, theory eq. (W15). Waves of equal frequency, with crests at X = 0 at T = 0, act as a single pattern.
   subroutine take_responses(self, surfaces, central_film, tangent, levels, responses, means)
      class(second_surface_result_t), intent(inout) :: self
      type(surfaces_t), intent(in) :: surfaces
      real(dp), intent(in) :: central_film                   !! smooth H(0,0)
      type(steady_tangent_t), intent(inout) :: tangent
      type(level_t), intent(inout), target :: levels(:)      !! levels of `tangent`
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
      if (are_tied(surfaces, levels(1)%problem%grid%is_line)) then
         together = responses(1)
         together%p = together%p + amplitudes(2)/amplitudes(1)*responses(2)%p
         together%h = together%h + amplitudes(2)/amplitudes(1)*responses(2)%h
         together%approach = together%approach + amplitudes(2)/amplitudes(1)*responses(2)%approach
         call find_mean_change(tangent, levels, together, surfaces%list(1), &
                               amplitudes(1), both)
         self%cross_rise = no_value
         if (both%status == status_converged) self%cross_rise = both%film/amplitudes(1) - self%mean_rise
         self%mean_rise = self%mean_rise + self%cross_rise
         film = both%state%h
      end if
      film = film + tangent%state%h - amplitudes(1)*abs(responses(1)%h) &
             - amplitudes(2)*abs(responses(2)%h)
      self%surfaces_touch = .not. minval(film) > 0
      if (.not. self%surfaces_touch) self%smallest_film = minval(film)
   end subroutine take_responses

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

   !> Warning where the waves of both surfaces together would touch; '': none.
   pure function touching_text(self) result(text)
      class(second_surface_result_t), intent(in) :: self
      character(len=:), allocatable :: text
      text = ''
      if (.not. allocated(self%surfaces_touch)) return
      if (self%surfaces_touch) text = 'the waves of both surfaces together would touch, to second order: there is '// &
         'no smallest_film_both'
   end function touching_text

   subroutine write_fields(self, file)
      class(second_surface_result_t), intent(in) :: self
      type(hdf5_file_t), intent(inout) :: file
      if (allocated(self%surface%surface_position)) call file%write('surface_position_2_m', &
         self%surface%surface_position, 'm', 'x on surface 2, as in its file, that is at the contact centre', 'time')
      call write_response(file, self%surface%harmonic, '_2')
   end subroutine write_fields

   subroutine add_quantities(self, list, case, plan)
      class(second_surface_result_t), intent(in) :: self
      type(quantity_list_t), intent(inout) :: list
      type(case_t), intent(in) :: case
      type(case_plan_t), intent(in) :: plan
      associate (exists => case%is_pair(), surface => self%surface)
         call list%add('amplitude_ratio_fit_2', 'Ad/Ai of the waves of surface 2 from a harmonic fit', &
            surface%amplitude_ratio_fit, exists=exists)
         call list%add('phase_fit_2', 'phase of their harmonic fit against their pattern at the centre', &
            surface%phase_fit, unit='rad', exists=exists)
         call add_response(list, surface%harmonic, '_2', exists)
         call list%add('film_rms_both', 'rms of H(0,0) by the waves of both surfaces over central_film, phases '// &
            'free even where the waves have one frequency, linear responses', self%film_rms, exists=exists)
         call list%add('mean_film_rise_both', 'mean film with the waves of both surfaces less smooth film over '// &
            'Ai of the first, second order, linear responses', self%mean_rise, exists=exists)
         call list%add('mean_film_rise_cross', 'part of mean_film_rise_both that neither surface has alone', &
            self%cross_rise, exists=exists)
         call list%add('smallest_film_both', 'smallest film with the waves of both surfaces anywhere at any time, '// &
            'phases free even where the waves have one frequency, second order', self%smallest_film, exists=exists)
         call list%add_truth('surfaces_touch_both', '1 when both waves together would touch, second order; -1: not '// &
            'known', self%surfaces_touch, exists=exists)
      end associate
   end subroutine add_quantities

   subroutine print(self, unit, plan)
      class(second_surface_result_t), intent(in) :: self
      integer, intent(in) :: unit
      type(case_plan_t), intent(in) :: plan
      if (ieee_is_finite(self%film_rms)) write (unit, '(a)') '  both       rms of H(0,0) over its mean '// &
         to_text(self%film_rms, 4)//', phases free'
   end subroutine print

end module ehlwave_second_surface_result
