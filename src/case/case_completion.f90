!> Completes the input of a case: fills in keys that follow from others, and refuses contradictions.
module ehlwave_case_completion
   use ehlwave_case_definition, only: case_t, largest_line_cells, usual_largest_cells
   use ehlwave_case_lubricant, only: check_lubricant, pressure_viscosity
   use ehlwave_conditions, only: conditions_from_dimensional, conditions_from_moes, conditions_t
   use ehlwave_effects_plan, only: effects_plan_t
   use ehlwave_errors, only: error_t, raise
   use ehlwave_kinds, only: dp
   use ehlwave_case_roughness, only: check_line_roughness, check_response, complete_amplitudes, &
      complete_roughness
   use ehlwave_method_choice, only: choose_method
   use ehlwave_roughness, only: roughness_t
   use ehlwave_sensitivity_check, only: check_sensitivities
   use ehlwave_scheme_choice, only: check_scheme, choose_scheme
   use ehlwave_petsc_library, only: require_petsc
   use ehlwave_text, only: to_text
   use ehlwave_threads, only: can_share
   implicit none (type, external)
   private
   public :: complete_case, case_conditions

contains

   !> Complete a case all of whose keys are meant, whether or not they apply. `place` begins every message.
   subroutine complete_case(case, place, error)
      type(case_t), intent(inout) :: case
      character(len=*), intent(in) :: place
      type(error_t), allocatable, intent(inout) :: error
      type(conditions_t) :: conditions
      type(effects_plan_t) :: effects

      if (allocated(error)) return
      call case_conditions(case, conditions, error)
      if (.not. allocated(error)) call effects%check_data(case, error)
      if (.not. allocated(error) .and. conditions%is_line()) call complete_line(case, error)
      if (case%largest_cells == 0) case%largest_cells = usual_largest_cells
      if (.not. allocated(error)) call complete_roughness(case, error)
      call complete_amplitudes(case, conditions, error)
      if (.not. allocated(error)) call check_grid_and_time(case, error)
      if (.not. allocated(error)) call check_response(case, error)
      if (.not. allocated(error)) call effects%check(case, error)
      call check_sensitivities(case, error)
      if (.not. allocated(error)) call check_scheme(case, error)
      if (.not. allocated(error)) call choose_scheme(case, conditions)
      if (.not. allocated(error)) call choose_method(case, conditions)
      if (.not. allocated(error) .and. case%method == 'petsc') call require_petsc(error)
      if (.not. allocated(error) .and. case%threads > 1 .and. .not. can_share()) call raise(error, &
         '&solver threads = '//to_text(case%threads)//': this build has no OpenMP: remove the key, or build with '// &
         '-DEHLWAVE_THREADS=ON')
      if (case%method == 'fas' .and. case%cycle == '') case%cycle = 'f'
      if (allocated(error)) error%message = place//error%message
   end subroutine complete_case

   !> Refuse keys that a line contact, D = 0, does not have: anything that is about its width; an
   !> approach whose change in time is known (that under a line load on a half-space is determined but for a constant
   !> times the load, so there is no equation of motion); FAS and MLMI, which are not written for it.
   subroutine complete_line(case, error)
      type(case_t), intent(inout) :: case
      type(error_t), allocatable, intent(inout) :: error
      character(len=*), parameter :: line = ': a line contact (radius_ratio_d = 0) '
      type(roughness_t) :: both(2)
      integer :: n

      both = case%surfaces()
      do n = 1, size(both)
         call check_line_roughness(case, both(n), line, error)
      end do
      if (allocated(error)) return
      if (case%method == 'fas') then
         call raise(error, "&solver method = 'fas'"//line//"is solved by 'newton' or 'petsc'")
      else if (case%deformation == 'mlmi') then
         call raise(error, "&solver deformation = 'mlmi'"//line//"has its deformation by 'fft'")
      else if (case%load_balance == 'equation_of_motion') then
         call raise(error, "&dynamics load_balance = 'equation_of_motion'"//line// &
            'has no mutual approach of its own (a line '// &
                    "load on a half-space gives an infinite one): use 'force_balance'")
      end if
      case%cells_y = 1
      case%domain = 'auto'
      if (case%largest_cells == 0) case%largest_cells = largest_line_cells
   end subroutine complete_line

   !> Operating conditions of a case whose lubricant has all it needs; also sets M, L, D of a case given by dimensional
   !> data.
   subroutine case_conditions(case, conditions, error)
      type(case_t), intent(inout) :: case
      type(conditions_t), intent(out) :: conditions
      type(error_t), allocatable, intent(inout) :: error
      type(effects_plan_t) :: effects
      real(dp) :: alpha_per_pa

      call effects%complete(case)
      call check_lubricant(case, error)
      if (allocated(error)) return
      alpha_per_pa = pressure_viscosity(case)
      if (case%is_dimensional) then
         case%data%pressure_viscosity_per_pa = alpha_per_pa
         call conditions_from_dimensional(case%data, conditions, error)
         case%load_parameter_m = conditions%m
         case%lubricant_parameter_l = conditions%l
         case%radius_ratio_d = conditions%d
      else
         call conditions_from_moes(case%load_parameter_m, case%lubricant_parameter_l, case%radius_ratio_d, &
                                   alpha_per_pa, conditions, error)
         conditions%data%reduced_modulus_pa = case%data%reduced_modulus_pa
      end if
      conditions%slip_parameter = case%slip_parameter
   end subroutine case_conditions

   subroutine check_grid_and_time(case, error)
      type(case_t), intent(in) :: case
      type(error_t), allocatable, intent(inout) :: error
      real(dp) :: ratio

      call check_cells(case%cells_x, 'cells_x', error)
      if (case%radius_ratio_d > 0) call check_cells(case%cells_y, 'cells_y', error)
      if (allocated(error)) return
      ratio = case%time_step_over_cell
      if (ratio <= 0) ratio = 1
      if (ratio < 1) ratio = 1/ratio
      if (abs(ratio - nint(ratio)) > 1e-6_dp*ratio .or. ratio > 64) &
         call raise(error, '&solver time_step_over_cell = '//to_text(case%time_step_over_cell, 6)// &
                    ': give a whole number (1, 2, 4) or one over a whole number (0.5, 0.25), so that steps follow '// &
                    'the characteristics from node to node')
      if (allocated(error)) return
      if (case%load_balance == 'equation_of_motion' .and. .not. case%natural_frequency > 0) &
         call raise(error, "&dynamics natural_frequency is missing: load_balance 'equation_of_motion' needs Omega")
   end subroutine check_grid_and_time

   !> 0 leaves the number of cells to the plan.
   subroutine check_cells(cells, key, error)
      integer, intent(in) :: cells
      character(len=*), intent(in) :: key
      type(error_t), allocatable, intent(inout) :: error

      if (allocated(error) .or. cells <= 0) return
      if (cells < 16 .or. cells > 8192 .or. modulo(cells, 2) /= 0) call raise(error, '&grid '//key//' = '// &
         to_text(cells)// &
         ': give an even number from 16 to 8192, best one that can be halved several times (64, 96, 128, ...), or '// &
         '0 for the plan to choose')
   end subroutine check_cells

end module ehlwave_case_completion
