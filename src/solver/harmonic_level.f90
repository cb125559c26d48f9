!> The equations of a contact linearised about its steady state, for changes that vary as exp(-i w T), on one grid.
module ehlwave_harmonic_level
   use ehlwave_contact_problem, only: contact_problem_t
   use ehlwave_harmonic_operator, only: harmonic_jacobian, harmonic_scale, harmonic_transport, harmonic_transport_t
   use ehlwave_kernel, only: cell_influence
   use ehlwave_kinds, only: dp
   use ehlwave_reynolds, only: diagonal_scale, flow_t, new_flow, reynolds_residual
   use ehlwave_state, only: state_t
   use ehlwave_transfer, only: inject
   use ehlwave_transport, only: steady_transport
   implicit none (type, external)
   private

   !> Rows are weighted by |A_ii|^(-1/4), as in Newton's system. A node that is cavitated in the steady state keeps P = 0.
   type, public :: harmonic_level_t
      type(contact_problem_t), pointer :: problem => null()  !! grid, deformation, conditions
      type(flow_t) :: flow                               !! coefficients at the steady state
      real(dp), allocatable :: p(:, :)                   !! its pressure
      logical, allocatable :: is_cavitated(:, :)
      type(harmonic_transport_t) :: transport            !! wedge and squeeze at the present frequency
      real(dp), allocatable :: scale(:, :)               !! 1/|A_ii|, 0 off the unknown nodes
      real(dp), allocatable :: row_scale(:, :)           !! weight of each row, 0 off the unknown nodes
      real(dp) :: self_influence = 0                     !! deformation at a node under its own unit pressure
      real(dp), allocatable, private :: part(:, :), part_film(:, :)
   contains
      procedure :: init
      procedure :: linearise
      procedure :: inject_from
      procedure :: set_frequency
      procedure :: film_change
      procedure :: residual_change
   end type harmonic_level_t

contains

   !> Work space for a problem's grid.
   subroutine init(self, problem)
      class(harmonic_level_t), intent(inout) :: self
      type(contact_problem_t), intent(in), target :: problem

      self%problem => problem
      associate (grid => problem%grid, nx => problem%grid%nx, ny => problem%grid%ny, elliptic => problem%conditions%elliptic)
         self%flow = new_flow(grid)
         self%self_influence = cell_influence(0.0_dp, 0.0_dp, grid%hx, grid%hy, elliptic%kappa, elliptic%k)
         allocate (self%p(0:nx, 0:ny), self%scale(0:nx, 0:ny), self%row_scale(0:nx, 0:ny), self%part(0:nx, 0:ny), &
                   self%part_film(0:nx, 0:ny), source=0.0_dp)
         allocate (self%is_cavitated(0:nx, 0:ny), source=.false.)
      end associate
   end subroutine init

   !> Linearise about a steady state of smooth surfaces.
   subroutine linearise(self, state)
      class(harmonic_level_t), intent(inout) :: self
      type(state_t), intent(in) :: state

      associate (grid => self%problem%grid, problem => self%problem, kappa => self%problem%conditions%elliptic%kappa)
         self%p = state%p
         call problem%film(state%p, state%delta, self%part_film)
         call self%flow%evaluate(problem%rheology, problem%conditions%lambdabar, self%p, self%part_film)
         call reynolds_residual(grid, steady_transport(grid), kappa, self%flow, self%p, self%part)
         call diagonal_scale(grid, steady_transport(grid), kappa, self%self_influence, self%flow, self%scale)
         self%is_cavitated = self%scale > 0 .and. self%p + self%scale*self%part <= 0
      end associate
   end subroutine linearise

   !> Linearise as the next finer level: coefficients, pressure and cavitated nodes by injection.
   subroutine inject_from(self, fine)
      class(harmonic_level_t), intent(inout) :: self
      class(harmonic_level_t), intent(in) :: fine

      associate (grid => self%problem%grid)
         call inject(grid, fine%p, self%p)
         call self%flow%inject_from(fine%flow, grid)
         self%is_cavitated = fine%is_cavitated(::2, ::grid%row_ratio)
      end associate
   end subroutine inject_from

   !> Transport and row weights at one frequency.
   subroutine set_frequency(self, frequency, dt)
      class(harmonic_level_t), intent(inout) :: self
      real(dp), intent(in) :: frequency       !! w in units of 1/T
      real(dp), intent(in) :: dt              !! step along the characteristic: hX of the finest grid

      associate (grid => self%problem%grid, kappa => self%problem%conditions%elliptic%kappa)
         self%transport = harmonic_transport(grid, frequency, dt)
         call harmonic_scale(grid, self%transport, kappa, self%self_influence, self%flow, self%scale)
         self%row_scale = sqrt(sqrt(self%scale))
      end associate
   end subroutine set_frequency

   !> Change of the film: deformation under q minus the approach, real and imaginary part one after the other. A
   !> field without imaginary part (w = 0) costs one convolution, any other two.
   subroutine film_change(self, q, delta, dh)
      class(harmonic_level_t), intent(inout) :: self
      complex(dp), intent(in) :: q(0:, 0:)       !! change of P, (0:nx, 0:ny)
      complex(dp), intent(in) :: delta           !! change of Delta
      complex(dp), intent(out) :: dh(0:, 0:)     !! change of H, (0:nx, 0:ny)
      self%part = real(q, dp)
      call self%problem%deformation%apply(self%part, self%part_film)
      dh = self%part_film - delta
      self%part = aimag(q)
      if (.not. any(abs(self%part) > 0)) return
      call self%problem%deformation%apply(self%part, self%part_film)
      dh = dh + cmplx(0, self%part_film, dp)
   end subroutine film_change

   !> Weighted change of the residuals; q itself at cavitated nodes.
   pure subroutine residual_change(self, q, dh, dr)
      class(harmonic_level_t), intent(in) :: self
      complex(dp), intent(in) :: q(0:, 0:), dh(0:, 0:)   !! changes of P and H, (0:nx, 0:ny)
      complex(dp), intent(out) :: dr(0:, 0:)             !! (0:nx, 0:ny)
      integer :: i, j

      associate (grid => self%problem%grid, kappa => self%problem%conditions%elliptic%kappa)
         call harmonic_jacobian(grid, self%transport, kappa, self%flow, self%p, q, dh, dr)
         do j = 0, grid%ny
            do i = 0, grid%nx
               dr(i, j) = merge(q(i, j), self%row_scale(i, j)*dr(i, j), self%is_cavitated(i, j))
            end do
         end do
      end associate
   end subroutine residual_change

end module ehlwave_harmonic_level
