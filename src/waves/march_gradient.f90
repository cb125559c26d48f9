!> Derivatives of a march with waves everywhere, theory eq. (W20): its steps backwards, each with its transposed system.
module ehlwave_march_gradient
   use ehlwave_contact_gradient, only: stand_in_state
   use ehlwave_contact_problem, only: contact_problem_t
   use ehlwave_contact_variant, only: contact_variable_t
   use ehlwave_equations, only: equations_t
   use ehlwave_given, only: given_t
   use ehlwave_grid, only: centre_nodes
   use ehlwave_hierarchy, only: level_t, work_of
   use ehlwave_kinds, only: dp
   use ehlwave_march_recording, only: march_recording_t
   use ehlwave_march_settings, only: march_settings_t
   use ehlwave_marched_step, only: marched_step_t
   use ehlwave_state, only: state_t
   use ehlwave_status, only: status_converged
   use ehlwave_steady_tangent, only: steady_adjoint_t, steady_tangent_t
   use ehlwave_step_systems, only: step_systems_t
   implicit none (type, external)
   private

   real(dp), parameter :: forgotten = 1e-6_dp   !! weight of a step over the largest, from which on none follows
   integer, parameter :: most_marches = 20      !! steps backwards, over the steps of the march

   !> Derivatives of results by variables through the solutions of a march.
   type, public :: march_gradient_t
      real(dp), allocatable :: change(:, :)     !! (results, variables)
      logical :: is_found = .false.
      integer :: solves = 0                     !! transposed solves
      real(dp) :: work = 0                      !! operations of these
      real(dp), allocatable, private :: content(:, :, :, :)    ! weights of rho H, (0:nx, 0:ny, results, steps back)
      real(dp), allocatable, private :: approach(:, :)         ! weights of Delta, (results, steps back)
      real(dp), allocatable, private :: vectors(:, :)          ! (n, results), of the last step
      type(step_systems_t), private :: systems
      real(dp), allocatable, private :: largest(:)             ! right sides, (results)
   contains
      procedure :: find
   end type march_gradient_t

