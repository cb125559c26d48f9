!> Roughness of a surface: waves, or measured heights.
module ehlwave_roughness
   use ehlwave_case_key, only: name_length => choice_length
   use ehlwave_kinds, only: dp
   use ehlwave_number_table, only: path_length
   implicit none (type, external)
   private
   public :: name_length, path_length, surface_speed

   type, public :: roughness_t
      integer :: surface = 1                             !! number of the surface; no key
      character(len=name_length) :: orientation = 'none'
      real(dp) :: wavelength_over_a = 0                  !! shorter wavelength of a custom pattern, completed
      real(dp) :: wavelength_x_over_a = 0, wavelength_y_over_a = 0   !! 0: no variation; completed
      logical :: oblique = .false.
      real(dp) :: amplitude_over_film = 0.2_dp           !! estimated where `amplitude_m` is given
      logical :: is_amplitude_chosen = .false.           !! no key: `amplitude_over_film` follows from the accuracy
      real(dp) :: amplitude_m = 0                        !! 0: by the film
      real(dp) :: phase_deg = 0                          !! of waves at rest whose surfaces may touch
      character(len=path_length) :: surface_file = ''    !! measured surface in place of waviness
   contains
      procedure :: is_wavy
      procedure :: is_measured
      procedure :: is_rough
      procedure :: varies_along
      procedure :: moves_at
      procedure :: number
      procedure :: group
      procedure :: given_as
   end type roughness_t

contains

   !> Whether the surface has waves.
   elemental logical function is_wavy(self)
      class(roughness_t), intent(in) :: self
      is_wavy = self%orientation /= 'none'
   end function is_wavy

   !> Whether its heights were measured.
   elemental logical function is_measured(self)
      class(roughness_t), intent(in) :: self
      is_measured = self%surface_file /= ''
   end function is_measured

   !> Whether it has waves or measured heights.
   elemental logical function is_rough(self)
      class(roughness_t), intent(in) :: self
      is_rough = self%is_wavy() .or. self%is_measured()
   end function is_rough

   !> Whether it varies along X.
   elemental logical function varies_along(self)
      class(roughness_t), intent(in) :: self
      varies_along = self%is_measured() .or. (self%is_wavy() .and. self%orientation /= 'longitudinal')
      if (self%orientation == 'custom') varies_along = self%wavelength_x_over_a > 0
   end function varies_along

   !> Whether the gap changes in time: the surface varies along X and moves.
   elemental logical function moves_at(self, slip)
      class(roughness_t), intent(in) :: self
      real(dp), intent(in) :: slip                       !! S
      moves_at = self%varies_along() .and. surface_speed(self%surface, slip) > 0
   end function moves_at

   !> Number of the surface in the names of groups: '' or '2'.
   pure function number(self) result(text)
      class(roughness_t), intent(in) :: self
      character(len=:), allocatable :: text
      text = trim(merge(' ', '2', self%surface == 1))
   end function number

   !> A group of the surface as in messages, '&waviness2' for 'waviness'.
   pure function group(self, name)
      class(roughness_t), intent(in) :: self
      character(len=*), intent(in) :: name
      character(len=:), allocatable :: group
      group = '&'//name//self%number()
   end function group

   !> The group and key by which the surface is given, with its value.
   pure function given_as(self) result(text)
      class(roughness_t), intent(in) :: self
      character(len=:), allocatable :: text
      if (self%is_measured()) then
         text = self%group('surface')//" file = '"//trim(self%surface_file)//"'"
      else
         text = self%group('waviness')//" orientation = '"//trim(self%orientation)//"'"
      end if
   end function given_as

   !> Speed of a surface over the mean speed: S of the first, 2 - S of the second.
   elemental real(dp) function surface_speed(surface, slip) result(speed)
      integer, intent(in) :: surface
      real(dp), intent(in) :: slip                       !! S
      speed = merge(slip, 2 - slip, surface == 1)
   end function surface_speed

end module ehlwave_roughness
