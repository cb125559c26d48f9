!> Allowed values of a key: a common check of kind, bounds and choices for namelists, lists and tables.
module ehlwave_key_bounds
   use ehlwave_case_key, only: choice_length, key_t, key_value_t, number_kind, truth_kind, whole_kind, word_kind, &
      words_of
   use ehlwave_kinds, only: dp
   use ehlwave_namelist_scanner, only: value_t
   use ehlwave_namelist_values, only: read_value
   use ehlwave_spelling, only: nearest_word
   use ehlwave_text, only: lower_case, shown, to_text
   implicit none (type, external)
   private
   public :: bounds_text, is_allowed, is_none, read_key, says_none

contains

   !> Value of a key as written in an input. `problem` is left unallocated when it may be used; otherwise it holds the
   !> problem and the correct form, and `value` is as before.
   subroutine read_key(key, item, value, problem)
      type(key_t), intent(in) :: key
      type(value_t), intent(in) :: item
      type(key_value_t), intent(inout) :: value
      character(len=:), allocatable, intent(out) :: problem
      type(key_value_t) :: candidate
      integer :: whole
      logical :: truth

      candidate%kind = key%kind
      select case (key%kind)
      case (number_kind); call read_value(item, candidate%number, problem)
      case (whole_kind)
         call read_value(item, whole, problem)
         if (.not. allocated(problem)) candidate%number = whole
      case (truth_kind)
         call read_value(item, truth, problem)
         if (.not. allocated(problem)) candidate%number = merge(1, 0, truth)
      case default; call read_value(item, candidate%word, problem)
      end select
      if (.not. allocated(problem) .and. key%choices /= '') candidate%word = lower_case(trim(candidate%word))
      if (.not. allocated(problem) .and. .not. is_allowed(key, candidate)) problem = refusal(key, item, candidate)
      if (.not. allocated(problem)) value = candidate
   end subroutine read_key

   !> Whether a value is inside the bounds of its key, or one of its choices.
   logical function is_allowed(key, value)
      type(key_t), intent(in) :: key
      type(key_value_t), intent(in) :: value

      is_allowed = .true.
      select case (key%kind)
      case (number_kind, whole_kind)
         is_allowed = value%number > key%above .and. value%number >= key%minimum .and. value%number <= key%maximum
      case (word_kind)
         if (key%choices /= '') then
            is_allowed = len(value%word) > 0 .and. scan(value%word, ' ') == 0 .and. &
                         index(' '//key%choices//' ', ' '//value%word//' ') > 0
         else
            is_allowed = len(value%word) >= key%minimum .and. len(value%word) <= key%maximum
         end if
      end select
   end function is_allowed

   !> Whether a value means none: 0, false or '' where this is the default, too.
   pure logical function is_none(value, default)
      type(key_value_t), intent(in) :: value, default
      is_none = max(abs(value%number), abs(default%number)) <= 0
      if (value%kind == word_kind) is_none = len(value%word) == 0 .and. len(default%word) == 0
   end function is_none

   !> Whether a written value means none; for a required key never.
   logical function says_none(key, item, default)
      type(key_t), intent(in) :: key
      type(value_t), intent(in) :: item
      type(key_value_t), intent(in) :: default
      type(key_t) :: unbound
      type(key_value_t) :: value
      character(len=:), allocatable :: problem

      says_none = .false.
      if (key%is_required .or. .not. is_none(default, default)) return
      unbound = key_t(name=key%name, kind=key%kind)
      call read_key(unbound, item, value, problem)
      if (.not. allocated(problem)) says_none = is_none(value, default)
   end function says_none

   !> Why a value of the right kind may not be used.
   function refusal(key, item, value) result(problem)
      type(key_t), intent(in) :: key
      type(value_t), intent(in) :: item
      type(key_value_t), intent(in) :: value
      character(len=:), allocatable :: problem
      character(len=choice_length), allocatable :: words(:)
      integer :: i

      if (key%kind /= word_kind) then
         problem = shown(item%text)//' is out of range: write a value '
         if (key%unit /= '1') problem = problem//'in '//trim(key%unit)//', '
         problem = problem//bounds_text(key)
      else if (key%choices == '') then
         problem = 'text of '//to_text(len(value%word))//' characters: write '
         if (len(value%word) < key%minimum) then
            problem = problem//'at least '//to_text(nint(key%minimum))
         else
            problem = problem//'at most '//to_text(nint(key%maximum))
         end if
      else
         words = words_of(key%choices)
         problem = "'"//shown(value%word)//"' is not one of the choices: write one of "//bounds_text(key)
         i = nearest_word(value%word, words)
         if (i > 0) problem = problem//"; did you mean '"//trim(words(i))//"'?"
      end if
   end function refusal

   !> Bounds or choices of a key for people; '' when there are none.
   function bounds_text(key) result(text)
      type(key_t), intent(in) :: key
      character(len=:), allocatable :: text
      character(len=:), allocatable :: list       ! every part with its link to the previous part
      character(len=choice_length), allocatable :: words(:)
      integer :: i

      list = ''
      if (key%kind == word_kind) then
         words = words_of(key%choices)
         do i = 1, size(words)
            list = list//", '"//trim(words(i))//"'"
         end do
         text = list(min(3, len(list) + 1):)
      else
         if (key%above > -huge(1.0_dp)) list = list//' and above '//to_text(key%above, 15)
         if (key%minimum > -huge(1.0_dp)) list = list//' and at least '//to_text(key%minimum, 15)
         if (key%maximum < huge(1.0_dp)) list = list//' and at most '//to_text(key%maximum, 15)
         text = list(min(6, len(list) + 1):)
      end if
   end function bounds_text

end module ehlwave_key_bounds
