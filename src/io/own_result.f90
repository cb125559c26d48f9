!> Whether a file is a result of the programs, which may be replaced without a word.
module ehlwave_own_result
   use, intrinsic :: iso_c_binding, only: c_funloc, c_loc, c_ptr
   use ehlwave_posix, only: file_kind, kind_file
   use ehlwave_process, only: guarded
   use hdf5, only: h5aclose_f, h5aexists_f, h5aget_type_f, h5aopen_f, h5aread_f, h5close_f, h5eset_auto_f, &
      h5f_acc_rdonly_f, &
      h5fclose_f, h5fopen_f, h5open_f, h5t_fortran_s1, h5t_string_f, h5tclose_f, h5tcopy_f, h5tget_class_f, &
      h5tget_size_f, h5tis_variable_str_f, h5tset_size_f, hid_t, size_t
   implicit none (type, external)
   private
   public :: is_own_result

   character(len=*), parameter :: formats(2) = [character(len=15) :: 'ehlwave-case', 'ehlwave-results']
   integer(size_t), parameter :: longest_format = 64

   !> The file that is being looked at, at module level for work that is guarded.
   type :: looking_t
      character(len=:), allocatable :: path
      character(len=longest_format) :: format = ''
      logical :: has_version = .false.
   end type looking_t
   type(looking_t) :: looking

contains

   !> A regular file that says that it is one: HDF5 with the attributes `format` and `program_version` of ours. One that
   !> cannot be read is none.
   logical function is_own_result(path, format)
      character(len=*), intent(in) :: path
      character(len=*), intent(in), optional :: format   !! the one that it has to be; absent: any
      is_own_result = .false.
      if (file_kind(path) /= kind_file) return
      looking = looking_t(path=path)
      if (guarded(c_funloc(read_attributes)) == 0) is_own_result = any(formats == looking%format) .and. &
         looking%has_version
      if (present(format)) is_own_result = is_own_result .and. looking%format == format
   end function is_own_result

   !> The library does not survive every file that is damaged or meant to harm.
   subroutine read_attributes() bind(c)
      integer(hid_t) :: file
      integer :: status
      logical :: exists

      call h5open_f(status)
      call h5eset_auto_f(0, status)
      call h5fopen_f(looking%path, h5f_acc_rdonly_f, file, status)
      if (status >= 0) then
         call h5aexists_f(file, 'program_version', exists, status)
         looking%has_version = exists .and. status >= 0
         call h5aexists_f(file, 'format', exists, status)
         if (exists .and. status >= 0) call read_format(file)
         call h5fclose_f(file, status)
      end if
      call h5close_f(status)
   end subroutine read_attributes

   !> Read the attribute `format` if it is a short text of fixed length, as ours are.
   subroutine read_format(file)
      integer(hid_t), intent(in) :: file
      integer(hid_t) :: attribute, in_file, in_memory
      integer(size_t) :: length
      integer :: class, status
      logical :: is_variable
      character(len=longest_format), target :: text
      type(c_ptr) :: address

      call h5aopen_f(file, 'format', attribute, status)
      if (status < 0) return
      call h5aget_type_f(attribute, in_file, status)
      call h5tget_class_f(in_file, class, status)
      call h5tget_size_f(in_file, length, status)
      is_variable = .true.
      if (class == h5t_string_f) call h5tis_variable_str_f(in_file, is_variable, status)
      if (.not. is_variable .and. length <= longest_format) then
         call h5tcopy_f(h5t_fortran_s1, in_memory, status)
         call h5tset_size_f(in_memory, longest_format, status)
         text = ''
         address = c_loc(text)
         call h5aread_f(attribute, in_memory, address, status)
         if (status >= 0) looking%format = text
         call h5tclose_f(in_memory, status)
      end if
      call h5tclose_f(in_file, status)
      call h5aclose_f(attribute, status)
   end subroutine read_format

end module ehlwave_own_result
