!> The medium that small waves meet in a solution: film and oil at each node.
module ehlwave_wave_medium
   use ehlwave_contact_problem, only: contact_problem_t
   use ehlwave_film_flow, only: across_film_t
   use ehlwave_kinds, only: dp
   use ehlwave_shear_stress, only: node_gradient
   use ehlwave_state, only: state_t
   use ehlwave_two_waves, only: wave_medium_t
   implicit none (type, external)
   private
   public :: take_media

contains

   !> Media in every row of some columns of nodes; of an oil that is warm, at the temperatures that it has
   !> there, and of one whose stress is limited, at the limit there.
   pure subroutine take_media(problem, state, first, medium)
      type(contact_problem_t), intent(in) :: problem
      type(state_t), intent(in) :: state
      integer, intent(in) :: first                          !! i of the first column, at least 1
      type(wave_medium_t), intent(out) :: medium(0:, first:)   !! (0:ny, first:last), last at most nx - 1
      real(dp), dimension(0:problem%grid%ny) :: b, dln_eta, drho, fluidity, rho, stress
      real(dp), allocatable, dimension(:, :) :: gx, gy
      real(dp) :: factor(2, 0:problem%grid%ny)
      type(across_film_t), allocatable :: across
      logical :: is_limited
      integer :: i, j

      associate (grid => problem%grid, c => problem%conditions, p => state%p, h => state%h)
         allocate (gx, gy, mold=p)
         if (.not. problem%rheology%is_newtonian()) call node_gradient(grid, c%elliptic%kappa, p, gx, gy)
         factor = 1
         is_limited = .false.
         if (allocated(problem%film_flow)) is_limited = allocated(problem%film_flow%limit)
         if (allocated(problem%heat) .or. is_limited) allocate (across)
         do i = first, ubound(medium, 2)
            if (allocated(problem%heat)) then
               call problem%rheology%evaluate(grid%ny + 1, p(i, :), rho, drho, fluidity, dln_eta, &
                                              problem%heat%mean_rise(i, :))
               across%ln_fluidity = problem%heat%ln_fluidity(:, i, :)
               across%range = problem%heat%range(i, :)
               if (allocated(problem%heat%moments)) across%moments = problem%heat%moments(:, i, :)
            else
               call problem%rheology%evaluate(grid%ny + 1, p(i, :), rho, drho, fluidity, dln_eta)
            end if
            if (is_limited) across%p = p(i, :)
            if (.not. problem%rheology%is_newtonian()) &
               call problem%film_flow%mean_stress(fluidity, h(i, :), gx(i, :), gy(i, :), stress, b, factor, across)
            do j = 0, grid%ny
               medium(j, i) = wave_medium_t(rho=rho(j), drho=drho(j), h=h(i, j), &
                  kappa=merge(1.0_dp, c%elliptic%kappa, c%is_line()), &
                  k=c%elliptic%k, eps=rho(j)*h(i, j)**3*fluidity(j)/c%lambdabar*factor(:, j))
            end do
         end do
      end associate
   end subroutine take_media

end module ehlwave_wave_medium
