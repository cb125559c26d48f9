!> Work of rank 0 in a run of a sweep besides scheduling: it takes over the store, keeps the user and the results file
!> up to date, and reports the outcome at the end.
module ehlwave_sweep_leader
   use, intrinsic :: iso_fortran_env, only: output_unit
   use ehlwave_case_files, only: paths_read
   use ehlwave_case_list, only: case_list_t
   use ehlwave_case_text, only: input_identity
   use ehlwave_outcome, only: outcome_t
   use ehlwave_clock, only: time_stamp, wall_seconds
   use ehlwave_cost_model, only: cost_features, feature_count
   use ehlwave_errors, only: error_t, raise
   use ehlwave_kinds, only: dp
   use ehlwave_output_path, only: check_output_path
   use ehlwave_own_result, only: is_own_result
   use ehlwave_paths, only: is_within
   use ehlwave_posix, only: file_kind, kind_none, reason_text, remove_file
   use ehlwave_provenance, only: program_version
   use ehlwave_results_writer, only: results_writer_t
   use ehlwave_scheduler, only: leader_t
   use ehlwave_status, only: last_status
   use ehlwave_store, only: prepare_store, store_t
   use ehlwave_store_contents, only: contents_t, read_store
   use ehlwave_store_folder, only: check_store, refuse_inside_store
   use ehlwave_store_names, only: store_path
   use ehlwave_store_removal, only: discard_store
   use ehlwave_sweep_cases, only: sweep_t
   use ehlwave_sweep_expectation, only: expected_seconds
   use ehlwave_sweep_notices, only: print_notices
   use ehlwave_sweep_progress, only: progress_t
   use ehlwave_sweep_queue, only: new_queue
   use ehlwave_sweep_report, only: print_sweep_result
   use ehlwave_sweep_start, only: choose_cases, refuse_changed_files, set_aside_crashed
   use ehlwave_terminal, only: complain, print_last, say
   use ehlwave_text, only: number_of, shown, to_text
   use ehlwave_text_file, only: read_text
   implicit none (type, external)
   private

   integer, parameter, public :: exit_done = 0, exit_failed = 1, exit_bad_input = 2, exit_not_written = 3, &
      exit_unfinished = 85

   !> Options of the command line.
   type, public :: job_options_t
      logical :: overwrite = .false.
      character(len=16) :: retry = ''            !! 'failed', 'version' or 'files'
      real(dp) :: time_limit_s = huge(1.0_dp)    !! from the start of the program on
   end type job_options_t

   !> Rank 0 also takes over the store, counts the cases, reports the progress and keeps the results file up to date.
   type, extends(leader_t), public :: job_t
      type(progress_t) :: progress
      type(results_writer_t) :: writer
   contains
      procedure :: prepare
      procedure :: conclude
      procedure :: count_case
      procedure :: look_after
   end type job_t

