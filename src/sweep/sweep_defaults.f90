!> The defaults of keys of a sweep: the defaults at the start of its store, from its records.
module ehlwave_sweep_defaults
   use ehlwave_errors, only: error_t, raise
   use ehlwave_store_defaults, only: not_said, origin_t, read_origin
   use ehlwave_store_names, only: defaults_name, newest_defaults
   use ehlwave_text, only: to_text
   implicit none (type, external)
   private
   public :: choose_defaults

   character(len=*), parameter, public :: edges_of_old_stores = 'truncated'   !! the default of the key in generation 0

contains

   !> Generation of the defaults for a sweep into a store. A store of which nothing is recorded has the newest.
   !>
   !> Fails where the store contradicts itself: other defaults are other results.
   subroutine choose_defaults(folder, generation, notice, error)
      character(len=*), intent(in) :: folder       !! folder of the store; it need not exist
      integer, intent(out) :: generation
      character(len=:), allocatable, intent(out) :: notice   !! notice for the user, a line or nothing
      type(error_t), allocatable, intent(inout) :: error
      type(origin_t) :: origin
      character(len=:), allocatable :: records
      integer :: recorded
      logical :: is_possible

      generation = newest_defaults
      notice = ''
      call read_origin(folder, origin, error)
      if (allocated(error)) return
      recorded = origin%recorded
      records = 'that they have the defaults of generation '//to_text(recorded)
      is_possible = any(origin%filed == [not_said, recorded])
      if (recorded == not_said .and. allocated(origin%input)) then
         recorded = generation_of(origin%input)
         records = edges_in(origin%input)
         ! a sweep file can have asked for the edges of before, but no case of today has none
         is_possible = any(origin%filed == [not_said, recorded]) .or. (origin%filed > 0 .and. says_edges(origin%input))
      else if (recorded == not_said) then
         is_possible = .true.
      end if
      if (.not. is_possible) then
         call raise(error, folder//' contradicts itself: its file '//defaults_name//' has generation '// &
                    to_text(origin%filed)//', its records say '//records// &
                    '. One of them is of another store, or damaged: put '// &
                    'the right one back, or remove '//defaults_name//' to have the records decide')
      else if (origin%filed /= not_said) then
         generation = origin%filed
      else if (recorded /= not_said) then
         generation = recorded
         if (generation > 0) notice = 'NOTICE: '//folder//' had lost its file '//defaults_name// &
            '; its records say '//records//', and it goes on so'//new_line('a')
      end if
   end subroutine choose_defaults

   !> The generation whose default an effective input has.
   integer function generation_of(input)
      character(len=*), intent(in) :: input
      generation_of = merge(1, 0, says_edges(input) .and. index(input, " edges = '"//edges_of_old_stores//"'") == 0)
   end function generation_of

   logical function says_edges(input)
      character(len=*), intent(in) :: input
      says_edges = index(input, ' edges = ') > 0
   end function says_edges

   !> The edges of an effective input, in the words of a message.
   function edges_in(input) result(text)
      character(len=*), intent(in) :: input
      character(len=:), allocatable :: text
      integer :: first
      text = "nothing of edges, as before they were a key"
      first = index(input, ' edges = ')
      if (first > 0) text = input(first + 1:first + index(input(first + 1:)//new_line('a'), new_line('a')) - 1)
   end function edges_in

end module ehlwave_sweep_defaults
