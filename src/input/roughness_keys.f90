!> The keys of groups &waviness and &surface, and of &waviness2 and &surface2: the roughness of each surface.
module ehlwave_roughness_keys
   use ehlwave_case_definition, only: path_length, roughness_t
   use ehlwave_case_key, only: key_t
   use ehlwave_key_list, only: key_list_t
   use ehlwave_kinds, only: dp
   implicit none (type, external)
   private
   public :: visit_surface, visit_waviness

contains

   !> The waves of a surface. The keys of surface 2 end in '_2', which their group may leave out.
   subroutine visit_waviness(waves, number, list)
      type(roughness_t), intent(inout) :: waves
      character(len=*), intent(in) :: number         !! number of the surface: '' is the first, '2'
      type(key_list_t), intent(inout) :: list
      character(len=:), allocatable :: one_length, orientation, tail
      logical :: is_custom

      is_custom = waves%orientation == 'custom'
      tail = ending(number)
      orientation = 'orientation'//tail
      one_length = orientation//" = 'transverse', 'isotropic' or 'longitudinal' ('custom' takes wavelength_x_over_a"// &
         tail//' and wavelength_y_over_a'//tail//')'
      if (number == '') then
         call list%enter('waviness', 'Harmonic waves of one surface.')
      else
         call list%enter('waviness'//number, 'Harmonic waves of surface 2, whose speed is 2 - S; besides &waviness '// &
            'or &surface. Names may leave out the _2 here.')
         list%common%is_late = .true.
      end if
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
   subroutine visit_surface(heights, number, list)
      type(roughness_t), intent(inout) :: heights
      character(len=*), intent(in) :: number         !! as in `visit_waviness`
      type(key_list_t), intent(inout) :: list
      type(key_t) :: key

      key = key_t(maximum=real(path_length, dp), file='surface'//ending(number), is_written=heights%is_measured())
      if (number == '') then
         call list%enter('surface', 'A measured surface in place of &waviness.')
         call list%see(heights%surface_file, named(key, 'file', 'surface written by `ehlwave surface`; it '// &
            'enters at x_min, moves with S and is followed until its trailing end is at the contact centre, or '// &
            'end_time; needs dimensional conditions. The whole domain is computed unless it is even in Y. With '// &
            '--output, surface_position_m is the x of the surface at the centre for each film_at_centre', &
            number))
      else
         call list%enter('surface'//number, 'A measured surface 2 in place of &waviness2.')
         list%common%is_late = .true.
         call list%see(heights%surface_file, named(key, 'file', 'measured surface 2; as &surface file, with the '// &
            'speed 2 - S. The march follows both to the end; surface_position_2_m is its x at the centre', number))
      end if
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
      if (index(help, 'surface 2') == 0) new%help = 'of surface 2, '//help
   end function named

   !> How names end that belong to a surface.
   pure function ending(number) result(text)
      character(len=*), intent(in) :: number
      character(len=:), allocatable :: text
      text = ''
      if (number /= '') text = '_'//number
   end function ending

end module ehlwave_roughness_keys
