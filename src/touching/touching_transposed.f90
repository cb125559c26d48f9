!> The transposed linear system of a steady state whose surfaces may touch: derivatives of results by residuals.
!>
!> Each procedure runs the steps of its counterpart in `touching_system` backwards, each step transposed. At flooded
!> edges the pressure is an unknown here, with the equation P = P_far(H): Newton's method takes it from the step before.
!> Products are in double precision.
module ehlwave_touching_transposed
   use ehlwave_edge_values, only: edge_values_t
   use ehlwave_given, only: given_t
   use ehlwave_kinds, only: dp
   use ehlwave_load_balance, only: load_factor
   use ehlwave_touching_oil_links, only: subtract_links_transposed
   use ehlwave_touching_state, only: touching_state_t
   use ehlwave_touching_system, only: touching_system_t
   use ehlwave_work_unit, only: real_weights
   implicit none (type, external)
   private

   type, extends(touching_system_t), public :: touching_transposed_t
      integer, allocatable :: edge(:, :)                      !! (2, nodes of flooded edges)
      real(dp), allocatable :: edge_slope(:)                  !! -d P_far/dH there
      real(dp), allocatable :: edge_by_speed(:)               !! -d P_far/d ln(speed), where the share is given
      real(dp) :: load_by_speed = 0                           !! derivative of the load outside, likewise
      real(dp), allocatable, private :: theta_weight(:, :)
   contains
      procedure :: set_edges
      procedure :: state_weights
      procedure :: product
      procedure :: finish
      procedure :: multiply => multiply_transposed
      procedure :: precondition => leave
   end type touching_transposed_t

