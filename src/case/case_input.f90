!> The input of one case: values as the user gives them, read from a namelist file and checked.
module ehlwave_case_input
   use ehlwave_case_completion, only: complete_case
   use ehlwave_case_definition, only: case_t, name_length, orientations, path_length
   use ehlwave_errors, only: error_t, raise
   use ehlwave_kinds, only: dp
   use ehlwave_namelist, only: namelist_t
   use ehlwave_text, only: to_text
   implicit none (type, external)
   private
   public :: read_case, read_case_groups

contains


   !> Read a case file, refuse what is unknown, missing or meaningless.
   subroutine read_case(path, case, error)
      character(len=*), intent(in) :: path
      type(case_t), intent(out) :: case
      type(error_t), allocatable, intent(out) :: error
      type(namelist_t) :: file

      call file%load(path, error)
      call read_case_groups(file, case, error)
      call file%check_all_used(error)
      if (.not. allocated(error)) call complete_case(case, path//': ', error)
   end subroutine read_case

   !> Read all groups of a case that a file has; what it does not have keeps its default.
   subroutine read_case_groups(file, case, error)
      class(namelist_t), intent(inout) :: file
      type(case_t), intent(inout) :: case
      type(error_t), allocatable, intent(inout) :: error
      character(len=:), allocatable :: file_group

      call read_conditions(file, case, error)

      file_group = 'lubricant'
      call file%get(file_group, 'pressure_viscosity_per_pa', case%pressure_viscosity_per_pa, error, above=0.0_dp)
      call file%get(file_group, 'roelands_index', case%roelands_index, error, above=0.0_dp, maximum=2.0_dp)
      call file%get_fixed(file_group, 'viscosity_law', case%viscosity_law, error, &
                          [character(len=name_length) :: 'roelands', 'barus', 'isoviscous'])
      call file%get_fixed(file_group, 'density_law', case%density_law, error, &
                          [character(len=name_length) :: 'dowson_higginson', 'incompressible'])

      file_group = 'waviness'
      call file%get_fixed(file_group, 'orientation', case%orientation, error, orientations)
      call file%get(file_group, 'wavelength_over_a', case%wavelength_over_a, error, above=0.0_dp)
      call file%get(file_group, 'wavelength_x_over_a', case%wavelength_x_over_a, error, minimum=0.0_dp)
      call file%get(file_group, 'wavelength_y_over_a', case%wavelength_y_over_a, error, minimum=0.0_dp)
      call file%get(file_group, 'oblique', case%oblique, error)
      call file%get(file_group, 'amplitude_over_film', case%amplitude_over_film, error, above=0.0_dp, maximum=1.0_dp)
      call file%get_fixed(file_group, 'response', case%response, error, &
                          [character(len=name_length) :: 'transient', 'harmonic', 'both'])

      call read_surface_group(file, case, error)

      file_group = 'grid'
      call file%get(file_group, 'x_min', case%x_min, error, maximum=-1.0_dp)
      call file%get(file_group, 'x_max', case%x_max, error, minimum=1.0_dp)
      call file%get(file_group, 'y_max', case%y_max, error, minimum=1.0_dp)
      call file%get(file_group, 'cells_x', case%cells_x, error, minimum=0, maximum=8192)
      call file%get(file_group, 'cells_y', case%cells_y, error, minimum=0, maximum=8192)
      call file%get(file_group, 'largest_cells', case%largest_cells, error, minimum=64, maximum=8192)
      call file%get_fixed(file_group, 'domain', case%domain, error, [character(len=name_length) :: 'auto', 'whole'])
      if (file%has(file_group, 'domain')) case%across = 'domain'
      if (file%has(file_group, 'y_max')) case%across = 'y_max'
      if (file%has(file_group, 'cells_y')) case%across = 'cells_y'

      file_group = 'solver'
      call file%get(file_group, 'tolerance', case%tolerance, error, minimum=1e-12_dp, maximum=0.1_dp)
      call file%get(file_group, 'step_tolerance', case%step_tolerance, error, minimum=1e-12_dp, maximum=0.1_dp)
      call file%get(file_group, 'time_step_over_cell', case%time_step_over_cell, error, above=0.0_dp)
      call file%get(file_group, 'largest_steps', case%largest_steps, error, minimum=1, maximum=10000)
      call file%get(file_group, 'largest_total_steps', case%largest_total_steps, error, minimum=0, maximum=1000000000)
      call file%get(file_group, 'settling_periods', case%settling_periods, error, minimum=0, maximum=1000)
      call file%get_fixed(file_group, 'method', case%method, error, &
                          [character(len=name_length) :: 'newton', 'fas', 'petsc'])
      call file%get_fixed(file_group, 'cycle', case%cycle, error, [character(len=name_length) :: 'f', 'v', 'w'])
      call file%get_fixed(file_group, 'deformation', case%deformation, error, &
                          [character(len=name_length) :: 'auto', 'fft', 'mlmi'])
      call file%get_fixed(file_group, 'error_estimate', case%error_estimate, error, &
                          [character(len=name_length) :: 'coarse_grid', 'model'])
      call file%get(file_group, 'accuracy', case%accuracy, error, above=0.0_dp, maximum=0.2_dp)
      if (case%accuracy > 0 .and. .not. allocated(error)) call choose_for_accuracy(file, case)

      file_group = 'dynamics'
      call file%get_fixed(file_group, 'load_balance', case%load_balance, error, &
                          [character(len=name_length) :: 'force_balance', 'equation_of_motion'])
      call file%get(file_group, 'natural_frequency', case%natural_frequency, error, above=0.0_dp)
      call file%get(file_group, 'load_factor', case%load_factor, error, above=0.0_dp)
      call file%get(file_group, 'end_time', case%end_time, error, above=0.0_dp)

      call file%get('output', 'fields', case%fields, error)
   end subroutine read_case_groups

   !> What `accuracy` chooses, unless the file gives it: cells and time step by the plan, tolerances well below the accuracy.
   !> Measured: a step tolerance of 1e-3 leaves up to 1e-3 of Ad/Ai, mostly below 1e-4; steady states are exact to
   !> a tenth of their tolerance or better.
   subroutine choose_for_accuracy(file, case)
      class(namelist_t), intent(inout) :: file
      type(case_t), intent(inout) :: case
      type(case_t) :: usual
      if (.not. file%has('grid', 'cells_x')) case%cells_x = 0
      if (.not. file%has('grid', 'cells_y')) case%cells_y = 0
      if (.not. file%has('solver', 'time_step_over_cell')) case%time_step_over_cell = 0
      if (.not. file%has('solver', 'step_tolerance')) case%step_tolerance = min(usual%step_tolerance, 0.1_dp*case%accuracy)
      if (.not. file%has('solver', 'tolerance')) case%tolerance = min(usual%tolerance, 1e-3_dp*case%accuracy)
   end subroutine choose_for_accuracy

   !> &surface: a file, in place of waviness.
   subroutine read_surface_group(file, case, error)
      class(namelist_t), intent(inout) :: file
      type(case_t), intent(inout) :: case
      type(error_t), allocatable, intent(inout) :: error
      character(len=*), parameter :: group = 'surface'
      character(len=:), allocatable :: path

      path = ''
      call file%get(group, 'file', path, error)
      if (allocated(error)) return
      if (len(path) > path_length) then
         call raise(error, file%place(group, 'file')//'the name of the file has more than '//to_text(path_length)//' characters')
      else if (len(path) > 0 .and. case%orientation /= 'none') then
         call raise(error, file%place(group, 'file')//'&surface gives a file and &waviness an orientation: give one of the two')
      end if
      case%surface_file = path
   end subroutine read_surface_group

   !> &conditions: the three numbers, or dimensional data.
   subroutine read_conditions(file, case, error)
      class(namelist_t), intent(inout) :: file
      type(case_t), intent(inout) :: case
      type(error_t), allocatable, intent(inout) :: error
      character(len=*), parameter :: group = 'conditions'
      logical :: has_moes

      call file%get(group, 'load_parameter_m', case%load_parameter_m, error, above=0.0_dp)
      call file%get(group, 'lubricant_parameter_l', case%lubricant_parameter_l, error, minimum=0.0_dp)
      call file%get(group, 'radius_ratio_d', case%radius_ratio_d, error, minimum=0.0_dp)
      call file%get(group, 'slip_parameter', case%slip_parameter, error, minimum=0.0_dp, maximum=2.0_dp)
      call file%get(group, 'radius_x_m', case%data%radius_x_m, error, above=0.0_dp)
      call file%get(group, 'radius_y_m', case%data%radius_y_m, error, above=0.0_dp)
      call file%get(group, 'reduced_modulus_pa', case%data%reduced_modulus_pa, error, above=0.0_dp)
      call file%get(group, 'load_n', case%data%load_n, error, above=0.0_dp)
      call file%get(group, 'mean_speed_m_per_s', case%data%mean_speed_m_per_s, error, above=0.0_dp)
      call file%get(group, 'viscosity_pa_s', case%data%viscosity_pa_s, error, above=0.0_dp)
      if (allocated(error)) return

      case%has_data = max(case%data%radius_x_m, case%data%radius_y_m, case%data%reduced_modulus_pa, &
                          case%data%load_n, case%data%mean_speed_m_per_s, case%data%viscosity_pa_s) > 0
      has_moes = max(case%load_parameter_m, case%lubricant_parameter_l, case%radius_ratio_d) >= 0
      if (case%has_data .and. has_moes) call raise(error, file%place(group, 'load_parameter_m')// &
         '&conditions gives both load_parameter_m, lubricant_parameter_l or radius_ratio_d and dimensional data '// &
         '(radius_x_m, ...): give one of the two')
   end subroutine read_conditions

end module ehlwave_case_input
