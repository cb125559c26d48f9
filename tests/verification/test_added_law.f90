!> Declared errors of an oil whose law of flow is added here: factors and parts of errors know nothing of it.
!>
!> As the study of declared errors does, each contact is solved on 32, 64 and 128 cells, a line on 64 to 256, and the
!> values of the finest two, extrapolated, judge the declared errors of the coarsest: of the ellipse by the model, of
!> the line by two grids.
program test_added_law
   use added_law, only: cubic_law_t
   use ehlwave_case_completion, only: complete_case
   use ehlwave_case_definition, only: case_t
   use ehlwave_case_plan, only: make_plan
   use ehlwave_case_result, only: case_result_t
   use ehlwave_case_runner, only: run_case
   use ehlwave_errors, only: error_t
   use ehlwave_kinds, only: dp
   use ehlwave_planned_case, only: case_plan_t
   use ehlwave_status, only: is_success
   use ehlwave_text, only: to_text
   use silent_monitor, only: silent_monitor_t
   use testing, only: test_t
   implicit none (type, external)

   real(dp), parameter :: modulus_pa = 2.26e11_dp, stress_pa = 1e7_dp
   !> M, L, D and S of each contact
   real(dp), parameter :: contacts(4, 2) = reshape([50.0_dp, 8.0_dp, 1.0_dp, 1.3_dp, &
                                                   20.0_dp, 8.0_dp, 0.0_dp, 1.2_dp], [4, 2])
   character(len=*), parameter :: schemes(2) = ['averaged', 'fitted  ']
   type(test_t) :: test
   integer :: contact, scheme

   do contact = 1, size(contacts, 2)
      do scheme = 1, size(schemes)
         call judge(contacts(:, contact), trim(schemes(scheme)))
      end do
   end do
   call test%finish()

contains

   subroutine judge(contact, scheme)
      real(dp), intent(in) :: contact(4)
      character(len=*), intent(in) :: scheme
      type(case_result_t) :: results(3)
      integer :: factor, n

      factor = merge(48, 64, contact(3) > 0)
      do n = 1, 3
         call run(contact, scheme, factor*2**(n - 1), results(n))
      end do
      associate (on => results)
         call check(scheme//', central film', cmplx(on%central_film, kind=dp), on(1)%central_film_error)
         call check(scheme//', smallest film', cmplx(on%minimum_film, kind=dp), on(1)%minimum_film_error)
         call check(scheme//', friction', cmplx(on%shear%friction_coefficient, kind=dp), on(1)%friction_error)
         call check(scheme//', response', &
                    cmplx(on%harmonic%real_part, on%harmonic%imaginary_part, dp), on(1)%harmonic%error)
      end associate
   end subroutine judge

   subroutine run(contact, scheme, cells, result)
      real(dp), intent(in) :: contact(4)
      character(len=*), intent(in) :: scheme
      integer, intent(in) :: cells
      type(case_result_t), intent(out) :: result
      type(case_t) :: given
      type(case_plan_t) :: plan
      type(error_t), allocatable :: error
      type(silent_monitor_t) :: monitor

      given%load_parameter_m = contact(1)
      given%lubricant_parameter_l = contact(2)
      given%radius_ratio_d = contact(3)
      given%slip_parameter = contact(4)
      given%data%reduced_modulus_pa = modulus_pa
      given%orientation = 'transverse'
      given%wavelength_over_a = 1
      given%response = 'harmonic'
      given%mean_rise = .false.
      given%scheme = scheme
      given%cells_x = cells
      if (contact(3) > 0) given%cells_y = cells
      call complete_case(given, '', error)
      if (.not. allocated(error)) call make_plan(given, plan, error)
      call test%check_no_error(error, scheme)
      if (allocated(error)) return
      call plan%rheology%use_flow(cubic_law_t(), modulus_pa*stress_pa)
      call run_case(given, plan, monitor, result)
      call test%check(is_success(result%status), scheme//' on '//to_text(cells)//' cells: '//result%message)
   end subroutine run

   !> The truth lies within the declared error, and that is no mere guard.
   subroutine check(name, values, declared)
      character(len=*), intent(in) :: name
      complex(dp), intent(in) :: values(3)     !! coarsest first
      real(dp), intent(in) :: declared
      real(dp) :: off
      off = abs(values(3) + (values(3) - values(2))/3 - values(1))/abs(values(1))
      print '(a)', 'measured: '//name//' off '//to_text(off, 2)//', declared '//to_text(declared, 2)
      call test%check(off <= declared, name//' is within its error')
      call test%check(declared < 1, name//' has a useful error')
   end subroutine check

end program test_added_law
