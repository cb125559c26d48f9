!> Fields of linear responses in an HDF5 file of a case.
module ehlwave_response_fields
   use ehlwave_harmonic_result, only: harmonic_result_t
   use ehlwave_hdf5_file, only: hdf5_file_t
   use ehlwave_kinds, only: dp
   implicit none (type, external)
   private
   public :: write_response

contains

   !> Fields of the linear response to the waves of a surface, and the waves in each row, where they were asked for.
   subroutine write_response(file, harmonic, number)
      type(hdf5_file_t), intent(inout) :: file
      type(harmonic_result_t), intent(in) :: harmonic
      character(len=*), intent(in) :: number         !! suffix of names: '' for the first surface, '_2'

      if (.not. allocated(harmonic%h)) return
      call file%write('film_response'//number, abs(harmonic%h), '1', 'amplitude of H over Ai, small waves', 'x', 'y')
      call file%write('film_phase'//number, atan2(aimag(harmonic%h), real(harmonic%h)), 'rad', &
                      'phase of H, exp(-i w T) with a crest of the pattern at the origin at T = 0', 'x', 'y')
      call file%write('pressure_response'//number, abs(harmonic%p), '1', 'amplitude of P over Ai, small waves', 'x', &
         'y')
      call file%write('pressure_phase'//number, atan2(aimag(harmonic%p), real(harmonic%p)), 'rad', 'phase of P', 'x', &
         'y')
      if (.not. allocated(harmonic%waves%rows)) return
      associate (row => harmonic%waves%rows)
         call write_complex(file, 'attenuated_by_row'//number, row%fit%attenuated, &
            'wave that moves with the surface over Ai')
         call write_complex(file, 'complementary_by_row'//number, row%fit%complementary, &
            'wave that moves with the oil over Ai')
      end associate
   end subroutine write_response

   !> A complex number for each row as two data sets.
   subroutine write_complex(file, name, values, long_name)
      type(hdf5_file_t), intent(inout) :: file
      character(len=*), intent(in) :: name, long_name
      complex(dp), intent(in) :: values(:)
      call file%write(name//'_real', real(values, dp), '1', long_name//', real part', 'y')
      call file%write(name//'_imaginary', aimag(values), '1', long_name//', imaginary part', 'y')
   end subroutine write_complex

end module ehlwave_response_fields
