!> Reynolds equation linearised about a steady state, for changes that vary as exp(-i w T).
module ehlwave_harmonic_operator
   use ehlwave_grid, only: grid_t
   use ehlwave_kinds, only: dp
   use ehlwave_reynolds, only: flow_t
   implicit none (type, external)
   private
   public :: harmonic_transport, harmonic_jacobian, harmonic_scale

   !> Weights of wedge and squeeze: w0(i) f(i) + w1(i) f(i-1) + w2(i) f(i-2), f the amplitude of rho H; the same at all
   !> nodes from 2 on.
   type, public :: harmonic_transport_t
      complex(dp), allocatable :: w0(:), w1(:), w2(:)    !! (0:nx)
   end type harmonic_transport_t

contains

   !> Exact linearisation of the transient operator along the characteristic (`characteristic_transport` with a
   !> step of one mesh size), where f(i-l) at T - l dT becomes z^l f(i-l), z = exp(i w dT):
   !>
   !>     (1.5 f(i) - 2 z f(i-1) + 0.5 z^2 f(i-2))/dT,    at i = 1    (f(1) - z f(0))/dT.
   !>
   !> It is written as  t0 f + t1 f' + t2 f''  with upstream differences for f' and f'' on the grid at hand. With
   !> hX = dT that is the operator itself; on a coarser grid it keeps the factors of the fine one, also where the
   !> coarse mesh is too wide for the wave: what it has to carry there is smooth.
   pure function harmonic_transport(grid, frequency, dt) result(self)
      type(grid_t), intent(in) :: grid
      real(dp), intent(in) :: frequency   !! w in units of 1/T
      real(dp), intent(in) :: dt          !! time step: hX of the finest grid
      type(harmonic_transport_t) :: self
      complex(dp) :: t0, t1, t2, z

      z = exp(cmplx(0, frequency*dt, dp))
      t0 = (1.5_dp - 2*z + 0.5_dp*z**2)/dt
      t1 = 2*z - z**2
      t2 = dt*(z**2 - z)
      allocate (self%w0(0:grid%nx), self%w1(0:grid%nx), self%w2(0:grid%nx))
      associate (h => grid%hx)
         self%w0 = t0 + 1.5_dp*t1/h + t2/h**2
         self%w1 = -2*t1/h - 2*t2/h**2
         self%w2 = 0.5_dp*t1/h + t2/h**2
         self%w0(:1) = (1 - z)/dt + z/h
         self%w1(:1) = -z/h
         self%w2(:1) = 0
      end associate
   end function harmonic_transport

   !> Change of the residual for changes q of pressure and dh of film, as `reynolds_jacobian`: differences of the changes
   !> of the flows between nodes, each of which is computed once.
   pure subroutine harmonic_jacobian(grid, transport, kappa, flow, p, q, dh, dr)
      type(grid_t), intent(in) :: grid
      type(harmonic_transport_t), intent(in) :: transport
      real(dp), intent(in) :: kappa
      type(flow_t), intent(in) :: flow              !! at the steady state
      real(dp), intent(in) :: p(0:, 0:)             !! pressure of the steady state
      complex(dp), intent(in) :: q(0:, 0:)          !! change of P, zero on the outer boundary
      complex(dp), intent(in) :: dh(0:, 0:)         !! change of H
      complex(dp), intent(out) :: dr(0:, 0:)        !! change of R, zero off the unknown nodes
      complex(dp), dimension(0:grid%nx) :: below, d, d_above, df, flux
      real(dp) :: cx, cy
      integer :: i, j, nx

      nx = grid%nx
      cx = 0.5_dp/grid%hx**2
      cy = 0.5_dp*kappa**2/grid%hy**2
      dr(:, 0) = 0
      dr(:, grid%ny) = 0
      call change(nx, flow%eps_p(:, 0), q(:, 0), flow%eps_h(:, 0), dh(:, 0), d)
      if (grid%is_half) then                        ! the flow across row 0 from below mirrors that above it
         call change(nx, flow%eps_p(:, 1), q(:, 1), flow%eps_h(:, 1), dh(:, 1), d_above)
         call flow_between(nx, -cy, flow%eps(:, 0), flow%eps(:, 1), q(:, 0), q(:, 1), d, d_above, p(:, 0), p(:, 1), below)
      else
         call change(nx, flow%eps_p(:, 1), q(:, 1), flow%eps_h(:, 1), dh(:, 1), d_above)
         call flow_between(nx, cy, flow%eps(:, 0), flow%eps(:, 1), q(:, 0), q(:, 1), d, d_above, p(:, 0), p(:, 1), below)
         d = d_above
      end if
      do j = grid%first_row, grid%ny - 1
         call change(nx, flow%eps_p(:, j + 1), q(:, j + 1), flow%eps_h(:, j + 1), dh(:, j + 1), d_above)
         call change(nx, flow%f_p(:, j), q(:, j), flow%f_h(:, j), dh(:, j), df)
         call flow_between(nx - 1, cx, flow%eps(:nx - 1, j), flow%eps(1:, j), q(:nx - 1, j), q(1:, j), d(:nx - 1), d(1:), &
                           p(:nx - 1, j), p(1:, j), flux(:nx - 1))
         dr(0, j) = 0
         dr(nx, j) = 0
         do i = 1, nx - 1
            dr(i, j) = flux(i) - flux(i - 1) - below(i)
         end do
         call flow_between(nx, cy, flow%eps(:, j), flow%eps(:, j + 1), q(:, j), q(:, j + 1), d, d_above, &
                           p(:, j), p(:, j + 1), below)
         dr(1, j) = dr(1, j) + below(1) - transport%w0(1)*df(1) - transport%w1(1)*df(0)
         do i = 2, nx - 1
            dr(i, j) = dr(i, j) + below(i) - (transport%w0(2)*df(i) + transport%w1(2)*df(i - 1) + transport%w2(2)*df(i - 2))
         end do
         d = d_above
      end do
   end subroutine harmonic_jacobian

   !> d = a q + b h.
   pure subroutine change(nx, a, q, b, h, d)
      integer, intent(in) :: nx
      real(dp), intent(in) :: a(0:nx), b(0:nx)
      complex(dp), intent(in) :: q(0:nx), h(0:nx)
      complex(dp), intent(out) :: d(0:nx)
      integer :: i
      do i = 0, nx
         d(i) = a(i)*q(i) + b(i)*h(i)
      end do
   end subroutine change

   !> Changes of the flows from nodes 1 to nodes 2, times c: (e1 + e2)(q2 - q1) + (d1 + d2)(p2 - p1).
   pure subroutine flow_between(n, c, e1, e2, q1, q2, d1, d2, p1, p2, flux)
      integer, intent(in) :: n
      real(dp), intent(in) :: c
      real(dp), intent(in), dimension(0:n) :: e1, e2, p1, p2
      complex(dp), intent(in), dimension(0:n) :: q1, q2, d1, d2
      complex(dp), intent(out) :: flux(0:n)
      integer :: i
      do i = 0, n
         flux(i) = (c*(e1(i) + e2(i)))*(q2(i) - q1(i)) + (c*(p2(i) - p1(i)))*(d1(i) + d2(i))
      end do
   end subroutine flow_between

   !> 1/|A_ii| as `diagonal_scale`, zero off the unknown nodes.
   pure subroutine harmonic_scale(grid, transport, kappa, self_influence, flow, scale)
      type(grid_t), intent(in) :: grid
      type(harmonic_transport_t), intent(in) :: transport
      real(dp), intent(in) :: kappa, self_influence
      type(flow_t), intent(in) :: flow
      real(dp), intent(out) :: scale(0:, 0:)   !! (0:nx, 0:ny)
      real(dp) :: cx, cy
      integer :: i, j

      cx = 0.5_dp/grid%hx**2
      cy = 0.5_dp*kappa**2/grid%hy**2
      scale = 0
      do j = grid%first_row, grid%ny - 1
         do i = 1, grid%nx - 1
            scale(i, j) = 1/(cx*(flow%eps(i - 1, j) + 2*flow%eps(i, j) + flow%eps(i + 1, j)) &
                             + cy*(flow%eps(i, grid%below(j)) + 2*flow%eps(i, j) + flow%eps(i, j + 1)) &
                             + abs(transport%w0(i))*(flow%f_h(i, j)*self_influence + flow%f_p(i, j)))
         end do
      end do
   end subroutine harmonic_scale

end module ehlwave_harmonic_operator
