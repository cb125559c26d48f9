!> The last period of a march that repeats, kept to be differentiated.
module ehlwave_march_recording
   use ehlwave_carried_change, only: points
   use ehlwave_hierarchy, only: level_t
   use ehlwave_kinds, only: dp
   use ehlwave_lagrange, only: lagrange_weights
   use ehlwave_march_watcher, only: march_watcher_t
   implicit none (type, external)
   private

   real(dp), parameter :: whole = 1e-9_dp            !! rounding of a number of steps

   type, extends(march_watcher_t), public :: march_recording_t
      integer :: last = -1                           !! the last step
      real(dp) :: time = 0                           !! its T
      real(dp), private :: period = 0                ! steps
      real(dp), allocatable, private :: p(:, :, :)   ! (0:nx, 0:ny, steps)
      real(dp), allocatable, private :: delta(:)
   contains
      procedure :: begin
      procedure :: see
      procedure :: look_up
   end type march_recording_t

contains

   !> Allocate the fields of a march.
   subroutine begin(self, nx, ny, steps, period)
      class(march_recording_t), intent(inout) :: self
      integer, intent(in) :: nx, ny, steps           !! cells of the grid, and steps
      real(dp), intent(in) :: period                 !! after which it repeats, steps
      integer :: first

      first = max(0, steps - ceiling(period) - points)
      if (allocated(self%p)) deallocate (self%p, self%delta)
      allocate (self%p(0:nx, 0:ny, first:steps), self%delta(first:steps))
      self%period = period
      self%last = -1
   end subroutine begin

   !> Keep a solution.
   subroutine see(self, level, step, time)
      class(march_recording_t), intent(inout) :: self
      type(level_t), intent(in) :: level
      integer, intent(in) :: step
      real(dp), intent(in) :: time
      self%last = step
      self%time = time
      if (step < lbound(self%delta, 1)) return
      self%p(:, :, step) = level%state%p
      self%delta(step) = level%state%delta
   end subroutine see

   !> Pressure and approach of a step. Before the steps kept the solution is that of whole periods later, between steps
   !> by a polynomial.
   pure subroutine look_up(self, step, p, delta)
      class(march_recording_t), intent(in) :: self
      integer, intent(in) :: step                    !! at most `last`
      real(dp), intent(out) :: p(0:, 0:), delta      !! (0:nx, 0:ny)
      real(dp) :: place, weights(0:points - 1)
      integer :: base, m

      associate (first => lbound(self%delta, 1))
         place = step
         if (step < first) place = step + self%period*ceiling((first - step)/self%period - whole)
         if (abs(place - nint(place)) < whole*self%period) then
            p = self%p(:, :, nint(place))
            delta = self%delta(nint(place))
            return
         end if
         base = min(max(floor(place) - points/2 + 1, first), self%last - points + 1)
         weights = lagrange_weights(points, place - base)
         p = 0
         delta = 0
         do m = 0, points - 1
            p = p + weights(m)*self%p(:, :, base + m)
            delta = delta + weights(m)*self%delta(base + m)
         end do
      end associate
   end subroutine look_up

end module ehlwave_march_recording
