!> Paths of the rescue ladder: places on them, and the states between.
program test_continuation
   use ehlwave_contact_problem, only: contact_problem_t
   use ehlwave_continuation, only: adaptive_path_t, neighbour_t
   use ehlwave_eyring_law, only: eyring_law_t
   use ehlwave_full_multigrid, only: full_multigrid_t
   use ehlwave_given, only: given_t, steady_given
   use ehlwave_kinds, only: dp
   use ehlwave_load_balance, only: force_balance
   use ehlwave_rescue, only: rung_continuation, rung_damped, rung_direct, rung_name, rung_newton, rung_petsc, rung_restart
   use ehlwave_rheology, only: rheology_t
   use sample_contact, only: make_conditions, make_contact, make_multigrid
   use testing, only: test_t
   implicit none (type, external)
   type(test_t) :: test

   call check_path()
   call check_names()
   call check_neighbour()
   call check_other_oil()
   call check_blend()
   call test%finish()

contains

   subroutine check_path()
      type(adaptive_path_t) :: path
      integer :: trials
      call path%advance(.true.)
      call test%check_close(path%place, 0.5_dp, 'first place', relative=0.0_dp)
      call path%advance(.true.)
      call test%check(path%is_at_end(), 'two successes lead to the end')
      call path%advance(.false.)
      call test%check_close(path%place, 0.75_dp, 'nearer after a failure', relative=1e-14_dp)
      call path%advance(.true.)
      call test%check(path%is_at_end(), 'and on')
      path = adaptive_path_t()
      call path%advance(.true.)
      trials = 1
      do while (path%can_retry())
         call path%advance(.false.)
         trials = trials + 1
         if (trials > 20) exit
      end do
      call test%check(trials == 5 .and. .not. path%is_at_end(), 'gives up after 1/2, 1/4, 1/8, 1/16, 1/32')
   end subroutine check_path

   subroutine check_names()
      integer, parameter :: rungs(6) = [rung_direct, rung_restart, rung_continuation, rung_newton, rung_damped, rung_petsc]
      integer :: i
      do i = 1, size(rungs)
         call test%check(rung_name(rungs(i)) /= 'unknown', 'a rung has a name')
      end do
      do i = 2, size(rungs)
         call test%check(rungs(i) > rungs(i - 1) .and. rung_name(rungs(i)) /= rung_name(rungs(i - 1)), 'rungs are in order')
      end do
   end subroutine check_names

   !> Both ends of the path, and M halfway between them geometrically.
   subroutine check_neighbour()
      real(dp), parameter :: hertz(1, 1) = 1   ! P
      type(full_multigrid_t) :: multigrid
      type(neighbour_t) :: neighbour
      associate (c => make_conditions(1600.0_dp, 0.35_dp))
         call make_multigrid(multigrid, c%m, c%d, 48, .true.)
         call neighbour%choose(multigrid%hierarchy_t, 2)
         call neighbour%impose(multigrid%hierarchy_t, 0.0_dp)
         associate (now => multigrid%levels(1)%problem%conditions)
            call test%check_close([now%m, now%l, now%d], [100.0_dp, 0.5_dp*c%l, c%d], 'neighbour', relative=1e-12_dp)
         end associate
         call neighbour%impose(multigrid%hierarchy_t, 0.5_dp)
         associate (now => multigrid%levels(size(multigrid%levels))%problem)
            call test%check_close(now%conditions%m, 400.0_dp, 'halfway', relative=1e-12_dp)
            call test%check_close(pack(now%rheology%density(hertz), .true.), [density_at(now%conditions%hertz_pressure_pa)], &
                                  'density follows the Hertz pressure', relative=1e-12_dp)
         end associate
         call neighbour%impose(multigrid%hierarchy_t, 1.0_dp)
         associate (now => multigrid%levels(1)%problem)
            call test%check_close([now%conditions%m, now%conditions%l, now%conditions%lambdabar], &
                                  [c%m, c%l, c%lambdabar], 'the case itself', relative=0.0_dp)
            call test%check_close(pack(now%rheology%density(hertz), .true.), [density_at(c%hertz_pressure_pa)], 'its lubricant', &
                                  relative=1e-12_dp)
         end associate
      end associate
   end subroutine check_neighbour

   !> The way from an oil that is more nearly Newtonian: its stress falls geometrically, M and L stay.
   subroutine check_other_oil()
      type(full_multigrid_t) :: multigrid
      type(neighbour_t) :: neighbour
      type(rheology_t) :: oil
      real(dp) :: n0
      integer :: k

      call make_multigrid(multigrid, 100.0_dp, 0.35_dp, 48, .true.)
      associate (problem => multigrid%levels(1)%problem)
         oil = problem%rheology
         call oil%use_flow(eyring_law_t(), 226e9_dp*1e6_dp)
         call problem%set_conditions(problem%conditions, oil)
         n0 = problem%film_flow%n0
         call neighbour%choose(multigrid%hierarchy_t, 0)
         do k = 0, 2
            call neighbour%impose(multigrid%hierarchy_t, 0.5_dp*k)
            call test%check_close([problem%film_flow%n0/n0, problem%conditions%m, problem%conditions%l], &
                                  [0.1_dp**(2 - k), 100.0_dp, 12.05_dp], 'other oil', relative=1e-12_dp)
         end do
      end associate
   end subroutine check_other_oil

   pure real(dp) function density_at(p_pa)
      real(dp), intent(in) :: p_pa
      density_at = (5.9e8_dp + 1.34_dp*p_pa)/(5.9e8_dp + p_pa)
   end function density_at

   subroutine check_blend()
      type(contact_problem_t) :: problem
      type(given_t) :: between, smooth, rough
      real(dp), allocatable :: crest(:, :)
      call make_contact(problem, 100.0_dp, 1.0_dp, 24, 24, .true.)
      smooth = steady_given(problem%grid)
      rough = smooth
      allocate (crest(0:problem%grid%nx, 0:problem%grid%ny), source=0.3_dp)
      call rough%set_rough(crest)
      rough%load = force_balance(2.0_dp)
      between = smooth%blend(rough, 0.25_dp)
      call test%check_close([between%rough(3, 4), between%load%force], [0.075_dp, 1.25_dp], 'a quarter of the way', &
                            relative=1e-14_dp)
      between = rough%blend(smooth, 0.0_dp)
      call test%check_close(between%load%force, 2.0_dp, 'begins where it was', relative=0.0_dp)
      between = smooth%blend(rough, 1.0_dp)
      call test%check_close([between%rough(3, 4), between%load%force], [0.3_dp, 2.0_dp], 'ends where it shall', &
                            relative=0.0_dp)
   end subroutine check_blend

end program test_continuation
