!> Provenance of a result, as quantities: this build, and the libraries that it runs with.
module ehlwave_provenance_list
   use ehlwave_process, only: library_text
   use ehlwave_provenance, only: build_type, compiler, compiler_flags, git_revision, library_versions, program_version
   use ehlwave_quantity, only: quantity_list_t
   use hdf5, only: h5get_libversion_f
   implicit none (type, external)
   private
   public :: add_provenance, version_text

contains

   !> Add all provenance, as texts.
   subroutine add_provenance(list)
      type(quantity_list_t), intent(inout) :: list
      call list%add('program_version', 'version of the program', program_version)
      call list%add('git_revision', 'revision of its source', git_revision)
      call list%add('compiler', 'compiler', compiler)
      call list%add('compiler_flags', 'flags that the Fortran files were compiled with', compiler_flags)
      call list%add('build_type', 'type of the build', build_type)
      call list%add('library_versions', 'libraries as loaded, and as built if loaded on demand', &
         loaded_libraries())
      call list%add('processor', 'model of the processor', processor())
   end subroutine add_provenance

   !> The text of `--version`, and of `--version --verbose`: the above and, of a program that has it, its MPI library.
   function version_text(is_verbose, mpi_library) result(text)
      logical, intent(in) :: is_verbose
      character(len=*), intent(in), optional :: mpi_library
      character(len=:), allocatable :: text
      type(quantity_list_t) :: list
      integer :: i

      text = 'ehlwave '//program_version
      if (.not. is_verbose) return
      call add_provenance(list)
      if (present(mpi_library)) call list%add('mpi_library', 'MPI library, as it names itself', mpi_library)
      do i = 1, list%count
         text = text//new_line('a')//list%items(i)%name//': '//list%items(i)%text
      end do
   end function version_text

   !> Names and versions of the libraries that numbers depend on.
   function loaded_libraries() result(text)
      character(len=:), allocatable :: text
      character(len=:), allocatable :: c_library, fftw
      character(len=40) :: hdf5
      integer :: number(3), status

      fftw = library_text('fftw_version')                ! fftw-3.3.10-sse2-avx...
      if (index(fftw, 'fftw-') == 1) then
         fftw = fftw(6:)
         text = 'FFTW '//fftw(:scan(fftw//'-', '-') - 1)
      else
         text = built_with('FFTW')                       ! in the program itself, or a library that replaces it
      end if
      call h5get_libversion_f(number(1), number(2), number(3), status)
      write (hdf5, '(a,i0,2(".",i0))') 'HDF5 ', number
      text = text//', '//trim(hdf5)
      c_library = library_text('')
      if (c_library /= '') text = text//', '//c_library
      if (index(library_versions, 'PETSc') > 0) text = text//', '//built_with('PETSc')//' on demand'
   end function loaded_libraries

   !> A library as the build has found it, "NAME VERSION".
   pure function built_with(name) result(text)
      character(len=*), intent(in) :: name
      character(len=:), allocatable :: text
      integer :: i
      i = index(library_versions, name)
      text = name//' unknown'
      if (i > 0) text = library_versions(i:i + scan(library_versions(i:)//',', ',') - 2)
   end function built_with

   !> The model of the processor as Linux reports it, else "unknown".
   function processor() result(text)
      character(len=:), allocatable :: text
      character(len=200) :: line
      integer :: io, unit

      text = 'unknown'
      open (newunit=unit, file='/proc/cpuinfo', action='read', iostat=io)
      if (io /= 0) return
      do
         read (unit, '(a)', iostat=io) line
         if (io /= 0) exit
         if (index(line, 'model name') /= 1) cycle
         text = trim(adjustl(line(index(line, ':') + 1:)))
         exit
      end do
      close (unit)
   end function processor

end module ehlwave_provenance_list
