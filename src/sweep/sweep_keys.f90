!> The keys of &sweep that are about the sweep itself; every key of a case that can vary is a list there, too.
module ehlwave_sweep_keys
   use ehlwave_case_definition, only: path_length
   use ehlwave_case_key, only: choice_length, key_t, key_value_t, number_kind
   use ehlwave_key_list, only: key_list_t
   use ehlwave_key_reference, only: case_key_reference, key_reference
   use ehlwave_kinds, only: dp
   use ehlwave_sweep_cases, only: case_limits_t
   implicit none (type, external)
   private
   public :: sweep_key_reference, visit_sweep_keys

   character(len=*), parameter, public :: sweep_group = 'sweep'

   type, public :: sweep_settings_t
      character(len=path_length) :: case_file = ''
      character(len=path_length) :: output = 'results.h5'
      character(len=choice_length) :: unresolved = 'run'
      type(case_limits_t) :: limits
   end type sweep_settings_t

   !> A list or column that determines wavelengths.
   type(key_t), parameter, public :: f_v_key = key_t(name='f_v', help='f(r) V; a list in place of wavelengths', &
      above=0.0_dp, default='none', kind=number_kind, group=sweep_group)

contains

   !> The table of these keys, see `key_list`.
   subroutine visit_sweep_keys(settings, list)
      type(sweep_settings_t), intent(inout) :: settings
      type(key_list_t), intent(inout) :: list

      call list%begin()
      call list%enter(sweep_group, 'Sweep files only: lists of any of the keys above, in place of the value in '// &
         'its group, and the keys below. The other groups hold the common values of all cases.')
      call list%see(settings%case_file, key_t('case_file', 'CSV file of cases in place of lists; its columns are '// &
         'named as the keys above, or f_v', maximum=real(path_length, dp)))
      call list%see(settings%output, key_t('output', 'results file; its name ends in .h5', &
         maximum=real(path_length, dp)))
      call list%see(settings%unresolved, key_t('unresolved', "cases that their grid does not resolve; 'skip' "// &
         "leaves them out", choices='run skip'))
      call list%see(settings%limits%largest_case_seconds, &
         key_t('largest_case_seconds', 'wall time after which a case is given '// &
         'up as over_budget; steps are limited by largest_steps', unit='s', above=0.0_dp))
      call list%see(settings%limits%checkpoint_seconds, key_t('checkpoint_seconds', 'wall time between two '// &
         'checkpoints of a time march', unit='s', minimum=0.0_dp))
   end subroutine visit_sweep_keys

   !> Reference of all keys of a sweep file: keys of a case, then its own.
   function sweep_key_reference(is_markdown) result(text)
      logical, intent(in) :: is_markdown
      character(len=:), allocatable :: text
      type(key_list_t) :: list
      type(sweep_settings_t) :: settings

      call visit_sweep_keys(settings, list)
      call list%add(f_v_key, key_value_t(kind=number_kind))
      text = case_key_reference(is_markdown)//new_line('a')//key_reference(list, is_markdown)
   end function sweep_key_reference

end module ehlwave_sweep_keys
