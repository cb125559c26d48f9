!> Wall clock, time stamps, rest and peak memory of the process.
module ehlwave_clock
   use, intrinsic :: iso_c_binding, only: c_int
   use ehlwave_kinds, only: dp, i8
   implicit none (type, external)
   private
   public :: wall_seconds, time_stamp, rest_for, peak_memory_mib

   interface
      integer(c_int) function usleep(microseconds) bind(c)
         import :: c_int
         implicit none (type, external)
         integer(c_int), value :: microseconds
      end function usleep
   end interface

contains

   !> Seconds since an arbitrary origin; differences are elapsed wall time.
   function wall_seconds() result(seconds)
      real(dp) :: seconds
      integer(i8) :: count, rate
      call system_clock(count, rate)
      seconds = real(count, dp)/real(rate, dp)
   end function wall_seconds

   !> Local date and time as ISO 8601 with offset, e.g. 2024-05-31T14:03:09+0200.
   function time_stamp() result(stamp)
      character(len=24) :: stamp
      character(len=8) :: date
      character(len=10) :: time
      character(len=5) :: zone
      call date_and_time(date, time, zone)
      stamp = date(1:4)//'-'//date(5:6)//'-'//date(7:8)//'T'//time(1:2)//':'//time(3:4)//':'//time(5:6)//zone
   end function time_stamp

   !> Leave the processor to others; a signal ends it early.
   subroutine rest_for(seconds)
      real(dp), intent(in) :: seconds   !! at most 1
      integer :: status
      status = usleep(nint(1e6_dp*max(0.0_dp, seconds)))
   end subroutine rest_for

   !> Largest resident memory of this process so far, MiB; 0 where the system does not report it.
   function peak_memory_mib() result(mib)
      real(dp) :: mib
      character(len=128) :: line
      integer :: unit, io
      real(dp) :: kib

      mib = 0
      open (newunit=unit, file='/proc/self/status', status='old', action='read', iostat=io)
      if (io /= 0) return
      do
         read (unit, '(a)', iostat=io) line
         if (io /= 0) exit
         if (line(1:6) == 'VmHWM:') then
            read (line(7:), *, iostat=io) kib
            if (io == 0) mib = kib/1024
            exit
         end if
      end do
      close (unit)
   end function peak_memory_mib

end module ehlwave_clock
