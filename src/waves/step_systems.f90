!> Linear systems of successive time steps, each with a few right sides. Earlier solutions give the first guess, and
!> factors are kept while they save work.
module ehlwave_step_systems
   use ehlwave_cycle_settings, only: diagonal_shift
   use ehlwave_hierarchy, only: level_t, work_of
   use ehlwave_kept_factors, only: kept_factors_t
   use ehlwave_kinds, only: dp
   use ehlwave_real_gmres, only: gmres_t
   use ehlwave_real_linearised_contact, only: linearised_contact_t
   use ehlwave_small_solve, only: solve_small
   use ehlwave_status, only: status_converged, status_not_finite, status_stalled
   implicit none (type, external)
   private

   integer, parameter :: room = 12                     ! solutions that are kept
   real(dp), parameter :: least_pivot = 1e-8_dp        ! of normal equations whose diagonal is 1

   type, public :: step_systems_t
      private
      type(gmres_t) :: gmres
      type(kept_factors_t) :: kept
      real(dp), allocatable :: right(:, :), solution(:, :)   ! right sides of length 1 and solutions, latest first
      integer :: known = 0                                   ! so many, of which
      integer :: exact = 0                                   ! these are of the present step
   contains
      procedure :: begin_step
      procedure :: solve
   end type step_systems_t

contains

   !> Go on to the matrix of another step, which is set in the linear system.
   subroutine begin_step(self)
      class(step_systems_t), intent(inout) :: self
      call self%kept%begin(may_keep=.true.)
      self%exact = 0
   end subroutine begin_step

   !> x with |b - A x| <= tolerance times the largest right side of the sequence.
   subroutine solve(self, linear, levels, b, tolerance, largest, x, status, steps)
      class(step_systems_t), intent(inout) :: self
      class(linearised_contact_t), intent(inout) :: linear
      type(level_t), intent(in) :: levels(:)
      real(dp), intent(in), contiguous :: b(:)
      real(dp), intent(in) :: tolerance
      real(dp), intent(inout) :: largest               !! norm of a right side of this sequence so far; 0: none
      real(dp), intent(out), contiguous :: x(:)
      integer, intent(out) :: status, steps            !! the latter of GMRES
      real(dp), allocatable :: rest(:)
      real(dp) :: error
      integer :: m

      if (.not. allocated(self%right)) allocate (self%right(size(b), room), self%solution(size(b), room))
      largest = max(largest, norm2(b))
      error = tolerance*sqrt(largest*norm2(b))
      steps = 0
      x = 0
      rest = b
      do m = 1, self%exact
         call take(self, m, dot_product(self%right(:, m), rest), x, rest)
      end do
      if (norm2(rest) > error .and. self%known > self%exact) call guess(self, linear, b, x, rest)
      if (norm2(rest) > error) then
         call correct(self, linear, levels, b, error, x, rest, status, steps)
         call keep(self, b, x)
      else
         status = merge(status_converged, status_not_finite, norm2(rest) <= error)
      end if
   end subroutine solve

   !> Add a multiple of a known solution.
   pure subroutine take(self, m, weight, x, rest)
      class(step_systems_t), intent(in) :: self
      integer, intent(in) :: m
      real(dp), intent(in) :: weight
      real(dp), intent(inout) :: x(:), rest(:)
      x = x + weight*self%solution(:, m)
      rest = rest - weight*self%right(:, m)
   end subroutine take

   !> Add the known solutions whose right sides are nearest to the rest, if that makes it smaller: the matrices of
   !> earlier steps were others.
   subroutine guess(self, linear, b, x, rest)
      class(step_systems_t), intent(inout) :: self
      class(linearised_contact_t), intent(inout) :: linear
      real(dp), intent(in), contiguous :: b(:)
      real(dp), intent(inout) :: x(:), rest(:)
      real(dp) :: matrix(self%known, self%known), share(self%known)
      real(dp), allocatable :: image(:), y(:)
      integer :: m, used
      logical :: is_solved

      allocate (image, y, mold=b)
      matrix = matmul(transpose(self%right(:, :self%known)), self%right(:, :self%known))
      do used = self%known, 1, -1
         call solve_small(matrix(:used, :used), matmul(rest, self%right(:, :used)), least_pivot, &
                          share(:used), is_solved)
         if (is_solved) exit
      end do
      if (used == 0) return
      y = x
      do m = 1, used
         y = y + share(m)*self%solution(:, m)
      end do
      call linear%drop_known(y)
      call linear%multiply(y, image)
      image = b - image
      if (.not. norm2(image) < norm2(rest)) return
      x = y
      rest = image
   end subroutine guess

   !> Solve for the rest with the kept factors, then, where these are worn, with new ones.
   subroutine correct(self, linear, levels, b, error, x, rest, status, steps)
      class(step_systems_t), intent(inout) :: self
      class(linearised_contact_t), intent(inout) :: linear
      type(level_t), intent(in) :: levels(:)
      real(dp), intent(in), contiguous :: b(:)
      real(dp), intent(in) :: error                    !! allowed norm of the rest
      real(dp), intent(inout), contiguous :: x(:), rest(:)
      integer, intent(out) :: status, steps
      real(dp), allocatable :: change(:)
      real(dp) :: factors_end, start
      integer :: rung

      allocate (change, mold=b)
      steps = 0
      associate (gmres => self%gmres)
         if (self%kept%serve(1)) then
            start = work_of(levels)
            linear%largest_work = start + self%kept%worth(error/norm2(rest))
            call gmres%solve(linear, rest, change, error/norm2(rest))
            linear%largest_work = huge(linear%largest_work)
            call self%kept%note_old(work_of(levels) - start, gmres%reduction)
            steps = gmres%steps
            status = outcome()
            if (status == status_not_finite) return
            x = x + change
            if (status == status_converged) return
            call linear%multiply(x, change)
            rest = b - change
         end if
         do rung = 1, size(diagonal_shift)
            start = work_of(levels)
            call linear%factorise(rung)
            factors_end = work_of(levels)
            call gmres%solve(linear, rest, change, error/norm2(rest))
            steps = steps + gmres%steps
            status = outcome()
            call self%kept%note_new(merge(1, 0, rung == 1), factors_end - start, work_of(levels) - factors_end, &
               gmres%reduction)
            if (status == status_converged) exit
         end do
         x = x + change
      end associate

   contains

      integer function outcome()
         outcome = merge(status_converged, status_stalled, self%gmres%reduction*norm2(rest) <= error)
         if (self%gmres%steps == 0) outcome = status_not_finite
      end function outcome

   end subroutine correct

   !> Keep a solution of the present step.
   subroutine keep(self, b, x)
      class(step_systems_t), intent(inout) :: self
      real(dp), intent(in) :: b(:), x(:)
      integer :: m

      self%known = min(self%known + 1, room)
      self%exact = min(self%exact + 1, room)
      do m = self%known, 2, -1
         self%right(:, m) = self%right(:, m - 1)
         self%solution(:, m) = self%solution(:, m - 1)
      end do
      self%right(:, 1) = b/norm2(b)
      self%solution(:, 1) = x/norm2(b)
   end subroutine keep

end module ehlwave_step_systems
