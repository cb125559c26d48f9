!> The method of a case that leaves the choice: Newton's method, or FAS multigrid where that takes less work.
module ehlwave_method_choice
   use ehlwave_accuracy_model, only: expected_film_error
   use ehlwave_case_definition, only: case_t
   use ehlwave_effect_keys, only: by_fas
   use ehlwave_conditions, only: conditions_t
   use ehlwave_kinds, only: dp
   use ehlwave_oil, only: barus
   use ehlwave_scheme_choice, only: is_fitted
   implicit none (type, external)
   private
   public :: choose_method

   ! Measured (study heavy, postprocess/record): on finer grids Newton's method takes more and more GMRES steps, and
   ! more the heavier the load or the steeper the end of the pressure, FAS 3 to 6 cycles.
   integer, parameter :: large_grid = 512        !! cells along a side, above which FAS takes less whatever the load
   real(dp), parameter :: heavy_load = 1000      !! gamma M, from which on it does on so many along each side

   ! Tolerance over the error of the film that is expected by the mesh, and its bounds. A residual of FAS lies at single
   ! nodes of inlet edge and spike. Measured (M = 20 to 2000, 256^2 to 2048^2 cells, tolerances of 1e-4 and 1e-3): it
   ! leaves at most a hundredth of itself in H(0,0), and a three-thousandth where it lies at a spike that is steeper
   ! than any grid.
   real(dp), parameter :: share_of_error = 5, share_at_spike = 50
   real(dp), parameter :: loosest = 1.5e-3_dp, tightest = 1e-6_dp

contains

   !> Method, cycle and, where none is given, the tolerance of a case with method = 'auto'.
   subroutine choose_method(case, conditions)
      type(case_t), intent(inout) :: case
      type(conditions_t), intent(in) :: conditions
      real(dp) :: mesh_error

      if (case%method /= 'auto') return
      case%method = 'newton'
      if (.not. (suits_multigrid(case) .and. gains(case, conditions))) return
      case%method = 'fas'
      if (.not. case%has_free_tolerance) return
      mesh_error = case%accuracy
      if (case%cells_x > 0) mesh_error = expected_film_error(conditions, (case%x_max - case%x_min)/case%cells_x)
      case%tolerance = max(tightest, min(loosest, mesh_error* &
                       merge(share_at_spike, share_of_error, case%oil%viscosity_law == barus)))
   end subroutine choose_method

   !> Whether all that a case asks of its solver is a steady state that FAS solves. With the fitted scheme it does not
   !> always (M = 1000, D = 1: on 512^2 cells in 5 cycles, on 768^2 not). Newton's method takes 28 GMRES steps there.
   logical function suits_multigrid(case)
      type(case_t), intent(in) :: case
      suits_multigrid = case%radius_ratio_d > 0 .and. case%oil%is_newtonian() .and. case%deformation /= 'mlmi' &
         .and. .not. (case%sensitivities .or. case%effects%refuse(by_fas) &
                    .or. case%is_measured() .or. is_fitted(case)) &
         .and. .not. case%end_time > 0 .and. .not. abs(case%load_factor - 1) > 0 &
         .and. (case%response == 'harmonic' .or. .not. case%is_wavy())
   end function suits_multigrid

   !> Whether FAS takes less work.
   pure logical function gains(case, conditions)
      type(case_t), intent(in) :: case
      type(conditions_t), intent(in) :: conditions
      integer :: cells(2)

      cells = [case%cells_x, case%cells_y]
      where (cells == 0) cells = min(large_grid, case%largest_cells)   ! the plan chooses
      gains = any(cells > large_grid)
      if (conditions%steepness() >= heavy_load .or. case%oil%viscosity_law == barus) &
         gains = gains .or. all(cells >= large_grid)
   end function gains

end module ehlwave_method_choice
