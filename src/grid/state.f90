!> The unknowns of a contact at one instant.
module ehlwave_state
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ehlwave_grid, only: grid_t
   use ehlwave_kinds, only: dp
   use ehlwave_threads, only: is_shared
   implicit none (type, external)
   private
   public :: new_state

   type, public :: state_t
      real(dp), allocatable :: p(:, :)   !! dimensionless pressure P, (0:nx, 0:ny)
      real(dp), allocatable :: h(:, :)   !! dimensionless film thickness H, (0:nx, 0:ny)
      real(dp) :: delta = 0              !! mutual approach Delta
   contains
      procedure :: add
      procedure :: exchange
      procedure :: move_to
      procedure :: survey
   end type state_t

contains

   !> Zero state on a grid.
   function new_state(grid) result(self)
      type(grid_t), intent(in) :: grid
      type(state_t) :: self
      call grid%new_field(self%p)
      call grid%new_field(self%h)
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

   !> Each takes the fields of the other, without a copy.
   pure subroutine exchange(self, other)
      class(state_t), intent(inout) :: self
      type(state_t), intent(inout) :: other
      type(state_t) :: third
      call self%move_to(third)
      call other%move_to(self)
      call third%move_to(other)
   end subroutine exchange

   !> Move the fields to another state without a copy; this state is left empty.
   pure subroutine move_to(self, other)
      class(state_t), intent(inout) :: self
      class(state_t), intent(inout) :: other
      call move_alloc(self%p, other%p)
      call move_alloc(self%h, other%h)
      other%delta = self%delta
   end subroutine move_to

   !> Whether all of it is finite, and its extremes: a look before it passes as a solution.
   subroutine survey(self, is_finite, thinnest, highest)
      class(state_t), intent(in) :: self
      logical, intent(out) :: is_finite                !! every P and H
      real(dp), intent(out) :: thinnest, highest       !! smallest H, largest P
      real(dp), dimension(size(self%p, 2)) :: high, thin, total
      integer :: j, row

      !$omp parallel do private(j) schedule(static) if (is_shared(size(self%p)))
      do row = 1, size(total)
         j = lbound(self%p, 2) + row - 1
         total(row) = sum(self%p(:, j)) + sum(self%h(:, j))
         thin(row) = minval(self%h(:, j))
         high(row) = maxval(self%p(:, j))
      end do
      is_finite = ieee_is_finite(sum(total))
      thinnest = minval(thin)
      highest = maxval(high)
   end subroutine survey

end module ehlwave_state
