!> Threads that share the work of one contact.
!>
!> Loops are handed out in blocks that do not depend on the number of threads, and no sum is taken in the order in which
!> threads come: results are the same bits with any number. The runtime of OpenMP keeps the number; a build without
!> OpenMP has one thread.
module ehlwave_threads
   use, intrinsic :: iso_c_binding, only: c_int
   !$ use omp_lib, only: omp_get_max_threads, omp_get_num_threads, omp_get_thread_num, omp_set_num_threads
   implicit none (type, external)
   private
   public :: announce, await, can_share, is_shared, take_threads, team_size, thread_count, thread_number

   integer, parameter :: least_shared = 8192        !! values; to share fewer takes longer than to do the work
   integer, parameter, public :: row_block = 16     !! rows of a grid that a thread takes at once
   integer, parameter, public :: most_threads = 256 !! that can be asked for

   integer, parameter :: patience = 1000            !! looks at another thread's progress before the processor is left to
                                                    !! others

   interface
      integer(c_int) function sched_yield() bind(c)
         import :: c_int
         implicit none (type, external)
      end function sched_yield
   end interface

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

   !> Threads that share the present loop.
   integer function team_size()
      team_size = 1
      !$ team_size = omp_get_num_threads()
   end function team_size

   !> Let other threads know how far this one is, and see what it has written so far.
   subroutine announce(progress, place)
      integer, intent(inout) :: progress
      integer, intent(in) :: place
      !$omp flush
      !$omp atomic write
      progress = place
      !$omp flush
   end subroutine announce

   !> Wait until another thread is so far.
   subroutine await(progress, place)
      integer, intent(inout) :: progress   !! as the other one announces it
      integer, intent(in) :: place
      integer(c_int) :: status
      integer :: looks, seen

      looks = 0
      do
         !$omp atomic read
         seen = progress
         if (seen >= place) exit
         looks = looks + 1
         if (modulo(looks, patience) == 0) status = sched_yield()
      end do
      !$omp flush
   end subroutine await

   !> Whether a loop over so many values is worth sharing.
   pure logical function is_shared(values)
      integer, intent(in) :: values
      is_shared = values >= least_shared
   end function is_shared

end module ehlwave_threads