contains

   !> Take the flooded edges of a problem at a state.
   subroutine set_edges(self, edges, given, state)
      class(touching_transposed_t), intent(inout) :: self
      type(edge_values_t), intent(in) :: edges
      type(given_t), intent(in) :: given
      type(touching_state_t), intent(in) :: state
      real(dp) :: excess(edges%count())

      if (allocated(self%edge)) deallocate (self%edge, self%edge_slope, self%edge_by_speed)
      allocate (self%edge(2, edges%count()), self%edge_slope(edges%count()))
      allocate (self%edge_by_speed(edges%count()), source=0.0_dp)
      self%load_by_speed = 0
      self%edge(1, :) = edges%i
      self%edge(2, :) = edges%j
      call edges%compare(given, state%p, state%h, excess, self%edge_slope)
      call self%grid%new_field(self%theta_weight)
   end subroutine set_edges

   !> Weights of the unknowns for weights of the changes of P, H and C: a right side.
   subroutine state_weights(self, p_weight, h_weight, c_weight, x)
      class(touching_transposed_t), intent(inout) :: self
      real(dp), intent(in), dimension(0:, 0:) :: p_weight, h_weight, c_weight
      real(dp), intent(out), contiguous, target :: x(:)
      integer :: k

      x = 0
      self%theta_weight = 0
      self%dr = p_weight
      self%dh = merge(h_weight, 0.0_dp, self%unknowns%is_free)
      do k = 1, size(self%unknowns%node, 2)
         associate (i => self%unknowns%node(1, k), j => self%unknowns%node(2, k))
            x(size(self%q) + k) = c_weight(i, j)               ! of P + C less P
            self%dr(i, j) = self%dr(i, j) - c_weight(i, j)
         end associate
      end do
      call collect(self, [0.0_dp, 0.0_dp], x)
      call deform_transposed(self)
      call add_pressure(self, self%q, x)
   end subroutine state_weights

   !> y = M^(-T) A^T x: the preconditioner from the left.
   subroutine multiply_transposed(self, x, y)
      class(touching_transposed_t), intent(inout) :: self
      real(dp), intent(in), contiguous, target :: x(:)
      real(dp), intent(out), contiguous, target :: y(:)
      real(dp), allocatable :: image(:)

      allocate (image, mold=x)
      call product(self, x, image)
      call finish(self, image, y)
   end subroutine multiply_transposed

   !> y = A^T x but for the weights of P + C by the deformation under `ahead`.
   subroutine product(self, x, y)
      class(touching_transposed_t), intent(inout) :: self
      real(dp), intent(in), contiguous, target :: x(:)
      real(dp), intent(out), contiguous, target :: y(:)
      real(dp), pointer, contiguous :: r(:, :)
      real(dp) :: weight
      integer :: k

      associate (n => self%unknowns%n)
         r(0:self%grid%nx, 0:self%grid%ny) => x(:size(self%q))
         call self%count(real_weights%product)
         self%work = self%unknowns%weight*r
         call self%oil%transpose(self%equations, self%state%theta, self%work, self%dr, self%theta_weight, self%dh)
         where (.not. self%unknowns%is_free) self%dh = 0
         y = 0
         do k = 1, size(self%unknowns%node, 2)
            associate (i => self%unknowns%node(1, k), j => self%unknowns%node(2, k), gap => x(size(self%q) + k))
               self%dh(i, j) = self%dh(i, j) + gap
               if (.not. self%law%is_soft) cycle
               weight = self%law%softness/self%state%c(i, j)*gap
               y(size(self%q) + k) = weight
               self%dr(i, j) = self%dr(i, j) - weight
            end associate
         end do
         do k = 1, size(self%edge, 2)
            associate (i => self%edge(1, k), j => self%edge(2, k))
               self%dr(i, j) = self%dr(i, j) + r(i, j)
               self%dh(i, j) = self%dh(i, j) + self%edge_slope(k)*r(i, j)
            end associate
         end do
         call collect(self, x(n - 1:), y)
         y(n) = x(n)
         if (self%seeks_speed) then
            y(n) = sum(self%by_speed*self%work) + self%load_by_speed*x(n - 1)
            do k = 1, size(self%edge, 2)
               y(n) = y(n) + self%edge_by_speed(k)*r(self%edge(1, k), self%edge(2, k))
            end do
         end if
         self%ahead = self%dh
      end associate
   end subroutine product

   !> Weights x of the unknowns for weights dr, theta_weight and dh of P, theta and H, and of the load and the share,
   !> without the deformation by dh.
   subroutine collect(self, borders, x)
      class(touching_transposed_t), intent(inout) :: self
      real(dp), intent(in) :: borders(2)
      real(dp), intent(inout), contiguous, target :: x(:)
      real(dp), pointer, contiguous :: u(:, :)
      integer :: k

      u(0:self%grid%nx, 0:self%grid%ny) => x(:size(self%q))
      x(self%unknowns%n - 1) = -sum(self%dh)
      u = merge(self%dr, merge(self%theta_weight, 0.0_dp, self%state%is_cavitated), self%unknowns%is_full)
      do k = 1, size(self%edge, 2)
         u(self%edge(1, k), self%edge(2, k)) = self%dr(self%edge(1, k), self%edge(2, k))
      end do
      call add_borders(self, borders, x)
   end subroutine collect

   !> q = K^T dh: the kernel is symmetric, the rows of a half domain count for two.
   subroutine deform_transposed(self)
      class(touching_transposed_t), intent(inout) :: self
      integer :: j
      do j = 0, self%grid%ny
         self%dh(:, j) = self%dh(:, j)/self%grid%weight(j)
      end do
      call self%deformation%deform(self%dh, self%q, .false.)
      do j = 0, self%grid%ny
         self%q(:, j) = self%grid%weight(j)*self%q(:, j)
      end do
   end subroutine deform_transposed

   !> Add weights of P + C to the unknowns that hold it.
   pure subroutine add_pressure(self, q, x)
      class(touching_transposed_t), intent(in) :: self
      real(dp), intent(in) :: q(0:, 0:)
      real(dp), intent(inout), contiguous, target :: x(:)
      real(dp), pointer, contiguous :: u(:, :)
      integer :: k

      u(0:self%grid%nx, 0:self%grid%ny) => x(:size(q))
      where (self%unknowns%is_full .and. .not. self%state%is_touching) u = u + q
      do k = 1, size(self%edge, 2)
         associate (i => self%edge(1, k), j => self%edge(2, k))
            u(i, j) = u(i, j) + q(i, j)
         end associate
      end do
      do k = 1, size(self%unknowns%node, 2)
         x(size(q) + k) = x(size(q) + k) + q(self%unknowns%node(1, k), self%unknowns%node(2, k))
      end do
   end subroutine add_pressure

   !> Add the weights of the unknowns in load and share.
   subroutine add_borders(self, borders, x)
      class(touching_transposed_t), intent(inout) :: self
      real(dp), intent(in) :: borders(2)
      real(dp), intent(inout), contiguous, target :: x(:)
      real(dp), pointer, contiguous :: u(:, :)
      real(dp) :: weight(0:self%grid%nx, 0:self%grid%ny)
      integer :: j, k

      u(0:self%grid%nx, 0:self%grid%ny) => x(:size(self%q))
      do j = 0, self%grid%ny
         weight(:, j) = load_factor*self%grid%hx*self%grid%hy*self%grid%weight(j)
      end do
      call add_pressure(self, borders(1)*weight, x)
      if (.not. self%seeks_speed) return
      do k = 1, size(self%unknowns%node, 2)
         associate (i => self%unknowns%node(1, k), j => self%unknowns%node(2, k))
            x(size(self%q) + k) = x(size(self%q) + k) + borders(2)*weight(i, j)
            if (self%unknowns%is_full(i, j)) u(i, j) = u(i, j) - borders(2)*weight(i, j)
         end associate
      end do
   end subroutine add_borders

   !> y = x: the product has the preconditioner.
   subroutine leave(self, x, y)
      class(touching_transposed_t), intent(inout) :: self
      real(dp), intent(in), contiguous, target :: x(:)
      real(dp), intent(out), contiguous, target :: y(:)
      y = x
   end subroutine leave

   !> y = M^(-T) x, with the identity at flooded edges; x lacks the weights of P + C by the deformation under `ahead`.
   subroutine finish(self, x, y)
      class(touching_transposed_t), intent(inout) :: self
      real(dp), intent(in), contiguous, target :: x(:)
      real(dp), intent(out), contiguous, target :: y(:)
      real(dp), allocatable, target :: fields(:)
      real(dp), pointer, contiguous :: edges(:, :), u(:, :)
      real(dp) :: at_edge(size(self%edge, 2)), determinant, right(2), t(2)
      integer :: k

      associate (n => self%unknowns%n, a => self%schur)
         right = x(n - 1:) - matmul(x(:n - 2), self%column(:n - 2, :)) &
                 - [(sum(self%ahead*self%deformed(:, :, k)), k=1, 2)]
         determinant = a(1, 1)*a(2, 2) - a(1, 2)*a(2, 1)
         t = 0
         if (abs(determinant) > 0) &
            t = [a(2, 2)*right(1) - a(2, 1)*right(2), a(1, 1)*right(2) - a(1, 2)*right(1)]/determinant
         fields = x
         call add_borders(self, -t, fields)
         call invert_transposed(self, fields, at_edge, y)
         y(n - 1:) = t
         edges(0:self%grid%nx, 0:self%grid%ny) => fields(:size(self%q))
         u(0:self%grid%nx, 0:self%grid%ny) => y(:size(self%q))
         do k = 1, size(self%edge, 2)
            u(self%edge(1, k), self%edge(2, k)) = edges(self%edge(1, k), self%edge(2, k)) + at_edge(k)
         end do
      end associate
   end subroutine finish

   !> Transposed approximate inverse for the fields alone.
   subroutine invert_transposed(self, x, at_edge, y)
      class(touching_transposed_t), intent(inout) :: self
      real(dp), intent(in), contiguous, target :: x(:)
      real(dp), intent(out) :: at_edge(:)          !! deformation at flooded edges
      real(dp), intent(out), contiguous, target :: y(:)
      real(dp), pointer, contiguous :: r(:, :), u(:, :)
      integer :: k, nodes

      nodes = size(self%q)
      u(0:self%grid%nx, 0:self%grid%ny) => x(:nodes)
      r(0:self%grid%nx, 0:self%grid%ny) => y(:nodes)
      self%dr = 0
      self%theta_weight = 0
      self%dh = 0
      if (size(self%unknowns%node, 2) > 0) then   ! transposed `follow_oil`
         self%work = merge(u, 0.0_dp, self%state%is_touching)
         call self%factors%oil%solve(self%grid, self%work, is_transposed=.true.)
         do k = 1, size(self%unknowns%node, 2)
            associate (i => self%unknowns%node(1, k), j => self%unknowns%node(2, k))
               self%dr(i, j) = self%work(i, j)
            end associate
         end do
         call subtract_links_transposed(self%unknowns, self%equations, self%grid%is_line, self%work, self%dh, &
                                        self%theta_weight)
         where (self%state%is_touching) self%theta_weight = 0
      end if
      self%dh = self%dh + self%ahead
      call deform_transposed(self)
      at_edge = [(self%q(self%edge(1, k), self%edge(2, k)), k=1, size(self%edge, 2))]
      self%q = merge(self%q, 0.0_dp, self%unknowns%is_full .or. self%state%is_touching)
      self%q = self%q + self%theta_weight
      where (.not. self%state%is_touching) self%q = self%q + u
      do k = 1, size(self%unknowns%node, 2)
         associate (i => self%unknowns%node(1, k), j => self%unknowns%node(2, k))
            self%q(i, j) = self%q(i, j) + x(nodes + k)
         end associate
      end do
      call self%factors%solve_transposed(self%grid, self%state, self%q, self%work)
      self%deformation%work = self%deformation%work + self%factors%operations
      call self%count(real_weights%solve*self%factors%entries + real_weights%cycle)
      do k = 1, size(self%unknowns%node, 2)
         associate (i => self%unknowns%node(1, k), j => self%unknowns%node(2, k))
            y(nodes + k) = self%work(i, j)
            self%work(i, j) = 0
         end associate
      end do
      r = 0
      where (self%unknowns%weight > 0) r = (self%dr + self%work)/self%unknowns%weight
      y(self%unknowns%n - 1:) = 0
   end subroutine invert_transposed

end module ehlwave_touching_transposed
