!> ehlwave-sweep: many contacts, distributed over MPI ranks.
program ehlwave_sweep
   use, intrinsic :: iso_fortran_env, only: output_unit
   use ehlwave_arguments, only: arguments_t, read_arguments
   use ehlwave_case_table, only: read_output_name, read_sweep
   use ehlwave_errors, only: error_t
   use ehlwave_mpi_start, only: watch_start
   use ehlwave_output_path, only: check_output_name
   use ehlwave_petsc_library, only: finish_petsc
   use ehlwave_process, only: catch_signals, end_program, ignore_write_signals
   use ehlwave_provenance, only: git_revision, program_version
   use ehlwave_provenance_list, only: version_text
   use ehlwave_refined_case, only: run_refined_case
   use ehlwave_sweep_cases, only: sweep_t
   use ehlwave_sweep_job, only: mpi_library, run_job
   use ehlwave_sweep_keys, only: sweep_key_reference
   use ehlwave_sweep_leader, only: exit_bad_input, exit_done, exit_failed, exit_not_written, exit_unfinished, &
      job_options_t
   use ehlwave_sweep_report, only: print_sweep_plan
   use ehlwave_sweep_status, only: print_status
   use ehlwave_terminal, only: complain, print_last, say_lines
   use ehlwave_threads, only: thread_count, wait_briefly
   use ehlwave_time_text, only: read_time
   use mpi_f08, only: mpi_bcast, mpi_comm_rank, mpi_comm_world, mpi_finalize, mpi_init, mpi_logical
   implicit none (type, external)

   character(len=*), parameter :: usage(35) = [character(len=120) :: &
      'Usage: mpirun -n RANKS ehlwave-sweep SWEEP.nml [--plan] [--output FILE.h5] [--time-limit TIME]', &
      '                                     [--retry failed|version|files] [--overwrite]', &
      '       ehlwave-sweep --status FILE.h5|SWEEP.nml', &
      '', &
      'Runs every combination of the lists in a sweep file, or every row of its CSV file; ranks take', &
      'cases as they become free, the longest expected first. A case that does not converge is a row', &
      'with its status. Without mpirun the same program runs on one rank.', &
      '', &
      'Every finished case is stored at once, in the folder FILE.store beside FILE.h5. The same command', &
      'again goes on where a run was stopped or killed, and with new cases when the sweep file has some.', &
      '', &
      '  --plan            list the cases with grids, steps and resolution; compute nothing', &
      '  --output FILE     results file, overrides the name in the sweep file', &
      '  --time-limit TIME stop after SECONDS, M:SS, H:MM:SS or D-HH:MM:SS: take no more cases, keep', &
      '                    checkpoints of those under way, exit with status 85', &
      '  --retry failed    run cases that did not converge, and those set aside, once more', &
      '  --retry version   run cases of other versions of the program once more', &
      '  --retry files     run cases once more whose files had other numbers when they were stored', &
      '  --overwrite       drop the store and the results file, begin anew', &
      '  --status FILE     print the content of a store (counts, slowest, failed, time left); compute nothing', &
      '  --keys            all keys of a sweep file, with defaults and meaning; --markdown: as in inputs/keys', &
      '  --version         version of the program; --verbose: with build, libraries, MPI, processor', &
      '  --help            this text', &
      '', &
      'SIGTERM, SIGUSR1, SIGINT and SIGXCPU stop a run as --time-limit does. scripts/run-sweep starts the rest of a', &
      'sweep again when a rank died.', &
      '', &
      'Exit status: 0 all cases converged (or are flagged unresolved); 1 all cases ran, some did not converge;', &
      '             2 bad input or usage; 3 results or output could not be written; 4 too little memory,', &
      '             or MPI could not be started (too few open files: ulimit -n);', &
      '             85 stopped before the end: the same command goes on (--status: cases are left)', &
      '', &
      'A minimal sweep:   &sweep load_parameter_m = 100, 200, lubricant_parameter_l = 12.05,', &
      "                   radius_ratio_d = 1, 0.35, orientation = 'transverse', wavelength_over_a = 1 /", &
      'All keys are described in inputs/README.md.']

   type(arguments_t) :: arguments
   type(error_t), allocatable :: error
   type(sweep_t), target :: sweep
   type(job_options_t) :: options
   integer :: code, i, rank

   call read_arguments(['--plan     ', '--overwrite', '--keys     ', '--markdown ', '--help     ', '--version  ', &
                        '--verbose  '], ['--output    ', '--time-limit', '--retry     ', '--status    '], arguments, &
                        error)
   call ignore_write_signals()
   if (.not. allocated(error)) then
      call answer()
      ! as early as can be: MPI takes a while to start
      if (.not. (arguments%has('--plan') .or. arguments%has('--status'))) call catch_signals()
   end if
   if (thread_count() > 1) call wait_briefly()   ! before MPI
   call watch_start(1)
   call mpi_init()
   call watch_start(0)
   call mpi_comm_rank(mpi_comm_world, rank)
   if (allocated(error)) call refuse(error%message//'; see ehlwave-sweep --help')
   if (arguments%has('--status')) call show_status()
   if (size(arguments%files) /= 1) call refuse('give one sweep file; see ehlwave-sweep --help')
   call read_options()

   if (rank == 0 .and. arguments%has('--output')) then
      call read_sweep(trim(arguments%files(1)), sweep, error, arguments%value('--output'), options%overwrite)
   else if (rank == 0) then
      call read_sweep(trim(arguments%files(1)), sweep, error, begins_anew=options%overwrite)
   end if
   if (rank == 0 .and. arguments%has('--plan')) call check_output_name(sweep%output, error)
   call refuse_together()
   if (rank == 0) call say_lines(output_unit, sweep%notice)
   if (arguments%has('--plan')) then
      if (rank == 0) call print_sweep_plan(output_unit, sweep)
      call conclude(exit_done)
   end if
   call run_job(mpi_comm_world, run_refined_case, trim(arguments%files(1)), sweep, options, code)
   call finish(code)

contains

   !> The help and version of the program: without starting MPI, which some machines refuse outside a job. Among
   !> many processes the first of the launcher prints it.
   subroutine answer()
      character(len=*), parameter :: rank_variables(4) = [character(len=20) :: 'OMPI_COMM_WORLD_RANK', 'PMIX_RANK', &
                                                          'PMI_RANK', 'SLURM_PROCID']
      character(len=16) :: number
      character(len=:), allocatable :: text
      logical :: is_first, is_written

      if (.not. (arguments%has('--help') .or. arguments%has('--version') .or. arguments%has('--keys'))) return
      is_first = .true.
      do i = 1, size(rank_variables)
         call get_environment_variable(trim(rank_variables(i)), number)
         is_first = is_first .and. (number == '' .or. number == '0')
      end do
      if (.not. is_first) call end_program(exit_done)
      if (arguments%has('--help')) then
         write (output_unit, '(a)') (trim(usage(i)), i=1, size(usage) - 1)
         text = trim(usage(size(usage)))
      else if (arguments%has('--version')) then
         text = version_text(arguments%has('--verbose'), mpi_library())
      else
         text = sweep_key_reference(arguments%has('--markdown'))
      end if
      call print_last(text, is_written)
      if (.not. is_written) call complain('ehlwave-sweep', 'standard output could not be written')
      call end_program(merge(exit_done, exit_not_written, is_written))
   end subroutine answer

   subroutine show_status()
      character(len=:), allocatable :: path
      integer :: failed, status
      logical :: is_finished
      status = exit_done
      if (rank == 0) then
         path = arguments%value('--status')
         if (index(path, '.nml') > 0 .and. index(path, '.nml') == len(path) - 3) &
            call read_output_name(arguments%value('--status'), path, error)
         if (.not. allocated(error)) call print_status(output_unit, path, is_finished, failed, error)
         if (.not. allocated(error)) status = merge(merge(exit_failed, exit_done, failed > 0), exit_unfinished, &
                                                     is_finished)
      end if
      call refuse_together()
      call conclude(status)
   end subroutine show_status

   !> Print the result of a plan or a status as the last line and end, alike on all ranks.
   subroutine conclude(status)
      integer, intent(in) :: status
      logical :: is_written
      is_written = .true.
      if (rank == 0) call print_last('Program      ehlwave '//program_version//' '//git_revision, is_written)
      if (.not. is_written) call complain('ehlwave-sweep', 'standard output could not be written')
      call finish(merge(status, exit_not_written, is_written))
   end subroutine conclude

   subroutine read_options()
      options%overwrite = arguments%has('--overwrite')
      options%retry = arguments%value('--retry')
      if (all(options%retry /= [character(len=7) :: '', 'failed', 'version', 'files'])) &
         call refuse("--retry '"//trim(options%retry)//"' is not one of failed, version, files")
      if (options%overwrite .and. options%retry /= '') call refuse('--overwrite and --retry contradict each other')
      if (arguments%has('--time-limit')) then
         call read_time(arguments%value('--time-limit'), '--time-limit', options%time_limit_s, error)
         if (allocated(error)) call refuse(error%message)
      end if
   end subroutine read_options

   !> Refuse the run; called by all ranks alike.
   subroutine refuse(message)
      character(len=*), intent(in) :: message
      if (rank == 0) call complain('ehlwave-sweep', message)
      call finish(exit_bad_input)
   end subroutine refuse

   !> End all ranks when rank 0 has met an error.
   subroutine refuse_together()
      logical :: has_failed
      has_failed = allocated(error)
      call mpi_bcast(has_failed, 1, mpi_logical, 0, mpi_comm_world)
      if (.not. has_failed) return
      if (rank == 0) call complain('ehlwave-sweep', error%message)
      call finish(exit_bad_input)
   end subroutine refuse_together

   subroutine finish(status)
      integer, intent(in) :: status
      flush (output_unit)
      call finish_petsc()
      call mpi_finalize()
      call end_program(status)
   end subroutine finish

end program ehlwave_sweep
