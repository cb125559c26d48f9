!> Fields of a march over time, at a fixed number of steps.
module ehlwave_field_history
   use ehlwave_hierarchy, only: level_t
   use ehlwave_kinds, only: dp
   use ehlwave_march_watcher, only: march_watcher_t
   use ehlwave_shear_stress, only: mean_shear_stress
   implicit none (type, external)
   private

   type, extends(march_watcher_t), public :: field_history_t
      integer :: count = 0                               !! sets of fields that are kept
      real(dp), allocatable :: time(:)                   !! T of each
      real(dp), allocatable :: p(:, :, :), h(:, :, :)    !! (0:nx, 0:ny, sets)
      real(dp), allocatable :: shear_stress_pa(:, :, :)  !! as of `mean_shear_stress`; unallocated where that is not
                                                         !! known
      integer, private :: every = 0                      ! steps between sets
   contains
      procedure :: begin
      procedure :: see
      procedure :: finish
   end type field_history_t

contains

   !> Allocate the fields of a march of so many steps.
   subroutine begin(self, level, every, steps)
      class(field_history_t), intent(inout) :: self
      type(level_t), intent(in) :: level            !! level of the march
      integer, intent(in) :: every, steps           !! above 0
      integer :: sets

      sets = steps/every + 1
      self%count = 0
      self%every = every
      allocate (self%time(sets))
      associate (grid => level%problem%grid)
         allocate (self%p(0:grid%nx, 0:grid%ny, sets), self%h(0:grid%nx, 0:grid%ny, sets))
      end associate
   end subroutine begin

   !> Keep the fields of a step that is due.
   subroutine see(self, level, step, time)
      class(field_history_t), intent(inout) :: self
      type(level_t), intent(in) :: level
      integer, intent(in) :: step
      real(dp), intent(in) :: time
      real(dp), allocatable :: stress_pa(:, :)

      if (self%every <= 0) return
      if (modulo(step, self%every) /= 0) return
      self%count = self%count + 1
      self%time(self%count) = time
      self%p(:, :, self%count) = level%state%p
      self%h(:, :, self%count) = level%state%h
      call mean_shear_stress(level%problem, level%state, stress_pa)
      if (.not. allocated(stress_pa)) return
      if (.not. allocated(self%shear_stress_pa)) allocate (self%shear_stress_pa, mold=self%p)
      self%shear_stress_pa(:, :, self%count) = stress_pa
   end subroutine see

   !> Give back the room of steps that were not reached.
   subroutine finish(self)
      class(field_history_t), intent(inout) :: self

      if (self%every <= 0) return
      if (self%count == size(self%time)) return
      self%time = self%time(:self%count)
      self%p = self%p(:, :, :self%count)
      self%h = self%h(:, :, :self%count)
      if (allocated(self%shear_stress_pa)) self%shear_stress_pa = self%shear_stress_pa(:, :, :self%count)
   end subroutine finish

end module ehlwave_field_history
