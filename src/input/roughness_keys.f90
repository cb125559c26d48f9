!> The keys of groups &waviness and &surface, and of &waviness2 and &surface2: the roughness of each surface.
module ehlwave_roughness_keys
   use ehlwave_case_key, only: key_t
   use ehlwave_key_list, only: key_list_t
   use ehlwave_kinds, only: dp
   use ehlwave_roughness, only: path_length, roughness_t
   implicit none (type, external)
   private
   public :: visit_surface, visit_waviness

contains

   !> The waves of a surface. The keys of another surface than the first end in its number, which their
   !> group may leave out.
   subroutine visit_waviness(waves, help, list)
      type(roughness_t), intent(inout) :: waves
      character(len=*), intent(in) :: help           !! of the group
      type(key_list_t), intent(inout) :: list
      character(len=:), allocatable :: number, one_length, orientation, tail
      logical :: is_custom

      is_custom = waves%orientation == 'custom'
      number = waves%number()
      tail = ending(number)
      orientation = 'orientation'//tail
      one_length = orientation//" = 'transverse', 'isotropic' or 'longitudinal' ('custom' takes wavelength_x_over_a"// &
         tail//' and wavelength_y_over_a'//tail//')'
      call list%enter('waviness'//number, help)
      list%common%is_late = number /= ''
      call see('orientation', 'orientation of the waves', waves%orientation, &
               key_t(choices='none transverse isotropic longitudinal custom'))
      call see('wavelength_over_a', 'wavelength lambda/a', waves%wavelength_over_a, &
               key_t(above=0.0_dp, applies=waves%is_wavy() .and. .not. is_custom, when=one_length))
      list%common%applies = is_custom
      list%common%when = orientation//" = 'custom'"
      call see('wavelength_x_over_a', 'wavelength along X over a; 0: no variation along X', waves%wavelength_x_over_a, &
               key_t(minimum=0.0_dp))
      call see('wavelength_y_over_a', 'wavelength along Y over a; 0: no variation along Y', waves%wavelength_y_over_a, &
               key_t(minimum=0.0_dp))
      call see('oblique', 'whether the pattern is one plane wave cos(kx X + ky Y) in place of the product of cosines', &
               waves%oblique, key_t())
      list%common%applies = .true.
      list%common%when = ''
      list%common%is_written = waves%is_wavy()
      call see('amplitude_over_film', 'amplitude Ai over the smooth central film thickness', &
               waves%amplitude_over_film, key_t(above=0.0_dp, maximum=1.0_dp, counts=waves%is_wavy(), &
                                                applies=.not. waves%amplitude_m > 0, &
                                                when='waves ('//orientation//') without amplitude_m'//tail))
      call see('amplitude_m', 'amplitude Ai of any size, in place of amplitude_over_film; needs dimensional '// &
               'conditions', waves%amplitude_m, key_t(unit='m', above=0.0_dp, maximum=1e-3_dp, is_late=.true., &
                                                      applies=waves%is_wavy(), when='waves ('//orientation//')'))

   contains

      subroutine see(name, help, component, key)
         character(len=*), intent(in) :: name, help
         class(*), intent(inout) :: component
         type(key_t), intent(in) :: key
         call list%see(component, named(key, name, help, number))
      end subroutine see

   end subroutine visit_waviness

   !> The file of measured heights of a surface.
   subroutine visit_surface(heights, group_help, help, list)
      type(roughness_t), intent(inout) :: heights
      character(len=*), intent(in) :: group_help, help   !! of the group and its key
      type(key_list_t), intent(inout) :: list
      character(len=:), allocatable :: number
      type(key_t) :: key

      number = heights%number()
      key = key_t(maximum=real(path_length, dp), file='surface'//ending(number), is_written=heights%is_measured())
      call list%enter('surface'//number, group_help)
      list%common%is_late = number /= ''
      call list%see(heights%surface_file, named(key, 'file', help, number))
   end subroutine visit_surface

   !> A key of the table with its name and help; keys of other surfaces than the first have its number.
   pure function named(key, name, help, number) result(new)
      type(key_t), intent(in) :: key
      character(len=*), intent(in) :: name, help, number
      type(key_t) :: new
      new = key
      new%name = name//ending(number)
      new%help = help
      if (number == '') return
      new%short = name
      if (index(help, 'surface '//number) == 0) new%help = 'of surface '//number//', '//help
   end function named

   !> How names end that belong to a surface.
   pure function ending(number) result(text)
      character(len=*), intent(in) :: number
      character(len=:), allocatable :: text
      text = ''
      if (number /= '') text = '_'//number
   end function ending

end module ehlwave_roughness_keys
