!> The change of the mean by small waves, to second order in their amplitude: an additional linear solve, theory eq.
!> (S7).
!>
!> With the steady state u0, the linear response u1 to a pattern of amplitude A, and J0 the Jacobian of the steady
!> state,
!>
!>     u2 = -J0^(-1) < R(u0 + A Re(u1 exp(-i phi))) - R(u0) >,    the mean over phases phi.
!>
!> The derivative in time has no mean. Four phases are exact to second order; a stationary pattern takes four places
!> along X. A pattern that varies along Y only takes the mean of crest and trough, two phases.
module ehlwave_mean_film
   use ehlwave_harmonic_response, only: harmonic_response_t
   use ehlwave_hierarchy, only: level_t
   use ehlwave_kinds, only: dp, pi
   use ehlwave_state, only: state_t
   use ehlwave_status, only: status_stalled
   use ehlwave_steady_tangent, only: steady_tangent_t, tangent_change_t
   use ehlwave_waviness, only: waviness_t
   implicit none (type, external)
   private
   public :: find_mean_change

   !> Tolerance of the linear residual: 1e-4 leaves 0.1 % of the rise in the median of 48 cases, but 26 % at M = 50,
   !> D = 0.12, longitudinal, 2.8 a; 1e-5 leaves 0.4 % there, 1e-6 0.1 %. Each costs a GMRES step.
   real(dp), parameter :: tolerance = 1e-6_dp

   !> Amplitude over H(0,0) at which the mean residual is taken, before it is scaled with the square of the amplitude.
   !> At the steep end of the pressure large waves leave the range of the second order: M = 100, D = 1, transverse, 0.5
   !> a, 65 x 65 nodes, rise over Ai at Ai = 0.2 H(0,0): 0.0362 taken at 0.2, 0.0393 at 0.02 and below, 0.0389 in a long
   !> march.
   real(dp), parameter, public :: probe_over_film = 0.005_dp

   !> Change of the mean and, with it, the thinnest film that occurs.
   type, public :: mean_change_t
      integer :: status = status_stalled   !! converged, stalled or not finite
      integer :: linear_steps = 0          !! GMRES steps
      type(state_t) :: state               !! changes of P, H and Delta
      real(dp) :: film = 0                 !! change of H(0,0)
      real(dp) :: smallest_film = 0        !! smallest H over all nodes and phases, to second order
      real(dp) :: smallest_at(2) = 0       !! its X and Y
   end type mean_change_t

contains

   !> Mean change by a pattern.
   subroutine find_mean_change(tangent, levels, response, waviness, amplitude, change)
      type(steady_tangent_t), intent(inout) :: tangent
      type(level_t), intent(inout), target :: levels(:)   !! levels of `tangent`
      type(harmonic_response_t), intent(in) :: response   !! converged, to this pattern
      type(waviness_t), intent(in) :: waviness
      real(dp), intent(in) :: amplitude                   !! Ai in units of c
      type(mean_change_t), intent(out) :: change
      type(tangent_change_t) :: second
      real(dp), allocatable :: b(:), h(:, :)
      real(dp) :: probe

      associate (grid => levels(size(levels))%problem%grid)
         allocate (b(tangent%linear%n))
         probe = probe_over_film*grid%value_at_centre(tangent%state%h)
         call mean_residual(tangent, levels(size(levels)), response, merge(2, 4, waviness%is_longitudinal()), probe, b)
         b = (amplitude/probe)**2*b
         call tangent%solve(levels, b, tolerance, second, in_single=.true.)
         change%status = second%status
         change%linear_steps = second%linear_steps
         change%state = second%state
         change%film = grid%value_at_centre(second%state%h)
         h = tangent%state%h + second%state%h - amplitude*abs(response%h)
         change%smallest_film = minval(h)
         associate (place => minloc(h))
            change%smallest_at = [grid%x(place(1) - 1), grid%y(place(2) - 1)]
         end associate
      end associate
   end subroutine find_mean_change

   !> Right side: minus the mean over the phases of the waves' change of the weighted residual; 0 at cavitated nodes, in
   !> the load row and at flooded edges, whose pressure is small and changes by (h/H)^2 of it.
   subroutine mean_residual(tangent, level, response, phases, amplitude, b)
      type(steady_tangent_t), intent(inout) :: tangent
      type(level_t), intent(inout) :: level        !! the finest
      type(harmonic_response_t), intent(in) :: response
      integer, intent(in) :: phases
      real(dp), intent(in) :: amplitude
      real(dp), intent(out), contiguous, target :: b(:)
      real(dp), pointer, contiguous :: r(:, :)
      type(state_t) :: state
      integer :: k

      associate (finest => tangent%linear%levels(tangent%linear%finest), grid => level%problem%grid)
         r(0:grid%nx, 0:grid%ny) => b(:tangent%linear%n - 1)
         b = 0
         do k = 0, phases - 1
            state = tangent%state
            call response%add_to(state, amplitude*exp(cmplx(0, -2*pi*k/phases, dp)))
            call finest%equations%evaluate(level%problem, tangent%given, state)
            level%problem%deformation%work = level%problem%deformation%work + finest%equations%work()
            r = r - finest%equations%residual/phases
         end do
         call tangent%stand(level)
         r = merge(0.0_dp, (r + finest%equations%residual)*finest%row_scale, finest%equations%is_cavitated)
      end associate
   end subroutine mean_residual

end module ehlwave_mean_film
