!> Working precision. Every real in the program is `real(wp)`, but for fields that are only looked
!> at.
module kinds
  use, intrinsic :: iso_fortran_env, only: real64, real32, int64
  implicit none
  private

  integer, parameter, public :: wp = real64    !< kind of every real
  integer, parameter, public :: sp = real32    !< kind of fields of drawings
  integer, parameter, public :: i8 = int64     !< kind of clocks and of large counts

end module kinds
