!> The discrete problem of one level as a variational inequality, solved by SNES of PETSc: an independent reference.
!>
!> Shares with `newton` the discrete equations only: Newton's method, active set, line search, GMRES and the
!> incomplete factors are PETSc's (SNESVINEWTONRSLS, Benson and Munson 2006). Where PETSc is absent,
!> `petsc_solver_absent.f90` takes the place of this file.
module ehlwave_petsc_solver
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use, intrinsic :: iso_c_binding, only: c_double, c_f_pointer, c_funloc, c_funptr, c_int, c_loc, c_null_funptr, &
      c_null_ptr, c_ptr
   use ehlwave_contact_problem, only: contact_problem_t
   use ehlwave_errors, only: error_t
   use ehlwave_formula, only: moes_film_formula
   use ehlwave_kernel, only: cell_influence
   use ehlwave_kinds, only: dp
   use ehlwave_level_solver, only: level_solver_t, mass_gain, solve_limits_t, solve_report_t
   use ehlwave_load_balance, only: load_factor
   use ehlwave_near_stencil, only: near_stencil_t, new_near_stencil
   use ehlwave_reynolds, only: diagonal_scale, flow_t, new_flow, reynolds_jacobian, reynolds_residual
   use ehlwave_state, only: state_t
   use ehlwave_status, only: status_converged, status_diverged, status_not_finite, status_stalled
   implicit none (type, external)
   private
   public :: finish_petsc, require_petsc

   logical, parameter, public :: has_petsc = .true.   !! whether this build has PETSc

   !> Unit of the vectors that PETSc sees. Its active set takes an unknown below 1e-8 for one at its bound; true
   !> pressures near the free boundary are smaller than that, and then Newton's method loses its speed (measured:
   !> M = 2000, D = 1, 257^2: the residual falls by 0.4 a step in place of quadratically).
   real(dp), parameter :: unit = 1e-8_dp
   integer, parameter :: largest_reach = 8                ! cells of the near stencil
   integer, parameter :: go_on = 0, judged_converged = 1, judged_broken = 2   ! as in petsc_snes.c
   integer, parameter :: out_of_steps = -5                ! SNES_DIVERGED_MAX_IT
   integer, parameter :: largest_trials = 40              ! of a step length

   !> P >= 0, F >= 0, P F = 0 at the unknown nodes, with the load balance for Delta, as vectors:
   !>
   !>     F = -R |A_ii|^(-1/4)   node (i, j), number (i - 1) rows + j - first_row + 1: flow order
   !>     F = load balance       last
   !>
   !> The weights |A_ii|^(-1/4) are those of the state a call of SNES starts from.
   type :: inequality_t
      type(contact_problem_t), pointer :: problem => null()
      integer :: n = 0, rows = 0                  ! unknowns; unknown nodes along Y
      type(near_stencil_t) :: stencil
      integer(c_int), allocatable :: row_start(:), column(:)   ! pattern of the near matrix, counted from 0
      real(dp) :: self_influence = 0
      ! the state met last, (0:nx, 0:ny)
      real(dp), allocatable, dimension(:, :) :: p, h, r, scale
      real(dp) :: delta = 0
      type(flow_t) :: flow
      ! the state of the linearisation
      real(dp), allocatable, dimension(:, :) :: base_p, base_h
      real(dp) :: base_delta = 0
      type(flow_t) :: base_flow
      ! scratch
      real(dp), allocatable, dimension(:, :) :: weight, change, film_change, work
      real(dp), allocatable :: near(:, :, :)      ! (nx-1, entries, first_row:ny-1) near part of the Jacobian
      ! judgement
      real(dp) :: tolerance = 0, smallest_film_factor = 0, largest_change = 0
      real(dp) :: residual = 0, complementarity = 0, load_error = 0
      real(dp) :: least = huge(1.0_dp)            ! the smallest worst of the three so far,
      real(dp), allocatable :: best(:)            ! and where it was found
      real(dp), allocatable :: history(:)
   end type inequality_t

   !> Newton steps are limited so that no pressure changes by more than `largest_change` and no film thickness
   !> falls below `smallest_film_factor` of its value, then shortened by a line search. When that fails, a second
   !> round goes on from the best state without line search.
   type, extends(level_solver_t), public :: petsc_solver_t
      real(dp) :: largest_change = 0.3_dp
      real(dp) :: smallest_film_factor = 0.1_dp
      real(dp) :: linear_tolerance = 1e-6_dp     !! of GMRES, relative to the right side
      integer :: largest_krylov = 400            !! GMRES steps of one Newton step
      integer :: restart = 100
      integer :: fill_levels = 1                 !! of the incomplete factors
      type(inequality_t), private :: inequality
   contains
      procedure :: init
      procedure :: solve
   end type petsc_solver_t

   ! Types and functions of petsc_snes.c
   type, bind(c) :: equations_t
      type(c_ptr) :: context = c_null_ptr
      type(c_funptr) :: evaluate = c_null_funptr, linearise = c_null_funptr, multiply = c_null_funptr
      type(c_funptr) :: step_length = c_null_funptr, judge = c_null_funptr
   end type equations_t

   type, bind(c) :: settings_t
      integer(c_int) :: backtracks, fill_levels, largest_steps, restart, largest_krylov
      real(c_double) :: linear_tolerance
   end type settings_t

   type, bind(c) :: outcome_t
      integer(c_int) :: reason = 0, steps = 0, linear_steps = 0
   end type outcome_t

   interface
      integer(c_int) function solve_inequality(n, row_start, column, x, lower, settings, equations, outcome) &
         bind(c, name='ehlwave_solve_inequality')
         import :: c_double, c_int, equations_t, outcome_t, settings_t
         implicit none (type, external)
         integer(c_int), value :: n
         integer(c_int), intent(in) :: row_start(*), column(*)
         real(c_double), intent(inout) :: x(*)
         real(c_double), intent(in) :: lower(*)
         type(settings_t), intent(in) :: settings
         type(equations_t), intent(inout) :: equations
         type(outcome_t), intent(inout) :: outcome
      end function solve_inequality

      !> End PETSc if this module started it, and MPI if it started that too. For drivers: after the last solve,
      !> before MPI_Finalize. No solve afterwards.
      subroutine finish_petsc() bind(c, name='ehlwave_finish_petsc')
         implicit none (type, external)
      end subroutine finish_petsc
   end interface

