!> Sparse near part of the Jacobian, bordered by the column of Delta and the load row, as rows of nonzeros.
module ehlwave_near_matrix
   use, intrinsic :: iso_c_binding, only: c_int
   use ehlwave_contact_problem, only: contact_problem_t
   use ehlwave_equations, only: equations_t
   use ehlwave_given, only: given_t
   use ehlwave_kinds, only: dp
   use ehlwave_load_balance, only: load_factor
   use ehlwave_near_kernel, only: near_kernel_t, near_settings_t, new_near_kernel
   use ehlwave_real_near_rows, only: near_links_t, near_rows
   implicit none (type, external)
   private

   !> Rows and columns in the order of `contact_inequality`.
   type, public :: near_matrix_t
      integer(c_int), allocatable :: row_start(:), column(:)   !! the pattern, counted from 0
      type(near_kernel_t), private :: kernel
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

      associate (grid => problem%grid, elliptic => problem%conditions%elliptic, kernel => self%kernel)
         self%kernel = new_near_kernel(grid, elliptic%kappa, elliptic%k, near_settings_t())
         columns = grid%nx - 1
         rows = grid%last_row - grid%first_row + 1
         n = rows*columns + 1
         if (allocated(self%column)) deallocate (self%row_start, self%column)
         allocate (self%row_start(n + 1), self%column(n*(kernel%entries + 2)), source=0_c_int)
         entries = 0
         do i = 1, columns
            do j = 1, rows
               k = (i - 1)*rows + j
               do di = max(-kernel%reach_x, 1 - i), min(kernel%reach_x, columns - i)
                  do dj = max(-kernel%reach_y, 1 - j), min(kernel%reach_y, rows - j)
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
   subroutine fill(self, given, equations, by_delta, weight, a)
      class(near_matrix_t), intent(inout) :: self
      type(given_t), intent(in) :: given
      type(equations_t), intent(in) :: equations    !! evaluated at the point of linearisation
      real(dp), intent(in) :: by_delta(0:, 0:)      !! dR/dDelta, (0:nx, 0:ny)
      real(dp), intent(in) :: weight(0:, 0:)        !! weight of the Reynolds rows
      real(dp), intent(out) :: a(:)                 !! (size(column))
      real(dp) :: rows(equations%mesh%grid%last_row - equations%mesh%grid%first_row + 1, self%kernel%entries)
      type(near_links_t) :: links
      integer :: di, dj, entry, i, j, load_row

      associate (grid => equations%mesh%grid, kernel => self%kernel)
         entry = 0
         load_row = self%row_start(size(self%row_start) - 1)
         do i = 1, grid%nx - 1
            call near_rows(kernel, equations%mesh, given%transport, equations%flow, i, links, rows)
            do j = grid%first_row, grid%last_row
               do di = max(-kernel%reach_x, 1 - i), min(kernel%reach_x, grid%nx - 1 - i)
                  do dj = max(-kernel%reach_y, grid%first_row - j), min(kernel%reach_y, grid%last_row - j)
                     entry = entry + 1
                     a(entry) = -weight(i, j)*rows(j - grid%first_row + 1, kernel%entry_at(di, dj))
                  end do
               end do
               entry = entry + 1
               a(entry) = -weight(i, j)*by_delta(i, j)
               load_row = load_row + 1
               a(load_row) = load_factor*grid%hx*grid%hy*grid%weight(j)
            end do
         end do
         a(size(a)) = given%load%inertia
      end associate
   end subroutine fill

end module ehlwave_near_matrix
