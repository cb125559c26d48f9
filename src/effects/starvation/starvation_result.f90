!> A contact with too little oil, in the result of a case.
module ehlwave_starvation_result
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ehlwave_bare_result, only: bare_result_t
   use ehlwave_case_definition, only: case_t
   use ehlwave_effect_result, only: effect_result_t
   use ehlwave_energy, only: energy_t
   use ehlwave_error_factors, only: by_domain, by_grids, central_film
   use ehlwave_error_parts, only: error_parts_t
   use ehlwave_full_multigrid, only: full_multigrid_t
   use ehlwave_grid, only: grid_t
   use ehlwave_hdf5_file, only: hdf5_file_t
   use ehlwave_hierarchy, only: level_t
   use ehlwave_kinds, only: dp, no_value
   use ehlwave_march_settings, only: march_settings_t
   use ehlwave_oil_passage, only: follow_oil, oil_passage_t
   use ehlwave_mesh_errors, only: kind_of, richardson_error
   use ehlwave_planned_case, only: case_plan_t
   use ehlwave_quantity, only: quantity_list_t
   use ehlwave_rescue, only: rescue_t
   use ehlwave_solve_report, only: solve_limits_t
   use ehlwave_starvation, only: flooded_t, starve
   use ehlwave_starvation_plan, only: expected_meniscus_error
   use ehlwave_status, only: status_converged
   use ehlwave_text, only: to_text
   implicit none (type, external)
   private

   !> Least error of R over the film error, which counts up to `largest_film_error`: grids can agree by chance, and
   !> errors of film and flooded film mostly cancel in R.
   real(dp), parameter :: ratio_share = 0.1_dp, largest_film_error = 0.2_dp

   !> Values of flooded contacts are NaN.
   type, extends(effect_result_t), public :: starvation_result_t
      type(flooded_t) :: flooded                     !! the contact with plenty of oil, on all levels
      real(dp) :: oil_over_flooded = no_value        !! r at Y = 0
      real(dp) :: flooded_film = no_value            !! H(0,0) with plenty of oil
      real(dp) :: film_over_flooded = no_value       !! R
      real(dp) :: film_over_flooded_error = no_value   !! estimated relative discretisation error, from grids
      real(dp) :: short_edge = 0                     !! error of the film, relative, by an inlet edge that the full gap
                                                     !! reaches
      real(dp) :: solve_over_flooded = no_value      !! counted work of the starved solve over the flooded solve
      type(oil_passage_t) :: passage                 !! oil passage of the smooth contact
      real(dp), allocatable :: content(:, :)         !! theta of the last solution, if fields are kept
   contains
      procedure :: solve
      procedure :: take
      procedure :: warning
      procedure :: edge_error
      procedure :: lacks_oil_outside
      procedure :: add_own_errors
      procedure :: add_errors
      procedure :: advice
      procedure, nopass :: set_march
      procedure :: take_fields
      procedure :: write_fields
      procedure :: add_quantities
      procedure :: print
   end type starvation_result_t

