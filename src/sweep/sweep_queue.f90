!> The cases that are left to run: the longest expected first, those that share a steady state by the same rank.
module ehlwave_sweep_queue
   use ehlwave_case_definition, only: case_t
   use ehlwave_cost_model, only: cost_features, cost_model_t, feature_count, fit_cost_model
   use ehlwave_identity_index, only: identity_index_t, text_identity
   use ehlwave_kinds, only: dp
   use ehlwave_planned_case, only: case_plan_t, run_harmonic
   use ehlwave_shared_steady, only: steady_key
   implicit none (type, external)
   private
   public :: new_queue

   !> Linear responses about the same steady state form a group, sorted by frequency, as equal frequencies share
   !> factors; every other case is a group of its own. A rank finishes its group, then takes the longest group not yet
   !> begun. In the end it helps with the group that has most left, at the price of another steady state. So no rank
   !> idles while there are cases, and results do not depend on the order.
   !>
   !> The model of the time of a case is fitted anew, and the queue sorted again, whenever the number of finished
   !> cases has grown by a half.
   type, public :: queue_t
      real(dp), private :: expected_left = 0         ! seconds of all cases that are not finished, by the model
      real(dp), private :: total_over_model = 1      ! ratio for finished cases: a fit of logarithms finds medians
      type(cost_model_t) :: model
      integer, allocatable :: group(:)               !! group of each case
      integer, allocatable, private :: sequence(:)   ! groups, the longest first
      integer, private :: next_group = 1             ! place in `sequence` of the first that nobody has begun
      integer, allocatable, private :: held(:)       ! (0:ranks - 1) group a rank works on, 0: none yet
      integer, allocatable, private :: first(:), next(:)   ! first waiting case of a group, next of its group; 0: none
      integer :: waiting = 0                         !! cases that are left to take
      real(dp), allocatable, private :: left(:)      ! expected seconds of the waiting cases of a group
      real(dp), allocatable, private :: expected(:)  ! expected time of each case
      logical, allocatable, private :: to_run(:)
      real(dp), allocatable, private :: features(:, :), seconds(:)   ! data of all cases; seconds 0: not finished
      ! seconds by the plan, NaN: no model; not allocated: nothing is known
      real(dp), allocatable, private :: planned(:)
      integer, private :: known = 0, refit_at = 1
   contains
      procedure :: is_empty
      procedure :: take
      procedure :: learn
      procedure :: sort
      procedure :: seconds_left
      procedure :: expected_seconds
   end type queue_t

