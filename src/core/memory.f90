!> The memory that this process can have, and its end if there is no more.
module ehlwave_memory
   use, intrinsic :: iso_c_binding, only: c_double, c_int, c_size_t
   use ehlwave_kinds, only: dp
   implicit none (type, external)
   private
   public :: can_allocate, memory_limit_mib, out_of_memory, return_memory

   !> Nodes of a grid above which a solve takes less memory: columns of GMRES in single precision, and a linear system
   !> at a time. Response on 1024^2 cells, half of them computed: 554 MiB in place of 952, in the same steps.
   integer, parameter, public :: many_nodes = 200000

   interface
      !> End the program with a line on standard error and status 4. Allocations of our own end so by themselves; this
      !> procedure serves allocations of libraries.
      subroutine out_of_memory(bytes) bind(c, name='ehlwave_out_of_memory')
         import :: c_size_t
         implicit none (type, external)
         integer(c_size_t), value :: bytes   !! requested bytes
      end subroutine out_of_memory
      !> Return freed memory to the system before many arrays of another size are made.
      subroutine return_memory() bind(c, name='ehlwave_return_memory')
         implicit none (type, external)
      end subroutine return_memory
      integer(c_int) function c_can_allocate(bytes) bind(c, name='ehlwave_can_allocate')
         import :: c_int, c_size_t
         implicit none (type, external)
         integer(c_size_t), value :: bytes
      end function c_can_allocate
      real(c_double) function c_memory_limit() bind(c, name='ehlwave_memory_limit')
         import :: c_double
         implicit none (type, external)
      end function c_memory_limit
   end interface

contains

   !> Whether so many bytes could be allocated now: to be asked where too large a size is the fault of an input.
   logical function can_allocate(bytes)
      integer(c_size_t), intent(in) :: bytes
      can_allocate = c_can_allocate(bytes) /= 0
   end function can_allocate

   !> Most memory this process can have, in MiB: limits of the process (`ulimit -v`) and its control groups, machine
   !> and swap.
   real(dp) function memory_limit_mib()
      memory_limit_mib = c_memory_limit()/2.0_dp**20
   end function memory_limit_mib

end module ehlwave_memory
