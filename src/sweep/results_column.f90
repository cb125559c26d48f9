!> A column of a results file: a quantity of every case.
module ehlwave_results_column
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ehlwave_hdf5_file, only: hdf5_file_t
   use ehlwave_kinds, only: dp, no_value
   use ehlwave_quantity, only: quantity_t, unknown_whole
   implicit none (type, external)
   private

   integer, parameter :: longest_text = 4096      !! longest text; longer texts are cut

   !> A value that has a length.
   type :: cell_t
      character(len=:), allocatable :: text
      real(dp), allocatable :: list(:)
   end type cell_t

   type, public :: column_t
      type(quantity_t), private :: quantity            ! name, kind, unit and long name
      logical, private :: is_empty = .true.            ! no case has this quantity
      integer, private :: longest = 0                  ! length of its longest text or list
      real(dp), allocatable, private :: numbers(:)     ! value of each case,
      type(cell_t), allocatable, private :: cells(:)   ! or, of texts and lists, these
   contains
      procedure :: init
      procedure :: set
      procedure :: write => write_column
      procedure, private :: write_texts, write_lists
   end type column_t

contains

   !> An empty column.
   subroutine init(self, quantity, cases)
      class(column_t), intent(out) :: self
      type(quantity_t), intent(in) :: quantity    !! its value is of no interest
      integer, intent(in) :: cases
      self%quantity = quantity
      select case (quantity%kind)
      case ('text', 'list')
         allocate (self%cells(cases))
      case default
         allocate (self%numbers(cases), source=merge(no_value, real(unknown_whole, dp), quantity%kind == 'real'))
      end select
   end subroutine init

   !> Value of a case.
   subroutine set(self, case, value)
      class(column_t), intent(inout) :: self
      integer, intent(in) :: case
      type(quantity_t), intent(in) :: value       !! value of the kind of the column
      if (.not. value%exists) return
      self%is_empty = .false.
      select case (self%quantity%kind)
      case ('text')
         self%cells(case)%text = value%text
         self%longest = max(self%longest, min(longest_text, len(value%text)))
      case ('list')
         self%cells(case)%list = value%list
         self%longest = max(self%longest, size(value%list))
      case ('real')
         self%numbers(case) = value%number
      case default
         self%numbers(case) = merge(value%number, real(unknown_whole, dp), ieee_is_finite(value%number))
      end select
   end subroutine set

   !> Write the column as a dataset over `case`. Quantities that no case has, and empty lists, are left out.
   subroutine write_column(self, file)
      class(column_t), intent(in) :: self
      type(hdf5_file_t), intent(inout) :: file

      if (self%is_empty) return
      associate (q => self%quantity)
         select case (q%kind)
         case ('text')
            call self%write_texts(file)
         case ('list')
            if (self%longest > 0) call self%write_lists(file)
         case ('real')
            call file%write(q%name, self%numbers, q%unit, q%long_name, 'case')
         case default
            call file%write(q%name, nint(self%numbers), q%unit, q%long_name, 'case')
         end select
      end associate
   end subroutine write_column

   subroutine write_texts(self, file)
      class(column_t), intent(in) :: self
      type(hdf5_file_t), intent(inout) :: file
      character(len=max(1, self%longest)), allocatable :: texts(:)
      integer :: i
      allocate (texts(size(self%cells)))
      texts = ''
      do i = 1, size(texts)
         if (allocated(self%cells(i)%text)) texts(i) = self%cells(i)%text
      end do
      call file%write(self%quantity%name, texts, '', self%quantity%long_name, 'case')
   end subroutine write_texts

   subroutine write_lists(self, file)
      class(column_t), intent(in) :: self
      type(hdf5_file_t), intent(inout) :: file
      real(dp) :: lists(self%longest, size(self%cells))
      character(len=:), allocatable :: scale
      integer :: i

      lists = no_value
      do i = 1, size(self%cells)
         if (allocated(self%cells(i)%list)) lists(:size(self%cells(i)%list), i) = self%cells(i)%list
      end do
      associate (q => self%quantity)
         scale = q%name//'_entry'
         call file%write(scale, [(i, i=1, self%longest)], '1', 'place in '//q%long_name)
         call file%dimension(scale)
         call file%write(q%name, lists, q%unit, q%long_name, scale, 'case')
      end associate
   end subroutine write_lists

end module ehlwave_results_column
