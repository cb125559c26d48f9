!> The list of all cases of a sweep that its store keeps, with expected costs and the keys that vary. With it `--status`
!> needs no sweep file.
module ehlwave_case_list
   use ehlwave_cost_model, only: feature_count
   use ehlwave_errors, only: error_t, raise
   use ehlwave_identity_index, only: identity_length
   use ehlwave_kinds, only: dp
   use ehlwave_posix, only: checksum, reason_text, replace_file
   use ehlwave_store_names, only: cases_name
   use ehlwave_text, only: harmless
   use ehlwave_text_file, only: read_whole_file
   implicit none (type, external)
   private

   integer, parameter, public :: variation_length = 160   !! length of descriptions; longer text is cut

   type, public :: case_list_t
      character(len=identity_length), allocatable :: identity(:)
      real(dp), allocatable :: features(:, :)    !! (feature_count, cases) of the cost model
      character(len=variation_length), allocatable :: variation(:)   !! keys that vary
      character(len=8) :: checksum = ''          !! checksum of the file
   contains
      procedure :: write => write_list
      procedure :: read => read_list
   end type case_list_t

   character(len=*), parameter :: features_format = '(*(1x,es12.5))'
   integer, parameter :: start_length = identity_length + 13*feature_count   !! length of a line before the varying part

contains

   !> Write the list, in lines of the same length.
   subroutine write_list(self, folder, error)
      class(case_list_t), intent(inout) :: self
      character(len=*), intent(in) :: folder     !! folder of the store
      type(error_t), allocatable, intent(inout) :: error
      character(len=start_length) :: start
      character(len=:), allocatable :: text
      integer :: i, status, width

      if (allocated(error)) return
      width = start_length + 1 + maxval(len_trim(self%variation)) + 1
      allocate (character(len=width*size(self%identity)) :: text)
      do i = 1, size(self%identity)
         start = self%identity(i)
         write (start(identity_length + 1:), features_format) self%features(:, i)
         text((i - 1)*width + 1:i*width) = start//' '//harmless(self%variation(i))
         text(i*width:i*width) = new_line('a')
      end do
      self%checksum = checksum(text)
      call replace_file(folder//'/'//cases_name, text, status)
      if (status /= 0) call raise(error, 'cannot write '//folder//'/'//cases_name//': '//reason_text(status))
   end subroutine write_list

   !> Fails when there is no list yet, and when it is not whole. Features that cannot be read are 0.
   subroutine read_list(self, folder, error)
      class(case_list_t), intent(inout) :: self
      character(len=*), intent(in) :: folder     !! folder of the store
      type(error_t), allocatable, intent(inout) :: error
      character(len=:), allocatable :: text
      integer :: i, io, n, width

      if (allocated(error)) return
      call read_whole_file(folder//'/'//cases_name, text)
      width = 0
      if (allocated(text)) width = index(text, new_line('a'))
      if (width <= identity_length) then
         call raise(error, folder//' has no list of cases yet: no job has begun to work on it, or the file '// &
            cases_name//' is lost; the sweep, started again, writes it')
      else if (modulo(len(text), width) /= 0) then
         call raise(error, folder//'/'//cases_name//' is not whole: the sweep, started again, writes it anew')
      end if
      if (allocated(error)) return
      self%checksum = checksum(text)
      n = len(text)/width
      allocate (self%identity(n), self%features(feature_count, n), self%variation(n))
      do i = 1, n
         associate (line => text((i - 1)*width + 1:i*width - 1))
            self%identity(i) = line(:identity_length)
            read (line(identity_length + 1:), features_format, iostat=io) self%features(:, i)
            if (io /= 0) self%features(:, i) = 0
            self%variation(i) = line(min(len(line), start_length + 1) + 1:)
         end associate
      end do
   end subroutine read_list

end module ehlwave_case_list
