!> The table of quantities: complete, no name twice, values that come back bit for bit from JSON.
program test_quantities
   use ehlwave_case_account, only: blank_result
   use ehlwave_case_completion, only: complete_case
   use ehlwave_case_definition, only: case_t
   use ehlwave_case_keys, only: case_key_list
   use ehlwave_case_plan, only: make_plan
   use ehlwave_case_result, only: case_result_t
   use ehlwave_errors, only: error_t
   use ehlwave_json_reader, only: split_list
   use ehlwave_kinds, only: dp, i8
   use ehlwave_planned_case, only: case_plan_t
   use ehlwave_input_quantities, only: add_case, add_plan
   use ehlwave_quantities, only: add_result
   use ehlwave_quantity, only: quantity_list_t, quantity_t
   use ehlwave_quantity_output, only: json_columns, json_object, json_values, take_json
   use testing, only: test_t
   implicit none (type, external)

   type(test_t) :: test
   type(case_t) :: case
   type(case_plan_t) :: plan
   type(case_result_t) :: result

   call make_case()
   call check_tables()
   call check_values()
   call check_json()
   call check_growth()
   call test%finish()

contains

   subroutine make_case()
      type(error_t), allocatable :: error
      case%load_parameter_m = 100
      case%lubricant_parameter_l = 12.05_dp
      case%radius_ratio_d = 0.35_dp
      case%orientation = 'transverse'
      case%wavelength_over_a = 0.7_dp
      case%cells_x = 64
      case%cells_y = 64
      call complete_case(case, '', error)
      if (.not. allocated(error)) call make_plan(case, plan, error)
      call test%check_no_error(error, 'case')
      result = blank_result(case, plan)
      result%central_film = 1/3.0_dp
      result%message = 'a "reason"; '
      result%residual_history = [1.0_dp, 0.1_dp]
   end subroutine make_case

   subroutine check_tables()
      type(quantity_list_t) :: list
      call add_result(list, case, plan, result)
      call check_table(list, 'result')
      list = quantity_list_t()
      call add_plan(list, case, plan)
      call check_table(list, 'plan')
   end subroutine check_tables

   subroutine check_table(list, what)
      type(quantity_list_t), intent(in) :: list
      character(len=*), intent(in) :: what
      character(len=*), parameter :: kinds(5) = [character(len=8) :: 'real', 'integer', 'logical', 'text', 'list']
      integer :: k
      call test%check(list%count > 20, what//' has quantities')
      do k = 1, list%count
         associate (q => list%items(k))
            call test%check_equal(list%find(q%name), k, q%name//' is there once')
            call test%check(len_trim(q%long_name) > 0 .and. q%long_name /= q%name, q%name//' has a long name')
            call test%check((len_trim(q%unit) > 0) .neqv. q%kind == 'text', q%name//' has a unit unless it is a text')
            call test%check(any(kinds == q%kind), q%name//' is of a known kind')
         end associate
      end do
      call test%check_equal(list%find('nothing'), 0, 'a name that is not there')
   end subroutine check_table

   subroutine check_values()
      type(quantity_list_t) :: list, what
      call add_result(list, case, plan, result)
      call test%check_close(list%items(list%find('central_film'))%number, 1/3.0_dp, 'central_film', relative=0.0_dp)
      call test%check_close(list%items(list%find('load_parameter_m'))%number, 100.0_dp, 'M', relative=0.0_dp)
      call test%check_equal(list%items(list%find('status'))%text, 'pending', 'status')
      call test%check_equal(list%items(list%find('phase_fit'))%unit, 'rad', 'unit of a phase')
      call test%check(.not. list%items(list%find('central_film_um'))%exists, 'no film in um without dimensions')
      call test%check(list%items(list%find('residual_history'))%exists, 'a history that is allocated')
      deallocate (result%residual_history)
      list = quantity_list_t()
      call add_result(list, case, plan, result)
      call test%check(.not. list%items(list%find('residual_history'))%exists, 'a history that is not')
      result%residual_history = [1.0_dp, 0.1_dp]
      call test%check(index(json_object(list), '"surfaces_touch": null') > 0, 'a truth that is not known')
      result%harmonic%surfaces_touch = .true.
      list = quantity_list_t()
      call add_result(list, case, plan, result)
      call test%check(index(json_object(list), '"surfaces_touch": true') > 0, 'a truth that is known')
      call add_case(what, case, case_key_list(case), plan)
      call test%check_equal(what%find('central_film'), 0, 'no outcome in what the case is')
   end subroutine check_values

   !> Names in order, values bit for bit, NaN as NaN.
   subroutine check_json()
      type(quantity_list_t) :: list
      type(quantity_t) :: back
      character(len=:), allocatable :: columns, values
      integer, allocatable :: first(:), last(:), first_column(:), last_column(:)
      integer :: k, n, wrong

      call add_result(list, case, plan, result)
      values = json_values(list)
      columns = json_columns(list)
      call split_list(values, first, last)
      call split_list(columns, first_column, last_column)
      call test%check_equal(size(first), count(list%items(:list%count)%exists), 'values')
      n = 0
      wrong = 0
      do k = 1, list%count
         associate (q => list%items(k))
            if (.not. q%exists) cycle
            n = n + 1
            call test%check_equal(columns(first_column(n):last_column(n)), '["'//q%name//'","'//trim(q%kind)//'"]', 'column')
            back = quantity_t(kind=q%kind)
            call take_json(values(first(n):last(n)), back)
            select case (q%kind)
            case ('text'); if (back%text /= q%text .or. len(back%text) /= len(q%text)) wrong = wrong + 1
            case ('list'); if (any(transfer(back%list, [0_i8]) /= transfer(q%list, [0_i8]))) wrong = wrong + 1
            case default; if (transfer(back%number, 0_i8) /= transfer(q%number, 0_i8)) wrong = wrong + 1
            end select
         end associate
      end do
      call test%check_equal(wrong, 0, 'values that do not come back')
   end subroutine check_json

   subroutine check_growth()
      type(quantity_list_t) :: list
      integer :: i
      do i = 1, 300
         call list%add(repeat('a', i), 'one of many', i)
      end do
      call test%check_equal(list%count, 300, 'long list')
      call test%check_equal(list%find(repeat('a', 200)), 200, 'place in a long list')
      call test%check_close(list%items(77)%number, 77.0_dp, 'value in a long list', relative=0.0_dp)
   end subroutine check_growth

end program test_quantities
