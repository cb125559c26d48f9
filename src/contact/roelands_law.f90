!> Roelands' viscosity law.
module ehlwave_roelands_law
   use ehlwave_alpha_law, only: alpha_law_t
   use ehlwave_kinds, only: dp
   use ehlwave_viscosity_law, only: largest_exponent
   implicit none (type, external)
   private

   real(dp), parameter, public :: roelands_pressure_pa = 1.96e8_dp   !! p0
   real(dp), parameter :: coldest_k = 138                            ! where the viscosity is infinite

   !> ln(eta/eta0) = (alpha p0/z) ((1 + p/p0)^z theta^(-S0) - 1),  theta = (T - 138 K)/(T0 - 138 K),
   !> S0 = beta (T0 - 138 K) z/(alpha p0): Roelands, Correlational aspects of the viscosity-temperature-pressure
   !> relationship of lubricating oils, Delft 1966; theory eq. (R4).
   type, extends(alpha_law_t), public :: roelands_law_t
      real(dp) :: index = 0.68_dp       !! z
      real(dp) :: temperature_k = 0     !! T0, K; needed where beta is not 0
   contains
      procedure :: evaluate
      procedure :: evaluate_rises
   end type roelands_law_t

contains

   pure subroutine evaluate(self, n, p_pa, rise_k, exponent, slope_per_pa, slope_per_k)
      class(roelands_law_t), intent(in) :: self
      integer, intent(in) :: n
      real(dp), intent(in) :: p_pa(n), rise_k(n)
      real(dp), intent(out) :: exponent(n), slope_per_pa(n), slope_per_k(n)
      real(dp) :: power, range_k, s0, scale, x
      integer :: i

      scale = self%alpha_per_pa*roelands_pressure_pa/self%index
      do i = 1, n
         x = 1 + p_pa(i)/roelands_pressure_pa
         power = exp(self%index*log(x))
         exponent(i) = min(scale*(power - 1), largest_exponent)
         slope_per_pa(i) = self%alpha_per_pa*power/x
         slope_per_k(i) = 0
      end do
      if (.not. self%beta_per_k > 0) return
      range_k = self%temperature_k - coldest_k
      s0 = self%beta_per_k*range_k/scale
      do i = 1, n
         x = 1 + rise_k(i)/range_k
         power = exp(-s0*log(x))                      ! theta^(-S0)
         slope_per_pa(i) = slope_per_pa(i)*power
         slope_per_k(i) = -(exponent(i) + scale)*power*s0/(x*range_k)
         exponent(i) = min((exponent(i) + scale)*power - scale, largest_exponent)
      end do
   end subroutine evaluate

   !> Take the pressure terms once for all places; see the interface.
   pure subroutine evaluate_rises(self, n, rises, p_pa, rise_k, exponent, slope_per_k)
      class(roelands_law_t), intent(in) :: self
      integer, intent(in) :: n, rises
      real(dp), intent(in) :: p_pa(n), rise_k(n, rises)
      real(dp), intent(out) :: exponent(n, rises), slope_per_k(n, rises)
      real(dp) :: at_reference(n), power, range_k, s0, scale, x
      integer :: i, k

      scale = self%alpha_per_pa*roelands_pressure_pa/self%index
      do i = 1, n
         x = 1 + p_pa(i)/roelands_pressure_pa
         power = exp(self%index*log(x))
         at_reference(i) = min(scale*(power - 1), largest_exponent)
      end do
      range_k = self%temperature_k - coldest_k
      s0 = self%beta_per_k*range_k/scale
      do k = 1, rises
         if (.not. self%beta_per_k > 0) then
            exponent(:, k) = at_reference
            slope_per_k(:, k) = 0
            cycle
         end if
         do i = 1, n
            x = 1 + rise_k(i, k)/range_k
            power = exp(-s0*log(x))
            slope_per_k(i, k) = -(at_reference(i) + scale)*power*s0/(x*range_k)
            exponent(i, k) = min((at_reference(i) + scale)*power - scale, largest_exponent)
         end do
      end do
   end subroutine evaluate_rises

end module ehlwave_roelands_law
