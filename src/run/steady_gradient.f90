!> Derivatives of the results of a steady state by variables: residual slopes, and one transposed solve a result.
module ehlwave_steady_gradient
   use ehlwave_contact_gradient, only: residual_slope, stand_in_state
   use ehlwave_contact_problem, only: contact_problem_t
   use ehlwave_contact_variant, only: contact_variable_t, variable_length
   use ehlwave_hierarchy, only: level_t, work_of
   use ehlwave_kinds, only: dp, no_value
   use ehlwave_result_slopes, only: centre_slope, result_slope, smooth_results
   use ehlwave_starvation, only: flooded_t
   use ehlwave_state, only: state_t
   use ehlwave_status, only: status_converged
   use ehlwave_steady_tangent, only: steady_adjoint_t, steady_tangent_t
   implicit none (type, external)
   private

   integer, parameter :: most_variants = 3

   type, public :: steady_gradient_t
      character(len=variable_length), allocatable :: names(:)   !! names of the variables
      real(dp), allocatable :: slopes(:, :)                     !! (n, variables) -dR/dx; NaN of one without variants
      real(dp), allocatable :: oil(:, :)                        !! (variants, variables) rho H of the flooded contact's
                                                                !! centre, where an oil offered is over that
      type(steady_adjoint_t) :: adjoints(smooth_results)        !! of the results of the smooth contact
      real(dp) :: work = 0                                      !! operations of the slopes
   contains
      procedure :: serves
      procedure :: find
      procedure :: solve
      procedure :: change
   end type steady_gradient_t

contains

   !> Whether it has the slopes of these variables.
   pure logical function serves(self, variables)
      class(steady_gradient_t), intent(in) :: self
      type(contact_variable_t), intent(in) :: variables(:)
      serves = allocated(self%names)
      if (serves) serves = size(self%names) == size(variables)
      if (serves) serves = all(self%names == variables%name)
   end function serves

   !> Slopes of the residuals at the steady state of the finest level.
   subroutine find(self, tangent, levels, flooded, variables, tolerance)
      class(steady_gradient_t), intent(inout) :: self
      type(steady_tangent_t), intent(inout) :: tangent     !! about the state of the finest level
      type(level_t), intent(inout), target :: levels(:)
      type(flooded_t), intent(inout) :: flooded            !! flooded reference of a starved contact
      type(contact_variable_t), intent(in) :: variables(:)
      real(dp), intent(in) :: tolerance                    !! tolerance of linear residuals
      type(steady_adjoint_t) :: blank

      self%work = -work_of(levels)
      self%names = variables%name
      self%adjoints = blank
      if (allocated(self%oil)) deallocate (self%oil)
      allocate (self%oil(most_variants, size(variables)), source=no_value)
      if (is_over_flooded(variables)) call find_flooded(self, levels, flooded, variables, tolerance)
      call find_slopes(self, tangent, levels, variables)
      self%work = self%work + work_of(levels)
   end subroutine find

   subroutine find_slopes(self, tangent, levels, variables)
      class(steady_gradient_t), intent(inout) :: self
      type(steady_tangent_t), intent(in) :: tangent
      type(level_t), intent(inout) :: levels(:)
      type(contact_variable_t), intent(in) :: variables(:)
      integer :: n

      if (allocated(self%slopes)) deallocate (self%slopes)
      allocate (self%slopes(tangent%linear%n, size(variables)), source=0.0_dp)
      do n = 1, size(variables)
         if (.not. allocated(variables(n)%variants)) then
            self%slopes(:, n) = no_value
         else if (.not. variables(n)%is_of_waves) then
            call residual_slope(tangent, levels(size(levels)), variables(n), self%oil(:, n), self%slopes(:, n))
         end if
      end do
   end subroutine find_slopes

   !> Transposed solve of a result.
   subroutine solve(self, tangent, levels, of, tolerance)
      class(steady_gradient_t), intent(inout) :: self
      type(steady_tangent_t), intent(inout) :: tangent     !! as in `find`
      type(level_t), intent(inout), target :: levels(:)
      integer, intent(in) :: of                            !! result
      real(dp), intent(in) :: tolerance
      real(dp), allocatable, dimension(:, :) :: h, q

      call result_slope(levels(size(levels))%problem, levels(size(levels))%state, of, q, h)
      call tangent%solve_transposed(levels, q, h, tolerance, self%adjoints(of))
   end subroutine solve

   !> Derivative of a result by the state, times the change of the state with a variable; NaN: none.
   pure real(dp) function change(self, of, n)
      class(steady_gradient_t), intent(in) :: self
      integer, intent(in) :: of, n                         !! result; variable
      change = no_value
      if (self%adjoints(of)%status == status_converged) &
         change = dot_product(self%adjoints(of)%vector, self%slopes(:, n))
   end function change

   !> Whether the oil offered follows the film of the flooded contact.
   pure logical function is_over_flooded(variables)
      type(contact_variable_t), intent(in) :: variables(:)
      integer :: n
      is_over_flooded = .false.
      do n = 1, size(variables)
         if (allocated(variables(n)%variants)) &
            is_over_flooded = is_over_flooded .or. any(variables(n)%variants%inlet%over_flooded > 0)
      end do
   end function is_over_flooded

   !> rho H at the centre of the flooded contact of each variant: one transposed solve of that contact.
   subroutine find_flooded(self, levels, flooded, variables, tolerance)
      class(steady_gradient_t), intent(inout) :: self
      type(level_t), intent(inout), target :: levels(:)
      type(flooded_t), intent(inout) :: flooded
      type(contact_variable_t), intent(in) :: variables(:)
      real(dp), intent(in) :: tolerance
      type(contact_problem_t) :: problem
      type(steady_adjoint_t) :: adjoint
      type(steady_tangent_t), allocatable :: tangent
      type(state_t) :: state
      real(dp), allocatable :: h(:, :), q(:, :), supply(:)
      real(dp) :: by_state, oil
      integer :: k, n

      allocate (tangent)
      associate (level => levels(size(levels)))
         call move_alloc(level%given%supply, supply)
         call level%state%exchange(flooded%state)
         call tangent%init(levels)
         call find_slopes(self, tangent, levels, variables)
         call centre_slope(level%problem, level%state, oil, q, h)
         call tangent%solve_transposed(levels, q, h, tolerance, adjoint)
         do n = 1, size(variables)
            if (adjoint%status /= status_converged .or. .not. allocated(variables(n)%variants)) cycle
            by_state = dot_product(adjoint%vector, self%slopes(:, n))
            do k = 1, size(variables(n)%variants)
               call stand_in_state(variables(n), k, level%problem, level%given, level%state, problem, state)
               oil = problem%grid%value_at_centre(problem%rheology%density(state%p)*state%h)
               self%oil(k, n) = oil + variables(n)%variants(k)%place*by_state
               call variables(n)%give_back(level%problem, problem)
            end do
         end do
         call level%state%exchange(flooded%state)
         call move_alloc(supply, level%given%supply)
      end associate
   end subroutine find_flooded

end module ehlwave_steady_gradient
