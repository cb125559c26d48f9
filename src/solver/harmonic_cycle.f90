!> The multigrid cycle that preconditions the response to a small wave.
module ehlwave_harmonic_cycle
   use ehlwave_complex_transfer, only: interpolate_complex, prolong_complex, restrict_complex
   use ehlwave_contact_problem, only: contact_problem_t
   use ehlwave_harmonic_factors, only: harmonic_factors_t
   use ehlwave_harmonic_level, only: harmonic_level_t
   use ehlwave_kinds, only: dp
   use ehlwave_smooth_share, only: set_smooth_share
   implicit none (type, external)
   private
   public :: cycle_pressure

   !> The equations on one grid, and what a cycle needs there.
   type, extends(harmonic_level_t), public :: cycle_level_t
      complex(dp), allocatable :: field(:, :)              !! right side in weighted rows, then change of P, (0:nx, 0:ny)
      type(harmonic_factors_t), private :: factors
      real(dp), allocatable, private :: smooth_share(:, :) ! of line contacts
      complex(dp), allocatable, private :: guess(:, :), dh(:, :), dr(:, :), work(:, :)
   contains
      procedure :: init
      procedure :: set_frequency
   end type cycle_level_t

contains

   !> Work space for a problem's grid.
   subroutine init(self, problem)
      class(cycle_level_t), intent(inout) :: self
      type(contact_problem_t), intent(in), target :: problem

      call self%harmonic_level_t%init(problem)
      call self%factors%init(self%harmonic_level_t)
      if (problem%grid%is_line) allocate (self%smooth_share, mold=self%scale)
      associate (nx => problem%grid%nx, ny => problem%grid%ny)
         allocate (self%field(0:nx, 0:ny), self%guess(0:nx, 0:ny), self%dh(0:nx, 0:ny), self%dr(0:nx, 0:ny), &
                   self%work(0:nx, 0:ny), source=(0.0_dp, 0.0_dp))
      end associate
   end subroutine init

   !> Equations and factors at one frequency.
   subroutine set_frequency(self, frequency, dt)
      class(cycle_level_t), intent(inout) :: self
      real(dp), intent(in) :: frequency       !! w in units of 1/T
      real(dp), intent(in) :: dt              !! step along the characteristic: hX of the finest grid

      call self%harmonic_level_t%set_frequency(frequency, dt)
      call self%factors%make(self%harmonic_level_t)
      if (allocated(self%smooth_share)) call set_smooth_share(self%scale, abs(self%transport%w0), self%flow%f_h, &
                                                              self%self_influence, self%smooth_share)
   end subroutine set_frequency

   !> One cycle for the pressure, in place in `field` of the finest level: correction from the coarser grid, then the
   !> factors of this one on what is left. The film change that goes with a correction is interpolated from the coarser
   !> grid too, in place of a convolution on this one (measured: at most one GMRES step more, a fifth less time).
   recursive subroutine cycle_pressure(levels)
      type(cycle_level_t), intent(inout) :: levels(:)   !! coarsest first
      integer :: n

      n = size(levels)
      if (n == 1) then
         call levels(1)%factors%solve(levels(1)%field)
         return
      end if
      associate (fine => levels(n), coarser => levels(n - 1), coarse => levels(n - 1)%problem%grid)
         fine%work = 0
         where (fine%row_scale > 0 .and. .not. fine%is_cavitated) fine%work = fine%field/fine%row_scale
         call restrict_complex(coarse, fine%work, coarser%field)
         where (coarser%is_cavitated)
            coarser%field = 0
         elsewhere
            coarser%field = coarser%field*coarser%row_scale
         end where
         call cycle_pressure(levels(:n - 1))
         call prolong_complex(coarse, coarser%field, fine%guess)
         where (fine%is_cavitated .or. .not. fine%row_scale > 0) fine%guess = 0
         call coarser%film_change(coarser%field, (0.0_dp, 0.0_dp), coarser%dh)
         call interpolate_complex(coarse, fine%problem%grid, coarser%dh, fine%dh)
         call fine%residual_change(fine%guess, fine%dh, fine%dr)
         fine%field = fine%field - fine%dr
         if (allocated(fine%smooth_share)) call remove_smooth_part(fine, coarser)
         call fine%factors%solve(fine%field)
         fine%field = fine%field + fine%guess
      end associate
   end subroutine cycle_pressure

   !> Take from what is left most of what the coarser grid can represent. The pressure of a line acts over longer
   !> distances than that of a cell. Measured (M = 100, L = 11, 8192 cells): 16 and 18 GMRES steps for waves of 2 a and
   !> a/4, without this 31 and 33; elliptical contacts do without.
   subroutine remove_smooth_part(fine, coarser)
      type(cycle_level_t), intent(inout) :: fine, coarser

      call restrict_complex(coarser%problem%grid, fine%field, coarser%work)
      call prolong_complex(coarser%problem%grid, coarser%work, fine%work)
      where (.not. fine%is_cavitated) fine%field = fine%field - fine%smooth_share*fine%work
   end subroutine remove_smooth_part

end module ehlwave_harmonic_cycle
