!> A part of a contact as a problem of its own: the same equations there, and a solution that leaves the whole closer to its own.
program test_patch
   use ehlwave_equations, only: equations_t
   use ehlwave_full_multigrid, only: full_multigrid_t
   use ehlwave_given, only: steady_given
   use ehlwave_hierarchy, only: level_t
   use ehlwave_kinds, only: dp
   use ehlwave_newton, only: newton_t
   use ehlwave_patch, only: cut, patch_grid
   use ehlwave_rescue, only: rescue_t
   use ehlwave_solve_report, only: solve_limits_t, solve_report_t
   use ehlwave_state, only: state_t
   use ehlwave_status, only: status_converged
   use sample_contact, only: make_multigrid, start_time_step
   use testing, only: test_t
   implicit none (type, external)

   type(test_t) :: test

   call check_equations('at the line of symmetry', [20, 0], [52, 16])
   call check_equations('beside it', [24, 6], [48, 22])
   call check_outcome()
   call test%finish()

contains

   !> Residuals and cavitated nodes inside a patch, of a steady state that is not solved and of a time step.
   subroutine check_equations(place, first, last)
      character(len=*), intent(in) :: place
      integer, intent(in) :: first(2), last(2)
      type(full_multigrid_t) :: multigrid
      type(level_t), allocatable :: patch(:)
      integer :: k, n

      call make_multigrid(multigrid, 100.0_dp, 1.0_dp, 64, .true.)
      n = size(multigrid%levels)
      call solve(multigrid)
      allocate (patch(1))
      do k = 1, 2
         associate (level => multigrid%levels(n))
            if (k == 2) call start_time_step(level%problem, level%state, level%given)
            call level%problem%film(level%given, level%state%p, level%state%delta, level%state%h)
            call patch(1)%problem%init(patch_grid(level%problem%grid, first, last), level%problem%conditions, &
                                       level%problem%rheology)
            patch(1)%given = steady_given(patch(1)%problem%grid)
            call compare(place//trim(merge(', steady', ', moving', k == 1)), level, patch(1), first, last)
         end associate
      end do
   end subroutine check_equations

   !> The equations of a patch against the whole contact, and again after the same change of pressure in both, when
   !> films outside no longer match the patch.
   subroutine compare(what, whole, patch, first, last)
      character(len=*), intent(in) :: what
      type(level_t), intent(inout) :: whole, patch
      integer, intent(in) :: first(2), last(2)
      type(equations_t) :: of_patch, of_whole
      real(dp) :: scale
      integer :: i, j, k

      i = (first(1) + last(1))/2
      j = (first(2) + last(2))/2
      do k = 1, 2
         call of_whole%init(whole%problem)
         call of_whole%evaluate(whole%problem, whole%given, whole%state)
         if (k == 1) then
            call cut(whole%problem, whole%given, of_whole, whole%state, &
                     patch_grid(whole%problem%grid, first, last), first, patch)
         else
            patch%state%p(i - first(1), j - first(2)) = patch%state%p(i - first(1), j - first(2)) + 1e-3_dp
         end if
         call patch%problem%film(patch%given, patch%state%p, patch%state%delta, patch%state%h)
         call of_patch%init(patch%problem)
         call of_patch%evaluate(patch%problem, patch%given, patch%state)
         scale = maxval(abs(whole%given%transport%w0))*maxval(whole%state%h(first(1):last(1), first(2):last(2)))
         associate (inner => of_patch%residual(1:last(1) - first(1) - 1, merge(0, 1, first(2) == 0):last(2) - first(2) - 1), &
                    outer => of_whole%residual(first(1) + 1:last(1) - 1, first(2) + merge(0, 1, first(2) == 0):last(2) - 1))
            call test%check_close(maxval(abs(inner - outer))/scale, 0.0_dp, what//': residuals', &
                                  absolute=merge(1e-12_dp, 2e-6_dp, k == 1))
         end associate
         if (k == 2) exit
         whole%state%p(i, j) = whole%state%p(i, j) + 1e-3_dp
         call whole%problem%film(whole%given, whole%state%p, whole%state%delta, whole%state%h)
      end do
      whole%state%p(i, j) = whole%state%p(i, j) - 1e-3_dp
   end subroutine compare

   !> Newton's method with patches and without comes to the same solution of a time step.
   subroutine check_outcome()
      type(full_multigrid_t) :: multigrid
      type(newton_t) :: plain
      type(solve_report_t) :: alone, helped
      type(solve_limits_t) :: limits
      type(state_t) :: guess, solution
      integer :: n

      call make_multigrid(multigrid, 100.0_dp, 1.0_dp, 128, .true.)
      n = size(multigrid%levels)
      call solve(multigrid)
      limits = solve_limits_t(1e-9_dp, 40)
      associate (level => multigrid%levels(n))
         call start_time_step(level%problem, level%state, level%given)
         guess = level%state
         call multigrid%solve_level(n, limits, helped)
         solution = level%state
         level%state = guess
         call plain%init(multigrid%hierarchy_t, n)
         call plain%solve(multigrid%hierarchy_t, n, limits, alone)
         call test%check(helped%status == status_converged .and. alone%status == status_converged, 'both converge')
         call test%check_close(maxval(abs(solution%p - level%state%p)), 0.0_dp, 'pressure with patches', absolute=1e-6_dp)
         call test%check(helped%nonlinear_steps < alone%nonlinear_steps, 'fewer steps with patches')
      end associate
   end subroutine check_outcome

   !> The steady state.
   subroutine solve(multigrid)
      type(full_multigrid_t), intent(inout) :: multigrid
      type(rescue_t) :: rescue
      call rescue%solve_steady(multigrid, solve_limits_t(1e-6_dp, 40), 1e-3_dp)
   end subroutine solve

end program test_patch
