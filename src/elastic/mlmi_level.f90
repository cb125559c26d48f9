!> Levels of multilevel multi-integration: nodes, corrections and work space.
module ehlwave_mlmi_level
   use ehlwave_kinds, only: dp
   use ehlwave_mlmi_correction, only: along_x, along_y, correction_t, midpoint_weights, new_correction, sampled_kernel_t
   implicit none (type, external)
   private

   integer, parameter, public :: nowhere = 0   !! direction of the coarsest level

   !> Nodes first(1)..last(1) by first(2)..last(2), at multiples of the kernel's stride from node (0, 0) of the
   !> finest level. Coarse levels go beyond the domain as far as interpolation refers to.
   !>
   !> On a half domain rows j >= 0 are computed; mirror images of some are stored below them.
   type, public :: mlmi_level_t
      integer :: first(2) = 0, last(2) = 0
      logical :: is_half = .false.
      integer :: direction = nowhere               !! along which every second node goes to the next level
      integer :: order = 0                         !! order of the transfers
      type(sampled_kernel_t) :: kernel
      type(correction_t) :: correction
      real(dp), allocatable :: weight(:)           !! (order/2) of the midpoint interpolation
      real(dp), allocatable :: c_even(:, :)        !! (0:, 0:reach_y) corrections at distances 0, 2, 4, ... along X
      real(dp), allocatable :: c_odd(:, :)         !! (0:, 0:reach_y) at distances 1, 3, 5, ...
      real(dp), allocatable :: influence(:, :)     !! kernel of the coarsest level, negative distances along X too
      real(dp), allocatable :: u(:, :)             !! result, not on the finest level
      ! Pressure among zeros: p, or even and odd columns (2i and 2i + 1 at i) where every second is dropped.
      integer :: ghost_x = 0, ghost_y = 0
      real(dp), allocatable :: p(:, :), even(:, :), odd(:, :)
      real(dp), allocatable :: fold(:), fold_odd(:)    ! sums of two rows at the same distance above and below
      real(dp), allocatable :: y_even(:), y_odd(:)     ! one row of the result
      real(dp), allocatable :: row(:)                  ! one row of the pressure
   contains
      procedure :: make_coarsest
      procedure :: make_coarsening
      procedure :: plan_coarser
      procedure :: step_cost
      procedure :: sum_cost
      procedure :: put_row
      procedure :: mirror_pressure
      procedure :: mirror_result
   end type mlmi_level_t

   public :: half_below

