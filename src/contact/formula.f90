!> Closed formulas of the field: amplitude reduction, and film thickness of a smooth contact.
module ehlwave_formula
   use ehlwave_conditions, only: conditions_t
   use ehlwave_kinds, only: dp
   implicit none (type, external)
   private
   public :: anisotropy_factor, wave_parameter_v, wave_parameter_v2, amplitude_formula, expected_film, moes_film_formula

contains

   !> f(r) of theory eq. (15): exp(1 - 1/r) for r = lambda_x/lambda_y > 1, else 1.
   !> A wavelength of 0 means no variation in that direction (infinite wavelength).
   pure function anisotropy_factor(wavelength_x, wavelength_y) result(f)
      real(dp), intent(in) :: wavelength_x, wavelength_y   !! same unit; 0: infinite
      real(dp) :: f
      if (wavelength_y <= 0) then
         f = 1
      else if (wavelength_x <= 0) then
         f = exp(1.0_dp)
      else if (wavelength_x > wavelength_y) then
         f = exp(1 - wavelength_y/wavelength_x)
      else
         f = 1
      end if
   end function anisotropy_factor

   !> V = (lambda/a)(gamma M/L)^(1/2), theory eq. (17), lambda = min(lambda_x, lambda_y); of a line, eq. (L8),
   !> (lambda/a) M^(3/4) L^(-1/2).
   pure function wave_parameter_v(conditions, wavelength_over_a) result(v)
      type(conditions_t), intent(in) :: conditions
      real(dp), intent(in) :: wavelength_over_a
      real(dp) :: v
      v = sqrt(conditions%gamma)*wave_parameter_v2(conditions, wavelength_over_a)
   end function wave_parameter_v

   !> V2 = (lambda/a)(M/L)^(1/2), theory eq. (16); infinite (huge) for L = 0. M of line and elliptical contacts differs
   !> in definition, so their V2 cannot be compared.
   pure function wave_parameter_v2(conditions, wavelength_over_a) result(v2)
      type(conditions_t), intent(in) :: conditions
      real(dp), intent(in) :: wavelength_over_a
      real(dp) :: v2
      if (conditions%l > 0) then
         v2 = wavelength_over_a*sqrt(conditions%m/conditions%l)
      else
         v2 = huge(1.0_dp)**0.25_dp
      end if
   end function wave_parameter_v2

   !> Ad/Ai = 1/(1 + 0.15 f V + 0.015 (f V)^2), theory eq. (18).
   pure function amplitude_formula(f_v) result(ratio)
      real(dp), intent(in) :: f_v   !! f(r) V
      real(dp) :: ratio
      ratio = 1/(1 + 0.15_dp*f_v + 0.015_dp*f_v**2)
   end function amplitude_formula

   !> H(0,0) of a smooth contact by the formula below.
   pure real(dp) function expected_film(conditions)
      type(conditions_t), intent(in) :: conditions
      expected_film = moes_film_formula(conditions)/conditions%moes_film_factor
   end function expected_film

   !> Central film thickness of a smooth contact in the Moes scale of eq. (6):
   !> Nijenbanning, Venner and Moes (1994), theory eq. (H1). A fit, good to 10 or 20 per cent.
   pure function moes_film_formula(conditions) result(film)
      type(conditions_t), intent(in) :: conditions
      real(dp) :: film
      real(dp) :: d, ei, ep, ri, rp, s, rigid_elastic, piezo, h00

      if (conditions%is_line()) then
         film = moes_line_formula(conditions%m, conditions%l)
         return
      end if
      d = conditions%d
      ri = 145*(1 + 0.796_dp*d**(14.0_dp/15))**(-15.0_dp/7)/d/conditions%m**2
      ei = 3.18_dp*(1 + 0.006_dp*log(d) + 0.63_dp*d**(4.0_dp/7))**(-14.0_dp/25)*d**(-1.0_dp/15) &
           *conditions%m**(-2.0_dp/15)
      h00 = 1.8_dp/d
      if (conditions%l > 0) then
         rp = 1.29_dp*(1 + 0.691_dp*d)**(-2.0_dp/3)*conditions%l**(2.0_dp/3)
         ep = 1.48_dp*(1 + 0.006_dp*log(d) + 0.63_dp*d**(4.0_dp/7))**(-7.0_dp/20)*d**(-1.0_dp/24) &
              *conditions%m**(-1.0_dp/12)*conditions%l**0.75_dp
         s = 1.5_dp*(1 + exp(-1.2_dp*ei/ep))
         piezo = (rp**(-8) + ep**(-8))**(-s/8)
      else
         s = 1.5_dp
         piezo = 0
      end if
      rigid_elastic = (ri**1.5_dp + (ei**(-4) + h00**(-4))**(-3.0_dp/8))**(2*s/3)
      film = (rigid_elastic + piezo)**(1/s)
   end function moes_film_formula

   !> Central film thickness of a line contact in the scale (h/Rx)(2U)^(-1/2): Moes (1992), theory eq. (H2).
   pure function moes_line_formula(m, l) result(film)
      real(dp), intent(in) :: m, l   !! Moes parameters of a line contact
      real(dp) :: film
      real(dp) :: ei, ep, piezo, ri, rp, s

      ri = 3/m
      ei = 2.621_dp*m**(-0.2_dp)
      s = (7 + 8*exp(-2*ei/ri))/5
      piezo = 0
      if (l > 0) then
         rp = 1.287_dp*l**(2.0_dp/3)
         ep = 1.311_dp*m**(-0.125_dp)*l**0.75_dp
         piezo = (rp**(-3.5_dp) + ep**(-3.5_dp))**(-2*s/7)
      end if
      film = ((ri**(7.0_dp/3) + ei**(7.0_dp/3))**(3*s/7) + piezo)**(1/s)
   end function moes_line_formula

end module ehlwave_formula
