!> Expected error of the friction coefficient, for the rule of `ehlwave_mesh_errors`.
!>
!> Where stress follows viscosity, much of the friction is in the pressure spike, which grows with every grid. The
!> growth since the next coarser grid is added once more, and the law of the oil gives the friction then. Its change is
!> taken `further_growths` times: finer grids have as much each.
module ehlwave_friction_error
   use ehlwave_hierarchy, only: level_t
   use ehlwave_kinds, only: dp
   use ehlwave_shear_stress, only: friction_at
   use ehlwave_state, only: state_t
   implicit none (type, external)
   private
   public :: spike_growth

   real(dp), parameter :: usual_growth = 0.1_dp  !! growth of the largest pressure, at least, where d ln(eta)/dP is
   real(dp), parameter :: steep = 15             !! this; measured: 0 to 0.2
   real(dp), parameter :: further_growths = 5    !! halvings of the mesh size until the spike no longer grows

contains

   !> Relative change of the friction by further growths of the pressure spike.
   real(dp) function spike_growth(levels, friction) result(change)
      type(level_t), intent(in) :: levels(:)     !! finest first, solved but for some
      real(dp), intent(in) :: friction           !! on the finest
      type(state_t) :: grown
      real(dp), dimension(1) :: before, dln_eta, drho, fluidity, highest, rho

      associate (finest => levels(1))
         highest = maxval(finest%state%p)
         call finest%problem%rheology%evaluate(1, highest, rho, drho, fluidity, dln_eta)
         before = (1 - usual_growth*min(1.0_dp, dln_eta/steep))*highest
         if (size(levels) > 1) then
            if (levels(2)%has_film()) before = min(before, maxval(levels(2)%state%p))
         end if
         grown = finest%state
         grown%p = grown%p + max(0.0_dp, grown%p - before(1))
         change = further_growths*abs(friction_at(finest%problem, grown)/friction - 1)
      end associate
   end function spike_growth

end module ehlwave_friction_error
