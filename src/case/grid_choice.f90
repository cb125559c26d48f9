!> The grid of a case: cells as given, or the smallest of a list of sizes that resolves inlet sweep and waves.
module ehlwave_grid_choice
   use ehlwave_accuracy_model, only: expected_long_step_error, expected_step_error, fitted_share, largest_mesh, &
      light_error, mesh_for_waves, points_for
   use ehlwave_case_definition, only: case_t, usual_largest_cells
   use ehlwave_conditions, only: conditions_t
   use ehlwave_effects_plan, only: effects_plan_t
   use ehlwave_error_factors, only: amplitude_ratio
   use ehlwave_formula, only: amplitude_formula, anisotropy_factor, expected_film, wave_parameter_v
   use ehlwave_kinds, only: dp
   use ehlwave_linear_range, only: expected_nonlinearity
   use ehlwave_mesh_errors, only: kind_of, least_error
   use ehlwave_resolution, only: coarsest_inlet, coarsest_side, fewest_points_per_wave, &
      inlet_length, times_as_wide, wanted_inlet, wanted_line_inlet, wanted_points_per_wave
   use ehlwave_roughness, only: roughness_t
   use ehlwave_surfaces, only: surfaces_t
   use ehlwave_text, only: to_text
   implicit none (type, external)
   private
   public :: accurate_mesh, choose_grid, formula_ratio, smallest_size

   !> Waves that a mesh has to resolve.
   type, public :: pattern_t
      logical :: has_ratio = .false.     !! the accuracy applies to Ad/Ai
      logical :: moves = .false.
      real(dp) :: waves = 0              !! largest wave number over 2 pi along X, times the slip above 1 and the
                                         !! root of the share that errors of waves have in the result's error
      real(dp) :: slip = 1               !! largest speed over the mean one
   end type pattern_t

   !> Products of 2, 3, 5 and 7 that can be halved four times: transforms and multigrid are fast on them.
   integer, parameter :: sizes(25) = [64, 80, 96, 112, 128, 160, 192, 224, 256, 320, 384, 448, 512, 640, 768, 896, &
      1024, 1280, 1536, 2048, 2560, 3072, 4096, 6144, 8192]
   ! Shares of the accuracy: mesh in X, waves along Y.
   real(dp), parameter :: slip_without_formula = 0.5_dp  !! |S - 1| from which the formula of pure rolling is unreliable
                                                          !! nothing
   real(dp), parameter :: share_of_mesh = 0.75_dp, share_of_waves = 0.2_dp
   !> Share of the mesh of what the other parts leave to waves in time: their estimate has a margin. Other parts may
   !> take `largest_others`: with more no mesh would do.
   real(dp), parameter :: share_of_march = 0.45_dp, largest_others = 0.6_dp
   real(dp), parameter :: share_of_proof = 0.85_dp        !! share of the least declared error of waves in time

