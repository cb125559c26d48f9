!> A steady contact linearised about its solution: its change for a small change of the equations.
module ehlwave_steady_tangent
   use ehlwave_assertions, only: assert, checks
   use ehlwave_cycle_settings, only: diagonal_shift, newton_cycle
   use ehlwave_given, only: given_t, steady_given
   use ehlwave_hierarchy, only: level_t, work_of
   use ehlwave_kinds, only: dp
   use ehlwave_real_gmres, only: gmres_t
   use ehlwave_real_linearised_contact, only: linearised_contact_t, set_wedge
   use ehlwave_state, only: new_state, state_t
   use ehlwave_status, only: status_converged, status_not_finite, status_stalled
   use ehlwave_step_systems, only: step_systems_t
   implicit none (type, external)
   private

   !> Change of a steady state.
   type, public :: tangent_change_t
      type(state_t) :: state               !! change of P, H and Delta
      integer :: status = status_stalled   !! converged, stalled or not finite
      integer :: linear_steps = 0          !! GMRES steps
      real(dp) :: reduction = 0            !! reduction of the linear residual
   end type tangent_change_t

   !> Solution of the transposed system: the derivative of a result by the weighted residuals.
   type, public :: steady_adjoint_t
      real(dp), allocatable :: vector(:)   !! (linear%n)
      integer :: status = status_stalled   !! converged, stalled or not finite
      integer :: linear_steps = 0          !! GMRES steps
      real(dp) :: work = 0                 !! operations of its solve
   end type steady_adjoint_t

   !> The linear system about a steady state, whose factors serve several right sides.
   type, public :: steady_tangent_t
      type(linearised_contact_t) :: linear
      type(state_t) :: state                        !! the steady state of smooth surfaces
      type(given_t) :: given                        !! data of the steady state, independent of the levels
      type(gmres_t), private :: gmres
      logical, private :: is_factorised = .false.   ! without a diagonal shift
   contains
      procedure :: init
      procedure :: stand
      procedure :: move_to
      procedure :: solve
      procedure :: solve_transposed
   end type steady_tangent_t

