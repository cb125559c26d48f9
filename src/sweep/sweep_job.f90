!> A run of a sweep from its store to its results file, on all ranks.
module ehlwave_sweep_job
   use, intrinsic :: iso_fortran_env, only: output_unit
   use ehlwave_case_work, only: case_procedure, case_watch_t
   use ehlwave_clock, only: rest_for, wall_seconds
   use ehlwave_errors, only: error_t
   use ehlwave_kinds, only: dp
   use ehlwave_scheduler, only: follow, run_sweep
   use ehlwave_store, only: store_t
   use ehlwave_sweep_cases, only: case_limits_t, sweep_t
   use ehlwave_sweep_leader, only: exit_bad_input, exit_done, exit_not_written, job_options_t, job_t
   use ehlwave_terminal, only: complain, say
   use ehlwave_threads, only: most_cores, own_cores, share_of_cores, take_threads, threads_notice
   use mpi_f08, only: mpi_allreduce, mpi_bcast, mpi_byte, mpi_character, mpi_comm, mpi_comm_free, mpi_comm_rank, &
      mpi_comm_size, mpi_comm_split_type, mpi_comm_type_shared, mpi_get_library_version, mpi_get_processor_name, &
      mpi_ibarrier, mpi_info_null, mpi_integer, mpi_logical, mpi_lor, mpi_max_library_version_string, &
      mpi_max_processor_name, mpi_request, mpi_status_ignore, mpi_sum, mpi_test
   implicit none (type, external)
   private
   public :: mpi_library, run_job

   real(dp), parameter :: between_looks_s = 0.01_dp

contains

   !> Run the rest of a sweep; `code` is the exit status. Collective. `sweep` is filled on rank 0 only.
   subroutine run_job(comm, run, sweep_path, sweep, options, code)
      type(mpi_comm), intent(in) :: comm
      procedure(case_procedure) :: run           !! run_case, or a substitute in a test
      character(len=*), intent(in) :: sweep_path
      type(sweep_t), intent(in), target :: sweep
      type(job_options_t), intent(in) :: options
      integer, intent(out) :: code
      type(store_t), target :: store
      type(job_t) :: job
      type(case_watch_t) :: watch
      type(error_t), allocatable :: error
      character(len=:), allocatable :: notice
      real(dp) :: start_s
      integer :: cases, rank, ranks

      start_s = wall_seconds()
      call mpi_comm_rank(comm, rank)
      call mpi_comm_size(comm, ranks)
      call describe_process(rank, store)
      if (rank == 0) call job%prepare(sweep_path, sweep, options, ranks, store, error)
      if (is_anywhere(comm, allocated(error))) then
         if (rank == 0) call complain('ehlwave-sweep', error%message)
         code = merge(exit_not_written, exit_bad_input, is_anywhere(comm, job%is_store_broken))
         return
      end if
      call share(comm, sweep, store, watch%limits, cases)
      notice = threads_notice(watch%limits%threads)
      if (rank == 0 .and. notice /= '') call say(output_unit, 'NOTICE: '//notice)
      call take_threads(watch%limits%threads, cores_of_rank(comm, cases))
      watch%store => store
      watch%deadline_s = start_s + options%time_limit_s
      if (rank == 0) then
         job%case_watch_t = watch
         call run_sweep(comm, run, job)
      else
         call follow(comm, run, watch)
      end if
      call store%close(error)
      job%is_store_broken = is_anywhere(comm, job%is_store_broken .or. allocated(error))
      code = exit_done
      if (rank == 0) call job%conclude(code)
      call wait_for_all(comm)
   end subroutine run_job

   !> Wait until every rank is here, without the processor: who waits in MPI itself takes it from rank 0, which writes
   !> the results, where ranks share cores.
   subroutine wait_for_all(comm)
      type(mpi_comm), intent(in) :: comm
      type(mpi_request) :: request
      logical :: is_done

      call mpi_ibarrier(comm, request)
      do
         call mpi_test(request, is_done, mpi_status_ignore)
         if (is_done) return
         call rest_for(between_looks_s)
      end do
   end subroutine wait_for_all

   subroutine describe_process(rank, store)
      integer, intent(in) :: rank
      type(store_t), intent(inout) :: store
      character(len=mpi_max_processor_name) :: host
      character(len=64) :: batch_job
      integer :: length

      store%rank = rank
      call mpi_get_processor_name(host, length)
      store%host = host(:length)
      call get_environment_variable('SLURM_JOB_ID', batch_job)
      if (batch_job == '') call get_environment_variable('PBS_JOBID', batch_job)
      store%job = batch_job
      store%mpi_library = mpi_library()
   end subroutine describe_process

   !> The MPI library as it names itself, up to the first comma or end of line.
   function mpi_library() result(name)
      character(len=:), allocatable :: name
      character(len=mpi_max_library_version_string) :: library
      integer :: length
      call mpi_get_library_version(library, length)
      name = library(:scan(library(:length)//',', ','//achar(10)//achar(0)) - 1)
   end function mpi_library

   !> Data of a sweep that all ranks need.
   subroutine share(comm, sweep, store, limits, cases)
      type(mpi_comm), intent(in) :: comm
      type(sweep_t), intent(in) :: sweep
      type(store_t), intent(inout) :: store
      type(case_limits_t), intent(out) :: limits
      integer, intent(out) :: cases
      integer :: numbers(4), rank

      call mpi_comm_rank(comm, rank)
      if (rank == 0) then
         limits = sweep%limits
         numbers = [store%run, store%defaults, len(store%folder), size(sweep%cases)]
      end if
      call mpi_bcast(limits, storage_size(limits)/8, mpi_byte, 0, comm)
      call mpi_bcast(numbers, size(numbers), mpi_integer, 0, comm)
      store%run = numbers(1)
      store%defaults = numbers(2)
      cases = numbers(4)
      if (rank /= 0) store%folder = repeat(' ', numbers(3))
      call mpi_bcast(store%folder, numbers(3), mpi_character, 0, comm)
   end subroutine share

   !> Cores that a rank has to itself: those that it is bound to, shared with the ranks of its machine that may use them
   !> and have a case.
   integer function cores_of_rank(comm, cases) result(cores)
      type(mpi_comm), intent(in) :: comm
      integer, intent(in) :: cases
      type(mpi_comm) :: machine
      integer :: is_mine(most_cores), rank, users(most_cores)

      call mpi_comm_rank(comm, rank)
      is_mine = 0
      if (rank < cases) is_mine = own_cores()
      call mpi_comm_split_type(comm, mpi_comm_type_shared, 0, mpi_info_null, machine)
      call mpi_allreduce(is_mine, users, most_cores, mpi_integer, mpi_sum, machine)
      call mpi_comm_free(machine)
      cores = share_of_cores(is_mine, users)
   end function cores_of_rank

   !> Whether something is true on some rank.
   logical function is_anywhere(comm, flag)
      type(mpi_comm), intent(in) :: comm
      logical, intent(in) :: flag
      call mpi_allreduce(flag, is_anywhere, 1, mpi_logical, mpi_lor, comm)
   end function is_anywhere

end module ehlwave_sweep_job
