!> The laws of an oil for the dimensionless equations: functions of P, at the reference temperature or a rise over it.
module ehlwave_rheology
   use ehlwave_carreau_law, only: new_carreau_law
   use ehlwave_density_law, only: density_law_t
   use ehlwave_film_flow, only: film_flow_t, new_film_flow
   use ehlwave_flow_law, only: flow_law_t
   use ehlwave_incompressible_density, only: incompressible_density_t
   use ehlwave_isoviscous_law, only: isoviscous_law_t
   use ehlwave_kinds, only: dp
   use ehlwave_shear_limit, only: new_shear_limit
   use ehlwave_viscosity_law, only: viscosity_law_t
   implicit none (type, external)
   private
   public :: new_rheology

   !> Values that the laws are asked for at a time, which stay in the cache.
   integer, parameter, public :: block_size = 256

   type, public :: rheology_t
      private
      class(viscosity_law_t), allocatable :: viscosity
      class(density_law_t), allocatable :: density_law
      class(flow_law_t), allocatable :: flow_law   !! unallocated for a Newtonian oil
      real(dp) :: ph_pa = 0                        !! ph, Pa
      real(dp) :: exponent_factor = 1              !! factor on ln(eta/eta0)
      real(dp) :: modulus_times_stress_pa2 = 0     !! E' tau0
      real(dp) :: modulus_times_limit_pa = 0       !! E' times the limit of the stress over the pressure; 0: none
      real(dp) :: limit_width = 0
   contains
      procedure :: evaluate
      procedure :: ln_viscosity
      procedure :: expansivity
      procedure :: use_limit
      procedure :: is_limited
      procedure :: generalise
      procedure :: density
      procedure :: thickening
      procedure :: largest_pressure
      procedure :: in_pascals
      procedure :: at_pressure
      procedure :: depends_on_alpha
      procedure :: with_alpha
      procedure :: with_stress
      procedure :: use_flow
      procedure :: is_newtonian
      procedure :: film_flow
   end type rheology_t

