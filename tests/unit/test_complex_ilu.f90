!> A system to try the factors and the solver on.
module complex_sample
   use ehlwave_complex_gmres, only: complex_system_t
   use ehlwave_complex_ilu, only: complex_ilu_t
   use ehlwave_kinds, only: dp
   implicit none (type, external)
   private

   !> A convection-diffusion matrix with a complex diagonal; the factors precondition it, or nothing does.
   type, extends(complex_system_t), public :: sample_system_t
      integer :: fast = 0, slow = 0
      complex(dp), allocatable :: rows(:, :, :)      ! (fast, entries, slow)
      type(complex_ilu_t) :: ilu
      logical :: is_preconditioned = .true.
   contains
      procedure :: multiply
      procedure :: precondition
   end type sample_system_t

contains

   subroutine multiply(self, x, y)
      class(sample_system_t), intent(inout) :: self
      complex(dp), intent(in), contiguous, target :: x(:)
      complex(dp), intent(out), contiguous, target :: y(:)
      integer :: e, f, pf, ps, s
      y = 0
      do s = 1, self%slow
         do f = 1, self%fast
            do e = 1, 9
               pf = f + self%ilu%off_f(e)
               ps = s + self%ilu%off_s(e)
               if (pf < 1 .or. pf > self%fast .or. ps < 1 .or. ps > self%slow) cycle
               y(f + (s - 1)*self%fast) = y(f + (s - 1)*self%fast) + self%rows(f, e, s)*x(pf + (ps - 1)*self%fast)
            end do
         end do
      end do
   end subroutine multiply

   subroutine precondition(self, x, y)
      class(sample_system_t), intent(inout) :: self
      complex(dp), intent(in), contiguous, target :: x(:)
      complex(dp), intent(out), contiguous, target :: y(:)
      complex(dp) :: v(self%fast, self%slow)
      if (self%is_preconditioned) then
         v = reshape(x, shape(v))
         call self%ilu%solve(v)
         y = reshape(v, shape(y))
      else
         y = x
      end if
   end subroutine precondition

end module complex_sample

!> Incomplete factors of a complex stencil matrix, and flexible GMRES with them.
program test_complex_ilu
   use complex_sample, only: sample_system_t
   use ehlwave_complex_gmres, only: complex_gmres_t
   use ehlwave_complex_ilu, only: complex_ilu_t, new_complex_ilu
   use ehlwave_kinds, only: dp
   use sample_contact, only: noise
   use testing, only: test_t
   implicit none (type, external)

   type(test_t) :: test

   call solves_exactly_without_fill(test)
   call preconditions(test)
   call keeps_pivots(test)
   call tells_growth(test)
   call finds_solution(test)
   call test%finish()

