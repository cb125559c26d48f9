!> The keys of group &touching: surfaces that touch where the film is thinner than a boundary film.
module ehlwave_touching_keys
   use ehlwave_case_key, only: key_t
   use ehlwave_effect_keys, only: by_fas, by_second_order, effect_keys_t
   use ehlwave_key_list, only: key_list_t
   use ehlwave_kinds, only: dp
   use ehlwave_touching_data, only: hard, soft, touching_data_t
   implicit none (type, external)
   private

   type, extends(effect_keys_t), public :: touching_keys_t
      type(touching_data_t) :: data
   contains
      procedure, nopass :: follows
      procedure :: visit
      procedure :: is_given
      procedure, nopass :: refuses
      procedure, nopass :: mandatory_key
   end type touching_keys_t

contains

   pure function follows() result(group)
      character(len=:), allocatable :: group
      group = 'lubricant'
   end function follows

   subroutine visit(self, list)
      class(touching_keys_t), intent(inout) :: self
      type(key_list_t), intent(inout) :: list
      call visit_data(self%data, list)
   end subroutine visit

   elemental logical function is_given(self)
      class(touching_keys_t), intent(in) :: self
      is_given = self%data%is_given()
   end function is_given

   pure logical function refuses(method)
      integer, intent(in) :: method
      refuses = any(method == [by_fas, by_second_order])
   end function refuses

   pure function mandatory_key() result(name)
      character(len=:), allocatable :: name
      name = 'film_m'
   end function mandatory_key

   subroutine visit_data(touching, list)
      type(touching_data_t), intent(inout) :: touching
      type(key_list_t), intent(inout) :: list

      call list%enter('touching', 'Surfaces that touch where the film falls to a boundary film: mixed lubrication. '// &
         'Absent: solids bear nothing. Needs dimensional conditions.')
      list%common = key_t(is_late=.true., is_written=touching%is_given())
      call list%see(touching%film_m, key_t('film_m', 'boundary film H_b; gap at which solids begin to bear, '// &
         'on which their share depends', unit='m', minimum=1e-10_dp, maximum=1e-5_dp, is_required=.true.))
      call list%see(touching%share, key_t('share', 'share of the load that the solids bear; the speed at which '// &
         'they '// &
         'do is found, from mean_speed_m_per_s on; none: at the speed given', above=0.0_dp, maximum=0.999_dp))
      list%common%applies = touching%is_given()
      list%common%when = '&touching film_m'
      call list%see(touching%law, key_t('law', "pressure of the solids; 'hard': the gap stays the boundary film, "// &
         "'soft': stress_pa exp((film_m - gap)/softness_m), of roughness finer than the grid", choices=hard//' '//soft))
      call list%see(touching%solid_friction, key_t('solid_friction', 'friction coefficient of the solids', &
         minimum=0.0_dp, maximum=10.0_dp))
      list%common%applies = touching%law == soft
      list%common%when = "law = 'soft'"
      call list%see(touching%softness_m, key_t('softness_m', 'fall of the gap by which the pressure of the solids '// &
         'grows e times', unit='m', above=0.0_dp, maximum=1e-5_dp, is_required=.true.))
      call list%see(touching%stress_pa, key_t('stress_pa', 'pressure of the solids at the boundary film', unit='Pa', &
         above=0.0_dp, is_required=.true.))
   end subroutine visit_data

end module ehlwave_touching_keys
