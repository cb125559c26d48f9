!> The reference of a table of keys, as text for a terminal and as Markdown for inputs/README.md.
module ehlwave_key_reference
   use ehlwave_case_definition, only: case_t
   use ehlwave_case_key, only: choice_length, key_t, key_value_t, key_visitor_t, value_text, word_kind
   use ehlwave_case_keys, only: visit_case_keys
   use ehlwave_key_bounds, only: bounds_text, is_allowed, is_none
   implicit none (type, external)
   private
   public :: case_key_reference

   integer, parameter :: line_length = 118
   character(len=*), parameter :: line_end = new_line('a')

   !> Collects the reference; show it a table.
   type, extends(key_visitor_t), public :: reference_t
      logical :: is_markdown = .false.
      character(len=:), allocatable :: text
      character(len=choice_length), private :: open_group = ''
   contains
      procedure :: visit => describe
   end type reference_t

contains

   !> Reference of all keys of a case.
   function case_key_reference(is_markdown) result(text)
      logical, intent(in) :: is_markdown
      character(len=:), allocatable :: text
      type(reference_t) :: reference
      type(case_t) :: defaults

      reference%is_markdown = is_markdown
      call visit_case_keys(defaults, reference)
      text = reference%text
   end function case_key_reference

   !> One key; before the first of a group what the group is.
   subroutine describe(self, key, value)
      class(reference_t), intent(inout) :: self
      type(key_t), intent(in) :: key
      type(key_value_t), intent(inout) :: value     !! the default
      character(len=:), allocatable :: default, meaning

      if (.not. allocated(self%text)) self%text = ''
      if (self%open_group /= key%group) then
         self%open_group = key%group
         if (self%text /= '') self%text = self%text//line_end
         if (self%is_markdown) then
            self%text = self%text//'## `&'//trim(key%group)//'`'//line_end//line_end//trim(self%group_help)//line_end// &
                        line_end//'| key | default | meaning |'//line_end//'| --- | --- | --- |'//line_end
         else
            self%text = self%text//'&'//trim(key%group)//line_end//folded(trim(self%group_help))
         end if
      end if
      default = default_text(key, value)
      meaning = meaning_of(key)
      if (self%is_markdown) then
         if (default /= 'none' .and. default /= key%default) default = '`'//default//'`'
         self%text = self%text//'| `'//trim(key%name)//'` | '//default//' | '//meaning//' |'//line_end
      else
         self%text = self%text//'  '//trim(key%name)//' (default: '//default//')'//line_end//folded(meaning)
      end if
   end subroutine describe

   !> What is printed for the default of a key.
   function default_text(key, default) result(text)
      type(key_t), intent(in) :: key
      type(key_value_t), intent(in) :: default
      character(len=:), allocatable :: text

      if (key%default /= '') then
         text = trim(key%default)
      else if (key%is_required .or. .not. is_allowed(key, default)) then
         text = 'none'
      else if (key%kind == word_kind .and. is_none(default, default)) then
         text = 'none'
      else
         text = value_text(default, 12)
      end if
   end function default_text

   !> Help, unit, bounds or choices, and to what the key applies.
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
