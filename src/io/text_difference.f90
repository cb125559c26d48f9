!> A text told by the lines in which it differs from another one.
module ehlwave_text_difference
   use ehlwave_text, only: to_text
   implicit none (type, external)
   private
   public :: text_difference, text_from_difference

   character(len=*), parameter :: line_end = new_line('a')

contains

   !> Lines of `text` that differ from those of `base`, as NUMBER:LINE; all of it, after a `=`, when the two have
   !> not the same number of lines.
   pure function text_difference(base, text) result(difference)
      character(len=*), intent(in) :: base, text   !! every line ended
      character(len=:), allocatable :: difference
      integer :: a, b, a_end, b_end, number

      difference = ''
      a = 1
      b = 1
      number = 0
      do while (a <= len(base) .and. b <= len(text))
         a_end = a + index(base(a:), line_end) - 1
         b_end = b + index(text(b:), line_end) - 1
         if (a_end < a .or. b_end < b) exit
         number = number + 1
         if (base(a:a_end) /= text(b:b_end)) difference = difference//to_text(number)//':'//text(b:b_end)
         a = a_end + 1
         b = b_end + 1
      end do
      if (a <= len(base) .or. b <= len(text)) difference = '='//text
   end function text_difference

   !> The text again.
   function text_from_difference(base, difference) result(text)
      character(len=*), intent(in) :: base, difference
      character(len=:), allocatable :: text
      integer :: a, a_end, colon, d, d_end, io, number, wanted

      text = ''
      if (len(difference) > 0) then
         if (difference(1:1) == '=') then
            text = difference(2:)
            return
         end if
      end if
      a = 1
      d = 1
      number = 0
      call next_difference()
      do while (a <= len(base))
         a_end = a + index(base(a:), line_end) - 1
         if (a_end < a) exit
         number = number + 1
         if (number == wanted) then
            text = text//difference(colon + 1:d_end)
            d = d_end + 1
            call next_difference()
         else
            text = text//base(a:a_end)
         end if
         a = a_end + 1
      end do

   contains

      subroutine next_difference()
         wanted = 0
         if (d > len(difference)) return
         colon = d + index(difference(d:), ':') - 1
         d_end = d + index(difference(d:), line_end) - 1
         if (colon <= d .or. d_end < colon) return
         read (difference(d:colon - 1), *, iostat=io) wanted
         if (io /= 0) wanted = 0
      end subroutine next_difference

   end function text_from_difference

end module ehlwave_text_difference
