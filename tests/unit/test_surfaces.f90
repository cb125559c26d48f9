!> A list of rough surfaces: the gap is their sum, also in a march.
program test_surfaces
   use ehlwave_case_completion, only: complete_case
   use ehlwave_case_definition, only: case_t
   use ehlwave_case_plan, only: make_plan
   use ehlwave_case_result, only: case_result_t
   use ehlwave_case_runner, only: run_case
   use ehlwave_errors, only: error_t
   use ehlwave_kinds, only: dp
   use ehlwave_planned_case, only: case_plan_t
   use ehlwave_status, only: is_success
   use ehlwave_surfaces, only: surfaces_t
   use ehlwave_waviness, only: new_waviness, no_waviness, waviness_t
   use silent_monitor, only: silent_monitor_t
   use testing, only: test_t
   implicit none (type, external)

   real(dp), parameter :: film = 0.3_dp
   type(test_t) :: test

   call check_sum()
   call check_repetition()
   call check_march()
   call test%finish()

contains

   !> Waves with other lengths, directions, speeds and amplitudes.
   subroutine check_sum()
      type(surfaces_t) :: pair
      type(waviness_t) :: first, second
      real(dp), parameter :: x(3) = [-1.5_dp, 0.2_dp, 1.1_dp], y(2) = [0.0_dp, 0.7_dp], t = 2
      real(dp) :: expected(3, 2)

      first = new_waviness(0.7_dp, 0.0_dp, .false., -2.5_dp, 1.3_dp, 0.2_dp)
      second = new_waviness(0.4_dp, 0.9_dp, .false., -2.0_dp, 0.7_dp, 0.1_dp)
      pair%list = [first, second]
      expected = film*(0.2_dp*first%shape_at(x, y, t) + 0.1_dp*second%shape_at(x, y, t))
      call close(pair%rough_behind_fronts(x, y, t, film), expected, 'behind their fronts')
      expected = film*(0.2_dp*first%shape_fixed(x, y, -first%frequency()*t) &
                       + 0.1_dp*second%shape_fixed(x, y, -second%frequency()*t))
      call close(pair%rough_of_waves(x, y, t, film), expected, 'everywhere')
      expected = film*(0.2_dp*first%shape_fixed(x, y, 1.0_dp) + 0.1_dp*second%shape_fixed(x, y, 0.0_dp))
      call close(pair%rough_fixed(x, y, 1.0_dp, film), expected, 'standing')
      call test%check_close(pair%passing_time(1.0_dp), 3/0.7_dp, 'the slower one passes last', relative=1e-14_dp)
      call test%check_close(pair%shortest_period(), 0.7_dp/1.3_dp, 'waves of the first pass first', relative=1e-14_dp)
      call test%check_close(pair%longest_period(), 0.4_dp/0.7_dp, 'and those of the second last', relative=1e-14_dp)
      call test%check(pair%is_rough() .and. pair%moves() .and. pair%is_symmetric(), 'rough, moving, even in Y')
      pair%list(1) = new_waviness(0.0_dp, 0.5_dp, .false., -2.5_dp, 1.0_dp, 0.2_dp)
      call test%check(pair%moves(), 'one that moves is enough')
      pair%list(2) = new_waviness(0.4_dp, 0.9_dp, .true., -2.0_dp, 0.7_dp, 0.1_dp)
      call test%check(.not. pair%is_symmetric(), 'one that is oblique is enough')
      pair%list = [no_waviness()]
      call test%check(.not. (pair%is_rough() .or. pair%moves() .or. pair%is_measured()), 'smooth')
   end subroutine check_sum

   !> Periods in a ratio of whole numbers, in none, and of equal frequency.
   subroutine check_repetition()
      type(surfaces_t) :: pair

      pair%list = [new_waviness(1.0_dp, 0.0_dp, .false., -2.5_dp, 1.25_dp, 0.2_dp), &
                   new_waviness(1.0_dp, 0.0_dp, .false., -2.5_dp, 0.75_dp, 0.1_dp)]
      call test%check_close(pair%repeat_period(), 4.0_dp, '5 of 0.8 and 3 of 4/3', relative=1e-14_dp)
      call test%check_close(pair%window(), 4.0_dp, 'measured until they repeat', relative=1e-14_dp)
      call test%check_close(pair%smallest_amplitude(film), 0.1_dp*film, 'the smaller amplitude', relative=1e-14_dp)
      call test%check(pair%are_apart() .and. .not. pair%are_one(), 'two frequencies')
      pair%list(2) = new_waviness(0.83_dp, 0.0_dp, .false., -2.5_dp, 0.75_dp, 0.1_dp)
      call test%check_close(pair%repeat_period(), 0.0_dp, 'periods of 0.8 and 1.1067 do not repeat', absolute=0.0_dp)
      call test%check_close(pair%window(), 1/(1.25_dp - 0.75_dp/0.83_dp), 'measured over a beat', relative=1e-12_dp)
      call test%check(pair%are_apart(), 'told apart in a beat')
      pair%list(2) = new_waviness(0.6_dp, 0.0_dp, .false., -2.5_dp, 0.75_dp, 0.1_dp)
      call test%check_close(pair%repeat_period(), 0.8_dp, 'one frequency', relative=1e-14_dp)
      call test%check(.not. (pair%are_apart() .or. pair%are_one()), 'of two patterns')
      pair%list(2) = pair%list(1)
      call test%check(pair%are_one(), 'one pattern')
   end subroutine check_repetition

   subroutine close(rough, expected, what)
      real(dp), intent(in) :: rough(:, :), expected(:, :)
      character(len=*), intent(in) :: what
      call test%check_close(pack(rough, .true.), pack(expected, .true.), 'gap is the sum: '//what, absolute=1e-15_dp)
   end subroutine close

   !> Waves of 15 % on one surface and of 5 % on the other, both at S = 1, and waves of 20 % on a single surface: the
   !> same film at all times.
   subroutine check_march()
      type(case_t) :: case
      type(case_plan_t) :: plan
      type(case_result_t) :: alone, both
      type(error_t), allocatable :: error
      type(silent_monitor_t) :: monitor

      case%load_parameter_m = 100
      case%lubricant_parameter_l = 12.05_dp
      case%radius_ratio_d = 1
      case%orientation = 'transverse'
      case%wavelength_over_a = 1
      case%cells_x = 32
      case%cells_y = 32
      case%step_tolerance = 1e-8_dp
      call complete_case(case, '', error)
      if (.not. allocated(error)) call make_plan(case, plan, error)
      call test%check_no_error(error, 'case')
      if (allocated(error)) return
      call run_case(case, plan, monitor, alone)
      plan%surfaces%list = [plan%surfaces%list, plan%surfaces%list]
      plan%surfaces%list%amplitude_over_film = [0.15_dp, 0.05_dp]
      call run_case(case, plan, monitor, both)
      call test%check(is_success(alone%status) .and. is_success(both%status), 'marches')
      call test%check_close(both%film_history, alone%film_history, 'film of two surfaces', relative=1e-6_dp)
      call test%check_close(both%ratios(2), &
                            [alone%amplitude_ratio_fit, alone%amplitude_ratio_fit], 'of one pattern each has its share', &
                            relative=1e-5_dp)
   end subroutine check_march

end program test_surfaces
