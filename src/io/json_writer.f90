!> Values as JSON.
module ehlwave_json
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ehlwave_kinds, only: dp
   use ehlwave_text, only: fewest_digits, to_text
   implicit none (type, external)
   private
   public :: list_json, real_json, string_json

contains

   !> A list of real numbers; NaN and infinities become null.
   pure function list_json(values) result(text)
      real(dp), intent(in) :: values(:)
      character(len=:), allocatable :: text
      integer :: i
      text = ''
      do i = 1, size(values)
         text = text//', '//real_json(values(i))
      end do
      text = '['//text(3:)//']'
   end function list_json

   !> The fewest digits that read back as the same number; of NaN and infinities null.
   pure function real_json(value) result(text)
      real(dp), intent(in) :: value
      character(len=:), allocatable :: text

      text = 'null'
      if (ieee_is_finite(value)) text = to_text(value, fewest_digits)
   end function real_json

   !> Text in double quotes; control characters are escaped, bytes that are not UTF-8 become U+FFFD.
   pure function string_json(text) result(json)
      character(len=*), intent(in) :: text
      character(len=:), allocatable :: json
      character(len=*), parameter :: hex = '0123456789abcdef'
      character(len=:), allocatable :: buffer
      character(len=6) :: piece
      integer :: i, n, code, bytes, width

      allocate (character(len=6*len(text)) :: buffer)   ! not on the stack: texts may be whole files
      do i = 1, len(text)                              ! most texts are plain
         code = iachar(text(i:i))
         if (code < 32 .or. code > 126 .or. code == 34 .or. code == 92) exit
      end do
      n = i - 1
      buffer(:n) = text(:n)
      do while (i <= len(text))
         code = iachar(text(i:i))
         bytes = 1
         select case (code)
         case (34); piece = '\"'
         case (92); piece = '\\'
         case (8); piece = '\b'
         case (9); piece = '\t'
         case (10); piece = '\n'
         case (12); piece = '\f'
         case (13); piece = '\r'
         case (0:7, 11, 14:31, 127)
            piece = '\u00'//hex(code/16 + 1:code/16 + 1)//hex(mod(code, 16) + 1:mod(code, 16) + 1)
         case (32:33, 35:91, 93:126); piece = text(i:i)
         case default
            bytes = utf8_bytes(text(i:))
            piece = '\ufffd'
            if (bytes > 0) piece = text(i:i + bytes - 1)
            bytes = max(1, bytes)
         end select
         width = max(1, len_trim(piece))              ! 1 for a blank
         buffer(n + 1:n + width) = piece
         n = n + width
         i = i + bytes
      end do
      json = '"'//buffer(:n)//'"'
   end function string_json

   !> Bytes of the UTF-8 character, beyond ASCII, at the start of `text`; 0 for invalid bytes (RFC 3629).
   pure function utf8_bytes(text) result(bytes)
      character(len=*), intent(in) :: text
      integer :: bytes
      integer :: lead, second, i, low, high

      lead = iachar(text(1:1))
      low = 128
      high = 191
      select case (lead)
      case (194:223); bytes = 2
      case (224); bytes = 3; low = 160        ! no overlong forms
      case (225:236, 238:239); bytes = 3
      case (237); bytes = 3; high = 159       ! no surrogates
      case (240); bytes = 4; low = 144
      case (241:243); bytes = 4
      case (244); bytes = 4; high = 143       ! up to U+10FFFF
      case default; bytes = 0
      end select
      if (bytes == 0) return
      if (len(text) < bytes) then
         bytes = 0
         return
      end if
      second = iachar(text(2:2))
      if (second < low .or. second > high) bytes = 0
      do i = 3, bytes
         if (iachar(text(i:i)) < 128 .or. iachar(text(i:i)) > 191) then
            bytes = 0
            return
         end if
      end do
   end function utf8_bytes

end module ehlwave_json