contains

   !> An error in builds without PETSc.
   subroutine require_petsc(error)
      type(error_t), allocatable, intent(out) :: error
      if (.false.) allocate (error)   ! never; silences a warning
   end subroutine require_petsc

   !> Work space for a problem's grid. PETSc itself is started by the first solve.
   subroutine init(self, problem)
      class(petsc_solver_t), intent(inout) :: self
      type(contact_problem_t), intent(in), target :: problem
      type(inequality_t) :: blank
      real(dp), allocatable :: zero(:, :)

      self%inequality = blank
      associate (grid => problem%grid, elliptic => problem%conditions%elliptic, eq => self%inequality)
         eq%rows = grid%ny - grid%first_row
         eq%n = eq%rows*(grid%nx - 1) + 1
         eq%stencil = new_near_stencil(grid, elliptic%kappa, elliptic%k, largest_reach, 0.0_dp)
         eq%self_influence = cell_influence(0.0_dp, 0.0_dp, grid%hx, grid%hy, elliptic%kappa, elliptic%k)
         eq%flow = new_flow(grid)
         eq%base_flow = eq%flow
         allocate (zero(0:grid%nx, 0:grid%ny), source=0.0_dp)
         allocate (eq%p, eq%h, eq%r, eq%scale, eq%base_p, eq%base_h, source=zero)
         allocate (eq%weight, eq%change, eq%film_change, eq%work, source=zero)
         allocate (eq%near(grid%nx - 1, eq%stencil%entries, grid%first_row:grid%ny - 1), eq%best(eq%n), source=0.0_dp)
         call make_pattern(eq, grid%nx - 1)
      end associate
   end subroutine init

   !> Pattern of the near matrix: the stencil and the Delta column at each node, then the load row.
   pure subroutine make_pattern(eq, columns)
      type(inequality_t), intent(inout) :: eq
      integer, intent(in) :: columns   !! unknown nodes along X
      integer :: di, dj, entries, i, j, k

      allocate (eq%row_start(eq%n + 1), source=0_c_int)
      allocate (eq%column(eq%n*(eq%stencil%entries + 2)), source=0_c_int)
      entries = 0
      do i = 1, columns
         do j = 1, eq%rows
            k = (i - 1)*eq%rows + j
            do di = max(-eq%stencil%reach_x, 1 - i), min(eq%stencil%reach_x, columns - i)
               do dj = max(-eq%stencil%reach_y, 1 - j), min(eq%stencil%reach_y, eq%rows - j)
                  entries = entries + 1
                  eq%column(entries) = k - 1 + di*eq%rows + dj
               end do
            end do
            entries = entries + 1
            eq%column(entries) = eq%n - 1
            eq%row_start(k + 1) = entries
         end do
      end do
      do k = 1, eq%n
         eq%column(entries + k) = k - 1
      end do
      entries = entries + eq%n
      eq%row_start(eq%n + 1) = entries
      eq%column = eq%column(:entries)
   end subroutine make_pattern

   !> See the interface. Hands back the best state met. A guess whose surfaces overlap is opened first.
   subroutine solve(self, problem, state, limits, report)
      class(petsc_solver_t), intent(inout) :: self
      type(contact_problem_t), intent(inout), target :: problem
      type(state_t), intent(inout), target :: state
      type(solve_limits_t), intent(in) :: limits
      type(solve_report_t), intent(out) :: report
      type(settings_t) :: settings

      settings = settings_t(1, self%fill_levels, limits%largest_steps, self%restart, self%largest_krylov, &
                            self%linear_tolerance)
      self%inequality%problem => problem
      self%inequality%tolerance = limits%tolerance
      self%inequality%largest_change = self%largest_change
      self%inequality%smallest_film_factor = self%smallest_film_factor
      call run(self%inequality, settings, state, report)
      nullify (self%inequality%problem)
   end subroutine solve

   !> Two rounds of SNES at most, and the account of them.
   subroutine run(eq, settings, state, report)
      type(inequality_t), intent(inout), target :: eq
      type(settings_t), intent(inout) :: settings
      type(state_t), intent(inout) :: state
      type(solve_report_t), intent(inout) :: report
      type(equations_t) :: equations
      type(outcome_t) :: outcome
      real(c_double), allocatable :: x(:), lower(:)
      integer :: round, failure

      equations = equations_t(c_loc(eq), c_funloc(evaluate), c_funloc(linearise), c_funloc(multiply), &
                              c_funloc(step_length), c_funloc(judge))
      allocate (x(eq%n), lower(eq%n), source=0.0_dp)
      lower(eq%n) = -huge(1.0_dp)   ! Delta is free
      eq%history = [real(dp) ::]
      eq%least = huge(1.0_dp)
      call pack_field(eq, max(state%p, 0.0_dp)/unit, eq%best)
      eq%best(eq%n) = state%delta/unit

      call evaluate_state(eq, eq%best)
      if (.not. minval(eq%h) > 0) then   ! surfaces overlap: begin with the film of the formula at the closest point
         eq%best(eq%n) = eq%best(eq%n) + (minval(eq%h) - moes_film_formula(eq%problem%conditions) &
                                          /eq%problem%conditions%moes_film_factor)/unit
         call evaluate_state(eq, eq%best)
      end if
      call measure(eq)
      do round = 1, 2
         if (verdict(eq) /= go_on .or. settings%largest_steps <= 0) exit
         settings%backtracks = merge(1, 0, round == 1)
         eq%weight = sqrt(sqrt(eq%scale))
         x = eq%best
         failure = solve_inequality(int(eq%n, c_int), eq%row_start, eq%column, x, lower, settings, equations, outcome)
         if (failure /= 0) exit
         report%nonlinear_steps = report%nonlinear_steps + outcome%steps
         report%linear_steps = report%linear_steps + outcome%linear_steps
         report%factorisations = report%nonlinear_steps
         settings%largest_steps = settings%largest_steps - max(outcome%steps, 1)
         call evaluate_state(eq, eq%best)
         call measure(eq)
      end do

      report%residual = eq%residual
      report%complementarity = eq%complementarity
      report%load_error = eq%load_error
      report%history = eq%history
      state%p = eq%p
      state%h = eq%h
      state%delta = eq%delta
      select case (verdict(eq))
      case (judged_converged)
         report%status = status_converged
      case (judged_broken)
         report%status = status_not_finite
      case default
         report%status = merge(status_stalled, status_diverged, outcome%reason == out_of_steps)
      end select
   end subroutine run

   !> Vector of the values at the unknown nodes.
   pure subroutine pack_field(eq, field, x)
      type(inequality_t), intent(in) :: eq
      real(dp), intent(in) :: field(0:, 0:)
      real(dp), intent(inout) :: x(:)
      integer :: i, j, low

      low = eq%problem%grid%first_row - 1
      do i = 1, eq%problem%grid%nx - 1
         do j = 1, eq%rows
            x((i - 1)*eq%rows + j) = field(i, j + low)
         end do
      end do
   end subroutine pack_field

   !> Values at the unknown nodes of a vector times `factor`; the outer boundary is left as it is.
   pure subroutine unpack_field(eq, factor, x, field)
      type(inequality_t), intent(in) :: eq
      real(dp), intent(in) :: factor, x(:)
      real(dp), intent(inout) :: field(0:, 0:)
      integer :: i, j, low

      low = eq%problem%grid%first_row - 1
      do j = 1, eq%rows
         do i = 1, eq%problem%grid%nx - 1
            field(i, j + low) = factor*x((i - 1)*eq%rows + j)
         end do
      end do
   end subroutine unpack_field

   !> Pressure, film, flow, residual and row scale of a vector.
   subroutine evaluate_state(eq, x)
      type(inequality_t), intent(inout) :: eq
      real(dp), intent(in) :: x(:)

      associate (problem => eq%problem, kappa => eq%problem%conditions%elliptic%kappa)
         call unpack_field(eq, unit, x, eq%p)
         eq%delta = unit*x(eq%n)
         call problem%film(eq%p, eq%delta, eq%h)
         call eq%flow%evaluate(problem%rheology, problem%conditions%lambdabar, eq%p, eq%h)
         call reynolds_residual(problem%grid, problem%transport, kappa, eq%flow, eq%p, eq%r)
         call diagonal_scale(problem%grid, problem%transport, kappa, eq%self_influence, eq%flow, eq%scale)
      end associate
   end subroutine evaluate_state

   !> The three numbers of `solve_report_t` for the state met last.
   subroutine measure(eq)
      type(inequality_t), intent(inout) :: eq
      real(dp) :: centre
      integer :: i, j

      associate (grid => eq%problem%grid, load => eq%problem%load)
         eq%residual = 0
         centre = grid%value_at_centre(eq%h)
         eq%complementarity = 0
         do j = grid%first_row, grid%ny - 1
            do i = 1, grid%nx - 1
               if (eq%p(i, j) + eq%scale(i, j)*eq%r(i, j) <= 0) then
                  eq%complementarity = max(eq%complementarity, abs(eq%p(i, j)))
               else
                  eq%residual = max(eq%residual, mass_gain(eq%r(i, j), grid%hx, eq%h(i, j), centre))
               end if
            end do
         end do
         if (.not. ieee_is_finite(sum(eq%r))) eq%residual = sum(eq%r)
         eq%load_error = abs(load%residual(grid%integral(eq%p), eq%delta))/abs(load%force)
      end associate
   end subroutine measure

   !> What `measure` found, against the tolerance.
   pure integer(c_int) function verdict(eq)
      type(inequality_t), intent(in) :: eq

      if (.not. (ieee_is_finite(eq%residual) .and. ieee_is_finite(eq%load_error))) then
         verdict = judged_broken
      else if (max(eq%residual, eq%complementarity, eq%load_error) <= eq%tolerance) then
         verdict = judged_converged
      else
         verdict = go_on
      end if
   end function verdict

   !> to = F(from). Callback of petsc_snes.c, as all that follow.
   subroutine evaluate(context, from, to) bind(c)
      type(c_ptr), intent(in), value :: context, from, to
      type(inequality_t), pointer :: eq
      real(c_double), pointer, contiguous :: x(:), f(:)

      call c_f_pointer(context, eq)
      call c_f_pointer(from, x, [eq%n])
      call c_f_pointer(to, f, [eq%n])
      call evaluate_state(eq, x)
      call pack_field(eq, -eq%weight*eq%r/unit, f)
      f(eq%n) = eq%problem%load%residual(eq%problem%grid%integral(eq%p), eq%delta)/unit
   end subroutine evaluate

   !> Linearise about `from`; `to`: nonzeros of the near matrix, local terms and deformation by the nearest cells.
   subroutine linearise(context, from, to) bind(c)
      type(c_ptr), intent(in), value :: context, from, to
      type(inequality_t), pointer :: eq
      real(c_double), pointer, contiguous :: x(:), a(:)
      integer :: di, dj, entry, i, j, load_row

      call c_f_pointer(context, eq)
      call c_f_pointer(from, x, [eq%n])
      call c_f_pointer(to, a, [size(eq%column)])
      call evaluate_state(eq, x)
      eq%base_p = eq%p
      eq%base_h = eq%h
      eq%base_delta = eq%delta
      eq%base_flow = eq%flow
      associate (problem => eq%problem, grid => eq%problem%grid, kappa => eq%problem%conditions%elliptic%kappa, &
                 stencil => eq%stencil)
         eq%change = 0
         eq%film_change = -1   ! Delta column: dH = -1
         call reynolds_jacobian(grid, problem%transport, kappa, eq%base_flow, eq%base_p, eq%change, eq%film_change, &
                                eq%r, eq%work)
         do j = grid%first_row, grid%ny - 1
            call stencil%fill_line(grid, problem%transport, kappa, eq%base_flow, eq%base_p, j, eq%near(:, :, j))
         end do
         entry = 0
         load_row = eq%row_start(eq%n)
         do i = 1, grid%nx - 1
            do j = grid%first_row, grid%ny - 1
               do di = max(-stencil%reach_x, 1 - i), min(stencil%reach_x, grid%nx - 1 - i)
                  do dj = max(-stencil%reach_y, grid%first_row - j), min(stencil%reach_y, grid%ny - 1 - j)
                     entry = entry + 1
                     a(entry) = -eq%weight(i, j)*eq%near(i, stencil%entry_at(di, dj), j)
                  end do
               end do
               entry = entry + 1
               a(entry) = -eq%weight(i, j)*eq%r(i, j)
               load_row = load_row + 1
               a(load_row) = load_factor*grid%hx*grid%hy*grid%weight(j)
            end do
         end do
         a(size(a)) = problem%load%inertia
      end associate
   end subroutine linearise

   !> to = F'(x_0) from, deformation by FFT included.
   subroutine multiply(context, from, to) bind(c)
      type(c_ptr), intent(in), value :: context, from, to
      type(inequality_t), pointer :: eq
      real(c_double), pointer, contiguous :: x(:), y(:)

      call c_f_pointer(context, eq)
      call c_f_pointer(from, x, [eq%n])
      call c_f_pointer(to, y, [eq%n])
      associate (problem => eq%problem)
         call unpack_field(eq, 1.0_dp, x, eq%change)
         call problem%deformation%apply(eq%change, eq%film_change)
         eq%film_change = eq%film_change - x(eq%n)
         call reynolds_jacobian(problem%grid, problem%transport, problem%conditions%elliptic%kappa, eq%base_flow, &
                                eq%base_p, eq%change, eq%film_change, eq%r, eq%work)
         call pack_field(eq, -eq%weight*eq%r, y)
         y(eq%n) = load_factor*problem%grid%integral(eq%change) + problem%load%inertia*x(eq%n)
      end associate
   end subroutine multiply

   !> Longest step, at most 1, along -from with pressures cut off at 0 that keeps to the limits; 0 if there is none.
   real(c_double) function step_length(context, from) bind(c) result(step)
      type(c_ptr), intent(in), value :: context, from
      type(inequality_t), pointer :: eq
      real(c_double), pointer, contiguous :: x(:)
      real(dp) :: largest
      integer :: trial

      call c_f_pointer(context, eq)
      call c_f_pointer(from, x, [eq%n])
      step = 0
      if (.not. ieee_is_finite(sum(x))) return
      call unpack_field(eq, unit, x, eq%change)
      largest = maxval(abs(eq%change), mask=eq%change < eq%base_p)   ! those not cut off by a full step
      step = 1
      if (largest > eq%largest_change) step = eq%largest_change/largest
      do trial = 1, largest_trials
         call eq%problem%film(max(eq%base_p - step*eq%change, 0.0_dp), eq%base_delta - step*unit*x(eq%n), &
                              eq%film_change)
         if (all(eq%film_change >= eq%smallest_film_factor*eq%base_h)) return
         step = 0.7_dp*step
      end do
      step = 0
   end function step_length

   !> Verdict on the state of a vector; the best one is remembered.
   integer(c_int) function judge(context, from) bind(c)
      type(c_ptr), intent(in), value :: context, from
      type(inequality_t), pointer :: eq
      real(c_double), pointer, contiguous :: x(:)
      real(dp) :: worst

      call c_f_pointer(context, eq)
      call c_f_pointer(from, x, [eq%n])
      call evaluate_state(eq, x)
      call measure(eq)
      eq%history = [eq%history, eq%residual]
      judge = verdict(eq)
      if (judge == judged_broken) return
      worst = max(eq%residual, eq%complementarity, eq%load_error)
      if (worst < eq%least) then
         eq%least = worst
         eq%best = x
      end if
   end function judge

end module ehlwave_petsc_solver
