!> Responses about a steady state give the same bits however it was solved, rescued or not.
program test_shared_steady
   use ehlwave_case_completion, only: complete_case
   use ehlwave_case_definition, only: case_t
   use ehlwave_case_plan, only: make_plan
   use ehlwave_case_result, only: case_result_t
   use ehlwave_case_runner, only: run_case
   use ehlwave_errors, only: error_t
   use ehlwave_kinds, only: dp
   use ehlwave_planned_case, only: case_plan_t
   use ehlwave_shared_steady, only: shared_steady_t
   use ehlwave_status, only: is_success
   use silent_monitor, only: silent_monitor_t
   use testing, only: test_t
   implicit none (type, external)

   integer, parameter :: few = 5, enough = 60     !! steps: the direct solve takes 6
   real(dp), parameter :: short = 0.3_dp, long = 1.0_dp, longer = 2.0_dp   !! waves; 64 cells do not resolve the short
                                                                           !! waves

   type(test_t) :: test
   type(case_result_t) :: first, second, alone, alone_second

   call pair(enough, short, long, 'newton')
   call test%check(is_success(first%status) .and. is_success(second%status), 'unresolved and resolved converge')
   call test%check(first%rung == 'direct' .and. first%nonlinear_steps == second%nonlinear_steps, 'one state, the same account')
   call pair(enough, long, longer, 'fas')
   call test%check(is_success(first%status) .and. first%harmonic%error > 0, 'FAS')
   call pair(few, long, longer, 'newton')
   call test%check(first%rung == 'damped' .and. second%rescued_solutions == 1, 'a rescued state is shared')
   call pair(few, short, long, 'newton')
   call test%check(.not. is_success(first%status) .and. is_success(second%status), 'only resolved cases are rescued')
   call pair(few, long, short, 'newton')
   call test%check(is_success(first%status) .and. .not. is_success(second%status), 'whatever the order')
   call check_speeds()
   call check_friction()
   call check_room()
   call test%finish()

