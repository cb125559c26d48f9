!> Sensitivities of a case: derivatives of film, friction, resistance to rolling and linear response by its inputs.
!>
!> `by_key` has those by every variable of `case/case_variables`. `by_oil` has those by two properties of any oil, which
!> need no key: ln(eta/eta0) at every pressure ('alpha') and the stress of the flow law ('stress'). Load, speed,
!> geometry, E' and viscosity at ambient pressure stay as they are then.
module ehlwave_sensitivity_case
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ehlwave_case_definition, only: case_t
   use ehlwave_case_result, only: case_result_t, gradient_t, of_central_film, of_friction, of_minimum_film, of_phase, &
      of_ratio, of_rolling_coefficient, of_rolling_force
   use ehlwave_case_variables, only: case_variables
   use ehlwave_contact_gradient, only: moved_state
   use ehlwave_contact_problem, only: contact_problem_t
   use ehlwave_contact_variant, only: contact_variable_t
   use ehlwave_harmonic_response, only: harmonic_response_t
   use ehlwave_hierarchy, only: level_t
   use ehlwave_inlet_oil, only: inlet_oil_t
   use ehlwave_kinds, only: dp, no_value
   use ehlwave_planned_case, only: case_plan_t
   use ehlwave_response_gradient, only: differentiate_response, response_basis_t
   use ehlwave_rolling_result, only: rolling_coefficient
   use ehlwave_shared_steady, only: shared_steady_t
   use ehlwave_shear_stress, only: friction_of, knows_stress, shear_stress
   use ehlwave_state, only: state_t
   use ehlwave_status, only: status_converged
   use ehlwave_waviness, only: waviness_t
   implicit none (type, external)
   private
   public :: find_response_sensitivities, find_smooth_sensitivities

   character(len=*), parameter :: oil_names(2) = [character(len=6) :: 'alpha', 'stress']
   real(dp), parameter :: oil_step = 1e-5_dp

