!> Doolittle's free-volume viscosity law with Tait's equation of state.
module ehlwave_doolittle_law
   use ehlwave_kinds, only: dp
   use ehlwave_tait_density, only: tait_density_t
   use ehlwave_viscosity_law, only: largest_exponent, viscosity_law_t
   implicit none (type, external)
   private

   !> eta = eta0 exp(B (R/(V/V0 - R) - R0/(1 - R0))),  R = R0 (1 + e (T - T0)): Doolittle, Journal of Applied Physics
   !> 22, 1951, 1471-1475, with the volume V of Tait's equation, V0 that at ambient pressure and T0; in this form Bair
   !> 2019, chapter 6; theory eq. (R7).
   type, extends(viscosity_law_t), public :: doolittle_law_t
      real(dp) :: factor = 0                   !! B, 2 to 6
      real(dp) :: occupied_fraction = 0        !! R0, volume occupied by molecules over volume at ambient pressure, 0.6
                                               !! to 0.75
      real(dp) :: occupied_rate_per_k = 0      !! e, 1/K
      type(tait_density_t) :: tait
   contains
      procedure :: evaluate
   end type doolittle_law_t

contains

   !> Where the free volume is nearly gone the exponent stays at its limit.
   pure subroutine evaluate(self, n, p_pa, rise_k, exponent, slope_per_pa, slope_per_k)
      class(doolittle_law_t), intent(in) :: self
      integer, intent(in) :: n
      real(dp), intent(in) :: p_pa(n), rise_k(n)
      real(dp), intent(out) :: exponent(n), slope_per_pa(n), slope_per_k(n)
      real(dp) :: by_k, by_pa, free, occupied, scale, volume
      integer :: i

      do i = 1, n
         occupied = self%occupied_fraction*(1 + self%occupied_rate_per_k*rise_k(i))
         scale = self%factor*occupied
         call self%tait%volume(p_pa(i), rise_k(i), volume, by_pa, by_k)
         free = max(volume - occupied, 1/(largest_exponent/scale + 1/(1 - self%occupied_fraction)))
         exponent(i) = min(scale/free - self%factor*self%occupied_fraction/(1 - self%occupied_fraction), &
            largest_exponent)
         slope_per_pa(i) = -scale*by_pa/free**2
         slope_per_k(i) = (self%factor*self%occupied_fraction*self%occupied_rate_per_k*volume - scale*by_k)/free**2
      end do
   end subroutine evaluate

end module ehlwave_doolittle_law
