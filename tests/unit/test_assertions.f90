!> Preconditions: a debug build ends with a message where one fails; a release build does not check.
program test_assertions
   use ehlwave_assertions, only: checks
   use ehlwave_grid, only: grid_t, new_line_grid
   use ehlwave_kinds, only: dp
   use ehlwave_transport, only: characteristic_transport, transport_t
   use testing, only: test_t
   implicit none (type, external)

   character(len=*), parameter :: report = 'test_assertions.txt'
   type(test_t) :: test
   character(len=1000) :: program
   integer :: status

   if (command_argument_count() > 0) call make_mistake()
   call get_command_argument(0, program)
   call execute_command_line(trim(program)//' mistake 2> '//report, exitstat=status)
   call test%check((status /= 0) .eqv. checks, 'debug builds end, others go on')
   call test%check(says('characteristic_transport: ') .eqv. checks, 'and say which precondition it is')
   call test%finish()

contains

   !> A time step that is neither cells for a step nor steps for a cell.
   subroutine make_mistake()
      type(grid_t) :: grid
      type(transport_t) :: transport
      grid = new_line_grid(-2.5_dp, 1.5_dp, 32)
      transport = characteristic_transport(grid, 2, 2)
      if (transport%cells_per_step == 2) stop
   end subroutine make_mistake

   !> Whether the report has a text.
   logical function says(text)
      character(len=*), intent(in) :: text
      character(len=500) :: line
      integer :: io, unit
      says = .false.
      open (newunit=unit, file=report, action='read')
      do
         read (unit, '(a)', iostat=io) line
         if (io /= 0) exit
         says = says .or. index(line, text) > 0
      end do
      close (unit, status='delete')
   end function says

end program test_assertions
