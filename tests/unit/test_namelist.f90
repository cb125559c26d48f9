!> The reader of input files: what it accepts, and that each mistake gets a message that names the
!> place and says what to change.
program test_namelist
   use, intrinsic :: iso_fortran_env, only: int64
   use ehlwave_errors, only: error_t, raise
   use ehlwave_kinds, only: dp
   use ehlwave_namelist, only: namelist_t
   use ehlwave_spelling, only: edit_distance, nearest_word
   use ehlwave_text, only: to_text
   use testing, only: test_t
   implicit none (type, external)

   character(len=1), parameter :: nl = achar(10), cr = achar(13), tab = achar(9)
   character(len=*), parameter :: bom = char(239)//char(187)//char(191)
   character(len=*), parameter :: shapes(3) = [character(len=8) :: 'cosine', 'Triangle', 'flat']
   !> A list of texts; as plain variables such lists get false 'uninitialized' warnings from gfortran 12.
   type :: texts_t
      character(len=:), allocatable :: list(:)
   end type texts_t

   type(test_t) :: test
   character(len=:), allocatable :: path   ! of the temporary file
   integer(int64) :: ticks

   call system_clock(ticks)
   path = 'test_namelist_'//to_text(ticks)//'.tmp'
   call accept_values()
   call accept_layouts()
   call accept_text()
   call accept_lists()
   call keep_defaults()
   call refuse_files()
   call refuse_formats()
   call refuse_names()
   call refuse_numbers()
   call refuse_other_values()
   call refuse_out_of_range()
   call refuse_unknown_names()
   call keep_first_error()
   call load_again()
   call measure_distance()
   call remove_file()
   call test%finish()

