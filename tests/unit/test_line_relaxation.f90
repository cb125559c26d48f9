!> The hybrid line relaxation: a solution stays a solution, and errors that change from node to node are smoothed
!> both where Poiseuille flow rules and where the deformation does.
program test_line_relaxation
   use ehlwave_contact_problem, only: contact_problem_t
   use ehlwave_equations, only: equations_t
   use ehlwave_given, only: given_t
   use ehlwave_hierarchy, only: hierarchy_t
   use ehlwave_kinds, only: dp
   use ehlwave_line_relaxation, only: line_relaxation_t
   use ehlwave_newton, only: newton_t
   use ehlwave_solve_report, only: solve_limits_t, solve_report_t
   use ehlwave_state, only: new_state, state_t
   use ehlwave_status, only: status_converged
   use ehlwave_text, only: to_text
   use sample_contact, only: make_level, noise, start_time_step
   use testing, only: test_t
   implicit none (type, external)

   integer, parameter :: cells = 64
   real(dp), parameter :: size_of_error = 1e-6_dp
   type(test_t) :: test

   call check_contact(100.0_dp, 1.0_dp, .true., 'M = 100, D = 1')
   call check_contact(100.0_dp, 1.0_dp, .false., 'M = 100, D = 1, whole domain')
   call check_contact(100.0_dp, 0.12_dp, .true., 'M = 100, D = 0.12')
   call check_contact(200.0_dp, 0.04_dp, .true., 'M = 200, D = 0.04')
   call check_cavitation()
   call test%finish()

