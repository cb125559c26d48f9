!> One run of a sweep from its store to its results file.
module ehlwave_sweep_job
   use, intrinsic :: iso_fortran_env, only: error_unit, output_unit
   use ehlwave_case_work, only: case_limits_t, case_procedure, case_watch_t
   use ehlwave_clock, only: time_stamp, wall_seconds
   use ehlwave_errors, only: error_t, raise
   use ehlwave_field_file, only: check_writable
   use ehlwave_kinds, only: dp
   use ehlwave_provenance, only: program_version
   use ehlwave_scheduler, only: follow, leader_t, run_sweep
   use ehlwave_status, only: last_status
   use ehlwave_store, only: prepare_store, store_t
   use ehlwave_store_contents, only: contents_t, read_store
   use ehlwave_store_folder, only: check_store, discard_store, store_path
   use ehlwave_sweep_cases, only: sweep_t
   use ehlwave_sweep_queue, only: new_queue
   use ehlwave_sweep_report, only: print_sweep_result
   use ehlwave_sweep_start, only: choose_cases, print_notices, set_aside_crashed, write_case_list
   use ehlwave_text, only: to_text
   use ehlwave_text_file, only: read_text
   use mpi_f08, only: mpi_allreduce, mpi_bcast, mpi_character, mpi_comm, mpi_comm_rank, mpi_comm_size, &
      mpi_double_precision, mpi_get_library_version, mpi_get_processor_name, mpi_integer, mpi_logical, mpi_lor, &
      mpi_max_library_version_string, mpi_max_processor_name
   implicit none (type, external)
   private
   public :: run_job

   integer, parameter, public :: exit_done = 0, exit_failed = 1, exit_bad_input = 2, exit_not_written = 3, &
      exit_unfinished = 85

   !> What the user asked for on the command line.
   type, public :: job_options_t
      logical :: overwrite = .false.
      character(len=16) :: retry = ''            !! 'failed' or 'version'
      real(dp) :: time_limit_s = huge(1.0_dp)    !! from the start of the program on
   end type job_options_t

