!> Quantities to and from JSON, and to HDF5 files.
module ehlwave_quantity_output
   use ehlwave_hdf5_file, only: hdf5_file_t
   use ehlwave_json, only: json_t
   use ehlwave_json_reader, only: json_number, json_string, split_list
   use ehlwave_kinds, only: i8
   use ehlwave_quantity, only: quantity_list_t, quantity_t
   implicit none (type, external)
   private
   public :: json_of, take_json, write_quantities

contains

   !> The quantities that exist as one JSON object.
   pure function json_of(list) result(json)
      type(quantity_list_t), intent(in) :: list
      type(json_t) :: json
      integer :: k
      do k = 1, list%count
         associate (q => list%items(k))
            if (.not. q%exists) cycle
            select case (q%kind)
            case ('real'); call json%add(q%name, q%number)
            case ('integer'); call json%add(q%name, nint(q%number, i8))
            case ('logical'); call json%add(q%name, q%number > 0)
            case ('list'); call json%add_list(q%name, q%list)
            case default; call json%add(q%name, q%text)
            end select
         end associate
      end do
   end function json_of

   !> The value of a quantity from JSON, by its kind; missing ones are NaN or empty.
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
      integer :: k
      do k = 1, list%count
         associate (q => list%items(k))
            if (.not. q%exists) cycle
            select case (q%kind)
            case ('real'); call file%write(q%name, q%number, q%unit, q%long_name)
            case ('integer', 'logical'); call file%write(q%name, nint(q%number), q%unit, q%long_name)
            case ('list'); call file%write(q%name, q%list, '', q%unit, q%long_name)
            case default; call file%attribute(q%name, q%text)
            end select
         end associate
      end do
   end subroutine write_quantities

end module ehlwave_quantity_output
