!> Operating conditions: reference table, the published experiment, and both routes to the same contact.
program test_conditions
   use ehlwave_conditions, only: conditions_from_dimensional, conditions_from_moes, conditions_t, contact_data_t
   use ehlwave_errors, only: error_t
   use ehlwave_kinds, only: dp, pi
   use testing, only: test_t
   implicit none (type, external)

   type(test_t) :: test

   call compare_with_table()
   call check_circular_limit()
   call compare_with_experiment()
   call compare_routes()
   call refuse_bad_data()
   call name_the_bound()
   call test%finish()

contains

   function from_moes(m, l, d) result(conditions)
      real(dp), intent(in) :: m, l, d
      type(conditions_t) :: conditions
      type(error_t), allocatable :: error
      call conditions_from_moes(m, l, d, 2.2e-8_dp, conditions, error)
      call test%check_no_error(error, 'conditions from M, L, D')
   end function from_moes

   !> Steel ball on glass disc: the experiment of Venner, Kaneta and Lubrecht (2000), section 4.
   function experiment(mean_speed) result(data)
      real(dp), intent(in) :: mean_speed
      type(contact_data_t) :: data
      data = contact_data_t(radius_x_m=12.52e-3_dp, radius_y_m=12.52e-3_dp, reduced_modulus_pa=1.17e11_dp, load_n=39.2_dp, &
                            mean_speed_m_per_s=mean_speed, viscosity_pa_s=1.22_dp, pressure_viscosity_per_pa=2.25e-8_dp)
   end function experiment

   subroutine compare_with_table()
      real(dp), parameter :: m(4) = [100.0_dp, 200.0_dp, 500.0_dp, 1000.0_dp], d(4) = [1.0_dp, 0.35_dp, 0.12_dp, 0.04_dp]
      real(dp), parameter :: gamma(4) = [1.0_dp, 0.38264526_dp, 0.16793439_dp, 0.080165487_dp]
      real(dp), parameter :: alphabar(4) = [20.379847_dp, 18.641308_dp, 19.226673_dp, 18.932011_dp]
      real(dp), parameter :: lambdabar(4) = [0.023650815_dp, 0.015664471_dp, 0.0076913142_dp, 0.0051978578_dp]
      real(dp), parameter :: moes_per_film(4) = [3.9541255_dp/0.14006285_dp, 4.424723_dp/0.11940163_dp, &
                                                 4.4870097_dp/0.082102306_dp, 4.5534202_dp/0.06754689_dp]
      type(conditions_t) :: c
      integer :: i

      do i = 1, size(m)
         c = from_moes(m(i), 12.05_dp, d(i))
         call test%check_close([c%gamma, c%alphabar, c%lambdabar, c%moes_film_factor], &
                               [gamma(i), alphabar(i), lambdabar(i), moes_per_film(i)], 'reference table', relative=1e-7_dp)
         call test%check_close(c%hertz_pressure_pa, c%alphabar/2.2e-8_dp, 'ph = alphabar/alpha', relative=1e-14_dp)
      end do
   end subroutine compare_with_table

   subroutine check_circular_limit()
      type(conditions_t) :: circular, nearly
      circular = from_moes(100.0_dp, 12.05_dp, 1.0_dp)
      nearly = from_moes(100.0_dp, 12.05_dp, 0.999999_dp)
      call test%check_close(circular%gamma, 1.0_dp, 'gamma(D = 1)', relative=1e-14_dp)
      call test%check_close(circular%s, 0.5_dp, 'S(D = 1)', relative=1e-14_dp)
      call test%check_close(circular%lambdabar, (128*pi**3/(3*100.0_dp**4))**(1.0_dp/3), 'lambdabar(D = 1)', relative=1e-14_dp)
      call test%check_close([nearly%gamma, nearly%s, nearly%lambdabar, nearly%moes_film_factor], &
                            [circular%gamma, circular%s, circular%lambdabar, circular%moes_film_factor], &
                            'D = 0.999999 against D = 1', relative=2e-6_dp)
   end subroutine check_circular_limit

   !> The published table rounds, and its M deviates by up to 3 per cent from the data beside it.
   subroutine compare_with_experiment()
      real(dp), parameter :: speed(3) = [0.024_dp, 0.048_dp, 0.096_dp]
      real(dp), parameter :: m(3) = [130.77_dp, 79.90_dp, 47.51_dp], l(3) = [6.61_dp, 7.88_dp, 9.36_dp]
      real(dp), parameter :: lambdabar(3) = [1.65e-2_dp, 3.19e-2_dp, 6.39e-2_dp]
      type(conditions_t) :: c
      type(error_t), allocatable :: error
      integer :: i

      do i = 1, size(speed)
         call conditions_from_dimensional(experiment(speed(i)), c, error)
         call test%check_no_error(error, 'conditions of the experiment')
         call test%check_close(c%m, m(i), 'published M', relative=0.04_dp)
         call test%check_close(c%l, l(i), 'published L', relative=0.005_dp)
         call test%check_close(c%lambdabar, lambdabar(i), 'published lambdabar', relative=0.04_dp)
         call test%check_close(c%alphabar, 12.23_dp, 'published alphabar', relative=0.02_dp)
         call test%check_close(c%hertz_pressure_pa, 0.54e9_dp, 'published ph', relative=0.02_dp)
         call test%check_close(c%a_m, 0.185e-3_dp, 'published a', relative=0.005_dp)
      end do
   end subroutine compare_with_experiment

   !> Dimensionless numbers from M, L, D against the same from lengths, pressure and speed.
   subroutine compare_routes()
      type(conditions_t) :: c, same
      type(contact_data_t) :: data
      type(error_t), allocatable :: error
      real(dp), parameter :: radius_ratio(3) = [1.0_dp, 0.3_dp, 0.05_dp]
      real(dp) :: speed_u2
      integer :: i

      do i = 1, size(radius_ratio)
         data = experiment(0.048_dp)
         data%radius_y_m = data%radius_x_m/radius_ratio(i)
         call conditions_from_dimensional(data, c, error)
         call test%check_no_error(error, 'elliptic contact')
         call test%check_close(c%d, radius_ratio(i), 'D', relative=1e-14_dp)
         call test%check_close(c%alphabar, data%pressure_viscosity_per_pa*c%hertz_pressure_pa, 'alphabar = alpha ph', &
                               relative=1e-12_dp)
         call test%check_close(c%lambdabar, 12*data%mean_speed_m_per_s*data%viscosity_pa_s*c%a_m/ &
                               (c%c_m**2*c%hertz_pressure_pa), 'lambdabar = 6 us eta0 a/(c^2 ph)', relative=1e-12_dp)
         speed_u2 = 2*data%mean_speed_m_per_s*data%viscosity_pa_s/(data%reduced_modulus_pa*data%radius_x_m)
         call test%check_close(c%moes_film_factor, c%c_m/data%radius_x_m/sqrt(speed_u2), 'Moes scale of the film', &
                               relative=1e-12_dp)
         call test%check_close(c%s, c%a_m**2/(2*data%radius_x_m*c%c_m), 'S = a^2/(2 Rx c)', relative=1e-12_dp)
         call test%check_close(1 - c%s, c%b_m**2/(2*data%radius_y_m*c%c_m), '1 - S = b^2/(2 Ry c)', relative=1e-11_dp)
         call test%check_close(c%radius_over_a(), data%radius_x_m/c%a_m, 'Rx/a', relative=1e-12_dp)
         call conditions_from_moes(c%m, c%l, c%d, data%pressure_viscosity_per_pa, same, error)
         call test%check_close([same%lambdabar, same%hertz_pressure_pa], [c%lambdabar, c%hertz_pressure_pa], &
                               'the other route', relative=1e-12_dp)
         call test%check(c%has_dimensions .and. .not. same%has_dimensions, 'only one route knows lengths')
      end do
   end subroutine compare_routes

   subroutine refuse_bad_data()
      type(conditions_t) :: c
      type(contact_data_t) :: data
      type(error_t), allocatable :: error

      call conditions_from_moes(0.0_dp, 12.0_dp, 1.0_dp, 2e-8_dp, c, error)
      call test%check_error(error, 'load_parameter_m', 'M = 0')
      call conditions_from_moes(100.0_dp, -1.0_dp, 1.0_dp, 2e-8_dp, c, error)
      call test%check_error(error, 'lubricant_parameter_l', 'L < 0')
      call conditions_from_moes(100.0_dp, 12.0_dp, 0.0049_dp, 2e-8_dp, c, error)
      call test%check_error(error, 'radius_ratio_d', 'D too small')
      call conditions_from_moes(100.0_dp, 12.0_dp, 1.0001_dp, 2e-8_dp, c, error)
      call test%check_error(error, 'radius_ratio_d', 'D too large')
      call conditions_from_moes(100.0_dp, 12.0_dp, 1.0_dp, 0.0_dp, c, error)
      call test%check_error(error, 'pressure_viscosity_per_pa', 'alpha = 0')
      call conditions_from_moes(100.0_dp, 0.0_dp, 0.005_dp, 2e-8_dp, c, error)
      call test%check_no_error(error, 'isoviscous, smallest D')

      data = experiment(0.024_dp)
      data%load_n = 0
      call conditions_from_dimensional(data, c, error)
      call test%check_error(error, 'load_n', 'no load')
      data = experiment(0.024_dp)
      data%radius_y_m = 0
      call conditions_from_dimensional(data, c, error)
      call test%check_error(error, 'radius_y_m', 'no radius')
      data = experiment(-0.024_dp)
      call conditions_from_dimensional(data, c, error)
      call test%check_error(error, 'mean_speed_m_per_s', 'negative speed')
      data = experiment(0.024_dp)
      data%radius_y_m = 6e-3_dp
      call conditions_from_dimensional(data, c, error)
      call test%check_error(error, 'radius_ratio_d', 'Rx > Ry')
      data = experiment(0.024_dp)
      data%radius_y_m = nearest(data%radius_x_m, -1.0_dp)
      call conditions_from_dimensional(data, c, error)
      call test%check_no_error(error, 'equal radii but for round-off')
      call test%check_close(c%d, 1.0_dp, 'D = 1', relative=0.0_dp)
   end subroutine refuse_bad_data

   !> Values outside are refused with the violated bound; the named M lies inside, close to the bound.
   subroutine name_the_bound()
      real(dp), parameter :: l(3) = [1.0_dp, 12.05_dp, 300.0_dp], d(3) = [0.0_dp, 0.07_dp, 1.0_dp]
      type(conditions_t) :: c
      type(error_t), allocatable :: error
      real(dp) :: largest
      integer :: i, j

      do i = 1, size(l)
         do j = 1, size(d)
            call conditions_from_moes(1e12_dp, l(i), d(j), 2.2e-8_dp, c, error)
            call test%check_error(error, 'at most 500', 'M too large')
            if (.not. allocated(error)) cycle
            read (error%message(index(error%message, ' ', back=.true.):), *) largest
            c = from_moes(largest, l(i), d(j))
            call test%check_close(c%alphabar, 500.0_dp, 'alpha ph of the largest M', relative=0.005_dp)
         end do
      end do
      associate (data => experiment(0.024_dp))
         call refuse_load(data)
      end associate
   end subroutine name_the_bound

   !> The message about a load of dimensional data has the load in newtons; the named one lies inside.
   subroutine refuse_load(given)
      type(contact_data_t), intent(in) :: given
      type(contact_data_t) :: data
      type(conditions_t) :: c
      type(error_t), allocatable :: error

      data = given
      data%load_n = 1e9_dp
      call conditions_from_dimensional(data, c, error)
      call test%check_error(error, 'load_n = 1e9 N gives alpha ph', 'load too large')
      if (.not. allocated(error)) return
      associate (bound => error%message(index(error%message, 'of at most ', back=.true.) + 11:))
         call test%check(scan(bound, 'e') == 0 .and. index(bound, ' N') == len(bound) - 1, 'the load is plain, in newtons: '//bound)
         read (bound, *) data%load_n
      end associate
      call conditions_from_dimensional(data, c, error)
      call test%check_no_error(error, 'the named load')
      call test%check_close(c%alphabar, 500.0_dp, 'alpha ph of the largest load', relative=0.005_dp)
   end subroutine refuse_load

end program test_conditions