contains

   !> Queue of the cases marked in `to_run`; `seconds` of the others, as far as it is known, teaches the model.
   function new_queue(cases, plans, to_run, seconds, ranks, planned) result(self)
      type(case_t), intent(in) :: cases(:)
      type(case_plan_t), intent(in) :: plans(:)
      logical, intent(in) :: to_run(:)
      real(dp), intent(in) :: seconds(:)
      integer, intent(in) :: ranks
      real(dp), intent(in), optional :: planned(:)   !! seconds that the plans expect, NaN: no model
      type(queue_t) :: self
      integer :: g, groups, i, n, order(size(plans))

      allocate (self%features(feature_count, size(plans)))
      do i = 1, size(plans)
         self%features(:, i) = cost_features(plans(i))
      end do
      self%to_run = to_run
      self%waiting = count(to_run)
      self%group = steady_groups(cases, plans)
      groups = maxval([0, self%group])
      allocate (self%first(groups), self%next(size(plans)), source=0)
      allocate (self%left(groups), self%expected(size(plans)), source=0.0_dp)
      allocate (self%held(0:ranks - 1), source=0)
      order = longest_first(plans%surfaces%frequency())
      do n = size(plans), 1, -1
         i = order(n)
         if (.not. to_run(i)) cycle
         g = self%group(i)
         self%next(i) = self%first(g)
         self%first(g) = i
      end do
      self%sequence = pack([(g, g=1, groups)], self%first > 0)
      self%seconds = merge(0.0_dp, seconds, to_run)
      self%known = count(self%seconds > 0)
      if (present(planned)) self%planned = planned
      call self%sort()
   end function new_queue

   !> Number of the group of each case, in the order in which they appear.
   function steady_groups(cases, plans) result(group)
      type(case_t), intent(in) :: cases(:)
      type(case_plan_t), intent(in) :: plans(:)
      integer :: group(size(cases))
      integer :: groups, i, place, known(size(cases))   ! known: group of a key
      type(identity_index_t) :: keys

      groups = 0
      known = 0
      do i = 1, size(cases)
         if (plans(i)%kind == run_harmonic) then
            call keys%add(text_identity(steady_key(cases(i), plans(i))), place)
            group(i) = known(place)
            if (group(i) > 0) cycle
            known(place) = groups + 1
         end if
         groups = groups + 1
         group(i) = groups
      end do
   end function steady_groups

   pure logical function is_empty(self)
      class(queue_t), intent(in) :: self
      is_empty = self%waiting == 0
   end function is_empty

   !> The next case for a rank, 0 when there is none left.
   subroutine take(self, rank, case)
      class(queue_t), intent(inout) :: self
      integer, intent(in) :: rank
      integer, intent(out) :: case
      real(dp) :: most
      integer :: g, other

      case = 0
      if (self%is_empty()) return
      g = self%held(rank)
      if (g > 0) then
         if (self%first(g) == 0) g = 0
      end if
      if (g == 0 .and. self%next_group <= size(self%sequence)) then
         g = self%sequence(self%next_group)
         self%next_group = self%next_group + 1
      else if (g == 0) then
         most = -huge(most)
         do other = 0, ubound(self%held, 1)          ! whoever has begun a group holds it to its end
            if (self%held(other) == 0) cycle
            if (self%first(self%held(other)) == 0 .or. self%left(self%held(other)) <= most) cycle
            g = self%held(other)
            most = self%left(g)
         end do
      end if
      self%held(rank) = g
      case = self%first(g)
      self%first(g) = self%next(case)
      self%left(g) = self%left(g) - self%expected(case)
      self%waiting = self%waiting - 1
   end subroutine take

   !> A case is finished and took so long.
   subroutine learn(self, case, seconds)
      class(queue_t), intent(inout) :: self
      integer, intent(in) :: case
      real(dp), intent(in) :: seconds
      self%expected_left = self%expected_left - self%model%seconds(self%features(:, case))
      self%seconds(case) = seconds
      self%to_run(case) = .false.
      self%known = self%known + 1
      if (self%known >= self%refit_at) call self%sort()
   end subroutine learn

   !> Fit the model, bring the waiting groups into order.
   subroutine sort(self)
      class(queue_t), intent(inout) :: self
      integer :: case, g, i

      self%refit_at = max(8, self%known + self%known/2)
      self%model = fit_cost_model(self%features, self%seconds, self%planned)
      do i = 1, size(self%expected)
         self%expected(i) = self%model%seconds(self%features(:, i))
      end do
      self%expected_left = sum(self%expected, mask=self%to_run)
      if (any(self%seconds > 0)) self%total_over_model = sum(self%seconds)/sum(self%expected, mask=self%seconds > 0)
      self%left = 0
      do g = 1, size(self%first)
         case = self%first(g)
         do while (case > 0)
            self%left(g) = self%left(g) + self%expected(case)
            case = self%next(case)
         end do
      end do
      associate (waiting => self%sequence(self%next_group:))
         waiting = waiting(longest_first(self%left(waiting)))
      end associate
   end subroutine sort

   !> Expected wall time of a case; huge when nothing is known yet.
   pure real(dp) function expected_seconds(self, case) result(seconds)
      class(queue_t), intent(in) :: self
      integer, intent(in) :: case
      seconds = huge(seconds)
      if (self%model%is_fitted) seconds = self%total_over_model*self%expected(case)
   end function expected_seconds

   !> Expected wall time of all cases that are not finished; negative when nothing is known yet.
   pure real(dp) function seconds_left(self)
      class(queue_t), intent(in) :: self
      seconds_left = -1
      if (self%model%is_fitted) seconds_left = max(0.0_dp, self%total_over_model*self%expected_left)
   end function seconds_left

   !> Places of the numbers, largest first; equal numbers in their order.
   pure function longest_first(cost) result(order)
      real(dp), intent(in) :: cost(:)
      integer :: order(size(cost))
      integer :: merged(size(cost)), i, j, k, middle, n, stop_, start, width

      n = size(cost)
      order = [(i, i=1, n)]
      width = 1
      do while (width < n)                       ! merge sort, stable
         do start = 1, n, 2*width
            middle = min(start + width, n + 1)
            stop_ = min(start + 2*width, n + 1)
            i = start
            j = middle
            do k = start, stop_ - 1
               if (j >= stop_ .or. (i < middle .and. cost(order(min(i, n))) >= cost(order(min(j, n))))) then
                  merged(k) = order(i)
                  i = i + 1
               else
                  merged(k) = order(j)
                  j = j + 1
               end if
            end do
         end do
         order = merged
         width = 2*width
      end do
   end function longest_first

end module ehlwave_sweep_queue
