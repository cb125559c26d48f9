!> The linear system of a line of nodes along X: changes that make its residuals vanish.
!>
!> It has the band of the line's own flow and deformation. Pressure changes of other lines are on the right side, their
!> deformation is left out. Cavitated nodes have an equation that takes their pressure to zero.
module ehlwave_line_system
   use ehlwave_equations, only: equations_t
   use ehlwave_kinds, only: dp
   use ehlwave_real_band, only: band_t, new_band
   use ehlwave_real_near_rows, only: link_i, link_j, links, node_links
   use ehlwave_real_wedge, only: wedge_t
   use ehlwave_relaxation_change, only: distributed, relaxation_change_t, single
   implicit none (type, external)
   private
   public :: new_line_system

   !> Work space of a thread for one line.
   type, public :: line_system_t
      type(band_t) :: band                                  !! n of it: nodes up to the last that is not cavitated
      real(dp), allocatable :: delta(:)                     !! its right side, then its solution
      real(dp), allocatable, private :: by_p(:, :), by_h(:, :)   ! derivatives, (node, link), an extra column for both
                                                                 ! neighbours across
      integer, allocatable :: kind(:)                       !! kind of the change of each node
   contains
      procedure :: set_up
      procedure :: set_right_side
   end type line_system_t

contains

   !> Work space for lines of n unknown nodes.
   pure function new_line_system(n, reach) result(self)
      integer, intent(in) :: n, reach          !! reach: see `relaxation_change_t`
      type(line_system_t) :: self
      self%band = new_band(n, reach)
      allocate (self%delta(n), self%by_p(n, links + 1), self%by_h(n, links + 1), source=0.0_dp)
      allocate (self%kind(n), source=single)
   end function new_line_system

   !> Matrix of line j and the kinds of its changes, the deformation of the line itself taken into account within reach.
   subroutine set_up(self, change, transport, equations, j, n)
      class(line_system_t), intent(inout) :: self
      type(relaxation_change_t), intent(in) :: change
      class(wedge_t), intent(in) :: transport
      type(equations_t), intent(in) :: equations
      integer, intent(in) :: j, n              !! line; its first nodes, the others are cavitated
      integer, parameter :: across = links + 1
      real(dp) :: self_wedge
      integer :: d, first, i, last

      associate (mesh => equations%mesh, flow => equations%flow, by_p => self%by_p, by_h => self%by_h)
         do i = 1, n
            self_wedge = transport%w0(i)*flow%rho(i, j)*equations%self_influence
            self%kind(i) = merge(distributed, single, .not. equations%is_cavitated(i, j) .and. &
               1/equations%scale(i, j) - transport%w0(i)*flow%f_p(i, j) < (1 + change%switch)*self_wedge)
         end do
         call node_links(mesh, transport, flow, [1, n, j, j], by_p, by_h)
         by_h(:n, across) = by_h(:n, 4) + by_h(:n, 5)
         by_p(:n, across) = by_p(:n, 4) + by_p(:n, 5)
         first = 1
         do while (first <= n)      ! runs of columns of a kind
            last = first
            do while (last < n)
               if (self%kind(last + 1) /= self%kind(first)) exit
               last = last + 1
            end do
            do d = -change%reach, change%reach
               call add_column(max(1, first - d), min(n, last - d), d, self%kind(first))
            end do
            first = last + 1
         end do
         do i = 1, n
            if (.not. equations%is_cavitated(i, j)) cycle
            self%band%a(i, :) = 0
            self%band%a(i, 0) = 1
         end do
      end associate

   contains

      subroutine add_column(i1, i2, d, kind)
         integer, intent(in) :: i1, i2, d, kind
         real(dp) :: g(links), s
         integer :: i, link
         do link = 1, links
            g(link) = change%influence(link_i(link) - d, abs(link_j(link)), kind)
         end do
         do i = i1, i2
            self%band%a(i, d) = self%by_h(i, 1)*g(1) + self%by_h(i, 2)*g(2) + self%by_h(i, 3)*g(3) &
               + self%by_h(i, across)*g(4) + self%by_h(i, 6)*g(6)
         end do
         do link = 1, links
            if (link == 5) cycle      ! with 4
            s = change%shape(link_i(link) - d, abs(link_j(link)), kind)
            if (abs(s) > 0) self%band%a(i1:i2, d) = self%band%a(i1:i2, d) &
                                                    + s*self%by_p(i1:i2, merge(across, link, link == 4))
         end do
      end subroutine add_column
   end subroutine set_up

   !> Right side of line j, which it changes nothing else of. After `set_up`. The pressure changes of earlier lines are
   !> taken into account (Gauss-Seidel), their deformation is not.
   subroutine set_right_side(self, equations, change, j, n)
      class(line_system_t), intent(inout) :: self
      type(equations_t), intent(in) :: equations
      real(dp), intent(in), contiguous :: change(0:, 0:)   !! change of P in this sweep, (0:nx, 0:ny)
      integer, intent(in) :: j, n              !! line; its first nodes, the others are cavitated
      integer :: i, jm, jp

      associate (mesh => equations%mesh, by_p => self%by_p)
         jm = mesh%grid%below(j)
         jp = mesh%grid%above(j)
         do i = 1, n
            self%delta(i) = -equations%residual(i, j) - by_p(i, 1)*change(i, j) - by_p(i, 2)*change(i + 1, j) &
                            - by_p(i, 3)*change(i - 1, j) - by_p(i, 4)*change(i, jp) - by_p(i, 5)*change(i, jm)
            if (i > 1) self%delta(i) = self%delta(i) - by_p(i, 6)*change(i - 2, j)
         end do
         do i = 1, n
            if (equations%is_cavitated(i, j)) self%delta(i) = -equations%flow%p(i, j) - change(i, j)
         end do
      end associate
   end subroutine set_right_side

end module ehlwave_line_system
