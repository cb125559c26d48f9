!> Makes a case from the input as given: defaults that depend on which keys were given.
module ehlwave_input_completion
   use ehlwave_case_completion, only: case_conditions, complete_case
   use ehlwave_case_definition, only: case_t
   use ehlwave_case_input, only: case_input_t
   use ehlwave_case_key, only: key_length
   use ehlwave_conditions, only: conditions_t
   use ehlwave_effect_keys, only: by_fitted_scheme
   use ehlwave_errors, only: error_t, raise
   use ehlwave_formula, only: anisotropy_factor, wave_parameter_v
   use ehlwave_kinds, only: dp
   use ehlwave_key_applicability, only: check_applicability
   use ehlwave_key_list, only: find_key, key_list_t
   use ehlwave_linear_range, only: linear_amplitude
   use ehlwave_roughness, only: roughness_t
   use ehlwave_text, only: to_text
   implicit none (type, external)
   private
   public :: complete_input

   character(len=key_length), parameter :: moes_keys(3) = [character(len=key_length) :: 'load_parameter_m', &
      'lubricant_parameter_l', 'radius_ratio_d']
   !> Keys that mark dimensional data; reduced_modulus_pa may be given with M, L and D, too.
   character(len=key_length), parameter :: data_keys(6) = [character(len=key_length) :: 'radius_x_m', 'radius_y_m', &
      'load_n', 'load_n_per_m', 'mean_speed_m_per_s', 'viscosity_pa_s']

   real(dp), parameter :: accuracy_of_heights = 0.005_dp   !! of films under measured heights, if none is given

