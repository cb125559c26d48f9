!> Transposed products, preconditioners and solutions of the linearised contact against the direct ones.
program test_transposed
   use ehlwave_full_multigrid, only: full_multigrid_t
   use ehlwave_harmonic_response, only: harmonic_response_t
   use ehlwave_harmonic_solver, only: harmonic_solver_t
   use ehlwave_hierarchy, only: work_of
   use ehlwave_kinds, only: dp
   use ehlwave_status, only: status_converged
   use ehlwave_steady_tangent, only: steady_adjoint_t, steady_tangent_t, tangent_change_t
   use sample_contact, only: noise, solve_sample
   use testing, only: test_t
   implicit none (type, external)

   type(test_t) :: test
   real(dp), parameter :: single = 1e-5_dp   !! preconditioners are in single precision

   call real_system(test, 'half domain', .true.)
   call real_system(test, 'whole domain', .false.)
   call real_system(test, 'fitted', .true., is_fitted=.true.)
   call complex_system(test, 'half domain', .true.)
   call complex_system(test, 'whole domain', .false.)
   call complex_system(test, 'fitted', .true., is_fitted=.true.)
   call test%finish()

contains

   !> The steady system. The gap at one node moves; the film there is the result.
   subroutine real_system(test, what, is_half, is_fitted)
      type(test_t), intent(inout) :: test
      character(len=*), intent(in) :: what
      logical, intent(in) :: is_half
      logical, intent(in), optional :: is_fitted   !! scheme; absent: averaged
      type(full_multigrid_t) :: multigrid
      type(steady_tangent_t) :: tangent
      type(steady_adjoint_t) :: adjoint
      type(tangent_change_t) :: change
      real(dp), allocatable :: b(:), dr(:, :), h(:, :), x(:), y(:), ax(:), aty(:)
      real(dp) :: work
      integer :: i

      call solve_sample(multigrid, is_half, is_fitted)
      call tangent%init(multigrid%levels)
      associate (levels => multigrid%levels, linear => tangent%linear, grid => multigrid%levels(2)%problem%grid)
         call grid%new_field(h)
         call grid%new_field(dr)
         h(24, grid%ny/2) = 1
         call linear%borrow(levels)
         call linear%gap_change(h, dr)
         b = [reshape(dr, [size(dr)]), 0.3_dp]
         call tangent%solve(levels, b, 1e-9_dp, change)         ! makes the factors
         work = -work_of(levels)
         call tangent%solve(levels, b, 1e-9_dp, change)
         work = work + work_of(levels)
         call tangent%solve_transposed(levels, 0*h, h, 1e-9_dp, adjoint)
         call test%check(adjoint%status == status_converged, what//': transposed solve converges')
         call test%check_close(dot_product(adjoint%vector, b), change%state%h(24, grid%ny/2), what//': transposed solve', &
                               relative=1e-6_dp)
         call test%check(adjoint%work < 1.2_dp*work, what//': it costs at most 1.2 direct solves')
         call linear%borrow(levels)
         allocate (ax(linear%n), aty(linear%n), y(linear%n))
         y = [(noise(i, 3), i=1, linear%n)]
         call linear%precondition(y(linear%n:1:-1), ax)         ! zero where the pressure is known,
         x = merge(0*ax, ax, [reshape(linear%levels(2)%equations%is_cavitated, [linear%n - 1]), .false.])
         call linear%multiply(x, ax)
         linear%is_transposed = .true.
         call linear%multiply(y, aty)
         call test%check_close(dot_product(x, aty), dot_product(y, ax), what//': transposed product', relative=1e-9_dp)
         call linear%precondition(x, aty)
         linear%is_transposed = .false.
         call linear%precondition(y, ax)
         call test%check_close(dot_product(y, aty), dot_product(x, ax), what//': transposed preconditioner', relative=single)
         call linear%release()
      end associate
   end subroutine real_system

   !> The system of a wave.
   subroutine complex_system(test, what, is_half, is_fitted)
      type(test_t), intent(inout) :: test
      character(len=*), intent(in) :: what
      logical, intent(in) :: is_half
      logical, intent(in), optional :: is_fitted   !! scheme; absent: averaged
      type(full_multigrid_t) :: multigrid
      type(harmonic_response_t) :: response
      type(harmonic_solver_t) :: solver
      complex(dp), allocatable :: x(:), y(:), ax(:), aty(:), dr(:, :), gap(:, :)
      real(dp), allocatable :: centre(:, :)
      real(dp) :: work
      integer :: i, status

      call solve_sample(multigrid, is_half, is_fitted)
      call solver%init(multigrid%levels)
      associate (levels => multigrid%levels, linear => solver%linear)
         call solver%set_frequency(levels, 4.0_dp, (0.2_dp, 0.1_dp), is_real=.false.)
         call linear%borrow(levels)
         allocate (ax(linear%n), aty(linear%n), y(linear%n))
         y = [(cmplx(noise(i, 3), noise(3, i), dp), i=1, linear%n)]
         call linear%precondition(y(linear%n:1:-1), ax)
         x = merge(0*ax, ax, [reshape(linear%levels(2)%equations%is_cavitated, [linear%n - 1]), .false.])
         call linear%multiply(x, ax)
         linear%is_transposed = .true.
         call linear%multiply(y, aty)
         call test%check_close(abs(sum(x*aty) - sum(y*ax))/abs(sum(y*ax)), 0.0_dp, what//': transposed complex product', &
                               absolute=1e-9_dp)
         call linear%precondition(x, aty)
         linear%is_transposed = .false.
         call linear%precondition(y, ax)
         call test%check_close(abs(sum(y*aty) - sum(x*ax))/abs(sum(x*ax)), 0.0_dp, &
                               what//': transposed complex preconditioner', absolute=single)
         call linear%release()
         allocate (gap(0:48, 0:ubound(levels(2)%state%h, 2)), source=(0.0_dp, 0.0_dp))
         allocate (dr, mold=gap)
         gap(20, 3) = (1.0_dp, 0.5_dp)
         call linear%borrow(levels)
         call linear%gap_change(gap, dr)
         call linear%release()
         ax = [reshape(dr, [size(dr)]), (0.1_dp, 0.3_dp)]
         solver%tolerance = 1e-8_dp
         work = work_of(levels)
         x = ax
         call solver%respond_to(levels, x, response)
         work = work_of(levels) - work
         call levels(2)%problem%grid%new_field(centre)
         centre(24, ubound(centre, 2)/2) = 1
         work = 1.2_dp*work + work_of(levels)
         call solver%respond_transposed(levels, centre, y, status)
         call test%check(work_of(levels) <= work, what//': it costs at most 1.2 direct solves')
         call test%check(status == status_converged .and. response%status == status_converged, &
                         what//': responses converge')
         call test%check_close(abs(sum(y*ax) - response%h(24, ubound(centre, 2)/2))/abs(response%h(24, ubound(centre, 2)/2)), &
                               0.0_dp, what//': transposed response', absolute=1e-6_dp)
      end associate
   end subroutine complex_system

end program test_transposed
