!> Discretisation error of the friction coefficient, from the multigrid levels.
!>
!> Newtonian oils, and oils that thin with a power, have much of the friction in the pressure spike under high pressure.
!> The spike grows with every grid: the coefficients of three grids may differ little, and the fourth be twice as large
!> (Roelands, alphabar = 14: 1.20, 1.45, 2.16, 5.19 on 16 to 128 cells, with largest P of 1.00, 1.15, 1.38, 1.71). Two
!> grids may even have no spike where the next has one (Barus, alphabar = 20: largest P of 0.998, 0.998, 1.185, and
!> twice the friction).
module ehlwave_friction_error
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ehlwave_error_estimate, only: estimate_error
   use ehlwave_eyring_law, only: eyring_law_t
   use ehlwave_hierarchy, only: level_t
   use ehlwave_kinds, only: dp, no_value
   use ehlwave_shear_stress, only: friction_at, friction_of
   implicit none (type, external)
   private
   public :: estimate_friction_error

   real(dp), parameter :: usual_order = 1        !! with two levels
   real(dp), parameter :: blunt_share = 1        !! share of the relative film error, at least: grids can agree by
                                                 !! chance,
   real(dp), parameter :: newtonian_share = 2    !! share of the relative film error, at least, for a Newtonian oil
   real(dp), parameter :: next_growth = 3  !! growth of the spike on finer grids over its growth since the last grid;
                                                 !! measured: 1 to 3
   real(dp), parameter :: largest_growth = 7     !! growth of the logarithm of the viscosity in the spike, from grid to
                                                 !! grid
   real(dp), parameter :: usual_growth = 0.1_dp  !! growth of the largest pressure, at least, where d ln(eta)/dP is
                                                 !! `steep`;
                                                 !! measured: 0 to 0.2
   real(dp), parameter :: steep = 15
   real(dp), parameter :: film_share = 4         !! share of the relative film error, likewise

contains

   !> Richardson's estimate; for oils whose stress follows the rate of shear, at least twice the film error. It is also
   !> at least the change by the growth of the spike, since the next coarser level, of the friction above the pressure
   !> there.
   real(dp) function estimate_friction_error(levels, stress, film_error) result(error)
      type(level_t), intent(in) :: levels(:)     !! finest first, solved but for some
      real(dp), intent(in) :: stress(0:, 0:)     !! tau/ph on the finest, (0:nx, 0:ny)
      real(dp), intent(in) :: film_error         !! error of H(0,0), relative
      real(dp) :: friction(size(levels))
      integer :: l

      friction = no_value
      if (levels(1)%has_film()) friction(1) = friction_of(levels(1)%problem%grid, stress, levels(1)%state%p, 0.0_dp)
      do l = 2, size(levels)
         if (levels(l)%has_film()) friction(l) = friction_at(levels(l)%problem, levels(l)%state)
      end do
      error = estimate_error(friction, usual_order)
      if (.not. ieee_is_finite(error)) error = film_share*film_error
      error = max(error, blunt_share*film_error)
      if (is_blunt(levels(1)) .or. abs(friction(1)) <= 0) return
      error = max(error, newtonian_share*film_error, by_growth(levels, stress)/abs(friction(1)))
   end function estimate_friction_error

   !> Whether the stress of an oil hardly grows with its viscosity: Ree-Eyring's with the logarithm, Carreau's with a
   !> power.
   pure logical function is_blunt(level)
      type(level_t), intent(in) :: level
      is_blunt = .false.
      if (level%problem%rheology%is_newtonian()) return
      select type (law => level%problem%film_flow%law)
      type is (eyring_law_t)
         is_blunt = .true.
      end select
   end function is_blunt

   !> Friction that another growth of the spike would add.
   real(dp) function by_growth(levels, stress)
      type(level_t), intent(in) :: levels(:)     !! finest first
      real(dp), intent(in) :: stress(0:, 0:)
      real(dp) :: before, growth
      real(dp), dimension(1) :: dln_eta, drho, fluidity, rho

      associate (finest => levels(1), highest => maxval(levels(1)%state%p))
         call finest%problem%rheology%evaluate(1, [highest], rho, drho, fluidity, dln_eta)
         before = (1 - usual_growth*min(1.0_dp, dln_eta(1)/steep))*highest
         if (size(levels) > 1) then
            if (levels(2)%has_film()) before = min(before, maxval(levels(2)%state%p))
         end if
         growth = min(largest_growth, next_growth*dln_eta(1)*max(0.0_dp, highest - before))
         by_growth = (exp(growth) - 1)*abs(friction_of(finest%problem%grid, stress, finest%state%p, before))
      end associate
   end function by_growth

end module ehlwave_friction_error
