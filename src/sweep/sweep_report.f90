!> Plan and outcome of a sweep as text.
module ehlwave_sweep_report
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ehlwave_kinds, only: dp
   use ehlwave_memory, only: memory_limit_mib
   use ehlwave_planned_case, only: case_plan_t, run_harmonic, run_march, run_smooth
   use ehlwave_status, only: last_status, status_name, status_pending
   use ehlwave_sweep_cases, only: sweep_t
   use ehlwave_sweep_expectation, only: expected_seconds
   use ehlwave_sweep_progress, only: counted, duration, progress_t
   use ehlwave_terminal, only: say
   use ehlwave_text, only: number_of, to_text
   implicit none (type, external)
   private
   public :: print_sweep_plan, print_sweep_result

contains

   !> All cases with their expected cost, rounded to a unit.
   subroutine print_sweep_plan(unit, sweep)
      integer, intent(in) :: unit
      type(sweep_t), intent(in) :: sweep
      character(len=24) :: run
      character(len=105) :: line
      integer :: i

      call say(unit, '   case        M       L        D  orientation   lambda/a        grid       '// &
         'run                  resolved   keys that vary besides')
      do i = 1, size(sweep%cases)
         associate (case => sweep%cases(i), plan => sweep%plans(i))
            run = to_text(plan%steps)//' time steps'
            if (plan%kind /= run_march) run = to_text(1 + plan%phases)//' steady states'
            if (plan%kind == run_smooth) run = '1 steady state'
            if (plan%kind == run_harmonic) run = 'linear response'
            write (line, '(i7,f9.1,f8.3,f9.4,2x,a12,f11.4,i7,a,i0,t76,a,t97,a)') i, plan%conditions%m, &
               plan%conditions%l, &
               plan%conditions%d, case%orientation, case%wavelength_over_a, plan%cells_x, ' x ', plan%cells_y, &
               trim(run), merge('yes', 'NO ', plan%resolution%is_resolved)
            call say(unit, line//sweep%variation(i))
         end associate
      end do
      call say(unit, number_of(size(sweep%cases), 'case')//', '//to_text(count(sweep%plans%resolution%is_resolved))// &
         ' resolved, '//to_text(sweep%skipped)//' unresolved left out')
      call print_expectation(unit, sweep%plans)
   end subroutine print_sweep_plan

   !> Time, error and memory of all cases: the sum of the times, the largest error, the largest memory.
   subroutine print_expectation(unit, plans)
      integer, intent(in) :: unit
      type(case_plan_t), intent(in) :: plans(:)
      character(len=:), allocatable :: text
      real(dp) :: errors(size(plans)), memory_mib(size(plans)), seconds(size(plans))
      integer :: i, line_contacts, worst

      seconds = expected_seconds(plans)
      line_contacts = count(.not. ieee_is_finite(seconds))
      memory_mib = [(plans(i)%expected_memory_mib(), i=1, size(plans))]
      errors = merge(plans%expected_error, 0.0_dp, ieee_is_finite(plans%expected_error))
      worst = maxloc(errors, 1, mask=errors > 0)
      text = 'Expected     '
      if (worst > 0) text = text//duration(sum(seconds, mask=ieee_is_finite(seconds)))// &
         ' of computing on this machine (a '// &
         'model, usually right within a factor '//to_text(nint(maxval(plans%thinning%cost_factor)))// &
         '), errors up to '//to_text(errors(worst), 2)//' (case '// &
         to_text(worst)//'), '
      call say(unit, text//to_text(maxval(memory_mib), 2)//' MiB a rank, plus memory of MPI')
      if (any(memory_mib > memory_limit_mib())) call say(unit, '             TOO LITTLE MEMORY for '// &
         number_of(count(memory_mib > memory_limit_mib()), 'case')//': a rank here can have '// &
         to_text(nint(memory_limit_mib()))//' MiB. They will be over_budget')
      if (line_contacts > 0) call say(unit, '             '//number_of(line_contacts, 'line contact')// &
         ' besides, without a model of time and error')
   end subroutine print_expectation

   !> Counts by status and where the results are.
   subroutine print_sweep_result(unit, progress, output)
      integer, intent(in) :: unit
      type(progress_t), intent(in) :: progress
      character(len=*), intent(in) :: output   !! results file
      integer :: status

      do status = 0, last_status
         if (progress%counts(status) > 0) call say(unit, counted(progress%counts(status), 7, status_name(status)))
      end do
      if (progress%done() < progress%total) &
         call say(unit, counted(progress%total - progress%done(), 7, status_name(status_pending)))
      call say(unit, to_text(progress%seconds, 4)//' s of computing, results in '//output)
      if (progress%failed() > 0) call say(unit, 'Cases that did not converge are rows with their status and message.')
   end subroutine print_sweep_result

end module ehlwave_sweep_report
