!> The oil of a case: the list of viscosity, density and flow laws, by name, and their parameters.
!>
!> A new law is a module that extends `viscosity_law_t`, `density_law_t` or `flow_law_t`. Enter here its name, its
!> parameters (a component of `oil_t`) and its `case`; its keys are in `input/oil_keys`. Measured values come from
!> `viscosity_file`, which `case/case_lubricant` reads.
module ehlwave_oil
   use ehlwave_barus_law, only: barus_law_t
   use ehlwave_carreau_law, only: new_carreau_law
   use ehlwave_density_law, only: density_law_t
   use ehlwave_doolittle_law, only: doolittle_law_t
   use ehlwave_dowson_higginson_density, only: dowson_higginson_density_t
   use ehlwave_errors, only: error_t, raise
   use ehlwave_eyring_law, only: eyring_law_t
   use ehlwave_flow_law, only: flow_law_t
   use ehlwave_incompressible_density, only: incompressible_density_t
   use ehlwave_isoviscous_law, only: isoviscous_law_t
   use ehlwave_kinds, only: dp
   use ehlwave_mcewen_law, only: mcewen_law_t
   use ehlwave_number_table, only: number_table_t, path_length
   use ehlwave_roelands_law, only: roelands_law_t
   use ehlwave_table_law, only: new_table_law, table_law_t
   use ehlwave_tait_density, only: tait_density_t
   use ehlwave_viscosity_law, only: viscosity_law_t
   use ehlwave_yasutomi_law, only: yasutomi_law_t
   implicit none (type, external)
   private

   integer, parameter :: name_length = 20

   character(len=*), parameter, public :: roelands = 'roelands', barus = 'barus', isoviscous = 'isoviscous', &
      mcewen = 'mcewen', yasutomi = 'yasutomi', doolittle = 'doolittle', tabulated = 'table'
   character(len=*), parameter, public :: viscosity_laws = roelands//' '//barus//' '//isoviscous//' '//mcewen//' '// &
      yasutomi//' '//doolittle//' '//tabulated

   character(len=*), parameter, public :: dowson_higginson = 'dowson_higginson', incompressible = 'incompressible', &
      tait = 'tait'
   character(len=*), parameter, public :: density_laws = dowson_higginson//' '//incompressible//' '//tait

   character(len=*), parameter, public :: newtonian = 'newtonian', eyring = 'eyring', carreau = 'carreau'
   character(len=*), parameter, public :: flow_laws = newtonian//' '//eyring//' '//carreau

   type, public :: oil_t
      character(len=name_length) :: viscosity_law = roelands
      character(len=name_length) :: density_law = dowson_higginson
      character(len=name_length) :: flow_law = newtonian
      character(len=path_length) :: viscosity_file = ''             !! measured values, of laws that are made from them,
      type(number_table_t) :: measured                              !! values of the file, once read
      real(dp) :: temperature_k = 0                                 !! T0, of laws that take it; 0: not given
      real(dp) :: pressure_viscosity_per_pa = 2.2e-8_dp             !! alpha, where it is given
      type(roelands_law_t) :: roelands
      type(mcewen_law_t) :: mcewen
      type(yasutomi_law_t) :: yasutomi
      type(doolittle_law_t) :: doolittle                            !! without its volume, which comes from `tait`:
      type(tait_density_t) :: tait = tait_density_t(modulus_rate=0)
      real(dp) :: eyring_stress_pa = 0                              !! tau0
      real(dp) :: carreau_modulus_pa = 0, carreau_exponent = 0      !! G, n
      real(dp) :: shear_limit_over_pressure = 0, shear_limit_width = 0.1_dp   !! 0: no limit; see `shear_limit`
      ! properties for laws of temperature:
      real(dp) :: beta_per_k = 0                                    !! -d ln(eta)/dT at ambient pressure and T0
      real(dp) :: expansion_per_k = 0                               !! -d ln(rho)/dT there
   contains
      procedure :: make_viscosity
      procedure :: make_density
      procedure :: make_flow
      procedure :: is_newtonian
      procedure :: takes_alpha
      procedure :: takes_temperature
      procedure :: takes_beta
      procedure :: stress_pa
      procedure :: flow_exponent
   end type oil_t

