!> Keys that are given where they do not apply, as 'cycle' without FAS, and keys that are missing where they do.
module ehlwave_key_applicability
   use ehlwave_case_definition, only: case_t
   use ehlwave_case_input, only: case_input_t
   use ehlwave_case_key, only: is_same, value_text
   use ehlwave_case_keys, only: default_keys, list_case_keys, list_oil_keys
   use ehlwave_errors, only: error_t, raise
   use ehlwave_key_bounds, only: bounds_text, is_allowed, is_none
   use ehlwave_key_list, only: key_list_t
   implicit none (type, external)
   private
   public :: check_applicability, check_oil

contains

   !> Refuse a given key that does not apply, or has no effect with another value than its default. A key that may
   !> idle gets its default instead and counts as not given. A setting of the solution is noted instead. Call it
   !> when radius_ratio_d and the slip are known.
   subroutine check_applicability(input, error)
      type(case_input_t), intent(inout) :: input
      type(error_t), allocatable, intent(inout) :: error
      type(key_list_t), save :: given
      call list_case_keys(input%case, given)
      associate (keys => given%keys(:given%count))
         if (any(input%is_given(:given%count) .and. .not. (keys%applies .and. keys%counts))) &
            call drop_idle(input, given, error)
      end associate
   end subroutine check_applicability

   !> Drop idle keys, where there may be any.
   subroutine drop_idle(input, given, error)
      type(case_input_t), intent(inout) :: input
      type(key_list_t), intent(in) :: given        !! keys of the case
      type(error_t), allocatable, intent(inout) :: error
      type(key_list_t), pointer :: defaults
      character(len=:), allocatable :: idle
      logical :: is_dropped(given%count)
      integer :: k

      defaults => default_keys()
      idle = ''
      is_dropped = .false.
      do k = 1, given%count
         associate (key => given%keys(k), value => given%values(k), default => defaults%values(k))
            if (key%applies .and. key%counts .or. .not. input%is_given(k)) cycle
            if (key%applies .and. key%is_effort) then
               if (.not. (input%may_idle(k) .or. is_same(value, default))) &
                  idle = idle//'; '//shown_key(given, k)//' belongs to '//trim(key%when)
               cycle
            end if
            if (.not. (input%may_idle(k) .or. is_none(value, default) .or. &
                       (key%applies .and. is_same(value, default)))) then
               call raise(error, shown_key(given, k)//' belongs to '//trim(key%when)// &
                  ': remove it, or set what it belongs to')
               return
            end if
            is_dropped(k) = .true.
         end associate
      end do
      if (any(is_dropped)) call input%set(pack([(k, k=1, given%count)], is_dropped), &
                                          pack(defaults%values(:given%count), is_dropped))
      input%is_given(:given%count) = input%is_given(:given%count) .and. .not. is_dropped
      if (idle /= '') input%case%idle = idle(3:)
   end subroutine drop_idle

   !> Refuse a case where a key of the oil applies and has no value that it may have.
   subroutine check_oil(case, error)
      type(case_t), intent(in) :: case
      type(error_t), allocatable, intent(inout) :: error
      type(key_list_t), save :: given
      type(key_list_t) :: defaults
      integer :: k

      call list_oil_keys(case, given)
      do k = 1, given%count
         associate (key => given%keys(k), value => given%values(k))
            if (key%group /= 'lubricant' .or. .not. key%applies) cycle
            if (is_allowed(key, value)) cycle
            call list_oil_keys(case_t(), defaults)
            if (is_none(value, defaults%values(k))) then
               call raise(error, '&'//trim(key%group)//' '//trim(key%name)//' is missing: '//trim(key%when)// &
                  ' needs it')
            else
               call raise(error, shown_key(given, k)//' is out of range: write a value '//bounds_text(key))
            end if
            return
         end associate
      end do
   end subroutine check_oil

   !> '&group name = value'.
   function shown_key(list, k) result(text)
      type(key_list_t), intent(in) :: list
      integer, intent(in) :: k
      character(len=:), allocatable :: text
      text = '&'//trim(list%keys(k)%group)//' '//trim(list%keys(k)%name)//' = '//value_text(list%values(k), 15)
   end function shown_key

end module ehlwave_key_applicability
