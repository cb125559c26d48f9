!> The rescue ladder leads to the solution that the direct solve finds, within its cap.
program test_rescue
   use ehlwave_continuation, only: neighbour_t
   use ehlwave_full_multigrid, only: full_multigrid_t
   use ehlwave_kinds, only: dp
   use ehlwave_rescue, only: rescue_t, rung_continuation, rung_damped, rung_direct, rung_name
   use ehlwave_solve_report, only: solve_limits_t
   use ehlwave_status, only: status_converged
   use ehlwave_text, only: to_text
   use sample_contact, only: make_multigrid
   use testing, only: test_t
   implicit none (type, external)

   real(dp), parameter :: tolerance = 1e-8_dp
   type(test_t) :: test

   call compare(1000.0_dp, 1.0_dp, 128, 4, rung_continuation)
   call compare(100.0_dp, 0.04_dp, 64, 5, rung_damped)
   call check_forgetting()
   call check_cap()
   call check_work_cap()
   call test%finish()

contains

   !> A direct solve of at most `steps` steps fails; the ladder gets there on rung `rung`.
   subroutine compare(m, d, cells, steps, rung)
      real(dp), intent(in) :: m, d
      integer, intent(in) :: cells, steps, rung
      type(full_multigrid_t) :: easy, hard
      type(rescue_t) :: free, rescue
      character(len=:), allocatable :: what
      integer :: l, n

      what = 'M = '//to_text(m, 4)//', '//to_text(steps)//' steps: '
      call make_multigrid(easy, m, d, cells, .true.)
      call free%solve_steady(easy, solve_limits_t(tolerance, 60), 1e-3_dp)
      call make_multigrid(hard, m, d, cells, .true.)
      call rescue%solve_steady(hard, solve_limits_t(tolerance, steps), 1e-3_dp)
      n = size(easy%levels)
      associate (direct => easy%levels(n), rescued => hard%levels(n))
         call test%check(direct%report%status == status_converged .and. free%rung == rung_direct .and. free%rescued == 0, &
                         what//'direct')
         call test%check(rescued%report%status == status_converged .and. rescue%rescued == 1, what//'rescued')
         call test%check(rescue%rung == rung, what//'on rung '//rung_name(rescue%rung)//', not '//rung_name(rung))
         call test%check(rescued%report%nonlinear_steps > steps, what//'steps of all attempts are counted')
         call test%check_close(maxval(abs(rescued%state%p - direct%state%p)), 0.0_dp, what//'pressure', absolute=1e-5_dp)
         call test%check_close(rescued%problem%grid%value_at_centre(rescued%state%h), &
                               direct%problem%grid%value_at_centre(direct%state%h), what//'film', relative=1e-6_dp)
      end associate
      do l = max(1, n - 2), n
         if (.not. easy%levels(l)%has_film()) cycle
         call test%check_close([hard%levels(l)%central_film, hard%levels(l)%minimum_film], &
                               [easy%levels(l)%central_film, easy%levels(l)%minimum_film], &
                               what//'films of level '//to_text(l)//', which error estimates compare', relative=0.02_dp)
      end do
   end subroutine compare

   !> A level has no film of another contact: not of the neighbour that a rescue went on from, and not of an unsolved
   !> contact.
   subroutine check_forgetting()
      type(full_multigrid_t) :: multigrid
      type(neighbour_t) :: neighbour
      integer :: n
      call make_multigrid(multigrid, 100.0_dp, 1.0_dp, 96, .true.)
      n = size(multigrid%levels)
      call test%check(.not. any(multigrid%levels%has_film()), 'no film before a solution')
      call neighbour%choose(multigrid%hierarchy_t, 1)
      call neighbour%impose(multigrid%hierarchy_t, 0.0_dp)
      call multigrid%solve(solve_limits_t(tolerance, 60), 1e-3_dp)
      call test%check(all(multigrid%levels%has_film()), 'films of the neighbour')
      call neighbour%impose(multigrid%hierarchy_t, 1.0_dp)
      call test%check(.not. any(multigrid%levels%has_film()), 'none of them for the case')
      call multigrid%solve_level(n, solve_limits_t(tolerance, 60), multigrid%levels(n)%report)
      call multigrid%take_film(n)
      call multigrid%solve_below(solve_limits_t(tolerance, 1))
      call test%check(count(multigrid%levels%has_film()) == 1, 'levels that do not converge have none')
      call multigrid%solve_below(solve_limits_t(tolerance, 60))
      call test%check(all(multigrid%levels(max(1, n - 2):)%has_film()), 'levels below are solved from the finest')
   end subroutine check_forgetting

   !> No further step begins when the work that is left is used up, and no solution follows.
   subroutine check_work_cap()
      type(full_multigrid_t) :: free, multigrid
      type(rescue_t) :: rescue, uncapped
      real(dp) :: enough
      call make_multigrid(free, 1000.0_dp, 1.0_dp, 64, .true.)
      call uncapped%solve_steady(free, solve_limits_t(tolerance, 5), 1e-3_dp)
      enough = free%work()
      call make_multigrid(multigrid, 1000.0_dp, 1.0_dp, 64, .true.)
      rescue%work_left = 0.1_dp*enough
      call rescue%solve_steady(multigrid, solve_limits_t(tolerance, 5), 1e-3_dp)
      associate (report => multigrid%levels(size(multigrid%levels))%report)
         call test%check(report%status /= status_converged, 'too little work for this contact')
      end associate
      call test%check(rescue%is_spent() .and. rescue%work_left <= 0, 'the work is used up')
      call test%check(multigrid%work() < 0.2_dp*enough, 'and little more than that')
   end subroutine check_work_cap

   !> The cap holds whatever is tried, and an unresolved case is not worth a climb.
   subroutine check_cap()
      type(full_multigrid_t) :: multigrid
      type(rescue_t) :: rescue
      integer :: n
      rescue%steps_left = 17
      call make_multigrid(multigrid, 1000.0_dp, 1.0_dp, 64, .true.)
      n = size(multigrid%levels)
      call rescue%solve_steady(multigrid, solve_limits_t(tolerance, 5), 1e-3_dp)
      call test%check(multigrid%levels(n)%report%status /= status_converged, 'too few steps for this contact')
      call test%check(multigrid%levels(n)%report%nonlinear_steps == 17 .and. rescue%steps_left == 0, 'the cap is kept')
      rescue = rescue_t(is_ready=.false.)
      call rescue%solve_steady(multigrid, solve_limits_t(tolerance, 5), 1e-3_dp)
      call test%check(multigrid%levels(n)%report%nonlinear_steps <= 5 .and. rescue%rung == rung_direct, 'no climb')
   end subroutine check_cap

end program test_rescue
