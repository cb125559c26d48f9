!> Coefficients of the flow at a state.
module ehlwave_flow
   use ehlwave_face_flow, only: face_flow_t, new_face_flow, node_oil_t
   use ehlwave_film_flow, only: film_flow_t
   use ehlwave_film_heat, only: film_heat_t
   use ehlwave_fitted_flux, only: fit_faces
   use ehlwave_grid, only: grid_t
   use ehlwave_kinds, only: dp
   use ehlwave_raised_flux, only: raise_order
   use ehlwave_real_transfer, only: inject
   use ehlwave_rheology, only: block_size, rheology_t
   use ehlwave_threads, only: is_shared
   implicit none (type, external)
   private
   public :: new_flow

   !> A state, the oil there, the coefficients of its flow and their derivatives. All arrays (0:nx, 0:ny). The flow of
   !> a generalised Newtonian oil is not eps times a gradient: it has fluxes through faces instead. So does a
   !> Newtonian oil with the fitted scheme.
   type, extends(node_oil_t), public :: flow_t
      real(dp), allocatable :: f(:, :)      !! rho H
      real(dp), allocatable :: eps(:, :)    !! rho H^3/(eta lambdabar)
      real(dp), allocatable :: f_p(:, :)    !! d(rho H)/dP at fixed H; by H it is rho
      real(dp), allocatable :: eps_p(:, :)  !! d eps/dP at fixed H
      real(dp), allocatable :: eps_h(:, :)  !! d eps/dH
      type(face_flow_t), allocatable :: along_x, along_y     !! through faces along X and along Y; not of a Newtonian
                                                             !! oil whose eps is averaged
      logical, private :: has_faces = .false.                ! whether these belong to the state
   contains
      procedure :: evaluate
      procedure :: evaluate_faces
      procedure :: fit
      procedure :: has_face_fluxes
      procedure :: is_raised_across
      procedure :: mobility
      procedure :: fall_along
      procedure :: inject_from
      procedure :: keep_changes
      procedure :: film_work
   end type flow_t

   real(dp), parameter :: slight = 1e-6_dp   !! share of the gradient-driven flow

