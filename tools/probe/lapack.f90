!> Proves LAPACK: factorizes and solves an indefinite symmetric system whose solution is 1, 2, 3.
program probe_lapack
  use, intrinsic :: iso_fortran_env, only: real64
  implicit none

  interface
    subroutine dsysv(uplo, n, nrhs, a, lda, ipiv, b, ldb, work, lwork, info)
      import :: real64
      implicit none
      character(len=1), intent(in) :: uplo
      integer, intent(in) :: n, nrhs, lda, ldb, lwork
      real(real64), intent(inout) :: a(lda, n), b(ldb, nrhs), work(lwork)
      integer, intent(out) :: ipiv(n), info
    end subroutine dsysv
  end interface

  real(real64) :: a(3, 3), b(3, 1), work(64)
  real(real64), parameter :: solution(3) = [1.0_real64, 2.0_real64, 3.0_real64]
  integer :: pivots(3), info

  a = reshape([2.0_real64, 1.0_real64, 1.0_real64, &
               1.0_real64, 3.0_real64, 1.0_real64, &
               1.0_real64, 1.0_real64, 0.0_real64], [3, 3])
  b(:, 1) = matmul(a, solution)
  call dsysv("L", 3, 1, a, 3, pivots, b, 3, work, size(work), info)
  if (info /= 0) error stop "dsysv: info is not zero"
  if (maxval(abs(b(:, 1) - solution)) > 1.0e-13_real64) error stop "dsysv: wrong solution"
end program probe_lapack
