!> Density and viscosity of the lubricant as functions of dimensionless pressure.
module ehlwave_rheology
   use ehlwave_film_flow, only: film_flow_t, new_film_flow
   use ehlwave_flow_law, only: flow_law_t
   use ehlwave_kinds, only: dp
   use ehlwave_tait_density, only: tait_density_t
   use ehlwave_viscosity_law, only: largest_exponent, viscosity_law_t
   implicit none (type, external)
   private
   public :: new_rheology

   integer, parameter, public :: viscosity_roelands = 1, viscosity_barus = 2, viscosity_constant = 3, &
                                 viscosity_special = 4   !! a law with parameters of its own
   integer, parameter, public :: density_dowson_higginson = 1, density_constant = 2, density_tait = 3

   real(dp), parameter, public :: roelands_pressure_pa = 1.96e8_dp     !! p0 of the Roelands law
   real(dp), parameter :: dowson_higginson_pa = 5.9e8_dp               !! ambient modulus of the density law
   real(dp), parameter :: dowson_higginson_factor = 1.34_dp            !! rho at infinite pressure

   type, public :: rheology_t
      private
      integer :: viscosity_law = viscosity_roelands
      integer :: density_law = density_dowson_higginson
      real(dp) :: alphabar = 0      !! alpha ph
      real(dp) :: z = 0.68_dp       !! Roelands index
      real(dp) :: ph_over_p0 = 0    !! ph/p0
      real(dp) :: ph_over_dh = 0    !! ph/5.9e8 Pa
      real(dp) :: ph_pa = 0         !! ph, Pa
      class(viscosity_law_t), allocatable :: law   !! viscosity_special
      real(dp) :: law_factor = 1    !! of ln(eta/eta0) by that law
      type(tait_density_t) :: tait                 !! density_tait
      class(flow_law_t), allocatable :: flow_law   !! not of a Newtonian oil
      real(dp) :: modulus_times_stress_pa2 = 0     !! E' tau0
      real(dp) :: slip_parameter = 1               !! S
   contains
      procedure :: evaluate
      procedure :: density
      procedure :: at_pressure
      procedure :: depends_on_alpha
      procedure :: with_alpha
      procedure :: with_stress
      procedure :: use_viscosity
      procedure :: use_density
      procedure :: use_flow
      procedure :: is_newtonian
      procedure :: film_flow
   end type rheology_t

