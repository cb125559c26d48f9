!> Reads HDF5 files back by the library itself, not by the module under test.
module hdf5_readback
   use, intrinsic :: iso_c_binding, only: c_loc, c_ptr
   use ehlwave_kinds, only: dp
   use hdf5, only: h5aclose_f, h5aget_type_f, h5aopen_by_name_f, h5aread_f, h5close_f, h5dclose_f, h5dget_space_f, &
      h5dget_type_f, h5dopen_f, h5dread_f, h5eset_auto_f, h5f_acc_rdonly_f, h5fclose_f, h5fopen_f, h5open_f, &
      h5sclose_f, h5sget_simple_extent_npoints_f, h5t_fortran_s1, h5t_native_double, h5tclose_f, h5tcopy_f, &
      h5tget_size_f, h5tset_size_f, hid_t, hsize_t, size_t
   implicit none (type, external)
   private
   public :: attribute_of, numbers_of, text_of

contains

   !> All numbers of a dataset in the order of the file; none when there is no such dataset.
   function numbers_of(path, name) result(values)
      character(len=*), intent(in) :: path, name
      real(dp), allocatable, target :: values(:)
      type(c_ptr) :: address
      integer(hid_t) :: dataset, file
      integer :: status

      allocate (values(0))
      call open_dataset(path, name, file, dataset)
      if (dataset >= 0) then
         deallocate (values)
         allocate (values(points(dataset)))
         address = c_loc(values)
         call h5dread_f(dataset, h5t_native_double, address, status)
         if (status < 0) values = huge(1.0_dp)
      end if
      call close_dataset(file, dataset)
   end function numbers_of

   !> Text `number` of a dataset, without the nulls that fill it up; '?' when there is no such dataset.
   function text_of(path, name, number) result(text)
      character(len=*), intent(in) :: path, name
      integer, intent(in) :: number
      character(len=:), allocatable :: text
      character(len=:), allocatable, target :: all
      type(c_ptr) :: address
      integer(hid_t) :: dataset, file, in_file, in_memory
      integer(size_t) :: length
      integer :: status

      text = '?'
      call open_dataset(path, name, file, dataset)
      if (dataset >= 0) then
         call h5dget_type_f(dataset, in_file, status)
         call h5tget_size_f(in_file, length, status)
         call h5tclose_f(in_file, status)
         allocate (character(len=length*points(dataset)) :: all)
         call h5tcopy_f(h5t_fortran_s1, in_memory, status)
         call h5tset_size_f(in_memory, length, status)
         address = c_loc(all)
         call h5dread_f(dataset, in_memory, address, status)
         call h5tclose_f(in_memory, status)
         text = trim(all((number - 1)*int(length) + 1:number*int(length)))
      end if
      call close_dataset(file, dataset)
   end function text_of

   !> Text attribute of a dataset, or of the file ('/'); '?' when there is none.
   function attribute_of(path, object, name) result(text)
      character(len=*), intent(in) :: path, object, name
      character(len=:), allocatable :: text
      character(len=4096) :: buffer
      integer(hid_t) :: attribute, file, type
      integer(size_t) :: length
      integer :: status

      text = '?'
      call h5open_f(status)
      call h5eset_auto_f(0, status)
      call h5fopen_f(path, h5f_acc_rdonly_f, file, status)
      call h5aopen_by_name_f(file, object, name, attribute, status)
      if (status >= 0) then
         call h5aget_type_f(attribute, type, status)
         call h5tget_size_f(type, length, status)
         buffer = ''
         call h5aread_f(attribute, type, buffer(:length), [1_hsize_t], status)
         text = trim(buffer(:index(buffer(:length)//achar(0), achar(0)) - 1))
         call h5tclose_f(type, status)
         call h5aclose_f(attribute, status)
      end if
      call h5fclose_f(file, status)
      call h5close_f(status)
   end function attribute_of

   subroutine open_dataset(path, name, file, dataset)
      character(len=*), intent(in) :: path, name
      integer(hid_t), intent(out) :: file, dataset   !! dataset negative: not there
      integer :: status
      call h5open_f(status)
      call h5eset_auto_f(0, status)
      dataset = -1
      call h5fopen_f(path, h5f_acc_rdonly_f, file, status)
      if (status < 0) return
      call h5dopen_f(file, name, dataset, status)
      if (status < 0) dataset = -1
   end subroutine open_dataset

   subroutine close_dataset(file, dataset)
      integer(hid_t), intent(in) :: file, dataset
      integer :: status
      if (dataset >= 0) call h5dclose_f(dataset, status)
      call h5fclose_f(file, status)
      call h5close_f(status)
   end subroutine close_dataset

   integer function points(dataset)
      integer(hid_t), intent(in) :: dataset
      integer(hid_t) :: space
      integer(hsize_t) :: n
      integer :: status
      call h5dget_space_f(dataset, space, status)
      call h5sget_simple_extent_npoints_f(space, n, status)
      call h5sclose_f(space, status)
      points = int(n)
   end function points

end module hdf5_readback
