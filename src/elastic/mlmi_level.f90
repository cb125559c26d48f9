!> One coarsening step of multilevel multi-integration: from a set of nodes to every second one along X or Y.
module ehlwave_mlmi_level
   use ehlwave_kinds, only: dp
   use ehlwave_mlmi_correction, only: along_x, along_y, correction_t, midpoint_weights, new_correction, sampled_kernel_t
   use ehlwave_mlmi_rows, only: add_centre, add_pairs, add_products
   implicit none (type, external)
   private

   integer, parameter :: nowhere = 0

   !> Nodes (first(1):last(1), first(2):last(2)) at multiples of the kernel's stride from node (0, 0).
   !>
   !> With a line of symmetry only rows j >= 0 are computed; their mirror images are stored beside them.
   type, public :: mlmi_level_t
      integer :: first(2) = 0, last(2) = 0
      logical :: is_half = .false.
      integer :: direction = nowhere           !! how the next level is coarser; nowhere: this is the coarsest
      type(sampled_kernel_t) :: kernel
      type(correction_t) :: correction
      integer :: order = 0
      real(dp), allocatable :: weight(:)       !! of the midpoint interpolation
      real(dp), allocatable :: u(:, :)         !! result, rows below zero are mirror images
      ! Pressure with zeros around: split in even and odd columns where the next level is coarser along X.
      integer :: ghost_x = 0, ghost_y = 0
      real(dp), allocatable :: p(:, :)
      real(dp), allocatable :: even(:, :), odd(:, :)
      real(dp), allocatable :: c_even(:, :), c_odd(:, :)   !! correction at even and odd distances along X
      real(dp), allocatable :: influence(:, :)             !! kernel of the coarsest level, even in X
      real(dp), allocatable :: row(:), fold(:), fold_odd(:), y_even(:), y_odd(:)
   contains
      procedure :: plan_coarser
      procedure :: make_coarsest
      procedure :: make_coarsening
      procedure :: put_row
      procedure :: mirror_pressure
      procedure :: mirror_result
      procedure :: anterpolate
      procedure :: finish
      procedure :: sum_row
      procedure :: sum_cost, step_cost
   end type mlmi_level_t

