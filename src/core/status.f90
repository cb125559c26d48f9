!> Numerical outcomes. They are data, stored with the result, and never end a process.
module ehlwave_status
   implicit none (type, external)
   private
   public :: status_name, status_of_name, is_solved, is_success

   integer, parameter, public :: status_converged = 0   !! criterion met, grid resolves the case
   integer, parameter, public :: status_unresolved = 1  !! criterion met, grid too coarse for the case
   integer, parameter, public :: status_stalled = 2     !! step cap reached before the criterion
   integer, parameter, public :: status_diverged = 3    !! residual grew or film left the physical range
   integer, parameter, public :: status_not_finite = 4  !! NaN or infinity met
   integer, parameter, public :: status_pending = 5     !! not run yet
   integer, parameter, public :: status_over_budget = 6 !! took longer than a case may, or needs more memory than
                                                        !! there is
   integer, parameter, public :: status_crashed = 7     !! its process died in two runs, so it is not tried again
   integer, parameter, public :: status_interrupted = 8 !! stopped from outside, to be continued
   integer, parameter, public :: status_inaccurate = 9  !! solved, but its error is above the accuracy asked for, within
                                                        !! all limits
   integer, parameter, public :: last_status = 9

   !> As written to results.
   character(len=*), parameter :: names(0:last_status) = [character(len=11) :: 'converged', 'unresolved', 'stalled', &
      'diverged', 'not_finite', 'pending', 'over_budget', 'crashed', 'interrupted', 'inaccurate']

contains

   !> Name of a status as written to results.
   pure function status_name(status) result(name)
      integer, intent(in) :: status
      character(len=:), allocatable :: name
      name = 'unknown'
      if (status >= 0 .and. status <= last_status) name = trim(names(status))
   end function status_name

   !> Status of a name; `pending` for a name that is none.
   pure integer function status_of_name(name)
      character(len=*), intent(in) :: name
      status_of_name = findloc(names, name, 1) - 1
      if (status_of_name < 0) status_of_name = status_pending
   end function status_of_name

   !> Whether the equations were solved, and as well as was asked for where an accuracy was.
   elemental logical function is_success(status)
      integer, intent(in) :: status
      is_success = status == status_converged .or. status == status_unresolved
   end function is_success

   !> Whether the equations were solved to the asked tolerance: there are numbers.
   elemental logical function is_solved(status)
      integer, intent(in) :: status
      is_solved = is_success(status) .or. status == status_inaccurate
   end function is_solved

end module ehlwave_status
