!> The cases of a sweep: completed, planned, each once.
module ehlwave_sweep_cases
   use ehlwave_case_definition, only: case_t
   use ehlwave_case_input, only: case_input_t
   use ehlwave_case_key, only: key_length, value_text
   use ehlwave_case_keys, only: case_key_list, default_keys, list_case_keys
   use ehlwave_case_plan, only: make_plan
   use ehlwave_case_text, only: input_identity, input_text
   use ehlwave_errors, only: error_t, raise
   use ehlwave_identity_index, only: identity_index_t, identity_length
   use ehlwave_input_completion, only: complete_input
   use ehlwave_key_list, only: find_key, key_list_t
   use ehlwave_kinds, only: dp
   use ehlwave_planned_case, only: case_plan_t
   use ehlwave_store_names, only: newest_defaults
   use ehlwave_text, only: to_text
   use ehlwave_text_difference, only: text_difference, text_from_difference
   implicit none (type, external)
   private
   public :: refuse_too_many

   real(dp), parameter :: most_cases = 250000, kilobytes_per_case = 3   !! memory of rank 0, measured

   character(len=key_length), parameter :: shown_anyway(5) = [character(len=key_length) :: 'load_parameter_m', &
      'lubricant_parameter_l', 'radius_ratio_d', 'orientation', 'wavelength_over_a']

   !> Options that hold for every case.
   type, public :: case_limits_t
      real(dp) :: largest_case_seconds = 0    !! a case that takes longer is given up; 0: no limit
      real(dp) :: checkpoint_seconds = 600    !! between two checkpoints of a march
      integer :: threads = 0                  !! threads of a rank; 0: the cores it owns
   end type case_limits_t

   type :: text_t
      character(len=:), allocatable :: text
   end type text_t

   type, public :: sweep_t
      character(len=:), allocatable :: output      !! results file
      type(case_t), allocatable :: cases(:)        !! completed, no two alike
      type(case_plan_t), allocatable :: plans(:)
      character(len=identity_length), allocatable :: identity(:)
      type(case_limits_t) :: limits                !! limits of every case
      integer :: defaults = newest_defaults        !! generation of the defaults of keys that its cases have
      character(len=:), allocatable :: files(:)    !! files read for it
      integer :: skipped = 0                       !! unresolved cases left out on request
      integer, allocatable :: varied(:)            !! numbers of the keys that its lists or columns give; unallocated:
                                                   !! none
      character(len=:), allocatable :: notice      !! notices for the user about the sweep file, lines
      type(identity_index_t) :: index              !! from identity to number of the case
      character(len=:), allocatable, private :: base_input   ! effective input of the first case,
      type(text_t), allocatable, private :: unlike(:)        ! how each differs from it
      ! Keys without a column of their own in plans and reports
      integer, allocatable, private :: told(:)
      logical, private :: skips_unresolved = .false.
   contains
      procedure :: begin
      procedure :: vary
      procedure :: add
      procedure :: keep
      procedure :: input => effective_input
      procedure :: varies
      procedure :: variation
      procedure :: finish
   end type sweep_t

