!> The files that a case reads besides its input.
module ehlwave_case_files
   use ehlwave_case_key, only: key_length, key_long_name
   use ehlwave_identity_index, only: identity_length
   use ehlwave_key_list, only: key_list_t
   implicit none (type, external)
   private
   public :: case_files, file_changed_since, file_digests, note_digest, paths_read

   type, public :: case_file_t
      character(len=key_length) :: name = ''                !! in results: NAME_file, NAME_digest
      character(len=:), allocatable :: key                  !! '&group key'
      character(len=:), allocatable :: long_name
      character(len=:), allocatable :: path                 !! as it is given; '': none is read
      character(len=identity_length) :: digest = ''         !! digest of the numbers in it, once read
   end type case_file_t

contains

   !> All files that cases may read, with the paths of a case.
   pure function case_files(list) result(files)
      type(key_list_t), intent(in) :: list                  !! keys of the case
      type(case_file_t), allocatable :: files(:)
      integer :: i, k

      allocate (files(count(list%keys(:list%count)%file(1:1) /= ' ')))
      i = 0
      do k = 1, list%count
         associate (key => list%keys(k))
            if (key%file(1:1) == ' ') cycle
            i = i + 1
            files(i)%name = key%file
            files(i)%key = '&'//trim(key%group)//' '//trim(key%name)
            files(i)%long_name = key_long_name(key)
            files(i)%path = ''
            if (key%applies) files(i)%path = list%values(k)%word
         end associate
      end do
   end function case_files

   !> Paths of the files that are read.
   pure function paths_read(files) result(paths)
      type(case_file_t), intent(in) :: files(:)
      character(len=:), allocatable :: paths(:)
      integer :: i, length
      length = maxval([0, (len(files(i)%path), i=1, size(files))])
      allocate (character(len=length) :: paths(0))
      do i = 1, size(files)
         if (files(i)%path /= '') paths = [character(len=length) :: paths, files(i)%path]
      end do
   end function paths_read

   !> Digests of all files in sequence: with the input they determine a result.
   pure function file_digests(files) result(digests)
      type(case_file_t), intent(in) :: files(:)
      character(len=:), allocatable :: digests
      integer :: i
      digests = ''
      do i = 1, size(files)
         digests = digests//files(i)%digest
      end do
   end function file_digests

   !> Number of the first file that holds other numbers than when these `file_digests` were taken, 0: none does.
   pure integer function file_changed_since(files, digests) result(i)
      type(case_file_t), intent(in) :: files(:)
      character(len=*), intent(in) :: digests
      do i = 1, size(files)
         if (digests((i - 1)*identity_length + 1:i*identity_length) /= files(i)%digest) return
      end do
      i = 0
   end function file_changed_since

   !> Note the digest of the content of a file.
   subroutine note_digest(files, path, digest)
      type(case_file_t), intent(inout) :: files(:)
      character(len=*), intent(in) :: path
      character(len=identity_length), intent(in) :: digest
      integer :: i
      do i = 1, size(files)
         if (files(i)%path == path) files(i)%digest = digest
      end do
   end subroutine note_digest

end module ehlwave_case_files
