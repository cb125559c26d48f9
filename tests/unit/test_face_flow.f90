!> Fluxes through faces: the Newtonian limit, derivatives, symmetry, line contacts.
program test_face_flow
   use ehlwave_carreau_law, only: new_carreau_law
   use ehlwave_eyring_law, only: eyring_law_t
   use ehlwave_face_flow, only: face_flow_t, new_face_flow, node_oil_t
   use ehlwave_film_flow, only: film_flow_t, new_film_flow
   use ehlwave_fitted_flux, only: fit_faces
   use ehlwave_flow_law, only: flow_law_t
   use ehlwave_grid, only: grid_t, new_grid, new_line_grid
   use ehlwave_kinds, only: dp
   use ehlwave_oil, only: oil_t
   use ehlwave_rheology, only: rheology_t
   use ehlwave_shear_limit, only: new_shear_limit
   use sample_contact, only: rheology_of
   use testing, only: test_t
   implicit none (type, external)

   real(dp), parameter :: lambdabar = 0.02_dp, kappa = 0.6_dp
   integer, parameter :: cells = 8
   type(test_t) :: test
   type(oil_t) :: default
   type(rheology_t) :: rheology

   default%pressure_viscosity_per_pa = 2e-8_dp
   rheology = rheology_of(default, 0.4e9_dp)
   call check_newtonian(new_grid(-2.5_dp, 1.5_dp, 2.0_dp, cells, cells, is_half=.false.))
   call check_newtonian(new_grid(-2.5_dp, 1.5_dp, 2.0_dp, cells, cells, is_half=.true.))
   call check_newtonian(new_line_grid(-2.5_dp, 1.5_dp, cells))
   call check_derivatives(new_grid(-2.5_dp, 1.5_dp, 2.0_dp, cells, cells, is_half=.false.), eyring_law_t())
   call check_derivatives(new_grid(-2.5_dp, 1.5_dp, 2.0_dp, cells, cells, is_half=.true.), eyring_law_t())
   call check_derivatives(new_grid(-2.5_dp, 1.5_dp, 2.0_dp, cells, cells, is_half=.true.), new_carreau_law(0.4_dp))
   call check_derivatives(new_line_grid(-2.5_dp, 1.5_dp, cells), eyring_law_t())
   call check_fitted(new_grid(-2.5_dp, 1.5_dp, 2.0_dp, cells, cells, is_half=.true.))
   call check_half()
   call test%finish()

