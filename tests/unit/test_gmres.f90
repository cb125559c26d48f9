!> GMRES on small dense systems, with and without preconditioner.
module dense_system
   use ehlwave_real_gmres, only: linear_system_t
   use ehlwave_kinds, only: dp
   implicit none (type, external)
   private

   type, extends(linear_system_t), public :: dense_t
      real(dp), allocatable :: a(:, :)
      logical :: is_scaled = .false.     !! precondition with the inverse of the diagonal
      integer :: products = 0, most_products = huge(1)
   contains
      procedure :: multiply
      procedure :: precondition
      procedure :: is_spent
   end type dense_t

contains

   subroutine multiply(self, x, y)
      class(dense_t), intent(inout) :: self
      real(dp), intent(in), contiguous, target :: x(:)
      real(dp), intent(out), contiguous, target :: y(:)
      y = matmul(self%a, x)
      self%products = self%products + 1
   end subroutine multiply

   subroutine precondition(self, x, y)
      class(dense_t), intent(inout) :: self
      real(dp), intent(in), contiguous, target :: x(:)
      real(dp), intent(out), contiguous, target :: y(:)
      integer :: i
      y = x
      if (.not. self%is_scaled) return
      do i = 1, size(x)
         y(i) = x(i)/self%a(i, i)
      end do
   end subroutine precondition

   pure logical function is_spent(self)
      class(dense_t), intent(in) :: self
      is_spent = self%products >= self%most_products
   end function is_spent

end module dense_system

program test_gmres
   use dense_system, only: dense_t
   use ehlwave_real_gmres, only: dot, gmres_t, norm
   use ehlwave_kinds, only: dp
   use sample_contact, only: noise
   use testing, only: test_t
   implicit none (type, external)

   integer, parameter :: n = 13
   type(test_t) :: test

   call check_products()
   call check_solution(.false.)
   call check_solution(.true.)
   call check_step_cap()
   call check_trivial()
   call test%finish()

contains

   function make_system(is_scaled) result(system)
      logical, intent(in) :: is_scaled
      type(dense_t) :: system
      integer :: i, j
      allocate (system%a(n, n))
      do j = 1, n
         do i = 1, n
            system%a(i, j) = noise(i, 2*j)
         end do
         system%a(j, j) = system%a(j, j) + 3.0_dp*j
      end do
      system%is_scaled = is_scaled
   end function make_system

   subroutine check_products()
      real(dp) :: a(n), b(n)
      integer :: i
      a = [(noise(i, 1), i=1, n)]
      b = [(noise(i, 2), i=1, n)]
      call test%check_close(dot(a, b), sum(a*b), 'dot with a remainder', relative=1e-14_dp)
      call test%check_close(dot(a(:8), b(:8)), sum(a(:8)*b(:8)), 'dot without one', relative=1e-14_dp)
      call test%check_close(norm(a), sqrt(sum(a**2)), 'norm', relative=1e-14_dp)
   end subroutine check_products

   subroutine check_solution(is_scaled)
      logical, intent(in) :: is_scaled
      type(dense_t) :: system
      type(gmres_t) :: gmres
      real(dp) :: b(n), expected(n), x(n)
      integer :: i

      system = make_system(is_scaled)
      expected = [(noise(5*i, 3), i=1, n)]
      b = matmul(system%a, expected)
      gmres%largest_steps = 2*n
      call gmres%solve(system, b, x, 1e-13_dp)
      call test%check_close(x, expected, 'solution', absolute=1e-11_dp)
      call test%check(gmres%steps <= n, 'at most n steps')
      call gmres%solve(system, b, x, 1e-3_dp)
      call test%check_close(gmres%reduction, norm(b - matmul(system%a, x))/norm(b), 'reported reduction is the true one', &
                            relative=1e-9_dp)
      call test%check(gmres%reduction <= 1e-3_dp .and. gmres%steps < n, 'stops at the tolerance')
   end subroutine check_solution

   subroutine check_step_cap()
      type(dense_t) :: system
      type(gmres_t) :: gmres
      real(dp) :: b(n), x(n)
      system = make_system(.false.)
      b = 1
      gmres%largest_steps = 4
      call gmres%solve(system, b, x, 1e-13_dp)
      call test%check(gmres%steps == 4 .and. system%products == 4, 'step cap')
      call test%check_close(norm(b - matmul(system%a, x))/norm(b), gmres%reduction, 'reduction at the cap', relative=1e-9_dp)
      call test%check(gmres%reduction < 1, 'better than nothing')
      system%most_products = system%products + 2
      call gmres%solve(system, b, x, 1e-13_dp)
      call test%check(gmres%steps == 2 .and. system%is_spent(), 'a system that is spent')
      call test%check_close(norm(b - matmul(system%a, x))/norm(b), gmres%reduction, 'reduction there', relative=1e-9_dp)
   end subroutine check_step_cap

   subroutine check_trivial()
      type(dense_t) :: system
      type(gmres_t) :: gmres
      real(dp) :: b(n), x(n)
      integer :: i
      system = make_system(.false.)
      b = 0
      call gmres%solve(system, b, x, 1e-10_dp)
      call test%check(all(abs(x) <= 0) .and. gmres%steps == 0, 'right side zero')
      system%a = 0
      do i = 1, n
         system%a(i, i) = 2
      end do
      b = 1
      call gmres%solve(system, b, x, 1e-10_dp)
      call test%check_close(x, spread(0.5_dp, 1, n), 'one step for a multiple of the identity', relative=1e-14_dp)
      call test%check(gmres%steps == 1, 'one step')
   end subroutine check_trivial

end program test_gmres
