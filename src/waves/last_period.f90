!> Pressures of the last period of a march, to be looked up a period later.
module ehlwave_last_period
   use ehlwave_byte_stream, only: bytes_t
   use ehlwave_kinds, only: dp, sp
   use ehlwave_lagrange, only: lagrange_weights
   use ehlwave_state, only: state_t
   implicit none (type, external)
   private

   !> Solutions at equal distances in time, a few more than a period of them, in single precision: they are for first
   !> guesses.
   type, public :: last_period_t
      real(dp), private :: period = 0, distance = 0          ! T, the latter between samples
      real(dp), private :: newest = 0                        ! T of the last sample
      integer, private :: steps_per_sample = 1, steps = 0
      integer, private :: samples = 0                        ! taken, the last n of them are there
      real(sp), allocatable, private :: p(:, :, :)           ! (0:nx, 0:ny, 0:n - 1), sample m at m modulo n
      real(dp), allocatable, private :: delta(:)             ! (0:n - 1)
   contains
      procedure :: begin
      procedure :: keep
      procedure :: is_known
      procedure :: look_up
      procedure :: pass
   end type last_period_t

   integer, parameter :: most_samples = 32            !! samples of a period
   integer, parameter :: points = 6                   !! points of the interpolation in time
   real(dp), parameter :: rounding = 1e-6_dp          !! rounding of a number of steps

contains

   !> Begin with nothing.
   subroutine begin(self, period, time_step, nx, ny)
      class(last_period_t), intent(inout) :: self
      real(dp), intent(in) :: period, time_step
      integer, intent(in) :: nx, ny              !! cells of the grid
      integer :: n

      self%samples = 0
      self%steps = 0
      self%period = period
      self%steps_per_sample = max(1, ceiling(period/(time_step*most_samples) - rounding))
      self%distance = self%steps_per_sample*time_step
      n = max(1, ceiling(period/self%distance - rounding)) + points   ! so that three steps back is known, too
      if (allocated(self%p)) deallocate (self%p, self%delta)
      allocate (self%p(0:nx, 0:ny, 0:n - 1), source=0.0_sp)
      allocate (self%delta(0:n - 1), source=0.0_dp)
   end subroutine begin

   !> Take the solution of the next step, if a period has begun.
   subroutine keep(self, t, state)
      class(last_period_t), intent(inout) :: self
      real(dp), intent(in) :: t
      type(state_t), intent(in) :: state
      integer :: place

      if (.not. allocated(self%p)) return
      self%steps = self%steps + 1
      if (modulo(self%steps, self%steps_per_sample) /= 0) return
      place = modulo(self%samples, size(self%delta))
      self%p(:, :, place) = real(state%p, sp)
      self%delta(place) = state%delta
      self%newest = t
      self%samples = self%samples + 1
   end subroutine keep

   !> Whether the solutions a period before the next step and the three steps before that can be looked up.
   pure logical function is_known(self)
      class(last_period_t), intent(in) :: self
      is_known = allocated(self%delta)
      if (is_known) is_known = self%samples >= size(self%delta)
   end function is_known

   !> Pressure and mutual approach a period before T, by a polynomial between samples.
   pure subroutine look_up(self, t, p, delta)
      class(last_period_t), intent(in) :: self
      real(dp), intent(in) :: t
      real(dp), intent(out) :: p(0:, 0:), delta     !! (0:nx, 0:ny)
      real(dp) :: back, weights(0:points - 1)
      integer :: base, j, m, place(0:points - 1)

      back = (self%newest - t + self%period)/self%distance
      base = min(max(floor(back) - points/2 + 1, 0), size(self%delta) - points)
      weights = lagrange_weights(points, back - base)
      place = modulo(self%samples - 1 - base - [(m, m=0, points - 1)], size(self%delta))
      delta = 0
      do m = 0, points - 1
         delta = delta + weights(m)*self%delta(place(m))
      end do
      do j = 0, ubound(p, 2)
         p(:, j) = 0
         do m = 0, points - 1
            p(:, j) = p(:, j) + weights(m)*self%p(:, j, place(m))
         end do
      end do
   end subroutine look_up

   !> Pass the samples, if a period has begun, to the bytes or from them.
   subroutine pass(self, bytes)
      class(last_period_t), intent(inout) :: self
      type(bytes_t), intent(inout) :: bytes
      real(dp), allocatable :: p(:, :, :)

      if (.not. allocated(self%p)) return
      p = self%p
      call bytes%numbers(p)
      self%p = real(p, sp)
      call bytes%numbers(self%delta)
      call bytes%numbers(self%newest)
      call bytes%count(self%steps)
      call bytes%count(self%samples)
   end subroutine pass

end module ehlwave_last_period
