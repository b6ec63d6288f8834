!> Proves the compiler: allocatable characters, polymorphic move_alloc, a Fortran 2008 intrinsic.
program probe_compiler
  use, intrinsic :: iso_fortran_env, only: real64
  implicit none

  type :: base_t
    character(len=:), allocatable :: name
  end type base_t
  class(base_t), allocatable :: source, target
  real(real64), parameter :: tolerance = 1.0e-15_real64

  allocate (source)
  source%name = "probe"
  call move_alloc(source, target)
  if (allocated(source) .or. target%name /= "probe") error stop "move_alloc"
  if (abs(norm2([3.0_real64, 4.0_real64]) - 5.0_real64) > tolerance) error stop "norm2"
end program probe_compiler
