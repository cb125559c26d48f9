!> Which cases a sweep that goes on with a store has to run.
module ehlwave_sweep_start
   use, intrinsic :: iso_fortran_env, only: output_unit
   use ehlwave_case_account, only: blank_result
   use ehlwave_case_record, only: store_result
   use ehlwave_case_result, only: case_result_t
   use ehlwave_clock, only: time_stamp
   use ehlwave_errors, only: error_t, raise
   use ehlwave_json_reader, only: json_string
   use ehlwave_kinds, only: dp
   use ehlwave_own_result, only: is_own_result
   use ehlwave_planned_case, only: case_plan_t
   use ehlwave_status, only: is_success, status_crashed, status_pending
   use ehlwave_store, only: store_t
   use ehlwave_store_contents, only: contents_t
   use ehlwave_sweep_cases, only: sweep_t
   use ehlwave_terminal, only: say
   use ehlwave_text, only: to_text
   implicit none (type, external)
   private
   public :: choose_cases, refuse_changed_files, set_aside_crashed

   integer, parameter :: most_deaths = 2   !! deaths of its process in a case, before it is set aside

contains

   !> Cases to run, and the state of the others.
   subroutine choose_cases(sweep, store, contents, retry, to_run, status, seconds)
      type(sweep_t), intent(in) :: sweep
      class(store_t), intent(in) :: store
      type(contents_t), intent(in) :: contents
      character(len=*), intent(in) :: retry          !! '', 'failed', 'version' or 'files': kind of cases to run again
      logical, intent(out) :: to_run(:)
      integer, intent(out) :: status(:)              !! status of the last record, else pending
      real(dp), intent(out) :: seconds(:)            !! wall time, 0: none
      logical :: has_fields
      integer :: i, place

      to_run = .true.
      status = status_pending
      seconds = 0
      do i = 1, size(sweep%cases)
         place = contents%index%find(sweep%identity(i))
         if (place == 0) cycle
         status(i) = contents%cases(place)%status
         seconds(i) = contents%cases(place)%seconds
         to_run(i) = status(i) == status_pending .or. (retry == 'failed' .and. .not. is_success(status(i))) .or. &
                     (retry == 'version' .and. .not. contents%logs(contents%cases(place)%log)%is_by_this_build) .or. &
                     (retry == 'files' .and. file_unlike_stored(sweep%plans(i), contents, place) > 0)
         if (sweep%cases(i)%fields .and. .not. to_run(i)) then
            has_fields = is_own_result(store%fields_path(sweep%identity(i)))   ! complete
            to_run(i) = is_success(status(i)) .and. .not. has_fields
         end if
      end do
   end subroutine choose_cases

   !> Number of the first file of a case that holds other numbers than when its result was stored, 0: none does. An
   !> identity holds the path alone.
   integer function file_unlike_stored(plan, contents, place) result(f)
      type(case_plan_t), intent(in) :: plan
      type(contents_t), intent(in) :: contents
      integer, intent(in) :: place                   !! place of the case in the contents
      character(len=:), allocatable :: stored
      do f = 1, size(plan%files)
         if (plan%files(f)%path == '') cycle
         stored = json_string(contents%value(place, trim(plan%files(f)%name)//'_digest'))
         if (stored /= '' .and. stored /= plan%files(f)%digest) return
      end do
      f = 0
   end function file_unlike_stored

   !> Refuse to go on where a stored result used another content of a file that the case reads.
   subroutine refuse_changed_files(sweep, contents, to_run, error)
      type(sweep_t), intent(in) :: sweep
      type(contents_t), intent(in) :: contents
      logical, intent(in) :: to_run(:)
      type(error_t), allocatable, intent(inout) :: error
      integer :: changed, f, first, i, others

      others = 0
      do i = size(sweep%cases), 1, -1
         if (to_run(i)) cycle
         f = file_unlike_stored(sweep%plans(i), contents, contents%index%find(sweep%identity(i)))
         if (f == 0) cycle
         changed = f
         first = i
         others = others + 1
      end do
      if (others == 0 .or. allocated(error)) return
      associate (file => sweep%plans(first)%files(changed))
         call raise(error, file%key//" = '"//file%path//"' has other numbers than when case "//to_text(first)// &
                    ' was stored ('//to_text(others)//' of '//to_text(size(to_run))//' cases): --retry files runs '// &
                    'these once more; or put the old file back, or give the new one another name')
      end associate
   end subroutine refuse_changed_files

   !> Cases whose process died in two runs are stored as `crashed` and not tried again, with a report.
   subroutine set_aside_crashed(sweep, contents, store, to_run, status, error)
      type(sweep_t), intent(in) :: sweep
      type(contents_t), intent(in) :: contents
      class(store_t), intent(inout) :: store
      logical, intent(inout) :: to_run(:)
      integer, intent(inout) :: status(:)
      type(error_t), allocatable, intent(inout) :: error
      type(case_result_t) :: result
      integer :: case, deaths, log

      do log = 1, size(contents%logs)
         case = sweep%index%find(contents%logs(log)%in_flight)
         if (case == 0 .or. allocated(error)) cycle
         if (.not. to_run(case)) cycle
         deaths = contents%deaths(sweep%identity(case))
         if (deaths < most_deaths) cycle
         result = blank_result(sweep%cases(case), sweep%plans(case))
         result%status = status_crashed
         result%message = 'its process died in '//to_text(deaths)//' runs; --retry failed tries it again'
         call store_result(sweep%cases(case), sweep%plans(case), sweep%input(case), result, &
                           time_stamp(), store, error)
         to_run(case) = .false.
         status(case) = status_crashed
         call say(output_unit, 'NOTICE: case '//to_text(case)//' is set aside: '//result%message)
      end do
   end subroutine set_aside_crashed

end module ehlwave_sweep_start
