!> Corrections on coarser grids to a solution with incomplete factors, in a part of the nodes.
!>
!> Where the oil flows easily its equation is close to Poisson's. Incomplete factors leave long waves there, the more
!> the finer the mesh. Rows of the coarser grids are rows of the near matrix between interpolated values (Galerkin), so
!> that these grids need no equations of their own.
module ehlwave_coarse_factors
   use ehlwave_coarse_level, only: level_t, make_coarser, new_coarser, new_level, prolong, restrict, subtract_product, &
      subtract_transposed_product
   use ehlwave_cycle_settings, only: diagonal_shift
   use ehlwave_grid, only: grid_t
   use ehlwave_kinds, only: dp, sp
   use ehlwave_real_ilu, only: ilu_t, new_ilu
   implicit none (type, external)
   private

   !> Factors of the rows divided by their diagonals.
   type :: scaled_factors_t
      real(dp), allocatable :: scale(:, :)              ! (unknown rows, lines)
      type(ilu_t) :: ilu
   end type scaled_factors_t

   type, public :: coarse_factors_t
      type(level_t), allocatable, private :: levels(:)  ! the finest first; none of a line
      type(scaled_factors_t), allocatable, private :: factors(:)   ! of all but the finest
      integer, private :: used = 0                      ! grids, less those whose factors are unbounded
   contains
      procedure :: init
      procedure :: put_line
      procedure :: finish
      procedure :: correct
      procedure :: correct_transposed
   end type coarse_factors_t

   integer, parameter :: fewest = 7                     ! unknown rows or lines of a grid that is made coarser

contains

   !> Room for the grids below a grid.
   subroutine init(self, grid, reach_x, reach_y)
      class(coarse_factors_t), intent(inout) :: self
      type(grid_t), intent(in) :: grid
      integer, intent(in) :: reach_x, reach_y           !! of the rows of the finest
      integer :: n

      if (allocated(self%levels)) deallocate (self%levels, self%factors)
      allocate (self%levels(0))
      self%used = 0
      if (.not. grid%is_line) self%levels = [new_level(grid%last_row - grid%first_row + 1, grid%nx - 1, &
                                                       grid%first_row, reach_x, reach_y)]
      do n = 1, merge(0, bit_size(n), grid%is_line)
         if (min(self%levels(n)%fast, self%levels(n)%slow) < fewest) exit
         self%levels = [self%levels, new_coarser(self%levels(n))]
      end do
      allocate (self%factors(2:size(self%levels)))
   end subroutine init

   !> Take the rows of a line of the finest grid, and the nodes of it that are corrected.
   pure subroutine put_line(self, i, rows, is_in)
      class(coarse_factors_t), intent(inout) :: self
      integer, intent(in) :: i
      real(dp), intent(in) :: rows(:, :)                !! (unknown rows, entries)
      logical, intent(in) :: is_in(:)
      if (size(self%levels) == 0) return
      self%levels(1)%rows(:, :, i) = real(rows, sp)
      self%levels(1)%part(1:size(is_in), i) = merge(1.0_sp, 0.0_sp, is_in)
   end subroutine put_line

   !> Complete matrices and factors after the last line.
   subroutine finish(self)
      class(coarse_factors_t), intent(inout) :: self
      integer :: n
      self%used = min(1, size(self%levels))
      do n = 2, size(self%levels)
         call make_coarser(self%levels(n - 1), self%levels(n))
         if (.not. are_made(self%factors(n), self%levels(n))) return
         self%used = n
      end do
   end subroutine finish

   !> Factorise the rows of a grid with the least shift that keeps the factors bounded, if one does.
   logical function are_made(self, level)
      type(scaled_factors_t), intent(inout) :: self
      type(level_t), intent(in) :: level
      real(dp) :: rows(level%fast, size(level%rows, 2))
      integer :: attempt, i, k, middle

      if (.not. allocated(self%scale)) self%ilu = new_ilu(level%fast, level%slow, level%reach_y, level%reach_x)
      middle = size(level%rows, 2)/2 + 1
      self%scale = level%rows(:, middle, :)
      where (.not. abs(self%scale) > 0) self%scale = 1
      self%scale = 1/self%scale
      do attempt = 1, size(diagonal_shift)
         call self%ilu%begin()
         do i = 1, level%slow
            do k = 1, size(rows, 2)
               rows(:, k) = level%rows(:, k, i)*self%scale(:, i)
            end do
            rows(:, middle) = rows(:, middle) + diagonal_shift(attempt)
            call self%ilu%add_line(i, rows)
         end do
         are_made = self%ilu%is_bounded()
         if (are_made) return
      end do
   end function are_made

   !> Add corrections to a solution of the finest grid.
   subroutine correct(self, right, x)
      class(coarse_factors_t), intent(inout) :: self
      real(dp), intent(in), contiguous :: right(:, :)      !! (unknown rows, lines) right side
      real(dp), intent(inout), contiguous :: x(:, :)       !! its solution with the factors
      integer :: n

      if (self%used < 2) return
      self%levels(1)%r = right
      self%levels(1)%x = x
      do n = 2, self%used
         associate (fine => self%levels(n - 1), coarse => self%levels(n), factors => self%factors(n))
            call subtract_product(fine)
            if (fine%first == 0) fine%r(1, :) = 0.5_dp*fine%r(1, :)
            call restrict(fine, coarse)
            coarse%x = factors%scale*coarse%r
            call factors%ilu%solve(coarse%x)
         end associate
      end do
      do n = self%used, 2, -1
         call prolong(self%levels(n), self%levels(n - 1))
         self%levels(n - 1)%x = self%levels(n - 1)%x + self%levels(n - 1)%r
      end do
      x = self%levels(1)%x
   end subroutine correct

   !> Transposed `correct`, which comes before the transposed factors.
   subroutine correct_transposed(self, x, right)
      class(coarse_factors_t), intent(inout) :: self
      real(dp), intent(inout), contiguous :: x(:, :)       !! weights of the solution; then of the factors' one
      real(dp), intent(out), contiguous :: right(:, :)     !! weights of the right side by the corrections alone
      integer :: n

      right = 0
      if (self%used < 2) return
      self%levels(1)%x = x
      do n = 2, self%used
         associate (fine => self%levels(n - 1), coarse => self%levels(n))
            fine%r = fine%part(1:fine%fast, :)*fine%x
            call restrict(fine, coarse)
            coarse%x = coarse%r
         end associate
      end do
      do n = self%used, 2, -1
         associate (fine => self%levels(n - 1), coarse => self%levels(n), factors => self%factors(n))
            call factors%ilu%solve_transposed(coarse%x)
            coarse%x = factors%scale*coarse%x
            if (n < self%used) coarse%x = coarse%x + coarse%r
            call prolong(coarse, fine)
            if (fine%first == 0) fine%r(1, :) = 0.5_dp*fine%r(1, :)
            call subtract_transposed_product(fine)
         end associate
      end do
      x = self%levels(1)%x
      right = self%levels(1)%r
   end subroutine correct_transposed

end module ehlwave_coarse_factors
