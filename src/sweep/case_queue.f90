!> Which case of a sweep is run next: the longest first, and cases that share a steady state by the same rank.
module ehlwave_case_queue
   use ehlwave_case_input, only: case_t
   use ehlwave_case_plan, only: case_plan_t, run_harmonic
   use ehlwave_kinds, only: dp
   use ehlwave_shared_steady, only: steady_key
   implicit none (type, external)
   private
   public :: new_queue

   !> Linear responses about one steady state form a group; every other case is a group of its own. A rank stays with
   !> its group as long as there is something left in it, then takes the longest group that nobody has begun, and in the
   !> end helps with the group that has most left, at the price of one more steady state. So no rank idles while there
   !> are cases, and the numbers depend on none of this.
   type, public :: case_queue_t
      integer, allocatable :: group(:)                  !! group of each case
      integer, allocatable, private :: first(:), next(:) ! first waiting case of a group, next one of its group; 0: none
      real(dp), allocatable, private :: left(:)         ! expected cost of the waiting cases of a group
      logical, allocatable, private :: is_begun(:)
      integer, allocatable, private :: held(:)          ! (0:ranks - 1) group a rank works on
      real(dp), allocatable, private :: cost(:)
   contains
      procedure :: take
      procedure :: is_empty
   end type case_queue_t

contains

   !> All cases, waiting.
   function new_queue(cases, plans, ranks) result(self)
      type(case_t), intent(in) :: cases(:)
      type(case_plan_t), intent(in) :: plans(:)
      integer, intent(in) :: ranks
      type(case_queue_t) :: self
      integer :: g, groups, i, last(size(cases))

      allocate (self%group(size(cases)), source=steady_groups(cases, plans))
      allocate (self%cost(size(cases)), source=plans%cost)
      groups = maxval([0, self%group])
      allocate (self%first(groups), self%next(size(cases)), source=0)
      allocate (self%left(groups), source=0.0_dp)
      allocate (self%is_begun(groups), source=.false.)
      allocate (self%held(0:ranks - 1), source=0)
      last = 0
      do i = 1, size(cases)
         g = self%group(i)
         if (self%first(g) == 0) self%first(g) = i
         if (last(g) > 0) self%next(last(g)) = i
         last(g) = i
         self%left(g) = self%left(g) + self%cost(i)
      end do
   end function new_queue

   !> Number of the group of each case, in the order in which they appear.
   function steady_groups(cases, plans) result(group)
      type(case_t), intent(in) :: cases(:)
      type(case_plan_t), intent(in) :: plans(:)
      integer :: group(size(cases))
      type :: text_t
         character(len=:), allocatable :: text
      end type text_t
      type(text_t) :: keys(size(cases))      ! of groups
      character(len=:), allocatable :: key
      integer :: g, groups, i

      groups = 0
      do i = 1, size(cases)
         group(i) = 0
         key = ''
         if (plans(i)%kind == run_harmonic) then
            key = steady_key(cases(i), plans(i))
            do g = groups, 1, -1             ! lists put the cases of a group next to each other
               if (keys(g)%text == key) then
                  group(i) = g
                  exit
               end if
            end do
         end if
         if (group(i) > 0) cycle
         groups = groups + 1
         keys(groups)%text = key
         group(i) = groups
      end do
   end function steady_groups

   !> The next case for a rank, 0 when there is none left.
   subroutine take(self, rank, case)
      class(case_queue_t), intent(inout) :: self
      integer, intent(in) :: rank
      integer, intent(out) :: case
      integer :: g

      case = 0
      if (self%is_empty()) return
      g = self%held(rank)
      if (g > 0) then
         if (self%first(g) == 0) g = 0
      end if
      if (g == 0) then
         g = maxloc(self%left, dim=1, mask=self%first > 0 .and. .not. self%is_begun)
         if (g == 0) g = maxloc(self%left, dim=1, mask=self%first > 0)
      end if
      self%held(rank) = g
      self%is_begun(g) = .true.
      case = self%first(g)
      self%first(g) = self%next(case)
      self%left(g) = self%left(g) - self%cost(case)
   end subroutine take

   !> Whether all cases have been taken.
   pure logical function is_empty(self)
      class(case_queue_t), intent(in) :: self
      is_empty = .not. any(self%first > 0)
   end function is_empty

end module ehlwave_case_queue
