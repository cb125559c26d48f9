!> Reynolds equation linearised about a steady state, for changes that vary as exp(-i w T).
module ehlwave_harmonic_operator
   use ehlwave_grid, only: grid_t
   use ehlwave_kinds, only: dp
   use ehlwave_reynolds, only: flow_t
   implicit none (type, external)
   private
   public :: harmonic_transport, harmonic_jacobian, harmonic_scale

   !> Weights of wedge and squeeze: w0(i) f(i) + w1(i) f(i-1) + w2(i) f(i-2), f the amplitude of rho H.
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

   !> Change of the residual for changes q of pressure and dh of film, as `reynolds_jacobian`.
   pure subroutine harmonic_jacobian(grid, transport, kappa, flow, p, q, dh, dr, work)
      type(grid_t), intent(in) :: grid
      type(harmonic_transport_t), intent(in) :: transport
      real(dp), intent(in) :: kappa
      type(flow_t), intent(in) :: flow              !! at the steady state
      real(dp), intent(in) :: p(0:, 0:)             !! pressure of the steady state
      complex(dp), intent(in) :: q(0:, 0:)          !! change of P, zero on the outer boundary
      complex(dp), intent(in) :: dh(0:, 0:)         !! change of H
      complex(dp), intent(out) :: dr(0:, 0:)        !! change of R, zero off the unknown nodes
      complex(dp), intent(inout) :: work(0:, 0:)    !! (0:nx, 0:ny) scratch: change of eps
      complex(dp) :: df(-1:grid%nx)
      real(dp) :: cx, cy
      integer :: i, j

      cx = 0.5_dp/grid%hx**2
      cy = 0.5_dp*kappa**2/grid%hy**2
      work(:grid%nx, :grid%ny) = flow%eps_p*q(:grid%nx, :grid%ny) + flow%eps_h*dh(:grid%nx, :grid%ny)
      dr(:, 0) = 0
      dr(:, grid%ny) = 0
      df(-1) = 0
      do j = grid%first_row, grid%ny - 1
         do i = 0, grid%nx
            df(i) = flow%f_p(i, j)*q(i, j) + flow%f_h(i, j)*dh(i, j)
         end do
         call row(grid%nx, cx, cy, transport, df, flow%eps(:, grid%below(j)), flow%eps(:, j), flow%eps(:, j + 1), &
                  q(:, grid%below(j)), q(:, j), q(:, j + 1), work(:, grid%below(j)), work(:, j), work(:, j + 1), &
                  p(:, grid%below(j)), p(:, j), p(:, j + 1), dr(:, j))
      end do
   end subroutine harmonic_jacobian

   !> One row: changes q with coefficients e, pressures p with changes d of the coefficients; below, on, above.
   pure subroutine row(nx, cx, cy, transport, df, e_below, e, e_above, q_below, q, q_above, d_below, d, d_above, &
                       p_below, p, p_above, r)
      integer, intent(in) :: nx
      real(dp), intent(in) :: cx, cy
      type(harmonic_transport_t), intent(in) :: transport
      complex(dp), intent(in) :: df(-1:nx)
      real(dp), intent(in), dimension(0:nx) :: e_below, e, e_above, p_below, p, p_above
      complex(dp), intent(in), dimension(0:nx) :: q_below, q, q_above, d_below, d, d_above
      complex(dp), intent(out) :: r(0:nx)
      integer :: i
      r(0) = 0
      r(nx) = 0
      do i = 1, nx - 1
         r(i) = cx*((e(i) + e(i + 1))*(q(i + 1) - q(i)) - (e(i - 1) + e(i))*(q(i) - q(i - 1)) &
                    + (d(i) + d(i + 1))*(p(i + 1) - p(i)) - (d(i - 1) + d(i))*(p(i) - p(i - 1))) &
                + cy*((e(i) + e_above(i))*(q_above(i) - q(i)) - (e_below(i) + e(i))*(q(i) - q_below(i)) &
                      + (d(i) + d_above(i))*(p_above(i) - p(i)) - (d_below(i) + d(i))*(p(i) - p_below(i))) &
                - (transport%w0(i)*df(i) + transport%w1(i)*df(i - 1) + transport%w2(i)*df(i - 2))
      end do
   end subroutine row

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
