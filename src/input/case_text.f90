!> The effective input of a case as text, and its identity.
module ehlwave_case_text
   use ehlwave_case_definition, only: case_t
   use ehlwave_case_key, only: is_same, value_text
   use ehlwave_case_keys, only: case_key_list, default_keys
   use ehlwave_identity_index, only: text_identity
   use ehlwave_key_bounds, only: is_allowed
   use ehlwave_key_list, only: key_list_t
   use ehlwave_text, only: put
   implicit none (type, external)
   private
   public :: case_identity, effective_input, input_identity, input_text

   ! Lines of keys added after stores were made, with the former behaviour, which is not the default: always written, no
   ! part of the identity.
   character(len=*), parameter :: former(1) = ["  edges = 'truncated'"//new_line('a')]

contains

   !> A case file with every key that applies and the value in use: running it gives the same result.
   function effective_input(case) result(text)
      type(case_t), intent(in) :: case   !! completed
      character(len=:), allocatable :: text
      text = input_text(case_key_list(case))
   end function effective_input

   !> The keys of a case, group by group. Left out are keys that do not apply, that mean none (a value outside the
   !> bounds, an empty text), or that were added later and are not used.
   function input_text(list) result(text)
      type(key_list_t), intent(in) :: list         !! of a completed case
      character(len=:), allocatable :: text
      type(key_list_t), pointer :: defaults
      character(len=*), parameter :: line_end = new_line('a')
      character(len=:), allocatable :: group       ! group of the text
      integer :: k, n

      defaults => default_keys()
      text = ''
      n = 0
      group = ''
      do k = 1, list%count
         associate (key => list%keys(k), value => list%values(k))
            if (.not. (key%applies .and. key%is_written .and. is_allowed(key, value))) cycle
            if (key%is_late) then
               if (is_same(value, defaults%values(k))) cycle
            end if
            if (group /= key%group) then
               if (group /= '') call put(text, n, '/'//line_end)
               group = trim(key%group)
               call put(text, n, '&'//group//line_end)
            end if
            call put(text, n, '  '//trim(key%name)//' = '//value_text(value)//line_end)
         end associate
      end do
      text = text(:n)//'/'//line_end
   end function input_text

   !> Identity of a case: the identity of its effective input.
   function case_identity(case) result(identity)
      type(case_t), intent(in) :: case
      character(len=16) :: identity
      identity = input_identity(effective_input(case))
   end function case_identity

   !> Identity of an effective input: 16 hexadecimal digits, the 64-bit FNV-1a hash of it, without lines that were
   !> implicit when the first stores were made.
   function input_identity(input) result(identity)
      character(len=*), intent(in) :: input
      character(len=16) :: identity
      character(len=:), allocatable :: text
      integer :: first, k

      text = input
      do k = 1, size(former)
         first = index(text, former(k))
         if (first > 0) text = text(:first - 1)//text(first + len(former):)
      end do
      identity = text_identity(text)
   end function input_identity

end module ehlwave_case_text