contains

   !> Complete a case: its conditions, the choices of its accuracy, and all keys that follow from others. Refuses
   !> missing, contradictory and inapplicable keys; keys that may idle are dropped and count as not given. `place`
   !> begins every message.
   subroutine complete_input(input, list, place, error)
      type(case_input_t), intent(inout) :: input
      type(key_list_t), intent(in) :: list         !! list of all keys
      character(len=*), intent(in) :: place
      type(error_t), allocatable, intent(inout) :: error

      if (allocated(error)) return
      call settle_slip(input, list, error)
      if (.not. allocated(error)) call settle_conditions(input, list, error)
      if (.not. allocated(error) .and. input%f_v > 0) call choose_wavelength(input, list, error)
      if (.not. allocated(error)) call check_applicability(input, error)
      if (allocated(error)) then
         error%message = place//error%message
         return
      end if
      input%case%has_free_tolerance = .not. input%is_given(find_key(list%keys, 'tolerance'))
      if (leaves_heights_to_plan(input, list)) input%case%accuracy = accuracy_of_heights
      if (input%case%accuracy > 0) call choose_for_accuracy(input, list)
      call complete_case(input%case, place, error)
   end subroutine complete_input

   !> Whether measured heights march through a flooded elliptical contact that the fitted scheme supports, and the input
   !> leaves grid, time step, scheme and tolerances to the plan.
   logical function leaves_heights_to_plan(input, list) result(leaves)
      type(case_input_t), intent(in) :: input
      type(key_list_t), intent(in) :: list
      character(len=key_length), parameter :: choices(8) = [character(len=key_length) :: 'accuracy', 'cells_x', &
         'cells_y', 'time_step_over_cell', 'scheme', 'method', 'tolerance', 'step_tolerance']
      integer :: n
      associate (case => input%case, waves => input%case%surfaces())
         leaves = case%has_heights() .and. .not. any(waves%is_wavy()) .and. case%edges == 'flooded' .and. &
                  case%radius_ratio_d > 0 .and. .not. case%effects%touching%is_given() .and. &
                  .not. case%effects%refuse(by_fitted_scheme) .and. &
                  .not. any([(input%is_given(find_key(list%keys, choices(n))), n=1, size(choices))])
      end associate
   end function leaves_heights_to_plan

   !> S = 1 + ratio/2 from whichever is given, theory section 1; to twelve decimals, so that 0.98 and a ratio of -0.04
   !> are the same case.
   subroutine settle_slip(input, list, error)
      type(case_input_t), intent(inout) :: input
      type(key_list_t), intent(in) :: list
      type(error_t), allocatable, intent(inout) :: error
      real(dp), parameter :: decimals = 1e12_dp

      associate (s => input%case%slip_parameter, ratio => input%case%slide_to_roll_ratio)
         if (input%is_given(find_key(list%keys, 'slide_to_roll_ratio'))) then
            if (input%is_given(find_key(list%keys, 'slip_parameter'))) then
               call raise(error, '&conditions slip_parameter = '//to_text(s, 6)//' and slide_to_roll_ratio = '// &
                  to_text(ratio, 6)//' are two words for one speed: give one of the two')
               return
            end if
            s = anint(decimals*(1 + ratio/2))/decimals
         end if
         ratio = anint(decimals*2*(s - 1))/decimals
      end associate
   end subroutine settle_slip

   !> The conditions are given by the three numbers, all of them, or by dimensional data, from which M, L and D follow.
   subroutine settle_conditions(input, list, error)
      type(case_input_t), intent(inout) :: input
      type(key_list_t), intent(in) :: list
      type(error_t), allocatable, intent(inout) :: error
      type(conditions_t) :: conditions
      logical :: has_data(size(data_keys)), has_moes(size(moes_keys))
      integer :: i

      has_data = [(input%is_given(find_key(list%keys, data_keys(i))), i=1, size(data_keys))]
      has_moes = [(input%is_given(find_key(list%keys, moes_keys(i))), i=1, size(moes_keys))]
      input%case%is_dimensional = any(has_data)
      if (any(has_data) .and. any(has_moes)) then
         call raise(error, '&conditions gives both load_parameter_m, lubricant_parameter_l or radius_ratio_d and '// &
                    'dimensional data (radius_x_m, ...): give one of the two')
      else if (any(has_data)) then
         call case_conditions(input%case, conditions, error)
      else if (.not. all(has_moes)) then
         call raise(error, '&conditions '//trim(moes_keys(findloc(has_moes, .false., 1)))//' is missing: give '// &
                    'load_parameter_m, lubricant_parameter_l and radius_ratio_d, or dimensional data (radius_x_m, '// &
                    'radius_y_m, reduced_modulus_pa, load_n, mean_speed_m_per_s, viscosity_pa_s; of a line contact '// &
                    'load_n_per_m in place of radius_y_m and load_n)')
      end if
   end subroutine settle_conditions

   !> The wavelength for which f(r) V has the value asked for.
   subroutine choose_wavelength(input, list, error)
      type(case_input_t), intent(inout) :: input
      type(key_list_t), intent(in) :: list
      type(error_t), allocatable, intent(inout) :: error
      type(conditions_t) :: conditions
      real(dp) :: factor

      call case_conditions(input%case, conditions, error)
      if (allocated(error)) return
      factor = anisotropy_factor(merge(0.0_dp, 1.0_dp, input%case%orientation == 'longitudinal'), &
                                 merge(0.0_dp, 1.0_dp, input%case%orientation == 'transverse'))
      input%case%wavelength_over_a = input%f_v/(factor*wave_parameter_v(conditions, 1.0_dp))
      input%is_given(find_key(list%keys, 'wavelength_over_a')) = .true.
   end subroutine choose_wavelength

   !> Keys that `accuracy` chooses where they are not given: cells and time step by the plan, tolerances well below the
   !> accuracy, amplitudes that respond like small waves. Measured: a step tolerance of 1e-3 leaves up to 2e-3 of Ad/Ai,
   !> most for long waves; steady states are exact to a tenth of their tolerance or better.
   subroutine choose_for_accuracy(input, list)
      type(case_input_t), intent(inout) :: input
      type(key_list_t), intent(in) :: list
      real(dp), parameter :: loosest_step_tolerance = 1e-3_dp
      real(dp), parameter :: share_of_amplitude = 0.02_dp  !! share of the accuracy
      type(case_t) :: usual

      associate (case => input%case)
         if (is_free('cells_x')) case%cells_x = 0
         if (is_free('cells_y')) case%cells_y = 0
         if (is_free('time_step_over_cell')) case%time_step_over_cell = 0
         ! with truncated edges cases are as before errors had parts
         if (is_free('settling_periods') .and. case%edges == 'flooded') case%settling_periods = 2
         if (is_free('step_tolerance')) case%step_tolerance = min(loosest_step_tolerance, case%accuracy* &
            merge(0.05_dp, 0.1_dp, case%edges == 'truncated'))
         if (is_free('tolerance')) case%tolerance = min(usual%tolerance, 1e-3_dp*case%accuracy)
         if (case%edges == 'truncated' .or. case%response == 'harmonic' .or. .not. case%has_linear_range()) return
         call choose_amplitude(case%roughness_t, 'amplitude_over_film')
         call choose_amplitude(case%effects%second%roughness, 'amplitude_over_film_2')
      end associate

   contains

      !> Amplitude of waves in time, reduced to two digits where larger waves respond unlike small ones.
      subroutine choose_amplitude(waves, key)
         type(roughness_t), intent(inout) :: waves
         character(len=*), intent(in) :: key
         real(dp), parameter :: rounding = 1e-9_dp
         type(roughness_t) :: both(2)
         real(dp) :: largest, unit

         both = input%case%surfaces()
         if (.not. waves%is_wavy() .or. waves%amplitude_m > 0 .or. .not. is_free(key)) return
         largest = (1 + rounding)*linear_amplitude(input%case, waves%surface, &
                                                   share_of_amplitude*input%case%accuracy/count(both%is_wavy()))
         if (largest >= waves%amplitude_over_film) return
         unit = 10.0_dp**(1 - floor(log10(largest)))
         waves%amplitude_over_film = floor(largest*unit)/unit
         waves%is_amplitude_chosen = .true.
      end subroutine choose_amplitude

      logical function is_free(key)
         character(len=*), intent(in) :: key
         is_free = .not. input%is_given(find_key(list%keys, key))
      end function is_free

   end subroutine choose_for_accuracy

end module ehlwave_input_completion
