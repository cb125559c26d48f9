!> Factors of a matrix on the unknown nodes: of a band on a line, else incomplete.
module ehlwave_node_factors
   use ehlwave_grid, only: grid_t
   use ehlwave_kinds, only: dp
   use ehlwave_real_band, only: band_t, new_band
   use ehlwave_real_ilu, only: ilu_t, new_ilu
   implicit none (type, external)
   private

   type, public :: node_factors_t
      integer :: reach_x = 0, reach_y = 0            !! nodes between a row and its entries
      type(ilu_t), private :: ilu
      type(band_t), private :: band
   contains
      procedure :: init
      procedure :: begin
      procedure :: put_line
      procedure :: finish
      procedure :: solve
   end type node_factors_t

contains

   !> Room for factors of rows with entries in reach.
   subroutine init(self, grid, reach_x, reach_y)
      class(node_factors_t), intent(out) :: self
      type(grid_t), intent(in) :: grid
      integer, intent(in) :: reach_x, reach_y
      self%reach_x = reach_x
      self%reach_y = reach_y
      if (grid%is_line) then
         self%band = new_band(grid%nx - 1, reach_x)
      else
         self%ilu = new_ilu(grid%last_row - grid%first_row + 1, grid%nx - 1, reach_y, reach_x)
      end if
   end subroutine init

   !> Forget the rows of former factors.
   subroutine begin(self)
      class(node_factors_t), intent(inout) :: self
      if (.not. allocated(self%band%a)) call self%ilu%begin()
   end subroutine begin

   !> Add the rows of one line of nodes, divided by their diagonals where `scale` is present.
   subroutine put_line(self, i, rows, scale)
      class(node_factors_t), intent(inout) :: self
      integer, intent(in) :: i
      real(dp), intent(inout) :: rows(:, :)
      real(dp), intent(out), optional :: scale(:)
      real(dp) :: diagonal(size(rows, 1))
      integer :: k

      if (present(scale)) then
         diagonal = rows(:, size(rows, 2)/2 + 1)
         where (.not. abs(diagonal) > 0) diagonal = 1
         scale = 1/diagonal
         do k = 1, size(rows, 2)
            rows(:, k) = rows(:, k)*scale
         end do
      end if
      if (allocated(self%band%a)) then
         self%band%a(i, :) = rows(1, :)
      else
         call self%ilu%add_line(i, rows)
      end if
   end subroutine put_line

   !> Complete the factors after the last line. Incomplete factors can be unbounded: the matrix then needs a shift.
   subroutine finish(self, is_bounded)
      class(node_factors_t), intent(inout) :: self
      logical, intent(out), optional :: is_bounded
      if (allocated(self%band%a)) call self%band%factorise()
      if (.not. present(is_bounded)) return
      is_bounded = .true.
      if (.not. allocated(self%band%a)) is_bounded = self%ilu%is_bounded()
   end subroutine finish

   !> Solve with factors, or with the transposed factors, in place.
   subroutine solve(self, packed, is_transposed)
      class(node_factors_t), intent(inout) :: self
      real(dp), intent(inout), contiguous :: packed(:, :)   !! (unknown rows, lines)
      logical, intent(in) :: is_transposed
      if (allocated(self%band%a) .and. is_transposed) then
         call self%band%solve_transposed(packed(1, :))
      else if (allocated(self%band%a)) then
         call self%band%solve(packed(1, :))
      else if (is_transposed) then
         call self%ilu%solve_transposed(packed)
      else
         call self%ilu%solve(packed)
      end if
   end subroutine solve

end module ehlwave_node_factors
