!> Tait's equation of state.
module ehlwave_tait_density
   use ehlwave_density_law, only: density_law_t
   use ehlwave_kinds, only: dp
   implicit none (type, external)
   private

   !> V/V0 = (1 + aV (T - T0)) (1 - ln(1 + (1 + K0') p/K)/(1 + K0')),  K = K0 exp(-bK (T - T0)), rho/rho0 = V0/V: Dymond
   !> and Malhotra, International Journal of Thermophysics 9, 1988, 941-951; in this form Bair 2019, chapter 4; theory
   !> eq. (R2). K0' is near 11 for most liquids, K0 is 1 to 2 GPa at 20 to 40 C.
   type, extends(density_law_t), public :: tait_density_t
      real(dp) :: modulus_pa = 0          !! K0, isothermal bulk modulus at ambient pressure and T0, Pa
      real(dp) :: modulus_rate = 11       !! K0', its rate of change with pressure there
      real(dp) :: expansion_per_k = 0     !! aV, of the volume at ambient pressure, 1/K
      real(dp) :: softening_per_k = 0     !! bK, of the modulus, 1/K
   contains
      procedure :: evaluate
      procedure :: volume
   end type tait_density_t

   real(dp), parameter :: least_volume = 0.3_dp   ! V/V0 at 2000 K0 with K0' = 11 is 0.16, which no liquid reaches

contains

   pure subroutine evaluate(self, n, p_pa, rise_k, rho, slope_per_pa, slope_per_k)
      class(tait_density_t), intent(in) :: self
      integer, intent(in) :: n
      real(dp), intent(in) :: p_pa(n), rise_k(n)
      real(dp), intent(out) :: rho(n), slope_per_pa(n), slope_per_k(n)
      real(dp) :: by_k, by_pa, ratio
      integer :: i
      do i = 1, n
         call self%volume(p_pa(i), rise_k(i), ratio, by_pa, by_k)
         rho(i) = 1/ratio
         slope_per_pa(i) = -by_pa*rho(i)**2
         slope_per_k(i) = -by_k*rho(i)**2
      end do
   end subroutine evaluate

   !> V/V0 at pressures >= 0 and its derivatives. The share that pressure leaves is held at 0.3 where the equation would
   !> go below that.
   elemental subroutine volume(self, p_pa, rise_k, ratio, by_pa, by_k)
      class(tait_density_t), intent(in) :: self
      real(dp), intent(in) :: p_pa, rise_k   !! p in Pa, T - T0 in K
      real(dp), intent(out) :: ratio         !! V/V0
      real(dp), intent(out) :: by_pa, by_k   !! its derivatives, 1/Pa and 1/K
      real(dp) :: modulus, share, stiff, warm

      warm = 1 + self%expansion_per_k*rise_k
      modulus = self%modulus_pa
      if (self%softening_per_k > 0) modulus = modulus*exp(-self%softening_per_k*rise_k)
      stiff = modulus + (1 + self%modulus_rate)*p_pa
      share = 1 - log(1 + (1 + self%modulus_rate)*p_pa/modulus)/(1 + self%modulus_rate)
      by_pa = -warm/stiff
      by_k = -warm*self%softening_per_k*p_pa/stiff
      if (share <= least_volume) then
         share = least_volume
         by_pa = 0
         by_k = 0
      end if
      ratio = warm*share
      by_k = by_k + self%expansion_per_k*share
   end subroutine volume

end module ehlwave_tait_density
