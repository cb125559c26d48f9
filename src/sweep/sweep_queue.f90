!> The cases that are left to run, the longest expected first.
module ehlwave_sweep_queue
   use ehlwave_case_plan, only: case_plan_t
   use ehlwave_cost_model, only: cost_features, cost_model_t, feature_count, fit_cost_model
   use ehlwave_kinds, only: dp
   implicit none (type, external)
   private
   public :: new_queue

   !> The model of the time of a case is fitted anew, and the queue sorted again, whenever the number of finished
   !> cases has grown by a half.
   type, public :: queue_t
      real(dp), private :: expected_left = 0         ! seconds of all cases that are not finished
      type(cost_model_t) :: model
      integer, allocatable, private :: order(:)      ! numbers of the cases
      integer, private :: next = 1                   ! place in `order`
      real(dp), allocatable, private :: features(:, :), seconds(:)   ! of all cases; seconds 0: not finished
      integer, private :: known = 0, refit_at = 1
   contains
      procedure :: is_empty
      procedure :: take
      procedure :: learn
      procedure :: sort
      procedure :: seconds_left
   end type queue_t

contains

   !> Queue of the cases marked in `to_run`; `seconds` of the others, as far as it is known, teaches the model.
   function new_queue(plans, to_run, seconds) result(self)
      type(case_plan_t), intent(in) :: plans(:)
      logical, intent(in) :: to_run(:)
      real(dp), intent(in) :: seconds(:)
      type(queue_t) :: self
      integer :: i
      allocate (self%features(feature_count, size(plans)))
      do i = 1, size(plans)
         self%features(:, i) = cost_features(plans(i))
      end do
      self%order = pack([(i, i=1, size(plans))], to_run)
      self%seconds = merge(0.0_dp, seconds, to_run)
      self%known = count(self%seconds > 0)
      call self%sort()
   end function new_queue

   pure logical function is_empty(self)
      class(queue_t), intent(in) :: self
      is_empty = self%next > size(self%order)
   end function is_empty

   !> Take the next case.
   subroutine take(self, case)
      class(queue_t), intent(inout) :: self
      integer, intent(out) :: case
      case = self%order(self%next)
      self%next = self%next + 1
   end subroutine take

   !> A case is finished and took so long.
   subroutine learn(self, case, seconds)
      class(queue_t), intent(inout) :: self
      integer, intent(in) :: case
      real(dp), intent(in) :: seconds
      self%expected_left = self%expected_left - self%model%seconds(self%features(:, case))
      self%seconds(case) = seconds
      self%known = self%known + 1
      if (self%known >= self%refit_at) call self%sort()
   end subroutine learn

   !> Fit the model, bring the waiting cases into order.
   subroutine sort(self)
      class(queue_t), intent(inout) :: self
      real(dp) :: expected(size(self%seconds))
      logical :: is_finished(size(self%seconds))
      integer :: i

      is_finished = self%seconds > 0
      self%refit_at = max(8, self%known + self%known/2)
      self%model = fit_cost_model(self%features, self%seconds)
      do i = 1, size(expected)
         expected(i) = self%model%seconds(self%features(:, i))
      end do
      self%expected_left = sum(expected(self%order), mask=.not. is_finished(self%order))
      associate (waiting => self%order(self%next:))
         waiting = waiting(longest_first(expected(waiting)))
      end associate
   end subroutine sort

   !> Expected wall time of all cases that are not finished; negative when nothing is known yet.
   pure real(dp) function seconds_left(self)
      class(queue_t), intent(in) :: self
      seconds_left = -1
      if (self%model%is_fitted) seconds_left = max(0.0_dp, self%expected_left)
   end function seconds_left

   !> Places of the numbers, largest first; equal ones in their order.
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
