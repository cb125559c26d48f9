!> A grid of corrections on coarser grids: its matrix, its part of the nodes, and transfers to the next coarser grid.
module ehlwave_coarse_level
   use ehlwave_kinds, only: dp, sp
   implicit none (type, external)
   private
   public :: make_coarser, new_coarser, new_level, prolong, restrict, subtract_product, subtract_transposed_product

   !> Unknown rows first, then lines.
   type, public :: level_t
      integer :: fast = 0, slow = 0                     !! unknown rows and lines
      integer :: first = 1                              !! row of the first: 0 of a half domain
      integer :: reach_x = 0, reach_y = 0               !! nodes between a row of the matrix and its entries
      real(sp), allocatable :: rows(:, :, :)            !! (fast, entries, slow)
      real(sp), allocatable :: part(:, :)               !! (1-reach_y:fast+reach_y, slow) 1: corrected, else 0
      real(dp), allocatable :: r(:, :), x(:, :)         !! (fast, slow) residual, solution
   end type level_t

contains

   !> Room for a grid.
   pure function new_level(fast, slow, first, reach_x, reach_y) result(self)
      integer, intent(in) :: fast, slow, first, reach_x, reach_y
      type(level_t) :: self
      self%fast = fast
      self%slow = slow
      self%first = first
      self%reach_x = reach_x
      self%reach_y = reach_y
      allocate (self%rows(fast, (2*reach_x + 1)*(2*reach_y + 1), slow), source=0.0_sp)
      allocate (self%part(1 - reach_y:fast + reach_y, slow), source=0.0_sp)
      allocate (self%r(fast, slow), self%x(fast, slow), source=0.0_dp)
   end function new_level

   !> Room for the next coarser grid.
   pure function new_coarser(fine) result(self)
      type(level_t), intent(in) :: fine
      type(level_t) :: self
      self = new_level((fine%fast + 1 - fine%first)/2, fine%slow/2, fine%first, (fine%reach_x + 2)/2, &
                       (fine%reach_y + 2)/2)
   end function new_coarser

   !> Entry of an offset within the reaches, sorted by offset along X.
   pure integer function entry_at(level, di, dj)
      type(level_t), intent(in) :: level
      integer, intent(in) :: di, dj
      entry_at = (di + level%reach_x)*(2*level%reach_y + 1) + dj + level%reach_y + 1
   end function entry_at

   !> Matrix R A P of the next grid, with the interpolation P between nodes that are corrected, and R = P^T, where the
   !> first row of a half domain counts for half. Along X, then along Y.
   pure subroutine make_coarser(fine, coarse)
      type(level_t), intent(in) :: fine
      type(level_t), intent(inout) :: coarse
      real(sp) :: lines(0:fine%fast + 1, -fine%reach_y:fine%reach_y, -coarse%reach_x:coarse%reach_x)
      integer :: b, dj, entry, ic, k, l, middle

      coarse%part = 0
      coarse%rows = 0
      middle = size(coarse%rows, 2)/2 + 1
      do ic = 1, coarse%slow
         coarse%part(1:coarse%fast, ic) = fine%part(fine%first + 1:2*coarse%fast + fine%first - 1:2, 2*ic)
      end do
      do ic = 1, coarse%slow
         call gather_lines(fine, coarse, ic, lines)
         do k = max(-coarse%reach_x, 1 - ic), min(coarse%reach_x, coarse%slow - ic)
            do dj = -fine%reach_y, fine%reach_y
               do b = -1, 1
                  associate (rows => lines(1 + fine%first + b:2*coarse%fast + fine%first - 1 + b:2, dj, k))
                     ! a node between coarser ones takes half of either
                     do l = floor_half(b + dj), floor_half(b + dj + 1)
                        entry = entry_at(coarse, k, l)
                        coarse%rows(:, entry, ic) = coarse%rows(:, entry, ic) &
                                                    + 0.5_sp**(abs(b) + modulo(b + dj, 2))*rows
                     end do
                  end associate
               end do
            end do
            do l = -coarse%reach_y, coarse%reach_y
               associate (rows => coarse%rows(:, entry_at(coarse, k, l), ic))
                  rows = rows*coarse%part(1:coarse%fast, ic)*coarse%part(1 + l:coarse%fast + l, ic + k)
               end associate
            end do
         end do
         coarse%rows(:, middle, ic) = coarse%rows(:, middle, ic) + (1 - coarse%part(1:coarse%fast, ic))
      end do
   end subroutine make_coarser

   !> Half of an even number, or of the odd number less one.
   pure integer function floor_half(n)
      integer, intent(in) :: n
      floor_half = (n - modulo(n, 2))/2
   end function floor_half

   !> Rows of the lines about one of the next grid: entries of lines of that grid.
   pure subroutine gather_lines(fine, coarse, ic, lines)
      type(level_t), intent(in) :: fine, coarse
      integer, intent(in) :: ic
      real(sp), intent(out) :: lines(0:, -fine%reach_y:, -coarse%reach_x:)   !! 0 beyond the rows
      real(sp) :: values(fine%fast)
      integer :: a, di, dj, k, line

      lines = 0
      do a = -1, min(1, fine%slow - 2*ic)
         line = 2*ic + a
         do di = max(-fine%reach_x, 1 - line), min(fine%reach_x, fine%slow - line)
            do dj = -fine%reach_y, fine%reach_y
               values = 0.5_sp**(abs(a) + modulo(a + di, 2))*fine%rows(:, entry_at(fine, di, dj), line) &
                        *fine%part(1:fine%fast, line)*fine%part(1 + dj:fine%fast + dj, line + di)
               if (fine%first == 0) values(1) = 0.5_sp*values(1)
               do k = floor_half(a + di), floor_half(a + di + 1)
                  lines(1:fine%fast, dj, k) = lines(1:fine%fast, dj, k) + values
               end do
            end do
         end do
      end do
   end subroutine gather_lines

   !> r <- r - A x where nodes are corrected, else 0.
   pure subroutine subtract_product(level)
      type(level_t), intent(inout) :: level
      integer :: di, dj, first, i, last
      do i = 1, level%slow
         do di = max(-level%reach_x, 1 - i), min(level%reach_x, level%slow - i)
            do dj = -level%reach_y, level%reach_y
               first = max(1, 1 - dj)
               last = min(level%fast, level%fast - dj)
               level%r(first:last, i) = level%r(first:last, i) - level%rows(first:last, entry_at(level, di, dj), i) &
                                        *level%x(first + dj:last + dj, i + di)
            end do
         end do
         level%r(:, i) = level%part(1:level%fast, i)*level%r(:, i)
      end do
   end subroutine subtract_product

   !> x <- x - A^T r.
   pure subroutine subtract_transposed_product(level)
      type(level_t), intent(inout) :: level
      integer :: di, dj, first, i, last
      do i = 1, level%slow
         do di = max(-level%reach_x, 1 - i), min(level%reach_x, level%slow - i)
            do dj = -level%reach_y, level%reach_y
               first = max(1, 1 - dj)
               last = min(level%fast, level%fast - dj)
               level%x(first + dj:last + dj, i + di) = level%x(first + dj:last + dj, i + di) &
                  - level%rows(first:last, entry_at(level, di, dj), i)*level%r(first:last, i)
            end do
         end do
      end do
   end subroutine subtract_transposed_product

   !> r of the next grid: P^T r.
   pure subroutine restrict(fine, coarse)
      type(level_t), intent(in) :: fine
      type(level_t), intent(inout) :: coarse
      real(dp) :: line(0:fine%fast + 1)
      integer :: ic
      line = 0
      do ic = 1, coarse%slow
         line(1:fine%fast) = fine%r(:, 2*ic) + 0.5_dp*fine%r(:, 2*ic - 1)
         if (2*ic < fine%slow) line(1:fine%fast) = line(1:fine%fast) + 0.5_dp*fine%r(:, 2*ic + 1)
         associate (low => fine%first + 1, top => 2*coarse%fast + fine%first - 1)
            coarse%r(:, ic) = coarse%part(1:coarse%fast, ic) &
                              *(line(low:top:2) + 0.5_dp*(line(low - 1:top - 1:2) + line(low + 1:top + 1:2)))
         end associate
      end do
   end subroutine restrict

   !> r of the finer grid: P x.
   pure subroutine prolong(coarse, fine)
      type(level_t), intent(in) :: coarse
      type(level_t), intent(inout) :: fine
      real(dp) :: line(0:coarse%fast + 1)
      integer :: i, next, row
      line = 0
      do i = 1, fine%slow
         next = (i + 1)/2
         line(1:coarse%fast) = 0
         if (i > 1) line(1:coarse%fast) = 0.5_dp*coarse%part(1:coarse%fast, i/2)*coarse%x(:, i/2)
         if (next <= coarse%slow) line(1:coarse%fast) = line(1:coarse%fast) &
            + 0.5_dp*coarse%part(1:coarse%fast, next)*coarse%x(:, next)
         do row = 1, fine%fast
            associate (at => row + 1 - fine%first)
               fine%r(row, i) = 0.5_dp*fine%part(row, i)*(line(at/2) + line((at + 1)/2))
            end associate
         end do
      end do
   end subroutine prolong

end module ehlwave_coarse_level
