!> Which way to compute the deformation is the faster one.
module ehlwave_deformation_choice
   use ehlwave_kinds, only: dp
   implicit none (type, external)
   private
   public :: chosen_deformation

   ! Measured, see the README of this folder. Below this size the gain is small and the error of MLMI is the larger; in contacts that
   ! are less slender transforms in single precision, for changes, are the faster.
   integer, parameter :: fewest_cells = 512*512          !! of the whole domain
   real(dp), parameter :: slender = 0.3_dp               !! largest kappa for which MLMI pays

contains

   !> 'fft' or 'mlmi' for a grid: as asked, or for 'auto' the faster one. MLMI halves with the domain, the zero-padded
   !> transform does not.
   pure function chosen_deformation(asked, cells_x, cells_y, is_half, kappa) result(choice)
      character(len=*), intent(in) :: asked         !! 'fft', 'mlmi' or 'auto'
      integer, intent(in) :: cells_x, cells_y       !! over the whole domain
      logical, intent(in) :: is_half                !! only Y >= 0 is computed
      real(dp), intent(in) :: kappa                 !! ellipticity a/b
      character(len=:), allocatable :: choice

      choice = trim(asked)
      if (choice /= 'auto') return
      choice = 'fft'
      if (real(cells_x, dp)*cells_y >= fewest_cells .and. is_half .and. kappa <= slender) choice = 'mlmi'
   end function chosen_deformation

end module ehlwave_deformation_choice
