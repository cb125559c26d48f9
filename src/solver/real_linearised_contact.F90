#define SCALAR real(dp)
#define COLUMN real(dp)
!> A contact linearised about an iterate: the linear system of a Newton step.
module ehlwave_real_linearised_contact
   use ehlwave_cycle_settings, only: cycle_settings_t, diagonal_shift
   use ehlwave_deformation, only: deformation_t
   use ehlwave_equations, only: equations_t
   use ehlwave_grid, only: grid_t
   use ehlwave_hierarchy, only: level_t
   use ehlwave_kinds, only: dp
   use ehlwave_load_balance, only: load_factor
   use ehlwave_near_kernel, only: near_kernel_t, new_near_kernel
   use ehlwave_real_band, only: band_t, new_band
   use ehlwave_real_gmres, only: linear_system_t
   use ehlwave_real_ilu, only: ilu_t, new_ilu
   use ehlwave_real_near_rows, only: near_links_t, near_rows
   use ehlwave_real_transfer, only: inject, prolong, prolong_transposed, restrict, &
      restrict_transposed
   use ehlwave_real_wedge, only: wedge_t
   use ehlwave_reynolds, only: reynolds_change
   use ehlwave_reynolds_transposed, only: reynolds_transposed
   use ehlwave_reynolds_links, only: flow_links, poiseuille_links
   use ehlwave_threads, only: is_shared, row_block, team_size, thread_number
   use ehlwave_transport, only: implicit_part, transport_t
   use ehlwave_work_unit, only: weights => real_weights
   implicit none (type, external)
   private
   public :: set_wedge

#include "linearised_contact.inc"

#include "contact_product.inc"

#include "contact_cycle.inc"

#include "near_factors.inc"

#include "contact_transposed.inc"

   !> Let wedge and squeeze be those that the finest level is given, on all levels.
   subroutine set_wedge(self, transport)
      type(linearised_contact_t), intent(inout) :: self
      type(transport_t), intent(in) :: transport
      integer :: l

      associate (levels => self%levels, n => self%finest)
         levels(n)%wedge = implicit_part(transport, levels(n)%equations%mesh%grid)
         do l = n - 1, 1, -1
            levels(l)%wedge = implicit_part(levels(l + 1)%wedge, levels(l)%equations%mesh%grid)
         end do
      end associate
   end subroutine set_wedge

   !> Deformation under a change of pressure.
   subroutine deform(level, q, d, in_single)
      type(linear_level_t), intent(inout) :: level
      real(dp), intent(in), contiguous :: q(0:, 0:)
      real(dp), intent(out), contiguous :: d(0:, 0:)
      logical, intent(in) :: in_single
      call level%deformation%deform(q, d, in_single)
   end subroutine deform

end module ehlwave_real_linearised_contact
