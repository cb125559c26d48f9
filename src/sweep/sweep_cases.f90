!> The cases of a sweep: completed, planned, no two alike.
module ehlwave_sweep_cases
   use ehlwave_case_completion, only: complete_case
   use ehlwave_case_definition, only: case_t
   use ehlwave_case_plan, only: case_plan_t, make_plan
   use ehlwave_case_terms, only: case_limits_t
   use ehlwave_case_text, only: case_identity
   use ehlwave_errors, only: error_t
   use ehlwave_identity_index, only: identity_index_t, identity_length
   implicit none (type, external)
   private

   type, public :: sweep_t
      character(len=:), allocatable :: output      !! results file
      type(case_t), allocatable :: cases(:)        !! completed, no two alike
      type(case_plan_t), allocatable :: plans(:)
      character(len=identity_length), allocatable :: identity(:)
      type(case_limits_t) :: limits                !! what is asked of every case
      integer :: skipped = 0                       !! unresolved cases left out on request
      type(identity_index_t) :: index              !! from identity to number of the case
      logical, private :: skips_unresolved = .false.
   contains
      procedure :: begin
      procedure :: add
      procedure :: finish
   end type sweep_t

contains

   !> An empty list, to which cases are to be added.
   subroutine begin(self, skips_unresolved)
      class(sweep_t), intent(inout) :: self
      logical, intent(in) :: skips_unresolved
      allocate (self%cases(64), self%plans(64), self%identity(64))
      self%skips_unresolved = skips_unresolved
   end subroutine begin

   !> No case will be added any more: the lists get the length that they need.
   subroutine finish(self)
      class(sweep_t), intent(inout) :: self
      call resize(self, self%index%count)
   end subroutine finish

   !> Complete, plan and add a case unless it is there already or left out as unresolved.
   subroutine add(self, case, place, error)
      class(sweep_t), intent(inout) :: self
      type(case_t), intent(inout) :: case
      character(len=*), intent(in) :: place        !! begins every message
      type(error_t), allocatable, intent(inout) :: error
      type(case_plan_t) :: plan
      character(len=identity_length) :: identity
      integer :: before, i

      if (.not. allocated(error)) call complete_case(case, place, error)
      if (allocated(error)) return
      call make_plan(case, plan, error)
      if (allocated(error)) then
         error%message = place//error%message
         return
      end if
      if (self%skips_unresolved .and. .not. plan%resolution%is_resolved) then
         self%skipped = self%skipped + 1
         return
      end if
      identity = case_identity(case)
      before = self%index%count
      call self%index%add(identity, i)
      if (i <= before) return
      if (i > size(self%cases)) call resize(self, 2*size(self%cases))
      self%cases(i) = case
      self%plans(i) = plan
      self%identity(i) = identity
   end subroutine add

   !> Make the lists n long, keeping what fits.
   subroutine resize(self, n)
      class(sweep_t), intent(inout) :: self
      integer, intent(in) :: n
      type(case_t), allocatable :: cases(:)
      type(case_plan_t), allocatable :: plans(:)
      character(len=identity_length), allocatable :: identity(:)
      integer :: kept

      kept = min(n, size(self%cases))
      allocate (cases(n), plans(n), identity(n))
      cases(:kept) = self%cases(:kept)
      plans(:kept) = self%plans(:kept)
      identity(:kept) = self%identity(:kept)
      call move_alloc(cases, self%cases)
      call move_alloc(plans, self%plans)
      call move_alloc(identity, self%identity)
   end subroutine resize

end module ehlwave_sweep_cases
