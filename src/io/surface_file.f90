!> Surfaces written by `ehlwave surface`: HDF5 with heights over x and y in metres.
module ehlwave_surface_file
   use ehlwave_errors, only: error_t, raise
   use ehlwave_kinds, only: dp
   use h5lt, only: h5ltget_dataset_info_f, h5ltget_dataset_ndims_f, h5ltread_dataset_double_f
   use hdf5, only: h5close_f, h5eset_auto_f, h5f_acc_rdonly_f, h5fclose_f, h5fopen_f, h5open_f, hid_t, hsize_t, size_t
   implicit none (type, external)
   private
   public :: read_surface_file

contains

   !> Read heights(nx, ny), m, positive out of the material, and the steps of `x` and `y`, m; step_y is 0 when ny = 1.
   !>
   !> In the file (C order) y comes first. Fails when the file or one of height, x and y is missing or of another
   !> shape, or when steps are not uniform.
   subroutine read_surface_file(path, height, step_x, step_y, error)
      character(len=*), intent(in) :: path
      real(dp), allocatable, intent(out) :: height(:, :)
      real(dp), intent(out) :: step_x, step_y
      type(error_t), allocatable, intent(inout) :: error
      real(dp), allocatable :: x(:), y(:), flat(:)
      integer(hsize_t), allocatable :: extent(:), extent_x(:), extent_y(:)
      integer(hid_t) :: file
      integer :: status
      logical :: exists

      step_x = 0
      step_y = 0
      inquire (file=path, exist=exists)
      if (.not. exists) then
         call raise(error, '&surface file = '''//path//''': no such file; ehlwave surface writes one')
         return
      end if
      call h5open_f(status)
      call h5eset_auto_f(0, status)
      call h5fopen_f(path, h5f_acc_rdonly_f, file, status)
      if (status < 0) then
         call raise(error, '&surface file = '''//path//''': is not an HDF5 file; ehlwave surface writes one')
      else
         call read_numbers(file, 'height', flat, extent)
         call read_numbers(file, 'x', x, extent_x)
         call read_numbers(file, 'y', y, extent_y)
         call h5fclose_f(file, status)
         if (size(extent) /= 2 .or. size(extent_x) /= 1 .or. size(extent_y) /= 1) then
            call raise(error, '&surface file = '''//path//''': needs height over (y, x), and x and y, in metres; '// &
                       'ehlwave surface writes them')
         else if (any(extent /= [extent_x, extent_y])) then
            call raise(error, '&surface file = '''//path//''': x and y do not have the numbers of points of height')
         end if
      end if
      call h5close_f(status)
      if (allocated(error)) return
      height = reshape(flat, [size(x), size(y)])
      call uniform_step(path, 'x', x, step_x, error)
      if (size(y) > 1) call uniform_step(path, 'y', y, step_y, error)
   end subroutine read_surface_file

   !> Numbers of a dataset in Fortran order; extent has no element when there is no such dataset.
   subroutine read_numbers(file, name, values, extent)
      integer(hid_t), intent(in) :: file
      character(len=*), intent(in) :: name
      real(dp), allocatable, intent(out) :: values(:)
      integer(hsize_t), allocatable, intent(out) :: extent(:)
      integer(size_t) :: bytes
      integer :: kind, rank, status

      allocate (extent(0), values(0))
      call h5ltget_dataset_ndims_f(file, name, rank, status)
      if (status < 0 .or. rank < 1) return
      deallocate (extent, values)
      allocate (extent(rank))
      call h5ltget_dataset_info_f(file, name, extent, kind, bytes, status)
      allocate (values(product(extent)))
      call h5ltread_dataset_double_f(file, name, values, extent, status)
      if (status < 0) extent = [integer(hsize_t) ::]
   end subroutine read_numbers

   !> Step of equidistant positions.
   subroutine uniform_step(path, name, positions, step, error)
      character(len=*), intent(in) :: path, name
      real(dp), intent(in) :: positions(:)
      real(dp), intent(out) :: step
      type(error_t), allocatable, intent(inout) :: error
      integer :: i

      step = 0
      if (size(positions) > 1) step = (positions(size(positions)) - positions(1))/(size(positions) - 1)
      if (allocated(error)) return
      do i = 1, size(positions)
         if (.not. abs(positions(i) - positions(1) - (i - 1)*step) <= 1e-6_dp*step*max(1, i)) then
            call raise(error, '&surface file = '''//path//''': '//name//' does not increase by equal steps')
            return
         end if
      end do
   end subroutine uniform_step

end module ehlwave_surface_file
