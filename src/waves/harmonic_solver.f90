!> Linear responses of a contact to small waves, without time steps, theory eq. (W1): GMRES at the frequency of a
!> pattern.
module ehlwave_harmonic_solver
   use ehlwave_assertions, only: assert, checks
   use ehlwave_complex_gmres, only: gmres_t
   use ehlwave_harmonic_operator, only: harmonic_operator_t
   use ehlwave_harmonic_response, only: harmonic_response_t
   use ehlwave_hierarchy, only: level_t, work_of
   use ehlwave_kinds, only: dp, pi
   use ehlwave_load_balance, only: harmonic_inertia
   use ehlwave_status, only: status_converged, status_not_finite, status_stalled
   use ehlwave_steady_tangent, only: steady_adjoint_t, steady_tangent_t, tangent_change_t
   use ehlwave_waviness, only: waviness_t
   implicit none (type, external)
   private

   !> Tolerance of the linear residual: 1e-4 leaves up to 0.3 % where Ad/Ai is a few per cent (2e-4 of Ai), 1e-5 a
   !> tenth of that for one or two more steps.
   real(dp), parameter :: response_tolerance = 1e-5_dp
   real(dp), parameter, public :: least_in_single = 1e-6_dp   !! tolerance down to which products in single precision
                                                              !! serve

   !> Solver of the operator about a steady state; `init` comes first, `respond` sets the frequency.
   type, extends(harmonic_operator_t), public :: harmonic_solver_t
      real(dp) :: tolerance = response_tolerance        !! tolerance of the linear residual
      logical :: in_single = .true.                     !! products, whose convolutions are good to 1e-7 then
      class(steady_tangent_t), allocatable :: tangent   !! for real changes that do not turn, see `find_tangent`
      real(dp), private :: tangent_work = 0             ! operations that it took, if a response found it
      type(gmres_t), private :: gmres
   contains
      procedure :: find_tangent
      procedure :: count_tangent
      procedure :: respond
      procedure :: respond_to
      procedure :: respond_transposed
   end type harmonic_solver_t