contains

   !> Newtonian oil of a contact with Hertz pressure ph. Where ph is 0 (L = 0, pressure in pascal is unknown), viscosity
   !> and density are constant, whatever the laws.
   pure function new_rheology(viscosity, density, hertz_pressure_pa) result(self)
      class(viscosity_law_t), intent(in) :: viscosity
      class(density_law_t), intent(in) :: density
      real(dp), intent(in) :: hertz_pressure_pa           !! ph, Pa
      type(rheology_t) :: self
      self%ph_pa = hertz_pressure_pa
      if (hertz_pressure_pa > 0) then
         allocate (self%viscosity, source=viscosity)
         allocate (self%density_law, source=density)
      else
         allocate (self%viscosity, source=isoviscous_law_t())
         allocate (self%density_law, source=incompressible_density_t())
      end if
   end function new_rheology

   !> Take a law of flow that is not Newtonian.
   pure subroutine use_flow(self, law, modulus_times_stress_pa2)
      class(rheology_t), intent(inout) :: self
      class(flow_law_t), intent(in) :: law
      real(dp), intent(in) :: modulus_times_stress_pa2   !! E' tau0, Pa^2; tau0 holds G of Carreau's law
      if (allocated(self%flow_law)) deallocate (self%flow_law)
      allocate (self%flow_law, source=law)
      self%modulus_times_stress_pa2 = modulus_times_stress_pa2
   end subroutine use_flow

   !> Make a Newtonian oil use Newton's flow law explicitly, where its viscosity varies across the film.
   pure subroutine generalise(self)
      class(rheology_t), intent(inout) :: self
      if (self%is_newtonian()) call self%use_flow(new_carreau_law(1.0_dp), self%ph_pa**2)
   end subroutine generalise

   !> Take a limit of the stress; without it there is none. The oil is not Newtonian.
   pure subroutine use_limit(self, modulus_times_limit_pa, width)
      class(rheology_t), intent(inout) :: self
      real(dp), intent(in) :: modulus_times_limit_pa   !! E' times the limit over the pressure, Pa
      real(dp), intent(in) :: width                    !! see `ehlwave_shear_limit`
      self%modulus_times_limit_pa = modulus_times_limit_pa
      self%limit_width = width
   end subroutine use_limit

   !> Whether the shear stress is proportional to the shear rate.
   pure logical function is_newtonian(self)
      class(rheology_t), intent(in) :: self
      is_newtonian = .not. allocated(self%flow_law)
   end function is_newtonian

   !> Flow across the film of a contact: N0 = c ph/(2 a tau0) = K ph^2/(E' tau0), K = 1 for a line contact.
   pure function film_flow(self, k, lambdabar, slip_parameter) result(flow)
      class(rheology_t), intent(in) :: self
      real(dp), intent(in) :: k                           !! complete elliptic integral K
      real(dp), intent(in) :: lambdabar, slip_parameter   !! dimensionless speed, S
      type(film_flow_t) :: flow
      flow = new_film_flow(self%flow_law, k*self%ph_pa**2/self%modulus_times_stress_pa2, lambdabar, slip_parameter)
      if (self%modulus_times_limit_pa > 0) flow%limit = &
         new_shear_limit(self%ph_pa*self%modulus_times_limit_pa/self%modulus_times_stress_pa2, self%limit_width)
   end function film_flow

   !> Oil of a contact at another Hertz pressure.
   pure function at_pressure(self, hertz_pressure_pa) result(other)
      class(rheology_t), intent(in) :: self
      real(dp), intent(in) :: hertz_pressure_pa           !! ph, Pa
      type(rheology_t) :: other
      other = self
      other%ph_pa = hertz_pressure_pa
   end function at_pressure

   !> Whether the viscosity varies with pressure.
   pure logical function depends_on_alpha(self)
      class(rheology_t), intent(in) :: self
      type(isoviscous_law_t) :: constant
      depends_on_alpha = .not. same_type_as(self%viscosity, constant)
   end function depends_on_alpha

   !> Oil with ln(eta/eta0) scaled by a factor at every pressure.
   pure function with_alpha(self, factor) result(other)
      class(rheology_t), intent(in) :: self
      real(dp), intent(in) :: factor   !! > 0
      type(rheology_t) :: other
      other = self
      other%exponent_factor = factor*self%exponent_factor
   end function with_alpha

   !> Whether the stress has a limit.
   pure logical function is_limited(self)
      class(rheology_t), intent(in) :: self
      is_limited = self%modulus_times_limit_pa > 0
   end function is_limited

   !> Oil with the stress of its flow law and its limiting stress scaled by a factor.
   pure function with_stress(self, factor) result(other)
      class(rheology_t), intent(in) :: self   !! not Newtonian
      real(dp), intent(in) :: factor          !! > 0
      type(rheology_t) :: other
      other = self
      other%modulus_times_stress_pa2 = factor*self%modulus_times_stress_pa2
      other%modulus_times_limit_pa = factor*self%modulus_times_limit_pa
   end function with_stress

   !> Density, fluidity 1/eta and their derivatives at pressures P >= 0.
   pure subroutine evaluate(self, n, p, rho, drho, fluidity, dln_eta, rise_k)
      class(rheology_t), intent(in) :: self
      integer, intent(in) :: n
      real(dp), intent(in) :: p(n)          !! P
      real(dp), intent(out) :: rho(n)       !! rho/rho0
      real(dp), intent(out) :: drho(n)      !! d rho/d P
      real(dp), intent(out) :: fluidity(n)  !! eta0/eta
      real(dp), intent(out) :: dln_eta(n)   !! d ln(eta)/d P
      real(dp), intent(in), optional :: rise_k(n)   !! T - T0, K; absent: 0
      real(dp), dimension(block_size) :: exponent, p_pa, rise, slope, slope_per_k
      integer :: first, i, last, m

      rise = 0
      do first = 1, n, block_size
         last = min(first + block_size - 1, n)
         m = last - first + 1
         p_pa(:m) = self%ph_pa*p(first:last)
         if (present(rise_k)) rise(:m) = rise_k(first:last)
         call self%density_law%evaluate(m, p_pa, rise, rho(first:last), slope, slope_per_k)
         drho(first:last) = self%ph_pa*slope(:m)
         call self%viscosity%evaluate(m, p_pa, rise, exponent, slope, slope_per_k)
         do i = 1, m
            fluidity(first + i - 1) = exp(-self%exponent_factor*exponent(i))
            dln_eta(first + i - 1) = self%exponent_factor*self%ph_pa*slope(i)
         end do
      end do
   end subroutine evaluate

   !> ln(eta/eta0) and its derivative by temperature, 1/K, at some rises for each pressure P >= 0.
   pure subroutine ln_viscosity(self, n, rises, p, rise_k, exponent, slope_per_k)
      class(rheology_t), intent(in) :: self
      integer, intent(in) :: n, rises
      real(dp), intent(in) :: p(n), rise_k(n, rises)   !! P; T - T0, K
      real(dp), intent(out) :: exponent(n, rises), slope_per_k(n, rises)
      call self%viscosity%evaluate_rises(n, rises, self%ph_pa*p, rise_k, exponent, slope_per_k)
      exponent = self%exponent_factor*exponent
      slope_per_k = self%exponent_factor*slope_per_k
   end subroutine ln_viscosity

   !> -d ln(rho)/dT at pressures P >= 0, 1/K.
   pure subroutine expansivity(self, n, p, rise_k, expansion)
      class(rheology_t), intent(in) :: self
      integer, intent(in) :: n
      real(dp), intent(in) :: p(n), rise_k(n)   !! P; T - T0, K
      real(dp), intent(out) :: expansion(n)
      real(dp), dimension(block_size) :: p_pa, rho, slope
      integer :: first, last, m

      do first = 1, n, block_size
         last = min(first + block_size - 1, n)
         m = last - first + 1
         p_pa(:m) = self%ph_pa*p(first:last)
         call self%density_law%evaluate(m, p_pa, rise_k(first:last), rho, slope, expansion(first:last))
         expansion(first:last) = -expansion(first:last)/rho(:m)
      end do
   end subroutine expansivity

   !> d ln(eta)/dP at P = 0.
   pure real(dp) function thickening(self)
      class(rheology_t), intent(in) :: self
      real(dp), dimension(1) :: drho, fluidity, rho, slope
      call self%evaluate(1, [0.0_dp], rho, drho, fluidity, slope)
      thickening = slope(1)
   end function thickening

   !> P up to which the viscosity is known; beyond it the law is extrapolated.
   pure real(dp) function largest_pressure(self) result(largest)
      class(rheology_t), intent(in) :: self
      largest = huge(largest)
      if (self%viscosity%largest_pressure_pa < huge(largest)) largest = self%viscosity%largest_pressure_pa/self%ph_pa
   end function largest_pressure

   !> A pressure P in pascals.
   pure real(dp) function in_pascals(self, p)
      class(rheology_t), intent(in) :: self
      real(dp), intent(in) :: p   !! P
      in_pascals = self%ph_pa*p
   end function in_pascals

   !> Density at pressures P >= 0.
   pure function density(self, p, rise_k) result(rho)
      class(rheology_t), intent(in) :: self
      real(dp), intent(in), contiguous :: p(:, :)   !! P
      real(dp), intent(in), optional :: rise_k(:, :)   !! T - T0, K; absent: 0
      real(dp) :: rho(size(p, 1), size(p, 2))
      real(dp), dimension(block_size) :: rise, slope, slope_per_k
      integer :: first, j, last

      rise = 0
      do j = 1, size(p, 2)
         do first = 1, size(p, 1), block_size
            last = min(first + block_size - 1, size(p, 1))
            if (present(rise_k)) rise(:last - first + 1) = rise_k(first:last, j)
            call self%density_law%evaluate(last - first + 1, self%ph_pa*p(first:last, j), rise, &
               rho(first:last, j), slope, slope_per_k)
         end do
      end do
   end function density

end module ehlwave_rheology
