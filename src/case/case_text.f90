!> The effective input of a case as text, and its identity.
module ehlwave_case_text
   use, intrinsic :: iso_fortran_env, only: int64
   use ehlwave_case_definition, only: case_t
   use ehlwave_kinds, only: dp
   use ehlwave_text, only: to_text
   implicit none (type, external)
   private
   public :: case_identity, effective_input, text_identity

   integer, parameter, public :: effective_length = 3072   !! no effective input is longer
   character(len=*), parameter :: line_end = new_line('a')

contains

   !> A case file with every key and the value in use: running it gives the same result.
   pure function effective_input(case) result(text)
      type(case_t), intent(in) :: case   !! completed
      character(len=:), allocatable :: text

      text = '&conditions'//line_end
      if (case%has_data) then
         text = text//number('radius_x_m', case%data%radius_x_m)//number('radius_y_m', case%data%radius_y_m) &
                //number('reduced_modulus_pa', case%data%reduced_modulus_pa)//number('load_n', case%data%load_n) &
                //number('mean_speed_m_per_s', case%data%mean_speed_m_per_s) &
                //number('viscosity_pa_s', case%data%viscosity_pa_s)
      else
         text = text//number('load_parameter_m', case%load_parameter_m) &
                //number('lubricant_parameter_l', case%lubricant_parameter_l) &
                //number('radius_ratio_d', case%radius_ratio_d)
      end if
      text = text//number('slip_parameter', case%slip_parameter)//'/'//line_end &
             //'&lubricant'//line_end//number('pressure_viscosity_per_pa', case%pressure_viscosity_per_pa) &
             //number('roelands_index', case%roelands_index)//word('viscosity_law', case%viscosity_law) &
             //word('density_law', case%density_law)//'/'//line_end &
             //'&waviness'//line_end//word('orientation', case%orientation)
      if (case%orientation == 'custom') then
         text = text//number('wavelength_x_over_a', case%wavelength_x_over_a) &
                //number('wavelength_y_over_a', case%wavelength_y_over_a)//truth('oblique', case%oblique)
      else if (case%orientation /= 'none') then
         text = text//number('wavelength_over_a', case%wavelength_over_a)
      end if
      if (case%orientation /= 'none') text = text//number('amplitude_over_film', case%amplitude_over_film) &
                                             //word('response', case%response)
      text = text//'/'//line_end
      if (len_trim(case%surface_file) > 0) text = text//'&surface'//line_end//word('file', case%surface_file)//'/'//line_end
      text = text &
             //'&grid'//line_end//number('x_min', case%x_min)//number('x_max', case%x_max)
      if (case%radius_ratio_d > 0) text = text//number('y_max', case%y_max)
      text = text//whole('cells_x', case%cells_x)
      if (case%radius_ratio_d > 0) text = text//whole('cells_y', case%cells_y)
      if (min(case%cells_x, case%cells_y) == 0) text = text//whole('largest_cells', case%largest_cells)
      if (case%radius_ratio_d > 0) text = text//word('domain', case%domain)
      text = text//'/'//line_end &
             //'&solver'//line_end//number('tolerance', case%tolerance) &
             //number('step_tolerance', case%step_tolerance)
      if (case%time_step_over_cell > 0) text = text//number('time_step_over_cell', case%time_step_over_cell)
      text = text//whole('largest_steps', case%largest_steps)//whole('settling_periods', case%settling_periods) &
             //optional_whole('largest_total_steps', case%largest_total_steps)//word('method', case%method)
      if (case%method == 'fas') text = text//word('cycle', case%cycle)
      text = text//word('deformation', case%deformation)//word('error_estimate', case%error_estimate)
      if (case%accuracy > 0) text = text//number('accuracy', case%accuracy)
      text = text//'/'//line_end &
             //'&dynamics'//line_end//word('load_balance', case%load_balance)
      if (case%natural_frequency > 0) text = text//number('natural_frequency', case%natural_frequency)
      text = text//number('load_factor', case%load_factor)
      if (case%end_time > 0) text = text//number('end_time', case%end_time)
      text = text//'/'//line_end
   end function effective_input

   pure function number(key, value) result(line)
      character(len=*), intent(in) :: key
      real(dp), intent(in) :: value
      character(len=:), allocatable :: line
      line = '  '//key//' = '//to_text(value)//line_end
   end function number

   pure function whole(key, value) result(line)
      character(len=*), intent(in) :: key
      integer, intent(in) :: value
      character(len=:), allocatable :: line
      line = '  '//key//' = '//to_text(value)//line_end
   end function whole

   !> Nothing for 0, which stands for a choice of the plan.
   pure function optional_whole(key, value) result(line)
      character(len=*), intent(in) :: key
      integer, intent(in) :: value
      character(len=:), allocatable :: line
      line = ''
      if (value > 0) line = whole(key, value)
   end function optional_whole

   pure function word(key, value) result(line)
      character(len=*), intent(in) :: key, value
      character(len=:), allocatable :: line
      line = '  '//key//" = '"//trim(value)//"'"//line_end
   end function word

   pure function truth(key, value) result(line)
      character(len=*), intent(in) :: key
      logical, intent(in) :: value
      character(len=:), allocatable :: line
      line = '  '//key//' = .'//to_text(value)//'.'//line_end
   end function truth

   !> Identity of a case: 16 hexadecimal digits, the 64-bit FNV-1a hash of its effective input.
   pure function case_identity(case) result(identity)
      type(case_t), intent(in) :: case
      character(len=16) :: identity
      identity = text_identity(effective_input(case))
   end function case_identity

   !> Identity of the case that an effective input describes.
   pure function text_identity(text) result(identity)
      character(len=*), intent(in) :: text
      character(len=16) :: identity
      integer(int64) :: hash
      integer :: i

      hash = -3750763034362895579_int64               ! 14695981039346656037 as a signed number
      do i = 1, len(text)
         hash = ieor(hash, int(iachar(text(i:i)), int64))
         hash = times_prime(hash)
      end do
      write (identity, '(z16.16)') hash
   end function text_identity

   !> hash * 1099511628211 modulo 2^64, without signed overflow: the prime is 2^40 + 2^8 + 0xb3.
   pure integer(int64) function times_prime(hash)
      integer(int64), intent(in) :: hash
      integer(int64) :: low, high
      low = iand(hash, int(z'FFFFFFFF', int64))
      high = ishft(hash, -32)
      times_prime = add(ishft(hash, 40), add(low*435_int64, ishft(high*435_int64, 32)))
   end function times_prime

   !> Sum modulo 2^64.
   pure integer(int64) function add(a, b)
      integer(int64), intent(in) :: a, b
      integer(int64) :: low, high
      low = iand(a, int(z'FFFFFFFF', int64)) + iand(b, int(z'FFFFFFFF', int64))
      high = ishft(a, -32) + ishft(b, -32) + ishft(low, -32)
      add = ior(ishft(high, 32), iand(low, int(z'FFFFFFFF', int64)))
   end function add

end module ehlwave_case_text
