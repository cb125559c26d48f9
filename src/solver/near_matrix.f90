!> Sparse near part of the Jacobian, bordered by the column of Delta and the load row, as rows of nonzeros.
module ehlwave_near_matrix
   use, intrinsic :: iso_c_binding, only: c_int
   use ehlwave_contact_problem, only: contact_problem_t
   use ehlwave_kinds, only: dp
   use ehlwave_load_balance, only: load_factor
   use ehlwave_near_stencil, only: near_stencil_t, new_near_stencil
   use ehlwave_reynolds, only: flow_t
   implicit none (type, external)
   private

   integer, parameter :: largest_reach = 8   ! cells of the near stencil

   !> Rows and columns in the order of `contact_inequality`.
   type, public :: near_matrix_t
      integer(c_int), allocatable :: row_start(:), column(:)   !! the pattern, counted from 0
      type(near_stencil_t), private :: stencil
      real(dp), allocatable, private :: near(:, :, :)          ! (nx-1, entries, first_row:ny-1) stencil of each node
   contains
      procedure :: init
      procedure :: fill
   end type near_matrix_t

contains

   !> Pattern for a problem's grid: the stencil and the Delta column at each node, then the load row.
   subroutine init(self, problem)
      class(near_matrix_t), intent(inout) :: self
      type(contact_problem_t), intent(in) :: problem
      integer :: columns, di, dj, entries, i, j, k, n, rows

      associate (grid => problem%grid, elliptic => problem%conditions%elliptic, stencil => self%stencil)
         self%stencil = new_near_stencil(grid, elliptic%kappa, elliptic%k, largest_reach, 0.0_dp)
         columns = grid%nx - 1
         rows = grid%ny - grid%first_row
         n = rows*columns + 1
         if (allocated(self%near)) deallocate (self%near, self%row_start, self%column)
         allocate (self%near(columns, stencil%entries, grid%first_row:grid%ny - 1), source=0.0_dp)
         allocate (self%row_start(n + 1), self%column(n*(stencil%entries + 2)), source=0_c_int)
         entries = 0
         do i = 1, columns
            do j = 1, rows
               k = (i - 1)*rows + j
               do di = max(-stencil%reach_x, 1 - i), min(stencil%reach_x, columns - i)
                  do dj = max(-stencil%reach_y, 1 - j), min(stencil%reach_y, rows - j)
                     entries = entries + 1
                     self%column(entries) = k - 1 + di*rows + dj
                  end do
               end do
               entries = entries + 1
               self%column(entries) = n - 1
               self%row_start(k + 1) = entries
            end do
         end do
         do k = 1, n
            self%column(entries + k) = k - 1
         end do
         entries = entries + n
         self%row_start(n + 1) = entries
         self%column = self%column(:entries)
      end associate
   end subroutine init

   !> Nonzeros of the rows -weight dR, local terms and deformation by the nearest cells, and of the load row.
   subroutine fill(self, problem, flow, p, by_delta, weight, a)
      class(near_matrix_t), intent(inout) :: self
      type(contact_problem_t), intent(in) :: problem
      type(flow_t), intent(in) :: flow              !! evaluated at the point of linearisation
      real(dp), intent(in) :: p(0:, 0:)             !! P there, (0:nx, 0:ny)
      real(dp), intent(in) :: by_delta(0:, 0:)      !! dR/dDelta
      real(dp), intent(in) :: weight(0:, 0:)        !! of the Reynolds rows
      real(dp), intent(out) :: a(:)                 !! (size(column))
      integer :: di, dj, entry, i, j, load_row

      associate (grid => problem%grid, stencil => self%stencil)
         do j = grid%first_row, grid%ny - 1
            call stencil%fill_line(grid, problem%transport, problem%conditions%elliptic%kappa, flow, p, j, &
                                   self%near(:, :, j))
         end do
         entry = 0
         load_row = self%row_start(size(self%row_start) - 1)
         do i = 1, grid%nx - 1
            do j = grid%first_row, grid%ny - 1
               do di = max(-stencil%reach_x, 1 - i), min(stencil%reach_x, grid%nx - 1 - i)
                  do dj = max(-stencil%reach_y, grid%first_row - j), min(stencil%reach_y, grid%ny - 1 - j)
                     entry = entry + 1
                     a(entry) = -weight(i, j)*self%near(i, stencil%entry_at(di, dj), j)
                  end do
               end do
               entry = entry + 1
               a(entry) = -weight(i, j)*by_delta(i, j)
               load_row = load_row + 1
               a(load_row) = load_factor*grid%hx*grid%hy*grid%weight(j)
            end do
         end do
         a(size(a)) = problem%load%inertia
      end associate
   end subroutine fill

end module ehlwave_near_matrix
