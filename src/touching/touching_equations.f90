!> The discrete equations of a contact whose surfaces may touch, at a state, and their derivatives at single nodes.
!>
!> Oil, theory eq. (Z1), (Z4): what pressure gradients drive into a cell less what the surfaces carry out of it,
!>
!>     R_i = driven flow - (F_i - F_(i-1))/hX,    F_i = theta_i (3/2 f_i - 1/2 f_(i-1)),    f = rho H,
!>
!> the capacity of the gap at the face behind node i times the share that is filled. Each F leaves one cell and enters
!> the next, so that no oil is made or lost. Along a characteristic f_(i-1) and F_(i-1) belong to the step before.
!> Where theta = 1 these are the differences of the full film, theory eq. (D1) and (D5).
module ehlwave_touching_equations
   use ehlwave_contact_problem, only: contact_problem_t
   use ehlwave_flow, only: flow_t, new_flow
   use ehlwave_given, only: given_t
   use ehlwave_kinds, only: dp
   use ehlwave_mesh, only: mesh_t, new_mesh
   use ehlwave_reynolds, only: driven_flow
   use ehlwave_reynolds_links, only: flow_links, poiseuille_links
   use ehlwave_touching_state, only: touching_law_t, touching_state_t
   implicit none (type, external)
   private
   public :: link_row

   !> Nodes that enter the residual of a node: itself, east, west, north, south, and the second upstream.
   integer, parameter, public :: links = flow_links + 1
   integer, parameter, public :: link_i(links) = [0, 1, -1, 0, 0, -2]
   integer, parameter, public :: link_j(links) = [0, 0, 0, 1, -1, 0]

   ! capacity at a face over its node's, where the gap opens steeply
   real(dp), parameter :: least_face = 0.25_dp

   ! film over the boundary film, below which no film falls on the way to a solution
   real(dp), parameter :: least_film = 0.5_dp

   !> Oil that the steps before pass on along the characteristics.
   type, public :: touching_past_t
      real(dp), allocatable :: f(:, :, :)        !! rho H at T - n dT, (0:nx, 0:ny, steps of a cell)
      real(dp), allocatable :: passed(:, :, :)   !! F there
   end type touching_past_t

   !> All arrays (0:nx, 0:ny).
   type, public :: touching_equations_t
      type(mesh_t) :: mesh
      type(flow_t) :: flow
      real(dp), allocatable :: gap(:, :)                     !! between the surfaces
      real(dp), allocatable :: residual(:, :)                !! R at unknown nodes, 0 elsewhere
      real(dp), allocatable :: face(:, :)                    !! capacity at the face behind a node
      real(dp), allocatable :: own(:, :), upstream(:, :)     !! weights of f_i and f_(i-1) in it
      real(dp), allocatable :: by_p(:, :, :), by_h(:, :, :)  !! derivatives of R by P and H of links
      real(dp), allocatable :: by_theta(:, :, :)             !! by theta of the node and of the one upstream
   contains
      procedure :: init
      procedure :: evaluate
      procedure :: evaluate_flow
      procedure :: linearise
      procedure :: remember
   end type touching_equations_t

