!> Flow of a generalised Newtonian oil through the faces between nodes, and its derivatives.
!>
!> At a face the pressure gradient along it is the difference of its two nodes, that across it the mean of the central differences of
!> both. rho Qhat is evaluated at both nodes with their own P and H and this gradient, and averaged; with tau0 -> inf this is eps
!> averaged between nodes. Fluxes are in the unit of (eps_1 + eps_2) (P_2 - P_1), 2 hX rho Qhat_x along X and
!> (2 hY/kappa) rho Qhat_y along Y, so that 1/(2 hX^2) and kappa^2/(2 hY^2) weight them in the Reynolds equation.
module ehlwave_face_flow
   use ehlwave_film_flow, only: along_x, along_y, film_flow_t, flow_by_gx, flow_by_gy, flow_by_h, flow_by_ln_eta, flow_q, &
      flow_values
   use ehlwave_grid, only: grid_t
   use ehlwave_kinds, only: dp
   implicit none (type, external)
   private
   public :: new_face_flow

   !> Faces from nodes (i, j) to (i + 1, j) or, along Y, to (i, j + 1). All arrays (0:nx, 0:ny); zero off the faces of unknown
   !> nodes. With node 1 the face's own and node 2 the one beyond, its flux changes by
   !>
   !>     by_p1 q_1 + by_p2 q_2 + by_h1 dH_1 + by_h2 dH_2 + own (q_2 - q_1) + cross (d_1 + d_2)
   !>
   !> for changes q of P and dH of H, d the difference of q between the neighbours of a node across the face.
   type, public :: face_flow_t
      real(dp), allocatable :: flux(:, :)
      real(dp), allocatable :: own(:, :), cross(:, :)
      real(dp), allocatable :: by_p1(:, :), by_p2(:, :)
      real(dp), allocatable :: by_h1(:, :), by_h2(:, :)
   contains
      procedure :: evaluate_x
      procedure :: evaluate_y
      procedure, private :: take
   end type face_flow_t

   !> What the oil is like at the nodes of a grid. All arrays (0:nx, 0:ny).
   type, public :: node_oil_t
      real(dp), allocatable :: p(:, :), h(:, :)                    !! P, H
      real(dp), allocatable :: rho(:, :), drho(:, :)               !! rho/rho0, d rho/dP
      real(dp), allocatable :: fluidity(:, :), dln_eta(:, :)       !! eta0/eta, d ln(eta)/dP
   end type node_oil_t

