!> GMRES with right preconditioning for any linear system (Saad and Schultz 1986).
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

   !> Work space: Krylov basis and small triangular system. The preconditioned vectors are kept (flexible form, Saad
   !> 1993): the solution is a sum of them and needs no further application of the preconditioner, which for a
   !> multigrid cycle and few steps is a good part of the work. Storage grows with the steps that are taken.
   type, public :: gmres_t
      integer :: largest_steps = 0
      real(dp), allocatable :: basis(:, :)    !! (n, 0:capacity)
      real(dp), allocatable :: z(:, :)        !! (n, capacity) preconditioned basis
      real(dp), allocatable :: hess(:, :)     !! (0:largest_steps, largest_steps)
      real(dp), allocatable :: cosine(:), sine(:), rhs(:)
      integer :: steps = 0                    !! of the last solve
      real(dp) :: reduction = 0               !! residual norm over that of the right side, last solve
   contains
      procedure :: solve
   end type gmres_t

   integer, parameter :: first_capacity = 8

contains

   !> Work space for n unknowns and at most `largest_steps` steps (no restart: the cap ends the solve).
   pure function new_gmres(n, largest_steps) result(self)
      integer, intent(in) :: n, largest_steps
      type(gmres_t) :: self
      self%largest_steps = largest_steps
      allocate (self%basis(n, 0:min(first_capacity, largest_steps)), self%z(n, min(first_capacity, largest_steps)))
      allocate (self%hess(0:largest_steps, largest_steps), self%cosine(largest_steps), self%sine(largest_steps), &
                self%rhs(0:largest_steps))
   end function new_gmres

   !> Make room for twice as many vectors, at most `largest_steps`.
   pure subroutine grow(self)
      type(gmres_t), intent(inout) :: self
      real(dp), allocatable :: wider(:, :)
      integer :: capacity, n, used

      n = size(self%z, 1)
      used = size(self%z, 2)
      capacity = min(2*used, self%largest_steps)
      allocate (wider(n, 0:capacity))
      wider(:, 0:used) = self%basis
      call move_alloc(wider, self%basis)
      allocate (wider(n, capacity))
      wider(:, 1:used) = self%z
      call move_alloc(wider, self%z)
   end subroutine grow

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
         if (k > size(self%z, 2)) call grow(self)
         call system%precondition(self%basis(:, k - 1), self%z(:, k))
         call system%multiply(self%z(:, k), self%basis(:, k))
         do i = 0, k - 1                                ! modified Gram-Schmidt
            self%hess(i, k) = dot(self%basis(:, k), self%basis(:, i))
            call subtract(self%hess(i, k), self%basis(:, i), self%basis(:, k))
         end do
         self%hess(k, k) = norm(self%basis(:, k))
         if (.not. ieee_is_finite(self%hess(k, k))) exit
         if (self%hess(k, k) > 0) self%basis(:, k) = self%basis(:, k)/self%hess(k, k)
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
      do i = 1, used
         call subtract(-self%rhs(i - 1), self%z(:, i), x)
      end do
   end subroutine solve

   !> y <- y - a x.
   pure subroutine subtract(a, x, y)
      real(dp), intent(in) :: a
      real(dp), intent(in), contiguous :: x(:)
      real(dp), intent(inout), contiguous :: y(:)
      y = y - a*x
   end subroutine subtract

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
