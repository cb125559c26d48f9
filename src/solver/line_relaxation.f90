!> Hybrid line relaxation of the contact problem, lines along X.
!>
!> Venner (1991); Venner and Lubrecht, Multilevel Methods in Lubrication (2000), chapter 6. Where Poiseuille flow
!> rules, the pressures of a line are changed one by one (Gauss-Seidel from line to line). Where it is weak, the
!> equation is one for the deformation, whose kernel reaches far: there the unknown of a node is the strength of a
!> distributive change, 1 at the node and in sum -1 at its four neighbours, whose deformation falls as 1/r^3, and
!> all lines are changed together at the end of the sweep (Jacobi).
module ehlwave_line_relaxation
   use ehlwave_contact_problem, only: contact_problem_t
   use ehlwave_kernel, only: cell_influence
   use ehlwave_kinds, only: dp
   use ehlwave_near_stencil, only: link_i, link_j, links, row_links
   use ehlwave_reynolds, only: diagonal_scale, flow_t, new_flow, reynolds_residual
   use ehlwave_state, only: state_t
   implicit none (type, external)
   private

   integer, parameter :: single = 0, distributed = 1   ! kinds of change

   type, public :: line_relaxation_t
      real(dp) :: switch = 0.3_dp                 !! Poiseuille over wedge coefficient below which changes are distributed
      real(dp) :: damping(0:1) = [0.8_dp, 0.5_dp] !! of single and of distributive changes
      type(flow_t) :: flow                        !! coefficients at the state last evaluated
      real(dp), allocatable :: residual(:, :)     !! R at the state last evaluated, (0:nx, 0:ny)
      logical, allocatable :: is_cavitated(:, :)  !! P + R/|A_ii| <= 0
      real(dp), allocatable :: scale(:, :)        !! 1/|A_ii|, 0 on the boundary
      integer :: reach = 3                        !! bands of the line system on either side
      real(dp) :: self_influence = 0
      real(dp), private :: share_x = 0, share_y = 0     ! of a distributive change at its neighbours
      real(dp), allocatable, private :: shape(:, :, :)      ! pressure of a change, (-reach-2:reach+2, 0:1, kind)
      real(dp), allocatable, private :: influence(:, :, :)  ! its deformation
      real(dp), allocatable, private :: strength(:, :)      ! of the distributive changes
      real(dp), allocatable, private :: south(:)            ! changes made in the line before
      real(dp), allocatable, private :: band(:, :), delta(:)
      integer, allocatable, private :: kind(:)
   contains
      procedure :: init
      procedure :: evaluate
      procedure :: relax
   end type line_relaxation_t

