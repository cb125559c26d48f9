!> Account of a contact whose surfaces may touch, over a solution or the steps of a march.
module ehlwave_touching_account_result
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ehlwave_conditions, only: conditions_t
   use ehlwave_grid, only: strip_width
   use ehlwave_kinds, only: dp, no_value, pi
   use ehlwave_shear_stress, only: friction_at
   use ehlwave_state, only: state_t
   use ehlwave_text, only: to_text
   use ehlwave_touching_continuation, only: share_of
   use ehlwave_touching_newton, only: touching_solver_t
   use ehlwave_touching_state, only: touching_state_t
   implicit none (type, external)
   private
   public :: error_of, state_of

   !> Values of one solution, or means over the time that is measured.
   type, public :: touching_values_t
      real(dp) :: share = no_value                 !! of the load that the solids bear
      real(dp) :: area = no_value                  !! where they do, over the Hertz area
      real(dp) :: friction_oil = no_value          !! friction coefficient of the oil
      real(dp) :: speed = no_value                 !! m/s
      real(dp) :: mean_film = no_value             !! mean of H where Hertz's contact is
      real(dp) :: max_contact_pressure = no_value  !! largest C
      real(dp) :: max_total_pressure = no_value    !! largest P + C
   contains
      procedure :: take
      procedure :: add
   end type touching_values_t

   type, extends(touching_values_t), public :: touching_account_t
      real(dp) :: share_error = no_value, area_error = no_value   !! absolute
      real(dp) :: speed_error = no_value                          !! relative
      logical :: is_artefact = .false.             !! whether the share falls with the mesh size
      real(dp) :: solid_friction = no_value        !! friction coefficient of the solids
      real(dp) :: mass_error = no_value            !! largest mass residual
      integer :: meshes = 0                        !! that the errors are from
      integer :: planned_meshes = 0                !! meshes that were computed, with or without a solution
      ! of the steps of a march:
      real(dp), allocatable, dimension(:) :: share_history, area_history, friction_history, mean_film_history
      real(dp), allocatable :: c(:, :), theta(:, :)               !! fields of the last solution
   contains
      procedure :: estimate
      procedure :: warning
   end type touching_account_t

   ! share on half the mesh over the share before: below it falls with it
   real(dp), parameter :: falling = 0.6_dp
   real(dp), parameter :: notable = 1e-4_dp        !! share that may be an artefact

contains

   !> Values of a solution.
   subroutine take(self, solver, state)
      class(touching_values_t), intent(out) :: self
      type(touching_solver_t), intent(in) :: solver
      type(touching_state_t), intent(in) :: state
      real(dp), allocatable :: inside(:, :)
      integer :: j

      associate (problem => solver%problem, grid => solver%problem%grid)
         self%share = share_of(solver, state)
         self%area = grid%integral(merge(1.0_dp, 0.0_dp, state%is_touching))/hertz_area(problem%conditions)
         self%friction_oil = friction_at(problem, state_of(state))
         self%speed = state%speed
         allocate (inside, mold=state%h)
         do j = 0, grid%ny
            inside(:, j) = merge(1.0_dp, 0.0_dp, grid%x**2 + merge(0.0_dp, grid%y(j)**2, grid%is_line) < 1)
         end do
         self%mean_film = grid%integral(inside*state%h)/grid%integral(inside)
         self%max_contact_pressure = maxval(state%c)
         self%max_total_pressure = maxval(state%p + state%c)
      end associate
   end subroutine take

   !> Add a solution to a mean over `n` of them; largest values stay.
   subroutine add(self, one, n)
      class(touching_values_t), intent(inout) :: self
      class(touching_values_t), intent(in) :: one
      integer, intent(in) :: n
      if (.not. ieee_is_finite(self%share)) then
         self%share = 0
         self%area = 0
         self%friction_oil = 0
         self%speed = 0
         self%mean_film = 0
         self%max_contact_pressure = 0
         self%max_total_pressure = 0
      end if
      self%share = self%share + one%share/n
      self%area = self%area + one%area/n
      self%friction_oil = self%friction_oil + one%friction_oil/n
      self%speed = self%speed + one%speed/n
      self%mean_film = self%mean_film + one%mean_film/n
      self%max_contact_pressure = max(self%max_contact_pressure, one%max_contact_pressure)
      self%max_total_pressure = max(self%max_total_pressure, one%max_total_pressure)
   end subroutine add

   !> Area of Hertz's contact, of a line over its strip.
   pure real(dp) function hertz_area(conditions)
      type(conditions_t), intent(in) :: conditions
      hertz_area = merge(2*strip_width, pi, conditions%is_line())
   end function hertz_area

   !> The state of the oil.
   function state_of(touching) result(state)
      type(touching_state_t), intent(in) :: touching
      type(state_t) :: state
      allocate (state%p, source=touching%p)
      allocate (state%h, source=touching%h)
      state%delta = touching%delta
   end function state_of

   !> Errors by the mesh: the difference to the mesh twice as wide, or a quarter of the difference before where that
   !> is more; of the area a cell at either edge besides. In a march its unrest is added. The share is an artefact where
   !> it is above 0 and falls each time the mesh is halved.
   subroutine estimate(self, levels, hx, unrest)
      class(touching_account_t), intent(inout) :: self
      class(touching_values_t), intent(in) :: levels(:)   !! the same on wider meshes, the finest first
      real(dp), intent(in) :: hx                          !! mesh size of the result
      real(dp), intent(in) :: unrest(2)                   !! of share and area

      self%meshes = 1 + size(levels)
      if (size(levels) == 0) return
      self%share_error = error_of([self%share, levels%share]) + unrest(1)
      self%area_error = error_of([self%area, levels%area]) + hx + unrest(2)
      self%speed_error = error_of([self%speed, levels%speed])/self%speed
      if (self%share > notable) self%is_artefact = self%share < falling*levels(1)%share
      if (size(levels) > 1) self%is_artefact = self%is_artefact .and. levels(1)%share < levels(2)%share
   end subroutine estimate

   !> Difference to the next wider mesh, or a quarter of the difference before where that is more.
   pure real(dp) function error_of(values) result(error)
      real(dp), intent(in) :: values(:)                   !! the finest first
      error = abs(values(1) - values(2))
      if (size(values) > 2) error = max(error, 0.25_dp*abs(values(2) - values(3)))
   end function error_of

   !> Warning of a share that the mesh makes; '' where it does not.
   function warning(self) result(text)
      class(touching_account_t), intent(in) :: self
      character(len=:), allocatable :: text
      text = ''
      if (self%is_artefact) text = 'the share of the load on the solids, '//to_text(self%share, 2)// &
         ', falls with the mesh size: this touching is an artefact of the mesh, use more cells'
      if (self%meshes /= 1) return
      text = 'no error of touching_share and touching_area, as '
      if (self%planned_meshes > 1) then
         text = text//'the mesh twice as wide has no solution: use more cells'
      else
         text = text//'the mesh cannot be made twice as wide: use a number of cells that can be halved'
      end if
   end function warning

end module ehlwave_touching_account_result
