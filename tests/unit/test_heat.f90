!> Temperatures: surfaces under a band of heat, a film at rest and a film that carries heat, levels across the film.
program test_heat
   use ehlwave_film_column, only: column_t, new_column, solve_column
   use ehlwave_film_shear, only: made_by_own, made_by_stress, made_heat, made_stress_by_rise
   use ehlwave_film_levels, only: film_levels_t, level_weights_t, new_film_levels, new_level_weights
   use ehlwave_kinds, only: dp, pi
   use fast_surface, only: fast_limit
   use testing, only: test_t
   implicit none (type, external)

   type(test_t) :: test

   call check_levels()
   call check_band()
   call check_conduction()
   call check_surfaces()
   call check_convection()
   call check_changing_source()
   call test%finish()

contains

   !> Integrals and values between levels are exact for cubics.
   subroutine check_levels()
      type(film_levels_t) :: levels
      type(level_weights_t) :: to
      real(dp), parameter :: place(3) = [-0.93_dp, 0.11_dp, 1.0_dp]
      real(dp) :: zeta(3)
      integer :: i

      levels = new_film_levels(9)
      call test%check_close(dot_product(levels%weight, levels%zeta**3), 0.25_dp, 'integral of a cubic', relative=1e-14_dp)
      call test%check_close(levels%running_integral(levels%zeta**2), levels%zeta**3/3, 'running integral', absolute=1e-15_dp)
      to = new_level_weights(9, place)
      zeta = 0.5_dp*(1 + place)
      do i = 1, 3
         call test%check_close(dot_product(to%weight(:, i), levels%zeta(to%first(i):to%first(i) + 3)**3), zeta(i)**3, &
                               'cubic between levels', absolute=1e-14_dp)
      end do
   end subroutine check_levels

   !> Blok 1937: a surface that moves through a band of heat of length 2 b, times q_mean (2 b/u)^(1/2)/(k rho c)^(1/2): even,
   !> largest 1.128, mean 0.752; semi-elliptic, largest 1.112 at x = 0.65 b, mean 0.766.
   subroutine check_band()
      integer, parameter :: n = 2000
      real(dp), parameter :: h = 2.0_dp/n
      real(dp) :: even(0:n), round(0:n), rise_even(0:n), rise_round(0:n), w(0:n), x(0:n)
      integer :: i

      x = [(-1 + i*h, i=0, n)]
      w = fast_limit(n, h)
      even = 1
      even(0) = 0
      round = 4/pi*sqrt(max(0.0_dp, 1 - x**2))
      do i = 0, n
         rise_even(i) = dot_product(w(:i), even(i:0:-1))/sqrt(2*pi)
         rise_round(i) = dot_product(w(:i), round(i:0:-1))/sqrt(2*pi)
      end do
      call test%check_close(maxval(rise_even), 1.128_dp, 'even band, largest', relative=1e-3_dp)
      call test%check_close(sum(rise_even)/n, 0.752_dp, 'even band, mean', relative=1e-3_dp)
      call test%check_close(maxval(rise_round), 1.112_dp, 'semi-elliptic band, largest', relative=1e-3_dp)
      call test%check_close(x(maxloc(rise_round, 1) - 1), 0.65_dp, 'its place', absolute=0.01_dp)
      call test%check_close(sum(rise_round)/n, 0.766_dp, 'semi-elliptic band, mean', relative=1e-3_dp)
   end subroutine check_band

   !> A column of n levels that nothing flows through.
   function at_rest(levels) result(column)
      type(film_levels_t), intent(in) :: levels
      type(column_t) :: column
      column = new_column(levels%n)
      column%h = 0.7_dp
   end function at_rest

   !> An even source that no rise changes.
   pure function source_of(levels, heat) result(made)
      type(film_levels_t), intent(in) :: levels
      real(dp), intent(in) :: heat
      real(dp), allocatable :: made(:, :)
      allocate (made(0:levels%n, 4), source=0.0_dp)
      made(:, made_heat) = heat
   end function source_of

   !> A source that changes with the rise: the solution is that under the source which it makes itself.
   subroutine check_changing_source()
      type(film_levels_t) :: levels
      type(column_t) :: column
      real(dp) :: into(2), into_again(2), mean
      real(dp), dimension(0:12) :: again, before, rise
      real(dp), allocatable :: fixed(:, :), made(:, :)

      levels = new_film_levels(12)
      column = at_rest(levels)
      column%wall_own = [0.3_dp, 0.9_dp]
      made = source_of(levels, 50.0_dp)
      made(:, made_by_own) = 40 + 30*sin(pi*levels%zeta)
      made(:, made_by_stress) = 25 + 5*levels%zeta
      made(:, made_stress_by_rise) = levels%weight*(2 + cos(levels%zeta))
      before = 2*levels%zeta
      call solve_column(column, levels, made, before, rise, into)
      fixed = source_of(levels, 0.0_dp)
      mean = dot_product(made(:, made_stress_by_rise), rise - before)
      fixed(:, made_heat) = made(:, made_heat) - made(:, made_by_stress)*mean &
                            + made(:, made_by_own)*mean/sum(made(:, made_stress_by_rise))
      call solve_column(column, levels, fixed, 0*before, again, into_again)
      call test%check_close(rise, again, 'own rises in the mean', relative=1e-11_dp)
      call test%check_close(into, into_again, 'and the heat', relative=1e-11_dp)

      column%own_share = 1                      ! each level by its own rise: lumped, so up to the second difference
      made(:, made_by_own) = made(:, made_by_own)/5
      call solve_column(column, levels, made, before, rise, into)
      mean = dot_product(made(:, made_stress_by_rise), rise - before)
      fixed(:, made_heat) = made(:, made_heat) - made(:, made_by_stress)*mean + made(:, made_by_own)*(rise - before)
      call solve_column(column, levels, fixed, 0*before, again, into_again)
      call test%check_close(rise, again, 'own rises', absolute=0.03_dp)
   end subroutine check_changing_source

   !> Between cold surfaces an even source S leaves S zeta (1 - zeta)/2, and S = sin(pi zeta) leaves sin(pi zeta)/pi^2: the
   !> error goes as the fourth power of the distance of levels.
   subroutine check_conduction()
      type(film_levels_t) :: levels
      type(column_t) :: column
      real(dp) :: error(2), into(2)
      real(dp), allocatable :: made(:, :), rise(:)
      integer :: i

      do i = 1, 2
         levels = new_film_levels(8*i)
         column = at_rest(levels)
         allocate (rise(0:levels%n))
         made = source_of(levels, 3.0_dp)
         call solve_column(column, levels, made, 0*levels%zeta, rise, into)
         call test%check_close(rise, 1.5_dp*levels%zeta*(1 - levels%zeta), 'even source', absolute=1e-13_dp)
         call test%check_close(into, spread(1.5_dp/0.7_dp, 1, 2), 'its heat', relative=1e-12_dp)
         made(:, made_heat) = sin(pi*levels%zeta)
         call solve_column(column, levels, made, 0*levels%zeta, rise, into)
         error(i) = maxval(abs(rise - sin(pi*levels%zeta)/pi**2))
         deallocate (rise)
      end do
      call test%check(error(2) < error(1)/14, 'fourth order')
   end subroutine check_conduction

   !> Surfaces as warm as the heat upstream and here makes them.
   subroutine check_surfaces()
      type(film_levels_t) :: levels
      type(column_t) :: column
      real(dp) :: into(2), rise(0:10)

      levels = new_film_levels(10)
      column = at_rest(levels)
      column%wall_before = [5.0_dp, 1.0_dp]
      column%wall_own = [0.3_dp, 0.9_dp]
      call solve_column(column, levels, source_of(levels, 2.0_dp), 0*levels%zeta, rise, into)
      call test%check_close(rise(10), 5 + 0.3_dp*into(1), 'surface 1', relative=1e-13_dp)
      call test%check_close(rise(0), 1 + 0.9_dp*into(2), 'surface 2', relative=1e-13_dp)
      call test%check_close(sum(into)*column%h, 2.0_dp, 'all heat goes into them', relative=1e-12_dp)
      call test%check_close(into(1)*column%h, 1 - (rise(10) - rise(0)), 'that into surface 1', relative=1e-12_dp)
   end subroutine check_surfaces

   !> Oil that flows fast through the sides keeps the rise that it brings, moving across the levels or not; conduction alone
   !> does not see it where the rise is even.
   subroutine check_convection()
      type(film_levels_t) :: levels
      type(column_t) :: column
      real(dp) :: into(2), rise(0:12)

      levels = new_film_levels(12)
      column = at_rest(levels)
      column%convection = 40
      column%own = 2 + levels%zeta             ! out on the other side,
      column%brought = 4*(2.5_dp)              ! 2.5 in on the other, where the rise is 4: so oil moves across
      column%net = column%own - 2.5_dp
      column%wall_before = 4
      call solve_column(column, levels, source_of(levels, 0.0_dp), 0*levels%zeta, rise, into)
      call test%check_close(rise, spread(4.0_dp, 1, 13), 'an even rise stays', relative=1e-12_dp)
      call test%check_close(into, [0.0_dp, 0.0_dp], 'and heats nothing', absolute=1e-10_dp)
      column%wall_before = 0
      call solve_column(column, levels, source_of(levels, 0.0_dp), 0*levels%zeta, rise, into)
      call test%check(minval(rise) >= -1e-12_dp .and. maxval(rise) <= 4 + 1e-12_dp, 'no rise beyond those around')
   end subroutine check_convection

end program test_heat
