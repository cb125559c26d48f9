!> The medium that small waves meet in a solution: film and oil at each node.
module ehlwave_wave_medium
   use ehlwave_contact_problem, only: contact_problem_t
   use ehlwave_film_rules, only: across_film_t
   use ehlwave_kinds, only: dp
   use ehlwave_shear_stress, only: node_gradient, oil_of_row
   use ehlwave_state, only: state_t
   use ehlwave_two_waves, only: wave_medium_t
   implicit none (type, external)
   private
   public :: take_media

contains

   !> Media in every row of some columns of nodes, with the local temperatures of a warm oil and the local limiting
   !> stress.
   pure subroutine take_media(problem, state, first, medium)
      type(contact_problem_t), intent(in) :: problem
      type(state_t), intent(in) :: state
      integer, intent(in) :: first                          !! i of the first column, at least 1
      type(wave_medium_t), intent(out) :: medium(0:, first:)   !! (0:ny, first:last), last at most nx - 1
      real(dp), dimension(0:problem%grid%nx) :: b, drho, fluidity, rho, stress
      real(dp), allocatable, dimension(:, :) :: gx, gy
      real(dp) :: factor(2, 0:problem%grid%nx)
      type(across_film_t), allocatable :: across
      integer :: i, j

      associate (grid => problem%grid, c => problem%conditions, p => state%p, h => state%h)
         allocate (gx, gy, mold=p)
         if (.not. problem%rheology%is_newtonian()) call node_gradient(grid, c%elliptic%kappa, p, gx, gy)
         factor = 1
         do j = 0, grid%ny
            call oil_of_row(problem, state, j, rho, drho, fluidity, across)
            if (.not. problem%rheology%is_newtonian()) &
               call problem%film_flow%mean_stress(fluidity, h(:, j), gx(:, j), gy(:, j), stress, b, factor, across)
            do i = first, ubound(medium, 2)
               medium(j, i) = wave_medium_t(rho=rho(i), drho=drho(i), h=h(i, j), &
                  kappa=merge(1.0_dp, c%elliptic%kappa, c%is_line()), &
                  k=c%elliptic%k, eps=rho(i)*h(i, j)**3*fluidity(i)/c%lambdabar*factor(:, i))
            end do
         end do
      end associate
   end subroutine take_media

end module ehlwave_wave_medium