contains

   subroutine check_contact(m, d, is_half, name)
      real(dp), intent(in) :: m, d
      logical, intent(in) :: is_half
      character(len=*), intent(in) :: name
      type(hierarchy_t) :: single
      type(state_t) :: solution

      allocate (single%levels(1))
      associate (problem => single%levels(1)%problem, given => single%levels(1)%given)
         call make_level(single%levels(1), m, d, cells, is_half)
         call solve(single, solution, name)
         call check_smoothing(problem, given, solution, name//', steady')
         call start_time_step(problem, solution, given)
         call solve(single, solution, name//', time step')
         call check_smoothing(problem, given, solution, name//', time step')
      end associate
   end subroutine check_contact

   !> Newton's solution, from a Hertz guess when there is none.
   subroutine solve(single, state, name)
      type(hierarchy_t), intent(inout) :: single   !! hierarchy of a single level
      type(state_t), intent(inout) :: state
      character(len=*), intent(in) :: name
      type(newton_t) :: newton
      type(solve_report_t) :: report

      associate (level => single%levels(1))
         if (allocated(state%p)) then
            level%state = state
         else
            level%state = new_state(level%problem%grid)
            call single%start_level(1)
         end if
         call newton%init(single, 1)
         call newton%solve(single, 1, solve_limits_t(tolerance=1e-11_dp, largest_steps=60), report)
         state = level%state
      end associate
      call test%check(report%status == status_converged, name//': there is a solution')
   end subroutine solve

   !> Two sweeps on the solution with noise: the noise falls in the inlet and in the middle of the contact.
   subroutine check_smoothing(problem, given, solution, name)
      type(contact_problem_t), intent(inout) :: problem
      type(given_t), intent(in) :: given
      type(state_t), intent(in) :: solution
      character(len=*), intent(in) :: name
      type(line_relaxation_t) :: relaxation
      type(equations_t) :: equations
      type(state_t) :: next, state
      real(dp), allocatable :: h(:, :)
      real(dp) :: inlet(0:2), middle(0:2)
      integer :: i, j, n

      call relaxation%init(problem)
      call equations%init(problem)
      state = solution
      next = solution
      call equations%evaluate(problem, given, state)
      call relaxation%relax(problem, given, equations, state, next)
      call test%check_close(maxval(abs(state%p - solution%p)), 0.0_dp, name//': a solution stays', absolute=1e-8_dp)

      state = solution
      do j = problem%grid%first_row, problem%grid%last_row
         do i = 1, problem%grid%nx - 1
            if (solution%p(i, j) > 0) state%p(i, j) = solution%p(i, j)*(1 + size_of_error*noise(i, j))
         end do
      end do
      call problem%film(given, state%p, state%delta, state%h)
      call measure(problem, solution, state, inlet(0), middle(0))
      do n = 1, 2
         call equations%evaluate(problem, given, state)
         call relaxation%relax(problem, given, equations, state, next)
         call measure(problem, solution, state, inlet(n), middle(n))
      end do
      print '(a)', name//': noise left in the inlet '//to_text(inlet(2)/inlet(0), 2)//', in the middle '// &
         to_text(middle(2)/middle(0), 2)
      call test%check(inlet(1) < 0.5_dp*inlet(0), name//': first sweep, inlet')
      call test%check(middle(1) < 0.6_dp*middle(0), name//': first sweep, middle')
      call test%check(inlet(2) < 0.2_dp*inlet(0), name//': two sweeps, inlet')
      call test%check(middle(2) < 0.35_dp*middle(0), name//': two sweeps, middle')

      allocate (h, mold=state%h)
      call problem%film(given, state%p, state%delta, h)
      call test%check_close(maxval(abs(h - state%h)), 0.0_dp, name//': the film belongs to the pressure', absolute=1e-12_dp)
   end subroutine check_smoothing

   !> Errors of the pressure, Euclidean norms: relative in the inlet, where it is small, absolute in the middle.
   subroutine measure(problem, solution, state, inlet, middle)
      type(contact_problem_t), intent(in) :: problem
      type(state_t), intent(in) :: solution, state
      real(dp), intent(out) :: inlet, middle
      integer :: i, j
      inlet = 0
      middle = 0
      associate (grid => problem%grid)
         do j = 0, grid%ny
            do i = 0, grid%nx
               if (abs(grid%y(j)) > 0.5_dp) cycle
               if (grid%x(i) > -2 .and. grid%x(i) < -1.5_dp) &
                  inlet = inlet + ((state%p(i, j) - solution%p(i, j))/solution%p(i, j))**2
               if (abs(grid%x(i)) < 0.5_dp) middle = middle + (state%p(i, j) - solution%p(i, j))**2
            end do
         end do
      end associate
      inlet = sqrt(inlet)
      middle = sqrt(middle)
   end subroutine measure

   !> From pressure where the outlet is cavitated the sweeps find the free boundary; no pressure falls below zero.
   subroutine check_cavitation()
      type(hierarchy_t) :: single
      type(line_relaxation_t) :: relaxation
      type(equations_t) :: equations
      type(state_t) :: next, solution, state
      integer :: n

      allocate (single%levels(1))
      associate (problem => single%levels(1)%problem, given => single%levels(1)%given)
         call make_level(single%levels(1), 100.0_dp, 1.0_dp, cells, .true.)
         call solve(single, solution, 'cavitation')
         state = solution
         next = solution
         state%p(52:58, 0:4) = state%p(52:58, 0:4) + 0.01_dp     ! X = 0.75 to 1.1
         call problem%film(given, state%p, state%delta, state%h)
         call relaxation%init(problem)
         call equations%init(problem)
         do n = 1, 10
            call equations%evaluate(problem, given, state)
            call relaxation%relax(problem, given, equations, state, next)
            call test%check(minval(state%p) >= 0, 'no pressure below zero')
         end do
      end associate
      print '(a)', 'pressure left in the cavitated outlet '//to_text(maxval(state%p, mask=solution%p <= 0), 2)
      call test%check(maxval(state%p, mask=solution%p <= 0) < 1e-3_dp, 'pressure leaves the cavitated outlet')
   end subroutine check_cavitation

end program test_line_relaxation
