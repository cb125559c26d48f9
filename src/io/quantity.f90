!> Quantities: values with a name, a unit and a long name, for any kind of output.
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
      character(len=:), allocatable :: error_of      !! result whose relative error it is, for people
      real(dp) :: number = no_value  !! value of all kinds but text and list; true is 1, false 0, NaN: unknown
      character(len=:), allocatable :: text
      real(dp), allocatable :: list(:)
   end type quantity_t

   !> Quantities in the order in which they were added; the caller gives each name once.
   type, public :: quantity_list_t
      integer :: count = 0
      type(quantity_t), allocatable :: items(:)      !! items(:count)
      logical :: has_errors_only = .false.           !! others are not added: for a look at the errors alone
   contains
      procedure :: add
      procedure :: add_truth
      procedure :: add_list
      procedure :: find
      procedure :: is_like
   end type quantity_list_t

   integer, parameter :: usual_size = 320, few = 32   ! of a case, and of its errors alone
   integer, parameter, public :: unknown_whole = -1   !! in files, of whole numbers and truths; else NaN or nothing

contains

   !> Place of a name in the list, 0 when it is not there.
   pure integer function find(self, name)
      class(quantity_list_t), intent(in) :: self
      character(len=*), intent(in) :: name
      do find = self%count, 1, -1
         if (self%items(find)%name == name) return
      end do
   end function find

   !> Whether two lists have the same names, kinds and existing quantities, in the same order.
   pure logical function is_like(self, other)
      class(quantity_list_t), intent(in) :: self
      type(quantity_list_t), intent(in) :: other
      integer :: k
      is_like = self%count == other%count
      do k = 1, self%count
         if (.not. is_like) return
         associate (a => self%items(k), b => other%items(k))
            is_like = a%name == b%name .and. a%kind == b%kind .and. (a%exists .eqv. b%exists)
         end associate
      end do
   end function is_like

   !> Add a real or whole number, a logical, or a text, which is kept with its trailing blanks.
   subroutine add(self, name, long_name, value, unit, exists, error_of)
      class(quantity_list_t), intent(inout) :: self
      character(len=*), intent(in) :: name, long_name
      class(*), intent(in) :: value
      character(len=*), intent(in), optional :: unit   !! default: '1', of a text ''
      logical, intent(in), optional :: exists          !! default: true
      character(len=*), intent(in), optional :: error_of   !! result whose relative error this is

      if (self%has_errors_only .and. .not. present(error_of)) return
      call lengthen(self)
      associate (item => self%items(self%count))
         item%name = name
         item%long_name = long_name
         item%unit = '1'
         select type (value)
         type is (real(dp))
            item%kind = 'real'
            item%number = value
         type is (integer)
            item%kind = 'integer'
            item%number = value
         type is (logical)
            item%kind = 'logical'
            item%number = merge(1, 0, value)
         type is (character(len=*))
            item%kind = 'text'
            item%text = value
            item%unit = ''
         end select
         if (present(unit)) item%unit = unit
         item%exists = .true.
         if (present(exists)) item%exists = exists
         if (present(error_of)) then
            item%error_of = error_of
         else if (allocated(item%error_of)) then
            deallocate (item%error_of)
         end if
      end associate
   end subroutine add

   !> Add a logical that may be unknown (not allocated).
   subroutine add_truth(self, name, long_name, value, exists)
      class(quantity_list_t), intent(inout) :: self
      character(len=*), intent(in) :: name, long_name
      logical, intent(in), allocatable :: value
      logical, intent(in), optional :: exists          !! default: true
      if (self%has_errors_only) return
      call self%add(name, long_name, .false., exists=exists)
      self%items(self%count)%number = no_value
      if (allocated(value)) self%items(self%count)%number = merge(1, 0, value)
   end subroutine add_truth

   !> Add a list of real numbers; it is absent if not allocated.
   subroutine add_list(self, name, long_name, value)
      class(quantity_list_t), intent(inout) :: self
      character(len=*), intent(in) :: name, long_name
      real(dp), intent(in), allocatable :: value(:)
      if (self%has_errors_only) return
      call lengthen(self)
      associate (item => self%items(self%count))
         item = quantity_t(name, long_name, '1', 'list', exists=allocated(value))
         if (allocated(value)) item%list = value
      end associate
   end subroutine add_list

   !> One more item, with the values of an item of an earlier list.
   subroutine lengthen(self)
      class(quantity_list_t), intent(inout) :: self
      type(quantity_t), allocatable :: more(:)

      if (.not. allocated(self%items)) allocate (self%items(merge(few, usual_size, self%has_errors_only)))
      if (self%count == size(self%items)) then
         allocate (more(2*self%count))
         more(:self%count) = self%items
         call move_alloc(more, self%items)
      end if
      self%count = self%count + 1
   end subroutine lengthen

end module ehlwave_quantity
