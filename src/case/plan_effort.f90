!> Errors and work to expect of a plan, and the cap on its work.
module ehlwave_plan_effort
   use ehlwave_accuracy_model, only: expected_long_step_error, expected_ratio_error, &
      expected_step_error, fitted_share, steady_work_units, step_work_units
   use ehlwave_case_definition, only: case_t
   use ehlwave_grid_choice, only: formula_ratio
   use ehlwave_kinds, only: dp
   use ehlwave_linear_range, only: expected_nonlinearity
   use ehlwave_planned_case, only: case_plan_t, run_harmonic, run_march, run_standing
   use ehlwave_scheme_choice, only: long_step_work
   implicit none (type, external)
   private
   public :: cap_work, expect

   !> Work of a case over its planned work, without a cap of its own; the case ends at a share of it, since the last
   !> step is finished.
   real(dp), parameter, public :: most_work = 10
   real(dp), parameter :: share_of_most = 0.8_dp
   real(dp), parameter, public :: most_finer_work = 6   !! times that cap, with finer runs for an accuracy
   real(dp), parameter :: estimate_cost = 0.15_dp    !! of the coarser grids of a case, whose steps are dT = hX, over
                                                     !! a march with such steps,
   real(dp), parameter :: standing_estimate_cost = 0.35_dp   !! and over a standing pattern
   real(dp), parameter :: response_work_units = 50   !! work units of a linear response on half a domain and the change
                                                     !! of the
                                                     !! mean; measured: 35 to 80
   real(dp), parameter :: line_response_work_units = 250   !! work units of a response of a line contact
   real(dp), parameter :: mean_share = 0.35_dp             !! share of the change of the mean; measured 17 of 55
   real(dp), parameter :: load_step_cost = 4         !! time steps after a load step over others; measured at M = 300, L
                                                     !! = 30, D = 1: 9
   real(dp), parameter :: petsc_cost = 2  !! cost of a solution by PETSc, relative to Newton's method; measured: 0.9
                                                     !! to 2.2
   real(dp), parameter :: periodic_share = 0.4_dp    !! cost of a march that starts in the waves, relative to rest;
                                                     !! measured:
                                                     !! 0.2 to 0.6
   !> Cost factor for an oil with a limiting shear stress; measured: 2 to 20, and 65 by FAS, whose every sweep finds the
   !> stresses anew.
   real(dp), parameter :: limit_cost = 6, fas_limit_cost = 30
   !> Cost factor of the fitted scheme, steady states and responses; measured (64 to 768 cells, M = 100 to 10,000): 0.9
   !> to 4 and 0.8 to 1.7.
   real(dp), parameter :: fitted_cost = 2, fitted_response_cost = 1.2_dp

