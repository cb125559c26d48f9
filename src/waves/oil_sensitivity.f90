!> How film and response answer to the oil: derivatives by alpha and stress of the flow law, theory eq. (W10), (W11).
!>
!> Load, speed, geometry, E', viscosity at ambient pressure and the other properties of the oil are constant, so
!> that only these dimensionless numbers change:
!>
!>     alpha    ln(eta/eta0) in proportion at every pressure; M, lambdabar, ph/p0 and N0 are fixed, L and alphabar in
!>     proportion stress   tau0 of Ree-Eyring, G of Carreau: N0 as 1/stress
!>
!> With R(u, x) = 0 the steady equations of the state u, x = ln(alpha) or ln(stress), J0 their Jacobian,
!>
!>     du/dx = -J0^(-1) dR/dx.
!>
!> The response u1 solves L(u, x) u1 = r, linear in u1 with coefficients at the state:
!>
!>     L du1/dx = -(dL/du du/dx + dL/dx) u1.
!>
!> Both right sides are centred differences of residuals, dR/dx at the state and the second along (du/dx, 1), with a
!> step of 1e-5, of second order, which leaves about 1e-8 of the result. Cavitated nodes stay cavitated. At flooded
!> edges the steady pressures and the load outside are differentiated, not the changes by waves.
module ehlwave_oil_sensitivity
   use ehlwave_conditions, only: conditions_t
   use ehlwave_harmonic_response, only: harmonic_response_t
   use ehlwave_harmonic_solver, only: harmonic_solver_t
   use ehlwave_hierarchy, only: level_t
   use ehlwave_kinds, only: dp
   use ehlwave_reynolds, only: reynolds_change
   use ehlwave_rheology, only: rheology_t
   use ehlwave_state, only: state_t
   use ehlwave_steady_tangent, only: steady_tangent_t, tangent_change_t
   implicit none (type, external)
   private
   public :: differentiate_response, differentiate_steady

   integer, parameter, public :: by_alpha = 1, by_stress = 2   !! x

   real(dp), parameter :: step = 1e-5_dp   !! relative step of x

contains

   !> du/dx of the steady state.
   subroutine differentiate_steady(tangent, levels, x, tolerance, change)
      type(steady_tangent_t), intent(inout) :: tangent
      type(level_t), intent(inout), target :: levels(:)   !! levels of `tangent`
      integer, intent(in) :: x                            !! `by_alpha` or `by_stress`; the oil depends on it
      real(dp), intent(in) :: tolerance                   !! tolerance of the linear residual
      type(tangent_change_t), intent(out) :: change
      real(dp), allocatable, target :: b(:)
      real(dp), pointer, contiguous :: r(:, :)
      real(dp) :: edge(size(tangent%linear%levels(tangent%linear%finest)%equations%edge_excess))
      integer :: k, side

      edge = 0
      associate (finest => tangent%linear%levels(tangent%linear%finest), level => levels(size(levels)))
         allocate (b(tangent%linear%n), source=0.0_dp)
         r(0:level%problem%grid%nx, 0:level%problem%grid%ny) => b(:tangent%linear%n - 1)
         do side = -1, 1, 2
            call evaluate_beside(tangent, level, x, side*step, tangent%state)
            r = r - side*finest%equations%residual/(2*step)
            edge = edge - side*finest%equations%edge_excess/(2*step)
            b(tangent%linear%n) = b(tangent%linear%n) - side*finest%equations%edges%load/(2*step)
         end do
         call tangent%stand(level)
         r = merge(0.0_dp, finest%row_scale*r, finest%equations%is_cavitated)
         do k = 1, finest%equations%edges%count()
            r(finest%equations%edges%i(k), finest%equations%edges%j(k)) = edge(k)
         end do
      end associate
      call tangent%solve(levels, b, tolerance, change)
   end subroutine differentiate_steady

   !> du1/dx of the response that `harmonic` found last.
   subroutine differentiate_response(harmonic, levels, response, x, change, derivative)
      type(harmonic_solver_t), intent(inout) :: harmonic   !! about `levels`, with its tangent
      type(level_t), intent(inout), target :: levels(:)
      type(harmonic_response_t), intent(in) :: response    !! u1, converged
      integer, intent(in) :: x
      type(tangent_change_t), intent(in) :: change         !! du/dx, converged
      type(harmonic_response_t), intent(out) :: derivative
      complex(dp), allocatable, target :: b(:)
      complex(dp), allocatable :: dr(:, :)
      complex(dp), pointer, contiguous :: r(:, :)
      type(state_t) :: state
      integer :: side

      associate (tangent => harmonic%tangent, n => size(levels), &
                 equations => harmonic%tangent%linear%levels(size(levels))%equations, &
                 finest => harmonic%linear%levels(harmonic%linear%finest))
         allocate (b(harmonic%linear%n), source=(0.0_dp, 0.0_dp))
         allocate (dr, mold=response%p)
         r(0:ubound(dr, 1), 0:ubound(dr, 2)) => b(:harmonic%linear%n - 1)
         state = tangent%state
         do side = -1, 1, 2
            state%p = tangent%state%p + side*step*change%state%p
            state%h = tangent%state%h + side*step*change%state%h
            call evaluate_beside(tangent, levels(n), x, side*step, state)
            call reynolds_change(equations%mesh, finest%wedge, equations%flow, response%p, response%h, dr)
            r = r - side*dr/(2*step)
         end do
         call tangent%stand(levels(n))
         r = merge((0.0_dp, 0.0_dp), finest%row_scale*r, equations%is_cavitated)
      end associate
      call harmonic%respond_to(levels, b, derivative)
   end subroutine differentiate_response

   !> Have the equations of `tangent` evaluated at a state, for an oil whose x is larger by dx.
   subroutine evaluate_beside(tangent, level, x, dx, state)
      type(steady_tangent_t), intent(inout) :: tangent
      type(level_t), intent(inout) :: level      !! the finest; left as it was
      integer, intent(in) :: x
      real(dp), intent(in) :: dx
      type(state_t), intent(in) :: state
      type(conditions_t) :: beside, conditions
      type(rheology_t) :: oil

      conditions = level%problem%conditions
      oil = level%problem%rheology
      beside = conditions
      if (x == by_alpha) then
         beside%alpha_per_pa = exp(dx)*conditions%alpha_per_pa
         beside%l = exp(dx)*conditions%l
         beside%alphabar = exp(dx)*conditions%alphabar
         call level%problem%set_conditions(beside, oil%with_alpha(exp(dx)))
      else
         call level%problem%set_conditions(beside, oil%with_stress(exp(dx)))
      end if
      call tangent%linear%levels(tangent%linear%finest)%equations%evaluate(level%problem, tangent%given, state)
      call level%problem%set_conditions(conditions, oil)
   end subroutine evaluate_beside

end module ehlwave_oil_sensitivity