contains

   !> A pressure that is zero on the boundary and a film, both even in Y.
   function oil_at(grid, step) result(oil)
      type(grid_t), intent(in) :: grid
      real(dp), intent(in) :: step   !! along `change`
      type(node_oil_t) :: oil
      integer :: i, j

      allocate (oil%p(0:grid%nx, 0:grid%ny), source=0.0_dp)
      oil%h = oil%p
      oil%rho = oil%p
      oil%drho = oil%p
      oil%fluidity = oil%p
      oil%dln_eta = oil%p
      do j = 0, grid%ny
         do i = 0, grid%nx
            associate (x => grid%x(i), y => grid%y(j))
               oil%h(i, j) = 0.15_dp + 0.05_dp*x**2 + 0.03_dp*y**2
               oil%p(i, j) = max(0.0_dp, (1 + 0.3_dp*sin(3*x))*(1.5_dp - x)*(x + 2.5_dp)*(4 - y**2)/16)
               if (grid%is_line) oil%p(i, j) = merge((1.5_dp - x)*(x + 2.5_dp)/4, 0.0_dp, j == 0)
            end associate
         end do
      end do
      oil%p = oil%p + step*change(grid, 1)
      oil%h = oil%h + step*change(grid, 2)
      call rheology%evaluate(size(oil%p), oil%p, oil%rho, oil%drho, oil%fluidity, oil%dln_eta)
   end function oil_at

   !> Change of P (1), zero on the boundary, or of H (2), even in Y.
   function change(grid, kind) result(d)
      type(grid_t), intent(in) :: grid
      integer, intent(in) :: kind
      real(dp) :: d(0:grid%nx, 0:grid%ny)
      integer :: i, j
      d = 0
      do j = 0, grid%ny
         do i = 0, grid%nx
            if (kind == 1 .and. (i == 0 .or. i == grid%nx .or. j > grid%last_row .or. j < grid%first_row)) cycle
            d(i, j) = merge(0.3_dp, 0.02_dp, kind == 1)*cos(5*grid%x(i) + kind)*cos(2*grid%y(j) + 0.1_dp*grid%y(j)**2)
         end do
      end do
   end function change

   !> tau0 -> inf: (eps_1 + eps_2) (P_2 - P_1).
   subroutine check_newtonian(grid)
      type(grid_t), intent(in) :: grid
      type(face_flow_t) :: x, y
      type(node_oil_t) :: oil
      type(film_flow_t) :: film
      real(dp) :: eps(0:grid%nx, 0:grid%ny)
      integer :: n, rows

      oil = oil_at(grid, 0.0_dp)
      film = new_film_flow(eyring_law_t(), 1e-9_dp, lambdabar, 1.5_dp)
      x = new_face_flow(grid)
      y = x
      call x%evaluate_x(grid, kappa, film, oil)
      call y%evaluate_y(grid, kappa, film, oil)
      eps = oil%rho*oil%h**3*oil%fluidity/lambdabar
      n = grid%nx
      do rows = grid%first_row, grid%last_row
         associate (j => rows)
            call test%check_close(x%flux(:n - 1, j), (eps(:n - 1, j) + eps(1:, j))*(oil%p(1:, j) - oil%p(:n - 1, j)), &
                                  'Newtonian flux along X', relative=1e-9_dp, absolute=1e-12_dp)
            call test%check_close(x%own(:n - 1, j), eps(:n - 1, j) + eps(1:, j), 'its coefficient', relative=1e-9_dp)
            if (grid%is_line) cycle
            call test%check_close(y%flux(1:n - 1, j), (eps(1:n - 1, j) + eps(1:n - 1, j + 1)) &
                                  *(oil%p(1:n - 1, j + 1) - oil%p(1:n - 1, j)), 'along Y', relative=1e-9_dp, absolute=1e-12_dp)
            call test%check_close(y%own(1:n - 1, j), eps(1:n - 1, j) + eps(1:n - 1, j + 1), 'its coefficient', relative=1e-9_dp)
         end associate
      end do
      if (grid%is_line) call test%check(maxval(abs(y%flux)) <= 0, 'no flow across a line contact')
   end subroutine check_newtonian

   !> Fitted fluxes: tau0 -> inf gives the fluxes of a Newtonian oil; equal nodes give the averaged fluxes; derivatives.
   subroutine check_fitted(given)
      type(grid_t), intent(in) :: given
      type(grid_t) :: grid
      type(face_flow_t) :: x(2), y(2)
      type(node_oil_t) :: oil
      type(film_flow_t) :: film
      integer :: n

      grid = given
      grid%is_fitted = .true.
      call check_derivatives(grid, eyring_law_t())
      call check_derivatives(grid, new_carreau_law(0.4_dp))
      call check_derivatives(grid, eyring_law_t(), limit=5.0_dp)
      n = grid%nx
      oil = oil_at(grid, 0.0_dp)
      x = new_face_flow(grid)
      y = x
      film = new_film_flow(eyring_law_t(), 1e-9_dp, lambdabar, 1.5_dp)
      call x(1)%evaluate_x(grid, kappa, film, oil)
      call y(1)%evaluate_y(grid, kappa, film, oil)
      call fit_faces(grid, lambdabar, oil, x(2), y(2))
      call test%check_close([x(1)%flux(:n - 1, :grid%last_row)], [x(2)%flux(:n - 1, :grid%last_row)], &
                            'fitted Newtonian flux along X', relative=1e-9_dp, absolute=1e-12_dp)
      call test%check_close([y(1)%flux(1:n - 1, :grid%last_row)], [y(2)%flux(1:n - 1, :grid%last_row)], 'along Y', &
                            relative=1e-9_dp, absolute=1e-12_dp)
      call test%check_close([x(1)%own(:n - 1, :grid%last_row)], [x(2)%own(:n - 1, :grid%last_row)], &
                            'its coefficient', relative=1e-9_dp)
      film = new_film_flow(eyring_law_t(), 1.2_dp, lambdabar, 1.5_dp)
      oil%fluidity(:, :) = 0.01_dp
      oil%h(:, :) = 0.2_dp
      call x(1)%evaluate_x(grid, kappa, film, oil)
      call x(2)%evaluate_x(given, kappa, film, oil)
      call test%check_close([x(1)%flux], [x(2)%flux], 'nodes alike', relative=1e-9_dp, absolute=1e-12_dp)
      call test%check_close([x(1)%cross], [x(2)%cross], 'across', relative=1e-9_dp, absolute=1e-12_dp)
   end subroutine check_fitted

   !> Taylor test of all fluxes along changes of P and H.
   subroutine check_derivatives(grid, law, limit)
      type(grid_t), intent(in) :: grid
      class(flow_law_t), intent(in) :: law
      real(dp), intent(in), optional :: limit   !! limit of the stress over tau0 P
      type(face_flow_t) :: x(3), y(3)
      type(film_flow_t) :: film
      real(dp), parameter :: step(3) = [0.0_dp, 2e-3_dp, 1e-3_dp]
      real(dp), allocatable :: dx(:, :), dy(:, :)
      real(dp) :: left(2)
      integer :: k

      film = new_film_flow(law, 1.2_dp, lambdabar, 1.5_dp)
      if (present(limit)) film%limit = new_shear_limit(limit, 0.1_dp)
      do k = 1, 3
         x(k) = new_face_flow(grid)
         y(k) = new_face_flow(grid)
         call x(k)%evaluate_x(grid, kappa, film, oil_at(grid, step(k)))
         call y(k)%evaluate_y(grid, kappa, film, oil_at(grid, step(k)))
      end do
      call changes(grid, x(1), y(1), dx, dy)
      left = [(norm2(x(k)%flux - x(1)%flux - step(k)*dx), k=2, 3)]
      call test%check_close(log(left(1)/left(2))/log(2.0_dp), 2.0_dp, 'observed order along X', absolute=0.05_dp)
      if (grid%is_line) return
      left = [(norm2(y(k)%flux - y(1)%flux - step(k)*dy), k=2, 3)]
      call test%check_close(log(left(1)/left(2))/log(2.0_dp), 2.0_dp, 'observed order along Y', absolute=0.05_dp)
   end subroutine check_derivatives

   !> Changes of the fluxes by their derivatives.
   subroutine changes(grid, x, y, dx, dy)
      type(grid_t), intent(in) :: grid
      type(face_flow_t), intent(in) :: x, y
      real(dp), allocatable, intent(out) :: dx(:, :), dy(:, :)
      real(dp), dimension(0:grid%nx, 0:grid%ny) :: dh, q
      integer :: i, j, jm, jp

      q = change(grid, 1)
      dh = change(grid, 2)
      allocate (dx(0:grid%nx, 0:grid%ny), dy(0:grid%nx, 0:grid%ny), source=0.0_dp)
      do j = grid%first_row, grid%last_row
         jm = grid%below(j)
         jp = grid%above(j)
         do i = 0, grid%nx - 1
            dx(i, j) = x%by_p1(i, j)*q(i, j) + x%by_p2(i, j)*q(i + 1, j) + x%by_h1(i, j)*dh(i, j) + x%by_h2(i, j)*dh(i + 1, j) &
                       + x%own(i, j)*(q(i + 1, j) - q(i, j)) &
                       + x%cross(i, j)*(q(i, jp) - q(i, jm) + q(i + 1, jp) - q(i + 1, jm))
         end do
      end do
      do j = 0, grid%ny - 1
         do i = 1, grid%nx - 1
            dy(i, j) = y%by_p1(i, j)*q(i, j) + y%by_p2(i, j)*q(i, j + 1) + y%by_h1(i, j)*dh(i, j) + y%by_h2(i, j)*dh(i, j + 1) &
                       + y%own(i, j)*(q(i, j + 1) - q(i, j)) &
                       + y%cross(i, j)*(q(i + 1, j) - q(i - 1, j) + q(i + 1, j + 1) - q(i - 1, j + 1))
         end do
      end do
   end subroutine changes

   !> The half domain has the fluxes of the upper half of the whole.
   subroutine check_half()
      type(grid_t) :: half, whole
      type(film_flow_t) :: film
      type(face_flow_t) :: x(2), y(2)
      integer, parameter :: m = cells/2

      half = new_grid(-2.5_dp, 1.5_dp, 2.0_dp, cells, cells, is_half=.true.)
      whole = new_grid(-2.5_dp, 1.5_dp, 2.0_dp, cells, cells, is_half=.false.)
      film = new_film_flow(eyring_law_t(), 1.2_dp, lambdabar, 1.5_dp)
      x = [new_face_flow(half), new_face_flow(whole)]
      y = x
      call x(1)%evaluate_x(half, kappa, film, oil_at(half, 0.0_dp))
      call x(2)%evaluate_x(whole, kappa, film, oil_at(whole, 0.0_dp))
      call y(1)%evaluate_y(half, kappa, film, oil_at(half, 0.0_dp))
      call y(2)%evaluate_y(whole, kappa, film, oil_at(whole, 0.0_dp))
      call test%check_close([x(1)%flux(:, :m - 1)], [x(2)%flux(:, m:2*m - 1)], 'half and whole along X', relative=1e-11_dp, &
                            absolute=1e-14_dp)
      call test%check_close([y(1)%flux(:, :m - 1)], [y(2)%flux(:, m:2*m - 1)], 'half and whole along Y', relative=1e-11_dp, &
                            absolute=1e-14_dp)
      call test%check_close(y(1)%flux(1:cells - 1, 0), -y(2)%flux(1:cells - 1, m - 1), 'mirrored flux', relative=1e-11_dp)
   end subroutine check_half

end program test_face_flow
