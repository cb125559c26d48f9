!> Dynamic distribution of cases over MPI ranks: the longest expected first, cases of one steady state together.
!>
!> Rank 0 schedules and computes: it answers messages between the steps of its own cases. Every other rank
!> keeps one case in reserve, so that nobody waits for rank 0. One rank runs the same code without messages.
!> A case travels as its effective input, so only rank 0 reads the sweep file. Results do not travel: every rank
!> puts its own into the store.
!>
!> Messages between rank 0 and another rank: `ask` is answered by `case` (number 0: there is none), every case by
!> `done`, and rank 0 sends exactly one `stop`: when everybody is to stop, or at the end.
module ehlwave_scheduler
   use ehlwave_case_definition, only: case_t
   use ehlwave_case_file, only: case_from_text
   use ehlwave_case_plan, only: case_plan_t, make_plan
   use ehlwave_case_text, only: effective_input
   use ehlwave_case_work, only: case_procedure, case_watch_t, message_length, outcome_t, work_on_case
   use ehlwave_errors, only: error_t, raise
   use ehlwave_kinds, only: dp
   use ehlwave_results_writer, only: results_writer_t
   use ehlwave_shared_steady, only: shared_steady_t
   use ehlwave_status, only: status_interrupted, status_pending
   use ehlwave_sweep_cases, only: sweep_t
   use ehlwave_sweep_progress, only: progress_t
   use ehlwave_sweep_queue, only: queue_t
   use ehlwave_text, only: to_text
   use mpi_f08, only: mpi_any_source, mpi_any_tag, mpi_character, mpi_comm, mpi_comm_size, &
      mpi_double_precision, mpi_get_count, mpi_iprobe, mpi_probe, mpi_recv, mpi_send, mpi_status, mpi_status_ignore
   implicit none (type, external)
   private
   public :: follow, run_sweep

   integer, parameter :: tag_ask = 1, tag_case = 2, tag_numbers = 3, tag_text = 4, tag_stop = 5
   integer, parameter :: no_case = 0
   integer, parameter :: number_digits = 12   !! of the number of a case, before its input; then T: keep fields
   integer, parameter :: in_reserve = 2       !! unanswered requests of a worker: the case it runs and the next

   !> Any other rank: hears when to stop.
   type, extends(case_watch_t) :: worker_t
      type(mpi_comm) :: comm
      logical :: has_heard = .false.          !! the one `stop` has arrived
   contains
      procedure :: exchange => hear
   end type worker_t

   !> Rank 0: the queue, served whenever a case of its own reports progress.
   type, extends(case_watch_t), public :: leader_t
      type(queue_t) :: queue
      type(progress_t) :: progress
      type(results_writer_t) :: writer
      logical :: is_store_broken = .false.    !! a rank could not store a case
      type(sweep_t), pointer :: sweep => null()
      type(mpi_comm), private :: comm
      integer, private :: running = 0         ! cases given to other ranks and not back yet
      integer, private :: asking = 0          ! requests of other ranks that are still to be answered by no_case
      logical, allocatable, private :: has_stopped(:)   ! (ranks - 1) `stop` was sent
   contains
      procedure :: exchange => serve_waiting
   end type leader_t