contains

   !> Linearise about the steady state of the finest of `levels`, of smooth surfaces.
   subroutine init(self, levels)
      class(steady_tangent_t), intent(inout) :: self
      type(level_t), intent(inout), target :: levels(:)   !! coarsest first
      integer :: n

      n = size(levels)
      self%is_factorised = .false.
      self%state = levels(n)%state
      associate (linear => self%linear, problem => levels(n)%problem)
         call linear%init(levels, newton_cycle)
         call linear%start(n)
         self%given = steady_given(problem%grid, levels(n)%given%supply)
         call problem%film(self%given, self%state%p, self%state%delta, self%state%h)
         call set_wedge(linear, self%given%transport)
      end associate
      call self%stand(levels(n))
   end subroutine init

   !> Have the equations evaluated at the steady state, after they were used elsewhere.
   subroutine stand(self, level)
      class(steady_tangent_t), intent(inout) :: self
      type(level_t), intent(in) :: level   !! the finest
      associate (linear => self%linear)
         call linear%levels(linear%finest)%equations%evaluate(level%problem, self%given, self%state)
         call linear%weigh(linear%finest)
      end associate
   end subroutine stand

   !> Linearise about another state, with data of its own, as of a time step.
   subroutine move_to(self, level, given, state)
      class(steady_tangent_t), intent(inout) :: self
      type(level_t), intent(in) :: level   !! the finest
      type(given_t), intent(in) :: given
      type(state_t), intent(in) :: state   !! with its film
      self%is_factorised = .false.
      self%given = given
      self%state = state
      self%linear%inertia = given%load%inertia
      call set_wedge(self%linear, given%transport)
      call self%stand(level)
   end subroutine move_to

   !> Change of the state whose weighted residuals change by b, with the cavitated nodes as they are.
   subroutine solve(self, levels, b, tolerance, change, in_single)
      class(steady_tangent_t), intent(inout) :: self
      type(level_t), intent(inout), target :: levels(:)   !! levels of `init`: their deformation is used
      real(dp), intent(in), contiguous :: b(:)            !! (linear%n), 0 at cavitated nodes; at flooded edges in units
                                                          !! of P
      real(dp), intent(in) :: tolerance                   !! tolerance of the linear residual
      type(tangent_change_t), intent(out) :: change
      logical, intent(in), optional :: in_single          !! products, whose convolutions are good to 1e-7 then
      real(dp), allocatable, target :: x(:)
      real(dp), pointer, contiguous :: q(:, :)

      if (checks) call assert(size(b) == self%linear%n .and. tolerance > 0, 'tangent%solve: a right side of its system')
      associate (linear => self%linear, grid => levels(size(levels))%problem%grid)
         allocate (x(linear%n))
         call linear%borrow(levels, in_single)
         call find(self, b, tolerance, x, change%status, change%linear_steps)
         change%reduction = self%gmres%reduction
         change%state = new_state(grid)
         q(0:grid%nx, 0:grid%ny) => x(:linear%n - 1)
         change%state%p = q
         change%state%delta = x(linear%n)
         call linear%film_change(change%state%p, change%state%delta, change%state%h)
         call linear%release()
      end associate
   end subroutine solve

   !> Derivative by the weighted residuals of a result whose derivatives by P, H and Delta are given.
   subroutine solve_transposed(self, levels, q_weight, h_weight, tolerance, adjoint, delta_weight, systems, largest)
      class(steady_tangent_t), intent(inout) :: self
      type(level_t), intent(inout), target :: levels(:)          !! levels of `init`: their deformation is used
      real(dp), intent(in) :: q_weight(0:, 0:), h_weight(0:, 0:)
      real(dp), intent(in) :: tolerance                          !! tolerance of the linear residual
      type(steady_adjoint_t), intent(out) :: adjoint
      real(dp), intent(in), optional :: delta_weight             !! besides the film's
      type(step_systems_t), intent(inout), optional :: systems   !! of successive steps, with
      real(dp), intent(inout), optional :: largest               !! their largest right side
      real(dp), allocatable :: c(:)

      adjoint%work = -work_of(levels)
      associate (linear => self%linear)
         allocate (c(linear%n), adjoint%vector(linear%n))
         call linear%borrow(levels)
         call linear%state_weights(q_weight, h_weight, c)
         if (present(delta_weight)) c(linear%n) = c(linear%n) + delta_weight
         linear%is_transposed = .true.
         if (present(systems)) then
            call systems%solve(linear, levels, c, tolerance, largest, adjoint%vector, adjoint%status, &
                               adjoint%linear_steps)
         else
            call find(self, c, tolerance, adjoint%vector, adjoint%status, adjoint%linear_steps)
         end if
         linear%is_transposed = .false.
         call linear%release()
      end associate
      adjoint%work = adjoint%work + work_of(levels)
   end subroutine solve_transposed

   !> Solve the system or, as it is set, the transposed system, with a shifted diagonal if needed.
   subroutine find(self, b, tolerance, x, status, steps)
      type(steady_tangent_t), intent(inout) :: self
      real(dp), intent(in), contiguous :: b(:)
      real(dp), intent(in) :: tolerance
      real(dp), intent(out), contiguous :: x(:)
      integer, intent(out) :: status, steps
      integer :: rung

      status = status_stalled
      steps = 0
      associate (linear => self%linear, gmres => self%gmres)
         do rung = 1, size(diagonal_shift)
            if (rung == 1 .and. self%is_factorised) then
               call linear%count_factors()
            else
               call linear%factorise(rung)
               self%is_factorised = rung == 1
            end if
            call gmres%solve(linear, b, x, tolerance)
            steps = steps + gmres%steps
            if (gmres%steps > 0 .and. gmres%reduction <= tolerance) exit
         end do
         if (gmres%steps == 0) then
            status = status_not_finite
         else if (gmres%reduction <= tolerance) then
            status = status_converged
         end if
      end associate
   end subroutine find

end module ehlwave_steady_tangent
