!> Derivatives of a steady state by variables; a starved state adds the derivatives of its flooded reference.
module ehlwave_steady_gradient
   use ehlwave_contact_gradient, only: gradient_basis_t, moved_state, residual_slope
   use ehlwave_contact_problem, only: contact_problem_t
   use ehlwave_contact_variant, only: contact_variable_t, variable_length
   use ehlwave_hierarchy, only: level_t
   use ehlwave_kinds, only: dp, no_value
   use ehlwave_starvation, only: flooded_t
   use ehlwave_state, only: new_state, state_t
   use ehlwave_status, only: status_converged
   use ehlwave_steady_tangent, only: steady_tangent_t, tangent_change_t
   implicit none (type, external)
   private

   integer, parameter :: most_variants = 3

   type, public :: steady_gradient_t
      character(len=variable_length), allocatable :: names(:)   !! names of the variables
      type(tangent_change_t), allocatable :: changes(:)         !! du/dx
      real(dp), allocatable :: oil(:, :)                        !! (variants, variables) rho H of the flooded contact's
                                                                !! centre, where an oil offered is over that
      integer :: solves = 0                                     !! linear solves that they took
   contains
      procedure :: serves
      procedure :: find
   end type steady_gradient_t

contains

   !> Whether it has the derivatives by these variables.
   pure logical function serves(self, variables)
      class(steady_gradient_t), intent(in) :: self
      type(contact_variable_t), intent(in) :: variables(:)
      serves = allocated(self%names)
      if (serves) serves = size(self%names) == size(variables)
      if (serves) serves = all(self%names == variables%name)
   end function serves

   !> Differentiate the steady state of the finest level. A variable without variants has a change that is not
   !> converged.
   subroutine find(self, tangent, levels, flooded, variables, tolerance)
      class(steady_gradient_t), intent(inout) :: self
      type(steady_tangent_t), intent(inout) :: tangent     !! about the state of the finest level
      type(level_t), intent(inout), target :: levels(:)
      type(flooded_t), intent(inout) :: flooded            !! flooded reference of a starved contact
      type(contact_variable_t), intent(in) :: variables(:)
      real(dp), intent(in) :: tolerance                    !! tolerance of linear residuals

      self%names = variables%name
      self%solves = 0
      if (allocated(self%oil)) deallocate (self%oil)
      allocate (self%oil(most_variants, size(variables)), source=no_value)
      if (is_over_flooded(variables)) call find_flooded(self, levels, flooded, variables, tolerance)
      call find_changes(self, tangent, levels, variables, tolerance)
   end subroutine find

   subroutine find_changes(self, tangent, levels, variables, tolerance)
      class(steady_gradient_t), intent(inout) :: self
      type(steady_tangent_t), intent(inout) :: tangent
      type(level_t), intent(inout), target :: levels(:)
      type(contact_variable_t), intent(in) :: variables(:)
      real(dp), intent(in) :: tolerance
      type(gradient_basis_t) :: basis
      real(dp), allocatable, target :: b(:)
      integer :: n

      if (allocated(self%changes)) deallocate (self%changes)
      allocate (self%changes(size(variables)))
      do n = 1, size(variables)
         if (.not. allocated(variables(n)%variants)) cycle
         if (variables(n)%is_of_waves) then
            self%changes(n)%state = new_state(levels(size(levels))%problem%grid)
            self%changes(n)%status = status_converged
            cycle
         end if
         call residual_slope(tangent, levels(size(levels)), variables(n), self%oil(:, n), b)
         call basis%solve(tangent, levels, b, tolerance, self%changes(n))
      end do
      self%solves = self%solves + basis%solves
   end subroutine find_changes

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

   !> rho H at the centre of the flooded contact of each variant.
   subroutine find_flooded(self, levels, flooded, variables, tolerance)
      class(steady_gradient_t), intent(inout) :: self
      type(level_t), intent(inout), target :: levels(:)
      type(flooded_t), intent(inout) :: flooded
      type(contact_variable_t), intent(in) :: variables(:)
      real(dp), intent(in) :: tolerance
      type(contact_problem_t) :: problem
      type(steady_tangent_t), allocatable :: tangent
      type(state_t) :: state
      real(dp), allocatable :: supply(:)
      integer :: k, n

      allocate (tangent)
      associate (level => levels(size(levels)))
         call move_alloc(level%given%supply, supply)
         call level%state%exchange(flooded%state)
         call tangent%init(levels)
         call find_changes(self, tangent, levels, variables, tolerance)
         do n = 1, size(variables)
            if (self%changes(n)%status /= status_converged) cycle
            do k = 1, size(variables(n)%variants)
               call variables(n)%stand_in(k, level%problem, problem)
               call moved_state(problem, variables(n)%changes_kernel, level%given, level%state, &
                                self%changes(n)%state, variables(n)%variants(k)%place, state)
               self%oil(k, n) = problem%grid%value_at_centre(problem%rheology%density(state%p)*state%h)
               call variables(n)%give_back(level%problem, problem)
            end do
         end do
         call level%state%exchange(flooded%state)
         call move_alloc(supply, level%given%supply)
      end associate
   end subroutine find_flooded

end module ehlwave_steady_gradient
