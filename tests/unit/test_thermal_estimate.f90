!> Estimates of temperature rises: numbers worked out by hand, limits and scalings.
program test_thermal_estimate
   use ehlwave_kinds, only: dp
   use ehlwave_thermal_estimate, only: film_rise_k, inlet_film_factor, inlet_rise_k, surface_rise_k, thermal_data_t
   use testing, only: test_t
   implicit none (type, external)

   type(thermal_data_t) :: data
   type(test_t) :: test
   real(dp) :: factor, quarter

   ! eta0 = 0.35 Pa s and ubar = 1 m/s: Lt = 0.1
   factor = inlet_film_factor(data, 0.35_dp, 1.0_dp, 0.0_dp, 0.005_dp)
   call test%check_close(factor, (1 - 0.066_dp*0.3801894_dp)/(1 + 0.213_dp*0.2290868_dp), 'inlet in pure rolling', relative=1e-6_dp)
   call test%check(inlet_film_factor(data, 0.35_dp, 1.0_dp, 1.0_dp, 0.005_dp) < factor, 'sliding warms the inlet more')
   call test%check_close(inlet_film_factor(data, 0.35_dp, 0.0_dp, 1.0_dp, 0.005_dp), 1.0_dp, 'at rest', relative=1e-15_dp)
   call test%check(inlet_film_factor(data, 1.0_dp, 100.0_dp, 1.0_dp, 0.01_dp) > 0, 'above 0 beyond the range of the fit')
   call test%check_close(inlet_rise_k(data, exp(-0.67_dp*0.04_dp*7)), 7.0_dp, 'rise in the inlet', relative=1e-12_dp)

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
end program test_thermal_estimate
