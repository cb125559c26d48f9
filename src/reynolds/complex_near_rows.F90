#define SCALAR complex(dp)
!> Rows of the near part of the Jacobian with complex weights of wedge and squeeze.
module ehlwave_complex_near_rows
   use ehlwave_complex_wedge, only: fold, wedge_t
   use ehlwave_flow, only: flow_t
   use ehlwave_grid, only: grid_t
   use ehlwave_kinds, only: dp
   use ehlwave_mesh, only: mesh_t
   use ehlwave_near_kernel, only: near_kernel_t
   use ehlwave_reynolds_links, only: flow_links, poiseuille_links
   implicit none (type, external)
   private
   public :: near_rows, node_links

#include "near_rows.inc"

end module ehlwave_complex_near_rows