contains

   !> The viscosity law that the oil follows. Fails on measured values of which no law can be made.
   pure subroutine make_viscosity(self, law, error)
      class(oil_t), intent(in) :: self
      class(viscosity_law_t), allocatable, intent(inout) :: law   !! unallocated before
      type(error_t), allocatable, intent(out) :: error
      type(roelands_law_t) :: with_alpha
      type(mcewen_law_t) :: with_beta
      type(doolittle_law_t) :: with_volume
      type(table_law_t) :: with_values

      select case (self%viscosity_law)
      case (roelands)
         with_alpha = self%roelands
         with_alpha%alpha_per_pa = self%pressure_viscosity_per_pa
         with_alpha%beta_per_k = self%beta_per_k
         with_alpha%temperature_k = self%temperature_k
         allocate (law, source=with_alpha)
      case (barus)
         allocate (law, source=barus_law_t(alpha_per_pa=self%pressure_viscosity_per_pa, beta_per_k=self%beta_per_k))
      case (isoviscous)
         allocate (law, source=isoviscous_law_t(alpha_per_pa=self%pressure_viscosity_per_pa, &
                                                beta_per_k=self%beta_per_k))
      case (mcewen)
         with_beta = self%mcewen
         with_beta%beta_per_k = self%beta_per_k
         allocate (law, source=with_beta)
      case (yasutomi)
         allocate (law, source=self%yasutomi)
      case (doolittle)
         with_volume = self%doolittle
         with_volume%tait = self%tait
         with_volume%tait%expansion_per_k = self%expansion_per_k
         allocate (law, source=with_volume)
      case (tabulated)
         call new_table_law(self%measured, self%temperature_k, with_values, error)
         if (.not. allocated(error)) allocate (law, source=with_values)
      case default
         call raise(error, "no viscosity_law is called '"//trim(self%viscosity_law)//"': write one of "//viscosity_laws)
      end select
   end subroutine make_viscosity

   !> The density law that the oil follows.
   pure subroutine make_density(self, law)
      class(oil_t), intent(in) :: self
      class(density_law_t), allocatable, intent(inout) :: law   !! unallocated before
      type(tait_density_t) :: with_expansion

      select case (self%density_law)
      case (dowson_higginson)
         allocate (law, source=dowson_higginson_density_t(expansion_per_k=self%expansion_per_k))
      case (incompressible)
         allocate (law, source=incompressible_density_t(expansion_per_k=self%expansion_per_k))
      case (tait)
         with_expansion = self%tait
         with_expansion%expansion_per_k = self%expansion_per_k
         allocate (law, source=with_expansion)
      end select
   end subroutine make_density

   !> The flow law that the oil follows; unallocated for a Newtonian oil.
   pure subroutine make_flow(self, law)
      class(oil_t), intent(in) :: self
      class(flow_law_t), allocatable, intent(inout) :: law   !! unallocated before

      select case (self%flow_law)
      case (eyring)
         allocate (law, source=eyring_law_t())
      case (carreau)
         allocate (law, source=new_carreau_law(self%carreau_exponent))
      end select
   end subroutine make_flow

   !> Whether the shear stress is proportional to the shear rate.
   elemental logical function is_newtonian(self)
      class(oil_t), intent(in) :: self
      is_newtonian = self%flow_law == newtonian
   end function is_newtonian

   !> Whether the viscosity law has alpha from its key; the others have it from parameters of their own.
   pure logical function takes_alpha(self)
      class(oil_t), intent(in) :: self
      takes_alpha = any(self%viscosity_law == [character(len=name_length) :: roelands, barus, isoviscous])
   end function takes_alpha

   !> Whether a law of the oil asks for the temperature T0.
   pure logical function takes_temperature(self)
      class(oil_t), intent(in) :: self
      takes_temperature = any(self%viscosity_law == [character(len=name_length) :: tabulated])
   end function takes_temperature

   !> Whether the viscosity varies with temperature by beta; other laws have parameters of their own for that.
   pure logical function takes_beta(self)
      class(oil_t), intent(in) :: self
      takes_beta = self%takes_alpha() .or. self%viscosity_law == mcewen
   end function takes_beta

   !> n of a Carreau oil, to whose power the stress grows with the shear rate; 0 of Ree-Eyring's, which grows as its
   !> logarithm.
   pure real(dp) function flow_exponent(self)
      class(oil_t), intent(in) :: self
      flow_exponent = 0
      if (self%flow_law == carreau) flow_exponent = self%carreau_exponent
   end function flow_exponent

   !> The stress by which the flow law is made dimensionless: tau0 of Ree-Eyring's law, G of Carreau's; 0 for a
   !> Newtonian oil.
   pure real(dp) function stress_pa(self)
      class(oil_t), intent(in) :: self
      stress_pa = 0
      if (self%flow_law == eyring) stress_pa = self%eyring_stress_pa
      if (self%flow_law == carreau) stress_pa = self%carreau_modulus_pa
   end function stress_pa

end module ehlwave_oil
