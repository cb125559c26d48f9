!> What a sweep that goes on with a store has to run, and what the user should know about that.
module ehlwave_sweep_start
   use, intrinsic :: iso_fortran_env, only: output_unit
   use ehlwave_case_account, only: blank_result
   use ehlwave_case_result, only: case_result_t
   use ehlwave_case_text, only: effective_input
   use ehlwave_case_work, only: store_result
   use ehlwave_clock, only: time_stamp
   use ehlwave_cost_model, only: cost_features, feature_count
   use ehlwave_errors, only: error_t, raise
   use ehlwave_json_reader, only: json_string
   use ehlwave_kinds, only: dp
   use ehlwave_posix, only: reason_text, replace_file
   use ehlwave_provenance, only: git_revision, program_version
   use ehlwave_status, only: is_success, status_crashed, status_pending
   use ehlwave_store, only: store_t
   use ehlwave_store_contents, only: contents_t, log_t, run_element
   use ehlwave_store_folder, only: cases_name
   use ehlwave_sweep_cases, only: sweep_t, variation_length
   use ehlwave_text, only: to_text
   implicit none (type, external)
   private
   public :: choose_cases, print_notices, set_aside_crashed, write_case_list

   character(len=*), parameter :: this_build = program_version//' '//git_revision
   integer, parameter :: most_deaths = 2   !! of its process in a case, before it is set aside

