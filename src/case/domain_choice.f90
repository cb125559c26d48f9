!> Errors by the edges of a domain, and how large a domain an accuracy needs.
module ehlwave_domain_choice
   use ehlwave_case_definition, only: case_t
   use ehlwave_conditions, only: conditions_t
   use ehlwave_error_factors, only: by_domain, central_film, response
   use ehlwave_far_field, only: far_field_t, new_far_field, rising_exponent
   use ehlwave_film_flow, only: film_flow_t
   use ehlwave_film_rules, only: across_film_t
   use ehlwave_formula, only: moes_film_formula
   use ehlwave_grid, only: strip_width
   use ehlwave_kinds, only: dp
   use ehlwave_resolution, only: has_room
   use ehlwave_rheology, only: rheology_t
   use ehlwave_roughness, only: roughness_t
   implicit none (type, external)
   private
   public :: chosen_scale, expected_domain_errors, may_enlarge, scale_domain

   ! Measured, domains of (-2.5, 1.5, 2) to (-40, 8, 24): P = 0 at the edges leaves 0.55 to 0.75 of the thickening alpha
   ! q of the inlet edge for M = 20 to 500, and the load outside in the power by which the film of the formula falls
   ! with the load (M = 4.2, L = 0, r0 = 10: 17 %). Flooded edges leave 0.005 to 0.035 of the first and 0.1 of the
   ! second. Ad/Ai has 0.15 to 0.4 of the error of the film with P = 0, about as much as the film with flooded edges (D
   ! = 0.3, M = 100: 0.18 and 0.25 %). Oils that do not thicken have an inlet, too, so flooded edges have 4 + alpha in
   ! place of alpha, as the far field at r = 1. Of 122 random contacts (M = 5 to 1000, D = 0 to 1, Newtonian, thinning,
   ! isoviscous; domains of two and four times the size) films were off by at most 1.15 times what is expected; with
   ! alpha, isoviscous, by up to 8 times.
   real(dp), parameter :: pressure_factor = 0.65_dp, flooded_pressure_share = 0.04_dp, flooded_load_share = 0.1_dp
   real(dp), parameter :: ratio_share = 0.4_dp
   !> Factor on the viscosity lost by shear at the inlet edge. One contact exceeded it 1.6 times (M = 48, L = 15,
   !> D = 0.04, Ree-Eyring).
   real(dp), parameter :: thinned_margin = 1.6_dp
   real(dp), parameter :: wave_factor = 0.25_dp, slip_factor = 2   !! see `share_of_waves`
   real(dp), parameter :: share_of_accuracy = 0.3_dp      !! for the domain, where it is chosen
   real(dp), parameter :: largest_scale = 32

