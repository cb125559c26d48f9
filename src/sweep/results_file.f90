!> HDF5 file of a sweep: one row per case over the dimension `case`, whatever its status.
module ehlwave_results_file
   use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
   use ehlwave_case_input, only: case_t
   use ehlwave_case_plan, only: case_plan_t
   use ehlwave_case_result, only: case_result_t
   use ehlwave_case_text, only: case_identity, effective_input, effective_length
   use ehlwave_error_estimate, only: basis_name
   use ehlwave_errors, only: error_t
   use ehlwave_field_file, only: write_provenance
   use ehlwave_hdf5_file, only: hdf5_file_t
   use ehlwave_kinds, only: dp
   use ehlwave_status, only: status_name, status_pending
   implicit none (type, external)
   private
   public :: write_results

   integer, parameter, public :: text_length = 256   !! longest message and host name kept

   !> A case with what it came to and where it ran.
   type, public :: row_t
      type(case_result_t) :: result
      character(len=text_length) :: message = '', host = ''
      character(len=24) :: started = '', finished = ''
      integer :: rank = -1
   end type row_t

contains

   !> Write all rows. The file appears under its name only when it is complete.
   subroutine write_results(path, sweep_text, cases, plans, rows, error)
      character(len=*), intent(in) :: path
      character(len=*), intent(in) :: sweep_text         !! the sweep file as it was
      type(case_t), intent(in) :: cases(:)
      type(case_plan_t), intent(in) :: plans(:)
      type(row_t), intent(in) :: rows(:)
      type(error_t), allocatable, intent(out) :: error
      type(hdf5_file_t) :: file
      character(len=16) :: identity(size(cases)), status(size(cases))
      integer :: i, n

      n = size(cases)
      call file%create(path, error)
      if (allocated(error)) return
      call file%attribute('', 'title', 'ehlwave: amplitude reduction of waviness in EHL contacts')
      call file%attribute('', 'format', 'ehlwave-results')
      call file%attribute('', 'format_version', 1)
      call write_provenance(file)
      call file%attribute('', 'sweep_input', sweep_text)

      call file%write('case', [(i, i=1, n)], '', '1', 'number of the case in the sweep')
      call file%dimension('case')
      do i = 1, n
         identity(i) = case_identity(cases(i))
         status(i) = status_name(rows(i)%result%status)
      end do
      call texts('case_id', identity, 'identity of the effective input')
      call texts('orientation', cases%orientation, 'orientation of the waviness')
      call texts('status', status, 'outcome')
      call texts('message', rows%message, 'why a case did not converge or is not resolved')
      call write_inputs()
      call write_outcomes()
      call texts('host', rows%host, 'machine the case ran on')
      call texts('started', rows%started, 'local time')
      call texts('finished', rows%finished, 'local time')
      call write_effective_inputs()
      call file%finish(error)

   contains

      subroutine reals(name, values, units, long_name)
         character(len=*), intent(in) :: name, units, long_name
         real(dp), intent(in) :: values(:)
         call file%write(name, values, 'case', units, long_name)
      end subroutine reals

      !> Results: NaN for cases that have not run.
      subroutine outcomes(name, values, units, long_name)
         character(len=*), intent(in) :: name, units, long_name
         real(dp), intent(in) :: values(:)
         call reals(name, merge(ieee_value(1.0_dp, ieee_quiet_nan), values, rows%result%status == status_pending), &
                    units, long_name)
      end subroutine outcomes

      subroutine integers(name, values, long_name)
         character(len=*), intent(in) :: name, long_name
         integer, intent(in) :: values(:)
         call file%write(name, values, 'case', '1', long_name)
      end subroutine integers

      subroutine texts(name, values, long_name)
         character(len=*), intent(in) :: name, long_name
         character(len=*), intent(in) :: values(:)
         call file%write(name, values, 'case', '', long_name)
      end subroutine texts

      subroutine write_inputs()
         call reals('load_parameter_m', plans%conditions%m, '1', 'Moes load parameter M')
         call reals('lubricant_parameter_l', plans%conditions%l, '1', 'Moes lubricant parameter L')
         call reals('radius_ratio_d', plans%conditions%d, '1', 'D = Rx/Ry')
         call reals('slip_parameter', cases%slip_parameter, '1', 'speed of the wavy surface over the mean speed')
         call reals('wavelength_over_a', cases%wavelength_over_a, '1', 'shorter wavelength over a, 0: smooth')
         call reals('wavelength_x_over_a', cases%wavelength_x_over_a, '1', 'lambda_x/a, 0: no variation along x')
         call reals('wavelength_y_over_a', cases%wavelength_y_over_a, '1', 'lambda_y/a, 0: no variation along y')
         call texts('response', cases%response, 'transient, harmonic (small waves) or both')
         call reals('amplitude_over_film', cases%amplitude_over_film, '1', 'Ai over the smooth central film')
         call reals('kappa', plans%conditions%elliptic%kappa, '1', 'ellipticity a/b')
         call reals('gamma', plans%conditions%gamma, '1', 'pressure factor of the ellipticity')
         call reals('alphabar', plans%conditions%alphabar, '1', 'alpha ph')
         call reals('lambdabar', plans%conditions%lambdabar, '1', 'dimensionless speed parameter')
         call integers('cells_x', plans%cells_x, 'cells along X')
         call integers('cells_y', plans%cells_y, 'cells along Y, whole domain')
         call texts('deformation', plans%deformation, 'fft or mlmi on the finest grid')
         call reals('points_per_wave_x', plans%resolution%points_x, '1', 'mesh sizes per wave along X')
         call reals('points_per_wave_y', plans%resolution%points_y, '1', 'mesh sizes per wave along Y')
         call reals('inlet_resolution', plans%resolution%inlet, '1', 'hX over the length of the inlet pressure sweep')
         call reals('inlet_gap_over_film', plans%resolution%inlet_gap, '1', 'gap at x_min over the film of the formula')
         call integers('is_resolved', merge(1, 0, plans%resolution%is_resolved .and. rows%result%is_resolved), &
                       '1 when the grid resolves the case')
      end subroutine write_inputs

      subroutine write_outcomes()
         associate (r => rows%result)
            call outcomes('central_film', r%central_film, '1', 'smooth central film thickness H(0,0)')
            call outcomes('minimum_film', r%minimum_film, '1', 'smallest H of the smooth contact')
            call outcomes('central_film_moes', r%central_film_moes, '1', 'H(0,0) in the Moes scale')
            call outcomes('max_pressure', r%max_pressure, '1', 'largest P of the smooth contact')
            call outcomes('amplitude_ratio', r%amplitude_ratio, '1', 'Ad/Ai from the samples')
            call outcomes('amplitude_ratio_fit', r%amplitude_ratio_fit, '1', 'Ad/Ai from a harmonic fit')
            call outcomes('phase_fit', r%phase_fit, 'rad', 'phase of the harmonic fit against the pattern at the centre')
            call outcomes('harmonic_ratio', r%harmonic%ratio, '1', 'Ad/Ai of small waves, linear response')
            call outcomes('harmonic_phase', r%harmonic%phase, 'rad', 'phase of the linear response of H(0,0)')
            call outcomes('harmonic_real', r%harmonic%real_part, '1', 'transfer function pattern to H(0,0), real part')
            call outcomes('harmonic_imaginary', r%harmonic%imaginary_part, '1', 'transfer function, imaginary part')
            call outcomes('harmonic_approach', r%harmonic%approach_ratio, '1', 'amplitude of the approach over Ai')
            call outcomes('harmonic_extrapolated', r%harmonic%extrapolated, '1', 'harmonic_ratio at mesh size 0')
            call outcomes('harmonic_error', r%harmonic%error, '1', 'estimated relative error of harmonic_ratio')
            call integers('harmonic_linear_steps', r%harmonic%linear_steps, 'GMRES steps of the linear response')
            call outcomes('harmonic_work_units', r%harmonic%work_units, '1', 'cost of the linear response')
            call outcomes('mean_film', r%mean_film, '1', 'mean of H(0,0) over the measured period')
            call outcomes('central_film_error', r%central_film_error, '1', 'estimated relative error of central_film')
            call outcomes('minimum_film_error', r%minimum_film_error, '1', 'estimated relative error of minimum_film')
            call outcomes('film_order', r%film_order, '1', 'observed order of central_film on three levels')
            call outcomes('amplitude_ratio_error', r%amplitude_ratio_error, '1', 'estimated relative error of Ad/Ai')
            call texts('amplitude_error_basis', basis_name(r%amplitude_error_basis), &
                       'what amplitude_ratio_error is from')
            call outcomes('v', r%v, '1', 'V of theory eq. (17)')
            call outcomes('v2', r%v2, '1', 'V2 of theory eq. (16)')
            call outcomes('f_r', r%f_r, '1', 'f(r) of theory eq. (15)')
            call outcomes('formula_ratio', r%formula_ratio, '1', 'Ad/Ai by theory eq. (18)')
            call outcomes('residual', r%residual, '1', 'largest mass residual of the solutions')
            call outcomes('load_error', r%load_error, '1', 'largest load error of the solutions')
            call outcomes('seconds', r%seconds, 's', 'wall time of the case')
            call outcomes('work_units', r%work_units, '1', 'wall time in plain FFT convolutions of the grid')
            call outcomes('peak_memory_mib', r%peak_memory_mib, 'MiB', 'peak memory of the rank so far')
            call integers('time_steps', r%time_steps, 'time steps done')
            call integers('nonlinear_steps', r%nonlinear_steps, 'Newton steps on the finest grid')
            call integers('linear_steps', r%linear_steps, 'GMRES steps on the finest grid')
            call texts('rung', r%rung, 'highest rung of the rescue ladder used')
            call integers('rescued_solutions', r%rescued_solutions, 'solutions that took more than the direct solve')
         end associate
         call integers('rank', rows%rank, 'MPI rank the case ran on, -1: not run')
      end subroutine write_outcomes

      subroutine write_effective_inputs()
         character(len=effective_length) :: inputs(n)
         integer :: k
         do k = 1, n
            inputs(k) = effective_input(cases(k))
         end do
         call texts('effective_input', inputs, 'case file that reproduces the case')
      end subroutine write_effective_inputs

   end subroutine write_results

end module ehlwave_results_file
