!> Approximate inverse of the equations of the oil at nodes where solids bear.
module ehlwave_touching_oil_factors
   use ehlwave_grid, only: grid_t
   use ehlwave_kinds, only: dp
   use ehlwave_node_factors, only: node_factors_t
   use ehlwave_touching_equations, only: link_i, link_j, link_row, links, touching_equations_t
   use ehlwave_touching_state, only: touching_state_t
   implicit none (type, external)
   private

   type, public :: touching_oil_factors_t
      type(node_factors_t), private :: factors
      real(dp), allocatable :: follows(:, :)         !! change of P where soft solids bear, if it is 1 elsewhere
      real(dp), allocatable, private :: packed(:, :)
   contains
      procedure :: init
      procedure :: make
      procedure :: solve
   end type touching_oil_factors_t

   integer, parameter :: oil_reach = 2               !! nodes upstream that the wedge reaches

contains

   !> Work space on a grid.
   subroutine init(self, grid, reach_y)
      class(touching_oil_factors_t), intent(inout) :: self
      type(grid_t), intent(in) :: grid
      integer, intent(in) :: reach_y                 !! nodes across the motion that a row may reach
      call self%factors%init(grid, oil_reach, min(1, reach_y))
      call grid%new_field(self%follows)
      if (allocated(self%packed)) deallocate (self%packed)
      allocate (self%packed(grid%last_row - grid%first_row + 1, grid%nx - 1))
   end subroutine init

   !> Factors of the oil where solids bear; of soft solids the change of its P there where P changes by 1 at all other
   !> nodes. Below hard solids it is 0: neighbours take it as given, which costs a tenth fewer steps of GMRES.
   subroutine make(self, grid, equations, is_soft, state)
      class(touching_oil_factors_t), intent(inout) :: self
      type(grid_t), intent(in) :: grid
      type(touching_equations_t), intent(in) :: equations
      logical, intent(in) :: is_soft
      type(touching_state_t), intent(in) :: state
      real(dp) :: rows(grid%last_row - grid%first_row + 1, (2*oil_reach + 1)*(2*self%factors%reach_y + 1))
      integer :: i, j, l, n

      self%follows = 0
      if (.not. any(state%is_touching)) return
      call self%factors%begin()
      do i = 1, grid%nx - 1
         call oil_rows(grid, equations, state, i, self%factors%reach_y, rows)
         call self%factors%put_line(i, rows)
      end do
      call self%factors%finish()
      if (.not. is_soft) return
      do j = grid%first_row, grid%last_row
         do i = 1, grid%nx - 1
            if (.not. state%is_touching(i, j) .or. state%is_cavitated(i, j)) cycle
            do l = 1, links
               n = link_row(j, l, grid%is_line)
               if (i + link_i(l) < 0) cycle
               if (state%is_touching(i + link_i(l), n) .or. state%is_cavitated(i + link_i(l), n)) cycle
               self%follows(i, j) = self%follows(i, j) - equations%by_p(i, j, l)
            end do
         end do
      end do
      call self%solve(grid, self%follows, is_transposed=.false.)
      self%follows = max(0.0_dp, min(1.0_dp, self%follows))
   end subroutine make

   !> Rows of the oil where solids bear, and of the identity elsewhere.
   subroutine oil_rows(grid, equations, state, i, reach_y, rows)
      type(grid_t), intent(in) :: grid
      type(touching_equations_t), intent(in) :: equations
      type(touching_state_t), intent(in) :: state
      integer, intent(in) :: i, reach_y
      real(dp), intent(out) :: rows(:, :)                 !! (unknown rows, entries)
      integer :: j, l, middle, n, row

      rows = 0
      middle = size(rows, 2)/2 + 1
      do row = 1, size(rows, 1)
         j = row - 1 + grid%first_row
         if (.not. state%is_touching(i, j)) then
            rows(row, middle) = 1
            cycle
         end if
         do l = 1, links
            n = link_row(j, l, grid%is_line)
            if (i + link_i(l) < 1 .or. i + link_i(l) > grid%nx - 1) cycle
            if (n > grid%last_row .or. n < grid%first_row) cycle
            if (.not. state%is_touching(i + link_i(l), n) .or. state%is_cavitated(i + link_i(l), n)) cycle
            if (grid%is_line .and. link_j(l) /= 0) cycle
            associate (entry => middle + link_i(l)*(2*reach_y + 1) + n - j)
               rows(row, entry) = rows(row, entry) + equations%by_p(i, j, l)
            end associate
         end do
         if (state%is_cavitated(i, j)) rows(row, middle) = rows(row, middle) + equations%by_theta(i, j, 1)
         if (i == 1) cycle
         if (state%is_cavitated(i - 1, j) .and. state%is_touching(i - 1, j)) &
            rows(row, middle - (2*reach_y + 1)) = equations%by_theta(i, j, 2)
      end do
      if (any(abs(rows(:, middle)) <= 0)) where (abs(rows(:, middle)) <= 0) rows(:, middle) = -1
   end subroutine oil_rows

   !> Changes of P or theta where solids bear, for residuals of the oil there and 0 elsewhere, in place; transposed:
   !> weights of the residuals for weights of the changes.
   subroutine solve(self, grid, change, is_transposed)
      class(touching_oil_factors_t), intent(inout) :: self
      type(grid_t), intent(in) :: grid
      real(dp), intent(inout), contiguous :: change(0:, 0:)
      logical, intent(in) :: is_transposed
      integer :: i
      associate (first => grid%first_row, last => grid%last_row)
         do i = 1, grid%nx - 1
            self%packed(:, i) = change(i, first:last)
         end do
         call self%factors%solve(self%packed, is_transposed)
         do i = 1, grid%nx - 1
            change(i, first:last) = self%packed(:, i)
         end do
      end associate
   end subroutine solve

end module ehlwave_touching_oil_factors
