!> The reader of input files: files and their layout, absent and unknown keys, and the state after an error.
program test_namelist
   use, intrinsic :: iso_fortran_env, only: int64
   use ehlwave_errors, only: error_t, raise
   use ehlwave_namelist, only: namelist_t
   use ehlwave_namelist_scanner, only: value_t
   use ehlwave_text, only: to_text
   use testing, only: test_t
   implicit none (type, external)

   character(len=1), parameter :: nl = achar(10), cr = achar(13), tab = achar(9)
   character(len=*), parameter :: bom = char(239)//char(187)//char(191)
   type(test_t) :: test
   character(len=:), allocatable :: path   ! name of the temporary file
   integer(int64) :: ticks

   call system_clock(ticks)
   path = 'test_namelist_'//to_text(ticks)//'.tmp'
   call accept_layouts()
   call leave_absent_keys()
   call read_many_keys()
   call refuse_files()
   call refuse_unknown_names()
   call shorten_long_lists()
   call keep_first_error()
   call load_again()
   call remove_file()
   call test%finish()

contains

   subroutine accept_layouts()
      type(namelist_t) :: nml
      type(error_t), allocatable :: error
      character(len=:), allocatable :: text
      type(value_t), allocatable :: items(:)
      integer :: i

      text = bom//'! caf'//char(195)//char(169)//' it''s a comment / & = "'//cr//nl//cr//nl// &
             '&First'//tab//'a=1,B = 2 ! both'//cr//nl//' c'//nl//tab//'='//nl//'! between'//nl//' 3,'//nl//'/ ! end'//nl// &
             '&second /&third list = 1 2,3 , 2*4.5'//nl//'5'//cr//'6 /'
      call load(nml, text, error)
      call test%check_no_error(error, 'layout')
      call test%check_equal(nml%text, text, 'text is kept as it is')
      call test%check_equal(nml%path, path, 'path is kept')
      call test%check_equal(text_of(nml, 'first', 'a')//text_of(nml, 'first', 'b')//text_of(nml, 'first', 'c'), '123', &
                            'several keys on a line and a key over several lines')
      call nml%values_of('third', 'list', items, error)
      text = ''
      do i = 1, size(items)
         text = text//items(i)%text//' '
      end do
      call test%check_equal(text, '1 2 3 4.5 4.5 5 6 ', 'blanks and commas, repeat count, several lines')
      call test%check_equal(nml%place('first', 'c'), path//':4: ', 'place of a key, lines counted over CR LF')
      call test%check_equal(nml%place('third', 'list'), path//':9: ', 'place of a later key')
      call test%check_equal(nml%place('second', 'a'), path//':9: ', 'place of a key that is absent')
      call test%check_equal(nml%place('fourth', 'a'), path//': ', 'place in a group that is absent')
   end subroutine accept_layouts

   !> Nothing for a key that is absent.
   function text_of(nml, group, key) result(text)
      type(namelist_t), intent(inout) :: nml
      character(len=*), intent(in) :: group, key
      character(len=:), allocatable :: text
      type(value_t), allocatable :: item
      type(error_t), allocatable :: error
      text = ''
      call nml%value_of(group, key, item, error)
      if (allocated(item)) text = item%text
   end function text_of

   subroutine leave_absent_keys()
      type(namelist_t) :: nml
      type(error_t), allocatable :: error
      type(value_t), allocatable :: item, items(:)

      call load(nml, '&g x = 1 /', error)
      call nml%value_of('g', 'a', item, error)
      call nml%value_of('h', 'x', item, error)
      call nml%values_of('g', 'b', items, error)
      call test%check_no_error(error, 'absent keys')
      call test%check(.not. (allocated(item) .or. allocated(items)), 'no values of absent keys')
   end subroutine leave_absent_keys

   !> A hundred thousand keys take no longer than a hundred thousand values.
   subroutine read_many_keys()
      integer, parameter :: n = 100000
      type(namelist_t) :: nml
      type(error_t), allocatable :: error
      character(len=:), allocatable :: text
      integer :: i
      allocate (character(len=18*n) :: text)
      do i = 1, n
         write (text(18*i - 17:18*i), '(a,i6.6,a,i6.6,1x)') ' k', i, ' =', i
      end do
      call nml%load_text('many', '&g '//text//' /', error)
      call test%check_no_error(error, 'many keys')
      call test%check_equal(text_of(nml, 'g', 'k000001')//text_of(nml, 'g', 'K100000'), '000001100000', 'first and last key')
      call nml%load_text('many', '&g '//text//' k000007 = 1 /', error)
      call test%check_error(error, "key 'k000007' is given twice (first on line 1)", 'a key twice among many')
   end subroutine read_many_keys

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
                          ':2: unknown group &waves: the known groups are &contact, &grid, &output', 'other group')
   end subroutine refuse_unknown_names

   !> A message lists at most 30 names; longer lists are replaced by their number.
   subroutine shorten_long_lists()
      type(namelist_t) :: nml
      type(error_t), allocatable :: error
      type(value_t), allocatable :: item
      integer :: i

      call load(nml, '&g roughness = 1 /', error)
      do i = 1, 40
         call nml%value_of('g', 'k'//to_text(i), item, error)
      end do
      call nml%check_all_used(error)
      call test%check_error(error, "unknown key 'roughness' in &g: none of the 40 known keys is like it", 'long list')
   end subroutine shorten_long_lists

   !> Load `text`, ask for a set of keys and check the message about the rest; nothing when `needle` is empty.
   subroutine refuse_unknown(text, needle, what)
      character(len=*), intent(in) :: text, needle, what
      type(namelist_t) :: nml
      type(error_t), allocatable :: error
      type(value_t), allocatable :: item

      call load(nml, text, error)
      call nml%value_of('Contact', 'load', item, error)
      call nml%value_of('contact', 'Speed', item, error)
      call nml%value_of('contact', 'shape', item, error)
      call nml%value_of('grid', 'levels', item, error)
      call nml%value_of('output', 'levels', item, error)
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
      type(value_t), allocatable :: item, items(:)

      call load(nml, '&g x = 1, list = 1, 2, unknown = 1 /', error)
      call raise(error, 'first')
      call nml%value_of('g', 'x', item, error)
      call nml%value_of('g', 'list', item, error)
      call nml%values_of('g', 'list', items, error)
      call nml%check_all_used(error)
      call nml%load('no such file.nml', error)
      call test%check_equal(error%message, 'first', 'the first error stays')
      call test%check(.not. (allocated(item) .or. allocated(items)), 'no value after an error')
   end subroutine keep_first_error

   !> A reader can be used for several files; a failed load leaves it as it was.
   subroutine load_again()
      type(namelist_t) :: nml
      type(error_t), allocatable :: error

      call test%check_equal(text_of(nml, 'g', 'x'), '', 'before the first load every key is absent')
      call nml%check_all_used(error)
      call test%check_no_error(error, 'before the first load')
      call load(nml, '&g x = 1, y = 2 /', error)
      call test%check_equal(text_of(nml, 'g', 'x')//text_of(nml, 'g', 'y'), '12', 'first load')
      call load(nml, '&g x = 3, y = 4', error)
      call test%check_error(error, 'not closed', 'second load')
      deallocate (error)
      call test%check_equal(text_of(nml, 'g', 'y'), '2', 'a failed load changes nothing')
      call load(nml, '&g x = 3, y = 4 /', error)
      call test%check_equal(text_of(nml, 'g', 'x'), '3', 'third load')
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
