!> The rough surfaces of a case, and how long a measured one is followed.
module ehlwave_surface_plan
   use ehlwave_case_definition, only: case_t
   use ehlwave_case_files, only: case_file_t, note_digest
   use ehlwave_conditions, only: conditions_t
   use ehlwave_errors, only: error_t, raise
   use ehlwave_identity_index, only: identity_length, numbers_identity
   use ehlwave_kinds, only: dp
   use ehlwave_surface, only: new_surface, surface_t
   use ehlwave_surface_file, only: read_surface_file
   use ehlwave_surfaces, only: new_surfaces, surfaces_t
   use ehlwave_text, only: harmless, to_text
   use ehlwave_waviness, only: new_waviness, surface_waviness, waviness_t
   implicit none (type, external)
   private
   public :: plan_surfaces, surface_times, surface_text, surface_positions

contains

   !> The list of surfaces, and the digest of the heights of a measured one among the files of the case. Fails where a
   !> measured one cannot be used.
   subroutine plan_surfaces(case, conditions, surfaces, files, error)
      type(case_t), intent(in) :: case
      type(conditions_t), intent(in) :: conditions
      type(surfaces_t), intent(out) :: surfaces
      type(case_file_t), intent(inout) :: files(:)
      type(error_t), allocatable, intent(inout) :: error
      character(len=identity_length) :: digest
      type(waviness_t) :: measured

      surfaces = new_surfaces()
      if (len_trim(case%surface_file) > 0) then
         call read_case_surface(case, conditions, measured, digest, error)
         call note_digest(files, trim(case%surface_file), digest)
         surfaces = new_surfaces(measured)
      else if (case%orientation /= 'none') then
         surfaces = new_surfaces(new_waviness(case%wavelength_x_over_a, &
                                              conditions%elliptic%kappa*case%wavelength_y_over_a, case%oblique, &
                                              case%x_min, conditions%slip_parameter, case%amplitude_over_film))
      end if
   end subroutine plan_surfaces

   !> Pattern of the surface in `case%surface_file`, scaled by the lengths of the contact. Fails on a file that
   !> cannot be used, on conditions without lengths, and when the surface does not move.
   subroutine read_case_surface(case, conditions, waviness, digest, error)
      type(case_t), intent(in) :: case
      type(conditions_t), intent(in) :: conditions
      type(waviness_t), intent(out) :: waviness
      character(len=identity_length), intent(out) :: digest   !! of the numbers in the file
      type(error_t), allocatable, intent(inout) :: error
      type(surface_t) :: surface
      real(dp), allocatable :: height_m(:, :)
      real(dp) :: step_x_m, step_y_m

      digest = ''
      if (.not. conditions%has_dimensions) then
         call raise(error, '&surface file holds metres: give &conditions by dimensional data (radius_x_m, ...) in '// &
            'place of load_parameter_m, lubricant_parameter_l and radius_ratio_d')
      else if (.not. conditions%slip_parameter > 0) then
         call raise(error, '&surface file with slip_parameter = 0: the surface never enters the contact; give a '// &
                    'slip_parameter above 0')
      end if
      if (.not. allocated(error)) call read_surface_file(trim(case%surface_file), height_m, step_x_m, step_y_m, error)
      if (allocated(error)) return
      digest = numbers_identity([step_x_m, step_y_m, real(shape(height_m), dp), height_m])
      call new_surface(height_m/conditions%c_m, step_x_m/conditions%a_m, step_y_m/conditions%b_m, 2*case%y_max, &
                       surface, error)
      if (allocated(error)) then
         error%message = '&surface file = '''//trim(case%surface_file)//''': '//error%message
         return
      end if
      waviness = surface_waviness(surface, case%x_min, conditions%slip_parameter)
   end subroutine read_case_surface

   !> When the leading end of the surface is at the contact centre, and when its trailing end is, in T.
   pure subroutine surface_times(surfaces, first, last)
      type(surfaces_t), intent(in) :: surfaces   !! the main one is measured
      real(dp), intent(out) :: first, last
      associate (measured => surfaces%list(surfaces%main))
         first = -measured%start/measured%slip
         last = first + measured%surface%length/measured%slip
      end associate
   end subroutine surface_times

   !> Position on the surface that is at the contact centre, as in its file, m.
   pure function surface_positions(surfaces, a_m, time) result(x_m)
      type(surfaces_t), intent(in) :: surfaces   !! the main one is measured
      real(dp), intent(in) :: a_m                !! Hertz semi-axis
      real(dp), intent(in) :: time(:)            !! T
      real(dp) :: x_m(size(time))
      associate (measured => surfaces%list(surfaces%main))
         x_m = a_m*(measured%surface%length - measured%start - measured%slip*time)
      end associate
   end function surface_positions

   !> One line about the surface, for the plan.
   function surface_text(case, surfaces, conditions) result(text)
      type(case_t), intent(in) :: case
      type(surfaces_t), intent(in) :: surfaces
      type(conditions_t), intent(in) :: conditions
      character(len=:), allocatable :: text
      associate (surface => surfaces%list(surfaces%main)%surface)
         text = 'surface '//harmless(trim(case%surface_file))//', '//to_text(size(surface%height, 1))//' x '// &
                to_text(size(surface%height, 2))//' points, '//to_text(surface%length, 4)//' a long, Rq = '// &
                to_text(surface%rq*conditions%c_m*1e6_dp, 4)//' um, RMS average wavelength '// &
                to_text(surface%wavelength_x, 4)//' a'
         if (size(surface%height, 2) > 1) text = text//' along X, '//to_text(surface%wavelength_y, 4)//' b along Y'
      end associate
   end function surface_text

end module ehlwave_surface_plan
