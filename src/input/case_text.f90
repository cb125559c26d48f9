!> The effective input of a case as text, and its identity.
module ehlwave_case_text
   use ehlwave_case_definition, only: case_t
   use ehlwave_case_key, only: is_same, key_t, key_value_t, key_visitor_t, value_text
   use ehlwave_case_keys, only: visit_case_keys
   use ehlwave_identity_index, only: text_identity
   use ehlwave_key_bounds, only: is_allowed
   use ehlwave_key_list, only: default_values
   implicit none (type, external)
   private
   public :: case_identity, effective_input, text_identity

   character(len=*), parameter :: line_end = new_line('a')

   !> Writes the keys that make a case.
   type, extends(key_visitor_t), public :: writer_t
      character(len=:), allocatable :: text
      character(len=:), allocatable, private :: open_group   ! that the text is in, '' in the beginning
      type(key_value_t), allocatable, private :: defaults(:) ! once a key is asked for its default
   contains
      procedure :: visit => write_key
   end type writer_t

contains

   !> A case file with every key that applies and the value in use: running it gives the same result.
   function effective_input(case) result(text)
      type(case_t), intent(in) :: case   !! completed
      character(len=:), allocatable :: text
      type(case_t) :: copy
      type(writer_t) :: writer

      copy = case
      call visit_case_keys(copy, writer)
      text = writer%text//'/'//line_end
   end function effective_input

   !> One key, unless it does not apply, says that there is none (a value outside its bounds, an empty text), or was
   !> added later and is not used.
   subroutine write_key(self, key, value)
      class(writer_t), intent(inout) :: self
      type(key_t), intent(in) :: key
      type(key_value_t), intent(inout) :: value

      if (.not. allocated(self%text)) then
         self%text = ''
         self%open_group = ''
      end if
      if (.not. (key%applies .and. key%is_written)) return
      if (.not. is_allowed(key, value)) return
      if (key%is_late) then
         if (.not. allocated(self%defaults)) call default_values(self%defaults)
         if (is_same(value, self%defaults(key%number))) return
      end if
      if (self%open_group /= key%group) then
         if (self%open_group /= '') self%text = self%text//'/'//line_end
         self%text = self%text//'&'//trim(key%group)//line_end
         self%open_group = trim(key%group)
      end if
      self%text = self%text//'  '//trim(key%name)//' = '//value_text(value)//line_end
   end subroutine write_key

   !> Identity of a case: 16 hexadecimal digits, the 64-bit FNV-1a hash of its effective input.
   function case_identity(case) result(identity)
      type(case_t), intent(in) :: case
      character(len=16) :: identity
      identity = text_identity(effective_input(case))
   end function case_identity

end module ehlwave_case_text
