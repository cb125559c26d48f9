!> Effective input and identity of a case.
program test_case_text
   use ehlwave_case_completion, only: complete_case
   use ehlwave_case_definition, only: case_t
   use ehlwave_case_file, only: read_case
   use ehlwave_case_keys, only: default_keys
   use ehlwave_case_plan, only: make_plan
   use ehlwave_case_text, only: case_identity, effective_input, input_identity, input_text
   use ehlwave_errors, only: error_t
   use ehlwave_identity_index, only: text_identity
   use ehlwave_key_list, only: find_key, key_list_t
   use ehlwave_kinds, only: dp
   use ehlwave_planned_case, only: case_plan_t
   use testing, only: test_t
   implicit none (type, external)

   character(len=*), parameter :: path = 'test_case_text.nml'
   type(test_t) :: test

   call check_hash()
   call check_reread(smooth(), 'smooth')
   call check_reread(wavy(), 'wavy')
   call check_reread(dimensional(), 'dimensional data, equation of motion')
   call check_reread(oblique(), 'oblique')
   call check_reread(chosen_grid(), 'grid chosen by the plan')
   call check_reread(pair(), 'two rough surfaces')
   call check_differences()
   call check_identities()
   call check_late_key()
   call check_former_default()
   call test%finish()

contains

   function smooth() result(case)
      type(case_t) :: case
      case%load_parameter_m = 100
      case%lubricant_parameter_l = 12.05_dp
      case%radius_ratio_d = 1
   end function smooth

   function wavy() result(case)
      type(case_t) :: case
      case = smooth()
      case%orientation = 'isotropic'
      case%wavelength_over_a = 1/3.0_dp
      case%slip_parameter = 0.1_dp + 0.2_dp
      case%end_time = 4.7_dp
   end function wavy

   function oblique() result(case)
      type(case_t) :: case
      case = smooth()
      case%orientation = 'custom'
      case%wavelength_x_over_a = 0.5_dp
      case%wavelength_y_over_a = 0.7_dp
      case%oblique = .true.
      case%oil%viscosity_law = 'barus'
      case%oil%density_law = 'incompressible'
      case%tolerance = 1e-7_dp
      case%largest_steps = 33
   end function oblique

   function pair() result(case)
      type(case_t) :: case
      case = oblique()
      case%response = 'harmonic'
      case%effects%second%roughness%orientation = 'isotropic'
      case%effects%second%roughness%wavelength_over_a = 0.8_dp
      case%effects%second%roughness%amplitude_over_film = 0.1_dp
   end function pair

   function dimensional() result(case)
      type(case_t) :: case
      case%is_dimensional = .true.
      case%data%radius_x_m = 12.52e-3_dp
      case%data%radius_y_m = 25e-3_dp
      case%data%reduced_modulus_pa = 1.17e11_dp
      case%data%load_n = 39.2_dp
      case%data%mean_speed_m_per_s = 0.024_dp
      case%data%viscosity_pa_s = 1.22_dp
      case%load_balance = 'equation_of_motion'
      case%natural_frequency = 12.5_dp
      case%load_factor = 1.1_dp
      case%end_time = 2
   end function dimensional

   function chosen_grid() result(case)
      type(case_t) :: case
      case = wavy()
      case%cells_x = 0
      case%cells_y = 0
      case%largest_cells = 64
   end function chosen_grid

   !> Line contact.
   function line() result(case)
      type(case_t) :: case
      case%load_parameter_m = 100
      case%lubricant_parameter_l = 11
      case%radius_ratio_d = 0
      case%orientation = 'transverse'
      case%wavelength_over_a = 0.5_dp
      case%response = 'harmonic'
      case%cells_x = 0
   end function line

   !> Stores hold cases by these identities, as in the first version of the program, whose edges were all truncated, and
   !> must never change.
   subroutine check_identities()
      call check_identity(smooth(), '13A8A1479AFEA8E4', 'smooth')
      call check_identity(wavy(), 'C212255D6EEA3CC6', 'wavy')
      call check_identity(dimensional(), 'C5F17D3C49678A15', 'dimensional data, equation of motion')
      call check_identity(oblique(), '20D686BB4D899409', 'oblique')
      call check_identity(chosen_grid(), '03DF80226B653EAD', 'grid chosen by the plan')
      call check_identity(line(), '2EF9381FF78EF23F', 'line contact')
      call check_file()
   end subroutine check_identities

   subroutine check_identity(given, identity, what)
      type(case_t), intent(in) :: given
      character(len=*), intent(in) :: identity, what
      type(case_t) :: case
      type(error_t), allocatable :: error
      case = given
      case%edges = 'truncated'
      call complete_case(case, '', error)
      call test%check_equal(case_identity(case), identity, 'identity: '//what)
   end subroutine check_identity

   !> Full text of a case with the choices of an accuracy, as the first version of the program wrote it except for the
   !> edges.
   subroutine check_file()
      character(len=*), parameter :: lf = new_line('a')
      character(len=*), parameter :: expected = '&conditions'//lf//'  load_parameter_m = 100'//lf// &
         '  lubricant_parameter_l = 12.050000000000001'//lf//'  radius_ratio_d = 0.34999999999999998'//lf// &
         '  slip_parameter = 1'//lf//'/'//lf//'&lubricant'//lf//'  pressure_viscosity_per_pa = 2.1999999999999998e-8'//lf// &
         '  roelands_index = 0.68000000000000005'//lf//"  viscosity_law = 'roelands'"//lf// &
         "  density_law = 'dowson_higginson'"//lf//'/'//lf//'&waviness'//lf//"  orientation = 'longitudinal'"//lf// &
         '  wavelength_over_a = 1'//lf//'  amplitude_over_film = 0.20000000000000001'//lf//"  response = 'transient'"//lf// &
         '/'//lf//'&grid'//lf//'  x_min = -2.5'//lf//'  x_max = 1.5'//lf//'  y_max = 2'//lf//'  cells_x = 0'//lf// &
         '  cells_y = 0'//lf//'  largest_cells = 1024'//lf//"  domain = 'auto'"//lf//"  edges = 'truncated'"//lf//'/'//lf// &
         '&solver'//lf// &
         '  tolerance = 9.9999999999999995e-7'//lf//'  step_tolerance = 0.00050000000000000001'//lf//'  largest_steps = 60'//lf// &
         '  settling_periods = 1'//lf//'  largest_total_steps = 900'//lf//"  method = 'fas'"//lf//"  cycle = 'f'"//lf// &
         "  deformation = 'auto'"//lf//"  error_estimate = 'coarse_grid'"//lf//'  accuracy = 0.01'//lf//'/'//lf// &
         '&dynamics'//lf//"  load_balance = 'force_balance'"//lf//'  load_factor = 1'//lf//'/'//lf
      type(case_t) :: case
      type(error_t), allocatable :: error
      integer :: unit

      open (newunit=unit, file=path, status='replace')
      write (unit, '(a)') '&conditions load_parameter_m = 100, lubricant_parameter_l = 12.05, radius_ratio_d = 0.35 /', &
         "&waviness orientation = 'Longitudinal', wavelength_over_a = 1 /", &
         "&solver method = 'fas', accuracy = 0.01, largest_total_steps = 900 / &grid edges = 'truncated' /"
      close (unit)
      call read_case(path, case, error)
      call test%check_no_error(error, 'case file')
      call test%check_equal(effective_input(case), expected, 'effective input')
      call test%check_equal(case_identity(case), '3BD213236BF3D60E', 'its identity')
   end subroutine check_file

   !> A key that is added later is written where it is not the default, and only there.
   subroutine check_late_key()
      type(key_list_t) :: list
      integer :: slip

      list = default_keys()
      slip = find_key(list%keys, 'slip_parameter')
      list%keys(slip)%is_late = .true.
      list%keys%is_written = list%keys%name == 'slip_parameter'
      call test%check_equal(input_text(list), '/'//new_line('a'), 'the default of a late key')
      list%values(slip)%number = 0.5_dp
      call test%check_equal(input_text(list), '&conditions'//new_line('a')//'  slip_parameter = 0.5'// &
                            new_line('a')//'/'//new_line('a'), 'another value of a late key')
   end subroutine check_late_key

   !> Former implicit defaults are written and are no part of the identity; the same holds for today's default.
   subroutine check_former_default()
      type(case_t) :: case
      type(error_t), allocatable :: error
      character(len=:), allocatable :: flooded, truncated
      character(len=16) :: identity

      case = smooth()
      call complete_case(case, '', error)
      flooded = effective_input(case)
      identity = case_identity(case)
      case%edges = 'truncated'
      truncated = effective_input(case)
      call test%check(index(flooded, "  edges = 'flooded'"//new_line('a')) > 0, 'the default of today is written')
      call test%check(index(truncated, "  edges = 'truncated'"//new_line('a')) > 0, 'that of before, too')
      call test%check(case_identity(case) /= identity, 'they are two cases')
      call test%check_equal(input_identity(flooded), text_identity(flooded), 'the default of today counts')
      call test%check_equal(input_identity(truncated), case_identity(case), 'identity of an effective input')
   end subroutine check_former_default

   !> From Python, with `text` from effective_input:
   !>     h = 14695981039346656037
   !>     for b in text.encode(): h = (h ^ b)*1099511628211 % 2**64
   !>     print(f'{h:016X}')
   subroutine check_hash()
      type(case_t) :: case
      character(len=*), parameter :: lf = new_line('a')
      character(len=*), parameter :: text = '&conditions'//lf//'  load_parameter_m = 100'//lf// &
         '  lubricant_parameter_l = 12.050000000000001'//lf//'  radius_ratio_d = 1'//lf//'  slip_parameter = 1'//lf//'/'//lf
      character(len=:), allocatable :: whole
      type(error_t), allocatable :: error

      case = smooth()
      call complete_case(case, '', error)
      whole = effective_input(case)     ! nothing of it goes without saying
      call test%check_equal(whole(:len(text)), text, 'effective input begins')
      call test%check_equal(identity_by_digits(effective_input(case)), case_identity(case), 'FNV-1a, digit by digit')
   end subroutine check_hash

   !> FNV-1a 64 another way: long multiplication in base 256.
   pure function identity_by_digits(text) result(identity)
      character(len=*), intent(in) :: text
      character(len=16) :: identity
      integer, parameter :: prime(8) = [int(z'B3'), int(z'01'), 0, 0, 0, 1, 0, 0]
      integer :: digit(8), product(8), i, j, n
      digit = [int(z'25'), int(z'23'), int(z'22'), int(z'84'), int(z'E4'), int(z'9C'), int(z'F2'), int(z'CB')]
      do n = 1, len(text)
         digit(1) = ieor(digit(1), iachar(text(n:n)))
         product = 0
         do j = 1, 8
            do i = 1, 9 - j
               product(i + j - 1) = product(i + j - 1) + prime(j)*digit(i)
            end do
         end do
         do i = 1, 7
            digit(i) = modulo(product(i), 256)
            product(i + 1) = product(i + 1) + product(i)/256
         end do
         digit(8) = modulo(product(8), 256)
      end do
      write (identity, '(8z2.2)') digit(8:1:-1)
   end function identity_by_digits

   !> Written, read and written again: the same text, the same identity, the same plan.
   subroutine check_reread(given, what)
      type(case_t), intent(in) :: given
      character(len=*), intent(in) :: what
      type(case_t) :: case, again
      type(case_plan_t) :: plan, plan_again
      type(error_t), allocatable :: error
      integer :: unit

      case = given
      call complete_case(case, '', error)
      call test%check_no_error(error, what)
      open (newunit=unit, file=path, access='stream', form='unformatted', status='replace')
      write (unit) effective_input(case)
      close (unit)
      call read_case(path, again, error)
      call test%check_no_error(error, what//', read again')
      if (allocated(error)) return
      call test%check_equal(effective_input(again), effective_input(case), what//', same text')
      call test%check_equal(case_identity(again), case_identity(case), what//', same identity')
      call make_plan(case, plan, error)
      call make_plan(again, plan_again, error)
      call test%check(plan%cells_x == plan_again%cells_x .and. plan%cells_y == plan_again%cells_y .and. &
                      plan%steps == plan_again%steps, what//', same plan')
   end subroutine check_reread

   subroutine check_differences()
      type(case_t) :: case
      type(error_t), allocatable :: error
      character(len=16) :: identity
      case = wavy()
      call complete_case(case, '', error)
      identity = case_identity(case)
      case%slip_parameter = nearest(case%slip_parameter, 1.0_dp)
      call test%check(case_identity(case) /= identity, 'the last bit of a number counts')
      case = wavy()
      case%fields = .true.
      call complete_case(case, '', error)
      call test%check_equal(case_identity(case), identity, 'what is written does not count')
   end subroutine check_differences

end program test_case_text
