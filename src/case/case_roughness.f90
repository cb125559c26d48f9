!> The rough surfaces of a case: their wavelengths, and refusals.
module ehlwave_case_roughness
   use ehlwave_case_definition, only: case_t, roughness_t
   use ehlwave_conditions, only: conditions_t
   use ehlwave_errors, only: error_t, raise
   use ehlwave_formula, only: expected_film
   use ehlwave_kinds, only: dp
   use ehlwave_text, only: to_text
   implicit none (type, external)
   private
   public :: check_line_roughness, check_response, complete_amplitude, complete_roughness

contains

   !> Complete the wavelengths of both surfaces; refuse contradictions.
   subroutine complete_roughness(case, error)
      type(case_t), intent(inout) :: case
      type(error_t), allocatable, intent(inout) :: error

      call complete_waviness(case%roughness_t, '', error)
      call complete_waviness(case%second, '2', error)
      if (allocated(error) .or. .not. case%is_pair()) return
      if (.not. (case%is_wavy() .or. case%is_measured())) then
         call raise(error, given_as(case%second, '2')//' without &waviness or &surface: a single rough surface is '// &
            'the first; write it there, with 2 - S for slip_parameter')
      else if (case%response /= 'harmonic') then
         call check_moving(case%roughness_t, '', case%slip_parameter, error)
         call check_moving(case%second, '2', 2 - case%slip_parameter, error)
      end if
   end subroutine complete_roughness

   !> Give waves of a known amplitude the amplitude over the film of the formula, for estimates of the plan.
   subroutine complete_amplitude(roughness, number, conditions, error)
      type(roughness_t), intent(inout) :: roughness
      character(len=*), intent(in) :: number         !! number of the surface in the names of groups: '' or '2'
      type(conditions_t), intent(in) :: conditions
      type(error_t), allocatable, intent(inout) :: error

      if (allocated(error) .or. .not. roughness%amplitude_m > 0) return
      if (conditions%has_dimensions) then
         roughness%amplitude_over_film = roughness%amplitude_m/(conditions%c_m*expected_film(conditions))
      else
         call raise(error, '&waviness'//number//' amplitude_m holds metres: give &conditions by dimensional data '// &
            '(radius_x_m, ...), or amplitude_over_film in its place')
      end if
   end subroutine complete_amplitude

   !> Refuse a stationary surface of a pair in a march: its pattern would never enter, or be present at once.
   subroutine check_moving(roughness, number, speed, error)
      type(roughness_t), intent(in) :: roughness
      character(len=*), intent(in) :: number
      real(dp), intent(in) :: speed                  !! over the mean speed
      type(error_t), allocatable, intent(inout) :: error
      character(len=*), parameter :: way = ": take response = 'harmonic', or remove one surface"

      if (allocated(error)) return
      if (.not. speed > 0) then
         call raise(error, given_as(roughness, number)//': the surface stands still (slip_parameter), and marches '// &
            'take pairs of surfaces that both move'//way)
      else if (roughness%is_wavy() .and. .not. roughness%wavelength_x_over_a > 0) then
         call raise(error, given_as(roughness, number)//': the pattern does not vary along X and stands still; '// &
            'marches take pairs of patterns that both move'//way)
      end if
   end subroutine check_moving

   !> The group and key by which a surface is given, with its value.
   pure function given_as(roughness, number) result(text)
      type(roughness_t), intent(in) :: roughness
      character(len=*), intent(in) :: number         !! number of the surface in the names of groups: '' or '2'
      character(len=:), allocatable :: text
      if (roughness%is_measured()) then
         text = '&surface'//number//" file = '"//trim(roughness%surface_file)//"'"
      else
         text = '&waviness'//number//" orientation = '"//trim(roughness%orientation)//"'"
      end if
   end function given_as

   !> Wavelengths along X and Y from the orientation, and back.
   subroutine complete_waviness(waves, number, error)
      type(roughness_t), intent(inout) :: waves
      character(len=*), intent(in) :: number         !! as in `given_as`
      type(error_t), allocatable, intent(inout) :: error

      if (allocated(error)) return
      if (waves%is_measured() .and. waves%is_wavy()) then
         call raise(error, given_as(waves, number)//' and &waviness'//number//" orientation = '"// &
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
            call raise(error, '&waviness'//number//" orientation 'custom' needs wavelength_x_over_a or "// &
               'wavelength_y_over_a above 0 (0 means no variation in that direction)')
         else if (waves%oblique .and. min(waves%wavelength_x_over_a, waves%wavelength_y_over_a) <= 0) then
            call raise(error, '&waviness'//number//' oblique needs both wavelength_x_over_a and '// &
               'wavelength_y_over_a above 0')
         end if
         waves%wavelength_over_a = shorter(waves%wavelength_x_over_a, waves%wavelength_y_over_a)
      case default
         if (.not. waves%wavelength_over_a > 0) &
            call raise(error, '&waviness'//number//" wavelength_over_a is missing: orientation '"// &
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
   subroutine check_line_roughness(case, roughness, number, line, error)
      type(case_t), intent(in) :: case
      type(roughness_t), intent(in) :: roughness     !! roughness of a surface
      character(len=*), intent(in) :: number         !! as in `given_as`
      character(len=*), intent(in) :: line           !! ': a line contact ... '
      type(error_t), allocatable, intent(inout) :: error
      character(len=*), parameter :: way = "has waves along Y in linear responses only: set response = 'harmonic', or "
      logical :: has_waves_along

      if (allocated(error)) return
      has_waves_along = roughness%orientation == 'isotropic' .or. roughness%wavelength_y_over_a > 0
      if (roughness%orientation == 'longitudinal' .or. (roughness%wavelength_y_over_a > 0 .and. &
          roughness%orientation == 'custom' .and. .not. roughness%wavelength_x_over_a > 0)) then
         call raise(error, given_as(roughness, number)//line//"has no waves along Y alone: use 'transverse' or "// &
            "'isotropic', or an elliptical contact (radius_ratio_d of 0.005 or more)")
      else if (roughness%is_measured()) then
         call raise(error, given_as(roughness, number)//line//'takes harmonic waves only')
      else if (.not. has_waves_along) then
         return
      else if (case%response /= 'harmonic' .and. roughness%orientation == 'isotropic') then
         call raise(error, given_as(roughness, number)//line//way//"orientation = 'transverse'")
      else if (case%response /= 'harmonic') then
         call raise(error, '&waviness'//number//' wavelength_y_over_a = '//to_text(roughness%wavelength_y_over_a, 6)// &
                    line//way//'wavelength_y_over_a to 0')
      end if
   end subroutine check_line_roughness

   !> The linear response belongs to harmonic waves, to the nominal load, and to time steps that do not skip nodes.
   subroutine check_response(case, error)
      type(case_t), intent(in) :: case
      type(error_t), allocatable, intent(inout) :: error
      character(len=:), allocatable :: given

      if (case%response == 'transient') return
      given = "&waviness response = '"//trim(case%response)
      if (case%is_measured() .or. case%second%is_measured()) then
         if (case%is_measured()) call refuse_heights(case%roughness_t, '')
         if (case%second%is_measured()) call refuse_heights(case%second, '2')
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

   contains

      subroutine refuse_heights(heights, number)
         type(roughness_t), intent(in) :: heights
         character(len=*), intent(in) :: number
         call raise(error, given//"' needs a single harmonic wave, "//given_as(heights, number)//' is none: remove '// &
            '&surface'//number//" or set response to 'transient'")
      end subroutine refuse_heights

   end subroutine check_response

end module ehlwave_case_roughness
