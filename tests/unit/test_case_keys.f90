!> The table of keys: every key is refused and accepted alike in a case file, in a list of &sweep and in a CSV file; the
!> reference has them all; a case file that repeats the defaults is the same case.
program test_case_keys
   use ehlwave_case_definition, only: case_t
   use ehlwave_case_input, only: case_input_t
   use ehlwave_case_key, only: key_length, key_t, key_value_t, most_keys, number_kind, truth_kind, value_text, whole_kind, &
      word_kind, words_of
   use ehlwave_case_keys, only: case_key_list, default_keys
   use ehlwave_case_row, only: find_columns, set_row
   use ehlwave_csv, only: cell_length, csv_t, parse_csv
   use ehlwave_errors, only: error_t
   use ehlwave_key_bounds, only: is_allowed
   use ehlwave_key_list, only: find_key, key_list_t
   use ehlwave_key_reference, only: case_key_reference
   use ehlwave_kinds, only: dp
   use ehlwave_namelist, only: namelist_t
   use ehlwave_sweep_lists, only: read_lists, sweep_lists_t
   use ehlwave_text, only: to_text
   use testing, only: test_t
   implicit none (type, external)

   type(test_t) :: test
   type(key_list_t) :: table
   integer :: k

   table = default_keys()
   call check_table()
   do k = 1, table%count
      call check_key(table%keys(k), table%values(k))
   end do
   call check_cells()
   call check_count()
   call test%finish()

