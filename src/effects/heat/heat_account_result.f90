!> How warm a contact is, and where its heat goes.
module ehlwave_heat_account_result
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ehlwave_carried_heat, only: carried_heat
   use ehlwave_contact_problem, only: contact_problem_t
   use ehlwave_energy, only: energy_t, fast
   use ehlwave_kinds, only: dp, no_value
   use ehlwave_shear_stress, only: least_pressure
   use ehlwave_state, only: state_t
   use ehlwave_text, only: to_text
   implicit none (type, external)
   private
   public :: warm_fields

   !> NaN of an isothermal contact. Heat is in W, of a line contact in W/m.
   type, public :: heat_account_t
      real(dp) :: isothermal_friction = no_value, isothermal_film = no_value   !! friction, H(0,0) without it
      real(dp) :: largest_mid_k = no_value, largest_wall_k(2) = no_value       !! rises over T0
      real(dp) :: centre_mid_k = no_value, centre_wall_k(2) = no_value         !! values at X = Y = 0
      real(dp) :: largest_mean_k = no_value                                    !! largest mean across the film
      real(dp) :: into_body_w(2) = no_value                                    !! heat into bodies 1 and 2
      real(dp) :: sheared_w = no_value, compressed_w = no_value                !! heat of shear and of compression
      real(dp) :: carried_w = no_value                                         !! carried off by the oil
      real(dp) :: settling = 0                      !! relative change of friction in the last round
      character(len=:), allocatable :: unsettled    !! why film and temperatures do not agree, if they do not
      real(dp) :: balance_error = no_value                 !! the missing part, over the largest of these
      real(dp) :: levels_error = 0                         !! relative error of film and friction by the levels
      real(dp) :: frozen_error = no_value  !! error of Ad/Ai over Ai by frozen temperatures as waves pass
      real(dp) :: peclet(2) = huge(1.0_dp)                 !! Peclet numbers of `heat_scales_t`
   contains
      procedure :: take
      procedure :: film_error
      procedure :: explain
      procedure :: warning
   end type heat_account_t

   real(dp), parameter :: no_oil_bears = 0.15_dp    ! friction coefficient
   ! Error by the levels: measured with 12 and 24 of them
   real(dp), parameter :: level_error = 1e-4_dp, usual_levels = 12
   integer, parameter :: level_order = 3
   ! Error of Ad/Ai over Ai, over beta times the largest rise half-way across: 0.003 to 0.25, once 0.5, was measured
   ! between marches with temperatures carried on and frozen, as complex numbers
   real(dp), parameter :: by_frozen_heat = 0.25_dp

