!> Discretisation error of the friction coefficient, from the multigrid levels.
!>
!> Of a Newtonian oil under high pressure much of the friction is borne in the pressure spike, which grows with every grid: the
!> coefficients of three grids may differ little, and that of the fourth be twice as large (Roelands, alphabar = 14: 1.20, 1.45, 2.16,
!> 5.19 on 16 to 128 cells, with largest P of 1.00, 1.15, 1.38, 1.71).
module ehlwave_friction_error
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ehlwave_error_estimate, only: estimate_error
   use ehlwave_hierarchy, only: level_t
   use ehlwave_kinds, only: dp, no_value
   use ehlwave_shear_result, only: friction_above
   implicit none (type, external)
   private
   public :: estimate_friction_error

   real(dp), parameter :: usual_order = 1        !! with two levels
   real(dp), parameter :: largest_growth = 3     !! of the logarithm of the viscosity in the spike, from grid to grid

contains

   !> The larger one of Richardson's estimate and, of a Newtonian oil, what the growth of the spike since the next coarser level changes
   !> in the friction that the finest has above the largest pressure there. NaN without a coarser level.
   real(dp) function estimate_friction_error(levels, slip_parameter) result(error)
      type(level_t), intent(in) :: levels(:)     !! finest first, solved but for some
      real(dp), intent(in) :: slip_parameter     !! S
      real(dp) :: above, friction(size(levels)), growth
      real(dp), dimension(1) :: dln_eta, drho, fluidity, rho
      integer :: l

      error = no_value
      friction = no_value
      do l = 1, size(levels)
         if (levels(l)%has_film()) friction(l) = friction_above(levels(l)%problem, levels(l)%state, slip_parameter, 0.0_dp)
      end do
      error = estimate_error(friction, usual_order)
      if (.not. ieee_is_finite(error) .or. allocated(levels(1)%problem%film_flow)) return
      associate (highest => maxval(levels(1)%state%p), coarse => maxval(levels(2)%state%p))
         call levels(1)%problem%rheology%evaluate(1, [highest], rho, drho, fluidity, dln_eta)
         growth = min(largest_growth, dln_eta(1)*max(0.0_dp, highest - coarse))
         above = friction_above(levels(1)%problem, levels(1)%state, slip_parameter, coarse)
      end associate
      if (abs(friction(1)) > 0) error = max(error, (exp(growth) - 1)*abs(above/friction(1)))
   end function estimate_friction_error

end module ehlwave_friction_error