contains

   !> How much the pressure falls along X next to each node inside a row, as a change of ln(eps) at fixed film.
   pure function fall_along(self, j) result(fall)
      class(flow_t), intent(in) :: self
      integer, intent(in) :: j                     !! row
      real(dp) :: fall(ubound(self%p, 1) - 1)
      associate (n => size(fall))
         fall = max(0.0_dp, self%p(:n - 1, j) - self%p(1:n, j), self%p(1:n, j) - self%p(2:, j))* &
                abs(self%eps_p(1:n, j))/max(self%eps(1:n, j), tiny(1.0_dp))
      end associate
   end function fall_along

   !> Work space for a grid.
   function new_flow(grid) result(self)
      type(grid_t), intent(in) :: grid
      type(flow_t) :: self
      call grid%new_field(self%p)
      call grid%new_field(self%h)
      call grid%new_field(self%rho)
      call grid%new_field(self%drho)
      call grid%new_field(self%fluidity)
      call grid%new_field(self%dln_eta)
      call grid%new_field(self%f)
      call grid%new_field(self%f_p)
      call grid%new_field(self%eps)
      call grid%new_field(self%eps_p)
      call grid%new_field(self%eps_h)
   end function new_flow

   !> Values of the next finer grid, at the nodes of this one, and through its faces: needed for linear changes.
   subroutine inject_from(self, fine, coarse)
      class(flow_t), intent(inout) :: self
      type(flow_t), intent(in) :: fine
      type(grid_t), intent(in) :: coarse   !! this grid

      call inject(coarse, fine%p, self%p)
      call inject(coarse, fine%eps, self%eps)
      call inject(coarse, fine%f_p, self%f_p)
      call inject(coarse, fine%rho, self%rho)
      call inject(coarse, fine%eps_p, self%eps_p)
      call inject(coarse, fine%eps_h, self%eps_h)
      self%has_faces = .not. thins_little(fine)
      if (.not. self%has_faces) return
      call make_faces(self, coarse)
      call self%along_x%join_x(fine%along_x, coarse%row_ratio)
      if (.not. coarse%is_line) call self%along_y%join_y(fine%along_y)
   end subroutine inject_from

   !> Free all that an evaluation needs and linear changes do not.
   subroutine keep_changes(self)
      class(flow_t), intent(inout) :: self
      deallocate (self%h, self%drho, self%fluidity, self%dln_eta, self%f)
   end subroutine keep_changes

   !> Coefficients at pressure p and film h.
   subroutine evaluate(self, rheology, lambdabar, p, h, heat)
      class(flow_t), intent(inout) :: self
      type(rheology_t), intent(in) :: rheology
      real(dp), intent(in) :: lambdabar             !! dimensionless speed parameter
      real(dp), intent(in), contiguous :: p(0:, 0:)   !! P, (0:nx, 0:ny)
      real(dp), intent(in), contiguous :: h(0:, 0:)   !! H > 0, (0:nx, 0:ny)
      type(film_heat_t), intent(in), optional :: heat
      integer :: i, j

      self%has_faces = .false.
      if (present(heat)) then
         call evaluate_oil(self, rheology, size(p), p, heat%mean_rise)
      else
         call evaluate_oil(self, rheology, size(p), p)
      end if
      !$omp parallel do private(i) schedule(static) if (is_shared(size(p)))
      do j = 0, ubound(p, 2)
         self%p(:, j) = p(:, j)
         self%h(:, j) = h(:, j)
         do i = 0, ubound(p, 1)
            self%f(i, j) = self%rho(i, j)*h(i, j)
            self%f_p(i, j) = self%drho(i, j)*h(i, j)
            self%eps(i, j) = self%rho(i, j)*h(i, j)**3*self%fluidity(i, j)/lambdabar
            self%eps_p(i, j) = self%eps(i, j)*(self%drho(i, j)/self%rho(i, j) - self%dln_eta(i, j))
            self%eps_h(i, j) = 3*self%eps(i, j)/h(i, j)
         end do
      end do
   end subroutine evaluate

   !> Density and fluidity at pressure p: blocks of nodes as the laws are asked for, so that values do not depend on who
   !> asks.
   subroutine evaluate_oil(self, rheology, n, p, rise_k)
      type(flow_t), intent(inout) :: self
      type(rheology_t), intent(in) :: rheology
      integer, intent(in) :: n                      !! nodes
      real(dp), intent(in) :: p(n)                  !! P
      real(dp), intent(in), optional :: rise_k(n)   !! T - T0, K
      integer :: first, m, width

      width = size(self%rho, 1)
      !$omp parallel do private(m) schedule(static) if (is_shared(n))
      do first = 1, n, block_size
         m = min(block_size, n - first + 1)
         associate (i => modulo(first - 1, width), j => (first - 1)/width)
            if (present(rise_k)) then
               call rheology%evaluate(m, p(first), self%rho(i, j), self%drho(i, j), self%fluidity(i, j), &
                                      self%dln_eta(i, j), rise_k(first))
            else
               call rheology%evaluate(m, p(first), self%rho(i, j), self%drho(i, j), self%fluidity(i, j), &
                                      self%dln_eta(i, j))
            end if
         end associate
      end do
   end subroutine evaluate_oil

   !> Fluxes of a generalised Newtonian oil, after `evaluate`.
   subroutine evaluate_faces(self, film, grid, kappa, heat)
      class(flow_t), intent(inout) :: self
      type(film_flow_t), intent(in) :: film    !! the law of flow across the film
      type(grid_t), intent(in) :: grid
      real(dp), intent(in) :: kappa
      type(film_heat_t), intent(in), optional :: heat

      call make_faces(self, grid)
      self%has_faces = .true.
      call self%along_x%evaluate_x(grid, kappa, film, self%node_oil_t, heat)
      call self%along_y%evaluate_y(grid, kappa, film, self%node_oil_t, heat)
      if (grid%is_fitted) call raise_order(self%along_x, self%along_y, grid, self%h)
   end subroutine evaluate_faces

   !> Fitted fluxes of a Newtonian oil, after `evaluate`: theory eq. (D11).
   subroutine fit(self, grid, lambdabar)
      class(flow_t), intent(inout) :: self
      type(grid_t), intent(in) :: grid
      real(dp), intent(in) :: lambdabar             !! dimensionless speed parameter
      call make_faces(self, grid)
      self%has_faces = .true.
      call fit_faces(grid, lambdabar, self%node_oil_t, self%along_x, self%along_y)
      call raise_order(self%along_x, self%along_y, grid, self%h)
   end subroutine fit

   !> Whether stresses thin the oil so little that a preconditioner may use Newtonian linear changes. The measure is the
   !> flow driven by a pressure gradient along X through the faces, eps_1 + eps_2 of a Newtonian oil.
   pure logical function thins_little(self)
      class(flow_t), intent(in) :: self
      integer :: n
      thins_little = .not. self%has_faces
      if (thins_little) return
      n = ubound(self%eps, 1)
      associate (eps => self%eps, own => self%along_x%own(:n - 1, :))
         thins_little = all(abs(own - eps(:n - 1, :) - eps(1:, :)) <= slight*own .or. .not. own > 0)   ! 0 on known rows
      end associate
   end function thins_little

   !> Work space for faces, where there is none.
   subroutine make_faces(self, grid)
      type(flow_t), intent(inout) :: self
      type(grid_t), intent(in) :: grid
      if (allocated(self%along_x)) return
      self%along_x = new_face_flow(grid)
      self%along_y = self%along_x
   end subroutine make_faces

   !> Operations that the flow across the film took when last evaluated, see `ehlwave_work_unit`; 0 of a Newtonian oil
   !> whose eps is averaged.
   pure real(dp) function film_work(self)
      class(flow_t), intent(in) :: self
      film_work = 0
      if (self%has_faces) film_work = self%along_x%work + self%along_y%work
   end function film_work

   !> Whether the flow last evaluated is that through faces, not eps times a gradient.
   pure logical function has_face_fluxes(self)
      class(flow_t), intent(in) :: self
      has_face_fluxes = self%has_faces
   end function has_face_fluxes

   !> Whether fluxes along Y are raised, see `ehlwave_raised_flux`.
   pure logical function is_raised_across(self)
      class(flow_t), intent(in) :: self
      is_raised_across = self%has_faces
      if (is_raised_across) is_raised_across = self%along_y%is_raised
   end function is_raised_across

   !> How easily a pressure gradient along X drives oil at each node: eps, or its replacement.
   pure function mobility(self) result(eps)
      class(flow_t), intent(in) :: self
      real(dp), allocatable :: eps(:, :)   !! (0:nx, 0:ny)
      integer :: nx

      eps = self%eps
      if (.not. self%has_faces) return
      nx = ubound(self%p, 1)
      eps(1:nx - 1, :) = 0.25_dp*(self%along_x%own(0:nx - 2, :) + self%along_x%own(1:nx - 1, :))
   end function mobility

end module ehlwave_flow
