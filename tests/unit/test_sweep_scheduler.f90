!> Cases with prescribed outcomes.
module planned_case
   use ehlwave_case_account, only: blank_result
   use ehlwave_case_definition, only: case_t
   use ehlwave_case_result, only: case_result_t
   use ehlwave_outcome, only: outcome_t
   use ehlwave_clock, only: wall_seconds
   use ehlwave_kinds, only: dp
   use ehlwave_march_keeper, only: march_keeper_t
   use ehlwave_monitor, only: give_up, go_on, monitor_t, stop_now
   use ehlwave_planned_case, only: case_plan_t
   use ehlwave_scheduler, only: leader_t
   use ehlwave_shared_steady, only: shared_steady_t
   use ehlwave_status, only: status_converged, status_interrupted, status_over_budget
   implicit none (type, external)
   private
   public :: run_planned

   !> Counts reported events.
   type, extends(leader_t), public :: counting_leader_t
      integer :: looks = 0
      integer :: most_cases = huge(1)         !! its time is up when so many are done
      integer, allocatable :: done(:)         !! cases in the order in which they were finished
      integer, allocatable :: status(:)
   contains
      procedure :: count_case
      procedure :: look_after
   end type counting_leader_t

   real(dp), parameter, public :: endless_m = 500, longest_s = 0.05_dp, hangs_s = 1800

contains

   !> Substitute for run_case: converges at once, however long the machine takes; with M = 500 it works until the
   !> monitor stops it.
   subroutine run_planned(case, plan, monitor, result, shared, keeper)
      type(case_t), intent(in) :: case
      type(case_plan_t), intent(inout) :: plan
      class(monitor_t), intent(inout) :: monitor
      type(case_result_t), intent(out) :: result
      type(shared_steady_t), intent(inout), target, optional :: shared
      class(march_keeper_t), intent(inout), optional :: keeper
      real(dp) :: start

      start = wall_seconds()
      result = blank_result(case, plan)
      result%status = status_converged
      result%central_film = case%load_parameter_m
      do
         call monitor%step_done('work', 1, 1)
         if (monitor%request /= go_on .or. case%load_parameter_m < endless_m) exit
         if (wall_seconds() - start > hangs_s) exit
      end do
      if (case%load_parameter_m >= endless_m .and. monitor%request == give_up) result%status = status_over_budget
      if (case%load_parameter_m >= endless_m .and. monitor%request == stop_now) result%status = status_interrupted
      result%seconds = wall_seconds() - start + 1e-6_dp
      if (present(shared)) shared%has_coarse = .false.
      if (present(keeper)) keeper%seconds_before = 0
   end subroutine run_planned

   subroutine count_case(self, outcome)
      class(counting_leader_t), intent(inout) :: self
      type(outcome_t), intent(in) :: outcome
      self%done = [self%done, outcome%case]
      self%status = [self%status, outcome%status]
      if (size(self%done) >= self%most_cases) self%deadline_s = 0
   end subroutine count_case

   subroutine look_after(self)
      class(counting_leader_t), intent(inout) :: self
      self%looks = self%looks + 1
   end subroutine look_after

end module planned_case

!> A single rank works through a queue: longest first, every case stored; limits, stops and broken stores are heeded.
program test_sweep_scheduler
   use ehlwave_case_input, only: case_input_t
   use ehlwave_case_key, only: most_keys
   use ehlwave_case_keys, only: default_keys
   use ehlwave_case_text, only: input_identity
   use ehlwave_errors, only: error_t
   use ehlwave_json_reader, only: json_number
   use ehlwave_kinds, only: dp
   use ehlwave_key_list, only: key_list_t
   use ehlwave_scheduler, only: run_sweep
   use ehlwave_status, only: status_converged, status_over_budget
   use ehlwave_store, only: prepare_store, store_t
   use ehlwave_store_contents, only: contents_t, read_store
   use ehlwave_sweep_cases, only: sweep_t
   use ehlwave_sweep_queue, only: new_queue
   use mpi_f08, only: mpi_comm_self, mpi_finalize, mpi_init
   use planned_case, only: counting_leader_t, endless_m, longest_s, run_planned
   use testing, only: test_t
   implicit none (type, external)

   character(len=*), parameter :: folder = 'test_sweep_scheduler.store'
   integer, parameter :: cells(4) = [32, 128, 64, 96]
   type(test_t) :: test

   call mpi_init()
   call check_all()
   call check_time_of_a_case()
   call check_stop()
   call check_broken_store()
   call mpi_finalize()
   call test%finish()

