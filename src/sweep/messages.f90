!> The messages between rank 0 and the others: all of MPI that the work on cases needs.
!>
!> A request is answered by cases, the last of them marked (number 0: there is none), every case by its outcome, and
!> rank 0 sends exactly one `stop` to each of the others. A case travels as its effective input with the digests of the
!> files that it reads, so only rank 0 reads the sweep file; results do not travel: every rank stores its own. Rank 0
!> does not wait until a case is received: the receiver may be in the middle of a long step.
module ehlwave_messages
   use ehlwave_case_definition, only: case_t
   use ehlwave_case_file, only: case_from_text
   use ehlwave_case_files, only: case_file_t, file_changed_since, file_digests
   use ehlwave_case_plan, only: make_plan
   use ehlwave_case_keys, only: list_case_keys
   use ehlwave_case_text, only: input_text
   use ehlwave_errors, only: error_t, raise
   use ehlwave_key_list, only: key_list_t
   use ehlwave_outcome, only: outcome_t
   use ehlwave_planned_case, only: case_plan_t
   use ehlwave_text, only: to_text
   use mpi_f08, only: mpi_any_source, mpi_any_tag, mpi_character, mpi_comm, mpi_get_count, mpi_iprobe, &
      mpi_isend, mpi_probe, mpi_recv, mpi_request, mpi_request_null, mpi_send, mpi_status, mpi_status_ignore, mpi_wait
   implicit none (type, external)
   private
   public :: is_waiting, next_message, receive_case, receive_outcome, receive_word, send_word

   integer, parameter, public :: no_case = 0
   integer, parameter, public :: ask = 1, stop_work = 2   !! words: messages without anything in them
   integer, parameter :: tag_case = 3, tag_outcome = 4
   integer, parameter :: number_digits = 12   !! digits of the number of a case, before its input
   integer, parameter :: marks = 2            !! behind it: T: keep fields; T: another case follows

   type :: letter_t
      character(len=:), allocatable :: text
      type(mpi_request) :: request = mpi_request_null
   end type letter_t

   !> Messages on their way, which stay where they are until they are received: answers of rank 0, outcomes of another
   !> rank. A rank that has at most n unanswered requests has received its last answer but n when it asks again, and
   !> rank 0 the outcomes before that, so that n places for each case of an answer are enough for each receiver.
   !> (MPI_Send of more than 256 bytes waits, in Open MPI 4.1, until the receiver looks at its messages: rank 0 does
   !> that between two cases of its own.)
   type, public :: outbox_t
      type(mpi_comm), private :: comm
      type(letter_t), allocatable, private :: letters(:, :)   ! (n, receivers)
      integer, allocatable, private :: place(:)               ! (receivers) of the last letter
   contains
      procedure :: init => outbox_init
      procedure :: send_case
      procedure :: send_outcome
      procedure :: wait => wait_for_all
      procedure, private :: post
   end type outbox_t

