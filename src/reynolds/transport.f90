!> Wedge and squeeze terms d(rho H)/dX + d(rho H)/dT, of second or, on fitted grids, third order, in the same form for
!> steady, transient and harmonic.
!>
!> At node i the sum of both terms is discretised as, theory eq. (D8),
!>
!>     w0(i) f(i) + w1(i) f(i-1) + w2(i) f(i-2) + w3(i) f(i-3) + carried(i),      f = rho H at the present time,
!>
!> where `carried` holds the known values of earlier times.
module ehlwave_transport
   use ehlwave_assertions, only: assert, checks
   use ehlwave_complex_wedge, only: complex_wedge_t => wedge_t, new_complex_wedge => new_wedge
   use ehlwave_grid, only: grid_t
   use ehlwave_kinds, only: dp
   use ehlwave_real_wedge, only: fold, new_wedge, wedge_t
   use ehlwave_threads, only: is_shared
   implicit none (type, external)
   private
   public :: steady_transport, characteristic_transport, harmonic_wedge, implicit_part

   !> Backward difference of third order: of f, f one, two and three steps before.
   real(dp), parameter :: third_order(0:3) = [11/6.0_dp, -3.0_dp, 1.5_dp, -1/3.0_dp]
   real(dp), parameter, public :: no_film = -1   !! in place of rho H where a node was not full

   type, extends(wedge_t), public :: transport_t
      real(dp), allocatable :: carried(:, :)         !! (0:nx, 0:ny), allocated in transient problems only
      integer :: cells_per_step = 1                  !! dT = hX cells_per_step / steps_per_cell,
      integer :: steps_per_cell = 1                  !! at least one of the two is 1
      integer :: order = 2  !! order of the difference along the characteristic, 3 of a fitted grid
      ! For gaps that are not full everywhere, in transient problems: outflow of the node upstream at the earlier
      ! time, and rho H there where it was full, else `no_film`
      real(dp), allocatable :: inflow(:, :), partner(:, :)
   contains
      procedure :: carry_content
      procedure :: carry
      procedure :: carry_row
      procedure :: carry_row_transposed
      procedure :: history_length
   end type transport_t

