!> Unsettled changes of a march that the oil carries: the final film at the centre.
program test_carried_change
   use ehlwave_carried_change, only: carried_change_t
   use ehlwave_grid, only: grid_t, new_grid
   use ehlwave_kinds, only: dp, pi
   use ehlwave_march_settings, only: march_settings_t
   use ehlwave_waviness, only: new_waviness
   use testing, only: test_t
   implicit none (type, external)

   type(test_t) :: test

   call check_wave(0.5_dp, 1.0_dp, 32, 1e-13_dp)     ! wavelength; share; steps; error left
   call check_wave(0.43_dp, 1.0_dp, 30, 1e-2_dp)     ! a period that is no whole number of steps: linear in X
   call check_wave(0.5_dp, 0.0_dp, 32, 1.0_dp)       ! spread as it goes: nothing is corrected
   call test%finish()

contains

   !> A wave and a change that the oil carries: neither fades.
   subroutine check_wave(wavelength, carried, steps, left)
      real(dp), intent(in) :: wavelength        !! over a, of a period that long in pure rolling
      real(dp), intent(in) :: carried           !! rather than spread
      integer, intent(in) :: steps
      real(dp), intent(in) :: left              !! error after the correction, over that before, at most
      type(carried_change_t) :: change
      type(march_settings_t) :: settings
      type(grid_t) :: grid
      real(dp), allocatable :: share(:, :)
      real(dp) :: errors(0:1), films(0:steps)
      integer :: k

      grid = new_grid(-2.5_dp, 1.5_dp, 2.0_dp, 256, 8, is_half=.true.)
      settings%surfaces%list = [new_waviness(wavelength, 0.0_dp, .false., -2.5_dp, 1.0_dp, 0.2_dp)]
      allocate (share(0:grid%nx, 0:grid%ny), source=max(carried, 1e-9_dp))
      call change%begin(grid, settings, share, film(grid, wavelength, 0.0_dp))
      films(0) = grid%value_at_centre(film(grid, wavelength, 0.0_dp))
      do k = 1, steps
         call test%check(.not. change%is_known(k - 1), 'not before a period')
         call change%see(k, film(grid, wavelength, k*grid%hx))
         films(k) = grid%value_at_centre(film(grid, wavelength, k*grid%hx))
      end do
      call test%check(change%is_known(steps), 'known after a period')
      call test%check(change%largest(.true.) <= change%largest(.false.), 'what is corrected counts less')
      errors(0) = maxval([(abs(films(k) - wave(wavelength, -k*grid%hx)), k=steps - 25, steps)])
      call change%correct(films)
      errors(1) = maxval([(abs(films(k) - wave(wavelength, -k*grid%hx)), k=steps - 25, steps)])
      call test%check(errors(0) > 1e-3_dp .and. errors(1) <= left*errors(0), 'the film that the centre comes to')
      if (carried < 0.5_dp) call test%check_close(errors(1), errors(0), 'left as it is', relative=1e-12_dp)
   end subroutine check_wave

   !> H at time t: waves, and a bump that is at X = -0.4 at first.
   function film(grid, wavelength, t)
      type(grid_t), intent(in) :: grid
      real(dp), intent(in) :: wavelength, t
      real(dp) :: film(0:grid%nx, 0:grid%ny)
      film = spread(wave(wavelength, grid%x - t) + 0.01_dp*exp(-100*(grid%x - t + 0.4_dp)**2), 2, grid%ny + 1)
   end function film

   elemental real(dp) function wave(wavelength, x)
      real(dp), intent(in) :: wavelength, x
      wave = 1 + 0.2_dp*cos(2*pi*x/wavelength)
   end function wave

end program test_carried_change
