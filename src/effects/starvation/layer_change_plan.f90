!> A layer of oil that changes in a march: the layer of the measurement, and its start.
module ehlwave_layer_change_plan
   use ehlwave_case_definition, only: case_t
   use ehlwave_conditions, only: conditions_t
   use ehlwave_formula, only: expected_film
   use ehlwave_gauss_legendre, only: gauss_rule_t, new_gauss_rule
   use ehlwave_hertz_gap, only: hertz_gap
   use ehlwave_kinds, only: dp
   use ehlwave_starvation_keys, only: starvation_keys_t
   implicit none (type, external)
   private
   public :: change_times, measured_share

   real(dp), parameter :: following_time = 3     !! T in which the film follows a change that has passed, but for the
                                                 !! oil that the inlet keeps

contains

   !> Layers with which a pattern is measured, over the steady layer: waves have the final layer; a measured surface
   !> has both, and so do waves with an additional linear response.
   elemental real(dp) function measured_share(case) result(share)
      type(case_t), intent(in) :: case
      type(starvation_keys_t) :: keys
      share = 1
      keys = case%effects%starvation
      if (.not. keys%layer_changes()) return
      if (case%is_measured() .or. case%response == 'both') then
         share = min(1.0_dp, keys%oil_change_factor)
      else if (.not. keys%oil_change_length > 0) then
         share = keys%oil_change_factor
      end if
   end function measured_share

   !> When the end of a change has passed a place, and from when on it should no longer move the film. In between the
   !> inlet empties, or fills: for about as long as the contact takes to pass the content of the gap between the contact
   !> and the meniscus, with the thicker of both layers. In 16 random changes (M = 40 to 250, L = 3 to 12, D = 1 to
   !> 0.25, r = 0.06 to 4.6) at most 1 per cent of Ad/Ai was left two periods later.
   pure subroutine change_times(keys, conditions, distance, x_min, outlet, passed, rest)
      type(starvation_keys_t), intent(in) :: keys
      type(conditions_t), intent(in) :: conditions
      real(dp), intent(in) :: distance  !! distance of the meniscus from the contact, with the thicker of both layers
      real(dp), intent(in) :: x_min, outlet    !! X of the inlet edge and of the place
      real(dp), intent(out) :: passed, rest    !! T
      type(gauss_rule_t) :: rule
      real(dp) :: half, volume
      integer :: k

      rule = new_gauss_rule(24)
      half = 0.5_dp*min(-1 - x_min, distance)
      volume = 0
      do k = 1, rule%n
         volume = volume + half*rule%weight(k)*hertz_gap(conditions, -1 - half*(1 + rule%node(k)), 0.0_dp, rule)
      end do
      passed = keys%oil_change_start + keys%oil_change_length + outlet - x_min
      rest = passed + following_time + volume/expected_film(conditions)
   end subroutine change_times

end module ehlwave_layer_change_plan
