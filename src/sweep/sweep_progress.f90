!> One line of progress of a sweep, and the results file renewed from time to time.
module ehlwave_sweep_progress
   use, intrinsic :: iso_fortran_env, only: output_unit
   use ehlwave_case_table, only: sweep_t
   use ehlwave_clock, only: time_stamp, wall_seconds
   use ehlwave_errors, only: error_t
   use ehlwave_kinds, only: dp
   use ehlwave_results_file, only: row_t, write_results
   use ehlwave_status, only: is_success, status_name, status_pending
   use ehlwave_text, only: to_text
   implicit none (type, external)
   private
   public :: new_progress

   type, public :: progress_t
      type(sweep_t), pointer, private :: sweep => null()
      character(len=:), allocatable, private :: sweep_text
      integer, private :: ranks = 1
      real(dp), private :: start_s = 0, last_line_s = 0, last_write_s = 0
      integer, private :: done = 0
      integer :: failed = 0                          !! cases that did not converge
      real(dp), private :: cost_done = 0, cost_total = 0, seconds_done = 0
      real(dp) :: line_interval_s = 10               !! between progress lines
      real(dp) :: write_interval_s = 60              !! between results files on the way
   contains
      procedure :: finished
      procedure :: tick
      procedure :: write
   end type progress_t

contains

   !> Begin to count.
   function new_progress(sweep, sweep_text, ranks) result(self)
      type(sweep_t), intent(in), target :: sweep
      character(len=*), intent(in) :: sweep_text     !! the sweep file as it was
      integer, intent(in) :: ranks
      type(progress_t) :: self
      self%sweep => sweep
      self%sweep_text = sweep_text
      self%ranks = ranks
      self%start_s = wall_seconds()
      self%last_write_s = self%start_s
      self%last_line_s = self%start_s
      self%cost_total = sum(sweep%plans%cost)
   end function new_progress

   !> Count a finished case; failures are told at once.
   subroutine finished(self, case, rows)
      class(progress_t), intent(inout) :: self
      integer, intent(in) :: case
      type(row_t), intent(in) :: rows(:)

      self%done = self%done + 1
      self%cost_done = self%cost_done + self%sweep%plans(case)%cost
      self%seconds_done = self%seconds_done + rows(case)%result%seconds
      if (.not. is_success(rows(case)%result%status)) then
         self%failed = self%failed + 1
         write (output_unit, '(a)') time_stamp()//' case '//to_text(case)//' '// &
            status_name(rows(case)%result%status)//': '//trim(rows(case)%message)
      end if
      if (self%done == size(rows)) self%last_line_s = 0
      call self%tick(rows)
   end subroutine finished

   !> A line, and a results file, when it is time for one.
   subroutine tick(self, rows)
      class(progress_t), intent(inout) :: self
      type(row_t), intent(in) :: rows(:)
      type(error_t), allocatable :: error
      character(len=:), allocatable :: left
      real(dp) :: now, rate

      now = wall_seconds()
      if (now - self%last_line_s >= self%line_interval_s) then
         self%last_line_s = now
         left = 'unknown'
         if (self%cost_done > 0) then
            rate = self%cost_done/max(self%seconds_done, 1e-6_dp)*self%ranks
            left = duration((self%cost_total - self%cost_done)/rate)
         end if
         write (output_unit, '(a)') time_stamp()//' '//to_text(self%done)//'/'//to_text(size(rows))//' cases, '// &
            to_text(self%failed)//' failed, '//duration(now - self%start_s)//' elapsed, '//left//' left'
         flush (output_unit)
      end if
      if (now - self%last_write_s >= self%write_interval_s .and. any(rows%result%status /= status_pending)) then
         self%last_write_s = now
         call self%write(rows, error)
         if (allocated(error)) write (output_unit, '(a)') time_stamp()//' '//error%message
      end if
   end subroutine tick

   !> Write the results file as things stand.
   subroutine write(self, rows, error)
      class(progress_t), intent(in) :: self
      type(row_t), intent(in) :: rows(:)
      type(error_t), allocatable, intent(out) :: error
      call write_results(self%sweep%output, self%sweep_text, self%sweep%cases, self%sweep%plans, rows, error)
   end subroutine write

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
