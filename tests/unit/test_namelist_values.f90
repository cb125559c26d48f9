!> Values of an input file: what is accepted for each kind of key, and that each mistake gets a message that names the
!> place and says what to write.
program test_namelist_values
   use ehlwave_errors, only: error_t
   use ehlwave_kinds, only: dp
   use ehlwave_namelist, only: namelist_t
   use ehlwave_text, only: to_text
   use testing, only: test_t
   implicit none (type, external)

   character(len=1), parameter :: nl = achar(10)
   character(len=*), parameter :: path = 'FILE'
   character(len=*), parameter :: shapes(3) = [character(len=8) :: 'cosine', 'Triangle', 'flat']
   !> A list of texts; as plain variables such lists get false 'uninitialized' warnings from gfortran 12.
   type :: texts_t
      character(len=:), allocatable :: list(:)
   end type texts_t

   type(test_t) :: test

   call accept_values()
   call accept_text()
   call accept_lists()
   call refuse_numbers()
   call refuse_out_of_range()
   call refuse_other_values()
   call test%finish()

contains

   !> Smallest and largest values are allowed themselves.
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
         call nml%get('g', 'x', x, error, minimum=values(i), maximum=values(i))
         call test%check_no_error(error, 'real '//reals(i))
         call test%check_close(x, values(i), 'real '//reals(i), absolute=0.0_dp)
      end do
      call load_value(nml, '-2147483647', error)
      call nml%get('g', 'x', n, error)
      call test%check_no_error(error, 'smallest integer')
      call test%check_equal(n, -2147483647, 'smallest integer')
      call load_value(nml, '+0012', error)
      call nml%get('G', 'X', n, error, minimum=12, maximum=12, above=11, below=13)
      call test%check_no_error(error, 'integer between its bounds')
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
      call nml%load_text(path, '&g a = 1, x = '''//long//''', b = 2 /', error)
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
      call nml%get_list('g', 'x', list, error, minimum=1.0_dp, maximum=7.0_dp)
      call test%check_no_error(error, 'mixed list')
      call test%check_close(list, [spread(1.0_dp, 1, 60), 2.0_dp, 3.0_dp, 4.0_dp, 5.0_dp, spread(6.0_dp, 1, 300), &
                                   7.0_dp], 'mixed list', absolute=0.0_dp)
      call load_value(nml, '2', error)
      call nml%get_list('g', 'x', list, error)
      call test%check_close(list, [2.0_dp], 'list of one', absolute=0.0_dp)
   end subroutine accept_lists

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
      call refuse('reals', '1,'//nl//'nan', '''nan'' does not fit', line=3)
   end subroutine refuse_numbers

   subroutine refuse_out_of_range()
      call refuse('real', '0.1', '0.1 is out of range: write a value above 0.1 and at most 2', above=0.1_dp, maximum=2.0_dp)
      call refuse('real', '0.1', 'write a value at least 0 and below 0.1', minimum=0.0_dp, below=0.1_dp)
      call refuse('real', '0.1', 'write a value at least 0.2', minimum=0.2_dp)
      call refuse('real', '0.1', 'write a value at most 0.05', maximum=0.05_dp)
      call refuse('integer', '3', '3 is out of range: write a value at least 4', minimum=4.0_dp)
      call refuse('integer', '3', 'at most 2', maximum=2.0_dp)
      call refuse('integer', '3', 'above 3', above=3.0_dp)
      call refuse('integer', '3', 'below 3', below=3.0_dp)
      call refuse('reals', '1 2'//nl//'3', '3 is out of range: write a value below 3', below=3.0_dp, line=3)
      call refuse('reals', '1 2 3', '1 is out of range: write a value above 1', above=1.0_dp)
   end subroutine refuse_out_of_range

   subroutine refuse_other_values()
      call refuse('logical', '1', '''1'' does not fit: write true or false')
      call refuse('logical', '''true''', 'write true or false, without quotes')
      call refuse('logical', 'T T', '2 values')
      call refuse('text', 'flat', 'flat is not in quotes: write ''flat''')
      call refuse('text', '''a'' ''b''', '2 values (a, b)')
      call refuse('choice', '''Coseni''', '''coseni'' is not one of the choices: write one of ''cosine'', ''triangle'', '// &
                  '''flat''; did you mean ''cosine''?')
      call refuse('choice', '''round''', '''triangle'', ''flat''', never='did you mean')
      call refuse('choice', '''''', 'is not one of the choices')
      call refuse('fixed', '''four''', 'text of 4 characters: write 3 at most')
      call refuse('fixed', nl//'''four''', 'text of 4 characters')
      call refuse('fixed', '''a'' ''b''', '2 values')
      call refuse('texts', '''flat'''//nl//'cosine', 'cosine is not in quotes', line=3)
      call refuse('choices', '''flat'' ''round''', '''round'' is not one of the choices')
   end subroutine refuse_other_values

   !> Asking for `value` as the kind of value named must be refused; the message names the line and says what `needle` says.
   subroutine refuse(kind, value, needle, line, minimum, maximum, above, below, never)
      character(len=*), intent(in) :: kind, value, needle
      integer, intent(in), optional :: line                                !! without: the first, 2
      real(dp), intent(in), optional :: minimum, maximum, above, below     !! for numbers
      character(len=*), intent(in), optional :: never                      !! what the message must not say
      type(namelist_t) :: nml
      type(error_t), allocatable :: error
      integer, allocatable :: low, high, over, under
      real(dp) :: x
      real(dp), allocatable :: list(:)
      integer :: named, n
      logical :: is_on
      character(len=3) :: short
      character(len=:), allocatable :: name
      type(texts_t) :: names

      if (present(minimum)) low = nint(minimum)
      if (present(maximum)) high = nint(maximum)
      if (present(above)) over = nint(above)
      if (present(below)) under = nint(below)
      named = 2
      if (present(line)) named = line
      call load_value(nml, value, error)
      select case (kind)
      case ('real'); call nml%get('g', 'x', x, error, minimum, maximum, above, below)
      case ('reals'); call nml%get_list('g', 'x', list, error, minimum, maximum, above, below)
      case ('integer'); call nml%get('g', 'x', n, error, low, high, over, under)
      case ('logical'); call nml%get('g', 'x', is_on, error)
      case ('text'); call nml%get('g', 'x', name, error)
      case ('choice'); call nml%get('g', 'x', name, error, shapes)
      case ('fixed'); call nml%get_fixed('g', 'x', short, error)
      case ('texts'); call nml%get_list('g', 'x', names%list, error)
      case ('choices'); call nml%get_list('g', 'x', names%list, error, shapes)
      end select
      call test%check_error(error, path//':'//to_text(named)//': key ''x'' in &g: ', 'place of '//kind//' '//value)
      call test%check_error(error, needle, kind//' '//value)
      if (present(never)) call test%check(index(error%message, never) == 0, kind//' '//value//' gets no advice')
      call test%check(.not. (allocated(name) .or. allocated(list) .or. allocated(names%list)), 'nothing is returned')
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
