!> A march that is stopped goes on from its checkpoint with the same bits; a torn or foreign checkpoint is not used.
program test_checkpoint_file
   use ehlwave_case_completion, only: complete_case
   use ehlwave_case_definition, only: case_t
   use ehlwave_case_plan, only: make_plan
   use ehlwave_case_result, only: case_result_t
   use ehlwave_case_runner, only: run_case
   use ehlwave_checkpoint_file, only: checkpoint_t
   use ehlwave_conditions, only: contact_data_t
   use ehlwave_errors, only: error_t
   use ehlwave_heat_data, only: heat_data_t
   use ehlwave_kinds, only: dp, i8
   use ehlwave_planned_case, only: case_plan_t
   use ehlwave_posix, only: remove_file, replace_file
   use ehlwave_status, only: is_success, status_interrupted
   use ehlwave_text_file, only: read_whole_file
   use ehlwave_time_march, only: steps_per_stretch
   use step_counter, only: counter_t
   use testing, only: test_t
   implicit none (type, external)

   character(len=*), parameter :: path = 'test_checkpoint_file.checkpoint', identity = '0123456789ABCDEF'
   type(test_t) :: test
   type(case_t) :: case
   type(case_plan_t) :: plan
   type(case_result_t) :: whole, stopped
   character(len=:), allocatable :: text
   integer :: i, places(4), status

   call make_case()
   call check_case()
   call check_unusable()
   call make_warm_case()
   call check_case()
   call remove_file(path, status)
   call test%finish()

