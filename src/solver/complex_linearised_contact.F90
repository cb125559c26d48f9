#define SCALAR complex(dp)
#define COLUMN complex(sp)
!> A contact linearised about its steady state, for changes that vary as exp(-i w T): the system of a small wave.
module ehlwave_complex_linearised_contact
   use, intrinsic :: iso_c_binding, only: c_f_pointer, c_loc
   use ehlwave_complex_band, only: band_t, new_band
   use ehlwave_complex_gmres, only: linear_system_t
   use ehlwave_complex_ilu, only: ilu_t, new_ilu
   use ehlwave_complex_near_rows, only: near_links_t, near_rows
   use ehlwave_complex_transfer, only: prolong, prolong_transposed, restrict, restrict_transposed
   use ehlwave_complex_wedge, only: wedge_t
   use ehlwave_cycle_settings, only: cycle_settings_t, diagonal_shift
   use ehlwave_deformation, only: deformation_t
   use ehlwave_equations, only: equations_t
   use ehlwave_grid, only: grid_t
   use ehlwave_hierarchy, only: level_t
   use ehlwave_kinds, only: dp, sp
   use ehlwave_load_balance, only: load_factor
   use ehlwave_real_transfer, only: inject
   use ehlwave_near_kernel, only: near_kernel_t, new_near_kernel
   use ehlwave_reynolds, only: reynolds_change
   use ehlwave_reynolds_transposed, only: reynolds_transposed
   use ehlwave_reynolds_links, only: flow_links, poiseuille_links
   use ehlwave_threads, only: is_shared, row_block, team_size, thread_number
   use ehlwave_work_unit, only: weights => complex_weights
   implicit none (type, external)
   private

#include "linearised_contact.inc"

#include "contact_product.inc"

#include "contact_cycle.inc"

#include "near_factors.inc"

#include "contact_transposed.inc"

   !> Deformation under a change of pressure, real then imaginary part. A field without imaginary part (w = 0) costs
   !> a single convolution, any other two. `guess` serves as work space.
   subroutine deform(level, q, d, in_single)
      type(linear_level_t), intent(inout) :: level
      complex(dp), intent(in), contiguous :: q(0:, 0:)
      complex(dp), intent(out), contiguous :: d(0:, 0:)
      logical, intent(in) :: in_single
      complex(dp), allocatable, target :: storage(:, :)
      real(dp), pointer, contiguous :: parts(:, :, :)

      call move_alloc(level%guess, storage)
      call c_f_pointer(c_loc(storage), parts, [shape(q), 2])
      associate (part => parts(:, :, 1), film => parts(:, :, 2))
         part = real(q, dp)
         call level%deformation%deform(part, film, in_single)
         d = film
         part = aimag(q)
         if (any(abs(part) > 0)) then
            call level%deformation%deform(part, film, in_single)
            d = d + cmplx(0, film, dp)
         end if
      end associate
      call move_alloc(storage, level%guess)
   end subroutine deform

end module ehlwave_complex_linearised_contact
