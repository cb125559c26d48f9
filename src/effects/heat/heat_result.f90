!> Heat of the film and of both bodies, in the result of a case.
module ehlwave_heat_result
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ehlwave_bare_result, only: bare_result_t
   use ehlwave_case_definition, only: case_t
   use ehlwave_effect_result, only: after_friction, effect_result_t
   use ehlwave_energy, only: energy_t
   use ehlwave_full_multigrid, only: full_multigrid_t
   use ehlwave_grid, only: grid_t
   use ehlwave_hdf5_file, only: hdf5_file_t
   use ehlwave_heat_account_result, only: heat_account_t, warm_fields
   use ehlwave_heat_data, only: new_heat_scales
   use ehlwave_hierarchy, only: level_t
   use ehlwave_kinds, only: dp, no_value
   use ehlwave_planned_case, only: case_plan_t
   use ehlwave_quantity, only: quantity_list_t
   use ehlwave_rescue, only: rescue_t
   use ehlwave_shear_result, only: is_impossible
   use ehlwave_shear_stress, only: friction_at
   use ehlwave_solve_report, only: solve_limits_t
   use ehlwave_status, only: status_converged
   use ehlwave_text, only: to_text
   use ehlwave_warm_steady, only: solve_warm
   implicit none (type, external)
   private

   type, extends(effect_result_t), public :: heat_result_t
      type(heat_account_t) :: account
      real(dp), allocatable :: fields(:, :, :)       !! `warm_fields`, if fields are kept
   contains
      procedure, nopass :: place
      procedure :: solve
      procedure, private :: is_warm
      procedure :: describe_state
      procedure :: warning
      procedure :: film_error
      procedure :: steepening
      procedure :: add_own_errors
      procedure :: take_fields
      procedure :: write_fields
      procedure :: add_quantities
      procedure :: print
   end type heat_result_t

