!> The scheme of the Reynolds equation of a case: averaged, or fitted to steep inlets, theory eq. (D11) to (D13).
module ehlwave_scheme_choice
   use ehlwave_accuracy_model, only: fitted_share
   use ehlwave_case_definition, only: case_t, largest_line_cells
   use ehlwave_effect_keys, only: by_fitted_scheme, by_long_steps
   use ehlwave_case_lubricant, only: case_lubricant
   use ehlwave_conditions, only: conditions_t
   use ehlwave_errors, only: error_t, raise
   use ehlwave_grid_choice, only: accurate_mesh, pattern_t, smallest_size
   use ehlwave_kinds, only: dp
   use ehlwave_resolution, only: coarsest_inlet, fewest_points_per_wave, inlet_length, times_as_wide
   use ehlwave_roughness, only: roughness_t
   use ehlwave_thinning, only: new_thinning, thinning_t
   implicit none (type, external)
   private
   public :: averaged_cells, check_scheme, choose_scheme, is_fitted, least_work_step, takes_long_steps

   ! Measured with accuracy = 0.01 (M = 100 to 10,000, L = 12.05, D = 1 and 0.07, smooth and the response to waves of
   ! 0.5 a): where the averaged scheme takes 384 cells along X or more, the fitted scheme takes 0.01 to 0.68 of its
   ! work with all finer runs; below it takes up to 2.2 times as much, for short waves in wide contacts. In 14 random
   ! contacts with Ree-Eyring oils (M = 300 to 3500, S = 0.5 to 1.6) 11 take it, and all are within 0.01.
   ! Linear responses (40 random contacts, M = 10 to 3,000, L = 3 to 20, D = 1 to 0.05, waves of 0.2 to 3 a, S = 0.7 to
   ! 1.4, accuracy 0.003 to 0.03): with at most half of the cells along X it takes 0.05 to 0.73 of the time, with as
   ! many nodes 1.2 to 1.8 times the time.
   real(dp), parameter :: most_averaged = 256      !! cells along X, up to which smooth contacts stay averaged
   real(dp), parameter :: largest_share = 0.5_dp   !! share of the cells that the fitted scheme may take
   ! Work of a march relative to the averaged scheme with dT = hX on the same cells. Measured (12 contacts, M =
   ! 20 to 1000, 0.25 to 2 a, 64 to 192 cells along X): 1.1 to 1.2 for the fitted scheme, 0.51 to 0.75 for dT = 2 hX.
   real(dp), parameter, public :: fitted_work = 1.15_dp, long_step_work = 0.62_dp
   integer, parameter, public :: longest_step = 2          !! cells: longer steps of equal error save nothing

