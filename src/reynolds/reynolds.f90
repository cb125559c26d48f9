!> Discrete Reynolds equation: residual, Jacobian product and the coefficients of both.
module ehlwave_reynolds
   use ehlwave_grid, only: grid_t
   use ehlwave_kinds, only: dp
   use ehlwave_rheology, only: rheology_t
   use ehlwave_transfer, only: inject
   use ehlwave_transport, only: transport_t
   implicit none (type, external)
   private
   public :: new_flow, reynolds_residual, reynolds_jacobian, diagonal_scale

   !> Coefficients of the flow at a state, and their derivatives. All arrays (0:nx, 0:ny).
   type, public :: flow_t
      real(dp), allocatable :: f(:, :)      !! rho H
      real(dp), allocatable :: eps(:, :)    !! rho H^3/(eta lambdabar)
      real(dp), allocatable :: f_p(:, :)    !! d(rho H)/dP at fixed H
      real(dp), allocatable :: f_h(:, :)    !! d(rho H)/dH = rho
      real(dp), allocatable :: eps_p(:, :)  !! d eps/dP at fixed H
      real(dp), allocatable :: eps_h(:, :)  !! d eps/dH
      real(dp), allocatable, private :: fluidity(:, :), dln_eta(:, :)
   contains
      procedure :: evaluate
      procedure :: inject_from
   end type flow_t

