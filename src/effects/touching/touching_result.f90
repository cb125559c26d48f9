!> Surfaces that may touch, in the result of a case.
module ehlwave_touching_result
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ehlwave_case_definition, only: case_t
   use ehlwave_effect_result, only: after_friction, effect_result_t
   use ehlwave_hdf5_file, only: hdf5_file_t
   use ehlwave_kinds, only: dp
   use ehlwave_planned_case, only: case_plan_t
   use ehlwave_quantity, only: quantity_list_t
   use ehlwave_text, only: to_text
   use ehlwave_touching_account_result, only: touching_account_t
   implicit none (type, external)
   private

   type, extends(effect_result_t), public :: touching_result_t
      type(touching_account_t) :: account
      logical :: seeks_speed = .false.             !! whether the share is given
   contains
      procedure, nopass :: place
      procedure :: write_fields
      procedure :: add_quantities
      procedure :: print
   end type touching_result_t

   real(dp), parameter :: um_per_m = 1e6_dp

contains

   pure integer function place()
      place = after_friction
   end function place

   subroutine write_fields(self, file)
      class(touching_result_t), intent(in) :: self
      type(hdf5_file_t), intent(inout) :: file

      associate (touching => self%account)
         if (allocated(touching%share_history)) then
            call file%write('touching_share_over_time', touching%share_history, '1', &
               'share of the load on the solids', 'time')
            call file%write('touching_area_over_time', touching%area_history, '1', &
               'area where the solids bear over the Hertz area', 'time')
            call file%write('oil_friction_over_time', touching%friction_history, '1', &
               'friction of the oil over the load', 'time')
            call file%write('mean_film_over_time', touching%mean_film_history, '1', &
               'mean of H of the oil in the Hertz contact', 'time')
         end if
         if (.not. allocated(touching%c)) return
         call file%write('contact_pressure', touching%c, '1', 'C = c/ph, pressure of the solids, last solution', &
            'x', 'y')
         call file%write('content', touching%theta, '1', 'theta, share of the gap that oil fills, last solution', &
            'x', 'y')
      end associate
   end subroutine write_fields

   subroutine add_quantities(self, list, case, plan)
      class(touching_result_t), intent(in) :: self
      type(quantity_list_t), intent(inout) :: list
      type(case_t), intent(in) :: case
      type(case_plan_t), intent(in) :: plan
      logical :: exists

      exists = case%effects%touching%is_given()
      associate (touching => self%account)
         call list%add('touching_share', 'share of the load on the solids; in a march its mean over the '// &
            'measured time', &
            touching%share, exists=exists)
         call list%add('touching_share_error', 'its error by the mesh and, in a march, by changes from '// &
            'period to period, absolute', touching%share_error, exists=exists)
         call list%add('touching_area', 'area where the solids bear over the Hertz area; in a march its mean', &
            touching%area, exists=exists)
         call list%add('touching_area_error', 'its error, likewise', touching%area_error, exists=exists)
         call list%add('touching_is_artefact', '1 where the share falls with the mesh size', touching%is_artefact, &
            exists=exists)
         call list%add('touching_meshes', 'meshes that these errors are from', touching%meshes, exists=exists)
         call list%add('mean_speed_m_per_s', 'mean speed at which the solids bear the share of the input', &
            touching%speed, unit='m/s', exists=case%effects%touching%data%seeks_speed())
         call list%add('mean_speed_error', 'its relative error by the mesh', touching%speed_error, &
            exists=case%effects%touching%data%seeks_speed())
         call list%add('solid_friction_coefficient', 'friction of the solids over the load, part of '// &
            'friction_coefficient', touching%solid_friction, exists=exists)
         call list%add('oil_friction_coefficient', 'friction of the oil over the load, the other part', &
            touching%friction_oil, exists=exists)
         call list%add('max_contact_pressure', 'largest pressure of the solids over ph', &
            touching%max_contact_pressure, exists=exists)
         call list%add('max_total_pressure', 'largest pressure of oil and solids together over ph', &
            touching%max_total_pressure, exists=exists)
         call list%add('mean_film_um', 'mean film of the oil in the Hertz contact', &
            touching%mean_film*plan%conditions%c_m*um_per_m, unit='um', exists=exists)
      end associate
   end subroutine add_quantities

   subroutine print(self, unit, plan)
      class(touching_result_t), intent(in) :: self
      integer, intent(in) :: unit
      type(case_plan_t), intent(in) :: plan
      character(len=:), allocatable :: oil, share, speed

      associate (touching => self%account)
         if (touching%meshes == 0) return
         oil = 'not given'
         if (ieee_is_finite(touching%friction_oil)) oil = to_text(touching%friction_oil, 4)
         share = 'share '//to_text(touching%share, 4)//' of the load'
         speed = 'mean speed '//to_text(touching%speed, 5)//' m/s'
         if (self%seeks_speed) then
            speed = speed//' (relative error '//to_text(touching%speed_error, 2)//')'
         else
            share = share//' (error '//to_text(touching%share_error, 2)//')'
         end if
         write (unit, '(a)') 'Touching     '//share//', area '//to_text(touching%area, 4)// &
            ' of the Hertz area (error '//to_text(touching%area_error, 2)//'), '//speed//', friction of the oil '// &
            oil//', of the solids '//to_text(touching%solid_friction, 4)
      end associate
   end subroutine print

end module ehlwave_touching_result
