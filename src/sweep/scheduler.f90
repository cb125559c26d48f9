!> Dynamic distribution of cases over MPI ranks: the longest expected first, cases with a common steady state together.
!>
!> Rank 0 schedules and computes: it answers messages between the steps of its own cases. Every other rank keeps an
!> answer in reserve, so that nobody waits for rank 0, and has its first before rank 0 takes one. An answer is a case,
!> or several that take `shortest_answer_s` together: rank 0 may look at messages only between two of its own cases. A
!> single rank runs the same code without messages.
module ehlwave_scheduler
   use ehlwave_case_definition, only: case_t
   use ehlwave_outcome, only: outcome_t
   use ehlwave_case_work, only: case_procedure, case_watch_t, work_on_case
   use ehlwave_errors, only: error_t
   use ehlwave_kinds, only: dp
   use ehlwave_messages, only: ask, is_waiting, next_message, no_case, outbox_t, receive_case, receive_outcome, &
      receive_word, send_word, stop_work
   use ehlwave_planned_case, only: case_plan_t
   use ehlwave_shared_steady, only: shared_steady_t
   use ehlwave_status, only: status_interrupted, status_pending
   use ehlwave_sweep_cases, only: sweep_t
   use ehlwave_sweep_queue, only: queue_t
   use mpi_f08, only: mpi_comm, mpi_comm_size
   implicit none (type, external)
   private
   public :: follow, run_sweep

   integer, parameter :: in_reserve = 2       !! unanswered requests of a worker: the answer it works on and the next
   integer, parameter :: most_in_answer = 8
   real(dp), parameter :: shortest_answer_s = 0.1_dp

   !> Any other rank: hears when to stop.
   type, extends(case_watch_t) :: worker_t
      type(mpi_comm) :: comm
      logical :: has_heard = .false.          !! `stop` has arrived
   contains
      procedure :: exchange => hear
   end type worker_t

   !> Rank 0: the queue, served whenever a case of its own reports progress. Extensions define the other tasks of
   !> rank 0.
   type, abstract, extends(case_watch_t), public :: leader_t
      type(queue_t) :: queue
      logical :: is_store_broken = .false.    !! a rank could not store a case
      logical :: is_input_changed = .false.   !! a rank could not read a file of a case as rank 0 did
      type(sweep_t), pointer :: sweep => null()
      type(mpi_comm), private :: comm
      type(outbox_t), private :: outbox
      integer, private :: running = 0         ! cases given to other ranks and not back yet
      integer, private :: asking = 0          ! requests of other ranks that are still to be answered by no_case
      logical, allocatable, private :: has_stopped(:)   ! (ranks - 1) `stop` was sent
      integer, allocatable, private :: put_off(:)       ! (ranks - 1) requests that arrived before all ranks had a case
   contains
      procedure :: exchange => serve_waiting
      procedure(count_case), deferred :: count_case
      procedure(look_after), deferred :: look_after
   end type leader_t

   abstract interface
      !> A case is finished.
      subroutine count_case(self, outcome)
         import :: leader_t, outcome_t
         implicit none (type, external)
         class(leader_t), intent(inout) :: self
         type(outcome_t), intent(in) :: outcome
      end subroutine count_case

      !> Called again and again; must return quickly.
      subroutine look_after(self)
         import :: leader_t
         implicit none (type, external)
         class(leader_t), intent(inout) :: self
      end subroutine look_after
   end interface

