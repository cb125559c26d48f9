!> Sensitivities of a case: derivatives of film, friction, resistance to rolling and linear response by its inputs.
!>
!> `by_key` has those by every variable of `case/case_variables`. `by_oil` has those by two properties of any oil, which
!> need no key: ln(eta/eta0) at every pressure ('alpha') and the stress of the flow law ('stress'). Load, speed,
!> geometry, E' and viscosity at ambient pressure stay as they are then.
module ehlwave_sensitivity_case
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ehlwave_case_definition, only: case_t
   use ehlwave_case_result, only: case_result_t, gradient_t, of_central_film, of_phase, of_ratio
   use ehlwave_case_variables, only: case_variables
   use ehlwave_contact_gradient, only: stand_in_state
   use ehlwave_contact_problem, only: contact_problem_t
   use ehlwave_contact_variant, only: contact_variable_t
   use ehlwave_harmonic_response, only: harmonic_response_t
   use ehlwave_hierarchy, only: level_t
   use ehlwave_inlet_oil, only: inlet_oil_t
   use ehlwave_kinds, only: dp
   use ehlwave_planned_case, only: case_plan_t
   use ehlwave_response_gradient, only: response_adjoint_t
   use ehlwave_result_slopes, only: smooth_results, take_results
   use ehlwave_shared_steady, only: adjoint_tolerance, shared_steady_t
   use ehlwave_state, only: state_t
   use ehlwave_status, only: status_converged
   use ehlwave_steady_gradient, only: steady_gradient_t
   implicit none (type, external)
   private
   public :: all_variables, find_response_sensitivities, find_smooth_sensitivities, take_gradient

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
      real(dp) :: values(smooth_results)
      integer :: n

      associate (level => steady%multigrid%levels(size(steady%multigrid%levels)))
         allocate (variables, source=all_variables(case, plan, level%problem))
         allocate (result%by_key(size(variables) - size(oil_names)))
         call take_results(level%problem, level%state, level%state, values)
         call steady%differentiate(case, variables, ieee_is_finite(values))
         associate (work => pack(steady%gradient%adjoints%work, ieee_is_finite(values)))
            result%transposed_solves = count(work > 0)
            result%transposed_work = sum(work)
         end associate
         do n = 1, size(variables)
            gradient = gradient_t(name=variables(n)%name)
            if (allocated(variables(n)%variants)) &
               call differentiate_results(level, variables(n), n, steady%gradient, gradient)
            call take_gradient(gradient, n, result)
         end do
      end associate
   end subroutine find_smooth_sensitivities

   !> Keep the derivatives by a variable.
   subroutine take_gradient(gradient, n, result)
      type(gradient_t), intent(in) :: gradient
      integer, intent(in) :: n                               !! its place among the variables
      type(case_result_t), intent(inout) :: result           !! `by_key` has room for all keys
      if (n <= size(result%by_key)) then
         result%by_key(n) = gradient
      else
         result%by_oil(n - size(result%by_key))%film = gradient%of(of_central_film)
      end if
   end subroutine take_gradient

   !> The variables of a case, with the variables of any oil at the end.
   function all_variables(case, plan, problem) result(variables)
      type(case_t), intent(in) :: case
      type(case_plan_t), intent(in) :: plan
      type(contact_problem_t), intent(in) :: problem
      type(contact_variable_t), allocatable :: variables(:)
      type(contact_variable_t) :: oil(size(oil_names))
      integer :: k, x

      do x = 1, size(oil)
         oil(x)%name = oil_names(x)
         if (x == 1 .and. .not. problem%rheology%depends_on_alpha()) cycle
         if (x == 2 .and. problem%rheology%is_newtonian()) cycle
         call oil(x)%place_variants(oil_step, 0)
         do k = 1, size(oil(x)%variants)
            associate (variant => oil(x)%variants(k), factor => exp(oil(x)%variants(k)%place))
               variant%conditions = problem%conditions
               variant%inlet = plan%effects%starvation%oil
               variant%touching = case%effects%touching%data
               variant%waves = plan%surfaces%list
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
      variables = [case_variables(case), oil]
   end function all_variables

   !> Derivatives of the results of the smooth contact by a variable.
   subroutine differentiate_results(level, variable, n, steady, gradient)
      type(level_t), intent(inout) :: level
      type(contact_variable_t), intent(in) :: variable
      integer, intent(in) :: n                          !! its place in `steady`
      type(steady_gradient_t), intent(in) :: steady
      type(gradient_t), intent(inout) :: gradient
      type(contact_problem_t) :: problem
      type(state_t) :: state
      real(dp) :: values(smooth_results)
      integer :: k

      gradient%of(:smooth_results) = [(steady%change(k, n), k=1, smooth_results)]
      do k = 1, size(variable%variants)
         call stand_in_state(variable, k, level%problem, level%given, level%state, problem, state)
         call take_results(problem, state, level%state, values)
         gradient%of(:smooth_results) = gradient%of(:smooth_results) + variable%variants(k)%weight*values
         call variable%give_back(level%problem, problem)
      end do
   end subroutine differentiate_results

   !> Derivatives of the transfer function T from the pattern to H(0,0), of ln|T| and of its phase.
   subroutine find_response_sensitivities(case, plan, steady, response, result)
      type(case_t), intent(in) :: case
      type(case_plan_t), intent(in) :: plan
      type(shared_steady_t), intent(inout) :: steady         !! with the derivatives of its state
      type(harmonic_response_t), intent(in) :: response      !! its last state, converged
      type(case_result_t), intent(inout) :: result
      type(contact_variable_t), allocatable :: variables(:)
      type(response_adjoint_t) :: adjoint
      complex(dp) :: change
      integer :: n, x

      associate (levels => steady%multigrid%levels)
         allocate (variables, source=all_variables(case, plan, levels(size(levels))%problem))
         result%transposed_work = result%transposed_work - steady%multigrid%work()
         call adjoint%find(steady%response, levels, plan%surfaces%list(1), response, adjoint_tolerance(case))
         result%transposed_work = result%transposed_work + steady%multigrid%work()
         result%transposed_solves = result%transposed_solves + adjoint%solves
         if (adjoint%status /= status_converged) return
         do n = 1, size(variables)
            if (.not. allocated(variables(n)%variants)) cycle
            call adjoint%derivative(steady%response, levels(size(levels)), response, plan%steps_per_cell, &
                                    variables(n), steady%gradient%slopes(:, n), steady%gradient%oil(:, n), change)
            x = n - size(result%by_key)
            if (x < 1) then
               result%by_key(n)%of(of_ratio) = real(change/response%film, dp)
               result%by_key(n)%of(of_phase) = aimag(change/response%film)
            else
               result%by_oil(x)%response_real = real(change, dp)
               result%by_oil(x)%response_imaginary = aimag(change)
               result%by_oil(x)%response = real(change/response%film, dp)
            end if
         end do
      end associate
   end subroutine find_response_sensitivities

end module ehlwave_sensitivity_case
