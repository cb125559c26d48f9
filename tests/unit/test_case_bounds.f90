!> Whatever the bounds of the keys let pass is the same case on every rank: a case travels as its effective input, which must
!> be read back to the same text and plan. Generated from the table of keys: each bound and choice of each key, in one of six
!> cases, or in all of them where EHLWAVE_LONG_TESTS is set.
program test_case_bounds
   use, intrinsic :: ieee_exceptions, only: ieee_set_flag, ieee_set_halting_mode, ieee_usual
   use ehlwave_case_file, only: case_from_text
   use ehlwave_case_definition, only: case_t
   use ehlwave_case_input, only: case_input_t
   use ehlwave_case_key, only: choice_length, key_value_t, number_kind, truth_kind, value_text, whole_kind, words_of
   use ehlwave_case_keys, only: default_keys
   use ehlwave_case_plan, only: make_plan
   use ehlwave_case_text, only: effective_input
   use ehlwave_errors, only: error_t
   use ehlwave_input_completion, only: complete_input
   use ehlwave_key_bounds, only: read_key
   use ehlwave_key_list, only: find_key, key_list_t
   use ehlwave_kinds, only: dp
   use ehlwave_namelist_scanner, only: value_t
   use ehlwave_planned_case, only: case_plan_t
   use testing, only: is_long, test_t
   implicit none (type, external)

   character(len=*), parameter :: bases(6) = [character(len=12) :: 'waves', 'custom', 'line', 'fas', 'motion', 'dimensional']
   type(test_t) :: test
   type(key_list_t) :: table
   integer :: accepted, apart, b, k, refused

   call ieee_set_halting_mode(ieee_usual, .false.)   ! large values overflow, which debug builds are to refuse, too
   table = default_keys()
   accepted = 0
   refused = 0
   apart = merge(1, size(bases), is_long())
   do k = 1, table%count
      do b = 1 + modulo(k, apart), size(bases), apart
         call try_key(k, trim(bases(b)))
      end do
   end do
   call ieee_set_flag(ieee_usual, .false.)
   call test%check(accepted > 150, 'many values are accepted')
   call test%check(refused > 150, 'many values are refused')
   call test%finish()

contains

   !> Every bound of a key, the values next to it, and every choice.
   subroutine try_key(k, base)
      integer, intent(in) :: k
      character(len=*), intent(in) :: base
      character(len=choice_length), allocatable :: words(:)
      type(key_value_t) :: value
      real(dp), allocatable :: numbers(:)
      integer :: i

      associate (key => table%keys(k))
         value%kind = key%kind
         select case (key%kind)
         case (number_kind, whole_kind)
            numbers = [0.0_dp, 1.0_dp, -1.0_dp, 1e9_dp, beside(key%above), beside(key%minimum), beside(key%maximum)]
            if (key%kind == number_kind) numbers = [numbers, 1e-300_dp, 1e300_dp, 0.3_dp, 1/3.0_dp]
            do i = 1, size(numbers)
               value%number = merge(anint(numbers(i)), numbers(i), key%kind == whole_kind)
               call try(k, value, base)
            end do
         case (truth_kind)
            do i = 0, 1
               value%number = i
               call try(k, value, base)
            end do
         case default
            words = words_of(key%choices)
            do i = 1, size(words)
               value%word = trim(words(i))
               call try(k, value, base)
            end do
         end select
      end associate
   end subroutine try_key

   !> A bound and its neighbours; nothing where there is none.
   pure function beside(bound) result(numbers)
      real(dp), intent(in) :: bound
      real(dp), allocatable :: numbers(:)
      numbers = [real(dp) ::]
      if (abs(bound) < 1e12_dp) numbers = [bound, nearest(bound, 1.0_dp), nearest(bound, -1.0_dp), bound + 1, bound - 1]
   end function beside

   !> A value in a case: refused, or the same on another rank.
   subroutine try(k, value, base)
      integer, intent(in) :: k
      type(key_value_t), intent(in) :: value
      character(len=*), intent(in) :: base
      type(case_input_t) :: input
      type(case_t) :: case
      type(case_plan_t) :: plan, planned
      type(error_t), allocatable :: error
      type(key_value_t) :: read_value
      type(value_t) :: item
      character(len=:), allocatable :: problem, text, what

      item%text = value_text(value)
      item%is_quoted = allocated(value%word)
      if (item%is_quoted) item%text = value%word
      read_value = value
      call read_key(table%keys(k), item, read_value, problem)
      if (allocated(problem)) then
         refused = refused + 1
         return
      end if
      input = base_input(base)
      call input%set([k], [read_value])
      call complete_input(input, table, '', error)
      if (.not. allocated(error)) call make_plan(input%case, plan, error)
      if (allocated(error)) then
         refused = refused + 1
         return
      end if
      accepted = accepted + 1
      what = base//' with '//trim(table%keys(k)%name)//' = '//value_text(value)
      text = effective_input(input%case)
      call case_from_text(text, case, error)
      if (.not. allocated(error)) call make_plan(case, planned, error)
      call test%check_no_error(error, what)
      if (allocated(error)) return
      call test%check_equal(effective_input(case), text, what)
      call test%check_equal(planned%cells_x, plan%cells_x, what//', cells')
   end subroutine try

   function base_input(base) result(input)
      character(len=*), intent(in) :: base
      type(case_input_t) :: input
      if (base == 'dimensional') then
         call give(input, 'radius_x_m', 0.0125_dp)
         call give(input, 'radius_y_m', 0.0125_dp)
         call give(input, 'reduced_modulus_pa', 1.17e11_dp)
         call give(input, 'load_n', 39.2_dp)
         call give(input, 'mean_speed_m_per_s', 0.024_dp)
         call give(input, 'viscosity_pa_s', 1.22_dp)
      else
         call give(input, 'load_parameter_m', 100.0_dp)
         call give(input, 'lubricant_parameter_l', 12.0_dp)
         call give(input, 'radius_ratio_d', merge(0.0_dp, 1.0_dp, base == 'line'))
      end if
      call give(input, 'cells_x', 64.0_dp)
      if (base /= 'line') call give(input, 'cells_y', 64.0_dp)
      call give(input, 'orientation', word=merge('custom    ', 'transverse', base == 'custom'))
      call give(input, merge('wavelength_x_over_a', 'wavelength_over_a  ', base == 'custom'), 1.0_dp)
      if (base == 'custom') call give(input, 'wavelength_y_over_a', 2.0_dp)
      if (base == 'fas') call give(input, 'method', word='fas')
      if (base == 'motion') call give(input, 'load_balance', word='equation_of_motion')
      if (base == 'motion') call give(input, 'natural_frequency', 4.0_dp)
   end function base_input

   subroutine give(input, name, number, word)
      type(case_input_t), intent(inout) :: input
      character(len=*), intent(in) :: name
      real(dp), intent(in), optional :: number
      character(len=*), intent(in), optional :: word
      type(key_value_t) :: value
      integer :: k
      k = find_key(table%keys, trim(name))
      value%kind = table%keys(k)%kind
      if (present(number)) value%number = number
      if (present(word)) value%word = trim(word)
      call input%set([k], [value])
   end subroutine give

end program test_case_bounds
