!> The keys of groups &waviness2 and &surface2: roughness of the second surface.
module ehlwave_second_surface_keys
   use ehlwave_effect_keys, only: effect_keys_t
   use ehlwave_key_list, only: key_list_t
   use ehlwave_roughness, only: roughness_t
   use ehlwave_roughness_keys, only: visit_surface, visit_waviness
   implicit none (type, external)
   private

   type, extends(effect_keys_t), public :: second_surface_keys_t
      type(roughness_t) :: roughness = roughness_t(surface=2)
   contains
      procedure, nopass :: follows
      procedure :: visit
      procedure :: is_given
   end type second_surface_keys_t

contains

   pure function follows() result(group)
      character(len=:), allocatable :: group
      group = 'surface'
   end function follows

   subroutine visit(self, list)
      class(second_surface_keys_t), intent(inout) :: self
      type(key_list_t), intent(inout) :: list
      call visit_waviness(self%roughness, 'Harmonic waves of surface 2, whose speed is 2 - S; besides &waviness or '// &
         '&surface. Names may leave out the _2 here.', list)
      call visit_surface(self%roughness, 'A measured surface 2 in place of &waviness2.', 'measured surface 2; as '// &
         '&surface file, with the speed 2 - S. The march follows both to the end; surface_position_2_m is its x at '// &
         'the centre', list)
   end subroutine visit

   elemental logical function is_given(self)
      class(second_surface_keys_t), intent(in) :: self
      is_given = self%roughness%is_rough()
   end function is_given

end module ehlwave_second_surface_keys