contains

   !> Refuse more cases than a sweep may have; counted before any of them is made.
   subroutine refuse_too_many(start, cases, what, error)
      character(len=*), intent(in) :: start        !! start of the message, up to the number
      real(dp), intent(in) :: cases
      character(len=*), intent(in) :: what         !! is counted, behind the number
      type(error_t), allocatable, intent(inout) :: error
      if (allocated(error) .or. cases <= most_cases) return
      call raise(error, start//to_text(cases, 15)//what//', which take about '// &
         to_text(1e-6_dp*kilobytes_per_case*cases, 2)// &
                 ' GB; one sweep can have '//to_text(nint(most_cases))// &
                 ': shorten it, or run parts with results of their own')
   end subroutine refuse_too_many

   !> An empty list, to which cases are to be added.
   subroutine begin(self, most, skips_unresolved)
      class(sweep_t), intent(inout) :: self
      integer, intent(in) :: most                  !! cases that can be added
      logical, intent(in) :: skips_unresolved
      allocate (self%cases(most), self%plans(most), self%identity(most), self%unlike(most))
      self%skips_unresolved = skips_unresolved
   end subroutine begin

   !> No case will be added any more: the lists get the length that they need.
   subroutine finish(self)
      class(sweep_t), intent(inout) :: self
      associate (n => self%index%count)
         if (n == size(self%cases)) return
         self%cases = self%cases(:n)
         self%plans = self%plans(:n)
         self%identity = self%identity(:n)
         self%unlike = self%unlike(:n)
      end associate
   end subroutine finish

   !> Note the keys that vary.
   subroutine vary(self, keys, has_f_v)
      class(sweep_t), intent(inout) :: self
      integer, intent(in) :: keys(:)               !! their numbers
      logical, intent(in) :: has_f_v               !! the wavelength varies, too
      type(key_list_t) :: list
      integer :: i, wavelength

      list = default_keys()
      wavelength = find_key(list%keys, 'wavelength_over_a')
      self%varied = pack([(i, i=1, list%count)], &
         [(any(keys == i) .or. (has_f_v .and. i == wavelength), i=1, list%count)])
      self%told = pack(self%varied, [(all(shown_anyway /= list%keys(self%varied(i))%name), i=1, size(self%varied))])
   end subroutine vary

   !> Whether the key of a number varies.
   pure logical function varies(self, key)
      class(sweep_t), intent(in) :: self
      integer, intent(in) :: key
      varies = .false.
      if (allocated(self%varied)) varies = any(self%varied == key)
   end function varies

   !> Values that identify a case, of the keys that vary and have no column of their own in plans and reports: 'key =
   !> value, ...'.
   function variation(self, case) result(text)
      class(sweep_t), intent(in) :: self
      integer, intent(in) :: case
      character(len=:), allocatable :: text
      character(len=:), allocatable :: parts
      type(key_list_t) :: list
      integer :: i

      parts = ''
      if (allocated(self%told)) then
         if (size(self%told) > 0) list = case_key_list(self%cases(case))
         do i = 1, size(self%told)
            associate (key => list%keys(self%told(i)), value => list%values(self%told(i)))
               if (key%applies) parts = parts//', '//trim(key%name)//' = '//value_text(value, 6)
            end associate
         end do
      end if
      text = parts(min(3, len(parts) + 1):)
   end function variation

   !> Complete, plan and add a case unless it is there already or left out as unresolved.
   subroutine add(self, input, table, place, error)
      class(sweep_t), intent(inout) :: self
      type(case_input_t), intent(inout) :: input
      type(key_list_t), intent(in) :: table        !! all keys, with their defaults
      character(len=*), intent(in) :: place        !! begins every message
      type(error_t), allocatable, intent(inout) :: error
      type(case_plan_t) :: plan
      type(key_list_t), save :: keys

      if (.not. allocated(error)) call complete_input(input, table, place, error)
      if (allocated(error)) return
      call list_case_keys(input%case, keys)
      call make_plan(input%case, plan, error, keys=keys)
      if (allocated(error)) then
         error%message = place//error%message
         return
      end if
      if (self%skips_unresolved .and. .not. plan%resolution%is_resolved) then
         self%skipped = self%skipped + 1
         return
      end if
      call self%keep(input%case, plan, input_text(keys))
   end subroutine add

   !> Take a case and its plan unless it is there already.
   subroutine keep(self, case, plan, input)
      class(sweep_t), intent(inout) :: self
      type(case_t), intent(in) :: case
      type(case_plan_t), intent(in) :: plan
      character(len=*), intent(in) :: input        !! effective input of the case
      character(len=identity_length) :: identity
      integer :: before, i

      identity = input_identity(input)
      before = self%index%count
      call self%index%add(identity, i)
      if (i <= before) return
      self%cases(i) = case
      self%plans(i) = plan
      self%identity(i) = identity
      if (i == 1) self%base_input = input
      self%unlike(i)%text = text_difference(self%base_input, input)
   end subroutine keep

   !> Effective input of a case.
   function effective_input(self, case) result(text)
      class(sweep_t), intent(in) :: self
      integer, intent(in) :: case
      character(len=:), allocatable :: text
      text = text_from_difference(self%base_input, self%unlike(case)%text)
   end function effective_input

end module ehlwave_sweep_cases
