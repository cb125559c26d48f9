!> Dynamic distribution of cases over MPI ranks: the longest expected first, cases of one steady state together.
!>
!> Rank 0 schedules and computes: it answers messages between the steps of its own cases. Every other rank
!> keeps one case in reserve, so that nobody waits for rank 0. One rank runs the same code without messages.
module ehlwave_scheduler
   use ehlwave_case_queue, only: case_queue_t, new_queue
   use ehlwave_case_result, only: case_result_t, rung_length
   use ehlwave_case_table, only: sweep_t
   use ehlwave_clock, only: time_stamp
   use ehlwave_estimated_case, only: run_estimated_case
   use ehlwave_kinds, only: dp
   use ehlwave_monitor, only: monitor_t, silent_monitor_t
   use ehlwave_harmonic_result, only: harmonic_result_t
   use ehlwave_results_file, only: row_t, text_length
   use ehlwave_shared_steady, only: shared_steady_t
   use ehlwave_sweep_progress, only: progress_t
   use mpi_f08, only: mpi_any_source, mpi_any_tag, mpi_character, mpi_comm, mpi_comm_rank, mpi_comm_size, &
      mpi_double_precision, mpi_get_processor_name, mpi_integer, mpi_iprobe, mpi_max_processor_name, mpi_probe, &
      mpi_recv, mpi_send, mpi_status, mpi_status_ignore
   implicit none (type, external)
   private
   public :: run_sweep

   integer, parameter :: tag_ask = 1, tag_case = 2, tag_numbers = 3, tag_text = 4
   integer, parameter :: no_case = 0
   integer, parameter :: numbers = 39
   integer, parameter :: in_reserve = 2   !! unanswered requests of a worker: the case it runs and the next

   !> Rank 0: the queue and the rows, served whenever a case of its own reports progress.
   type, extends(monitor_t) :: schedule_t
      type(mpi_comm) :: comm
      type(case_queue_t) :: queue
      integer :: running = 0                  !! cases given to other ranks and not back yet
      integer :: asking = 0                   !! requests of other ranks that are still to be answered by no_case
      type(row_t), allocatable :: rows(:)
      type(progress_t) :: progress
   contains
      procedure :: step_done => serve_waiting
   end type schedule_t

