!> Expected discretisation error and cost of a case, before it is run.
!>
!> The functions were fitted to the runs of `scripts/study error-vs-time`; the coefficients are those of
!> postprocess/record/error-vs-time/models.csv, which also has the deviation of each function from the runs. They
!> are fits, not bounds. Results carry estimates from their own grids.
module ehlwave_accuracy_model
   use ehlwave_conditions, only: conditions_t
   use ehlwave_formula, only: expected_film
   use ehlwave_kinds, only: dp
   implicit none (type, external)
   private
   public :: expected_film_error, expected_long_step_error, expected_ratio_error, expected_step_error, light_error, &
      light_film_error, largest_mesh, mesh_for_waves, points_for, steady_work_units, step_work_units, upstream_error, &
      wave_x_error, wave_y_error

   real(dp), parameter :: film_factor = 0.172_dp           !! model 'film'
   real(dp), parameter :: moving_factor = 0.265_dp         !! model 'moving_ratio'
   real(dp), parameter :: standing_factor = 0.0592_dp      !! model 'standing_ratio'
   !> Ratio of the errors of the fitted and the averaged scheme, as a reduced steepness of the inlet. Measured (96 to
   !> 512 cells along X; M = 100 to 10,000, L = 1 to 20, D = 1 to 0.07): 0.02 to 0.065, 0.085 where hX is above half an
   !> inlet length. In shear-thinning oils 0.03 to 0.14 of the Newtonian error (Ree-Eyring, 1 to 10 MPa, S = 1 to 1.75),
   !> where this share of their own error is 0.05 to 0.18.
   real(dp), parameter, public :: fitted_share = 1/20.0_dp
   !> Relative error of Ad/Ai and responses by waves along X of a fitted scheme: over the inverse fourth power of their
   !> points, and under slip over S - 1 and the inverse square; see `resolution_t` for points under slip. Measured: 0.4
   !> to 0.6 (M = 100, D = 1, transverse, 0.25 a, 4 and 6 points); 0.1 to 3 (14 contacts, M = 49 to 761, D = 0.13 to
   !> 0.94, S = 1.2 to 1.9). Of the averaged scheme it is part of the other.
   real(dp), parameter :: wave_x_factor = 1
   real(dp), parameter :: slip_factor = 2
   real(dp), parameter :: step_by_inlet = 0.0108_dp        !! model 'time_step'
   !> Factor of the inverse cube of the steps per wave. Measured: 0.5 to 0.9 (M = 100, D = 1, 0.5 a, 3 to 16 steps).
   real(dp), parameter :: step_by_waves = 0.8_dp
   !> Factor of the inverse fourth power of the steps per wave in place of `step_by_waves`, for a fitted scheme, whose
   !> difference along the characteristic has one order more. Measured: 0.8 to 2.2 (M = 100, D = 1, 0.25 and 0.5 a).
   real(dp), parameter :: fitted_step_by_waves = 2
   !> Growth of the part by the inlet with |S - 1|. Measured at S = 0.5 and 1.5 (M = 100, D = 1, 0.7 a): up to
   !> 3.5 times.
   real(dp), parameter :: step_by_slip = 4
   real(dp), parameter :: step_tolerance_factor = 1.26_dp  !! model 'step_tolerance': four of five runs are below
   real(dp), parameter :: steady_cost(3) = [66.7_dp, -0.265_dp, 0.0870_dp]   !! model 'steady_cost'
   real(dp), parameter :: step_cost(3) = [19.8_dp, -0.351_dp, 0.0229_dp]      !! model 'step_cost'
   !> Work of steady states of line contacts, see line_steady_work; fitted to
   !> postprocess/record/error-vs-time/line-work.csv (M = 0.2 to 1000, L = 0 to 25; Barus, Roelands and McEwen; inlets
   !> at -2.5 and -20; 256 to 4096 cells). Of 560 converged states 98 per cent are within a factor of 2, all within 3.1;
   !> for M <= 20 the largest factor is 2.13. Where the film is thicker than five times the gap at x_min, states take
   !> up to 8 times this.
   real(dp), parameter :: line_work = 86, line_cells_power = -0.218_dp, line_power = 0.473_dp
   real(dp), parameter :: line_alpha = 1.62_dp, line_load = 2.78_dp, line_film = 0.422_dp
   real(dp), parameter :: line_step_cost = 80               !! cost of a step of a line contact; measured: 70 to 85
   !> Times as much of a steady state and of a step with a Ree-Eyring oil, M = 100, D = 1, S = 1.5, 5 MPa, counted on
   !> 64, 128 and 256 cells: 1.7, 1.5, 1.6 and 1.8, 1.7, 1.8. Linear responses take less, for they need fewer GMRES
   !> steps.
   real(dp), parameter :: film_flow_cost(2) = [1.6_dp, 1.8_dp]
   ! Refining Y alone changes Ad/Ai of patterns that vary in Y by 0.26 to 0.69 over the square of the points per wave
   ! (M = 100, D = 1 and 0.12, isotropic and longitudinal, 24 to 96 cells). With the fitted scheme by 0.1 to 13 over
   ! their fourth power, under slip by 0.3 to 20 (|S - 1| <= 0.5) and up to 80 (0.9); 27 contacts, M = 22 to 733, D =
   ! 0.1 to 0.97, 5 to 20 points.
   real(dp), parameter :: wave_y_factor = 0.5_dp, fitted_wave_y_factor = 8, fitted_wave_y_slip = 4

