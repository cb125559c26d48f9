!> Splits a text in Fortran namelist format into groups, keys and values, the values still as written.
!>
!> Format: groups `&name ... /` of `key = value[, value...]`, comments from `!` to the end of the line,
!> text in ' or " with the quote doubled inside, repeat counts `3*1.0`. Stricter than a Fortran
!> namelist: nothing but comments outside groups, no key or group twice, no empty values, no array
!> elements, text in quotes stays on one line and a word without quotes is never text.
module ehlwave_namelist_scanner
   use ehlwave_errors, only: error_t, raise
   use ehlwave_namelist_tokens, only: cursor_t, token_t, end_of_text, quoted, word
   use ehlwave_text, only: lower_case, to_text
   implicit none (type, external)
   private
   public :: scan_namelist, group_t, entry_t, value_t

   integer, parameter, public :: name_length = 63   !! longest name of a group or key
   integer, parameter :: max_values = 100000        !! in one file, repeat counts included

   type :: group_t
      character(len=name_length) :: name = ''       !! in lower case
      integer :: line = 0
   end type group_t

   !> One `key = values`.
   type :: entry_t
      character(len=name_length) :: group = '', key = ''   !! in lower case
      integer :: line = 0
      integer :: first = 1, last = 0                !! its values in the list of all values; at least one
   end type entry_t

   !> One value, without quotes and repeat count.
   type :: value_t
      character(len=:), allocatable :: text
      logical :: is_quoted = .false.
      integer :: line = 0
   end type value_t

   !> What was found so far, the token at hand and the one after it.
   type :: scanner_t
      type(cursor_t) :: cursor
      type(token_t) :: token, after
      type(group_t), allocatable :: groups(:)
      type(entry_t), allocatable :: entries(:)
      type(value_t), allocatable :: values(:)       !! the first `n_values` are in use
      integer :: n_values = 0
      type(entry_t) :: current                      !! key being read; line 0 before the first of a group
      logical :: needs_value = .false.              !! after '=' or ','
   end type scanner_t

