!> Moving patterns against the independent solver, with its own start.
!>
!> The reference takes the first time step with first order. That disturbs the smooth film once, by a
!> discretisation error that does not shrink with the amplitude of the waviness: 0.5 % of Ad/Ai when Ai is 1 %
!> of the film. Marching here in the same way, from the same parts as the solver, leaves no such difference.
program test_reference_march
   use ehlwave_amplitude, only: fitted_harmonic, sampled_amplitude
   use ehlwave_csv, only: csv_t, read_csv
   use ehlwave_errors, only: error_t
   use ehlwave_full_multigrid, only: full_multigrid_t
   use ehlwave_kinds, only: dp
   use ehlwave_solve_report, only: solve_limits_t, solve_report_t
   use ehlwave_status, only: status_converged
   use ehlwave_text, only: to_text
   use ehlwave_transport, only: characteristic_transport
   use ehlwave_waviness, only: new_waviness, waviness_t
   use sample_contact, only: make_conditions, make_multigrid
   use testing, only: is_long, test_t
   implicit none (type, external)

   ! columns of transient.csv
   integer, parameter :: column_m = 1, column_d = 3, column_points = 4, column_orientation = 5, column_wave = 6, &
                         column_amplitude = 7, column_ratio = 9, column_fit = 10
   real(dp), parameter :: settled = 3.5_dp, allowed = 2e-5_dp
   character(len=1024) :: path
   type(csv_t) :: table
   type(error_t), allocatable :: error
   type(test_t) :: test
   real(dp) :: worst
   integer :: row

   call get_command_argument(1, path)
   call read_csv(trim(path), table, error)
   call test%check_no_error(error, 'reference values')
   if (allocated(error)) call test%finish()
   call test%check_equal(size(table%line), 12, 'rows')
   call test%check_equal(trim(table%names(column_ratio))//' '//trim(table%names(column_fit)), &
                         'amplitude_ratio amplitude_ratio_fit', 'columns')
   worst = 0
   ! Daily a third of them: both amplitudes, both orientations, both shapes.
   do row = merge(1, 2, is_long()), size(table%line), merge(1, 3, is_long())
      call compare_row(row)
   end do
   print '(a)', 'measured: largest deviation '//to_text(worst, 2)
   call test%finish()

contains

   real(dp) function number(column, row)
      integer, intent(in) :: column, row
      character(len=:), allocatable :: text
      integer :: status
      text = table%cell(column, row)
      read (text, *, iostat=status) number
      call test%check_equal(status, 0, 'number')
   end function number

   subroutine compare_row(row)
      integer, intent(in) :: row
      real(dp), parameter :: length_x = 4
      type(full_multigrid_t) :: multigrid
      type(waviness_t) :: wave
      real(dp), allocatable :: film(:), time(:)
      real(dp) :: amplitude, dt, wavelength
      character(len=:), allocatable :: what
      integer :: cells, first, steps

      cells = nint(number(column_points, row)) - 1
      wavelength = number(column_wave, row)
      what = 'row '//to_text(row)
      associate (conditions => make_conditions(number(column_m, row), number(column_d, row)))
         call make_multigrid(multigrid, conditions%m, conditions%d, cells, .true.)
         wave = new_waviness(wavelength, 0.0_dp, .false., -2.5_dp, 1.0_dp)
         if (table%cell(column_orientation, row) == 'isotropic') &
            wave = new_waviness(wavelength, conditions%elliptic%kappa*wavelength, .false., -2.5_dp, 1.0_dp)
      end associate
      call multigrid%solve(solve_limits_t(tolerance=1e-9_dp), 1e-3_dp)
      dt = length_x/cells
      first = ceiling(settled/dt - 1e-9_dp)
      steps = ceiling((settled + wavelength)/dt - 1e-9_dp)
      allocate (film(0:steps), time(0:steps))
      call march_as_reference(multigrid, wave, number(column_amplitude, row), steps, amplitude, time, film, what)
      call compare(sampled_amplitude(film(first:))/amplitude, number(column_ratio, row), what//', samples')
      call compare(abs(fitted_harmonic(time(first:), film(first:), wavelength))/amplitude, number(column_fit, row), what//', fit')
   end subroutine compare_row

   subroutine march_as_reference(multigrid, wave, amplitude_over_film, steps, amplitude, time, film, what)
      type(full_multigrid_t), intent(inout) :: multigrid
      type(waviness_t), intent(in) :: wave
      real(dp), intent(in) :: amplitude_over_film
      integer, intent(in) :: steps
      real(dp), intent(out) :: amplitude, time(0:), film(0:)
      character(len=*), intent(in) :: what
      real(dp), allocatable :: history(:, :, :)
      type(solve_report_t) :: report
      logical :: is_good
      integer :: k

      associate (level => multigrid%levels(size(multigrid%levels)))
         associate (problem => level%problem, given => level%given, grid => level%problem%grid)
            is_good = level%report%status == status_converged
            film(0) = grid%value_at_centre(level%state%h)
            time(0) = 0
            amplitude = amplitude_over_film*film(0)
            allocate (history(0:grid%nx, 0:grid%ny, 2))
            history = spread(problem%rheology%density(level%state%p)*level%state%h, 3, 2)
            do k = 1, steps
               time(k) = k*grid%hx
               given%transport = characteristic_transport(grid, 1, 1)
               call given%transport%carry(grid, history)
               if (k == 1) then
                  given%transport%w0 = 1/grid%hx
                  given%transport%carried(1:, :) = -history(:grid%nx - 1, :, 1)/grid%hx
               end if
               call given%set_rough(amplitude*wave%shape_at(grid%x, grid%y, time(k)))
               call multigrid%solve_level(size(multigrid%levels), solve_limits_t(tolerance=1e-7_dp), report)
               is_good = is_good .and. report%status == status_converged
               film(k) = grid%value_at_centre(level%state%h)
               history(:, :, 2) = history(:, :, 1)
               history(:, :, 1) = problem%rheology%density(level%state%p)*level%state%h
            end do
         end associate
      end associate
      call test%check(is_good, what//' converges')
   end subroutine march_as_reference

   subroutine compare(value, expected, what)
      real(dp), intent(in) :: value, expected
      character(len=*), intent(in) :: what
      call test%check_close(value, expected, what, relative=allowed)
      worst = max(worst, abs(value/expected - 1))
   end subroutine compare

end program test_reference_march
