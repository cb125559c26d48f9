!> Flow of a generalised Newtonian oil through the faces between nodes, and its derivatives.
!>
!> At a face the pressure gradient along it is the difference of its two nodes, the gradient across it the mean of the
!> central differences of both. rho Qhat, theory eq. (S4), is evaluated at both nodes with their own P and H and this
!> gradient, and averaged; with tau0 -> inf this is eps averaged between nodes. The fitted scheme has a single flow
!> between them, see `ehlwave_fitted_mean`. Fluxes are in the unit of (eps_1 + eps_2) (P_2 - P_1), 2 hX rho Qhat_x
!> along X and (2 hY/kappa) rho Qhat_y along Y, so that 1/(2 hX^2) and kappa^2/(2 hY^2) weight them in the Reynolds
!> equation.
module ehlwave_face_flow
   use ehlwave_film_flow, only: film_flow_t
   use ehlwave_film_heat, only: film_heat_t
   use ehlwave_film_rules, only: across_film_t
   use ehlwave_fitted_mean, only: fit_flows, places_of_face
   use ehlwave_flow_values, only: along_x, along_y, flow_by_gx, flow_by_gy, flow_by_h, flow_by_ln_eta, flow_by_p, &
      flow_q, flow_values
   use ehlwave_grid, only: grid_t
   use ehlwave_kinds, only: dp
   use ehlwave_threads, only: is_shared
   use ehlwave_work_unit, only: fitted_operations, place_operations, point_operations
   implicit none (type, external)
   private
   public :: new_face_flow

   !> Faces from nodes (i, j) to (i + 1, j) or, along Y, to (i, j + 1). All arrays (0:nx, 0:ny); zero off the faces of
   !> unknown nodes. With node 1 the face's own and node 2 the next, its flux changes by
   !>
   !>     by_p1 q_1 + by_p2 q_2 + by_h1 dH_1 + by_h2 dH_2 + own (q_2 - q_1) + cross (d_1 + d_2)
   !>
   !> for changes q of P and dH of H, d the difference of q between the neighbours of a node across the face.
   type, public :: face_flow_t
      real(dp), allocatable :: flux(:, :)
      real(dp), allocatable :: own(:, :), cross(:, :)
      real(dp), allocatable :: by_p1(:, :), by_p2(:, :)
      real(dp), allocatable :: by_h1(:, :), by_h2(:, :)
      ! fitted faces, see `ehlwave_raised_flux`: s and 1/(8 Hm), derivative by H of the next nodes but one
      logical :: is_raised = .false.
      integer :: first_curved = 0, last_curved = -1     ! faces in a row with two more nodes on both sides
      real(dp), allocatable :: slope(:, :), thin(:, :), outer(:, :)
      real(dp) :: work = 0   !! operations of the last evaluation, see `ehlwave_work_unit`
   contains
      procedure :: evaluate_x
      procedure :: evaluate_y
      procedure :: join_x
      procedure :: join_y
      procedure, private :: set_row
      procedure, private :: rest
   end type face_flow_t

   !> State of the oil at the nodes of a grid. All arrays (0:nx, 0:ny).
   type, public :: node_oil_t
      real(dp), allocatable :: p(:, :), h(:, :)                    !! P, H
      real(dp), allocatable :: rho(:, :), drho(:, :)               !! rho/rho0, d rho/dP
      real(dp), allocatable :: fluidity(:, :), dln_eta(:, :)       !! eta0/eta, d ln(eta)/dP
   end type node_oil_t

