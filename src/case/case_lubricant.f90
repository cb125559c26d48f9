!> The lubricant of a case: its laws from its keys.
module ehlwave_case_lubricant
   use ehlwave_carreau_law, only: new_carreau_law
   use ehlwave_case_definition, only: case_t, is_special_law
   use ehlwave_conditions, only: conditions_t
   use ehlwave_doolittle_law, only: doolittle_law_t
   use ehlwave_errors, only: error_t, raise
   use ehlwave_eyring_law, only: eyring_law_t
   use ehlwave_key_applicability, only: check_needed
   use ehlwave_kinds, only: dp
   use ehlwave_rheology, only: density_constant, density_dowson_higginson, new_rheology, rheology_t, viscosity_barus, &
      viscosity_constant, viscosity_roelands
   use ehlwave_viscosity_law, only: film_forming_coefficient, viscosity_law_t
   implicit none (type, external)
   private
   public :: case_lubricant, check_lubricant, pressure_viscosity

contains

   !> Refuse a law that lacks its parameters, or a flow law that lacks what makes it dimensionless.
   subroutine check_lubricant(case, error)
      type(case_t), intent(in) :: case
      type(error_t), allocatable, intent(inout) :: error

      call check_needed(case, 'lubricant', error)
      if (allocated(error) .or. case%flow_law == 'newtonian' .or. case%is_dimensional) return
      if (.not. case%data%reduced_modulus_pa > 0) then
         call raise(error, "&conditions reduced_modulus_pa is missing: &lubricant flow_law = '"//trim(case%flow_law)// &
                    "' with load_parameter_m, lubricant_parameter_l and radius_ratio_d needs E', since its stress enters by "// &
                    "E' times it")
      else if (.not. case%lubricant_parameter_l > 0) then
         call raise(error, "&conditions lubricant_parameter_l = 0 leaves the pressure unknown, and &lubricant flow_law = '"// &
                    trim(case%flow_law)//"' needs it: give lubricant_parameter_l above 0 (with viscosity_law = 'isoviscous' "// &
                    'the viscosity is constant all the same), or dimensional data')
      end if
   end subroutine check_lubricant

   !> Pressure-viscosity coefficient alpha of the case, 1/Pa: as given, or film-forming coefficient of a law with parameters.
   real(dp) function pressure_viscosity(case)
      type(case_t), intent(in) :: case
      class(viscosity_law_t), allocatable :: law
      pressure_viscosity = case%pressure_viscosity_per_pa
      if (.not. is_special_law(case%viscosity_law)) return
      call choose_viscosity(case, law)
      pressure_viscosity = film_forming_coefficient(law)
   end function pressure_viscosity

   !> Density, viscosity and flow law. With L = 0 the pressure in pascal is unknown and the density law has nothing to work on.
   function case_lubricant(case, conditions) result(rheology)
      type(case_t), intent(in) :: case
      type(conditions_t), intent(in) :: conditions
      type(rheology_t) :: rheology
      class(viscosity_law_t), allocatable :: law
      integer :: density, viscosity

      viscosity = viscosity_roelands
      if (case%viscosity_law == 'barus') viscosity = viscosity_barus
      if (case%viscosity_law == 'isoviscous') viscosity = viscosity_constant
      density = density_dowson_higginson
      if (case%density_law == 'incompressible' .or. conditions%hertz_pressure_pa <= 0) density = density_constant
      rheology = new_rheology(viscosity, density, conditions%alphabar, case%roelands_index, conditions%hertz_pressure_pa)
      if (is_special_law(case%viscosity_law)) then
         call choose_viscosity(case, law)
         call rheology%use_viscosity(law)
      end if
      if (case%density_law == 'tait' .and. conditions%hertz_pressure_pa > 0) call rheology%use_density(case%tait)
      associate (modulus_pa => conditions%data%reduced_modulus_pa)
         select case (case%flow_law)
         case ('eyring')
            call rheology%use_flow(eyring_law_t(), modulus_pa*case%eyring_stress_pa, case%slip_parameter)
         case ('carreau')
            call rheology%use_flow(new_carreau_law(case%carreau_exponent), modulus_pa*case%carreau_modulus_pa, &
                                   case%slip_parameter)
         end select
      end associate
   end function case_lubricant

   !> The viscosity law with the parameters of the case.
   subroutine choose_viscosity(case, law)
      type(case_t), intent(in) :: case             !! with a law that has parameters of its own
      class(viscosity_law_t), allocatable, intent(out) :: law
      type(doolittle_law_t) :: doolittle

      select case (case%viscosity_law)
      case ('mcewen'); law = case%mcewen
      case ('yasutomi'); law = case%yasutomi
      case ('doolittle')
         doolittle = case%doolittle
         doolittle%tait = case%tait
         law = doolittle
      end select
   end subroutine choose_viscosity

end module ehlwave_case_lubricant
