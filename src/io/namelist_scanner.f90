!> Splits a text in Fortran namelist format into groups, keys and values, the values still as written.
!>
!> Format: groups `&name ... /` of `key = value[, value...]`, comments from `!` to the end of the line,
!> text in ' or " with the quote doubled inside, repeat counts `3*1.0`. Stricter than a Fortran
!> namelist: nothing but comments outside groups, no key or group twice, no empty values, no array
!> elements, text in quotes stays on one line and unquoted words are never text.
module ehlwave_namelist_scanner
   use ehlwave_errors, only: error_t, raise
   use ehlwave_identity_index, only: identity_index_t, identity_length, text_identity
   use ehlwave_namelist_tokens, only: cursor_t, token_t, end_of_text, quoted, word
   use ehlwave_text, only: lower_case, shown, to_text
   implicit none (type, external)
   private
   public :: contents_t, key_identity, scan_namelist, value_t

   integer, parameter, public :: name_length = 63   !! longest name of a group or key
   integer, parameter :: max_values = 100000        !! per file, repeat counts included

   type :: group_t
      character(len=name_length) :: name = ''       !! in lower case
      integer :: line = 0
   end type group_t

   !> An entry, `key = values`.
   type :: entry_t
      character(len=name_length) :: group = '', key = ''   !! in lower case
      integer :: line = 0
      integer :: first = 1, last = 0                !! its values in the list of all values; at least 1
   end type entry_t

   !> A value, without quotes and repeat count.
   type :: value_t
      character(len=:), allocatable :: text
      logical :: is_quoted = .false.
      integer :: line = 0
   end type value_t

   !> Groups, entries and values in the order of the file; lists may be longer than their content.
   type :: contents_t
      type(group_t), allocatable :: groups(:)
      type(entry_t), allocatable :: entries(:)
      type(value_t), allocatable :: values(:)
      integer :: n_groups = 0, n_entries = 0, n_values = 0
      type(identity_index_t), private :: group_index, entry_index
   contains
      procedure :: group_place
      procedure :: entry_place
   end type contents_t

   !> The entries found so far, the present token and the next.
   type, extends(cursor_t) :: scanner_t
      type(token_t) :: token, after
      type(contents_t) :: found
   end type scanner_t

