!> Incomplete LU factors, without fill-in, of a complex matrix with the same stencil in every row: ILU(0).
!>
!> A preconditioner does not need more than single precision, which halves memory and time. Real and imaginary
!> parts are stored apart and lines of the fast index are worked on together, so that all but the coupling
!> within a line is vectorised.
module ehlwave_complex_ilu
   use ehlwave_kinds, only: dp, sp
   implicit none (type, external)
   private
   public :: new_complex_ilu

   real(sp), parameter :: smallest_pivot = 0.1_sp   !! of the diagonal entry
   real(dp), parameter :: largest_growth = 1e6_dp   !! of a vector of ones; factors that are of use stay below 1e3
   real(sp), parameter :: largest_pivot = 1e12_sp   !! those of use are near 1e6 on 256 x 256 cells, and grow with the grid

   !> Unknowns on a rectangle, fast index first. Entries are sorted by slow, then by fast offset:
   !> 1..lower come before the diagonal, lower+2..entries after it.
   type, public :: complex_ilu_t
      integer :: fast = 0, slow = 0           !! extent of the rectangle
      integer :: entries = 0, lower = 0
      integer, allocatable :: off_f(:), off_s(:)         !! (entries) sorted offsets
      integer :: reach_fast = 0, reach_slow = 0
      ! (1-reach_fast:fast+reach_fast, entries, 1-reach_slow:slow) matrix, then factors (diagonal inverted),
      ! zero outside the rectangle
      real(sp), allocatable :: re(:, :, :), im(:, :, :)
      integer, allocatable, private :: fill(:, :)        ! (entries, lower) where a product of factors lands, or 0
      real(sp), allocatable, private :: xr(:, :), xi(:, :) ! padded vector
      logical, private :: is_broken = .false.            ! the last factors were given up
   contains
      procedure :: set_line
      procedure :: factorise
      procedure :: is_bounded
      procedure :: solve
   end type complex_ilu_t