contains

   !> Relative error of H(0,0) of a smooth contact, theory eq. (E4): c hX^2 gamma M.
   pure real(dp) function expected_film_error(conditions, hx)
      type(conditions_t), intent(in) :: conditions
      real(dp), intent(in) :: hx    !! mesh size in X
      expected_film_error = film_factor*hx**2*conditions%steepness()
   end function expected_film_error

   !> Relative error of H(0,0) by differences of third order, theory eq. (D12), of a fitted scheme. Where the viscosity
   !> hardly rises no error by the inlet cancels it; measured there: 0.25 to 0.32 (hX/inlet)^3, with 0.06 to 0.26
   !> inlet lengths (M = 20 and 50).
   elemental real(dp) function upstream_error(inlet)
      real(dp), intent(in) :: inlet   !! hX over the length of the inlet
      upstream_error = 0.32_dp*inlet**3
   end function upstream_error

   !> Relative error of Ad/Ai, theory eq. (E4): c hX^2 gamma M (1 - F)^(1/2). F is the ratio by the formula: the shorter
   !> the wave, the nearer F to 1, and the smaller the role of the inlet. c depends on whether the pattern moves. Errors
   !> by steps longer than hX and by the step tolerance are added.
   pure real(dp) function expected_ratio_error(conditions, formula_ratio, hx, cells_per_step, samples, step_tolerance)
      type(conditions_t), intent(in) :: conditions
      real(dp), intent(in) :: formula_ratio    !! Ad/Ai by theory eq. (18)
      real(dp), intent(in) :: hx               !! mesh size in X
      integer, intent(in) :: cells_per_step    !! dT/hX, 1 for shorter steps too: they add no error
      real(dp), intent(in) :: samples          !! time steps per wave, 0 for a stationary pattern
      real(dp), intent(in) :: step_tolerance

      expected_ratio_error = ratio_factor(samples > 0)*ratio_scale(conditions, formula_ratio)*hx**2
      if (samples > 0) expected_ratio_error = expected_ratio_error + expected_step_error(step_tolerance) &
         + expected_long_step_error(conditions, formula_ratio, hx, cells_per_step, samples, .false.)
   end function expected_ratio_error

   !> Error of Ad/Ai and responses in light contacts, over the square of hX. There the film is as thick as the bodies
   !> approach and does not come from the inlet: where the waves keep their amplitude, the error by the inlet nearly
   !> vanishes. With the fitted scheme 14 contacts (M = 4 to 23, H = 0.36 to 12, S = 0.8 and 1) have at most 1.1.
   elemental real(dp) function light_error(film, is_fitted)
      real(dp), intent(in) :: film             !! H(0,0)
      logical, intent(in) :: is_fitted         !! scheme
      light_error = merge(2, 8, is_fitted)*min(1.0_dp, film)
   end function light_error

   !> See `wave_x_factor`: by points on waves.
   elemental real(dp) function wave_x_error(points, slip)
      real(dp), intent(in) :: points           !! on a wave along X, see `resolution_t`
      real(dp), intent(in) :: slip             !! largest speed of a rough surface over the mean one
      wave_x_error = wave_x_factor/points**4 + slip_part(slip)/points**2
   end function wave_x_error

   !> By mesh sizes per wave along Y.
   elemental real(dp) function wave_y_error(points, slip, is_fitted)
      real(dp), intent(in) :: points           !! above 0
      real(dp), intent(in) :: slip             !! as in `wave_x_error`
      logical, intent(in) :: is_fitted         !! scheme
      if (is_fitted) then
         wave_y_error = fitted_y_factor(slip)/points**4
      else
         wave_y_error = wave_y_factor/points**2
      end if
   end function wave_y_error

   !> `wave_y_error` of the fitted scheme, times the fourth power of the points.
   elemental real(dp) function fitted_y_factor(slip)
      real(dp), intent(in) :: slip
      fitted_y_factor = fitted_wave_y_factor*(1 + fitted_wave_y_slip*abs(slip - 1))
   end function fitted_y_factor

   !> The mesh size in X on which waves leave as much of an error as `mesh` leaves without `wave_x_error`: the part by
   !> `mesh` grows with its square.
   elemental real(dp) function mesh_for_waves(mesh, waves, slip, error)
      real(dp), intent(in) :: mesh             !! mesh size
      real(dp), intent(in) :: waves            !! points on a wave are 1/(waves hX)
      real(dp), intent(in) :: slip             !! as in `wave_x_error`
      real(dp), intent(in) :: error            !! in all, above 0
      real(dp) :: by_square
      by_square = 1/mesh**2 + slip_part(slip)*waves**2/error
      mesh_for_waves = sqrt(2/(by_square + sqrt(by_square**2 + 4*wave_x_factor/error*waves**4)))
   end function mesh_for_waves

   !> The part of `wave_x_error` by slip, times the square of the points.
   elemental real(dp) function slip_part(slip)
      real(dp), intent(in) :: slip
      slip_part = slip_factor*max(0.0_dp, slip - 1)
   end function slip_part

   !> Error of H(0,0) in light contacts, over the square of hX: the film does not come from a steep inlet there.
   elemental real(dp) function light_film_error(film)
      real(dp), intent(in) :: film             !! H(0,0)
      light_film_error = min(1.0_dp, film)
   end function light_film_error

   !> Relative error of Ad/Ai by the step tolerance alone, on any grid.
   pure real(dp) function expected_step_error(step_tolerance)
      real(dp), intent(in) :: step_tolerance
      expected_step_error = step_tolerance_factor*step_tolerance
   end function expected_step_error

   !> Relative error of Ad/Ai by steps of dT = m hX with m above 1, theory eq. (E8): waves pass the inlet as on a mesh
   !> of m hX, and are carried along in steps of finite order.
   pure real(dp) function expected_long_step_error(conditions, formula_ratio, hx, cells_per_step, samples, is_fitted) &
      result(error)
      type(conditions_t), intent(in) :: conditions
      real(dp), intent(in) :: formula_ratio    !! see `expected_ratio_error`
      real(dp), intent(in) :: hx
      integer, intent(in) :: cells_per_step    !! m
      real(dp), intent(in) :: samples          !! time steps per wave
      logical, intent(in) :: is_fitted         !! scheme
      associate (m => real(cells_per_step, dp))
         error = (m**2 - 1)*step_by_inlet*(1 + step_by_slip*abs(conditions%slip_parameter - 1)) &
                 *ratio_scale(conditions, formula_ratio)*hx**2 &
                 + (1 - 1/m**2)*merge(fitted_step_by_waves/samples**4, step_by_waves/samples**3, is_fitted)
      end associate
   end function expected_long_step_error

   !> gamma M (1 - F)^(1/2), of which errors by the inlet are multiples.
   pure real(dp) function ratio_scale(conditions, formula_ratio)
      type(conditions_t), intent(in) :: conditions
      real(dp), intent(in) :: formula_ratio
      ratio_scale = conditions%steepness()*sqrt(max(0.0_dp, 1 - formula_ratio))
   end function ratio_scale

   pure real(dp) function ratio_factor(moves)
      logical, intent(in) :: moves
      ratio_factor = merge(moving_factor, standing_factor, moves)
   end function ratio_factor

   !> Largest mesh size in X that leaves at most `error`: of H(0,0), or of Ad/Ai by the mesh in X alone.
   pure real(dp) function largest_mesh(conditions, error, formula_ratio, moves)
      type(conditions_t), intent(in) :: conditions
      real(dp), intent(in) :: error                     !! relative, above 0
      real(dp), intent(in), optional :: formula_ratio   !! Ad/Ai of a wavy contact by the formula
      logical, intent(in), optional :: moves            !! whether its pattern moves, with formula_ratio
      if (present(formula_ratio) .and. present(moves)) then
         largest_mesh = sqrt(error/max(ratio_factor(moves)*ratio_scale(conditions, formula_ratio), tiny(1.0_dp)))
      else
         largest_mesh = sqrt(error/(film_factor*conditions%steepness()))
      end if
   end function largest_mesh

   !> Mesh sizes per wave along Y that leave at most `error` of Ad/Ai by waves along Y alone.
   elemental real(dp) function points_for(error, slip, is_fitted)
      real(dp), intent(in) :: error            !! relative, above 0
      real(dp), intent(in) :: slip             !! as in `wave_x_error`
      logical, intent(in) :: is_fitted         !! scheme
      if (is_fitted) then
         points_for = (fitted_y_factor(slip)/error)**0.25_dp
      else
         points_for = sqrt(wave_y_factor/error)
      end if
   end function points_for

   !> Counted work units of a steady state on a half domain, all levels included.
   pure real(dp) function steady_work_units(conditions, cells, is_newtonian, thinning_cost)
      type(conditions_t), intent(in) :: conditions
      integer, intent(in) :: cells            !! along X
      logical, intent(in) :: is_newtonian     !! the oil
      real(dp), intent(in) :: thinning_cost   !! see `thinning_t`
      steady_work_units = cost(steady_cost, conditions, cells)
      if (conditions%is_line()) steady_work_units = line_steady_work(conditions, cells)
      steady_work_units = steady_work_units*merge(1.0_dp, film_flow_cost(1)*thinning_cost, is_newtonian)
   end function steady_work_units

   !> Counted work units of a time step on a half domain.
   pure real(dp) function step_work_units(conditions, cells, is_newtonian, thinning_cost)
      type(conditions_t), intent(in) :: conditions
      integer, intent(in) :: cells            !! along X
      logical, intent(in) :: is_newtonian     !! the oil
      real(dp), intent(in) :: thinning_cost   !! see `thinning_t`
      step_work_units = cost(step_cost, conditions, cells)
      if (conditions%is_line()) step_work_units = line_step_cost
      step_work_units = step_work_units*merge(1.0_dp, film_flow_cost(2)*thinning_cost, is_newtonian)
   end function step_work_units

   !> c1 (cells/128)^c2 (gamma M/100)^c3
   pure real(dp) function cost(c, conditions, cells)
      real(dp), intent(in) :: c(3)
      type(conditions_t), intent(in) :: conditions
      integer, intent(in) :: cells
      cost = c(1)*(cells/128.0_dp)**c(2)*(conditions%gamma*conditions%m/100)**c(3)
   end function cost

   !> Work units of a steady state of a line contact. It grows with the load and with alpha pmax: alpha ph is
   !> proportional to L M^(1/2), and a film above the Hertzian approach, H > 1, spreads the pressure over H^(1/2).
   pure real(dp) function line_steady_work(conditions, cells)
      type(conditions_t), intent(in) :: conditions
      integer, intent(in) :: cells
      line_steady_work = line_work*(cells/128.0_dp)**line_cells_power &
                         *(1 + conditions%l*sqrt(conditions%m/(1 + line_film*expected_film(conditions)))/line_alpha &
                           + conditions%m/line_load)**line_power
   end function line_steady_work

end module ehlwave_accuracy_model
