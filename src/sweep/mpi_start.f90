!> Watch over the start of MPI, which ends a program by itself where it cannot start.
module ehlwave_mpi_start
   use, intrinsic :: iso_c_binding, only: c_int
   implicit none (type, external)
   private
   public :: watch_start

   interface
      !> Begin (1) or end (0) the watch: an end of the program in between prints a line and has status 4.
      subroutine watch_start(begins) bind(c, name='ehlwave_watch_start')
         import :: c_int
         implicit none (type, external)
         integer(c_int), value :: begins
      end subroutine watch_start
   end interface

end module ehlwave_mpi_start
