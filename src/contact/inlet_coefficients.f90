!> The law of warm inlets, theory eq. (T15): coefficients, errors, contacts of the fit.
!> Made from postprocess/record/inlet/law.csv by `python -m studies.inlet_tables`, with
!> the table of the package.
module ehlwave_inlet_coefficients
   use ehlwave_kinds, only: dp
   implicit none (type, external)
   private

   !> Coefficients c1 to c11.
   real(dp), parameter, public :: inlet_coefficients(11) = &
      [0.21776_dp, 0.93042_dp, 0.94565_dp, 2.1696_dp, 6.9248_dp, 0.81289_dp, &
       0.25734_dp, -0.28921_dp, -0.83828_dp, 1.8291_dp, 0.067384_dp]
   !> Error over the loss and known_loss, by the sliding.
   real(dp), parameter, public :: error_share(3) = [0.17288_dp, 0.47554_dp, 1.0339_dp]
   !> Slide-to-roll ratios |u1 - u2|/ubar above which the next share holds.
   real(dp), parameter, public :: error_slip(2) = [0.2_dp, 1.0_dp]
   !> Load parameter M of the contacts of the fit.
   real(dp), parameter, public :: m_range(2) = [2.0_dp, 20000.0_dp]
   !> Lubricant parameter L.
   real(dp), parameter, public :: l_range(2) = [2.0_dp, 25.0_dp]
   !> Central film over the Hertz approach.
   real(dp), parameter, public :: film_range(2) = [0.0_dp, 1.0_dp]
   !> Thermal loading L_t.
   real(dp), parameter, public :: loading_range(2) = [0.0_dp, 8.0_dp]
   !> Smallest loss that is known.
   real(dp), parameter, public :: known_loss = 0.01_dp
   !> Smallest D of an elliptical contact.
   real(dp), parameter, public :: lowest_d = 0.012_dp
   !> Largest |u1 - u2|/ubar.
   real(dp), parameter, public :: largest_slide_roll = 1.9_dp
   !> Conductivity of usual oils, W/(m K).
   real(dp), parameter, public :: usual_conductivity = 0.14_dp
   !> -d ln(eta)/dT of usual oils, 1/K.
   real(dp), parameter, public :: usual_beta = 0.04_dp
   !> Effusivity (k rho c)^(1/2) of steel, W s^(1/2)/(m2 K).
   real(dp), parameter, public :: usual_effusivity = 13000.0_dp

end module ehlwave_inlet_coefficients
