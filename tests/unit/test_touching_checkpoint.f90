!> A march of surfaces that touch goes on from its checkpoint with the same bits, in line and elliptical contacts.
program test_touching_checkpoint
   use ehlwave_case_completion, only: complete_case
   use ehlwave_case_definition, only: case_t
   use ehlwave_case_plan, only: make_plan
   use ehlwave_case_result, only: case_result_t
   use ehlwave_checkpoint_file, only: checkpoint_t
   use ehlwave_conditions, only: contact_data_t
   use ehlwave_errors, only: error_t
   use ehlwave_estimated_case, only: run_estimated_case
   use ehlwave_kinds, only: dp, i8
   use ehlwave_planned_case, only: case_plan_t
   use ehlwave_posix, only: remove_file
   use ehlwave_status, only: status_interrupted
   use step_counter, only: counter_t
   use testing, only: test_t
   implicit none (type, external)

   character(len=*), parameter :: path = 'test_touching_checkpoint.checkpoint'
   integer, parameter :: stop_at = 7
   type(test_t) :: test
   integer :: status

   call check_march('ball', is_line=.false.)
   call check_march('roller', is_line=.true.)
   call remove_file(path, status)
   call test%finish()

contains

   !> Stop a march after some steps on the wider mesh, and go on; the march of a line also on its own mesh.
   subroutine check_march(name, is_line)
      character(len=*), intent(in) :: name
      logical, intent(in) :: is_line
      type(case_t) :: case
      type(case_plan_t) :: plan
      type(case_result_t) :: whole
      integer :: first, steps

      call make_case(is_line, case, plan)
      call remove_file(path, status)
      call run(case, plan, plan%steps, huge(1), whole, first, steps)
      call test%check_equal(steps, plan%steps, name//': steps of the whole march')
      call test%check(whole%effects%touching%account%share > 0.01_dp, name//': the surfaces touch')
      if (is_line) call check_stop(name, case, plan, plan%steps, whole)
      call check_stop(name//', wider mesh', case, plan, plan%steps/2, whole)
   end subroutine check_march

   !> Stop the march of a mesh with so many steps after some of them: the march goes on there, without the meshes before.
   subroutine check_stop(name, case, plan, total, whole)
      character(len=*), intent(in) :: name
      type(case_t), intent(in) :: case
      type(case_plan_t), intent(in) :: plan
      integer, intent(in) :: total
      type(case_result_t), intent(in) :: whole        !! of a march without a stop
      type(case_result_t) :: stopped, resumed
      integer :: first, steps

      call remove_file(path, status)
      call run(case, plan, total, stop_at, stopped, first, steps)
      call test%check_equal(stopped%status, status_interrupted, name//': status of a stopped march')
      call run(case, plan, 0, huge(1), resumed, first, steps)
      call test%check_equal(first, stop_at + 1, name//': first step after the stop, of any mesh')
      call compare(name, whole, resumed)
   end subroutine check_stop

   !> A wave that rolls through, on a coarse grid.
   subroutine make_case(is_line, case, plan)
      logical, intent(in) :: is_line
      type(case_t), intent(out) :: case
      type(case_plan_t), intent(out) :: plan
      type(error_t), allocatable :: error

      case%is_dimensional = .true.
      case%data = contact_data_t(radius_x_m=0.01_dp, radius_y_m=0.01_dp, reduced_modulus_pa=2.26e11_dp, load_n=20.72_dp, &
                                 mean_speed_m_per_s=0.05_dp, viscosity_pa_s=0.04_dp, pressure_viscosity_per_pa=2.2e-8_dp)
      if (is_line) case%data = contact_data_t(radius_x_m=0.01_dp, reduced_modulus_pa=2.26e11_dp, &
         load_n_per_m=1e5_dp, mean_speed_m_per_s=0.03_dp, viscosity_pa_s=0.04_dp, pressure_viscosity_per_pa=2.2e-8_dp)
      case%effects%touching%data%film_m = 20e-9_dp
      case%orientation = 'transverse'
      case%wavelength_over_a = merge(0.5_dp, 1.0_dp, is_line)
      case%amplitude_m = 2e-7_dp
      case%scheme = 'averaged'
      case%cells_x = merge(96, 32, is_line)
      if (.not. is_line) case%cells_y = 32
      call complete_case(case, '', error)
      if (.not. allocated(error)) call make_plan(case, plan, error)
      call test%check_no_error(error, 'case')
   end subroutine make_case

   subroutine run(case, plan, total, last, result, first, steps)
      type(case_t), intent(in) :: case
      type(case_plan_t), intent(in) :: plan
      integer, intent(in) :: total                    !! steps of the mesh that is followed, 0: of all
      integer, intent(in) :: last                     !! step at which its march is to stop
      type(case_result_t), intent(out) :: result
      integer, intent(out) :: first, steps
      type(checkpoint_t) :: checkpoint
      type(counter_t) :: monitor

      checkpoint%path = path
      checkpoint%identity = '0123456789ABCDEF'
      monitor%stage = 'time step with touching'
      monitor%total = total
      monitor%stop_at = last
      call run_estimated_case(case, plan, monitor, result, keeper=checkpoint)
      first = monitor%first
      steps = monitor%steps
   end subroutine run

   !> All numbers of two results, bit for bit.
   subroutine compare(name, a, b)
      character(len=*), intent(in) :: name
      type(case_result_t), intent(in) :: a, b

      call test%check_equal(a%status, b%status, name//': status')
      call test%check_equal(a%linear_steps, b%linear_steps, name//': linear steps')
      call same(a%film_history, b%film_history, name//': films')
      call same([a%residual, a%load_error, a%work, a%mean_film], [b%residual, b%load_error, b%work, b%mean_film], &
                name//': account')
      associate (c => a%effects%touching%account, d => b%effects%touching%account)
         call same(c%share_history, d%share_history, name//': shares')
         call same([c%share, c%area, c%friction_oil, c%max_contact_pressure, c%share_error], &
                   [d%share, d%area, d%friction_oil, d%max_contact_pressure, d%share_error], name//': means')
      end associate
   end subroutine compare

   subroutine same(a, b, name)
      real(dp), intent(in) :: a(:), b(:)
      character(len=*), intent(in) :: name
      call test%check(size(a) == size(b), name//', number of values')
      if (size(a) == size(b)) call test%check(all(transfer(a, [0_i8]) == transfer(b, [0_i8])), name//' keep their bits')
   end subroutine same

end program test_touching_checkpoint
