!> Number kinds used everywhere.
module ehlwave_kinds
   use, intrinsic :: iso_fortran_env, only: int64, real32, real64
   implicit none (type, external)
   private
   integer, parameter, public :: dp = real64   !! working precision
   integer, parameter, public :: sp = real32   !! kind of work that only preconditions
   integer, parameter, public :: i8 = int64    !! long counters, clock ticks
   real(dp), parameter, public :: pi = acos(-1.0_dp)
   !> NaN: not known, not there
   real(dp), parameter, public :: no_value = transfer(int(z'7FF8000000000000', i8), 1.0_dp)
end module ehlwave_kinds
