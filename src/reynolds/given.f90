!> Data of a solution besides its contact: earlier times, load, roughness.
module ehlwave_given
   use ehlwave_kinds, only: dp
   use ehlwave_load_balance, only: load_balance_t
   use ehlwave_transport, only: transport_t
   implicit none (type, external)
   private

   !> Terms that change from one solution of a contact to the next.
   type, public :: given_t
      type(transport_t) :: transport           !! wedge and squeeze, with terms of earlier times
      type(load_balance_t) :: load
      real(dp), allocatable :: rough(:, :)     !! Rough(X, Y, T), (0:nx, 0:ny); not allocated for smooth surfaces
      real(dp), allocatable :: edge_rough(:)   !! the same at the nodes of flooded edges, where `rough` holds something
                                               !! else
   contains
      procedure :: blend
   end type given_t

contains

   !> The data between this (0) and `later` (1, to the last digit): roughness, terms of earlier times, load. What is
   !> not there counts as `later` has it, roughness as none.
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
   end function blend

end module ehlwave_given
