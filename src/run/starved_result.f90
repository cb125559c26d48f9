!> Results of a contact with too little oil.
module ehlwave_starved_result
   use ehlwave_error_estimate, only: estimate_error
   use ehlwave_grid, only: grid_t
   use ehlwave_hierarchy, only: level_t
   use ehlwave_kinds, only: dp, no_value
   use ehlwave_oil_passage, only: follow_oil, oil_passage_t
   use ehlwave_starvation, only: flooded_t
   use ehlwave_text, only: to_text
   implicit none (type, external)
   private

   !> Values of flooded contacts are NaN.
   type, public :: starved_result_t
      real(dp) :: oil_over_flooded = no_value       !! r at Y = 0
      real(dp) :: flooded_film = no_value           !! H(0,0) with plenty of oil
      real(dp) :: film_over_flooded = no_value      !! R
      real(dp) :: film_over_flooded_error = no_value   !! estimated relative discretisation error, from grids
      real(dp) :: edge_error = 0                    !! of the film, relative, by an inlet edge that the full gap reaches
      real(dp) :: solve_over_flooded = no_value     !! counted work of the starved solve over that of the flooded one
      type(oil_passage_t) :: passage                !! of the smooth contact
      real(dp), allocatable :: content(:, :)        !! theta of the last solution, if fields are kept
   contains
      procedure :: take
      procedure :: is_full_to_edge
      procedure :: warning => edge_warning
   end type starved_result_t

contains

   !> Account of a starved steady state and of the flooded one it came from.
   subroutine take(self, levels, flooded, work)
      class(starved_result_t), intent(inout) :: self
      type(level_t), intent(in) :: levels(:)     !! coarsest first
      type(flooded_t), intent(in) :: flooded
      real(dp), intent(in) :: work               !! operations of both
      real(dp) :: ratios(size(levels))
      integer :: n

      n = size(levels)
      associate (level => levels(n), grid => levels(n)%problem%grid)
         ratios = levels%central_film/flooded%film
         self%flooded_film = flooded%film(n)
         self%film_over_flooded = ratios(n)
         self%film_over_flooded_error = estimate_error(ratios(n:1:-1))
         self%oil_over_flooded = level%given%supply(minloc(abs(grid%y), 1) - 1)/flooded%oil(n)
         self%solve_over_flooded = work/flooded%work - 1
         call follow_oil(level%problem, level%given, level%state, self%passage)
         ! a longer domain has a thicker film, the flooded one at most
         if (self%is_full_to_edge(grid)) self%edge_error = max(0.0_dp, flooded%film(n)/level%central_film - 1)
      end associate
   end subroutine take

   !> Whether the gap fills at the inlet edge, which has less oil than gap.
   pure logical function is_full_to_edge(self, grid)
      class(starved_result_t), intent(in) :: self
      type(grid_t), intent(in) :: grid
      is_full_to_edge = self%passage%meniscus_x < grid%x(0) + 1.5_dp*grid%hx
   end function is_full_to_edge

   !> A warning where the gap fills at the inlet edge, which has less oil than gap; '' where it does not.
   pure function edge_warning(self, grid) result(text)
      class(starved_result_t), intent(in) :: self
      type(grid_t), intent(in) :: grid
      character(len=:), allocatable :: text
      text = ''
      if (.not. self%is_full_to_edge(grid)) return
      text = 'the gap is full from the inlet edge on, which has less oil than gap: a longer domain '// &
             '(&grid x_min below '//to_text(grid%x(0), 4)//') has a thicker film'
   end function edge_warning

end module ehlwave_starved_result
