!> Rows of the near stencil against the dense Jacobian restricted to their pattern.
program test_near_stencil
   use ehlwave_contact_problem, only: contact_problem_t
   use ehlwave_grid, only: grid_t
   use ehlwave_kinds, only: dp
   use ehlwave_near_stencil, only: near_stencil_t, new_near_stencil
   use ehlwave_reynolds, only: flow_t, new_flow, reynolds_jacobian
   use ehlwave_text, only: to_text
   use ehlwave_transport, only: characteristic_transport
   use sample_contact, only: bump_pressure, make_contact
   use testing, only: test_t
   implicit none (type, external)

   integer, parameter :: nx = 12, ny = 12
   type(test_t) :: test

   call compare(1.0_dp, .false., .false.)
   call compare(1.0_dp, .true., .false.)
   call compare(0.12_dp, .false., .true.)
   call compare(0.12_dp, .true., .true.)
   call check_reach()
   call test%finish()

contains

   !> State and flow coefficients of a pressure that is even in Y.
   subroutine linearise(problem, flow, p, is_transient)
      type(contact_problem_t), intent(inout) :: problem
      type(flow_t), intent(out) :: flow
      real(dp), allocatable, intent(out) :: p(:, :)
      logical, intent(in) :: is_transient
      real(dp), allocatable :: h(:, :)
      associate (grid => problem%grid)
         if (is_transient) problem%transport = characteristic_transport(grid, 2, 1)
         allocate (p(0:grid%nx, 0:grid%ny), h(0:grid%nx, 0:grid%ny))
         p = 0.5_dp*bump_pressure(grid)
         call problem%film(p, -0.2_dp, h)
         flow = new_flow(grid)
         call flow%evaluate(problem%rheology, problem%conditions%lambdabar, p, h)
      end associate
   end subroutine linearise

   !> jacobian(:, :, i, j): change of the residual under unit pressure at node (i, j), whole domain.
   subroutine dense(problem, flow, p, jacobian)
      type(contact_problem_t), intent(inout) :: problem
      type(flow_t), intent(in) :: flow
      real(dp), intent(in) :: p(0:, 0:)
      real(dp), intent(out) :: jacobian(0:, 0:, 0:, 0:)
      real(dp), allocatable, dimension(:, :) :: change, dh, work
      integer :: i, j
      allocate (change(0:nx, 0:ny), dh(0:nx, 0:ny), work(0:nx, 0:ny), source=0.0_dp)
      do j = 0, ny
         do i = 0, nx
            change = 0
            change(i, j) = 1
            call problem%deformation%apply(change, dh)
            call reynolds_jacobian(problem%grid, problem%transport, problem%conditions%elliptic%kappa, flow, p, change, dh, &
                                   jacobian(:, :, i, j), work)
         end do
      end do
   end subroutine dense

   !> On a half domain what falls on a row below the line of symmetry belongs to its mirror image.
   subroutine compare(d, is_half, is_transient)
      real(dp), intent(in) :: d
      logical, intent(in) :: is_half, is_transient
      type(contact_problem_t) :: problem, whole
      type(flow_t) :: flow, flow_whole
      type(near_stencil_t) :: stencil
      real(dp), allocatable :: expected(:), jacobian(:, :, :, :), p(:, :), p_whole(:, :), line(:, :)
      integer :: i, j, jj, low, n, target_i, target_j

      call make_contact(whole, 100.0_dp, d, nx, ny, .false.)
      call linearise(whole, flow_whole, p_whole, is_transient)
      allocate (jacobian(0:nx, 0:ny, 0:nx, 0:ny))
      call dense(whole, flow_whole, p_whole, jacobian)
      call make_contact(problem, 100.0_dp, d, nx, ny, is_half)
      call linearise(problem, flow, p, is_transient)
      low = merge(ny/2, 0, is_half)
      associate (grid => problem%grid, elliptic => problem%conditions%elliptic)
         stencil = new_near_stencil(grid, elliptic%kappa, elliptic%k, 3, 0.0_dp)
         allocate (line(nx - 1, stencil%entries), expected(stencil%entries))
         do j = grid%first_row, grid%ny - 1
            call stencil%fill_line(grid, problem%transport, elliptic%kappa, flow, p, j, line)
            do i = 1, nx - 1
               expected = 0
               do n = 1, stencil%entries
                  target_i = i + stencil%di(n)
                  target_j = j + stencil%dj(n)
                  if (target_i < 1 .or. target_i > nx - 1 .or. target_j + low < 1 .or. target_j > grid%ny - 1) cycle
                  jj = target_j
                  if (is_half) jj = abs(target_j)
                  associate (place => stencil%entry_at(stencil%di(n), jj - j))
                     expected(place) = expected(place) + jacobian(i, j + low, target_i, target_j + low)
                  end associate
               end do
               call test%check_close(line(i, :), expected, 'row '//to_text(i)//' '//to_text(j)//', D = '//to_text(d, 3)// &
                                     ', half '// &
                                     to_text(is_half), absolute=1e-11_dp*maxval(abs(expected)))
            end do
         end do
      end associate
   end subroutine compare

   subroutine check_reach()
      type(contact_problem_t) :: problem
      type(near_stencil_t) :: stencil
      call make_contact(problem, 100.0_dp, 0.04_dp, 32, 32, .false.)
      stencil = new_near_stencil(problem%grid, problem%conditions%elliptic%kappa, problem%conditions%elliptic%k, 5, 0.0_dp)
      call test%check(stencil%reach_x == 5 .and. stencil%reach_y == 1, 'slender contact: reach along X is limited')
      call test%check(stencil%entries == 11*3, 'entries')
      call test%check(stencil%entry_at(stencil%di(7), stencil%dj(7)) == 7, 'entries and offsets belong together')
   end subroutine check_reach

end program test_near_stencil
