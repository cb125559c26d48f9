!> A grid with the weights of a difference of fluxes: the left side of the discrete Reynolds equation, theory eq. (D1).
module ehlwave_mesh
   use ehlwave_grid, only: grid_t
   use ehlwave_kinds, only: dp
   implicit none (type, external)
   private
   public :: new_mesh

   type, public :: mesh_t
      type(grid_t) :: grid
      real(dp) :: kappa = 1
      real(dp) :: cx = 0, cy = 0   !! 1/(2 hX^2), kappa^2/(2 hY^2): a flux is twice that at the mean of its nodes
   end type mesh_t

contains

   !> Weights of a grid for a contact of ellipticity kappa.
   pure function new_mesh(grid, kappa) result(self)
      type(grid_t), intent(in) :: grid
      real(dp), intent(in) :: kappa
      type(mesh_t) :: self
      self%grid = grid
      self%kappa = kappa
      self%cx = 0.5_dp/grid%hx**2
      self%cy = 0.5_dp*kappa**2/grid%hy**2
   end function new_mesh

end module ehlwave_mesh
