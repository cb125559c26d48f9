!> Moment of the pressure about the contact centre, and the force that resists rolling.
!>
!> The oil shears the surfaces by tau_m +- (h/2) dp/dx. The second part acts on both against their motion, whatever the
!> oil, its temperatures and the sliding: theory eq. (T12). An elastic half-space bears no force on itself along X, so
!> that the integral of (h/2) dp/dx is the moment of the pressure over twice the radius of the gap (T13).
module ehlwave_rolling_moment
   use ehlwave_contact_problem, only: contact_problem_t
   use ehlwave_kinds, only: dp
   use ehlwave_load_balance, only: load_factor
   use ehlwave_shear_stress, only: least_pressure
   use ehlwave_state, only: state_t
   implicit none (type, external)
   private
   public :: shift_inside, shift_outside, wet_share

contains

   !> Distance along X, upstream in units of a, of the pressure's centre from the contact centre: the part by the
   !> pressure within the domain,
   !>
   !>     -(3/(2 pi)) int int X P dX dY.
   real(dp) function shift_inside(problem, state) result(shift)
      type(contact_problem_t), intent(in) :: problem
      type(state_t), intent(in) :: state
      real(dp), allocatable :: moment(:, :)
      integer :: j
      allocate (moment, mold=state%p)
      do j = 0, problem%grid%ny
         moment(:, j) = -problem%grid%x*state%p(:, j)
      end do
      shift = load_factor*problem%grid%integral(moment)
   end function shift_inside

   !> The part by the far field of a flooded contact outside the domain, out to `times` its size.
   real(dp) function shift_outside(problem, times) result(shift)
      type(contact_problem_t), intent(in) :: problem
      real(dp), intent(in) :: times
      real(dp), allocatable, dimension(:) :: area, pressure, x
      call problem%edges%pressure_outside(times, area, x, pressure)
      shift = -load_factor*sum(area*x*pressure)
   end function shift_outside

   !> Share of the nodes of flooded edges that are not dry: only these have oil outside.
   pure real(dp) function wet_share(problem, state)
      type(contact_problem_t), intent(in) :: problem
      type(state_t), intent(in) :: state
      integer :: k
      associate (edges => problem%edges)
         wet_share = count([(state%p(edges%i(k), edges%j(k)) > least_pressure, k=1, edges%count())]) &
                     /real(max(edges%count(), 1), dp)
      end associate
   end function wet_share

end module ehlwave_rolling_moment
