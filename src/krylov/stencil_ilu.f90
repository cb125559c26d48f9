!> Incomplete LU factors of a matrix with the same stencil in every row, without fill-in: ILU(0).
module ehlwave_stencil_ilu
   use ehlwave_kinds, only: dp, sp
   implicit none (type, external)
   private
   public :: new_stencil_ilu

   real(sp), parameter :: smallest_pivot = 0.1_sp   !! of the diagonal entry

   !> Factors are kept in single precision: they only precondition, and a solve takes the time that its memory takes.
   !> Unknowns on a rectangle, numbered with the fast index first. Offsets are sorted so that
   !> entries 1..lower come before the diagonal and entries lower+2..entries after it.
   type, public :: stencil_ilu_t
      integer :: fast = 0, slow = 0        !! extent of the rectangle
      integer :: entries = 0, lower = 0
      integer, allocatable :: order(:)     !! (entries) caller's entry number of each sorted entry
      integer, allocatable :: shift(:)     !! (entries) offset in the padded vector
      integer :: reach_fast = 0, reach_slow = 0
      real(sp), allocatable :: a(:, :, :)  !! (entries, fast, slow) matrix, then its factors (diagonal inverted)
      integer, allocatable, private :: fills(:)    ! (lower) how many products of factors with entry m land in the pattern,
      integer, allocatable, private :: from(:, :)  ! (entries, lower) which upper entries they come from
      integer, allocatable, private :: into(:, :)  ! (entries, lower) and where they land
      real(sp), allocatable, private :: x(:)       ! padded vector
   contains
      procedure :: factorise
      procedure :: solve
   end type stencil_ilu_t

contains

   !> Pattern and storage. Offsets are in (fast, slow) index; (0, 0) must be among them.
   pure function new_stencil_ilu(fast, slow, offset_fast, offset_slow) result(self)
      integer, intent(in) :: fast, slow                          !! extent of the rectangle
      integer, intent(in) :: offset_fast(:), offset_slow(:)      !! (entries)
      type(stencil_ilu_t) :: self
      integer :: f, n, m, s, width

      n = size(offset_fast)
      self%fast = fast
      self%slow = slow
      self%entries = n
      self%reach_fast = maxval(abs(offset_fast))
      self%reach_slow = maxval(abs(offset_slow))
      width = fast + self%reach_fast
      allocate (self%order(n), self%shift(n))
      m = 0
      do s = -self%reach_slow, self%reach_slow
         do f = -self%reach_fast, self%reach_fast
            block
               integer :: e
               do e = 1, n
                  if (offset_fast(e) == f .and. offset_slow(e) == s) then
                     m = m + 1
                     self%order(m) = e
                     self%shift(m) = f + s*width
                     if (f == 0 .and. s == 0) self%lower = m - 1
                  end if
               end do
            end block
         end do
      end do
      allocate (self%fills(self%lower), self%from(n, self%lower), self%into(n, self%lower), source=0)
      do m = 1, self%lower
         do s = self%lower + 2, n
            do f = 1, n
               if (offset_fast(self%order(f)) == offset_fast(self%order(m)) + offset_fast(self%order(s)) .and. &
                   offset_slow(self%order(f)) == offset_slow(self%order(m)) + offset_slow(self%order(s))) then
                  self%fills(m) = self%fills(m) + 1
                  self%from(self%fills(m), m) = s
                  self%into(self%fills(m), m) = f
               end if
            end do
         end do
      end do
      allocate (self%a(n, fast, slow), source=0.0_sp)
      allocate (self%x(1 - self%reach_fast - self%reach_slow*width: &
                       width*(slow + self%reach_slow) + self%reach_fast), source=0.0_sp)
   end function new_stencil_ilu

   !> Factors in place of the matrix in `a`. A pivot that changed sign or lost most of its size against the
   !> diagonal it started from is set to `smallest_pivot` of it: without fill-in that is an artefact, and
   !> factors with such pivots amplify instead of solving.
   pure subroutine factorise(self)
      class(stencil_ilu_t), intent(inout) :: self
      integer :: d, f, m, n, pf, ps, s, t
      real(sp) :: diagonal, factor
      integer :: off_f(self%entries), off_s(self%entries), width

      d = self%lower + 1
      n = self%entries
      width = self%fast + self%reach_fast
      do m = 1, n
         off_s(m) = floor((self%shift(m) + self%reach_fast)/real(width, dp))
         off_f(m) = self%shift(m) - off_s(m)*width
      end do
      do s = 1, self%slow
         do f = 1, self%fast
            diagonal = self%a(d, f, s)
            do m = 1, self%lower
               pf = f + off_f(m)
               ps = s + off_s(m)
               if (pf < 1 .or. pf > self%fast .or. ps < 1) cycle
               if (abs(self%a(m, f, s)) <= 0) cycle
               factor = self%a(m, f, s)*self%a(d, pf, ps)
               self%a(m, f, s) = factor
               do t = 1, self%fills(m)
                  self%a(self%into(t, m), f, s) = self%a(self%into(t, m), f, s) - factor*self%a(self%from(t, m), pf, ps)
               end do
            end do
            if (.not. self%a(d, f, s)/diagonal > smallest_pivot) self%a(d, f, s) = smallest_pivot*diagonal
            self%a(d, f, s) = 1/self%a(d, f, s)
         end do
      end do
   end subroutine factorise

   !> Solution of (L U) v = v in place.
   pure subroutine solve(self, v)
      class(stencil_ilu_t), intent(inout) :: self
      real(dp), intent(inout) :: v(:, :)   !! (fast, slow) right side, then solution
      integer :: d, f, m, place, s, width
      real(sp) :: total

      d = self%lower + 1
      width = self%fast + self%reach_fast
      do s = 1, self%slow
         do f = 1, self%fast
            place = f + (s - 1)*width
            total = real(v(f, s), sp)
            do m = 1, self%lower
               total = total - self%a(m, f, s)*self%x(place + self%shift(m))
            end do
            self%x(place) = total
         end do
      end do
      do s = self%slow, 1, -1
         do f = self%fast, 1, -1
            place = f + (s - 1)*width
            total = self%x(place)
            do m = self%entries, d + 1, -1      ! the entry just computed comes last: the others need not wait for it
               total = total - self%a(m, f, s)*self%x(place + self%shift(m))
            end do
            self%x(place) = total*self%a(d, f, s)
         end do
      end do
      do s = 1, self%slow
         do f = 1, self%fast
            v(f, s) = self%x(f + (s - 1)*width)
         end do
      end do
   end subroutine solve

end module ehlwave_stencil_ilu
