!> Words, texts in quotes and punctuation of a file in namelist format, one after the other.
module ehlwave_namelist_tokens
   use ehlwave_errors, only: error_t, raise
   use ehlwave_text, only: to_text
   implicit none (type, external)
   private
   public :: token_t, cursor_t, line_prefix

   character(len=1), parameter, public :: end_of_text = achar(0), word = 'w', quoted = 'q'   !! kinds of token

   character(len=1), parameter :: lf = achar(10), cr = achar(13)
   character(len=*), parameter :: blanks = ' '//achar(9)//lf//cr
   character(len=*), parameter :: quotes = '''"'

   type :: token_t
      character(len=1) :: kind = end_of_text      !! `word`, `quoted`, `end_of_text` or one of & / , = (
      character(len=:), allocatable :: text       !! as written, without quotes
      integer :: line = 0
      logical :: is_attached = .false.            !! no blank between this token and the previous one
   end type token_t

   !> A place in a text, and the first error in the text. Later tokens have no meaning, so a single check at the end
   !> is enough.
   type :: cursor_t
      character(len=:), allocatable :: path       !! for messages
      character(len=:), allocatable :: text
      integer :: at = 1, line = 1
      type(error_t), allocatable :: error
   contains
      procedure :: take
      procedure :: fail
      procedure, private :: next
      procedure, private :: advance
      procedure, private :: skip_blanks
      procedure, private :: take_word
      procedure, private :: take_quoted
   end type cursor_t

contains

   !> `FILE:LINE: `, with which every message about a place begins.
   pure function line_prefix(path, line) result(prefix)
      character(len=*), intent(in) :: path
      integer, intent(in) :: line
      character(len=:), allocatable :: prefix
      prefix = trim(path)//':'//to_text(line)//': '
   end function line_prefix

   !> Take the next token; comments, blanks and a byte order mark are passed over.
   subroutine take(self, token)
      class(cursor_t), intent(inout) :: self
      type(token_t), intent(out) :: token
      integer :: first

      if (self%at == 1) then
         if (index(self%text, char(239)//char(187)//char(191)) == 1) self%at = 4
      end if
      first = self%at
      call self%skip_blanks()
      token%line = self%line
      token%is_attached = self%at == first
      token%kind = self%next()
      select case (token%kind)
      case (end_of_text)
         token%text = 'the end of the file'
      case ('&', '/', ',', '=', '(')
         token%text = token%kind
         call self%advance()
      case ('''', '"')
         token%kind = quoted
         call self%take_quoted(token%text)
      case default
         token%kind = word
         call self%take_word(token%text)
      end select
   end subroutine take

   !> Raise an error about a line, unless there is one already.
   subroutine fail(self, line, message)
      class(cursor_t), intent(inout) :: self
      integer, intent(in) :: line
      character(len=*), intent(in) :: message
      if (.not. allocated(self%error)) call raise(self%error, line_prefix(self%path, line)//message)
   end subroutine fail

   !> Characters up to a separator.
   subroutine take_word(self, text)
      class(cursor_t), intent(inout) :: self
      character(len=:), allocatable, intent(out) :: text
      integer :: first

      first = self%at
      do while (self%next() /= end_of_text .and. scan(self%next(), blanks//quotes//',/=!(') == 0)
         if (iachar(self%next()) < 32 .or. iachar(self%next()) > 126) then
            call self%fail(self%line, 'a character that is not plain ASCII stands outside quotes and '// &
                           'comments: retype it (often a pasted quote, dash or blank)')
            exit
         end if
         call self%advance()
      end do
      text = self%text(first:self%at - 1)
   end subroutine take_word

   !> Text between quotes; a doubled quote gives a single quote.
   subroutine take_quoted(self, text)
      class(cursor_t), intent(inout) :: self
      character(len=:), allocatable, intent(out) :: text
      character(len=:), allocatable :: line
      character(len=1) :: mark
      integer :: length

      mark = self%next()
      call self%advance()
      text = ''
      line = repeat(' ', 64)
      length = 0
      do while (scan(self%next(), end_of_text//lf//cr) == 0)
         if (self%next() == mark) then
            call self%advance()
            if (self%next() /= mark) then
               text = line(:length)
               return
            end if                                 ! keep one of two quotes
         end if
         if (length == len(line)) line = line//line   ! room for as many again
         length = length + 1
         line(length:length) = self%next()
         call self%advance()
      end do
      call self%fail(self%line, 'quote without its partner: close the text with '//mark//' on the line where it begins')
   end subroutine take_quoted

   !> Pass blanks, line ends and comments.
   subroutine skip_blanks(self)
      class(cursor_t), intent(inout) :: self
      logical :: is_comment

      is_comment = .false.
      do while (self%next() /= end_of_text)
         if (scan(self%next(), lf//cr) > 0) then
            is_comment = .false.
         else if (self%next() == '!') then
            is_comment = .true.
         end if
         if (.not. is_comment .and. scan(self%next(), blanks) == 0) exit
         call self%advance()
      end do
   end subroutine skip_blanks

   !> The character at the current place.
   pure function next(self) result(c)
      class(cursor_t), intent(in) :: self
      character(len=1) :: c
      c = end_of_text
      if (self%at <= len(self%text)) c = self%text(self%at:self%at)
   end function next

   !> Pass one character; CR LF, LF and CR each end a line once.
   subroutine advance(self)
      class(cursor_t), intent(inout) :: self
      character(len=1) :: passed

      passed = self%next()
      self%at = self%at + 1
      if (passed == lf .or. (passed == cr .and. self%next() /= lf)) self%line = self%line + 1
   end subroutine advance

end module ehlwave_namelist_tokens
