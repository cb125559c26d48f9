!> The rescue ladder: further attempts when a solve fails, rung by rung, under a common cap on the work of a case.
!>
!> Rungs, in this order: from the previous solution (time steps only), continuation from an easier neighbour,
!> Newton's method where another method was requested, Newton's method with short steps, PETSc where the build has
!> it.
module ehlwave_rescue
   use ehlwave_capped_solver, only: capped_solver_t
   use ehlwave_continuation, only: adaptive_path_t, neighbour_t
   use ehlwave_full_multigrid, only: full_multigrid_t
   use ehlwave_given, only: given_t
   use ehlwave_kinds, only: dp
   use ehlwave_level_solver, only: level_solver_t
   use ehlwave_newton, only: newton_t
   use ehlwave_petsc_library, only: has_petsc
   use ehlwave_petsc_solver, only: petsc_solver_t
   use ehlwave_solve_report, only: solve_limits_t, solve_report_t
   use ehlwave_state, only: state_t
   use ehlwave_status, only: status_converged
   use ehlwave_step_limit, only: step_limit_t
   implicit none (type, external)
   private
   public :: rung_name

   integer, parameter, public :: rung_direct = 0, rung_restart = 1, rung_continuation = 2, rung_newton = 3, &
                                 rung_damped = 4, rung_petsc = 5

   !> Limits of damped
   type(step_limit_t), parameter :: short_steps = step_limit_t(largest_change=0.05_dp, smallest_film_factor=0.5_dp)
   integer, parameter :: damped_patience = 4           !! times as many steps as usual
   integer, parameter :: steps_below = 20              !! for a level that starts from the next finer solution

   type, extends(capped_solver_t), public :: rescue_t
      logical :: is_ready = .true.       !! climb the ladder; false: cheap attempts only
      integer :: rung = rung_direct      !! the highest rung that a solution needed, or that failed
      integer :: rescued = 0             !! solutions that took more than the direct solve
   contains
      procedure :: solve_steady
      procedure :: solve_step
   end type rescue_t

