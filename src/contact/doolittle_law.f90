!> Doolittle's free-volume viscosity law with Tait's equation of state.
module ehlwave_doolittle_law
   use ehlwave_kinds, only: dp
   use ehlwave_tait_density, only: tait_density_t
   use ehlwave_viscosity_law, only: largest_exponent, viscosity_law_t
   implicit none (type, external)
   private

   !> eta = eta0 exp(B R0 (1/(V/V0 - R0) - 1/(1 - R0))) at one temperature: Doolittle, Journal of Applied Physics 22, 1951, 1471-1475,
   !> with the volume V of Tait's equation; in this form Bair 2019, chapter 6.
   type, extends(viscosity_law_t), public :: doolittle_law_t
      real(dp) :: factor = 0                   !! B, 2 to 6
      real(dp) :: occupied_fraction = 0        !! R0, volume occupied by molecules over volume at ambient pressure, 0.6 to 0.75
      type(tait_density_t) :: tait
   contains
      procedure :: evaluate
   end type doolittle_law_t

contains

   !> Where the free volume is nearly gone the exponent stays at its limit.
   pure subroutine evaluate(self, n, p_pa, exponent, slope_per_pa)
      class(doolittle_law_t), intent(in) :: self
      integer, intent(in) :: n
      real(dp), intent(in) :: p_pa(n)
      real(dp), intent(out) :: exponent(n), slope_per_pa(n)
      real(dp) :: free, scale
      integer :: i

      scale = self%factor*self%occupied_fraction
      do i = 1, n
         free = max(self%tait%volume(p_pa(i)) - self%occupied_fraction, &
                    1/(largest_exponent/scale + 1/(1 - self%occupied_fraction)))
         exponent(i) = min(scale*(1/free - 1/(1 - self%occupied_fraction)), largest_exponent)
         slope_per_pa(i) = -scale*self%tait%volume_slope_per_pa(p_pa(i))/free**2
      end do
   end subroutine evaluate

end module ehlwave_doolittle_law
