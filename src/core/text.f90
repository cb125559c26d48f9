!> Small conversions between numbers and text.
module ehlwave_text
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use, intrinsic :: iso_c_binding, only: c_char, c_double, c_int
   use ehlwave_kinds, only: dp, i8
   implicit none (type, external)
   private
   public :: count_lines, harmless, lower_case, next_line, number_of, put, shown, to_text

   integer, parameter :: most_shown = 60   ! characters of a text from outside that a message repeats
   integer, parameter, public :: fewest_digits = 0   !! the fewest of 15 to 17 that read back as the same number

   !> Number or logical as trimmed text; reals with `digits` significant digits (default: 17, lossless).
   interface to_text
      module procedure :: integer_text, long_text, real_text, logical_text
   end interface to_text

   interface
      pure subroutine number_text(value, digits, text, length) bind(c, name='ehlwave_number_text')
         import :: c_char, c_double, c_int
         implicit none (type, external)
         real(c_double), value :: value
         integer(c_int), value :: digits
         character(kind=c_char), intent(inout) :: text(*)
         integer(c_int), intent(out) :: length
      end subroutine number_text
   end interface

contains

   pure function integer_text(value) result(text)
      integer, intent(in) :: value
      character(len=:), allocatable :: text
      text = long_text(int(value, i8))
   end function integer_text

   pure function long_text(value) result(text)
      integer(i8), intent(in) :: value
      character(len=:), allocatable :: text
      character(len=20) :: figures
      integer(i8) :: rest
      integer :: first
      rest = value
      if (rest > 0) rest = -rest                ! negative numbers go farther
      do first = len(figures), 2, -1
         figures(first:first) = achar(iachar('0') - int(mod(rest, 10_i8)))
         rest = rest/10
         if (rest == 0) exit
      end do
      if (value < 0) then
         first = first - 1
         figures(first:first) = '-'
      end if
      text = figures(first:)
   end function long_text

   !> A number of things: '1 case', '12 cases'.
   pure function number_of(value, thing) result(text)
      integer, intent(in) :: value
      character(len=*), intent(in) :: thing
      character(len=:), allocatable :: text
      text = integer_text(value)//' '//thing
      if (value /= 1) text = text//'s'
   end function number_of

   !> Shortest of fixed and exponential notation with the asked number of significant digits.
   pure function real_text(value, digits) result(text)
      real(dp), intent(in) :: value
      integer, intent(in), optional :: digits
      character(len=:), allocatable :: text
      character(len=50) :: buffer
      integer :: length, n

      if (.not. ieee_is_finite(value)) then
         write (buffer, '(es26.16e3)') value
         text = trim(adjustl(buffer))
         return
      end if
      n = 17
      if (present(digits)) n = digits
      call number_text(value, n, buffer, length)
      text = buffer(:length)
   end function real_text

   pure function logical_text(value) result(text)
      logical, intent(in) :: value
      character(len=:), allocatable :: text
      text = merge('true ', 'false', value)
      text = trim(text)
   end function logical_text

   !> Append to text(:used). The rest of the text is room for more, so that many pieces are not copied again and again.
   pure subroutine put(text, used, piece)
      character(len=:), allocatable, intent(inout) :: text
      integer, intent(inout) :: used
      character(len=*), intent(in) :: piece
      character(len=:), allocatable :: more
      if (used + len(piece) > len(text)) then
         allocate (character(len=2*(used + len(piece))) :: more)
         more(:used) = text(:used)
         call move_alloc(more, text)
      end if
      text(used + 1:used + len(piece)) = piece
      used = used + len(piece)
   end subroutine put

   !> Whether a text has one more line, which is text(first:last) without its end. Begin with last = -1.
   logical function next_line(text, first, last)
      character(len=*), intent(in) :: text
      integer, intent(out) :: first
      integer, intent(inout) :: last
      first = last + 2
      next_line = first <= len(text)
      if (.not. next_line) return
      last = first + index(text(first:), new_line('a')) - 2
      if (last < first - 1) last = len(text)
   end function next_line

   !> Number of lines, the last line with or without its end.
   pure integer function count_lines(text)
      character(len=*), intent(in) :: text
      integer :: i
      count_lines = 1
      do i = 1, len(text)
         if (text(i:i) == new_line('a')) count_lines = count_lines + 1
      end do
   end function count_lines

   !> Copy of `text` in lower case.
   elemental function lower_case(text) result(lower)
      character(len=*), intent(in) :: text
      character(len=len(text)) :: lower
      integer :: i, code
      do i = 1, len(text)
         code = iachar(text(i:i))
         if (code >= iachar('A') .and. code <= iachar('Z')) code = code + 32
         lower(i:i) = achar(code)
      end do
   end function lower_case

   !> A text from outside as a message may repeat it: short, and without bytes that a terminal would obey.
   pure function shown(text, most) result(clean)
      character(len=*), intent(in) :: text
      integer, intent(in), optional :: most   !! characters, in place of the usual number
      character(len=:), allocatable :: clean
      integer :: n
      n = most_shown
      if (present(most)) n = most
      clean = harmless(text(:min(len(text), n)))
      if (len(text) > n) clean = clean//'...'
   end function shown

   !> A text without bytes that a terminal would obey, or that are no letters of UTF-8: each is a question mark.
   pure function harmless(text) result(clean)
      character(len=*), intent(in) :: text
      character(len=len(text)) :: clean
      integer :: i, length
      clean = text
      i = 1
      do while (i <= len(clean))
         length = letter_length(clean(i:))
         if (length == 0) clean(i:i) = '?'
         i = i + max(1, length)
      end do
   end function harmless

   !> Bytes of the letter, in ASCII or UTF-8, that a text begins with; 0: a control character, or none.
   pure integer function letter_length(text) result(length)
      character(len=*), intent(in) :: text   !! not empty
      integer :: code, i
      code = iachar(text(1:1))
      select case (code)
      case (32:126); length = 1
      case (194:223); length = 2
      case (224:239); length = 3
      case (240:244); length = 4
      case default; length = 0
      end select
      if (length > len(text)) length = 0
      do i = 2, length
         if (iand(iachar(text(i:i)), 192) /= 128) length = 0
      end do
      if (code == 194 .and. length == 2) then
         if (iachar(text(2:2)) < 160) length = 0   ! a control character above 127
      end if
   end function letter_length

end module ehlwave_text
