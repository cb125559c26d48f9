!> Command line arguments: switches, options with a value, files.
module ehlwave_arguments
   use ehlwave_errors, only: error_t, raise
   use ehlwave_text, only: shown, to_text
   implicit none (type, external)
   private
   public :: read_arguments

   integer, parameter :: longest = 4096

   type, public :: arguments_t
      character(len=longest), allocatable :: files(:)                 !! arguments without dashes, in order
      character(len=longest), allocatable, private :: names(:), values(:)
   contains
      procedure :: has
      procedure :: value
   end type arguments_t

contains

   !> Read the command line. Fails on unknown or repeated options and on options without their value.
   subroutine read_arguments(switches, options, arguments, error)
      character(len=*), intent(in) :: switches(:)   !! e.g. '--plan'
      character(len=*), intent(in) :: options(:)    !! followed by a value: '--output FILE' or '--output=FILE'
      type(arguments_t), intent(out) :: arguments
      type(error_t), allocatable, intent(out) :: error
      character(len=longest) :: argument, name, value
      integer :: equal, i, length

      allocate (arguments%files(0), arguments%names(0), arguments%values(0))
      i = 0
      do while (i < command_argument_count())
         i = i + 1
         call get_command_argument(i, argument, length)
         if (length > longest) then
            call raise(error, 'argument '//to_text(i)//' has '//to_text(length)//' characters: give at most '// &
               to_text(longest))
            return
         end if
         if (argument(1:1) /= '-' .or. argument == '-') then
            call refuse_blank_end(argument, length, error)
            if (allocated(error)) return
            arguments%files = [character(len=longest) :: arguments%files, argument]
            cycle
         end if
         equal = index(argument, '=')
         if (equal == 0) equal = longest + 1
         name = argument(:equal - 1)
         value = argument(equal + 1:)
         if (any(options == name)) then
            if (equal > longest) then
               i = i + 1
               call get_command_argument(i, value, length)      ! blank after the last argument
               if (length > longest) value = ''
            end if
            if (value /= '') call refuse_blank_end(merge(argument, value, equal <= longest), length, error)
            if (value == '') call raise(error, trim(name)//' needs a value, of at most '//to_text(longest)// &
               ' characters')
         else if (.not. any(switches == name) .or. equal <= longest) then
            call raise(error, 'unknown option '//shown(trim(argument)))
         end if
         if (arguments%has(trim(name)) .and. .not. allocated(error)) call raise(error, trim(name)//' is given twice')
         if (allocated(error)) return
         arguments%names = [character(len=longest) :: arguments%names, name]
         arguments%values = [character(len=longest) :: arguments%values, value]
      end do
   end subroutine read_arguments

   !> Refuse a value that ends in a blank, which Fortran drops: another file would be read or written.
   subroutine refuse_blank_end(argument, length, error)
      character(len=*), intent(in) :: argument
      integer, intent(in) :: length                 !! length as given
      type(error_t), allocatable, intent(inout) :: error
      if (length > len_trim(argument)) call raise(error, "'"//shown(argument(:length))// &
         "' ends in a blank, which would be left out: give it without")
   end subroutine refuse_blank_end

   !> Whether a switch or option was given.
   pure logical function has(self, name)
      class(arguments_t), intent(in) :: self
      character(len=*), intent(in) :: name
      has = any(self%names == name)
   end function has

   !> Value of an option, empty when it was not given.
   pure function value(self, name)
      class(arguments_t), intent(in) :: self
      character(len=*), intent(in) :: name
      character(len=:), allocatable :: value
      integer :: i
      value = ''
      do i = 1, size(self%names)
         if (self%names(i) == name) value = trim(self%values(i))
      end do
   end function value

end module ehlwave_arguments
