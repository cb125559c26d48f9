!> The last period of a march: values a period earlier, whether steps meet it or not.
program test_last_period
   use ehlwave_kinds, only: dp, pi
   use ehlwave_lagrange, only: lagrange_weights
   use ehlwave_last_period, only: last_period_t
   use ehlwave_state, only: state_t
   use testing, only: test_t
   implicit none (type, external)

   type(test_t) :: test

   call check_weights()
   call check_period(32.0_dp, 32, 1e-6_dp)     ! in steps; samples kept of it; in single precision
   call check_period(16.0_dp/3, 6, 0.06_dp)    ! six samples to a period
   call check_period(70.3_dp, 24, 2e-3_dp)     ! every third step
   call check_short(1e-3_dp)                   ! far below a step: such waves are not resolved
   call check_short(1e-9_dp)
   call test%finish()

contains

   !> A period far below a time step: each step is a sample.
   subroutine check_short(period)
      real(dp), intent(in) :: period   !! in steps
      type(last_period_t) :: last
      real(dp) :: delta, ones(0:1, 0:0), p(0:1, 0:0)
      integer :: k

      ones = 1
      call last%begin(period, 1.0_dp, 1, 0)
      do k = 1, 10
         call last%keep(real(k, dp), state_t(p=ones, h=ones, delta=1.0_dp))
      end do
      call test%check(last%is_known(), 'samples of a short period')
      call last%look_up(11.0_dp, p, delta)
      call test%check_close(delta, 1.0_dp, 'a constant a short period before', relative=1e-12_dp)
   end subroutine check_short

   !> A polynomial of degree points - 1.
   subroutine check_weights()
      real(dp) :: t
      integer :: n
      t = 2.3_dp
      call test%check_close(dot_product(lagrange_weights(5, t), [((n - 1.5_dp)**4, n=0, 4)]), (t - 1.5_dp)**4, 'quartic', &
                            relative=1e-13_dp)
   end subroutine check_weights

   !> A wave of a single period: looked up as soon as it can be, and from then on.
   subroutine check_period(period, most, tolerance)
      real(dp), intent(in) :: period          !! in steps
      integer, intent(in) :: most             !! samples of a period
      real(dp), intent(in) :: tolerance       !! tolerance of the values
      real(dp), parameter :: dt = 0.25_dp
      type(last_period_t) :: last
      real(dp) :: delta, largest, p(0:1, 0:0)
      integer :: k, n, first

      call test%check(.not. last%is_known(), 'nothing before it begins')
      call last%begin(period*dt, dt, 1, 0)
      largest = 0
      first = 0
      do k = 1, ceiling(3*period) + 10
         if (last%is_known()) then
            if (first == 0) first = k
            do n = 0, 3
               call last%look_up((k - n)*dt, p, delta)
               largest = max(largest, maxval(abs(p - wave(k - n, period))), abs(delta - wave(k - n, period)))
            end do
         end if
         call last%keep(k*dt, state_t(p=reshape([1, 1], [2, 1])*wave(k, period), h=p, delta=wave(k, period)))
      end do
      ! six samples more than a period, for the interpolation, and two by rounding
      call test%check(first > period .and. first <= period*(1 + 8.0_dp/most) + 1, 'known after a period and a few samples')
      call test%check(largest > 0 .and. largest <= tolerance, 'what was a period before')
   end subroutine check_period

   real(dp) function wave(step, period)
      integer, intent(in) :: step
      real(dp), intent(in) :: period
      wave = cos(2*pi*step/period)
   end function wave

end program test_last_period
