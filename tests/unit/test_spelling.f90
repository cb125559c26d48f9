!> Edit distance and the nearest of several words.
program test_spelling
   use ehlwave_spelling, only: edit_distance, nearest_word
   use testing, only: test_t
   implicit none (type, external)

   type(test_t) :: test

   call measure_distance()
   call find_nearest()
   call test%finish()

contains

   subroutine measure_distance()
      call test%check_equal(edit_distance('kitten', 'sitting  '), 3, 'replace and insert')
      call test%check_equal(edit_distance('load', 'laod'), 1, 'swap')
      call test%check_equal(edit_distance('abcd', 'bd'), 2, 'remove')
      call test%check_equal(edit_distance('abxy', 'bcxy'), 2, 'half a swap is none')
      call test%check_equal(edit_distance('', 'abc'), 3, 'from nothing')
      call test%check_equal(edit_distance('abc', ''), 3, 'to nothing')
   end subroutine measure_distance

   subroutine find_nearest()
      call test%check_equal(nearest_word('p', ['h', 'q']), 0, 'single letters are never near')
      call test%check_equal(nearest_word('amplitud', ['amplitude', 'altitude ']), 1, 'nearest of two')
      call test%check_equal(nearest_word('loxd', ['none', 'load', 'lord']), 2, 'first of two that are equally near')
      call test%check_equal(nearest_word('viscosity', ['velocity ', 'roughness']), 0, 'none near')
   end subroutine find_nearest

end program test_spelling
