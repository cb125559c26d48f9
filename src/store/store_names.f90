!> Names of the parts of a store, and its place.
module ehlwave_store_names
   use ehlwave_identity_index, only: identity_length
   use ehlwave_posix, only: checksum, is_temporary
   use ehlwave_text, only: next_line, to_text
   implicit none (type, external)
   private
   public :: defaults_text, foreign_name, log_name, part_name, read_log_name, store_path

   character(len=*), parameter, public :: cases_name = 'cases', lock_name = 'lock', records_name = 'records'
   character(len=*), parameter, public :: defaults_name = 'defaults'
   integer, parameter :: most_digits = 9   !! digits of a run or a rank
   !> Generation of the defaults of keys, raised by one when a default changes. Stores without a file of that name
   !> have generation 0.
   integer, parameter, public :: newest_defaults = 1
   character(len=*), parameter, public :: folders(3) = [character(len=11) :: records_name, 'checkpoints', 'fields']
   !> In the order in which they are removed: `store` before `defaults`, without which it would be of generation 0.
   character(len=*), parameter, public :: files(4) = [character(len=11) :: cases_name, 'store', defaults_name, &
      lock_name]

contains

   !> Folder of the store of a results file: results.h5 has results.store. A store is its own.
   pure function store_path(output) result(path)
      character(len=*), intent(in) :: output
      character(len=:), allocatable :: path
      integer :: n
      n = len_trim(output)
      path = output(:n)
      if (n > 1 .and. output(n:n) == '/') path = output(:n - 1)
      n = len(path)
      if (n > 6) then
         if (path(n - 5:) == '.store') return
      end if
      if (n > 3) then
         if (path(n - 2:) == '.h5') path = path(:n - 3)
      end if
      path = path//'.store'
   end function store_path

   !> Name of the log of a rank in a run: six digits each, more where it takes them.
   pure function log_name(run, rank) result(name)
      integer, intent(in) :: run, rank
      character(len=:), allocatable :: name
      character(len=32) :: buffer
      write (buffer, '(i0.6,a,i0.6,a)') run, '-', rank, '.log'
      name = trim(buffer)
   end function log_name

   !> Run and rank of the log of a name; -1 where it is not the name of a log.
   pure subroutine read_log_name(name, run, rank)
      character(len=*), intent(in) :: name
      integer, intent(out) :: run, rank
      integer :: dash, io, point

      run = -1
      rank = -1
      dash = index(name, '-')
      point = index(name, '.log')
      if (dash < 2 .or. dash > most_digits + 1 .or. point < dash + 2 .or. point > dash + most_digits + 1) return
      if (point + 3 /= len(name) .or. verify(name(:dash - 1)//name(dash + 1:point - 1), '0123456789') > 0) return
      read (name(:dash - 1), *, iostat=io) run
      read (name(dash + 1:point - 1), *, iostat=io) rank
   end subroutine read_log_name

   !> First name that no file in a part of a store has; empty where there is none. Files that another part of the
   !> program is writing have names of their own.
   function foreign_name(part, names) result(foreign)
      character(len=*), intent(in) :: part    !! a folder of the store, or empty: the store itself
      character(len=*), intent(in) :: names   !! one per line
      character(len=:), allocatable :: foreign
      character(len=*), parameter :: digits = '0123456789ABCDEF'
      integer :: first, last, rank, run
      logical :: is_ours

      last = -1
      foreign = ''
      do while (next_line(names, first, last))
         associate (name => names(first:last))
            select case (part)
            case ('')
               is_ours = any(folders == name) .or. any(files == name)
            case (records_name)
               call read_log_name(name, run, rank)
               is_ours = run >= 0
            case ('checkpoints')
               is_ours = len(name) == identity_length .and. verify(name, digits) == 0
            case default
               is_ours = len(name) == identity_length + 3 .and. verify(name, digits) == identity_length + 1
               if (is_ours) is_ours = name(identity_length + 1:) == '.h5'
            end select
            if (is_temporary(name) .or. is_ours) cycle
            foreign = name
            return
         end associate
      end do
   end function foreign_name

   !> Folder i of a store, empty for i = 0: the store itself.
   pure function part_name(i) result(name)
      integer, intent(in) :: i
      character(len=:), allocatable :: name
      name = ''
      if (i > 0) name = trim(folders(i))
   end function part_name

   !> Content of the file with the generation of the defaults: the number and its checksum.
   function defaults_text(generation) result(text)
      integer, intent(in) :: generation
      character(len=:), allocatable :: text
      text = to_text(generation)//' '//checksum(to_text(generation))//new_line('a')
   end function defaults_text

end module ehlwave_store_names
