!> Flexible GMRES with right preconditioning for complex linear systems (Saad 1993).
!>
!> Flexible, because a preconditioner in single precision is not exactly linear: plain GMRES, which applies it once
!> more to the sum of its basis, lost four digits of the solution to that.
module ehlwave_complex_gmres
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ehlwave_kinds, only: dp
   implicit none (type, external)
   private

   type, abstract, public :: complex_system_t
   contains
      procedure(product), deferred :: multiply       !! y = A x
      procedure(product), deferred :: precondition   !! y = M^(-1) x
   end type complex_system_t

   abstract interface
      subroutine product(self, x, y)
         import :: complex_system_t, dp
         implicit none (type, external)
         class(complex_system_t), intent(inout) :: self
         complex(dp), intent(in), contiguous, target :: x(:)
         complex(dp), intent(out), contiguous, target :: y(:)
      end subroutine product
   end interface

   !> A column of the Krylov basis and its image under the preconditioner. Columns are made as they are needed: a
   !> solve that takes few steps takes little memory.
   type :: column_t
      complex(dp), allocatable :: v(:), z(:)
   end type column_t

   !> Work space, kept from one solve to the next.
   type, public :: complex_gmres_t
      integer :: largest_steps = 150
      integer :: steps = 0                    !! of the last solve
      real(dp) :: reduction = 0               !! residual norm over that of the right side, last solve
      type(column_t), allocatable, private :: basis(:)   ! (0:largest_steps)
   contains
      procedure :: solve
   end type complex_gmres_t

contains

   !> x with |b - A x| <= tolerance |b|, from x = 0, or the best found within `largest_steps` (no restart).
   subroutine solve(self, system, b, x, tolerance)
      class(complex_gmres_t), intent(inout) :: self
      class(complex_system_t), intent(inout) :: system
      complex(dp), intent(in), contiguous :: b(:)
      complex(dp), intent(out), contiguous :: x(:)
      real(dp), intent(in) :: tolerance
      complex(dp) :: hess(0:self%largest_steps, self%largest_steps), rhs(0:self%largest_steps), &
                     sine(self%largest_steps), rotated
      real(dp) :: beta, cosine(self%largest_steps), length
      complex(dp), allocatable :: w(:)
      integer :: i, k, used

      self%steps = 0
      self%reduction = 0
      x = 0
      beta = norm(b)
      if (.not. beta > 0) return
      call make_basis(self, size(b))
      allocate (w(size(b)))
      self%basis(0)%v = b/beta
      rhs = 0
      rhs(0) = beta
      used = 0
      do k = 1, self%largest_steps
         if (.not. allocated(self%basis(k - 1)%z)) allocate (self%basis(k - 1)%z(size(b)))
         call system%precondition(self%basis(k - 1)%v, self%basis(k - 1)%z)
         call system%multiply(self%basis(k - 1)%z, w)
         do i = 0, k - 1                                ! modified Gram-Schmidt
            hess(i, k) = dot(self%basis(i)%v, w)
            call subtract(hess(i, k), self%basis(i)%v, w)
         end do
         length = norm(w)
         if (.not. ieee_is_finite(length)) exit
         hess(k, k) = length
         if (length > 0) self%basis(k)%v = w/length
         do i = 1, k - 1                                ! earlier rotations
            rotated = cosine(i)*hess(i - 1, k) + sine(i)*hess(i, k)
            hess(i, k) = -conjg(sine(i))*hess(i - 1, k) + cosine(i)*hess(i, k)
            hess(i - 1, k) = rotated
         end do
         if (.not. hypot(abs(hess(k - 1, k)), length) > 0) exit
         used = k
         call rotation(hess(k - 1, k), length, cosine(k), sine(k))
         hess(k - 1, k) = cosine(k)*hess(k - 1, k) + sine(k)*length
         rhs(k) = -conjg(sine(k))*rhs(k - 1)
         rhs(k - 1) = cosine(k)*rhs(k - 1)
         if (abs(rhs(k)) <= tolerance*beta) exit
      end do
      self%steps = used
      if (used == 0) return
      self%reduction = abs(rhs(used))/beta
      do i = used, 1, -1                                ! back substitution, result in rhs(0:used-1)
         rhs(i - 1) = (rhs(i - 1) - sum(hess(i - 1, i + 1:used)*rhs(i:used - 1)))/hess(i - 1, i)
      end do
      do i = 1, used
         call subtract(-rhs(i - 1), self%basis(i - 1)%z, x)
      end do
   end subroutine solve

   !> Columns for vectors of length n; made in `solve` on first assignment.
   subroutine make_basis(self, n)
      class(complex_gmres_t), intent(inout) :: self
      integer, intent(in) :: n
      if (allocated(self%basis)) then
         if (ubound(self%basis, 1) == self%largest_steps .and. size(self%basis(0)%v) == n) return
         deallocate (self%basis)
      end if
      allocate (self%basis(0:self%largest_steps))
   end subroutine make_basis

   !> Rotation [c s; -conj(s) c] that takes (a, b), b real, to (r, 0).
   pure subroutine rotation(a, b, c, s)
      complex(dp), intent(in) :: a
      real(dp), intent(in) :: b
      real(dp), intent(out) :: c
      complex(dp), intent(out) :: s
      real(dp) :: length
      length = hypot(abs(a), b)
      c = abs(a)/length
      if (abs(a) > 0) then
         s = a/abs(a)*(b/length)
      else
         s = 1
      end if
   end subroutine rotation

   !> conj(a) b with four partial sums, so that it is vectorised and the same on every run.
   pure complex(dp) function dot(a, b)
      complex(dp), intent(in), contiguous :: a(:), b(:)
      real(dp) :: re(4), im(4)
      integer :: i, n
      re = 0
      im = 0
      n = size(a) - modulo(size(a), 4)
      do i = 1, n, 4
         re = re + real(a(i:i + 3))*real(b(i:i + 3)) + aimag(a(i:i + 3))*aimag(b(i:i + 3))
         im = im + real(a(i:i + 3))*aimag(b(i:i + 3)) - aimag(a(i:i + 3))*real(b(i:i + 3))
      end do
      dot = cmplx(sum(re), sum(im), dp)
      do i = n + 1, size(a)
         dot = dot + conjg(a(i))*b(i)
      end do
   end function dot

   !> w <- w - factor v.
   pure subroutine subtract(factor, v, w)
      complex(dp), intent(in) :: factor
      complex(dp), intent(in), contiguous :: v(:)
      complex(dp), intent(inout), contiguous :: w(:)
      integer :: i
      do i = 1, size(w)
         w(i) = w(i) - factor*v(i)
      end do
   end subroutine subtract

   !> Euclidean norm.
   pure real(dp) function norm(a)
      complex(dp), intent(in), contiguous :: a(:)
      norm = sqrt(real(dot(a, a), dp))
   end function norm

end module ehlwave_complex_gmres
