!> An HDF5 file open for writing: datasets with units, names and dimensions that xarray reads.
!>
!> The status of every call of the library that makes or writes something counts. The file is made in memory; `finish`
!> writes it, waits for the disk and only then gives it its name, so that a reader never sees a broken file. (The
!> library itself notices a full disk late, and can crash then.)
module ehlwave_hdf5_file
   use, intrinsic :: iso_c_binding, only: c_loc, c_null_ptr, c_ptr
   use ehlwave_errors, only: error_t, raise
   use ehlwave_kinds, only: dp
   use ehlwave_posix, only: reason_text, replace_file
   use h5ds, only: h5dsattach_scale_f, h5dsset_scale_f
   use hdf5, only: h5aclose_f, h5acreate_f, h5awrite_f, h5close_f, h5dclose_f, h5dcreate_f, h5dopen_f, h5dwrite_f, &
      h5eset_auto_f, h5f_acc_trunc_f, h5f_scope_global_f, h5fclose_f, h5fcreate_f, h5fflush_f, h5fget_file_image_f, &
      h5lexists_f, h5open_f, h5p_dataset_create_f, h5p_file_access_f, h5pclose_f, h5pcreate_f, h5pset_chunk_f, &
      h5pset_deflate_f, h5pset_fapl_core_f, h5pset_shuffle_f, h5s_scalar_f, h5sclose_f, h5screate_f, &
      h5screate_simple_f, h5t_c_s1, h5t_fortran_s1, h5t_native_double, h5t_native_integer, h5t_str_nullpad_f, &
      h5tclose_f, h5tcopy_f, h5tset_size_f, h5tset_strpad_f, hid_t, hsize_t, size_t
   implicit none (type, external)
   private

   integer(hsize_t), parameter :: compressed_from = 1024   !! values in a dataset; it must be worth the chunks
   integer, parameter :: deflate_level = 4

   type, public :: hdf5_file_t
      private
      character(len=:), allocatable :: path
      integer(hid_t) :: id = -1
      logical :: is_good = .true.
   contains
      procedure :: create
      procedure :: finish
      generic :: attribute => text_attribute, integer_attribute
      procedure :: dimension
      procedure :: has
      generic :: write => write_reals, write_integers, write_texts
      procedure, private :: text_attribute, integer_attribute, write_reals, write_integers, write_texts, note
   end type hdf5_file_t