contains

   !> Pattern and storage: all offsets up to the reaches in both directions.
   pure function new_complex_ilu(fast, slow, reach_fast, reach_slow) result(self)
      integer, intent(in) :: fast, slow                  !! extent of the rectangle
      integer, intent(in) :: reach_fast, reach_slow      !! largest offsets
      type(complex_ilu_t) :: self
      integer :: f, m, n, s

      n = (2*reach_fast + 1)*(2*reach_slow + 1)
      self%fast = fast
      self%slow = slow
      self%entries = n
      self%lower = n/2
      self%reach_fast = reach_fast
      self%reach_slow = reach_slow
      allocate (self%off_f(n), self%off_s(n))
      m = 0
      do s = -reach_slow, reach_slow
         do f = -reach_fast, reach_fast
            m = m + 1
            self%off_f(m) = f
            self%off_s(m) = s
         end do
      end do
      allocate (self%fill(n, self%lower), source=0)
      do m = 1, self%lower
         do s = self%lower + 2, n
            if (abs(self%off_f(m) + self%off_f(s)) > reach_fast .or. abs(self%off_s(m) + self%off_s(s)) > reach_slow) cycle
            self%fill(s, m) = m + s - (self%lower + 1)   ! entries are numbered linearly in their offsets
         end do
      end do
      allocate (self%re(1 - reach_fast:fast + reach_fast, n, 1 - reach_slow:slow), &
                self%im(1 - reach_fast:fast + reach_fast, n, 1 - reach_slow:slow), source=0.0_sp)
      allocate (self%xr(1 - reach_fast:fast + reach_fast, 1 - reach_slow:slow + reach_slow), &
                self%xi(1 - reach_fast:fast + reach_fast, 1 - reach_slow:slow + reach_slow), source=0.0_sp)
   end function new_complex_ilu

   !> Rows of one line.
   pure subroutine set_line(self, s, rows)
      class(complex_ilu_t), intent(inout) :: self
      integer, intent(in) :: s                    !! line, 1..slow
      complex(dp), intent(in) :: rows(:, :)       !! (fast, entries)
      integer :: m
      do m = 1, self%entries
         self%re(1:self%fast, m, s) = real(rows(:, m), sp)
         self%im(1:self%fast, m, s) = real(aimag(rows(:, m)), sp)
      end do
   end subroutine set_line

   !> Factors in place of the matrix. A pivot that turned round or lost most of its size against the diagonal it
   !> started from is set to `smallest_pivot` of it: without fill-in that is an artefact. Given up, for `is_bounded` to
   !> tell, where a pivot is zero or beyond `largest_pivot`. Other factors that grow show in a solution.
   pure subroutine factorise(self)
      class(complex_ilu_t), intent(inout) :: self
      real(sp) :: dr(self%fast), di(self%fast), fr(self%fast), fi(self%fast)
      real(sp) :: gr, gi, size2
      integer :: d, e, f, m, n, off, pf, ps, s, t

      d = self%lower + 1
      n = self%fast
      self%is_broken = .true.
      associate (re => self%re, im => self%im)
         do s = 1, self%slow
            dr = re(1:n, d, s)
            di = im(1:n, d, s)
            do m = 1, self%lower
               if (self%off_s(m) == 0) exit
               off = self%off_f(m)
               ps = s + self%off_s(m)
               fr = re(1:n, m, s)*re(1 + off:n + off, d, ps) - im(1:n, m, s)*im(1 + off:n + off, d, ps)
               fi = re(1:n, m, s)*im(1 + off:n + off, d, ps) + im(1:n, m, s)*re(1 + off:n + off, d, ps)
               re(1:n, m, s) = fr
               im(1:n, m, s) = fi
               do t = d + 1, self%entries
                  e = self%fill(t, m)
                  if (e == 0) cycle
                  do f = 1, n
                     re(f, e, s) = re(f, e, s) - (fr(f)*re(f + off, t, ps) - fi(f)*im(f + off, t, ps))
                     im(f, e, s) = im(f, e, s) - (fr(f)*im(f + off, t, ps) + fi(f)*re(f + off, t, ps))
                  end do
               end do
            end do
            do f = 1, n                       ! within the line
               do m = d - self%reach_fast, d - 1
                  pf = f + self%off_f(m)
                  gr = re(f, m, s)*re(pf, d, s) - im(f, m, s)*im(pf, d, s)
                  gi = re(f, m, s)*im(pf, d, s) + im(f, m, s)*re(pf, d, s)
                  re(f, m, s) = gr
                  im(f, m, s) = gi
                  do t = d + 1, self%entries
                     e = self%fill(t, m)
                     if (e == 0) cycle
                     re(f, e, s) = re(f, e, s) - (gr*re(pf, t, s) - gi*im(pf, t, s))
                     im(f, e, s) = im(f, e, s) - (gr*im(pf, t, s) + gi*re(pf, t, s))
                  end do
               end do
               if (.not. abs(re(f, d, s)) + abs(im(f, d, s)) <= largest_pivot) return
               size2 = dr(f)**2 + di(f)**2
               if (.not. (re(f, d, s)*dr(f) + im(f, d, s)*di(f)) > smallest_pivot*size2) then
                  re(f, d, s) = smallest_pivot*dr(f)
                  im(f, d, s) = smallest_pivot*di(f)
               end if
               size2 = re(f, d, s)**2 + im(f, d, s)**2
               if (.not. size2 > 0) return
               re(f, d, s) = re(f, d, s)/size2
               im(f, d, s) = -im(f, d, s)/size2
            end do
         end do
      end associate
      self%is_broken = .false.
   end subroutine factorise

   !> Whether the factors are of use: a solution for a right side of ones that is neither NaN nor absurdly large. Incomplete
   !> factors can grow without bound although the matrix does not.
   logical function is_bounded(self)
      class(complex_ilu_t), intent(inout) :: self
      complex(dp) :: v(self%fast, self%slow)
      is_bounded = .false.
      if (self%is_broken) return
      v = 1
      call self%solve(v)
      is_bounded = all(abs(v) <= largest_growth)
   end function is_bounded

   !> Solution of (L U) v = v in place.
   pure subroutine solve(self, v)
      class(complex_ilu_t), intent(inout) :: self
      complex(dp), intent(inout) :: v(:, :)   !! (fast, slow) right side, then solution
      real(sp) :: tr, ti
      integer :: d, f, m, n, off, ps, s

      d = self%lower + 1
      n = self%fast
      associate (re => self%re, im => self%im, xr => self%xr, xi => self%xi)
         do s = 1, self%slow
            xr(1:n, s) = real(v(:, s), sp)
            xi(1:n, s) = real(aimag(v(:, s)), sp)
            do m = 1, d - 1 - self%reach_fast
               off = self%off_f(m)
               ps = s + self%off_s(m)
               do f = 1, n
                  xr(f, s) = xr(f, s) - (re(f, m, s)*xr(f + off, ps) - im(f, m, s)*xi(f + off, ps))
                  xi(f, s) = xi(f, s) - (re(f, m, s)*xi(f + off, ps) + im(f, m, s)*xr(f + off, ps))
               end do
            end do
            do f = 1, n
               do m = d - self%reach_fast, d - 1
                  off = f + self%off_f(m)
                  xr(f, s) = xr(f, s) - (re(f, m, s)*xr(off, s) - im(f, m, s)*xi(off, s))
                  xi(f, s) = xi(f, s) - (re(f, m, s)*xi(off, s) + im(f, m, s)*xr(off, s))
               end do
            end do
         end do
         do s = self%slow, 1, -1
            do m = d + self%reach_fast + 1, self%entries
               off = self%off_f(m)
               ps = s + self%off_s(m)
               do f = 1, n
                  xr(f, s) = xr(f, s) - (re(f, m, s)*xr(f + off, ps) - im(f, m, s)*xi(f + off, ps))
                  xi(f, s) = xi(f, s) - (re(f, m, s)*xi(f + off, ps) + im(f, m, s)*xr(f + off, ps))
               end do
            end do
            do f = n, 1, -1
               do m = d + self%reach_fast, d + 1, -1
                  off = f + self%off_f(m)
                  xr(f, s) = xr(f, s) - (re(f, m, s)*xr(off, s) - im(f, m, s)*xi(off, s))
                  xi(f, s) = xi(f, s) - (re(f, m, s)*xi(off, s) + im(f, m, s)*xr(off, s))
               end do
               tr = re(f, d, s)*xr(f, s) - im(f, d, s)*xi(f, s)
               ti = re(f, d, s)*xi(f, s) + im(f, d, s)*xr(f, s)
               xr(f, s) = tr
               xi(f, s) = ti
            end do
            v(:, s) = cmplx(xr(1:n, s), xi(1:n, s), dp)
         end do
      end associate
   end subroutine solve

end module ehlwave_complex_ilu