contains

   !> Rank 0: run all cases of the leader's queue, together with the ranks that call `follow`. Collective.
   subroutine run_sweep(comm, run, leader)
      type(mpi_comm), intent(in) :: comm
      procedure(case_procedure) :: run            !! run_case, or what stands for it in a test
      type(leader_t), intent(inout) :: leader     !! ready to go; on return what became of everything
      type(shared_steady_t), target :: shared
      type(outcome_t) :: outcome
      integer :: case, rank, ranks

      call mpi_comm_size(comm, ranks)
      leader%comm = comm
      leader%asking = in_reserve*(ranks - 1)
      allocate (leader%has_stopped(ranks - 1), source=.false.)
      do
         call leader%look_at_clock()
         call leader%exchange()
         if (leader%is_stopping .or. leader%queue%is_empty()) exit
         call leader%queue%take(0, case)
         call work_on_case(run, leader%sweep%cases(case), leader%sweep%plans(case), &
                           effective_input(leader%sweep%cases(case)), leader, shared, outcome)
         call take_outcome(leader, case, outcome)
      end do
      do while (leader%running > 0 .or. leader%asking > 0)
         call serve_one(leader)
         call look_after(leader)
      end do
      do rank = 1, ranks - 1
         call tell_stop(leader, rank)
      end do
   end subroutine run_sweep

   !> Answer all messages that have arrived; pass on that all are to stop.
   subroutine serve_waiting(self)
      class(leader_t), intent(inout) :: self
      logical :: is_waiting

      do
         call mpi_iprobe(mpi_any_source, mpi_any_tag, self%comm, is_waiting, mpi_status_ignore)
         if (.not. is_waiting) exit
         call serve_one(self)
         call look_after(self)   ! with very short cases there is always another message
      end do
      call look_after(self)
   end subroutine serve_waiting

   !> What rank 0 does besides: stop the others, tell the progress, renew the results file.
   subroutine look_after(self)
      class(leader_t), intent(inout) :: self
      integer :: rank
      call self%look_at_clock()
      if (self%is_stopping) then
         do rank = 1, size(self%has_stopped)
            call tell_stop(self, rank)
         end do
      end if
      call self%progress%tick(self%queue%seconds_left())
      call self%writer%renew(self%progress%done())
   end subroutine look_after

   subroutine tell_stop(self, rank)
      class(leader_t), intent(inout) :: self
      integer, intent(in) :: rank
      if (self%has_stopped(rank)) return
      self%has_stopped(rank) = .true.
      call mpi_send('', 0, mpi_character, rank, tag_stop, self%comm)
   end subroutine tell_stop

   !> Receive one message: a request for a case, or the outcome of one.
   subroutine serve_one(self)
      class(leader_t), intent(inout) :: self
      type(mpi_status) :: status
      type(outcome_t) :: outcome
      real(dp) :: numbers(4)
      integer :: case

      call mpi_probe(mpi_any_source, mpi_any_tag, self%comm, status)
      select case (status%mpi_tag)
      case (tag_ask)
         call receive_nothing(self%comm, status%mpi_source, tag_ask)
         if (self%is_stopping .or. self%queue%is_empty()) then
            self%asking = self%asking - 1
            call send_case(self%comm, status%mpi_source, no_case)
         else
            call self%queue%take(status%mpi_source, case)
            self%running = self%running + 1
            call send_case(self%comm, status%mpi_source, case, self%sweep%cases(case))
         end if
      case default
         call mpi_recv(numbers, 4, mpi_double_precision, status%mpi_source, tag_numbers, self%comm, mpi_status_ignore)
         call mpi_recv(outcome%message, message_length, mpi_character, status%mpi_source, tag_text, self%comm, &
                       mpi_status_ignore)
         outcome%status = nint(numbers(2))
         outcome%seconds = numbers(3)
         outcome%is_store_broken = numbers(4) > 0.5_dp
         self%running = self%running - 1
         call take_outcome(self, nint(numbers(1)), outcome)
      end select
   end subroutine serve_one

   !> A case is finished, or could not be: then all stop.
   subroutine take_outcome(self, case, outcome)
      class(leader_t), intent(inout) :: self
      integer, intent(in) :: case
      type(outcome_t), intent(in) :: outcome

      if (outcome%status == status_pending .or. outcome%status == status_interrupted) then
         self%is_stopping = .true.
         if (outcome%is_store_broken .and. .not. self%is_store_broken) self%reason = outcome%message
         if (self%reason == '') self%reason = 'a signal asked for it'
         self%is_store_broken = self%is_store_broken .or. outcome%is_store_broken
      else
         call self%queue%learn(case, outcome%seconds)
         call self%progress%finished(case, outcome)
      end if
   end subroutine take_outcome

   !> Any other rank: ask, run, report, until there is nothing left. Collective with `run_sweep`.
   subroutine follow(comm, run, watch)
      type(mpi_comm), intent(in) :: comm
      procedure(case_procedure) :: run
      type(case_watch_t), intent(in) :: watch     !! store, limits and deadline
      type(worker_t) :: worker
      type(shared_steady_t), target :: shared
      type(outcome_t) :: outcome
      type(case_t) :: case
      type(case_plan_t) :: plan
      type(error_t), allocatable :: error
      character(len=:), allocatable :: input
      integer :: i, number, unanswered

      worker%case_watch_t = watch
      worker%comm = comm
      do i = 1, in_reserve
         call mpi_send('', 0, mpi_character, 0, tag_ask, comm)
      end do
      unanswered = in_reserve
      do while (unanswered > 0)
         if (allocated(error)) deallocate (error)
         call receive_case(comm, number, case, plan, input, error)
         unanswered = unanswered - 1
         if (number == no_case) cycle
         call worker%look_at_clock()
         call worker%exchange()
         outcome = outcome_t()
         if (allocated(error)) then
            outcome = outcome_t(message=error%message, is_store_broken=.true.)
         else if (.not. worker%is_stopping) then
            call work_on_case(run, case, plan, input, worker, shared, outcome)
         end if
         if (outcome%is_store_broken) worker%is_stopping = .true.
         call mpi_send([real(dp) :: number, outcome%status, outcome%seconds, merge(1, 0, outcome%is_store_broken)], 4, &
                       mpi_double_precision, 0, tag_numbers, comm)
         call mpi_send(outcome%message, message_length, mpi_character, 0, tag_text, comm)
         call mpi_send('', 0, mpi_character, 0, tag_ask, comm)
         unanswered = unanswered + 1
      end do
      if (.not. worker%has_heard) call receive_nothing(comm, 0, tag_stop)
   end subroutine follow

   !> Whether rank 0 wants all to stop.
   subroutine hear(self)
      class(worker_t), intent(inout) :: self
      logical :: is_waiting
      if (self%has_heard) return
      call mpi_iprobe(0, tag_stop, self%comm, is_waiting, mpi_status_ignore)
      if (.not. is_waiting) return
      call receive_nothing(self%comm, 0, tag_stop)
      self%has_heard = .true.
      self%is_stopping = .true.
   end subroutine hear

   subroutine receive_nothing(comm, source, tag)
      type(mpi_comm), intent(in) :: comm
      integer, intent(in) :: source, tag
      character(len=1) :: nothing
      call mpi_recv(nothing, 0, mpi_character, source, tag, comm, mpi_status_ignore)
   end subroutine receive_nothing

   subroutine send_case(comm, rank, number, case)
      type(mpi_comm), intent(in) :: comm
      integer, intent(in) :: rank, number
      type(case_t), intent(in), optional :: case
      character(len=number_digits) :: digits
      character(len=:), allocatable :: text

      write (digits, '(i12)') number
      text = digits
      if (present(case)) text = digits//merge('T', 'F', case%fields)//effective_input(case)
      call mpi_send(text, len(text), mpi_character, rank, tag_case, comm)
   end subroutine send_case

   !> Receive a case and plan it as rank 0 did. Fails when it does not come out the same.
   subroutine receive_case(comm, number, case, plan, input, error)
      type(mpi_comm), intent(in) :: comm
      integer, intent(out) :: number
      type(case_t), intent(out) :: case
      type(case_plan_t), intent(out) :: plan
      character(len=:), allocatable, intent(out) :: input   !! its effective input
      type(error_t), allocatable, intent(inout) :: error
      type(mpi_status) :: status
      character(len=:), allocatable :: text
      integer :: length

      call mpi_probe(0, tag_case, comm, status)
      call mpi_get_count(status, mpi_character, length)
      allocate (character(len=length) :: text)
      call mpi_recv(text, length, mpi_character, 0, tag_case, comm, mpi_status_ignore)
      read (text(:number_digits), *) number
      if (number == no_case) return
      input = text(number_digits + 2:)
      call case_from_text(input, case, error)
      if (.not. allocated(error)) call make_plan(case, plan, error)
      case%fields = text(number_digits + 1:number_digits + 1) == 'T'
      if (.not. allocated(error)) then
         if (effective_input(case) /= input) &
            call raise(error, 'case '//to_text(number)//' arrived with another input')
      end if
   end subroutine receive_case

end module ehlwave_scheduler