contains

   !> How many times as large as that of a case a domain has to be for its accuracy, and for the room that a thick film
   !> needs: a power of 2. It is more than 1 with flooded edges and a domain of the usual size only.
   real(dp) function chosen_scale(case, conditions, rheology) result(scale)
      type(case_t), intent(in) :: case
      type(conditions_t), intent(in) :: conditions
      type(rheology_t), intent(in) :: rheology
      real(dp) :: errors(2)

      scale = 1
      do while (may_enlarge(case, scale))
         errors = expected_domain_errors(case, conditions, rheology, scale)
         if (errors(2) <= share_of_accuracy*case%accuracy) then
            if (has_room(conditions, scale*case%x_min, scale*case%y_max)) exit
         end if
         scale = 2*scale
      end do
   end function chosen_scale

   !> Enlarge the domain of a case, the outlet by the root of the scale.
   pure subroutine scale_domain(case, scale)
      type(case_t), intent(inout) :: case
      real(dp), intent(in) :: scale
      case%x_min = scale*case%x_min
      case%x_max = sqrt(scale)*case%x_max
      case%y_max = scale*case%y_max
   end subroutine scale_domain

   !> Whether the plan may take a larger domain than `scale` times that of a case.
   pure logical function may_enlarge(case, scale)
      type(case_t), intent(in) :: case
      real(dp), intent(in) :: scale
      type(case_t) :: usual
      may_enlarge = case%accuracy > 0 .and. case%edges == 'flooded' .and. .not. case%has_heights() .and. &
         scale < largest_scale .and. &
         maxval(abs([case%x_min - usual%x_min, case%x_max - usual%x_max, case%y_max - usual%y_max])) <= 0
   end function may_enlarge

   !> Relative errors by the edges of a domain `scale` times that of a case: of H(0,0), and of Ad/Ai, without waves both
   !> of H(0,0). Flooded edges leave in waves a share of the error that P = 0 there leaves in the film, see
   !> `share_of_waves`.
   function expected_domain_errors(case, conditions, rheology, scale) result(errors)
      type(case_t), intent(in) :: case
      type(conditions_t), intent(in) :: conditions
      type(rheology_t), intent(in) :: rheology
      real(dp), intent(in) :: scale
      real(dp) :: errors(2)
      type(conditions_t) :: contact, heavier
      type(far_field_t) :: far
      real(dp), parameter :: step = 0.01_dp
      real(dp) :: by_load, by_pressure, by_waves, film, inlet, side, slope, thickening, thinned

      thickening = rheology%thickening()
      far = new_far_field(conditions, thickening)
      contact = conditions
      if (.not. thickening > 0) contact%l = 0         ! its law of viscosity knows no pressure, whatever L is
      heavier = contact
      heavier%m = (1 + step)*contact%m
      slope = -log(moes_film_formula(heavier)/moes_film_formula(contact))/log(1 + step)
      inlet = scale*case%x_min
      side = merge(strip_width, scale*case%y_max, conditions%is_line())
      film = far%film_at(inlet, 0.0_dp)
      by_pressure = pressure_factor*far%strength(inlet, 0.0_dp)/film**2
      by_load = max(0.0_dp, slope)*far%load_outside(inlet, side)
      by_waves = share_of_waves(case, conditions, scale, &
                                1 - exp(-(rising_exponent + thickening)*by_pressure - by_load))
      if (case%edges == 'flooded') then
         thinned = thinning_at(rheology, conditions, film)
         by_pressure = max(flooded_pressure_share, thinned_margin*thinned)*(rising_exponent + thickening)*by_pressure
         by_load = max(flooded_load_share, thinned_margin*thinned)*by_load
      else
         by_pressure = thickening*by_pressure
      end if
      errors = 1 - exp(-by_pressure - by_load)
      if (case%has_ratio()) errors(2) = merge(errors(2) + by_waves, ratio_share*errors(2), case%edges == 'flooded')
      if (case%edges == 'flooded') errors = min(1.0_dp, errors*by_domain([central_film, merge(response, central_film, &
                                                                                             case%has_ratio())]))
   end function expected_domain_errors

   !> Relative error of Ad/Ai by waves that reach beyond the inlet edge: the far field at a flooded edge has no waves.
   !> The share of the film error with P = 0 there grows with the wavelength over the inlet, then is 1.
   !> Under slip the wave of the oil starts at the edge, where the film of light contacts is thin.
   pure real(dp) function share_of_waves(case, conditions, scale, truncated) result(error)
      type(case_t), intent(in) :: case
      type(conditions_t), intent(in) :: conditions
      real(dp), intent(in) :: scale
      real(dp), intent(in) :: truncated   !! error of H(0,0) with P = 0 at the edges
      real(dp) :: long

      long = wave_factor*maxval(length_of(case%surfaces()))/abs(scale*case%x_min)
      error = truncated*long/(1 + long)
      if (long > 0) error = error + slip_factor*abs(conditions%slip_parameter - 1)*truncated**2
   end function share_of_waves

   !> 2 pi over the wave number of waves that vary along X, in units of a; 0 for others.
   elemental real(dp) function length_of(waves)
      type(roughness_t), intent(in) :: waves
      length_of = 0
      if (.not. (waves%is_wavy() .and. waves%wavelength_x_over_a > 0)) return
      length_of = waves%wavelength_x_over_a
      if (waves%wavelength_y_over_a > 0) length_of = 1/norm2([1/waves%wavelength_x_over_a, 1/waves%wavelength_y_over_a])
   end function length_of

   !> Share of the viscosity, for the flow along X, that an oil loses by the shear of its film at ambient pressure. The
   !> far field is that of an oil that loses none.
   pure real(dp) function thinning_at(rheology, conditions, film) result(lost)
      type(rheology_t), intent(in) :: rheology
      type(conditions_t), intent(in) :: conditions
      real(dp), intent(in) :: film         !! H
      type(film_flow_t) :: flow
      type(across_film_t) :: across
      real(dp) :: b(1), factor(2, 1), stress(1)

      lost = 0
      if (rheology%is_newtonian()) return
      flow = rheology%film_flow(conditions%elliptic%k, conditions%lambdabar, conditions%slip_parameter)
      across%p = [0.0_dp]
      call flow%mean_stress([1.0_dp], [film], [0.0_dp], [0.0_dp], stress, b, factor, across)
      lost = 1 - 1/max(1.0_dp, factor(1, 1))
   end function thinning_at

end module ehlwave_domain_choice