contains

   subroutine solve(self, case, plan, multigrid, rescue, limits, coarse_tolerance, energy)
      class(starvation_result_t), intent(inout) :: self
      type(case_t), intent(in) :: case
      type(case_plan_t), intent(in) :: plan
      type(full_multigrid_t), intent(inout) :: multigrid
      type(rescue_t), intent(inout) :: rescue
      type(solve_limits_t), intent(in) :: limits
      real(dp), intent(in) :: coarse_tolerance
      type(energy_t), intent(inout) :: energy
      associate (oil => plan%effects%starvation%oil)
         if (oil%is_short() .and. multigrid%levels(size(multigrid%levels))%report%status == status_converged) &
            call starve(rescue, multigrid, oil, limits, coarse_tolerance, self%flooded)
      end associate
   end subroutine solve

   subroutine take(self, plan, levels, work)
      class(starvation_result_t), intent(inout) :: self
      type(case_plan_t), intent(in) :: plan
      type(level_t), intent(in) :: levels(:)
      real(dp), intent(in) :: work
      real(dp) :: ratios(size(levels))
      integer :: n

      if (.not. plan%effects%starvation%oil%is_short()) return
      n = size(levels)
      associate (level => levels(n), grid => levels(n)%problem%grid, flooded => self%flooded)
         ratios = levels%central_film/flooded%film
         self%flooded_film = flooded%film(n)
         self%film_over_flooded = ratios(n)
         self%film_over_flooded_error = by_grids(central_film, kind_of(plan%is_fitted, plan%conditions%is_line()))* &
                                        richardson_error(cmplx(ratios(n:1:-1), kind=dp))
         self%oil_over_flooded = level%given%supply(minloc(abs(grid%y), 1) - 1)/flooded%oil(n)
         self%solve_over_flooded = work/flooded%work - 1
         call follow_oil(level%problem, level%given, level%state, self%passage)
         ! a longer domain has a thicker film, at most the flooded film
         if (self%lacks_oil_outside(grid)) self%short_edge = max(0.0_dp, flooded%film(n)/level%central_film - 1)
      end associate
   end subroutine take

   !> Whether the gap fills at the inlet edge, which has less oil than gap.
   logical function lacks_oil_outside(self, grid)
      class(starvation_result_t), intent(in) :: self
      type(grid_t), intent(in) :: grid
      lacks_oil_outside = ieee_is_finite(self%film_over_flooded) .and. ieee_is_finite(self%passage%meniscus_x)
      if (lacks_oil_outside) lacks_oil_outside = self%passage%meniscus_x < grid%x(0) + 1.5_dp*grid%hx
   end function lacks_oil_outside

   function warning(self, case, plan, grid) result(text)
      class(starvation_result_t), intent(in) :: self
      type(case_t), intent(in) :: case
      type(case_plan_t), intent(in) :: plan
      type(grid_t), intent(in) :: grid
      character(len=:), allocatable :: text
      text = ''
      if (self%lacks_oil_outside(grid)) text = 'the gap is full from the inlet edge on, which has less oil than '// &
         'gap: a longer domain (&grid x_min below '//to_text(grid%x(0), 4)//') has a thicker film'
   end function warning

   real(dp) function edge_error(self) result(error)
      class(starvation_result_t), intent(in) :: self
      error = self%short_edge
   end function edge_error

   !> Least error of R: a share of the film error, since grids can agree by chance.
   subroutine add_own_errors(self, result)
      class(starvation_result_t), intent(inout) :: self
      class(bare_result_t), intent(inout) :: result
      if (ieee_is_finite(self%film_over_flooded_error)) &
         self%film_over_flooded_error = max(self%film_over_flooded_error, &
                                            ratio_share*min(largest_film_error, result%central_film_error))
   end subroutine add_own_errors

   !> For the film the part is the error of R, found from grids like the film error.
   subroutine add_errors(self, k, case, plan, film, ratio)
      class(starvation_result_t), intent(in) :: self
      integer, intent(in) :: k
      type(case_t), intent(in) :: case
      type(case_plan_t), intent(in) :: plan
      type(error_parts_t), intent(inout) :: film, ratio
      logical :: changes
      real(dp) :: distance

      if (.not. plan%effects%starvation%oil%is_short()) return
      if (ieee_is_finite(self%film_over_flooded_error)) then
         film%by_effect(k) = self%film_over_flooded_error
         film%mesh = max(0.0_dp, film%mesh - film%by_effect(k))
      end if
      changes = case%effects%starvation%layer_changes()
      if (changes) ratio%by_effect(k) = plan%expected%by_effect(k)   ! waves are measured with another layer
      if (changes .or. .not. (ieee_is_finite(self%passage%meniscus_x) .and. ieee_is_finite(ratio%mesh))) return
      distance = max(plan%hx, -1 - self%passage%meniscus_x)
      if (ratio%mesh > 0) ratio%by_effect(k) = expected_meniscus_error(plan%hx/distance)
   end subroutine add_errors

   function advice(self, plan, film_error) result(text)
      class(starvation_result_t), intent(in) :: self
      type(case_plan_t), intent(in) :: plan
      real(dp), intent(in) :: film_error
      character(len=:), allocatable :: text
      text = ''
      if (by_domain(central_film)*self%short_edge > 0.5_dp*film_error) &
         text = 'the gap is full from the inlet edge on: take &grid x_min below '//to_text(plan%x_min, 4)
   end function advice

   subroutine set_march(case, settings)
      type(case_t), intent(in) :: case
      type(march_settings_t), intent(inout) :: settings
      associate (keys => case%effects%starvation)
         settings%oil_factor = keys%oil_change_factor
         settings%oil_change_start = keys%oil_change_start
         settings%oil_change_length = keys%oil_change_length
      end associate
   end subroutine set_march

   subroutine take_fields(self, plan, level, energy)
      class(starvation_result_t), intent(inout) :: self
      type(case_plan_t), intent(in) :: plan
      type(level_t), intent(in) :: level
      type(energy_t), intent(in) :: energy
      type(oil_passage_t) :: last
      if (plan%effects%starvation%oil%is_short()) call follow_oil(level%problem, level%given, level%state, last)
      if (allocated(last%content)) self%content = last%content
   end subroutine take_fields

   subroutine write_fields(self, file)
      class(starvation_result_t), intent(in) :: self
      type(hdf5_file_t), intent(inout) :: file
      if (.not. allocated(self%content)) return
      call file%write('content', self%content, '1', 'theta, share of the gap that oil fills, last solution', 'x', 'y')
      call file%write('layer_offered', self%passage%offered, '1', &
         'oil that enters across Y, layer over c, smooth contact', 'y')
      call file%write('layer_behind', self%passage%behind, '1', &
         'oil that leaves behind the contact across Y, layers of both surfaces over c, smooth contact', 'y')
   end subroutine write_fields

   subroutine add_quantities(self, list, case, plan)
      class(starvation_result_t), intent(in) :: self
      type(quantity_list_t), intent(inout) :: list
      type(case_t), intent(in) :: case
      type(case_plan_t), intent(in) :: plan
      logical :: is_short

      is_short = plan%effects%starvation%oil%is_short()
      call list%add('film_over_flooded', 'R, central_film over flooded_central_film', self%film_over_flooded, &
                    exists=is_short)
      call list%add('film_over_flooded_error', 'estimated relative error of film_over_flooded by the mesh', &
                    self%film_over_flooded_error, exists=is_short, error_of='film over flooded R')
      call list%add('flooded_central_film', 'H(0,0) of the flooded contact with the same domain and edges', &
                    self%flooded_film, exists=is_short)
      call list%add('oil_offered', 'r at Y = 0, oil offered over the flow of the flooded contact', &
                    self%oil_over_flooded, exists=is_short)
      call list%add('mass_balance_error', 'oil lost or gained over oil that enters', self%passage%balance_error, &
                    exists=is_short)
      call list%add('side_flow', 'share of the oil that leaves over the sides', self%passage%side_flow, &
                    exists=is_short)
      call list%add('meniscus_x', 'X at Y = 0 from which on the gap is full', self%passage%meniscus_x, &
                    exists=is_short)
      call list%add('starved_over_flooded_work', 'counted work of the starved solve over the flooded solve', &
                    self%solve_over_flooded, exists=is_short)
   end subroutine add_quantities

   subroutine print(self, unit, plan)
      class(starvation_result_t), intent(in) :: self
      integer, intent(in) :: unit
      type(case_plan_t), intent(in) :: plan
      character(len=:), allocatable :: meniscus

      if (.not. ieee_is_finite(self%film_over_flooded)) return
      meniscus = 'gap full from the inlet edge'
      if (ieee_is_finite(self%passage%meniscus_x)) meniscus = 'gap full from X = '//to_text(self%passage%meniscus_x, 4)
      write (unit, '(a)') 'Starvation   film over flooded R = '//to_text(self%film_over_flooded, 5)// &
         ', oil over flooded r = '//to_text(self%oil_over_flooded, 5)//', flooded H(0,0) = '// &
         to_text(self%flooded_film, 6)
      write (unit, '(a)') '             '//meniscus//', over the sides '//to_text(100*self%passage%side_flow, 3)// &
         ' % of the oil, mass balance '//to_text(self%passage%balance_error, 2)
   end subroutine print

end module ehlwave_starvation_result
