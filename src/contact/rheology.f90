!> Density and viscosity of the lubricant as functions of dimensionless pressure.
module ehlwave_rheology
   use ehlwave_kinds, only: dp
   implicit none (type, external)
   private
   public :: new_rheology

   integer, parameter, public :: viscosity_roelands = 1, viscosity_barus = 2, viscosity_constant = 3
   integer, parameter, public :: density_dowson_higginson = 1, density_constant = 2

   real(dp), parameter, public :: roelands_pressure_pa = 1.96e8_dp     !! p0 of the Roelands law
   real(dp), parameter :: dowson_higginson_pa = 5.9e8_dp               !! ambient modulus of the density law
   real(dp), parameter :: dowson_higginson_factor = 1.34_dp            !! rho at infinite pressure
   real(dp), parameter :: largest_exponent = 600                       !! keeps exp() finite

   type, public :: rheology_t
      private
      integer :: viscosity_law = viscosity_roelands
      integer :: density_law = density_dowson_higginson
      real(dp) :: alphabar = 0      !! alpha ph
      real(dp) :: z = 0.68_dp       !! Roelands index
      real(dp) :: ph_over_p0 = 0    !! ph/p0
      real(dp) :: ph_over_dh = 0    !! ph/5.9e8 Pa
   contains
      procedure :: evaluate
      procedure :: density
      procedure :: at_pressure
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
   end function new_rheology

   !> The same laws for a contact at another Hertz pressure.
   pure function at_pressure(self, alphabar, hertz_pressure_pa) result(other)
      class(rheology_t), intent(in) :: self
      real(dp), intent(in) :: alphabar                    !! alpha ph
      real(dp), intent(in) :: hertz_pressure_pa           !! ph, Pa
      type(rheology_t) :: other
      other = new_rheology(self%viscosity_law, self%density_law, alphabar, self%z, hertz_pressure_pa)
   end function at_pressure

   !> Density, fluidity 1/eta and their derivatives at pressures P >= 0, theory section 3:
   !>
   !>     rho = (5.9e8 + 1.34 ph P)/(5.9e8 + ph P)                       Dowson-Higginson
   !>     eta = exp((alpha p0/z) ((1 + ph P/p0)^z - 1))                  Roelands
   !>     eta = exp(alphabar P)                                          Barus
   !>
   !> Written as plain loops over contiguous arrays so that exp and log are vectorised.
   pure subroutine evaluate(self, n, p, rho, drho, fluidity, dln_eta)
      class(rheology_t), intent(in) :: self
      integer, intent(in) :: n
      real(dp), intent(in) :: p(n)          !! P
      real(dp), intent(out) :: rho(n)       !! rho/rho0
      real(dp), intent(out) :: drho(n)      !! d rho/d P
      real(dp), intent(out) :: fluidity(n)  !! eta0/eta
      real(dp), intent(out) :: dln_eta(n)   !! d ln(eta)/d P
      real(dp) :: c, f, g, power, x, z
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
   end function density

end module ehlwave_rheology
