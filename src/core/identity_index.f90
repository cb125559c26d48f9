!> Identities of texts, 16 hexadecimal digits each, and a list of them in which a place is found in constant time.
module ehlwave_identity_index
   use ehlwave_kinds, only: dp, i8
   implicit none (type, external)
   private
   public :: identity_index_t, numbers_identity, text_identity

   integer, parameter, public :: identity_length = 16

   !> Open addressing with linear probing; the table is doubled when it is half full. Identities are hashes
   !> already, so their own digits give the place.
   type :: identity_index_t
      integer :: count = 0                                            !! identities added
      character(len=identity_length), allocatable, private :: key(:)
      integer, allocatable, private :: place(:)                       ! 0: free
   contains
      procedure :: add
      procedure :: find
      procedure, private :: slot
   end type identity_index_t

contains

   !> Add an identity; `place` is its number in the order of adding, or the number it got before.
   subroutine add(self, identity, place)
      class(identity_index_t), intent(inout) :: self
      character(len=identity_length), intent(in) :: identity
      integer, intent(out) :: place
      type(identity_index_t) :: larger
      integer :: i

      if (.not. allocated(self%place)) then
         allocate (self%key(0:1023))
         allocate (self%place(0:1023), source=0)
      else if (2*self%count >= size(self%place)) then
         allocate (larger%key(0:2*size(self%key) - 1))
         allocate (larger%place(0:2*size(self%place) - 1), source=0)
         do i = 0, size(self%place) - 1
            if (self%place(i) == 0) cycle
            place = larger%slot(self%key(i))
            larger%key(place) = self%key(i)
            larger%place(place) = self%place(i)
         end do
         call move_alloc(larger%key, self%key)
         call move_alloc(larger%place, self%place)
      end if
      i = self%slot(identity)
      if (self%place(i) == 0) then
         self%count = self%count + 1
         self%key(i) = identity
         self%place(i) = self%count
      end if
      place = self%place(i)
   end subroutine add

   !> Number of an identity in the order of adding, 0 when it was not added.
   integer function find(self, identity)
      class(identity_index_t), intent(in) :: self
      character(len=identity_length), intent(in) :: identity
      find = 0
      if (allocated(self%place)) find = self%place(self%slot(identity))
   end function find

   !> Where an identity is, or the free place where it belongs.
   integer function slot(self, identity)
      class(identity_index_t), intent(in) :: self
      character(len=identity_length), intent(in) :: identity
      integer(i8) :: number
      integer :: i
      number = 0
      do i = 1, identity_length
         number = iand(number*33_i8 + iachar(identity(i:i)), int(z'FFFFFFFFFFFF', i8))
      end do
      slot = int(iand(number, int(size(self%place) - 1, i8)))
      do while (self%place(slot) /= 0)
         if (self%key(slot) == identity) return
         slot = iand(slot + 1, size(self%place) - 1)
      end do
   end function slot

   !> Identity of a text: 16 hexadecimal digits, its 64-bit FNV-1a hash.
   pure function text_identity(text) result(identity)
      character(len=*), intent(in) :: text
      character(len=identity_length) :: identity
      character(len=*), parameter :: hexadecimal = '0123456789ABCDEF'
      integer(i8) :: hash
      integer :: digit, i

      hash = -3750763034362895579_i8               ! 14695981039346656037 as a signed number
      do i = 1, len(text)
         hash = ieor(hash, int(iachar(text(i:i)), i8))
         hash = times_prime(hash)
      end do
      do i = 1, identity_length
         digit = int(ibits(hash, 64 - 4*i, 4)) + 1
         identity(i:i) = hexadecimal(digit:digit)
      end do
   end function text_identity

   !> hash * 1099511628211 modulo 2^64, without signed overflow: in halves of 32 bits. The prime is 2^40 + 435.
   pure integer(i8) function times_prime(hash)
      integer(i8), intent(in) :: hash
      integer(i8), parameter :: half = int(z'FFFFFFFF', i8), prime = 435
      integer(i8) :: low, high
      low = iand(hash, half)*prime
      high = ishft(hash, -32)*prime + ishft(low, -32) + ishft(iand(hash, int(z'FFFFFF', i8)), 8)
      times_prime = ior(ishft(high, 32), iand(low, half))
   end function times_prime

   !> Identity of numbers, from their bytes.
   pure function numbers_identity(numbers) result(identity)
      real(dp), intent(in) :: numbers(:)
      character(len=identity_length) :: identity
      character(len=:), allocatable :: bytes
      allocate (character(len=8*size(numbers)) :: bytes)
      bytes = transfer(numbers, bytes)
      identity = text_identity(bytes)
   end function numbers_identity

end module ehlwave_identity_index
