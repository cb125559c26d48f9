!> Which way to compute the deformation is the faster one.
module ehlwave_deformation_choice
   use ehlwave_kinds, only: dp
   implicit none (type, external)
   private
   public :: chosen_deformation

   ! Measured, see the README of this folder. Below this size the gain is small and the error of MLMI is the larger; of contacts that
   ! are less slender the transform in single precision, for changes, is the faster.
   integer, parameter :: fewest_cells = 512*512          !! of the whole domain
   real(dp), parameter :: slender = 0.2_dp               !! largest kappa for which MLMI pays

contains

   !> 'fft' or 'mlmi' for a grid: as asked, or for 'auto' the faster one.
   pure function chosen_deformation(asked, cells_x, cells_y, kappa) result(choice)
      character(len=*), intent(in) :: asked         !! 'fft', 'mlmi' or 'auto'
      integer, intent(in) :: cells_x, cells_y       !! over the whole domain
      real(dp), intent(in) :: kappa                 !! ellipticity a/b
      character(len=:), allocatable :: choice

      choice = trim(asked)
      if (choice /= 'auto') return
      choice = 'fft'
      if (real(cells_x, dp)*cells_y >= fewest_cells .and. kappa <= slender) choice = 'mlmi'
   end function chosen_deformation

end module ehlwave_deformation_choice
