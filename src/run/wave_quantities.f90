!> Quantities of linear responses, see `ehlwave_quantities`.
module ehlwave_wave_quantities
   use ehlwave_harmonic_result, only: harmonic_result_t
   use ehlwave_kinds, only: dp
   use ehlwave_quantity, only: quantity_list_t
   implicit none (type, external)
   private
   public :: add_response

contains

   !> The linear response to the waves of a surface.
   subroutine add_response(list, harmonic, number, exists)
      type(quantity_list_t), intent(inout) :: list
      type(harmonic_result_t), intent(in) :: harmonic
      character(len=*), intent(in) :: number         !! suffix of names: '' for the first surface
      logical, intent(in) :: exists
      character(len=:), allocatable :: of

      of = ''
      if (number /= '') of = ', surface '//number(2:)
      call put('harmonic_ratio', 'Ad/Ai of small waves, linear response', harmonic%ratio)
      call put('harmonic_phase', 'phase of the linear response of H(0,0)', harmonic%phase, unit='rad')
      call put_complex('harmonic', 'transfer function pattern to H(0,0)', &
                       cmplx(harmonic%real_part, harmonic%imaginary_part, dp))
      call put_complex('harmonic_pressure', 'transfer function pattern (in c) to P(0,0)', harmonic%pressure)
      call put('harmonic_approach', 'amplitude of the approach over Ai', harmonic%approach_ratio)
      call put('harmonic_extrapolated', 'harmonic_ratio at mesh size 0', harmonic%extrapolated)
      call put_complex('harmonic_extrapolated', 'transfer function pattern to H(0,0) at mesh size 0', &
         harmonic%film_limit)
      call put_complex('harmonic_pressure_extrapolated', &
         'transfer function pattern (in c) to P(0,0) at mesh size 0', harmonic%pressure_limit)
      call put('harmonic_error', 'estimated relative error of harmonic_ratio', harmonic%error, &
               error_of='linear response'//of)
      call put('harmonic_error_basis', 'basis of harmonic_error', trim(harmonic%error_basis))
      call put('mean_film_rise', 'mean film less smooth film over Ai, second order, linear response', &
         harmonic%mean_rise)
      call put('smallest_film', 'smallest film with waves of Ai anywhere at any time, second order', &
                    harmonic%smallest_film)
      call put('smallest_film_x', 'X of the smallest film with waves, or of where they would touch', &
         harmonic%smallest_film_x)
      call put('smallest_film_y', 'Y of the smallest film with waves, or of where they would touch', &
         harmonic%smallest_film_y)
      call list%add_truth('surfaces_touch'//number, '1 when waves of Ai would touch the other surface, second '// &
         'order: there is no smallest_film; -1: not known'//of, harmonic%surfaces_touch, exists=exists)
      call add_waves()
      call put('harmonic_linear_steps', 'GMRES steps of the linear response', harmonic%linear_steps)
      call put('harmonic_work_units', 'processor time of the linear response in plain FFT convolutions of the '// &
         'grid', harmonic%work_units)
      call put('harmonic_counted_work_units', 'the same counted', harmonic%counted_work_units)

   contains

      subroutine put(name, long_name, value, unit, error_of)
         character(len=*), intent(in) :: name, long_name
         class(*), intent(in) :: value
         character(len=*), intent(in), optional :: unit, error_of
         call list%add(name//number, long_name//of, value, unit=unit, exists=exists, error_of=error_of)
      end subroutine put

      subroutine put_complex(name, long_name, value, unit)
         character(len=*), intent(in) :: name, long_name
         complex(dp), intent(in) :: value
         character(len=*), intent(in), optional :: unit
         call put(name//'_real', long_name//', real part', real(value, dp), unit)
         call put(name//'_imaginary', long_name//', imaginary part', aimag(value), unit)
      end subroutine put_complex

      !> The two waves of the film at the centre.
      subroutine add_waves()
         associate (row => harmonic%waves%centre)
            call put_complex('attenuated', 'wave of the film that moves with the surface, over Ai', row%fit%attenuated)
            call put_complex('complementary', 'wave of the film that moves with the oil, over Ai', &
               row%fit%complementary)
            call put_complex('psi', 'wave number of the complementary wave', row%fit%psi, unit='1/a')
            call put('two_wave_misfit', 'residual of both waves in the film, rms over Ai, |X| <= 0.5', row%fit%misfit)
            call put_complex('attenuated_formula', 'attenuated wave over Ai in closed form', row%attenuated)
            call put_complex('psi_formula', 'psi in closed form', row%psi, unit='1/a')
         end associate
      end subroutine add_waves

   end subroutine add_response

end module ehlwave_wave_quantities
