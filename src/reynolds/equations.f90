!> The discrete equations of a contact evaluated at a state.
module ehlwave_equations
   use ehlwave_assertions, only: assert, checks
   use ehlwave_contact_problem, only: contact_problem_t
   use ehlwave_edge_values, only: edge_values_t
   use ehlwave_flow, only: flow_t, new_flow
   use ehlwave_given, only: given_t
   use ehlwave_kernel, only: kernel_t, new_kernel
   use ehlwave_kinds, only: dp
   use ehlwave_mesh, only: mesh_t, new_mesh
   use ehlwave_oil_content, only: new_content, oil_content_t
   use ehlwave_reynolds, only: driven_flow, follow_state, reynolds_residual
   use ehlwave_reynolds_links, only: reynolds_scale
   use ehlwave_state, only: state_t
   use ehlwave_threads, only: is_shared
   use ehlwave_work_unit, only: evaluation_operations
   implicit none (type, external)
   private

   !> Work space of their evaluation, with given data: data of a level or, in a multigrid cycle, right sides from a
   !> finer grid. All arrays (0:nx, 0:ny), zero or false off the unknown nodes.
   type, public :: equations_t
      type(mesh_t) :: mesh
      real(dp) :: self_influence = 0              !! deformation at a node under its own unit pressure
      type(flow_t) :: flow                        !! coefficients at the state last evaluated
      real(dp), allocatable :: residual(:, :)     !! R there
      real(dp), allocatable :: scale(:, :)        !! 1/|A_ii|
      logical, allocatable :: is_cavitated(:, :)  !! P + R/|A_ii| <= 0: there the equation is P = 0
      type(edge_values_t) :: edges                !! edges of the problem last evaluated: at these nodes P = P_far(H)
      real(dp), allocatable :: edge_excess(:)     !! P - P_far(H) there
      real(dp), allocatable :: edge_slope(:)      !! -d P_far/dH there
      real(dp) :: edge_unit = 0                   !! unit of P there, where edges may be dry
      type(oil_content_t), allocatable :: content !! content, in a problem with a supply: partly filled nodes are the
                                                  !! cavitated nodes
   contains
      procedure :: init
      procedure :: evaluate
      procedure :: follow
      procedure :: work
      procedure :: inject_from
      procedure :: keep_changes
      procedure :: set_scale
      procedure :: drop_scale
      procedure :: load_residual
   end type equations_t