contains

   !> Whether there is a message of any rank, or a word of rank 0.
   logical function is_waiting(comm, word)
      type(mpi_comm), intent(in) :: comm
      integer, intent(in), optional :: word
      if (present(word)) then
         call mpi_iprobe(0, word, comm, is_waiting, mpi_status_ignore)
      else
         call mpi_iprobe(mpi_any_source, mpi_any_tag, comm, is_waiting, mpi_status_ignore)
      end if
   end function is_waiting

   !> Rank 0: wait for a message; a request is received with that, an outcome is not.
   subroutine next_message(comm, rank, is_request)
      type(mpi_comm), intent(in) :: comm
      integer, intent(out) :: rank              !! rank that sent it
      logical, intent(out) :: is_request
      type(mpi_status) :: status
      call mpi_probe(mpi_any_source, mpi_any_tag, comm, status)
      rank = status%mpi_source
      is_request = status%mpi_tag == ask
      if (is_request) call receive_word(comm, rank, ask)
   end subroutine next_message

   subroutine send_word(comm, rank, word)
      type(mpi_comm), intent(in) :: comm
      integer, intent(in) :: rank, word
      call mpi_send('', 0, mpi_character, rank, word, comm)
   end subroutine send_word

   subroutine receive_word(comm, rank, word)
      type(mpi_comm), intent(in) :: comm
      integer, intent(in) :: rank, word
      character(len=1) :: nothing
      call mpi_recv(nothing, 0, mpi_character, rank, word, comm, mpi_status_ignore)
   end subroutine receive_word

   subroutine outbox_init(self, comm, first, last, places)
      class(outbox_t), intent(out) :: self
      type(mpi_comm), intent(in) :: comm
      integer, intent(in) :: first, last   !! receivers: the ranks from first to last
      integer, intent(in) :: places        !! cases in all requests that a rank has at most
      self%comm = comm
      allocate (self%letters(places, first:last))
      allocate (self%place(first:last), source=0)
   end subroutine outbox_init

   !> Rank 0: answer a request, by a last case or some before it. Returns at once.
   subroutine send_case(self, rank, number, input, has_fields, files, is_last)
      class(outbox_t), intent(inout) :: self
      integer, intent(in) :: rank, number
      character(len=*), intent(in), optional :: input       !! effective input of the case; absent: there is none
      logical, intent(in), optional :: has_fields           !! its fields are kept
      type(case_file_t), intent(in), optional :: files(:)   !! files of its plan
      logical, intent(in), optional :: is_last              !! no other case follows
      character(len=:), allocatable :: text

      text = repeat(' ', number_digits)
      write (text, '(i12)') number
      if (present(input)) text = text//merge('T', 'F', has_fields)//merge('F', 'T', is_last)//input//file_digests(files)
      call self%post(rank, tag_case, text)
   end subroutine send_case

   !> Send rank 0 the outcome of a case. Returns at once.
   subroutine send_outcome(self, outcome)
      class(outbox_t), intent(inout) :: self
      type(outcome_t), intent(in) :: outcome
      character(len=storage_size(outcome)/8) :: text
      text = transfer(outcome, text)
      call self%post(0, tag_outcome, text)
   end subroutine send_outcome

   !> Send a text when the letter in its place has been received.
   subroutine post(self, rank, tag, text)
      class(outbox_t), intent(inout), target :: self
      integer, intent(in) :: rank, tag
      character(len=*), intent(in) :: text
      type(letter_t), pointer :: letter

      self%place(rank) = modulo(self%place(rank), size(self%letters, 1)) + 1
      letter => self%letters(self%place(rank), rank)
      call mpi_wait(letter%request, mpi_status_ignore)
      letter%text = text
      call mpi_isend(letter%text, len(letter%text), mpi_character, rank, tag, self%comm, letter%request)
   end subroutine post

   !> Wait until all letters are received.
   subroutine wait_for_all(self)
      class(outbox_t), intent(inout) :: self
      integer :: i, rank
      do rank = lbound(self%letters, 2), ubound(self%letters, 2)
         do i = 1, size(self%letters, 1)
            call mpi_wait(self%letters(i, rank)%request, mpi_status_ignore)
         end do
      end do
   end subroutine wait_for_all

   !> Receive a case and plan it as rank 0 did. Fails when it does not come out the same, as where a file that it reads
   !> was changed since.
   subroutine receive_case(comm, number, case, plan, input, is_last, error)
      type(mpi_comm), intent(in) :: comm
      integer, intent(out) :: number
      type(case_t), intent(out) :: case
      type(case_plan_t), intent(out) :: plan
      character(len=:), allocatable, intent(out) :: input   !! its effective input
      logical, intent(out) :: is_last                       !! of an answer
      type(error_t), allocatable, intent(inout) :: error
      type(mpi_status) :: status
      character(len=:), allocatable :: text
      type(key_list_t), save :: keys
      integer :: changed, input_end, length

      call mpi_probe(0, tag_case, comm, status)
      call mpi_get_count(status, mpi_character, length)
      allocate (character(len=length) :: text)
      call mpi_recv(text, length, mpi_character, 0, tag_case, comm, mpi_status_ignore)
      read (text(:number_digits), *) number
      is_last = .true.
      if (number == no_case) return
      is_last = text(number_digits + 2:number_digits + 2) == 'F'
      input_end = index(text, new_line('a'), back=.true.)
      input = text(number_digits + marks + 1:input_end)
      call case_from_text(input, case, error)
      if (.not. allocated(error)) then
         call list_case_keys(case, keys)
         call make_plan(case, plan, error, keys=keys)
      end if
      case%fields = text(number_digits + 1:number_digits + 1) == 'T'
      if (allocated(error)) return
      changed = file_changed_since(plan%files, text(input_end + 1:))
      if (changed > 0) then
         call raise(error, plan%files(changed)%key//" = '"//plan%files(changed)%path// &
            "' was changed while the sweep was at work (--retry files runs cases once more that were stored with "// &
            'other numbers)')
      else if (input_text(keys) /= input) then
         call raise(error, 'case '//to_text(number)//' arrived with another input')
      end if
   end subroutine receive_case

   subroutine receive_outcome(comm, rank, outcome)
      type(mpi_comm), intent(in) :: comm
      integer, intent(in) :: rank
      type(outcome_t), intent(out) :: outcome
      character(len=storage_size(outcome)/8) :: text
      call mpi_recv(text, len(text), mpi_character, rank, tag_outcome, comm, mpi_status_ignore)
      outcome = transfer(text, outcome)
   end subroutine receive_outcome

end module ehlwave_messages
