!> Heat of a case: required data, and refusals.
module ehlwave_heat_check_plan
   use ehlwave_case_definition, only: case_t
   use ehlwave_errors, only: error_t, raise
   use ehlwave_oil, only: doolittle, oil_t, tabulated
   use ehlwave_text, only: to_text
   implicit none (type, external)
   private
   public :: check_heat, heat_of_oil

contains

   !> Give the thermal data to the laws of the oil.
   pure subroutine heat_of_oil(case)
      type(case_t), intent(inout) :: case
      case%oil%beta_per_k = case%effects%heat%data%viscosity_temperature_per_k
      case%oil%expansion_per_k = case%effects%heat%data%oil_expansion_per_k
   end subroutine heat_of_oil

   !> Refuse a case with heat that lacks data, or whose temperatures are far from the smooth contact's.
   subroutine check_heat(case, error)
      type(case_t), intent(in) :: case
      type(error_t), allocatable, intent(inout) :: error
      character(len=:), allocatable :: missing

      if (allocated(error) .or. .not. case%effects%heat%data%is_given()) return
      associate (heat => case%effects%heat%data, oil => case%oil)
         missing = ''
         if (.not. heat%oil_conductivity_w_per_m_k > 0) missing = '&heat oil_conductivity_w_per_m_k'
         if (.not. heat%oil_heat_capacity_j_per_kg_k > 0) missing = '&heat oil_heat_capacity_j_per_kg_k'
         if (.not. heat%oil_density_kg_per_m3 > 0) missing = '&heat oil_density_kg_per_m3'
         if (.not. oil%temperature_k > 0) missing = '&lubricant temperature_k'
         if (.not. min(heat%body(1)%conductivity_w_per_m_k, heat%body(1)%density_kg_per_m3, &
                       heat%body(1)%heat_capacity_j_per_kg_k) > 0) missing = '&heat body_conductivity_w_per_m_k, '// &
            'body_density_kg_per_m3 or body_heat_capacity_j_per_kg_k'
         if (missing /= '') then
            call raise(error, missing//' is missing: &heat needs it')
         else if (.not. case%is_dimensional) then
            call raise(error, '&heat needs the dimensions of the contact: give &conditions by dimensional data '// &
               '(radius_x_m, ...) in place of load_parameter_m, lubricant_parameter_l and radius_ratio_d')
         else if (abs(case%slip_parameter - 1) > 1) then
            call raise(error, '&conditions slip_parameter = '//to_text(case%slip_parameter, 6)//' moves surfaces '// &
               'against each other: &heat takes values from 0 to 2')
         else if (.not. abs(case%slip_parameter - 1) < 1 .and. &
                  (heat%follows_waves() .or. .not. case%radius_ratio_d > 0)) then
            call raise(error, '&conditions slip_parameter = '//to_text(case%slip_parameter, 6)//' has a surface at '// &
               "rest: line contacts and wave_temperatures = 'carried' take values between 0 and 2, since a body at "// &
               'rest under a line grows warmer without end')
         else if (oil%viscosity_law == doolittle .and. .not. &
                  max(heat%oil_expansion_per_k, abs(oil%doolittle%occupied_rate_per_k)) > 0) then
            call raise(error, "&lubricant viscosity_law = '"//doolittle//"' takes the temperature from its volume: "// &
               'give &heat oil_expansion_per_k, or &lubricant doolittle_occupied_rate_per_k, too')
         else if (.not. oil%takes_beta() .and. heat%viscosity_temperature_per_k > 0) then
            call raise(error, "&heat viscosity_temperature_per_k belongs to laws without temperature of their own: "// &
               "remove it, since viscosity_law = '"//trim(oil%viscosity_law)//"' has its own")
         else if (has_one_temperature(oil)) then
            call raise(error, '&lubricant viscosity_table has one temperature: &heat needs measurements at two '// &
               'or more (column temperature_k)')
         else if (oil%temperature_k <= 150 .or. oil%temperature_k > 700) then
            call raise(error, '&lubricant temperature_k = '//to_text(oil%temperature_k, 6)//' is no temperature of '// &
               'an oil in kelvin: write a value between 150 and 700')
         else if (case%has_heights()) then
            call raise(error, '&heat has the temperatures of the smooth contact, which a measured surface changes: '// &
               'remove &surface and &surface2, or &heat')
         else if (merge(abs(case%load_factor - 1), case%end_time, case%is_wavy()) > 0) then
            call raise(error, '&heat has the temperatures of the steady load: remove &dynamics load_factor and a '// &
               '&dynamics end_time without waves, or &heat')
         else if (case%is_wavy() .and. case%response == 'periodic') then
            call raise(error, "&waviness response = 'periodic' does not take &heat: use 'transient' or 'harmonic'")
         else if (case%effects%starvation%is_given() .or. case%effects%starvation%oil_profile /= '') then
            call raise(error, '&heat takes a gap that is full of oil: remove &inlet oil_over_flooded, oil_layer_m '// &
               'and oil_profile, or &heat')
         else if (heat%follows_waves() .and. .not. (case%is_wavy() .and. case%moves() .and. case%marches())) then
            call raise(error, "&heat wave_temperatures = 'carried' is for waves that move in time: give &waviness "// &
               "transverse, isotropic or custom waves with response = 'transient' or 'both', or remove it")
         else if (case%method == 'fas') then
            call raise(error, "&solver method = 'fas' does not take &heat: use 'newton' or 'petsc'")
         end if
      end associate
   end subroutine check_heat

   !> Whether the viscosity of an oil was measured at a single temperature.
   pure logical function has_one_temperature(oil)
      type(oil_t), intent(in) :: oil
      has_one_temperature = oil%viscosity_law == tabulated
      if (has_one_temperature) has_one_temperature = oil%measured%column('temperature_k') == 0
   end function has_one_temperature

end module ehlwave_heat_check_plan
