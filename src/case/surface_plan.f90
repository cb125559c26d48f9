!> The rough surfaces of a case, and the time that a measured surface is followed.
module ehlwave_surface_plan
   use ehlwave_case_definition, only: case_t
   use ehlwave_case_files, only: case_file_t, note_digest
   use ehlwave_conditions, only: conditions_t
   use ehlwave_errors, only: error_t, raise
   use ehlwave_identity_index, only: identity_length, numbers_identity
   use ehlwave_kinds, only: dp
   use ehlwave_roughness, only: roughness_t, surface_speed
   use ehlwave_surface, only: new_surface, surface_t
   use ehlwave_surface_file, only: read_surface_file
   use ehlwave_surfaces, only: surfaces_t
   use ehlwave_text, only: harmless, to_text
   use ehlwave_waviness, only: new_waviness, no_waviness, surface_waviness, waviness_t
   implicit none (type, external)
   private
   public :: plan_surfaces, surface_times, surface_text, surface_positions

contains

   !> The list of surfaces, and the digest of measured heights among the files of the case. Fails where a measured
   !> surface cannot be used.
   subroutine plan_surfaces(case, conditions, surfaces, files, error)
      type(case_t), intent(in) :: case
      type(conditions_t), intent(in) :: conditions
      type(surfaces_t), intent(out) :: surfaces
      type(case_file_t), intent(inout) :: files(:)
      type(error_t), allocatable, intent(inout) :: error
      type(waviness_t), allocatable :: list(:)
      type(roughness_t) :: both(2)
      integer :: n

      both = case%surfaces()
      allocate (list(merge(2, 1, case%is_pair())))
      do n = 1, size(list)
         call plan_surface(case, both(n), surface_speed(n, conditions%slip_parameter), conditions, list(n), files, &
                           error)
      end do
      surfaces%list = list
   end subroutine plan_surfaces

   !> A surface of the list.
   subroutine plan_surface(case, roughness, speed, conditions, waviness, files, error)
      type(case_t), intent(in) :: case
      type(roughness_t), intent(in) :: roughness     !! roughness of the surface
      real(dp), intent(in) :: speed                  !! over the mean speed
      type(conditions_t), intent(in) :: conditions
      type(waviness_t), intent(out) :: waviness
      type(case_file_t), intent(inout) :: files(:)
      type(error_t), allocatable, intent(inout) :: error
      character(len=identity_length) :: digest
      real(dp) :: aspect

      waviness = no_waviness()
      if (roughness%is_measured()) then
         call read_case_surface(case, roughness, speed, conditions, waviness, digest, error)
         call note_digest(files, trim(roughness%surface_file), digest)
      else if (roughness%is_wavy()) then
         aspect = merge(1.0_dp, conditions%elliptic%kappa, conditions%is_line())   ! lines have Y = y/a
         waviness = new_waviness(roughness%wavelength_x_over_a, aspect*roughness%wavelength_y_over_a, &
                                 roughness%oblique, case%x_min, speed, roughness%amplitude_over_film)
         if (roughness%amplitude_m > 0) waviness%amplitude_over_c = roughness%amplitude_m/conditions%c_m
      end if
   end subroutine plan_surface

   !> Pattern of a measured surface, scaled by the lengths of the contact. Fails on a file that cannot be used, on
   !> conditions without lengths, and when the surface does not move.
   subroutine read_case_surface(case, roughness, speed, conditions, waviness, digest, error)
      type(case_t), intent(in) :: case
      type(roughness_t), intent(in) :: roughness
      real(dp), intent(in) :: speed
      type(conditions_t), intent(in) :: conditions
      type(waviness_t), intent(out) :: waviness
      character(len=identity_length), intent(out) :: digest   !! digest of the numbers in the file
      type(error_t), allocatable, intent(inout) :: error
      character(len=:), allocatable :: key
      type(surface_t) :: surface
      real(dp), allocatable :: height_m(:, :)
      real(dp) :: step_x_m, step_y_m

      digest = ''
      key = roughness%group('surface')//' file'
      if (allocated(error)) return
      if (.not. conditions%has_dimensions) then
         call raise(error, key//' holds metres: give &conditions by dimensional data (radius_x_m, ...) in '// &
            'place of load_parameter_m, lubricant_parameter_l and radius_ratio_d')
      else if (.not. speed > 0) then
         call raise(error, key//' with slip_parameter = '//to_text(conditions%slip_parameter, 2)//': the surface '// &
            'never enters the contact; give a slip_parameter '//merge('above 0', 'below 2', roughness%surface == 1))
      end if
      if (.not. allocated(error)) call read_surface_file(trim(roughness%surface_file), height_m, step_x_m, step_y_m, &
                                                         error)
      if (allocated(error)) return
      digest = numbers_identity([step_x_m, step_y_m, real(shape(height_m), dp), height_m])
      call new_surface(height_m/conditions%c_m, step_x_m/conditions%a_m, step_y_m/conditions%b_m, 2*case%y_max, &
                       surface, error)
      if (allocated(error)) then
         error%message = key//' = '''//trim(roughness%surface_file)//''': '//error%message
         return
      end if
      waviness = surface_waviness(surface, case%x_min, speed)
   end subroutine read_case_surface

   !> When the leading end of the last measured surface is at the contact centre, and when its trailing end is, in T.
   pure subroutine surface_times(surfaces, first, last)
      type(surfaces_t), intent(in) :: surfaces   !! at least one is measured
      real(dp), intent(out) :: first, last
      integer :: n
      first = 0
      last = 0
      do n = 1, size(surfaces%list)
         associate (measured => surfaces%list(n))
            if (.not. allocated(measured%surface)) cycle
            first = max(first, -measured%start/measured%slip)
            last = max(last, -measured%start/measured%slip + measured%surface%length/measured%slip)
         end associate
      end do
   end subroutine surface_times

   !> Position on a surface that is at the contact centre, as in its file, m.
   pure function surface_positions(measured, a_m, time) result(x_m)
      type(waviness_t), intent(in) :: measured
      real(dp), intent(in) :: a_m                !! Hertz semi-axis
      real(dp), intent(in) :: time(:)            !! T
      real(dp) :: x_m(size(time))
      x_m = a_m*(measured%surface%length - measured%start - measured%slip*time)
   end function surface_positions

   !> A line about a rough surface, for the plan.
   function surface_text(roughness, waviness, conditions) result(text)
      type(roughness_t), intent(in) :: roughness
      type(waviness_t), intent(in) :: waviness   !! waves of the same surface
      type(conditions_t), intent(in) :: conditions
      character(len=:), allocatable :: text
      if (allocated(waviness%surface)) then
         associate (surface => waviness%surface)
            text = 'surface '//harmless(trim(roughness%surface_file))//', '//to_text(size(surface%height, 1))//' x '// &
                   to_text(size(surface%height, 2))//' points, '//to_text(surface%length, 4)//' a long, Rq = '// &
                   to_text(surface%rq*conditions%c_m*1e6_dp, 4)//' um, RMS average wavelength '// &
                   to_text(surface%wavelength_x, 4)//' a'
            if (size(surface%height, 2) > 1) text = text//' along X, '//to_text(surface%wavelength_y, 4)//' b along Y'
         end associate
      else if (roughness%is_wavy()) then
         text = trim(roughness%orientation)
         if (roughness%wavelength_x_over_a > 0) text = text//', lambda_x/a = '// &
            to_text(roughness%wavelength_x_over_a, 6)
         if (roughness%wavelength_y_over_a > 0) text = text//', lambda_y/a = '// &
            to_text(roughness%wavelength_y_over_a, 6)
         if (roughness%oblique) text = text//', oblique'
         if (roughness%amplitude_m > 0) then
            text = text//', Ai = '//to_text(roughness%amplitude_m*1e6_dp, 4)//' um'
         else
            text = text//', Ai = '//to_text(roughness%amplitude_over_film, 4)//' of the smooth central film'
            if (roughness%is_amplitude_chosen) text = text//' (chosen for the accuracy: larger waves may respond '// &
               'unlike small waves)'
         end if
      else
         text = 'none (smooth surfaces)'
      end if
   end function surface_text

end module ehlwave_surface_plan