contains

   !> Work space for a grid.
   pure function new_face_flow(grid) result(self)
      type(grid_t), intent(in) :: grid
      type(face_flow_t) :: self
      real(dp), allocatable :: zero(:, :)
      allocate (zero(0:grid%nx, 0:grid%ny), source=0.0_dp)
      self%flux = zero
      self%own = zero
      self%cross = zero
      self%by_p1 = zero
      self%by_p2 = zero
      self%by_h1 = zero
      self%by_h2 = zero
   end function new_face_flow

   !> Faces along X.
   pure subroutine evaluate_x(self, grid, kappa, film, oil)
      class(face_flow_t), intent(inout) :: self
      type(grid_t), intent(in) :: grid
      real(dp), intent(in) :: kappa
      type(film_flow_t), intent(in) :: film
      type(node_oil_t), intent(in) :: oil
      real(dp) :: across(0:grid%nx), gx(grid%nx), gy(grid%nx), one(grid%nx, flow_values), two(grid%nx, flow_values)
      integer :: j, n

      n = grid%nx
      do j = grid%first_row, grid%last_row
         across = kappa*(oil%p(:, grid%above(j)) - oil%p(:, grid%below(j)))/(2*grid%hy)
         gx = (oil%p(1:n, j) - oil%p(0:n - 1, j))/grid%hx
         gy = 0.5_dp*(across(0:n - 1) + across(1:n))
         call film%evaluate(along_x, oil%fluidity(0:n - 1, j), oil%h(0:n - 1, j), gx, gy, one)
         call film%evaluate(along_x, oil%fluidity(1:n, j), oil%h(1:n, j), gx, gy, two)
         call self%take(oil, [0, j], [1, j], grid%hx, one, two)
         self%own(0:n - 1, j) = oil%rho(0:n - 1, j)*one(:, flow_by_gx) + oil%rho(1:n, j)*two(:, flow_by_gx)
         self%cross(0:n - 1, j) = grid%hx*kappa/(4*grid%hy) &
                                  *(oil%rho(0:n - 1, j)*one(:, flow_by_gy) + oil%rho(1:n, j)*two(:, flow_by_gy))
      end do
   end subroutine evaluate_x

   !> Faces along Y; none in a line contact.
   pure subroutine evaluate_y(self, grid, kappa, film, oil)
      class(face_flow_t), intent(inout) :: self
      type(grid_t), intent(in) :: grid
      real(dp), intent(in) :: kappa
      type(film_flow_t), intent(in) :: film
      type(node_oil_t), intent(in) :: oil
      real(dp), dimension(grid%nx - 1) :: below, above, gx, gy
      real(dp), dimension(grid%nx - 1, flow_values) :: one, two
      integer :: j, n

      n = grid%nx - 1
      do j = 0, grid%ny - 1
         below = (oil%p(2:n + 1, j) - oil%p(0:n - 1, j))/(2*grid%hx)
         above = (oil%p(2:n + 1, j + 1) - oil%p(0:n - 1, j + 1))/(2*grid%hx)
         gx = 0.5_dp*(below + above)
         gy = kappa*(oil%p(1:n, j + 1) - oil%p(1:n, j))/grid%hy
         call film%evaluate(along_y, oil%fluidity(1:n, j), oil%h(1:n, j), gx, gy, one)
         call film%evaluate(along_y, oil%fluidity(1:n, j + 1), oil%h(1:n, j + 1), gx, gy, two)
         call self%take(oil, [1, j], [1, j + 1], grid%hy/kappa, one, two)
         self%own(1:n, j) = oil%rho(1:n, j)*one(:, flow_by_gy) + oil%rho(1:n, j + 1)*two(:, flow_by_gy)
         self%cross(1:n, j) = grid%hy/(4*kappa*grid%hx) &
                              *(oil%rho(1:n, j)*one(:, flow_by_gx) + oil%rho(1:n, j + 1)*two(:, flow_by_gx))
      end do
   end subroutine evaluate_y

   !> Fluxes of a row of faces and their derivatives by P and H of the two nodes at a fixed gradient.
   pure subroutine take(self, oil, node1, node2, weight, one, two)
      class(face_flow_t), intent(inout) :: self
      type(node_oil_t), intent(in) :: oil
      integer, intent(in) :: node1(2), node2(2)            !! nodes of the first face
      real(dp), intent(in) :: weight                       !! half of 2 hX or of 2 hY/kappa
      real(dp), intent(in) :: one(:, :), two(:, :)         !! Qhat at the nodes, (faces, flow_values)
      integer :: f, i1, i2, k

      associate (j1 => node1(2), j2 => node2(2))
         do k = 1, size(one, 1)
            f = node1(1) + k - 1
            i1 = f
            i2 = node2(1) + k - 1
            self%flux(f, j1) = weight*(oil%rho(i1, j1)*one(k, flow_q) + oil%rho(i2, j2)*two(k, flow_q))
            self%by_p1(f, j1) = weight*(oil%drho(i1, j1)*one(k, flow_q) &
                                        + oil%rho(i1, j1)*oil%dln_eta(i1, j1)*one(k, flow_by_ln_eta))
            self%by_p2(f, j1) = weight*(oil%drho(i2, j2)*two(k, flow_q) &
                                        + oil%rho(i2, j2)*oil%dln_eta(i2, j2)*two(k, flow_by_ln_eta))
            self%by_h1(f, j1) = weight*oil%rho(i1, j1)*one(k, flow_by_h)
            self%by_h2(f, j1) = weight*oil%rho(i2, j2)*two(k, flow_by_h)
         end do
      end associate
   end subroutine take

end module ehlwave_face_flow
