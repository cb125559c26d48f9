!> Derivatives of a linear response by inputs, theory eq. (W19).
!>
!> The response u1 solves L(u, x) u1 = r(u, x) about the steady state u; T = c u1 is its film at the centre. With
!>
!>     L^T mu = c,    J0^T nu = d/du (mu (L u1 - r)),
!>
!> dT/dx = T_x - mu d/dx (L u1 - r) + nu dR/dx, R(u, x) = 0 the steady equations. Second derivatives are symmetric:
!> d/du (mu L u1) is the derivative of L^T mu along u1, a difference quotient for the real and the imaginary part of u1.
module ehlwave_response_gradient
   use ehlwave_complex_wedge, only: wedge_t
   use ehlwave_contact_gradient, only: variant_equations
   use ehlwave_contact_problem, only: contact_problem_t
   use ehlwave_contact_variant, only: contact_variable_t
   use ehlwave_equations, only: equations_t
   use ehlwave_grid, only: centre_nodes, grid_t
   use ehlwave_harmonic_response, only: harmonic_response_t
   use ehlwave_harmonic_solver, only: harmonic_solver_t
   use ehlwave_hierarchy, only: level_t
   use ehlwave_kinds, only: dp
   use ehlwave_load_balance, only: harmonic_inertia
   use ehlwave_reynolds, only: reynolds_change
   use ehlwave_reynolds_transposed, only: reynolds_transposed
   use ehlwave_state, only: state_t
   use ehlwave_status, only: status_converged, status_stalled
   use ehlwave_steady_tangent, only: steady_adjoint_t
   use ehlwave_transport, only: harmonic_wedge
   use ehlwave_waviness, only: waviness_t
   implicit none (type, external)
   private

   real(dp), parameter :: largest_step = 1e-4_dp   !! of a difference quotient: of a relative film, and of P times the
                                                   !! thickening

   !> Weights of the residuals of a response and of its steady state in the derivatives of T.
   type, public :: response_adjoint_t
      complex(dp), allocatable :: mu(:), nu(:)
      integer :: status = status_stalled
      integer :: solves = 0           !! transposed solves, of which the first is complex
   contains
      procedure :: find
      procedure :: derivative
   end type response_adjoint_t

