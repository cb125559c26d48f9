!> Times as a user writes them.
module ehlwave_time_text
   use ehlwave_errors, only: error_t, raise
   use ehlwave_kinds, only: dp
   implicit none (type, external)
   private
   public :: read_time

contains

   !> Seconds from SECONDS, M:SS, H:MM:SS or D-HH:MM:SS. Fails on anything else and on 0.
   subroutine read_time(text, what, seconds, error)
      character(len=*), intent(in) :: text
      character(len=*), intent(in) :: what       !! option, for the message
      real(dp), intent(out) :: seconds
      type(error_t), allocatable, intent(inout) :: error
      integer :: colon, dash, first, io, parts
      real(dp) :: number

      seconds = 0
      io = 0
      if (verify(text, '0123456789:-.') > 0 .or. len(text) == 0) io = 1
      dash = index(text, '-')
      if (dash > 0 .and. io == 0) then
         read (text(:dash - 1), *, iostat=io) number
         if (io == 0) seconds = number*24
      end if
      first = dash + 1
      parts = 0
      do while (io == 0)
         colon = index(text(first:), ':')
         if (colon == 0) colon = len(text) - first + 2
         read (text(first:first + colon - 2), *, iostat=io) number
         if (io == 0) then
            seconds = merge(seconds + number, 60*seconds + number, parts == 0)
            parts = parts + 1
         end if
         first = first + colon
         if (first > len(text) + 1) exit
      end do
      if (parts > 3 .or. (dash > 0 .and. parts /= 3)) io = 1
      if (io /= 0 .or. .not. seconds > 0) &
         call raise(error, what//' '//text//': give a time as SECONDS, M:SS, H:MM:SS or D-HH:MM:SS')
   end subroutine read_time

end module ehlwave_time_text
