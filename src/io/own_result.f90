!> Whether a file is a result of the programs, which may be replaced without a word.
!>
!> A file that cannot be read at present does not count as foreign: see `found_unreadable`.
module ehlwave_own_result
   use, intrinsic :: iso_c_binding, only: c_funloc, c_loc, c_ptr
   use ehlwave_hdf5_reading, only: has_hdf5_signature, open_hdf5
   use ehlwave_posix, only: file_kind, kind_file
   use ehlwave_process, only: guarded
   use hdf5, only: h5aclose_f, h5aexists_f, h5aget_type_f, h5aopen_f, h5aread_f, h5close_f, h5fclose_f, &
      h5t_fortran_s1, h5t_string_f, h5tclose_f, h5tcopy_f, h5tget_class_f, &
      h5tget_size_f, h5tis_variable_str_f, h5tset_size_f, hid_t, size_t
   implicit none (type, external)
   private
   public :: is_own_result, look_at_result

   !> Kinds of files that `look_at_result` finds.
   integer, parameter, public :: found_own = 1         !! a result of the programs
   integer, parameter, public :: found_foreign = 2     !! no HDF5 file, or none of ours
   integer, parameter, public :: found_damaged = 3     !! begins as HDF5 files do, and the library cannot open it
   integer, parameter, public :: found_unreadable = 4  !! the system does not open it

   character(len=*), parameter :: formats(2) = [character(len=15) :: 'ehlwave-case', 'ehlwave-results']
   integer(size_t), parameter :: longest_format = 64

   !> The file that is being looked at, at module level for work that is guarded.
   type :: looking_t
      character(len=:), allocatable :: path
      character(len=longest_format) :: format = ''
      logical :: has_version = .false., is_open = .false.
   end type looking_t
   type(looking_t) :: looking

contains

   !> Whether a regular file is a result: HDF5 with the attributes `format` and `program_version` of the programs.
   logical function is_own_result(path, format)
      character(len=*), intent(in) :: path
      character(len=*), intent(in), optional :: format   !! required kind; absent: any
      character(len=:), allocatable :: reason
      integer :: found
      call look_at_result(path, found, reason, format)
      is_own_result = found == found_own
   end function is_own_result

   !> Find out the kind of a file; something other than a regular file is foreign.
   subroutine look_at_result(path, found, reason, format)
      character(len=*), intent(in) :: path
      integer, intent(out) :: found                                !! a kind from above
      character(len=:), allocatable, intent(out) :: reason         !! system's words where the file is unreadable
      character(len=*), intent(in), optional :: format             !! the only kind that counts as own; absent: any
      logical :: is_hdf5

      found = found_foreign
      reason = ''
      if (file_kind(path) /= kind_file) return
      call has_hdf5_signature(path, is_hdf5, reason)
      if (reason /= '') found = found_unreadable
      if (.not. is_hdf5) return
      looking = looking_t(path=path)
      if (guarded(c_funloc(read_attributes)) /= 0) looking%is_open = .false.
      if (.not. looking%is_open) then
         found = found_damaged
      else if (looking%has_version .and. any(formats == looking%format)) then
         found = found_own
         if (present(format)) found = merge(found_own, found_foreign, looking%format == format)
      end if
   end subroutine look_at_result

   !> The library does not survive every file that is damaged or meant to harm.
   subroutine read_attributes() bind(c)
      integer(hid_t) :: file
      integer :: status
      logical :: exists

      call open_hdf5(looking%path, file, looking%is_open)
      if (looking%is_open) then
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
