!> The keys of group &lubricant: the laws of the oil and their parameters. `contact/oil` lists the laws.
module ehlwave_oil_keys
   use ehlwave_case_key, only: key_t
   use ehlwave_key_list, only: key_list_t
   use ehlwave_kinds, only: dp
   use ehlwave_number_table, only: path_length
   use ehlwave_oil, only: barus, carreau, density_laws, doolittle, eyring, flow_laws, isoviscous, mcewen, oil_t, &
      roelands, tabulated, tait, viscosity_laws, yasutomi
   implicit none (type, external)
   private
   public :: visit_oil_keys

   character(len=*), parameter :: alpha_laws = "viscosity_law = '"//roelands//"', '"//barus//"' or '"//isoviscous//"'"

contains

   subroutine visit_oil_keys(oil, is_warm, list)
      type(oil_t), intent(inout) :: oil
      logical, intent(in) :: is_warm             !! whether temperatures are found
      type(key_list_t), intent(inout) :: list

      call list%enter('lubricant', 'Viscosity and density of the lubricant, and how it shears.')
      call list%see(oil%pressure_viscosity_per_pa, key_t('pressure_viscosity_per_pa', 'pressure-viscosity '// &
         'coefficient alpha; '// &
         'sets ph = alphabar/alpha, also where M, L and D are given', unit='1/Pa', minimum=1e-10_dp, maximum=1e-6_dp, &
         applies=oil%takes_alpha(), &
         when=alpha_laws//' (the others have alpha from their parameters: the film-forming coefficient)'))
      call list%see(oil%roelands%index, key_t('roelands_index', "index z of Roelands' viscosity", above=0.0_dp, &
         maximum=2.0_dp, applies=oil%takes_alpha(), counts=oil%viscosity_law == roelands, &
         when="viscosity_law = '"//roelands//"'"))
      call list%see(oil%viscosity_law, key_t('viscosity_law', 'viscosity against pressure', choices=viscosity_laws))
      call list%see(oil%density_law, key_t('density_law', 'density against pressure', choices=density_laws))
      call visit_flow_law(oil, list)
      call visit_viscosity_laws(oil, list)
      call visit_free_volume(oil, is_warm, list)
      call visit_table(oil, is_warm, list)
   end subroutine visit_oil_keys

   !> The keys that follow belong to a law.
   subroutine belong(list, key, law, chosen)
      type(key_list_t), intent(inout) :: list
      character(len=*), intent(in) :: key, law   !! a name in `key`,
      character(len=*), intent(in) :: chosen     !! which has this value
      list%common = key_t(is_late=.true., applies=chosen == law, when=key//" = '"//law//"'")
   end subroutine belong

   subroutine visit_flow_law(oil, list)
      type(oil_t), intent(inout) :: oil
      type(key_list_t), intent(inout) :: list

      list%common = key_t(is_late=.true.)
      call list%see(oil%flow_law, key_t('flow_law', "shear rate against shear stress; 'eyring': Ree-Eyring, "// &
         'sinh(tau/tau0) tau0/eta', choices=flow_laws))
      call belong(list, 'flow_law', eyring, oil%flow_law)
      call list%see(oil%eyring_stress_pa, key_t('eyring_stress_pa', 'Eyring stress tau0', unit='Pa', minimum=1e4_dp))
      call belong(list, 'flow_law', carreau, oil%flow_law)
      call list%see(oil%carreau_modulus_pa, key_t('carreau_modulus_pa', 'stress G at which thinning begins', &
         unit='Pa', minimum=1e2_dp))
      call list%see(oil%carreau_exponent, key_t('carreau_exponent', 'exponent n of the shear rate; 1: Newtonian', &
         minimum=0.1_dp, maximum=1.0_dp))
      list%common = key_t(is_late=.true.)
      call list%see(oil%shear_limit_over_pressure, key_t('shear_limit_over_pressure', 'largest shear stress over '// &
         'pressure, which the stress nears but does not pass; 0: no limit', minimum=0.0_dp, maximum=1.0_dp))
      list%common%applies = oil%shear_limit_over_pressure > 0
      list%common%when = 'shear_limit_over_pressure'
      call list%see(oil%shear_limit_width, key_t('shear_limit_width', 'width of the limit: at (1 - width) times '// &
         'the limit the shear rate is twice the rate of flow_law', minimum=0.01_dp, maximum=0.5_dp))
   end subroutine visit_flow_law

   subroutine visit_viscosity_laws(oil, list)
      type(oil_t), intent(inout) :: oil
      type(key_list_t), intent(inout) :: list

      call belong(list, 'viscosity_law', mcewen, oil%viscosity_law)
      call list%see(oil%mcewen%alpha0_per_pa, key_t('mcewen_coefficient_per_pa', 'coefficient alpha0 of (1 + '// &
         'alpha0 p/q)^q', unit='1/Pa', above=0.0_dp))
      call list%see(oil%mcewen%exponent, key_t('mcewen_exponent', 'exponent q of (1 + alpha0 p/q)^q', above=1.0_dp))
      call belong(list, 'viscosity_law', yasutomi, oil%viscosity_law)
      call list%see(oil%yasutomi%c1, key_t('yasutomi_c1', 'C1 of the improved Yasutomi law', above=0.0_dp))
      call list%see(oil%yasutomi%c2_k, key_t('yasutomi_c2_k', 'C2 of the improved Yasutomi law', unit='K', &
         above=0.0_dp))
      call list%see(oil%yasutomi%above_glass_k, key_t('yasutomi_above_glass_k', 'temperature of the oil above its '// &
         'glass transition at ambient pressure, T - Tg0', unit='K', above=0.0_dp))
      call list%see(oil%yasutomi%a1_k, key_t('yasutomi_a1_k', 'A1 of Tg = Tg0 + A1 ln(1 + A2 p)', unit='K', &
         above=0.0_dp))
      call list%see(oil%yasutomi%a2_per_pa, key_t('yasutomi_a2_per_pa', 'A2 of Tg = Tg0 + A1 ln(1 + A2 p)', &
         unit='1/Pa', above=0.0_dp))
      call list%see(oil%yasutomi%b1_per_pa, key_t('yasutomi_b1_per_pa', 'b1 of F = (1 + b1 p)^b2', unit='1/Pa', &
         above=0.0_dp))
      call list%see(oil%yasutomi%b2, key_t('yasutomi_b2', 'b2 of F = (1 + b1 p)^b2; below 0', minimum=-10.0_dp, &
         maximum=-1e-6_dp))
   end subroutine visit_viscosity_laws

   !> Doolittle's viscosity and Tait's density, which share the volume.
   subroutine visit_free_volume(oil, is_warm, list)
      type(oil_t), intent(inout) :: oil
      logical, intent(in) :: is_warm
      type(key_list_t), intent(inout) :: list

      call belong(list, 'viscosity_law', doolittle, oil%viscosity_law)
      call list%see(oil%doolittle%factor, key_t('doolittle_factor', 'factor B of the Doolittle law', above=0.0_dp))
      call list%see(oil%doolittle%occupied_fraction, key_t('doolittle_occupied_fraction', &
         'occupied volume over the volume at ambient pressure, R0', above=0.0_dp, maximum=0.99_dp))
      list%common = key_t(is_late=.true., applies=oil%viscosity_law == doolittle .or. oil%density_law == tait, &
                          when="density_law = '"//tait//"' or viscosity_law = '"//doolittle//"'")
      call list%see(oil%tait%modulus_pa, key_t('tait_modulus_pa', 'bulk modulus at ambient pressure, K0', unit='Pa', &
         above=0.0_dp))
      call list%see(oil%tait%modulus_rate, key_t('tait_modulus_rate', "rate of change of the bulk modulus with "// &
         "pressure, K0'; "//'near 11', above=0.0_dp))
      list%common%applies = list%common%applies .and. is_warm
      list%common%when = '('//trim(list%common%when)//') and &heat'
      call list%see(oil%tait%softening_per_k, key_t('tait_softening_per_k', 'bK of the bulk modulus '// &
         'K0 exp(-bK (T - T0)); near 0.006', unit='1/K', minimum=0.0_dp, maximum=0.1_dp))
      call belong(list, 'viscosity_law', doolittle, oil%viscosity_law)
      list%common%applies = list%common%applies .and. is_warm
      list%common%when = trim(list%common%when)//' and &heat'
      call list%see(oil%doolittle%occupied_rate_per_k, key_t('doolittle_occupied_rate_per_k', 'e of the occupied '// &
         'volume R0 (1 + e (T - T0)); near -0.001', unit='1/K', minimum=-0.01_dp, maximum=0.01_dp))
   end subroutine visit_free_volume

   !> Measured viscosities, and the temperature at which the oil has them.
   subroutine visit_table(oil, is_warm, list)
      type(oil_t), intent(inout) :: oil
      logical, intent(in) :: is_warm
      type(key_list_t), intent(inout) :: list

      call belong(list, 'viscosity_law', tabulated, oil%viscosity_law)
      call list%see(oil%viscosity_file, key_t('viscosity_table', 'CSV file of measured viscosities; columns '// &
         'pressure_pa, viscosity_pa_s and, of more than one temperature, temperature_k', minimum=1.0_dp, &
         maximum=real(path_length, dp), file='viscosity'))
      list%common%applies = oil%takes_temperature() .or. is_warm
      list%common%when = trim(list%common%when)//" or &heat"
      call list%see(oil%temperature_k, key_t('temperature_k', 'temperature T0 of the oil; may be left out with '// &
         'a table of one temperature', unit='K', minimum=0.0_dp, default='none'))
   end subroutine visit_table

end module ehlwave_oil_keys
