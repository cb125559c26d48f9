!> The keys of group &heat: how oil and bodies conduct and store heat. With them temperatures are found.
module ehlwave_heat_keys
   use ehlwave_case_key, only: key_t
   use ehlwave_effect_keys, only: by_fas, by_fitted_scheme, by_long_steps, effect_keys_t
   use ehlwave_film_levels, only: most_levels
   use ehlwave_heat_data, only: body_heat_t, carried, frozen, heat_data_t
   use ehlwave_key_list, only: key_list_t
   use ehlwave_kinds, only: dp
   implicit none (type, external)
   private

   type, extends(effect_keys_t), public :: heat_keys_t
      type(heat_data_t) :: data
   contains
      procedure, nopass :: follows
      procedure :: visit
      procedure :: is_given
      procedure, nopass :: refuses
      procedure, nopass :: finds_temperatures
      procedure, nopass :: mandatory_key
   end type heat_keys_t

contains

   pure function follows() result(group)
      character(len=:), allocatable :: group
      group = 'lubricant'
   end function follows

   subroutine visit(self, list)
      class(heat_keys_t), intent(inout) :: self
      type(key_list_t), intent(inout) :: list
      call visit_data(self%data, list)
   end subroutine visit

   elemental logical function is_given(self)
      class(heat_keys_t), intent(in) :: self
      is_given = self%data%is_given()
   end function is_given

   pure logical function refuses(method)
      integer, intent(in) :: method
      refuses = any(method == [by_fas, by_fitted_scheme, by_long_steps])
   end function refuses

   pure logical function finds_temperatures()
      finds_temperatures = .true.
   end function finds_temperatures

   pure function mandatory_key() result(name)
      character(len=:), allocatable :: name
      name = 'oil_conductivity_w_per_m_k'
   end function mandatory_key

   subroutine visit_data(heat, list)
      type(heat_data_t), intent(inout) :: heat
      type(key_list_t), intent(inout) :: list

      call list%enter('heat', 'Heat of the film and of both bodies; absent: the contact is isothermal at T0. As '// &
         'waves pass, temperatures are frozen at the smooth contact, or computed in time.')
      list%common = key_t(is_late=.true., is_written=heat%is_given())
      call list%see(heat%oil_conductivity_w_per_m_k, key_t('oil_conductivity_w_per_m_k', 'conductivity of the oil', &
         unit='W/(m K)', above=0.0_dp, default='none'))
      call list%see(heat%oil_heat_capacity_j_per_kg_k, key_t('oil_heat_capacity_j_per_kg_k', 'heat capacity of '// &
         'the oil', unit='J/(kg K)', above=0.0_dp, default='none'))
      call list%see(heat%oil_density_kg_per_m3, key_t('oil_density_kg_per_m3', 'density of the oil at ambient '// &
         'pressure and T0', unit='kg/m3', above=0.0_dp, default='none'))
      call list%see(heat%oil_expansion_per_k, key_t('oil_expansion_per_k', 'thermal expansion of the oil; its '// &
         'density falls and its compression heats by it', unit='1/K', minimum=0.0_dp, maximum=0.01_dp))
      call list%see(heat%viscosity_temperature_per_k, key_t('viscosity_temperature_per_k', 'beta; -d ln(eta)/dT at '// &
         'ambient pressure and T0, of laws without parameters of their own for temperature', unit='1/K', &
         minimum=0.0_dp, maximum=1.0_dp))
      list%common%applies = heat%is_given()
      list%common%when = '&heat with the data of the oil (oil_conductivity_w_per_m_k, ...)'
      call visit_body('body', heat%body(1), ' of the bodies', list)
      call visit_body('body2', heat%body(2), ' of the body of surface 2', list)
      call list%see(heat%levels, key_t('levels', 'intervals across the film', minimum=4.0_dp, &
         maximum=real(most_levels, dp)))
      call list%see(heat%wave_temperatures, key_t('wave_temperatures', "temperatures in marches; 'frozen': those "// &
         "of the smooth contact; 'carried': of the oil and of both surfaces as heat flows in time", &
         choices=frozen//' '//carried))
   end subroutine visit_data

   subroutine visit_body(name, body, of, list)
      character(len=*), intent(in) :: name, of
      type(body_heat_t), intent(inout) :: body
      type(key_list_t), intent(inout) :: list
      character(len=16) :: default

      default = merge('as body_...', '           ', name == 'body2')
      call list%see(body%conductivity_w_per_m_k, key_t(name//'_conductivity_w_per_m_k', 'conductivity'//of, &
         unit='W/(m K)', above=0.0_dp, default=default))
      call list%see(body%density_kg_per_m3, key_t(name//'_density_kg_per_m3', 'density'//of, unit='kg/m3', &
         above=0.0_dp, default=default))
      call list%see(body%heat_capacity_j_per_kg_k, key_t(name//'_heat_capacity_j_per_kg_k', 'heat capacity'//of, &
         unit='J/(kg K)', above=0.0_dp, default=default))
   end subroutine visit_body

end module ehlwave_heat_keys
