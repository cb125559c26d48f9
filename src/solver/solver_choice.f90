!> The solvers of a method.
module ehlwave_solver_choice
   use ehlwave_conditions, only: conditions_t
   use ehlwave_fas_multigrid, only: fas_t
   use ehlwave_full_multigrid, only: full_multigrid_t
   use ehlwave_grid, only: grid_t
   use ehlwave_newton, only: newton_t
   use ehlwave_patch_solver, only: patch_solver_t
   use ehlwave_petsc_solver, only: petsc_solver_t
   use ehlwave_rheology, only: rheology_t
   implicit none (type, external)
   private
   public :: init_multigrid

   !> How levels are solved.
   type, public :: method_t
      character(len=6) :: solver = 'newton'       !! 'newton', 'fas', or 'petsc' for the finest level
      character(len=1) :: cycle = 'f'             !! cycle of FAS: 'v', 'w' or 'f'
      character(len=4) :: deformation = 'fft'     !! 'fft' or 'mlmi'
   end type method_t

contains

   !> Hierarchy down from the finest grid, and solvers for it.
   subroutine init_multigrid(self, conditions, rheology, finest, method)
      class(full_multigrid_t), intent(inout) :: self
      type(conditions_t), intent(in) :: conditions
      type(rheology_t), intent(in) :: rheology
      type(grid_t), intent(in) :: finest
      type(method_t), intent(in) :: method
      integer :: n

      call self%build(conditions, rheology, finest, method%deformation)
      n = size(self%levels)
      if (allocated(self%solver)) deallocate (self%solver)
      if (allocated(self%coarse_solver)) deallocate (self%coarse_solver)
      select case (method%solver)
      case ('fas')
         allocate (self%solver, source=fas_t(cycle=method%cycle))
      case ('petsc')
         allocate (petsc_solver_t :: self%solver)
         if (n > 1) allocate (newton_t :: self%coarse_solver)
      case default
         allocate (newton_t :: self%solver)
         select type (solver => self%solver)
         type is (newton_t)
            allocate (patch_solver_t :: solver%local)
         end select
      end select
      call self%solver%init(self%hierarchy_t, n)
      if (allocated(self%coarse_solver)) call self%coarse_solver%init(self%hierarchy_t, n - 1)
   end subroutine init_multigrid

end module ehlwave_solver_choice
