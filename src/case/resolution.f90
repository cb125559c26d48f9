!> Whether a grid, its domain and the time step resolve a case: theory eq. (E6).
module ehlwave_resolution
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
   use ehlwave_conditions, only: conditions_t
   use ehlwave_formula, only: expected_film
   use ehlwave_hertz_gap, only: gap_rule, hertz_gap
   use ehlwave_kinds, only: dp
   use ehlwave_surfaces, only: surfaces_t
   use ehlwave_text, only: to_text
   implicit none (type, external)
   private
   public :: judge_resolution, has_room, inlet_length, inlet_gap, touching_reason, closing_reason, &
      add_reason, times_as_wide

   ! Points per wave, in each direction and in time.
   real(dp), parameter, public :: fewest_points_per_wave = 8        !! points that resolve it, see theory eq. (E6)
   real(dp), parameter, public :: wanted_points_per_wave = 16  !! points of a chosen grid, unless an accuracy decides
   real(dp), parameter, public :: telling_points_per_wave = 4  !! points of a coarser grid that still shows an error

   ! Mesh sizes over the inlet length.
   real(dp), parameter, public :: coarsest_inlet = 0.25_dp          !! largest hX that resolves it,
   real(dp), parameter, public :: coarsest_side = 0.4_dp  !! largest hY: measured, see judge_resolution
   real(dp), parameter, public :: wanted_inlet = 0.2_dp             !! hX of a chosen grid, unless an accuracy decides,
   real(dp), parameter, public :: wanted_line_inlet = 0.1_dp        !! hX for a line contact, which costs little
   real(dp), parameter, public :: telling_inlet = 0.6_dp            !! largest hX of a coarser grid that still shows an
                                                                    !! error

   !> Times as wide as all of these a mesh may be with the fitted scheme. Measured: with 0.45 to 0.5 inlet lengths the
   !> central film is 0.3 to 2 per cent off (M = 1000 to 10,000, L = 2.5 to 20, D = 1 to 0.07), with 0.9 5 per cent.
   real(dp), parameter :: fitted_inlet = 2

   real(dp), parameter, public :: narrowest_inlet_gap = 4/3.0_dp    !! gap at the inlet boundary over the film thickness
   real(dp), parameter, public :: flooded_inlet_gap = 8             !! from which on the film does not feel the boundary
   real(dp), parameter, public :: thick_film_gap = 40               !! gap needed on all sides of a film above 1

   real(dp), parameter, public :: touching_film = 0.03_dp           !! smallest film over the smooth central one, see
                                                                    !! there

   type, public :: resolution_t
      real(dp) :: inlet = 0                !! hX over the length of the inlet pressure sweep
      real(dp) :: points_x = 0             !! mesh sizes per wave along X, 0 without variation along X
      real(dp) :: points_y = 0             !! mesh sizes per wave along Y
      real(dp) :: samples = 0              !! time steps per period, 0 in steady cases
      real(dp) :: inlet_gap = 0            !! see inlet_gap
      logical :: is_resolved = .true.
      character(len=:), allocatable :: reason   !! coarse quantity and its remedy; '' when resolved
   end type resolution_t

