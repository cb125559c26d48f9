!> Estimates of temperature rises: numbers worked out by hand, limits and scalings.
program test_thermal_estimate
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ehlwave_inlet_law, only: inlet_loss, inlet_t
   use ehlwave_kinds, only: dp
   use ehlwave_thermal_estimate, only: film_rise_k, rough_film_factor, surface_rise_k, thermal_data_t, warm_inlet, warm_inlet_t
   use testing, only: test_t
   implicit none (type, external)

   type(thermal_data_t) :: data
   type(test_t) :: test
   real(dp) :: factor, quarter

   ! Lt = 0.1
   factor = rough_film_factor(0.1_dp, 0.0_dp, 0.005_dp)
   call test%check_close(factor, (1 - 0.066_dp*0.3801894_dp)/(1 + 0.213_dp*0.2290868_dp), 'inlet in pure rolling', relative=1e-6_dp)
   call test%check(rough_film_factor(0.1_dp, 1.0_dp, 0.005_dp) < factor, 'sliding warms the inlet more')
   call test%check_close(rough_film_factor(0.0_dp, 1.0_dp, 0.005_dp), 1.0_dp, 'at rest', relative=1e-15_dp)
   call test%check(rough_film_factor(3e3_dp, 1.0_dp, 0.01_dp) > 0, 'above 0 beyond the range of the fit')
   call check_law()

   ! 50 MPa, 1 m/s and 0.2 um: 10 W/m/(12*0.14 W/(m K))
   call test%check_close(film_rise_k(data, 5e7_dp, 1.0_dp, 2e-7_dp), 10/1.68_dp, 'film over surfaces', relative=1e-12_dp)
   ! q = 5e7 W/m2 over 2 a = 0.4 mm, into surfaces at 1.5 and 0.5 m/s
   call test%check_close(surface_rise_k(data, 5e7_dp, 1.5_dp, 0.5_dp, 2e-4_dp), 29.953438_dp, 'surfaces', relative=1e-5_dp)
   ! the second surface at rest: all heat goes into the first, mean (2/3) of 2 q (t/pi)^(1/2)/effusivity after t = 2 a/u
   call test%check_close(surface_rise_k(data, 5e7_dp, 1.0_dp, 0.0_dp, 2e-4_dp), &
                         2/3.0_dp*2*5e7_dp*sqrt(4e-4_dp/acos(-1.0_dp))/1.3e4_dp, 'one surface alone', relative=1e-12_dp)
   call test%check_close(surface_rise_k(data, 5e7_dp, 1.0_dp, 1.0_dp, 2e-4_dp), 0.0_dp, 'no sliding', absolute=0.0_dp)
   quarter = surface_rise_k(data, 5e7_dp, 1.5_dp, 0.5_dp, 0.5e-4_dp)
   call test%check_close(quarter, 0.5_dp*surface_rise_k(data, 5e7_dp, 1.5_dp, 0.5_dp, 2e-4_dp), 'root of the length', &
                         relative=1e-12_dp)
   call test%finish()

contains

   !> The law of warm inlets within its range, and the lower of two estimates beyond it.
   subroutine check_law()
      type(inlet_t) :: inlet
      type(warm_inlet_t) :: found

      inlet = inlet_t(loading=0.2286_dp, wall=0.08_dp, film=0.46_dp, m=27.0_dp, l=17.0_dp, d=1.0_dp)
      found = warm_inlet(data, inlet, 0.004_dp)
      call test%check(found%film_factor > 0.93_dp .and. found%film_factor < 0.98_dp, 'a ball that rolls')
      call test%check(found%error > 0.002_dp .and. found%error < 0.02_dp, 'and the error')
      call test%check_close(exp(-0.67_dp*0.04_dp*found%rise_k), found%film_factor, 'rise in the inlet', relative=1e-12_dp)
      inlet%wall = 1
      call test%check(inlet_loss(inlet) > 1 - found%film_factor, 'bodies that keep the heat')
      inlet%slide_roll = 1
      found = warm_inlet(data, inlet, 0.004_dp)
      call test%check(found%error > 0.2_dp*(1 - found%film_factor), 'films that slide are known less')
      inlet%film = 1.1_dp
      found = warm_inlet(data, inlet, 0.004_dp)
      call test%check(.not. ieee_is_finite(found%error), 'no error beyond the range')
      call test%check(found%film_factor <= min(1 - inlet_loss(inlet), rough_film_factor(inlet%loading, 1.0_dp, 0.004_dp)), &
                      'the lower estimate')
   end subroutine check_law
end program test_thermal_estimate