contains

   !> Work space for a problem.
   subroutine init(self, problem)
      class(equations_t), intent(out) :: self
      type(contact_problem_t), intent(in) :: problem
      type(kernel_t) :: kernel

      associate (grid => problem%grid, elliptic => problem%conditions%elliptic)
         self%mesh = new_mesh(grid, elliptic%kappa)
         kernel = new_kernel(grid, elliptic%kappa, elliptic%k)
         self%self_influence = kernel%at(0, 0)
         self%flow = new_flow(grid)
         call grid%new_field(self%residual)
         call grid%new_field(self%scale)
         allocate (self%is_cavitated(0:grid%nx, 0:grid%ny), source=.false.)
         self%edges = problem%edges
         allocate (self%edge_excess(self%edges%count()), self%edge_slope(self%edges%count()), source=0.0_dp)
      end associate
   end subroutine init

   !> Coefficients, residual, scale and cavitated nodes of a state whose film belongs to its pressure.
   subroutine evaluate(self, problem, given, state)
      class(equations_t), intent(inout) :: self
      type(contact_problem_t), intent(in) :: problem
      type(given_t), intent(in) :: given
      type(state_t), intent(in) :: state
      integer :: j

      if (checks) call check_shapes(self, given, state)
      call self%flow%evaluate(problem%rheology, problem%conditions%lambdabar, state%p, state%h, problem%heat)
      if (.not. problem%rheology%is_newtonian()) then
         call self%flow%evaluate_faces(problem%film_flow, problem%grid, self%mesh%kappa, problem%heat)
      else if (problem%grid%is_fitted) then
         call self%flow%fit(problem%grid, problem%conditions%lambdabar)
      end if
      call self%set_scale(abs(given%transport%w0))
      if (given%conserves_oil()) then
         call driven_flow(self%mesh, self%flow, self%residual)
         if (.not. allocated(self%content)) self%content = new_content(problem%grid)
         call self%content%carry(problem%grid, given%transport, given%supply, state%p, self%scale, self%flow%f, &
                                 self%residual)
         self%is_cavitated = self%content%is_partial
         self%is_cavitated(0, :) = .false.
      else
         if (allocated(self%content)) deallocate (self%content)
         call reynolds_residual(self%mesh, given%transport, self%flow, self%residual)
         !$omp parallel do schedule(static) if (is_shared(size(state%p)))
         do j = 0, problem%grid%ny
            self%is_cavitated(:, j) = self%scale(:, j) > 0 .and. &
                                      state%p(:, j) + self%scale(:, j)*self%residual(:, j) <= 0
            if (allocated(given%is_empty)) &
               self%is_cavitated(:, j) = self%is_cavitated(:, j) .or. given%is_empty(:, j)
         end do
      end if
      self%edges = problem%edges
      call self%edges%compare(given, state%p, state%h, self%edge_excess, self%edge_slope)
      if (allocated(given%supply)) &
         call self%edges%run_dry(given%supply, state%p, state%h, self%edge_excess, self%edge_slope, self%edge_unit)
   end subroutine evaluate

   !> Preconditions of an evaluation: given data and state belong to the grid.
   pure subroutine check_shapes(self, given, state)
      class(equations_t), intent(in) :: self
      type(given_t), intent(in) :: given
      type(state_t), intent(in) :: state
      call assert(allocated(self%residual), 'equations%evaluate: init came first')
      call assert(all(shape(state%p) == shape(self%residual)) .and. all(shape(state%h) == shape(self%residual)), &
                  'equations%evaluate: a state of this grid')
      call assert(ubound(given%transport%w0, 1) == self%mesh%grid%nx, 'equations%evaluate: given for this grid')
      if (allocated(given%rough)) call assert(all(shape(given%rough) == shape(self%residual)), &
                                              'equations%evaluate: roughness on this grid')
   end subroutine check_shapes

   !> Update the flow linearly for a change of the state, in place of an evaluation; everything else keeps its values.
   subroutine follow(self, state)
      class(equations_t), intent(inout) :: self
      type(state_t), intent(in) :: state
      call follow_state(self%mesh, self%flow, state%p, state%h)
   end subroutine follow

   !> Operations of the last evaluation, see `ehlwave_work_unit`.
   pure real(dp) function work(self)
      class(equations_t), intent(in) :: self
      work = real(evaluation_operations, dp)*size(self%is_cavitated) + self%flow%film_work()
   end function work

   !> Coefficients and cavitated nodes of the next finer grid, at the nodes of this one.
   subroutine inject_from(self, fine)
      class(equations_t), intent(inout) :: self
      class(equations_t), intent(in) :: fine
      call self%flow%inject_from(fine%flow, self%mesh%grid)
      self%is_cavitated = fine%is_cavitated(::2, ::self%mesh%grid%row_ratio)
      if (.not. allocated(fine%content)) then
         if (allocated(self%content)) deallocate (self%content)
         return
      end if
      if (.not. allocated(self%content)) self%content = new_content(self%mesh%grid)
      call self%content%inject_from(fine%content, self%mesh%grid%row_ratio)
   end subroutine inject_from

   !> Keep linear changes only: there is no further evaluation before `init`.
   subroutine keep_changes(self)
      class(equations_t), intent(inout) :: self
      call self%flow%keep_changes()
      deallocate (self%residual, self%scale)
   end subroutine keep_changes

   !> Free the scale where linear changes only are kept, until it is set again.
   subroutine drop_scale(self)
      class(equations_t), intent(inout) :: self
      if (.not. allocated(self%residual)) deallocate (self%scale)
   end subroutine drop_scale

   !> Scale at the state last evaluated, for wedge weights of any kind.
   subroutine set_scale(self, wedge)
      class(equations_t), intent(inout) :: self
      real(dp), intent(in) :: wedge(0:)   !! (0:nx) modulus of the weight of a node's own rho H
      if (.not. allocated(self%scale)) call self%mesh%grid%new_field(self%scale)
      call reynolds_scale(self%mesh, wedge, self%self_influence, self%flow, self%scale)
   end subroutine set_scale

   !> Residual of the load balance; of a flooded domain with the load that is borne outside.
   real(dp) function load_residual(self, given, state)
      class(equations_t), intent(in) :: self
      type(given_t), intent(in) :: given
      type(state_t), intent(in) :: state
      load_residual = given%load%residual(self%mesh%grid%integral(state%p), state%delta)
      if (self%edges%count() > 0) load_residual = load_residual + self%edges%load
   end function load_residual

end module ehlwave_equations
