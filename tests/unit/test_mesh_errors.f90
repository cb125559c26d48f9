!> The rule of declared errors: values on meshes h, 2h, 4h, and a model.
program test_mesh_errors
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
   use ehlwave_error_factors, only: amplitude_ratio, by_grids, by_model, central_film
   use ehlwave_kinds, only: dp, no_value
   use ehlwave_mesh_errors, only: kind_of, mesh_error, mesh_error_t, observed_order, richardson_error
   use testing, only: test_t
   implicit none (type, external)

   type(test_t) :: test

   call check_richardson()
   call check_rule()
   call check_order()
   call test%finish()

contains

   !> v(h) = 2 + 0.1 h^p on h = 1, 2, 4: the error of the first value is 0.1 of 2.1.
   subroutine check_richardson()
      call test%check_close(richardson_error(powers(2.0_dp)), 0.1_dp/2.1_dp, 'second order', relative=1e-12_dp)
      call test%check_close(richardson_error(powers(1.0_dp), 1.0_dp), 0.1_dp/2.1_dp, 'first order', relative=1e-12_dp)
      call test%check_close(richardson_error(powers(3.0_dp)), 5.6_dp/12/2.1_dp, 'finer grids that agree', relative=1e-12_dp)
      call test%check_close(richardson_error(powers(3.0_dp), 2.0_dp, 8.0_dp), 0.7_dp/3/2.1_dp, 'third order', relative=1e-12_dp)
      call test%check_close(richardson_error([(2.1_dp, 0.0_dp), (2.1_dp, 0.3_dp)]), 0.1_dp/2.1_dp, 'a phase', relative=1e-12_dp)
      call test%check(ieee_is_nan(richardson_error(powers(2.0_dp), 2.0_dp) + richardson_error([(2.1_dp, 0.0_dp)])), 'one value')
   end subroutine check_richardson

   subroutine check_rule()
      type(mesh_error_t) :: error
      integer :: kind

      do kind = 1, size(by_grids, 2)
         error = mesh_error(central_film, kind, [2.1_dp, 2.4_dp, 3.6_dp], 0.01_dp)
         call test%check_close(error%relative/by_grids(central_film, kind), 0.1_dp/2.1_dp, 'by grids', relative=1e-12_dp)
         call test%check(error%basis == 'coarse_grid', 'basis of two grids')
         error = mesh_error(central_film, kind, [2.1_dp, 2.1_dp], 0.01_dp)
         call test%check_close(error%relative/by_grids(central_film, kind), 0.003_dp, 'grids that agree by chance', &
                               relative=1e-12_dp)
         error = mesh_error(amplitude_ratio, kind, [2.1_dp, no_value, 2.4_dp], 0.01_dp)
         call test%check_close(error%relative/by_model(amplitude_ratio, kind), 0.01_dp, 'by the model', relative=1e-12_dp)
         call test%check(error%basis == 'model', 'basis of one grid')
      end do
      error = mesh_error(central_film, 1, [2.1_dp], 0.0_dp)
      call test%check(ieee_is_nan(error%relative) .and. error%basis == '', 'neither grids nor model')
      error = mesh_error(central_film, 1, [no_value, 2.1_dp], 0.01_dp)
      call test%check(error%basis /= 'coarse_grid', 'no value on the finest grid')
      call test%check(all(kind_of([.false., .false., .true., .true.], [.false., .true., .false., .true.]) == [1, 2, 3, 4]), 'kinds')
      ! 0.3 of the expected error is the least that grids show; factors have three digits
      call test%check(all(by_model > 0.298_dp*by_grids) .and. all(by_grids > 0), 'a model is no better than grids that agree')
   end subroutine check_rule

   subroutine check_order()
      call test%check_close(observed_order(real(powers(1.7_dp), dp)), 1.7_dp, 'observed order', relative=1e-12_dp)
      call test%check(ieee_is_nan(observed_order([1.0_dp, 2.0_dp])), 'two values: no order')
      call test%check(ieee_is_nan(observed_order([1.0_dp, 1.0_dp, 2.0_dp])), 'no difference: no order')
   end subroutine check_order

   pure function powers(order) result(values)
      real(dp), intent(in) :: order
      complex(dp) :: values(3)
      values = 2 + 0.1_dp*[1.0_dp, 2**order, 4**order]
   end function powers

end program test_mesh_errors
