!> The interface of viscosity laws, and the pressure-viscosity coefficient that builds films.
module ehlwave_viscosity_law
   use ehlwave_gauss_legendre, only: gauss_rule_t, new_gauss_rule
   use ehlwave_kinds, only: dp
   implicit none (type, external)
   private
   public :: asymptotic_coefficient, film_forming_coefficient

   real(dp), parameter, public :: largest_exponent = 600   !! largest ln of viscosity over its value at ambient
                                                           !! pressure: keeps exp()
                                                           !! finite

   !> Viscosity against pressure and temperature. eta0 is the viscosity at ambient pressure and the reference
   !> temperature T0.
   type, abstract, public :: viscosity_law_t
      real(dp) :: ambient_pa_s = 0                           !! eta0 where the law gives it, Pa s; else 0
      real(dp) :: largest_pressure_pa = huge(1.0_dp)         !! beyond it the law is extrapolated
   contains
      procedure(evaluate), deferred :: evaluate
      procedure :: evaluate_rises
      procedure :: coefficient => film_forming_coefficient
   end type viscosity_law_t

   abstract interface
      !> ln(eta/eta0), at most `largest_exponent`, and its derivatives by pressure and temperature.
      pure subroutine evaluate(self, n, p_pa, rise_k, exponent, slope_per_pa, slope_per_k)
         import :: dp, viscosity_law_t
         implicit none (type, external)
         class(viscosity_law_t), intent(in) :: self
         integer, intent(in) :: n
         real(dp), intent(in) :: p_pa(n)            !! pressure >= 0, Pa
         real(dp), intent(in) :: rise_k(n)          !! T - T0, K
         real(dp), intent(out) :: exponent(n)       !! ln(eta/eta0)
         real(dp), intent(out) :: slope_per_pa(n)   !! d ln(eta)/dp, 1/Pa
         real(dp), intent(out) :: slope_per_k(n)    !! d ln(eta)/dT, 1/K
      end subroutine evaluate
   end interface

   real(dp), parameter :: film_range = 3            ! in units of 1/alpha*
   integer, parameter :: most_panels = 200
   real(dp), parameter :: growth = 1.3_dp           ! ratio of a panel to the one before
   real(dp), parameter :: first_panel = 0.25_dp     ! in units of 1/alpha at ambient pressure
   real(dp), parameter :: negligible = 1e-14_dp     ! share of the integral
   integer, parameter :: panel_points = 16

contains

   !> ln(eta/eta0) and its derivative by temperature at some rises for each pressure.
   pure subroutine evaluate_rises(self, n, rises, p_pa, rise_k, exponent, slope_per_k)
      class(viscosity_law_t), intent(in) :: self
      integer, intent(in) :: n, rises
      real(dp), intent(in) :: p_pa(n), rise_k(n, rises)
      real(dp), intent(out) :: exponent(n, rises), slope_per_k(n, rises)
      real(dp) :: slope(n)
      integer :: k
      do k = 1, rises
         call self%evaluate(n, p_pa, rise_k(:, k), exponent(:, k), slope, slope_per_k(:, k))
      end do
   end subroutine evaluate_rises

   !> alpha* = 1/integral_0^inf eta(0)/eta(p) dp, 1/Pa, at T0: the reciprocal asymptotic isoviscous pressure (Blok
   !> 1963), theory eq. (R8). Zero for a law that does not rise with pressure from the first.
   pure real(dp) function asymptotic_coefficient(law) result(alpha)
      class(viscosity_law_t), intent(in) :: law
      alpha = initial_slope(law)
      if (alpha > 0) alpha = 1/isoviscous_pressure(law, huge(alpha), 1/alpha)
   end function asymptotic_coefficient

   !> The pressure-viscosity coefficient for film thickness formulas, 1/Pa (Bair, Liu and Wang, Journal of Tribology
   !> 128, 2006, 624-631), theory eq. (R9):
   !>
   !>     alpha_film = (1 - exp(-3))/integral_0^(3/alpha*) eta(0)/eta(p) dp,
   !>
   !> which is alpha for Barus' law. Panels that grow by a constant factor, 16 Gauss points each: error below 1e-10.
   pure real(dp) function film_forming_coefficient(law) result(alpha)
      class(viscosity_law_t), intent(in) :: law
      alpha = asymptotic_coefficient(law)
      if (alpha > 0) alpha = (1 - exp(-film_range))/isoviscous_pressure(law, film_range/alpha, 1/initial_slope(law))
   end function film_forming_coefficient

   !> d ln(eta)/dp at ambient pressure and T0, 1/Pa.
   pure real(dp) function initial_slope(law)
      class(viscosity_law_t), intent(in) :: law
      real(dp), dimension(1) :: exponent, slope, slope_per_k
      call law%evaluate(1, [0.0_dp], [0.0_dp], exponent, slope, slope_per_k)
      initial_slope = slope(1)
   end function initial_slope

   !> integral_0^last eta(0)/eta(p) dp at T0, Pa.
   pure real(dp) function isoviscous_pressure(law, last_pa, scale_pa) result(total)
      class(viscosity_law_t), intent(in) :: law
      real(dp), intent(in) :: last_pa    !! end of the integral; it stops earlier where nothing is added
      real(dp), intent(in) :: scale_pa   !! pressure over which viscosity grows by e at first
      real(dp), parameter :: isothermal(panel_points) = 0
      type(gauss_rule_t) :: rule
      real(dp), dimension(panel_points) :: exponent, p, slope, slope_per_k
      real(dp) :: added, first, width
      integer :: panel

      rule = new_gauss_rule(panel_points)
      total = 0
      first = 0
      width = first_panel*scale_pa
      do panel = 1, most_panels
         width = min(width, last_pa - first)
         p = first + 0.5_dp*width*(1 + rule%node)
         call law%evaluate(panel_points, p, isothermal, exponent, slope, slope_per_k)
         added = 0.5_dp*width*sum(rule%weight*exp(-exponent))
         total = total + added
         first = first + width
         if (first >= last_pa .or. added < negligible*total) exit
         width = growth*width
      end do
   end function isoviscous_pressure

end module ehlwave_viscosity_law