contains

   !> The steps go back as if the march had always repeated, until their weights fade.
   subroutine find(self, levels, settings, recording, steady, variables, film_slopes, first, weights, tolerance)
      class(march_gradient_t), intent(out) :: self
      type(level_t), intent(inout), target :: levels(:)
      type(march_settings_t), intent(in) :: settings
      type(march_recording_t), intent(in) :: recording
      type(state_t), intent(in) :: steady                    !! the steady state
      type(contact_variable_t), intent(in) :: variables(:)
      real(dp), intent(in) :: film_slopes(:)                 !! (variables) d ln of the steady H(0,0)/dx
      integer, intent(in) :: first                           !! first step of the weights
      real(dp), intent(in) :: weights(:, first:)             !! (results, steps) of H(0,0) in the results
      real(dp), intent(in) :: tolerance                      !! of the linear systems
      type(steady_tangent_t), allocatable :: tangent
      type(marched_step_t) :: step
      real(dp) :: largest, norm
      integer :: k

      allocate (tangent)
      associate (level => levels(size(levels)))
         allocate (self%change(size(weights, 1), size(variables)), source=0.0_dp)
         call step%init(level%problem, settings, recording, steady)
         call tangent%init(levels)
         call make_room(self, level%problem, step, size(weights, 1), tangent%linear%n)
         largest = 0
         do k = ubound(weights, 2), first - most_marches*recording%last, -1
            call step%load(level%problem, recording, k)
            call tangent%move_to(level, step%given, step%states(0))
            call solve_step(self, tangent, levels, step%states(0), weights_of(k), tolerance, norm)
            if (.not. self%is_found) return
            largest = max(largest, norm)
            self%is_found = norm <= forgotten*largest .and. k <= first
            if (self%is_found) exit
            call pass_back(self, tangent, step)
            call add_changes(self, tangent, level, step, recording, steady, variables, film_slopes, &
                             weights_of(k))
         end do
      end associate

   contains

      pure function weights_of(k) result(given)
         integer, intent(in) :: k
         real(dp) :: given(size(weights, 1))
         given = 0
         if (k >= first) given = weights(:, k)
      end function weights_of

   end subroutine find

   subroutine make_room(self, problem, step, results, n)
      type(march_gradient_t), intent(inout) :: self
      type(contact_problem_t), intent(in) :: problem
      type(marched_step_t), intent(in) :: step
      integer, intent(in) :: results, n
      associate (nx => problem%grid%nx, ny => problem%grid%ny)
         allocate (self%content(0:nx, 0:ny, results, 0:step%steps_back), source=0.0_dp)
      end associate
      allocate (self%approach(results, 0:step%steps_back), source=0.0_dp)
      allocate (self%vectors(n, results), source=0.0_dp)
      allocate (self%largest(results), source=0.0_dp)
   end subroutine make_room

   !> Transposed solves of a step: weights of its residuals in the results.
   subroutine solve_step(self, tangent, levels, state, weights, tolerance, norm)
      type(march_gradient_t), intent(inout) :: self
      type(steady_tangent_t), intent(inout) :: tangent       !! about the step
      type(level_t), intent(inout), target :: levels(:)
      type(state_t), intent(in) :: state                     !! of the step
      real(dp), intent(in) :: weights(:), tolerance          !! of H(0,0)
      real(dp), intent(out) :: norm                          !! of the vectors
      type(steady_adjoint_t) :: adjoint
      real(dp), allocatable :: h_weight(:, :), q_weight(:, :)
      real(dp) :: weight(centre_nodes)
      integer :: k, node(2, centre_nodes), r

      allocate (h_weight, q_weight, mold=state%h)
      norm = 0
      call self%systems%begin_step()
      associate (flow => tangent%linear%levels(tangent%linear%finest)%equations%flow)
         call levels(size(levels))%problem%grid%centre_weights(node, weight)
         do r = 1, size(weights)
            q_weight = flow%f_p*self%content(:, :, r, 0)
            h_weight = flow%rho*self%content(:, :, r, 0)
            do k = 1, size(weight)
               if (abs(weight(k)) > 0) h_weight(node(1, k), node(2, k)) = &
                  h_weight(node(1, k), node(2, k)) + weights(r)*weight(k)
            end do
            call tangent%solve_transposed(levels, q_weight, h_weight, tolerance, adjoint, self%approach(r, 0), &
                                         self%systems, self%largest(r))
            self%is_found = adjoint%status == status_converged
            if (.not. self%is_found) return
            self%vectors(:, r) = adjoint%vector
            self%solves = self%solves + 1
            self%work = self%work + adjoint%work
            norm = max(norm, norm2(adjoint%vector))
         end do
      end associate
   end subroutine solve_step

   !> Weights of the earlier steps in the residuals of a step.
   subroutine pass_back(self, tangent, step)
      type(march_gradient_t), intent(inout), target :: self
      type(steady_tangent_t), intent(in) :: tangent
      type(marched_step_t), intent(in) :: step
      real(dp), pointer, contiguous :: rows(:, :)
      real(dp), allocatable :: r(:, :)
      integer :: j, l, of

      associate (finest => tangent%linear%levels(tangent%linear%finest), transport => step%given%transport, &
                 back => step%steps_back, n => tangent%linear%n, &
                 grid => tangent%linear%levels(tangent%linear%finest)%equations%mesh%grid)
         allocate (r(0:grid%nx, 0:grid%ny))
         self%content(:, :, :, :back - 1) = self%content(:, :, :, 1:)
         self%approach(:, :back - 1) = self%approach(:, 1:)
         self%content(:, :, :, back) = 0
         self%approach(:, back) = 0
         do of = 1, size(self%vectors, 2)
            rows(0:grid%nx, 0:grid%ny) => self%vectors(:n - 1, of)
            r = merge(0.0_dp, finest%row_scale*rows, finest%equations%is_cavitated)
            r(0, :) = 0
            r(grid%nx, :) = 0
            do j = grid%first_row, grid%last_row
               do l = 1, transport%history_length()
                  call transport%carry_row_transposed(grid, l, r(:, j), self%content(:, j, of, l - 1))
               end do
            end do
            self%approach(of, :2) = self%approach(of, :2) - self%vectors(n, of)*step%given%load%earlier_weights()
         end do
      end associate
   end subroutine pass_back

   !> Add the changes of the residuals and of H(0,0) of a step with the variables, its solutions held.
   subroutine add_changes(self, tangent, level, step, recording, steady, variables, film_slopes, weights)
      type(march_gradient_t), intent(inout), target :: self
      type(steady_tangent_t), intent(in) :: tangent
      type(level_t), intent(inout) :: level
      type(marched_step_t), intent(inout) :: step
      type(march_recording_t), intent(in) :: recording
      type(state_t), intent(in) :: steady                    !! the steady state
      type(contact_variable_t), intent(in) :: variables(:)
      real(dp), intent(in) :: film_slopes(:), weights(:)     !! the latter of H(0,0) in the results
      real(dp), pointer, contiguous :: rows(:, :)
      real(dp), allocatable :: r(:, :)
      type(contact_problem_t) :: problem
      type(equations_t) :: equations
      type(given_t) :: given
      type(marched_step_t) :: other
      type(state_t) :: at_rest
      integer :: i, k, n, of

      associate (finest => tangent%linear%levels(tangent%linear%finest), last => tangent%linear%n)
         allocate (r(0:level%problem%grid%nx, 0:level%problem%grid%ny))
         do n = 1, size(variables)
            if (.not. allocated(variables(n)%variants)) cycle
            do k = 1, size(variables(n)%variants)
               associate (variant => variables(n)%variants(k))
                  call stand_in_state(variables(n), k, level%problem, given, steady, problem, at_rest)
                  call other%vary(problem, step, variables(n), k, film_slopes(n), recording, at_rest)
                  call equations%init(problem)
                  call equations%evaluate(problem, other%given, other%states(0))
                  r = merge(0.0_dp, finest%row_scale*equations%residual, finest%equations%is_cavitated)
                  do i = 1, equations%edges%count()
                     r(equations%edges%i(i), equations%edges%j(i)) = equations%edge_excess(i)
                  end do
                  do of = 1, size(self%vectors, 2)
                     rows(0:problem%grid%nx, 0:problem%grid%ny) => self%vectors(:last - 1, of)
                     self%change(of, n) = self%change(of, n) + variant%weight*(weights(of)* &
                        problem%grid%value_at_centre(other%states(0)%h) - sum(rows*r) - &
                        self%vectors(last, of)*equations%load_residual(other%given, other%states(0)))
                  end do
                  call variables(n)%give_back(level%problem, problem)
               end associate
            end do
         end do
      end associate
   end subroutine add_changes

end module ehlwave_march_gradient
