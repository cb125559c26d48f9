!> Surfaces written by `ehlwave surface`: HDF5 with heights over x and y in metres.
module ehlwave_surface_file
   use, intrinsic :: iso_c_binding, only: c_funloc, c_size_t
   use ehlwave_errors, only: error_t, raise
   use ehlwave_hdf5_reading, only: has_hdf5_signature, is_written_to, open_hdf5
   use ehlwave_kinds, only: dp
   use ehlwave_memory, only: can_allocate
   use ehlwave_process, only: guarded
   use ehlwave_text, only: to_text
   use h5lt, only: h5ltget_dataset_info_f, h5ltget_dataset_ndims_f, h5ltread_dataset_double_f
   use hdf5, only: h5close_f, h5d_virtual_f, h5dclose_f, h5dget_create_plist_f, h5dget_storage_size_f, h5dopen_f, &
      h5fclose_f, h5l_type_hard_f, h5lget_info_f, h5pclose_f, &
      h5pget_external_count_f, h5pget_layout_f, h5pget_nfilters_f, h5t_float_f, h5t_integer_f, hid_t, hsize_t, size_t
   implicit none (type, external)
   private
   public :: read_surface_file

   real(dp), parameter :: most_points = 5e7_dp   !! most points of a height: 400 MB
   real(dp), parameter :: most_compressed = 1100 !! most bytes that deflate packs into a byte (1032), and a little
   integer(size_t), parameter :: largest_number = 16   !! bytes; damaged files claim numbers of gigabytes
   real(dp), parameter :: always_read = 1e5_dp   !! points, whatever the file holds of them

   !> The file that is being read, at module level for work that is guarded.
   type :: reading_t
      character(len=:), allocatable :: path
      real(dp), allocatable :: flat(:), x(:), y(:)
      integer(hsize_t), allocatable :: extent(:), extent_x(:), extent_y(:)
      type(error_t), allocatable :: error
   end type reading_t
   type(reading_t) :: reading

