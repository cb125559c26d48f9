!> Hybrid line relaxation of the contact problem, lines along X.
!>
!> Venner (1991); Venner and Lubrecht, Multilevel Methods in Lubrication (2000), chapter 6. Where Poiseuille flow
!> rules, the pressures of a line are changed one by one. Where it is weak, the equation is one for the deformation,
!> whose kernel reaches far: there the unknown of a node is the strength of a distributive change, 1 at the node and in
!> sum -1 at its four neighbours, whose deformation falls as 1/r^3. Each line sees the pressure changes of those before
!> it (Gauss-Seidel), and their deformation at the end of the sweep only (Jacobi). Threads make the matrix of a line and
!> its factors, which do not see the other lines, ahead of its turn.
module ehlwave_line_relaxation
   use ehlwave_contact_problem, only: contact_problem_t
   use ehlwave_equations, only: equations_t
   use ehlwave_given, only: given_t
   use ehlwave_kernel, only: cell_influence
   use ehlwave_kinds, only: dp
   use ehlwave_real_band, only: band_t, new_band
   use ehlwave_real_near_rows, only: link_i, link_j, links, node_links
   use ehlwave_real_wedge, only: wedge_t
   use ehlwave_rheology, only: rheology_t
   use ehlwave_state, only: state_t
   use ehlwave_step_limit, only: step_limit_t
   use ehlwave_threads, only: announce, await, is_shared, team_size, thread_count, thread_number
   use ehlwave_work_unit, only: relaxation_operations
   implicit none (type, external)
   private

   integer, parameter :: single = 0, distributed = 1   ! kinds of change
   real(dp), parameter :: damping = 0.9_dp             ! of both

   !> Lines that a thread takes at once where there are several. A line reads its neighbours: with one at a time, each
   !> thread reads all of the grid. Steady state of M = 100, D = 1 on 1024^2 cells, two threads, medians of 14 runs in
   !> turn: 0.89 s with one, 0.78, 0.82, 0.86 s with 2, 4, 8.
   integer, parameter :: lines_at_once = 2

   !> Poiseuille over wedge coefficient below which changes are distributed, for cells that are square in metres.
   !> It grows with the square of their aspect: single changes in long cells deform many of their neighbours.
   real(dp), parameter :: switch_of_squares = 3

   !> The same of an oil that is not Newtonian. The ratio counts the flow along X and across; where sliding makes that
   !> along X several times easier, less of it couples one line to the next, and single changes spread at ratios that
   !> would do otherwise.
   real(dp), parameter :: switch_of_easy_flow = 6

   !> The same of an oil that thickens about as much by a pressure at the Hertz pressure as at none. Its spike grows
   !> with each finer grid (Barus' law, M = 20, L = 10: 2.5, 3.3, 4.5, 6.3 on 256^2 to 2048^2 cells), and the flow
   !> changes there by a large factor from node to node, so that the sum of the flows to all sides says little of the
   !> coupling. On 2048^2 cells cycles do not converge with a switch of 3.
   real(dp), parameter :: switch_of_steep_spike = 6

   !> The same of a fitted grid, whose differences upstream see the changes of a line more strongly. M = 1000, D = 1,
   !> 512^2 cells to 1e-3: 40 cycles and no end with 3, 7 cycles with 6, 5 with 12.
   real(dp), parameter :: switch_of_fitted = 12
   real(dp), parameter :: steep_share = 0.9_dp   ! of the thickening at P = 0, at P = 1

   !> The linear system of one line: what a thread works on.
   type :: line_system_t
      type(band_t) :: band                                  ! n of it: nodes up to the last that is not cavitated
      real(dp), allocatable :: delta(:)                     ! its right side, then its solution
      real(dp), allocatable :: by_p(:, :), by_h(:, :)       ! derivatives, (node, link), in one more column by both
                                                            ! neighbours across
      integer, allocatable :: kind(:)                       ! of the change of each node
   end type line_system_t

   type, public :: line_relaxation_t
      integer, private :: reach = 3                     ! bands of the line system on either side
      real(dp), private :: switch = 0                   ! `switch_of_squares` for the cells of this grid
      real(dp), private :: share_x = 0, share_y = 0     ! of a distributive change at its neighbours
      real(dp), allocatable, private :: shape(:, :, :)      ! pressure of a change, (-reach-2:reach+2, 0:1, kind)
      real(dp), allocatable, private :: influence(:, :, :)  ! its deformation
      real(dp), allocatable, private :: change(:, :)        ! of P in this sweep
      type(line_system_t), allocatable, private :: line(:, :)   ! (lines at once, 0:threads-1)
   contains
      procedure :: init
      procedure :: relax
   end type line_relaxation_t

contains

   !> Work space for a problem's grid.
   subroutine init(self, problem)
      class(line_relaxation_t), intent(inout) :: self
      type(contact_problem_t), intent(in) :: problem
      real(dp) :: aspect
      integer :: i, j, r, threads

      associate (grid => problem%grid, kappa => problem%conditions%elliptic%kappa, k => problem%conditions%elliptic%k)
         aspect = grid%hy/(kappa*grid%hx)
         self%switch = switch_of(problem%rheology)*max(aspect, 1/aspect)**2
         if (grid%is_fitted) self%switch = max(self%switch, switch_of_fitted*max(aspect, 1/aspect)**2)
         self%reach = max(3, min(5, nint(aspect)))
         self%share_x = 0.5_dp*max(0.5_dp, aspect**2/(1 + aspect**2))
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
         call grid%new_field(self%change)
         threads = merge(thread_count(), 1, is_shared(size(self%change)))
         allocate (self%line(merge(lines_at_once, 1, threads > 1), 0:threads - 1))
         do j = 0, threads - 1
            do i = 1, size(self%line, 1)
               associate (line => self%line(i, j), n => grid%nx - 1)
                  line%band = new_band(n, self%reach)
                  allocate (line%delta(n), line%by_p(n, links + 1), line%by_h(n, links + 1), source=0.0_dp)
                  allocate (line%kind(n), source=single)
               end associate
            end do
         end do
      end associate

   contains

      real(dp) function at(i, j)
         integer, intent(in) :: i, j
         associate (grid => problem%grid, elliptic => problem%conditions%elliptic)
            at = cell_influence(i*grid%hx, j*grid%hy, grid%hx, grid%hy, elliptic%kappa, elliptic%k)
         end associate
      end function at
   end subroutine init

   !> Of squares, for an oil.
   pure real(dp) function switch_of(rheology) result(switch)
      type(rheology_t), intent(in) :: rheology
      real(dp), dimension(2) :: rho, drho, fluidity, thickening

      switch = switch_of_squares
      if (.not. rheology%is_newtonian()) switch = switch_of_easy_flow
      call rheology%evaluate(2, [0.0_dp, 1.0_dp], rho, drho, fluidity, thickening)
      if (thickening(2) > steep_share*thickening(1)) switch = max(switch, switch_of_steep_spike)
   end function switch_of

   !> One sweep over all lines; then the film of the new pressure.
   subroutine relax(self, problem, given, equations, state, next)
      class(line_relaxation_t), intent(inout) :: self
      type(contact_problem_t), intent(inout) :: problem
      type(given_t), intent(in) :: given
      type(equations_t), intent(in) :: equations      !! evaluated at the state
      type(state_t), intent(inout) :: state
      type(state_t), intent(inout) :: next            !! work space: the state before on return
      type(step_limit_t) :: limit
      integer :: done, i, j, width

      associate (grid => problem%grid, change => self%change)
         problem%deformation%work = problem%deformation%work + relaxation_operations*size(change) &
                                   + equations%flow%film_work()
         done = grid%first_row - 1
         width = size(self%line, 1)
         !$omp parallel num_threads(size(self%line, 2)) private(j)
         !$omp do schedule(static)
         do j = 0, grid%ny
            change(:, j) = 0
         end do
         !$omp end do
         do j = grid%first_row + width*thread_number(), grid%last_row, width*team_size()
            call relax_lines(self, given%transport, equations, state, [j, min(j + width - 1, grid%last_row)], done)
         end do
         !$omp end parallel
         !$omp parallel do private(i) schedule(static) if (is_shared(size(change)))
         do j = 0, grid%ny
            next%p(:, j) = state%p(:, j)
            if (j < grid%first_row .or. j > grid%last_row) cycle
            do i = 1, grid%nx - 1
               next%p(i, j) = max(0.0_dp, state%p(i, j) + limit%bounded(change(i, j)))
            end do
         end do
         next%delta = state%delta
         call problem%edges%impose(given, state%h, next%p)   ! one sweep behind: of the film before it
         call problem%film(given, next%p, next%delta, next%h)
         call limit%shorten(state, next)
         call state%exchange(next)
      end associate
   end subroutine relax

   !> Changes of some lines, in their turn.
   subroutine relax_lines(self, transport, equations, state, lines, done)
      class(line_relaxation_t), intent(inout) :: self
      class(wedge_t), intent(in) :: transport
      type(equations_t), intent(in) :: equations
      type(state_t), intent(in) :: state
      integer, intent(in) :: lines(2)           !! the first and the last
      integer, intent(inout) :: done            !! the last line that is done
      integer :: j

      associate (line => self%line(:, thread_number()), last => equations%mesh%grid%nx - 1)
         do j = lines(1), lines(2)
            associate (line => line(j - lines(1) + 1))
               line%band%n = last_wet(equations%is_cavitated(1:last, j))
               if (line%band%n == 0) cycle
               call set_up_line(self, line, transport, equations, j, line%band%n)
               call line%band%factorise()
            end associate
         end do
         call await(done, lines(1) - 1)
         do j = lines(1), lines(2)
            call change_line(self, line(j - lines(1) + 1), equations, state, j)
         end do
         call announce(done, lines(2))
      end associate
   end subroutine relax_lines

   !> Changes of one line whose matrix has been factorised.
   subroutine change_line(self, line, equations, state, j)
      class(line_relaxation_t), intent(inout) :: self
      type(line_system_t), intent(inout) :: line
      type(equations_t), intent(in) :: equations
      type(state_t), intent(in) :: state
      integer, intent(in) :: j
      real(dp) :: strength
      integer :: i, image, jm

      associate (grid => equations%mesh%grid, change => self%change, n => line%band%n)
         jm = grid%below(j)
         image = merge(2, 1, j == 1 .and. grid%is_half)      ! row 0 has row 1 on either side
         change(n + 1:grid%nx - 1, j) = -state%p(n + 1:grid%nx - 1, j)
         if (n > 0) then
            call set_right_side(self, line, equations, j, n)
            call line%band%solve(line%delta)
            do i = 1, n
               if (line%kind(i) == single) then
                  change(i, j) = change(i, j) + damping*line%delta(i)
               else
                  strength = damping*line%delta(i)
                  change(i, j) = change(i, j) + strength
                  change(i - 1, j) = change(i - 1, j) - self%share_x*strength
                  change(i + 1, j) = change(i + 1, j) - self%share_x*strength
                  change(i, j + 1) = change(i, j + 1) - self%share_y*strength
                  if (jm < j) change(i, jm) = change(i, jm) - image*self%share_y*strength
               end if
            end do
            change(0, j) = 0
            change(grid%nx, j) = 0
         end if
      end associate
   end subroutine change_line

   !> Number of nodes of a line up to the last that is not cavitated.
   pure integer function last_wet(is_cavitated)
      logical, intent(in) :: is_cavitated(:)
      do last_wet = size(is_cavitated), 1, -1
         if (.not. is_cavitated(last_wet)) exit
      end do
   end function last_wet

   !> Right side of the system of one line, which it changes nothing else of. The pressure changes of earlier lines are
   !> taken into account (Gauss-Seidel), their deformation is not.
   subroutine set_right_side(self, line, equations, j, n)
      type(line_relaxation_t), intent(in) :: self
      type(line_system_t), intent(inout) :: line
      type(equations_t), intent(in) :: equations
      integer, intent(in) :: j, n              !! line; its first nodes, the others are cavitated
      integer :: i, jm, jp

      associate (mesh => equations%mesh, change => self%change, by_p => line%by_p)
         jm = mesh%grid%below(j)
         jp = mesh%grid%above(j)
         do i = 1, n
            line%delta(i) = -equations%residual(i, j) - by_p(i, 1)*change(i, j) - by_p(i, 2)*change(i + 1, j) &
                            - by_p(i, 3)*change(i - 1, j) - by_p(i, 4)*change(i, jp) - by_p(i, 5)*change(i, jm)
            if (i > 1) line%delta(i) = line%delta(i) - by_p(i, 6)*change(i - 2, j)
         end do
         do i = 1, n
            if (equations%is_cavitated(i, j)) line%delta(i) = -equations%flow%p(i, j) - change(i, j)
         end do
      end associate
   end subroutine set_right_side

   !> Matrix of the system of one line: changes that make its residuals vanish, the deformation of the line itself
   !> taken into account within reach.
   subroutine set_up_line(self, line, transport, equations, j, n)
      type(line_relaxation_t), intent(in) :: self
      type(line_system_t), intent(inout) :: line
      class(wedge_t), intent(in) :: transport
      type(equations_t), intent(in) :: equations
      integer, intent(in) :: j, n              !! line; its first nodes, the others are cavitated
      integer, parameter :: across = links + 1
      real(dp) :: self_wedge
      integer :: d, first, i, last

      associate (mesh => equations%mesh, flow => equations%flow, by_p => line%by_p, by_h => line%by_h)
         do i = 1, n
            self_wedge = transport%w0(i)*flow%rho(i, j)*equations%self_influence
            line%kind(i) = merge(distributed, single, .not. equations%is_cavitated(i, j) .and. &
               1/equations%scale(i, j) - transport%w0(i)*flow%f_p(i, j) < (1 + self%switch)*self_wedge)
         end do
         call node_links(mesh, transport, flow, [1, n, j, j], by_p, by_h)
         by_h(:n, across) = by_h(:n, 4) + by_h(:n, 5)
         by_p(:n, across) = by_p(:n, 4) + by_p(:n, 5)
         first = 1
         do while (first <= n)      ! runs of columns of one kind
            last = first
            do while (last < n)
               if (line%kind(last + 1) /= line%kind(first)) exit
               last = last + 1
            end do
            do d = -self%reach, self%reach
               call add_column(max(1, first - d), min(n, last - d), d, line%kind(first))
            end do
            first = last + 1
         end do
         do i = 1, n
            if (.not. equations%is_cavitated(i, j)) cycle
            line%band%a(i, :) = 0
            line%band%a(i, 0) = 1
         end do
      end associate

   contains

      subroutine add_column(i1, i2, d, kind)
         integer, intent(in) :: i1, i2, d, kind
         real(dp) :: g(links), s
         integer :: i, link
         do link = 1, links
            g(link) = self%influence(link_i(link) - d, abs(link_j(link)), kind)
         end do
         do i = i1, i2
            line%band%a(i, d) = line%by_h(i, 1)*g(1) + line%by_h(i, 2)*g(2) + line%by_h(i, 3)*g(3) &
               + line%by_h(i, across)*g(4) + line%by_h(i, 6)*g(6)
         end do
         do link = 1, links
            if (link == 5) cycle      ! with 4
            s = self%shape(link_i(link) - d, abs(link_j(link)), kind)
            if (abs(s) > 0) line%band%a(i1:i2, d) = line%band%a(i1:i2, d) &
                                                    + s*line%by_p(i1:i2, merge(across, link, link == 4))
         end do
      end subroutine add_column
   end subroutine set_up_line

end module ehlwave_line_relaxation