contains

   !> Begin a file that will be called `path` once it is complete.
   subroutine create(self, path, error)
      class(hdf5_file_t), intent(inout) :: self
      character(len=*), intent(in) :: path
      type(error_t), allocatable, intent(out) :: error
      integer(size_t), parameter :: increment = 1048576   ! bytes by which the memory grows
      integer(hid_t) :: properties
      integer :: status(6)

      self%path = path
      self%is_good = .true.
      call h5open_f(status(1))
      call h5eset_auto_f(0, status(2))      ! our own messages, not the library's stack
      call h5pcreate_f(h5p_file_access_f, properties, status(3))
      call h5pset_fapl_core_f(properties, increment, .false., status(4))
      call h5fcreate_f(path, h5f_acc_trunc_f, self%id, status(5), access_prp=properties)
      call h5pclose_f(properties, status(6))
      call self%note(status)
      if (.not. self%is_good) call raise(error, 'cannot make '//path//' in memory: is there too little of it?')
   end subroutine create

   !> Write the file and give it its name. Fails when anything since `create` did.
   subroutine finish(self, error)
      class(hdf5_file_t), intent(inout) :: self
      type(error_t), allocatable, intent(out) :: error
      character(len=:), allocatable, target :: image
      type(c_ptr) :: buffer
      integer(size_t) :: length
      integer :: status(5), written

      length = 0
      call h5fflush_f(self%id, h5f_scope_global_f, status(1))
      buffer = c_null_ptr
      call h5fget_file_image_f(self%id, buffer, 0_size_t, status(2), length)
      allocate (character(len=length) :: image)
      buffer = c_loc(image)
      call h5fget_file_image_f(self%id, buffer, length, status(3))
      call h5fclose_f(self%id, status(4))
      call h5close_f(status(5))
      call self%note(status)
      if (.not. self%is_good) then
         call raise(error, 'making '//self%path//' failed: is there too little memory? The previous file is '// &
            'unchanged')
         return
      end if
      call replace_file(self%path, image, written)
      if (written /= 0) call raise(error, 'cannot write '//self%path//': '//reason_text(written)// &
                                   '. The previous file is unchanged')
   end subroutine finish

   !> Remember for `finish` whether calls of the library failed.
   subroutine note(self, status)
      class(hdf5_file_t), intent(inout) :: self
      integer, intent(in) :: status(:)
      if (any(status < 0)) self%is_good = .false.
   end subroutine note

   !> Text attribute of the file.
   subroutine text_attribute(self, name, text)
      class(hdf5_file_t), intent(inout) :: self
      character(len=*), intent(in) :: name, text
      call write_attribute(self, self%id, name, text)
   end subroutine text_attribute

   !> Whole-number attribute of the file.
   subroutine integer_attribute(self, name, value)
      class(hdf5_file_t), intent(inout) :: self
      character(len=*), intent(in) :: name
      integer, intent(in), target :: value
      call write_value(self, self%id, name, h5t_native_integer, c_loc(value))
   end subroutine integer_attribute

   !> Text attribute of an object, as long as the text without trailing blanks.
   subroutine write_attribute(self, object, name, text)
      type(hdf5_file_t), intent(inout) :: self
      integer(hid_t), intent(in) :: object
      character(len=*), intent(in) :: name, text
      integer(hid_t) :: type
      character(len=max(1, len_trim(text))), target :: value
      type(c_ptr) :: address   ! as an argument, c_loc of text shifts the lengths of the texts after it (gfortran 12)
      integer :: status(3)

      value = text
      call h5tcopy_f(h5t_fortran_s1, type, status(1))
      call h5tset_size_f(type, len(value, size_t), status(2))
      address = c_loc(value)
      call write_value(self, object, name, type, address)
      call h5tclose_f(type, status(3))
      call self%note(status)
   end subroutine write_attribute

   subroutine write_value(self, object, name, type, value)
      type(hdf5_file_t), intent(inout) :: self
      integer(hid_t), intent(in) :: object, type
      character(len=*), intent(in) :: name
      type(c_ptr), intent(in) :: value
      integer(hid_t) :: id, space
      integer :: status(5)
      call h5screate_f(h5s_scalar_f, space, status(1))
      call h5acreate_f(object, name, type, space, id, status(2))
      call h5awrite_f(id, type, value, status(3))
      call h5aclose_f(id, status(4))
      call h5sclose_f(space, status(5))
      call self%note(status)
   end subroutine write_value

   !> Make a dataset already written the scale of the dimension of its name.
   subroutine dimension(self, name)
      class(hdf5_file_t), intent(inout) :: self
      character(len=*), intent(in) :: name
      integer(hid_t) :: id
      integer :: status(3)
      call h5dopen_f(self%id, name, id, status(1))
      call h5dsset_scale_f(id, status(2), name)
      call h5dclose_f(id, status(3))
      call self%note(status)
   end subroutine dimension

   !> Whether a dataset has been written. If that cannot be found out it counts as not; writing it then fails.
   logical function has(self, name)
      class(hdf5_file_t), intent(in) :: self
      character(len=*), intent(in) :: name
      integer :: status
      has = .false.
      if (len(name) == 0) return
      call h5lexists_f(self%id, name, has, status)
      has = has .and. status >= 0
   end function has

   !> Properties of a new dataset: long datasets are compressed chunk by chunk.
   integer(hid_t) function storage(self, extent) result(properties)
      class(hdf5_file_t), intent(inout) :: self
      integer(hsize_t), intent(in) :: extent(:)
      integer(hsize_t), parameter :: longest_chunk = 16384
      integer(hsize_t) :: chunk(size(extent))
      integer :: status(4)
      status = 0
      call h5pcreate_f(h5p_dataset_create_f, properties, status(1))
      if (product(extent) >= compressed_from) then
         chunk = extent
         chunk(size(chunk)) = max(1_hsize_t, &
            min(extent(size(extent)), longest_chunk*extent(size(extent))/product(extent)))
         call h5pset_chunk_f(properties, size(chunk), chunk, status(2))
         call h5pset_shuffle_f(properties, status(3))
         call h5pset_deflate_f(properties, deflate_level, status(4))
      end if
      call self%note(status)
   end function storage

   !> A dataset with its attributes: units, long_name and its scales.
   subroutine write_values(self, name, in_memory, in_file, extent, values, units, long_name, scale, second_scale, &
      third_scale)
      type(hdf5_file_t), intent(inout) :: self
      character(len=*), intent(in) :: name, units, long_name
      integer(hid_t), intent(in) :: in_memory, in_file       !! types
      integer(hsize_t), intent(in) :: extent(:)              !! empty: a scalar without dimension
      type(c_ptr), intent(in) :: values                      !! contiguous
      character(len=*), intent(in), optional :: scale, second_scale, third_scale   !! names of the first dimension, and
                                                                                   !! so on
      integer(hid_t) :: id, properties, space
      integer :: status(6)

      if (size(extent) == 0) then
         call h5screate_f(h5s_scalar_f, space, status(1))
      else
         call h5screate_simple_f(size(extent), extent, space, status(1))
      end if
      properties = storage(self, extent)
      call h5dcreate_f(self%id, name, in_file, space, id, status(2), dcpl_id=properties)
      call h5pclose_f(properties, status(3))
      call h5dwrite_f(id, in_memory, values, status(4))
      if (len(units) > 0) call write_attribute(self, id, 'units', units)
      call write_attribute(self, id, 'long_name', long_name)
      if (present(third_scale)) call attach(self, id, third_scale, size(extent) - 2)
      if (present(second_scale)) call attach(self, id, second_scale, size(extent) - 1)
      if (present(scale)) call attach(self, id, scale, size(extent))
      call h5dclose_f(id, status(5))
      call h5sclose_f(space, status(6))
      call self%note(status)
   end subroutine write_values

   !> Attach a dimension scale; `number` counts dimensions in C order, slowest first.
   subroutine attach(self, id, scale, number)
      type(hdf5_file_t), intent(inout) :: self
      integer(hid_t), intent(in) :: id
      character(len=*), intent(in) :: scale
      integer, intent(in) :: number
      integer(hid_t) :: scale_id
      integer :: status(3)
      call h5dopen_f(self%id, scale, scale_id, status(1))
      call h5dsattach_scale_f(id, scale_id, number, status(2))
      call h5dclose_f(scale_id, status(3))
      call self%note(status)
   end subroutine attach

   !> Real values over as many dimensions as they have. In the file (C order) the first comes last.
   subroutine write_reals(self, name, values, units, long_name, scale, second_scale, third_scale)
      class(hdf5_file_t), intent(inout) :: self
      character(len=*), intent(in) :: name, units, long_name
      real(dp), intent(in), target, contiguous :: values(..)
      character(len=*), intent(in), optional :: scale, second_scale, third_scale   !! names of the first dimension, and
                                                                                   !! so on
      call write_values(self, name, h5t_native_double, h5t_native_double, shape(values, hsize_t), c_loc(values), &
         units, long_name, scale, second_scale, third_scale)
   end subroutine write_reals

   !> Whole numbers: a scalar, or values over a dimension.
   subroutine write_integers(self, name, values, units, long_name, scale)
      class(hdf5_file_t), intent(inout) :: self
      character(len=*), intent(in) :: name, units, long_name
      integer, intent(in), target, contiguous :: values(..)
      character(len=*), intent(in), optional :: scale
      call write_values(self, name, h5t_native_integer, h5t_native_integer, shape(values, hsize_t), c_loc(values), &
         units, long_name, scale)
   end subroutine write_integers

   !> Texts over one dimension, in a fixed length, padded with nulls in the file. By the attribute _Encoding xarray
   !> distinguishes text from bytes.
   subroutine write_texts(self, name, values, units, long_name, scale)
      class(hdf5_file_t), intent(inout) :: self
      character(len=*), intent(in) :: name, units, long_name
      character(len=*), intent(in), target, contiguous :: values(:)
      character(len=*), intent(in) :: scale
      integer(hid_t) :: id, in_memory, in_file
      type(c_ptr) :: address   ! as an argument, c_loc of text shifts the lengths of the texts after it (gfortran 12)
      integer :: status(9)
      call h5tcopy_f(h5t_fortran_s1, in_memory, status(1))
      call h5tset_size_f(in_memory, len(values, size_t), status(2))
      call h5tcopy_f(h5t_c_s1, in_file, status(3))
      call h5tset_size_f(in_file, int(max(1, maxval(len_trim(values))), size_t), status(4))
      call h5tset_strpad_f(in_file, h5t_str_nullpad_f, status(5))
      address = c_loc(values)
      call write_values(self, name, in_memory, in_file, shape(values, hsize_t), address, units, long_name, scale)
      call h5dopen_f(self%id, name, id, status(6))
      call write_attribute(self, id, '_Encoding', 'utf-8')
      call h5dclose_f(id, status(7))
      call h5tclose_f(in_memory, status(8))
      call h5tclose_f(in_file, status(9))
      call self%note(status)
   end subroutine write_texts

end module ehlwave_hdf5_file
