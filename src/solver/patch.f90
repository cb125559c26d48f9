!> A part of a contact as a contact problem of its own.
module ehlwave_patch
   use ehlwave_contact_problem, only: contact_problem_t
   use ehlwave_equations, only: equations_t
   use ehlwave_given, only: given_t
   use ehlwave_grid, only: grid_t
   use ehlwave_hierarchy, only: level_t
   use ehlwave_kinds, only: dp
   use ehlwave_load_balance, only: held_approach
   use ehlwave_state, only: new_state, state_t
   implicit none (type, external)
   private
   public :: cut, patch_grid

contains

   !> Grid of the nodes first(1)..last(1), first(2)..last(2) of another grid of an elliptical contact: outer nodes are
   !> known, except on a line of symmetry.
   pure function patch_grid(grid, first, last) result(self)
      type(grid_t), intent(in) :: grid
      integer, intent(in) :: first(2), last(2)   !! i and j
      type(grid_t) :: self

      self%nx = last(1) - first(1)
      self%ny = last(2) - first(2)
      self%hx = grid%hx
      self%hy = grid%hy
      self%is_half = grid%is_half .and. first(2) == 0
      self%is_fitted = grid%is_fitted
      self%has_curved_pressure = grid%has_curved_pressure
      self%first_row = merge(0, 1, self%is_half)
      self%last_row = self%ny - 1
      allocate (self%x(0:self%nx), self%y(0:self%ny), self%weight(0:self%ny))
      self%x = grid%x(first(1):last(1))
      self%y = grid%y(first(2):last(2))
      self%weight = grid%weight(first(2):last(2))
   end function patch_grid

   !> Set problem and state of a patch at the state of the whole, on a level laid out for its size. The pressure at its
   !> outer nodes and the approach are held; the pressure outside fixes the gap. Beside the line of symmetry the
   !> deformation by the mirror image is held too.
   subroutine cut(whole, given, equations, state, grid, first, patch)
      type(contact_problem_t), intent(in) :: whole
      type(given_t), intent(in) :: given           !! to the whole
      type(equations_t), intent(in) :: equations   !! equations of the whole at the state
      type(state_t), intent(in) :: state
      type(grid_t), intent(in) :: grid             !! grid of the patch
      integer, intent(in) :: first(2)              !! its first node in the whole: i and j
      type(level_t), intent(inout) :: patch
      integer :: i, last(2)

      last = first + [grid%nx, grid%ny]
      patch%state = new_state(grid)
      patch%state%p = state%p(first(1):last(1), first(2):last(2))
      patch%state%delta = state%delta
      associate (problem => patch%problem, transport => patch%given%transport, from => given%transport)
         problem%grid = grid
         call problem%take_oil(whole)
         if (allocated(problem%heat)) deallocate (problem%heat)
         if (allocated(whole%heat)) problem%heat = whole%heat%part(first, last)
         call problem%deformation%apply(patch%state%p, patch%state%h)
         if (allocated(problem%own_gap)) deallocate (problem%own_gap)
         allocate (problem%own_gap(0:grid%nx, 0:grid%ny), &
                   source=state%h(first(1):last(1), first(2):last(2)) + state%delta - patch%state%h)
         patch%given%load = held_approach(state%delta, grid%integral(patch%state%p))
         transport%cells_per_step = from%cells_per_step
         transport%steps_per_cell = from%steps_per_cell
         transport%is_local = from%is_local
         transport%w0 = from%w0(first(1):last(1))
         transport%w1 = from%w1(first(1):last(1))
         transport%w2 = from%w2(first(1):last(1))
         if (allocated(transport%carried)) deallocate (transport%carried)
         allocate (transport%carried(0:grid%nx, 0:grid%ny), source=0.0_dp)
         if (allocated(from%carried)) transport%carried = from%carried(first(1):last(1), first(2):last(2))
         ! the second node upstream of it is outside
         if (first(1) > 0) transport%carried(1, :) = transport%carried(1, :) &
            + transport%w2(1)*equations%flow%f(first(1) - 1, first(2):last(2))
         if (allocated(transport%w3)) deallocate (transport%w3)
         if (.not. allocated(from%w3)) return
         allocate (transport%w3(0:grid%nx), source=from%w3(first(1):last(1)))
         do i = 1, 2               ! likewise for the third order
            if (first(1) + i >= 3) transport%carried(i, :) = transport%carried(i, :) &
               + transport%w3(i)*equations%flow%f(first(1) + i - 3, first(2):last(2))
         end do
      end associate
   end subroutine cut

end module ehlwave_patch
