!> Proves the sequential MUMPS: factorizes a saddle point system with the settings the program
!> uses, compares the solution with 1, 2, 3 and the negative pivots with the one constraint.
program probe_mumps
  use, intrinsic :: iso_fortran_env, only: real64
  implicit none
  include "dmumps_struc.h"

  interface
    subroutine dmumps(id)
      import :: dmumps_struc
      implicit none
      type(dmumps_struc), intent(inout) :: id
    end subroutine dmumps
  end interface

  type(dmumps_struc) :: id
  real(real64), parameter :: solution(3) = [1.0_real64, 2.0_real64, 3.0_real64]

  id%comm = 0
  id%par = 1
  id%sym = 2
  call job(-1)
  id%icntl(1:4) = [0, 0, 0, 0]
  id%icntl(7) = 2
  id%icntl(24) = 1
  id%n = 3
  id%nnz = 5
  allocate (id%irn(5), id%jcn(5), id%a(5), id%rhs(3))
  id%irn = [1, 2, 2, 3, 3]
  id%jcn = [1, 1, 2, 1, 2]
  id%a = [2.0_real64, 1.0_real64, 3.0_real64, 1.0_real64, 1.0_real64]
  id%rhs = [7.0_real64, 10.0_real64, 3.0_real64]
  call job(6)
  if (maxval(abs(id%rhs - solution)) > 1.0e-13_real64) error stop "dmumps: wrong solution"
  if (id%infog(12) /= 1) error stop "dmumps: wrong number of negative pivots"
  deallocate (id%irn, id%jcn, id%a, id%rhs)
  nullify (id%irn, id%jcn, id%a, id%rhs)
  call job(-2)

contains

  subroutine job(number)
    integer, intent(in) :: number

    id%job = number
    call dmumps(id)
    if (id%infog(1) < 0) error stop "dmumps: infog(1) is negative"
  end subroutine job

end program probe_mumps