contains

   !> Take over the store, find and report the cases left to run.
   subroutine prepare(self, sweep_path, sweep, options, ranks, store, error)
      class(job_t), intent(inout) :: self
      character(len=*), intent(in) :: sweep_path
      type(sweep_t), intent(in), target :: sweep
      type(job_options_t), intent(in) :: options
      integer, intent(in) :: ranks
      type(store_t), intent(inout) :: store
      type(error_t), allocatable, intent(inout) :: error
      type(contents_t) :: contents
      character(len=:), allocatable :: folder, warning
      logical, allocatable :: to_run(:)
      integer, allocatable :: status(:)
      real(dp), allocatable :: seconds(:)
      integer :: i
      logical :: has_results, has_store

      folder = store_path(sweep%output)
      has_store = .false.   ! results without a store were not made by this sweep: they are not replaced unasked
      if (folder == sweep%output) call raise(error, "results file '"//shown(folder)// &
         "' has the name of a store: give one that ends in .h5")
      call refuse_inside_store(sweep%output, error)
      if (.not. (allocated(error) .or. options%overwrite)) call check_store(folder, has_store, error)
      call check_output_path(sweep%output, files_read(sweep), options%overwrite, error, has_store=has_store)
      if (options%overwrite) call refuse_dropped_inputs(folder, files_read(sweep), error)
      if (options%overwrite) call discard_store(folder, error)
      inquire (file=sweep%output, exist=has_results)
      if (has_results .and. .not. (has_store .or. options%overwrite .or. allocated(error))) call raise(error, &
         'results file '// &
         sweep%output//' exists but not its store '//folder// &
         ': move it away, name another with --output, or give --overwrite')
      store%defaults = sweep%defaults
      call prepare_store(folder, store, warning, error)
      if (options%overwrite) call drop_foreign_results(sweep%output, error)
      call read_store(folder, input_identity, contents, error)
      if (.not. allocated(error)) call read_text(sweep_path, self%writer%sweep_text, error)
      if (allocated(error)) return

      call say(output_unit, 'ehlwave-sweep '//program_version//': '//number_of(size(sweep%cases), 'case')// &
         ' on '//number_of(ranks, 'rank')//', results in '//sweep%output)
      if (allocated(warning)) call say(output_unit, 'NOTICE: '//warning)
      if (sweep%skipped > 0) call say(output_unit, number_of(sweep%skipped, 'unresolved case')//' left out as asked')
      allocate (to_run(size(sweep%cases)), status(size(sweep%cases)), seconds(size(sweep%cases)))
      call choose_cases(sweep, store, contents, options%retry, to_run, status, seconds)
      call refuse_changed_files(sweep, contents, to_run, error)
      if (allocated(error)) return
      call store%open_log(error)
      self%is_store_broken = allocated(error)
      if (allocated(error)) return
      call print_notices(sweep, contents, to_run, options%retry)
      call list_cases(sweep, folder, store, error)
      call set_aside_crashed(sweep, contents, store, to_run, status, error)
      self%is_store_broken = allocated(error)
      if (allocated(error)) return
      flush (output_unit)

      self%sweep => sweep
      self%writer%sweep => sweep
      self%writer%folder = folder
      self%writer%ranks = ranks
      self%progress%total = size(sweep%cases)
      self%progress%ranks = ranks
      self%progress%start_s = wall_seconds()
      do i = 1, size(sweep%cases)
         if (.not. to_run(i)) call self%progress%count_case(status(i), seconds(i))
      end do
      self%queue = new_queue(sweep%cases, sweep%plans, to_run, seconds, ranks, expected_seconds(sweep%plans))
   end subroutine prepare

   !> All files that a sweep has been made from: none of them is ever replaced.
   function files_read(sweep) result(files)
      type(sweep_t), intent(in) :: sweep
      character(len=:), allocatable :: files(:)
      character(len=:), allocatable :: more(:)
      integer :: i, k

      allocate (character(len=0) :: files(0))
      if (allocated(sweep%files)) files = sweep%files
      do i = 1, size(sweep%cases)
         more = paths_read(sweep%plans(i)%files)
         do k = 1, size(more)
            if (.not. any(files == more(k))) files = [character(len=max(len(files), len(more))) :: files, more(k)]
         end do
      end do
   end function files_read

   !> Refuse to drop a store that holds a file which the sweep reads.
   subroutine refuse_dropped_inputs(folder, files, error)
      character(len=*), intent(in) :: folder     !! folder of the store
      character(len=*), intent(in) :: files(:)
      type(error_t), allocatable, intent(inout) :: error
      integer :: i
      do i = 1, size(files)
         if (allocated(error)) return
         if (is_within(trim(files(i)), folder)) call raise(error, trim(files(i))//', which the sweep reads, is in '// &
            folder//', which --overwrite would drop: move it')
      end do
   end subroutine refuse_dropped_inputs

   !> Remove files to overwrite that are no results: a resumed run would refuse them.
   subroutine drop_foreign_results(path, error)
      character(len=*), intent(in) :: path       !! a regular file, or nothing
      type(error_t), allocatable, intent(inout) :: error
      integer :: status
      if (allocated(error)) return
      if (is_own_result(path)) return
      call remove_file(path, status)
      if (status /= 0) call raise(error, 'cannot remove '//path//': '//reason_text(status))
   end subroutine drop_foreign_results

   !> The list of all cases, for `--status`.
   subroutine list_cases(sweep, folder, store, error)
      type(sweep_t), intent(in) :: sweep
      character(len=*), intent(in) :: folder     !! folder of the store
      type(store_t), intent(inout) :: store
      type(error_t), allocatable, intent(inout) :: error
      type(case_list_t) :: list
      integer :: i
      allocate (list%identity, source=sweep%identity)
      allocate (list%features(feature_count, size(sweep%plans)), list%variation(size(sweep%plans)))
      do i = 1, size(sweep%plans)
         list%features(:, i) = cost_features(sweep%plans(i))
         list%variation(i) = sweep%variation(i)
      end do
      call list%write(folder, error)
      call store%note_list(list%checksum, error)
   end subroutine list_cases

   subroutine count_case(self, outcome)
      class(job_t), intent(inout) :: self
      type(outcome_t), intent(in) :: outcome
      call self%progress%finished(outcome)
   end subroutine count_case

   subroutine look_after(self)
      class(job_t), intent(inout) :: self
      call self%progress%tick(self%queue%seconds_left())
      call self%writer%renew(self%progress%done())
   end subroutine look_after

   !> Make the results file from the store and report the state of the sweep.
   subroutine conclude(self, code)
      class(job_t), intent(inout) :: self
      integer, intent(out) :: code
      type(contents_t) :: contents
      type(error_t), allocatable :: error
      integer :: i, place, stored(0:last_status), lost
      logical :: is_written

      call self%writer%write(contents, error)
      stored = 0
      do i = 1, size(self%sweep%cases)
         place = contents%index%find(self%sweep%identity(i))
         if (place > 0) stored(contents%cases(place)%status) = stored(contents%cases(place)%status) + 1
      end do
      lost = self%progress%done() - sum(stored)
      if (lost > 0 .and. .not. allocated(error)) call raise(error, to_text(lost)// &
         ' cases were reported as done but are '// &
         'not in the store '//self%writer%folder//': '// &
         trim(merge('was it moved or removed', 'is the disk broken     ', &
                    file_kind(self%writer%folder) == kind_none))//'? The same command computes missing cases again')

      call self%progress%tick(self%queue%seconds_left(), is_last=.true.)
      call print_sweep_result(output_unit, self%progress, self%sweep%output)
      code = merge(exit_failed, exit_done, self%progress%failed() > 0)
      if (self%progress%done() < self%progress%total) then
         code = exit_unfinished
         call say(output_unit, time_stamp()//' stopped, because '//trim(self%reason)// &
            '; the same command goes on with the rest')
      end if
      if (self%is_input_changed) code = exit_bad_input
      if (self%is_store_broken .or. allocated(error)) code = exit_not_written
      call print_last(time_stamp()//' the end, exit status '//to_text(code), is_written)
      if (.not. is_written) call complain('ehlwave-sweep', &
         'standard output could not be written; the results are in '//self%writer%folder)
      if (.not. is_written .and. code /= exit_unfinished) code = exit_not_written
      if (self%is_store_broken .or. self%is_input_changed) call complain('ehlwave-sweep', trim(self%reason))
      if (allocated(error)) call complain('ehlwave-sweep', error%message)
   end subroutine conclude

end module ehlwave_sweep_leader