contains

   !> Work space for a problem's grid.
   subroutine init(self, problem)
      class(line_relaxation_t), intent(inout) :: self
      type(contact_problem_t), intent(in) :: problem
      real(dp) :: aspect
      integer :: i, j, r

      associate (grid => problem%grid, kappa => problem%conditions%elliptic%kappa, k => problem%conditions%elliptic%k)
         aspect = grid%hy/(kappa*grid%hx)
         self%reach = max(3, min(8, nint(2*aspect)))
         self%share_x = 0.5_dp*aspect**2/(1 + aspect**2)
         self%share_y = 0.5_dp - self%share_x
         r = self%reach + 2
         allocate (self%shape(-r:r, 0:1, 0:1), self%influence(-r:r, 0:1, 0:1), source=0.0_dp)
         self%shape(0, 0, :) = 1
         self%shape(-1, 0, distributed) = -self%share_x
         self%shape(1, 0, distributed) = -self%share_x
         self%shape(0, 1, distributed) = -self%share_y
         do j = 0, 1
            do i = -r, r
               self%influence(i, j, single) = at(i, j)
               self%influence(i, j, distributed) = at(i, j) - self%share_x*(at(i - 1, j) + at(i + 1, j)) &
                                                   - self%share_y*(at(i, j - 1) + at(i, j + 1))
            end do
         end do
         self%self_influence = at(0, 0)
         self%flow = new_flow(grid)
         allocate (self%residual(0:grid%nx, 0:grid%ny), self%scale(0:grid%nx, 0:grid%ny), &
                   self%strength(0:grid%nx, 0:grid%ny), source=0.0_dp)
         allocate (self%is_cavitated(0:grid%nx, 0:grid%ny), source=.false.)
         allocate (self%south(0:grid%nx), self%delta(0:grid%nx), source=0.0_dp)
         allocate (self%band(-self%reach:self%reach, 1 - self%reach:grid%nx - 1 + self%reach), source=0.0_dp)
         allocate (self%kind(0:grid%nx), source=single)
      end associate

   contains

      real(dp) function at(i, j)
         integer, intent(in) :: i, j
         associate (grid => problem%grid, elliptic => problem%conditions%elliptic)
            at = cell_influence(i*grid%hx, j*grid%hy, grid%hx, grid%hy, elliptic%kappa, elliptic%k)
         end associate
      end function at
   end subroutine init

   !> Coefficients, residual and cavitated nodes of a state whose film belongs to its pressure.
   subroutine evaluate(self, problem, state)
      class(line_relaxation_t), intent(inout) :: self
      type(contact_problem_t), intent(in) :: problem
      type(state_t), intent(in) :: state

      associate (grid => problem%grid, kappa => problem%conditions%elliptic%kappa)
         call self%flow%evaluate(problem%rheology, problem%conditions%lambdabar, state%p, state%h)
         call reynolds_residual(grid, problem%transport, kappa, self%flow, state%p, self%residual)
         call diagonal_scale(grid, problem%transport, kappa, self%self_influence, self%flow, self%scale)
         self%is_cavitated = self%scale > 0 .and. state%p + self%scale*self%residual <= 0
      end associate
   end subroutine evaluate

   !> One sweep over all lines from the evaluated state; then the film of the new pressure.
   subroutine relax(self, problem, state)
      class(line_relaxation_t), intent(inout) :: self
      type(contact_problem_t), intent(inout) :: problem
      type(state_t), intent(inout) :: state
      integer :: i, j, jm

      associate (grid => problem%grid, p => state%p)
         self%strength = 0
         self%south = 0
         do j = grid%first_row, grid%ny - 1
            call solve_line(self, problem, p, j)
            do i = 1, grid%nx - 1
               self%south(i) = 0
               if (self%kind(i) == distributed) then
                  self%strength(i, j) = self%damping(distributed)*self%delta(i)
               else
                  self%south(i) = max(p(i, j) + self%damping(single)*self%delta(i), 0.0_dp) - p(i, j)
                  p(i, j) = p(i, j) + self%south(i)
               end if
            end do
         end do
         do j = grid%first_row, grid%ny - 1
            jm = grid%below(j)
            do i = 1, grid%nx - 1
               p(i, j) = max(0.0_dp, p(i, j) + self%strength(i, j) &
                             - self%share_x*(self%strength(i - 1, j) + self%strength(i + 1, j)) &
                             - self%share_y*(self%strength(i, jm) + self%strength(i, j + 1)))
            end do
         end do
         call problem%film(state%p, state%delta, state%h)
      end associate
   end subroutine relax

   !> Changes of one line that make its residuals vanish, those of the deformation within reach included.
   subroutine solve_line(self, problem, p, j)
      class(line_relaxation_t), intent(inout) :: self
      type(contact_problem_t), intent(in) :: problem
      real(dp), intent(in) :: p(0:, 0:)
      integer, intent(in) :: j
      real(dp) :: by_p(links), by_h(links), entry, poiseuille, wedge
      integer :: d, i, n

      associate (grid => problem%grid, flow => self%flow)
         do i = 1, grid%nx - 1
            wedge = problem%transport%w0(i)*flow%f_h(i, j)*self%self_influence
            poiseuille = 1/self%scale(i, j) - problem%transport%w0(i)*(flow%f_h(i, j)*self%self_influence + flow%f_p(i, j))
            self%kind(i) = merge(distributed, single, poiseuille < self%switch*wedge .and. .not. self%is_cavitated(i, j))
         end do
         do i = 1, grid%nx - 1
            self%band(:, i) = 0
            if (self%is_cavitated(i, j)) then
               self%band(0, i) = 1
               self%delta(i) = -p(i, j)
               cycle
            end if
            call row_links(grid, problem%transport, problem%conditions%elliptic%kappa, flow, p, i, j, by_p, by_h)
            self%delta(i) = -self%residual(i, j) - by_p(5)*self%south(i)
            do d = max(-self%reach, 1 - i), min(self%reach, grid%nx - 1 - i)
               associate (shape => self%shape(:, :, self%kind(i + d)), influence => self%influence(:, :, self%kind(i + d)), &
                          m => self%reach + 3)
                  entry = 0
                  do n = 1, links
                     entry = entry + by_p(n)*shape(m + link_i(n) - d, 1 + abs(link_j(n))) &
                             + by_h(n)*influence(m + link_i(n) - d, 1 + abs(link_j(n)))
                  end do
               end associate
               self%band(d, i) = entry
            end do
         end do
         call solve_band(self%reach, grid%nx - 1, self%band, self%delta(1:))
      end associate
   end subroutine solve_line

   !> Gauss elimination without pivoting; band(d, i) is the coefficient of unknown i + d in row i.
   pure subroutine solve_band(reach, n, band, x)
      integer, intent(in) :: reach, n
      real(dp), intent(inout) :: band(-reach:, 1 - reach:)
      real(dp), intent(inout) :: x(:)   !! right side, then solution
      real(dp) :: factor
      integer :: d, i, k

      do i = 1, n
         do k = i + 1, min(i + reach, n)
            factor = band(i - k, k)/band(0, i)
            do d = 1, reach
               band(i - k + d, k) = band(i - k + d, k) - factor*band(d, i)
            end do
            x(k) = x(k) - factor*x(i)
         end do
      end do
      do i = n, 1, -1
         do d = 1, min(reach, n - i)
            x(i) = x(i) - band(d, i)*x(i + d)
         end do
         x(i) = x(i)/band(0, i)
      end do
   end subroutine solve_band

end module ehlwave_line_relaxation
