!> Derivatives of the equations of a steady state whose surfaces may touch, and transposed solves, theory eq. (W18).
module ehlwave_touching_gradient
   use ehlwave_contact_problem, only: contact_problem_t
   use ehlwave_contact_variant, only: contact_variable_t
   use ehlwave_given, only: given_t
   use ehlwave_kinds, only: dp
   use ehlwave_real_gmres, only: gmres_t
   use ehlwave_touching_adjoint, only: solve_adjoint
   use ehlwave_touching_change, only: new_change, touching_change_t
   use ehlwave_touching_equations, only: touching_equations_t
   use ehlwave_touching_newton, only: exact, residuals, set_speed, speed_step, touching_solver_t
   use ehlwave_touching_state, only: new_touching_law, rough_at_rest, touching_law_t, touching_state_t
   use ehlwave_touching_transposed, only: touching_transposed_t
   implicit none (type, external)
   private

   type, public :: touching_gradient_t
      integer :: n = 0                                !! unknowns
      type(touching_transposed_t), private :: system
      type(gmres_t), private :: gmres
      type(touching_change_t), private :: sides
   contains
      procedure :: start
      procedure :: solve
      procedure :: evaluate
   end type touching_gradient_t

contains

   !> Linearise about a steady state.
   subroutine start(self, solver, state, seeks_speed)
      class(touching_gradient_t), intent(inout) :: self
      type(touching_solver_t), intent(inout), target :: solver
      type(touching_state_t), intent(inout), target :: state   !! converged
      logical, intent(in) :: seeks_speed                       !! whether the share is given

      self%sides = new_change(solver%problem%grid)
      self%sides%seeks_speed = seeks_speed
      call set_speed(solver%problem, state%speed)
      call solver%equations%evaluate(solver%problem, solver%law, solver%given, solver%past, state)
      call solver%equations%linearise(solver%past, state)
      if (seeks_speed) call solver%differentiate_by_speed(state, self%sides)
      call self%system%init(solver%problem)
      call self%system%pose(solver%problem, solver%law, solver%equations, .true., state, self%sides)
      call self%system%set_edges(solver%problem%edges, solver%given, state)
      if (seeks_speed .and. solver%problem%edges%count() > 0) call differentiate_edges(self%system, solver, state)
      self%n = self%system%unknowns%n
   end subroutine start

   !> Derivatives of the far field at flooded edges by ln(speed).
   subroutine differentiate_edges(system, solver, state)
      type(touching_transposed_t), intent(inout) :: system
      type(touching_solver_t), intent(inout) :: solver
      type(touching_state_t), intent(in) :: state
      real(dp), dimension(size(system%edge_slope)) :: excess, slope
      integer :: side

      do side = -1, 1, 2
         call set_speed(solver%problem, state%speed*exp(side*speed_step))
         associate (edges => solver%problem%edges, weight => side/(2*speed_step))
            call edges%compare(solver%given, state%p, state%h, excess, slope)
            system%edge_by_speed = system%edge_by_speed + weight*excess
            system%load_by_speed = system%load_by_speed + weight*edges%load
         end associate
      end do
      call set_speed(solver%problem, state%speed)
   end subroutine differentiate_edges

   !> Derivatives of a result by the residuals, for its derivatives by the state with all else held.
   subroutine solve(self, p_weight, h_weight, c_weight, speed_weight, adjoint, is_solved)
      class(touching_gradient_t), intent(inout) :: self
      real(dp), intent(in), dimension(0:, 0:) :: p_weight, h_weight, c_weight   !! derivatives by P, H and C
      real(dp), intent(in) :: speed_weight                     !! derivative by ln(speed) where the share is given
      real(dp), intent(out), contiguous :: adjoint(:)          !! (n)
      logical, intent(out) :: is_solved
      real(dp) :: right(self%n)

      call self%system%state_weights(p_weight, h_weight, c_weight, right)
      right(self%n) = speed_weight
      call solve_adjoint(self%system, self%gmres, right, adjoint, is_solved, exact)
   end subroutine solve

   !> Weighted residuals of a variant at the unknowns of the state, with the sign of a right side, and its film.
   !> `problem` borrows parts of the solver's until `variable%give_back`.
   subroutine evaluate(self, solver, state, phase_deg, variable, k, problem, at, b)
      class(touching_gradient_t), intent(inout) :: self
      type(touching_solver_t), intent(inout) :: solver
      type(touching_state_t), intent(in) :: state
      real(dp), intent(in) :: phase_deg                        !! of waves at rest
      type(contact_variable_t), intent(in) :: variable
      integer, intent(in) :: k                                 !! the variant
      type(contact_problem_t), intent(inout) :: problem
      type(touching_state_t), intent(out) :: at
      real(dp), intent(out), contiguous, target :: b(:)        !! (n)
      type(given_t) :: given
      type(touching_equations_t) :: equations
      type(touching_law_t) :: law
      real(dp), allocatable :: excess(:), slope(:)
      real(dp), pointer, contiguous :: rows(:, :)
      integer :: n

      associate (variant => variable%variants(k))
         call variable%stand_in(k, solver%problem, problem)
         if (self%sides%seeks_speed) call set_speed(problem, state%speed)
         law = new_touching_law(variant%touching, problem%conditions)
         given = solver%given
         if (allocated(variant%waves)) then
            if (any(variant%waves%is_present)) &
               call given%set_rough(rough_at_rest(variant%waves, phase_deg, problem%grid))
         end if
         at = state
         call equations%init(problem)
         call equations%evaluate(problem, law, given, solver%past, at, holds_edges=.true.)
         if (self%sides%seeks_speed) then
            call residuals(problem, law, given, equations, at, self%sides, variant%touching%share)
         else
            call residuals(problem, law, given, equations, at, self%sides)
         end if
      end associate
      call self%system%unknowns%residuals(self%sides, b)
      rows(0:problem%grid%nx, 0:problem%grid%ny) => b(:size(at%p))
      associate (edges => problem%edges)
         allocate (excess(edges%count()), slope(edges%count()))
         call edges%compare(given, at%p, at%h, excess, slope)
         do n = 1, edges%count()
            rows(edges%i(n), edges%j(n)) = -excess(n)
         end do
      end associate
   end subroutine evaluate

end module ehlwave_touching_gradient
