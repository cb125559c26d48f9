!> Factors of the near part of the equations of a small wave on one grid, which a preconditioner solves with.
module ehlwave_harmonic_factors
   use ehlwave_complex_band, only: band_t, new_band
   use ehlwave_complex_ilu, only: ilu_t, new_ilu
   use ehlwave_harmonic_level, only: harmonic_level_t
   use ehlwave_harmonic_stencil, only: harmonic_stencil_t, new_harmonic_stencil
   use ehlwave_kinds, only: dp
   implicit none (type, external)
   private

   !> Factors, in flow order, of local terms and near deformation: incomplete ones of an elliptical contact, those of a
   !> band matrix of a line contact.
   type, public :: harmonic_factors_t
      private
      logical :: is_line = .false.
      integer :: first_row = 0
      type(harmonic_stencil_t) :: stencil
      type(ilu_t) :: ilu                                 ! of elliptical contacts,
      type(band_t) :: band                               ! of line contacts
      complex(dp), allocatable :: packed(:, :)           ! values at the unknown nodes, row first
   contains
      procedure :: init
      procedure :: make
      procedure :: solve
   end type harmonic_factors_t

   integer, parameter :: largest_reach = 8   !! cells of the near stencil, keeps memory bounded
   real(dp), parameter :: diagonal_shift(4) = [0.0_dp, 0.1_dp, 0.3_dp, 1.0_dp]   !! of incomplete factors, tried in turn

contains

   !> Pattern and storage for the grid of a level.
   subroutine init(self, level)
      class(harmonic_factors_t), intent(inout) :: self
      class(harmonic_level_t), intent(in) :: level
      integer :: columns, rows

      associate (grid => level%problem%grid, elliptic => level%problem%conditions%elliptic)
         self%is_line = grid%is_line
         self%first_row = grid%first_row
         self%stencil = new_harmonic_stencil(grid, elliptic%kappa, elliptic%k, largest_reach)
         rows = grid%ny - grid%first_row
         columns = grid%nx - 1
         allocate (self%packed(rows, columns), source=(0.0_dp, 0.0_dp))
         if (self%is_line) then
            self%band = new_band(columns, self%stencil%reach_x)
         else
            self%ilu = new_ilu(rows, columns, self%stencil%reach_y, self%stencil%reach_x)
         end if
      end associate
   end subroutine init

   !> Factors at the frequency of the level. Where incomplete ones blow up (waves of few points across a slender contact),
   !> the diagonal is shifted (Manteuffel 1980) until they do not.
   subroutine make(self, level)
      class(harmonic_factors_t), intent(inout) :: self
      class(harmonic_level_t), intent(in) :: level
      integer :: attempt

      if (self%is_line) then
         call fill_matrix(self, level, 0.0_dp)
         call self%band%factorise()
         return
      end if
      do attempt = 1, size(diagonal_shift)
         call fill_matrix(self, level, diagonal_shift(attempt))
         call self%ilu%factorise()
         if (self%ilu%is_bounded()) exit
      end do
   end subroutine make

   !> Weighted local terms and near deformation, for the factors to take their place. The diagonal gets `shift` of itself
   !> besides; a cavitated node has the row of the identity.
   subroutine fill_matrix(self, level, shift)
      class(harmonic_factors_t), intent(inout) :: self
      class(harmonic_level_t), intent(in) :: level
      real(dp), intent(in) :: shift
      complex(dp), allocatable :: rows(:, :)
      integer :: diagonal, i, j, k, row

      diagonal = (2*self%stencil%reach_x + 1)*(2*self%stencil%reach_y + 1)/2 + 1
      allocate (rows(size(self%packed, 1), 2*diagonal - 1))
      associate (kappa => level%problem%conditions%elliptic%kappa)
         do i = 1, size(self%packed, 2)
            call self%stencil%fill_lines(level%problem%grid, level%transport, kappa, level%flow, level%p, i, rows)
            do k = 1, size(rows, 2)
               do j = 1, size(rows, 1)
                  row = j - 1 + self%first_row
                  rows(j, k) = rows(j, k)*level%row_scale(i, row)
                  if (level%is_cavitated(i, row)) rows(j, k) = merge(1, 0, k == diagonal)
               end do
            end do
            rows(:, diagonal) = (1 + shift)*rows(:, diagonal)
            if (self%is_line) then
               self%band%a(i, :) = rows(1, :)
            else
               call self%ilu%set_line(i, rows)
            end if
         end do
      end associate
   end subroutine fill_matrix

   !> Solve in place.
   subroutine solve(self, field)
      class(harmonic_factors_t), intent(inout) :: self
      complex(dp), intent(inout) :: field(0:, 0:)   !! right side in weighted rows, then change of P, (0:nx, 0:ny)
      integer :: columns, low, top

      low = self%first_row
      top = low + size(self%packed, 1) - 1
      columns = size(self%packed, 2)
      self%packed = transpose(field(1:columns, low:top))
      if (self%is_line) then
         call self%band%solve(self%packed(1, :))
      else
         call self%ilu%solve(self%packed)
      end if
      field = 0
      field(1:columns, low:top) = transpose(self%packed)
   end subroutine solve

end module ehlwave_harmonic_factors
