!> Processes a case of a sweep: runs it, and stores its result.
module ehlwave_case_work
   use ehlwave_case_account, only: refused_result
   use ehlwave_case_definition, only: case_t
   use ehlwave_case_files, only: file_digests
   use ehlwave_case_record, only: store_result
   use ehlwave_case_result, only: case_result_t
   use ehlwave_case_text, only: input_identity
   use ehlwave_checkpoint_file, only: checkpoint_t
   use ehlwave_clock, only: time_stamp, wall_seconds
   use ehlwave_errors, only: error_t
   use ehlwave_kinds, only: dp
   use ehlwave_march_keeper, only: march_keeper_t
   use ehlwave_memory_plan, only: memory_shortage
   use ehlwave_monitor, only: give_up, go_on, monitor_t, stop_now
   use ehlwave_outcome, only: message_length, outcome_t
   use ehlwave_planned_case, only: case_plan_t, run_march
   use ehlwave_process, only: signal_caught, watchdog
   use ehlwave_shared_steady, only: shared_steady_t
   use ehlwave_status, only: status_interrupted
   use ehlwave_store, only: store_t
   use ehlwave_sweep_cases, only: case_limits_t
   implicit none (type, external)
   private
   public :: case_procedure, work_on_case

   !> Watches the time while a case runs and keeps a rank in touch with the others.
   type, extends(monitor_t), public :: case_watch_t
      type(store_t), pointer :: store => null()
      type(case_limits_t) :: limits
      real(dp) :: deadline_s = huge(1.0_dp)   !! wall_seconds at which to stop
      logical :: is_stopping = .false.        !! take no more cases, stop the present case
      character(len=message_length) :: reason = ''   !! reason for stopping
      real(dp), private :: case_start_s = 0
   contains
      procedure :: step_done => look_up
      procedure :: look_at_clock
      procedure :: exchange
   end type case_watch_t

   abstract interface
      !> The interface of `run_refined_case`.
      subroutine case_procedure(case, plan, monitor, result, shared, keeper)
         import :: case_plan_t, case_result_t, case_t, march_keeper_t, monitor_t, shared_steady_t
         implicit none (type, external)
         type(case_t), intent(in) :: case
         type(case_plan_t), intent(inout) :: plan      !! on return the shared state of the result
         class(monitor_t), intent(inout) :: monitor
         type(case_result_t), intent(out) :: result
         type(shared_steady_t), intent(inout), target, optional :: shared
         class(march_keeper_t), intent(inout), optional :: keeper
      end subroutine case_procedure
   end interface

contains

   !> Run a case and store it.
   subroutine work_on_case(run, case, plan, input, watch, shared, outcome)
      procedure(case_procedure) :: run
      type(case_t), intent(in) :: case
      type(case_plan_t), intent(in) :: plan
      character(len=*), intent(in) :: input      !! effective input of the case
      class(case_watch_t), intent(inout) :: watch
      type(shared_steady_t), intent(inout), target :: shared   !! steady state of the rank, from one case to the next
      type(outcome_t), intent(out) :: outcome
      type(case_result_t) :: result
      type(case_plan_t) :: used                  ! may become finer
      type(checkpoint_t) :: checkpoint
      type(error_t), allocatable :: error
      character(len=24) :: started
      character(len=:), allocatable :: shortage
      character(len=16) :: identity

      identity = input_identity(input)
      used = plan
      started = time_stamp()
      watch%request = go_on
      watch%case_start_s = wall_seconds()
      call watch%store%start(identity, error)
      if (.not. allocated(error)) then
         checkpoint%path = watch%store%checkpoint_path(identity)
         checkpoint%identity = identity//file_digests(plan%files)
         checkpoint%interval_s = watch%limits%checkpoint_seconds
         checkpoint%start_s = watch%case_start_s
         ! A case that does not even notice that its time is up hangs: this process ends itself.
         if (watch%limits%largest_case_seconds > 0) call watchdog(ceiling(2*watch%limits%largest_case_seconds + 60))
         shortage = memory_shortage(plan)
         if (shortage == '') then
            call run(case, used, watch, result, shared, checkpoint)
         else
            result = refused_result(case, plan, shortage)
         end if
         call watchdog(0)
         if (result%status == status_interrupted) then
            call watch%store%stop(identity, error)
         else
            call store_result(case, used, input, result, started, watch%store, error)
            if (.not. allocated(error) .and. plan%kind == run_march) call checkpoint%discard()
         end if
         outcome%status = result%status
         outcome%seconds = result%seconds
         outcome%message = result%message
      end if
      if (allocated(error)) outcome = outcome_t(message=error%message, is_store_broken=.true.)
   end subroutine work_on_case

   !> Called between the steps of a case.
   subroutine look_up(self, stage, done, total)
      class(case_watch_t), intent(inout) :: self
      character(len=*), intent(in) :: stage
      integer, intent(in) :: done, total
      type(error_t), allocatable :: error

      call self%look_at_clock()
      call self%exchange()
      call self%store%sync(error)   ! an error shows again when the case is stored
      self%request = go_on
      if (self%limits%largest_case_seconds > 0) then
         if (wall_seconds() - self%case_start_s > self%limits%largest_case_seconds) self%request = give_up
      end if
      if (self%is_stopping) self%request = stop_now
      if (.false.) then   ! how far the case is, is of no interest here
         associate (a => stage, b => done, c => total)
         end associate
      end if
   end subroutine look_up

   !> Notice signals and the time limit.
   subroutine look_at_clock(self)
      class(case_watch_t), intent(inout) :: self
      if (self%is_stopping) return
      if (signal_caught() /= 0) then
         self%is_stopping = .true.
         self%reason = 'a signal asked for it'
      else if (wall_seconds() > self%deadline_s) then
         self%is_stopping = .true.
         self%reason = 'the time limit is reached'
      end if
   end subroutine look_at_clock

   !> Messages from and to other ranks; with a single process there are none.
   subroutine exchange(self)
      class(case_watch_t), intent(inout) :: self
      if (.false.) self%request = go_on
   end subroutine exchange

end module ehlwave_case_work
