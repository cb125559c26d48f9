!> A table of numbers with named columns, as it was read from a file.
module ehlwave_number_table
   use ehlwave_identity_index, only: identity_length, numbers_identity
   use ehlwave_kinds, only: dp
   use ehlwave_text, only: to_text
   implicit none (type, external)
   private

   integer, parameter, public :: path_length = 512   !! longest name of a file

   type, public :: number_table_t
      character(len=:), allocatable :: path          !! name of the file; unallocated: nothing is read yet
      character(len=64), allocatable :: names(:)     !! (columns), lower case
      integer, allocatable :: line(:)                !! (rows) line number in the file
      real(dp), allocatable :: values(:, :)          !! (rows, columns)
   contains
      procedure :: is_from
      procedure :: column
      procedure :: place
      procedure :: digest
   end type number_table_t

contains

   !> Whether the numbers are from a file.
   pure logical function is_from(self, path)
      class(number_table_t), intent(in) :: self
      character(len=*), intent(in) :: path
      is_from = allocated(self%path)
      if (is_from) is_from = self%path == path
   end function is_from

   !> Number of the column of a name, 0: there is none.
   pure integer function column(self, name)
      class(number_table_t), intent(in) :: self
      character(len=*), intent(in) :: name
      do column = size(self%names), 1, -1
         if (self%names(column) == name) return
      end do
   end function column

   !> `FILE:LINE: ` of a row, for messages.
   pure function place(self, row)
      class(number_table_t), intent(in) :: self
      integer, intent(in) :: row
      character(len=:), allocatable :: place
      place = self%path//':'//to_text(self%line(row))//': '
   end function place

   !> Identity of the numbers. Comments and other spellings of the same numbers do not change it.
   pure function digest(self)
      class(number_table_t), intent(in) :: self
      character(len=identity_length) :: digest
      digest = numbers_identity([real(shape(self%values), dp), self%values])
   end function digest

end module ehlwave_number_table
