!> Discretisation error of a result from its values on grids of mesh size h, 2h and 4h, and from a model.
!>
!> One rule for every quantity, theory eq. (E1): the largest of two Richardson estimates and of a share of the error
!> that a model expects, times a factor. The factors are data, see `ehlwave_error_factors`.
module ehlwave_mesh_errors
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ehlwave_error_factors, only: by_grids, by_model
   use ehlwave_kinds, only: dp, no_value
   implicit none (type, external)
   private
   public :: kind_of, least_error, mesh_error, observed_order, richardson_error

   !> Fall of errors of fitted grids from 4h to 2h: there they are of third order and more, while steep inlets are of
   !> second order in the end.
   real(dp), parameter :: fitted_fall = 8
   real(dp), parameter :: model_share = 0.3_dp     !! of the expected error: grids can agree by chance

   !> Relative error of a quantity and its source.
   type, public :: mesh_error_t
      real(dp) :: relative = no_value              !! NaN: unknown
      character(len=12) :: basis = ''              !! 'coarse_grid' or 'model'
   end type mesh_error_t

   interface mesh_error
      module procedure error_of_real, error_of_complex
   end interface mesh_error

contains

   !> Column of the table: scheme of the Reynolds equation, and shape of the contact.
   elemental integer function kind_of(is_fitted, is_line) result(kind)
      logical, intent(in) :: is_fitted, is_line
      kind = merge(3, 1, is_fitted) + merge(1, 0, is_line)
   end function kind_of

   !> Least relative error that coarser grids can show.
   elemental real(dp) function least_error(quantity, kind, expected)
      integer, intent(in) :: quantity, kind        !! see `mesh_error`
      real(dp), intent(in) :: expected             !! relative error by the model
      least_error = by_grids(quantity, kind)*model_share*expected
   end function least_error

   !> Relative error of values(1).
   pure type(mesh_error_t) function error_of_real(quantity, kind, values, expected, order) result(error)
      integer, intent(in) :: quantity              !! row of the table
      integer, intent(in) :: kind                  !! column of the table, see `kind_of`
      real(dp), intent(in) :: values(:)            !! on meshes h, 2h, 4h: the finest first; NaN where not solved
      real(dp), intent(in) :: expected             !! relative error by the model
      real(dp), intent(in), optional :: order      !! of the error in the mesh size; absent: 2
      error = error_of_complex(quantity, kind, cmplx(values, kind=dp), expected, order)
   end function error_of_real

   pure type(mesh_error_t) function error_of_complex(quantity, kind, values, expected, order) result(error)
      integer, intent(in) :: quantity
      integer, intent(in) :: kind
      complex(dp), intent(in) :: values(:)
      real(dp), intent(in) :: expected
      real(dp), intent(in), optional :: order
      real(dp) :: by_richardson

      if (kind > 2) then
         by_richardson = richardson_error(values, order, fitted_fall)
      else
         by_richardson = richardson_error(values, order)
      end if
      if (ieee_is_finite(by_richardson)) then
         error = mesh_error_t(max(by_grids(quantity, kind)*by_richardson, least_error(quantity, kind, expected)), &
                              'coarse_grid')
      else if (expected > 0) then
         error = mesh_error_t(by_model(quantity, kind)*expected, 'model')
      end if
   end function error_of_complex

   !> Larger of two estimates: |v(h) - v(2h)|/(2^p - 1), and |v(2h) - v(4h)|/(2^p (2^p - 1)) where there are three
   !> values, over |v(h)|. NaN without two values.
   pure real(dp) function richardson_error(values, order, fall) result(error)
      complex(dp), intent(in) :: values(:)
      real(dp), intent(in), optional :: order
      real(dp), intent(in), optional :: fall       !! of the error from mesh size 4h to 2h; absent: 2^p
      real(dp) :: coarse_ratio, ratio              ! of errors on meshes 4h and 2h, 2h and h

      error = no_value
      if (size(values) < 2) return
      if (.not. (all(ieee_is_finite(abs(values(:2)))) .and. abs(values(1)) > 0)) return
      ratio = 4
      if (present(order)) ratio = 2**order
      error = abs(values(1) - values(2))
      if (size(values) > 2) then
         coarse_ratio = ratio
         if (present(fall)) coarse_ratio = fall
         if (ieee_is_finite(abs(values(3)))) error = max(error, abs(values(2) - values(3))/coarse_ratio)
      end if
      error = error/((ratio - 1)*abs(values(1)))
   end function richardson_error

   !> Theory eq. (E2): log2 of |v(2h) - v(4h)|/|v(h) - v(2h)|; NaN without three finite values or where they do not
   !> differ.
   pure real(dp) function observed_order(values)
      real(dp), intent(in) :: values(:)   !! on meshes h, 2h, 4h, ...: the finest first
      real(dp) :: fine, coarse

      observed_order = no_value
      if (size(values) < 3) return
      if (.not. all(ieee_is_finite(values(:3)))) return
      fine = abs(values(1) - values(2))
      coarse = abs(values(2) - values(3))
      if (fine > 0 .and. coarse > 0) observed_order = log(coarse/fine)/log(2.0_dp)
   end function observed_order

end module ehlwave_mesh_errors
