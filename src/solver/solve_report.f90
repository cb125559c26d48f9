!> The end of a solve, and the report of its outcome.
module ehlwave_solve_report
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ehlwave_equations, only: equations_t
   use ehlwave_given, only: given_t
   use ehlwave_kinds, only: dp
   use ehlwave_state, only: state_t
   use ehlwave_status, only: status_converged, status_not_finite, status_stalled
   use ehlwave_threads, only: is_shared
   implicit none (type, external)
   private
   public :: mass_gain

   !> When to stop.
   type, public :: solve_limits_t
      real(dp) :: tolerance = 1e-6_dp   !! on the mass residual and the load error of `solve_report_t`
      integer :: largest_steps = 40     !! nonlinear steps or cycles
      real(dp) :: largest_work = huge(1.0_dp)   !! operations from which on no further step begins, see
                                                !! `ehlwave_work_unit`
      real(dp) :: film_unit = 0         !! unit of the mass residual; 0: the film at the contact centre
      logical :: leaves_last = .false.  !! whether Newton's method leaves the state of the last step without judging it,
                                        !! with the flow of `last_equations` as the step has it
      logical :: gives_up = .false.     !! whether Newton's method ends where it comes to rest away from the solution
      logical :: keeps_factors = .false.   !! whether Newton's method may keep factors from system to system, and from
                                           !! its last solution: `kept_factors_t`
      real(dp) :: loosest = 1           !! linear tolerance that Newton's method never exceeds
      logical :: starts_in_part = .false.  !! whether Newton's method also solves a part first under heat
      real(dp) :: guess_share = 1  !! multiple of the tolerance, above which Newton's method improves every first guess
   end type solve_limits_t

   !> The outcome of a solve. Each equation is reported by itself.
   type, public :: solve_report_t
      integer :: status = status_stalled
      real(dp) :: residual = huge(1.0_dp)         !! largest `mass_gain` over nodes with P > 0, and `edge_error`
      real(dp) :: complementarity = huge(1.0_dp)  !! max |P| over nodes where the film is cavitated
      real(dp) :: load_error = huge(1.0_dp)       !! relative error of the load balance
      integer :: nonlinear_steps = 0
      integer :: linear_steps = 0
      integer :: factorisations = 0
      real(dp), allocatable :: history(:)         !! residual before each step and at the end
   contains
      procedure :: judge
      procedure :: worst
   end type solve_report_t

contains

   !> Measure the three errors of a state and judge them: `status` becomes converged, not finite, or stalled, which it
   !> remains if nothing better follows. A residual that is not finite anywhere makes `residual` so.
   subroutine judge(self, given, equations, state, limits)
      class(solve_report_t), intent(inout) :: self
      type(given_t), intent(in) :: given
      type(equations_t), intent(in) :: equations        !! evaluated with it at the state
      type(state_t), intent(in) :: state                !! with the film of its pressure
      type(solve_limits_t), intent(in) :: limits
      real(dp), dimension(0:equations%mesh%grid%ny) :: complementarity, residual, total
      real(dp) :: centre, error
      integer :: i, j

      associate (grid => equations%mesh%grid, r => equations%residual)
         centre = limits%film_unit
         if (.not. centre > 0) centre = grid%value_at_centre(state%h)
         !$omp parallel do private(i) schedule(static) if (is_shared(size(r)))
         do j = 0, grid%ny
            total(j) = sum(r(:, j))
            residual(j) = 0
            complementarity(j) = 0
            do i = 0, grid%nx
               if (equations%is_cavitated(i, j)) then
                  complementarity(j) = max(complementarity(j), abs(state%p(i, j)))
               else
                  residual(j) = max(residual(j), mass_gain(r(i, j), grid%hx, state%h(i, j), centre))
               end if
            end do
         end do
         self%residual = maxval(residual)
         self%complementarity = maxval(complementarity)
         if (.not. ieee_is_finite(sum(total))) self%residual = sum(total)
         if (equations%edges%count() > 0) then
            error = edge_error(equations, state)
            self%residual = max(self%residual, error)
         end if
         self%load_error = abs(equations%load_residual(given, state))/abs(given%load%force)
      end associate
      if (.not. (ieee_is_finite(self%residual) .and. ieee_is_finite(self%load_error))) then
         self%status = status_not_finite
      else if (max(self%residual, self%complementarity, self%load_error) <= limits%tolerance) then
         self%status = status_converged
      else
         self%status = status_stalled
      end if
   end subroutine judge

   !> Largest excess of a pressure at flooded edges over the far-field pressure, in units of the largest pressure there.
   pure real(dp) function edge_error(equations, state)
      type(equations_t), intent(in) :: equations
      type(state_t), intent(in) :: state
      real(dp) :: largest
      integer :: k

      largest = max(tiny(1.0_dp), equations%edge_unit)
      do k = 1, equations%edges%count()
         largest = max(largest, abs(state%p(equations%edges%i(k), equations%edges%j(k))))
      end do
      edge_error = maxval(abs(equations%edge_excess))/largest
   end function edge_error

   !> The largest of the three errors.
   pure real(dp) function worst(self)
      class(solve_report_t), intent(in) :: self
      worst = max(self%residual, self%complementarity, self%load_error)
   end function worst

   !> Mass that the oil of a cell gains or loses, in units of the flow through that cell or through the contact centre,
   !> whichever is larger: |R| hX/max(H, H(0,0)).
   elemental real(dp) function mass_gain(r, hx, h, h_centre)
      real(dp), intent(in) :: r          !! Reynolds residual
      real(dp), intent(in) :: hx         !! mesh size in X
      real(dp), intent(in) :: h          !! film of the cell
      real(dp), intent(in) :: h_centre   !! H(0,0)
      mass_gain = abs(r)*hx/max(h, h_centre)
   end function mass_gain

end module ehlwave_solve_report
