!> A key of an input: its description, and its value of any kind.
module ehlwave_case_key
   use ehlwave_kinds, only: dp
   use ehlwave_text, only: to_text
   implicit none (type, external)
   private
   public :: is_same, key_long_name, value_text, words_of

   integer, parameter, public :: number_kind = 1, whole_kind = 2, truth_kind = 3, word_kind = 4
   integer, parameter, public :: most_keys = 128     !! most keys of a table
   integer, parameter, public :: key_length = 32     !! longest name
   integer, parameter, public :: choice_length = 20  !! longest choice, e.g. 'equation_of_motion'

   !> An entry of a table of keys, with its defaults.
   type, public :: key_t
      character(len=key_length) :: name = ''
      character(len=512) :: help = ''                !! one line; its long name ends at the first ':' or ';'
      character(len=8) :: unit = '1'
      real(dp) :: above = -huge(1.0_dp)              !! not allowed itself
      real(dp) :: minimum = -huge(1.0_dp), maximum = huge(1.0_dp)   !! allowed themselves
      character(len=80) :: choices = ''              !! choices of a word, separated by blanks; none: any text
      logical :: is_required = .false.               !! has no default
      character(len=64) :: default = ''              !! default in the reference where it is not a value
      logical :: applies = .true.                    !! to the case at hand: refused where it is given and does not
      logical :: counts = .true.                     !! has an effect in the present case: without one any other value
                                                     !! than the default is refused; it is written all the same
      logical :: is_effort = .false.  !! a setting of the solution: the plan reports that it has no effect,
                                                     !! in place of a refusal
      character(len=160) :: when = ''                !! condition as text: 'belongs to ...'
      logical :: is_written = .true.                 !! in the effective input of the case at hand, if it applies
      logical :: is_late = .false.                   !! added after stores were made: written where it is not the
                                                     !! default
      logical :: can_vary = .true.                   !! in a sweep
      character(len=key_length) :: file = ''         !! for a key that names a file to be read: its name in results
      character(len=key_length) :: short = ''        !! short name that its group accepts as well, where the group
                                                     !! implies the rest
      ! filled in by the list
      integer :: kind = 0
      character(len=choice_length) :: group = ''
      character(len=256) :: group_help = ''
   end type key_t

   !> Value of a key of any kind.
   type, public :: key_value_t
      integer :: kind = 0
      real(dp) :: number = 0                         !! value of all kinds but words; true is 1, false 0
      character(len=:), allocatable :: word
   end type key_value_t

contains

   !> A value as a namelist takes it.
   pure function value_text(value, digits) result(text)
      type(key_value_t), intent(in) :: value
      integer, intent(in), optional :: digits   !! digits of a number; without: lossless
      character(len=:), allocatable :: text
      integer :: i

      select case (value%kind)
      case (number_kind)
         text = to_text(value%number, digits)
      case (whole_kind)
         text = to_text(nint(value%number))
      case (truth_kind)
         text = '.'//to_text(value%number > 0)//'.'
      case default
         text = "'"
         do i = 1, len(value%word)
            text = text//repeat(value%word(i:i), merge(2, 1, value%word(i:i) == "'"))
         end do
         text = text//"'"
      end select
   end function value_text

   !> Whether two values of a key are the same.
   elemental logical function is_same(a, b)
      type(key_value_t), intent(in) :: a, b
      is_same = abs(a%number - b%number) <= 0
      if (a%kind == word_kind) is_same = a%word == b%word
   end function is_same

   !> The help up to its first ';' or ':'.
   pure function key_long_name(key) result(name)
      type(key_t), intent(in) :: key
      character(len=:), allocatable :: name
      name = trim(key%help(:scan(trim(key%help)//';', ';:') - 1))
   end function key_long_name

   !> The words of a list of choices, separated by single blanks.
   pure function words_of(list) result(words)
      character(len=*), intent(in) :: list
      character(len=choice_length), allocatable :: words(:)
      integer :: first, i, last

      allocate (words(merge(1 + count([(list(i:i) == ' ', i=1, len_trim(list))]), 0, list /= '')))
      first = 1
      do i = 1, size(words)
         first = first + verify(list(first:), ' ') - 1
         last = first + scan(list(first:)//' ', ' ') - 2
         words(i) = list(first:last)
         first = last + 1
      end do
   end function words_of

end module ehlwave_case_key
