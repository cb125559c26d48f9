!> Sensitivities of a steady state whose surfaces may touch: films, friction, and the share or the speed.
module ehlwave_touching_sensitivity
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ehlwave_case_definition, only: case_t
   use ehlwave_case_result, only: case_result_t, gradient_t, gradients, of_central_film, of_friction, &
      of_minimum_film, of_share, of_speed
   use ehlwave_contact_problem, only: contact_problem_t
   use ehlwave_contact_variant, only: contact_variable_t
   use ehlwave_kinds, only: dp, no_value
   use ehlwave_load_balance, only: load_factor
   use ehlwave_planned_case, only: case_plan_t
   use ehlwave_result_slopes, only: result_slope, smooth_results, take_results
   use ehlwave_sensitivity_case, only: all_variables, take_gradient
   use ehlwave_touching_account_result, only: state_of
   use ehlwave_touching_gradient, only: touching_gradient_t
   use ehlwave_touching_newton, only: set_speed, speed_step, touching_solver_t
   use ehlwave_touching_state, only: touching_state_t
   implicit none (type, external)
   private
   public :: find_touching_sensitivities

contains

   !> Derivatives of ln(result) by all variables; those that are not found stay NaN.
   subroutine find_touching_sensitivities(case, plan, solver, state, result)
      type(case_t), intent(in) :: case
      type(case_plan_t), intent(in) :: plan
      type(touching_solver_t), intent(inout) :: solver
      type(touching_state_t), intent(inout) :: state         !! converged
      type(case_result_t), intent(inout) :: result
      type(contact_variable_t), allocatable :: variables(:)
      type(touching_gradient_t) :: touching
      real(dp), allocatable :: adjoints(:, :)
      logical :: is_solved(gradients)
      integer :: n

      allocate (variables, source=all_variables(case, plan, solver%problem))
      allocate (result%by_key(size(variables) - size(result%by_oil)))
      call touching%start(solver, state, case%effects%touching%data%seeks_speed())
      allocate (adjoints(touching%n, gradients), source=0.0_dp)
      call find_adjoints(case, touching, solver, state, result, adjoints, is_solved)
      do n = 1, size(variables)
         call take_gradient(gradient_of(case, touching, solver, state, variables(n), adjoints, is_solved), n, result)
      end do
   end subroutine find_touching_sensitivities

   !> Transposed solves of all results that there are.
   subroutine find_adjoints(case, touching, solver, state, result, adjoints, is_solved)
      type(case_t), intent(in) :: case
      type(touching_gradient_t), intent(inout) :: touching
      type(touching_solver_t), intent(inout) :: solver
      type(touching_state_t), intent(in) :: state
      type(case_result_t), intent(inout) :: result
      real(dp), intent(inout) :: adjoints(:, :)              !! (n, gradients)
      logical, intent(out) :: is_solved(:)
      real(dp), allocatable, dimension(:, :) :: by_c, by_h, by_p, share
      real(dp), dimension(gradients) :: base, by_speed
      integer :: j, of

      associate (grid => solver%problem%grid)
         base = values_of(case, solver%problem, state, state, case%effects%touching%data%solid_friction)
         by_speed = speed_slope(case, solver, state)
         call grid%new_field(share)
         do j = 0, grid%ny
            share(:, j) = load_factor*grid%hx*grid%hy*grid%weight(j)/solver%given%load%force
         end do
         is_solved = .false.
         do of = 1, gradients
            if (.not. ieee_is_finite(base(of))) cycle
            by_c = 0*share
            by_h = by_c
            by_p = by_c
            select case (of)
            case (of_central_film, of_minimum_film)
               call result_slope(solver%problem, state_of(state), of, by_p, by_h)
            case (of_friction)
               call result_slope(solver%problem, state_of(state), of, by_p, by_h)
               associate (solids => case%effects%touching%data%solid_friction*sum(share*state%c)/exp(base(of)))
                  by_p = (1 - solids)*by_p
                  by_h = (1 - solids)*by_h
               end associate
               by_c = case%effects%touching%data%solid_friction*share/exp(base(of))
            case (of_share)
               by_c = share/exp(base(of))
            end select
            result%transposed_work = result%transposed_work - solver%work()
            call touching%solve(by_p, by_h, by_c, by_speed(of), adjoints(:, of), is_solved(of))
            result%transposed_work = result%transposed_work + solver%work()
            result%transposed_solves = result%transposed_solves + 1
         end do
      end associate
   end subroutine find_adjoints

   !> Derivatives of all results by a variable.
   function gradient_of(case, touching, solver, state, variable, adjoints, is_solved) result(gradient)
      type(case_t), intent(in) :: case
      type(touching_gradient_t), intent(inout) :: touching
      type(touching_solver_t), intent(inout) :: solver
      type(touching_state_t), intent(in) :: state
      type(contact_variable_t), intent(in) :: variable
      real(dp), intent(in) :: adjoints(:, :)
      logical, intent(in) :: is_solved(:)
      type(gradient_t) :: gradient
      type(contact_problem_t) :: problem
      type(touching_state_t) :: at
      real(dp) :: b(touching%n)
      integer :: k

      gradient%name = variable%name
      if (.not. allocated(variable%variants)) return
      gradient%of = merge(0.0_dp, no_value, is_solved)
      do k = 1, size(variable%variants)
         associate (variant => variable%variants(k))
            call touching%evaluate(solver, state, case%phase_deg, variable, k, problem, at, b)
            gradient%of = gradient%of + variant%weight*( &
               values_of(case, problem, at, state, variant%touching%solid_friction) + matmul(b, adjoints))
         end associate
         call variable%give_back(solver%problem, problem)
      end do
   end function gradient_of

   !> Logarithms of the results, where they exist; the speed is 1 by itself.
   function values_of(case, problem, state, base, solid_friction) result(values)
      type(case_t), intent(in) :: case
      type(contact_problem_t), intent(in) :: problem
      type(touching_state_t), intent(in) :: state, base      !! as in `take_results`
      real(dp), intent(in) :: solid_friction                 !! friction coefficient of the solids
      real(dp) :: values(gradients)
      real(dp) :: share

      values = no_value
      call take_results(problem, state_of(state), state_of(base), values(:smooth_results))
      values(of_minimum_film + 2:) = no_value
      share = load_factor*problem%grid%integral(state%c)
      values(of_friction) = log(exp(values(of_friction)) + solid_friction*share)
      if (case%effects%touching%data%seeks_speed()) then
         values(of_speed) = 0
      else if (share > 0) then
         values(of_share) = log(share)
      end if
   end function values_of

   !> Derivatives of the results by ln(speed) with the state held, where the share is given.
   function speed_slope(case, solver, state) result(slope)
      type(case_t), intent(in) :: case
      type(touching_solver_t), intent(inout) :: solver
      type(touching_state_t), intent(in) :: state
      real(dp) :: slope(gradients)
      integer :: side

      slope = 0
      if (.not. case%effects%touching%data%seeks_speed()) return
      do side = -1, 1, 2
         call set_speed(solver%problem, state%speed*exp(side*speed_step))
         slope = slope + side/(2*speed_step)* &
                 values_of(case, solver%problem, state, state, case%effects%touching%data%solid_friction)
      end do
      call set_speed(solver%problem, state%speed)
      slope(of_speed) = 1
   end function speed_slope

end module ehlwave_touching_sensitivity
