!> Order of the unknowns of a step of Newton's method for a contact whose surfaces may touch.
!>
!> The change of P at all nodes, or of theta where the film is cavitated; q, the change of P + C, of nodes where solids
!> bear; Delta; ln(speed).
module ehlwave_touching_unknowns
   use ehlwave_grid, only: grid_t
   use ehlwave_kinds, only: dp
   use ehlwave_touching_change, only: touching_change_t
   use ehlwave_touching_state, only: touching_state_t
   implicit none (type, external)
   private

   integer, parameter, public :: borders = 2      !! unknowns that are no fields: Delta, ln(speed)

   type, public :: touching_unknowns_t
      integer :: n = 0                            !! unknowns
      integer, allocatable :: node(:, :)          !! (2, nodes where solids bear)
      logical, allocatable :: is_free(:, :)       !! film that deforms
      logical, allocatable :: is_full(:, :)       !! P that is unknown
      real(dp), allocatable :: weight(:, :)       !! of the rows of the oil, 0 at nodes without an equation
   contains
      procedure :: init
      procedure :: choose
      procedure :: spread_q
      procedure :: residuals
      procedure :: changes
   end type touching_unknowns_t

contains

   !> Room for the sets of a grid.
   subroutine init(self, grid)
      class(touching_unknowns_t), intent(inout) :: self
      type(grid_t), intent(in) :: grid
      call grid%new_field(self%weight)
      if (allocated(self%is_free)) deallocate (self%is_free, self%is_full)
      allocate (self%is_free(0:grid%nx, 0:grid%ny), self%is_full(0:grid%nx, 0:grid%ny))
   end subroutine init

   !> Choose the unknowns by the sets of a state.
   subroutine choose(self, grid, is_soft, state)
      class(touching_unknowns_t), intent(inout) :: self
      type(grid_t), intent(in) :: grid
      logical, intent(in) :: is_soft
      type(touching_state_t), intent(in) :: state
      integer :: i, j, k

      if (allocated(self%node)) deallocate (self%node)
      allocate (self%node(2, count(state%is_touching)))
      k = 0
      do j = 0, grid%ny
         do i = 0, grid%nx
            if (.not. state%is_touching(i, j)) cycle
            k = k + 1
            self%node(:, k) = [i, j]
         end do
      end do
      self%n = size(state%p) + k + borders
      self%weight = 0
      self%weight(1:grid%nx - 1, grid%first_row:grid%last_row) = grid%hx
      self%is_free = is_soft .or. .not. state%is_touching
      self%is_full = .false.
      self%is_full(1:grid%nx - 1, grid%first_row:grid%last_row) = &
         .not. state%is_cavitated(1:grid%nx - 1, grid%first_row:grid%last_row)
   end subroutine choose

   !> The field q of some unknowns.
   subroutine spread_q(self, x, q)
      class(touching_unknowns_t), intent(in) :: self
      real(dp), intent(in), contiguous, target :: x(:)
      real(dp), intent(out) :: q(0:, 0:)
      real(dp), pointer, contiguous :: u(:, :)
      integer :: k
      u(0:ubound(q, 1), 0:ubound(q, 2)) => x(:size(q))
      q = merge(u, 0.0_dp, self%is_full)
      do k = 1, size(self%node, 2)
         q(self%node(1, k), self%node(2, k)) = x(size(q) + k)
      end do
   end subroutine spread_q

   !> Right side for residuals.
   subroutine residuals(self, sides, x)
      class(touching_unknowns_t), intent(in) :: self
      type(touching_change_t), intent(in) :: sides
      real(dp), intent(out), contiguous :: x(:)
      integer :: k
      x(:size(self%weight)) = reshape(-self%weight*sides%p, [size(self%weight)])
      do k = 1, size(self%node, 2)
         x(size(self%weight) + k) = -sides%c(self%node(1, k), self%node(2, k))
      end do
      x(self%n - 1) = -sides%delta
      x(self%n) = -sides%ln_speed
   end subroutine residuals

   !> Changes of the unknowns of a solution.
   subroutine changes(self, x, change)
      class(touching_unknowns_t), intent(in) :: self
      real(dp), intent(in), contiguous :: x(:)
      type(touching_change_t), intent(inout) :: change
      integer :: k
      change%p(:, :) = reshape(x(:size(self%weight)), shape(self%weight))
      change%c = 0
      do k = 1, size(self%node, 2)
         associate (i => self%node(1, k), j => self%node(2, k))
            change%c(i, j) = x(size(self%weight) + k) - merge(change%p(i, j), 0.0_dp, self%is_full(i, j))
         end associate
      end do
      change%delta = x(self%n - 1)
      change%ln_speed = x(self%n)
   end subroutine changes

end module ehlwave_touching_unknowns