contains

   !> Work space for a grid.
   function new_face_flow(grid) result(self)
      type(grid_t), intent(in) :: grid
      type(face_flow_t) :: self
      call grid%new_field(self%flux)
      call grid%new_field(self%own)
      call grid%new_field(self%cross)
      call grid%new_field(self%by_p1)
      call grid%new_field(self%by_p2)
      call grid%new_field(self%by_h1)
      call grid%new_field(self%by_h2)
   end function new_face_flow

   !> Faces along X.
   subroutine evaluate_x(self, grid, kappa, film, oil, heat)
      class(face_flow_t), intent(inout) :: self
      type(grid_t), intent(in) :: grid
      real(dp), intent(in) :: kappa
      type(film_flow_t), intent(in) :: film
      type(node_oil_t), intent(in) :: oil
      type(film_heat_t), intent(in), optional :: heat
      real(dp) :: across(0:grid%nx), gx(grid%nx), gy(grid%nx)
      real(dp) :: work(grid%first_row:grid%last_row)
      integer :: j, n

      n = grid%nx
      !$omp parallel do private(across, gx, gy) schedule(dynamic) if (is_shared(size(oil%p)))
      do j = grid%first_row, grid%last_row
         across = kappa*(oil%p(:, grid%above(j)) - oil%p(:, grid%below(j)))/(2*grid%hy)
         gx = (oil%p(1:n, j) - oil%p(0:n - 1, j))/grid%hx
         gy = 0.5_dp*(across(0:n - 1) + across(1:n))
         call self%set_row(film, oil, along_x, [0, j], gx, gy, [grid%hx, grid%hx*kappa/(4*grid%hy)], &
                           grid%is_fitted, work(j), heat)
      end do
      self%work = sum(work)
   end subroutine evaluate_x

   !> Faces along Y; none in a line contact.
   subroutine evaluate_y(self, grid, kappa, film, oil, heat)
      class(face_flow_t), intent(inout) :: self
      type(grid_t), intent(in) :: grid
      real(dp), intent(in) :: kappa
      type(film_flow_t), intent(in) :: film
      type(node_oil_t), intent(in) :: oil
      type(film_heat_t), intent(in), optional :: heat
      real(dp), dimension(grid%nx - 1) :: below, above, gx, gy
      real(dp) :: work(0:grid%ny - 1)
      integer :: j, n

      n = grid%nx - 1
      !$omp parallel do private(below, above, gx, gy) schedule(dynamic) if (is_shared(size(oil%p)))
      do j = 0, grid%ny - 1
         below = (oil%p(2:n + 1, j) - oil%p(0:n - 1, j))/(2*grid%hx)
         above = (oil%p(2:n + 1, j + 1) - oil%p(0:n - 1, j + 1))/(2*grid%hx)
         gx = 0.5_dp*(below + above)
         gy = kappa*(oil%p(1:n, j + 1) - oil%p(1:n, j))/grid%hy
         call self%set_row(film, oil, along_y, [1, j], gx, gy, [grid%hy/kappa, grid%hy/(4*kappa*grid%hx)], &
                           grid%is_fitted, work(j), heat)
      end do
      self%work = sum(work)
   end subroutine evaluate_y

   !> Faces along X of the next coarser grid, each two of a finer one: for changes, without the flux itself.
   pure subroutine join_x(self, fine, row_ratio)
      class(face_flow_t), intent(inout) :: self
      type(face_flow_t), intent(in) :: fine
      integer, intent(in) :: row_ratio           !! rows of `self` per row of the finer grid
      integer :: i, j

      self%is_raised = .false.
      do j = 0, ubound(self%own, 2)
         do i = 0, ubound(self%own, 1) - 1
            call join(self, [i, j], fine, [2*i, row_ratio*j], [2*i + 1, row_ratio*j])
         end do
      end do
   end subroutine join_x

   !> Faces along Y of the next coarser grid.
   pure subroutine join_y(self, fine)
      class(face_flow_t), intent(inout) :: self
      type(face_flow_t), intent(in) :: fine
      integer :: i, j

      self%is_raised = .false.
      do j = 0, ubound(self%own, 2) - 1
         do i = 0, ubound(self%own, 1)
            call join(self, [i, j], fine, [2*i, 2*j], [2*i, 2*j + 1])
         end do
      end do
   end subroutine join_y

   !> A face in place of two in a row, in its own unit, twice as large: by its outer nodes as each has it by its half.
   pure subroutine join(self, face, fine, first, second)
      type(face_flow_t), intent(inout) :: self
      type(face_flow_t), intent(in) :: fine
      integer, intent(in) :: face(2), first(2), second(2)   !! face of `self`; the two of `fine`

      associate (i => face(1), j => face(2), i1 => first(1), j1 => first(2), i2 => second(1), j2 => second(2))
         self%own(i, j) = 0.5_dp*(fine%own(i1, j1) + fine%own(i2, j2))
         self%cross(i, j) = 0.5_dp*(fine%cross(i1, j1) + fine%cross(i2, j2))
         self%by_p1(i, j) = 2*fine%by_p1(i1, j1)
         self%by_p2(i, j) = 2*fine%by_p2(i2, j2)
         self%by_h1(i, j) = 2*fine%by_h1(i1, j1)
         self%by_h2(i, j) = 2*fine%by_h2(i2, j2)
      end associate
   end subroutine join

   !> Fluxes of a row of faces and their derivatives.
   pure subroutine set_row(self, film, oil, direction, node, gx, gy, weight, fits, work, heat)
      class(face_flow_t), intent(inout) :: self
      type(film_flow_t), intent(in) :: film
      type(node_oil_t), intent(in) :: oil
      integer, intent(in) :: direction           !! direction of the faces: along_x or along_y
      integer, intent(in) :: node(2)             !! first node of the first face
      real(dp), intent(in) :: gx(:), gy(:)       !! dP/dX and kappa dP/dY, (faces)
      real(dp), intent(in) :: weight(2)          !! half of 2 hX or of 2 hY/kappa; likewise for `cross`
      logical, intent(in) :: fits                !! single flow between the nodes, theory eq. (D13)
      real(dp), intent(out) :: work              !! operations that it took: whole numbers, whose sum is exact
      type(film_heat_t), intent(in), optional :: heat
      type(across_film_t), allocatable :: across_film
      ! Qhat at the first nodes, then at those beyond, of faces with a gradient
      real(dp) :: flow(flow_values, 2*size(gx))
      real(dp), dimension(2*size(gx)) :: density, fluidity, grad_x, grad_y, h     ! there
      integer :: across, along, driven(size(gx)), f, i, i2, j2, k, l, last, n, next, points
      integer, parameter :: beside = 2                                   ! faces beyond the last with a gradient

      i2 = merge(1, 0, direction == along_x)
      j2 = node(2) + merge(1, 0, direction == along_y)
      n = 0
      last = -beside
      next = 1
      do k = 1, size(gx)
         if (.not. abs(gx(k)) + abs(gy(k)) > 0) then
            if (.not. present(heat)) cycle
            f = node(1) + k - 1
            if (.not. max(heat%range(f, node(2)), heat%range(f + i2, j2)) > 0) cycle
            ! where the film may come to bear, a gradient must drive the flow: a warm oil is far from Newtonian
            do next = max(next, k), size(gx)
               if (abs(gx(next)) + abs(gy(next)) > 0) exit
            end do
            if (k - last > beside .and. next - k > beside) cycle
         else
            last = k
         end if
         n = n + 1
         driven(n) = k
      end do
      along = merge(flow_by_gx, flow_by_gy, direction == along_x)
      across = flow_by_gx + flow_by_gy - along
      do k = 1, n
         f = node(1) + driven(k) - 1
         fluidity(k) = oil%fluidity(f, node(2))
         fluidity(n + k) = oil%fluidity(f + i2, j2)
         h(k) = oil%h(f, node(2))
         h(n + k) = oil%h(f + i2, j2)
         grad_x(k) = gx(driven(k))
         grad_y(k) = gy(driven(k))
      end do
      if (present(heat) .or. allocated(film%limit)) then
         allocate (across_film)
         associate (nodes => node(1) - 1 + driven(:n))
            if (allocated(film%limit)) across_film%p = [oil%p(nodes, node(2)), oil%p(nodes + i2, j2)]
            if (present(heat)) call heat%take_ends(across_film, nodes, i2, [node(2), j2])
         end associate
      end if
      grad_x(n + 1:2*n) = grad_x(:n)
      grad_y(n + 1:2*n) = grad_y(:n)
      if (fits) then
         associate (first => node(1) - 1 + driven(:n))
            density(:2*n) = [oil%rho(first, node(2)), oil%rho(first + i2, j2)]
         end associate
         call fit_flows(film, direction, reshape(fluidity(:2*n), [n, 2]), reshape(h(:2*n), [n, 2]), grad_x(:n), &
                        grad_y(:n), reshape(density(:2*n), [n, 2]), flow(:, :2*n), points, across_film)
      else
         call film%evaluate(direction, fluidity(:2*n), h(:2*n), grad_x(:2*n), grad_y(:2*n), flow(:, :2*n), points, &
                            across_film)
      end if
      work = real(point_operations, dp)*points + real(place_operations, dp)*merge(places_of_face, 2, fits)*n
      if (fits) work = work + real(fitted_operations, dp)*n
      if (n < size(gx)) call self%rest(oil, film%lambdabar, node, [i2, j2 - node(2)], size(gx))
      associate (j1 => node(2), rho => oil%rho, drho => oil%drho, dln_eta => oil%dln_eta)
         do k = 1, n
            f = node(1) + driven(k) - 1
            i = f + i2
            l = k + n
            self%flux(f, j1) = weight(1)*(rho(f, j1)*flow(flow_q, k) + rho(i, j2)*flow(flow_q, l))
            self%by_p1(f, j1) = weight(1)*(drho(f, j1)*flow(flow_q, k) &
               + rho(f, j1)*dln_eta(f, j1)*flow(flow_by_ln_eta, k))
            self%by_p2(f, j1) = weight(1)*(drho(i, j2)*flow(flow_q, l) &
               + rho(i, j2)*dln_eta(i, j2)*flow(flow_by_ln_eta, l))
            if (allocated(film%limit)) then
               self%by_p1(f, j1) = self%by_p1(f, j1) + weight(1)*rho(f, j1)*flow(flow_by_p, k)
               self%by_p2(f, j1) = self%by_p2(f, j1) + weight(1)*rho(i, j2)*flow(flow_by_p, l)
            end if
            self%by_h1(f, j1) = weight(1)*rho(f, j1)*flow(flow_by_h, k)
            self%by_h2(f, j1) = weight(1)*rho(i, j2)*flow(flow_by_h, l)
            self%own(f, j1) = rho(f, j1)*flow(along, k) + rho(i, j2)*flow(along, l)
            self%cross(f, j1) = weight(2)*(rho(f, j1)*flow(across, k) + rho(i, j2)*flow(across, l))
         end do
      end associate
   end subroutine set_row

   !> Faces of a row without pressure-driven flow, as in a Newtonian oil: in cavitated film only their signs count.
   pure subroutine rest(self, oil, lambdabar, node, shift, n)
      class(face_flow_t), intent(inout) :: self
      type(node_oil_t), intent(in) :: oil
      real(dp), intent(in) :: lambdabar
      integer, intent(in) :: node(2)             !! first node of the first face
      integer, intent(in) :: shift(2)            !! from the first to the second node of a face
      integer, intent(in) :: n                   !! faces
      integer :: i, last

      last = node(1) + n - 1
      associate (j => node(2))
         self%flux(node(1):last, j) = 0
         self%by_p1(node(1):last, j) = 0
         self%by_p2(node(1):last, j) = 0
         self%by_h1(node(1):last, j) = 0
         self%by_h2(node(1):last, j) = 0
         self%cross(node(1):last, j) = 0
         do i = node(1), last
            self%own(i, j) = (mobility(i, j) + mobility(i + shift(1), j + shift(2)))/lambdabar
         end do
      end associate

   contains

      !> rho H^3/eta.
      pure real(dp) function mobility(i, j)
         integer, intent(in) :: i, j
         mobility = oil%rho(i, j)*oil%h(i, j)**3*oil%fluidity(i, j)
      end function mobility

   end subroutine rest

end module ehlwave_face_flow