contains

   subroutine check_table()
      character(len=:), allocatable :: markdown, text
      integer :: i

      call test%check(table%count > 40 .and. table%count <= most_keys, 'number of keys: '//to_text(table%count))
      text = case_key_reference(is_markdown=.false.)
      markdown = case_key_reference(is_markdown=.true.)
      do i = 1, table%count
         associate (key => table%keys(i))
            call test%check_equal(find_key(table%keys, trim(key%name)), i, 'the one key of its name: '//key%name)
            call test%check(key%help /= '' .and. key%help(len(key%help):) == '', 'help of '//key%name)
            call test%check(index(text, new_line('a')//'  '//trim(key%name)//' (default: ') > 0, key%name//' in the text')
            call test%check(index(markdown, '| `'//trim(key%name)//'` | ') > 0, key%name//' in Markdown')
            call test%check(key%applies .or. key%when /= '', 'to what belongs '//key%name)
         end associate
      end do
      call test%check(index(markdown, '| `slip_parameter` | `1` |') > 0, 'a default that is a number')
      call test%check(index(markdown, '| `end_time` | none |') > 0, 'a key without a default')
   end subroutine check_table

   !> Values at, inside and outside the bounds of a key, given in three ways.
   subroutine check_key(key, default)
      type(key_t), intent(in) :: key
      type(key_value_t), intent(in) :: default
      character(len=cell_length), allocatable :: words(:)
      integer :: i

      select case (key%kind)
      case (number_kind, whole_kind)
         call try_number(key, key%minimum, default)
         call try_number(key, key%maximum, default)
         call try_number(key, key%above, default)
         call try_number(key, max(key%minimum, key%above, -1e3_dp) - 1, default)
         call try_number(key, min(key%maximum, 1e3_dp) + 1, default)
         call try(key, 'nan', is_fine=.false.)
         call try(key, '1.2.3', is_fine=.false.)
         if (key%kind == whole_kind) call try(key, '64.5', is_fine=.false.)
      case (truth_kind)
         call try(key, 'true', is_fine=.true.)
         call try(key, '3', is_fine=.false.)
      case (word_kind)
         words = words_of(key%choices)
         do i = 1, size(words)
            call try(key, words(i), is_fine=.true.)
         end do
         if (size(words) > 0) call try(key, 'picard', is_fine=.false.)
      end select
   end subroutine check_key

   !> A number that the bounds of the key should judge; without such a bound nothing is tried. 0 means none for a key
   !> without default in a table, and only there.
   subroutine try_number(key, number, default)
      type(key_t), intent(in) :: key
      real(dp), intent(in) :: number
      type(key_value_t), intent(in) :: default
      logical :: is_fine, may_say_none

      if (abs(number) > 1e30_dp) return
      is_fine = number > key%above .and. number >= key%minimum .and. number <= key%maximum
      may_say_none = abs(number) <= 0 .and. .not. (key%is_required .or. is_allowed(key, default))
      call try(key, to_text(number), is_fine, may_say_none)
   end subroutine try_number

   !> Give a value in a case file, in a list of &sweep and in a table: all accept it, or all refuse it in the same words.
   subroutine try(key, text, is_fine, may_say_none)
      type(key_t), intent(in) :: key
      character(len=*), intent(in) :: text
      logical, intent(in) :: is_fine
      logical, intent(in), optional :: may_say_none
      character(len=:), allocatable :: in_file, in_list, in_table, quoted, what

      quoted = trim(text)
      if (key%kind == word_kind) quoted = "'"//quoted//"'"
      what = trim(key%name)//' = '//quoted
      in_file = from_file(key, quoted)
      call test%check(in_file == '' .eqv. is_fine, what//' in a case file: '//in_file)
      if (.not. key%can_vary) return
      in_list = from_list(key, quoted)
      call test%check_equal(in_list, in_file, what//' in a list')
      in_table = from_table(key, trim(text))
      if (present(may_say_none)) then
         if (may_say_none) in_file = ''
      end if
      call test%check_equal(in_table, in_file, what//' in a table')
   end subroutine try

   !> Error of a case file with a value, '' when it is accepted and the case has it.
   function from_file(key, text) result(problem)
      type(key_t), intent(in) :: key
      character(len=*), intent(in) :: text
      character(len=:), allocatable :: problem
      type(namelist_t) :: file
      type(case_input_t) :: input
      type(error_t), allocatable :: error
      integer :: k

      call file%load_text('F', '&'//trim(key%group)//new_line('a')//trim(key%name)//' = '//text//' /', error)
      call input%read(file, error)
      problem = ''
      if (allocated(error)) then
         problem = behind(error%message, "F:2: key '"//trim(key%name)//"' in &"//trim(key%group)//': ')
      else
         k = find_key(table%keys, key%name)
         call test%check(count(input%is_given) == 1 .and. input%is_given(k), trim(key%name)//' is given, it alone')
         call test%check(same(key, value_of(input%case, k), text), 'the case has '//trim(key%name)//' = '//text)
      end if
   end function from_file

   function from_list(key, text) result(problem)
      type(key_t), intent(in) :: key
      character(len=*), intent(in) :: text
      character(len=:), allocatable :: problem
      type(namelist_t) :: file
      type(sweep_lists_t) :: lists
      type(case_input_t) :: input
      type(error_t), allocatable :: error

      call file%load_text('F', '&sweep'//new_line('a')//trim(key%name)//' = '//text//' /', error)
      call read_lists(file, table, lists, error)
      problem = ''
      if (allocated(error)) then
         problem = behind(error%message, "F:2: key '"//trim(key%name)//"' in &sweep: ")
      else if (lists%next()) then
         call lists%put(input)
         call test%check(same(key, value_of(input%case, find_key(table%keys, key%name)), text), &
                         'the listed case has '//trim(key%name)//' = '//text)
         call test%check(.not. lists%next(), 'one case')
      end if
   end function from_list

   function from_table(key, text) result(problem)
      type(key_t), intent(in) :: key
      character(len=*), intent(in) :: text
      character(len=:), allocatable :: problem
      character(len=cell_length) :: cell
      type(case_input_t) :: input
      type(error_t), allocatable :: error

      cell = text
      call put_row([key%name], [cell], input, error)
      problem = ''
      if (allocated(error)) problem = behind(error%message, 'T:2: column '//trim(key%name)//': ')
   end function from_table

   !> Give a case the values of a table of one row.
   subroutine put_row(names, cells, input, error)
      character(len=key_length), intent(in) :: names(:)
      character(len=cell_length), intent(in) :: cells(:)
      type(case_input_t), intent(inout) :: input
      type(error_t), allocatable, intent(out) :: error
      type(csv_t) :: rows
      character(len=:), allocatable :: header, row
      integer, allocatable :: columns(:)
      integer :: i

      header = ''
      row = ''
      do i = 1, size(names)
         header = header//','//trim(names(i))
         row = row//',"'//trim(cells(i))//'"'
      end do
      call parse_csv('T', header(2:)//new_line('a')//row(2:), rows, error)
      call find_columns(rows, table, columns, error)
      if (.not. allocated(error)) call set_row(rows, 1, table, columns, input, error)
   end subroutine put_row

   function behind(message, place) result(problem)
      character(len=*), intent(in) :: message, place
      character(len=:), allocatable :: problem
      call test%check_equal(message(:min(len(message), len(place))), place, 'a message begins with its place')
      problem = message(min(len(message), len(place)) + 1:)
   end function behind

   function value_of(case, k) result(value)
      type(case_t), intent(in) :: case
      integer, intent(in) :: k     !! number of the key
      type(key_value_t) :: value
      type(key_list_t) :: list
      list = case_key_list(case)
      value = list%values(k)
   end function value_of

   logical function same(key, value, text)
      type(key_t), intent(in) :: key
      type(key_value_t), intent(in) :: value
      character(len=*), intent(in) :: text
      character(len=:), allocatable :: expected
      expected = text
      if (key%kind == truth_kind) expected = '.'//text//'.'
      same = value_text(value) == expected
   end function same

   !> Empty cells, none, and columns that are no keys.
   subroutine check_cells()
      type(case_input_t) :: input
      type(error_t), allocatable :: error

      input%case%wavelength_over_a = 3
      call put_row([character(len=key_length) :: 'wavelength_over_a', 'cells_x', 'f_v', 'slip_parameter'], &
                   [character(len=cell_length) :: '', '64.0', '0', ''], input, error)
      call test%check_no_error(error, 'empty cells')
      call test%check_close(input%case%wavelength_over_a, 3.0_dp, 'an empty cell leaves the value', relative=0.0_dp)
      call test%check_equal(input%case%cells_x, 64, 'a whole number with a point')
      call test%check(count(input%is_given) == 1 .and. .not. input%f_v > 0, 'one key is given')
      call put_row([character(len=key_length) :: 'wavelength_over_a', 'f_v'], [character(len=cell_length) :: '0', '2.5'], &
                   input, error)
      call test%check_no_error(error, 'none')
      call test%check_close(input%case%wavelength_over_a, 0.0_dp, '0 says that there is none', absolute=0.0_dp)
      call test%check_close(input%f_v, 2.5_dp, 'f_v', relative=0.0_dp)
      call put_row([character(len=key_length) :: 'wavelength_over_a', 'f_v'], [character(len=cell_length) :: '1', '2.5'], &
                   input, error)
      call test%check_error(error, 'T:2: gives wavelength_over_a and f_v', 'two wavelengths')
      call put_row([character(len=key_length) :: 'wavelength'], [character(len=cell_length) :: '1'], input, error)
      call test%check_error(error, "T: column 'wavelength': unknown: columns are named as the keys", 'no key')
      call put_row([character(len=key_length) :: 'slip_paramter'], [character(len=cell_length) :: '1'], input, error)
      call test%check_error(error, "did you mean 'slip_parameter'?", 'nearly a key')
      call put_row([character(len=key_length) :: 'fields'], [character(len=cell_length) :: 'true'], input, error)
      call test%check_error(error, "T: column 'fields': this key cannot vary", 'a key that cannot vary')
   end subroutine check_cells

   !> Combinations are counted before they are made; the wavelength varies fastest, new keys slowest.
   subroutine check_count()
      type(namelist_t) :: file
      type(sweep_lists_t) :: lists
      type(case_input_t) :: input
      type(error_t), allocatable :: error
      character(len=:), allocatable :: order

      call file%load_text('F', '&sweep wavelength_over_a = 1, 2 slip_parameter = 0, 1 load_parameter_m = 10, 20'// &
                          " radius_ratio_d = 1, 0.5, method = 'newton', 'fas' /", error)
      call read_lists(file, table, lists, error)
      call test%check_no_error(error, 'five lists')
      order = ''
      do while (lists%next())
         call lists%put(input)
         order = order//merge('S', 's', input%case%slip_parameter > 0)//merge('F', 'f', input%case%method == 'fas')// &
                 merge('d', 'D', input%case%radius_ratio_d < 1)//merge('M', 'm', input%case%load_parameter_m > 10)// &
                 merge('W', 'w', input%case%wavelength_over_a > 1)//' '
      end do
      call test%check_equal(order(:54), 'sfDmw sfDmW sfDMw sfDMW sfdmw sfdmW sfdMw sfdMW sFDmw ', 'order of the combinations')
      call test%check_equal(len(order), 32*6, 'all combinations')
      call file%load_text('F', '&sweep'//new_line('a')//' wavelength_over_a = 100*1 slip_parameter = 100*1'// &
                          ' load_parameter_m = 1000*10, 20 /', error)
      call read_lists(file, table, lists, error)
      call test%check_no_error(error, 'repeated values')
      call test%check_close(lists%combinations(), 2.0_dp, 'what is given twice counts once', relative=0.0_dp)
      call file%load_text('F', '&sweep'//new_line('a')//' wavelength_over_a ='//numbers(200)//' slip_parameter = 1, 2'// &
                          ' load_parameter_m ='//numbers(1000)//'/', error)
      call read_lists(file, table, lists, error)
      call test%check_error(error, 'F:1: the lists of &sweep have 400000 combinations, which take about 1.2 GB', 'too many')
   end subroutine check_count

   !> 1 2 3 ...
   function numbers(n) result(text)
      integer, intent(in) :: n
      character(len=:), allocatable :: text
      integer :: i
      text = ''
      do i = 1, n
         text = text//' '//to_text(i)
      end do
      text = text//' '
   end function numbers

end program test_case_keys
