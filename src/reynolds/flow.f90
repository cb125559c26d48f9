!> Coefficients of the flow at a state.
module ehlwave_flow
   use ehlwave_grid, only: grid_t
   use ehlwave_kinds, only: dp
   use ehlwave_real_transfer, only: inject
   use ehlwave_rheology, only: rheology_t
   implicit none (type, external)
   private
   public :: new_flow

   !> A state's pressure, the coefficients of the flow there, and their derivatives. All arrays (0:nx, 0:ny).
   type, public :: flow_t
      real(dp), allocatable :: p(:, :)      !! P
      real(dp), allocatable :: f(:, :)      !! rho H
      real(dp), allocatable :: eps(:, :)    !! rho H^3/(eta lambdabar)
      real(dp), allocatable :: f_p(:, :)    !! d(rho H)/dP at fixed H
      real(dp), allocatable :: f_h(:, :)    !! d(rho H)/dH = rho
      real(dp), allocatable :: eps_p(:, :)  !! d eps/dP at fixed H
      real(dp), allocatable :: eps_h(:, :)  !! d eps/dH
      real(dp), allocatable, private :: fluidity(:, :), dln_eta(:, :)
   contains
      procedure :: evaluate
      procedure :: inject_from
   end type flow_t

contains

   !> Work space for a grid.
   pure function new_flow(grid) result(self)
      type(grid_t), intent(in) :: grid
      type(flow_t) :: self
      real(dp), allocatable :: zero(:, :)
      allocate (zero(0:grid%nx, 0:grid%ny), source=0.0_dp)
      self%p = zero
      self%f = zero
      self%eps = zero
      self%f_p = zero
      self%f_h = zero
      self%eps_p = zero
      self%eps_h = zero
      self%fluidity = zero
      self%dln_eta = zero
   end function new_flow

   !> Values of the next finer grid, at the nodes of this one.
   pure subroutine inject_from(self, fine, coarse)
      class(flow_t), intent(inout) :: self
      type(flow_t), intent(in) :: fine
      type(grid_t), intent(in) :: coarse   !! this grid
      call inject(coarse, fine%p, self%p)
      call inject(coarse, fine%f, self%f)
      call inject(coarse, fine%eps, self%eps)
      call inject(coarse, fine%f_p, self%f_p)
      call inject(coarse, fine%f_h, self%f_h)
      call inject(coarse, fine%eps_p, self%eps_p)
      call inject(coarse, fine%eps_h, self%eps_h)
   end subroutine inject_from

   !> Coefficients at pressure p and film h.
   pure subroutine evaluate(self, rheology, lambdabar, p, h)
      class(flow_t), intent(inout) :: self
      type(rheology_t), intent(in) :: rheology
      real(dp), intent(in) :: lambdabar             !! dimensionless speed parameter
      real(dp), intent(in), contiguous :: p(0:, 0:)   !! P, (0:nx, 0:ny)
      real(dp), intent(in), contiguous :: h(0:, 0:)   !! H > 0, (0:nx, 0:ny)
      integer :: i, j
      real(dp) :: rho, drho

      self%p = p
      call rheology%evaluate(size(p), p, self%f_h, self%f_p, self%fluidity, self%dln_eta)
      do j = 0, ubound(p, 2)
         do i = 0, ubound(p, 1)
            rho = self%f_h(i, j)
            drho = self%f_p(i, j)
            self%f(i, j) = rho*h(i, j)
            self%f_p(i, j) = drho*h(i, j)
            self%eps(i, j) = rho*h(i, j)**3*self%fluidity(i, j)/lambdabar
            self%eps_p(i, j) = self%eps(i, j)*(drho/rho - self%dln_eta(i, j))
            self%eps_h(i, j) = 3*self%eps(i, j)/h(i, j)
         end do
      end do
   end subroutine evaluate

end module ehlwave_flow
