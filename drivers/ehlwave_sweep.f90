!> ehlwave-sweep: many contacts, distributed over MPI ranks.
program ehlwave_sweep
   use, intrinsic :: iso_fortran_env, only: error_unit, output_unit
   use ehlwave_arguments, only: arguments_t, read_arguments
   use ehlwave_case_table, only: read_sweep, sweep_t
   use ehlwave_errors, only: error_t
   use ehlwave_field_file, only: check_writable
   use ehlwave_petsc_solver, only: finish_petsc
   use ehlwave_provenance, only: program_version
   use ehlwave_results_file, only: row_t
   use ehlwave_scheduler, only: run_sweep
   use ehlwave_sweep_progress, only: new_progress, progress_t
   use ehlwave_sweep_report, only: print_sweep_plan, print_sweep_result
   use ehlwave_text_file, only: read_text
   use mpi_f08, only: mpi_barrier, mpi_comm_rank, mpi_comm_size, mpi_comm_world, mpi_finalize, mpi_init
   implicit none (type, external)

   character(len=*), parameter :: usage(18) = [character(len=96) :: &
      'Usage: mpirun -n RANKS ehlwave-sweep SWEEP.nml [--plan] [--output FILE.h5] [--overwrite]', &
      '', &
      'Runs every combination of the lists in a sweep file, or every row of its CSV file; ranks take', &
      'cases as they become free, the longest expected first. A case that does not converge is a row', &
      'with its status. Without mpirun the same program runs on one rank.', &
      '', &
      '  --plan           list the cases with grids, steps and resolution; compute nothing', &
      '  --output FILE    results file, in place of the one named in the sweep file', &
      '  --overwrite      replace an existing results file', &
      '  --version        version of the program', &
      '  --help           this text', &
      '', &
      'Exit status: 0 all cases converged (or are flagged unresolved); 1 some did not;', &
      '             2 bad input or usage; 3 results could not be written', &
      '', &
      'A minimal sweep:   &sweep load_parameter_m = 100, 200, lubricant_parameter_l = 12.05,', &
      "                   radius_ratio_d = 1, 0.35, orientation = 'transverse', wavelength_over_a = 1 /", &
      'All keys are described in the README.']

   type(arguments_t) :: arguments
   type(error_t), allocatable :: error
   type(sweep_t), target :: sweep
   type(progress_t) :: progress
   type(row_t), allocatable :: rows(:)
   character(len=:), allocatable :: text
   integer :: code, i, rank, ranks
   logical :: is_there

   call mpi_init()
   call mpi_comm_rank(mpi_comm_world, rank)
   call mpi_comm_size(mpi_comm_world, ranks)
   call read_arguments(['--plan     ', '--overwrite', '--help     ', '--version  '], ['--output'], arguments, error)
   if (allocated(error)) call refuse(error%message//'; see ehlwave-sweep --help')
   if (arguments%has('--help') .or. arguments%has('--version')) then
      if (rank == 0 .and. arguments%has('--help')) write (output_unit, '(a)') (trim(usage(i)), i=1, size(usage))
      if (rank == 0 .and. .not. arguments%has('--help')) write (output_unit, '(a)') 'ehlwave '//program_version
      call finish(0)
   end if
   if (size(arguments%files) /= 1) call refuse('give one sweep file; see ehlwave-sweep --help')

   call read_sweep(trim(arguments%files(1)), sweep, error)
   if (allocated(error)) call refuse(error%message)
   if (arguments%has('--output')) sweep%output = arguments%value('--output')
   if (arguments%has('--plan')) then
      if (rank == 0) call print_sweep_plan(output_unit, sweep)
      call finish(0)
   end if

   inquire (file=sweep%output, exist=is_there)
   call mpi_barrier(mpi_comm_world)
   if (is_there .and. .not. arguments%has('--overwrite')) call refuse('results file '//sweep%output// &
      ' exists: move it away, name another with --output, or give --overwrite')
   if (rank == 0) call check_writable(sweep%output, error)
   call stop_together(allocated(error))
   call read_text(trim(arguments%files(1)), text, error)

   if (rank == 0) then
      progress = new_progress(sweep, text, ranks)
      call print_start()
   end if
   call run_sweep(mpi_comm_world, sweep, progress, rows)
   code = 0
   if (rank == 0) then
      if (progress%failed > 0) code = 1
      call progress%write(rows, error)
      if (allocated(error)) then
         write (error_unit, '(a)') 'ehlwave-sweep: '//error%message
         code = 3
      end if
      call print_sweep_result(output_unit, sweep, rows)
   end if
   call finish(code)

contains

   subroutine print_start()
      write (output_unit, '(a,i0,a,i0,a)') 'ehlwave-sweep '//program_version//': ', size(sweep%cases), ' cases on ', ranks, &
         ' ranks, results in '//sweep%output
      if (sweep%skipped > 0) write (output_unit, '(i0,a)') sweep%skipped, ' unresolved cases are left out as asked'
      flush (output_unit)
   end subroutine print_start

   !> Refuse the run; called by all ranks alike.
   subroutine refuse(message)
      character(len=*), intent(in) :: message
      if (rank == 0) write (error_unit, '(a)') 'ehlwave-sweep: '//message
      call finish(2)
   end subroutine refuse

   !> End all ranks when rank 0 has met an error.
   subroutine stop_together(has_failed)
      use mpi_f08, only: mpi_bcast, mpi_logical
      logical, intent(in) :: has_failed
      logical :: flag
      flag = has_failed
      call mpi_bcast(flag, 1, mpi_logical, 0, mpi_comm_world)
      if (.not. flag) return
      if (rank == 0) write (error_unit, '(a)') 'ehlwave-sweep: '//error%message
      call finish(2)
   end subroutine stop_together

   subroutine finish(status)
      integer, intent(in) :: status
      flush (output_unit)
      call finish_petsc()
      call mpi_finalize()
      stop status, quiet=.true.
   end subroutine finish

end program ehlwave_sweep
