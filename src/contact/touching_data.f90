!> Surfaces that touch: the boundary film, the law of the solids' pressure, and their friction.
module ehlwave_touching_data
   use ehlwave_kinds, only: dp
   implicit none (type, external)
   private

   !> Solids that keep the boundary film at any pressure, or yield by the logarithm of it.
   character(len=*), parameter, public :: hard = 'hard', soft = 'soft'

   type, public :: touching_data_t
      real(dp) :: film_m = 0             !! boundary film H_b; 0: surfaces never touch
      character(len=4) :: law = hard
      real(dp) :: softness_m = 0         !! sigma of the soft law
      real(dp) :: stress_pa = 0          !! C_0 of the soft law
      real(dp) :: solid_friction = 0.1_dp   !! mu_b
      real(dp) :: share = 0              !! load on the solids for which the speed is found; 0: the speed is given
   contains
      procedure :: is_given
      procedure :: seeks_speed
   end type touching_data_t

contains

   !> Whether surfaces may touch.
   elemental logical function is_given(self)
      class(touching_data_t), intent(in) :: self
      is_given = self%film_m > 0
   end function is_given

   !> Whether the speed follows from a share of the load.
   elemental logical function seeks_speed(self)
      class(touching_data_t), intent(in) :: self
      seeks_speed = self%is_given() .and. self%share > 0
   end function seeks_speed

end module ehlwave_touching_data
