!> Derivatives of the steady equations by inputs, theory eq. (W18).
!>
!> With R(u, x) = 0 the steady equations of the state u, x the logarithm of an input and J0 their Jacobian, a result
!> f(u, x) has the derivative
!>
!>     df/dx = f_x - lambda dR/dx,    J0^T lambda = f_u:
!>
!> one transposed solve a result serves all inputs. dR/dx is a difference quotient of residuals with a step of 1e-5, of
!> second order, which leaves about 1e-8 of the result. Cavitated nodes stay cavitated. The mesh stays in units of a and
!> b.
module ehlwave_contact_gradient
   use ehlwave_contact_problem, only: contact_problem_t
   use ehlwave_contact_variant, only: contact_variable_t
   use ehlwave_equations, only: equations_t
   use ehlwave_given, only: given_t
   use ehlwave_hierarchy, only: level_t
   use ehlwave_kinds, only: dp
   use ehlwave_state, only: state_t
   use ehlwave_steady_tangent, only: steady_tangent_t
   implicit none (type, external)
   private
   public :: residual_slope, stand_in_state, variant_equations

contains

   !> -dR/dx of the weighted residuals, a right side of `tangent%solve`.
   subroutine residual_slope(tangent, level, variable, flooded_oil, b)
      type(steady_tangent_t), intent(in) :: tangent
      type(level_t), intent(inout) :: level                !! the finest of the tangent; left as it was
      type(contact_variable_t), intent(in) :: variable
      real(dp), intent(in) :: flooded_oil(:)               !! (variants) rho H of the flooded contact's centre
      real(dp), intent(out), contiguous, target :: b(:)    !! (tangent%linear%n)
      type(contact_problem_t) :: problem
      type(equations_t) :: equations
      real(dp), pointer, contiguous :: r(:, :)
      real(dp), allocatable :: edge(:)
      integer :: k

      associate (linear => tangent%linear, finest => tangent%linear%levels(tangent%linear%finest))
         b = 0
         allocate (edge(finest%equations%edges%count()), source=0.0_dp)
         r(0:level%problem%grid%nx, 0:level%problem%grid%ny) => b(:linear%n - 1)
         do k = 1, size(variable%variants)
            associate (variant => variable%variants(k))
               call variant_equations(tangent, level, variable, k, flooded_oil(k), problem, equations)
               r = r - variant%weight*equations%residual
               edge = edge - variant%weight*equations%edge_excess
               b(linear%n) = b(linear%n) - variant%weight*equations%edges%load
               call variable%give_back(level%problem, problem)
            end associate
         end do
         r = merge(0.0_dp, finest%row_scale*r, finest%equations%is_cavitated)
         do k = 1, size(edge)
            r(finest%equations%edges%i(k), finest%equations%edges%j(k)) = edge(k)
         end do
      end associate
   end subroutine residual_slope

   !> The equations of a variant, with P and Delta of the steady state held. `problem` borrows parts of the level until
   !> `variable%give_back`.
   subroutine variant_equations(tangent, level, variable, k, flooded_oil, problem, equations)
      type(steady_tangent_t), intent(in) :: tangent
      type(level_t), intent(inout) :: level                !! the finest of the tangent
      type(contact_variable_t), intent(in) :: variable
      integer, intent(in) :: k                             !! the variant
      real(dp), intent(in) :: flooded_oil                  !! rho H of its flooded contact's centre
      type(contact_problem_t), intent(inout) :: problem
      type(equations_t), intent(inout) :: equations
      type(given_t) :: given
      type(state_t) :: state

      given = tangent%given
      call stand_in_state(variable, k, level%problem, given, tangent%state, problem, state)
      if (allocated(given%supply)) given%supply(:) = variable%variants(k)%inlet%supply_on(problem%grid, flooded_oil)
      call equations%init(problem)
      call equations%evaluate(problem, given, state)
   end subroutine variant_equations

   !> The problem of a variant, as `stand_in`, and the state with P and Delta held in it.
   subroutine stand_in_state(variable, k, own, given, base, problem, state)
      type(contact_variable_t), intent(in) :: variable
      integer, intent(in) :: k                             !! the variant
      type(contact_problem_t), intent(inout) :: own        !! of the finest level
      type(given_t), intent(in) :: given
      type(state_t), intent(in) :: base
      type(contact_problem_t), intent(inout) :: problem
      type(state_t), intent(inout) :: state
      call variable%stand_in(k, own, problem)
      state = base
      if (variable%changes_kernel) call problem%film(given, state%p, state%delta, state%h)
   end subroutine stand_in_state

end module ehlwave_contact_gradient
