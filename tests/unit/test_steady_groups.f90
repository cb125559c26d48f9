!> The order in which ranks get the cases of a sweep.
program test_steady_groups
   use ehlwave_case_definition, only: case_t
   use ehlwave_case_plan, only: make_plan
   use ehlwave_errors, only: error_t
   use ehlwave_kinds, only: dp
   use ehlwave_planned_case, only: case_plan_t
   use ehlwave_sweep_queue, only: new_queue, queue_t
   use testing, only: test_t
   implicit none (type, external)

   type(test_t) :: test
   type(case_t) :: cases(9)
   type(case_plan_t) :: plans(9)
   type(queue_t) :: queue
   logical, parameter :: all_of_them(9) = .true.
   real(dp), parameter :: none_known(9) = 0
   integer :: case, i, taken(9)

   ! 1 to 4 and 6: responses about a steady state, 5 and 7: about another, 8 and 9: transients about the first
   do i = 1, 9
      cases(i)%load_parameter_m = merge(200, 100, i == 5 .or. i == 7)
      cases(i)%lubricant_parameter_l = 10
      cases(i)%radius_ratio_d = 1
      cases(i)%orientation = 'transverse'
      cases(i)%wavelength_x_over_a = 0.5 + 0.1*i
      cases(i)%wavelength_over_a = cases(i)%wavelength_x_over_a
      cases(i)%response = merge('harmonic ', 'transient', i < 8)
   end do
   cases(3)%slip_parameter = 0.5
   cases(6) = cases(1)                                     ! another pattern of the same frequency
   cases(6)%orientation = 'isotropic'
   cases(6)%wavelength_y_over_a = cases(1)%wavelength_x_over_a
   call plan_all()
   queue = new_queue(cases, plans, all_of_them, none_known, 3)
   call test%check(all(queue%group == [1, 1, 1, 1, 2, 1, 2, 3, 4]), 'groups')

   call queue%take(0, case)
   call test%check_equal(case, 9, 'the longest first: its waves are longer')
   call queue%take(1, case)
   call test%check_equal(case, 8, 'then the next')
   call queue%take(2, case)
   call test%check_equal(case, 1, 'a group')
   call queue%take(0, case)
   call test%check_equal(case, 5, 'another group for another rank')
   call queue%take(2, case)
   call test%check_equal(case, 6, 'a rank stays with its group, and first with its frequency')
   call queue%take(0, case)
   call test%check_equal(case, 7, 'so does this one')
   call queue%take(0, case)
   call test%check_equal(case, 2, 'and helps where most is left')
   call test%check(.not. queue%is_empty(), 'not empty yet')
   call queue%take(1, case)
   call queue%take(1, case)
   call test%check(case == 3 .and. queue%is_empty(), 'the slowest wave is the last')
   call queue%take(1, case)
   call test%check_equal(case, 0, 'nothing left')

   queue = new_queue(cases, plans, all_of_them, none_known, 1)
   do i = 1, 9
      call queue%take(0, taken(i))
   end do
   call test%check(all([(any(taken == i), i=1, 9)]), 'one rank gets every case once')

   ! keys that change the steady state separate the groups, domain and grid included
   cases(2)%cells_x = 128
   cases(3)%domain = 'whole'
   cases(4)%oil%roelands%index = 0.5
   call plan_all()
   queue = new_queue(cases, plans, all_of_them, none_known, 1)
   call test%check(all(queue%group(:6) == [1, 2, 3, 4, 5, 1]), 'groups of their own')
   cases(2) = cases(1)
   cases(2)%tolerance = 1e-7_dp
   cases(3) = cases(1)
   cases(3)%method = 'fas'
   cases(3)%cycle = 'f'
   cases(4) = cases(3)
   cases(4)%cycle = 'v'
   cases(5) = cases(1)
   cases(5)%deformation = 'mlmi'
   cases(6) = cases(1)
   cases(6)%largest_steps = 30
   cases(7) = cases(1)
   cases(7)%largest_total_steps = 100
   call plan_all()
   queue = new_queue(cases, plans, all_of_them, none_known, 1)
   call test%check(all(queue%group(:7) == [1, 2, 3, 4, 5, 6, 7]), 'by solver and limits too')
   call test%finish()

contains

   subroutine plan_all()
      type(error_t), allocatable :: error
      integer :: k
      do k = 1, 9
         call make_plan(cases(k), plans(k), error)
         call test%check_no_error(error, 'plan')
      end do
   end subroutine plan_all

end program test_steady_groups
