!> Numerical outcomes. They are data, stored with the result, and never end a process.
module ehlwave_status
   implicit none (type, external)
   private
   public :: status_name, is_success

   integer, parameter, public :: status_converged = 0   !! criterion met, grid resolves the case
   integer, parameter, public :: status_unresolved = 1  !! criterion met, grid too coarse for the case
   integer, parameter, public :: status_stalled = 2     !! step cap reached before the criterion
   integer, parameter, public :: status_diverged = 3    !! residual grew or film left the physical range
   integer, parameter, public :: status_not_finite = 4  !! NaN or infinity met
   integer, parameter, public :: status_pending = 5     !! not run yet

contains

   !> Name of a status as written to results.
   pure function status_name(status) result(name)
      integer, intent(in) :: status
      character(len=:), allocatable :: name
      select case (status)
      case (status_converged); name = 'converged'
      case (status_unresolved); name = 'unresolved'
      case (status_stalled); name = 'stalled'
      case (status_diverged); name = 'diverged'
      case (status_not_finite); name = 'not_finite'
      case (status_pending); name = 'pending'
      case default; name = 'unknown'
      end select
   end function status_name

   !> Whether the equations were solved to the asked tolerance.
   elemental logical function is_success(status)
      integer, intent(in) :: status
      is_success = status == status_converged .or. status == status_unresolved
   end function is_success

end module ehlwave_status
