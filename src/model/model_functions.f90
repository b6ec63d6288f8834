!> Values of the functions that replace the load factor.
module model_functions
  use kinds, only: wp
  use formula, only: formula_value
  use model_data, only: function_t, function_ramp, function_sine, function_step, function_table
  implicit none
  private

  public :: function_value, function_jet

  real(wp), parameter :: pi = acos(-1.0_wp)

contains

  !> f(s), s being the load factor or time; NaN where a formula has no finite value.
  pure function function_value(f, s) result(value)
    type(function_t), intent(in) :: f
    real(wp), intent(in) :: s
    real(wp) :: value

    associate (p => f%parameter)
      select case (f%kind)
      case (function_ramp)
        value = min(1.0_wp, max(0.0_wp, (s - p(1))/(p(2) - p(1))))
      case (function_sine)
        value = p(1)*sin(2.0_wp*pi*p(2)*s + p(3))
      case (function_step)
        value = merge(1.0_wp, 0.0_wp, s >= p(1))
      case (function_table)
        value = table_value(f%table, s)
      case default
        value = formula_value(f%formula, s)
      end select
    end associate
  end function function_value

  !> Value, first and second derivative.
  pure subroutine function_jet(f, s, jet)
    type(function_t), intent(in) :: f
    real(wp), intent(in) :: s
    real(wp), intent(out) :: jet(0:2)
    real(wp), parameter :: h = 1.0e-4_wp

    jet(0) = function_value(f, s)
    jet(1) = (function_value(f, s + h) - function_value(f, s - h))/(2*h)
    jet(2) = (function_value(f, s + h) - 2*jet(0) + function_value(f, s - h))/h**2
  end subroutine function_jet

  !> Linear between the rows' pairs, constant outside; at a jump the value behind it.
  pure function table_value(table, s) result(value)
    real(wp), intent(in) :: table(:, :)  !< 2 x n: abscissas, not falling, and values
    real(wp), intent(in) :: s
    real(wp) :: value
    integer :: low, high, middle

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
    if (low == 0) then
      value = table(2, 1)
    else if (low == size(table, 2)) then
      value = table(2, low)
    else
      value = table(2, low) + (table(2, high) - table(2, low)) &
              *(s - table(1, low))/(table(1, high) - table(1, low))
    end if
  end function table_value

end module model_functions
