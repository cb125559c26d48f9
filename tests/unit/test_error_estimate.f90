!> Richardson estimates from values on meshes h, 2h, 4h.
program test_error_estimate
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan, ieee_quiet_nan, ieee_value
   use ehlwave_error_estimate, only: estimate_error, likely_order, observed_order
   use ehlwave_kinds, only: dp
   use ehlwave_resolution, only: resolution_t
   use testing, only: test_t
   implicit none (type, external)

   type(test_t) :: test
   real(dp) :: nan

   nan = ieee_value(1.0_dp, ieee_quiet_nan)
   ! v(h) = 2 + 0.1 h^p on h = 1, 2, 4: the error of the first value is 0.1 of 2.1
   call test%check_close(estimate_error(powers(2.0_dp)), 0.1_dp/2.1_dp, 'second order, three values', relative=1e-12_dp)
   call test%check_close(estimate_error(powers(1.5_dp)), 0.1_dp/2.1_dp, 'order 1.5, three values', relative=1e-12_dp)
   call test%check_close(estimate_error([2.1_dp, 2.4_dp]), 0.1_dp/2.1_dp, 'two values: order 2', relative=1e-12_dp)
   call test%check_close(estimate_error([2.1_dp, 2.4_dp], 1.0_dp), 0.3_dp/2.1_dp, 'two values of another order', relative=1e-12_dp)
   call test%check_close(likely_order(nan, resolution_t(inlet=0.1_dp), 1.0_dp), 2.0_dp, 'well resolved', relative=1e-12_dp)
   call test%check_close(likely_order(nan, resolution_t(inlet=0.25_dp), 1.0_dp), 1.0_dp, 'bare inlet', relative=1e-12_dp)
   call test%check_close(likely_order(nan, resolution_t(inlet=0.1_dp), 4.0_dp), 1.5_dp, 'a steep inlet', relative=1e-12_dp)
   call test%check_close(likely_order(nan, resolution_t(inlet=0.1_dp, points_y=12.0_dp), 1.0_dp), 1.5_dp, 'waves', &
                         relative=1e-12_dp)
   call test%check_close(likely_order(1.7_dp, resolution_t(inlet=0.1_dp), 1.0_dp), 1.7_dp, 'as the film', relative=1e-12_dp)
   call test%check_close(likely_order(0.2_dp, resolution_t(inlet=0.1_dp), 1.0_dp), 1.0_dp, 'and at least 1', relative=1e-12_dp)
   call test%check_close(estimate_error([2.1_dp, 2.4_dp, nan]), 0.1_dp/2.1_dp, 'third value missing: order 2', relative=1e-12_dp)
   call test%check_close(estimate_error(-powers(2.0_dp)), 0.1_dp/2.1_dp, 'negative values', relative=1e-12_dp)
   call test%check_close(estimate_error(powers(3.0_dp)), (5.6_dp/2**2.5_dp/3)/2.1_dp, 'higher order is not trusted', &
                         relative=1e-12_dp)
   call test%check_close(estimate_error(powers(0.5_dp)), (2**0.5_dp - 1)*0.1_dp/2.1_dp, 'lower order is not trusted', &
                         relative=1e-12_dp)
   call test%check_close(estimate_error([2.1_dp, 2.0_dp, 2.3_dp]), 0.1_dp/2.1_dp, 'no monotony: order 1', relative=1e-12_dp)
   call test%check(ieee_is_nan(estimate_error([2.1_dp])), 'one value: no estimate')
   call test%check(ieee_is_nan(estimate_error([2.1_dp, nan, 2.0_dp])), 'second value missing: no estimate')
   call test%check(ieee_is_nan(estimate_error([nan, 2.1_dp, 2.0_dp])), 'first value missing: no estimate')

   call test%check_close(observed_order(powers(1.7_dp)), 1.7_dp, 'observed order', relative=1e-12_dp)
   call test%check(ieee_is_nan(observed_order([1.0_dp, 2.0_dp])), 'two values: no order')
   call test%check(ieee_is_nan(observed_order([1.0_dp, 1.0_dp, 2.0_dp])), 'no difference: no order')
   call test%finish()

contains

   pure function powers(order) result(values)
      real(dp), intent(in) :: order
      real(dp) :: values(3)
      values = 2 + 0.1_dp*[1.0_dp, 2**order, 4**order]
   end function powers

end program test_error_estimate
