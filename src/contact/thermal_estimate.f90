!> Estimated temperature rise of the oil, for a warning: the model is isothermal.
module ehlwave_thermal_estimate
   use ehlwave_inlet_coefficients, only: usual_beta, usual_conductivity, usual_effusivity
   use ehlwave_inlet_law, only: inlet_loss, inlet_loss_error, inlet_t, is_within_law
   use ehlwave_kinds, only: dp, no_value, pi
   implicit none (type, external)
   private
   public :: film_rise_k, rough_film_factor, surface_rise_k, warm_inlet

   !> Data of oil and bodies that temperatures depend on. Defaults: mineral oils and PAO (conductivity 0.12 to 0.15 W/(m
   !> K), viscosity falling by 3 to 6 % for a kelvin near 40 C; Hamrock, Schmid and Jacobson, Fundamentals of Fluid Film
   !> Lubrication, 2nd ed., 2004, chapter 4) and bearing steel (46 W/(m K), 7800 kg/m3, 470 J/(kg K)).
   type, public :: thermal_data_t
      real(dp) :: oil_conductivity_w_per_m_k = usual_conductivity
      real(dp) :: viscosity_decay_per_k = usual_beta           !! -d ln(eta0)/dT
      real(dp) :: solid_effusivity = usual_effusivity          !! (k rho c)^(1/2), W s^(1/2)/(m2 K)
   end type thermal_data_t

   !> Film of a contact with a warm inlet over the isothermal film.
   type, public :: warm_inlet_t
      real(dp) :: film_factor = no_value
      real(dp) :: error = no_value       !! relative error; NaN where the law does not hold: then the factor is a low
                                         !! estimate
      real(dp) :: rise_k = no_value      !! rise of the oil in the inlet that would thin the film by such a factor
   end type warm_inlet_t

   real(dp), parameter :: film_exponent = 0.67_dp    ! exponent of viscosity in the film thickness: Hamrock and Dowson
                                                     ! 1977
   real(dp), parameter :: least_factor = 0.05_dp     ! keeps the fit of the inlet factor positive beyond its range

contains

   !> The law of warm inlets, theory eq. (T15), within its range; beyond, the lower value of it and of (T3).
   elemental type(warm_inlet_t) function warm_inlet(data, inlet, pressure_over_modulus)
      type(thermal_data_t), intent(in) :: data
      type(inlet_t), intent(in) :: inlet
      real(dp), intent(in) :: pressure_over_modulus   !! ph/E'
      warm_inlet%film_factor = 1 - inlet_loss(inlet)
      if (is_within_law(inlet)) then
         warm_inlet%error = inlet_loss_error(inlet)
      else
         warm_inlet%film_factor = min(warm_inlet%film_factor, &
                                      rough_film_factor(inlet%loading, inlet%slide_roll, pressure_over_modulus))
      end if
      warm_inlet%rise_k = -log(warm_inlet%film_factor)/(film_exponent*data%viscosity_decay_per_k)
   end function warm_inlet

   !> Film of a contact with a warm inlet over the isothermal film (Gupta, Cheng, Zhu, Forster and Schrand, Tribology
   !> Transactions 35, 1992, 269-274), theory eq. (T3):
   !>
   !>     (1 - 13.2 (ph/E') Lt^0.42)/(1 + 0.213 (1 + 2.23 s^0.83) Lt^0.64),    Lt = -(d eta0/dT) ubar^2/k,   s = |u1 -
   !>     u2|/ubar.
   elemental real(dp) function rough_film_factor(loading, slide_roll, pressure_over_modulus)
      real(dp), intent(in) :: loading                 !! Lt
      real(dp), intent(in) :: slide_roll              !! |u1 - u2|/ubar = 2 |S - 1|
      real(dp), intent(in) :: pressure_over_modulus   !! ph/E'
      rough_film_factor = max(least_factor, 1 - 13.2_dp*pressure_over_modulus*loading**0.42_dp) &
                          /(1 + 0.213_dp*(1 + 2.23_dp*slide_roll**0.83_dp)*loading**0.64_dp)
   end function rough_film_factor

   !> Mean temperature of the film above the surfaces, K: heat generated evenly across the film and conducted to
   !> both, q h/(12 k) with q = |tau| |u1 - u2|, theory eq. (T4). The rise at mid-film is 1.5 times as large.
   elemental real(dp) function film_rise_k(data, stress_pa, sliding_m_per_s, film_m)
      type(thermal_data_t), intent(in) :: data
      real(dp), intent(in) :: stress_pa         !! mean |tau|
      real(dp), intent(in) :: sliding_m_per_s   !! |u1 - u2|
      real(dp), intent(in) :: film_m            !! h
      film_rise_k = stress_pa*sliding_m_per_s*film_m/(12*data%oil_conductivity_w_per_m_k)
   end function film_rise_k

   !> Mean temperature rise of the surfaces within the contact, K: a band of length 2 a of even heat q over two surfaces
   !> that move fast (Peclet number above 10), at rest in no case (Blok 1937; Archard, Wear 2, 1959, 438-455). Heat q
   !> into a single surface warms it by (4/3) q (2 a/(pi u))^(1/2)/(k rho c)^(1/2) on average; both surfaces share it so
   !> that they are equally warm: theory eq. (T5).
   elemental real(dp) function surface_rise_k(data, stress_pa, speed1_m_per_s, speed2_m_per_s, half_length_m)
      type(thermal_data_t), intent(in) :: data
      real(dp), intent(in) :: stress_pa                          !! mean |tau|
      real(dp), intent(in) :: speed1_m_per_s, speed2_m_per_s     !! u1, u2
      real(dp), intent(in) :: half_length_m                      !! a
      surface_rise_k = 4/3.0_dp*stress_pa*abs(speed1_m_per_s - speed2_m_per_s)*sqrt(2*half_length_m/pi) &
                       /(data%solid_effusivity*max(sqrt(abs(speed1_m_per_s)) + sqrt(abs(speed2_m_per_s)), tiny(1.0_dp)))
   end function surface_rise_k

end module ehlwave_thermal_estimate
