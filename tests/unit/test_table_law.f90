!> Viscosity interpolated in a table: against the laws that the table was made from, derivatives, bounds, refusals.
program test_table_law
   use ehlwave_errors, only: error_t
   use ehlwave_kinds, only: dp
   use ehlwave_number_table, only: number_table_t
   use ehlwave_roelands_law, only: roelands_law_t
   use ehlwave_table_law, only: new_table_law, table_law_t
   use ehlwave_viscosity_law, only: largest_exponent
   use testing, only: test_t
   implicit none (type, external)

   real(dp), parameter :: eta0 = 0.1_dp, celsius = 273.15_dp
   type(roelands_law_t), parameter :: roelands = roelands_law_t(alpha_per_pa=2.2e-8_dp, beta_per_k=0.04_dp, &
                                                                temperature_k=313.15_dp)
   real(dp), parameter :: warm(4) = celsius + [20, 40, 70, 100]
   type(test_t) :: test

   call check_values()
   call check_derivatives([warm(2)], 0.0_dp)
   call check_derivatives(warm(2:3), 10.0_dp)
   call check_derivatives(warm, 0.0_dp)
   call check_derivatives(warm, 17.0_dp)
   call check_bounds()
   call check_refusals()
   call test%finish()

contains

   !> Roelands' law with eta0 at 40 C at so many pressures up to 1.5 GPa and some temperatures.
   function roelands_table(pressures, temperatures) result(table)
      integer, intent(in) :: pressures
      real(dp), intent(in) :: temperatures(:)
      type(number_table_t) :: table
      real(dp), dimension(pressures) :: exponent, p, slope, slope_per_k
      integer :: i, k

      table%path = 't.csv'
      table%names = [character(len=64) :: 'viscosity_pa_s', 'temperature_k', 'pressure_pa']
      allocate (table%values(pressures*size(temperatures), 3))
      table%line = [(i + 1, i=1, size(table%values, 1))]
      p = 1.5e9_dp*[(real(i, dp)/(pressures - 1), i=0, pressures - 1)]
      do k = 1, size(temperatures)
         call roelands%evaluate(pressures, p, spread(temperatures(k) - warm(2), 1, pressures), exponent, slope, &
                                slope_per_k)
         associate (rows => table%values((k - 1)*pressures + 1:k*pressures, :))
            rows(:, 1) = eta0*exp(exponent)
            rows(:, 2) = temperatures(k)
            rows(:, 3) = p
         end associate
      end do
   end function roelands_table

   !> 30 pressures, four temperatures: ln(eta/eta0) within 3e-3, between temperatures within 5e-2; alpha within 1e-3.
   subroutine check_values()
      type(table_law_t) :: law
      type(error_t), allocatable :: error
      real(dp), dimension(301) :: at_point, cool, exact, exponent, p, slope, unused, zero
      integer :: i, k

      p = 5e6_dp*[(i, i=0, 300)]
      zero = 0
      cool = 15
      call new_table_law(roelands_table(30, warm), warm(2), law, error)
      call test%check_no_error(error, 'Roelands in a table')
      if (allocated(error)) return
      call test%check_close(law%ambient_pa_s, eta0, 'eta0', relative=1e-12_dp)
      call test%check_close(law%largest_pressure_pa, 1.5e9_dp, 'largest pressure', relative=1e-14_dp)
      call law%evaluate(301, p, zero, exponent, slope, unused)
      call roelands%evaluate(301, p, zero, exact, slope, unused)
      call test%check_close(exponent, exact, 'at T0', absolute=3e-3_dp)
      call test%check_close(law%coefficient(), film_alpha(), 'alpha', relative=1e-3_dp)
      call law%evaluate(301, p, cool, exponent, slope, unused)
      call roelands%evaluate(301, p, cool, exact, slope, unused)
      call test%check_close(exponent, exact, '15 K above', absolute=5e-2_dp)
      do k = -1, 1, 2   ! beyond both ends
         cool = merge(warm(1) - 3, warm(size(warm)) + 3, k < 0) - warm(2)
         call law%evaluate(301, p, cool, exponent, slope, unused)
         call roelands%evaluate(301, p, cool, at_point, slope, unused)
         call test%check_close(exponent, at_point, 'beyond the temperatures of the table', absolute=8e-2_dp)
      end do
      call new_table_law(roelands_table(30, warm), warm(2) + 15, law, error)
      call law%evaluate(301, p, zero, exponent, slope, unused)
      call test%check_close(exponent, exact - exact(1), 'another T0', absolute=5e-2_dp)
      call test%check_close(log(law%ambient_pa_s/eta0), exact(1), 'eta0 of another T0', absolute=1e-2_dp)
   end subroutine check_values

   !> Film-forming coefficient of Roelands' law.
   real(dp) function film_alpha()
      use ehlwave_viscosity_law, only: film_forming_coefficient
      film_alpha = film_forming_coefficient(roelands)
   end function film_alpha

   !> By pressure and temperature, inside the table and beyond it; continuous at its points.
   subroutine check_derivatives(temperatures, rise)
      real(dp), intent(in) :: temperatures(:), rise
      type(table_law_t) :: law
      type(error_t), allocatable :: error
      real(dp), parameter :: step = 1e3_dp, step_k = 1e-3_dp
      real(dp), dimension(90) :: above, below, by_k, by_pa, exponent, other, p, rises, unused
      integer :: i

      call new_table_law(roelands_table(12, temperatures), warm(2), law, error)
      call test%check_no_error(error, 'table')
      if (allocated(error)) return
      p = 2.1e7_dp*[(i, i=1, 90)]
      rises = rise
      call law%evaluate(90, p, rises, exponent, by_pa, by_k)
      call law%evaluate(90, p - step, rises, below, unused, other)
      call law%evaluate(90, p + step, rises, above, unused, other)
      call test%check_close(by_pa, (above - below)/(2*step), 'd ln(eta)/dp', relative=1e-5_dp)
      call test%check(all(by_pa > 0), 'rises with pressure')
      call law%evaluate(90, p, rises - step_k, below, unused, other)
      call test%check_close(other, by_k, 'd ln(eta)/dT does not jump', relative=1e-3_dp, absolute=0.0_dp)
      call law%evaluate(90, p, rises + step_k, above, unused, other)
      call test%check_close(by_k, (above - below)/(2*step_k), 'd ln(eta)/dT', relative=1e-5_dp, absolute=1e-12_dp)
      p = 1.5e9_dp/11*[(real(1 + i/9, dp), i=0, 89)]
      call law%evaluate(90, p - 1, rises, exponent, below, unused)
      call law%evaluate(90, p + 1, rises, exponent, above, unused)
      call test%check_close(above, below, 'd ln(eta)/dp does not jump', relative=1e-6_dp)
   end subroutine check_derivatives

   !> Straight beyond the last pressure, bounded, and blocks whose values do not depend on their neighbours.
   subroutine check_bounds()
      type(table_law_t) :: law
      type(error_t), allocatable :: error
      real(dp), dimension(4) :: alone, by_k, by_pa, exponent, unused
      real(dp), parameter :: p(4) = [1.5e9_dp, 1.6e9_dp, 1e12_dp, 3e8_dp], zero(4) = 0
      integer :: i

      call new_table_law(roelands_table(30, warm(2:2)), 0.0_dp, law, error)
      call test%check_no_error(error, 'one temperature needs no T0')
      if (allocated(error)) return
      call law%evaluate(4, p, zero, exponent, by_pa, by_k)
      call test%check_close(exponent(2), exponent(1) + 1e8_dp*by_pa(1), 'straight beyond the table', relative=1e-13_dp)
      call test%check_close(by_pa(2), by_pa(1), 'with its last slope', relative=1e-13_dp)
      call test%check_close(exponent(3), largest_exponent, 'bounded', absolute=0.0_dp)
      call test%check_close(by_k, zero, 'one temperature: no change with it', absolute=0.0_dp)
      do i = 1, 4
         call law%evaluate(1, p(i:i), zero(1:1), alone(i:i), unused(1:1), unused(2:2))
      end do
      call test%check_close(alone, exponent, 'one by one', absolute=0.0_dp)
   end subroutine check_bounds

   subroutine check_refusals()
      type(number_table_t) :: table

      table = roelands_table(6, warm)
      call refuse(table, 0.0_dp, 't.csv: has 4 temperatures, 293.15 to 373.15 K: &lubricant temperature_k is needed')
      call refuse(table, 290.0_dp, '&lubricant temperature_k = 290 is outside the table (4 temperatures')
      call refuse(changed(9, 1, 0.0_dp), warm(2), 't.csv:10: viscosity_pa_s = 0 is not above 0')
      call refuse(changed(9, 2, 40.0_dp), warm(2), 't.csv:10: temperature_k = 40 is not from 200 to 700: write kelvin')
      call refuse(changed(9, 3, -1.0_dp), warm(2), 't.csv:10: pressure_pa = -1 is below 0')
      call refuse(changed(9, 3, 0.0_dp), warm(2), 't.csv:10: pressure_pa = 0 does not rise')
      call refuse(changed(9, 1, 1e-3_dp), warm(2), 't.csv:10: viscosity_pa_s = 0.001 does not rise')
      call refuse(changed(9, 2, 315.0_dp), warm(2), 't.csv:10: only 1 pressures of this temperature: give at least 4')
      call refuse(changed(7, 3, 1e7_dp), warm(2), 't.csv:8: the first pressure_pa is 1e7, above 5e6')
      table%values(:, 3) = 1e-9_dp*table%values(:, 3)
      call refuse(table, warm(2), 't.csv:7: the last pressure_pa is 1.5, below 5e7: write pascals')
      table = roelands_table(6, warm(:2))
      table%values(7:, 1) = table%values(:6, 1)
      call refuse(table, warm(2), 'does not fall with temperature')
      table = roelands_table(6, warm(:1))
      table%names(2) = 'density'
      call refuse(table, 0.0_dp, "t.csv: column 'density' is unknown: the columns are")
      table%names(2) = 'temperature_k'
      call refuse(table, warm(2), 'is outside the table (293.15 K)')
      table%names = [character(len=64) :: 'viscosity_pa_s', 'temperature_k', 'temperature_k']
      call refuse(table, 0.0_dp, 't.csv: has no column pressure_pa')
   end subroutine check_refusals

   !> The table of four temperatures with another value.
   function changed(row, column, value) result(table)
      integer, intent(in) :: row, column
      real(dp), intent(in) :: value
      type(number_table_t) :: table
      table = roelands_table(6, warm)
      table%values(row, column) = value
   end function changed

   subroutine refuse(table, temperature_k, needle)
      type(number_table_t), intent(in) :: table
      real(dp), intent(in) :: temperature_k
      character(len=*), intent(in) :: needle
      type(table_law_t) :: law
      type(error_t), allocatable :: error
      call new_table_law(table, temperature_k, law, error)
      call test%check_error(error, needle, needle)
   end subroutine refuse

end program test_table_law
