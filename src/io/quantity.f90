!> Quantities: values with a name, a unit and a long name, whatever they are going to be written to.
module ehlwave_quantity
   use ehlwave_kinds, only: dp, no_value
   implicit none (type, external)
   private

   integer, parameter, public :: kind_length = 8

   type, public :: quantity_t
      character(len=:), allocatable :: name
      character(len=:), allocatable :: long_name
      character(len=:), allocatable :: unit          !! '1': a plain number; '': a text
      character(len=kind_length) :: kind = ''        !! 'real', 'integer', 'logical', 'text', or 'list' of real numbers
      logical :: exists = .true.                     !! false: only others have it
      real(dp) :: number = no_value                  !! of all kinds but text and list; true is 1, false 0
      character(len=:), allocatable :: text
      real(dp), allocatable :: list(:)
   end type quantity_t

   !> Quantities in the order in which they were added; the caller gives each name once.
   type, public :: quantity_list_t
      integer :: count = 0
      type(quantity_t), allocatable :: items(:)      !! items(:count)
   contains
      generic :: add => add_real, add_integer, add_logical, add_text, add_list
      procedure :: find
      procedure, private :: add_real, add_integer, add_logical, add_text, add_list, add_item
   end type quantity_list_t

contains

   !> Place of a name in the list, 0 when it is not there.
   pure integer function find(self, name)
      class(quantity_list_t), intent(in) :: self
      character(len=*), intent(in) :: name
      do find = 1, self%count
         if (self%items(find)%name == name) return
      end do
      find = 0
   end function find

   pure subroutine add_real(self, name, long_name, value, unit, exists)
      class(quantity_list_t), intent(inout) :: self
      character(len=*), intent(in) :: name, long_name
      real(dp), intent(in) :: value
      character(len=*), intent(in), optional :: unit   !! default: '1'
      logical, intent(in), optional :: exists          !! default: true
      call self%add_item(name, long_name, 'real', unit, exists)
      self%items(self%count)%number = value
   end subroutine add_real

   pure subroutine add_integer(self, name, long_name, value)
      class(quantity_list_t), intent(inout) :: self
      character(len=*), intent(in) :: name, long_name
      integer, intent(in) :: value
      call self%add_item(name, long_name, 'integer')
      self%items(self%count)%number = value
   end subroutine add_integer

   pure subroutine add_logical(self, name, long_name, value)
      class(quantity_list_t), intent(inout) :: self
      character(len=*), intent(in) :: name, long_name
      logical, intent(in) :: value
      call self%add_item(name, long_name, 'logical')
      self%items(self%count)%number = merge(1, 0, value)
   end subroutine add_logical

   pure subroutine add_text(self, name, long_name, value, exists)
      class(quantity_list_t), intent(inout) :: self
      character(len=*), intent(in) :: name, long_name
      character(len=*), intent(in) :: value            !! kept with its trailing blanks
      logical, intent(in), optional :: exists          !! default: true
      call self%add_item(name, long_name, 'text', '', exists)
      self%items(self%count)%text = value
   end subroutine add_text

   !> A list that is not allocated does not exist.
   pure subroutine add_list(self, name, long_name, value, unit)
      class(quantity_list_t), intent(inout) :: self
      character(len=*), intent(in) :: name, long_name
      real(dp), intent(in), allocatable :: value(:)
      character(len=*), intent(in), optional :: unit   !! default: '1'
      call self%add_item(name, long_name, 'list', unit, allocated(value))
      if (allocated(value)) self%items(self%count)%list = value
   end subroutine add_list

   !> One more quantity, without its value.
   pure subroutine add_item(self, name, long_name, kind, unit, exists)
      class(quantity_list_t), intent(inout) :: self
      character(len=*), intent(in) :: name, long_name, kind
      character(len=*), intent(in), optional :: unit
      logical, intent(in), optional :: exists
      integer, parameter :: usual_size = 128
      type(quantity_t), allocatable :: more(:)

      if (.not. allocated(self%items)) allocate (self%items(usual_size))
      if (self%count == size(self%items)) then
         allocate (more(2*self%count))
         more(:self%count) = self%items
         call move_alloc(more, self%items)
      end if
      self%count = self%count + 1
      associate (item => self%items(self%count))
         item%name = name
         item%long_name = long_name
         item%kind = kind
         item%unit = '1'
         if (present(unit)) item%unit = unit
         if (present(exists)) item%exists = exists
      end associate
   end subroutine add_item

end module ehlwave_quantity