contains

   !> Solve both transposed systems.
   subroutine find(self, harmonic, levels, waves, response, tolerance)
      class(response_adjoint_t), intent(out) :: self
      type(harmonic_solver_t), intent(inout) :: harmonic   !! about `levels`, with its tangent, at the response
      type(level_t), intent(inout), target :: levels(:)
      type(waviness_t), intent(in) :: waves
      type(harmonic_response_t), intent(in) :: response    !! u1, converged
      real(dp), intent(in) :: tolerance                    !! of the real transposed systems
      complex(dp), allocatable, dimension(:, :) :: h_weight, q_weight
      real(dp), allocatable :: centre(:, :)
      type(steady_adjoint_t) :: imaginary, real_part
      integer :: k, node(2, centre_nodes)
      real(dp) :: weight(centre_nodes)

      associate (grid => levels(size(levels))%problem%grid, tangent => harmonic%tangent)
         call grid%new_field(centre)
         call grid%centre_weights(node, weight)
         do k = 1, size(weight)
            if (abs(weight(k)) > 0) centre(node(1, k), node(2, k)) = centre(node(1, k), node(2, k)) + weight(k)
         end do
         call harmonic%respond_transposed(levels, centre, self%mu, self%status)
         self%solves = 1
         if (self%status /= status_converged) return
         call state_slope(harmonic, levels(size(levels)), waves, response, self%mu, q_weight, h_weight)
         call tangent%solve_transposed(levels, q_weight%re, h_weight%re, tolerance, real_part)
         self%nu = real_part%vector
         self%solves = 2
         self%status = real_part%status
         if (self%status /= status_converged .or. harmonic%is_real) return
         call tangent%solve_transposed(levels, q_weight%im, h_weight%im, tolerance, imaginary)
         self%nu = cmplx(real_part%vector, imaginary%vector, dp)
         self%status = imaginary%status
         self%solves = 3
      end associate
   end subroutine find

   !> d/du (mu (L u1 - r)) by P and by H at the nodes.
   subroutine state_slope(harmonic, level, waves, response, mu, q_weight, h_weight)
      type(harmonic_solver_t), intent(inout) :: harmonic
      type(level_t), intent(inout) :: level
      type(waviness_t), intent(in) :: waves
      type(harmonic_response_t), intent(in) :: response
      complex(dp), intent(in), target, contiguous :: mu(:)
      complex(dp), allocatable, dimension(:, :), intent(out) :: q_weight, h_weight
      complex(dp), pointer, contiguous :: m(:, :)
      complex(dp), allocatable, dimension(:, :) :: rows, q, h, pattern
      real(dp), dimension(harmonic%linear%levels(harmonic%linear%finest)%equations%edges%count()) :: excess, thicker, &
         thinner
      complex(dp) :: factor
      type(equations_t) :: equations
      type(state_t) :: state
      type(wedge_t) :: wedge
      real(dp) :: step
      integer :: k, part

      associate (finest => harmonic%linear%levels(harmonic%linear%finest), base => harmonic%tangent%state, &
                 given => harmonic%tangent%given, problem => level%problem, grid => level%problem%grid)
         allocate (rows, q, h, pattern, q_weight, h_weight, mold=response%h)
         m(0:grid%nx, 0:grid%ny) => mu(:size(mu) - 1)
         rows = merge((0.0_dp, 0.0_dp), finest%row_scale*m, finest%equations%is_cavitated)
         wedge = wedge_of(finest%equations, grid, waves)
         q_weight = 0
         h_weight = 0
         step = largest_step/max(maxval(abs(response%h)/base%h), maxval(abs(response%p))* &
                                 max(1.0_dp, problem%rheology%thickening()))
         call equations%init(problem)
         do part = 0, 3
            factor = (0.0_dp, 1.0_dp)**part                     ! along u1, i u1, -u1, -i u1
            state = base
            state%p = base%p + step*real(conjg(factor)*response%p, dp)
            state%h = base%h + step*real(conjg(factor)*response%h, dp)
            call equations%evaluate(problem, given, state)
            call reynolds_transposed(equations%mesh, wedge, equations%flow, rows, q, h)
            q_weight = q_weight + factor/(2*step)*q
            h_weight = h_weight + factor/(2*step)*h
         end do
         pattern = waves%amplitude_at(grid%x, grid%y)
         associate (edges => finest%equations%edges)
            call edges%compare(given, base%p, (1 + largest_step)*base%h, excess, thicker)
            call edges%compare(given, base%p, (1 - largest_step)*base%h, excess, thinner)
            do k = 1, edges%count()
               if (.not. abs(finest%equations%edge_slope(k)) > 0) cycle
               associate (x => edges%i(k), y => edges%j(k))
                  h_weight(x, y) = h_weight(x, y) + m(x, y)*(response%h(x, y) - pattern(x, y))* &
                                   (thicker(k) - thinner(k))/(2*largest_step*base%h(x, y))
               end associate
            end do
         end associate
      end associate
   end subroutine state_slope

   !> dT/dx.
   subroutine derivative(self, harmonic, level, response, steps_per_cell, variable, slope, flooded_oil, change)
      class(response_adjoint_t), intent(in) :: self
      type(harmonic_solver_t), intent(inout) :: harmonic
      type(level_t), intent(inout) :: level                !! the finest
      type(harmonic_response_t), intent(in) :: response
      integer, intent(in) :: steps_per_cell                !! as in `respond`
      type(contact_variable_t), intent(in) :: variable     !! x
      real(dp), intent(in) :: slope(:), flooded_oil(:)     !! -dR/dx; as in `residual_slope`
      complex(dp), intent(out) :: change
      complex(dp), allocatable, target :: b(:)
      complex(dp), allocatable :: dh(:, :), dr(:, :), edge(:), film(:, :), pattern(:, :)
      complex(dp), pointer, contiguous :: r(:, :)
      type(contact_problem_t) :: problem
      type(equations_t) :: equations
      integer :: i, k

      associate (finest => harmonic%linear%levels(harmonic%linear%finest), n => harmonic%linear%n, &
                 grid => level%problem%grid)
         allocate (b(n), source=(0.0_dp, 0.0_dp))
         allocate (dh, dr, film, pattern, mold=response%h)
         allocate (edge(finest%equations%edges%count()), source=(0.0_dp, 0.0_dp))
         r(0:ubound(dr, 1), 0:ubound(dr, 2)) => b(:n - 1)
         dh = 0
         do k = 1, size(variable%variants)
            associate (variant => variable%variants(k), w => variable%variants(k)%weight)
               call variant_equations(harmonic%tangent, level, variable, k, flooded_oil(k), problem, equations)
               pattern = variant%waves(1)%amplitude_at(grid%x, grid%y)
               call film_of(problem, response, film)
               film = film + pattern
               call reynolds_change(equations%mesh, wedge_of(finest%equations, grid, variant%waves(1)), &
                                    equations%flow, response%p, film, dr)
               r = r - w*dr
               dh = dh + w*film
               do i = 1, size(edge)
                  associate (x => equations%edges%i(i), y => equations%edges%j(i))
                     edge(i) = edge(i) - w*equations%edge_slope(i)*(film(x, y) - pattern(x, y))
                  end associate
               end do
               if (variant%natural_frequency > 0) b(n) = b(n) - w*response%approach* &
                  harmonic_inertia(variant%natural_frequency, grid%hx/steps_per_cell, variant%waves(1)%frequency())
               call variable%give_back(level%problem, problem)
            end associate
         end do
         r = merge((0.0_dp, 0.0_dp), finest%row_scale*r, finest%equations%is_cavitated)
         do i = 1, size(edge)
            r(finest%equations%edges%i(i), finest%equations%edges%j(i)) = edge(i)
         end do
         change = sum(self%mu*b) - sum(self%nu*slope) &
                  + cmplx(grid%value_at_centre(dh%re), grid%value_at_centre(dh%im), dp)
      end associate
   end subroutine derivative

   !> Wedge and squeeze of the changes by a pattern, with the contents of the steady state.
   function wedge_of(equations, grid, waves) result(wedge)
      type(equations_t), intent(in) :: equations  !! at the steady state
      type(grid_t), intent(in) :: grid            !! the finest
      type(waviness_t), intent(in) :: waves
      type(wedge_t) :: wedge
      wedge = harmonic_wedge(grid, waves%frequency(), grid%hx)
      if (allocated(equations%content)) call wedge%set_content(equations%content%is_partial, equations%content%slope)
   end function wedge_of

   !> Film of the response without the pattern, in the problem of a variant.
   subroutine film_of(problem, response, film)
      type(contact_problem_t), intent(inout) :: problem
      type(harmonic_response_t), intent(in) :: response
      complex(dp), intent(out) :: film(0:, 0:)
      real(dp), allocatable, dimension(:, :) :: imaginary, p, real_part

      allocate (imaginary, real_part, mold=real(film, dp))
      p = real(response%p, dp)
      call problem%deformation%apply(p, real_part)
      p = aimag(response%p)
      call problem%deformation%apply(p, imaginary)
      film = cmplx(real_part, imaginary, dp) - response%approach
   end subroutine film_of

end module ehlwave_response_gradient
