!> Tridiagonal systems.
module linalg_tridiagonal
  use kinds, only: wp
  use errors, only: error_t, fail, exit_solve
  use text, only: to_text
  use lapack_interfaces, only: dgtsv
  implicit none
  private

  public :: solve_tridiagonal

contains

  !> Overwrite x (n) with the solution of A x' = x; lower and upper diagonal (n - 1), diagonal (n).
  subroutine solve_tridiagonal(lower, diagonal, upper, x, error)
    real(wp), intent(in) :: lower(:), diagonal(:), upper(:)
    real(wp), intent(inout), contiguous :: x(:)
    type(error_t), allocatable, intent(out) :: error
    real(wp) :: l(size(lower)), d(size(x)), u(size(upper)), b(size(x), 1)
    integer :: info

    l = lower
    d = diagonal
    u = upper
    b(:, 1) = x
    call dgtsv(size(x), 1, l, d, u, b, max(1, size(x)), info)
    if (info /= 0) call fail(error, exit_solve, "dgtsv: info = "//to_text(info))
    x = b(:, 1)
  end subroutine solve_tridiagonal

end module linalg_tridiagonal
