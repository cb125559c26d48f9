!> Rows of the near part of the Jacobian against the dense Jacobian restricted to their pattern.
program test_near_rows
   use ehlwave_contact_problem, only: contact_problem_t
   use ehlwave_flow, only: flow_t, new_flow
   use ehlwave_kinds, only: dp
   use ehlwave_mesh, only: new_mesh
   use ehlwave_near_kernel, only: near_kernel_t, near_settings_t, new_near_kernel
   use ehlwave_real_near_rows, only: near_links_t, near_rows
   use ehlwave_reynolds, only: reynolds_change
   use ehlwave_text, only: to_text
   use ehlwave_transport, only: characteristic_transport, steady_transport, transport_t
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
   subroutine linearise(problem, flow, transport, is_transient)
      type(contact_problem_t), intent(inout) :: problem
      type(flow_t), intent(out) :: flow
      type(transport_t), intent(out) :: transport
      logical, intent(in) :: is_transient
      real(dp), allocatable :: h(:, :), p(:, :)
      associate (grid => problem%grid)
         transport = steady_transport(grid)
         if (is_transient) transport = characteristic_transport(grid, 2, 1)
         allocate (p(0:grid%nx, 0:grid%ny), h(0:grid%nx, 0:grid%ny))
         p = 0.5_dp*bump_pressure(grid)
         call problem%smooth_film(p, -0.2_dp, h)
         flow = new_flow(grid)
         call flow%evaluate(problem%rheology, problem%conditions%lambdabar, p, h)
      end associate
   end subroutine linearise

   !> jacobian(:, :, i, j): change of the residual under unit pressure at node (i, j), whole domain.
   subroutine dense(problem, flow, transport, jacobian)
      type(contact_problem_t), intent(inout) :: problem
      type(flow_t), intent(in) :: flow
      type(transport_t), intent(in) :: transport
      real(dp), intent(out) :: jacobian(0:, 0:, 0:, 0:)
      real(dp), allocatable, dimension(:, :) :: change, dh
      integer :: i, j
      allocate (change(0:nx, 0:ny), dh(0:nx, 0:ny), source=0.0_dp)
      do j = 0, ny
         do i = 0, nx
            change = 0
            change(i, j) = 1
            call problem%deformation%apply(change, dh)
            call reynolds_change(new_mesh(problem%grid, problem%conditions%elliptic%kappa), transport, flow, change, &
                                 dh, jacobian(:, :, i, j))
         end do
      end do
   end subroutine dense

   !> On a half domain entries on a row below the line of symmetry belong to its mirror image.
   subroutine compare(d, is_half, is_transient)
      real(dp), intent(in) :: d
      logical, intent(in) :: is_half, is_transient
      type(contact_problem_t) :: problem, whole
      type(flow_t) :: flow, flow_whole
      type(transport_t) :: transport
      type(near_kernel_t) :: kernel
      real(dp), allocatable :: expected(:), jacobian(:, :, :, :), rows(:, :)
      type(near_links_t) :: links
      integer :: di, dj, i, j, jj, low, target_i, target_j

      call make_contact(whole, 100.0_dp, d, nx, ny, .false.)
      call linearise(whole, flow_whole, transport, is_transient)
      allocate (jacobian(0:nx, 0:ny, 0:nx, 0:ny))
      call dense(whole, flow_whole, transport, jacobian)
      call make_contact(problem, 100.0_dp, d, nx, ny, is_half)
      call linearise(problem, flow, transport, is_transient)
      low = merge(ny/2, 0, is_half)
      associate (grid => problem%grid, elliptic => problem%conditions%elliptic)
         kernel = new_near_kernel(grid, elliptic%kappa, elliptic%k, near_settings_t())
         allocate (rows(grid%first_row:grid%last_row, kernel%entries), expected(kernel%entries))
         do i = 1, nx - 1
            call near_rows(kernel, new_mesh(grid, elliptic%kappa), transport, flow, i, links, rows)
            do j = grid%first_row, grid%last_row
               expected = 0
               do di = -kernel%reach_x, kernel%reach_x
                  do dj = -kernel%reach_y, kernel%reach_y
                     target_i = i + di
                     target_j = j + dj
                     if (target_i < 1 .or. target_i > nx - 1 .or. target_j + low < 1 .or. target_j > grid%last_row) cycle
                     jj = target_j
                     if (is_half) jj = abs(target_j)
                     associate (place => kernel%entry_at(di, jj - j))
                        expected(place) = expected(place) + jacobian(i, j + low, target_i, target_j + low)
                     end associate
                  end do
               end do
               call test%check_close(rows(j, :), expected, 'row '//to_text(i)//' '//to_text(j)//', D = '//to_text(d, 3)// &
                                     ', half '// &
                                     to_text(is_half), absolute=1e-11_dp*maxval(abs(expected)))
            end do
         end do
      end associate
   end subroutine compare

   subroutine check_reach()
      type(contact_problem_t) :: problem
      type(near_kernel_t) :: kernel
      integer :: di, dj, places(17*3)
      call make_contact(problem, 100.0_dp, 0.04_dp, 32, 32, .false.)
      kernel = new_near_kernel(problem%grid, problem%conditions%elliptic%kappa, problem%conditions%elliptic%k, near_settings_t())
      call test%check(kernel%reach_x == 8 .and. kernel%reach_y == 1, 'slender contact: reach along X is limited')
      call test%check(kernel%entries == 17*3, 'entries')
      places = [((kernel%entry_at(di, dj), dj=-1, 1), di=-8, 8)]
      call test%check(all(places == [(di, di=1, 17*3)]), 'entries are numbered with the offset along Y first')
   end subroutine check_reach

end program test_near_rows
