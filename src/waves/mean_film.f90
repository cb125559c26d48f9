!> What small waves change in the mean, to second order in their amplitude: one more linear solve.
!>
!> With the steady state u0, the linear response u1 to a pattern of amplitude A, and J0 the Jacobian of the steady state,
!>
!>     u2 = -J0^(-1) < R(u0 + A Re(u1 exp(-i phi))) - R(u0) >,    the mean over phases phi.
!>
!> The derivative in time has no mean. Four phases see all that is of second order. A pattern that varies along Y only
!> stands still: its mean is that of crest and trough, two phases.
module ehlwave_mean_film
   use ehlwave_cycle_settings, only: diagonal_shift, newton_cycle
   use ehlwave_given, only: given_t
   use ehlwave_harmonic_response, only: harmonic_response_t
   use ehlwave_hierarchy, only: level_t
   use ehlwave_kinds, only: dp, pi
   use ehlwave_real_gmres, only: gmres_t
   use ehlwave_real_linearised_contact, only: linearised_contact_t, set_wedge
   use ehlwave_state, only: state_t
   use ehlwave_status, only: status_converged, status_not_finite, status_stalled
   use ehlwave_transport, only: steady_transport
   use ehlwave_waviness, only: waviness_t
   implicit none (type, external)
   private
   public :: has_mean

   real(dp), parameter :: tolerance = 1e-4_dp   !! of the linear residual

   !> Amplitude over H(0,0) at which the mean residual is taken, before it is scaled with the square of the amplitude. At the
   !> steep end of the pressure large waves leave the range of the second order: M = 100, D = 1, transverse, 0.5 a, 65 x 65
   !> nodes, rise over Ai at Ai = 0.2 H(0,0): 0.0362 taken at 0.2, 0.0393 at 0.02 and below, 0.0389 in a long march.
   real(dp), parameter :: probe_over_film = 0.005_dp

   !> Change of the mean and, with it, the thinnest film that occurs.
   type, public :: mean_change_t
      integer :: status = status_stalled   !! converged, stalled or not finite
      integer :: linear_steps = 0          !! GMRES steps
      real(dp) :: film = 0                 !! of H(0,0)
      real(dp) :: smallest_film = 0        !! smallest H over all nodes and phases, to second order
      real(dp) :: smallest_at(2) = 0       !! its X and Y
   end type mean_change_t

   !> The steady contact linearised about its solution, for all patterns.
   type, public :: mean_film_solver_t
      type(linearised_contact_t), private :: linear
      type(gmres_t), private :: gmres
      type(state_t), private :: state
      logical, private :: is_factorised = .false.   ! without a diagonal shift
   contains
      procedure :: init
      procedure :: solve
   end type mean_film_solver_t

contains

   !> Whether a pattern has a mean in this sense: it moves, or varies along Y only.
   pure logical function has_mean(waviness)
      type(waviness_t), intent(in) :: waviness
      has_mean = waviness%moves() .or. .not. waviness%wavelength_x > 0
   end function has_mean

   !> Linearise about the steady state of the finest of `levels`, of smooth surfaces.
   subroutine init(self, levels)
      class(mean_film_solver_t), intent(inout) :: self
      type(level_t), intent(inout), target :: levels(:)   !! coarsest first
      integer :: n

      n = size(levels)
      self%is_factorised = .false.
      self%state = levels(n)%state
      associate (linear => self%linear, problem => levels(n)%problem)
         call linear%init(levels, newton_cycle)
         call linear%start(n)
         linear%levels(n)%equations%given = given_t(transport=steady_transport(problem%grid))
         call problem%film_of(linear%levels(n)%equations%given, self%state%p, self%state%delta, self%state%h)
         call set_wedge(linear)
      end associate
   end subroutine init

   !> Mean change by a pattern that `has_mean`. The factors are kept for the next one.
   subroutine solve(self, levels, response, waviness, amplitude, change)
      class(mean_film_solver_t), intent(inout) :: self
      type(level_t), intent(inout), target :: levels(:)   !! those of `init`: their deformation is used
      type(harmonic_response_t), intent(in) :: response   !! converged, to this pattern
      type(waviness_t), intent(in) :: waviness
      real(dp), intent(in) :: amplitude                   !! Ai in units of c
      type(mean_change_t), intent(out) :: change
      real(dp), allocatable, target :: b(:), x(:)
      real(dp), allocatable :: dh(:, :)
      real(dp), pointer, contiguous :: q(:, :)
      real(dp) :: probe
      integer :: rung

      associate (linear => self%linear, grid => levels(size(levels))%problem%grid)
         allocate (b(linear%n), x(linear%n), dh(0:grid%nx, 0:grid%ny))
         probe = probe_over_film*grid%value_at_centre(self%state%h)
         call mean_residual(self, levels(size(levels)), response, merge(4, 2, waviness%moves()), probe, b)
         b = (amplitude/probe)**2*b
         call linear%borrow(levels)
         do rung = 1, size(diagonal_shift)
            if (rung > 1 .or. .not. self%is_factorised) call linear%factorise(rung)
            self%is_factorised = rung == 1
            call self%gmres%solve(linear, b, x, tolerance)
            change%linear_steps = change%linear_steps + self%gmres%steps
            if (self%gmres%steps > 0 .and. self%gmres%reduction <= tolerance) exit
         end do
         if (self%gmres%steps == 0) then
            change%status = status_not_finite
         else if (self%gmres%reduction <= tolerance) then
            change%status = status_converged
         end if
         q(0:grid%nx, 0:grid%ny) => x(:linear%n - 1)
         call linear%film_change(q, x(linear%n), dh)
         call linear%release()
         change%film = grid%value_at_centre(dh)
         dh = self%state%h + dh - amplitude*abs(response%h)
         change%smallest_film = minval(dh)
         associate (place => minloc(dh))
            change%smallest_at = [grid%x(place(1) - 1), grid%y(place(2) - 1)]
         end associate
      end associate
   end subroutine solve

   !> Right side: minus the mean over the phases of what waves change in the weighted residual; 0 at cavitated nodes, in
   !> the load row and at flooded edges, whose pressure is small and changes by (h/H)^2 of it. The equations are left evaluated at the steady state.
   subroutine mean_residual(self, level, response, phases, amplitude, b)
      class(mean_film_solver_t), intent(inout) :: self
      type(level_t), intent(in) :: level           !! the finest
      type(harmonic_response_t), intent(in) :: response
      integer, intent(in) :: phases
      real(dp), intent(in) :: amplitude
      real(dp), intent(out), contiguous, target :: b(:)
      real(dp), pointer, contiguous :: r(:, :)
      type(state_t) :: state
      complex(dp) :: factor
      integer :: k

      associate (linear => self%linear, equations => self%linear%levels(self%linear%finest)%equations, &
                 grid => level%problem%grid)
         r(0:grid%nx, 0:grid%ny) => b(:linear%n - 1)
         b = 0
         state = self%state
         do k = 0, phases - 1
            factor = amplitude*exp(cmplx(0, -2*pi*k/phases, dp))
            state%p = self%state%p + real(factor*response%p, dp)
            state%h = self%state%h + real(factor*response%h, dp)
            call equations%evaluate(level%problem, state)
            r = r - equations%residual/phases
         end do
         call equations%evaluate(level%problem, self%state)
         call linear%weigh(linear%finest)
         r = merge(0.0_dp, (r + equations%residual)*linear%levels(linear%finest)%row_scale, equations%is_cavitated)
      end associate
   end subroutine mean_residual

end module ehlwave_mean_film
