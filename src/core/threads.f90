!> Threads that share the work of one contact.
!>
!> Loops are handed out in blocks that do not depend on the number of threads, and no sum is taken in the order in which
!> threads come: results are the same bits with any number. The runtime of OpenMP keeps the number; a build without
!> OpenMP has one thread.
module ehlwave_threads
   !$ use omp_lib, only: omp_get_max_threads, omp_get_thread_num, omp_set_num_threads
   implicit none (type, external)
   private
   public :: can_share, is_shared, take_threads, thread_count, thread_number

   integer, parameter :: least_shared = 8192        !! values; to share fewer takes longer than to do the work
   integer, parameter, public :: row_block = 16     !! rows of a grid that a thread takes at once
   integer, parameter, public :: most_threads = 256 !! that can be asked for

contains

   !> Whether this build can use more than one thread.
   pure logical function can_share()
      can_share = .false.
      !$ can_share = .true.
   end function can_share

   !> Threads in use from now on. None asked for: as many as the environment says (OMP_NUM_THREADS), else the cores that
   !> this process may use.
   subroutine take_threads(asked_for)
      integer, intent(in) :: asked_for   !! 0: none
      !$ if (asked_for > 0) call omp_set_num_threads(asked_for)
   end subroutine take_threads

   !> Threads in use.
   integer function thread_count()
      thread_count = 1
      !$ thread_count = omp_get_max_threads()
   end function thread_count

   !> Number of the present thread of those that share a loop, from 0.
   integer function thread_number()
      thread_number = 0
      !$ thread_number = omp_get_thread_num()
   end function thread_number

   !> Whether a loop over so many values is worth sharing.
   pure logical function is_shared(values)
      integer, intent(in) :: values
      is_shared = values >= least_shared
   end function is_shared

end module ehlwave_threads
