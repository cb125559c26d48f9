!> Change of the residuals of the oil of a contact whose surfaces may touch, to first order.
module ehlwave_touching_oil_change
   use ehlwave_grid, only: grid_t
   use ehlwave_kinds, only: dp
   use ehlwave_real_wedge, only: new_wedge, wedge_t
   use ehlwave_reynolds, only: reynolds_change
   use ehlwave_reynolds_transposed, only: reynolds_transposed
   use ehlwave_touching_equations, only: touching_equations_t
   use ehlwave_touching_unknowns, only: touching_unknowns_t
   implicit none (type, external)
   private

   type, public :: touching_oil_change_t
      type(grid_t), private :: grid
      type(wedge_t), private :: no_wedge
      real(dp), allocatable, private :: work(:, :)
   contains
      procedure :: init
      procedure :: evaluate
      procedure :: transpose => evaluate_transposed
   end type touching_oil_change_t

contains

   !> Work space on a grid.
   subroutine init(self, grid)
      class(touching_oil_change_t), intent(inout) :: self
      type(grid_t), intent(in) :: grid
      self%grid = grid
      self%no_wedge = new_wedge(grid%nx)
      call grid%new_field(self%work)
   end subroutine init

   !> Change of the residuals of the oil with changes of pressure or content, and film.
   subroutine evaluate(self, unknowns, equations, theta, is_steady, u, dh, r)
      class(touching_oil_change_t), intent(inout) :: self
      type(touching_unknowns_t), intent(in) :: unknowns
      type(touching_equations_t), intent(in) :: equations
      real(dp), intent(in) :: theta(0:, 0:)
      logical, intent(in) :: is_steady
      real(dp), intent(in), contiguous :: u(0:, 0:)        !! changes of P or theta
      real(dp), intent(in), contiguous :: dh(0:, 0:)       !! changes of the film
      real(dp), intent(out), contiguous :: r(0:, 0:)
      real(dp), dimension(0:ubound(u, 1)) :: d_theta, df, passed
      integer :: i, j, nx

      nx = ubound(u, 1)
      self%work = merge(u, 0.0_dp, unknowns%is_full)
      associate (hx => self%grid%hx)
         call reynolds_change(equations%mesh, self%no_wedge, equations%flow, self%work, dh, r)
         do j = self%grid%first_row, self%grid%last_row
            df = equations%flow%f_p(:, j)*self%work(:, j) + equations%flow%rho(:, j)*dh(:, j)
            d_theta = merge(0.0_dp, u(:, j), unknowns%is_full(:, j))
            passed(0) = df(0)
            do i = 1, nx
               passed(i) = theta(i, j)*equations%own(i, j)*df(i) + equations%face(i, j)*d_theta(i)
               if (is_steady) passed(i) = passed(i) + theta(i, j)*equations%upstream(i, j)*df(i - 1)
            end do
            r(1, j) = r(1, j) - (theta(1, j)*df(1) + equations%flow%f(1, j)*d_theta(1))/hx
            r(2:nx - 1, j) = r(2:nx - 1, j) - passed(2:nx - 1)/hx
            if (.not. is_steady) cycle
            r(1:nx - 1, j) = r(1:nx - 1, j) + passed(0:nx - 2)/hx
         end do
      end associate
   end subroutine evaluate

   !> Transposed `evaluate` of a steady state: weights of the changes of P, theta and H for weights of the residuals.
   subroutine evaluate_transposed(self, equations, theta, r, p_weight, theta_weight, h_weight)
      class(touching_oil_change_t), intent(in) :: self
      type(touching_equations_t), intent(in) :: equations
      real(dp), intent(in) :: theta(0:, 0:)
      real(dp), intent(in), contiguous :: r(0:, 0:)        !! 0 at nodes without an equation
      real(dp), intent(out), contiguous, dimension(0:, 0:) :: p_weight, theta_weight, h_weight
      real(dp), dimension(0:ubound(r, 1)) :: df, passed
      integer :: i, j, nx

      nx = ubound(r, 1)
      call reynolds_transposed(equations%mesh, self%no_wedge, equations%flow, r, p_weight, h_weight)
      theta_weight = 0
      do j = self%grid%first_row, self%grid%last_row
         passed = 0
         passed(0:nx - 2) = r(1:nx - 1, j)/self%grid%hx
         passed(2:nx - 1) = passed(2:nx - 1) - r(2:nx - 1, j)/self%grid%hx
         df = 0
         df(0) = passed(0)
         df(1) = -theta(1, j)*r(1, j)/self%grid%hx
         theta_weight(1, j) = -equations%flow%f(1, j)*r(1, j)/self%grid%hx
         do i = 1, nx - 1
            theta_weight(i, j) = theta_weight(i, j) + equations%face(i, j)*passed(i)
            df(i) = df(i) + theta(i, j)*equations%own(i, j)*passed(i)
            df(i - 1) = df(i - 1) + theta(i, j)*equations%upstream(i, j)*passed(i)
         end do
         p_weight(:, j) = p_weight(:, j) + equations%flow%f_p(:, j)*df
         h_weight(:, j) = h_weight(:, j) + equations%flow%rho(:, j)*df
      end do
   end subroutine evaluate_transposed

end module ehlwave_touching_oil_change
