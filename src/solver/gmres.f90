!> GMRES with right preconditioning for any linear system.
module ehlwave_gmres
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ehlwave_kinds, only: dp
   implicit none (type, external)
   private
   public :: new_gmres, dot, norm

   type, abstract, public :: linear_system_t
   contains
      procedure(product), deferred :: multiply       !! y = A x
      procedure(product), deferred :: precondition   !! y = M^(-1) x
   end type linear_system_t

   abstract interface
      subroutine product(self, x, y)
         import :: dp, linear_system_t
         implicit none (type, external)
         class(linear_system_t), intent(inout) :: self
         real(dp), intent(in), contiguous, target :: x(:)
         real(dp), intent(out), contiguous, target :: y(:)
      end subroutine product
   end interface

   !> Work space: Krylov basis and small triangular system.
   type, public :: gmres_t
      integer :: largest_steps = 0
      real(dp), allocatable :: basis(:, :)    !! (n, 0:largest_steps)
      real(dp), allocatable :: hess(:, :)     !! (0:largest_steps, largest_steps)
      real(dp), allocatable :: cosine(:), sine(:), rhs(:), z(:), w(:)
      integer :: steps = 0                    !! of the last solve
      real(dp) :: reduction = 0               !! residual norm over that of the right side, last solve
   contains
      procedure :: solve
   end type gmres_t

contains

   !> Work space for n unknowns and at most `largest_steps` steps (no restart: the cap ends the solve).
   pure function new_gmres(n, largest_steps) result(self)
      integer, intent(in) :: n, largest_steps
      type(gmres_t) :: self
      self%largest_steps = largest_steps
      allocate (self%basis(n, 0:largest_steps), self%hess(0:largest_steps, largest_steps), &
                self%cosine(largest_steps), self%sine(largest_steps), self%rhs(0:largest_steps), &
                self%z(n), self%w(n))
   end function new_gmres

   !> x with |b - A x| <= tolerance |b|, from x = 0, or the best found within the step cap.
   subroutine solve(self, system, b, x, tolerance)
      class(gmres_t), intent(inout) :: self
      class(linear_system_t), intent(inout) :: system
      real(dp), intent(in), contiguous :: b(:)
      real(dp), intent(out), contiguous, target :: x(:)
      real(dp), intent(in) :: tolerance
      real(dp) :: beta, correction, rotated
      integer :: i, k, used

      self%steps = 0
      self%reduction = 0
      x = 0
      beta = norm(b)
      if (.not. beta > 0) return
      self%basis(:, 0) = b/beta
      self%rhs = 0
      self%rhs(0) = beta
      used = 0
      do k = 1, self%largest_steps
         call system%precondition(self%basis(:, k - 1), self%z)
         call system%multiply(self%z, self%w)
         do i = 0, k - 1                                ! modified Gram-Schmidt
            self%hess(i, k) = dot(self%w, self%basis(:, i))
            self%w = self%w - self%hess(i, k)*self%basis(:, i)
         end do
         self%hess(k, k) = norm(self%w)
         if (.not. ieee_is_finite(self%hess(k, k))) exit
         if (self%hess(k, k) > 0) self%basis(:, k) = self%w/self%hess(k, k)
         do i = 1, k - 1                                ! earlier rotations
            rotated = self%cosine(i)*self%hess(i - 1, k) + self%sine(i)*self%hess(i, k)
            self%hess(i, k) = -self%sine(i)*self%hess(i - 1, k) + self%cosine(i)*self%hess(i, k)
            self%hess(i - 1, k) = rotated
         end do
         correction = hypot(self%hess(k - 1, k), self%hess(k, k))
         if (.not. correction > 0) exit
         used = k
         self%cosine(k) = self%hess(k - 1, k)/correction
         self%sine(k) = self%hess(k, k)/correction
         self%hess(k - 1, k) = correction
         self%rhs(k) = -self%sine(k)*self%rhs(k - 1)
         self%rhs(k - 1) = self%cosine(k)*self%rhs(k - 1)
         if (abs(self%rhs(k)) <= tolerance*beta) exit
      end do
      self%steps = used
      if (used == 0) return
      self%reduction = abs(self%rhs(used))/beta
      do i = used, 1, -1                                ! back substitution, result in rhs(0:used-1)
         do k = i + 1, used
            self%rhs(i - 1) = self%rhs(i - 1) - self%hess(i - 1, k)*self%rhs(k - 1)
         end do
         self%rhs(i - 1) = self%rhs(i - 1)/self%hess(i - 1, i)
      end do
      self%w = 0
      do i = 1, used
         self%w = self%w + self%rhs(i - 1)*self%basis(:, i - 1)
      end do
      call system%precondition(self%w, x)
   end subroutine solve

   !> Scalar product with eight partial sums, so that it is vectorised and the same on every run.
   pure real(dp) function dot(a, b)
      real(dp), intent(in), contiguous :: a(:), b(:)
      real(dp) :: part(8)
      integer :: i, n
      part = 0
      n = size(a) - modulo(size(a), 8)
      do i = 1, n, 8
         part = part + a(i:i + 7)*b(i:i + 7)
      end do
      dot = sum(part)
      do i = n + 1, size(a)
         dot = dot + a(i)*b(i)
      end do
   end function dot

   !> Euclidean norm.
   pure real(dp) function norm(a)
      real(dp), intent(in), contiguous :: a(:)
      norm = sqrt(dot(a, a))
   end function norm

end module ehlwave_gmres