contains

   subroutine accept_values()
      type(namelist_t) :: nml
      type(error_t), allocatable :: error
      real(dp) :: x
      integer :: n
      logical :: is_on
      character(len=*), parameter :: reals(18) = [character(len=12) :: '1', '-2', '+3', '4.', '.5', '-.5', '6e1', &
                                                  '7D-2', '8.0d+0', '9.5E1', '0', '0.0e-999', &
                                                  '1e-307', '9.99e307', '0.00001e312', '100e-309', '1e+0000002', '1e-000']
      real(dp), parameter :: values(18) = [1.0_dp, -2.0_dp, 3.0_dp, 4.0_dp, 0.5_dp, -0.5_dp, 60.0_dp, &
                                           0.07_dp, 8.0_dp, 95.0_dp, 0.0_dp, 0.0_dp, &
                                           1e-307_dp, 9.99e307_dp, 1e307_dp, 1e-307_dp, 100.0_dp, 1.0_dp]
      character(len=*), parameter :: yes(7) = [character(len=6) :: '.true.', 'true', 'T', 't', '.T.', 'TRUE', '.TRUE.']
      character(len=*), parameter :: no(6) = [character(len=7) :: '.false.', 'false', 'F', 'f', '.f.', 'False']
      integer :: i

      do i = 1, size(reals)
         call load_value(nml, trim(reals(i)), error)
         x = -77
         call nml%get('g', 'x', x, error)
         call test%check_no_error(error, 'real '//reals(i))
         call test%check_close(x, values(i), 'real '//reals(i), absolute=0.0_dp)
      end do
      call load_value(nml, '-2147483647', error)
      call nml%get('g', 'x', n, error)
      call test%check_no_error(error, 'smallest integer')
      call test%check_equal(n, -2147483647, 'smallest integer')
      call load_value(nml, '+0012', error)
      call nml%get('G', 'X', n, error)
      call test%check_equal(n, 12, 'integer with sign and zeros, names asked for in capitals')
      do i = 1, size(yes)
         call load_value(nml, trim(yes(i)), error)
         is_on = .false.
         call nml%get('g', 'x', is_on, error)
         call test%check(is_on .and. .not. allocated(error), 'logical '//yes(i))
      end do
      do i = 1, size(no)
         call load_value(nml, trim(no(i)), error)
         is_on = .true.
         call nml%get('g', 'x', is_on, error)
         call test%check(.not. is_on .and. .not. allocated(error), 'logical '//no(i))
      end do
   end subroutine accept_values

   subroutine accept_layouts()
      type(namelist_t) :: nml
      type(error_t), allocatable :: error
      character(len=:), allocatable :: text
      real(dp), allocatable :: list(:)
      integer :: a, b, c

      text = bom//'! caf'//char(195)//char(169)//' it''s a comment / & = "'//cr//nl//cr//nl// &
             '&First'//tab//'a=1,B = 2 ! both'//cr//nl//' c'//nl//tab//'='//nl//'! between'//nl//' 3,'//nl//'/ ! end'//nl// &
             '&second /&third list = 1 2,3 , 2*4.5'//nl//'5'//cr//'6 /'
      call load(nml, text, error)
      call test%check_no_error(error, 'layout')
      call test%check_equal(nml%text, text, 'text is kept as it is')
      call test%check_equal(nml%path, path, 'path is kept')
      call nml%get('first', 'a', a, error)
      call nml%get('first', 'b', b, error)
      call nml%get('first', 'c', c, error)
      call test%check(all([a, b, c] == [1, 2, 3]), 'several keys on a line and a key over several lines')
      call nml%get_list('third', 'list', list, error)
      call test%check_close(list, [1.0_dp, 2.0_dp, 3.0_dp, 4.5_dp, 4.5_dp, 5.0_dp, 6.0_dp], &
                            'blanks and commas, repeat count, several lines', absolute=0.0_dp)
      call test%check(nml%has_group('SECOND'), 'group that is there')
      call test%check(.not. nml%has_group('fourth'), 'group that is absent')
      call test%check(nml%has('first', 'A'), 'key that is there')
      call test%check(.not. nml%has('second', 'a'), 'key that is absent')
      call test%check_equal(nml%place('first', 'c'), path//':4: ', 'place of a key, lines counted over CR LF')
      call test%check_equal(nml%place('third', 'list'), path//':9: ', 'place of a later key')
      call test%check_equal(nml%place('second', 'a'), path//':9: ', 'place of a key that is absent')
      call test%check_equal(nml%place('fourth', 'a'), path//': ', 'place in a group that is absent')
      call nml%check_all_used(error)
      call test%check_no_error(error, 'everything was asked for')
   end subroutine accept_layouts

   subroutine accept_text()
      type(namelist_t) :: nml
      type(error_t), allocatable :: error
      character(len=:), allocatable :: name
      character(len=8) :: short
      character(len=:), allocatable :: long

      call load_value(nml, '''it''''s "a/b" & = ! ( , ''', error)
      call nml%get('g', 'x', name, error)
      call test%check_no_error(error, 'single quotes')
      call test%check_equal(name, 'it''s "a/b" & = ! ( , ', 'single quotes')
      call load_value(nml, '"say ""it''s"""', error)
      call nml%get('g', 'x', name, error)
      call test%check_equal(name, 'say "it''s"', 'double quotes')
      call load_value(nml, '''''', error)
      call nml%get('g', 'x', name, error)
      call test%check_equal(name, '', 'empty text')
      long = repeat('0123456789', 3000)
      call load(nml, '&g a = 1, x = '''//long//''', b = 2 /', error)
      call nml%get('g', 'x', name, error)
      call test%check_no_error(error, 'line of 30000 characters')
      call test%check(name == long .and. len(name) == 30000, 'line of 30000 characters')
      call load_value(nml, '''TRIANGLE''', error)
      call nml%get('g', 'x', name, error, choices=shapes)
      call test%check_equal(name, 'triangle', 'choice in lower case')
      call nml%get_fixed('g', 'x', short, error)
      call test%check_equal(short, 'TRIANGLE', 'text of fixed length')
      call nml%get_fixed('g', 'x', short, error, choices=shapes)
      call test%check_equal(short, 'triangle', 'choice of fixed length')
      call load_value(nml, '''flat''', error)
      call nml%get_fixed('g', 'x', short, error)
      call test%check_equal(short, 'flat    ', 'shorter text in a fixed length')
      call test%check_no_error(error, 'text')
   end subroutine accept_text

   subroutine accept_lists()
      type(namelist_t) :: nml
      type(error_t), allocatable :: error
      type(texts_t) :: names
      real(dp), allocatable :: list(:)

      call load_value(nml, '''flat'', 2*"Cosine"', error)
      call nml%get_list('g', 'x', names%list, error)
      call test%check_no_error(error, 'list of texts')
      call test%check_equal(size(names%list), 3, 'list of texts')
      call test%check_equal(len(names%list), 6, 'length of texts')
      call test%check_equal(names%list(1)//names%list(2)//names%list(3), 'flat  CosineCosine', 'texts')
      call nml%get_list('g', 'x', names%list, error, choices=shapes)
      call test%check_equal(names%list(1)//names%list(2)//names%list(3), 'flat  cosinecosine', 'list of choices')
      call load_value(nml, '100000*0.5', error)
      call nml%get_list('g', 'x', list, error, above=0.0_dp, below=1.0_dp)
      call test%check_no_error(error, 'longest list')
      call test%check_equal(size(list), 100000, 'longest list')
      call test%check_close(list(100000), 0.5_dp, 'longest list', absolute=0.0_dp)
      call load_value(nml, '60*1 2 3'//nl//'1*4 5 300*6 7', error)
      call nml%get_list('g', 'x', list, error)
      call test%check_close(list, [spread(1.0_dp, 1, 60), 2.0_dp, 3.0_dp, 4.0_dp, 5.0_dp, spread(6.0_dp, 1, 300), &
                                   7.0_dp], 'mixed list', absolute=0.0_dp)
      call load_value(nml, '2', error)
      call nml%get_list('g', 'x', list, error)
      call test%check_close(list, [2.0_dp], 'list of one', absolute=0.0_dp)
   end subroutine accept_lists

   subroutine keep_defaults()
      type(namelist_t) :: nml
      type(error_t), allocatable :: error
      real(dp) :: x
      integer :: n
      logical :: is_on
      character(len=:), allocatable :: name
      type(texts_t) :: names
      character(len=4) :: short
      real(dp), allocatable :: list(:)

      x = 1.5_dp
      n = 7
      is_on = .true.
      allocate (name, source='Default')
      short = 'four'
      list = [1.0_dp, 2.0_dp]
      names%list = ['a', 'b']
      call load_value(nml, '1', error)
      call nml%get('g', 'a', x, error, minimum=100.0_dp)
      call nml%get('g', 'b', n, error, minimum=100)
      call nml%get('h', 'c', is_on, error)
      call nml%get('g', 'd', name, error, choices=shapes)
      call nml%get_fixed('g', 'd', short, error, choices=shapes)
      call nml%get_list('g', 'e', list, error, minimum=100.0_dp)
      call nml%get_list('g', 'f', names%list, error, choices=shapes)
      call test%check_no_error(error, 'absent keys')
      call test%check_close(x, 1.5_dp, 'default real', absolute=0.0_dp)
      call test%check_equal(n, 7, 'default integer')
      call test%check(is_on, 'default logical')
      call test%check_equal(name, 'Default', 'default text')
      call test%check_equal(short, 'four', 'default text of fixed length')
      call test%check_close(list, [1.0_dp, 2.0_dp], 'default list', absolute=0.0_dp)
      call test%check_equal(names%list(1)//names%list(2), 'ab', 'default list of texts')
      call load_value(nml, '-1', error)
      call nml%get('g', 'x', x, error, minimum=0.0_dp)
      call test%check_close(x, 1.5_dp, 'a refused value does not replace the default', absolute=0.0_dp)
   end subroutine keep_defaults

   subroutine refuse_files()
      type(namelist_t) :: nml
      type(error_t), allocatable :: error

      call nml%load('no such file.nml', error)
      call test%check_error(error, 'no such file.nml: no such file: check the path', 'missing file')
      deallocate (error)
      call nml%load('', error)
      call test%check_error(error, 'give its path', 'no path')
      deallocate (error)
      call nml%load('.', error)
      call test%check_error(error, '.: cannot be read (Is a directory)', 'directory')
      deallocate (error)
      call load(nml, '', error)
      call test%check_error(error, path//': is empty', 'empty file')
      deallocate (error)
      call load(nml, '! nothing but a comment'//nl//nl, error)
      call test%check_error(error, path//': holds no group', 'file without groups')
      deallocate (error)
      call load(nml, '&g'//achar(0)//'/', error)
      call test%check_error(error, path//': holds zero bytes', 'zero bytes')
      deallocate (error)
      call load(nml, repeat(' ', 16*1024*1024 + 1), error)
      call test%check_error(error, path//': is larger than 16 MiB', 'very large file')
   end subroutine refuse_files

   subroutine refuse_formats()
      call refuse_text('&g'//nl//' a = 1'//nl, 1, 'group &g is not closed: put ''/''', 'end of file in a group')
      call refuse_text('&g'//nl//' a = 1'//nl//'&h b = 2 /', 3, 'group &g of line 1 is not closed', 'group in a group')
      call refuse_text('&g'//nl//' a = 1'//nl//'&end', 3, 'put ''/'' on a line', 'old end of group')
      call refuse_text(nl//'a = 1'//nl//'&g /', 2, '''a'' stands outside a group', 'text before the groups')
      call refuse_text('&g /'//nl//'b', 2, '''b'' stands outside a group', 'text after the groups')
      call refuse_text('&g /'//nl//'/', 2, '''/'' stands outside a group', 'slash after the groups')
      call refuse_text('&g'//nl//'a = ''x'//nl//'b = ''y'' /', 2, 'close the text with '' on the line', 'open quote')
      call refuse_text('&g a = "x', 1, 'close the text with " on the line', 'open quote at the end of the file')
      call refuse_text('&g a = "x'//cr//nl//'"/', 1, 'quote without', 'open quote before CR LF')
      call refuse_text('&g'//nl//'a ='//nl//'b = 1 /', 2, 'key ''a'' has no value', 'no value before a key')
      call refuse_text('&g'//nl//'a ='//nl//'/', 2, 'key ''a'' has no value', 'no value before the end')
      call refuse_text('&g a = , b = 1 /', 1, 'empty value of key ''a''', 'comma for a value')
      call refuse_text('&g a = 1,,2 /', 1, 'empty value of key ''a''', 'two commas')
      call refuse_text('&g a = 1,'//nl//',2 /', 2, 'empty value of key ''a''', 'two commas on two lines')
      call refuse_text('&g a = 3* /', 1, 'empty value of key ''a'': give a value after ''3*''', 'repeat of nothing')
      call refuse_text('&g a = 3* ''x'' /', 1, 'empty value of key ''a''', 'blank after a repeat count')
      call refuse_text('&g a = 0*1 /', 1, 'repeat count in ''0*1'' of key ''a'' must be from 1', 'repeat 0')
      call refuse_text('&g a = 100001*1 /', 1, 'repeat count in ''100001*1'' of key ''a''', 'large repeat')
      call refuse_text('&g a = 99999999999*1 /', 1, 'repeat count in', 'very large repeat')
      call refuse_text('&g a = 90000*1, 20000*1 /', 1, 'key ''a'': more than 100000 values', 'many values')
      call refuse_text('&g'//nl//'a(2) = 1 /', 2, 'array elements are not accepted: write the whole list', 'element')
      call refuse_text('&g a = 1'//nl//'b (2) = 1 /', 2, '''('' after ''b''', 'element after a blank')
      call refuse_text('&g a = (1, 2) /', 1, '''('' is not accepted', 'complex number')
      call refuse_text('&g a = 1/2 /', 1, 'write fractions as decimal numbers', 'fraction')
      call refuse_text('&g a = /tmp/x /', 1, 'put text that holds ''/'' into quotes', 'path without quotes')
      call refuse_text('&g a = don''t /', 1, 'quote without its partner', 'quote in a word')
      call refuse_text('&g a = don''t, b = ''x'' /', 1, 'key ''a'': ''don'' and what follows are not apart', 'quotes in words')
      call refuse_text('&g a = ''x''''y'' /', 1, '', 'doubled quote is accepted', is_accepted=.true.)
      call refuse_text('&g a = ''x''y'' /', 1, 'key ''a'': ''x'' and what follows are not apart', 'quote not doubled')
      call refuse_text('&g a = ''x''b = 1 /', 1, 'are not apart', 'key attached to a text')
      call refuse_text('&g a'//nl//'/', 1, 'no ''='' after it: write ''key = value''', 'key alone')
      call refuse_text('&g'//nl//' a 1 /', 2, 'no key before ''a'', or no ''=''', 'no equals sign')
      call refuse_text('&g ''a'' = 1 /', 1, 'no key before ''a''', 'key in quotes')
      call refuse_text('&g , a = 1 /', 1, ''','' without a key', 'comma first')
      call refuse_text('&g = 1 /', 1, '''='' without a key', 'equals sign first')
      call refuse_text('&g a == 1 /', 1, '''='' without a key', 'two equals signs')
      call refuse_text('&g a '//char(226)//char(137)//char(136)//' 1 /', 1, 'not plain ASCII', 'UTF-8 outside quotes')
      call refuse_text('&g'//nl//' a ='//char(194)//char(160)//'1 /', 2, 'retype it', 'hard blank')
      call refuse_text(char(255)//char(254)//'&g /', 1, 'not plain ASCII', 'UTF-16')
   end subroutine refuse_formats

   subroutine refuse_names()
      call refuse_text('&g'//nl//'a = 1'//nl//'b = 2'//nl//'A = 3 /', 4, &
                       'key ''a'' is given twice (first on line 2): remove one', 'doubled key')
      call refuse_text('&g a = 1 /'//nl//'&h a = 1 /', 1, '', 'key in two groups is accepted', is_accepted=.true.)
      call refuse_text('&g a = 1 /'//nl//'&h /'//nl//'&G b = 1 /', 3, &
                       'group &g is given twice (first on line 1): put all its keys into one', 'doubled group')
      call refuse_text('& g a = 1 /', 1, '', 'blank before the name of a group is accepted', is_accepted=.true.)
      call refuse_text('& /', 1, '''/'' is not the name of a group', 'group without a name')
      call refuse_text('&', 1, 'not the name of a group', 'group without anything')
      call refuse_text('&2g /', 1, '''2g'' is not the name of a group', 'group that begins with a digit')
      call refuse_text('&g a%b = 1 /', 1, '''a%b'' is not the name of a key: use letters', 'component')
      call refuse_text('&g a-b = 1 /', 1, '''a-b'' is not the name of a key', 'minus in a key')
      call refuse_text('&g 1 = 1 /', 1, '''1'' is not the name of a key', 'number as key')
      call refuse_text('&g a = b = 1 /', 1, 'key ''a'' has no value', 'key as value')
      call refuse_text('&g '//repeat('a', 64)//' = 1 /', 1, 'at most 63', 'long key')
      call refuse_text('&g '//repeat('a', 63)//' = 1 /', 1, '', 'key of 63 letters is accepted', is_accepted=.true.)
   end subroutine refuse_names

   subroutine refuse_numbers()
      call refuse_real('nan', '''nan'' does not fit: write a number such as')
      call refuse_real('NaN', 'write a number')
      call refuse_real('inf', 'write a number')
      call refuse_real('-Infinity', 'write a number')
      call refuse_real('1d400', '1d400 is too large: write a number below 1e308')
      call refuse_real('-1e400', '-1e400 is too large')
      call refuse_real('1.8e308', '1.8e308 is too large')
      call refuse_real('1e308', '1e308 is too large: write a number below 1e308')
      call refuse_real('100000e303', 'is too large')
      call refuse_real('0.00001e313', 'is too large')
      call refuse_real('-1'//repeat('0', 308), 'is too large')
      call refuse_real('1e99999999999999999999', 'is too large')
      call refuse_real('1d-400', '1d-400 is too small')
      call refuse_real('9.9e-308', '9.9e-308 is too small: write 0 or a number from 1e-307')
      call refuse_real('0.001e-305', 'is too small')
      call refuse_real('100e-310', 'is too small')
      call refuse_real('1e-99999999999999999999', 'is too small')
      call refuse_real('1.5+3', 'write a number')
      call refuse_real('1.2.3', 'write a number')
      call refuse_real('1e', 'write a number')
      call refuse_real('1e1.5', 'write a number')
      call refuse_real('e5', 'write a number')
      call refuse_real('.', 'write a number')
      call refuse_real('.-5', 'write a number')
      call refuse_real('+', 'write a number')
      call refuse_real('--1', 'write a number')
      call refuse_real('1;', 'write a number')
      call refuse_real('0x10', 'write a number')
      call refuse_real('1_8', 'write a number')
      call refuse_real('*2', 'write a number')
      call refuse_real('true', 'write a number')
      call refuse_real('''1.5''', '''1.5'' in quotes is text: write a number such as 1.5 or 2e-3, without quotes')
      call refuse_real('1,5', '2 values (1, 5) where one is needed: write one, with a point as decimal mark')
      call refuse_real('1 2 3', '3 values (1, 2, ...) where one')
      call refuse_real('1 2*3', '3 values')
      call refuse_real('1 y 2', '''='' after each key')
      call refuse_integer('4.0', '''4.0'' does not fit: write a whole number such as 4')
      call refuse_integer('4.', 'write a whole number')
      call refuse_integer('1e3', 'write a whole number')
      call refuse_integer('four', 'write a whole number')
      call refuse_integer('''4''', 'in quotes is text: write a whole number')
      call refuse_integer('2147483648', '2147483648 is too large for a whole number')
      call refuse_integer('-99999999999999999999', 'is too large for a whole number')
      call refuse_integer('1, 2', '2 values (1, 2) where one')
   end subroutine refuse_numbers

   subroutine refuse_other_values()
      type(namelist_t) :: nml
      type(error_t), allocatable :: error
      logical :: is_on
      character(len=:), allocatable :: name
      type(texts_t) :: names
      character(len=3) :: short
      real(dp), allocatable :: list(:)

      call load_value(nml, '1', error)
      call nml%get('g', 'x', is_on, error)
      call test%check_error(error, path//':2: key ''x'' in &g: ''1'' does not fit: write true or false', 'logical 1')
      call load_value(nml, '''true''', error)
      call nml%get('g', 'x', is_on, error)
      call test%check_error(error, 'write true or false, without quotes', 'logical in quotes')
      call load_value(nml, 'T T', error)
      call nml%get('g', 'x', is_on, error)
      call test%check_error(error, '2 values', 'two logicals')
      call load_value(nml, 'flat', error)
      call nml%get('g', 'x', name, error)
      call test%check_error(error, path//':2: key ''x'' in &g: flat is not in quotes: write ''flat''', 'no quotes')
      call load_value(nml, '''a'' ''b''', error)
      call nml%get('g', 'x', name, error)
      call test%check_error(error, '2 values (a, b)', 'two texts')
      call load_value(nml, '''Coseni''', error)
      call nml%get('g', 'x', name, error, choices=shapes)
      call test%check_error(error, '''coseni'' is not one of the choices: write one of ''cosine'', ''triangle'', '// &
                            '''flat''; did you mean ''cosine''?', 'choice')
      call load_value(nml, '''round''', error)
      call nml%get('g', 'x', name, error, choices=shapes)
      call test%check_error(error, '''triangle'', ''flat''', 'choice near none')
      call test%check(index(error%message, 'did you mean') == 0, 'choice near none gets no advice')
      call load_value(nml, '''''', error)
      call nml%get('g', 'x', name, error, choices=shapes)
      call test%check_error(error, 'is not one of the choices', 'empty choice')
      call load_value(nml, '''four''', error)
      call nml%get_fixed('g', 'x', short, error)
      call test%check_error(error, path//':2: key ''x'' in &g: text of 4 characters: write 3 at most', 'long text')
      call load_value(nml, '''a'' ''b''', error)
      call nml%get_fixed('g', 'x', short, error)
      call test%check_error(error, '2 values', 'two texts of fixed length')
      call load_value(nml, '1,'//nl//'nan', error)
      call nml%get_list('g', 'x', list, error)
      call test%check_error(error, path//':3: key ''x'' in &g: ''nan'' does not fit', 'NaN in a list')
      call test%check(.not. allocated(list), 'a refused list is not returned')
      call load_value(nml, '''flat'''//nl//'cosine', error)
      call nml%get_list('g', 'x', names%list, error)
      call test%check_error(error, path//':3: key ''x'' in &g: cosine is not in quotes', 'text in a list')
      call load_value(nml, '''flat'' ''round''', error)
      call nml%get_list('g', 'x', names%list, error, choices=shapes)
      call test%check_error(error, '''round'' is not one of the choices', 'choice in a list')
      call test%check(.not. allocated(names%list), 'a refused list of texts is not returned')
   end subroutine refuse_other_values

   subroutine refuse_out_of_range()
      type(namelist_t) :: nml
      type(error_t), allocatable :: error
      real(dp) :: x
      real(dp), allocatable :: list(:)
      integer :: n

      call load_value(nml, '0.1', error)
      call nml%get('g', 'x', x, error, minimum=0.1_dp, maximum=0.1_dp)
      call test%check_no_error(error, 'minimum and maximum are allowed themselves')
      call nml%get('g', 'x', x, error, above=0.1_dp, maximum=2.0_dp)
      call test%check_error(error, path//':2: key ''x'' in &g: 0.1 is out of range: write a value above 0.1 and '// &
                            'at most 2', 'above')
      call load_value(nml, '0.1', error)
      call nml%get('g', 'x', x, error, minimum=0.0_dp, below=0.1_dp)
      call test%check_error(error, 'write a value at least 0 and below 0.1', 'below')
      call load_value(nml, '0.1', error)
      call nml%get('g', 'x', x, error, minimum=0.2_dp)
      call test%check_error(error, 'write a value at least 0.2', 'minimum')
      call load_value(nml, '0.1', error)
      call nml%get('g', 'x', x, error, maximum=0.05_dp)
      call test%check_error(error, 'write a value at most 0.05', 'maximum')
      call load_value(nml, '3', error)
      call nml%get('g', 'x', n, error, minimum=3, maximum=3, above=2, below=4)
      call test%check_no_error(error, 'integer inside')
      call test%check_equal(n, 3, 'integer inside')
      call nml%get('g', 'x', n, error, minimum=4)
      call test%check_error(error, path//':2: key ''x'' in &g: 3 is out of range: write a value at least 4', 'minimum')
      call load_value(nml, '3', error)
      call nml%get('g', 'x', n, error, maximum=2)
      call test%check_error(error, 'at most 2', 'integer maximum')
      call load_value(nml, '3', error)
      call nml%get('g', 'x', n, error, above=3)
      call test%check_error(error, 'above 3', 'integer above')
      call load_value(nml, '3', error)
      call nml%get('g', 'x', n, error, below=3)
      call test%check_error(error, 'below 3', 'integer below')
      call load_value(nml, '1 2'//nl//'3', error)
      call nml%get_list('g', 'x', list, error, minimum=1.0_dp, maximum=3.0_dp)
      call test%check_no_error(error, 'list inside')
      call nml%get_list('g', 'x', list, error, below=3.0_dp)
      call test%check_error(error, path//':3: key ''x'' in &g: 3 is out of range: write a value below 3', 'list')
      call load_value(nml, '1 2 3', error)
      call nml%get_list('g', 'x', list, error, above=1.0_dp)
      call test%check_error(error, '1 is out of range: write a value above 1', 'list above')
   end subroutine refuse_out_of_range

   subroutine refuse_unknown_names()
      call refuse_unknown('&contact load = 1, speed = 2 /', '', 'all known')
      call refuse_unknown('&contact'//nl//' laod = 1 /', &
                          ':2: unknown key ''laod'' in &contact: did you mean ''load''?', 'misspelt key')
      call refuse_unknown('&contact'//nl//'laod = 1'//nl//'sped = 2 /', ':2: unknown key ''laod''', 'two misspelt keys')
      call refuse_unknown('&contakt /'//nl//'&grit /', ':1: unknown group &contakt', 'two misspelt groups')
      call refuse_unknown('&contact roughness = 1 /', &
                          ':1: unknown key ''roughness'' in &contact: the known keys are load, speed, shape', 'other key')
      call refuse_unknown('&contact'//nl//nl//'levels = 1 /', &
                          ':3: unknown key ''levels'' in &contact: it belongs to &grid or &output, move it there', &
                          'key of another group')
      call refuse_unknown('&contakt load = 1 /', &
                          ':1: unknown group &contakt: did you mean ''&contact''?', 'misspelt group')
      call refuse_unknown('&contact load = 1 /'//nl//'&waves /', &
                          ':2: unknown group &waves: the known groups are &contact, &grid, &output, &bare', 'other group')
      call refuse_unknown('&bare x = 1 /', ':1: unknown key ''x'' in &bare: no keys are known here', 'group without keys')
   end subroutine refuse_unknown_names

   !> Load `text`, ask for a set of keys and check what is said about the rest; nothing when `needle` is empty.
   subroutine refuse_unknown(text, needle, what)
      character(len=*), intent(in) :: text, needle, what
      type(namelist_t) :: nml
      type(error_t), allocatable :: error
      real(dp) :: load_value, speed
      integer :: levels
      character(len=:), allocatable :: shape
      logical :: is_there

      call load(nml, text, error)
      call nml%get('Contact', 'load', load_value, error)
      call nml%get('contact', 'Speed', speed, error)
      call nml%get('contact', 'shape', shape, error)
      call nml%get('grid', 'levels', levels, error)
      is_there = nml%has('output', 'levels')
      is_there = nml%has_group('bare')
      call test%check_no_error(error, what)
      call nml%check_all_used(error)
      if (needle == '') then
         call test%check_no_error(error, what)
      else
         call test%check_error(error, path//needle, what)
      end if
   end subroutine refuse_unknown

   subroutine keep_first_error()
      type(namelist_t) :: nml
      type(error_t), allocatable :: error
      real(dp) :: x
      real(dp), allocatable :: list(:)
      character(len=:), allocatable :: name
      type(texts_t) :: names
      character(len=4) :: short
      integer :: n
      logical :: is_on

      call load(nml, '&g x = 1, n = 2, is_on = T, name = ''a'', bad = nan, unknown = 1 /', error)
      call raise(error, 'first')
      x = 0
      n = 0
      is_on = .false.
      short = 'four'
      call nml%get('g', 'x', x, error)
      call nml%get('g', 'n', n, error)
      call nml%get('g', 'is_on', is_on, error)
      call nml%get('g', 'name', name, error)
      call nml%get_fixed('g', 'name', short, error)
      call nml%get_list('g', 'x', list, error)
      call nml%get_list('g', 'name', names%list, error)
      call nml%get('g', 'bad', x, error)
      call nml%check_all_used(error)
      call nml%load('no such file.nml', error)
      call test%check_equal(error%message, 'first', 'the first error stays')
      call test%check(abs(x) <= 0 .and. n == 0 .and. .not. is_on .and. short == 'four', 'no value after an error')
      call test%check(.not. (allocated(name) .or. allocated(list) .or. allocated(names%list)), 'no list after an error')
   end subroutine keep_first_error

   !> A reader can be used for several files; a failed load leaves it as it was.
   subroutine load_again()
      type(namelist_t) :: nml
      type(error_t), allocatable :: error
      integer :: n

      n = 0
      call nml%get('g', 'x', n, error)
      call nml%check_all_used(error)
      call test%check(.not. allocated(error) .and. n == 0, 'before the first load every key is absent')
      call test%check(.not. nml%has_group('g'), 'before the first load every group is absent')
      call load(nml, '&g x = 1, y = 2 /', error)
      call nml%get('g', 'x', n, error)
      call nml%get('g', 'y', n, error)
      call load(nml, '&g x = 3, y = 4', error)
      call test%check_error(error, 'not closed', 'second load')
      deallocate (error)
      call nml%get('g', 'y', n, error)
      call test%check_equal(n, 2, 'a failed load changes nothing')
      call load(nml, '&g x = 3, y = 4 /', error)
      call nml%get('g', 'x', n, error)
      call test%check_equal(n, 3, 'third load')
      call nml%check_all_used(error)
      call test%check_error(error, 'unknown key ''y''', 'what was known in one file is not known in the next')
   end subroutine load_again

   subroutine measure_distance()
      call test%check_equal(edit_distance('kitten', 'sitting  '), 3, 'replace and insert')
      call test%check_equal(edit_distance('load', 'laod'), 1, 'swap')
      call test%check_equal(edit_distance('abcd', 'bd'), 2, 'remove')
      call test%check_equal(edit_distance('abxy', 'bcxy'), 2, 'half a swap is none')
      call test%check_equal(edit_distance('', 'abc'), 3, 'from nothing')
      call test%check_equal(edit_distance('abc', ''), 3, 'to nothing')
      call test%check_equal(nearest_word('p', ['h', 'q']), 0, 'single letters are never near')
      call test%check_equal(nearest_word('amplitud', ['amplitude', 'altitude ']), 1, 'nearest of two')
      call test%check_equal(nearest_word('loxd', ['none', 'load', 'lord']), 2, 'first of two that are equally near')
      call test%check_equal(nearest_word('viscosity', ['velocity ', 'roughness']), 0, 'none near')
   end subroutine measure_distance

   !> The file must be refused with `path:line: ` and `needle`.
   subroutine refuse_text(text, line, needle, what, is_accepted)
      character(len=*), intent(in) :: text, needle, what
      integer, intent(in) :: line
      logical, intent(in), optional :: is_accepted
      type(namelist_t) :: nml
      type(error_t), allocatable :: error

      call load(nml, text, error)
      if (present(is_accepted)) then
         call test%check_no_error(error, what)
      else
         call test%check_error(error, path//':'//to_text(line)//': ', what//': line')
         call test%check_error(error, needle, what)
      end if
   end subroutine refuse_text

   subroutine refuse_real(value, needle)
      character(len=*), intent(in) :: value, needle
      type(namelist_t) :: nml
      type(error_t), allocatable :: error
      real(dp) :: x
      call load_value(nml, value, error)
      call nml%get('g', 'x', x, error)
      call test%check_error(error, path//':2: key ''x'' in &g: ', 'place of real '//value)
      call test%check_error(error, needle, 'real '//value)
   end subroutine refuse_real

   subroutine refuse_integer(value, needle)
      character(len=*), intent(in) :: value, needle
      type(namelist_t) :: nml
      type(error_t), allocatable :: error
      integer :: n
      call load_value(nml, value, error)
      call nml%get('g', 'x', n, error)
      call test%check_error(error, path//':2: key ''x'' in &g: ', 'place of integer '//value)
      call test%check_error(error, needle, 'integer '//value)
   end subroutine refuse_integer

   !> Load a file with group g and `x = value` on line 2.
   subroutine load_value(nml, value, error)
      type(namelist_t), intent(inout) :: nml
      character(len=*), intent(in) :: value
      type(error_t), allocatable, intent(out) :: error
      call load(nml, '&g'//nl//' x = '//value//nl//'/'//nl, error)
      if (allocated(error)) call test%check_no_error(error, 'load '//value)
   end subroutine load_value

   subroutine load(nml, text, error)
      type(namelist_t), intent(inout) :: nml
      character(len=*), intent(in) :: text
      type(error_t), allocatable, intent(out) :: error
      integer :: unit
      open (newunit=unit, file=path, access='stream', form='unformatted', status='replace', action='write')
      write (unit) text
      close (unit)
      call nml%load(path, error)
   end subroutine load

   !> Gives `path` back as well: a leak checker would report a variable of the program.
   subroutine remove_file()
      integer :: unit
      open (newunit=unit, file=path)
      close (unit, status='delete')
      deallocate (path)
   end subroutine remove_file

end program test_namelist
