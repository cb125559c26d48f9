!> HDF5 file of a case: its quantities, history at the contact centre, fields of the last solution, effective input.
module ehlwave_field_file
   use ehlwave_case_definition, only: case_t
   use ehlwave_case_result, only: case_result_t
   use ehlwave_case_text, only: effective_input
   use ehlwave_clock, only: time_stamp
   use ehlwave_errors, only: error_t
   use ehlwave_field_history, only: field_history_t
   use ehlwave_hdf5_file, only: hdf5_file_t
   use ehlwave_planned_case, only: case_plan_t
   use ehlwave_provenance_list, only: add_provenance
   use ehlwave_quantities, only: add_result
   use ehlwave_quantity, only: quantity_list_t
   use ehlwave_quantity_output, only: write_quantities
   use ehlwave_response_fields, only: write_response
   implicit none (type, external)
   private
   public :: write_case_file, write_provenance

contains

   !> Write a case. Fails when the file cannot be written completely.
   subroutine write_case_file(path, case, plan, result, error)
      character(len=*), intent(in) :: path
      type(case_t), intent(in) :: case
      type(case_plan_t), intent(in) :: plan
      type(case_result_t), intent(in) :: result
      type(error_t), allocatable, intent(out) :: error
      type(hdf5_file_t) :: file
      type(quantity_list_t) :: quantities

      call file%create(path, error)
      if (allocated(error)) return
      call file%attribute('title', 'ehlwave: one elastohydrodynamic contact')
      call file%attribute('format', 'ehlwave-case')
      call write_provenance(file)
      call file%attribute('effective_input', effective_input(case))
      call add_result(quantities, case, plan, result)
      call write_quantities(file, quantities)
      if (allocated(result%time)) then
         if (size(result%time) > 0) then
            call file%write('time', result%time, '1', 'T, or phase over 2 pi for a standing pattern')
            call file%dimension('time')
            call file%write('film_at_centre', result%film_history, '1', 'H(0,0)', 'time')
            if (allocated(result%surface_position)) call file%write('surface_position_m', result%surface_position, &
               'm', 'x on the surface, as in its file, that is at the contact centre', 'time')
            if (allocated(result%approach_history)) &
               call file%write('approach', result%approach_history, '1', 'mutual approach Delta', 'time')
         end if
      end if
      if (allocated(result%p)) then
         call file%write('x', result%x, '1', 'X = x/a')
         call file%dimension('x')
         call file%write('y', result%y, '1', 'Y = y/b')
         call file%dimension('y')
         call file%write('pressure', result%p, '1', 'P = p/ph of the last solution', 'x', 'y')
         call file%write('film', result%h, '1', 'H = h/c of the last solution', 'x', 'y')
         if (allocated(result%shear_stress_pa)) call file%write('mean_shear_stress_pa', result%shear_stress_pa, 'Pa', &
            'mean of the shear stresses at the two surfaces along x, last solution', 'x', 'y')
      end if
      call result%effects%write_fields(file)
      if (allocated(result%history%p)) call write_history(file, result%history)
      call write_response(file, result%harmonic, '')
      call file%finish(error)
   end subroutine write_case_file

   !> Fields of a march over time.
   subroutine write_history(file, history)
      type(hdf5_file_t), intent(inout) :: file
      type(field_history_t), intent(in) :: history

      call file%write('field_time', history%time, '1', 'T of the fields over time')
      call file%dimension('field_time')
      call file%write('pressure_over_time', history%p, '1', 'P = p/ph over time', 'x', 'y', 'field_time')
      call file%write('film_over_time', history%h, '1', 'H = h/c over time', 'x', 'y', 'field_time')
      if (allocated(history%shear_stress_pa)) call file%write('mean_shear_stress_over_time_pa', &
         history%shear_stress_pa, 'Pa', &
         'mean of the shear stresses at the two surfaces along x, over time', 'x', 'y', 'field_time')
   end subroutine write_history

   !> Attributes that name the program and its build.
   subroutine write_provenance(file)
      type(hdf5_file_t), intent(inout) :: file
      type(quantity_list_t) :: list
      integer :: i
      call add_provenance(list)
      do i = 1, list%count
         call file%attribute(list%items(i)%name, list%items(i)%text)
      end do
      call file%attribute('written', time_stamp())
   end subroutine write_provenance

end module ehlwave_field_file