contains

   !> Work space for a grid.
   pure function new_flow(grid) result(self)
      type(grid_t), intent(in) :: grid
      type(flow_t) :: self
      real(dp), allocatable :: zero(:, :)
      allocate (zero(0:grid%nx, 0:grid%ny), source=0.0_dp)
      self%f = zero
      self%eps = zero
      self%f_p = zero
      self%f_h = zero
      self%eps_p = zero
      self%eps_h = zero
      self%fluidity = zero
      self%dln_eta = zero
   end function new_flow

   !> Coefficients of the next finer grid, at the nodes of this one.
   pure subroutine inject_from(self, fine, coarse)
      class(flow_t), intent(inout) :: self
      type(flow_t), intent(in) :: fine
      type(grid_t), intent(in) :: coarse   !! this grid
      call inject(coarse, fine%f, self%f)
      call inject(coarse, fine%eps, self%eps)
      call inject(coarse, fine%f_p, self%f_p)
      call inject(coarse, fine%f_h, self%f_h)
      call inject(coarse, fine%eps_p, self%eps_p)
      call inject(coarse, fine%eps_h, self%eps_h)
   end subroutine inject_from

   !> Coefficients at pressure p and film h.
   pure subroutine evaluate(self, rheology, lambdabar, p, h)
      class(flow_t), intent(inout) :: self
      type(rheology_t), intent(in) :: rheology
      real(dp), intent(in) :: lambdabar             !! dimensionless speed parameter
      real(dp), intent(in), contiguous :: p(0:, 0:)   !! P, (0:nx, 0:ny)
      real(dp), intent(in), contiguous :: h(0:, 0:)   !! H > 0, (0:nx, 0:ny)
      integer :: i, j
      real(dp) :: rho, drho

      call rheology%evaluate(size(p), p, self%f_h, self%f_p, self%fluidity, self%dln_eta)
      do j = 0, ubound(p, 2)
         do i = 0, ubound(p, 1)
            rho = self%f_h(i, j)
            drho = self%f_p(i, j)
            self%f(i, j) = rho*h(i, j)
            self%f_p(i, j) = drho*h(i, j)
            self%eps(i, j) = rho*h(i, j)**3*self%fluidity(i, j)/lambdabar
            self%eps_p(i, j) = self%eps(i, j)*(drho/rho - self%dln_eta(i, j))
            self%eps_h(i, j) = 3*self%eps(i, j)/h(i, j)
         end do
      end do
   end subroutine evaluate

   !> Residual of theory eq. (7), eps averaged between nodes:
   !>
   !>     R = [eps_(i+1/2) (P_(i+1) - P_i) - eps_(i-1/2) (P_i - P_(i-1))]/hX^2 + kappa^2 (same in Y)/hY^2
   !>         - wedge and squeeze of `transport`
   !>
   !> at unknown nodes, zero elsewhere. R = 0 where P > 0; R <= 0 where the film is cavitated.
   pure subroutine reynolds_residual(grid, transport, kappa, flow, p, r)
      type(grid_t), intent(in) :: grid
      type(transport_t), intent(in) :: transport
      real(dp), intent(in) :: kappa
      type(flow_t), intent(in) :: flow        !! evaluated at p and its film
      real(dp), intent(in) :: p(0:, 0:)       !! P, (0:nx, 0:ny)
      real(dp), intent(out) :: r(0:, 0:)      !! R, (0:nx, 0:ny)
      real(dp) :: cx, cy
      integer :: i, j, jm, nx

      nx = grid%nx
      cx = 0.5_dp/grid%hx**2
      cy = 0.5_dp*kappa**2/grid%hy**2
      r = 0
      do j = grid%first_row, grid%ny - 1
         jm = grid%below(j)
         call poiseuille_row(nx, cx, cy, flow%eps(:, jm), flow%eps(:, j), flow%eps(:, j + 1), &
                             p(:, jm), p(:, j), p(:, j + 1), r(:, j))
         call transport_row(nx, transport, flow%f(:, j), r(:, j))
         if (allocated(transport%carried)) then
            do i = 1, nx - 1
               r(i, j) = r(i, j) - transport%carried(i, j)
            end do
         end if
      end do
   end subroutine reynolds_residual

   !> Jacobian product: change of R for changes dp of pressure and dh of film.
   pure subroutine reynolds_jacobian(grid, transport, kappa, flow, p, dp_, dh, dr, work)
      type(grid_t), intent(in) :: grid
      type(transport_t), intent(in) :: transport
      real(dp), intent(in) :: kappa
      type(flow_t), intent(in) :: flow        !! evaluated at the point of linearisation
      real(dp), intent(in) :: p(0:, 0:)       !! P of the point of linearisation
      real(dp), intent(in) :: dp_(0:, 0:)     !! change of P, zero on the outer boundary
      real(dp), intent(in) :: dh(0:, 0:)      !! change of H
      real(dp), intent(out) :: dr(0:, 0:)     !! change of R, zero off the unknown nodes
      real(dp), intent(inout) :: work(0:, 0:) !! (0:nx, 0:ny) scratch: change of eps
      real(dp) :: cx, cy, df(0:grid%nx)
      integer :: i, j, jm, nx

      nx = grid%nx
      cx = 0.5_dp/grid%hx**2
      cy = 0.5_dp*kappa**2/grid%hy**2
      do j = 0, grid%ny
         do i = 0, nx
            work(i, j) = flow%eps_p(i, j)*dp_(i, j) + flow%eps_h(i, j)*dh(i, j)
         end do
      end do
      dr = 0
      do j = grid%first_row, grid%ny - 1
         jm = grid%below(j)
         call poiseuille_row(nx, cx, cy, flow%eps(:, jm), flow%eps(:, j), flow%eps(:, j + 1), &
                             dp_(:, jm), dp_(:, j), dp_(:, j + 1), dr(:, j))
         call poiseuille_row(nx, cx, cy, work(:, jm), work(:, j), work(:, j + 1), &
                             p(:, jm), p(:, j), p(:, j + 1), dr(:, j))
         do i = 0, nx
            df(i) = flow%f_p(i, j)*dp_(i, j) + flow%f_h(i, j)*dh(i, j)
         end do
         call transport_row(nx, transport, df, dr(:, j))
      end do
   end subroutine reynolds_jacobian

   !> r += Poiseuille terms of one row with node coefficients e and pressures q below, on and above it.
   pure subroutine poiseuille_row(nx, cx, cy, e_below, e, e_above, q_below, q, q_above, r)
      integer, intent(in) :: nx
      real(dp), intent(in) :: cx, cy
      real(dp), intent(in), dimension(0:nx) :: e_below, e, e_above, q_below, q, q_above
      real(dp), intent(inout) :: r(0:nx)
      integer :: i
      do i = 1, nx - 1
         r(i) = r(i) + cx*((e(i) + e(i + 1))*(q(i + 1) - q(i)) - (e(i - 1) + e(i))*(q(i) - q(i - 1))) &
                + cy*((e(i) + e_above(i))*(q_above(i) - q(i)) - (e_below(i) + e(i))*(q(i) - q_below(i)))
      end do
   end subroutine poiseuille_row

   !> r -= w0 f(i) + w1 f(i-1) + w2 f(i-2) on one row.
   pure subroutine transport_row(nx, transport, f, r)
      integer, intent(in) :: nx
      type(transport_t), intent(in) :: transport
      real(dp), intent(in) :: f(0:nx)
      real(dp), intent(inout) :: r(0:nx)
      integer :: i
      if (transport%is_local) then
         do i = 1, nx - 1
            r(i) = r(i) - transport%w0(i)*f(i)
         end do
      else
         r(1) = r(1) - transport%w0(1)*f(1) - transport%w1(1)*f(0)
         do i = 2, nx - 1
            r(i) = r(i) - transport%w0(i)*f(i) - transport%w1(i)*f(i - 1) - transport%w2(i)*f(i - 2)
         end do
      end if
   end subroutine transport_row

   !> 1/|A_ii|: how much pressure one unit of residual is worth at each unknown node, from the Poiseuille
   !> terms and the effect of the node's own deformation on the wedge term. Zero elsewhere.
   pure subroutine diagonal_scale(grid, transport, kappa, self_influence, flow, scale)
      type(grid_t), intent(in) :: grid
      type(transport_t), intent(in) :: transport
      real(dp), intent(in) :: kappa
      real(dp), intent(in) :: self_influence   !! deformation at a node under its own unit pressure
      type(flow_t), intent(in) :: flow
      real(dp), intent(out) :: scale(0:, 0:)   !! (0:nx, 0:ny)
      real(dp) :: cx, cy
      integer :: i, j, jm

      cx = 0.5_dp/grid%hx**2
      cy = 0.5_dp*kappa**2/grid%hy**2
      scale = 0
      do j = grid%first_row, grid%ny - 1
         jm = grid%below(j)
         do i = 1, grid%nx - 1
            scale(i, j) = 1/(cx*(flow%eps(i - 1, j) + 2*flow%eps(i, j) + flow%eps(i + 1, j)) &
                             + cy*(flow%eps(i, jm) + 2*flow%eps(i, j) + flow%eps(i, j + 1)) &
                             + transport%w0(i)*(flow%f_h(i, j)*self_influence + flow%f_p(i, j)))
         end do
      end do
   end subroutine diagonal_scale

end module ehlwave_reynolds
