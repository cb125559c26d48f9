!> Cases A, B, A in a single process: both runs of A give the same bits.
program test_no_hidden_state
   use ehlwave_case_completion, only: complete_case
   use ehlwave_case_definition, only: case_t
   use ehlwave_case_plan, only: make_plan
   use ehlwave_case_result, only: case_result_t
   use ehlwave_case_runner, only: run_case
   use ehlwave_errors, only: error_t
   use ehlwave_kinds, only: dp
   use ehlwave_planned_case, only: case_plan_t
   use ehlwave_status, only: is_success
   use silent_monitor, only: silent_monitor_t
   use testing, only: test_t
   implicit none (type, external)

   type(test_t) :: test
   type(case_result_t) :: moving, moving_again, standing, standing_again, other, by_fas, by_fas_again

   call run(100.0_dp, 1.0_dp, 'isotropic', 0.5_dp, 64, moving)
   call run(1000.0_dp, 0.04_dp, 'longitudinal', 2.0_dp, 64, standing)
   call run(500.0_dp, 0.12_dp, 'transverse', 1.0_dp, 48, other)
   call run(100.0_dp, 1.0_dp, 'isotropic', 0.5_dp, 64, moving_again)
   call run(1000.0_dp, 0.04_dp, 'longitudinal', 2.0_dp, 64, standing_again)
   call run(100.0_dp, 0.35_dp, 'isotropic', 1.0_dp, 64, by_fas, 'fas')
   call run(500.0_dp, 0.12_dp, 'transverse', 1.0_dp, 48, other, 'fas')
   call run(100.0_dp, 0.35_dp, 'isotropic', 1.0_dp, 64, by_fas_again, 'fas')
   call compare(moving, moving_again, 'moving')
   call compare(by_fas, by_fas_again, 'moving, FAS')
   call compare(standing, standing_again, 'standing')
   call test%check(.not. same([moving%central_film], [other%central_film]), 'the case between was another one')
   call test%finish()

contains

   subroutine run(m, d, orientation, wavelength, cells, result, method)
      real(dp), intent(in) :: m, d, wavelength
      character(len=*), intent(in) :: orientation
      integer, intent(in) :: cells
      type(case_result_t), intent(out) :: result
      character(len=*), intent(in), optional :: method
      type(case_t) :: case
      type(case_plan_t) :: plan
      type(error_t), allocatable :: error
      type(silent_monitor_t) :: monitor

      case%load_parameter_m = m
      case%lubricant_parameter_l = 12.05_dp
      case%radius_ratio_d = d
      case%orientation = orientation
      case%wavelength_over_a = wavelength
      case%cells_x = cells
      case%cells_y = cells
      case%fields = .true.
      if (present(method)) case%method = method
      call complete_case(case, '', error)
      if (.not. allocated(error)) call make_plan(case, plan, error)
      call test%check_no_error(error, orientation)
      if (allocated(error)) return
      call run_case(case, plan, monitor, result)
      call test%check(is_success(result%status), orientation//' converges')
   end subroutine run

   !> Equal bits; NaN equals nothing.
   pure logical function same(a, b)
      real(dp), intent(in) :: a(:), b(:)
      same = size(a) == size(b)
      if (same) same = all(abs(a - b) <= 0)
   end function same

   subroutine compare(a, b, what)
      type(case_result_t), intent(in) :: a, b
      character(len=*), intent(in) :: what
      call test%check(same([a%central_film, a%minimum_film, a%central_film_moes, a%max_pressure], &
                           [b%central_film, b%minimum_film, b%central_film_moes, b%max_pressure]), what//': smooth contact')
      call test%check(same([a%amplitude_ratio, a%amplitude_ratio_fit, a%mean_film], &
                           [b%amplitude_ratio, b%amplitude_ratio_fit, b%mean_film]), what//': amplitudes')
      call test%check(same([a%residual, a%load_error], [b%residual, b%load_error]), what//': errors')
      call test%check(all([a%status, a%time_steps, a%nonlinear_steps, a%linear_steps] == &
                          [b%status, b%time_steps, b%nonlinear_steps, b%linear_steps]), what//': effort')
      call test%check(same(a%time, b%time) .and. same(a%film_history, b%film_history), what//': history')
      if (allocated(a%approach_history)) call test%check(same(a%approach_history, b%approach_history), what//': approach')
      call test%check(same(reshape(a%p, [size(a%p)]), reshape(b%p, [size(b%p)])), what//': pressure')
      call test%check(same(reshape(a%h, [size(a%h)]), reshape(b%h, [size(b%h)])), what//': film')
   end subroutine compare

end program test_no_hidden_state
