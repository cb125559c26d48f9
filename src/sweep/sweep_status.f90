!> The state of a store, printed without the sweep file and without disturbing a job at work.
module ehlwave_sweep_status
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ehlwave_case_list, only: case_list_t
   use ehlwave_case_text, only: input_identity
   use ehlwave_cost_model, only: cost_model_t, fit_cost_model
   use ehlwave_errors, only: error_t, raise
   use ehlwave_json_reader, only: json_number, json_string
   use ehlwave_kinds, only: dp
   use ehlwave_posix, only: is_locked
   use ehlwave_status, only: is_success, last_status, status_name
   use ehlwave_store_folder, only: check_store, refuse_lost_records
   use ehlwave_store_names, only: cases_name, lock_name, store_path
   use ehlwave_store_contents, only: contents_t, read_store
   use ehlwave_sweep_progress, only: counted, duration
   use ehlwave_terminal, only: say
   use ehlwave_text, only: number_of, to_text
   implicit none (type, external)
   private
   public :: print_status

   integer, parameter :: slowest_shown = 5, failed_shown = 20

contains

   !> Print the content of the store of a results file. `is_finished`: no case is left to run; `failed`: number of
   !> finished cases that did not converge. Fails when there is no store or it cannot be understood.
   subroutine print_status(unit, path, is_finished, failed, error)
      integer, intent(in) :: unit
      character(len=*), intent(in) :: path       !! results file or store
      logical, intent(out) :: is_finished
      integer, intent(out) :: failed
      type(error_t), allocatable, intent(out) :: error
      type(contents_t) :: contents
      type(case_list_t) :: list
      integer, allocatable :: place(:)           ! place of each case in the contents, 0: absent
      character(len=:), allocatable :: folder
      integer, allocatable :: found(:)
      integer :: i, n, status
      logical :: is_there, is_working

      is_finished = .false.
      failed = 0
      folder = store_path(path)
      call check_store(folder, is_there, error)
      if (.not. (is_there .or. allocated(error))) &
         call raise(error, 'there is no store '//folder//': give the results file of a sweep, or its store')
      if (allocated(error)) return
      is_working = is_locked(folder//'/'//lock_name)
      call read_store(folder, input_identity, contents, error)
      call refuse_lost_records(folder, error)
      call list%read(folder, error)
      if (allocated(error)) return
      ! another job wrote one meanwhile
      if (is_locked(folder//'/'//lock_name)) contents%list_checksum = ''
      if (contents%list_checksum /= '' .and. contents%list_checksum /= list%checksum) call raise(error, folder//'/'// &
         cases_name//' is not whole: the sweep, started again, writes it anew')
      if (allocated(error)) return

      n = size(list%identity)
      place = [(contents%index%find(list%identity(i)), i=1, n)]
      found = pack(place, place > 0)
      is_finished = size(found) == n
      failed = count(.not. is_success(contents%cases(found)%status))
      call say(unit, 'Store        '//folder//', '//trim(merge('a job is at work ', 'no job is at work', is_working)))
      call say(unit, 'Cases        '//to_text(n)//': '//to_text(size(found))//' finished, '// &
         to_text(n - size(found))//' left')
      do status = 0, last_status
         if (any(contents%cases(found)%status == status)) &
            call say(unit, counted(count(contents%cases(found)%status == status), 16, status_name(status)))
      end do
      if (is_working) call say(unit, 'Under way    '//number_of(count(contents%logs%run == contents%runs .and. &
         contents%logs%in_flight /= ''), 'case')//' on '//number_of(count(contents%logs%run == contents%runs), 'rank'))
      if (contents%count > size(found)) call say(unit, 'Not listed   '//number_of(contents%count - size(found), &
         'finished case')//' that the sweep file no longer lists')
      if (contents%bad_lines > 0) call say(unit, 'Damaged      '//number_of(contents%bad_lines, 'record')// &
         ' cut off; counted as not written')
      call print_times(unit, contents, list, place, found)
      associate (variation => pack(list%variation, place > 0))
         call print_slowest(unit, contents, found, variation)
         call print_failed(unit, contents, found, variation)
      end associate
   end subroutine print_status

   !> Time so far and time left.
   subroutine print_times(unit, contents, list, place, found)
      integer, intent(in) :: unit
      type(contents_t), intent(in) :: contents
      type(case_list_t), intent(in) :: list
      integer, intent(in) :: place(:)            !! place of each case in the contents, 0: absent
      integer, intent(in) :: found(:)
      type(cost_model_t) :: model
      real(dp) :: left, seconds(size(place))
      integer :: i, ranks

      seconds = 0
      do i = 1, size(place)
         if (place(i) > 0) seconds(i) = contents%cases(place(i))%seconds
      end do
      call say(unit, 'Time         '//duration(sum(contents%cases(found)%seconds))//' of computing in '// &
         number_of(contents%runs, 'run')//' of the program')
      if (size(found) == size(place)) return
      model = fit_cost_model(list%features, seconds)
      left = 0
      do i = 1, size(place)
         if (place(i) == 0) left = left + model%seconds(list%features(:, i))
      end do
      ranks = max(1, count(contents%logs%run == contents%runs))
      if (model%is_fitted) then
         call say(unit, 'Time left    '//duration(left/ranks)//' on '// &
            number_of(ranks, 'rank')//', '//duration(left)// &
            ' of computing')
      else
         call say(unit, 'Time left    unknown until a case is finished')
      end if
   end subroutine print_times

   subroutine print_slowest(unit, contents, found, variation)
      integer, intent(in) :: unit
      type(contents_t), intent(in) :: contents
      integer, intent(in) :: found(:)
      character(len=*), intent(in) :: variation(:)   !! variations of the cases found
      logical :: is_shown(size(found))
      integer :: k, place

      is_shown = .false.
      do k = 1, min(slowest_shown, size(found))
         place = maxloc(contents%cases(found)%seconds, 1, mask=.not. is_shown)
         is_shown(place) = .true.
         call say(unit, merge('Slowest      ', '             ', k == 1)// &
            one_case(contents, found(place), variation(place))//', '//to_text(contents%cases(found(place))%seconds, &
            4)//' s')
      end do
   end subroutine print_slowest

   subroutine print_failed(unit, contents, found, variation)
      integer, intent(in) :: unit
      type(contents_t), intent(in) :: contents
      integer, intent(in) :: found(:)
      character(len=*), intent(in) :: variation(:)   !! variations of the cases found
      integer :: i, shown

      shown = 0
      do i = 1, size(found)
         associate (record => contents%cases(found(i)))
            if (is_success(record%status)) cycle
            shown = shown + 1
            if (shown > failed_shown) cycle
            call say(unit, merge('Failed       ', '             ', shown == 1)// &
               one_case(contents, found(i), variation(i))//', '//status_name(record%status)//': '// &
               json_string(contents%value(found(i), 'message')))
         end associate
      end do
      if (shown > failed_shown) call say(unit, '             and '//to_text(shown - failed_shown)//' more')
   end subroutine print_failed

   !> Identity, conditions and varying keys of a case.
   function one_case(contents, place, variation) result(text)
      type(contents_t), intent(in) :: contents
      integer, intent(in) :: place
      character(len=*), intent(in) :: variation
      character(len=:), allocatable :: text
      text = contents%cases(place)%identity//' (M = '//contents%value(place, 'load_parameter_m')//', L = '// &
             contents%value(place, 'lubricant_parameter_l')//', D = '//contents%value(place, 'radius_ratio_d')// &
             ', '//json_string(contents%value(place, 'orientation'))
      if (wavelength(contents, place) > 0) text = text//', lambda/a = '//to_text(wavelength(contents, place), 4)
      if (variation /= '') text = text//', '//trim(variation)
      text = text//')'
   end function one_case

   !> The shorter wavelength of a case over a, 0 where there is none.
   real(dp) function wavelength(contents, place)
      type(contents_t), intent(in) :: contents
      integer, intent(in) :: place
      real(dp) :: x, y
      x = json_number(contents%value(place, 'wavelength_x_over_a'))
      y = json_number(contents%value(place, 'wavelength_y_over_a'))
      if (.not. ieee_is_finite(x)) x = 0
      if (.not. ieee_is_finite(y)) y = 0
      wavelength = min(x, y)
      if (wavelength <= 0) wavelength = max(x, y)
   end function wavelength

end module ehlwave_sweep_status