contains

   !> Corrections of this level and place and kernel of the next: the nodes that interpolation refers to.
   pure subroutine plan_coarser(self, direction, order, reach, coarse)
      class(mlmi_level_t), intent(inout) :: self
      integer, intent(in) :: direction             !! along_x or along_y
      integer, intent(in) :: order                 !! order of the transfers
      real(dp), intent(in) :: reach                !! reach of the corrections, see `smallest_kept`
      type(mlmi_level_t), intent(out) :: coarse
      integer :: cells(2)

      cells = self%last - self%first
      if (self%is_half) cells(2) = 2*cells(2)
      cells(direction) = cells(direction) + order   ! coarse nodes beyond the last are corrected too
      self%correction = new_correction(self%kernel, direction, order, self%kernel%smallest_kept(order, reach), cells)

      coarse%is_half = self%is_half
      coarse%kernel = self%kernel
      coarse%kernel%stride(direction) = 2*self%kernel%stride(direction)
      coarse%first = self%first
      coarse%last = self%last
      coarse%last(direction) = last_needed(self%last(direction), order)
      if (self%is_half .and. direction == along_y) return
      coarse%first(direction) = first_needed(self%first(direction), order)
   end subroutine plan_coarser

   !> Products per application when this level is summed directly.
   pure real(dp) function sum_cost(self)
      class(mlmi_level_t), intent(in) :: self
      real(dp) :: n(2)
      n = self%last - self%first + 1
      sum_cost = product(n)**2*merge(1.5_dp, 0.75_dp, self%is_half)
   end function sum_cost

   !> Cost of the corrections of this level and the transfers to and from the next.
   pure real(dp) function step_cost(self, order)
      class(mlmi_level_t), intent(in) :: self
      integer, intent(in) :: order
      real(dp) :: n(2)
      n = self%last - self%first + 1
      step_cost = product(n)*(order + 6 + 0.75_dp*sum(2*self%correction%width + 2))
   end function step_cost

   !> Kernel and work space of a level that is summed directly.
   pure subroutine make_coarsest(self, order)
      class(mlmi_level_t), intent(inout) :: self
      integer, intent(in) :: order     !! orders of the transfers of the finer levels
      integer :: d, e, n, rows

      self%direction = nowhere
      self%order = order
      n = self%last(1) - self%first(1) + 1
      rows = self%last(2) - self%first(2)
      if (self%is_half) rows = 2*rows
      allocate (self%influence(1 - n:n - 1, 0:rows))
      do e = 0, rows
         do d = 0, n - 1
            self%influence(d, e) = self%kernel%at(d, e)
            self%influence(-d, e) = self%influence(d, e)
         end do
      end do
      call make_arrays(self, 0, rows)
   end subroutine make_coarsest

   !> Work space of a level that `plan_coarser` has given a coarser level.
   pure subroutine make_coarsening(self, direction, order)
      class(mlmi_level_t), intent(inout) :: self
      integer, intent(in) :: direction, order
      integer :: d

      self%direction = direction
      self%order = order
      self%weight = midpoint_weights(order)
      associate (c => self%correction)
         if (direction == along_x) then
            allocate (self%c_even(0:c%reach_x/2 + 1, 0:c%reach_y), source=0.0_dp)
            allocate (self%c_odd(0:c%reach_x/2 + 1, 0:c%reach_y), source=0.0_dp)
            do d = 0, c%reach_x
               if (modulo(d, 2) == 0) self%c_even(d/2, :) = c%c(d, :)
               if (modulo(d, 2) == 1) self%c_odd(d/2, :) = c%c(d, :)
            end do
            call make_arrays(self, max(order, c%reach_x/2 + 2), c%reach_y)
         else
            call make_arrays(self, c%reach_x + 1, order + max(order, c%reach_y))
         end if
      end associate
   end subroutine make_coarsening

   pure subroutine make_arrays(self, ghost_x, ghost_y)
      type(mlmi_level_t), intent(inout) :: self
      integer, intent(in) :: ghost_x, ghost_y   ! zeros on either side
      integer :: first, high, last, low

      self%ghost_x = ghost_x
      self%ghost_y = ghost_y
      low = self%first(2) - ghost_y
      high = self%last(2) + ghost_y
      first = self%first(1)
      last = self%last(1)
      if (any(self%kernel%stride > 1)) then
         allocate (self%row(first:last), source=0.0_dp)
         allocate (self%u(first:last, self%first(2) - merge(self%order, 0, self%is_half):self%last(2)), source=0.0_dp)
      end if
      if (self%direction == along_x) then
         first = first_needed(first, self%order)
         last = last_needed(last, self%order)
         allocate (self%even(first - ghost_x:last + ghost_x, low:high), source=0.0_dp)
         allocate (self%odd(first - ghost_x:last + ghost_x, low:high), source=0.0_dp)
         allocate (self%fold_odd(first - ghost_x:last + ghost_x), source=0.0_dp)
         allocate (self%y_even(first:last), self%y_odd(first:last), source=0.0_dp)
      else
         allocate (self%p(first - ghost_x:last + ghost_x, low:high), source=0.0_dp)
      end if
      allocate (self%fold(first - ghost_x:last + ghost_x), source=0.0_dp)
   end subroutine make_arrays

   !> Largest integer <= i/2.
   elemental integer function half_below(i)
      integer, intent(in) :: i
      half_below = (i - modulo(i, 2))/2
   end function half_below

   !> First coarse node that interpolation to the odd nodes from `first` on refers to.
   elemental integer function first_needed(first, order)
      integer, intent(in) :: first, order
      first_needed = half_below(first) + 1 - order/2
   end function first_needed

   !> Last coarse node that interpolation to the odd nodes up to `last` refers to.
   elemental integer function last_needed(last, order)
      integer, intent(in) :: last, order
      last_needed = half_below(last - 1) + order/2
   end function last_needed

   !> Set the pressure of one row.
   pure subroutine put_row(self, j, first, row)
      class(mlmi_level_t), intent(inout) :: self
      integer, intent(in) :: j
      integer, intent(in) :: first            !! self%first(1)
      real(dp), intent(in) :: row(first:)     !! (first(1):last(1))
      integer :: i, last

      last = self%last(1)
      if (self%direction /= along_x) then
         self%p(first:last, j) = row
         return
      end if
      do i = half_below(first + 1), half_below(last)
         self%even(i, j) = row(2*i)
      end do
      do i = half_below(first), half_below(last - 1)
         self%odd(i, j) = row(2*i + 1)
      end do
   end subroutine put_row

   !> Pressure below the line of symmetry, when there is one.
   pure subroutine mirror_pressure(self)
      class(mlmi_level_t), intent(inout) :: self
      integer :: j
      if (.not. self%is_half) return
      do j = 1, min(self%ghost_y, self%last(2))
         if (self%direction == along_x) then
            self%even(:, -j) = self%even(:, j)
            self%odd(:, -j) = self%odd(:, j)
         else
            self%p(:, -j) = self%p(:, j)
         end if
      end do
   end subroutine mirror_pressure

   !> Mirror the result, as far as interpolation needs it.
   pure subroutine mirror_result(self)
      class(mlmi_level_t), intent(inout) :: self
      integer :: j
      if (.not. self%is_half) return
      do j = 1, min(self%order, self%last(2))
         self%u(:, -j) = self%u(:, j)
      end do
   end subroutine mirror_result

end module ehlwave_mlmi_level