contains

   !> Split `text`; groups, entries and values are in the order of the file.
   subroutine scan_namelist(path, text, groups, entries, values, error)
      character(len=*), intent(in) :: path          !! for messages
      character(len=*), intent(in) :: text
      type(group_t), allocatable, intent(out) :: groups(:)
      type(entry_t), allocatable, intent(out) :: entries(:)
      type(value_t), allocatable, intent(out) :: values(:)
      type(error_t), allocatable, intent(out) :: error
      type(scanner_t) :: s

      s%cursor%path = trim(path)
      s%cursor%text = text
      allocate (s%groups(0), s%entries(0), s%values(64))
      call s%cursor%take(s%after, error)
      if (.not. allocated(error)) call shift(s, error)
      do while (.not. allocated(error) .and. s%token%kind /= end_of_text)
         call take_group(s, error)
      end do
      if (allocated(error)) return
      if (size(s%groups) == 0) then
         call raise(error, s%cursor%path//': holds no group: write at least one ''&name ... /''')
         return
      end if
      call move_alloc(s%groups, groups)
      call move_alloc(s%entries, entries)
      call move_alloc(s%values, values)
   end subroutine scan_namelist

   !> Go one token further.
   subroutine shift(s, error)
      type(scanner_t), intent(inout) :: s
      type(error_t), allocatable, intent(out) :: error
      s%token = s%after
      if (s%token%kind /= end_of_text) call s%cursor%take(s%after, error)
   end subroutine shift

   !> One group from '&' to '/'.
   subroutine take_group(s, error)
      type(scanner_t), intent(inout) :: s
      type(error_t), allocatable, intent(out) :: error
      type(group_t) :: group
      integer :: i

      group%line = s%token%line
      if (s%token%kind /= '&') then
         call s%cursor%fail(error, group%line, ''''//s%token%text//''' stands outside a group: '// &
                            'move it between ''&name'' and ''/'', or make it a comment with ''!''')
         return
      end if
      call shift(s, error)
      if (allocated(error)) return
      call check_name(s, 'group', error)
      if (allocated(error)) return
      group%name = lower_case(s%token%text)
      do i = 1, size(s%groups)
         if (s%groups(i)%name == group%name) then
            call s%cursor%fail(error, group%line, 'group &'//trim(group%name)//' is given twice (first on line '// &
                               to_text(s%groups(i)%line)//'): put all its keys into one')
            return
         end if
      end do
      s%groups = [s%groups, group]
      call shift(s, error)
      do while (.not. allocated(error) .and. s%token%kind /= '/')
         call take_item(s, group, error)
         if (.not. allocated(error)) call shift(s, error)
      end do
      if (allocated(error)) return
      if (s%after%is_attached .and. scan(s%after%kind, '&'//end_of_text) == 0) then
         call s%cursor%fail(error, s%token%line, '''/'' ends a group: put text that holds ''/'' into quotes, '// &
                            'write fractions as decimal numbers, and begin a new line after ''/''')
         return
      end if
      call end_key(s, error)
      if (.not. allocated(error)) call shift(s, error)
   end subroutine take_group

   !> One key with its '=', one value or one comma inside a group.
   subroutine take_item(s, group, error)
      type(scanner_t), intent(inout) :: s
      type(group_t), intent(in) :: group
      type(error_t), allocatable, intent(out) :: error

      select case (s%token%kind)
      case (end_of_text)
         call s%cursor%fail(error, group%line, 'group &'//trim(group%name)// &
                            ' is not closed: put ''/'' on a line of its own at its end')
      case ('&')
         call s%cursor%fail(error, s%token%line, 'group &'//trim(group%name)//' of line '//to_text(group%line)// &
                            ' is not closed: put ''/'' on a line of its own before this one')
      case ('(')
         call s%cursor%fail(error, s%token%line, '''('' is not accepted: write a list as ''key = a, b, c''')
      case ('=')
         call s%cursor%fail(error, s%token%line, '''='' without a key before it: write ''key = value''')
      case (',')
         if (s%current%line == 0) then
            call s%cursor%fail(error, s%token%line, ''','' without a key before it: write ''key = value''')
         else if (s%needs_value) then
            call s%cursor%fail(error, s%token%line, 'empty value of key '''//trim(s%current%key)// &
                               ''': give a value or remove the '',''')
         end if
         s%needs_value = .true.
      case default
         if (s%token%kind == word .and. s%after%kind == '=') then
            call begin_key(s, error)
         else if (s%token%kind == word .and. s%after%kind == '(') then
            call s%cursor%fail(error, s%token%line, '''('' after '''//s%token%text//''': array elements are not '// &
                               'accepted: write the whole list as ''key = a, b, c''')
         else if (s%current%line == 0) then
            call s%cursor%fail(error, s%token%line, 'no key before '''//s%token%text//''', or no ''='' after it: '// &
                               'write ''key = value''')
         else
            call take_value(s, error)
         end if
      end select
   end subroutine take_item

   !> Close the key before, note the new one and go to its '='.
   subroutine begin_key(s, error)
      type(scanner_t), intent(inout) :: s
      type(error_t), allocatable, intent(out) :: error
      type(entry_t) :: new
      integer :: i

      call end_key(s, error)
      if (allocated(error)) return
      call check_name(s, 'key', error)
      if (allocated(error)) return
      new%group = s%groups(size(s%groups))%name
      new%key = lower_case(s%token%text)
      new%line = s%token%line
      new%first = s%n_values + 1
      do i = 1, size(s%entries)
         if (s%entries(i)%group == new%group .and. s%entries(i)%key == new%key) then
            call s%cursor%fail(error, new%line, 'key '''//trim(new%key)//''' is given twice (first on line '// &
                               to_text(s%entries(i)%line)//'): remove one')
            return
         end if
      end do
      s%current = new
      s%needs_value = .true.
      call shift(s, error)
   end subroutine begin_key

   !> Store the key being read, if there is one.
   subroutine end_key(s, error)
      type(scanner_t), intent(inout) :: s
      type(error_t), allocatable, intent(out) :: error

      s%needs_value = .false.
      if (s%current%line == 0) return
      s%current%last = s%n_values
      if (s%current%last < s%current%first) then
         call s%cursor%fail(error, s%current%line, 'key '''//trim(s%current%key)// &
                            ''' has no value: give one, or remove the key')
      else
         s%entries = [s%entries, s%current]
      end if
      s%current = entry_t()
   end subroutine end_key

   !> A value, with or without a repeat count.
   subroutine take_value(s, error)
      type(scanner_t), intent(inout) :: s
      type(error_t), allocatable, intent(out) :: error
      integer :: repeats

      call take_repeat_count(s, repeats, error)
      if (allocated(error)) return
      if (s%after%is_attached .and. scan(s%after%kind, word//quoted) > 0) then
         call s%cursor%fail(error, s%token%line, 'key '''//trim(s%current%key)//''': '''//s%token%text// &
                            ''' and what follows are not apart: put '','' between values and a whole text '// &
                            'into one pair of quotes, a quote inside it doubled')
         return
      end if
      call store_value(s, repeats, error)
   end subroutine take_value

   !> Take the `3*` off `3*1.0`, or go from `3*` to the text in quotes after it.
   subroutine take_repeat_count(s, repeats, error)
      type(scanner_t), intent(inout) :: s
      integer, intent(out) :: repeats
      type(error_t), allocatable, intent(out) :: error
      integer :: star

      repeats = 1
      star = 0
      if (s%token%kind == word) star = index(s%token%text, '*')
      if (star < 2) return
      if (verify(s%token%text(:star - 1), '0123456789') /= 0) return
      repeats = 0
      if (star <= 10) read (s%token%text(:star - 1), *) repeats
      if (repeats < 1 .or. repeats > max_values) then
         call s%cursor%fail(error, s%token%line, 'repeat count in '''//s%token%text//''' of key '''// &
                            trim(s%current%key)//''' must be from 1 to '//to_text(max_values))
      else if (star < len(s%token%text)) then
         s%token%text = s%token%text(star + 1:)
      else if (s%after%kind == quoted .and. s%after%is_attached) then
         call shift(s, error)
      else
         call s%cursor%fail(error, s%token%line, 'empty value of key '''//trim(s%current%key)// &
                            ''': give a value after '''//s%token%text//'''')
      end if
   end subroutine take_repeat_count

   !> Add the token at hand to the values.
   subroutine store_value(s, repeats, error)
      type(scanner_t), intent(inout) :: s
      integer, intent(in) :: repeats
      type(error_t), allocatable, intent(out) :: error
      type(value_t), allocatable :: grown(:)
      integer :: i, n

      n = s%n_values + repeats
      if (n > max_values) then
         call s%cursor%fail(error, s%token%line, 'key '''//trim(s%current%key)//''': more than '// &
                            to_text(max_values)//' values in the file: give fewer')
         return
      end if
      if (n > size(s%values)) then
         allocate (grown(2*n))
         do i = 1, s%n_values
            call move_alloc(s%values(i)%text, grown(i)%text)
            grown(i)%is_quoted = s%values(i)%is_quoted
            grown(i)%line = s%values(i)%line
         end do
         call move_alloc(grown, s%values)
      end if
      do i = s%n_values + 1, n
         s%values(i)%text = s%token%text
         s%values(i)%is_quoted = s%token%kind == quoted
         s%values(i)%line = s%token%line
      end do
      s%n_values = n
      s%needs_value = .false.
   end subroutine store_value

   !> Whether the token at hand can be a name.
   subroutine check_name(s, what, error)
      type(scanner_t), intent(in) :: s
      character(len=*), intent(in) :: what   !! 'group' or 'key'
      type(error_t), allocatable, intent(out) :: error
      character(len=*), parameter :: letters = 'abcdefghijklmnopqrstuvwxyz', digits = '0123456789'
      logical :: is_name

      is_name = s%token%kind == word .and. len(s%token%text) <= name_length
      if (is_name) is_name = verify(lower_case(s%token%text(1:1)), letters) == 0 .and. &
                             verify(lower_case(s%token%text), letters//digits//'_') == 0
      if (.not. is_name) then
         call s%cursor%fail(error, s%token%line, ''''//s%token%text//''' is not the name of a '//what// &
                            ': use letters, digits and ''_'', at most '//to_text(name_length)//', a letter first')
      end if
   end subroutine check_name

end module ehlwave_namelist_scanner