contains

   !> Name of a rung as written to results.
   pure function rung_name(rung) result(name)
      integer, intent(in) :: rung
      character(len=:), allocatable :: name
      select case (rung)
      case (rung_direct); name = 'direct'
      case (rung_restart); name = 'restart'
      case (rung_continuation); name = 'continuation'
      case (rung_newton); name = 'newton'
      case (rung_damped); name = 'damped'
      case (rung_petsc); name = 'petsc'
      case default; name = 'unknown'
      end select
   end function rung_name

   !> Steady state on the finest level: full multigrid, then the ladder. The report of the finest level holds the
   !> steps of all attempts. However it was found, the levels next below end with solutions of the same contact, or with
   !> none.
   subroutine solve_steady(self, multigrid, limits, coarse_tolerance)
      class(rescue_t), intent(inout) :: self
      type(full_multigrid_t), intent(inout) :: multigrid
      type(solve_limits_t), intent(in) :: limits       !! for the finest level
      real(dp), intent(in) :: coarse_tolerance         !! for the others, and for neighbours

      call find_steady(self, multigrid, limits, coarse_tolerance)
      associate (n => size(multigrid%levels))
         if (multigrid%levels(n)%report%status /= status_converged .or. .not. self%is_ready) return
         call multigrid%take_film(n)
      end associate
      call self%solve_below(multigrid, solve_limits_t(max(limits%tolerance, coarse_tolerance), &
                                                      min(limits%largest_steps, steps_below)))
   end subroutine solve_steady

   !> The finest level of it.
   subroutine find_steady(self, multigrid, limits, coarse_tolerance)
      type(rescue_t), intent(inout) :: self
      type(full_multigrid_t), intent(inout) :: multigrid
      type(solve_limits_t), intent(in) :: limits
      real(dp), intent(in) :: coarse_tolerance
      type(state_t) :: guess
      integer :: n

      n = size(multigrid%levels)
      associate (level => multigrid%levels(n))
         level%report = solve_report_t()
         call self%attempt_from_coarsest(multigrid, limits, coarse_tolerance)
         if (level%report%status == status_converged .or. .not. self%is_ready) return
         call multigrid%start_level(n)
         guess = level%state
         call continue_conditions(self, multigrid, limits, coarse_tolerance)
         call note(self, level%report, rung_continuation)
         if (level%report%status == status_converged) return
         call climb(self, multigrid, guess, limits)
      end associate
   end subroutine find_steady

   !> A solution of the finest level, from the first guess in its state: a time step, or a stationary pattern. If it
   !> fails: from the previous solution, then the ladder.
   subroutine solve_step(self, multigrid, before, given_before, limits)
      class(rescue_t), intent(inout) :: self
      type(full_multigrid_t), intent(inout) :: multigrid
      type(state_t), intent(in) :: before              !! the last solution
      type(given_t), intent(in) :: given_before        !! its given data
      type(solve_limits_t), intent(in) :: limits
      logical :: starts_there

      associate (level => multigrid%levels(size(multigrid%levels)))
         level%report = solve_report_t()
         starts_there = .not. any(abs(level%state%p - before%p) > 0)
         call self%attempt(multigrid, limits)
         if (level%report%status == status_converged) return
         if (.not. starts_there) then
            level%state = before
            call self%attempt(multigrid, limits)
            call note(self, level%report, rung_restart)
            if (level%report%status == status_converged) return
         end if
         if (.not. self%is_ready) return
         call continue_step(self, multigrid, before, given_before, limits)
         call note(self, level%report, rung_continuation)
         if (level%report%status == status_converged) return
      end associate
      call climb(self, multigrid, before, limits)
   end subroutine solve_step

   !> The rungs that need nothing but another solver.
   subroutine climb(self, multigrid, guess, limits)
      type(rescue_t), intent(inout) :: self
      type(full_multigrid_t), intent(inout) :: multigrid
      type(state_t), intent(in) :: guess
      type(solve_limits_t), intent(in) :: limits
      class(level_solver_t), allocatable :: solver
      type(solve_limits_t) :: patient
      type(newton_t) :: newton
      integer :: rung

      associate (level => multigrid%levels(size(multigrid%levels)))
         do rung = rung_newton, rung_petsc
            if (self%is_spent()) return
            if (rung == rung_newton .and. same_type_as(multigrid%solver, newton)) cycle
            level%state = guess
            patient = limits
            if (allocated(solver)) deallocate (solver)
            if (rung == rung_petsc) then
               if (.not. has_petsc()) return      ! the last rung
               allocate (petsc_solver_t :: solver)
            else
               if (rung == rung_damped) then
                  newton%limit = short_steps
                  patient%largest_steps = damped_patience*limits%largest_steps
               end if
               allocate (solver, source=newton)
            end if
            call solver%init(multigrid%hierarchy_t, size(multigrid%levels))
            call self%attempt(multigrid, patient, solver)
            call note(self, level%report, rung)
            if (level%report%status == status_converged) return
         end do
      end associate
   end subroutine climb

   !> Continuation in M and L, before that in the stress of the flow law: solve an easier neighbour from scratch, then
   !> approach the case from it.
   subroutine continue_conditions(self, multigrid, limits, coarse_tolerance)
      type(rescue_t), intent(inout) :: self
      type(full_multigrid_t), intent(inout) :: multigrid
      type(solve_limits_t), intent(in) :: limits
      real(dp), intent(in) :: coarse_tolerance
      type(neighbour_t) :: neighbour
      type(adaptive_path_t) :: path
      type(solve_limits_t) :: loose
      type(state_t) :: last
      integer :: distance

      loose = limits
      loose%tolerance = max(limits%tolerance, coarse_tolerance)
      associate (level => multigrid%levels(size(multigrid%levels)))
         do distance = merge(1, 0, level%problem%rheology%is_newtonian()), 3
            call neighbour%choose(multigrid%hierarchy_t, distance)
            call neighbour%impose(multigrid%hierarchy_t, 0.0_dp)
            call self%attempt_from_coarsest(multigrid, loose, coarse_tolerance)
            path = adaptive_path_t()
            last = level%state
            do while (level%report%status == status_converged .or. path%can_retry())
               if (level%report%status == status_converged) then
                  if (path%is_at_end()) exit
                  last = level%state
               end if
               call path%advance(level%report%status == status_converged)
               call neighbour%impose(multigrid%hierarchy_t, path%place)
               level%state = last
               if (path%is_at_end()) then
                  call self%attempt(multigrid, limits)
               else
                  call self%attempt(multigrid, loose)
               end if
            end do
            call neighbour%impose(multigrid%hierarchy_t, 1.0_dp)
            if (level%report%status == status_converged .or. self%is_spent()) return
         end do
      end associate
   end subroutine continue_conditions

   !> Continuation from the last solution: given data change gradually from their former to their present values.
   subroutine continue_step(self, multigrid, before, given_before, limits)
      type(rescue_t), intent(inout) :: self
      type(full_multigrid_t), intent(inout) :: multigrid
      type(state_t), intent(in) :: before
      type(given_t), intent(in) :: given_before
      type(solve_limits_t), intent(in) :: limits
      type(adaptive_path_t) :: path
      type(given_t) :: now
      type(state_t) :: last
      logical :: is_solved

      associate (level => multigrid%levels(size(multigrid%levels)))
         now = level%given
         last = before
         is_solved = .true.
         do while (is_solved .or. path%can_retry())
            if (is_solved .and. path%is_at_end()) exit
            call path%advance(is_solved)
            level%given = given_before%blend(now, path%place)
            level%state = last
            call self%attempt(multigrid, limits)
            is_solved = level%report%status == status_converged
            if (is_solved) last = level%state
         end do
         level%given = now
      end associate
   end subroutine continue_step

   !> Keep the rung of a solution.
   pure subroutine note(self, report, rung)
      type(rescue_t), intent(inout) :: self
      type(solve_report_t), intent(in) :: report
      integer, intent(in) :: rung
      self%rung = max(self%rung, rung)
      if (report%status == status_converged) self%rescued = self%rescued + 1
   end subroutine note

end module ehlwave_rescue