contains

   !> Rank 0: run all cases of the leader's queue, together with the ranks that call `follow`. Collective.
   subroutine run_sweep(comm, run, leader)
      type(mpi_comm), intent(in) :: comm
      procedure(case_procedure) :: run             !! run_case, or a substitute in a test
      class(leader_t), intent(inout) :: leader     !! cases to run; on return their outcomes
      class(shared_steady_t), allocatable, target :: shared
      type(outcome_t) :: outcome
      integer :: case, ranks

      call mpi_comm_size(comm, ranks)
      allocate (shared)
      leader%comm = comm
      call leader%outbox%init(comm, 1, ranks - 1, in_reserve*most_in_answer)
      leader%asking = in_reserve*(ranks - 1)
      allocate (leader%has_stopped(ranks - 1), source=.false.)
      allocate (leader%put_off(ranks - 1), source=0)
      call give_first(leader)
      do
         call leader%look_at_clock()
         call leader%exchange()
         if (leader%is_stopping .or. leader%queue%is_empty()) exit
         call leader%queue%take(0, case)
         call answer_put_off(leader)
         call work_on_case(run, leader%sweep%cases(case), leader%sweep%plans(case), &
                           leader%sweep%input(case), leader, shared, outcome)
         outcome%case = case
         call take_outcome(leader, outcome)
      end do
      call answer_put_off(leader)
      do while (leader%running > 0 .or. leader%asking > 0)
         call serve_one(leader)
         call look_around(leader)
      end do
      call stop_others(leader)
      call leader%outbox%wait()
   end subroutine run_sweep

   !> Wait for the first request of every other rank, and answer it: the first step of a case of rank 0 can take long.
   subroutine give_first(self)
      class(leader_t), intent(inout) :: self
      logical :: has_one(size(self%put_off)), is_request
      integer :: rank

      has_one = .false.
      do while (.not. all(has_one))
         call next_message(self%comm, rank, is_request)
         if (.not. is_request) then
            call take_back(self, rank)
         else if (has_one(rank)) then
            self%put_off(rank) = self%put_off(rank) + 1
         else
            call answer(self, rank)
            has_one(rank) = .true.
         end if
      end do
   end subroutine give_first

   !> Answer requests for a reserve that came before.
   subroutine answer_put_off(self)
      class(leader_t), intent(inout) :: self
      integer :: rank
      do rank = 1, size(self%put_off)
         do while (self%put_off(rank) > 0)
            self%put_off(rank) = self%put_off(rank) - 1
            call answer(self, rank)
         end do
      end do
   end subroutine answer_put_off

   !> Answer all messages that have arrived; pass on that all are to stop.
   subroutine serve_waiting(self)
      class(leader_t), intent(inout) :: self
      do while (is_waiting(self%comm))
         call serve_one(self)
         call look_around(self)   ! with very short cases there is always another message
      end do
      call look_around(self)
   end subroutine serve_waiting

   !> Check for a stop request, and do the other tasks of rank 0.
   subroutine look_around(self)
      class(leader_t), intent(inout) :: self
      call self%look_at_clock()
      if (self%is_stopping) call stop_others(self)
      call self%look_after()
   end subroutine look_around

   !> Tell the other ranks to stop, each once.
   subroutine stop_others(self)
      class(leader_t), intent(inout) :: self
      integer :: rank
      do rank = 1, size(self%has_stopped)
         if (.not. self%has_stopped(rank)) call send_word(self%comm, rank, stop_work)
      end do
      self%has_stopped = .true.
   end subroutine stop_others

   !> Receive a message: a request for a case, or the outcome of one.
   subroutine serve_one(self)
      class(leader_t), intent(inout) :: self
      integer :: rank
      logical :: is_request

      call next_message(self%comm, rank, is_request)
      if (is_request) then
         call answer(self, rank)
      else
         call take_back(self, rank)
      end if
   end subroutine serve_one

   !> Receive the outcome of a case.
   subroutine take_back(self, rank)
      class(leader_t), intent(inout) :: self
      integer, intent(in) :: rank
      type(outcome_t) :: outcome
      call receive_outcome(self%comm, rank, outcome)
      self%running = self%running - 1
      call take_outcome(self, outcome)
   end subroutine take_back

   !> Give cases, if any are left, to a rank that asks; in the end one at a time.
   subroutine answer(self, rank)
      class(leader_t), intent(inout) :: self
      integer, intent(in) :: rank
      integer :: case, left
      real(dp) :: seconds

      if (self%is_stopping .or. self%queue%is_empty()) then
         self%asking = self%asking - 1
         call self%outbox%send_case(rank, no_case)
         return
      end if
      seconds = 0
      left = min(most_in_answer, 1 + self%queue%waiting/(2*in_reserve*(size(self%has_stopped) + 1)))
      do while (left > 0)
         call self%queue%take(rank, case)
         self%running = self%running + 1
         seconds = seconds + self%queue%expected_seconds(case)
         left = merge(left - 1, 0, seconds < shortest_answer_s)
         call self%outbox%send_case(rank, case, self%sweep%input(case), self%sweep%cases(case)%fields, &
                                    self%sweep%plans(case)%files, is_last=left == 0)
      end do
   end subroutine answer

   !> A case is finished, or could not be: then all stop.
   subroutine take_outcome(self, outcome)
      class(leader_t), intent(inout) :: self
      type(outcome_t), intent(in) :: outcome

      if (outcome%status == status_pending .or. outcome%status == status_interrupted) then
         self%is_stopping = .true.
         if ((outcome%is_store_broken .and. .not. self%is_store_broken) .or. &
             (outcome%is_input_changed .and. .not. (self%is_store_broken .or. self%is_input_changed))) &
            self%reason = outcome%message
         if (self%reason == '') self%reason = 'a signal asked for it'
         self%is_store_broken = self%is_store_broken .or. outcome%is_store_broken
         self%is_input_changed = self%is_input_changed .or. outcome%is_input_changed
      else
         call self%queue%learn(outcome%case, outcome%seconds)
         call self%count_case(outcome)
      end if
   end subroutine take_outcome

   !> Any other rank: ask, run, report, until there is nothing left. Collective with `run_sweep`.
   subroutine follow(comm, run, watch)
      type(mpi_comm), intent(in) :: comm
      procedure(case_procedure) :: run
      type(case_watch_t), intent(in) :: watch     !! store, limits and deadline
      type(worker_t) :: worker
      class(shared_steady_t), allocatable, target :: shared
      type(outbox_t) :: outbox
      type(outcome_t) :: outcome
      type(case_t) :: case
      type(case_plan_t) :: plan
      type(error_t), allocatable :: error
      character(len=:), allocatable :: input
      integer :: i, number, unanswered
      logical :: is_last

      allocate (shared)
      worker%case_watch_t = watch
      worker%comm = comm
      call outbox%init(comm, 0, 0, in_reserve*most_in_answer)
      do i = 1, in_reserve
         call send_word(comm, 0, ask)
      end do
      unanswered = in_reserve
      do while (unanswered > 0)
         if (allocated(error)) deallocate (error)
         call receive_case(comm, number, case, plan, input, is_last, error)
         if (is_last) unanswered = unanswered - 1
         if (number == no_case) cycle
         call worker%look_at_clock()
         call worker%exchange()
         outcome = outcome_t()
         if (allocated(error)) then
            outcome = outcome_t(message=error%message, is_input_changed=.true.)
         else if (.not. worker%is_stopping) then
            call work_on_case(run, case, plan, input, worker, shared, outcome)
         end if
         if (outcome%is_store_broken .or. outcome%is_input_changed) worker%is_stopping = .true.
         outcome%case = number
         call outbox%send_outcome(outcome)
         if (.not. is_last) cycle
         call send_word(comm, 0, ask)
         unanswered = unanswered + 1
      end do
      if (.not. worker%has_heard) call receive_word(comm, 0, stop_work)
      call outbox%wait()
   end subroutine follow

   !> Whether rank 0 has a request to stop all ranks.
   subroutine hear(self)
      class(worker_t), intent(inout) :: self
      if (self%has_heard) return
      if (.not. is_waiting(self%comm, stop_work)) return
      call receive_word(self%comm, 0, stop_work)
      self%has_heard = .true.
      self%is_stopping = .true.
   end subroutine hear

end module ehlwave_scheduler
