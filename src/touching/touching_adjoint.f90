!> Transposed solves of a contact whose surfaces may touch.
module ehlwave_touching_adjoint
   use ehlwave_kinds, only: dp
   use ehlwave_real_gmres, only: gmres_t, norm
   use ehlwave_touching_transposed, only: touching_transposed_t
   implicit none (type, external)
   private
   public :: solve_adjoint

   integer, parameter :: most_rounds = 4   !! of a solution and its refinement
   real(dp), parameter :: first_round = 1e-4_dp        !! tolerance of a round with factors in single precision
   real(dp), parameter :: single_rounding = 1e-6_dp    !! at most, relative, of their preconditioner,
   real(dp), parameter :: double_rounding = 1e-13_dp   !! and with factors in double precision

contains

   !> Solve A^T x = b, preconditioned from the left: what the product and the preconditioner deform is deformed at once.
   !>
   !> The estimate of GMRES leaves out what the preconditioner rounds, about 1e-7 with the factors of an elliptical
   !> contact, which are in single precision. So the first round with these ends early; the residual of the solution is
   !> computed, and the solution refined until this residual is small, as computed, or as estimated where rounding
   !> cannot matter.
   subroutine solve_adjoint(system, gmres, b, x, is_solved, tolerance, steps)
      type(touching_transposed_t), intent(inout) :: system
      type(gmres_t), intent(inout) :: gmres
      real(dp), intent(in), contiguous :: b(:)
      real(dp), intent(out), contiguous :: x(:)
      logical, intent(out) :: is_solved
      real(dp), intent(in) :: tolerance               !! of the preconditioned residual
      integer, intent(out), optional :: steps         !! of GMRES
      real(dp), dimension(size(b)) :: change, image, right
      real(dp) :: first, now, rounding
      integer :: round, taken

      system%ahead = 0
      call system%finish(b, right)
      first = norm(right)
      now = first
      x = 0
      taken = 0
      rounding = merge(double_rounding, single_rounding, system%grid%is_line)
      is_solved = first <= 0
      do round = 1, most_rounds
         if (is_solved) exit
         call gmres%solve(system, right, change, max(tolerance*first/now, merge(tolerance, first_round, &
                                                                                system%grid%is_line)))
         taken = taken + gmres%steps
         x = x + change
         is_solved = max(gmres%reduction, 10*rounding)*now <= tolerance*first
         if (is_solved) exit
         call system%product(x, image)
         system%ahead = -system%ahead
         call system%finish(b - image, right)
         now = norm(right)
         is_solved = now <= tolerance*first
      end do
      if (present(steps)) steps = taken
   end subroutine solve_adjoint

end module ehlwave_touching_adjoint