contains

   pure integer function place()
      place = after_friction
   end function place

   !> Let the oil be warm, from the isothermal state.
   subroutine solve(self, case, plan, multigrid, rescue, limits, coarse_tolerance, energy)
      class(heat_result_t), intent(inout) :: self
      type(case_t), intent(in) :: case
      type(case_plan_t), intent(in) :: plan
      type(full_multigrid_t), intent(inout) :: multigrid
      type(rescue_t), intent(inout) :: rescue
      type(solve_limits_t), intent(in) :: limits
      real(dp), intent(in) :: coarse_tolerance
      type(energy_t), intent(inout) :: energy

      if (.not. plan%effects%heat%is_given) return
      associate (level => multigrid%levels(size(multigrid%levels)), data => case%effects%heat%data)
         if (level%report%status /= status_converged) return
         self%account%isothermal_film = level%problem%grid%value_at_centre(level%state%h)
         self%account%isothermal_friction = friction_at(level%problem, level%state)
         if (is_impossible(self%account%isothermal_friction)) self%account%isothermal_friction = no_value
         call solve_warm(multigrid, rescue, new_heat_scales(data, case%oil%temperature_k, plan%conditions), &
                         data%levels, limits, coarse_tolerance, energy)
         if (level%report%status == status_converged) then
            call self%account%take(level%problem, level%state, energy)
         else
            call self%account%explain(energy)
         end if
      end associate
   end subroutine solve

   logical function is_warm(self)
      class(heat_result_t), intent(in) :: self
      is_warm = ieee_is_finite(self%account%isothermal_film)
   end function is_warm

   subroutine describe_state(self, name, failure)
      class(heat_result_t), intent(in) :: self
      character(len=:), allocatable, intent(inout) :: name, failure
      if (self%is_warm()) name = name//' with heat'
      if (allocated(self%account%unsettled)) failure = failure//self%account%unsettled
   end subroutine describe_state

   function warning(self, case, plan, grid) result(text)
      class(heat_result_t), intent(in) :: self
      type(case_t), intent(in) :: case
      type(case_plan_t), intent(in) :: plan
      type(grid_t), intent(in) :: grid
      character(len=:), allocatable :: text
      text = self%account%warning(case%effects%heat%data%follows_waves())
      if (.not. (self%is_warm() .and. plan%surfaces%is_rough())) return
      if (text /= '') text = text//'; '
      text = text//wave_text(self, case)
   end function warning

   !> How temperatures are known as waves pass.
   function wave_text(self, case) result(text)
      class(heat_result_t), intent(in) :: self
      type(case_t), intent(in) :: case
      character(len=:), allocatable :: text
      associate (frozen_error => self%account%frozen_error)
         if (case%effects%heat%data%follows_waves()) then
            text = 'in the march the oil has its own temperatures, both surfaces keep the smooth contact''s'
            if (case%response == 'both') text = text//'; the linear response has all of them from there'// &
               ', which leaves about '//to_text(frozen_error, 1)//' of Ai in its Ad/Ai'
         else
            text = 'temperatures stay those of the smooth contact as waves pass, which leaves about '// &
               to_text(frozen_error, 1)//" of Ai in Ad/Ai besides the errors (&heat wave_temperatures = 'carried' "// &
               'lets marches tell)'
         end if
      end associate
   end function wave_text

   real(dp) function film_error(self) result(error)
      class(heat_result_t), intent(in) :: self
      error = self%account%film_error()
   end function film_error

   real(dp) function steepening(self, film)
      class(heat_result_t), intent(in) :: self
      real(dp), intent(in) :: film
      steepening = 0
      if (self%is_warm()) steepening = max(0.0_dp, self%account%isothermal_film/film - 1)
   end function steepening

   subroutine add_own_errors(self, result)
      class(heat_result_t), intent(inout) :: self
      class(bare_result_t), intent(inout) :: result
      result%friction_error = result%friction_error + self%account%settling*result%shear%cancellation &
                              + self%account%levels_error
      result%central_film_error = result%central_film_error + self%film_error()
      result%minimum_film_error = result%minimum_film_error + self%film_error()
   end subroutine add_own_errors

   subroutine take_fields(self, plan, level, energy)
      class(heat_result_t), intent(inout) :: self
      type(case_plan_t), intent(in) :: plan
      type(level_t), intent(in) :: level
      type(energy_t), intent(in) :: energy
      if (allocated(level%problem%heat)) self%fields = warm_fields(level%problem, energy)
   end subroutine take_fields

   subroutine write_fields(self, file)
      class(heat_result_t), intent(in) :: self
      type(hdf5_file_t), intent(inout) :: file
      character(len=*), parameter :: &
         names(6) = [character(len=22) :: 'rise_mid_film_k', 'rise_mean_k', 'rise_wall_1_k', 'rise_wall_2_k', &
                     'heat_into_1_w_per_m2', 'heat_into_2_w_per_m2'], &
         of(6) = [character(len=56) :: 'rise of the temperature half-way across the film', &
                  'rise of the temperature, mean across the film', 'rise of the temperature of surface 1', &
                  'rise of the temperature of surface 2', 'heat flow into surface 1', 'heat flow into surface 2']
      integer :: i
      if (.not. allocated(self%fields)) return
      do i = 1, size(names)
         call file%write(trim(names(i)), self%fields(:, :, i), trim(merge('K   ', 'W/m2', i <= 4)), trim(of(i)), &
                         'x', 'y')
      end do
   end subroutine write_fields

   subroutine add_quantities(self, list, case, plan)
      class(heat_result_t), intent(in) :: self
      type(quantity_list_t), intent(inout) :: list
      type(case_t), intent(in) :: case
      type(case_plan_t), intent(in) :: plan
      character(len=3) :: watt
      character(len=1) :: wall
      logical :: is_warm
      integer :: i

      is_warm = plan%effects%heat%is_given
      associate (heat => self%account, data => case%effects%heat%data)
         watt = merge('W/m', 'W  ', plan%conditions%is_line())
         call list%add('isothermal_friction_coefficient', 'friction_coefficient without heat', &
            heat%isothermal_friction, exists=is_warm)
         call list%add('isothermal_central_film', 'central_film without heat', heat%isothermal_film, exists=is_warm)
         call list%add('largest_rise_mid_film_k', 'largest rise of the temperature half-way across the film', &
            heat%largest_mid_k, unit='K', exists=is_warm)
         call list%add('central_rise_mid_film_k', 'the same at the contact centre', heat%centre_mid_k, unit='K', &
            exists=is_warm)
         call list%add('largest_rise_mean_k', 'largest rise of the mean temperature across the film', &
            heat%largest_mean_k, unit='K', exists=is_warm)
         do i = 1, 2
            wall = merge('1', '2', i == 1)
            call list%add('largest_rise_wall_'//wall//'_k', 'largest rise of the temperature of surface '//wall, &
               heat%largest_wall_k(i), unit='K', exists=is_warm)
            call list%add('central_rise_wall_'//wall//'_k', 'the same at the contact centre', heat%centre_wall_k(i), &
               unit='K', exists=is_warm)
            call list%add('heat_into_body_'//wall, 'heat that flows into body '//wall//' under pressure', &
               heat%into_body_w(i), unit=trim(watt), exists=is_warm)
         end do
         call list%add('heat_of_shear', 'power dissipated by shear', heat%sheared_w, unit=trim(watt), exists=is_warm)
         call list%add('heat_of_compression', 'heat of compression less heat of expansion', heat%compressed_w, &
            unit=trim(watt), exists=is_warm)
         call list%add('heat_carried_by_oil', 'heat that the oil carries out of the film under pressure', &
            heat%carried_w, unit=trim(watt), exists=is_warm)
         call list%add('heat_levels_error', 'error of film and friction by the levels across the film, '// &
            'part of theirs', heat%levels_error, exists=is_warm)
         call list%add('heat_balance_error', 'heat that is missing over the largest part', heat%balance_error, &
            exists=is_warm)
         call list%add('frozen_heat_error', 'estimated error of Ad/Ai over Ai by temperatures that stay as waves '// &
            'pass; part of no other error', heat%frozen_error, exists=is_warm .and. case%is_wavy())
         call list%add('wave_temperatures', "temperatures as waves pass: 'frozen' at the smooth contact, or "// &
            "'carried', computed for the oil in time in marches", trim(merge(data%wave_temperatures, &
            repeat(' ', len(data%wave_temperatures)), is_warm .and. case%is_wavy())), &
            exists=is_warm .and. case%is_wavy())
      end associate
   end subroutine add_quantities

   subroutine print(self, unit, plan)
      class(heat_result_t), intent(in) :: self
      integer, intent(in) :: unit
      type(case_plan_t), intent(in) :: plan
      if (.not. self%is_warm()) return
      associate (h => self%account)
         write (unit, '(a)') 'Heat         without it H(0,0) = '//to_text(h%isothermal_film, 6)// &
            ', friction coefficient '//to_text(h%isothermal_friction, 5)
         write (unit, '(a)') '             largest rise mid-film '//to_text(h%largest_mid_k, 3)//' K, surfaces '// &
            to_text(h%largest_wall_k(1), 3)//' and '//to_text(h%largest_wall_k(2), 3)//' K; at the centre '// &
            to_text(h%centre_mid_k, 3)//', '//to_text(h%centre_wall_k(1), 3)//' and '// &
            to_text(h%centre_wall_k(2), 3)//' K'
         write (unit, '(a)') '             heat into bodies 1 and 2 '//to_text(h%into_body_w(1), 4)//' and '// &
            to_text(h%into_body_w(2), 4)//trim(merge(' W/m', ' W  ', plan%conditions%is_line()))// &
            ', heat balance '//to_text(h%balance_error, 2)
      end associate
   end subroutine print

end module ehlwave_heat_result