contains

   !> Relative error of the film by temperatures that have not settled and by the levels across it.
   pure real(dp) function film_error(self)
      class(heat_account_t), intent(in) :: self
      film_error = self%settling + self%levels_error
   end function film_error

   !> Account of the last march at a solution. The balance covers the film under pressure: heat carried off is the
   !> flow of oil through its edges times the rise there.
   subroutine take(self, problem, state, energy)
      class(heat_account_t), intent(inout) :: self
      type(contact_problem_t), intent(in) :: problem
      type(state_t), intent(in) :: state
      type(energy_t), intent(in) :: energy
      real(dp), dimension(0:problem%grid%nx, 0:problem%grid%ny) :: field, mid
      logical :: bears(0:problem%grid%nx, 0:problem%grid%ny)
      integer :: n, wall
      real(dp) :: unit

      n = energy%levels%n
      self%settling = energy%heat_difference
      self%peclet = energy%scales%peclet
      associate (ln => problem%heat%ln_fluidity)
         self%levels_error = level_error*maxval(maxval(ln, 1) - minval(ln, 1))**2*(usual_levels/n)**level_order
      end associate
      bears = bearing_film(state%p)
      bears([0, problem%grid%nx], :) = .false.        ! nodes of the edges are no cells of the film
      bears(:, problem%grid%last_row + 1:) = .false.
      bears(:, :problem%grid%first_row - 1) = .false.
      associate (grid => problem%grid, rise => energy%rise, c => problem%conditions)
         mid = middle_of(rise)
         self%largest_mid_k = maxval(mid, mask=bears)
         self%centre_mid_k = grid%value_at_centre(mid)
         field = problem%heat%mean_rise
         self%frozen_error = by_frozen_heat*self%largest_mid_k*problem%heat%thinning(0, 0, grid%first_row)
         self%largest_mean_k = maxval(field, mask=bears)
         self%largest_wall_k = [maxval(rise(n, :, :)), maxval(rise(0, :, :))]
         field = rise(n, :, :)
         self%centre_wall_k(1) = grid%value_at_centre(field)
         field = rise(0, :, :)
         self%centre_wall_k(2) = grid%value_at_centre(field)
         ! a unit of heat flow times the area of a cell, of a line times its length
         unit = energy%scales%flux*c%a_m*merge(1/grid%hy, c%b_m, c%is_line())
         do wall = 1, 2
            self%into_body_w(wall) = unit*grid%integral(merge(energy%into_wall(wall, :, :), 0.0_dp, bears))
         end do
         self%sheared_w = unit*grid%integral(merge(energy%shear%shear_heat/state%h, 0.0_dp, bears))
         self%compressed_w = unit*grid%integral(merge(energy%shear%pressure_heat/state%h, 0.0_dp, bears))
         field = carried_heat(energy, grid, c%elliptic%kappa)
         self%carried_w = unit*grid%integral(merge(field, 0.0_dp, bears))
      end associate
      self%balance_error = abs(self%sheared_w + self%compressed_w - self%carried_w - sum(self%into_body_w)) &
                           /max(abs(self%sheared_w), abs(self%compressed_w), abs(self%carried_w), tiny(unit))
   end subroutine take

   !> Film under pressure, of each row from the inlet to where it ruptures: beyond, solvers leave up to 1e-7 at single
   !> nodes, whose oil is not conserved.
   pure function bearing_film(p) result(bears)
      real(dp), intent(in) :: p(0:, 0:)
      logical :: bears(0:ubound(p, 1), 0:ubound(p, 2))
      integer :: i, j

      bears = p > least_pressure
      do j = 0, ubound(p, 2)
         do i = 1, ubound(p, 1)
            if (.not. bears(i, j) .and. bears(i - 1, j)) exit
         end do
         bears(i:, j) = .false.
      end do
   end function bearing_film

   !> Surface that is slow against conduction along it, in a march that has its heat change in time; '' where none is.
   function warning(self, is_carried) result(text)
      class(heat_account_t), intent(in) :: self
      logical, intent(in) :: is_carried
      character(len=:), allocatable :: text
      integer :: slow
      text = ''
      slow = minloc(self%peclet, 1)
      if (.not. is_carried .or. self%peclet(slow) >= fast) return
      text = 'surface '//to_text(slow)//' is slow, Peclet number '//to_text(self%peclet(slow), 2)//' (at least '// &
             to_text(fast, 1)//' needed in the march): its rise changes too much as waves pass, since the change '// &
             'is conducted into its depth alone; the steady rise is right'
   end function warning

   !> Report unsettled values, and the change needed.
   subroutine explain(self, energy)
      class(heat_account_t), intent(inout) :: self
      type(energy_t), intent(in) :: energy

      if (ieee_is_finite(energy%difference)) then
         self%unsettled = '; in the last round heat changed H(0,0) by '//to_text(energy%film_difference, 2)// &
            ', the heat of shear by '//to_text(energy%heat_difference, 2)//', temperatures by '// &
            to_text(energy%difference, 2)//' of themselves: '
      else
         self%unsettled = '; temperatures grew without bound: '
      end if
      if (self%isothermal_friction > no_oil_bears) then
         self%unsettled = self%unsettled//'without heat the stress is '//to_text(self%isothermal_friction, 2)// &
            " of the pressure, more than oils bear; use flow_law = 'eyring' or 'carreau', or shear_limit_over_pressure"
      else
         self%unsettled = self%unsettled//'use more cells along X, or a smaller slide_to_roll_ratio'
      end if
   end subroutine explain

   !> Rise half-way across the film.
   pure function middle_of(rise) result(mid)
      real(dp), intent(in) :: rise(0:, 0:, 0:)                  !! (0:levels, 0:nx, 0:ny)
      real(dp) :: mid(size(rise, 2), size(rise, 3))
      associate (m => ubound(rise, 1)/2)
         mid = rise(m, :, :)
         if (modulo(ubound(rise, 1), 2) == 1) &
            mid = (9*(rise(m, :, :) + rise(m + 1, :, :)) - rise(m - 1, :, :) - rise(m + 2, :, :))/16
      end associate
   end function middle_of

   !> Fields of rises, K: half-way across the film, in the mean, of surfaces 1 and 2; heat into these, W/m2.
   pure function warm_fields(problem, energy) result(fields)
      type(contact_problem_t), intent(in) :: problem
      type(energy_t), intent(in) :: energy
      real(dp), allocatable :: fields(:, :, :)
      associate (rise => energy%rise, nx => problem%grid%nx, ny => problem%grid%ny)
         allocate (fields(0:nx, 0:ny, 6))
         fields(:, :, 1) = middle_of(rise)
         fields(:, :, 2) = problem%heat%mean_rise
         fields(:, :, 3) = rise(ubound(rise, 1), :, :)
         fields(:, :, 4) = rise(0, :, :)
         fields(:, :, 5) = energy%scales%flux*energy%into_wall(1, :, :)
         fields(:, :, 6) = energy%scales%flux*energy%into_wall(2, :, :)
      end associate
   end function warm_fields

end module ehlwave_heat_account_result
