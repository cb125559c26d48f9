!> Factors are kept while they save work.
program test_kept_factors
   use ehlwave_kept_factors, only: kept_factors_t
   use ehlwave_kinds, only: dp
   use testing, only: test_t
   implicit none (type, external)

   type(test_t) :: test

   call check_wear()
   call check_failure()
   call test%finish()

contains

   !> Factors that wear a little with each system are made anew when a system loses more than the mean so far.
   subroutine check_wear()
      type(kept_factors_t) :: kept
      real(dp), parameter :: making = 100, solve = 40   ! operations, for two decades
      integer :: k, least, served

      call kept%begin(.true.)
      call test%check(.not. kept%serve(3), 'none at first')
      call kept%note_new(3, making, solve, 1e-2_dp)
      call test%check(kept%serve(3) .and. .not. kept%serve(2), 'for their own level')
      do served = 1, 20
         if (.not. kept%serve(3)) exit
         call kept%note_old(solve + 9*served, 1e-2_dp)
      end do
      ! making + 9 (1 + 2 + ... + n) over n + 1 systems is smallest at n = 4
      least = minloc([((making + 4.5_dp*k*(k + 1))/(k + 1), k=0, 20)], 1) - 1
      call test%check(abs(served - 1 - least) <= 1, 'as many systems as the least mean cost')
      call kept%begin(.true.)
      call test%check(.not. kept%serve(3), 'dropped')
   end subroutine check_wear

   !> Kept factors that lost more than new ones cost are not tried again for such systems, until all begins anew.
   subroutine check_failure()
      type(kept_factors_t) :: kept
      call kept%begin(.true.)
      call kept%note_new(1, 100.0_dp, 40.0_dp, 1e-2_dp)
      call test%check(kept%worth(1e-2_dp) > 130 .and. kept%worth(1e-2_dp) < 150, 'work that they are worth')
      call kept%begin(.true.)
      call kept%note_old(400.0_dp, 1e-2_dp)
      call kept%note_new(1, 100.0_dp, 40.0_dp, 1e-2_dp)
      call test%check(kept%serve(1), 'kept for the later systems of a solution')
      call kept%begin(.true.)
      call test%check(.not. kept%serve(1), 'not for the first of the next solution')
      call kept%begin(.false.)
      call kept%note_new(1, 100.0_dp, 40.0_dp, 1e-2_dp)
      call kept%begin(.true.)
      call test%check(kept%serve(1), 'after a new start')
      call kept%begin(.true.)
      call kept%note_new(0, 100.0_dp, 40.0_dp, 0.9_dp)
      call test%check(.not. kept%serve(1), 'useless factors are not kept')
   end subroutine check_failure

end program test_kept_factors
