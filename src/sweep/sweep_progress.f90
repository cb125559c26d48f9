!> Counts the cases of a sweep, and prints a line of progress from time to time.
module ehlwave_sweep_progress
   use, intrinsic :: iso_fortran_env, only: output_unit
   use ehlwave_outcome, only: outcome_t
   use ehlwave_clock, only: time_stamp, wall_seconds
   use ehlwave_kinds, only: dp
   use ehlwave_status, only: is_success, last_status, status_name
   use ehlwave_terminal, only: say
   use ehlwave_text, only: to_text
   implicit none (type, external)
   private
   public :: counted, duration

   type, public :: progress_t
      integer :: total = 0                           !! cases of the sweep
      integer :: counts(0:last_status) = 0           !! finished cases by status, earlier runs included
      integer :: ranks = 1
      real(dp) :: seconds = 0                        !! wall time of all finished cases
      real(dp) :: start_s = 0                        !! wall_seconds at the start
      real(dp) :: line_interval_s = 10               !! between progress lines
      real(dp), private :: last_line_s = 0
   contains
      procedure :: done
      procedure :: failed
      procedure :: count_case
      procedure :: finished
      procedure :: tick
   end type progress_t

contains

   !> Finished cases, whatever their status.
   pure integer function done(self)
      class(progress_t), intent(in) :: self
      done = sum(self%counts)
   end function done

   !> Finished cases that did not converge.
   pure integer function failed(self)
      class(progress_t), intent(in) :: self
      integer :: status
      failed = sum(self%counts, mask=.not. is_success([(status, status=0, last_status)]))
   end function failed

   !> Count a case without a word.
   subroutine count_case(self, status, seconds)
      class(progress_t), intent(inout) :: self
      integer, intent(in) :: status
      real(dp), intent(in) :: seconds
      self%counts(status) = self%counts(status) + 1
      self%seconds = self%seconds + seconds
   end subroutine count_case

   !> Count a case of this run; failures are reported at once.
   subroutine finished(self, outcome)
      class(progress_t), intent(inout) :: self
      type(outcome_t), intent(in) :: outcome
      call self%count_case(outcome%status, outcome%seconds)
      if (.not. is_success(outcome%status)) call say(output_unit, time_stamp()//' case '//to_text(outcome%case)//' '// &
         status_name(outcome%status)//': '//trim(outcome%message))
   end subroutine finished

   !> Print a line when due. Negative `seconds_left`: unknown.
   subroutine tick(self, seconds_left, is_last)
      class(progress_t), intent(inout) :: self
      real(dp), intent(in) :: seconds_left           !! expected wall time of all cases that are left
      logical, intent(in), optional :: is_last       !! true: in any case
      character(len=:), allocatable :: left
      real(dp) :: now

      now = wall_seconds()
      if (now - max(self%last_line_s, self%start_s) < self%line_interval_s .and. .not. present(is_last)) return
      self%last_line_s = now
      left = 'unknown'
      if (seconds_left >= 0) left = duration(seconds_left/self%ranks)
      call say(output_unit, time_stamp()//' '//to_text(self%done())//'/'//to_text(self%total)//' cases, '// &
         to_text(self%failed())//' failed, '//duration(now - self%start_s)//' elapsed, '//left//' left')
      flush (output_unit)
   end subroutine tick

   !> A right-aligned number and its unit.
   pure function counted(number, width, what) result(text)
      integer, intent(in) :: number, width
      character(len=*), intent(in) :: what
      character(len=:), allocatable :: text
      text = to_text(number)
      text = repeat(' ', max(0, width - len(text)))//text//' '//what
   end function counted

   !> Time as h:mm:ss or m:ss.
   pure function duration(seconds) result(text)
      real(dp), intent(in) :: seconds
      character(len=:), allocatable :: text
      character(len=24) :: buffer
      integer :: s
      s = nint(min(max(seconds, 0.0_dp), 1e8_dp))
      if (s >= 3600) then
         write (buffer, '(i0,a,i2.2,a,i2.2)') s/3600, ':', modulo(s, 3600)/60, ':', modulo(s, 60)
      else
         write (buffer, '(i0,a,i2.2)') s/60, ':', modulo(s, 60)
      end if
      text = trim(buffer)
   end function duration

end module ehlwave_sweep_progress
