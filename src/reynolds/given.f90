!> Data of a solution besides its contact: earlier times, load, roughness.
module ehlwave_given
   use ehlwave_assertions, only: assert, checks
   use ehlwave_grid, only: grid_t
   use ehlwave_kinds, only: dp
   use ehlwave_load_balance, only: load_balance_t
   use ehlwave_transport, only: steady_transport, transport_t
   implicit none (type, external)
   private
   public :: steady_given

   !> Terms that change from one solution of a contact to the next. Each level of a hierarchy (`level_t`) owns an
   !> instance; equations are evaluated with it and keep nothing of it.
   type, public :: given_t
      type(transport_t) :: transport           !! wedge and squeeze, with terms of earlier times
      type(load_balance_t) :: load
      real(dp), allocatable :: rough(:, :)     !! Rough(X, Y, T), (0:nx, 0:ny); not allocated for smooth surfaces
      real(dp), allocatable :: edge_rough(:)   !! roughness at the nodes of flooded edges, if `rough` is set
                                               !! else
      real(dp), allocatable :: supply(:)       !! (0:ny) oil offered at the inlet edge, theta rho H; not allocated:
                                               !! flooded
      logical, allocatable :: is_empty(:, :)   !! (0:nx, 0:ny), with a supply: where P is held at 0 and the oil is not
                                               !! followed
   contains
      procedure :: set_rough
      procedure :: blend
      procedure :: conserves_oil
   end type given_t

contains

   !> The steady state of smooth surfaces under the nominal load.
   pure function steady_given(grid, supply) result(given)
      type(grid_t), intent(in) :: grid
      real(dp), intent(in), optional :: supply(0:)   !! oil offered; absent: flooded
      type(given_t) :: given
      given%transport = steady_transport(grid)
      if (present(supply)) allocate (given%supply(0:grid%ny), source=supply)
   end function steady_given

   !> Set the roughness added to the gap.
   pure subroutine set_rough(self, rough)
      class(given_t), intent(inout) :: self
      real(dp), intent(in) :: rough(0:, 0:)   !! (0:nx, 0:ny)
      if (checks .and. allocated(self%rough)) call assert(all(shape(rough) == shape(self%rough)), 'set_rough: one grid')
      if (.not. allocated(self%rough)) allocate (self%rough(0:ubound(rough, 1), 0:ubound(rough, 2)))
      self%rough = rough
   end subroutine set_rough

   !> The data between this (0) and `later` (1, to the last digit): roughness, terms of earlier times, load. Missing
   !> terms are taken from `later`; missing roughness is zero.
   pure function blend(self, later, place) result(between)
      class(given_t), intent(in) :: self
      type(given_t), intent(in) :: later
      real(dp), intent(in) :: place
      type(given_t) :: between

      between = later
      if (place >= 1) return
      between%load%force = (1 - place)*self%load%force + place*later%load%force
      between%load%carried = (1 - place)*self%load%carried + place*later%load%carried
      if (allocated(later%rough)) then
         between%rough = place*later%rough
         if (allocated(self%rough)) between%rough = between%rough + (1 - place)*self%rough
      end if
      if (allocated(later%transport%carried) .and. allocated(self%transport%carried)) &
         between%transport%carried = (1 - place)*self%transport%carried + place*later%transport%carried
      if (allocated(later%supply) .and. allocated(self%supply)) &
         between%supply(:) = (1 - place)*self%supply + place*later%supply
      if (allocated(later%transport%inflow) .and. allocated(self%transport%inflow)) &
         between%transport%inflow = (1 - place)*self%transport%inflow + place*later%transport%inflow
   end function blend

   !> Whether the oil of a gap is followed that may be partly filled.
   pure logical function conserves_oil(self)
      class(given_t), intent(in) :: self
      conserves_oil = allocated(self%supply) .and. .not. allocated(self%is_empty)
   end function conserves_oil

end module ehlwave_given