contains

   !> Cells of the whole domain; 1 along Y for a line contact.
   subroutine choose_grid(case, conditions, surfaces, is_fitted, steepness, effects, cells_per_step, cells_x, &
                          cells_y, reason)
      type(case_t), intent(in) :: case
      type(conditions_t), intent(in) :: conditions
      type(surfaces_t), intent(in) :: surfaces
      logical, intent(in) :: is_fitted         !! scheme
      real(dp), intent(in) :: steepness        !! steepness of the inlet, see `case_plan_t`
      type(effects_plan_t), intent(in) :: effects
      integer, intent(in) :: cells_per_step    !! dT/hX of a march, 1 for shorter steps and without a march
      integer, intent(out) :: cells_x, cells_y
      character(len=:), allocatable, intent(out) :: reason   !! why so many, for people
      real(dp) :: points, share       ! share: of errors of waves
      character(len=:), allocatable :: why_x, why_y
      integer :: largest

      largest = case%largest_cells
      if (largest == 0) largest = usual_largest_cells
      points = merge(fewest_points_per_wave, wanted_points_per_wave, case%accuracy > 0)
      share = surfaces%share_in_film(expected_film(conditions))
      call choose_x()
      cells_y = 1
      reason = why_x
      if (conditions%is_line()) return
      call choose_y()
      reason = 'X: '//why_x//'; Y: '//why_y

   contains

      subroutine choose_x()
         character(len=:), allocatable :: why
         real(dp) :: each, inlet, length, mesh, wanted, waves   ! waves: see `pattern_t`
         integer :: n

         cells_x = case%cells_x
         why_x = 'given, or its default'
         if (cells_x > 0) return
         length = case%x_max - case%x_min
         inlet = merge(coarsest_inlet, wanted_inlet, case%accuracy > 0)
         if (conditions%is_line() .and. .not. case%accuracy > 0) inlet = wanted_line_inlet
         inlet = times_as_wide(is_fitted)*inlet
         mesh = inlet*inlet_length(conditions)
         if (.not. is_fitted) mesh = mesh/sqrt(steepness)
         wanted = length/mesh
         why_x = 'for hX over the inlet length <= '//to_text(inlet, 2)
         waves = 0
         do n = 1, size(surfaces%list)
            associate (wave => surfaces%list(n))
               if (.not. wave%wavelength_x > 0) cycle
               waves = max(waves, sqrt(share)*max(1.0_dp, wave%slip)/wave%wavelength_x)
               each = points
               if (wave%moves()) each = max(each, fewest_points_per_wave*cells_per_step)
               if (each*length*max(1.0_dp, wave%slip)/wave%wavelength_x <= wanted) cycle
               wanted = each*length*max(1.0_dp, wave%slip)/wave%wavelength_x
               why_x = 'for '//to_text(each, 3)//' points per wave'
            end associate
         end do
         call effects%limit_mesh(case%accuracy, surfaces%is_rough(), mesh, why)
         if (length/mesh > wanted) why_x = why
         wanted = max(wanted, length/mesh)
         if (case%accuracy > 0) then
            mesh = accurate_mesh(case, conditions, pattern_t(surfaces%is_rough() .and. .not. surfaces%is_measured(), &
               surfaces%moves(), waves, surfaces%largest_slip()), steepness, is_fitted, cells_per_step)
            if (length/mesh > wanted) then
               wanted = length/mesh
               why_x = 'for an accuracy of '//to_text(case%accuracy, 3)
            end if
         end if
         cells_x = smallest_size(wanted, largest)
         if (cells_x < wanted) why_x = why_x//', limited'
      end subroutine choose_x

      subroutine choose_y()
         real(dp) :: inlet, length, mesh, wanted
         integer :: n

         cells_y = case%cells_y
         why_y = 'given, or its default'
         if (cells_y > 0) return
         length = 2*case%y_max
         wanted = 0.5_dp*cells_x*length/(case%x_max - case%x_min)
         why_y = 'for hY <= 2 hX'
         if (is_fitted) then
            inlet = times_as_wide(is_fitted)*coarsest_side
            mesh = inlet*inlet_length(conditions)
            if (length/mesh > wanted) why_y = 'for hY over the inlet length <= '//to_text(inlet, 2)
            wanted = max(wanted, length/mesh)
         end if
         if (case%accuracy > 0) points = max(points, points_for(share_of_waves*case%accuracy/share, &
            surfaces%largest_slip(), is_fitted))
         do n = 1, size(surfaces%list)
            associate (wave => surfaces%list(n))
               if (.not. wave%wavelength_y > 0) cycle
               if (points*length/wave%wavelength_y <= wanted) cycle
               wanted = points*length/wave%wavelength_y
               why_y = 'for '//to_text(points, 3)//' points per wave'
            end associate
         end do
         cells_y = smallest_size(wanted, largest)
         if (cells_y < wanted) why_y = why_y//', limited'
      end subroutine choose_y

   end subroutine choose_grid

   !> The largest hX for the accuracy that a case asks for, by its models of the error. Flattened standing patterns have
   !> larger relative errors than their model; measured by coarser grids (Ad/Ai = 0.1 to 0.2): 1.8 to 3.5 times.
   pure real(dp) function accurate_mesh(case, conditions, pattern, steepness, is_fitted, cells_per_step)
      type(case_t), intent(in) :: case
      type(conditions_t), intent(in) :: conditions
      type(pattern_t), intent(in) :: pattern
      real(dp), intent(in) :: steepness          !! steepness of the inlet for the scheme, see `case_plan_t`
      logical, intent(in) :: is_fitted           !! scheme
      integer, intent(in) :: cells_per_step      !! dT/hX, see `choose_grid`
      integer, parameter :: halvings = 30
      real(dp) :: by_model, left, provable, ratio, room, step
      real(dp) :: share                          ! of the mesh without the error of longer steps
      integer :: n

      accurate_mesh = largest_mesh(conditions, case%accuracy)
      left = mesh_room(case)
      ratio = 1
      if (pattern%has_ratio) then
         ratio = formula_ratio(case, conditions, pattern%moves)
         accurate_mesh = largest_mesh(conditions, left, ratio, pattern%moves)
      end if
      accurate_mesh = accurate_mesh/sqrt(steepness)
      if (pattern%waves > 0 .and. is_fitted) &
         accurate_mesh = mesh_for_waves(accurate_mesh, pattern%waves, pattern%slip, left)
      if (.not. pattern%has_ratio) return
      if (case%response == 'harmonic') return
      room = room_of_proof()
      provable = provable_mesh(left/accurate_mesh**2)
      if (.not. pattern%moves) accurate_mesh = ratio**0.25_dp*accurate_mesh
      by_model = accurate_mesh
      accurate_mesh = min(by_model, provable)
      if (cells_per_step <= 1) return
      share = 0
      step = 1
      do n = 1, halvings
         step = 0.5_dp*step
         if (fits((share + step)*accurate_mesh)) share = share + step
      end do
      accurate_mesh = share*accurate_mesh

   contains

      !> Whether a mesh leaves room for the error of longer steps, by its model and by its declared error.
      pure logical function fits(hx)
         real(dp), intent(in) :: hx
         real(dp) :: error
         error = by_steps(hx)
         fits = (hx/by_model)**2 + error/left <= 1 .and. (hx/provable)**2 + error/room <= 1
      end function fits

      !> Declared error that waves in time may have by the mesh and by longer steps.
      pure real(dp) function room_of_proof()
         type(roughness_t) :: both(2)
         real(dp) :: others
         both = case%surfaces()
         others = expected_others(case)
         if (any(both%wavelength_y_over_a > 0)) others = others + least_error(amplitude_ratio, &
            kind_of(is_fitted, conditions%is_line()), share_of_waves*case%accuracy)
         room_of_proof = share_of_proof*max((1 - largest_others)*case%accuracy, case%accuracy - others)
      end function room_of_proof

      !> The largest hX whose declared error can be as small as the accuracy, however well coarser grids agree.
      pure real(dp) function provable_mesh(expected)
         real(dp), intent(in) :: expected     !! error by the mesh over the square of hX
         real(dp) :: all_of_it
         all_of_it = expected + light_error(expected_film(conditions), is_fitted)
         provable_mesh = sqrt(room/least_error(amplitude_ratio, kind_of(is_fitted, conditions%is_line()), all_of_it))
      end function provable_mesh

      !> Error by the time steps on a mesh.
      pure real(dp) function by_steps(hx)
         real(dp), intent(in) :: hx
         real(dp) :: by_oil      ! steepness
         by_oil = steepness/merge(fitted_share, 1.0_dp, is_fitted)
         by_steps = expected_long_step_error(conditions, ratio, hx*sqrt(by_oil), cells_per_step, &
                                             1/(max(pattern%waves, tiny(1.0_dp))*cells_per_step*hx), is_fitted)
      end function by_steps

   end function accurate_mesh

   !> Error of Ad/Ai that an accuracy leaves to the mesh and to the steps that follow it.
   pure real(dp) function mesh_room(case)
      type(case_t), intent(in) :: case
      mesh_room = share_of_mesh*case%accuracy
      if (case%has_ratio() .and. case%response /= 'harmonic') &
         mesh_room = share_of_march*(case%accuracy - min(largest_others*case%accuracy, expected_others(case)))
   end function mesh_room

   !> Error of waves in time by their amplitude and by the step tolerance.
   pure real(dp) function expected_others(case)
      type(case_t), intent(in) :: case
      expected_others = expected_nonlinearity(case) + expected_step_error(case%step_tolerance)
   end function expected_others

   !> The smallest of the usual numbers of cells that is enough, the largest allowed if none is.
   pure integer function smallest_size(wanted, largest)
      real(dp), intent(in) :: wanted
      integer, intent(in) :: largest
      integer :: i
      do i = 1, size(sizes)
         smallest_size = sizes(i)
         if (smallest_size >= wanted*(1 - 1e-9_dp) .or. smallest_size >= largest) exit
      end do
   end function smallest_size

   !> Ad/Ai by theory eq. (18), for the error model: reduced under slip, where the inlet launches a wave of its own.
   !> The smaller value of two rough surfaces.
   pure real(dp) function formula_ratio(case, conditions, moves)
      type(case_t), intent(in) :: case
      type(conditions_t), intent(in) :: conditions
      logical, intent(in) :: moves      !! whether the pattern does
      type(roughness_t) :: both(2)
      integer :: n
      both = case%surfaces()
      formula_ratio = of(both(1))
      do n = 2, size(both)
         if (both(n)%is_wavy()) formula_ratio = min(formula_ratio, of(both(n)))
      end do
      if (moves) formula_ratio = formula_ratio*max(0.0_dp, 1 - abs(conditions%slip_parameter - 1)/slip_without_formula)

   contains

      pure real(dp) function of(waves)
         type(roughness_t), intent(in) :: waves
         of = amplitude_formula(anisotropy_factor(waves%wavelength_x_over_a, waves%wavelength_y_over_a) &
                                *wave_parameter_v(conditions, waves%wavelength_over_a))
      end function of

   end function formula_ratio

end module ehlwave_grid_choice