contains

   !> Run all cases; on rank 0 `rows` holds every result, elsewhere it is empty. Collective.
   subroutine run_sweep(comm, sweep, progress, rows)
      type(mpi_comm), intent(in) :: comm
      type(sweep_t), intent(in) :: sweep
      type(progress_t), intent(inout) :: progress   !! used on rank 0
      type(row_t), allocatable, intent(out) :: rows(:)
      integer :: rank, ranks

      call mpi_comm_rank(comm, rank)
      call mpi_comm_size(comm, ranks)
      if (rank == 0) then
         call schedule(comm, ranks, sweep, progress, rows)
      else
         call work(comm, rank, sweep)
         allocate (rows(0))
      end if
   end subroutine run_sweep

   subroutine schedule(comm, ranks, sweep, progress, rows)
      type(mpi_comm), intent(in) :: comm
      integer, intent(in) :: ranks
      type(sweep_t), intent(in) :: sweep
      type(progress_t), intent(inout) :: progress
      type(row_t), allocatable, intent(out) :: rows(:)
      type(schedule_t) :: self
      type(shared_steady_t), target :: shared
      type(row_t) :: row
      integer :: case

      self%comm = comm
      self%queue = new_queue(sweep%cases, sweep%plans, ranks)
      self%asking = in_reserve*(ranks - 1)
      allocate (self%rows(size(sweep%cases)))
      self%progress = progress
      do
         call serve_waiting(self, '', 0, 0)
         call self%queue%take(0, case)
         if (case == no_case) exit
         call run_row(0, sweep, case, self, shared, row)
         call keep(self, case, row)
      end do
      do while (self%running > 0 .or. self%asking > 0)
         call serve_one(self)
      end do
      progress = self%progress
      call move_alloc(self%rows, rows)
   end subroutine schedule

   !> Answer all messages that have arrived.
   subroutine serve_waiting(self, stage, done, total)
      class(schedule_t), intent(inout) :: self
      character(len=*), intent(in) :: stage
      integer, intent(in) :: done, total
      logical :: is_waiting

      do
         call mpi_iprobe(mpi_any_source, mpi_any_tag, self%comm, is_waiting, mpi_status_ignore)
         if (.not. is_waiting) exit
         call serve_one(self)
      end do
      call self%progress%tick(self%rows)
      if (.false.) then   ! the stage of the own case is of no interest here
         associate (a => stage, b => done, c => total)
         end associate
      end if
   end subroutine serve_waiting

   !> Receive one message: a request for a case, or a result.
   subroutine serve_one(self)
      class(schedule_t), intent(inout) :: self
      type(mpi_status) :: status
      type(row_t) :: row
      integer :: case

      call mpi_probe(mpi_any_source, mpi_any_tag, self%comm, status)
      select case (status%mpi_tag)
      case (tag_ask)
         call mpi_recv(case, 1, mpi_integer, status%mpi_source, tag_ask, self%comm, mpi_status_ignore)
         call self%queue%take(status%mpi_source, case)
         if (case /= no_case) then
            self%running = self%running + 1
         else
            self%asking = self%asking - 1
         end if
         call mpi_send(case, 1, mpi_integer, status%mpi_source, tag_case, self%comm)
      case default
         call receive_row(self%comm, status%mpi_source, case, row)
         self%running = self%running - 1
         call keep(self, case, row)
      end select
   end subroutine serve_one

   subroutine keep(self, case, row)
      class(schedule_t), intent(inout) :: self
      integer, intent(in) :: case
      type(row_t), intent(in) :: row
      self%rows(case) = row
      call self%progress%finished(case, self%rows)
   end subroutine keep

   !> Any other rank: ask, run, report.
   subroutine work(comm, rank, sweep)
      type(mpi_comm), intent(in) :: comm
      integer, intent(in) :: rank
      type(sweep_t), intent(in) :: sweep
      type(silent_monitor_t) :: monitor
      type(shared_steady_t), target :: shared
      type(row_t) :: row
      integer :: case, i, unanswered

      do i = 1, in_reserve
         call mpi_send(no_case, 1, mpi_integer, 0, tag_ask, comm)
      end do
      unanswered = in_reserve
      do while (unanswered > 0)
         call mpi_recv(case, 1, mpi_integer, 0, tag_case, comm, mpi_status_ignore)
         unanswered = unanswered - 1
         if (case == no_case) cycle
         call run_row(rank, sweep, case, monitor, shared, row)
         call send_row(comm, case, row)
         call mpi_send(no_case, 1, mpi_integer, 0, tag_ask, comm)
         unanswered = unanswered + 1
      end do
   end subroutine work

   subroutine run_row(rank, sweep, case, monitor, shared, row)
      integer, intent(in) :: rank
      type(sweep_t), intent(in) :: sweep
      integer, intent(in) :: case
      class(monitor_t), intent(inout) :: monitor
      type(shared_steady_t), intent(inout), target :: shared   !! of the rank, from one case to the next
      type(row_t), intent(out) :: row
      character(len=mpi_max_processor_name) :: host
      integer :: length

      call mpi_get_processor_name(host, length)
      row%host = host(:length)
      row%rank = rank
      row%started = time_stamp()
      call run_estimated_case(sweep%cases(case), sweep%plans(case), monitor, row%result, shared)
      row%finished = time_stamp()
      row%message = row%result%message
   end subroutine run_row

   subroutine send_row(comm, case, row)
      type(mpi_comm), intent(in) :: comm
      integer, intent(in) :: case
      type(row_t), intent(in) :: row
      real(dp) :: buffer(numbers)
      character(len=2*text_length + 48 + rung_length) :: text

      associate (r => row%result)
         buffer = [real(dp) :: case, row%rank, r%status, merge(1, 0, r%is_resolved), r%central_film, r%minimum_film, &
                   r%central_film_moes, r%max_pressure, r%amplitude_ratio, r%amplitude_ratio_fit, r%mean_film, r%v, &
                   r%v2, r%f_r, r%formula_ratio, r%residual, r%load_error, r%time_steps, r%nonlinear_steps, &
                   r%linear_steps, r%seconds, r%work_units, r%peak_memory_mib, r%central_film_error, &
                   r%minimum_film_error, r%film_order, r%amplitude_ratio_error, r%amplitude_error_basis, &
                   r%rescued_solutions, r%phase_fit, r%harmonic%ratio, r%harmonic%phase, r%harmonic%real_part, &
                   r%harmonic%imaginary_part, r%harmonic%approach_ratio, r%harmonic%extrapolated, r%harmonic%error, &
                   r%harmonic%linear_steps, r%harmonic%work_units]
      end associate
      text = row%message//row%host//row%started//row%finished//row%result%rung
      call mpi_send(buffer, numbers, mpi_double_precision, 0, tag_numbers, comm)
      call mpi_send(text, len(text), mpi_character, 0, tag_text, comm)
   end subroutine send_row

   subroutine receive_row(comm, source, case, row)
      type(mpi_comm), intent(in) :: comm
      integer, intent(in) :: source
      integer, intent(out) :: case
      type(row_t), intent(out) :: row
      real(dp) :: buffer(numbers)
      character(len=2*text_length + 48 + rung_length) :: text

      call mpi_recv(buffer, numbers, mpi_double_precision, source, tag_numbers, comm, mpi_status_ignore)
      call mpi_recv(text, len(text), mpi_character, source, tag_text, comm, mpi_status_ignore)
      case = nint(buffer(1))
      row%rank = nint(buffer(2))
      row%result = case_result_t(status=nint(buffer(3)), is_resolved=buffer(4) > 0.5_dp, central_film=buffer(5), &
         minimum_film=buffer(6), central_film_moes=buffer(7), max_pressure=buffer(8), amplitude_ratio=buffer(9), &
         amplitude_ratio_fit=buffer(10), mean_film=buffer(11), v=buffer(12), v2=buffer(13), f_r=buffer(14), &
         formula_ratio=buffer(15), residual=buffer(16), load_error=buffer(17), time_steps=nint(buffer(18)), &
         nonlinear_steps=nint(buffer(19)), linear_steps=nint(buffer(20)), seconds=buffer(21), work_units=buffer(22), &
         peak_memory_mib=buffer(23), central_film_error=buffer(24), minimum_film_error=buffer(25), film_order=buffer(26), &
         amplitude_ratio_error=buffer(27), amplitude_error_basis=nint(buffer(28)), &
         rescued_solutions=nint(buffer(29)), rung=text(2*text_length + 49:), phase_fit=buffer(30), &
         harmonic=harmonic_result_t(buffer(31), buffer(32), buffer(33), buffer(34), buffer(35), buffer(36), buffer(37), &
                                    nint(buffer(38)), buffer(39)))
      row%message = text(1:text_length)
      row%host = text(text_length + 1:2*text_length)
      row%started = text(2*text_length + 1:2*text_length + 24)
      row%finished = text(2*text_length + 25:2*text_length + 48)
   end subroutine receive_row

end module ehlwave_scheduler
