!> The scheme of the Reynolds equation of a case: averaged, or fitted to steep inlets, theory eq. (D11) to (D13).
module ehlwave_scheme_choice
   use ehlwave_accuracy_model, only: fitted_share
   use ehlwave_case_definition, only: case_t, roughness_t
   use ehlwave_effect_keys, only: by_fitted_scheme
   use ehlwave_case_lubricant, only: case_lubricant
   use ehlwave_conditions, only: conditions_t
   use ehlwave_errors, only: error_t, raise
   use ehlwave_grid_choice, only: accurate_mesh
   use ehlwave_kinds, only: dp
   use ehlwave_resolution, only: coarsest_inlet, fewest_points_per_wave, inlet_length, times_as_wide
   use ehlwave_thinning, only: new_thinning, thinning_t
   implicit none (type, external)
   private
   public :: averaged_cells, check_scheme, choose_scheme, is_fitted

   ! Measured with accuracy = 0.01 (M = 100 to 10,000, L = 12.05, D = 1 and 0.07, smooth and the response to waves of
   ! 0.5 a): where the averaged scheme takes 384 cells along X or more, the fitted one takes 0.01 to 0.68 of its work
   ! with all finer runs; below it took up to 2.2 times as much, for short waves in wide contacts.
   ! Of 14 random contacts with Ree-Eyring oils (M = 300 to 3500, S = 0.5 to 1.6) 11 take it, and all are within 0.01.
   real(dp), parameter :: most_averaged = 256      !! cells along X, up to which the averaged scheme is taken
   real(dp), parameter :: largest_share = 0.5_dp   !! of them that the fitted scheme may take

contains

   !> The scheme of a case that leaves the choice: fitted where an accuracy is asked for that it reaches with clearly
   !> fewer cells. What has truncated edges keeps the averaged scheme, as the results that are there.
   subroutine choose_scheme(case, conditions)
      type(case_t), intent(inout) :: case
      type(conditions_t), intent(in) :: conditions
      real(dp) :: averaged

      if (case%scheme /= 'auto' .or. .not. suits(case)) return
      if (.not. case%accuracy > 0 .or. case%cells_x > 0 .or. case%edges == 'truncated' .or. conditions%is_line() &
          .or. case%is_measured() .or. case%second%is_measured()) return
      if (any(case%method == ['fas  ', 'petsc'])) return   ! FAS does not always find its steady states
      averaged = averaged_cells(case, conditions)
      if (averaged > most_averaged .and. cells(case, conditions, .true.) <= largest_share*averaged) &
         case%scheme = 'fitted'
   end subroutine choose_scheme

   !> Cells along X that the accuracy asked for takes with the averaged scheme.
   real(dp) function averaged_cells(case, conditions)
      type(case_t), intent(in) :: case
      type(conditions_t), intent(in) :: conditions
      averaged_cells = cells(case, conditions, .false.)
   end function averaged_cells

   !> The same with either scheme.
   real(dp) function cells(case, conditions, fitted)
      type(case_t), intent(in) :: case
      type(conditions_t), intent(in) :: conditions
      logical, intent(in) :: fitted
      type(thinning_t) :: thinning
      real(dp) :: mesh, waves

      thinning = new_thinning(case_lubricant(case, conditions), conditions, case%oil%flow_exponent())
      waves = max(wave_number(case%roughness_t), wave_number(case%second))*max(1.0_dp, conditions%slip_parameter)
      mesh = accurate_mesh(case, conditions, case%has_ratio(), waves > 0 .and. conditions%slip_parameter > 0, &
                           merge(waves, 0.0_dp, fitted), &
                           thinning%steepness*merge(fitted_share, 1.0_dp, fitted))
      mesh = min(mesh, times_as_wide(fitted)*coarsest_inlet*inlet_length(conditions))
      cells = (case%x_max - case%x_min)*max(1/mesh, waves*fewest_points_per_wave)
   end function cells

   !> Waves per length along X, 0 where there are none.
   pure real(dp) function wave_number(waves)
      type(roughness_t), intent(in) :: waves
      wave_number = 0
      if (waves%is_wavy() .and. waves%wavelength_x_over_a > 0) wave_number = 1/waves%wavelength_x_over_a
   end function wave_number

   !> Refuse the fitted scheme where it is not written.
   subroutine check_scheme(case, error)
      type(case_t), intent(in) :: case
      type(error_t), allocatable, intent(inout) :: error
      if (is_fitted(case) .and. .not. suits(case)) call raise(error, "&solver scheme = 'fitted' is written "// &
         "without heat, for flooded contacts: take 'averaged', or remove the key")
   end subroutine check_scheme

   !> Whether the case has the fitted scheme.
   pure logical function is_fitted(case)
      type(case_t), intent(in) :: case
      is_fitted = case%scheme == 'fitted'
   end function is_fitted

   !> Whether the fitted scheme is written for what the case asks.
   logical function suits(case)
      type(case_t), intent(in) :: case
      suits = .not. case%effects%refuse(by_fitted_scheme)
   end function suits

end module ehlwave_scheme_choice
