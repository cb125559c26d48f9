!> The input of one case: values as the user gives them, read from a namelist file and checked.
module ehlwave_case_input
   use ehlwave_conditions, only: conditions_from_dimensional, conditions_from_moes, conditions_t, contact_data_t
   use ehlwave_errors, only: error_t, raise
   use ehlwave_kinds, only: dp
   use ehlwave_namelist, only: namelist_t
   use ehlwave_petsc_solver, only: require_petsc
   use ehlwave_text, only: to_text
   implicit none (type, external)
   private
   public :: read_case, read_case_groups, complete_case, case_conditions

   integer, parameter, public :: name_length = 20   !! longest choice, e.g. 'equation_of_motion'
   integer, parameter, public :: path_length = 512  !! longest name of a surface file

   !> All keys, in the order of the groups. Not given: M, L, D below 0; wavelengths and dimensional data 0.
   type, public :: case_t
      ! &conditions
      real(dp) :: load_parameter_m = -1, lubricant_parameter_l = -1, radius_ratio_d = -1
      real(dp) :: slip_parameter = 1
      type(contact_data_t) :: data                       !! dimensional data, used when has_data
      logical :: has_data = .false.
      ! &lubricant
      real(dp) :: pressure_viscosity_per_pa = 2.2e-8_dp
      real(dp) :: roelands_index = 0.68_dp
      character(len=name_length) :: viscosity_law = 'roelands'
      character(len=name_length) :: density_law = 'dowson_higginson'
      ! &waviness
      character(len=name_length) :: orientation = 'none'
      real(dp) :: wavelength_over_a = 0
      real(dp) :: wavelength_x_over_a = 0, wavelength_y_over_a = 0
      logical :: oblique = .false.
      real(dp) :: amplitude_over_film = 0.2_dp
      character(len=name_length) :: response = 'transient'
      ! &surface
      character(len=path_length) :: surface_file = ''    !! measured surface in place of waviness
      ! &grid
      real(dp) :: x_min = -2.5_dp, x_max = 1.5_dp, y_max = 2
      integer :: cells_x = 256, cells_y = 256            !! 0: chosen by the plan
      integer :: largest_cells = 1024                    !! limit of what the plan chooses
      character(len=name_length) :: domain = 'auto'
      ! &solver
      real(dp) :: tolerance = 1e-6_dp
      real(dp) :: step_tolerance = 1e-4_dp
      real(dp) :: time_step_over_cell = 1                !! 0: chosen by the plan
      integer :: largest_steps = 60
      integer :: largest_total_steps = 0                 !! 0: chosen by the plan
      integer :: settling_periods = 1
      character(len=name_length) :: method = 'newton'
      character(len=name_length) :: cycle = ''           !! of method = 'fas', completed
      character(len=name_length) :: deformation = 'auto'
      character(len=name_length) :: error_estimate = 'coarse_grid'
      real(dp) :: accuracy = 0                           !! relative error asked for; 0: none
      ! &dynamics
      character(len=name_length) :: load_balance = 'force_balance'
      real(dp) :: natural_frequency = 0
      real(dp) :: load_factor = 1
      real(dp) :: end_time = 0
      ! &output
      logical :: fields = .false.
   end type case_t

   character(len=name_length), parameter, public :: orientations(5) = &
      [character(len=name_length) :: 'none', 'transverse', 'isotropic', 'longitudinal', 'custom']

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
      call file%get(group, 'radius_ratio_d', case%radius_ratio_d, error, above=0.0_dp)
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

   !> Fill in what follows from other keys and refuse contradictions. `place` begins every message.
   subroutine complete_case(case, place, error)
      type(case_t), intent(inout) :: case
      character(len=*), intent(in) :: place
      type(error_t), allocatable, intent(inout) :: error
      type(conditions_t) :: conditions

      call case_conditions(case, conditions, error)
      if (.not. allocated(error)) call complete_waviness(case, error)
      if (.not. allocated(error)) call check_grid_and_time(case, error)
      if (.not. allocated(error)) call check_response(case, error)
      if (.not. allocated(error)) call complete_method(case, error)
      if (allocated(error)) error%message = place//error%message
   end subroutine complete_case

   !> The method must be there, and a cycle is one of FAS: F cycles when none is given.
   subroutine complete_method(case, error)
      type(case_t), intent(inout) :: case
      type(error_t), allocatable, intent(inout) :: error
      if (case%method == 'petsc') call require_petsc(error)
      if (case%method == 'fas') then
         if (case%cycle == '') case%cycle = 'f'
      else if (case%cycle /= '') then
         call raise(error, 'cycle = '''//trim(case%cycle)//''' is of method = ''fas'' only: leave it out or set method = ''fas''')
      end if
   end subroutine complete_method

   !> Operating conditions of a case; also sets M, L, D of a case given by dimensional data.
   subroutine case_conditions(case, conditions, error)
      type(case_t), intent(inout) :: case
      type(conditions_t), intent(out) :: conditions
      type(error_t), allocatable, intent(inout) :: error

      if (case%has_data) then
         case%data%pressure_viscosity_per_pa = case%pressure_viscosity_per_pa
         call conditions_from_dimensional(case%data, conditions, error)
         case%load_parameter_m = conditions%m
         case%lubricant_parameter_l = conditions%l
         case%radius_ratio_d = conditions%d
      else
         call require(case%load_parameter_m >= 0, 'load_parameter_m', error)
         call require(case%lubricant_parameter_l >= 0, 'lubricant_parameter_l', error)
         call require(case%radius_ratio_d >= 0, 'radius_ratio_d', error)
         if (allocated(error)) return
         call conditions_from_moes(case%load_parameter_m, case%lubricant_parameter_l, case%radius_ratio_d, &
                                   case%pressure_viscosity_per_pa, conditions, error)
      end if
   end subroutine case_conditions

   subroutine require(is_given, key, error)
      logical, intent(in) :: is_given
      character(len=*), intent(in) :: key
      type(error_t), allocatable, intent(inout) :: error
      if (.not. (is_given .or. allocated(error))) call raise(error, '&conditions '//key//' is missing: give '// &
         'load_parameter_m, lubricant_parameter_l and radius_ratio_d, or dimensional data (radius_x_m, radius_y_m, '// &
         'reduced_modulus_pa, load_n, mean_speed_m_per_s, viscosity_pa_s)')
   end subroutine require

   !> Wavelengths along X and Y from the orientation, and back.
   subroutine complete_waviness(case, error)
      type(case_t), intent(inout) :: case
      type(error_t), allocatable, intent(inout) :: error
      real(dp) :: wave

      wave = case%wavelength_over_a
      select case (case%orientation)
      case ('none')
         if (max(wave, case%wavelength_x_over_a, case%wavelength_y_over_a) > 0) then
            call raise(error, "&waviness gives a wavelength but orientation is 'none': set orientation to "// &
                       "'transverse', 'isotropic', 'longitudinal' or 'custom', or remove the wavelength")
            return
         end if
      case ('custom')
         if (wave > 0 .and. max(case%wavelength_x_over_a, case%wavelength_y_over_a) <= 0) then
            call raise(error, "&waviness orientation 'custom' takes wavelength_x_over_a and wavelength_y_over_a, "// &
                       'not wavelength_over_a')
         else if (max(case%wavelength_x_over_a, case%wavelength_y_over_a) <= 0) then
            call raise(error, "&waviness orientation 'custom' needs wavelength_x_over_a or wavelength_y_over_a "// &
                       'above 0 (0 means no variation in that direction)')
         end if
         wave = shorter(case%wavelength_x_over_a, case%wavelength_y_over_a)
         if (case%wavelength_over_a > 0 .and. abs(wave - case%wavelength_over_a) > 0) &
            call raise(error, "&waviness orientation 'custom' takes wavelength_x_over_a and wavelength_y_over_a: "// &
                       'remove wavelength_over_a')
         case%wavelength_over_a = wave
         if (.not. allocated(error) .and. case%oblique .and. min(case%wavelength_x_over_a, case%wavelength_y_over_a) <= 0) &
            call raise(error, '&waviness oblique needs both wavelength_x_over_a and wavelength_y_over_a above 0')
      case default
         if (.not. wave > 0) then
            call raise(error, "&waviness wavelength_over_a is missing: orientation '"//trim(case%orientation)//"' needs it")
            return
         end if
         if (differs(case%wavelength_x_over_a, merge(0.0_dp, wave, case%orientation == 'longitudinal')) .or. &
             differs(case%wavelength_y_over_a, merge(0.0_dp, wave, case%orientation == 'transverse'))) &
            call raise(error, "&waviness wavelength_x_over_a and wavelength_y_over_a belong to orientation 'custom'; '"// &
                       trim(case%orientation)//"' takes wavelength_over_a")
         if (case%oblique) call raise(error, "&waviness oblique belongs to orientation 'custom'")
         if (case%orientation /= 'longitudinal') case%wavelength_x_over_a = wave
         if (case%orientation /= 'transverse') case%wavelength_y_over_a = wave
      end select
   end subroutine complete_waviness

   !> Whether a value was given and is not the expected one.
   pure logical function differs(value, expected)
      real(dp), intent(in) :: value, expected
      differs = value > 0 .and. abs(value - expected) > 0
   end function differs

   !> The smaller of two wavelengths, 0 standing for infinite.
   pure real(dp) function shorter(x, y)
      real(dp), intent(in) :: x, y
      shorter = min(merge(x, huge(x), x > 0), merge(y, huge(y), y > 0))
      if (max(x, y) <= 0) shorter = 0
   end function shorter

   !> The linear response belongs to harmonic waves, to the nominal load, and to time steps that do not skip nodes.
   subroutine check_response(case, error)
      type(case_t), intent(in) :: case
      type(error_t), allocatable, intent(inout) :: error

      if (case%response == 'transient') return
      if (len_trim(case%surface_file) > 0) then
         call raise(error, "&waviness response = '"//trim(case%response)//"' is that of one harmonic wave, &surface file = '"// &
                    trim(case%surface_file)//"' is none: remove &surface or set response to 'transient'")
      else if (abs(case%load_factor - 1) > 0) then
         call raise(error, "&waviness response = '"//trim(case%response)//"' is about the steady state under the nominal "// &
                    "load: remove &dynamics load_factor or set response to 'transient'")
      else if (case%time_step_over_cell > 1) then
         call raise(error, '&solver time_step_over_cell = '//to_text(case%time_step_over_cell, 6)// &
                    " is above 1: response = '"//trim(case%response)//"' linearises steps of at most one cell; use 1, 0.5, "// &
                    "0.25, ... or response = 'transient'")
      else if (case%response == 'harmonic' .and. case%end_time > 0) then
         call raise(error, "&dynamics end_time is given but response = 'harmonic' takes no time steps: remove end_time or "// &
                    "set response to 'both' or 'transient'")
      end if
   end subroutine check_response

   subroutine check_grid_and_time(case, error)
      type(case_t), intent(in) :: case
      type(error_t), allocatable, intent(inout) :: error
      real(dp) :: ratio

      if (case%cells_x > 0 .and. (case%cells_x < 16 .or. case%cells_x > 8192 .or. modulo(case%cells_x, 2) /= 0)) then
         call raise(error, '&grid cells_x = '//to_text(case%cells_x)//': give an even number from 16 to 8192, '// &
                    'best one that can be halved several times (64, 96, 128, ...), or 0 for the plan to choose')
      else if (case%cells_y > 0 .and. (case%cells_y < 16 .or. case%cells_y > 8192 .or. modulo(case%cells_y, 2) /= 0)) then
         call raise(error, '&grid cells_y = '//to_text(case%cells_y)//': give an even number from 16 to 8192, '// &
                    'best one that can be halved several times (64, 96, 128, ...), or 0 for the plan to choose')
      end if
      if (allocated(error)) return
      ratio = case%time_step_over_cell
      if (ratio <= 0) ratio = 1
      if (ratio < 1) ratio = 1/ratio
      if (abs(ratio - nint(ratio)) > 1e-6_dp*ratio .or. ratio > 64) &
         call raise(error, '&solver time_step_over_cell = '//to_text(case%time_step_over_cell, 6)// &
                    ': give a whole number (1, 2, 4) or one over a whole number (0.5, 0.25), so that steps follow the '// &
                    'characteristics from node to node')
      if (allocated(error)) return
      if (case%load_balance == 'equation_of_motion' .and. .not. case%natural_frequency > 0) then
         call raise(error, "&dynamics natural_frequency is missing: load_balance 'equation_of_motion' needs Omega")
      else if (case%load_balance == 'force_balance' .and. case%natural_frequency > 0) then
         call raise(error, "&dynamics natural_frequency is given but load_balance is 'force_balance': set it to "// &
                    "'equation_of_motion' or remove natural_frequency")
      end if
   end subroutine check_grid_and_time

end module ehlwave_case_input
