!> Tait's equation of state at one temperature.
module ehlwave_tait_density
   use ehlwave_kinds, only: dp
   implicit none (type, external)
   private

   !> V/V0 = 1 - ln(1 + (1 + K0') p/K0)/(1 + K0'), rho = V0/V: Dymond and Malhotra, International Journal of Thermophysics 9, 1988,
   !> 941-951; in this form Bair 2019, chapter 4. K0' is near 11 for most liquids, K0 is 1 to 2 GPa at 20 to 40 C.
   type, public :: tait_density_t
      real(dp) :: modulus_pa = 0          !! K0, isothermal bulk modulus at ambient pressure, Pa
      real(dp) :: modulus_rate = 11       !! K0', its rate of change with pressure there
   contains
      procedure :: volume
      procedure :: volume_slope_per_pa
      procedure :: density
   end type tait_density_t

   real(dp), parameter :: least_volume = 0.3_dp   ! V/V0 at 2000 K0 with K0' = 11 is 0.16, which no liquid reaches

contains

   !> V/V0 at pressures >= 0, held at 0.3 where the equation would go below that.
   elemental real(dp) function volume(self, p_pa)
      class(tait_density_t), intent(in) :: self
      real(dp), intent(in) :: p_pa   !! Pa
      volume = max(1 - log(1 + (1 + self%modulus_rate)*p_pa/self%modulus_pa)/(1 + self%modulus_rate), least_volume)
   end function volume

   !> d(V/V0)/dp, 1/Pa.
   elemental real(dp) function volume_slope_per_pa(self, p_pa)
      class(tait_density_t), intent(in) :: self
      real(dp), intent(in) :: p_pa   !! Pa
      volume_slope_per_pa = -1/(self%modulus_pa + (1 + self%modulus_rate)*p_pa)
      if (self%volume(p_pa) <= least_volume) volume_slope_per_pa = 0
   end function volume_slope_per_pa

   !> rho/rho0.
   elemental real(dp) function density(self, p_pa)
      class(tait_density_t), intent(in) :: self
      real(dp), intent(in) :: p_pa   !! Pa
      density = 1/self%volume(p_pa)
   end function density

end module ehlwave_tait_density
