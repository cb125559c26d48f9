!> Density by Dowson and Higginson.
module ehlwave_dowson_higginson_density
   use ehlwave_density_law, only: density_law_t
   use ehlwave_kinds, only: dp
   implicit none (type, external)
   private

   !> rho/rho0 = (5.9e8 Pa + 1.34 p)/(5.9e8 Pa + p) (1 - eps (T - T0)): Dowson and Higginson, Elasto-hydrodynamic
   !> Lubrication, Pergamon 1966; theory eq. (R1).
   type, extends(density_law_t), public :: dowson_higginson_density_t
      real(dp) :: expansion_per_k = 0   !! eps, 1/K
   contains
      procedure :: evaluate
   end type dowson_higginson_density_t

   real(dp), parameter :: modulus_pa = 5.9e8_dp     ! constant of the law
   real(dp), parameter :: largest_gain = 0.34_dp    ! relative rise of density at infinite pressure

contains

   pure subroutine evaluate(self, n, p_pa, rise_k, rho, slope_per_pa, slope_per_k)
      class(dowson_higginson_density_t), intent(in) :: self
      integer, intent(in) :: n
      real(dp), intent(in) :: p_pa(n), rise_k(n)
      real(dp), intent(out) :: rho(n), slope_per_pa(n), slope_per_k(n)
      real(dp) :: share, warm, x
      integer :: i

      do i = 1, n
         x = 1/(modulus_pa + p_pa(i))
         share = 1 + largest_gain*p_pa(i)*x
         warm = 1 - self%expansion_per_k*rise_k(i)
         rho(i) = share*warm
         slope_per_pa(i) = largest_gain*modulus_pa*x*x*warm
         slope_per_k(i) = -self%expansion_per_k*share
      end do
   end subroutine evaluate

end module ehlwave_dowson_higginson_density
