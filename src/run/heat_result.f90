!> How warm a contact is, and where its heat goes.
module ehlwave_heat_result
   use ehlwave_conditions, only: conditions_t
   use ehlwave_contact_problem, only: contact_problem_t
   use ehlwave_energy, only: energy_t
   use ehlwave_kinds, only: dp, no_value
   use ehlwave_shear_stress, only: least_pressure
   use ehlwave_state, only: state_t
   implicit none (type, external)
   private

   !> NaN of an isothermal contact. Heat is in W, of a line contact in W/m.
   type, public :: heat_result_t
      real(dp) :: isothermal_friction = no_value, isothermal_film = no_value   !! friction coefficient, H(0,0) without heat
      real(dp) :: largest_mid_k = no_value, largest_wall_k(2) = no_value       !! rises over T0
      real(dp) :: centre_mid_k = no_value, centre_wall_k(2) = no_value         !! the same at X = Y = 0
      real(dp) :: largest_mean_k = no_value                                    !! of the mean across the film
      real(dp) :: into_body_w(2) = no_value                                    !! heat into bodies 1 and 2
      real(dp) :: sheared_w = no_value, compressed_w = no_value                !! heat of shear and of compression
      real(dp) :: carried_w = no_value                                         !! carried off by the oil
      real(dp) :: balance_error = no_value                                     !! what is missing, over the largest of these
   contains
      procedure :: take
   end type heat_result_t

contains

   !> Account of the last march at a solution. The balance is that of the film under pressure: heat carried off is the
   !> flow of oil through its edges times the rise there.
   pure subroutine take(self, problem, state, energy)
      class(heat_result_t), intent(inout) :: self
      type(contact_problem_t), intent(in) :: problem
      type(state_t), intent(in) :: state
      type(energy_t), intent(in) :: energy
      real(dp), dimension(0:problem%grid%nx, 0:problem%grid%ny) :: field, mid
      logical :: bears(0:problem%grid%nx, 0:problem%grid%ny)
      integer :: n, wall
      real(dp) :: unit

      n = energy%levels%n
      bears = state%p > least_pressure
      bears([0, problem%grid%nx], :) = .false.        ! nodes of the edges are no cells of the film
      bears(:, problem%grid%last_row + 1:) = .false.
      bears(:, :problem%grid%first_row - 1) = .false.
      associate (grid => problem%grid, rise => energy%rise, c => problem%conditions)
         mid = rise(n/2, :, :)
         if (modulo(n, 2) == 1) mid = (9*(rise(n/2, :, :) + rise(n/2 + 1, :, :)) - rise(n/2 - 1, :, :) &
                                       - rise(n/2 + 2, :, :))/16
         self%largest_mid_k = maxval(mid, mask=bears)
         self%centre_mid_k = grid%value_at_centre(mid)
         field = problem%heat%mean_rise
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
         field = energy%carried(grid, c%elliptic%kappa)
         self%carried_w = unit*grid%integral(merge(field, 0.0_dp, bears))
      end associate
      self%balance_error = abs(self%sheared_w + self%compressed_w - self%carried_w - sum(self%into_body_w)) &
                           /max(abs(self%sheared_w), abs(self%compressed_w), abs(self%carried_w), tiny(unit))
   end subroutine take

end module ehlwave_heat_result
