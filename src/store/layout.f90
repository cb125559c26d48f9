!> Records of a store as lists of values: a layout gives their names and kinds.
module ehlwave_layout
   use ehlwave_json_reader, only: json_string, split_list
   use ehlwave_posix, only: checksum
   implicit none (type, external)
   private
   public :: new_layout

   integer, parameter :: name_length = 96

   !> Names and kinds of the values of a record.
   type, public :: layout_t
      character(len=:), allocatable :: text            !! as stored: [[name, kind],...]
      character(len=8) :: tag = ''                     !! its checksum, by which records refer to it
      character(len=name_length), allocatable :: names(:), kinds(:)
   contains
      procedure :: element
   end type layout_t

   !> The values of a record. Value k, as JSON, is text(first(k):last(k)).
   type, public :: values_t
      character(len=:), allocatable :: text
      integer, allocatable :: first(:), last(:)
   contains
      procedure :: split
      procedure :: element => numbered_element
   end type values_t

contains

   function new_layout(text) result(layout)
      character(len=*), intent(in) :: text   !! [[name, kind],...]
      type(layout_t) :: layout
      integer, allocatable :: first(:), last(:), a(:), b(:)
      integer :: k
      layout%text = text
      layout%tag = checksum(text)
      call split_list(text, first, last)
      allocate (layout%names(size(first)), layout%kinds(size(first)))
      do k = 1, size(first)
         associate (pair => text(first(k):last(k)))
            call split_list(pair, a, b)
            layout%names(k) = ''
            layout%kinds(k) = ''
            if (size(a) /= 2) cycle
            layout%names(k) = json_string(pair(a(1):b(1)))
            layout%kinds(k) = json_string(pair(a(2):b(2)))
         end associate
      end do
   end function new_layout

   !> Take the values of a list; `fits` returns whether their number equals the layout's.
   subroutine split(self, text, layout, fits)
      class(values_t), intent(inout) :: self
      character(len=*), intent(in) :: text
      class(layout_t), intent(in) :: layout
      logical, intent(out) :: fits
      self%text = text
      call split_list(text, self%first, self%last)
      fits = size(self%first) == size(layout%names)
   end subroutine split

   !> Value of a name as JSON; empty when a record of this layout has no such value.
   pure function element(self, values, name) result(text)
      class(layout_t), intent(in) :: self
      class(values_t), intent(in) :: values
      character(len=*), intent(in) :: name
      character(len=:), allocatable :: text
      text = values%element(findloc(self%names == name, .true., 1))
   end function element

   !> Value in a place as JSON; empty in place 0.
   pure function numbered_element(self, place) result(text)
      class(values_t), intent(in) :: self
      integer, intent(in) :: place
      character(len=:), allocatable :: text
      if (place > 0) then
         text = self%text(self%first(place):self%last(place))
      else
         text = ''
      end if
   end function numbered_element

end module ehlwave_layout
