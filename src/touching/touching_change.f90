!> A change of the unknowns of a contact whose surfaces may touch, or the residuals of its equations.
module ehlwave_touching_change
   use ehlwave_grid, only: grid_t
   use ehlwave_kinds, only: dp
   implicit none (type, external)
   private
   public :: new_change

   type, public :: touching_change_t
      real(dp), allocatable :: p(:, :)           !! of P, or of theta where it is cavitated; the residual of the oil
      real(dp), allocatable :: c(:, :)           !! of C; the gap above what the solids ask for, where they bear
      real(dp) :: delta = 0                      !! of Delta; the residual of the load balance
      real(dp) :: ln_speed = 0                   !! of ln(speed); the share of the solids above that given
      logical :: seeks_speed = .false.           !! whether the share is given
      real(dp), allocatable :: by_speed(:, :)    !! derivative of the residual of the oil by ln(speed), if it is
   end type touching_change_t

contains

   function new_change(grid) result(self)
      type(grid_t), intent(in) :: grid
      type(touching_change_t) :: self
      call grid%new_field(self%p)
      call grid%new_field(self%c)
      call grid%new_field(self%by_speed)
   end function new_change

end module ehlwave_touching_change
