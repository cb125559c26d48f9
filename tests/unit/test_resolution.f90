!> Verdicts on grids and time steps.
program test_resolution
   use ehlwave_conditions, only: conditions_from_moes, conditions_t
   use ehlwave_errors, only: error_t
   use ehlwave_kinds, only: dp
   use ehlwave_resolution, only: inlet_gap, inlet_length, judge_resolution, resolution_t, &
      closing_reason, touching_reason
   use ehlwave_surfaces, only: surfaces_t
   use ehlwave_waviness, only: new_waviness, no_waviness
   use sample_contact, only: make_conditions
   use testing, only: test_t
   implicit none (type, external)

   real(dp), parameter :: h = 0.0625_dp
   type(conditions_t) :: conditions
   type(surfaces_t) :: smooth
   type(test_t) :: test

   smooth%list = [no_waviness()]
   conditions = make_conditions(100.0_dp, 1.0_dp)
   call check_inlet()
   call check_sides()
   call check_domain()
   call check_touching()
   call check_waves()
   call test%finish()

contains

   !> A surface with waves.
   function waves(wavelength_x, wavelength_y, slip) result(surfaces)
      real(dp), intent(in) :: wavelength_x, wavelength_y, slip
      type(surfaces_t) :: surfaces
      allocate (surfaces%list(1), source=new_waviness(wavelength_x, wavelength_y, .false., -2.5_dp, slip))
   end function waves

   subroutine check_inlet()
      type(conditions_t) :: dry
      type(error_t), allocatable :: error
      type(resolution_t) :: r
      call test%check_close(inlet_length(conditions), sqrt(12.05_dp/100), 'inlet sweep', relative=1e-14_dp)
      call conditions_from_moes(100.0_dp, 0.0_dp, 1.0_dp, 2.2e-8_dp, dry, error)
      call test%check_close(inlet_length(dry), dry%lambdabar**0.4_dp, 'isoviscous', relative=1e-14_dp)
      r = judge_resolution(dry, smooth, -2.5_dp, 2.0_dp, h, h, 0.0_dp)
      call test%check(.not. r%is_resolved, 'too coarse without piezoviscosity')
      r = judge_resolution(dry, smooth, -2.5_dp, 2.0_dp, 0.5_dp*h, 0.5_dp*h, 0.0_dp)
      call test%check(r%is_resolved, 'fine enough without piezoviscosity')
      call conditions_from_moes(1000.0_dp, 0.3_dp, 1.0_dp, 2.2e-8_dp, dry, error)
      call test%check_close(inlet_length(dry), dry%lambdabar**0.4_dp, 'nearly isoviscous', relative=1e-14_dp)
      call conditions_from_moes(0.1_dp, 0.0_dp, 1.0_dp, 2.2e-8_dp, dry, error)
      call test%check_close(inlet_length(dry), 1.0_dp, 'at most half the contact', relative=0.0_dp)
      r = judge_resolution(conditions, smooth, -2.5_dp, 2.0_dp, h, h, 0.0_dp)
      call test%check_close(r%inlet, h*sqrt(100/12.05_dp), 'hX over the inlet length', relative=1e-14_dp)
      call test%check(r%is_resolved .and. r%reason == '', 'fine enough')
      r = judge_resolution(conditions, smooth, -2.5_dp, 2.0_dp, 2*h, h, 0.0_dp)
      call test%check(.not. r%is_resolved .and. index(r%reason, 'hX') > 0, 'coarse inlet')
   end subroutine check_inlet

   subroutine check_sides()
      type(resolution_t) :: r
      real(dp) :: inlet
      inlet = inlet_length(conditions)
      r = judge_resolution(conditions, smooth, -2.5_dp, 2.0_dp, 0.2_dp*inlet, 0.39_dp*inlet, 0.0_dp)
      call test%check(r%is_resolved, 'sides fine enough')
      r = judge_resolution(conditions, smooth, -2.5_dp, 2.0_dp, 0.2_dp*inlet, 0.41_dp*inlet, 0.0_dp)
      call test%check(.not. r%is_resolved .and. index(r%reason, 'hY') > 0, 'coarse sides')
   end subroutine check_sides

   subroutine check_domain()
      type(conditions_t) :: light
      type(error_t), allocatable :: error
      type(resolution_t) :: r
      call conditions_from_moes(3.0_dp, 0.0_dp, 0.04_dp, 2.2e-8_dp, light, error)
      r = judge_resolution(light, smooth, -2.5_dp, 2.0_dp, 0.1_dp*h, h, 0.0_dp)
      call test%check(.not. r%is_resolved .and. index(r%reason, 'x_min') > 0, 'a film thicker than the inlet')
      call conditions_from_moes(3.0_dp, 0.0_dp, 1.0_dp, 2.2e-8_dp, light, error)
      r = judge_resolution(light, smooth, -8.0_dp, 8.0_dp, 0.5_dp*h, h, 0.0_dp)
      call test%check(r%inlet_gap > 8 .and. .not. r%is_resolved .and. index(r%reason, 'rigid') > 0, 'a thick film')
      r = judge_resolution(light, smooth, -16.0_dp, 16.0_dp, 0.5_dp*h, h, 0.0_dp)
      call test%check(r%is_resolved, 'a thick film with room')
      r = judge_resolution(light, smooth, -16.0_dp, 8.0_dp, 0.5_dp*h, h, 0.0_dp)
      call test%check(.not. r%is_resolved, 'a thick film without room on its sides')
      call test%check(inlet_gap(light, -5.0_dp) > 4*inlet_gap(light, -2.5_dp), 'the gap widens with the square of X')
      call test%check_close(inlet_gap(light, -1.0_dp), 0.0_dp, 'no gap at the edge of the contact', absolute=1e-12_dp)
      r = judge_resolution(conditions, smooth, -2.5_dp, 2.0_dp, h, h, 0.0_dp)
      call test%check(r%inlet_gap > 8, 'flooded at M = 100')
      r = judge_resolution(make_conditions(50.0_dp, 0.04_dp), smooth, -2.5_dp, 2.0_dp, 0.1_dp*h, h, 0.0_dp)
      call test%check(r%is_resolved .and. r%inlet_gap < 8, 'not flooded but usable: the lightest contact of the paper')
   end subroutine check_domain

   subroutine check_touching()
      call test%check(touching_reason(0.004_dp, 0.1_dp) == '', 'a film of 4 per cent')
      call test%check(index(touching_reason(0.002_dp, 0.1_dp), 'falls to 2 per cent') > 0, 'a film of 2 per cent')
      call test%check(closing_reason(0.004_dp, 0.1_dp) == '', 'a smallest smooth film of 4 per cent')
      call test%check(index(closing_reason(0.002_dp, 0.1_dp), 'is 2 per cent') > 0, 'one of 2 per cent')
   end subroutine check_touching

   subroutine check_waves()
      type(resolution_t) :: r
      r = judge_resolution(conditions, waves(0.5_dp, 0.0_dp, 1.0_dp), -2.5_dp, 2.0_dp, h, h, h)
      call test%check_close([r%points_x, r%points_y, r%samples], [8.0_dp, 0.0_dp, 8.0_dp], 'exactly 8 points', absolute=1e-12_dp)
      call test%check(r%is_resolved, '8 points are enough')
      r = judge_resolution(conditions, waves(0.49_dp, 0.0_dp, 1.0_dp), -2.5_dp, 2.0_dp, h, h, 0.5_dp*h)
      call test%check(.not. r%is_resolved .and. index(r%reason, 'along X') > 0, 'too few along X')
      r = judge_resolution(conditions, waves(2.0_dp, 0.4_dp, 1.0_dp), -2.5_dp, 2.0_dp, h, h, h)
      call test%check(.not. r%is_resolved .and. index(r%reason, 'along Y') > 0 .and. index(r%reason, 'along X') == 0, &
                      'too few along Y')
      r = judge_resolution(conditions, waves(0.6_dp, 0.0_dp, 1.0_dp), -2.5_dp, 2.0_dp, h, h, 2*h)
      call test%check(.not. r%is_resolved .and. index(r%reason, 'time steps') > 0, 'too few time steps')
      r = judge_resolution(conditions, waves(0.9_dp, 0.0_dp, 2.0_dp), -2.5_dp, 2.0_dp, h, h, 0.5_dp*h)
      call test%check(.not. r%is_resolved .and. index(r%reason, 'along X') > 0, 'slip excites shorter waves')
      r = judge_resolution(conditions, waves(0.0_dp, 0.6_dp, 1.0_dp), -2.5_dp, 2.0_dp, h, h, 0.0_dp)
      call test%check(r%is_resolved .and. .not. abs(r%samples) > 0, 'longitudinal needs no time steps')
   end subroutine check_waves

end program test_resolution
