!> Progress lines of a single case on standard error.
module ehlwave_log
   use, intrinsic :: iso_fortran_env, only: error_unit
   use ehlwave_clock, only: time_stamp, wall_seconds
   use ehlwave_kinds, only: dp
   use ehlwave_monitor, only: monitor_t
   use ehlwave_text, only: to_text
   implicit none (type, external)
   private

   real(dp), parameter :: interval_s = 5   !! between two lines of the same stage

   !> A time-stamped line every few seconds.
   type, extends(monitor_t), public :: log_monitor_t
      logical :: is_quiet = .false.
      real(dp), private :: last_s = -1e30_dp
      character(len=40), private :: last_stage = ''
   contains
      procedure :: step_done
   end type log_monitor_t

contains

   subroutine step_done(self, stage, done, total)
      class(log_monitor_t), intent(inout) :: self
      character(len=*), intent(in) :: stage
      integer, intent(in) :: done, total
      real(dp) :: now
      if (self%is_quiet) return
      now = wall_seconds()
      if (stage == self%last_stage .and. done < total .and. now - self%last_s < interval_s) return
      self%last_s = now
      self%last_stage = stage
      write (error_unit, '(a)') time_stamp()//' '//stage//' '//to_text(done)//'/'//to_text(total)
   end subroutine step_done

end module ehlwave_log
