!> Small conversions between numbers and text.
module ehlwave_text
   use ehlwave_kinds, only: dp, i8
   implicit none (type, external)
   private
   public :: to_text, lower_case

   !> Number or logical as trimmed text; reals with `digits` significant digits (default: 17, lossless).
   interface to_text
      module procedure :: integer_text, long_text, real_text, logical_text
   end interface to_text

contains

   pure function integer_text(value) result(text)
      integer, intent(in) :: value
      character(len=:), allocatable :: text
      text = long_text(int(value, i8))
   end function integer_text

   pure function long_text(value) result(text)
      integer(i8), intent(in) :: value
      character(len=:), allocatable :: text
      character(len=24) :: buffer
      write (buffer, '(i0)') value
      text = trim(buffer)
   end function long_text

   !> Shortest of fixed and exponential notation with the asked number of significant digits.
   pure function real_text(value, digits) result(text)
      real(dp), intent(in) :: value
      integer, intent(in), optional :: digits
      character(len=:), allocatable :: text
      character(len=40) :: buffer, form
      integer :: n, e, last

      n = 17
      if (present(digits)) n = digits
      write (form, '(a,i0,a,i0,a)') '(es', n + 9, '.', n - 1, 'e3)'
      write (buffer, form) value
      buffer = adjustl(buffer)
      e = index(buffer, 'E')
      if (e == 0) then                       ! NaN or infinity
         text = trim(buffer)
         return
      end if
      block
         integer :: exponent
         read (buffer(e + 1:), *) exponent
         if (exponent >= -4 .and. exponent < n) then
            write (form, '(a,i0,a)') '(f40.', max(0, n - 1 - exponent), ')'
            write (buffer, form) value
            buffer = adjustl(buffer)
            last = len_trim(buffer)
            if (index(buffer, '.') > 0) then
               do while (buffer(last:last) == '0')
                  last = last - 1
               end do
               if (buffer(last:last) == '.') last = last - 1
            end if
            text = buffer(:last)
            if (text(1:1) == '.') text = '0'//text
            if (len(text) > 1) then
               if (text(1:2) == '-.') text = '-0'//text(2:)
            end if
            return
         end if
      end block
      last = e - 1
      do while (buffer(last:last) == '0')
         last = last - 1
      end do
      if (buffer(last:last) == '.') last = last - 1
      block
         integer :: exponent
         read (buffer(e + 1:), *) exponent
         text = buffer(:last)//'e'//integer_text(exponent)
      end block
   end function real_text

   pure function logical_text(value) result(text)
      logical, intent(in) :: value
      character(len=:), allocatable :: text
      text = merge('true ', 'false', value)
      text = trim(text)
   end function logical_text

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

end module ehlwave_text
