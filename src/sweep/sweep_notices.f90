!> Notices about a store that a sweep goes on with.
module ehlwave_sweep_notices
   use, intrinsic :: iso_fortran_env, only: output_unit
   use ehlwave_store_contents, only: contents_t, this_build
   use ehlwave_sweep_cases, only: sweep_t
   use ehlwave_terminal, only: say
   use ehlwave_text, only: next_line, number_of, to_text
   implicit none (type, external)
   private
   public :: print_notices

contains

   !> Report the content of the store and its differences from the present request.
   subroutine print_notices(sweep, contents, to_run, retry)
      type(sweep_t), intent(in) :: sweep
      type(contents_t), intent(in) :: contents
      logical, intent(in) :: to_run(:)
      character(len=*), intent(in) :: retry
      integer :: i, other, other_build, unlisted

      if (contents%bad_lines > 0) call say(output_unit, number_of(contents%bad_lines, 'record')// &
         ' cut off or damaged (killed while writing, full disk); counted as not written')
      if (contents%count == 0) return
      call say(output_unit, to_text(count(.not. to_run))//' of '//number_of(size(to_run), 'case')// &
         ' found in the store, '//to_text(count(to_run))//' to run')
      other = 0
      unlisted = 0
      other_build = 0
      do i = 1, contents%count
         if (sweep%index%find(contents%cases(i)%identity) == 0) then
            unlisted = unlisted + 1
         else if (.not. contents%logs(contents%cases(i)%log)%is_by_this_build) then
            other = contents%cases(i)%log
            other_build = other_build + 1
         end if
      end do
      if (unlisted > 0) then
         call say(output_unit, 'NOTICE: the store also holds '//number_of(unlisted, 'finished case')// &
            ' that this sweep file does not list: kept in the store, left out of the results file')
         call print_changed_settings(sweep, contents)
      end if
      if (other_build > 0 .and. retry /= 'version') call say(output_unit, 'NOTICE: ehlwave '// &
         contents%logs(other)%build()//' computed '// &
         number_of(other_build, 'finished case')//', this is '//this_build// &
         ': kept (each row of the results has its version; --retry version computes them again)')
   end subroutine print_notices

   !> Lines of the effective input, beyond what a sweep varies, that differ from an earlier run.
   subroutine print_changed_settings(sweep, contents)
      type(sweep_t), intent(in) :: sweep
      type(contents_t), intent(in) :: contents
      character(len=:), allocatable :: earlier, now
      integer :: first, last, log

      now = settings_of(sweep%input(1))
      do log = size(contents%logs), 1, -1
         if (.not. allocated(contents%logs(log)%base_input)) cycle
         earlier = settings_of(contents%logs(log)%base_input)
         if (earlier == now) cycle
         last = -1
         do while (next_line(earlier, first, last))
            if (index(now, earlier(first:last)//new_line('a')) == 0) &
               call say(output_unit, '   an earlier run had '//trim(adjustl(earlier(first:last))))
         end do
         exit
      end do
   end subroutine print_changed_settings

   !> The groups &lubricant, &grid, &solver and &dynamics.
   pure function settings_of(input) result(text)
      character(len=*), intent(in) :: input
      character(len=:), allocatable :: text
      integer :: grid, lubricant, waviness
      lubricant = index(input, '&lubricant')
      waviness = index(input, '&waviness')
      grid = index(input, '&grid')
      text = ''
      if (lubricant > 0 .and. waviness > lubricant .and. grid > waviness) text = input(lubricant:waviness - 1)// &
         input(grid:)
   end function settings_of

end module ehlwave_sweep_notices
