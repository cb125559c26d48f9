!> The lubricant of a case: its mandatory keys, and its laws in the form that the equations use.
module ehlwave_case_lubricant
   use ehlwave_carreau_law, only: new_carreau_law
   use ehlwave_case_definition, only: case_t
   use ehlwave_case_files, only: case_file_t, case_files
   use ehlwave_case_keys, only: case_key_list
   use ehlwave_conditions, only: conditions_t
   use ehlwave_density_law, only: density_law_t
   use ehlwave_errors, only: error_t, raise
   use ehlwave_flow_law, only: flow_law_t
   use ehlwave_key_applicability, only: check_oil
   use ehlwave_kinds, only: dp
   use ehlwave_number_file, only: read_number_table
   use ehlwave_number_table, only: number_table_t
   use ehlwave_rheology, only: new_rheology, rheology_t
   use ehlwave_text, only: to_text
   use ehlwave_viscosity_law, only: viscosity_law_t
   implicit none (type, external)
   private
   public :: case_lubricant, check_lubricant, extrapolation_text, pressure_viscosity

   real(dp), parameter :: largest_difference = 0.01_dp   ! relative, of two values of the same viscosity

contains

   !> Read the file of the oil, unless that is done. Refuse a law that lacks its parameters or contradicts the
   !> conditions, or a flow law without data to make it dimensionless.
   subroutine check_lubricant(case, error)
      type(case_t), intent(inout) :: case
      type(error_t), allocatable, intent(inout) :: error
      character(len=:), allocatable :: what

      call check_oil(case, error)
      if (.not. allocated(error)) call check_viscosity(case, error)
      if (allocated(error) .or. case%is_dimensional) return
      if (case%oil%is_newtonian() .and. .not. case%oil%shear_limit_over_pressure > 0) return
      what = "flow_law = '"//trim(case%oil%flow_law)//"'"
      if (case%oil%is_newtonian()) what = 'shear_limit_over_pressure'
      if (.not. case%data%reduced_modulus_pa > 0) then
         call raise(error, '&conditions reduced_modulus_pa is missing: &lubricant '//what//' with '// &
            "load_parameter_m, lubricant_parameter_l and radius_ratio_d needs E', since its stress "// &
            "enters by E' times it")
      else if (.not. case%lubricant_parameter_l > 0) then
         call raise(error, '&conditions lubricant_parameter_l = 0 leaves the pressure unknown, and &lubricant '// &
            what//" needs it: give lubricant_parameter_l above 0 (with viscosity_law = "// &
            "'isoviscous' the viscosity is constant all the same), or dimensional data")
      end if
   end subroutine check_lubricant

   !> Read the measured viscosities of an oil that has some. Refuse such of which no law can be made, or which
   !> contradict the viscosity of the case.
   subroutine check_viscosity(case, error)
      type(case_t), intent(inout) :: case
      type(error_t), allocatable, intent(inout) :: error
      class(viscosity_law_t), allocatable :: law
      character(len=:), allocatable :: key

      key = ''
      if (case%oil%viscosity_file /= '') key = file_key(case, trim(case%oil%viscosity_file))
      associate (oil => case%oil)
         if (key == '') then
            oil%measured = number_table_t()
         else if (.not. oil%measured%is_from(trim(oil%viscosity_file))) then
            call read_number_table(trim(oil%viscosity_file), oil%measured, error)
         end if
         if (.not. allocated(error)) call oil%make_viscosity(law, error)
      end associate
      if (allocated(error)) then
         if (key /= '') error%message = key//': '//error%message
      else if (case%is_dimensional .and. law%ambient_pa_s > 0) then
         if (abs(case%data%viscosity_pa_s/law%ambient_pa_s - 1) <= largest_difference) return
         if (.not. case%data%viscosity_pa_s > 0) return   ! the conditions report the missing key
         call raise(error, key//" = '"//trim(case%oil%viscosity_file)//"' has "//to_text(law%ambient_pa_s, 6)// &
                    ' Pa s at ambient pressure, which &conditions viscosity_pa_s = '// &
                    to_text(case%data%viscosity_pa_s, 6)//' contradicts: give the same')
      end if
   end subroutine check_viscosity

   !> '&group key' of the file of a path, '' where the case reads no such file.
   function file_key(case, path) result(key)
      type(case_t), intent(in) :: case
      character(len=*), intent(in) :: path
      character(len=:), allocatable :: key
      type(case_file_t), allocatable :: files(:)
      integer :: i

      allocate (files, source=case_files(case_key_list(case)))
      key = ''
      do i = 1, size(files)
         if (files(i)%path == path) key = files(i)%key
      end do
   end function file_key

   !> A warning where pressures go beyond those that the viscosity law is known up to, else ''.
   function extrapolation_text(case, rheology, pressure) result(text)
      type(case_t), intent(in) :: case
      type(rheology_t), intent(in) :: rheology
      real(dp), intent(in) :: pressure   !! largest P
      character(len=:), allocatable :: text

      text = ''
      if (pressure > rheology%largest_pressure()) text = 'pressures reach '//gigapascals(pressure)// &
         " and viscosity_law = '"//trim(case%oil%viscosity_law)//"' is known up to "// &
         gigapascals(rheology%largest_pressure())//': beyond that it is extrapolated'

   contains

      function gigapascals(p) result(text)
         real(dp), intent(in) :: p   !! P
         character(len=:), allocatable :: text
         text = to_text(1e-9_dp*rheology%in_pascals(p), 4)//' GPa'
      end function gigapascals

   end function extrapolation_text

   !> Pressure-viscosity coefficient alpha of the case, 1/Pa.
   real(dp) function pressure_viscosity(case)
      type(case_t), intent(in) :: case
      class(viscosity_law_t), allocatable :: law
      type(error_t), allocatable :: ignored
      call case%oil%make_viscosity(law, ignored)
      pressure_viscosity = law%coefficient()
   end function pressure_viscosity

   !> The oil of a case under its conditions. Laws are made by subroutines: results of functions of an abstract type
   !> would not be freed by some compilers.
   function case_lubricant(case, conditions) result(rheology)
      type(case_t), intent(in) :: case
      type(conditions_t), intent(in) :: conditions
      type(rheology_t) :: rheology
      class(viscosity_law_t), allocatable :: viscosity
      class(density_law_t), allocatable :: density
      class(flow_law_t), allocatable :: flow
      type(error_t), allocatable :: ignored

      call case%oil%make_viscosity(viscosity, ignored)
      call case%oil%make_density(density)
      rheology = new_rheology(viscosity, density, conditions%hertz_pressure_pa)
      associate (modulus_pa => conditions%data%reduced_modulus_pa, limit => case%oil%shear_limit_over_pressure)
         if (.not. case%oil%is_newtonian()) then
            call case%oil%make_flow(flow)
            call rheology%use_flow(flow, modulus_pa*case%oil%stress_pa())
         else if (limit > 0) then
            call rheology%use_flow(new_carreau_law(1.0_dp), modulus_pa*limit*conditions%hertz_pressure_pa)
         end if
         if (limit > 0) call rheology%use_limit(modulus_pa*limit, case%oil%shear_limit_width)
      end associate
   end function case_lubricant

end module ehlwave_case_lubricant