contains

   !> Steady state: second-order upstream difference, theory eq. (D2); first order at the first interior node. Of a
   !> fitted grid third order from the third on, theory eq. (D12).
   pure function steady_transport(grid) result(self)
      type(grid_t), intent(in) :: grid
      type(transport_t) :: self
      self%wedge_t = new_wedge(grid%nx)
      self%w0 = 1.5_dp/grid%hx
      self%w1 = -2/grid%hx
      self%w2 = 0.5_dp/grid%hx
      self%w0(1) = 1/grid%hx
      self%w1(1) = -1/grid%hx
      self%w2(1) = 0
      if (grid%is_fitted) call self%raise_order(third_order/grid%hx)
   end function steady_transport

   !> Transient: second-order backward difference along the characteristic X - T = const, with the idea
   !> of the narrow upstream scheme NU2 (Venner and others 1999), theory eq. (D5): with dT = hX
   !>
   !>     (1.5 f(i,k) - 2 f(i-1,k-1) + 0.5 f(i-2,k-2))/hX,
   !>
   !> free of numerical damping and dispersion for transported quantities. With dT = m hX the step along the
   !> characteristic is dT (and m cells), with dT = hX/m it is hX (and m steps). Nodes nearer to the inlet than two
   !> such steps: first order along the characteristic at node m when m = 1, else upstream in X and backward in T
   !> separately, second order.
   !>
   !> On a fitted grid the difference along the characteristic has third order where three steps lie upstream, theory
   !> eq. (D12).
   pure function characteristic_transport(grid, cells_per_step, steps_per_cell) result(self)
      type(grid_t), intent(in) :: grid
      integer, intent(in) :: cells_per_step   !! m for dT = m hX
      integer, intent(in) :: steps_per_cell   !! m for dT = hX/m
      type(transport_t) :: self
      real(dp) :: dt
      integer :: i

      if (checks) call assert(min(cells_per_step, steps_per_cell) == 1, &
                              'characteristic_transport: cells_per_step or steps_per_cell is 1')
      self%wedge_t = new_wedge(grid%nx)
      self%cells_per_step = cells_per_step
      self%steps_per_cell = steps_per_cell
      dt = grid%hx*cells_per_step/steps_per_cell
      self%w0 = 1.5_dp/(grid%hx*cells_per_step)
      self%w1 = 0
      self%w2 = 0
      self%is_local = cells_per_step == 1
      if (self%is_local) then
         self%w0(1) = 1/grid%hx
      else
         do i = 1, min(2*cells_per_step - 1, grid%nx)
            self%w0(i) = 1.5_dp/dt + merge(1.0_dp, 1.5_dp, i == 1)/grid%hx
            self%w1(i) = merge(-1.0_dp, -2.0_dp, i == 1)/grid%hx
            self%w2(i) = merge(0.0_dp, 0.5_dp, i == 1)/grid%hx
         end do
      end if
      if (grid%is_fitted) then
         self%order = 3
         self%w0(3*cells_per_step:) = third_order(0)/(grid%hx*cells_per_step)
      end if
      allocate (self%carried(0:grid%nx, 0:grid%ny), source=0.0_dp)
   end function characteristic_transport

   !> Weights for an amplitude f that varies as exp(-i w T): exact linearisation of the transient operator along the
   !> characteristic (`characteristic_transport` with a step of one mesh size), where f(i-l) at T - l dT becomes
   !> z^l f(i-l), z = exp(i w dT), theory eq. (D6):
   !>
   !>     (1.5 f(i) - 2 z f(i-1) + 0.5 z^2 f(i-2))/dT,    at i = 1    (f(1) - z f(0))/dT.
   !>
   !> It is written as  t0 f + t1 f' + t2 f''  with upstream differences for f' and f'' on the grid at hand. With
   !> hX = dT this is the operator itself. A coarser grid keeps the factors of the fine grid, also where its mesh is
   !> too wide for the wave: it carries smooth corrections.
   pure function harmonic_wedge(grid, frequency, dt) result(self)
      type(grid_t), intent(in) :: grid
      real(dp), intent(in) :: frequency   !! w in units of 1/T
      real(dp), intent(in) :: dt          !! time step: hX of the finest grid
      type(complex_wedge_t) :: self
      complex(dp) :: t0, t1, t2, z

      z = exp(cmplx(0, frequency*dt, dp))
      t0 = (1.5_dp - 2*z + 0.5_dp*z**2)/dt
      t1 = 2*z - z**2
      t2 = dt*(z**2 - z)
      self = new_complex_wedge(grid%nx)
      associate (h => grid%hx)
         self%w0 = t0 + 1.5_dp*t1/h + t2/h**2
         self%w1 = -2*t1/h - 2*t2/h**2
         self%w2 = 0.5_dp*t1/h + t2/h**2
         self%w0(:1) = (1 - z)/dt + z/h
         self%w1(:1) = -z/h
         self%w2(:1) = 0
      end associate
      if (grid%is_fitted) call self%raise_order(harmonic_weights(grid%hx, z, dt))
   end function harmonic_wedge

   !> Weights of third order of f(i) to f(i-3): t0 f + t1 f' + t2 f'' + t3 f''' with the differences of the cubic
   !> through the four nodes.
   pure function harmonic_weights(h, z, dt) result(weight)
      real(dp), intent(in) :: h           !! mesh size in X of the grid at hand
      complex(dp), intent(in) :: z        !! exp(i w dT)
      real(dp), intent(in) :: dt
      ! differences of order 0 to 3, by nodes i, i-1, i-2, i-3, with a mesh size of 1
      real(dp), parameter :: difference(0:3, 0:3) = reshape([1.0_dp, 0.0_dp, 0.0_dp, 0.0_dp, third_order, &
         2.0_dp, -5.0_dp, 4.0_dp, -1.0_dp, 1.0_dp, -3.0_dp, 3.0_dp, -1.0_dp], [4, 4])
      complex(dp) :: t(0:3), weight(0:3)
      integer :: l

      t = 0
      do l = 0, 3         ! f(i-l) = f - l dT f' + (l dT)^2/2 f'' - (l dT)^3/6 f'''
         t = t + third_order(l)*z**l/dt*[1.0_dp, -l*dt, (l*dt)**2/2, -(l*dt)**3/6]
      end do
      weight = matmul(difference, t/h**[0, 1, 2, 3])
   end function harmonic_weights

   !> The terms at the present time, on the same grid or with half as many cells, for a Jacobian. Terms that look
   !> upstream in X follow the mesh size; terms along the characteristic do not.
   pure function implicit_part(transport, grid) result(self)
      class(wedge_t), intent(in) :: transport
      type(grid_t), intent(in) :: grid            !! grid of the result
      type(wedge_t) :: self
      integer :: ratio

      ratio = ubound(transport%w0, 1)/grid%nx
      self = new_wedge(grid%nx)
      self%is_local = transport%is_local
      self%w0 = transport%w0(::ratio)
      self%w1 = transport%w1(::ratio)
      self%w2 = transport%w2(::ratio)
      if (allocated(transport%w3)) allocate (self%w3(0:grid%nx), source=transport%w3(::ratio))
      if (ratio > 1 .and. .not. transport%is_local) self = scaled_upstream(self, ratio)
      if (ratio > 1 .and. transport%is_local) self%w0(1) = self%w0(min(2, grid%nx))
   end function implicit_part

   !> Upstream differences for a mesh `ratio` times as wide; other terms stay.
   pure function scaled_upstream(transport, ratio) result(self)
      type(wedge_t), intent(in) :: transport
      integer, intent(in) :: ratio
      type(wedge_t) :: self
      real(dp) :: still(0:ubound(transport%w0, 1))
      self = transport
      still = transport%w0 + transport%w1 + transport%w2   ! an upstream difference sums to zero
      if (allocated(transport%w3)) still = still + transport%w3
      self%w0 = still + (transport%w0 - still)/ratio
      self%w1 = transport%w1/ratio
      self%w2 = transport%w2/ratio
      if (allocated(transport%w3)) then
         self%w3 = transport%w3/ratio
         call fold(self%w0(:2), self%w1(:2), self%w2(:2), self%w3(:2))   ! f(i-3) is outside
         self%w3(:2) = 0
      end if
      self%w0(1) = still(1) - self%w1(1) - self%w2(1)
      self%w1(1) = self%w1(1) + self%w2(1)
      self%w2(1) = 0
      self%w0(1) = still(1) - self%w1(1)
   end function scaled_upstream

   !> How many earlier times are needed: f at T - dT, T - 2 dT, ...
   pure integer function history_length(self)
      class(transport_t), intent(in) :: self
      history_length = self%order*self%steps_per_cell
   end function history_length

   !> Set `carried` from the values f = rho H of earlier times.
   subroutine carry(self, grid, history)
      class(transport_t), intent(inout) :: self
      type(grid_t), intent(in) :: grid
      real(dp), intent(in) :: history(0:, 0:, :)   !! (0:nx, 0:ny, n): f at T - n dT
      integer :: j
      if (checks) call assert(all(shape(history) == [grid%nx + 1, grid%ny + 1, self%history_length()]), &
                              'carry: as many earlier times as the scheme takes, on the grid')
      !$omp parallel do schedule(static) if (is_shared(size(self%carried)))
      do j = 0, grid%ny
         call self%carry_row(grid, j, history(:, j, :))
      end do
   end subroutine carry

   !> Weights of transport in a gap that is not full everywhere. `history` has the outflows at T - n dT for n = 1 to
   !> `steps_per_cell`, then rho H of full nodes, see `ehlwave_oil_content`.
   pure subroutine carry_content(self, grid, history)
      class(transport_t), intent(inout) :: self
      type(grid_t), intent(in) :: grid
      real(dp), intent(in) :: history(0:, 0:, :)   !! (0:nx, 0:ny, 2 steps_per_cell)
      integer :: s

      s = self%steps_per_cell
      if (.not. allocated(self%inflow)) &
         allocate (self%inflow(0:grid%nx, 0:grid%ny), self%partner(0:grid%nx, 0:grid%ny), source=0.0_dp)
      self%inflow(1:, :) = history(:grid%nx - 1, :, s)
      self%partner(1:, :) = history(:grid%nx - 1, :, 2*s)
   end subroutine carry_content

   !> Carry the content of one row.
   pure subroutine carry_row(self, grid, j, history)
      class(transport_t), intent(inout) :: self
      type(grid_t), intent(in) :: grid
      integer, intent(in) :: j                     !! row
      real(dp), intent(in) :: history(0:, :)       !! (0:nx, n): f there at T - n dT
      real(dp) :: dt
      integer :: i, m, s

      m = self%cells_per_step
      s = self%steps_per_cell
      dt = grid%hx*m/s
      if (self%is_local) then
         self%carried(1, j) = -history(0, s)/grid%hx
         do i = 2, grid%nx
            self%carried(i, j) = (-2*history(i - 1, s) + 0.5_dp*history(i - 2, 2*s))/grid%hx
         end do
      else
         do i = 1, min(2*m - 1, grid%nx)
            self%carried(i, j) = (-2*history(i, 1) + 0.5_dp*history(i, 2))/dt
         end do
         do i = 2*m, grid%nx
            self%carried(i, j) = (-2*history(i - m, 1) + 0.5_dp*history(i - 2*m, 2))/dt
         end do
      end if
      if (self%order < 3) return
      do i = 3*m, grid%nx
         self%carried(i, j) = (third_order(1)*history(i - m, s) + third_order(2)*history(i - 2*m, 2*s) &
                               + third_order(3)*history(i - 3*m, 3*s))/(grid%hx*m)
      end do
   end subroutine carry_row

   !> Transposed `carry_row`: add the weights of f at T - n dT for weights r of `carried`.
   pure subroutine carry_row_transposed(self, grid, n, r, f)
      class(transport_t), intent(in) :: self
      type(grid_t), intent(in) :: grid
      integer, intent(in) :: n
      real(dp), intent(in) :: r(0:)                !! (0:nx)
      real(dp), intent(inout) :: f(0:)             !! (0:nx)
      real(dp) :: weight
      integer :: i, l, last, m, shift

      m = self%cells_per_step
      if (modulo(n, self%steps_per_cell) /= 0) return
      l = n/self%steps_per_cell
      last = merge(min(3*m - 1, grid%nx), grid%nx, self%order == 3)
      do i = 1, grid%nx
         if (i > last) then
            weight = third_order(l)/(grid%hx*m)
            shift = l*m
         else if (l > 2 .or. (self%is_local .and. i < l)) then
            cycle
         else if (self%is_local .and. i == 1) then
            weight = -1/grid%hx
            shift = 1
         else
            weight = merge(-2.0_dp, 0.5_dp, l == 1)/(grid%hx*m)
            shift = merge(l*m, 0, i >= 2*m)
         end if
         f(i - shift) = f(i - shift) + weight*r(i)
      end do
   end subroutine carry_row_transposed

end module ehlwave_transport