contains

   !> Error and cost to expect of a plan that is complete except for them. Whole domains cost twice as much as half
   !> domains.
   subroutine expect(case, plan)
      type(case_t), intent(in) :: case
      type(case_plan_t), intent(inout) :: plan
      real(dp) :: samples, steady_cost, step_tolerance, steps_cost
      logical :: is_newtonian

      is_newtonian = plan%rheology%is_newtonian()
      steps_cost = 1
      samples = plan%resolution%samples
      step_tolerance = case%step_tolerance
      if (plan%kind == run_harmonic) then     ! has the frequency of steps dT = hX, and no tolerance of its own
         if (plan%surfaces%moves()) samples = plan%surfaces%shortest_period()/plan%hx
         step_tolerance = 0
      end if
      plan%expected%domain = plan%domain_error
      plan%expected%mesh = plan%expected_film_mesh_error()
      if (plan%surfaces%is_rough() .and. .not. plan%surfaces%is_measured()) then
         plan%expected%mesh = expected_ratio_error(plan%conditions, &
                                                   formula_ratio(case, plan%conditions, plan%surfaces%moves()), &
                                                   plan%hx*sqrt(merge(fitted_share, 1.0_dp, plan%is_fitted)), &
                                                   1, samples, 0.0_dp)*plan%thinning%steepness
         plan%expected%mesh = plan%expected%mesh + plan%wave_mesh_error()
         call plan%effects%expect_ratio_error(plan%expected)
         if (samples > 0) plan%expected%time = expected_long_step_error(plan%conditions, &
            formula_ratio(case, plan%conditions, plan%surfaces%moves()), plan%hx*sqrt(plan%thinning%steepness), &
            plan%cells_per_step, samples, plan%is_fitted)
         if (samples > 0) plan%expected%algebraic = expected_step_error(step_tolerance)
         if (plan%kind == run_march .or. plan%kind == run_standing) plan%expected%amplitude = &
            expected_nonlinearity(case)
      end if
      plan%expected_error = plan%expected%mesh + sum(plan%expected%by_effect) + plan%expected%time &
                            + plan%expected%algebraic
      associate (steady => steady_work_units(plan%conditions, plan%cells_x, is_newtonian, plan%thinning%cost), &
                 step => step_work_units(plan%conditions, plan%cells_x, is_newtonian, plan%thinning%cost))
         if (abs(case%load_factor - 1) > 0) steps_cost = load_step_cost
         if (case%method == 'petsc') steps_cost = petsc_cost*steps_cost
         steady_cost = merge(petsc_cost, 1.0_dp, case%method == 'petsc')
         call plan%effects%multiply_cost(steady_cost, steps_cost)
         if (plan%is_fitted) steady_cost = fitted_cost*steady_cost
         plan%expected_work_units = (1 + plan%phases*phase_cost(min(1.0_dp, &
            case%amplitude_over_film)))*steady*steady_cost &
                                    + merge(periodic_share, 1.0_dp, plan%is_periodic)*plan%steps*step*steps_cost
      end associate
      if (case%oil%shear_limit_over_pressure > 0) plan%expected_work_units = plan%expected_work_units* &
         merge(fas_limit_cost, limit_cost, case%method == 'fas')
      if (plan%responds) plan%expected_work_units = plan%expected_work_units &
         + size(plan%surfaces%list)*merge(line_response_work_units, response_work_units, plan%conditions%is_line()) &
         *merge(fitted_response_cost, 1.0_dp, plan%is_fitted)*merge(1.0_dp, 1 - mean_share, case%mean_rise)
      if (.not. (plan%is_half .or. plan%conditions%is_line())) plan%expected_work_units = 2*plan%expected_work_units
      plan%work_with_estimates = plan%expected_work_units
      if (plan%surfaces%is_rough() .and. plan%kind /= run_harmonic .and. case%error_estimate == 'coarse_grid') &
         plan%work_with_estimates = (1 + merge(standing_estimate_cost, estimate_cost &
            *merge(1.0_dp, 1/long_step_work, plan%cells_per_step == 1), plan%kind == run_standing)) &
                                    *plan%expected_work_units
   end subroutine expect

   !> Work of a steady state with a standing pattern, found from the phase before, over the smooth state's work.
   !> Measured at amplitudes of 1, 20, 50 and 90 % of the film (M = 50 to 300, L = 5 to 30, D = 0.2 and 1, transverse,
   !> isotropic and longitudinal, 96 x 64 cells): 0.6 to 2 times this.
   elemental real(dp) function phase_cost(amplitude)
      real(dp), intent(in) :: amplitude    !! over the film
      phase_cost = 0.5_dp*(1 + amplitude)/(1 - 0.9_dp*amplitude)
   end function phase_cost

   !> A run takes at most ten times the work that its plan expects, rescues and error estimates included, and a case
   !> with finer runs for an accuracy at most thirty times, unless it has a cap of its own, `largest_total_steps`.
   !> Measured: twice the cells of a march take eleven times the work.
   subroutine cap_work(case, plan)
      type(case_t), intent(in) :: case
      type(case_plan_t), intent(inout) :: plan
      plan%largest_work = huge(1.0_dp)
      plan%largest_work_in_all = plan%largest_work
      if (case%largest_total_steps > 0) return
      plan%largest_work = share_of_most*most_work*plan%expected_work()
      plan%largest_work_in_all = plan%largest_work*merge(most_finer_work, 1.0_dp, &
                                                         case%accuracy > 0 .and. case%edges == 'flooded')
   end subroutine cap_work

end module ehlwave_plan_effort