contains

   !> Derivatives of the smooth contact; those that are not found stay NaN.
   subroutine find_smooth_sensitivities(case, plan, steady, result)
      type(case_t), intent(in) :: case
      type(case_plan_t), intent(in) :: plan
      type(shared_steady_t), intent(inout) :: steady
      type(case_result_t), intent(inout) :: result
      type(contact_variable_t), allocatable :: variables(:)
      type(gradient_t) :: gradient
      integer :: n, x

      allocate (variables, source=all_variables(case, plan, steady))
      call steady%differentiate(case, variables)
      allocate (result%by_key(size(variables) - size(oil_names)))
      associate (level => steady%multigrid%levels(size(steady%multigrid%levels)))
         do n = 1, size(variables)
            gradient = gradient_t(name=variables(n)%name)
            if (steady%gradient%changes(n)%status == status_converged) &
               call differentiate_results(level, variables(n), steady%gradient%changes(n)%state, gradient)
            x = n - size(result%by_key)
            if (x < 1) then
               result%by_key(n) = gradient
            else
               result%by_oil(x)%film = gradient%of(of_central_film)
            end if
         end do
      end associate
   end subroutine find_smooth_sensitivities

   !> The variables of a case, with the variables of any oil at the end.
   function all_variables(case, plan, steady) result(variables)
      type(case_t), intent(in) :: case
      type(case_plan_t), intent(in) :: plan
      type(shared_steady_t), intent(in) :: steady
      type(contact_variable_t), allocatable :: variables(:)
      type(contact_variable_t) :: oil(size(oil_names))
      integer :: k, x

      associate (problem => steady%multigrid%levels(size(steady%multigrid%levels))%problem)
         do x = 1, size(oil)
            oil(x)%name = oil_names(x)
            if (x == 1 .and. .not. problem%rheology%depends_on_alpha()) cycle
            if (x == 2 .and. problem%rheology%is_newtonian()) cycle
            call oil(x)%place_variants(oil_step, 0)
            do k = 1, size(oil(x)%variants)
               associate (variant => oil(x)%variants(k), factor => exp(oil(x)%variants(k)%place))
                  variant%conditions = problem%conditions
                  variant%inlet = plan%effects%starvation%oil
                  if (plan%responds) variant%waves = plan%surfaces%list(1)
                  variant%natural_frequency = case%natural_frequency
                  if (x == 1) then
                     variant%conditions%alpha_per_pa = factor*problem%conditions%alpha_per_pa
                     variant%conditions%l = factor*problem%conditions%l
                     variant%conditions%alphabar = factor*problem%conditions%alphabar
                     variant%rheology = problem%rheology%with_alpha(factor)
                  else
                     variant%rheology = problem%rheology%with_stress(factor)
                  end if
               end associate
            end do
         end do
      end associate
      variables = [case_variables(case), oil]
   end function all_variables

   !> Derivatives of the results of the smooth contact by a variable.
   subroutine differentiate_results(level, variable, change, gradient)
      type(level_t), intent(inout) :: level
      type(contact_variable_t), intent(in) :: variable
      type(state_t), intent(in) :: change               !! du/dx
      type(gradient_t), intent(inout) :: gradient
      type(contact_problem_t) :: problem
      type(state_t) :: base, state
      real(dp) :: values(of_rolling_force)
      integer :: k

      base = level%state
      call take_results(level%problem, base, base, values)
      gradient%of(:of_rolling_force) = merge(0.0_dp, values, ieee_is_finite(values))   ! NaN stays
      do k = 1, size(variable%variants)
         call variable%stand_in(k, level%problem, problem)
         call moved_state(problem, variable%changes_kernel, level%given, base, change, variable%variants(k)%place, &
                          state)
         call take_results(problem, state, base, values)
         gradient%of(:of_rolling_force) = gradient%of(:of_rolling_force) + variable%variants(k)%weight*values
         call variable%give_back(level%problem, problem)
      end do
   end subroutine differentiate_results

   !> Logarithms of the results of a state beside the base: films in metres where lengths are known, else in units of c.
   !> NaN: no such result.
   subroutine take_results(problem, state, base, values)
      type(contact_problem_t), intent(in) :: problem
      type(state_t), intent(in) :: state, base          !! node of the smallest film and cavitated
                                                        !! nodes of the base
      real(dp), intent(out) :: values(:)
      real(dp), allocatable, dimension(:, :) :: b, factor_x, factor_y, stress
      real(dp) :: friction, length
      integer :: thinnest(2)

      length = 1
      if (problem%conditions%has_dimensions) length = problem%conditions%c_m
      thinnest = minloc(base%h) - 1
      values(of_central_film) = log(length*problem%grid%value_at_centre(state%h))
      values(of_minimum_film) = log(length*state%h(thinnest(1), thinnest(2)))
      friction = 0
      if (knows_stress(problem%conditions)) then
         call shear_stress(problem, state, stress, b, factor_x, factor_y)
         friction = friction_of(problem%grid, stress, base%p, 0.0_dp)
      end if
      values(of_friction) = ln_modulus(friction)
      values(of_rolling_coefficient) = ln_modulus(rolling_coefficient(problem, state))
      associate (data => problem%conditions%data)
         values(of_rolling_force) = values(of_rolling_coefficient) + ln_modulus(max(data%load_n, data%load_n_per_m))
      end associate
   end subroutine take_results

   !> NaN for 0 and NaN.
   elemental real(dp) function ln_modulus(value)
      real(dp), intent(in) :: value
      ln_modulus = no_value
      if (abs(value) > 0) ln_modulus = log(abs(value))
   end function ln_modulus

   !> Derivatives of the transfer function T from the pattern to H(0,0), of ln|T| and of its phase.
   subroutine find_response_sensitivities(case, plan, steady, response, result)
      type(case_t), intent(in) :: case
      type(case_plan_t), intent(in) :: plan
      type(shared_steady_t), intent(inout) :: steady         !! with the derivatives of its state
      type(harmonic_response_t), intent(in) :: response      !! its last state, converged
      type(case_result_t), intent(inout) :: result
      type(contact_variable_t), allocatable :: variables(:)
      type(harmonic_response_t) :: derivative
      type(response_basis_t) :: basis
      integer :: n, x

      allocate (variables, source=all_variables(case, plan, steady))
      do n = 1, size(variables)
         if (steady%gradient%changes(n)%status /= status_converged) cycle
         call differentiate_response(steady%response, steady%multigrid%levels, response, plan%steps_per_cell, &
            variables(n), steady%gradient%changes(n), steady%gradient%oil(:, n), basis, derivative)
         if (derivative%status /= status_converged) cycle
         x = n - size(result%by_key)
         if (x < 1) then
            result%by_key(n)%of(of_ratio) = real(derivative%film/response%film, dp)
            result%by_key(n)%of(of_phase) = aimag(derivative%film/response%film)
         else
            result%by_oil(x)%response_real = real(derivative%film, dp)
            result%by_oil(x)%response_imaginary = aimag(derivative%film)
            result%by_oil(x)%response = real(derivative%film/response%film, dp)
         end if
      end do
   end subroutine find_response_sensitivities

end module ehlwave_sensitivity_case
