!> Units and long names of the columns of a results file.
module ehlwave_column_names
   implicit none (type, external)
   private
   public :: describe_column

contains

   !> Units and long name of a column. One that is not listed here describes itself: underscores become blanks, the
   !> unit is told by the end of the name.
   pure subroutine describe_column(name, units, long_name)
      character(len=*), intent(in) :: name
      character(len=:), allocatable, intent(out) :: units, long_name
      integer :: i

      units = '1'
      select case (name)
      case ('case_id'); long_name = 'identity of the effective input'
      case ('status'); long_name = 'outcome'
      case ('message'); long_name = 'why a case did not converge or is not resolved'
      case ('central_film'); long_name = 'smooth central film thickness H(0,0)'
      case ('minimum_film'); long_name = 'smallest H of the smooth contact'
      case ('central_film_moes'); long_name = 'H(0,0) in the Moes scale'
      case ('max_pressure'); long_name = 'largest P of the smooth contact'
      case ('amplitude_ratio'); long_name = 'Ad/Ai from the samples'
      case ('amplitude_ratio_fit'); long_name = 'Ad/Ai from a harmonic fit'
      case ('phase_fit'); long_name = 'phase of the harmonic fit against the pattern at the centre'
      case ('harmonic_ratio'); long_name = 'Ad/Ai of small waves, linear response'
      case ('harmonic_phase'); long_name = 'phase of the linear response of H(0,0)'
      case ('harmonic_real'); long_name = 'transfer function pattern to H(0,0), real part'
      case ('harmonic_imaginary'); long_name = 'transfer function, imaginary part'
      case ('harmonic_approach'); long_name = 'amplitude of the approach over Ai'
      case ('harmonic_extrapolated'); long_name = 'harmonic_ratio at mesh size 0'
      case ('harmonic_error'); long_name = 'estimated relative error of harmonic_ratio'
      case ('harmonic_linear_steps'); long_name = 'GMRES steps of the linear response'
      case ('harmonic_work_units'); long_name = 'cost of the linear response'
      case ('mean_film'); long_name = 'mean of H(0,0) over the measured period'
      case ('central_film_error'); long_name = 'estimated relative error of central_film'
      case ('minimum_film_error'); long_name = 'estimated relative error of minimum_film'
      case ('film_order'); long_name = 'observed order of central_film on three levels'
      case ('amplitude_ratio_error'); long_name = 'estimated relative error of Ad/Ai'
      case ('amplitude_error_basis'); long_name = 'what amplitude_ratio_error is from'
      case ('expected_error'); long_name = 'relative error expected by the plan'
      case ('expected_work_units'); long_name = 'work expected by the plan, in plain FFT convolutions of the grid'
      case ('v'); long_name = 'V of theory eq. (17)'
      case ('v2'); long_name = 'V2 of theory eq. (16)'
      case ('f_r'); long_name = 'f(r) of theory eq. (15)'
      case ('formula_ratio'); long_name = 'Ad/Ai by theory eq. (18)'
      case ('residual'); long_name = 'largest mass residual of the solutions'
      case ('load_error'); long_name = 'largest load error of the solutions'
      case ('residual_history'); long_name = 'mass residual of the solution that failed, before each step and at the end'
      case ('seconds'); long_name = 'wall time of the case'
      case ('work_units'); long_name = 'wall time in plain FFT convolutions of the grid'
      case ('peak_memory_mib'); long_name = 'peak memory of the rank so far'
      case ('time_steps'); long_name = 'time steps done'
      case ('nonlinear_steps'); long_name = 'Newton steps on the finest grid'
      case ('linear_steps'); long_name = 'GMRES steps on the finest grid'
      case ('rung'); long_name = 'highest rung of the rescue ladder used'
      case ('rescued_solutions'); long_name = 'solutions that took more than the direct solve'
      case ('rank'); long_name = 'MPI rank the case ran on, -1: not run'
      case ('run'); long_name = 'run of the program, counted from 1 in its store; -1: not run'
      case ('host'); long_name = 'machine the case ran on'
      case ('job'); long_name = 'batch job the case ran in'
      case ('mpi_library'); long_name = 'MPI library, as it names itself'
      case ('started', 'finished'); long_name = 'local time'
      case ('effective_input'); long_name = 'case file that reproduces the case'
      case default
         long_name = name
         do i = 1, len(name)
            if (name(i:i) == '_') long_name(i:i) = ' '
         end do
      end select
      if (name == 'seconds' .or. ends_with(name, '_seconds')) units = 's'
      if (name == 'phase_fit' .or. name == 'harmonic_phase') units = 'rad'
      if (ends_with(name, '_mib')) units = 'MiB'
      if (ends_with(name, '_um')) units = 'um'
      if (ends_with(name, '_m') .and. name /= 'load_parameter_m') units = 'm'
      if (ends_with(name, '_pa')) units = 'Pa'
   end subroutine describe_column

   pure logical function ends_with(name, ending)
      character(len=*), intent(in) :: name, ending
      ends_with = .false.
      if (len(name) > len(ending)) ends_with = name(len(name) - len(ending) + 1:) == ending
   end function ends_with

end module ehlwave_column_names