contains

   !> Rows with entries at the offsets -1..1 by -1..1 that `keep` allows.
   subroutine make(system, fast, slow, five_points)
      type(sample_system_t), intent(out) :: system
      integer, intent(in) :: fast, slow
      logical, intent(in) :: five_points
      integer :: e, f, s

      system%fast = fast
      system%slow = slow
      system%ilu = new_complex_ilu(fast, slow, 1, 1)
      allocate (system%rows(fast, 9, slow), source=(0.0_dp, 0.0_dp))
      do s = 1, slow
         do f = 1, fast
            do e = 1, 9
               if (five_points .and. abs(system%ilu%off_f(e)) + abs(system%ilu%off_s(e)) > 1) cycle
               if (f + system%ilu%off_f(e) < 1 .or. f + system%ilu%off_f(e) > fast) cycle
               if (s + system%ilu%off_s(e) < 1 .or. s + system%ilu%off_s(e) > slow) cycle
               system%rows(f, e, s) = cmplx(-1 + 0.2_dp*noise(f + 7*e, s), 0.3_dp*noise(f, s + 5*e), dp)
            end do
            system%rows(f, 5, s) = cmplx(4.2_dp, 2.0_dp, dp)
         end do
         call system%ilu%set_line(s, system%rows(:, :, s))
      end do
      call system%ilu%factorise()
   end subroutine make

   pure function sample(n) result(x)
      integer, intent(in) :: n
      complex(dp) :: x(n)
      integer :: i
      x = [(cmplx(noise(i, 1), noise(i, 2), dp), i=1, n)]
   end function sample

   !> On one line the pattern loses nothing: the factors are exact but for their single precision.
   subroutine solves_exactly_without_fill(test)
      type(test_t), intent(inout) :: test
      type(sample_system_t) :: system
      complex(dp) :: x(40), y(40), z(40)
      call make(system, 40, 1, .false.)
      x = sample(40)
      call system%multiply(x, y)
      call system%precondition(y, z)
      call test%check_close(maxval(abs(z - x)), 0.0_dp, 'one line, along the fast index', absolute=1e-5_dp)
      call make(system, 1, 40, .false.)
      call system%multiply(x, y)
      call system%precondition(y, z)
      call test%check_close(maxval(abs(z - x)), 0.0_dp, 'one line, along the slow index', absolute=1e-5_dp)
   end subroutine solves_exactly_without_fill

   !> ILU(0) reproduces the matrix on its pattern: the defect of five-point factors is small, not zero.
   subroutine preconditions(test)
      type(test_t), intent(inout) :: test
      type(sample_system_t) :: system
      complex(dp) :: x(600), y(600), z(600)
      call make(system, 20, 30, .true.)
      x = sample(600)
      call system%multiply(x, y)
      call system%precondition(y, z)
      call test%check(norm2(abs(z - x)) < 0.15_dp*norm2(abs(x)), 'factors are close to the matrix')
      call test%check(norm2(abs(z - x)) > 1e-4_dp*norm2(abs(x)), 'but incomplete')
   end subroutine preconditions

   !> x(s) = 1 + 3 x(s - 1) grows by 3^40, with a larger diagonal it does not, and NaN is no use.
   subroutine tells_growth(test)
      type(test_t), intent(inout) :: test
      call test%check(.not. with_diagonal(1.0_dp), 'factors that grow are told')
      call test%check(with_diagonal(4.0_dp), 'factors that do not are kept')
      call test%check(.not. with_diagonal(0.0_dp), 'a zero pivot is no use')
   end subroutine tells_growth

   logical function with_diagonal(diagonal)
      real(dp), intent(in) :: diagonal
      type(complex_ilu_t) :: ilu
      complex(dp) :: rows(2, 9)
      integer :: s
      ilu = new_complex_ilu(2, 40, 1, 1)
      do s = 1, 40
         rows = 0
         rows(:, 5) = diagonal
         if (s > 1) rows(:, 2) = -3      ! the line before
         call ilu%set_line(s, rows)
      end do
      call ilu%factorise()
      with_diagonal = ilu%is_bounded()
   end function with_diagonal

   !> A pivot that elimination would turn round is kept at a tenth of the diagonal it came from.
   subroutine keeps_pivots(test)
      type(test_t), intent(inout) :: test
      type(complex_ilu_t) :: ilu
      complex(dp) :: rows(2, 9), v(2, 1)
      ilu = new_complex_ilu(2, 1, 1, 1)
      rows = 0
      rows(:, 5) = 1
      rows(1, 6) = 2                         ! [1 2; 2 1]: elimination gives 1 - 4 < 0
      rows(2, 4) = 2
      call ilu%set_line(1, rows)
      call ilu%factorise()
      v(:, 1) = [(0.0_dp, 0.0_dp), (1.0_dp, 0.0_dp)]
      call ilu%solve(v)
      call test%check_close(real(v(2, 1), dp), 10.0_dp, 'pivot of a tenth', relative=1e-6_dp)
   end subroutine keeps_pivots

   subroutine finds_solution(test)
      type(test_t), intent(inout) :: test
      type(sample_system_t) :: system
      type(complex_gmres_t) :: gmres
      complex(dp) :: b(600), r(600), x(600)
      integer :: plain
      call make(system, 20, 30, .false.)
      b = sample(600)
      call gmres%solve(system, b, x, 1e-10_dp)
      call system%multiply(x, r)
      call test%check(norm2(abs(b - r)) <= 1.01e-10_dp*norm2(abs(b)), 'true residual below the tolerance')
      call test%check_close(gmres%reduction, norm2(abs(b - r))/norm2(abs(b)), 'reported reduction', relative=1e-3_dp)
      system%is_preconditioned = .false.
      plain = gmres%steps
      call gmres%solve(system, b, x, 1e-10_dp)
      call test%check(plain < gmres%steps, 'factors save steps')
      call gmres%solve(system, 0*b, x, 1e-10_dp)
      call test%check(gmres%steps == 0 .and. all(abs(x) <= 0), 'nothing to do for b = 0')
      gmres%largest_steps = 3
      call gmres%solve(system, b, x, 1e-10_dp)
      call test%check(gmres%steps == 3 .and. gmres%reduction > 1e-10_dp .and. gmres%reduction < 1, 'the cap ends it')
   end subroutine finds_solution

end program test_complex_ilu