contains

   !> Range and kernel of the next level: all nodes that the interpolation to this level refers to.
   pure subroutine plan_coarser(self, direction, order, reach, coarse)
      class(mlmi_level_t), intent(inout) :: self
      integer, intent(in) :: direction, order
      real(dp), intent(in) :: reach
      type(mlmi_level_t), intent(out) :: coarse
      integer :: cells(2)
      cells = self%last - self%first
      if (self%is_half) cells(2) = 2*cells(2)
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
      sum_cost = n(1)**2*n(2)**2*merge(1.5_dp, 0.75_dp, self%is_half)
   end function sum_cost

   !> The same for the transfers to and from the next level and the corrections.
   pure real(dp) function step_cost(self, order)
      class(mlmi_level_t), intent(in) :: self
      integer, intent(in) :: order
      real(dp) :: n(2)
      n = self%last - self%first + 1
      step_cost = n(1)*n(2)*(order + 6 + 0.75_dp*sum(2*self%correction%width + 2))
   end function step_cost

   !> Work space of a level that is summed directly.
   subroutine make_coarsest(self, order)
      class(mlmi_level_t), intent(inout) :: self
      integer, intent(in) :: order
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

   !> Corrections and work space of a level that has a coarser one.
   subroutine make_coarsening(self, direction, order)
      class(mlmi_level_t), intent(inout) :: self
      integer, intent(in) :: direction, order
      integer :: k

      self%direction = direction
      self%order = order
      self%weight = midpoint_weights(order)
      associate (c => self%correction)
         if (direction == along_x) then
            allocate (self%c_odd(0:c%reach_x/2 + 1, 0:c%reach_y), self%c_even(0:c%reach_x/2 + 1, 0:c%reach_y), source=0.0_dp)
            do k = 0, c%reach_x
               if (modulo(k, 2) == 0) self%c_even(k/2, :) = c%c(k, :)
               if (modulo(k, 2) == 1) self%c_odd(k/2, :) = c%c(k, :)
            end do
            call make_arrays(self, max(order, c%reach_x/2 + 2), c%reach_y)
         else
            call make_arrays(self, c%reach_x + 1, order + max(order, c%reach_y))
         end if
      end associate
   end subroutine make_coarsening

   subroutine make_arrays(self, ghost_x, ghost_y)
      type(mlmi_level_t), intent(inout) :: self
      integer, intent(in) :: ghost_x, ghost_y
      integer :: first, last, low, high

      self%ghost_x = ghost_x
      self%ghost_y = ghost_y
      low = self%first(2) - ghost_y
      high = self%last(2) + ghost_y
      first = self%first(1)
      last = self%last(1)
      allocate (self%row(first:last), source=0.0_dp)
      allocate (self%u(first:last, self%first(2) - merge(self%order, 0, self%is_half):self%last(2)), source=0.0_dp)
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

   !> First node that interpolation to the odd nodes from `first` on refers to.
   elemental integer function first_needed(first, order)
      integer, intent(in) :: first, order
      first_needed = half_below(first) + 1 - order/2
   end function first_needed

   !> Last node that interpolation to the odd nodes up to `last` refers to.
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

   !> Rows below the line of symmetry, when there is one.
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

   pure subroutine mirror_result(self)
      class(mlmi_level_t), intent(inout) :: self
      integer :: j
      if (.not. self%is_half) return
      do j = 1, min(self%order, self%last(2))
         self%u(:, -j) = self%u(:, j)
      end do
   end subroutine mirror_result

   !> Pressure of the next level, the adjoint of interpolation:
   !>
   !>     P'(I) = P(2I) + sum over s = 1, 3, ... of w(s) (P(2I + s) + P(2I - s))
   subroutine anterpolate(self, coarse)
      class(mlmi_level_t), intent(in) :: self
      type(mlmi_level_t), intent(inout) :: coarse
      integer :: a, first, j, last

      first = coarse%first(1)
      last = coarse%last(1)
      do j = coarse%first(2), coarse%last(2)
         associate (row => coarse%row)
            if (self%direction == along_x) then
               row = self%even(first:last, j)
               do a = 1, self%order/2
                  row = row + self%weight(a)*(self%odd(first + a - 1:last + a - 1, j) + self%odd(first - a:last - a, j))
               end do
            else
               row = self%p(first:last, 2*j)
               do a = 1, self%order/2
                  row = row + self%weight(a)*(self%p(first:last, 2*j + 2*a - 1) + self%p(first:last, 2*j - 2*a + 1))
               end do
            end if
         end associate
         call coarse%put_row(j, first, coarse%row)
      end do
      call coarse%mirror_pressure()
   end subroutine anterpolate

   !> Result u from that of the next level, u', and the corrections: along the coarsened direction
   !>
   !>     u'(I)    := u'(I) + sum over odd d of C(d, e) P(2I + d, e)
   !>     u(2I)     = u'(I)
   !>     u(2I + 1) = sum over s of w(s) u'(I + (1 +- s)/2) + sum over all d of C(d, e) P(2I + 1 + d, e)
   subroutine finish(self, coarse, first, u)
      class(mlmi_level_t), intent(inout) :: self
      type(mlmi_level_t), intent(inout) :: coarse
      integer, intent(in) :: first(2)                          !! self%first
      real(dp), intent(inout) :: u(first(1):, first(2):)       !! (first(1):last(1), first(2):last(2))
      integer :: j

      if (self%direction == along_x) then
         do j = self%first(2), self%last(2)
            call correct_along_x(self, coarse, j)
            call interpolate_along_x(self, u(:, j))
         end do
      else
         do j = coarse%first(2), coarse%last(2)
            call correct_along_y(self, 2*j, coarse%u(:, j))
         end do
         call coarse%mirror_result()
         do j = self%first(2), self%last(2)
            call interpolate_along_y(self, coarse, j, u(:, j))
            if (modulo(j, 2) == 1) call correct_along_y(self, j, u(:, j))
         end do
      end if
   end subroutine finish

   !> Coarse values of row j with their corrections into y_even, corrections between them into y_odd.
   subroutine correct_along_x(self, coarse, j)
      type(mlmi_level_t), intent(inout) :: self
      type(mlmi_level_t), intent(in) :: coarse
      integer, intent(in) :: j
      integer :: e, first, g, n, pairs, w

      g = self%ghost_x
      first = lbound(self%y_even, 1)
      n = size(self%y_even)
      self%y_even = coarse%u(:, j)
      self%y_odd = 0
      do e = 0, self%correction%reach_y
         w = self%correction%width(e)
         if (w < 0) cycle
         if (e == 0) then
            self%fold = self%even(:, j)
            self%fold_odd = self%odd(:, j)
         else
            self%fold = self%even(:, j - e) + self%even(:, j + e)
            self%fold_odd = self%odd(:, j - e) + self%odd(:, j + e)
         end if
         pairs = (w + 1)/2
         call add_pairs(n, pairs, g, 0, -1, self%c_odd(:, e), self%fold_odd, self%y_even)
         call add_pairs(n, pairs, g, 1, 0, self%c_odd(:, e), self%fold, self%y_odd)
         call add_centre(n, self%c_even(0, e), self%fold_odd(first), self%y_odd)
         call add_pairs(n, w/2, g, 1, -1, self%c_even(1, e), self%fold_odd, self%y_odd)
      end do
   end subroutine correct_along_x

   subroutine interpolate_along_x(self, u)
      type(mlmi_level_t), intent(inout) :: self
      real(dp), intent(inout) :: u(self%first(1):)
      integer :: a, first, i, last

      first = half_below(self%first(1))
      last = half_below(self%last(1) - 1)
      do a = 1, self%order/2
         do i = first, last
            self%y_odd(i) = self%y_odd(i) + self%weight(a)*(self%y_even(i + a) + self%y_even(i + 1 - a))
         end do
      end do
      do i = first, last
         u(2*i + 1) = self%y_odd(i)
      end do
      do i = half_below(self%first(1) + 1), half_below(self%last(1))
         u(2*i) = self%y_even(i)
      end do
   end subroutine interpolate_along_x

   !> Corrections of row j of this level: from odd rows for an even one, from all rows for an odd one.
   subroutine correct_along_y(self, j, u)
      type(mlmi_level_t), intent(inout) :: self
      integer, intent(in) :: j
      real(dp), intent(inout) :: u(self%first(1):)
      integer :: e, n, odd, w

      n = size(u)
      odd = modulo(j, 2)
      do e = 1 - odd, self%correction%reach_y, 2 - odd
         w = self%correction%width(e)
         if (w < 0) cycle
         if (e == 0) then
            self%fold = self%p(:, j)
         else
            self%fold = self%p(:, j - e) + self%p(:, j + e)
         end if
         call add_centre(n, self%correction%c(0, e), self%fold(self%first(1)), u)
         if (w > 0) call add_pairs(n, w, self%ghost_x, 1, -1, self%correction%c(1, e), self%fold, u)
      end do
   end subroutine correct_along_y

   pure subroutine interpolate_along_y(self, coarse, j, u)
      type(mlmi_level_t), intent(in) :: self
      type(mlmi_level_t), intent(in) :: coarse
      integer, intent(in) :: j
      real(dp), intent(inout) :: u(self%first(1):)
      integer :: a, i, k

      k = half_below(j)
      if (modulo(j, 2) == 0) then
         u = coarse%u(:, k)
         return
      end if
      u = 0
      do a = 1, self%order/2
         do i = self%first(1), self%last(1)
            u(i) = u(i) + self%weight(a)*(coarse%u(i, k + a) + coarse%u(i, k + 1 - a))
         end do
      end do
   end subroutine interpolate_along_y

   !> Result in row j of the coarsest level by summation over all nodes.
   subroutine sum_row(self, j, u)
      class(mlmi_level_t), intent(inout) :: self
      integer, intent(in) :: j
      real(dp), intent(inout) :: u(:)
      integer :: e, lowest, n

      n = size(u)
      lowest = merge(-self%last(2), self%first(2), self%is_half)
      u = 0
      do e = 0, max(self%last(2) - j, j - lowest)
         if (e == 0) then
            self%fold = self%p(:, j)
         else
            self%fold = self%p(:, j - e) + self%p(:, j + e)
         end if
         call add_products(n, self%influence(:, e), self%fold, u)
      end do
   end subroutine sum_row

end module ehlwave_mlmi_level
