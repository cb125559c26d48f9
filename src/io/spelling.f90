!> Nearest known word, for 'did you mean' messages.
module ehlwave_spelling
   implicit none (type, external)
   private
   public :: edit_distance, nearest_word

contains

   !> Number of single-letter insertions, deletions, replacements and swaps of neighbours that turn
   !> `a` into `b` (optimal string alignment); trailing blanks do not count.
   pure function edit_distance(a, b) result(distance)
      character(len=*), intent(in) :: a, b
      integer :: distance
      integer :: d(-1:len_trim(a), -1:len_trim(b))   ! row and column -1 are never read
      integer :: i, j, cost

      do i = 0, len_trim(a)
         d(i, 0) = i
      end do
      do j = 1, len_trim(b)
         d(0, j) = j
         do i = 1, len_trim(a)
            cost = merge(0, 1, a(i:i) == b(j:j))
            d(i, j) = min(d(i - 1, j) + 1, d(i, j - 1) + 1, d(i - 1, j - 1) + cost)
            if (i > 1 .and. j > 1) then
               if (a(i:i) == b(j - 1:j - 1) .and. a(i - 1:i - 1) == b(j:j)) d(i, j) = min(d(i, j), d(i - 2, j - 2) + 1)
            end if
         end do
      end do
      distance = d(len_trim(a), len_trim(b))
   end function edit_distance

   !> Index of the candidate nearest_word to `word`, or 0 when none differs by a third of its letters or less.
   pure function nearest_word(word, candidates) result(best)
      character(len=*), intent(in) :: word
      character(len=*), intent(in) :: candidates(:)
      integer :: best
      integer :: i, letters, distance, shortest

      best = 0
      shortest = huge(shortest)
      do i = 1, size(candidates)
         letters = max(len_trim(word), len_trim(candidates(i)))
         if (abs(len_trim(word) - len_trim(candidates(i))) > max(1, letters/3)) cycle
         distance = edit_distance(word, candidates(i))
         if (distance > max(1, letters/3) .or. distance >= letters) cycle
         if (distance < shortest) then
            shortest = distance
            best = i
         end if
      end do
   end function nearest_word

end module ehlwave_spelling
