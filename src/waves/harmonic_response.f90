!> The linear response of a contact to small waves: amplitudes and phases of all changes.
module ehlwave_harmonic_response
   use ehlwave_grid, only: grid_t
   use ehlwave_kinds, only: dp
   use ehlwave_state, only: state_t
   use ehlwave_status, only: status_stalled
   implicit none (type, external)
   private

   !> The response to a pattern of amplitude A, to first order in A. The pattern is the real part of, theory eq. (W1),
   !>
   !>     A exp(i (kx X - w T)) cos(ky Y)   or   A exp(i (kx X + ky Y - w T))  (oblique),    w = kx S,
   !>
   !> a crest at the origin at T = 0, and P changes by the real part of A p exp(-i w T), likewise H and Delta. The
   !> change of the mean film is of second order in A and not part of this.
   type, public :: harmonic_response_t
      integer :: status = status_stalled             !! converged, stalled or not finite
      complex(dp) :: film = 0                        !! amplitude of H(0,0) over A; its modulus is Ad/Ai
      complex(dp) :: pressure = 0                    !! amplitude of P(0,0) over A
      complex(dp) :: approach = 0                    !! amplitude of Delta over A
      integer :: linear_steps = 0                    !! GMRES steps
      real(dp) :: reduction = 0                      !! reduction of the linear residual
      complex(dp), allocatable :: p(:, :), h(:, :)   !! amplitudes of P and H over A, (0:nx, 0:ny)
   contains
      procedure :: add_to
      procedure :: take_centre
   end type harmonic_response_t

contains

   !> Add the real part of `factor` times the response, the factor A exp(-i w T) for a pattern of amplitude A at T.
   pure subroutine add_to(self, state, factor)
      class(harmonic_response_t), intent(in) :: self
      type(state_t), intent(inout) :: state
      complex(dp), intent(in) :: factor
      state%p = state%p + real(factor*self%p, dp)
      state%h = state%h + real(factor*self%h, dp)
      state%delta = state%delta + real(factor*self%approach, dp)
   end subroutine add_to

   !> Take the amplitudes at the centre from the fields.
   pure subroutine take_centre(self, grid)
      class(harmonic_response_t), intent(inout) :: self
      type(grid_t), intent(in) :: grid
      self%film = at_centre(grid, self%h)
      self%pressure = at_centre(grid, self%p)
   end subroutine take_centre

   !> Value of a complex field at X = Y = 0.
   pure complex(dp) function at_centre(grid, field)
      type(grid_t), intent(in) :: grid
      complex(dp), intent(in) :: field(0:, 0:)
      at_centre = cmplx(grid%value_at_centre(real(field, dp)), grid%value_at_centre(aimag(field)), dp)
   end function at_centre

end module ehlwave_harmonic_response