contains

   !> Run what is left of a sweep; `code` is the exit status. Collective. `sweep` is filled on rank 0 only.
   subroutine run_job(comm, run, sweep_path, sweep, options, code)
      type(mpi_comm), intent(in) :: comm
      procedure(case_procedure) :: run           !! run_case, or what stands for it in a test
      character(len=*), intent(in) :: sweep_path
      type(sweep_t), intent(in), target :: sweep
      type(job_options_t), intent(in) :: options
      integer, intent(out) :: code
      type(store_t), target :: store
      type(leader_t) :: leader
      type(case_watch_t) :: watch
      type(error_t), allocatable :: error
      real(dp) :: start_s
      integer :: rank, ranks

      start_s = wall_seconds()
      call mpi_comm_rank(comm, rank)
      call mpi_comm_size(comm, ranks)
      call describe_process(rank, store)
      if (rank == 0) call prepare(sweep_path, sweep, options, ranks, store, leader, error)
      if (is_anywhere(comm, allocated(error))) then
         if (rank == 0) write (error_unit, '(a)') 'ehlwave-sweep: '//error%message
         code = exit_bad_input
         return
      end if
      call share(comm, sweep, store, watch%limits)
      watch%store => store
      watch%deadline_s = start_s + options%time_limit_s
      if (rank == 0) then
         leader%case_watch_t = watch
         call run_sweep(comm, run, leader)
      else
         call follow(comm, run, watch)
      end if
      call store%close(error)
      leader%is_store_broken = is_anywhere(comm, leader%is_store_broken .or. allocated(error))
      code = exit_done
      if (rank == 0) call conclude(leader, code)
   end subroutine run_job

   subroutine describe_process(rank, store)
      integer, intent(in) :: rank
      type(store_t), intent(inout) :: store
      character(len=mpi_max_processor_name) :: host
      character(len=mpi_max_library_version_string) :: library
      character(len=64) :: job
      integer :: length

      store%rank = rank
      call mpi_get_processor_name(host, length)
      store%host = host(:length)
      call get_environment_variable('SLURM_JOB_ID', job)
      if (job == '') call get_environment_variable('PBS_JOBID', job)
      store%job = trim(job)
      call mpi_get_library_version(library, length)
      store%mpi_library = library(:scan(library(:length)//',', ','//achar(10)//achar(0)) - 1)
   end subroutine describe_process

   !> Rank 0: take over the store, find out what is left to run, say so.
   subroutine prepare(sweep_path, sweep, options, ranks, store, leader, error)
      character(len=*), intent(in) :: sweep_path
      type(sweep_t), intent(in), target :: sweep
      type(job_options_t), intent(in) :: options
      integer, intent(in) :: ranks
      type(store_t), intent(inout) :: store
      type(leader_t), intent(inout) :: leader
      type(error_t), allocatable, intent(inout) :: error
      type(contents_t) :: contents
      character(len=:), allocatable :: folder, warning
      logical, allocatable :: to_run(:)
      integer, allocatable :: status(:)
      real(dp), allocatable :: seconds(:)
      integer :: i

      folder = store_path(sweep%output)
      call check_writable(sweep%output, error)
      if (options%overwrite) call discard_store(folder, error)
      if (.not. (allocated(error) .or. options%overwrite)) call refuse_foreign_results(sweep%output, folder, error)
      call prepare_store(folder, store, warning, error)
      call read_store(folder, contents, error)
      if (.not. allocated(error)) call read_text(sweep_path, leader%writer%sweep_text, error)
      if (allocated(error)) return

      write (output_unit, '(a)') 'ehlwave-sweep '//program_version//': '//to_text(size(sweep%cases))//' cases on '// &
         to_text(ranks)//' ranks, results in '//sweep%output
      if (allocated(warning)) write (output_unit, '(a)') 'NOTICE: '//warning
      if (sweep%skipped > 0) write (output_unit, '(a)') to_text(sweep%skipped)//' unresolved cases are left out as asked'
      allocate (to_run(size(sweep%cases)), status(size(sweep%cases)), seconds(size(sweep%cases)))
      call choose_cases(sweep, store, contents, options%retry, to_run, status, seconds)
      call print_notices(sweep, contents, to_run, options%retry)
      call write_case_list(sweep, store, error)
      call set_aside_crashed(sweep, contents, store, to_run, status, error)
      if (allocated(error)) return
      flush (output_unit)

      leader%sweep => sweep
      leader%writer%sweep => sweep
      leader%writer%folder = folder
      leader%writer%ranks = ranks
      leader%progress%total = size(sweep%cases)
      leader%progress%ranks = ranks
      leader%progress%start_s = wall_seconds()
      do i = 1, size(sweep%cases)
         if (.not. to_run(i)) call leader%progress%count_case(status(i), seconds(i))
      end do
      leader%queue = new_queue(sweep%cases, sweep%plans, to_run, seconds, ranks)
   end subroutine prepare

   !> A results file without a store was not made by this sweep: it is not replaced unasked.
   subroutine refuse_foreign_results(output, folder, error)
      character(len=*), intent(in) :: output, folder
      type(error_t), allocatable, intent(inout) :: error
      logical :: has_results, has_store
      call check_store(folder, has_store, error)
      inquire (file=output, exist=has_results)
      if (has_results .and. .not. (has_store .or. allocated(error))) call raise(error, 'results file '//output// &
         ' exists but not its store '//folder//': move it away, name another with --output, or give --overwrite')
   end subroutine refuse_foreign_results

   !> What all ranks must know.
   subroutine share(comm, sweep, store, limits)
      type(mpi_comm), intent(in) :: comm
      type(sweep_t), intent(in) :: sweep
      type(store_t), intent(inout) :: store
      type(case_limits_t), intent(out) :: limits
      real(dp) :: numbers(2)
      integer :: integers(2), rank

      call mpi_comm_rank(comm, rank)
      if (rank == 0) then
         numbers = [sweep%limits%largest_case_seconds, sweep%limits%checkpoint_seconds]
         integers = [store%run, len(store%folder)]
      end if
      call mpi_bcast(numbers, 2, mpi_double_precision, 0, comm)
      call mpi_bcast(integers, 2, mpi_integer, 0, comm)
      limits = case_limits_t(numbers(1), numbers(2))
      store%run = integers(1)
      if (rank /= 0) store%folder = repeat(' ', integers(2))
      call mpi_bcast(store%folder, integers(2), mpi_character, 0, comm)
   end subroutine share

   !> Whether something is true on some rank.
   logical function is_anywhere(comm, flag)
      type(mpi_comm), intent(in) :: comm
      logical, intent(in) :: flag
      call mpi_allreduce(flag, is_anywhere, 1, mpi_logical, mpi_lor, comm)
   end function is_anywhere

   !> Rank 0: make the results file from the store and say what became of the sweep.
   subroutine conclude(leader, code)
      type(leader_t), intent(inout) :: leader
      integer, intent(out) :: code
      type(contents_t) :: contents
      type(error_t), allocatable :: error
      integer :: i, place, stored(0:last_status), lost

      call leader%writer%write(contents, error)
      stored = 0
      do i = 1, size(leader%sweep%cases)
         place = contents%index%find(leader%sweep%identity(i))
         if (place > 0) stored(contents%cases(place)%status) = stored(contents%cases(place)%status) + 1
      end do
      lost = leader%progress%done() - sum(stored)
      if (lost > 0 .and. .not. allocated(error)) call raise(error, to_text(lost)//' cases were reported as done but are '// &
         'not in the store '//leader%writer%folder//': is the disk broken? The same command computes them again')

      call leader%progress%tick(leader%queue%seconds_left(), is_last=.true.)
      call print_sweep_result(output_unit, leader%progress, leader%sweep%output)
      code = merge(exit_failed, exit_done, leader%progress%failed() > 0)
      if (leader%progress%done() < leader%progress%total) then
         code = exit_unfinished
         write (output_unit, '(a)') time_stamp()//' stopped, because '//trim(leader%reason)// &
            '; the same command goes on with the rest'
      end if
      if (leader%is_store_broken .or. allocated(error)) code = exit_not_written
      flush (output_unit)
      if (leader%is_store_broken) write (error_unit, '(a)') 'ehlwave-sweep: '//trim(leader%reason)
      if (allocated(error)) write (error_unit, '(a)') 'ehlwave-sweep: '//error%message
   end subroutine conclude

end module ehlwave_sweep_job
