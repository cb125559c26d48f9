!> Builds one JSON object on one line, for log and provenance records.
module ehlwave_json
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ehlwave_kinds, only: dp, i8
   use ehlwave_text, only: to_text
   implicit none (type, external)
   private
   public :: json_t

   !> Members in the order in which they are added; the caller gives each name once.
   type :: json_t
      character(len=:), allocatable, private :: members   !! text between the braces
      character(len=:), allocatable, private :: columns   ! ["name", "kind"] of each
      character(len=:), allocatable, private :: values    ! their values alone
   contains
      generic :: add => add_real, add_integer, add_long, add_logical, add_character
      procedure :: add_list
      procedure :: add_object
      procedure :: to_string
      procedure :: column_list
      procedure :: value_list
      procedure, private :: add_real, add_integer, add_long, add_logical, add_character, add_member
   end type json_t

contains

   !> The object as text: ASCII and UTF-8, no line ends.
   pure function to_string(self) result(text)
      class(json_t), intent(in) :: self
      character(len=:), allocatable :: text
      text = '{}'
      if (allocated(self%members)) text = '{'//self%members//'}'
   end function to_string

   !> Names and kinds (real, integer, logical, text, list, object) of the members: [["name","kind"],...]
   pure function column_list(self) result(text)
      class(json_t), intent(in) :: self
      character(len=:), allocatable :: text
      text = '[]'
      if (allocated(self%columns)) text = '['//self%columns//']'
   end function column_list

   !> The values of the members alone, in the order of `column_list`.
   pure function value_list(self) result(text)
      class(json_t), intent(in) :: self
      character(len=:), allocatable :: text
      text = '[]'
      if (allocated(self%values)) text = '['//self%values//']'
   end function value_list

   pure subroutine add_real(self, name, value)
      class(json_t), intent(inout) :: self
      character(len=*), intent(in) :: name
      real(dp), intent(in) :: value               !! NaN and infinities become null
      call self%add_member('real', name, real_json(value))
   end subroutine add_real

   pure subroutine add_integer(self, name, value)
      class(json_t), intent(inout) :: self
      character(len=*), intent(in) :: name
      integer, intent(in) :: value
      call self%add_member('integer', name, to_text(value))
   end subroutine add_integer

   pure subroutine add_long(self, name, value)
      class(json_t), intent(inout) :: self
      character(len=*), intent(in) :: name
      integer(i8), intent(in) :: value
      call self%add_member('integer', name, to_text(value))
   end subroutine add_long

   pure subroutine add_logical(self, name, value)
      class(json_t), intent(inout) :: self
      character(len=*), intent(in) :: name
      logical, intent(in) :: value
      call self%add_member('logical', name, to_text(value))
   end subroutine add_logical

   pure subroutine add_character(self, name, value)
      class(json_t), intent(inout) :: self
      character(len=*), intent(in) :: name
      character(len=*), intent(in) :: value       !! kept with its trailing blanks
      call self%add_member('text', name, string_json(value))
   end subroutine add_character

   pure subroutine add_list(self, name, values)
      class(json_t), intent(inout) :: self
      character(len=*), intent(in) :: name
      real(dp), intent(in) :: values(:)           !! NaN and infinities become null
      character(len=:), allocatable :: list
      integer :: i

      list = ''
      do i = 1, size(values)
         list = list//', '//real_json(values(i))
      end do
      call self%add_member('list', name, '['//list(3:)//']')
   end subroutine add_list

   pure subroutine add_object(self, name, value)
      class(json_t), intent(inout) :: self
      character(len=*), intent(in) :: name
      type(json_t), intent(in) :: value
      call self%add_member('object', name, value%to_string())
   end subroutine add_object

   pure subroutine add_member(self, kind, name, value)
      class(json_t), intent(inout) :: self
      character(len=*), intent(in) :: kind, name
      character(len=*), intent(in) :: value       !! as JSON
      character(len=:), allocatable :: quoted

      quoted = string_json(name)
      if (allocated(self%members)) then
         self%members = self%members//', '//quoted//': '//value
         self%columns = self%columns//',['//quoted//',"'//kind//'"]'
         self%values = self%values//','//value
      else
         self%members = quoted//': '//value
         self%columns = '['//quoted//',"'//kind//'"]'
         self%values = value
      end if
   end subroutine add_member

   !> The shortest of 15, 16 and 17 significant digits that reads back as the same number.
   pure function real_json(value) result(text)
      real(dp), intent(in) :: value
      character(len=:), allocatable :: text
      character(len=:), allocatable :: short
      real(dp) :: back
      integer :: digits

      text = 'null'
      if (.not. ieee_is_finite(value)) return
      text = to_text(value)
      if (abs(value) < 1e-300_dp .or. abs(value) > 1e300_dp) return   ! rounded, it could under- or overflow
      do digits = 15, 16
         short = to_text(value, digits)
         read (short, *) back
         if (transfer(back, 0_i8) == transfer(value, 0_i8)) then
            text = short
            return
         end if
      end do
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
      n = 0
      i = 1
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

   !> Bytes of the UTF-8 character, beyond ASCII, at the start of `text`; 0 when it is not one (RFC 3629).
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