contains

   !> Lubricant of a contact with alphabar = alpha ph and Hertz pressure ph.
   pure function new_rheology(viscosity_law, density_law, alphabar, roelands_index, hertz_pressure_pa) result(self)
      integer, intent(in) :: viscosity_law, density_law   !! one of the parameters above
      real(dp), intent(in) :: alphabar                    !! alpha ph
      real(dp), intent(in) :: roelands_index              !! z
      real(dp), intent(in) :: hertz_pressure_pa           !! ph, Pa
      type(rheology_t) :: self
      self%viscosity_law = viscosity_law
      if (alphabar <= 0) self%viscosity_law = viscosity_constant
      self%density_law = density_law
      self%alphabar = alphabar
      self%z = roelands_index
      self%ph_over_p0 = hertz_pressure_pa/roelands_pressure_pa
      self%ph_over_dh = hertz_pressure_pa/dowson_higginson_pa
      self%ph_pa = hertz_pressure_pa
   end function new_rheology

   !> Take a viscosity law with parameters of its own.
   pure subroutine use_viscosity(self, law)
      class(rheology_t), intent(inout) :: self
      class(viscosity_law_t), intent(in) :: law
      self%viscosity_law = viscosity_special
      self%law = law
   end subroutine use_viscosity

   !> Take Tait's density.
   pure subroutine use_density(self, tait)
      class(rheology_t), intent(inout) :: self
      type(tait_density_t), intent(in) :: tait
      self%density_law = density_tait
      self%tait = tait
   end subroutine use_density

   !> Take a law of flow that is not Newtonian.
   pure subroutine use_flow(self, law, modulus_times_stress_pa2, slip_parameter)
      class(rheology_t), intent(inout) :: self
      class(flow_law_t), intent(in) :: law
      real(dp), intent(in) :: modulus_times_stress_pa2   !! E' tau0, Pa^2; tau0 stands for G of Carreau's law
      real(dp), intent(in) :: slip_parameter             !! S
      self%flow_law = law
      self%modulus_times_stress_pa2 = modulus_times_stress_pa2
      self%slip_parameter = slip_parameter
   end subroutine use_flow

   !> Whether the shear stress is proportional to the shear rate.
   pure logical function is_newtonian(self)
      class(rheology_t), intent(in) :: self
      is_newtonian = .not. allocated(self%flow_law)
   end function is_newtonian

   !> Flow across the film of a contact: N0 = c ph/(2 a tau0) = K ph^2/(E' tau0), K = 1 for a line contact.
   pure function film_flow(self, k, hertz_pressure_pa, lambdabar) result(flow)
      class(rheology_t), intent(in) :: self               !! not Newtonian
      real(dp), intent(in) :: k                           !! complete elliptic integral K
      real(dp), intent(in) :: hertz_pressure_pa, lambdabar
      type(film_flow_t) :: flow
      flow = new_film_flow(self%flow_law, k*hertz_pressure_pa**2/self%modulus_times_stress_pa2, lambdabar, self%slip_parameter)
   end function film_flow

   !> The same laws for a contact at another Hertz pressure.
   pure function at_pressure(self, alphabar, hertz_pressure_pa) result(other)
      class(rheology_t), intent(in) :: self
      real(dp), intent(in) :: alphabar                    !! alpha ph
      real(dp), intent(in) :: hertz_pressure_pa           !! ph, Pa
      type(rheology_t) :: other
      other = new_rheology(self%viscosity_law, self%density_law, alphabar, self%z, hertz_pressure_pa)
      if (allocated(self%law)) other%law = self%law
      other%law_factor = self%law_factor
      other%tait = self%tait
      if (allocated(self%flow_law)) call other%use_flow(self%flow_law, self%modulus_times_stress_pa2, self%slip_parameter)
   end function at_pressure

   !> Whether the viscosity grows with pressure.
   pure logical function depends_on_alpha(self)
      class(rheology_t), intent(in) :: self
      depends_on_alpha = self%viscosity_law /= viscosity_constant
   end function depends_on_alpha

   !> The same oil with ln(eta/eta0) so many times as large at every pressure.
   pure function with_alpha(self, factor) result(other)
      class(rheology_t), intent(in) :: self
      real(dp), intent(in) :: factor   !! > 0
      type(rheology_t) :: other
      other = self
      other%alphabar = factor*self%alphabar
      other%law_factor = factor*self%law_factor
   end function with_alpha

   !> The same oil with the stress of its flow law so many times as large.
   pure function with_stress(self, factor) result(other)
      class(rheology_t), intent(in) :: self   !! not Newtonian
      real(dp), intent(in) :: factor          !! > 0
      type(rheology_t) :: other
      other = self
      other%modulus_times_stress_pa2 = factor*self%modulus_times_stress_pa2
   end function with_stress

   !> Density, fluidity 1/eta and their derivatives at pressures P >= 0, theory section 3:
   !>
   !>     rho = (5.9e8 + 1.34 ph P)/(5.9e8 + ph P)                       Dowson-Higginson
   !>     eta = exp((alpha p0/z) ((1 + ph P/p0)^z - 1))                  Roelands
   !>     eta = exp(alphabar P)                                          Barus
   !>
   !> or the law that was given.
   !> Written as plain loops over contiguous arrays so that exp and log are vectorised.
   pure subroutine evaluate(self, n, p, rho, drho, fluidity, dln_eta)
      class(rheology_t), intent(in) :: self
      integer, intent(in) :: n
      real(dp), intent(in) :: p(n)          !! P
      real(dp), intent(out) :: rho(n)       !! rho/rho0
      real(dp), intent(out) :: drho(n)      !! d rho/d P
      real(dp), intent(out) :: fluidity(n)  !! eta0/eta
      real(dp), intent(out) :: dln_eta(n)   !! d ln(eta)/d P
      real(dp) :: c, f, g, p_pa(merge(n, 0, self%viscosity_law == viscosity_special)), power, x, z
      integer :: i

      select case (self%density_law)
      case (density_dowson_higginson)
         f = self%ph_over_dh
         g = dowson_higginson_factor - 1
         do i = 1, n
            x = 1/(1 + f*p(i))
            rho(i) = 1 + g*f*p(i)*x
            drho(i) = g*f*x*x
         end do
      case (density_tait)
         do i = 1, n
            rho(i) = self%tait%density(self%ph_pa*p(i))
            drho(i) = -rho(i)**2*self%tait%volume_slope_per_pa(self%ph_pa*p(i))*self%ph_pa
         end do
      case default
         do i = 1, n
            rho(i) = 1
            drho(i) = 0
         end do
      end select

      select case (self%viscosity_law)
      case (viscosity_roelands)
         f = self%ph_over_p0
         z = self%z
         c = self%alphabar/(z*f)
         do i = 1, n
            x = 1 + f*p(i)
            power = exp(z*log(x))
            fluidity(i) = exp(-min(c*(power - 1), largest_exponent))
            dln_eta(i) = self%alphabar*power/x
         end do
      case (viscosity_barus)
         do i = 1, n
            fluidity(i) = exp(-min(self%alphabar*p(i), largest_exponent))
            dln_eta(i) = self%alphabar
         end do
      case (viscosity_special)
         p_pa = self%ph_pa*p
         call self%law%evaluate(n, p_pa, fluidity, dln_eta)
         fluidity = exp(-self%law_factor*fluidity)
         dln_eta = self%law_factor*self%ph_pa*dln_eta
      case default
         do i = 1, n
            fluidity(i) = 1
            dln_eta(i) = 0
         end do
      end select
   end subroutine evaluate

   !> Density at pressures P >= 0.
   elemental real(dp) function density(self, p)
      class(rheology_t), intent(in) :: self
      real(dp), intent(in) :: p   !! P
      density = 1
      if (self%density_law == density_dowson_higginson) &
         density = 1 + (dowson_higginson_factor - 1)*self%ph_over_dh*p/(1 + self%ph_over_dh*p)
      if (self%density_law == density_tait) density = self%tait%density(self%ph_pa*p)
   end function density

end module ehlwave_rheology
