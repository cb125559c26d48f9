!> Values of an input file: accepted values for each kind of key, and messages for mistakes with the place and the
!> correct form.
program test_namelist_values
   use ehlwave_case_key, only: key_t, key_value_t, number_kind, truth_kind, whole_kind, word_kind
   use ehlwave_errors, only: error_t
   use ehlwave_key_bounds, only: read_key
   use ehlwave_kinds, only: dp
   use ehlwave_namelist, only: namelist_t
   use ehlwave_namelist_scanner, only: value_t
   use ehlwave_text, only: to_text
   use testing, only: test_t
   implicit none (type, external)

   character(len=1), parameter :: nl = achar(10), escape = achar(27)
   character(len=*), parameter :: path = 'FILE', shapes = 'cosine triangle flat'
   type(test_t) :: test

   call accept_values()
   call accept_text()
   call accept_lists()
   call refuse_numbers()
   call refuse_out_of_range()
   call refuse_other_values()
   call refuse_in_short()
   call test%finish()

contains

   !> Smallest and largest values are allowed themselves.
   subroutine accept_values()
      character(len=*), parameter :: reals(18) = [character(len=12) :: '1', '-2', '+3', '4.', '.5', '-.5', '6e1', &
                                                  '7D-2', '8.0d+0', '9.5E1', '0', '0.0e-999', &
                                                  '1e-307', '9.99e307', '0.00001e312', '100e-309', '1e+0000002', '1e-000']
      real(dp), parameter :: values(18) = [1.0_dp, -2.0_dp, 3.0_dp, 4.0_dp, 0.5_dp, -0.5_dp, 60.0_dp, &
                                           0.07_dp, 8.0_dp, 95.0_dp, 0.0_dp, 0.0_dp, &
                                           1e-307_dp, 9.99e307_dp, 1e307_dp, 1e-307_dp, 100.0_dp, 1.0_dp]
      character(len=*), parameter :: yes(7) = [character(len=6) :: '.true.', 'true', 'T', 't', '.T.', 'TRUE', '.TRUE.']
      character(len=*), parameter :: no(6) = [character(len=7) :: '.false.', 'false', 'F', 'f', '.f.', 'False']
      type(key_value_t) :: value
      integer :: i

      do i = 1, size(reals)
         value = accepted(number_kind, trim(reals(i)), key_t('x', minimum=values(i), maximum=values(i)))
         call test%check_close(value%number, values(i), 'real '//reals(i), absolute=0.0_dp)
      end do
      value = accepted(whole_kind, '-2147483647', key_t('x'))
      call test%check_equal(nint(value%number), -2147483647, 'smallest integer')
      value = accepted(whole_kind, '+0012', key_t('x', minimum=12.0_dp, maximum=12.0_dp, above=11.0_dp))
      call test%check_equal(nint(value%number), 12, 'integer with sign and zeros')
      do i = 1, size(yes)
         value = accepted(truth_kind, trim(yes(i)), key_t('x'))
         call test%check(value%number > 0, 'logical '//yes(i))
      end do
      do i = 1, size(no)
         value = accepted(truth_kind, trim(no(i)), key_t('x'))
         call test%check(.not. value%number > 0, 'logical '//no(i))
      end do
   end subroutine accept_values

   subroutine accept_text()
      type(key_value_t) :: value
      type(namelist_t) :: nml
      type(value_t), allocatable :: item
      type(error_t), allocatable :: error
      character(len=:), allocatable :: long

      value = accepted(word_kind, "'it''s ""a/b"" & = ! ( , '", key_t('x'))
      call test%check_equal(value%word, 'it''s "a/b" & = ! ( , ', 'single quotes')
      value = accepted(word_kind, '"say ""it''s"""', key_t('x'))
      call test%check_equal(value%word, 'say "it''s"', 'double quotes')
      value = accepted(word_kind, "''", key_t('x'))
      call test%check_equal(value%word, '', 'empty text')
      value = accepted(word_kind, "'TRIANGLE'", key_t('x', choices=shapes))
      call test%check_equal(value%word, 'triangle', 'choice in lower case')
      value = accepted(word_kind, "'four'", key_t('x', maximum=4.0_dp))
      call test%check_equal(value%word, 'four', 'longest text')
      long = repeat('0123456789', 3000)
      call nml%load_text(path, "&g a = 1, x = '"//long//"', b = 2 /", error)
      call nml%value_of('G', 'X', item, error)
      call test%check_no_error(error, 'line of 30000 characters')
      if (allocated(item)) call test%check(item%text == long .and. len(item%text) == 30000, 'line of 30000 characters')
   end subroutine accept_text

   subroutine accept_lists()
      type(namelist_t) :: nml
      type(error_t), allocatable :: error
      type(value_t), allocatable :: items(:)

      call load_value(nml, "'flat', 2*""Cosine""", error)
      call nml%values_of('g', 'x', items, error)
      call test%check_equal(size(items), 3, 'list of texts')
      call test%check_equal(items(1)%text//items(2)%text//items(3)%text, 'flatCosineCosine', 'texts')
      call test%check(all(items%is_quoted), 'texts in quotes')
      call load_value(nml, '100000*0.5', error)
      call nml%values_of('g', 'x', items, error)
      call test%check_equal(size(items), 100000, 'longest list')
      call test%check_equal(items(100000)%text, '0.5', 'longest list')
      call load_value(nml, '60*1 2 3'//nl//'1*4 5 300*6 7', error)
      call nml%values_of('g', 'x', items, error)
      call test%check_equal(size(items), 365, 'mixed list')
      call test%check_equal(items(60)%text//items(61)%text//items(63)%text//items(364)%text//items(365)%text, '12467', &
                            'mixed list')
      call test%check(all(items(:62)%line == 2) .and. all(items(63:)%line == 3), 'lines of values')
   end subroutine accept_lists

   !> Value of a key that must be accepted.
   function accepted(kind, text, key) result(value)
      integer, intent(in) :: kind
      character(len=*), intent(in) :: text
      type(key_t), intent(in) :: key
      type(key_value_t) :: value
      type(namelist_t) :: nml
      type(error_t), allocatable :: error

      call load_value(nml, text, error)
      call ask(nml, kind, key, value, error)
      call test%check_no_error(error, text)
   end function accepted

   !> Ask as a reader does for a key.
   subroutine ask(nml, kind, key, value, error)
      type(namelist_t), intent(inout) :: nml
      integer, intent(in) :: kind
      type(key_t), intent(in) :: key
      type(key_value_t), intent(inout) :: value
      type(error_t), allocatable, intent(inout) :: error
      type(value_t), allocatable :: item
      type(key_t) :: whole
      character(len=:), allocatable :: problem

      whole = key
      whole%kind = kind
      call nml%value_of('g', key%name, item, error)
      if (.not. allocated(item)) return
      call read_key(whole, item, value, problem)
      call nml%refuse('g', key%name, problem, error, item%line)
   end subroutine ask

   subroutine refuse_numbers()
      character(len=*), parameter :: no_numbers(19) = [character(len=9) :: 'nan', 'NaN', 'inf', '-Infinity', '1.5+3', &
                                                       '1.2.3', '1e', '1e1.5', 'e5', '.', '.-5', '+', '--1', '1;', '0x10', &
                                                       '1_8', '*2', 'true', '1d']
      character(len=*), parameter :: no_integers(4) = [character(len=4) :: '4.0', '4.', '1e3', 'four']
      integer :: i

      do i = 1, size(no_numbers)
         call refuse('real', trim(no_numbers(i)), ''''//trim(no_numbers(i))//''' does not fit: write a number such as')
      end do
      call refuse('real', '1d400', '1d400 is too large: write a number below 1e308')
      call refuse('real', '-1e400', '-1e400 is too large')
      call refuse('real', '1.8e308', '1.8e308 is too large')
      call refuse('real', '1e308', '1e308 is too large: write a number below 1e308')
      call refuse('real', '100000e303', 'is too large')
      call refuse('real', '0.00001e313', 'is too large')
      call refuse('real', '-1'//repeat('0', 308), 'is too large')
      call refuse('real', '1e99999999999999999999', 'is too large')
      call refuse('real', '1d-400', '1d-400 is too small')
      call refuse('real', '9.9e-308', '9.9e-308 is too small: write 0 or a number from 1e-307')
      call refuse('real', '0.001e-305', 'is too small')
      call refuse('real', '100e-310', 'is too small')
      call refuse('real', '1e-99999999999999999999', 'is too small')
      call refuse('real', '''1.5''', '''1.5'' in quotes is text: write a number such as 1.5 or 2e-3, without quotes')
      call refuse('real', '1,5', '2 values (1, 5) where one is needed: write one, with a point as decimal mark')
      call refuse('real', '1 2 3', '3 values (1, 2, ...) where one')
      call refuse('real', '1 2*3', '3 values')
      call refuse('real', '1 y 2', '''='' after each key')
      do i = 1, size(no_integers)
         call refuse('integer', trim(no_integers(i)), ''''//trim(no_integers(i))//''' does not fit: write a whole number such as 4')
      end do
      call refuse('integer', '''4''', 'in quotes is text: write a whole number')
      call refuse('integer', '2147483648', '2147483648 is too large for a whole number')
      call refuse('integer', '-99999999999999999999', 'is too large for a whole number')
      call refuse('integer', '1, 2', '2 values (1, 2) where one')
      call refuse('real', nl//'nan', '''nan'' does not fit', line=3)
   end subroutine refuse_numbers

   subroutine refuse_out_of_range()
      call refuse('real', '0.1', '0.1 is out of range: write a value above 0.1 and at most 2', key_t('x', above=0.1_dp, &
                  maximum=2.0_dp))
      call refuse('real', '0.1', 'write a value at least 0.2', key_t('x', minimum=0.2_dp))
      call refuse('real', '0.1', 'write a value at most 0.05', key_t('x', maximum=0.05_dp))
      call refuse('integer', '3', '3 is out of range: write a value at least 4', key_t('x', minimum=4.0_dp))
      call refuse('integer', '3', 'at most 2', key_t('x', maximum=2.0_dp))
      call refuse('integer', '3', 'above 3', key_t('x', above=3.0_dp))
   end subroutine refuse_out_of_range

   subroutine refuse_other_values()
      call refuse('logical', '1', '''1'' does not fit: write true or false')
      call refuse('logical', '''true''', 'write true or false, without quotes')
      call refuse('logical', 'T T', '2 values')
      call refuse('text', 'flat', 'flat is not in quotes: write ''flat''')
      call refuse('text', '''a'' ''b''', '2 values (a, b)')
      call refuse('text', '''Coseni''', '''coseni'' is not one of the choices: write one of ''cosine'', ''triangle'', '// &
                  '''flat''; did you mean ''cosine''?', key_t('x', choices=shapes))
      call refuse('text', '''round''', '''triangle'', ''flat''', key_t('x', choices=shapes), never='did you mean')
      call refuse('text', '''cosine triangle''', 'is not one of the choices', key_t('x', choices=shapes))
      call refuse('text', '''''', 'is not one of the choices', key_t('x', choices=shapes))
      call refuse('text', nl//'''four''', 'text of 4 characters: write at most 3', key_t('x', maximum=3.0_dp), line=3)
   end subroutine refuse_other_values

   !> A message repeats the beginning of a long value, and nothing that a terminal would obey.
   subroutine refuse_in_short()
      type(namelist_t) :: nml
      type(error_t), allocatable :: error
      type(key_value_t) :: value
      character(len=*), parameter :: kinds(2) = ['number', 'word  ']
      integer :: i

      do i = 1, 2
         if (allocated(error)) deallocate (error)
         call load_value(nml, '"'//escape//'[31m'//repeat('x', 1000000)//'"', error)
         call ask(nml, merge(number_kind, word_kind, i == 1), key_t('x', choices=shapes), value, error)
         call test%check_error(error, '?[31mxxx', 'long value of a '//kinds(i))
         call test%check(len(error%message) < 300 .and. index(error%message, escape) == 0, 'short and printable')
      end do
   end subroutine refuse_in_short

   !> Asking for `value` as the kind of value named must be refused; the message names the line and contains `needle`.
   subroutine refuse(kind, value, needle, key, line, never)
      character(len=*), intent(in) :: kind, value, needle
      type(key_t), intent(in), optional :: key                             !! its bounds and choices
      integer, intent(in), optional :: line                                !! without: the first, 2
      character(len=*), intent(in), optional :: never                      !! text that the message must not contain
      type(namelist_t) :: nml
      type(error_t), allocatable :: error
      type(key_t) :: asked
      type(key_value_t) :: got
      integer :: named

      asked = key_t('x')
      if (present(key)) asked = key
      named = 2
      if (present(line)) named = line
      call load_value(nml, value, error)
      select case (kind)
      case ('real'); call ask(nml, number_kind, asked, got, error)
      case ('integer'); call ask(nml, whole_kind, asked, got, error)
      case ('logical'); call ask(nml, truth_kind, asked, got, error)
      case ('text'); call ask(nml, word_kind, asked, got, error)
      end select
      call test%check_error(error, path//':'//to_text(named)//': key ''x'' in &g: ', 'place of '//kind//' '//value)
      call test%check_error(error, needle, kind//' '//value)
      if (present(never)) call test%check(index(error%message, never) == 0, kind//' '//value//' gets no advice')
      call test%check_equal(got%kind, 0, 'nothing is returned')
   end subroutine refuse

   !> Load a text with group g and `x = value` on line 2.
   subroutine load_value(nml, value, error)
      type(namelist_t), intent(inout) :: nml
      character(len=*), intent(in) :: value
      type(error_t), allocatable, intent(out) :: error
      call nml%load_text(path, '&g'//nl//' x = '//value//nl//'/'//nl, error)
      if (allocated(error)) call test%check_no_error(error, 'load '//value)
   end subroutine load_value

end program test_namelist_values
