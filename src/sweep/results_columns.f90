!> Columns of a results file that come from the store alone. Every column that a record of it has becomes a dataset,
!> without being named here.
module ehlwave_results_columns
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_quiet_nan, ieee_value
   use ehlwave_column_names, only: describe_column
   use ehlwave_hdf5_file, only: hdf5_file_t
   use ehlwave_json_reader, only: json_number, json_string, split_list
   use ehlwave_kinds, only: dp
   use ehlwave_store_contents, only: contents_t, run_element
   implicit none (type, external)
   private
   public :: write_outcomes, write_runs

   integer, parameter :: longest_text = 4096      !! of a column; what is longer is cut

   !> What of the header of a log goes into the rows of its cases.
   character(len=*), parameter :: run_columns(8) = [character(len=16) :: 'run', 'job', 'program_version', 'git_revision', &
                                                   'compiler', 'compiler_flags', 'library_versions', 'mpi_library']

contains

   !> A dataset for every column of the records that the file has not yet.
   subroutine write_outcomes(file, contents, place)
      type(hdf5_file_t), intent(inout) :: file
      type(contents_t), intent(in) :: contents
      integer, intent(in) :: place(:)
      character(len=:), allocatable :: name
      integer :: column(size(contents%layouts))   ! of the present name, in each layout
      integer :: k, l, other

      do l = 1, size(contents%layouts)
         do k = 1, size(contents%layouts(l)%names)
            name = trim(contents%layouts(l)%names(k))
            if (file%has(name)) cycle
            do other = 1, size(contents%layouts)
               column(other) = findloc(contents%layouts(other)%names, contents%layouts(l)%names(k), 1)
            end do
            call write_column(file, contents, place, column, name, trim(contents%layouts(l)%kinds(k)))
         end do
      end do
   end subroutine write_outcomes

   !> One column, whatever its kind. Missing: NaN, -1, empty.
   subroutine write_column(file, contents, place, column, name, kind)
      type(hdf5_file_t), intent(inout) :: file
      type(contents_t), intent(in) :: contents
      integer, intent(in) :: place(:), column(:)
      character(len=*), intent(in) :: name, kind
      character(len=:), allocatable :: units, long_name, value
      real(dp), allocatable :: numbers(:), lists(:, :)
      integer, allocatable :: first(:), last(:)
      integer :: i, k, longest

      call describe_column(name, units, long_name)
      select case (kind)
      case ('real', 'integer', 'logical')
         allocate (numbers(size(place)), source=ieee_value(1.0_dp, ieee_quiet_nan))
         do i = 1, size(place)
            numbers(i) = json_number(value_of(i))
         end do
         if (kind == 'real') then
            call file%write(name, numbers, 'case', units, long_name)
         else
            where (.not. ieee_is_finite(numbers)) numbers = -1
            call file%write(name, nint(numbers), 'case', units, long_name)
         end if
      case ('list')
         longest = 0
         do i = 1, size(place)
            call split_list(value_of(i), first, last)
            longest = max(longest, size(first))
         end do
         if (longest == 0) return
         allocate (lists(longest, size(place)), source=ieee_value(1.0_dp, ieee_quiet_nan))
         do i = 1, size(place)
            value = value_of(i)
            call split_list(value, first, last)
            do k = 1, size(first)
               lists(k, i) = json_number(value(first(k):last(k)))
            end do
         end do
         call file%write(name//'_entry', [(k, k=1, longest)], '', '1', 'place in '//long_name)
         call file%dimension(name//'_entry')
         call file%write(name, lists, name//'_entry', 'case', units, long_name)
      case default
         longest = 1
         do i = 1, size(place)
            longest = max(longest, min(longest_text, len(value_of(i))))
         end do
         call write_texts(longest)
      end select

   contains

      subroutine write_texts(length)
         integer, intent(in) :: length
         character(len=length) :: texts(size(place))
         integer :: n
         do n = 1, size(place)
            texts(n) = json_string(value_of(n))
         end do
         call file%write(name, texts, 'case', '', long_name)
      end subroutine write_texts

      !> JSON of this column for a case of the sweep; empty when there is none.
      function value_of(case) result(text)
         integer, intent(in) :: case
         character(len=:), allocatable :: text
         text = ''
         if (place(case) == 0) return
         associate (record => contents%cases(place(case)))
            if (column(record%layout) == 0) return
            text = record%text(record%first(column(record%layout)):record%last(column(record%layout)))
         end associate
      end function value_of

   end subroutine write_column

   !> Which run of which build made each row.
   subroutine write_runs(file, contents, place)
      type(hdf5_file_t), intent(inout) :: file
      type(contents_t), intent(in) :: contents
      integer, intent(in) :: place(:)
      character(len=longest_text), allocatable :: of_log(:)
      character(len=:), allocatable :: units, long_name
      integer :: i, k, log, longest

      allocate (of_log(size(contents%logs)))
      do k = 1, size(run_columns)
         call describe_column(trim(run_columns(k)), units, long_name)
         if (run_columns(k) == 'run') then
            call file%write('run', [(run_of(i), i=1, size(place))], 'case', units, long_name)
            cycle
         end if
         longest = 1
         do log = 1, size(contents%logs)
            of_log(log) = json_string(run_element(contents%logs(log), trim(run_columns(k))))
            longest = max(longest, len_trim(of_log(log)))
         end do
         call write_texts(trim(run_columns(k)), longest)
      end do

   contains

      subroutine write_texts(name, length)
         character(len=*), intent(in) :: name
         integer, intent(in) :: length
         character(len=length) :: texts(size(place))
         integer :: n
         texts = ''
         do n = 1, size(place)
            if (place(n) > 0) texts(n) = of_log(contents%cases(place(n))%log)
         end do
         call file%write(name, texts, 'case', '', long_name)
      end subroutine write_texts

      pure integer function run_of(case)
         integer, intent(in) :: case
         run_of = -1
         if (place(case) > 0) run_of = contents%cases(place(case))%run
      end function run_of

   end subroutine write_runs

end module ehlwave_results_columns
