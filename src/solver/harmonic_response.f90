!> Response of a steady contact to small harmonic waviness: one linear system, no time stepping.
module ehlwave_harmonic_response
   use ehlwave_complex_gmres, only: gmres_t
   use ehlwave_full_multigrid, only: level_t
   use ehlwave_harmonic_system, only: harmonic_system_t
   use ehlwave_kinds, only: dp, pi
   use ehlwave_load_balance, only: harmonic_inertia
   use ehlwave_status, only: status_converged, status_not_finite, status_stalled
   use ehlwave_waviness, only: waviness_t
   implicit none (type, external)
   private

   !> What a pattern of amplitude A does to first order in A. The pattern is the real part of
   !>
   !>     A exp(i (kx X - w T)) cos(ky Y)   or   A exp(i (kx X + ky Y - w T))  (oblique),    w = kx S,
   !>
   !> a crest at the origin at T = 0, and P changes by the real part of A p exp(-i w T), likewise H and Delta. The
   !> change of the mean film is of second order in A and not part of this.
   type, public :: harmonic_response_t
      integer :: status = status_stalled             !! converged, stalled or not finite
      complex(dp) :: film = 0                        !! amplitude of H(0,0) over A; its modulus is Ad/Ai
      complex(dp) :: approach = 0                    !! amplitude of Delta over A
      integer :: linear_steps = 0                    !! GMRES steps
      real(dp) :: reduction = 0                      !! of the linear residual
      complex(dp), allocatable :: p(:, :), h(:, :)   !! amplitudes of P and H over A, (0:nx, 0:ny)
   end type harmonic_response_t

   !> The linear system of a steady state. It points at the problems of the levels: do not copy it.
   type, public :: harmonic_solver_t
      ! Of the linear residual. 1e-4 leaves up to 0.3 % where Ad/Ai is a few per cent (2e-4 of Ai), 1e-5 a tenth of that
      ! for one or two steps more.
      real(dp) :: tolerance = 1e-5_dp
      type(harmonic_system_t), private :: system
      type(gmres_t), private :: gmres
   contains
      procedure :: init
      procedure :: respond
   end type harmonic_solver_t

contains

   !> Linearise about the steady state of the finest of `levels`.
   subroutine init(self, levels)
      class(harmonic_solver_t), intent(inout) :: self
      type(level_t), intent(in), target :: levels(:)   !! coarsest first
      call self%system%init(levels)
   end subroutine init

   !> Response to one pattern. It depends on nothing but the steady state and the pattern.
   subroutine respond(self, waviness, natural_frequency, steps_per_cell, response)
      class(harmonic_solver_t), intent(inout) :: self
      type(waviness_t), intent(in) :: waviness
      real(dp), intent(in) :: natural_frequency      !! Omega of the equation of motion; 0: force balance
      integer, intent(in) :: steps_per_cell          !! m for dT = hX/m: enters through the equation of motion only
      type(harmonic_response_t), intent(out) :: response
      complex(dp), allocatable, target :: b(:), x(:)
      complex(dp), allocatable :: dh(:, :), g(:, :)
      complex(dp), pointer, contiguous :: q(:, :)
      complex(dp) :: inertia
      real(dp) :: frequency

      associate (system => self%system, finest => self%system%levels(size(self%system%levels)), &
                 grid => self%system%levels(size(self%system%levels))%problem%grid)
         allocate (b(system%n), x(system%n), g(0:grid%nx, 0:grid%ny), dh(0:grid%nx, 0:grid%ny))
         g = waviness%amplitude_at(grid%x, grid%y)
         frequency = 0
         if (waviness%moves()) frequency = 2*pi*waviness%slip/waviness%wavelength_x
         inertia = 0
         if (natural_frequency > 0) inertia = harmonic_inertia(natural_frequency, grid%hx/steps_per_cell, frequency)
         call system%set_frequency(frequency, grid%hx, inertia)
         call system%gap_change(g, b)
         call self%gmres%solve(system, b, x, self%tolerance)
         response%linear_steps = self%gmres%steps
         response%reduction = self%gmres%reduction
         if (self%gmres%steps == 0) then
            response%status = status_not_finite
         else if (self%gmres%reduction <= self%tolerance) then
            response%status = status_converged
         end if
         q(0:grid%nx, 0:grid%ny) => x(:system%n - 1)
         call finest%film_change(q, x(system%n), dh)
         dh = dh + g
         response%film = cmplx(grid%value_at_centre(real(dh, dp)), grid%value_at_centre(aimag(dh)), dp)
         response%approach = x(system%n)
         allocate (response%p(0:grid%nx, 0:grid%ny), response%h(0:grid%nx, 0:grid%ny))
         response%p = q
         response%h = dh
      end associate
   end subroutine respond

end module ehlwave_harmonic_response
