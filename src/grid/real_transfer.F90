#define SCALAR real(dp)
!> Transfers of real node values between a grid and a grid with half as many cells.
module ehlwave_real_transfer
   use ehlwave_grid, only: grid_t
   use ehlwave_kinds, only: dp
   use ehlwave_threads, only: is_shared
   implicit none (type, external)
   private
   public :: interpolate, inject, prolong, prolong_transposed, restrict, restrict_transposed

contains

#include "transfer.inc"

end module ehlwave_real_transfer
