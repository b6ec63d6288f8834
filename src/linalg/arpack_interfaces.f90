!> Explicit interfaces of the ARPACK routines in use; arguments as in ARPACK's documentation.
module arpack_interfaces
  use kinds, only: wp
  implicit none
  private

  public :: dsaupd, dseupd, dnaupd, dneupd

  interface
    !> Implicitly restarted Lanczos by reverse communication.
    subroutine dsaupd(ido, bmat, n, which, nev, tol, resid, ncv, v, ldv, iparam, ipntr, workd, &
                      workl, lworkl, info)
      import :: wp
      implicit none
      integer, intent(inout) :: ido, info
      character(len=1), intent(in) :: bmat
      character(len=2), intent(in) :: which
      integer, intent(in) :: n, nev, ncv, ldv, lworkl
      real(wp), intent(in) :: tol
      real(wp), intent(inout) :: resid(n), v(ldv, ncv), workd(3*n), workl(lworkl)
      integer, intent(inout) :: iparam(11), ipntr(11)
    end subroutine dsaupd

    !> Eigenvalues and vectors after `dsaupd`.
    subroutine dseupd(rvec, howmny, select, d, z, ldz, sigma, bmat, n, which, nev, tol, resid, &
                      ncv, v, ldv, iparam, ipntr, workd, workl, lworkl, info)
      import :: wp
      implicit none
      logical, intent(in) :: rvec
      character(len=1), intent(in) :: howmny, bmat
      character(len=2), intent(in) :: which
      integer, intent(in) :: ldz, n, nev, ncv, ldv, lworkl
      logical, intent(inout) :: select(ncv)
      real(wp), intent(inout) :: d(nev), z(ldz, nev)
      real(wp), intent(in) :: sigma, tol
      real(wp), intent(inout) :: resid(n), v(ldv, ncv), workd(3*n), workl(lworkl)
      integer, intent(inout) :: iparam(11), ipntr(11), info
    end subroutine dseupd

    !> Implicitly restarted Arnoldi by reverse communication.
    subroutine dnaupd(ido, bmat, n, which, nev, tol, resid, ncv, v, ldv, iparam, ipntr, workd, &
                      workl, lworkl, info)
      import :: wp
      implicit none
      integer, intent(inout) :: ido, info
      character(len=1), intent(in) :: bmat
      character(len=2), intent(in) :: which
      integer, intent(in) :: n, nev, ncv, ldv, lworkl
      real(wp), intent(in) :: tol
      real(wp), intent(inout) :: resid(n), v(ldv, ncv), workd(3*n), workl(lworkl)
      integer, intent(inout) :: iparam(11), ipntr(14)
    end subroutine dnaupd

    !> Eigenvalues and vectors after `dnaupd`.
    subroutine dneupd(rvec, howmny, select, dr, di, z, ldz, sigmar, sigmai, workev, bmat, n, &
                      which, nev, tol, resid, ncv, v, ldv, iparam, ipntr, workd, workl, lworkl, &
                      info)
      import :: wp
      implicit none
      logical, intent(in) :: rvec
      character(len=1), intent(in) :: howmny, bmat
      character(len=2), intent(in) :: which
      integer, intent(in) :: ldz, n, ncv, ldv, lworkl
      integer, intent(inout) :: nev
      logical, intent(inout) :: select(ncv)
      real(wp), intent(inout) :: dr(nev + 1), di(nev + 1), z(ldz, nev + 1)
      real(wp), intent(in) :: sigmar, sigmai, tol
      real(wp), intent(inout) :: workev(3*ncv)
      real(wp), intent(inout) :: resid(n), v(ldv, ncv), workd(3*n), workl(lworkl)
      integer, intent(inout) :: iparam(11), ipntr(14), info
    end subroutine dneupd
  end interface

end module arpack_interfaces
