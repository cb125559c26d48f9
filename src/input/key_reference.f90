!> The reference of a table of keys, as text for a terminal and as Markdown for the pages of inputs/keys.
module ehlwave_key_reference
   use ehlwave_case_key, only: key_t, key_value_t, value_text, word_kind
   use ehlwave_case_keys, only: default_keys
   use ehlwave_key_bounds, only: bounds_text, is_allowed, is_none
   use ehlwave_key_list, only: key_list_t
   implicit none (type, external)
   private
   public :: case_key_reference, default_text, has_default_value, key_reference

   integer, parameter :: line_length = 118
   character(len=*), parameter :: line_end = new_line('a')

contains

   !> Reference of all keys of a case.
   function case_key_reference(is_markdown) result(text)
      logical, intent(in) :: is_markdown
      character(len=:), allocatable :: text
      text = key_reference(default_keys(), is_markdown)
   end function case_key_reference

   !> Reference of the keys of a list; the first of a group follows a description of the group.
   function key_reference(list, is_markdown) result(text)
      type(key_list_t), intent(in) :: list           !! with the defaults
      logical, intent(in) :: is_markdown
      character(len=:), allocatable :: text
      character(len=:), allocatable :: default, group
      integer :: k

      text = ''
      group = ''
      do k = 1, list%count
         associate (key => list%keys(k))
            if (group /= key%group) then
               group = trim(key%group)
               if (text /= '') text = text//line_end
               if (is_markdown) then
                  text = text//'## `&'//group//'`'//line_end//line_end//trim(key%group_help)//line_end//line_end// &
                         '| key | default | meaning |'//line_end//'| --- | --- | --- |'//line_end
               else
                  text = text//'&'//group//line_end//folded(trim(key%group_help))
               end if
            end if
            default = default_text(key, list%values(k))
            if (is_markdown) then
               if (default /= 'none' .and. default /= key%default) default = '`'//default//'`'
               text = text//'| `'//trim(key%name)//'` | '//default//' | '//meaning_of(key)//' |'//line_end
            else
               text = text//'  '//trim(key%name)//' (default: '//default//')'//line_end//folded(meaning_of(key))
            end if
         end associate
      end do
   end function key_reference

   !> The default of a key as it is printed.
   function default_text(key, default) result(text)
      type(key_t), intent(in) :: key
      type(key_value_t), intent(in) :: default
      character(len=:), allocatable :: text

      if (key%default /= '') then
         text = trim(key%default)
      else if (has_default_value(key, default)) then
         text = value_text(default, 12)
      else
         text = 'none'
      end if
   end function default_text

   !> Whether the default is a value that a key may be given.
   logical function has_default_value(key, default) result(is_said)
      type(key_t), intent(in) :: key
      type(key_value_t), intent(in) :: default

      is_said = key%default == '' .and. .not. key%is_required
      if (is_said) is_said = is_allowed(key, default)
      if (is_said .and. key%kind == word_kind) is_said = .not. is_none(default, default)
   end function has_default_value

   !> Help, unit, bounds or choices, and condition of a key.
   function meaning_of(key) result(text)
      type(key_t), intent(in) :: key
      character(len=:), allocatable :: text, bounds

      text = trim(key%help)
      if (key%unit /= '1') text = text//', in '//trim(key%unit)
      bounds = bounds_text(key)
      if (bounds /= '' .and. key%kind == word_kind) then
         text = text//'. One of '//bounds
      else if (bounds /= '') then
         text = text//'. '//upper_first(bounds)
      end if
      if (key%when /= '') text = text//'. Belongs to '//trim(key%when)
   end function meaning_of

   pure function upper_first(text) result(upper)
      character(len=*), intent(in) :: text
      character(len=len(text)) :: upper
      upper = text
      if (upper(1:1) >= 'a' .and. upper(1:1) <= 'z') upper(1:1) = achar(iachar(upper(1:1)) - 32)
   end function upper_first

   !> Text in lines of a terminal, indented.
   pure function folded(text) result(lines)
      character(len=*), intent(in) :: text
      character(len=:), allocatable :: lines
      integer :: first, last

      lines = ''
      first = 1
      do while (first <= len(text))
         last = len(text)
         if (last - first + 1 > line_length) last = first + index(text(first:first + line_length), ' ', back=.true.) - 2
         lines = lines//'      '//text(first:last)//line_end
         first = last + 2
      end do
   end function folded

end module ehlwave_key_reference