contains

   !> A leader with four cases in a new store; the third works without end when asked.
   subroutine make_leader(leader, sweep, store, with_endless)
      type(counting_leader_t), intent(out) :: leader
      type(sweep_t), intent(out), target :: sweep
      type(store_t), intent(out), target :: store
      logical, intent(in) :: with_endless
      type(case_input_t) :: input
      type(key_list_t) :: keys
      type(error_t), allocatable :: error
      character(len=:), allocatable :: warning
      logical :: is_moes(most_keys)
      integer :: i

      keys = default_keys()
      is_moes = .false.
      is_moes(:keys%count) = [(any(keys%keys(i)%name == [character(len=21) :: 'load_parameter_m', &
                                                         'lubricant_parameter_l', 'radius_ratio_d']), &
                               i=1, keys%count)]
      call execute_command_line('rm -rf '//folder)
      call sweep%begin(most=4, skips_unresolved=.false.)
      do i = 1, 4
         input = case_input_t()
         input%is_given = is_moes
         input%case%load_parameter_m = 100 + i
         if (i == 3 .and. with_endless) input%case%load_parameter_m = endless_m
         input%case%lubricant_parameter_l = 12.05_dp
         input%case%radius_ratio_d = 1
         input%case%cells_x = cells(i)
         input%case%cells_y = cells(i)
         call sweep%add(input, keys, '', error)
      end do
      call sweep%finish()
      store%host = 'here'
      call prepare_store(folder, store, warning, error)
      call test%check_no_error(error, 'sweep')
      leader%sweep => sweep
      leader%store => store
      allocate (leader%done(0), leader%status(0))
      leader%queue = new_queue(sweep%cases, sweep%plans, spread(.true., 1, 4), spread(0.0_dp, 1, 4), ranks=1)
   end subroutine make_leader

   subroutine check_all()
      type(counting_leader_t) :: leader
      type(sweep_t), target :: sweep
      type(store_t), target :: store
      type(contents_t) :: contents
      type(error_t), allocatable :: error
      integer :: i, place
      call make_leader(leader, sweep, store, with_endless=.false.)
      call run_sweep(mpi_comm_self, run_planned, leader)
      call store%close(error)
      call test%check(size(leader%done) == 4 .and. all(leader%status == status_converged), 'all cases are done')
      if (size(leader%done) == 4) call test%check(all(cells(leader%done) == [128, 96, 64, 32]), 'the longest first')
      call test%check(leader%looks >= 4, 'rank 0 looks after the rest')
      call test%check(.not. leader%is_stopping .and. .not. leader%is_store_broken, 'nothing stopped it')
      call read_store(folder, input_identity, contents, error)
      call test%check_equal(contents%count, 4, 'stored cases')
      do i = 1, 4
         place = contents%index%find(sweep%identity(i))
         call test%check(place > 0, 'a case is in the store')
         if (place > 0) call test%check_close(json_number(contents%value(place, 'central_film')), 100.0_dp + i, &
                                              'its result', relative=0.0_dp)
      end do
   end subroutine check_all

   !> A case that takes too long is given up; the others run.
   subroutine check_time_of_a_case()
      type(counting_leader_t) :: leader
      type(sweep_t), target :: sweep
      type(store_t), target :: store
      call make_leader(leader, sweep, store, with_endless=.true.)
      leader%limits%largest_case_seconds = longest_s
      call run_sweep(mpi_comm_self, run_planned, leader)
      call test%check_equal(size(leader%done), 4, 'all cases are done')
      call test%check_equal(count(leader%status == status_over_budget), 1, 'one had its time')
      if (count(leader%status == status_over_budget) == 1) call test%check_equal( &
         leader%done(findloc(leader%status, status_over_budget, 1)), 3, 'the one without end')
   end subroutine check_time_of_a_case

   !> At the deadline the case under way is stopped, and no other begun.
   subroutine check_stop()
      type(counting_leader_t) :: leader
      type(sweep_t), target :: sweep
      type(store_t), target :: store
      type(contents_t) :: contents
      type(error_t), allocatable :: error
      call make_leader(leader, sweep, store, with_endless=.true.)
      leader%most_cases = 2                   ! the next case is endless
      call run_sweep(mpi_comm_self, run_planned, leader)
      call store%close(error)
      call test%check(leader%is_stopping, 'it stopped')
      call test%check_equal(trim(leader%reason), 'the time limit is reached', 'reason')
      call test%check_equal(size(leader%done), 2, 'cases before the one without end')
      call read_store(folder, input_identity, contents, error)
      call test%check_equal(contents%deaths(sweep%identity(3)), 0, 'a stopped case has not died')
   end subroutine check_stop

   subroutine check_broken_store()
      type(counting_leader_t) :: leader
      type(sweep_t), target :: sweep
      type(store_t), target :: store
      type(error_t), allocatable :: error
      call make_leader(leader, sweep, store, with_endless=.false.)
      call store%open_log(error)
      call store%close(error)                 ! the next log cannot be made: it is there
      call run_sweep(mpi_comm_self, run_planned, leader)
      call test%check(leader%is_store_broken .and. leader%is_stopping, 'nothing more is run')
      call test%check(index(leader%reason, 'cannot write') > 0, 'reason of the broken store')
      call test%check_equal(size(leader%done), 0, 'no case counts as done')
   end subroutine check_broken_store

end program test_sweep_scheduler
