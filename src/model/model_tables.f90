!> Values between the points of a table: straight lines, or a cubic spline.
module model_tables
  use kinds, only: wp
  use errors, only: error_t
  use linalg_tridiagonal, only: solve_tridiagonal
  implicit none
  private

  public :: table_row, table_value, table_slope, spline_curvatures, spline_jet

contains

  !> Linear between the rows' pairs, constant outside; at a jump the value behind it.
  pure function table_value(table, s) result(value)
    real(wp), intent(in) :: table(:, :)  !< 2 x n: abscissas, not falling, and values
    real(wp), intent(in) :: s
    real(wp) :: value
    integer :: low

    low = table_row(table, s)
    if (low == 0) then
      value = table(2, 1)
    else if (low == size(table, 2)) then
      value = table(2, low)
    else
      value = table(2, low) + (table(2, low + 1) - table(2, low)) &
              *(s - table(1, low))/(table(1, low + 1) - table(1, low))
    end if
  end function table_value

  !> Slope to the right of s.
  pure function table_slope(table, s) result(slope)
    real(wp), intent(in) :: table(:, :)  !< as for `table_value`
    real(wp), intent(in) :: s
    real(wp) :: slope
    integer :: low

    low = table_row(table, s)
    slope = 0
    if (low == 0 .or. low == size(table, 2)) return
    slope = (table(2, low + 1) - table(2, low))/(table(1, low + 1) - table(1, low))
  end function table_slope

  !> The last pair at or before s; 0: none.
  pure integer function table_row(table, s) result(low)
    real(wp), intent(in) :: table(:, :)
    real(wp), intent(in) :: s
    integer :: high, middle

    low = 0
    high = size(table, 2) + 1
    do while (high - low > 1)
      middle = (low + high)/2
      if (table(1, middle) <= s) then
        low = middle
      else
        high = middle
      end if
    end do
  end function table_row

  !> Second derivatives at the points of a cubic spline whose third derivative does not jump at the
  !> second and last but one point ("not a knot"): of three points a parabola, of two a line.
  subroutine spline_curvatures(s, v, curvature, error)
    real(wp), intent(in) :: s(:), v(:)          !< abscissas, rising, and values
    real(wp), intent(out) :: curvature(:)
    type(error_t), allocatable, intent(out) :: error
    real(wp), dimension(size(s) - 1) :: h, slope
    real(wp), dimension(size(s) - 2) :: diagonal, lower, upper
    integer :: n

    n = size(s)
    h = s(2:) - s(:n - 1)
    slope = (v(2:) - v(:n - 1))/h
    curvature = 0
    if (n == 2) return
    if (n == 3) then
      curvature = 2*(slope(2) - slope(1))/(h(1) + h(2))
      return
    end if
    diagonal = 2*(h(:n - 2) + h(2:))
    lower = h(:n - 2)
    upper = h(2:)
    diagonal(1) = diagonal(1) + h(1)*(1 + h(1)/h(2))
    upper(1) = h(2) - h(1)**2/h(2)
    diagonal(n - 2) = diagonal(n - 2) + h(n - 1)*(1 + h(n - 1)/h(n - 2))
    lower(n - 2) = h(n - 2) - h(n - 1)**2/h(n - 2)
    curvature(2:n - 1) = 6*(slope(2:) - slope(:n - 2))
    call solve_tridiagonal(lower(2:), diagonal, upper(:n - 3), curvature(2:n - 1), error)
    curvature(1) = curvature(2) + (curvature(2) - curvature(3))*h(1)/h(2)
    curvature(n) = curvature(n - 1) + (curvature(n - 1) - curvature(n - 2))*h(n - 1)/h(n - 2)
  end subroutine spline_curvatures

  !> Value, slope and curvature; constant outside, at the ends what is to the right.
  pure subroutine spline_jet(table, s, jet)
    real(wp), intent(in) :: table(:, :)  !< 3 x n: abscissas, values, second derivatives
    real(wp), intent(in) :: s
    real(wp), intent(out) :: jet(0:2)
    real(wp) :: h, a, b
    integer :: low

    jet = 0
    low = table_row(table, s)
    if (low == 0 .or. low == size(table, 2)) then
      jet(0) = table(2, max(1, low))
      return
    end if
    associate (p => table(:, low), q => table(:, low + 1))
      h = q(1) - p(1)
      b = (s - p(1))/h
      a = 1 - b
      jet(0) = a*p(2) + b*q(2) + h**2/6*((a**3 - a)*p(3) + (b**3 - b)*q(3))
      jet(1) = (q(2) - p(2))/h + h/6*((3*b**2 - 1)*q(3) - (3*a**2 - 1)*p(3))
      jet(2) = a*p(3) + b*q(3)
    end associate
  end subroutine spline_jet

end module model_tables
