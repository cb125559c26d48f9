!> The table of keys as JSON, for programs that write inputs.
module ehlwave_key_json
   use ehlwave_case_key, only: choice_length, key_t, key_value_t, number_kind, truth_kind, whole_kind, words_of
   use ehlwave_case_keys, only: default_keys
   use ehlwave_json, only: real_json, string_json
   use ehlwave_key_list, only: key_list_t
   use ehlwave_key_reference, only: default_text, has_default_value
   use ehlwave_kinds, only: dp
   use ehlwave_text, only: to_text
   implicit none (type, external)
   private
   public :: case_key_json

contains

   !> All keys of a case as an object on a line: {"keys": [{"group": ..., "name": ..., ...}, ...]}, in the order of
   !> the reference.
   function case_key_json() result(text)
      character(len=:), allocatable :: text
      type(key_list_t) :: list
      integer :: k

      list = default_keys()
      text = ''
      do k = 1, list%count
         text = text//', '//key_json(list%keys(k), list%values(k))
      end do
      text = '{"keys": ['//text(3:)//']}'
   end function case_key_json

   !> Properties of a key. A missing bound is null, and so is a default that is no value: `default_text` has both as
   !> in the reference.
   function key_json(key, default) result(text)
      type(key_t), intent(in) :: key
      type(key_value_t), intent(in) :: default
      character(len=:), allocatable :: text
      character(len=*), parameter :: kinds(*) = [character(len=6) :: 'number', 'whole', 'truth', 'word']

      text = '{"group": '//string_json(trim(key%group))//', "name": '//string_json(trim(key%name))// &
             ', "kind": "'//trim(kinds(key%kind))//'", "unit": '//string_json(trim(key%unit))// &
             ', "above": '//bound_json(key%above)//', "minimum": '//bound_json(key%minimum)// &
             ', "maximum": '//bound_json(key%maximum)//', "choices": '//choices_json(trim(key%choices))// &
             ', "default": '//merge_text(has_default_value(key, default), value_json(default), 'null')// &
             ', "default_text": '//string_json(default_text(key, default))// &
             ', "required": '//to_text(key%is_required)//', "help": '//string_json(trim(key%help))// &
             ', "belongs_to": '//string_json(trim(key%when))//'}'
   end function key_json

   !> A bound, null where there is none.
   pure function bound_json(bound) result(text)
      real(dp), intent(in) :: bound
      character(len=:), allocatable :: text
      text = merge_text(abs(bound) < huge(bound), real_json(bound), 'null')
   end function bound_json

   !> The words of a list of choices.
   pure function choices_json(choices) result(text)
      character(len=*), intent(in) :: choices
      character(len=:), allocatable :: text
      character(len=choice_length), allocatable :: words(:)
      integer :: i

      words = words_of(choices)
      text = ''
      do i = 1, size(words)
         text = text//', '//string_json(trim(words(i)))
      end do
      text = '['//text(min(3, len(text) + 1):)//']'
   end function choices_json

   !> A value of any kind.
   pure function value_json(value) result(text)
      type(key_value_t), intent(in) :: value
      character(len=:), allocatable :: text
      select case (value%kind)
      case (number_kind); text = real_json(value%number)
      case (whole_kind); text = to_text(nint(value%number))
      case (truth_kind); text = to_text(value%number > 0)
      case default; text = string_json(value%word)
      end select
   end function value_json

   pure function merge_text(condition, yes, no) result(text)
      logical, intent(in) :: condition
      character(len=*), intent(in) :: yes, no
      character(len=:), allocatable :: text
      text = no
      if (condition) text = yes
   end function merge_text

end module ehlwave_key_json
