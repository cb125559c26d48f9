!> How oil and bodies conduct and store heat, and the scales of temperatures that follow.
module ehlwave_heat_data
   use ehlwave_conditions, only: conditions_t
   use ehlwave_kinds, only: dp
   implicit none (type, external)
   private
   public :: new_heat_scales

   !> Temperatures in marches: from the smooth contact, or the heat equation of oil and surfaces at each time.
   character(len=*), parameter, public :: frozen = 'frozen', carried = 'carried'

   !> A body; by default bearing steel.
   type, public :: body_heat_t
      real(dp) :: conductivity_w_per_m_k = 46
      real(dp) :: density_kg_per_m3 = 7850
      real(dp) :: heat_capacity_j_per_kg_k = 470
   end type body_heat_t

   type, public :: heat_data_t
      real(dp) :: oil_conductivity_w_per_m_k = 0          !! k; 0: not given
      real(dp) :: oil_heat_capacity_j_per_kg_k = 0        !! cp
      real(dp) :: oil_density_kg_per_m3 = 0               !! rho0
      real(dp) :: oil_expansion_per_k = 0                 !! eps
      real(dp) :: viscosity_temperature_per_k = 0         !! beta
      type(body_heat_t) :: body(2) = [body_heat_t(), body_heat_t(0.0_dp, 0.0_dp, 0.0_dp)]   !! surfaces 1 and 2; 0 of
                                                          !! the second: as the first
      integer :: levels = 12                              !! intervals across the film
      character(len=7) :: wave_temperatures = frozen      !! as waves pass in time
   contains
      procedure :: is_given
      procedure :: follows_waves
      procedure :: second_body
   end type heat_data_t

   !> Scales of heat for the dimensionless equation, theory eq. (T6).
   type, public :: heat_scales_t
      real(dp) :: convection = 0       !! rho0 cp ubar c^2/(a k)
      real(dp) :: work = 0             !! ubar ph c^2/(a k), K
      real(dp) :: body(2) = 0          !! (k/c) a/k_s
      real(dp) :: temperature_k = 0    !! T0
      real(dp) :: peclet(2) = 0        !! u_i a rho_s c_s/(2 k_s): motion of surfaces against conduction in the bodies
      real(dp) :: flux = 0             !! k/c, W/(m2 K): heat flow for a unit of d theta/d zeta over H
   end type heat_scales_t

contains

   !> Whether any heat property of the oil is given: then temperatures are found.
   elemental logical function is_given(self)
      class(heat_data_t), intent(in) :: self
      is_given = max(self%oil_conductivity_w_per_m_k, self%oil_heat_capacity_j_per_kg_k, self%oil_density_kg_per_m3, &
                     self%oil_expansion_per_k, self%viscosity_temperature_per_k) > 0
   end function is_given

   !> Whether temperatures follow the waves that pass in time.
   elemental logical function follows_waves(self)
      class(heat_data_t), intent(in) :: self
      follows_waves = self%is_given() .and. self%wave_temperatures == carried
   end function follows_waves

   !> The body of surface 2.
   pure function second_body(self) result(body)
      class(heat_data_t), intent(in) :: self
      type(body_heat_t) :: body
      body = self%body(2)
      associate (first => self%body(1))
         if (.not. body%conductivity_w_per_m_k > 0) body%conductivity_w_per_m_k = first%conductivity_w_per_m_k
         if (.not. body%density_kg_per_m3 > 0) body%density_kg_per_m3 = first%density_kg_per_m3
         if (.not. body%heat_capacity_j_per_kg_k > 0) body%heat_capacity_j_per_kg_k = first%heat_capacity_j_per_kg_k
      end associate
   end function second_body

   !> Scales in a contact that has dimensions and both of whose surfaces move forward.
   pure function new_heat_scales(data, temperature_k, conditions) result(self)
      type(heat_data_t), intent(in) :: data
      real(dp), intent(in) :: temperature_k    !! T0
      type(conditions_t), intent(in) :: conditions
      type(heat_scales_t) :: self
      real(dp) :: speed(2)
      type(body_heat_t) :: body(2)

      body = [data%body(1), data%second_body()]
      associate (u => conditions%data%mean_speed_m_per_s, a => conditions%a_m, c => conditions%c_m, &
                 k => data%oil_conductivity_w_per_m_k)
         speed = u*[conditions%slip_parameter, 2 - conditions%slip_parameter]
         self%convection = data%oil_density_kg_per_m3*data%oil_heat_capacity_j_per_kg_k*u*c**2/(a*k)
         self%work = u*conditions%hertz_pressure_pa*c**2/(a*k)
         self%body = k/c*a/body%conductivity_w_per_m_k
         self%peclet = 0.5_dp*speed*a*body%density_kg_per_m3*body%heat_capacity_j_per_kg_k/body%conductivity_w_per_m_k
         self%temperature_k = temperature_k
         self%flux = k/c
      end associate
   end function new_heat_scales

end module ehlwave_heat_data
