!> The rough surfaces of a case: their wavelengths, and refusals.
module ehlwave_case_roughness
   use ehlwave_case_definition, only: case_t
   use ehlwave_conditions, only: conditions_t
   use ehlwave_errors, only: error_t, raise
   use ehlwave_formula, only: expected_film
   use ehlwave_kinds, only: dp
   use ehlwave_roughness, only: roughness_t
   use ehlwave_text, only: to_text
   implicit none (type, external)
   private
   public :: check_line_roughness, check_response, complete_amplitudes, complete_roughness

contains

   !> Complete the wavelengths of both surfaces; refuse contradictions.
   subroutine complete_roughness(case, error)
      type(case_t), intent(inout) :: case
      type(error_t), allocatable, intent(inout) :: error
      call complete_waviness(case%roughness_t, error)
      call complete_waviness(case%effects%second%roughness, error)
   end subroutine complete_roughness

   !> Complete the amplitudes of both surfaces.
   subroutine complete_amplitudes(case, conditions, error)
      type(case_t), intent(inout) :: case
      type(conditions_t), intent(in) :: conditions
      type(error_t), allocatable, intent(inout) :: error
      call complete_amplitude(case%roughness_t, conditions, error)
      call complete_amplitude(case%effects%second%roughness, conditions, error)
   end subroutine complete_amplitudes

   !> Give waves of a known amplitude the amplitude over the film of the formula, for estimates of the plan.
   subroutine complete_amplitude(roughness, conditions, error)
      type(roughness_t), intent(inout) :: roughness
      type(conditions_t), intent(in) :: conditions
      type(error_t), allocatable, intent(inout) :: error

      if (allocated(error) .or. .not. roughness%amplitude_m > 0) return
      if (conditions%has_dimensions) then
         roughness%amplitude_over_film = roughness%amplitude_m/(conditions%c_m*expected_film(conditions))
      else
         call raise(error, roughness%group('waviness')//' amplitude_m holds metres: give &conditions by '// &
            'dimensional data (radius_x_m, ...), or amplitude_over_film in its place')
      end if
   end subroutine complete_amplitude

   !> Wavelengths along X and Y from the orientation, and back.
   subroutine complete_waviness(waves, error)
      type(roughness_t), intent(inout) :: waves
      type(error_t), allocatable, intent(inout) :: error

      if (allocated(error)) return
      if (waves%is_measured() .and. waves%is_wavy()) then
         call raise(error, waves%given_as()//' and '//waves%group('waviness')//" orientation = '"// &
            trim(waves%orientation)//"': give one of the two")
         return
      end if
      select case (waves%orientation)
      case ('none')
         waves%wavelength_over_a = 0
         waves%wavelength_x_over_a = 0
         waves%wavelength_y_over_a = 0
      case ('custom')
         if (max(waves%wavelength_x_over_a, waves%wavelength_y_over_a) <= 0) then
            call raise(error, waves%group('waviness')//" orientation 'custom' needs wavelength_x_over_a or "// &
               'wavelength_y_over_a above 0 (0 means no variation in that direction)')
         else if (waves%oblique .and. min(waves%wavelength_x_over_a, waves%wavelength_y_over_a) <= 0) then
            call raise(error, waves%group('waviness')//' oblique needs both wavelength_x_over_a and '// &
               'wavelength_y_over_a above 0')
         end if
         waves%wavelength_over_a = shorter(waves%wavelength_x_over_a, waves%wavelength_y_over_a)
      case default
         if (.not. waves%wavelength_over_a > 0) &
            call raise(error, waves%group('waviness')//" wavelength_over_a is missing: orientation '"// &
            trim(waves%orientation)//"' needs it")
         waves%wavelength_x_over_a = merge(0.0_dp, waves%wavelength_over_a, waves%orientation == 'longitudinal')
         waves%wavelength_y_over_a = merge(0.0_dp, waves%wavelength_over_a, waves%orientation == 'transverse')
      end select
   end subroutine complete_waviness

   !> The smaller of two wavelengths, 0 standing for infinite.
   pure real(dp) function shorter(x, y)
      real(dp), intent(in) :: x, y
      shorter = min(merge(x, huge(x), x > 0), merge(y, huge(y), y > 0))
      if (max(x, y) <= 0) shorter = 0
   end function shorter

   !> Refuse surfaces outside line contacts: heights, and waves along Y, except linear responses that also vary
   !> along X.
   subroutine check_line_roughness(case, roughness, line, error)
      type(case_t), intent(in) :: case
      type(roughness_t), intent(in) :: roughness     !! roughness of a surface
      character(len=*), intent(in) :: line           !! ': a line contact ... '
      type(error_t), allocatable, intent(inout) :: error
      character(len=*), parameter :: way = "has waves along Y in linear responses only: set response = 'harmonic', or "
      logical :: has_waves_along

      if (allocated(error)) return
      has_waves_along = roughness%orientation == 'isotropic' .or. roughness%wavelength_y_over_a > 0
      if (roughness%orientation == 'longitudinal' .or. (roughness%wavelength_y_over_a > 0 .and. &
          roughness%orientation == 'custom' .and. .not. roughness%wavelength_x_over_a > 0)) then
         call raise(error, roughness%given_as()//line//"has no waves along Y alone: use 'transverse' or "// &
            "'isotropic', or an elliptical contact (radius_ratio_d of 0.005 or more)")
      else if (roughness%is_measured()) then
         call raise(error, roughness%given_as()//line//'takes harmonic waves only')
      else if (.not. has_waves_along) then
         return
      else if (case%response /= 'harmonic' .and. roughness%orientation == 'isotropic') then
         call raise(error, roughness%given_as()//line//way//"orientation = 'transverse'")
      else if (case%response /= 'harmonic') then
         call raise(error, roughness%group('waviness')//' wavelength_y_over_a = '// &
                    to_text(roughness%wavelength_y_over_a, 6)// &
                    line//way//'wavelength_y_over_a to 0')
      end if
   end subroutine check_line_roughness

   !> The linear response belongs to harmonic waves, to the nominal load, and to time steps that do not skip nodes.
   subroutine check_response(case, error)
      type(case_t), intent(in) :: case
      type(error_t), allocatable, intent(inout) :: error
      character(len=:), allocatable :: given
      type(roughness_t) :: both(2)
      integer :: n

      if (case%response == 'transient') return
      given = "&waviness response = '"//trim(case%response)
      if (case%has_heights()) then
         both = case%surfaces()
         do n = 1, size(both)
            if (both(n)%is_measured()) call raise(error, given//"' needs a single harmonic wave, "// &
               both(n)%given_as()//' is none: remove '//both(n)%group('surface')//" or set response to 'transient'")
         end do
      else if (abs(case%load_factor - 1) > 0) then
         call raise(error, given//"' is about the steady state under the nominal load: remove &dynamics "// &
            "load_factor or set response to 'transient'")
      else if (case%time_step_over_cell > 1) then
         call raise(error, '&solver time_step_over_cell = '//to_text(case%time_step_over_cell, 6)// &
                    " is above 1: response = '"//trim(case%response)// &
                    "' linearises steps of at most one cell; use 1, 0.5, 0.25, ... or response = 'transient'")
      else if ((case%response == 'harmonic' .or. case%response == 'periodic') .and. case%end_time > 0) then
         call raise(error, "&dynamics end_time is given but response = '"//trim(case%response)// &
            "' takes no time steps: remove end_time or set response to 'both' or 'transient'")
      end if
   end subroutine check_response

end module ehlwave_case_roughness
