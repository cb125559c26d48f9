!> The reader of input files: files and their layout, absent and unknown keys, and what an error leaves.
program test_namelist
   use, intrinsic :: iso_fortran_env, only: int64
   use ehlwave_errors, only: error_t, raise
   use ehlwave_kinds, only: dp
   use ehlwave_namelist, only: namelist_t
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
   call accept_layouts()
   call keep_defaults()
   call refuse_files()
   call refuse_unknown_names()
   call keep_first_error()
   call load_again()
   call remove_file()
   call test%finish()

contains

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
      call load(nml, '&g x = 1 /', error)
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
      call load(nml, '&g x = -1 /', error)
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
      real(dp) :: load_number, speed
      integer :: levels
      character(len=:), allocatable :: shape
      logical :: is_there

      call load(nml, text, error)
      call nml%get('Contact', 'load', load_number, error)
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
