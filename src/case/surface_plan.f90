!> What a measured surface on the moving body means for a case: its pattern, and how long it is followed.
module ehlwave_surface_plan
   use ehlwave_case_definition, only: case_t
   use ehlwave_conditions, only: conditions_t
   use ehlwave_errors, only: error_t, raise
   use ehlwave_identity_index, only: identity_length, numbers_identity
   use ehlwave_kinds, only: dp
   use ehlwave_surface, only: new_surface, surface_t
   use ehlwave_surface_file, only: read_surface_file
   use ehlwave_text, only: harmless, to_text
   use ehlwave_waviness, only: surface_waviness, waviness_t
   implicit none (type, external)
   private
   public :: read_case_surface, surface_times, surface_text, surface_positions

contains

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
         call raise(error, '&surface file holds metres: give &conditions by dimensional data (radius_x_m, ...) in place of '// &
                    'load_parameter_m, lubricant_parameter_l and radius_ratio_d')
      else if (.not. case%slip_parameter > 0) then
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
      waviness = surface_waviness(surface, case%x_min, case%slip_parameter)
   end subroutine read_case_surface

   !> When the leading end of the surface is at the contact centre, and when its trailing end is, in T.
   pure subroutine surface_times(waviness, first, last)
      type(waviness_t), intent(in) :: waviness   !! with a surface
      real(dp), intent(out) :: first, last
      first = -waviness%start/waviness%slip
      last = first + waviness%surface%length/waviness%slip
   end subroutine surface_times

   !> Position on the surface that is at the contact centre, as in its file, m.
   pure function surface_positions(waviness, a_m, time) result(x_m)
      type(waviness_t), intent(in) :: waviness   !! with a surface
      real(dp), intent(in) :: a_m                !! Hertz semi-axis
      real(dp), intent(in) :: time(:)            !! T
      real(dp) :: x_m(size(time))
      x_m = a_m*(waviness%surface%length - waviness%start - waviness%slip*time)
   end function surface_positions

   !> One line about the surface, for the plan.
   function surface_text(case, waviness, conditions) result(text)
      type(case_t), intent(in) :: case
      type(waviness_t), intent(in) :: waviness
      type(conditions_t), intent(in) :: conditions
      character(len=:), allocatable :: text
      associate (surface => waviness%surface)
         text = 'surface '//harmless(trim(case%surface_file))//', '//to_text(size(surface%height, 1))//' x '// &
                to_text(size(surface%height, 2))//' points, '//to_text(surface%length, 4)//' a long, Rq = '// &
                to_text(surface%rq*conditions%c_m*1e6_dp, 4)//' um, RMS average wavelength '// &
                to_text(surface%wavelength_x, 4)//' a'
         if (size(surface%height, 2) > 1) text = text//' along X, '//to_text(surface%wavelength_y, 4)//' b along Y'
      end associate
   end function surface_text

end module ehlwave_surface_plan
