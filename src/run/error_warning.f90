!> Warning of results whose estimated error is large: a rule over the whole table of quantities.
module ehlwave_error_warning
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ehlwave_kinds, only: dp
   use ehlwave_quantity, only: quantity_list_t
   use ehlwave_text, only: to_text
   implicit none (type, external)
   private
   public :: error_warning

   real(dp), parameter, public :: largest_error = 0.3_dp   !! relative, that passes without a warning

contains

   !> Results with an error above `largest_error`, each once with the largest of its errors; '' where there is none.
   function error_warning(list) result(text)
      type(quantity_list_t), intent(in) :: list
      character(len=:), allocatable :: text
      integer :: k

      text = ''
      do k = 1, list%count
         if (.not. is_worst(list, k)) cycle
         if (text /= '') text = text//', '
         associate (item => list%items(k))
            text = text//item%error_of//' '//to_text(100*item%number, merge(2, 3, item%number < 1))//' %'
         end associate
      end do
      if (text /= '') text = 'large errors: '//text//'; use more cells (&grid) or an accuracy (&solver)'
   end function error_warning

   !> Whether an entry is the largest error of its result, the first among equals, and large.
   pure logical function is_worst(list, k)
      type(quantity_list_t), intent(in) :: list
      integer, intent(in) :: k
      integer :: l

      is_worst = .false.
      if (.not. is_error(list, k)) return
      if (list%items(k)%number <= largest_error) return
      do l = 1, list%count
         if (l == k .or. .not. is_error(list, l)) cycle
         if (list%items(l)%error_of /= list%items(k)%error_of) cycle
         if (list%items(l)%number > list%items(k)%number) return
         if (l < k .and. list%items(l)%number >= list%items(k)%number) return
      end do
      is_worst = .true.
   end function is_worst

   !> Whether an entry is an error that is known.
   pure logical function is_error(list, k)
      type(quantity_list_t), intent(in) :: list
      integer, intent(in) :: k
      associate (item => list%items(k))
         is_error = allocated(item%error_of) .and. item%exists
         if (is_error) is_error = ieee_is_finite(item%number)
      end associate
   end function is_error

end module ehlwave_error_warning