contains

   !> Which cases are to run, and what is known of the others.
   subroutine choose_cases(sweep, store, contents, retry, to_run, status, seconds)
      type(sweep_t), intent(in) :: sweep
      class(store_t), intent(in) :: store
      type(contents_t), intent(in) :: contents
      character(len=*), intent(in) :: retry          !! '', 'failed' or 'version': what to run again
      logical, intent(out) :: to_run(:)
      integer, intent(out) :: status(:)              !! of the last record, else pending
      real(dp), intent(out) :: seconds(:)            !! wall time, 0: none
      logical :: has_fields, is_same(size(contents%logs))
      integer :: i, place

      is_same = by_this_build(contents)
      to_run = .true.
      status = status_pending
      seconds = 0
      do i = 1, size(sweep%cases)
         place = contents%index%find(sweep%identity(i))
         if (place == 0) cycle
         status(i) = contents%cases(place)%status
         seconds(i) = contents%cases(place)%seconds
         to_run(i) = status(i) == status_pending .or. (retry == 'failed' .and. .not. is_success(status(i))) .or. &
                     (retry == 'version' .and. .not. is_same(contents%cases(place)%log))
         if (sweep%cases(i)%fields .and. .not. to_run(i)) then
            inquire (file=store%fields_path(sweep%identity(i)), exist=has_fields)
            to_run(i) = is_success(status(i)) .and. .not. has_fields
         end if
      end do
   end subroutine choose_cases

   !> Version and revision of the program that wrote a log.
   function build_of(log) result(build)
      type(log_t), intent(in) :: log
      character(len=:), allocatable :: build
      build = json_string(run_element(log, 'program_version'))//' '//json_string(run_element(log, 'git_revision'))
   end function build_of

   !> For each log whether this version and revision wrote it.
   function by_this_build(contents) result(is_same)
      type(contents_t), intent(in) :: contents
      logical :: is_same(size(contents%logs))
      integer :: k
      do k = 1, size(is_same)
         is_same(k) = build_of(contents%logs(k)) == this_build
      end do
   end function by_this_build

   !> Tell what is in the store and how it differs from what is asked for now.
   subroutine print_notices(sweep, contents, to_run, retry)
      type(sweep_t), intent(in) :: sweep
      type(contents_t), intent(in) :: contents
      logical, intent(in) :: to_run(:)
      character(len=*), intent(in) :: retry
      logical :: is_same(size(contents%logs))
      integer :: i, other, other_build, unlisted

      if (contents%bad_lines > 0) write (output_unit, '(a)') to_text(contents%bad_lines)// &
         ' records were cut off or damaged (killed while writing, full disk); they count as not written'
      if (contents%count == 0) return
      write (output_unit, '(a)') to_text(count(.not. to_run))//' of '//to_text(size(to_run))// &
         ' cases are in the store already, '//to_text(count(to_run))//' to run'
      is_same = by_this_build(contents)
      other = 0
      unlisted = 0
      other_build = 0
      do i = 1, contents%count
         if (sweep%index%find(contents%cases(i)%identity) == 0) then
            unlisted = unlisted + 1
         else if (.not. is_same(contents%cases(i)%log)) then
            other = contents%cases(i)%log
            other_build = other_build + 1
         end if
      end do
      if (unlisted > 0) then
         write (output_unit, '(a)') 'NOTICE: the store also holds '//to_text(unlisted)//' finished cases that this sweep '// &
            'file does not list; they stay in the store and out of the results file'
         call print_changed_settings(sweep, contents)
      end if
      if (other_build > 0 .and. retry /= 'version') write (output_unit, '(a)') 'NOTICE: '//to_text(other_build)// &
         ' finished cases were computed by ehlwave '//build_of(contents%logs(other))//', this is '//this_build// &
         '; they are kept (each row of the results tells its version; --retry version computes them again)'
   end subroutine print_notices

   !> Lines of the effective input, beyond what a sweep varies, that differ from those of an earlier run.
   subroutine print_changed_settings(sweep, contents)
      type(sweep_t), intent(in) :: sweep
      type(contents_t), intent(in) :: contents
      character(len=:), allocatable :: earlier, line, now
      integer :: first, last, log

      now = settings_of(effective_input(sweep%cases(1)))
      do log = size(contents%logs), 1, -1
         if (.not. allocated(contents%logs(log)%base_input)) cycle
         earlier = settings_of(contents%logs(log)%base_input)
         if (earlier == now) cycle
         first = 1
         do while (first <= len(earlier))
            last = first + index(earlier(first:), new_line('a')) - 2
            line = earlier(first:last)
            if (index(now, line//new_line('a')) == 0) &
               write (output_unit, '(a)') '   an earlier run had '//trim(adjustl(line))
            first = last + 2
         end do
         exit
      end do
   end subroutine print_changed_settings

   !> The groups &lubricant, &grid, &solver and &dynamics.
   pure function settings_of(input) result(text)
      character(len=*), intent(in) :: input
      character(len=:), allocatable :: text
      integer :: grid, lubricant, waviness
      lubricant = index(input, '&lubricant')
      waviness = index(input, '&waviness')
      grid = index(input, '&grid')
      text = ''
      if (lubricant > 0 .and. waviness > lubricant .and. grid > waviness) text = input(lubricant:waviness - 1)//input(grid:)
   end function settings_of

   !> Cases whose process died in two runs are stored as `crashed` and not tried again; says so.
   subroutine set_aside_crashed(sweep, contents, store, to_run, status, error)
      type(sweep_t), intent(in) :: sweep
      type(contents_t), intent(in) :: contents
      class(store_t), intent(inout) :: store
      logical, intent(inout) :: to_run(:)
      integer, intent(inout) :: status(:)
      type(error_t), allocatable, intent(inout) :: error
      type(case_result_t) :: result
      integer :: case, deaths, log

      do log = 1, size(contents%logs)
         case = sweep%index%find(contents%logs(log)%in_flight)
         if (case == 0 .or. allocated(error)) cycle
         if (.not. to_run(case)) cycle
         deaths = contents%deaths(sweep%identity(case))
         if (deaths < most_deaths) cycle
         result = blank_result(sweep%cases(case), sweep%plans(case))
         result%status = status_crashed
         result%message = 'its process died in '//to_text(deaths)//' runs; --retry failed tries it again'
         call store_result(sweep%cases(case), sweep%plans(case), effective_input(sweep%cases(case)), result, &
                           time_stamp(), store, error)
         to_run(case) = .false.
         status(case) = status_crashed
         write (output_unit, '(a)') 'NOTICE: case '//to_text(case)//' is set aside: '//result%message
      end do
   end subroutine set_aside_crashed

   !> The list of all cases, with what their time is told from and the keys that vary, for `--status`. All lines have
   !> the same length.
   subroutine write_case_list(sweep, store, error)
      type(sweep_t), intent(in) :: sweep
      class(store_t), intent(in) :: store
      type(error_t), allocatable, intent(inout) :: error
      character(len=16 + 13*feature_count) :: line
      character(len=variation_length) :: variation(size(sweep%cases))
      character(len=:), allocatable :: text
      integer :: i, status, width

      if (allocated(error)) return
      do i = 1, size(sweep%cases)
         variation(i) = sweep%variation(i)
      end do
      width = len(line) + 1 + maxval(len_trim(variation)) + 1
      allocate (character(len=width*size(sweep%cases)) :: text)
      do i = 1, size(sweep%cases)
         write (line, '(a16,*(1x,es12.5))') sweep%identity(i), cost_features(sweep%plans(i))
         text((i - 1)*width + 1:i*width) = line//' '//variation(i)
         text(i*width:i*width) = new_line('a')
      end do
      call replace_file(store%folder//'/'//cases_name, text, status)
      if (status /= 0) call raise(error, 'cannot write '//store%folder//'/'//cases_name//': '//reason_text(status))
   end subroutine write_case_list

end module ehlwave_sweep_start
