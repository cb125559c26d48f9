!> Quantities to and from JSON, and to HDF5 files.
module ehlwave_quantity_output
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
   use ehlwave_hdf5_file, only: hdf5_file_t
   use ehlwave_json, only: list_json, real_json, string_json
   use ehlwave_json_reader, only: json_number, json_string, split_list
   use ehlwave_kinds, only: i8
   use ehlwave_quantity, only: quantity_list_t, quantity_t, unknown_whole
   use ehlwave_text, only: put, to_text
   implicit none (type, external)
   private
   public :: json_columns, json_object, json_values, take_json, write_quantities

contains

   !> The quantities that exist as one JSON object, on one line.
   pure function json_object(list) result(text)
      type(quantity_list_t), intent(in) :: list
      character(len=:), allocatable :: text
      integer :: k, n
      text = ''
      n = 0
      do k = 1, list%count
         if (list%items(k)%exists) call put(text, n, ', '//string_json(list%items(k)%name)//': '// &
                                            value_json(list%items(k)))
      end do
      text = '{'//text(3:n)//'}'
   end function json_object

   !> Names and kinds of the quantities that exist: [["name","kind"],...]
   pure function json_columns(list) result(text)
      type(quantity_list_t), intent(in) :: list
      character(len=:), allocatable :: text
      integer :: k, n
      text = ''
      n = 0
      do k = 1, list%count
         if (list%items(k)%exists) call put(text, n, ',['//string_json(list%items(k)%name)//',"'// &
                                            trim(list%items(k)%kind)//'"]')
      end do
      text = '['//text(2:n)//']'
   end function json_columns

   !> The values of the quantities that exist as a list, in the order of `json_columns`.
   pure function json_values(list) result(text)
      type(quantity_list_t), intent(in) :: list
      character(len=:), allocatable :: text
      integer :: k, n
      text = ''
      n = 0
      do k = 1, list%count
         if (.not. list%items(k)%exists) cycle
         call put(text, n, ',')
         call put(text, n, value_json(list%items(k)))
      end do
      text = '['//text(2:n)//']'
   end function json_values

   pure function value_json(quantity) result(text)
      type(quantity_t), intent(in) :: quantity
      character(len=:), allocatable :: text
      select case (quantity%kind)
      case ('real'); text = real_json(quantity%number)
      case ('integer'); text = to_text(nint(quantity%number, i8))
      case ('logical')
         text = real_json(quantity%number)
         if (.not. ieee_is_nan(quantity%number)) text = to_text(quantity%number > 0)
      case ('list'); text = list_json(quantity%list)
      case default; text = string_json(quantity%text)
      end select
   end function value_json

   !> The value of a quantity from JSON, by its kind; missing values are NaN or empty.
   subroutine take_json(text, quantity)
      character(len=*), intent(in) :: text
      type(quantity_t), intent(inout) :: quantity
      integer, allocatable :: first(:), last(:)
      integer :: k
      select case (quantity%kind)
      case ('text')
         quantity%text = json_string(text)
      case ('list')
         call split_list(text, first, last)
         quantity%list = [(json_number(text(first(k):last(k))), k=1, size(first))]
      case default
         quantity%number = json_number(text)
      end select
   end subroutine take_json

   !> The quantities that exist: texts as attributes of the file, numbers as datasets with units and long name.
   subroutine write_quantities(file, list)
      type(hdf5_file_t), intent(inout) :: file
      type(quantity_list_t), intent(in) :: list
      integer :: k, whole
      do k = 1, list%count
         associate (q => list%items(k))
            if (.not. q%exists) cycle
            select case (q%kind)
            case ('real'); call file%write(q%name, q%number, q%unit, q%long_name)
            case ('integer', 'logical')
               whole = unknown_whole
               if (.not. ieee_is_nan(q%number)) whole = nint(q%number)
               call file%write(q%name, whole, q%unit, q%long_name)
            case ('list'); call file%write(q%name, q%list, q%unit, q%long_name)
            case default; call file%attribute(q%name, q%text)
            end select
         end associate
      end do
   end subroutine write_quantities

end module ehlwave_quantity_output
