!> Records of ranks come back from a store, the last run counting; incomplete or damaged records count as not written.
program test_store
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
   use ehlwave_errors, only: error_t
   use ehlwave_identity_index, only: text_identity
   use ehlwave_json, only: string_json
   use ehlwave_json_reader, only: json_number, json_string
   use ehlwave_kinds, only: dp, i8, no_value
   use ehlwave_posix, only: replace_file
   use ehlwave_quantity, only: quantity_list_t
   use ehlwave_status, only: status_converged, status_stalled
   use ehlwave_store, only: prepare_store, store_t
   use ehlwave_store_contents, only: contents_t, read_store
   use ehlwave_store_names, only: log_name
   use ehlwave_text, only: to_text
   use ehlwave_text_file, only: read_whole_file
   use testing, only: test_t
   implicit none (type, external)

   character(len=*), parameter :: folder = 'test_store.store', lf = new_line('a')
   character(len=*), parameter :: input_1 = '&conditions'//lf//'  m = 1'//lf//'/'//lf, &
      input_2 = '&conditions'//lf//'  m = 2'//lf//'/'//lf, input_3 = '&conditions'//lf//'  m = 3'//lf//'/'//lf
   type(test_t) :: test
   character(len=16) :: first, second, third

   first = text_identity(input_1)
   second = text_identity(input_2)
   third = text_identity(input_3)
   call execute_command_line('rm -rf '//folder)
   call check_nothing()
   call check_first_run()
   call check_second_run()
   call check_deaths()
   call check_cut_log()
   call check_damaged_log()
   call check_every_damaged_byte()
   call check_unreadable_log()
   call check_short_record()
   call test%finish()

contains

   subroutine check_nothing()
      type(contents_t) :: contents
      type(error_t), allocatable :: error
      call read_store(folder, text_identity, contents, error)
      call test%check_no_error(error, 'no store')
      call test%check_equal(contents%count + size(contents%logs) + contents%runs, 0, 'nothing in no store')
   end subroutine check_nothing

   !> A store opened for another run.
   subroutine open_run(store, expected)
      type(store_t), intent(out) :: store
      integer, intent(in) :: expected
      type(error_t), allocatable :: error
      character(len=:), allocatable :: warning
      store%host = 'here'
      store%job = '17'
      call prepare_store(folder, store, warning, error)
      call test%check_no_error(error, 'run '//to_text(expected))
      call test%check_equal(store%run, expected, 'number of the run')
   end subroutine open_run

   subroutine keep(store, identity, status, seconds, input)
      type(store_t), intent(inout) :: store
      character(len=*), intent(in) :: identity, status, input
      real(dp), intent(in) :: seconds
      type(quantity_list_t) :: record
      type(error_t), allocatable :: error
      real(dp), allocatable :: history(:)
      allocate (history, source=[0.1_dp, 0.2_dp])
      call record%add('case_id', '', identity)
      call record%add('status', '', status)
      call record%add('third', '', 1/3.0_dp)
      call record%add('missing', '', no_value)
      call record%add_list('history', '', history)
      call record%add('seconds', '', seconds)
      call store%start(identity, error)
      call store%keep(record, input, error)
      call test%check_no_error(error, 'keep '//identity)
   end subroutine keep

   function contents_now() result(contents)
      type(contents_t) :: contents
      type(error_t), allocatable :: error
      call read_store(folder, text_identity, contents, error)
      call test%check_no_error(error, 'read the store')
   end function contents_now

   subroutine check_first_run()
      type(store_t) :: store
      type(contents_t) :: contents
      type(error_t), allocatable :: error
      integer :: place

      call open_run(store, 1)
      call keep(store, first, 'stalled', 2.5_dp, input_1)
      call keep(store, second, 'converged', 1.0_dp, input_2)
      call store%close(error)
      call test%check_no_error(error, 'close')
      contents = contents_now()
      call test%check_equal(contents%count, 2, 'cases')
      call test%check_equal(contents%runs, 1, 'runs')
      call test%check_equal(contents%bad_lines, 0, 'bad lines')
      place = contents%index%find(second)
      call test%check(place > 0, 'the second case is there')
      if (place == 0) return
      call test%check_equal(contents%cases(place)%status, status_converged, 'status')
      call test%check_close(contents%cases(place)%seconds, 1.0_dp, 'seconds', relative=0.0_dp)
      call test%check_equal(transfer(json_number(contents%value(place, 'third')), 0_i8), transfer(1/3.0_dp, 0_i8), &
                            'a number, bit for bit')
      call test%check(ieee_is_nan(json_number(contents%value(place, 'missing'))), 'NaN')
      call test%check_equal(contents%value(place, 'history'), '[0.1, 0.2]', 'a list')
      call test%check_equal(contents%value(place, 'nothing'), '', 'a name that is not there')
      call test%check_equal(contents%input(place), input_2, 'input, kept as a difference')
      call test%check_equal(contents%input(contents%index%find(first)), input_1, 'input of the first')
      call test%check_equal(json_string(contents%logs(1)%element('host')), 'here', 'host of the run')
      call test%check_equal(json_string(contents%logs(1)%element('job')), '17', 'job of the run')
      call test%check(contents%logs(1)%is_by_this_build, 'this build wrote it')
      call test%check_equal(contents%index%find(third), 0, 'a case that is not there')
   end subroutine check_first_run

   !> Another run: its records count, records of other runs stay.
   subroutine check_second_run()
      type(store_t) :: store
      type(contents_t) :: contents
      type(error_t), allocatable :: error
      call open_run(store, 2)
      call keep(store, first, 'converged', 4.0_dp, input_1)
      call store%close(error)
      contents = contents_now()
      call test%check_equal(contents%count, 2, 'cases of two runs')
      call test%check_equal(contents%cases(contents%index%find(first))%status, status_converged, 'the later run counts')
      call test%check_equal(contents%cases(contents%index%find(first))%run, 2, 'its number')
      call test%check_equal(contents%cases(contents%index%find(second))%run, 1, 'the other case stays')
   end subroutine check_second_run

   !> A case that was begun and neither done nor stopped: its process died.
   subroutine check_deaths()
      type(store_t) :: store
      type(contents_t) :: contents
      type(error_t), allocatable :: error
      call open_run(store, 3)
      call store%start(third, error)
      call store%close(error)
      contents = contents_now()
      call test%check_equal(contents%deaths(third), 1, 'one death')
      call test%check_equal(contents%deaths(first), 0, 'none in a case that is done')
      call open_run(store, 4)
      call store%start(third, error)
      call store%stop(third, error)
      call store%close(error)
      contents = contents_now()
      call test%check_equal(contents%deaths(third), 1, 'a case that was stopped has not died')
      call open_run(store, 5)
      call keep(store, third, 'converged', 1.0_dp, input_3)
      call store%close(error)
      contents = contents_now()
      call test%check_equal(contents%deaths(third), 0, 'deaths before it was done do not count')
   end subroutine check_deaths

   function path_of(run) result(path)
      integer, intent(in) :: run
      character(len=:), allocatable :: path
      path = folder//'/records/'//log_name(run, 0)
   end function path_of

   !> The log of the first run ends within its last record.
   subroutine check_cut_log()
      type(contents_t) :: contents
      character(len=:), allocatable :: text
      integer :: cut, status
      call read_whole_file(path_of(1), text)
      do cut = 1, 40, 13
         call replace_file(path_of(1), text(:len(text) - cut), status)
         contents = contents_now()
         call test%check_equal(contents%index%find(second), 0, 'a record that was cut off')
         call test%check_equal(contents%bad_lines, 1, 'counts as a bad line')
         call test%check(contents%index%find(first) > 0, 'those before it stay')
      end do
      call replace_file(path_of(1), text, status)
      contents = contents_now()
      call test%check(contents%index%find(second) > 0, 'the whole log')
   end subroutine check_cut_log

   !> A changed digit of a record.
   subroutine check_damaged_log()
      type(contents_t) :: contents
      character(len=:), allocatable :: damaged, text
      integer :: place, status
      call read_whole_file(path_of(2), text)
      damaged = text
      place = index(text, '"converged"')
      damaged(place + 1:place + 1) = 'C'
      call replace_file(path_of(2), damaged, status)
      contents = contents_now()
      call test%check_equal(contents%bad_lines, 1, 'a damaged line')
      call test%check_equal(contents%cases(contents%index%find(first))%status, status_stalled, 'the record before it counts')
      call replace_file(path_of(2), text, status)
   end subroutine check_damaged_log

   !> Whatever byte of the log of two cases is damaged, at most one is lost, and the rest is right. Every fifth byte is
   !> tried: no text of the log has a period of five.
   subroutine check_every_damaged_byte()
      character(len=*), parameter :: intact = 'test_store_intact.store'
      type(contents_t) :: contents
      type(error_t), allocatable :: error
      character(len=:), allocatable :: damaged, text, value
      logical :: is_right
      integer :: i, lost, place, unit
      contents = contents_now()
      value = contents%value(contents%index%find(second), 'third')
      call execute_command_line('rm -rf '//intact//' && mkdir -p '//intact//'/records')
      call read_whole_file(path_of(1), text)
      lost = 0
      do i = 1, len(text), 5
         damaged = text
         damaged(i:i) = achar(ieor(iachar(text(i:i)), 1))
         open (newunit=unit, file=intact//'/records/000001-000000.log', access='stream', form='unformatted', status='replace')
         write (unit) damaged
         close (unit)
         call read_store(intact, text_identity, contents, error)
         call test%check_no_error(error, 'damaged byte '//to_text(i))
         lost = max(lost, 2 - contents%count)
         place = contents%index%find(second)
         if (contents%count == 0 .or. contents%runs /= 1) call test%check(.false., 'cases of damaged byte '//to_text(i))
         if (place == 0) cycle
         is_right = contents%value(place, 'third') == value
         if (is_right) is_right = contents%input(place) == input_2
         if (.not. is_right) call test%check(.false., 'values of damaged byte '//to_text(i))
      end do
      call test%check_equal(lost, 1, 'a damaged byte takes one case at most')
   end subroutine check_every_damaged_byte

   !> A log that is there and cannot be read is an error, not an empty log.
   subroutine check_unreadable_log()
      type(contents_t) :: contents
      type(error_t), allocatable :: error
      call execute_command_line('mkdir '//path_of(999999))
      call read_store(folder, text_identity, contents, error)
      call test%check_error(error, path_of(999999), 'a folder in place of a log')
      call execute_command_line('rmdir '//path_of(999999)//' && mkfifo '//path_of(999999))
      call read_store(folder, text_identity, contents, error)
      call test%check_error(error, path_of(999999), 'a pipe in place of a log')
      call execute_command_line('rm '//path_of(999999)//' && ln -s nowhere '//path_of(999999))
      call read_store(folder, text_identity, contents, error)
      call test%check_error(error, path_of(999999), 'a link to nothing in place of a log')
      call execute_command_line('rm '//path_of(999999))
   end subroutine check_unreadable_log

   !> A good line whose record has fewer values than its columns, no columns at all, or the input of another case.
   subroutine check_short_record()
      use ehlwave_record_file, only: record_writer_t
      type(record_writer_t) :: writer
      type(contents_t) :: contents
      type(error_t), allocatable :: error
      character(len=*), parameter :: input_4 = '&conditions'//lf//'  m = 4'//lf//'/'//lf, &
         input_5 = '&conditions'//lf//'  m = 5'//lf//'/'//lf
      call writer%create(path_of(6), error)
      call writer%append('run [[["run","integer"],["rank","integer"]],[6,0]]', error)
      call writer%append('input ['//string_json(input_4)//']', error)
      call writer%append('case ["'//text_identity(input_4)//'","converged",1,""]', error)
      call writer%append('columns [["case_id","text"],["status","text"],["seconds","real"],["effective_input","text"]]', error)
      call writer%append('case ["'//text_identity(input_4)//'","converged",""]', error)
      call writer%append('case ["00000000000000D4","converged",1,""]', error)
      call writer%append('case ["'//text_identity(input_5)//'","converged",0.5,'//string_json('2:  m = 5'//lf)//']', error)
      call writer%close(error)
      call test%check_no_error(error, 'a log by hand')
      contents = contents_now()
      call test%check_equal(contents%index%find(text_identity(input_4)), 0, 'records without columns, or too short')
      call test%check_equal(contents%index%find('00000000000000D4'), 0, 'an identity that is not that of the input')
      call test%check_equal(contents%bad_lines, 3, 'count as damaged')
      call test%check(contents%index%find(text_identity(input_5)) > 0, 'the next one is good')
      call test%check_equal(contents%runs, 6, 'number of the last run')
   end subroutine check_short_record

end program test_store
