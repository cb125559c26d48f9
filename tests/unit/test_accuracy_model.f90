!> Expected errors and costs follow their formulas.
program test_accuracy_model
   use ehlwave_accuracy_model, only: expected_film_error, expected_ratio_error, largest_mesh, points_for, wave_y_error, &
      steady_work_units, step_work_units
   use ehlwave_conditions, only: conditions_from_moes, conditions_t
   use ehlwave_errors, only: error_t
   use ehlwave_kinds, only: dp
   use ehlwave_text, only: to_text
   use testing, only: test_t
   implicit none (type, external)

   type(test_t) :: test
   type(conditions_t) :: c
   type(error_t), allocatable :: error
   real(dp) :: plain

   call conditions_from_moes(100.0_dp, 12.05_dp, 1.0_dp, 2.2e-8_dp, c, error)
   call test%check_no_error(error, 'conditions')

   ! measured: 6.2 per cent of H(0,0) and 4.3 per cent of Ad/Ai (lambda = 0.5 a, F = 0.80) on 64 x 64 cells
   call test%check_close(expected_film_error(c, 0.0625_dp), 0.062_dp, 'film as measured', relative=0.5_dp)
   plain = expected_ratio_error(c, 0.80_dp, 0.0625_dp, 1, 8.0_dp, 1e-3_dp)
   call test%check_close(plain, 0.043_dp, 'ratio as measured', relative=0.5_dp)

   call test%check_close(expected_film_error(c, largest_mesh(c, 0.01_dp)), 0.01_dp, 'mesh for a film error', relative=1e-12_dp)
   call test%check_close(expected_ratio_error(c, 0.8_dp, largest_mesh(c, 0.01_dp, 0.8_dp, .false.), 1, 0.0_dp, &
                                              1.0_dp), &
                         0.01_dp, 'mesh for a ratio error', relative=1e-12_dp)
   call test%check_close(wave_y_error(points_for(0.02_dp, 1.5_dp, .false.), 1.5_dp, .false.), 0.02_dp, &
                         'points for waves along Y', relative=1e-12_dp)
   call test%check_close(wave_y_error(points_for(0.02_dp, 1.5_dp, .true.), 1.5_dp, .true.), 0.02_dp, &
                         'points of the fitted scheme', relative=1e-12_dp)

   call test%check(expected_ratio_error(c, 0.8_dp, 0.0625_dp, 2, 8.0_dp, 1e-3_dp) > plain, 'longer steps')
   call test%check(expected_ratio_error(c, 0.8_dp, 0.0625_dp, 1, 8.0_dp, 1e-2_dp) > plain, 'looser steps')
   call test%check(wave_y_error(10.0_dp, 0.5_dp, .true.) > wave_y_error(10.0_dp, 1.0_dp, .true.), 'slip')
   call test%check(steady_work_units(c, 128, .true., 1.0_dp) > step_work_units(c, 128, .true., 1.0_dp) .and. &
                   step_work_units(c, 128, .true., 1.0_dp) > 1, &
                   'costs')
   call test%check(step_work_units(c, 128, .false., 1.0_dp) > step_work_units(c, 128, .true., 1.0_dp), 'flow across the film costs')
   ! measured, postprocess/record/error-vs-time/line-work.csv
   call check_line(0.2_dp, 12.0_dp, 4096, 43.0_dp)
   call check_line(0.5_dp, 25.0_dp, 4096, 44.5_dp)
   call check_line(1.0_dp, 12.0_dp, 4096, 48.3_dp)
   call check_line(2.0_dp, 12.0_dp, 4096, 173.8_dp)
   call check_line(5.0_dp, 25.0_dp, 1024, 298.0_dp)
   call check_line(20.0_dp, 0.0_dp, 1024, 128.0_dp)
   call check_line(200.0_dp, 2.0_dp, 1024, 344.0_dp)
   call check_line(1000.0_dp, 12.0_dp, 1024, 1001.0_dp)
   call test%finish()

contains

   !> Work of a line contact within a factor of 2.
   subroutine check_line(m, l, cells, measured)
      real(dp), intent(in) :: m, l
      integer, intent(in) :: cells
      real(dp), intent(in) :: measured   !! work units
      call conditions_from_moes(m, l, 0.0_dp, 2.2e-8_dp, c, error)
      call test%check_no_error(error, 'conditions of a line')
      associate (ratio => steady_work_units(c, cells, .true., 1.0_dp)/measured)
         call test%check(ratio > 0.5_dp .and. ratio < 2, 'work of a line contact, M = '//to_text(m, 3))
      end associate
   end subroutine check_line

end program test_accuracy_model