contains

   !> Have the real linear system about the same state; it stays until it is deallocated.
   subroutine find_tangent(self, levels)
      class(harmonic_solver_t), intent(inout) :: self
      type(level_t), intent(inout) :: levels(:)   !! levels of `init`, which may come later
      if (allocated(self%tangent)) return
      allocate (self%tangent)
      call self%tangent%init(levels)
   end subroutine find_tangent

   !> Count for a response the work of a tangent that an earlier response found: counts do not depend on their
   !> order.
   subroutine count_tangent(self, levels)
      class(harmonic_solver_t), intent(inout) :: self
      type(level_t), intent(inout) :: levels(:)
      real(dp) :: work_before

      if (allocated(self%tangent)) then
         associate (deformation => levels(size(levels))%problem%deformation)
            deformation%work = deformation%work + self%tangent_work
         end associate
      else
         work_before = work_of(levels)
         call self%find_tangent(levels)
         self%tangent_work = work_of(levels) - work_before
      end if
   end subroutine count_tangent

   !> Response to a pattern. It depends only on the steady state and the pattern: factors of the previous pattern are
   !> used again for the same frequency. For a pattern that varies along Y only, all is real.
   subroutine respond(self, levels, waviness, natural_frequency, steps_per_cell, response)
      class(harmonic_solver_t), intent(inout) :: self
      type(level_t), intent(inout), target :: levels(:)   !! levels of `init`: their deformation is used
      type(waviness_t), intent(in) :: waviness
      real(dp), intent(in) :: natural_frequency      !! Omega of the equation of motion; 0: force balance
      integer, intent(in) :: steps_per_cell          !! m for dT = hX/m: enters through the equation of motion only
      type(harmonic_response_t), intent(out) :: response
      complex(dp), allocatable, target :: b(:)
      complex(dp), allocatable :: g(:, :)
      complex(dp), pointer, contiguous :: dr(:, :)
      complex(dp) :: inertia
      real(dp) :: along, frequency
      integer :: k

      associate (linear => self%linear, grid => self%linear%levels(self%linear%finest)%equations%mesh%grid)
         allocate (b(linear%n), g(0:grid%nx, 0:grid%ny))
         g = waviness%amplitude_at(grid%x, grid%y)
         frequency = waviness%frequency()
         inertia = 0
         if (natural_frequency > 0) inertia = harmonic_inertia(natural_frequency, grid%hx/steps_per_cell, frequency)
         if (waviness%is_longitudinal()) call self%count_tangent(levels)
         along = 0
         if (grid%is_line .and. waviness%wavelength_y > 0) along = 2*pi/waviness%wavelength_y
         call self%set_frequency(levels, frequency, inertia, waviness%is_longitudinal(), along)
         dr(0:grid%nx, 0:grid%ny) => b(:linear%n - 1)
         call linear%gap_change(g, dr)
         associate (edges => linear%levels(linear%finest)%equations%edges)
            do k = 1, edges%count()
               dr(edges%i(k), edges%j(k)) = 0   ! the far field does not see the waves
            end do
         end associate
         dr = -dr
         b(linear%n) = 0
         deallocate (g)                    ! not kept beside the solve
         call self%respond_to(levels, b, response)
         response%h = response%h + waviness%amplitude_at(grid%x, grid%y)
         call response%take_centre(grid)
      end associate
   end subroutine respond

   !> Response of another right side, with the operator of the pattern that was the last.
   subroutine respond_to(self, levels, b, response)
      class(harmonic_solver_t), intent(inout) :: self
      type(level_t), intent(inout), target :: levels(:)   !! levels of `init`
      !> Weighted change of the residuals, 0 at cavitated nodes; on return the change of P and Delta, unless it is real.
      complex(dp), intent(inout), contiguous, target :: b(:)
      type(harmonic_response_t), intent(out) :: response
      complex(dp), pointer, contiguous :: q(:, :)

      if (checks) call assert(size(b) == self%linear%n .and. self%tolerance > 0, &
                              'respond_to: a right side of its system')
      associate (linear => self%linear, grid => self%linear%levels(self%linear%finest)%equations%mesh%grid)
         if (self%is_real) then
            call respond_really(self, levels, real(b, dp), response)
            return
         end if
         call linear%borrow(levels, in_single=self%in_single)
         call self%gmres%solve_in_place(linear, b, self%tolerance)
         response%linear_steps = self%gmres%steps
         response%reduction = self%gmres%reduction
         if (self%gmres%steps == 0) then
            response%status = status_not_finite
         else if (self%gmres%reduction <= self%tolerance) then
            response%status = status_converged
         end if
         q(0:grid%nx, 0:grid%ny) => b(:linear%n - 1)
         allocate (response%p(0:grid%nx, 0:grid%ny), source=q)
         response%approach = b(linear%n)
         allocate (response%h(0:grid%nx, 0:grid%ny))
         call linear%film_change(response%p, response%approach, response%h)
         call linear%release()
         call response%take_centre(grid)
      end associate
   end subroutine respond_to

   !> Derivative by the weighted residuals of a sum of weighted changes of the film, with the operator of the last
   !> pattern.
   subroutine respond_transposed(self, levels, h_weight, vector, status)
      class(harmonic_solver_t), intent(inout) :: self
      type(level_t), intent(inout), target :: levels(:)   !! levels of `init`
      real(dp), intent(in) :: h_weight(0:, 0:)
      complex(dp), allocatable, intent(out) :: vector(:)
      integer, intent(out) :: status                      !! converged, stalled or not finite
      complex(dp), allocatable :: c(:), none(:, :)
      type(steady_adjoint_t) :: adjoint

      status = status_stalled
      if (self%is_real) then
         call self%tangent%solve_transposed(levels, 0*h_weight, h_weight, self%tolerance, adjoint)
         vector = adjoint%vector
         status = adjoint%status
         return
      end if
      associate (linear => self%linear)
         allocate (c(linear%n), vector(linear%n))
         allocate (none(size(h_weight, 1), size(h_weight, 2)), source=(0.0_dp, 0.0_dp))
         call linear%borrow(levels)
         call linear%state_weights(none, none + h_weight, c)
         linear%is_transposed = .true.
         call self%gmres%solve(linear, c, vector, self%tolerance)
         linear%is_transposed = .false.
         call linear%release()
         if (self%gmres%steps == 0) then
            status = status_not_finite
         else if (self%gmres%reduction <= self%tolerance) then
            status = status_converged
         end if
      end associate
   end subroutine respond_transposed

   !> Response of a real right side that does not turn.
   subroutine respond_really(self, levels, b, response)
      class(harmonic_solver_t), intent(inout) :: self
      type(level_t), intent(inout), target :: levels(:)
      real(dp), intent(in), contiguous :: b(:)
      type(harmonic_response_t), intent(inout) :: response
      type(tangent_change_t) :: change

      call self%tangent%solve(levels, b, self%tolerance, change, self%in_single)
      response%status = change%status
      response%linear_steps = change%linear_steps
      response%reduction = change%reduction
      response%p = change%state%p
      response%h = change%state%h
      response%approach = change%state%delta
      call response%take_centre(levels(size(levels))%problem%grid)
   end subroutine respond_really

end module ehlwave_harmonic_solver
