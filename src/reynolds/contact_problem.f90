!> A contact on one grid: everything except the unknowns and the data of a particular solution.
module ehlwave_contact_problem
   use ehlwave_conditions, only: conditions_t
   use ehlwave_deformation, only: deformation_t
   use ehlwave_deformation_fft, only: deformation_fft_t
   use ehlwave_deformation_line, only: deformation_line_t
   use ehlwave_edge_values, only: edge_values_t, new_edge_values
   use ehlwave_film_flow, only: film_flow_t
   use ehlwave_film_heat, only: film_heat_t
   use ehlwave_formula, only: expected_film
   use ehlwave_given, only: given_t
   use ehlwave_grid, only: grid_t
   use ehlwave_kinds, only: dp
   use ehlwave_rheology, only: rheology_t
   use ehlwave_state, only: state_t
   use ehlwave_threads, only: is_shared
   implicit none (type, external)
   private

   !> A contact, its oil and its gap, the same for all solutions on this grid.
   type, public :: contact_problem_t
      type(grid_t) :: grid
      type(conditions_t) :: conditions
      type(rheology_t) :: rheology
      type(film_flow_t), allocatable :: film_flow   !! flow across the film; not of a Newtonian oil, unless it is warm
      type(film_heat_t), allocatable :: heat     !! temperatures of the oil; not allocated where it is at T0
      type(edge_values_t) :: edges               !! P at the edges of the domain
      class(deformation_t), allocatable :: deformation
      real(dp), allocatable :: own_gap(:, :)     !! gap in place of S X^2 + (1 - S) Y^2, (0:nx, 0:ny)
   contains
      procedure :: init
      procedure :: lay_out
      procedure :: take_oil
      procedure :: set_conditions
      procedure :: film
      procedure :: smooth_gap
      procedure :: smooth_film
      procedure :: film_of_guess
      procedure :: density
   end type contact_problem_t

contains

   !> A contact on a grid.
   subroutine init(self, grid, conditions, rheology)
      class(contact_problem_t), intent(inout) :: self
      type(grid_t), intent(in) :: grid
      type(conditions_t), intent(in) :: conditions
      type(rheology_t), intent(in) :: rheology
      call self%lay_out(grid, conditions)
      call self%set_conditions(conditions, rheology)
   end subroutine init

   !> Its parts that are independent of the oil.
   subroutine lay_out(self, grid, conditions)
      class(contact_problem_t), intent(inout) :: self
      type(grid_t), intent(in) :: grid
      type(conditions_t), intent(in) :: conditions

      self%grid = grid
      if (conditions%is_line() .and. &
         .not. allocated(self%deformation)) allocate (deformation_line_t :: self%deformation)
      if (.not. allocated(self%deformation)) allocate (deformation_fft_t :: self%deformation)
      call self%deformation%init(grid, conditions%elliptic%kappa, conditions%elliptic%k)
   end subroutine lay_out

   !> Conditions and oil of a problem on another grid, and the flow across the film that was made of them.
   subroutine take_oil(self, other)
      class(contact_problem_t), intent(inout) :: self
      type(contact_problem_t), intent(in) :: other
      self%conditions = other%conditions
      self%rheology = other%rheology
      self%edges = new_edge_values(self%grid, other%conditions, other%rheology)
      if (allocated(self%film_flow)) deallocate (self%film_flow)
      if (allocated(other%film_flow)) self%film_flow = other%film_flow
   end subroutine take_oil

   !> Other conditions of a contact with the same ratio of radii, on which grid and kernel depend, and the oil under
   !> them.
   subroutine set_conditions(self, conditions, rheology)
      class(contact_problem_t), intent(inout) :: self
      type(conditions_t), intent(in) :: conditions
      type(rheology_t), intent(in) :: rheology

      self%conditions = conditions
      self%rheology = rheology
      self%edges = new_edge_values(self%grid, conditions, rheology)
      if (allocated(self%film_flow)) deallocate (self%film_flow)
      if (rheology%is_newtonian()) return
      self%film_flow = rheology%film_flow(conditions%elliptic%k, conditions%lambdabar, conditions%slip_parameter)
   end subroutine set_conditions

   !> Film thickness H = -Delta + S X^2 + (1 - S) Y^2 + Rough + Dbar(P), theory eq. (8).
   subroutine film(self, given, p, delta, h)
      class(contact_problem_t), intent(inout) :: self
      type(given_t), intent(in) :: given               !! its roughness counts
      real(dp), intent(in), contiguous :: p(0:, 0:)    !! P, (0:nx, 0:ny)
      real(dp), intent(in) :: delta                    !! mutual approach
      real(dp), intent(out), contiguous :: h(0:, 0:)   !! H, (0:nx, 0:ny)
      integer :: j
      call self%smooth_film(p, delta, h)
      if (.not. allocated(given%rough)) return
      !$omp parallel do schedule(static) if (is_shared(size(h)))
      do j = 0, ubound(h, 2)
         h(:, j) = h(:, j) + given%rough(:, j)
      end do
   end subroutine film

   !> Gap between undeformed smooth surfaces along a row of nodes, but for the approach.
   pure function smooth_gap(self, j) result(gap)
      class(contact_problem_t), intent(in) :: self
      integer, intent(in) :: j
      real(dp) :: gap(0:self%grid%nx)
      associate (grid => self%grid, s => self%conditions%s)
         if (allocated(self%own_gap)) then
            gap = self%own_gap(:, j)
         else
            gap = s*grid%x**2 + (1 - s)*grid%y(j)**2
         end if
      end associate
   end function smooth_gap

   !> `film` of smooth surfaces.
   subroutine smooth_film(self, p, delta, h)
      class(contact_problem_t), intent(inout) :: self
      real(dp), intent(in), contiguous :: p(0:, 0:)
      real(dp), intent(in) :: delta
      real(dp), intent(out), contiguous :: h(0:, 0:)
      integer :: j
      call self%deformation%apply(p, h)
      !$omp parallel do schedule(static) if (is_shared(size(h)))
      do j = 0, ubound(h, 2)
         h(:, j) = h(:, j) + self%smooth_gap(j) - delta
      end do
   end subroutine smooth_film

   !> Film of a first guess. Overlapping surfaces, as with thin films on grids too coarse for them, are opened to the
   !> film of the formula at the closest point: where there is no film no equation makes sense.
   subroutine film_of_guess(self, given, guess)
      class(contact_problem_t), intent(inout) :: self
      type(given_t), intent(in) :: given
      type(state_t), intent(inout) :: guess   !! P and Delta; H on return
      real(dp) :: gap

      call self%film(given, guess%p, guess%delta, guess%h)
      if (minval(guess%h) > 0) return
      gap = expected_film(self%conditions) - minval(guess%h)
      guess%delta = guess%delta - gap
      guess%h = guess%h + gap
   end subroutine film_of_guess

   !> rho/rho0 at the nodes, at their temperatures where the oil is warm.
   pure function density(self, p) result(rho)
      class(contact_problem_t), intent(in) :: self
      real(dp), intent(in), contiguous :: p(0:, 0:)   !! P, (0:nx, 0:ny)
      real(dp) :: rho(0:self%grid%nx, 0:self%grid%ny)
      if (allocated(self%heat)) then
         rho = self%rheology%density(p, self%heat%mean_rise)
      else
         rho = self%rheology%density(p)
      end if
   end function density

end module ehlwave_contact_problem
