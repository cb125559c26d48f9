!> Transposed change of the discrete Reynolds equation: derivatives of weighted residuals by pressure and film.
module ehlwave_reynolds_transposed
   use ehlwave_complex_wedge, only: complex_wedge_t => wedge_t
   use ehlwave_face_flow, only: face_flow_t
   use ehlwave_flow, only: flow_t
   use ehlwave_grid, only: grid_t
   use ehlwave_kinds, only: dp
   use ehlwave_mesh, only: mesh_t
   use ehlwave_raised_flux, only: curvature, flux_before
   use ehlwave_real_wedge, only: wedge_t
   implicit none (type, external)
   private
   public :: reynolds_transposed

   !> Transposed `reynolds_change`.
   interface reynolds_transposed
      module procedure real_transposed, complex_transposed
   end interface reynolds_transposed

contains

#define SCALAR real(dp)
#define WEDGE wedge_t
#define TRANSPOSED real_transposed
#define FACE_TRANSPOSED real_face_transposed
#define GENERAL_TRANSPOSED real_general_transposed
#define RAISED_TRANSPOSED real_raised_transposed
#define RAISED_ACROSS_TRANSPOSED real_raised_across_transposed
#include "transposed_change.inc"
#undef SCALAR
#undef WEDGE
#undef TRANSPOSED
#undef FACE_TRANSPOSED
#undef GENERAL_TRANSPOSED
#undef RAISED_TRANSPOSED
#undef RAISED_ACROSS_TRANSPOSED

#define SCALAR complex(dp)
#define WEDGE complex_wedge_t
#define TRANSPOSED complex_transposed
#define FACE_TRANSPOSED complex_face_transposed
#define GENERAL_TRANSPOSED complex_general_transposed
#define RAISED_TRANSPOSED complex_raised_transposed
#define RAISED_ACROSS_TRANSPOSED complex_raised_across_transposed
#include "transposed_change.inc"

end module ehlwave_reynolds_transposed