contains

   !> Sliding changes the steady state of an oil that is not Newtonian: none is shared between two speeds.
   subroutine check_speeds()
      type(shared_steady_t) :: shared
      call run(enough, long, 'newton', first, shared, slip=1.0_dp)
      call run(enough, long, 'newton', second, shared, slip=1.5_dp)
      call run(enough, long, 'newton', alone_second, slip=1.5_dp)
      call compare(second, alone_second, 'Ree-Eyring, second speed')
      call test%check(is_success(second%status) .and. second%shear%largest_b > 100, 'a Ree-Eyring oil that slides')
   end subroutine check_speeds

   !> The steady state of a Newtonian oil does not depend on sliding and is shared; its friction does.
   subroutine check_friction()
      type(shared_steady_t) :: shared
      call run(enough, long, 'newton', first, shared, slip=1.0_dp, flow_law='newtonian')
      call run(enough, long, 'newton', second, shared, slip=1.0001_dp, flow_law='newtonian')
      call run(enough, long, 'newton', alone_second, slip=1.0001_dp, flow_law='newtonian')
      call compare(second, alone_second, 'Newtonian, second speed')
      call test%check(same(second%shear%friction_coefficient, alone_second%shear%friction_coefficient) .and. &
                      abs(second%shear%friction_coefficient) > 0, 'friction of the second speed')
   end subroutine check_friction

   !> Linear systems that are not kept side by side: the same numbers and counts.
   subroutine check_room()
      type(shared_steady_t) :: shared
      shared%most_nodes = 0
      call run(enough, long, 'newton', first, shared)
      call run(enough, longer, 'newton', second, shared)
      call run(enough, long, 'newton', alone)
      call compare(first, alone, 'little room, first')
      call test%check(same(first%harmonic%mean_rise, alone%harmonic%mean_rise), 'little room, mean film')
      call run(enough, longer, 'newton', alone_second)
      call compare(second, alone_second, 'little room, second')
      call test%check(allocated(shared%response%tangent) .and. .not. allocated(shared%response%linear%levels), 'room was made')
   end subroutine check_room

   !> Two wavelengths of a contact, in `first` and `second`, each against the same case alone.
   subroutine pair(steps, wavelength, wavelength_second, method)
      integer, intent(in) :: steps
      real(dp), intent(in) :: wavelength, wavelength_second
      character(len=*), intent(in) :: method
      type(shared_steady_t) :: shared
      call run(steps, wavelength, method, first, shared)
      call run(steps, wavelength_second, method, second, shared)
      call run(steps, wavelength, method, alone)
      call run(steps, wavelength_second, method, alone_second)
      call compare(first, alone, method//', first')
      call compare(second, alone_second, method//', second')
   end subroutine pair

   subroutine run(steps, wavelength, method, result, shared, slip, flow_law)
      integer, intent(in) :: steps
      real(dp), intent(in) :: wavelength
      character(len=*), intent(in) :: method
      type(case_result_t), intent(out) :: result
      type(shared_steady_t), intent(inout), optional :: shared
      real(dp), intent(in), optional :: slip               !! S; the oil is then a Ree-Eyring oil,
      character(len=*), intent(in), optional :: flow_law   !! or this oil
      type(case_t) :: case
      type(case_plan_t) :: plan
      type(error_t), allocatable :: error
      type(silent_monitor_t) :: monitor

      case%load_parameter_m = 100
      case%lubricant_parameter_l = 12.05_dp
      case%radius_ratio_d = 1
      case%orientation = 'transverse'
      case%wavelength_over_a = wavelength
      case%response = 'harmonic'
      case%cells_x = 64
      case%cells_y = 64
      case%largest_steps = steps
      case%method = method
      if (present(slip)) then
         case%slip_parameter = slip
         case%oil%flow_law = 'eyring'
         case%oil%eyring_stress_pa = 5e6_dp
         if (present(flow_law)) case%oil%flow_law = flow_law
         case%data%reduced_modulus_pa = 2.26e11_dp
      end if
      call complete_case(case, '', error)
      if (.not. allocated(error)) call make_plan(case, plan, error)
      call test%check_no_error(error, method)
      if (allocated(error)) return
      call run_case(case, plan, monitor, result, shared)
   end subroutine run

   subroutine compare(a, b, what)
      type(case_result_t), intent(in) :: a, b
      character(len=*), intent(in) :: what
      call test%check(all([a%status, a%nonlinear_steps, a%linear_steps, a%rescued_solutions, a%harmonic%linear_steps] == &
                          [b%status, b%nonlinear_steps, b%linear_steps, b%rescued_solutions, b%harmonic%linear_steps]) &
                      .and. a%rung == b%rung .and. a%message == b%message, what//': outcome and effort')
      call test%check(all(same([a%central_film, a%minimum_film, a%central_film_error, a%minimum_film_error, a%film_order, &
                                a%residual, a%load_error, a%counted_work_units], &
                               [b%central_film, b%minimum_film, b%central_film_error, b%minimum_film_error, b%film_order, &
                                b%residual, b%load_error, b%counted_work_units])), what//': smooth contact')
      call test%check(all(same([a%harmonic%real_part, a%harmonic%imaginary_part, a%harmonic%approach_ratio, &
                                a%harmonic%extrapolated, a%harmonic%error, a%harmonic%counted_work_units], &
                               [b%harmonic%real_part, b%harmonic%imaginary_part, b%harmonic%approach_ratio, &
                                b%harmonic%extrapolated, b%harmonic%error, b%harmonic%counted_work_units])), what//': response')
   end subroutine compare

   !> Equal bits; NaN equals NaN.
   elemental logical function same(a, b)
      real(dp), intent(in) :: a, b
      same = abs(a - b) <= 0 .or. .not. (abs(a) <= huge(a) .or. abs(b) <= huge(b))
   end function same

end program test_shared_steady