contains

   !> Read heights(nx, ny), m, positive out of the material, and the steps of `x` and `y`, m; step_y is 0 when ny = 1.
   !>
   !> In the file (C order) y comes first. Fails when the file, height, x or y is missing or of another shape, or
   !> when steps are not uniform.
   subroutine read_surface_file(path, height, step_x, step_y, error)
      character(len=*), intent(in) :: path
      real(dp), allocatable, intent(out) :: height(:, :)
      real(dp), intent(out) :: step_x, step_y
      type(error_t), allocatable, intent(inout) :: error
      character(len=:), allocatable :: reason
      logical :: is_hdf5

      step_x = 0
      step_y = 0
      call has_hdf5_signature(path, is_hdf5, reason)
      if (reason /= '') then
         call raise(error, '&surface file = '''//path//''': cannot be read ('//reason// &
            '); ehlwave surface writes one')
         return
      else if (is_written_to(path)) then
         call raise(error, '&surface file = '''//path//''': another program holds it open for writing: close it '// &
            'there (HDF5_USE_FILE_LOCKING=FALSE reads it all the same)')
         return
      end if
      reading = reading_t(path=path)
      if (guarded(c_funloc(read_datasets)) /= 0) then
         call raise(error, '&surface file = '''//path//''': the HDF5 library breaks down on it: the file is damaged')
      else if (allocated(reading%error)) then
         call move_alloc(reading%error, error)
      else
         height = reshape(reading%flat, [size(reading%x), size(reading%y)])
         call uniform_step(path, 'x', reading%x, step_x, error)
         if (size(reading%y) > 1) call uniform_step(path, 'y', reading%y, step_y, error)
      end if
      reading = reading_t()
   end subroutine read_surface_file

   !> Read height, x and y. The library does not survive every file that is damaged or meant to harm.
   subroutine read_datasets() bind(c)
      integer(hid_t) :: file
      integer :: status
      logical :: is_open

      associate (path => reading%path)
         call open_hdf5(path, file, is_open)
         if (.not. is_open) then
            call raise(reading%error, '&surface file = '''//path//''': is not an HDF5 file; ehlwave surface writes one')
         else
            call read_numbers(path, file, 'height', reading%flat, reading%extent, reading%error)
            call read_numbers(path, file, 'x', reading%x, reading%extent_x, reading%error)
            call read_numbers(path, file, 'y', reading%y, reading%extent_y, reading%error)
            call h5fclose_f(file, status)
            if (allocated(reading%error)) then
               continue
            else if (size(reading%extent) /= 2 .or. size(reading%extent_x) /= 1 .or. size(reading%extent_y) /= 1) then
               call raise(reading%error, '&surface file = '''//path// &
                  ''': needs height over (y, x), and x and y, in metres; ehlwave surface writes them')
            else if (any(reading%extent /= [reading%extent_x, reading%extent_y])) then
               call raise(reading%error, '&surface file = '''//path// &
                  ''': x and y do not have the numbers of points of height')
            end if
         end if
         call h5close_f(status)
      end associate
   end subroutine read_datasets

   !> Numbers of a dataset in Fortran order; extent has no element when there is no such dataset. Fails, before it asks
   !> for memory, on more numbers than a surface may have and on some that the file claims and does not hold.
   subroutine read_numbers(path, file, name, values, extent, error)
      character(len=*), intent(in) :: path
      integer(hid_t), intent(in) :: file
      character(len=*), intent(in) :: name
      real(dp), allocatable, intent(out) :: values(:)
      integer(hsize_t), allocatable, intent(out) :: extent(:)
      type(error_t), allocatable, intent(inout) :: error
      integer(hsize_t) :: stored
      integer(size_t) :: bytes
      real(dp) :: held, points
      integer :: kind, rank, status
      logical :: fits, is_elsewhere

      allocate (extent(0), values(0))
      if (allocated(error)) return
      call look_at_storage(file, name, stored, held, is_elsewhere)
      if (is_elsewhere) then
         call raise(error, '&surface file = '''//path//''': the numbers of '//name//' are not in the file itself '// &
                    'but where a link, external storage or a virtual dataset leads: copy them into one file')
         return
      end if
      call h5ltget_dataset_ndims_f(file, name, rank, status)
      if (status < 0 .or. rank < 1) return
      deallocate (extent)
      allocate (extent(rank))
      call h5ltget_dataset_info_f(file, name, extent, kind, bytes, status)
      points = product(real(extent, dp))
      if (status < 0 .or. (kind /= h5t_float_f .and. kind /= h5t_integer_f)) then
         extent = [integer(hsize_t) ::]
      else if (points > most_points) then
         call raise(error, '&surface file = '''//path//''': '//name//' has '//to_text(points, 3)// &
            ' points, more than '//to_text(most_points, 3)//': cut or resample it')
      else
         if ((points*bytes > held .and. points > always_read) .or. bytes > largest_number) stored = 0
         fits = can_allocate(int(8*points, c_size_t))
         if (stored > 0 .and. fits) then
            deallocate (values)
            allocate (values(product(extent)))
            call h5ltread_dataset_double_f(file, name, values, extent, status)
         end if
         if (stored == 0 .or. .not. fits .or. status < 0) call raise(error, '&surface file = '''//path// &
            ''': the numbers of '//name//' cannot be read: the file is damaged or was not written to its end')
      end if
   end subroutine read_numbers

   !> How many bytes a file holds of a dataset, and whether its numbers are in other files: those are not read. A
   !> dataset that is not there has no bytes.
   subroutine look_at_storage(file, name, stored, held, is_elsewhere)
      integer(hid_t), intent(in) :: file
      character(len=*), intent(in) :: name
      integer(hsize_t), intent(out) :: stored
      real(dp), intent(out) :: held              !! bytes that these can be at most, once they are no longer compressed
      logical, intent(out) :: is_elsewhere
      integer(hid_t) :: id, properties
      integer(size_t) :: value_size
      integer :: corder, cset, external_files, filters, layout, link, status
      integer(hid_t) :: address
      logical :: corder_valid

      stored = 0
      held = 0
      is_elsewhere = .false.
      call h5lget_info_f(file, name, cset, corder, corder_valid, link, address, value_size, status)
      if (status < 0) return
      is_elsewhere = link /= h5l_type_hard_f
      if (is_elsewhere) return
      call h5dopen_f(file, name, id, status)
      if (status < 0) return
      call h5dget_create_plist_f(id, properties, status)
      external_files = 0
      filters = 0
      layout = h5d_virtual_f
      if (status >= 0) call h5pget_layout_f(properties, layout, status)
      if (status >= 0) call h5pget_external_count_f(properties, external_files, status)
      if (status >= 0) call h5pget_nfilters_f(properties, filters, status)
      is_elsewhere = layout == h5d_virtual_f .or. external_files > 0
      call h5pclose_f(properties, status)
      call h5dget_storage_size_f(id, stored, status)
      if (status < 0) stored = 0
      held = stored
      if (filters > 0) held = most_compressed*stored
      call h5dclose_f(id, status)
   end subroutine look_at_storage

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
