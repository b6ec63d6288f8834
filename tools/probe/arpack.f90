!> Proves ARPACK: the three largest eigenvalues of the second difference matrix of 40 points,
!> 2 - 2 cos(k pi / 41), by dsaupd and dseupd.
program probe_arpack
  use, intrinsic :: iso_fortran_env, only: real64
  implicit none

  interface
    subroutine dsaupd(ido, bmat, n, which, nev, tol, resid, ncv, v, ldv, iparam, ipntr, &
                      workd, workl, lworkl, info)
      import :: real64
      implicit none
      integer, intent(inout) :: ido, iparam(11), ipntr(11), info
      integer, intent(in) :: n, nev, ncv, ldv, lworkl
      character(len=1), intent(in) :: bmat
      character(len=2), intent(in) :: which
      real(real64), intent(in) :: tol
      real(real64), intent(inout) :: resid(n), v(ldv, ncv), workd(3*n), workl(lworkl)
    end subroutine dsaupd
    subroutine dseupd(rvec, howmny, select, d, z, ldz, sigma, bmat, n, which, nev, tol, resid, &
                      ncv, v, ldv, iparam, ipntr, workd, workl, lworkl, info)
      import :: real64
      implicit none
      logical, intent(in) :: rvec
      integer, intent(in) :: ldz, n, nev, ncv, ldv, lworkl
      character(len=1), intent(in) :: howmny, bmat
      character(len=2), intent(in) :: which
      logical, intent(inout) :: select(ncv)
      real(real64), intent(in) :: sigma, tol
      real(real64), intent(inout) :: d(nev), z(ldz, nev), resid(n), v(ldv, ncv), workd(2*n), &
                                     workl(lworkl)
      integer, intent(inout) :: iparam(7), ipntr(11), info
    end subroutine dseupd
  end interface

  integer, parameter :: n = 40, wanted = 3, ncv = 20, lworkl = ncv*(ncv + 8)
  real(real64), parameter :: pi = acos(-1.0_real64), tolerance = 1.0e-10_real64
  real(real64) :: resid(n), v(n, ncv), workd(3*n), workl(lworkl), values(wanted), vectors(n, wanted)
  real(real64) :: exact
  integer :: ido, iparam(11), ipntr(11), info, i
  logical :: chosen(ncv)

  ido = 0
  info = 1
  resid = [(1.0_real64/i, i=1, n)]
  iparam = 0
  iparam([1, 3, 7]) = [1, 300, 1]
  do
    call dsaupd(ido, "I", n, "LA", wanted, 1.0e-12_real64, resid, ncv, v, n, iparam, ipntr, &
                workd, workl, lworkl, info)
    if (abs(ido) /= 1) exit
    workd(ipntr(2):ipntr(2) + n - 1) = second_difference(workd(ipntr(1):ipntr(1) + n - 1))
  end do
  if (info /= 0) error stop "dsaupd: info is not zero"
  call dseupd(.true., "A", chosen, values, vectors, n, 0.0_real64, "I", n, "LA", wanted, &
              1.0e-12_real64, resid, ncv, v, n, iparam, ipntr, workd, workl, lworkl, info)
  if (info /= 0) error stop "dseupd: info is not zero"
  do i = 1, wanted
    exact = 2.0_real64 - 2.0_real64*cos((n - wanted + i)*pi/(n + 1))
    if (abs(values(i) - exact) > tolerance) error stop "dseupd: wrong eigenvalue"
  end do

contains

  pure function second_difference(x) result(y)
    real(real64), intent(in) :: x(n)
    real(real64) :: y(n)

    y = 2.0_real64*x
    y(2:) = y(2:) - x(:n - 1)
    y(:n - 1) = y(:n - 1) - x(2:)
  end function second_difference

end program probe_arpack
