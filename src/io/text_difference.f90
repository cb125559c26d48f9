!> A text stored as the lines in which it differs from another text.
module ehlwave_text_difference
   use ehlwave_text, only: next_line, to_text
   implicit none (type, external)
   private
   public :: text_difference, text_from_difference

   character(len=*), parameter :: line_end = new_line('a')

contains

   !> Lines of `text` that differ from lines of `base`, as NUMBER:LINE; all of it, after a `=`, when the numbers of
   !> lines differ.
   function text_difference(base, text) result(difference)
      character(len=*), intent(in) :: base, text   !! every line ended
      character(len=:), allocatable :: difference
      integer :: a, a_end, b, b_end, number
      logical :: has_a, has_b

      difference = ''
      a_end = -1
      b_end = -1
      number = 0
      do
         has_a = next_line(base, a, a_end)
         has_b = next_line(text, b, b_end)
         if (.not. (has_a .and. has_b)) exit
         number = number + 1
         if (a_end - a /= b_end - b .or. base(a:a_end) /= text(b:b_end)) &
            difference = difference//to_text(number)//':'//text(b:b_end)//line_end
      end do
      if (has_a .or. has_b) difference = '='//text
   end function text_difference

   !> The text again.
   function text_from_difference(base, difference) result(text)
      character(len=*), intent(in) :: base, difference
      character(len=:), allocatable :: text
      character(len=:), allocatable :: buffer
      integer :: a, a_end, colon, d, d_end, io, n, number, start, wanted

      if (index(difference, '=') == 1) then
         text = difference(2:)
         return
      end if
      allocate (character(len=len(base) + len(difference)) :: buffer)
      n = 0
      start = 1                                  ! of the part of the base that is not copied yet
      a_end = -1
      d_end = -1
      number = 0
      call find_next_difference()
      do while (next_line(base, a, a_end))
         number = number + 1
         if (number /= wanted) cycle
         call append(base(start:a - 1))
         call append(difference(colon + 1:d_end)//line_end)
         start = a_end + 2
         call find_next_difference()
         if (wanted == 0) exit
      end do
      call append(base(start:))
      text = buffer(:n)

   contains

      subroutine append(piece)
         character(len=*), intent(in) :: piece
         buffer(n + 1:n + len(piece)) = piece
         n = n + len(piece)
      end subroutine append

      subroutine find_next_difference()
         wanted = 0
         if (.not. next_line(difference, d, d_end)) return
         colon = d + index(difference(d:d_end), ':') - 1
         read (difference(d:colon - 1), *, iostat=io) wanted
         if (io /= 0) wanted = 0
      end subroutine find_next_difference

   end function text_from_difference

end module ehlwave_text_difference
