!> Keys of a contact with less oil than it could take.
module ehlwave_starvation_keys
   use ehlwave_case_key, only: key_t
   use ehlwave_effect_keys, only: by_fas, by_fitted_scheme, by_long_steps, by_second_order, effect_keys_t
   use ehlwave_key_list, only: key_list_t
   use ehlwave_kinds, only: dp
   use ehlwave_number_table, only: path_length
   implicit none (type, external)
   private

   type, extends(effect_keys_t), public :: starvation_keys_t
      real(dp) :: oil_over_flooded = 0                   !! r; 0: none
      real(dp) :: oil_layer_m = 0                        !! 0: none
      character(len=path_length) :: oil_profile = ''
      real(dp) :: oil_change_factor = 1                  !! 1: none
      real(dp) :: oil_change_start = 0, oil_change_length = 0   !! 0: to the end
   contains
      procedure, nopass :: follows
      procedure :: visit
      procedure :: is_given
      procedure, nopass :: refuses
      procedure :: changing
      procedure :: layer_changes
   end type starvation_keys_t

contains

   pure function follows() result(group)
      character(len=:), allocatable :: group
      group = 'surface'
   end function follows

   subroutine visit(self, list)
      class(starvation_keys_t), intent(inout) :: self
      type(key_list_t), intent(inout) :: list

      call list%enter('inlet', 'Oil offered to the contact, where it is less than fills the inlet.')
      call list%see(self%oil_over_flooded, key_t('oil_over_flooded', 'oil offered over oil that the flooded '// &
         'contact passes; r = layer/(rho_c h_cff), h_cff the film and rho_c the relative density at its centre, '// &
         'found on the way; none: flooded', above=0.0_dp, maximum=1e4_dp, is_late=.true., &
         applies=.not. self%oil_layer_m > 0, when='inlets without oil_layer_m'))
      call list%see(self%oil_layer_m, key_t('oil_layer_m', 'layers of oil on both surfaces together; in place of '// &
         'oil_over_flooded; needs dimensional conditions', unit='m', above=0.0_dp, is_late=.true.))
      list%common = key_t(is_late=.true., applies=self%is_given(), &
                          when='starved contacts (oil_over_flooded or oil_layer_m)')
      call list%see(self%oil_profile, key_t('oil_profile', 'CSV of the layer across; columns y_over_b and '// &
         'layer_over_given, local share of oil_over_flooded or oil_layer_m; linear '// &
         'between its rows', maximum=real(path_length, dp), file='oil_profile', is_written=self%oil_profile /= ''))
      call list%see(self%oil_change_factor, key_t('oil_change_factor', 'layer in a march after a change over '// &
         'before; 1: no change, 0.001: a gap', above=0.0_dp, maximum=1000.0_dp))
      list%common%applies = self%is_given() .and. abs(self%oil_change_factor - 1) > 0
      list%common%when = 'a change of the layer (oil_change_factor)'
      call list%see(self%oil_change_start, key_t('oil_change_start', 'T at which the change passes x_min', &
         minimum=0.0_dp))
      call list%see(self%oil_change_length, key_t('oil_change_length', 'length of the changed layer over a; 0: to '// &
         'the end', minimum=0.0_dp))
   end subroutine visit

   !> Whether the contact is offered less oil than it could take, or may be.
   elemental logical function is_given(self)
      class(starvation_keys_t), intent(in) :: self
      is_given = self%oil_over_flooded > 0 .or. self%oil_layer_m > 0
   end function is_given

   pure logical function refuses(method)
      integer, intent(in) :: method
      refuses = any(method == [by_fas, by_fitted_scheme, by_second_order, by_long_steps])
   end function refuses

   pure function changing(self) result(name)
      class(starvation_keys_t), intent(in) :: self
      character(len=:), allocatable :: name
      name = ''
      if (self%layer_changes()) name = 'the layer'
   end function changing

   !> Whether the layer changes in a march.
   elemental logical function layer_changes(self)
      class(starvation_keys_t), intent(in) :: self
      layer_changes = self%is_given() .and. abs(self%oil_change_factor - 1) > 0
   end function layer_changes

end module ehlwave_starvation_keys