contains

   !> The scheme of a case that leaves the choice: fitted where an accuracy is asked for that it reaches with clearly
   !> fewer cells, in marches with less work, or on cells given that are too few without it. Cases with truncated edges
   !> keep the averaged scheme.
   subroutine choose_scheme(case, conditions)
      type(case_t), intent(inout) :: case
      type(conditions_t), intent(in) :: conditions
      real(dp) :: averaged

      if (case%scheme /= 'auto' .or. .not. suits(case)) return
      if (.not. case%accuracy > 0 .or. case%edges == 'truncated') return
      if (.not. case%marches() .and. conditions%is_line()) return
      if (any(case%method == ['fas  ', 'petsc'])) return   ! FAS does not always find its steady states
      if (case%cells_x > 0) then
         averaged = averaged_cells(case, conditions)
         if (averaged > case%cells_x .and. cells(case, conditions, .true., 1) < averaged) case%scheme = 'fitted'
         return
      else if (case%marches() .and. case%is_rough()) then
         if (march_work(case, conditions, .true.) < march_work(case, conditions, .false.)) case%scheme = 'fitted'
         return
      end if
      averaged = smallest_size(averaged_cells(case, conditions), largest_line_cells)
      if (.not. (averaged > most_averaged .or. case%has_ratio())) return
      if (smallest_size(cells(case, conditions, .true., 1), largest_line_cells) <= largest_share*averaged) &
         case%scheme = 'fitted'
   end subroutine choose_scheme

   !> Relative work of a march with its best time step.
   real(dp) function march_work(case, conditions, fitted)
      type(case_t), intent(in) :: case
      type(conditions_t), intent(in) :: conditions
      logical, intent(in) :: fitted
      march_work = work(case, conditions, fitted, least_work_step(case, conditions, fitted))
   end function march_work

   !> dT/hX of a march on cells that are free: `longest_step` where that takes less work for the accuracy, else 1.
   integer function least_work_step(case, conditions, fitted) result(step)
      type(case_t), intent(in) :: case
      type(conditions_t), intent(in) :: conditions
      logical, intent(in) :: fitted
      step = 1
      if (case%time_step_over_cell > 0) then
         step = max(1, nint(case%time_step_over_cell))
      else if (takes_long_steps(case)) then
         if (work(case, conditions, fitted, longest_step) < work(case, conditions, fitted, 1)) step = longest_step
      end if
   end function least_work_step

   !> Whether a march may take steps longer than hX. The linear response has the frequency of steps of one cell, and
   !> line contacts lose up to 60 per cent of Ad/Ai with steps of two (M = 200, L = 10, 128 cells).
   logical function takes_long_steps(case)
      type(case_t), intent(in) :: case
      takes_long_steps = case%moves() .and. case%response == 'transient' .and. case%load_balance == 'force_balance' &
         .and. case%radius_ratio_d > 0 .and. .not. case%effects%refuse(by_long_steps)
   end function takes_long_steps

   !> Relative work of a march, from its nodes and steps.
   real(dp) function work(case, conditions, fitted, cells_per_step)
      type(case_t), intent(in) :: case
      type(conditions_t), intent(in) :: conditions
      logical, intent(in) :: fitted
      integer, intent(in) :: cells_per_step
      work = real(smallest_size(cells(case, conditions, fitted, cells_per_step), largest_line_cells), dp)**3 &
             *merge(fitted_work, 1.0_dp, fitted)*merge(1.0_dp, long_step_work, cells_per_step == 1)
   end function work

   !> Cells along X that the accuracy asked for takes with the averaged scheme.
   real(dp) function averaged_cells(case, conditions)
      type(case_t), intent(in) :: case
      type(conditions_t), intent(in) :: conditions
      averaged_cells = cells(case, conditions, .false., 1)
   end function averaged_cells

   !> Cells along X that the accuracy asked for takes.
   real(dp) function cells(case, conditions, fitted, cells_per_step)
      type(case_t), intent(in) :: case
      type(conditions_t), intent(in) :: conditions
      logical, intent(in) :: fitted              !! scheme
      integer, intent(in) :: cells_per_step      !! dT/hX of a march
      type(pattern_t) :: pattern
      type(thinning_t) :: thinning
      real(dp) :: mesh

      thinning = new_thinning(case_lubricant(case, conditions), conditions, case%oil%flow_exponent())
      pattern%has_ratio = case%has_ratio()
      pattern%moves = case%moves()
      pattern%slip = max(1.0_dp, conditions%slip_parameter)
      if (case%is_pair()) pattern%slip = max(pattern%slip, 2 - conditions%slip_parameter)
      pattern%waves = maxval(wave_number(case%surfaces()))*pattern%slip
      mesh = accurate_mesh(case, conditions, pattern, thinning%steepness*merge(fitted_share, 1.0_dp, fitted), fitted, &
                           cells_per_step)
      mesh = min(mesh, times_as_wide(fitted)*coarsest_inlet*inlet_length(conditions))
      cells = (case%x_max - case%x_min)*max(1/mesh, pattern%waves*fewest_points_per_wave*cells_per_step)
   end function cells

   !> Waves per length along X, 0 where there are none.
   elemental real(dp) function wave_number(waves)
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

   !> Whether the fitted scheme supports the case.
   logical function suits(case)
      type(case_t), intent(in) :: case
      suits = .not. case%effects%refuse(by_fitted_scheme)
   end function suits

end module ehlwave_scheme_choice
