!> The inputs by which the results of a case are differentiated, and the case as it would be with others.
!>
!> A variable is a key with a number that enters the equations: conditions, oil, layer, waves. The case is completed
!> anew for each variant, so that all that follows from a key changes with it. Grid and domain stay as in the plan, in
!> units of a and b.
module ehlwave_case_variables
   use ehlwave_case_completion, only: case_conditions
   use ehlwave_case_definition, only: case_t
   use ehlwave_case_files, only: case_file_t, case_files
   use ehlwave_case_key, only: key_length, key_t, key_value_t, number_kind
   use ehlwave_case_keys, only: case_key_list, take_values
   use ehlwave_case_lubricant, only: case_lubricant
   use ehlwave_case_roughness, only: complete_roughness
   use ehlwave_contact_variant, only: contact_variable_t, contact_variant_t
   use ehlwave_errors, only: error_t
   use ehlwave_oil_offer_plan, only: read_oil
   use ehlwave_key_bounds, only: is_allowed
   use ehlwave_key_list, only: key_list_t
   use ehlwave_kinds, only: dp
   use ehlwave_surface_plan, only: plan_surfaces
   use ehlwave_surfaces, only: surfaces_t
   implicit none (type, external)
   private
   public :: case_variables, variable_names

   real(dp), parameter :: step = 1e-5_dp   !! step in the logarithm of a key

   character(len=*), parameter :: slide = 'slide_to_roll_ratio'
   character(len=*), parameter :: steady_groups(4) = [character(len=10) :: 'conditions', 'lubricant', 'inlet', &
      'touching']
   !> Keys of marches alone, and of the temperatures of marches.
   character(len=*), parameter :: not_steady(3) = [character(len=17) :: 'oil_change_factor', 'oil_change_start', &
      'oil_change_length']
   character(len=*), parameter :: wave_keys(4) = [character(len=19) :: 'wavelength_over_a', 'wavelength_x_over_a', &
      'wavelength_y_over_a', 'natural_frequency']
   character(len=*), parameter :: resting_keys(4) = [character(len=19) :: wave_keys(:3), 'amplitude_m']
   character(len=*), parameter :: periodic_keys(6) = [character(len=19) :: wave_keys, 'amplitude_m', &
      'amplitude_over_film']
   character(len=*), parameter :: speed = 'mean_speed_m_per_s'

contains

   !> Names of the variables of a completed case.
   function variable_names(case) result(names)
      type(case_t), intent(in) :: case
      character(len=key_length), allocatable :: names(:)
      type(key_list_t) :: list
      integer :: k
      list = case_key_list(case)
      allocate (names, source=pack(list%keys(:list%count)%name, &
                                   [(is_variable(case, list%keys(k), list%values(k)), k=1, list%count)]))
   end function variable_names

   !> The variables with their variants. One that has no neighbours on either side has no variants.
   function case_variables(case) result(variables)
      type(case_t), intent(in) :: case
      type(contact_variable_t), allocatable :: variables(:)
      type(key_list_t) :: list
      integer :: k

      list = case_key_list(case)
      allocate (variables(0))
      do k = 1, list%count
         if (is_variable(case, list%keys(k), list%values(k))) variables = [variables, variable_of(case, list, k)]
      end do
   end function case_variables

   !> Whether results depend smoothly on a key of a case.
   logical function is_variable(case, key, value)
      type(case_t), intent(in) :: case
      type(key_t), intent(in) :: key
      type(key_value_t), intent(in) :: value

      is_variable = value%kind == number_kind .and. key%applies .and. key%counts .and. is_allowed(key, value)
      if (.not. is_variable) return
      is_variable = abs(value%number) > 0 .and. (key%is_written .or. key%name == slide)
      if (any(key%group == steady_groups)) then
         is_variable = is_variable .and. .not. any(key%name == not_steady)
         if (key%name == speed) is_variable = is_variable .and. .not. case%effects%touching%data%seeks_speed()
      else if (case%responds()) then
         is_variable = is_variable .and. any(key%name == wave_keys)
      else if (case%repeats()) then
         is_variable = is_variable .and. any(key%name == periodic_keys)
      else
         is_variable = is_variable .and. case%touches_at_rest() .and. any(key%name == resting_keys)
      end if
   end function is_variable

   !> A key of the list as a variable: centred, or to one side where the other is outside the model.
   function variable_of(case, list, k) result(variable)
      type(case_t), intent(in) :: case
      type(key_list_t), intent(in) :: list
      integer, intent(in) :: k
      type(contact_variable_t) :: variable
      type(error_t), allocatable :: error
      integer :: i, n
      integer, parameter :: sides(3) = [0, -1, 1]

      variable%name = list%keys(k)%name
      variable%is_of_waves = (case%responds() .or. case%repeats()) .and. .not. any(list%keys(k)%group == steady_groups)
      do n = 1, size(sides)
         call variable%place_variants(step, sides(n))
         do i = 1, size(variable%variants)
            call vary(case, list, k, variable%variants(i), error)
            if (allocated(error)) exit
         end do
         if (.not. allocated(error)) exit
         deallocate (error, variable%variants)
      end do
      if (.not. allocated(variable%variants)) return
      associate (kappa => variable%variants%conditions%elliptic%kappa)
         variable%changes_kernel = maxval(kappa) > minval(kappa)
      end associate
   end function variable_of

   !> The case with another value of a key. Fails where that is outside the model.
   subroutine vary(case, list, k, variant, error)
      type(case_t), intent(in) :: case
      type(key_list_t), intent(in) :: list
      integer, intent(in) :: k
      type(contact_variant_t), intent(inout) :: variant   !! its place is set
      type(error_t), allocatable, intent(inout) :: error
      type(case_t) :: other
      type(case_file_t), allocatable :: files(:)
      type(key_list_t) :: values
      type(surfaces_t) :: surfaces

      other = case
      values = list
      values%values(k)%number = exp(variant%place)*values%values(k)%number
      call take_values(values, other)
      if (list%keys(k)%name == slide) other%slip_parameter = 1 + other%slide_to_roll_ratio/2
      call complete_roughness(other, error)
      if (.not. allocated(error)) call case_conditions(other, variant%conditions, error)
      if (allocated(error)) return
      variant%rheology = case_lubricant(other, variant%conditions)
      files = case_files(case_key_list(other))
      call read_oil(other%effects%starvation, variant%conditions, variant%inlet, files, error)
      variant%touching = other%effects%touching%data
      if (allocated(error) .or. .not. (case%responds() .or. case%repeats() .or. case%touches_at_rest())) return
      call plan_surfaces(other, variant%conditions, surfaces, files, error)
      if (allocated(error)) return
      variant%waves = surfaces%list
      variant%natural_frequency = other%natural_frequency
   end subroutine vary

end module ehlwave_case_variables
