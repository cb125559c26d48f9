!> The lubricant of a case: what it needs, and its laws as the equations take them.
module ehlwave_case_lubricant
   use ehlwave_case_definition, only: case_t
   use ehlwave_conditions, only: conditions_t
   use ehlwave_errors, only: error_t, raise
   use ehlwave_key_applicability, only: check_needed
   use ehlwave_kinds, only: dp
   use ehlwave_rheology, only: new_rheology, rheology_t
   use ehlwave_viscosity_law, only: viscosity_law_t
   implicit none (type, external)
   private
   public :: case_lubricant, check_lubricant, pressure_viscosity

contains

   !> Refuse a law that lacks its parameters, or a flow law that lacks what makes it dimensionless.
   subroutine check_lubricant(case, error)
      type(case_t), intent(in) :: case
      type(error_t), allocatable, intent(inout) :: error

      call check_needed(case, 'lubricant', error)
      if (allocated(error) .or. case%oil%is_newtonian() .or. case%is_dimensional) return
      if (.not. case%data%reduced_modulus_pa > 0) then
         call raise(error, "&conditions reduced_modulus_pa is missing: &lubricant flow_law = '"//trim(case%oil%flow_law)// &
                    "' with load_parameter_m, lubricant_parameter_l and radius_ratio_d needs E', since its stress enters by "// &
                    "E' times it")
      else if (.not. case%lubricant_parameter_l > 0) then
         call raise(error, "&conditions lubricant_parameter_l = 0 leaves the pressure unknown, and &lubricant flow_law = '"// &
                    trim(case%oil%flow_law)//"' needs it: give lubricant_parameter_l above 0 (with viscosity_law = "// &
                    "'isoviscous' the viscosity is constant all the same), or dimensional data")
      end if
   end subroutine check_lubricant

   !> Pressure-viscosity coefficient alpha of the case, 1/Pa.
   real(dp) function pressure_viscosity(case)
      type(case_t), intent(in) :: case
      class(viscosity_law_t), allocatable :: law
      allocate (law, source=case%oil%viscosity())
      pressure_viscosity = law%coefficient()
   end function pressure_viscosity

   !> The oil of a case under its conditions.
   function case_lubricant(case, conditions) result(rheology)
      type(case_t), intent(in) :: case
      type(conditions_t), intent(in) :: conditions
      type(rheology_t) :: rheology
      rheology = new_rheology(case%oil%viscosity(), case%oil%density(), conditions%hertz_pressure_pa)
      if (.not. case%oil%is_newtonian()) &
         call rheology%use_flow(case%oil%flow(), conditions%data%reduced_modulus_pa*case%oil%stress_pa())
   end function case_lubricant

end module ehlwave_case_lubricant