contains

   !> Length of the inlet pressure sweep in X: piezoviscous inlet, (L/(gamma M))^(1/2), or isoviscous inlet,
   !> lambdabar^(2/5) (Snoeijer, Eggers and Venner 2013), whichever is longer; at most half the contact.
   !>
   !> Measured (central film on 64^2 to 512^2 cells against the extrapolated film, M = 30 to 3000, D = 1): with hX =
   !> lambdabar^(2/5)/4 it is 4 to 6 per cent off for L = 0 to 3; (L/(gamma M))^(1/2) alone requires grids up to ten
   !> times finer there.
   !>
   !> gamma M is the `steepness` of the conditions. Measured (L = 11, M = 100): with hX = 0.17 of it the central film is
   !> 7 per cent off.
   pure real(dp) function inlet_length(conditions)
      type(conditions_t), intent(in) :: conditions
      inlet_length = min(1.0_dp, max(sqrt(conditions%l/conditions%steepness()), conditions%lambdabar**0.4_dp))
   end function inlet_length

   !> Gap of the dry Hertzian contact at the inlet boundary on the axis, in units of the film thickness of the formula.
   !> Measured against domains four times as long, L = 0 and 12.05, D = 0.005 to 1: the film is 5 per cent too thin at
   !> 8, 8 to 20 per cent at 2 to 3, 20 to 25 per cent at 1.2, and is unrelated to the flooded film below 0.1. That
   !> holds for H < 1. A thicker film hardly deforms the surfaces, and pressure spreads far: M = 3, D = 1 is still 34
   !> per cent off at 3.5 on the sides and 12 per cent at 37.
   real(dp) function inlet_gap(conditions, x_min)
      type(conditions_t), intent(in) :: conditions
      real(dp), intent(in) :: x_min   !! X of the inlet boundary, -1 or less
      inlet_gap = gap_over_film(conditions, x_min, 0.0_dp)
   end function inlet_gap

   real(dp) function gap_over_film(conditions, x, y)
      type(conditions_t), intent(in) :: conditions
      real(dp), intent(in) :: x, y    !! X, Y
      gap_over_film = hertz_gap(conditions, x, y, gap_rule())/expected_film(conditions)
   end function gap_over_film

   !> Why a solution with this smallest film is not resolved; '' when it is, or when there is no smooth film (NaN).
   !>
   !> Waves higher than the film of the side lobes or the outlet press it out where they pass. Measured (Ai = 60 to 90
   !> per cent, waves of a quarter of a, 128 and 256 cells): time steps converge down to 0.04 to 2 per cent of the
   !> central film, then none does, on the finer grid either.
   function touching_reason(smallest_film, central_film) result(reason)
      real(dp), intent(in) :: smallest_film   !! smallest of all solutions of the case, H
      real(dp), intent(in) :: central_film    !! smooth H(0,0); NaN: none
      character(len=:), allocatable :: reason
      reason = thin_reason('the waves touch the other surface: the film falls to ', smallest_film, central_film, &
                           'smooth central one', 'reduce amplitude_over_film')
   end function touching_reason

   !> Reason for smooth surfaces. A line contact with a film of 1.1 per cent at its outlet had 2.4 on twice the cells.
   function closing_reason(smallest_film, central_film) result(reason)
      real(dp), intent(in) :: smallest_film   !! H of the smooth contact,
      real(dp), intent(in) :: central_film    !! H(0,0); NaN: none
      character(len=:), allocatable :: reason
      reason = thin_reason('the smallest film is ', smallest_film, central_film, 'central one', 'use more cells')
   end function closing_reason

   function thin_reason(found, smallest_film, central_film, whole, advice) result(reason)
      real(dp), intent(in) :: smallest_film, central_film   !! NaN: none, which is no reason
      character(len=*), intent(in) :: found, whole, advice
      character(len=:), allocatable :: reason
      reason = ''
      if (ieee_is_nan(central_film)) return
      if (smallest_film < touching_film*central_film) reason = found//to_text(100*smallest_film/central_film, 2)// &
         ' per cent of the '//whole//', at least '//to_text(100*touching_film, 2)//' needed: '//advice
   end function thin_reason

   !> Append a reason, if any, to earlier reasons.
   pure subroutine add_reason(reasons, reason)
      character(len=:), allocatable, intent(inout) :: reasons
      character(len=*), intent(in) :: reason
      if (len(reasons) > 0 .and. len(reason) > 0) reasons = reasons//'; '
      reasons = reasons//reason
   end subroutine add_reason

   !> Width of the mesh allowed by the inlet, over the averaged scheme's.
   pure real(dp) function times_as_wide(is_fitted)
      logical, intent(in) :: is_fitted   !! scheme
      times_as_wide = merge(fitted_inlet, 1.0_dp, is_fitted)
   end function times_as_wide

   !> Whether a film above 1 has all the domain that it needs, at X = x_min and at Y = y_max.
   logical function has_room(conditions, x_min, y_max)
      type(conditions_t), intent(in) :: conditions
      real(dp), intent(in) :: x_min, y_max
      has_room = .true.
      if (expected_film(conditions) <= 1) return
      has_room = inlet_gap(conditions, x_min) >= thick_film_gap
      if (conditions%is_line()) return
      if (has_room) has_room = gap_over_film(conditions, 0.0_dp, y_max) >= thick_film_gap
   end function has_room

   !> Points per wave and per inlet sweep, the length of the inlet, and the verdict on them.
   function judge_resolution(conditions, surfaces, x_min, y_max, hx, hy, dt, is_fitted) result(self)
      type(conditions_t), intent(in) :: conditions
      type(surfaces_t), intent(in) :: surfaces
      real(dp), intent(in) :: x_min    !! X of the inlet boundary
      real(dp), intent(in) :: y_max    !! half the width of the domain
      real(dp), intent(in) :: hx, hy   !! mesh sizes in X and Y, hY of a line contact 0
      real(dp), intent(in) :: dt       !! time step, 0 in steady cases
      logical, intent(in), optional :: is_fitted   !! scheme; absent: averaged
      type(resolution_t) :: self
      real(dp) :: coarsest, length
      integer :: n

      self%reason = ''
      length = inlet_length(conditions)
      self%inlet = hx/length
      coarsest = 1
      if (present(is_fitted)) coarsest = times_as_wide(is_fitted)
      call judge_inlet(self%inlet, coarsest*coarsest_inlet, 'hX')
      ! Measured at M = 3000, D = 1: with hY = 0.5 inlet lengths no solution is found where 0.25 has one (L = 12.05);
      ! with 0.31 the central film is 0.1 per cent off, but the smallest, in the side lobes, by a factor of two (L =
      ! 30).
      call judge_inlet(hy/length, coarsest*coarsest_side, 'hY')
      self%inlet_gap = inlet_gap(conditions, x_min)
      if (.not. self%inlet_gap >= narrowest_inlet_gap) call add_reason(self%reason, &
         'the film is as thick as the gap at x_min (ratio '//to_text(self%inlet_gap, 3)// &
         ', at least '//to_text(narrowest_inlet_gap, 3)//' needed): take x_min farther out')
      if (.not. has_room(conditions, x_min, y_max)) call add_reason(self%reason, 'the film, H = '// &
         to_text(expected_film(conditions), 3)//' by the formula, is thicker than the Hertzian approach and needs '// &
         'a gap of '//to_text(thick_film_gap, 3)// &
         ' times that at x_min and y_max: such a contact is better solved as rigid')
      do n = 1, size(surfaces%list)
         associate (wave => surfaces%list(n))
            ! with slip the pattern also excites waves of length lambda/S that travel with the mean speed
            if (wave%is_present .and. wave%wavelength_x > 0) &
               call judge(wave%wavelength_x/hx/max(1.0_dp, abs(wave%slip)), 'points per wave along X', self%points_x)
            if (wave%is_present .and. wave%wavelength_y > 0 .and. hy > 0) &   ! a line has its waves exactly
               call judge(wave%wavelength_y/hy, 'points per wave along Y', self%points_y)
            if (dt > 0 .and. wave%moves()) call judge(wave%period()/dt, 'time steps per wave', self%samples)
         end associate
      end do
      self%is_resolved = len(self%reason) == 0

   contains

      !> Note a mesh size, over the inlet length, that is above the largest.
      pure subroutine judge_inlet(share, largest, what)
         real(dp), intent(in) :: share, largest
         character(len=*), intent(in) :: what
         if (share > largest) call add_reason(self%reason, what//' over the inlet length = '//to_text(share, 3)// &
            ' is above '//to_text(largest, 3)//': use '//what//' <= '//to_text(largest*length, 3))
      end subroutine judge_inlet

      !> Note the fewest of all surfaces.
      pure subroutine judge(points, what, fewest)
         real(dp), intent(in) :: points
         character(len=*), intent(in) :: what
         real(dp), intent(inout) :: fewest   !! so far, 0: none
         fewest = merge(min(points, fewest), points, fewest > 0)
         if (points < fewest_points_per_wave - 1e-9_dp) call add_reason(self%reason, &
            to_text(points, 3)//' '//what//', at least '//to_text(fewest_points_per_wave, 3)//' needed')
      end subroutine judge

   end function judge_resolution

end module ehlwave_resolution
