!> The unknowns of a contact at one instant.
module ehlwave_state
   use ehlwave_grid, only: grid_t
   use ehlwave_kinds, only: dp
   implicit none (type, external)
   private
   public :: new_state

   type, public :: state_t
      real(dp), allocatable :: p(:, :)   !! dimensionless pressure P, (0:nx, 0:ny)
      real(dp), allocatable :: h(:, :)   !! dimensionless film thickness H, (0:nx, 0:ny)
      real(dp) :: delta = 0              !! mutual approach Delta
   contains
      procedure :: add
   end type state_t

contains

   !> Zero state on a grid.
   pure function new_state(grid) result(self)
      type(grid_t), intent(in) :: grid
      type(state_t) :: self
      allocate (self%p(0:grid%nx, 0:grid%ny), self%h(0:grid%nx, 0:grid%ny), source=0.0_dp)
   end function new_state

   !> Add `weight` times another state of the same grid.
   pure subroutine add(self, other, weight)
      class(state_t), intent(inout) :: self
      type(state_t), intent(in) :: other
      real(dp), intent(in) :: weight
      self%p = self%p + weight*other%p
      self%h = self%h + weight*other%h
      self%delta = self%delta + weight*other%delta
   end subroutine add

end module ehlwave_state
