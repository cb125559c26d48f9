!> Threads that share the work of one contact.
!>
!> Loops are handed out in blocks that do not depend on the number of threads, and no sum is taken in the order in which
!> threads come: results are the same bits with any number. The runtime of OpenMP keeps the number; a build without
!> OpenMP has one thread.
module ehlwave_threads
   use, intrinsic :: iso_c_binding, only: c_int
   use ehlwave_kinds, only: dp
   use ehlwave_text, only: to_text
   !$ use omp_lib, only: omp_get_max_threads, omp_get_num_threads, omp_get_thread_num, omp_set_num_threads
   implicit none (type, external)
   private
   public :: announce, await, can_share, is_shared, own_cores, share_of_cores, take_threads, team_size, thread_count, &
      thread_number, threads_notice, wait_briefly

   integer, parameter :: least_shared = 8192        !! values; to share fewer takes longer than to do the work
   integer, parameter, public :: row_block = 16     !! rows of a grid that a thread takes at once
   integer, parameter, public :: most_threads = 256 !! most threads that can be requested
   integer, parameter, public :: most_cores = 1024  !! most cores of a machine that are distinguished

   integer, parameter :: patience = 1000            !! looks at the progress of another thread before the processor is
                                                    !! left to others

   interface
      integer(c_int) function c_cores(is_mine, size) bind(c, name='ehlwave_cores')
         import :: c_int
         implicit none (type, external)
         integer(c_int), intent(out) :: is_mine(*)
         integer(c_int), value :: size
      end function c_cores
      integer(c_int) function core_quota() bind(c, name='ehlwave_core_quota')
         import :: c_int
         implicit none (type, external)
      end function core_quota
      integer(c_int) function sched_yield() bind(c)
         import :: c_int
         implicit none (type, external)
      end function sched_yield
      !> Let threads that wait leave the processor soon. The program may start anew: call it before anything is done.
      subroutine wait_briefly() bind(c, name='ehlwave_wait_briefly')
         implicit none (type, external)
      end subroutine wait_briefly
   end interface

contains

   !> Whether this build can use more than one thread.
   pure logical function can_share()
      can_share = .false.
      !$ can_share = .true.
   end function can_share

   !> Threads in use from now on. Without a request: as many as the environment sets (OMP_NUM_THREADS), else `cores`;
   !> never more than `most_threads`.
   subroutine take_threads(asked_for, cores)
      integer, intent(in) :: asked_for            !! 0: none
      integer, intent(in), optional :: cores      !! cores reserved for this process; absent: all that it may use
      character(len=16) :: environment
      integer :: threads

      call get_environment_variable('OMP_NUM_THREADS', environment)
      threads = asked_for
      if (threads == 0) threads = thread_count()
      if (asked_for == 0 .and. environment == '') then
         if (present(cores)) threads = cores
         threads = min(threads, core_quota())
      end if
      !$ call omp_set_num_threads(min(threads, most_threads))
   end subroutine take_threads

   !> A line for the user where the environment asks for more threads than a contact can use, else ''. Call before
   !> `take_threads`.
   function threads_notice(asked_for) result(notice)
      integer, intent(in) :: asked_for            !! by the input, 0: nothing
      character(len=:), allocatable :: notice
      notice = ''
      if (asked_for == 0 .and. thread_count() > most_threads) notice = 'OMP_NUM_THREADS = '//to_text(thread_count())// &
         ' is taken as '//to_text(most_threads)//', the most that share one contact'
   end function threads_notice

   !> How much of each core this process has, of `users` processes that may use it: whole cores.
   pure integer function share_of_cores(is_mine, users) result(cores)
      integer, intent(in) :: is_mine(:)   !! 1 or 0, see `own_cores`
      integer, intent(in) :: users(:)     !! number of users of each core
      cores = max(1, int(sum(is_mine/real(max(users, 1), dp)) + 1e-6_dp))
   end function share_of_cores

   !> Cores that this process may run on: 1, else 0.
   function own_cores() result(is_mine)
      integer(c_int) :: is_mine(most_cores)
      integer(c_int) :: count
      count = c_cores(is_mine, int(size(is_mine), c_int))
      if (count == 0) is_mine(1) = 1
   end function own_cores

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

   !> Publish the progress of this thread, and see the memory that the other has written so far.
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
      integer, intent(inout) :: progress   !! as announced by the other
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
