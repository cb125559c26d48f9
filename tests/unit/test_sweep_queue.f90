!> The cost model finds known laws; the queue gives the longest expected case first and learns.
program test_sweep_queue
   use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
   use ehlwave_case_definition, only: case_t
   use ehlwave_cost_model, only: cost_features, cost_model_t, feature_count, fit_cost_model
   use ehlwave_kinds, only: dp
   use ehlwave_planned_case, only: case_plan_t, run_march
   use ehlwave_sweep_queue, only: new_queue, queue_t
   use testing, only: test_t
   implicit none (type, external)

   integer, parameter :: n = 200
   type(test_t) :: test
   type(case_plan_t) :: plans(n)
   type(case_t) :: cases(n)

   call make_plans()
   call check_model()
   call check_queue()
   call test%finish()

contains

   subroutine make_plans()
      integer :: i
      do i = 1, n
         plans(i)%kind = run_march
         plans(i)%cost = 1e6_dp*(1 + modulo(37*i, 101))
         plans(i)%conditions%m = 50 + 10*modulo(i, 7)
      end do
   end subroutine make_plans

   !> seconds = 1e-7 cost^1.1 M^(-0.3)
   pure real(dp) function law(plan)
      type(case_plan_t), intent(in) :: plan
      law = 1e-7_dp*plan%cost**1.1_dp*plan%conditions%m**(-0.3_dp)
   end function law

   subroutine check_model()
      type(cost_model_t) :: model
      real(dp) :: features(feature_count, n), seconds(n)
      integer :: i
      do i = 1, n
         features(:, i) = cost_features(plans(i))
         seconds(i) = law(plans(i))
      end do
      model = fit_cost_model(features, spread(0.0_dp, 1, n))
      call test%check(.not. model%is_fitted, 'nothing is known without a finished case')
      model = fit_cost_model(features, spread(0.0_dp, 1, n), [ieee_value(1.0_dp, ieee_quiet_nan), 2*seconds(2:)])
      call test%check(model%is_fitted, 'the plans know something from the start')
      call test%check_close(sum([(model%seconds(features(:, i)), i=2, n)])/sum(seconds(2:)), 2.0_dp, 'as the plans expect', &
                            relative=0.3_dp)
      model = fit_cost_model(features, seconds, 10*seconds)
      call test%check_close([(model%seconds(features(:, i)), i=1, n)], seconds, 'finished cases count more', relative=0.1_dp)
      model = fit_cost_model(features(:, :1), seconds(:1))
      call test%check_close(model%seconds(features(:, 1)), seconds(1), 'one case', relative=1e-3_dp)
      model = fit_cost_model(features, seconds)
      call test%check_close([(model%seconds(features(:, i)), i=1, n)], seconds, 'all cases', relative=0.05_dp)
   end subroutine check_model

   subroutine check_queue()
      type(queue_t) :: queue
      logical :: is_taken(n), to_run(n)
      real(dp) :: before, left, seconds(n)
      integer :: case, i

      to_run = .true.
      to_run(:20) = .false.
      seconds = [(law(plans(i)), i=1, n)]
      queue = new_queue(cases, plans, to_run, merge(0.0_dp, seconds, to_run), 1)
      left = queue%seconds_left()
      call test%check_close(left, sum(seconds(21:)), 'time left', relative=0.1_dp)
      call test%check_close(sum([(queue%expected_seconds(i), i=21, n)]), left, 'times of the cases left', relative=1e-12_dp)
      before = 1e300_dp
      is_taken = .false.
      do while (.not. queue%is_empty())
         call queue%take(0, case)
         call test%check(to_run(case) .and. .not. is_taken(case), 'each case once')
         is_taken(case) = .true.
         call test%check(seconds(case) <= 1.3_dp*before, 'longest first, as far as 20 cases can teach it')
         before = seconds(case)
         call queue%learn(case, merge(0.0_dp, seconds(case), modulo(case, 10) == 0))   ! those that are refused take no time
      end do
      call test%check_equal(count(is_taken), n - 20, 'all cases')
      call test%check_close(queue%seconds_left(), 0.0_dp, 'nothing left', absolute=1e-6_dp*left)
      seconds = seconds*[(merge(0.2_dp, 1.8_dp, modulo(i, 2) == 0), i=1, n)]
      queue = new_queue(cases, plans, to_run, merge(0.0_dp, seconds, to_run), 1)
      call test%check_close(queue%seconds_left(), sum(seconds(21:)), 'time left of cases that scatter', relative=0.2_dp)
   end subroutine check_queue

end program test_sweep_queue
