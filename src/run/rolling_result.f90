!> Resistance to rolling of the smooth contact, by the moment of its pressure: theory eq. (T12) to (T14).
module ehlwave_rolling_result
   use ehlwave_conditions, only: conditions_t
   use ehlwave_contact_problem, only: contact_problem_t
   use ehlwave_error_factors, only: by_domain, rolling
   use ehlwave_hierarchy, only: level_t
   use ehlwave_kinds, only: dp, no_value
   use ehlwave_mesh_errors, only: mesh_error, mesh_error_t
   use ehlwave_rolling_moment, only: shift_inside, shift_outside, wet_share
   use ehlwave_state, only: state_t
   implicit none (type, external)
   private
   public :: rolling_coefficient, times_outside

   !> NaN where it is not known: the coefficient without E' and pressure, the others without lengths.
   type, public :: rolling_result_t
      real(dp) :: pressure_centre_x = no_value        !! X of the pressure's centre, oil outside the domain included
      real(dp) :: coefficient = no_value              !! resisting force at each surface over the load
      real(dp) :: share_outside = no_value            !! share of it, by oil outside the domain
      real(dp) :: error = no_value                    !! relative, of all of them
      real(dp) :: domain_error = no_value             !! part of it by the edges of the domain
      real(dp), private :: share_missing = 0          ! share of it, for the missing oil outside a dry edge
      real(dp), allocatable, private :: shifts(:)     ! of the pressure's centre on each grid, finest first
   contains
      procedure :: take
      procedure :: estimate
      procedure :: add_errors
      procedure :: force
      procedure :: moment
      procedure :: power
   end type rolling_result_t

   integer, parameter :: fewest_domains = 2        !! out to which oil counts, at least

contains

   !> Account of a steady solution. Oil outside the domain counts out to Rx, where bodies are no longer paraboloids.
   subroutine take(self, levels)
      class(rolling_result_t), intent(inout) :: self
      type(level_t), intent(in) :: levels(:)   !! finest first
      real(dp) :: all_outside, outside, shift(size(levels)), times
      integer :: l

      shift = no_value
      associate (problem => levels(1)%problem)
         times = times_outside(problem)
         all_outside = shift_outside(problem, times)
         outside = all_outside*wet_share(problem, levels(1)%state)
         do l = 1, size(levels)
            if (levels(l)%has_film()) shift(l) = shift_inside(levels(l)%problem, levels(l)%state) + outside
         end do
         self%pressure_centre_x = -shift(1)
         self%share_outside = outside/shift(1)
         self%share_missing = (all_outside - outside)/shift(1)
         self%shifts = shift
         if (problem%conditions%radius_over_a() > 0) &
            self%coefficient = shift(1)/(2*problem%conditions%radius_over_a())
      end associate
   end subroutine take

   !> Error by the mesh.
   pure subroutine estimate(self, kind, expected, order)
      class(rolling_result_t), intent(inout) :: self
      integer, intent(in) :: kind              !! see `kind_of`
      real(dp), intent(in) :: expected         !! error of H(0,0), relative, by the model
      real(dp), intent(in) :: order            !! of errors by the mesh
      type(mesh_error_t) :: error
      if (.not. allocated(self%shifts)) return
      error = mesh_error(rolling, kind, self%shifts, expected, order)
      self%error = error%relative
   end subroutine estimate

   !> Distance up to which oil outside counts, over the size of the domain.
   pure real(dp) function times_outside(problem) result(times)
      type(contact_problem_t), intent(in) :: problem
      times = max(real(fewest_domains, dp), problem%conditions%radius_over_a()/abs(problem%grid%x(0)))
   end function times_outside

   !> The coefficient of a steady solution; NaN where it is not known.
   real(dp) function rolling_coefficient(problem, state) result(coefficient)
      type(contact_problem_t), intent(in) :: problem
      type(state_t), intent(in) :: state
      coefficient = no_value
      if (.not. problem%conditions%radius_over_a() > 0) return
      coefficient = (shift_inside(problem, state) + shift_outside(problem, times_outside(problem))* &
                     wet_share(problem, state))/(2*problem%conditions%radius_over_a())
   end function rolling_coefficient

   !> Complete the error, so far the mesh error.
   pure subroutine add_errors(self, edge_error, solver_error, is_starved, lacks_oil)
      class(rolling_result_t), intent(inout) :: self
      real(dp), intent(in) :: edge_error   !! by the edges of the domain
      real(dp), intent(in) :: solver_error   !! by the solution of effects, as of temperatures
      logical, intent(in) :: is_starved    !! whether the oil outside may be missing
      logical, intent(in) :: lacks_oil     !! whether a longer domain would be full from farther upstream
      self%domain_error = edge_error + merge(1.0_dp, by_domain(rolling), is_starved)*abs(self%share_outside)
      if (lacks_oil) self%domain_error = self%domain_error + self%share_missing
      self%error = self%error + self%domain_error + solver_error
   end subroutine add_errors

   !> Force at each surface, N, of a line contact N/m.
   pure real(dp) function force(self, conditions)
      class(rolling_result_t), intent(in) :: self
      type(conditions_t), intent(in) :: conditions
      force = self%coefficient*merge(conditions%data%load_n_per_m, conditions%data%load_n, conditions%is_line())
   end function force

   !> Moment of the pressure about the contact centre, N m, of a line contact N.
   pure real(dp) function moment(self, conditions)
      class(rolling_result_t), intent(in) :: self
      type(conditions_t), intent(in) :: conditions
      moment = 2*conditions%data%radius_x_m*self%force(conditions)
   end function moment

   !> Power that it takes at both surfaces, W, of a line contact W/m.
   pure real(dp) function power(self, conditions)
      class(rolling_result_t), intent(in) :: self
      type(conditions_t), intent(in) :: conditions
      power = 2*conditions%data%mean_speed_m_per_s*self%force(conditions)
   end function power

end module ehlwave_rolling_result
