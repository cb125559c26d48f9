!> Derivatives of the equations of nodes by the pressure and film of their neighbours, where surfaces may touch.
module ehlwave_touching_local_rows
   use ehlwave_grid, only: grid_t
   use ehlwave_kinds, only: dp
   use ehlwave_near_kernel, only: near_kernel_t
   use ehlwave_touching_equations, only: link_i, link_row, links, touching_equations_t
   use ehlwave_touching_state, only: touching_law_t, touching_state_t
   implicit none (type, external)
   private
   public :: fold, local_rows, take_contents

contains

   !> Derivatives of the equations of the nodes at one X by q and film of their links. Where solids bear it is the gap
   !> that counts.
   subroutine local_rows(follows, grid, equations, law, state, i, by_p, by_h)
      type(grid_t), intent(in) :: grid
      type(touching_equations_t), intent(in) :: equations
      type(touching_law_t), intent(in) :: law
      type(touching_state_t), intent(in) :: state
      integer, intent(in) :: i
      real(dp), intent(out) :: by_p(:, :), by_h(:, :)     !! (unknown rows, links)
      real(dp), intent(in) :: follows(0:, 0:)             !! by which P follows where solids bear
      integer :: j, l, m, n, row

      by_p = 0
      by_h = 0
      do l = 1, links
         m = i + link_i(l)
         if (m < 0) cycle
         do row = 1, size(by_p, 1)
            j = row - 1 + grid%first_row
            n = link_row(j, l, grid%is_line)
            if (state%is_touching(i, j)) then
               if (l > 1) cycle
               by_h(row, 1) = 1
               if (law%is_soft) by_p(row, 1) = law%softness/state%c(i, j)
            else
               if (law%is_soft .or. .not. state%is_touching(m, n)) by_h(row, l) = equations%by_h(i, j, l)
               if (state%is_cavitated(m, n)) cycle
               if (state%is_touching(m, n)) then
                  by_p(row, 1) = by_p(row, 1) + equations%by_p(i, j, l)*follows(m, n)
               else
                  by_p(row, l) = by_p(row, l) + equations%by_p(i, j, l)
               end if
            end if
         end do
      end do
   end subroutine local_rows

   !> A content deforms nothing: in the columns of cavitated nodes where no solids bear there is theta in place of q.
   subroutine take_contents(grid, kernel, equations, state, i, rows)
      type(grid_t), intent(in) :: grid
      type(near_kernel_t), intent(in) :: kernel
      type(touching_equations_t), intent(in) :: equations
      type(touching_state_t), intent(in) :: state
      integer, intent(in) :: i
      real(dp), intent(inout) :: rows(:, :)
      integer :: di, dj, entry, j, n, row

      do di = -kernel%reach_x, kernel%reach_x
         if (i + di < 1 .or. i + di > grid%nx - 1) cycle
         do dj = -kernel%reach_y, kernel%reach_y
            entry = kernel%entry_at(di, dj)
            do row = 1, size(rows, 1)
               j = row - 1 + grid%first_row
               n = abs(j + dj)
               if (n > grid%ny) cycle
               if (.not. state%is_cavitated(i + di, n) .or. state%is_touching(i + di, n)) cycle
               rows(row, entry) = 0
               if (dj /= 0 .or. di > 0 .or. di < -1 .or. state%is_touching(i, j)) cycle
               rows(row, entry) = equations%by_theta(i, j, 1 - di)
            end do
         end do
      end do
   end subroutine take_contents

   !> Fold entries beyond a line of symmetry back, and clear entries beyond the other edges.
   pure subroutine fold(grid, kernel, rows)
      type(grid_t), intent(in) :: grid
      type(near_kernel_t), intent(in) :: kernel
      real(dp), intent(inout) :: rows(:, :)
      integer :: di, dj, entry, n, row, target

      n = size(rows, 1)
      do row = 1, n
         if (row > kernel%reach_y .and. row <= n - kernel%reach_y) cycle
         do di = -kernel%reach_x, kernel%reach_x
            do dj = -kernel%reach_y, kernel%reach_y
               target = row + dj
               if (target >= 1 .and. target <= n) cycle
               entry = kernel%entry_at(di, dj)
               if (grid%is_half .and. target < 1) then
                  target = 2 - target
                  if (target - row <= kernel%reach_y .and. target <= n) &
                     rows(row, entry + target - row - dj) = rows(row, entry + target - row - dj) + rows(row, entry)
               end if
               rows(row, entry) = 0
            end do
         end do
      end do
   end subroutine fold

end module ehlwave_touching_local_rows
