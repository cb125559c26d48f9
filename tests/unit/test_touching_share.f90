!> A conforming wave driven by the share of the load that solids bear, up to 0.95 and back: one speed for each share.
program test_touching_share
   use ehlwave_case_definition, only: case_t
   use ehlwave_case_file, only: case_from_text
   use ehlwave_case_plan, only: make_plan
   use ehlwave_errors, only: error_t
   use ehlwave_grid, only: new_line_grid
   use ehlwave_kinds, only: dp, pi
   use ehlwave_planned_case, only: case_plan_t
   use ehlwave_solve_report, only: solve_report_t
   use ehlwave_status, only: status_converged
   use ehlwave_touching_continuation, only: reach_share, share_of, start_steady
   use ehlwave_touching_newton, only: touching_solver_t
   use ehlwave_touching_state, only: new_touching_law, touching_state_t
   use silent_monitor, only: silent_monitor_t
   use testing, only: test_t
   implicit none (type, external)

   real(dp), parameter :: shares(6) = [0.02_dp, 0.2_dp, 0.4_dp, 0.6_dp, 0.8_dp, 0.95_dp]
   real(dp), parameter :: amplitude_m = 50e-9_dp, wavelength = 0.5_dp
   type(test_t) :: test
   type(touching_solver_t) :: solver
   type(touching_state_t) :: state
   type(solve_report_t) :: report
   real(dp) :: down(size(shares)), up(size(shares))
   integer :: n

   call make_contact()
   call start_steady(solver, state, report)
   call test%check_equal(report%status, status_converged, 'a first state')
   do n = 1, size(shares)
      call go_to(shares(n), up(n))
   end do
   do n = size(shares), 1, -1
      call go_to(shares(n), down(n))
   end do
   call test%check(all(up(2:) < up(:size(up) - 1)), 'the more the solids bear, the slower')
   call test%check_close(down, up, 'speeds on the way back', relative=1e-4_dp)
   call test%finish()

contains

   !> The wavy roller of the reference values, on a coarse mesh.
   subroutine make_contact()
      type(case_t) :: case
      type(case_plan_t) :: plan
      type(error_t), allocatable :: error
      real(dp), allocatable :: rough(:, :)

      call case_from_text('&conditions radius_x_m = 0.01, reduced_modulus_pa = 2.26e11, load_n_per_m = 1.000861e5, '// &
                          'mean_speed_m_per_s = 0.05, viscosity_pa_s = 0.04, slip_parameter = 0 / &lubricant '// &
                          "pressure_viscosity_per_pa = 2.2e-8, roelands_index = 0.68, flow_law = 'eyring', "// &
                          'eyring_stress_pa = 1e7 / &touching film_m = 2e-8 / &grid cells_x = 96 /', case, error)
      if (.not. allocated(error)) call make_plan(case, plan, error)
      call test%check_no_error(error, 'case')
      solver%law = new_touching_law(case%effects%touching%data, plan%conditions)
      call solver%problem%init(new_line_grid(-4.0_dp, 2.0_dp, 96), plan%conditions, plan%rheology)
      call solver%begin()
      call solver%problem%grid%new_field(rough)
      rough(:, 0) = -amplitude_m/plan%conditions%c_m*cos(2*pi*solver%problem%grid%x/wavelength)
      call solver%given%set_rough(rough)
   end subroutine make_contact

   subroutine go_to(share, speed)
      real(dp), intent(in) :: share
      real(dp), intent(out) :: speed               !! m/s
      type(silent_monitor_t) :: monitor
      call reach_share(solver, state, share, monitor, report)
      call test%check_equal(report%status, status_converged, 'steady state')
      call test%check_close(share_of(solver, state), share, 'share', absolute=1e-6_dp)
      speed = state%speed
   end subroutine go_to

end program test_touching_share
