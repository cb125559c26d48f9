!> Moving and standing patterns, theory eq. (12) and (13).
program test_waviness
   use ehlwave_kinds, only: dp, pi
   use ehlwave_waviness, only: new_waviness, no_waviness, waviness_t
   use testing, only: test_t
   implicit none (type, external)

   real(dp), parameter :: x(5) = [-2.5_dp, -1.0_dp, 0.0_dp, 0.3_dp, 1.5_dp], y(3) = [-0.4_dp, 0.0_dp, 0.4_dp]
   type(test_t) :: test

   call check_smooth()
   call check_front()
   call check_carried_pattern()
   call check_standing()
   call check_oblique()
   call test%finish()

contains

   subroutine check_smooth()
      type(waviness_t) :: none
      none = no_waviness()
      call test%check(all(abs(none%shape_at(x, y, 3.0_dp)) <= 0), 'no waviness, moving')
      call test%check(all(abs(none%shape_fixed(x, y, 0.0_dp)) <= 0), 'no waviness, standing')
      call test%check(.not. none%moves() .and. none%is_symmetric(), 'no waviness stands still and is even')
   end subroutine check_smooth

   subroutine check_front()
      type(waviness_t) :: wave
      real(dp) :: shape(5, 3)
      wave = new_waviness(0.5_dp, 0.0_dp, .false., -2.5_dp, 1.0_dp)
      shape = wave%shape_at(x, y, 0.0_dp)
      call test%check_close(shape(1, 2), 1.0_dp, 'the front stands at Xs at T = 0', relative=1e-15_dp)
      call test%check(all(abs(shape(2:, :)) < 1e-80_dp), 'nothing ahead of it')
      ! a quarter wave ahead of the front the cosine is 0, half a wave ahead it is -10^(-2.5)
      shape = wave%shape_at([-2.375_dp, -2.25_dp, -2.5_dp, -2.5_dp, -2.5_dp], y, 0.0_dp)
      call test%check_close(shape(:2, 1), [0.0_dp, -10**(-2.5_dp)], 'ahead of the front', absolute=1e-15_dp)
      ! after T the front is at Xs + S T
      wave = new_waviness(0.5_dp, 0.0_dp, .false., -2.5_dp, 1.5_dp)
      shape = wave%shape_at(x, y, 1.0_dp)
      call test%check_close(shape(2, 1), 1.0_dp, 'the front moves with the slip', relative=1e-14_dp)
      call test%check_close(wave%period(), 0.5_dp/1.5_dp, 'period', relative=1e-15_dp)
   end subroutine check_front

   !> Behind the front the pattern depends on X - S T only, so it repeats after a period.
   subroutine check_carried_pattern()
      type(waviness_t) :: wave
      real(dp) :: now(5, 3), later(5, 3)
      integer :: i, j
      wave = new_waviness(0.7_dp, 0.3_dp, .false., -2.5_dp, 0.5_dp)
      now = wave%shape_at(x, y, 20.0_dp)
      later = wave%shape_at(x, y, 20 + wave%period())
      call test%check_close(reshape(later, [15]), reshape(now, [15]), 'periodic', absolute=1e-12_dp)
      do j = 1, 3
         do i = 1, 5
            call test%check_close(now(i, j), cos(2*pi*(x(i) + 2.5_dp - 10)/0.7_dp)*cos(2*pi*y(j)/0.3_dp), 'eq. (12)', &
                                  absolute=1e-12_dp)
         end do
      end do
      call test%check_close(now(:, 1), now(:, 3), 'even in Y', absolute=1e-15_dp)
      call test%check(wave%moves() .and. wave%is_symmetric(), 'isotropic patterns move and are even')
   end subroutine check_carried_pattern

   subroutine check_standing()
      type(waviness_t) :: wave
      real(dp) :: crest(5, 3), trough(5, 3)
      wave = new_waviness(0.0_dp, 0.3_dp, .false., -2.5_dp, 1.0_dp)
      call test%check(.not. wave%moves(), 'longitudinal patterns stand still')
      crest = wave%shape_fixed(x, y, 0.0_dp)
      trough = wave%shape_fixed(x, y, pi)
      call test%check_close(crest(3, 2), 1.0_dp, 'a crest at the origin', relative=1e-15_dp)
      call test%check_close(reshape(trough, [15]), -reshape(crest, [15]), 'half a turn makes crests troughs', absolute=1e-15_dp)
      call test%check_close(reshape(wave%shape_at(x, y, 7.0_dp), [15]), reshape(crest, [15]), 'no front along Y', &
                            absolute=1e-15_dp)
      wave = new_waviness(0.5_dp, 0.0_dp, .false., -2.5_dp, 0.0_dp)
      call test%check(.not. wave%moves(), 'no slip, no motion')
      crest = wave%shape_fixed(x, y, pi/2)
      call test%check_close(crest(3, 2), 0.0_dp, 'a quarter turn', absolute=1e-15_dp)
   end subroutine check_standing

   subroutine check_oblique()
      type(waviness_t) :: wave
      real(dp) :: shape(5, 3)
      wave = new_waviness(0.7_dp, 0.3_dp, .true., -2.5_dp, 1.0_dp)
      call test%check(.not. wave%is_symmetric(), 'an oblique pattern is not even')
      shape = wave%shape_fixed(x, y, 0.0_dp)
      call test%check_close(shape(4, 1), cos(2*pi*(0.3_dp/0.7_dp - 0.4_dp/0.3_dp)), 'one plane wave', absolute=1e-14_dp)
      wave = new_waviness(0.7_dp, 0.0_dp, .true., -2.5_dp, 1.0_dp)
      call test%check(wave%is_symmetric(), 'oblique needs both wavelengths')
   end subroutine check_oblique

end program test_waviness
