!> Threads that share a contact: the same bits with any number of them; the cores of a rank.
program test_threads
   use ehlwave_deformation_fft, only: deformation_fft_t
   use ehlwave_grid, only: grid_t, new_grid
   use ehlwave_kinds, only: dp
   use ehlwave_real_gmres, only: dot
   use ehlwave_real_ilu, only: ilu_t, new_ilu
   use ehlwave_threads, only: announce, await, can_share, own_cores, share_of_cores, take_threads, team_size, &
      thread_count, thread_number
   use ehlwave_text, only: to_text
   use sample_contact, only: noise
   use testing, only: test_t
   implicit none (type, external)

   integer, parameter :: fast = 400, slow = 30        ! lines that three threads work on
   type(test_t) :: test
   real(dp), allocatable :: by_one(:), by_many(:)
   integer :: threads

   call check_shares()
   do threads = 1, merge(3, 1, can_share())
      call take_threads(threads)
      call test%check_equal(thread_count(), threads, 'as many threads as asked for')
      call check_turns(threads)
      by_many = [deformations(.true.), deformations(.false.), solved(), products()]
      if (threads == 1) by_one = by_many
      call test%check(all(abs(by_many - by_one) <= 0), 'the same bits by '//to_text(threads)//' threads')
   end do
   call test%check(any(abs(by_one) > 0), 'of values that are some')
   call test%finish()

contains

   !> Processes that are bound have their cores, those that are not share them.
   subroutine check_shares()
      call test%check_equal(share_of_cores([1, 1, 0, 0], [1, 1, 1, 1]), 2, 'bound to two cores')
      call test%check_equal(share_of_cores([1, 1, 1, 1], [2, 2, 2, 2]), 2, 'two that share four')
      call test%check_equal(share_of_cores([1, 1, 1, 1], [3, 3, 3, 3]), 1, 'three that share four')
      call test%check_equal(share_of_cores([1, 0, 0, 0], [8, 0, 0, 0]), 1, 'never none')
      call test%check_equal(share_of_cores([0, 0, 0, 0], [0, 0, 0, 0]), 1, 'nor where the system does not tell')
      call test%check(sum(own_cores()) >= 1, 'this process has a core')
   end subroutine check_shares

   !> A waiting thread sees the other thread's writes.
   subroutine check_turns(threads)
      integer, intent(in) :: threads
      integer :: done, k, total
      done = 0
      total = 0
      !$omp parallel num_threads(threads) private(k)
      do k = 1 + thread_number(), 200, team_size()
         call await(done, k - 1)
         total = 2*modulo(total, 1000) + k
         call announce(done, k)
      end do
      !$omp end parallel
      call test%check_equal(total, in_turn(200), to_text(threads)//' threads in turn')
   end subroutine check_turns

   pure integer function in_turn(n) result(total)
      integer, intent(in) :: n
      integer :: k
      total = 0
      do k = 1, n
         total = 2*modulo(total, 1000) + k
      end do
   end function in_turn

   !> Deformation in double and in single precision, on a grid that is worth sharing.
   function deformations(is_half) result(values)
      logical, intent(in) :: is_half
      real(dp), allocatable :: values(:)
      type(deformation_fft_t) :: deformation
      type(grid_t) :: grid
      real(dp), allocatable :: d(:, :), p(:, :)
      integer :: i, j

      grid = new_grid(-2.5_dp, 1.5_dp, 2.0_dp, 150, 140, is_half)
      call deformation%init(grid, 0.7_dp, 1.8_dp)
      allocate (d(0:grid%nx, 0:grid%ny), p(0:grid%nx, 0:grid%ny), source=0.0_dp)
      do j = grid%first_row, grid%last_row
         do i = 1, grid%nx - 1
            p(i, j) = noise(i, j)
         end do
      end do
      call deformation%apply(p, d)
      values = reshape(d, [size(d)])
      call deformation%apply_single(p, d)
      values = [values, reshape(d, [size(d)])]
   end function deformations

   !> Solution with incomplete factors, and whether factors of a matrix without any are given up.
   function solved() result(values)
      real(dp) :: values(fast*slow + 2)
      type(ilu_t) :: ilu
      real(dp) :: v(fast, slow)
      integer :: f, s

      ilu = new_ilu(fast, slow, 1, 2)
      call factorise(ilu, is_broken=.true.)
      values(1) = merge(1, 0, ilu%is_bounded())
      call factorise(ilu, is_broken=.false.)
      values(2) = merge(1, 0, ilu%is_bounded())
      do s = 1, slow
         do f = 1, fast
            v(f, s) = noise(f, s)
         end do
      end do
      call ilu%solve(v)
      values(3:) = reshape(v, [size(v)])
      call test%check(values(1) < 0.5_dp .and. values(2) > 0.5_dp, 'factors are given up where there are none')
   end function solved

   subroutine factorise(ilu, is_broken)
      type(ilu_t), intent(inout) :: ilu
      logical, intent(in) :: is_broken
      real(dp) :: rows(fast, ilu%entries)
      integer :: e, f, s

      call ilu%begin()
      !$omp parallel num_threads(ilu%threads) private(e, f, rows, s)
      do s = 1, slow
         if (modulo((s - 1)/ilu%together, team_size()) /= thread_number()) cycle
         do e = 1, ilu%entries
            do f = 1, fast
               rows(f, e) = noise(f + 3*e, s) - 0.5_dp
               if (f + ilu%off_f(e) < 1 .or. f + ilu%off_f(e) > fast) rows(f, e) = 0
               if (s + ilu%off_s(e) < 1 .or. s + ilu%off_s(e) > slow) rows(f, e) = 0
            end do
         end do
         rows(:, ilu%lower + 1) = 9
         if (is_broken .and. s == slow/2) rows(fast/2, ilu%lower + 1) = 0
         call ilu%add_line(s, rows)
      end do
      !$omp end parallel
   end subroutine factorise

   !> Scalar products of more values than a block.
   function products() result(values)
      real(dp) :: values(1)
      real(dp) :: a(50001), b(50001)
      integer :: i
      do i = 1, size(a)
         a(i) = noise(i, 1)
         b(i) = noise(i, 2) - 0.5_dp
      end do
      values = dot(a, b)
   end function products

end program test_threads
