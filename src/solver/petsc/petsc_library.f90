!> The library of PETSc's solver (`petsc_snes.c`), loaded when it is asked for.
module ehlwave_petsc_library
   use, intrinsic :: iso_c_binding, only: c_associated, c_f_procpointer, c_funptr
   use ehlwave_errors, only: error_t, raise
   use ehlwave_process, only: find_procedure
   use ehlwave_provenance, only: library_versions
   implicit none (type, external)
   private
   public :: find_solver, finish_petsc, has_petsc, require_petsc

   logical, parameter, public :: is_petsc_built = index(library_versions, 'PETSc') > 0   !! with this build
   character(len=*), parameter :: default_library = 'libehlwave_petsc.so'   !! beside the program: see its run path

   abstract interface
      subroutine finish_t() bind(c)
         implicit none (type, external)
      end subroutine finish_t
   end interface

contains

   !> Path or name of the library: EHLWAVE_PETSC_LIBRARY overrides the library of this build.
   function library() result(path)
      character(len=:), allocatable :: path
      integer :: length
      call get_environment_variable('EHLWAVE_PETSC_LIBRARY', length=length)
      allocate (character(len=length) :: path)
      if (length > 0) then
         call get_environment_variable('EHLWAVE_PETSC_LIBRARY', path)
      else
         path = default_library
      end if
   end function library

   !> The function that solves, for `petsc_binding`; not associated if the library is missing, with the `reason`.
   subroutine find_solver(solver, reason)
      type(c_funptr), intent(out) :: solver
      character(len=:), allocatable, intent(out) :: reason
      call find_procedure(library(), 'ehlwave_solve_inequality', .true., solver, reason)
   end subroutine find_solver

   !> Whether PETSc can be had. Loads it.
   logical function has_petsc()
      type(error_t), allocatable :: error
      call require_petsc(error)
      has_petsc = .not. allocated(error)
   end function has_petsc

   !> Error with the way to get PETSc where it is missing. Call before choosing its solver. Loads it.
   subroutine require_petsc(error)
      type(error_t), allocatable, intent(out) :: error
      type(c_funptr) :: solver
      character(len=:), allocatable :: advice, reason

      call find_solver(solver, reason)
      if (c_associated(solver)) return
      if (is_petsc_built) then
         advice = 'it belongs into the folder lib beside that of this program, or name it in EHLWAVE_PETSC_LIBRARY,'
      else
         advice = 'this build has none; install PETSc 3.17 or later and configure with -DEHLWAVE_PETSC=ON,'
      end if
      call raise(error, 'PETSc cannot be loaded ('//reason//'): '//advice//' or choose another solver')
   end subroutine require_petsc

   !> End PETSc if it was started here, and MPI if that was too. For drivers: after the last solve, before
   !> MPI_Finalize. No solve by PETSc afterwards.
   subroutine finish_petsc()
      procedure(finish_t), pointer :: finish
      type(c_funptr) :: found
      character(len=:), allocatable :: reason
      call find_procedure(library(), 'ehlwave_finish_petsc', .false., found, reason)
      if (.not. c_associated(found)) return
      call c_f_procpointer(found, finish)
      call finish()
   end subroutine finish_petsc

end module ehlwave_petsc_library
