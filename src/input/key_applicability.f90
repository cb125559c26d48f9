!> Keys that are given where they do not apply, as 'cycle' without FAS, and keys that are missing where they do.
module ehlwave_key_applicability
   use ehlwave_case_definition, only: case_t
   use ehlwave_case_input, only: case_input_t
   use ehlwave_case_key, only: choice_length, key_t, key_value_t, key_visitor_t, most_keys, value_text
   use ehlwave_case_keys, only: visit_case_keys
   use ehlwave_errors, only: error_t, raise
   use ehlwave_key_bounds, only: bounds_text, is_allowed, is_none
   use ehlwave_key_list, only: default_values
   implicit none (type, external)
   private
   public :: check_applicability, check_needed

   type, extends(key_visitor_t) :: checker_t
      logical :: is_given(most_keys), may_idle(most_keys)
      type(error_t), allocatable :: error
   contains
      procedure :: visit => check
   end type checker_t

   type, extends(key_visitor_t) :: seeker_t
      character(len=choice_length) :: wanted = ''    ! group
      type(error_t), allocatable :: error
   contains
      procedure :: visit => seek
   end type seeker_t

contains

   !> Refuse a key that is given, says something and does not apply; one that may idle gets its default instead and
   !> counts as not given. Call it when radius_ratio_d is known.
   subroutine check_applicability(input, error)
      type(case_input_t), intent(inout) :: input
      type(error_t), allocatable, intent(inout) :: error
      type(checker_t) :: checker

      checker%is_given = input%is_given
      checker%may_idle = input%may_idle
      call visit_case_keys(input%case, checker)
      input%is_given = checker%is_given
      if (allocated(checker%error)) call move_alloc(checker%error, error)
   end subroutine check_applicability

   subroutine check(self, key, value)
      class(checker_t), intent(inout) :: self
      type(key_t), intent(in) :: key
      type(key_value_t), intent(inout) :: value
      type(key_value_t), allocatable :: defaults(:)

      if (key%applies .or. .not. self%is_given(key%number) .or. allocated(self%error)) return
      call default_values(defaults)
      if (self%may_idle(key%number) .or. is_none(value, defaults(key%number))) then
         value = defaults(key%number)
         self%is_given(key%number) = .false.
      else
         call raise(self%error, '&'//trim(key%group)//' '//trim(key%name)//' = '//value_text(value, 15)// &
                    ' belongs to '//trim(key%when)//': remove it, or change that')
      end if
   end subroutine check

   !> Refuse a case where a key of a group applies and has no value that it may have.
   subroutine check_needed(case, group, error)
      type(case_t), intent(in) :: case
      character(len=*), intent(in) :: group
      type(error_t), allocatable, intent(inout) :: error
      type(case_t) :: copy
      type(seeker_t) :: seeker

      copy = case
      seeker%wanted = group
      call visit_case_keys(copy, seeker)
      if (allocated(seeker%error)) call move_alloc(seeker%error, error)
   end subroutine check_needed

   subroutine seek(self, key, value)
      class(seeker_t), intent(inout) :: self
      type(key_t), intent(in) :: key
      type(key_value_t), intent(inout) :: value
      type(key_value_t), allocatable :: defaults(:)

      if (key%group /= self%wanted .or. .not. key%applies .or. allocated(self%error)) return
      if (is_allowed(key, value)) return
      call default_values(defaults)
      if (is_none(value, defaults(key%number))) then
         call raise(self%error, '&'//trim(key%group)//' '//trim(key%name)//' is missing: '//trim(key%when)//' needs it')
      else
         call raise(self%error, '&'//trim(key%group)//' '//trim(key%name)//' = '//value_text(value, 15)// &
                    ' is out of range: write a value '//bounds_text(key))
      end if
   end subroutine seek

end module ehlwave_key_applicability