contains

   !> Row of the node that a link leads to from row j; a half domain is mirrored, and a line has a single row.
   elemental integer function link_row(j, l, is_line) result(row)
      integer, intent(in) :: j, l          !! row; link
      logical, intent(in) :: is_line
      row = merge(j, abs(j + link_j(l)), is_line)
   end function link_row

   !> Work space for a problem.
   subroutine init(self, problem)
      class(touching_equations_t), intent(inout) :: self
      type(contact_problem_t), intent(in) :: problem
      associate (grid => problem%grid)
         self%mesh = new_mesh(grid, problem%conditions%elliptic%kappa)
         self%flow = new_flow(grid)
         call grid%new_field(self%gap)
         call grid%new_field(self%residual)
         call grid%new_field(self%face)
         call grid%new_field(self%own)
         call grid%new_field(self%upstream)
         if (allocated(self%by_p)) deallocate (self%by_p, self%by_h, self%by_theta)
         allocate (self%by_p(0:grid%nx, 0:grid%ny, links), self%by_h(0:grid%nx, 0:grid%ny, links), &
                   self%by_theta(0:grid%nx, 0:grid%ny, 2), source=0.0_dp)
      end associate
   end subroutine init

   !> Gap, film and residual of a state.
   subroutine evaluate(self, problem, law, given, past, state, holds_edges)
      class(touching_equations_t), intent(inout) :: self
      type(contact_problem_t), intent(inout) :: problem
      type(touching_law_t), intent(in) :: law
      type(given_t), intent(in) :: given           !! its roughness and load count
      type(touching_past_t), intent(in) :: past
      type(touching_state_t), intent(inout) :: state
      logical, intent(in), optional :: holds_edges   !! whether pressures at flooded edges stay as they are
      integer :: j
      logical :: holds

      holds = .false.
      if (present(holds_edges)) holds = holds_edges
      call problem%film(given, state%p + state%c, state%delta, self%gap)
      state%h = self%gap
      if (.not. law%is_soft) then
         if (allocated(past%f)) state%h = max(state%h, least_film*law%film)
         where (state%is_touching) state%h = law%film
      end if
      if (.not. holds) call problem%edges%impose(given, state%h, state%p)
      call self%evaluate_flow(problem, state%p, state%h)
      call driven_flow(self%mesh, self%flow, self%residual)
      do j = 0, problem%grid%ny
         call set_faces(self, past, j)
         if (j < problem%grid%first_row .or. j > problem%grid%last_row) cycle
         call subtract_row(self, past, j, state%theta(:, j))
      end do
   end subroutine evaluate

   !> Coefficients of the flow at a pressure and a film.
   subroutine evaluate_flow(self, problem, p, h)
      class(touching_equations_t), intent(inout) :: self
      type(contact_problem_t), intent(in) :: problem
      real(dp), intent(in), contiguous :: p(0:, 0:), h(0:, 0:)
      call self%flow%evaluate(problem%rheology, problem%conditions%lambdabar, p, h)
      if (.not. problem%rheology%is_newtonian()) then
         call self%flow%evaluate_faces(problem%film_flow, problem%grid, self%mesh%kappa)
      else if (problem%grid%is_fitted) then
         call self%flow%fit(problem%grid, problem%conditions%lambdabar)
      end if
   end subroutine evaluate_flow

   !> Capacities of a row at the faces behind its nodes. Where they would all but vanish, as the gap opens steeply
   !> upstream, they are a share of those at the nodes.
   pure subroutine set_faces(self, past, j)
      type(touching_equations_t), intent(inout) :: self
      type(touching_past_t), intent(in) :: past
      integer, intent(in) :: j
      integer :: i, n

      n = ubound(self%face, 1)
      associate (f => self%flow%f, own => self%own, upstream => self%upstream, face => self%face)
         own(:, j) = 1.5_dp
         upstream(:, j) = -0.5_dp
         own(0, j) = 1
         upstream(0, j) = 0
         face(0, j) = f(0, j)
         do i = 1, n
            face(i, j) = 1.5_dp*f(i, j) - 0.5_dp*before(i)
            if (face(i, j) > least_face*f(i, j)) cycle
            face(i, j) = least_face*f(i, j)
            own(i, j) = least_face
            upstream(i, j) = 0
         end do
      end associate

   contains

      !> rho H of the node upstream.
      pure real(dp) function before(i)
         integer, intent(in) :: i
         if (allocated(past%f)) then
            before = past%f(i - 1, j, size(past%f, 3))
         else
            before = self%flow%f(i - 1, j)
         end if
      end function before

   end subroutine set_faces

   !> R less wedge and squeeze on a row. The first node has first order, as nothing is upstream of the edge.
   pure subroutine subtract_row(self, past, j, theta)
      type(touching_equations_t), intent(inout) :: self
      type(touching_past_t), intent(in) :: past
      integer, intent(in) :: j
      real(dp), intent(in) :: theta(0:)
      integer :: i, nx

      nx = ubound(theta, 1)
      associate (r => self%residual, face => self%face, f => self%flow%f, hx => self%mesh%grid%hx)
         if (allocated(past%f)) then
            r(1, j) = r(1, j) - (theta(1)*f(1, j) - past%f(0, j, size(past%f, 3)))/hx
            do i = 2, nx - 1
               r(i, j) = r(i, j) - (theta(i)*face(i, j) - past%passed(i - 1, j, size(past%f, 3)))/hx
            end do
         else
            r(1, j) = r(1, j) - (theta(1)*f(1, j) - f(0, j))/hx
            do i = 2, nx - 1
               r(i, j) = r(i, j) - (theta(i)*face(i, j) - theta(i - 1)*face(i - 1, j))/hx
            end do
         end if
      end associate
   end subroutine subtract_row

   !> Derivatives at the state last evaluated, except derivatives of edges by their own pressure, which stays.
   subroutine linearise(self, past, state)
      class(touching_equations_t), intent(inout) :: self
      type(touching_past_t), intent(in) :: past
      type(touching_state_t), intent(in) :: state
      integer :: i, j, l, nodes
      real(dp), allocatable :: flow_p(:, :), flow_h(:, :)

      associate (grid => self%mesh%grid, theta => state%theta, hx => self%mesh%grid%hx)
         nodes = grid%nx - 1
         allocate (flow_p(nodes, flow_links), flow_h(nodes, flow_links))
         self%by_p = 0
         self%by_h = 0
         self%by_theta = 0
         do j = grid%first_row, grid%last_row
            call poiseuille_links(self%mesh, self%flow, [1, nodes, j, j], flow_p, flow_h)
            do l = 1, flow_links
               self%by_p(1:nodes, j, l) = flow_p(:, l)
               self%by_h(1:nodes, j, l) = flow_h(:, l)
            end do
            call add(1, 1, -theta(1, j)/hx, 0)
            self%by_theta(1, j, 1) = -self%flow%f(1, j)/hx
            if (.not. allocated(past%f)) call add(1, 3, 1/hx, -1)
            do i = 2, nodes
               call add(i, 1, -theta(i, j)*self%own(i, j)/hx, 0)
               self%by_theta(i, j, 1) = -self%face(i, j)/hx
               if (allocated(past%f)) cycle
               call add(i, 3, -theta(i, j)*self%upstream(i, j)/hx + theta(i - 1, j)*self%own(i - 1, j)/hx, -1)
               call add(i, 6, theta(i - 1, j)*self%upstream(i - 1, j)/hx, -2)
               self%by_theta(i, j, 2) = self%face(i - 1, j)/hx
            end do
         end do
      end associate

   contains

      !> A term `weight` times rho H of the node `shift` nodes further.
      subroutine add(i, link, weight, shift)
         integer, intent(in) :: i, link, shift
         real(dp), intent(in) :: weight
         self%by_p(i, j, link) = self%by_p(i, j, link) + weight*self%flow%f_p(i + shift, j)
         self%by_h(i, j, link) = self%by_h(i, j, link) + weight*self%flow%rho(i + shift, j)
      end subroutine add

   end subroutine linearise

   !> Put what the state last evaluated passes on at the head of the past, made for `steps` steps of a cell.
   subroutine remember(self, theta, steps, past)
      class(touching_equations_t), intent(in) :: self
      real(dp), intent(in) :: theta(0:, 0:)
      integer, intent(in) :: steps
      type(touching_past_t), intent(inout) :: past
      integer :: n

      if (.not. allocated(past%f)) then
         associate (nx => ubound(theta, 1), ny => ubound(theta, 2))
            allocate (past%f(0:nx, 0:ny, steps), source=spread(self%flow%f, 3, steps))
            allocate (past%passed(0:nx, 0:ny, steps), source=spread(theta*self%face, 3, steps))
         end associate
         return
      end if
      do n = steps, 2, -1
         past%f(:, :, n) = past%f(:, :, n - 1)
         past%passed(:, :, n) = past%passed(:, :, n - 1)
      end do
      past%f(:, :, 1) = self%flow%f
      past%passed(:, :, 1) = theta*self%face
   end subroutine remember

end module ehlwave_touching_equations
