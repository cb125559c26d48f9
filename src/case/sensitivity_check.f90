!> Cases that `&output sensitivities` refuses.
module ehlwave_sensitivity_check
   use ehlwave_case_definition, only: case_t
   use ehlwave_errors, only: error_t, raise
   use ehlwave_roughness, only: roughness_t
   implicit none (type, external)
   private
   public :: check_sensitivities

contains

   !> Refuse sensitivities of results that are not differentiated.
   subroutine check_sensitivities(case, error)
      type(case_t), intent(in) :: case            !! completed
      type(error_t), allocatable, intent(inout) :: error
      type(roughness_t) :: waves(2)

      if (allocated(error) .or. .not. case%sensitivities) return
      waves = case%surfaces()
      if (case%effects%heat%is_given()) then
         call raise(error, '&output sensitivities are derivatives of an isothermal contact, as the march of the '// &
            'temperatures has no transposed march: remove them, or &heat')
      else if (case%has_heights()) then
         call raise(error, '&output sensitivities: a march of a measured surface is not differentiated: remove '// &
            'them, or &surface and &surface2')
      else if (case%end_time > 0) then
         call raise(error, '&output sensitivities: marches in time are not differentiated: remove them, or '// &
            '&dynamics end_time')
      else if (case%is_wavy() .and. .not. (case%responds() .or. case%repeats() .or. case%touches_at_rest())) then
         call raise(error, "&output sensitivities with &waviness response = '"//trim(case%response)// &
            "': marches in time and standing patterns are not differentiated: set response = 'harmonic', whose "// &
            'Ad/Ai is, or remove sensitivities')
      else if (case%radius_ratio_d <= 0 .and. any(waves%wavelength_y_over_a > 0)) then
         call raise(error, '&output sensitivities: of line contacts only responses to transverse waves are '// &
            "differentiated: set orientation = 'transverse', or remove sensitivities")
      end if
   end subroutine check_sensitivities

end module ehlwave_sensitivity_check
