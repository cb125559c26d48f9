!> Coefficients of the flow at a state.
module ehlwave_flow
   use ehlwave_face_flow, only: face_flow_t, new_face_flow, node_oil_t
   use ehlwave_film_flow, only: film_flow_t
   use ehlwave_grid, only: grid_t
   use ehlwave_kinds, only: dp
   use ehlwave_real_transfer, only: inject
   use ehlwave_rheology, only: rheology_t
   implicit none (type, external)
   private
   public :: new_flow

   !> A state, the oil there, the coefficients of its flow and their derivatives. All arrays (0:nx, 0:ny). The flow of
   !> a generalised Newtonian oil is not eps times a gradient: it has fluxes through faces in place of it.
   type, extends(node_oil_t), public :: flow_t
      real(dp), allocatable :: f(:, :)      !! rho H
      real(dp), allocatable :: eps(:, :)    !! rho H^3/(eta lambdabar)
      real(dp), allocatable :: f_p(:, :)    !! d(rho H)/dP at fixed H; by H it is rho
      real(dp), allocatable :: eps_p(:, :)  !! d eps/dP at fixed H
      real(dp), allocatable :: eps_h(:, :)  !! d eps/dH
      type(face_flow_t), allocatable :: along_x, along_y     !! through faces along X and along Y; not of a Newtonian oil
      type(film_flow_t), allocatable, private :: film        ! the law of flow across the film; not of a Newtonian oil
   contains
      procedure :: evaluate
      procedure :: evaluate_faces
      procedure :: is_newtonian
      procedure :: mobility
      procedure :: inject_from
   end type flow_t

contains

   !> Work space for a grid.
   pure function new_flow(grid) result(self)
      type(grid_t), intent(in) :: grid
      type(flow_t) :: self
      real(dp), allocatable :: zero(:, :)
      allocate (zero(0:grid%nx, 0:grid%ny), source=0.0_dp)
      allocate (self%p, self%h, self%rho, self%drho, self%fluidity, self%dln_eta, source=zero)
      allocate (self%f, self%f_p, self%eps, self%eps_p, self%eps_h, source=zero)
   end function new_flow

   !> Values of the next finer grid, at the nodes of this one, and the fluxes that they drive through its faces.
   pure subroutine inject_from(self, fine, coarse, kappa)
      class(flow_t), intent(inout) :: self
      type(flow_t), intent(in) :: fine
      type(grid_t), intent(in) :: coarse   !! this grid
      real(dp), intent(in) :: kappa
      call inject(coarse, fine%p, self%p)
      call inject(coarse, fine%f, self%f)
      call inject(coarse, fine%eps, self%eps)
      call inject(coarse, fine%f_p, self%f_p)
      call inject(coarse, fine%rho, self%rho)
      call inject(coarse, fine%eps_p, self%eps_p)
      call inject(coarse, fine%eps_h, self%eps_h)
      if (allocated(self%film)) deallocate (self%film)
      if (fine%is_newtonian()) return
      call inject(coarse, fine%h, self%h)
      call inject(coarse, fine%drho, self%drho)
      call inject(coarse, fine%fluidity, self%fluidity)
      call inject(coarse, fine%dln_eta, self%dln_eta)
      call self%evaluate_faces(fine%film, coarse, kappa)
   end subroutine inject_from

   !> Coefficients at pressure p and film h.
   pure subroutine evaluate(self, rheology, lambdabar, p, h)
      class(flow_t), intent(inout) :: self
      type(rheology_t), intent(in) :: rheology
      real(dp), intent(in) :: lambdabar             !! dimensionless speed parameter
      real(dp), intent(in), contiguous :: p(0:, 0:)   !! P, (0:nx, 0:ny)
      real(dp), intent(in), contiguous :: h(0:, 0:)   !! H > 0, (0:nx, 0:ny)
      integer :: i, j

      if (allocated(self%film)) deallocate (self%film)
      self%p = p
      self%h = h
      call rheology%evaluate(size(p), p, self%rho, self%drho, self%fluidity, self%dln_eta)
      do j = 0, ubound(p, 2)
         do i = 0, ubound(p, 1)
            self%f(i, j) = self%rho(i, j)*h(i, j)
            self%f_p(i, j) = self%drho(i, j)*h(i, j)
            self%eps(i, j) = self%rho(i, j)*h(i, j)**3*self%fluidity(i, j)/lambdabar
            self%eps_p(i, j) = self%eps(i, j)*(self%drho(i, j)/self%rho(i, j) - self%dln_eta(i, j))
            self%eps_h(i, j) = 3*self%eps(i, j)/h(i, j)
         end do
      end do
   end subroutine evaluate

   !> Fluxes of a generalised Newtonian oil, after `evaluate`.
   pure subroutine evaluate_faces(self, film, grid, kappa)
      class(flow_t), intent(inout) :: self
      type(film_flow_t), intent(in) :: film    !! the law of flow across the film
      type(grid_t), intent(in) :: grid
      real(dp), intent(in) :: kappa

      self%film = film
      if (.not. allocated(self%along_x)) then
         self%along_x = new_face_flow(grid)
         self%along_y = self%along_x
      end if
      call self%along_x%evaluate_x(grid, kappa, film, self%node_oil_t)
      call self%along_y%evaluate_y(grid, kappa, film, self%node_oil_t)
   end subroutine evaluate_faces

   !> Whether the flow last evaluated is eps times a gradient.
   pure logical function is_newtonian(self)
      class(flow_t), intent(in) :: self
      is_newtonian = .not. allocated(self%film)
   end function is_newtonian

   !> How easily a pressure gradient along X drives oil at each node: eps, or what stands in its place.
   pure function mobility(self) result(eps)
      class(flow_t), intent(in) :: self
      real(dp), allocatable :: eps(:, :)   !! (0:nx, 0:ny)
      integer :: nx

      eps = self%eps
      if (self%is_newtonian()) return
      nx = ubound(self%p, 1)
      eps(1:nx - 1, :) = 0.25_dp*(self%along_x%own(0:nx - 2, :) + self%along_x%own(1:nx - 1, :))
   end function mobility

end module ehlwave_flow