contains

   !> Stop a march and go on.
   subroutine check_case()
      call run_with(whole, text='', expected_steps=plan%steps, what='a march without a checkpoint')
      call test%check(is_success(whole%status), 'the whole march')
      call stop_march()
      call read_whole_file(path, text)
      call test%check(allocated(text), 'there is a checkpoint')
      if (.not. allocated(text)) call test%finish()
      call run_with(stopped, text, expected_steps=plan%steps - steps_per_stretch, what='a march that goes on')
      call compare('a march that goes on')
   end subroutine check_case

   subroutine make_case()
      type(error_t), allocatable :: error
      case%load_parameter_m = 200
      case%lubricant_parameter_l = 12.05
      case%radius_ratio_d = 0.35
      case%orientation = 'transverse'
      case%wavelength_over_a = 1
      case%slip_parameter = 1.25
      case%effects%second%roughness%orientation = 'transverse'       ! both surfaces are rough
      case%effects%second%roughness%wavelength_over_a = 0.8
      case%load_balance = 'equation_of_motion'     ! for it the approach of the steps before counts
      case%natural_frequency = 6
      case%cells_x = 32
      case%cells_y = 32
      call complete_case(case, '', error)
      if (.not. allocated(error)) call make_plan(case, plan, error)
      call test%check_no_error(error, 'case')
      call test%check(plan%steps > steps_per_stretch, 'the march is longer than a stretch')
   end subroutine make_case

   !> Checkpoint with heat, whose oil and surfaces follow the waves.
   subroutine make_warm_case()
      type(error_t), allocatable :: error
      type(case_t) :: defaults
      case = defaults
      case%is_dimensional = .true.
      case%data = contact_data_t(radius_x_m=0.02_dp, radius_y_m=0.02_dp, reduced_modulus_pa=2.26e11_dp, load_n=100.0_dp, &
                                 mean_speed_m_per_s=2.0_dp, viscosity_pa_s=0.08_dp, pressure_viscosity_per_pa=2e-8_dp)
      case%oil%temperature_k = 313
      case%effects%heat%data = heat_data_t(oil_conductivity_w_per_m_k=0.14_dp, oil_heat_capacity_j_per_kg_k=2000.0_dp, &
                              oil_density_kg_per_m3=870.0_dp, oil_expansion_per_k=7e-4_dp, &
                              viscosity_temperature_per_k=0.045_dp, wave_temperatures='carried')
      case%orientation = 'transverse'
      case%wavelength_over_a = 1
      case%slip_parameter = 1.02_dp
      case%effects%second%roughness%orientation = 'transverse'
      case%effects%second%roughness%wavelength_over_a = 0.8
      case%cells_x = 32
      case%cells_y = 32
      call complete_case(case, '', error)
      if (.not. allocated(error)) call make_plan(case, plan, error)
      call test%check_no_error(error, 'case with heat')
      call test%check(plan%steps > steps_per_stretch, 'its march is longer than a stretch')
   end subroutine make_warm_case

   subroutine stop_march()
      type(checkpoint_t) :: checkpoint
      type(counter_t) :: monitor
      checkpoint%path = path
      checkpoint%identity = identity
      monitor%stop_at = 5
      call run_case(case, plan, monitor, stopped, keeper=checkpoint)
      call test%check_equal(stopped%status, status_interrupted, 'a march that is stopped')
      call test%check_equal(stopped%time_steps, steps_per_stretch, 'it goes on to the end of its stretch')
   end subroutine stop_march

   !> Run the case with a checkpoint file of this content (empty: none) and count its steps.
   subroutine run_with(result, text, expected_steps, what)
      type(case_result_t), intent(out) :: result
      character(len=*), intent(in) :: text, what
      integer, intent(in) :: expected_steps
      type(counter_t) :: monitor
      call run_counted(result, text, monitor)
      call test%check_equal(monitor%steps, expected_steps, 'steps of '//what)
   end subroutine run_with

   !> The first two steps with a checkpoint file of this content equal the steps of a march without one.
   subroutine begin_with(text, what)
      character(len=*), intent(in) :: text, what
      type(case_result_t) :: begun
      type(counter_t) :: monitor
      monitor%end_after = 2
      call run_counted(begun, text, monitor)
      call test%check_equal(monitor%first, 1, 'first step with '//what)
      call test%check_equal(monitor%steps, 2, 'steps with '//what)
      call test%check(all(transfer(begun%film_history(:2), [0_i8]) == transfer(whole%film_history(:2), [0_i8])), &
                      'film with '//what)
   end subroutine begin_with

   subroutine run_counted(result, text, monitor)
      type(case_result_t), intent(out) :: result
      character(len=*), intent(in) :: text
      type(counter_t), intent(inout) :: monitor
      type(checkpoint_t) :: checkpoint
      call remove_file(path, status)
      if (len(text) > 0) call replace_file(path, text, status)
      checkpoint%path = path
      checkpoint%identity = identity
      call run_case(case, plan, monitor, result, keeper=checkpoint)
   end subroutine run_counted

   !> All numbers of `stopped` against `whole`, bit for bit.
   subroutine compare(what)
      character(len=*), intent(in) :: what
      call test%check_equal(stopped%status, whole%status, 'status of '//what)
      call test%check(all(transfer(stopped%film_history, [0_i8]) == transfer(whole%film_history, [0_i8])), 'film of '//what)
      call test%check(all(transfer(stopped%approach_history, [0_i8]) == transfer(whole%approach_history, [0_i8])), &
                      'approach of '//what)
      call test%check(all(whole%ratios(2) > 0), 'there are Ad/Ai of both surfaces')
      call test%check_equal(transfer(stopped%amplitude_ratio_fit, 0_i8), transfer(whole%amplitude_ratio_fit, 0_i8), &
                            'Ad/Ai of '//what)
      call test%check_equal(transfer(stopped%effects%second%surface%amplitude_ratio_fit, 0_i8), &
                            transfer(whole%effects%second%surface%amplitude_ratio_fit, 0_i8), &
                            'Ad/Ai of surface 2 of '//what)
      call test%check_equal(transfer(stopped%residual, 0_i8), transfer(whole%residual, 0_i8), 'residual of '//what)
      call test%check_equal(stopped%linear_steps, whole%linear_steps, 'linear steps of '//what)
   end subroutine compare

   !> Torn, damaged, of another case or of another build: the march begins anew and comes to the same.
   subroutine check_unusable()
      character(len=:), allocatable :: bad
      bad = damaged(len(text)/2)
      call run_with(stopped, bad, expected_steps=plan%steps, what='a damaged checkpoint')
      call compare('a damaged checkpoint')
      places = [1, index(text, identity), len(text) - 8, len(text)]
      do i = 1, size(places)
         call begin_with(damaged(places(i)), 'a damaged checkpoint')
      end do
      call begin_with(text(:len(text) - 1), 'a torn checkpoint')
      call begin_with(text(:index(text, identity)), 'half a heading')
   end subroutine check_unusable

   !> The checkpoint with a single bit changed.
   pure function damaged(place) result(bad)
      integer, intent(in) :: place
      character(len=:), allocatable :: bad
      bad = text
      bad(place:place) = achar(ieor(iachar(bad(place:place)), 1))
   end function damaged

end program test_checkpoint_file
