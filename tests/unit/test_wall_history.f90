!> Rise of surfaces under heat that changes in time: closed forms.
program test_wall_history
   use ehlwave_kinds, only: dp, pi
   use ehlwave_wall_history, only: new_wall_history, wall_history_t
   use fast_surface, only: fast_limit
   use testing, only: test_t
   implicit none (type, external)

   type(test_t) :: test

   call check_switched_on()
   call check_steady_limit()
   call check_travelling_wave()
   call test%finish()

contains

   !> A step in time under a heat flow at its end: the rise there.
   subroutine pass(wall, heat, rise)
      type(wall_history_t), intent(inout) :: wall
      real(dp), intent(in) :: heat(:, :)
      real(dp), intent(out) :: rise(:, :)
      call wall%go_on()
      rise = wall%rise + wall%own*heat
      call wall%take(heat)
   end subroutine pass

   !> An even flow from t = 0 on leaves 2 q (t/pi)^(1/2) where no point came from outside since; it begins within the first
   !> step, whose flow grows from 0.
   subroutine check_switched_on()
      integer, parameter :: nx = 400, steps = 300
      real(dp), parameter :: hx = 0.01_dp, speed = 0.6_dp, dt = 0.01_dp
      type(wall_history_t) :: wall
      real(dp) :: heat(0:nx, 0:0), rise(0:nx, 0:0), since
      integer :: n

      wall = new_wall_history(nx, 0, hx, speed, dt, 1/sqrt(pi*speed))
      heat = 1
      do n = 1, steps
         call pass(wall, heat, rise)
         if (all(n /= [30, 100, 300])) cycle
         ! flow s/dt up to the first step, then 1: 2 t^(1/2) less the part that is missing
         since = n*dt
         call test%check_close(rise(nx, 0), (4/3.0_dp*(since**1.5_dp - (since - dt)**1.5_dp)/dt)/sqrt(pi), &
                               'even flow switched on', relative=2e-4_dp)
         call test%check_close(rise(nx, 0), 2*sqrt((since - 0.5_dp*dt)/pi), 'and at once', relative=3e-4_dp)
      end do
   end subroutine check_switched_on

   !> A flow that lasts: the rise of a fast moving half-space.
   subroutine check_steady_limit()
      integer, parameter :: nx = 200
      real(dp), parameter :: hx = 0.02_dp, dt = 0.02_dp
      real(dp), parameter :: speeds(3) = [0.13_dp, 1.0_dp, 1.87_dp]
      type(wall_history_t) :: wall
      real(dp) :: heat(0:nx, 0:0), rise(0:nx, 0:0), steady(0:nx), w(0:nx)
      integer :: i, k, n

      do i = 0, nx
         heat(i, 0) = sqrt(max(0.0_dp, 1 - (i*hx - 1.8_dp)**2))**3
      end do
      w = fast_limit(nx, hx)
      do i = 0, nx
         steady(i) = 0.4_dp*dot_product(w(:i), heat(i:0:-1, 0))
      end do
      do k = 1, size(speeds)
         wall = new_wall_history(nx, 0, hx, speeds(k), dt, 0.4_dp)
         do n = 1, nint(1.2_dp*nx*hx/speeds(k)/dt)
            call pass(wall, heat, rise)
         end do
         call test%check_close(rise(:, 0), steady, 'steady limit', absolute=1.5e-3_dp*maxval(steady))
      end do
   end subroutine check_steady_limit

   !> A wave cos(kappa (x - v t)) through a surface of speed u, long after: (pi/(kappa |u - v|))^(1/2) times a wave that
   !> lags by an eighth of its period as the surface sees it. The end of the memory, the time a point has been here, leaves
   !> 1/(kappa |u - v|)/s^(1/2).
   subroutine check_travelling_wave()
      integer, parameter :: nx = 1600, steps = 1500
      real(dp), parameter :: hx = 0.02_dp, dt = 0.02_dp, kappa = 2*pi/0.8_dp, u = 0.7_dp, v = 1.5_dp
      type(wall_history_t) :: wall
      real(dp) :: frequency, heat(0:nx, 0:0), remains, rise(0:nx, 0:0), x(0:nx)
      integer :: i, n

      x = [(i*hx, i=0, nx)]
      wall = new_wall_history(nx, 0, hx, u, dt, 1/sqrt(u))
      do n = 1, steps
         heat(:, 0) = cos(kappa*(x - v*n*dt))
         call pass(wall, heat, rise)
      end do
      frequency = kappa*abs(u - v)
      remains = 1.5_dp/(frequency*sqrt(steps*dt))
      do i = nx - 40, nx
         call test%check_close(rise(i, 0), sqrt(pi/frequency)*cos(kappa*(x(i) - v*steps*dt) + sign(pi/4, v - u)), &
                               'travelling wave', absolute=remains + 3e-3_dp*sqrt(pi/frequency))
      end do
   end subroutine check_travelling_wave

end program test_wall_history