contains

   !> Place of a group among all groups, 0 when it is not there.
   integer function group_place(self, group)
      class(contents_t), intent(in) :: self
      character(len=*), intent(in) :: group
      group_place = self%group_index%find(text_identity(lower_case(trim(group))))
   end function group_place

   !> Place of a key among all entries, 0 when it is not there.
   integer function entry_place(self, identity)
      class(contents_t), intent(in) :: self
      character(len=identity_length), intent(in) :: identity   !! by `key_identity`
      entry_place = self%entry_index%find(identity)
   end function entry_place

   !> Identity of a key in a group.
   pure function key_identity(group, key) result(identity)
      character(len=*), intent(in) :: group, key
      character(len=identity_length) :: identity
      identity = text_identity(lower_case(trim(group)//' '//trim(key)))
   end function key_identity

   !> Split `text`. Fails when it breaks the format.
   subroutine scan_namelist(path, text, contents, error)
      character(len=*), intent(in) :: path          !! for messages
      character(len=*), intent(in) :: text
      type(contents_t), intent(out) :: contents
      type(error_t), allocatable, intent(out) :: error
      type(scanner_t) :: s

      s%path = trim(path)
      s%text = text
      allocate (s%found%groups(8), s%found%entries(64), s%found%values(64))
      call s%take(s%after)
      call shift(s)
      do while (s%token%kind /= end_of_text)
         call take_group(s)
      end do
      if (allocated(s%error)) then
         call move_alloc(s%error, error)
      else if (s%found%n_groups == 0) then
         call raise(error, s%path//': holds no group: write at least one ''&name ... /''')
      else
         contents = s%found
      end if
   end subroutine scan_namelist

   !> Go to the next token; after an error to the end of the text.
   subroutine shift(s)
      type(scanner_t), intent(inout) :: s
      s%token = s%after
      if (s%token%kind /= end_of_text) call s%take(s%after)
      if (allocated(s%error)) s%token%kind = end_of_text
   end subroutine shift

   !> A group from '&' to '/'.
   subroutine take_group(s)
      type(scanner_t), intent(inout) :: s
      type(group_t) :: group
      integer :: i

      group%line = s%token%line
      if (s%token%kind /= '&') call s%fail(group%line, ''''//shown(s%token%text)//''' stands outside a group: '// &
                                           'move it between ''&name'' and ''/'', or make it a comment with ''!''')
      call shift(s)
      call check_name(s, 'group')
      group%name = lower_case(s%token%text)
      call s%found%group_index%add(text_identity(trim(group%name)), i)
      if (i <= s%found%n_groups) call s%fail(group%line, 'group &'//trim(group%name)// &
         ' is given twice (first on line '//to_text(s%found%groups(i)%line)//'): put all its keys into one')
      if (i > size(s%found%groups)) s%found%groups = [s%found%groups, s%found%groups]   ! room for as many again
      s%found%groups(i) = group
      s%found%n_groups = i
      call shift(s)
      do while (s%token%kind /= '/' .and. .not. allocated(s%error))
         call take_key(s, group)
      end do
      call check_end(s)
      call shift(s)
   end subroutine take_group

   !> A key with its '=' and all its values, up to the next key or the end of the group.
   subroutine take_key(s, group)
      type(scanner_t), intent(inout) :: s
      type(group_t), intent(in) :: group
      type(entry_t) :: entry
      logical :: needs_value
      integer :: i

      if (s%token%kind /= word .or. s%after%kind /= '=') then
         call refuse_token(s, group)
         return
      end if
      call check_name(s, 'key')
      entry = entry_t(group%name, lower_case(s%token%text), s%token%line, first=s%found%n_values + 1)
      call s%found%entry_index%add(key_identity(entry%group, entry%key), i)
      if (i <= s%found%n_entries) call s%fail(entry%line, 'key '''//trim(entry%key)// &
         ''' is given twice (first on line '//to_text(s%found%entries(i)%line)//'): remove one')
      call shift(s)
      call shift(s)
      needs_value = .true.
      do while (scan(s%token%kind, word//quoted//',') > 0 .and. .not. begins_key(s))
         if (s%token%kind /= ',') then
            call take_value(s, trim(entry%key))
         else if (needs_value) then
            call s%fail(s%token%line, 'empty value of key '''//trim(entry%key)//''': give a value or remove the '',''')
         end if
         needs_value = s%token%kind == ','
         call shift(s)
      end do
      call check_end(s)
      entry%last = s%found%n_values
      if (entry%last < entry%first .and. (s%token%kind == '/' .or. (begins_key(s) .and. s%after%kind == '='))) &
         call s%fail(entry%line, 'key '''//trim(entry%key)//''' has no value: give one, or remove the key')
      if (s%found%n_entries == size(s%found%entries)) s%found%entries = [s%found%entries, s%found%entries]
      s%found%n_entries = s%found%n_entries + 1
      s%found%entries(s%found%n_entries) = entry
   end subroutine take_key

   !> Whether the present token is a key, not a value of the previous key.
   pure logical function begins_key(s)
      type(scanner_t), intent(in) :: s
      begins_key = s%token%kind == word .and. scan(s%after%kind, '=(') > 0
   end function begins_key

   !> Raise the reason why a key is missing here.
   subroutine refuse_token(s, group)
      type(scanner_t), intent(inout) :: s
      type(group_t), intent(in) :: group

      select case (s%token%kind)
      case (end_of_text)
         call s%fail(group%line, 'group &'//trim(group%name)// &
            ' is not closed: put ''/'' on a line of its own at its end')
      case ('&')
         call s%fail(s%token%line, 'group &'//trim(group%name)//' of line '//to_text(group%line)// &
                     ' is not closed: put ''/'' on a line of its own before this one')
      case ('(')
         call s%fail(s%token%line, '''('' is not accepted: write a list as ''key = a, b, c''')
      case ('=', ',')
         call s%fail(s%token%line, ''''//s%token%kind//''' without a key before it: write ''key = value''')
      case default
         if (begins_key(s)) call s%fail(s%token%line, '''('' after '''//shown(s%token%text)// &
            ''': array elements are not accepted: write the whole list as ''key = a, b, c''')
         call s%fail(s%token%line, 'no key before '''//shown(s%token%text)//''', or no ''='' after it: '// &
                     'write ''key = value''')
      end select
   end subroutine refuse_token

   !> Refuse a '/' that belongs to something else.
   subroutine check_end(s)
      type(scanner_t), intent(inout) :: s
      if (s%token%kind == '/' .and. s%after%is_attached .and. scan(s%after%kind, '&'//end_of_text) == 0) &
         call s%fail(s%token%line, '''/'' ends a group: put text that holds ''/'' into quotes, '// &
                     'write fractions as decimal numbers, and begin a new line after ''/''')
   end subroutine check_end

   !> A value, with or without a repeat count.
   subroutine take_value(s, key)
      type(scanner_t), intent(inout) :: s
      character(len=*), intent(in) :: key           !! it belongs to
      type(value_t), allocatable :: grown(:)
      type(value_t) :: value
      integer :: n, repeats

      call take_repeat_count(s, key, repeats)
      if (s%after%is_attached .and. scan(s%after%kind, word//quoted) > 0) &
         call s%fail(s%token%line, 'key '''//key//''': '''//shown(s%token%text)// &
                     ''' and what follows are not apart: put '','' between values and a whole text '// &
                     'into one pair of quotes, a quote inside it doubled')
      n = s%found%n_values + repeats
      if (n > max_values) call s%fail(s%token%line, 'key '''//key//''': more than '//to_text(max_values)// &
                                      ' values in the file: give fewer')
      if (allocated(s%error)) return
      if (n > size(s%found%values)) then
         allocate (grown(2*n))
         grown(:s%found%n_values) = s%found%values(:s%found%n_values)
         call move_alloc(grown, s%found%values)
      end if
      value%text = s%token%text
      value%is_quoted = s%token%kind == quoted
      value%line = s%token%line
      s%found%values(s%found%n_values + 1:n) = value
      s%found%n_values = n
   end subroutine take_value

   !> Take the `3*` off `3*1.0`, or go from `3*` to the text in quotes after it.
   subroutine take_repeat_count(s, key, repeats)
      type(scanner_t), intent(inout) :: s
      character(len=*), intent(in) :: key
      integer, intent(out) :: repeats
      integer :: star

      repeats = 1
      star = 0
      if (s%token%kind == word) star = index(s%token%text, '*')
      if (star < 2) return
      if (verify(s%token%text(:star - 1), '0123456789') /= 0) return
      repeats = 0
      if (star <= 10) read (s%token%text(:star - 1), *) repeats
      if (repeats < 1 .or. repeats > max_values) then
         call s%fail(s%token%line, 'repeat count in '''//shown(s%token%text)//''' of key '''//key// &
            ''' must be from 1 to '//to_text(max_values))
      else if (star < len(s%token%text)) then
         s%token%text = s%token%text(star + 1:)
      else if (s%after%kind == quoted .and. s%after%is_attached) then
         call shift(s)
      else
         call s%fail(s%token%line, 'empty value of key '''//key//''': give a value after '''//shown(s%token%text)//'''')
      end if
   end subroutine take_repeat_count

   !> Whether the token at hand can be a name.
   subroutine check_name(s, what)
      type(scanner_t), intent(inout) :: s
      character(len=*), intent(in) :: what   !! 'group' or 'key'
      character(len=*), parameter :: letters = 'abcdefghijklmnopqrstuvwxyz', digits = '0123456789'
      logical :: is_name

      is_name = s%token%kind == word .and. len(s%token%text) <= name_length
      if (is_name) is_name = verify(lower_case(s%token%text(1:1)), letters) == 0 .and. &
                             verify(lower_case(s%token%text), letters//digits//'_') == 0
      if (.not. is_name) &
         call s%fail(s%token%line, ''''//shown(s%token%text)//''' is not the name of a '//what// &
                     ': use letters, digits and ''_'', at most '//to_text(name_length)//', a letter first')
   end subroutine check_name

end module ehlwave_namelist_scanner
