!> Values and derivatives of the functions that replace the load factor.
module model_functions
  use kinds, only: wp
  use formula, only: formula_value
  use formula_derivatives, only: formula_jet
  use model_data, only: function_t, function_ramp, function_sine, function_step, function_table, &
                        function_spline
  use model_tables, only: table_row, table_value, table_slope, spline_jet
  implicit none
  private

  public :: function_value, function_jet, next_jump, next_kink

  real(wp), parameter :: pi = acos(-1.0_wp)

contains

  !> The first jump of a function behind s; huge if there is none.
  pure function next_jump(f, s) result(jump)
    type(function_t), intent(in) :: f
    real(wp), intent(in) :: s
    real(wp) :: jump
    integer :: i

    jump = huge(jump)
    if (f%kind == function_step .and. f%parameter(1) > s) jump = f%parameter(1)
    if (f%kind /= function_table) return
    do i = size(f%table, 2) - 1, 1, -1
      if (f%table(1, i) < f%table(1, i + 1) .or. f%table(1, i) <= s) cycle
      jump = f%table(1, i)
    end do
  end function next_jump

  !> The first jump of a function or of its slope behind s; huge if there is none, or it is in a
  !> formula.
  pure function next_kink(f, s) result(kink)
    type(function_t), intent(in) :: f
    real(wp), intent(in) :: s
    real(wp) :: kink
    integer :: low

    kink = huge(kink)
    select case (f%kind)
    case (function_step)
      kink = next_jump(f, s)
    case (function_ramp)
      kink = minval(f%parameter(1:2), f%parameter(1:2) > s)
    case (function_table)
      low = table_row(f%table, s)
      if (low < size(f%table, 2)) kink = f%table(1, low + 1)
    case (function_spline)
      kink = minval(f%table(1, [1, size(f%table, 2)]), f%table(1, [1, size(f%table, 2)]) > s)
    case default
    end select
  end function next_kink

  !> f(s), s being the load factor or time; NaN where a formula has no finite value.
  pure function function_value(f, s) result(value)
    type(function_t), intent(in) :: f
    real(wp), intent(in) :: s
    real(wp) :: value, jet(0:2)

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
      case (function_spline)
        call spline_jet(f%table, s, jet)
        value = jet(0)
      case default
        value = formula_value(f%formula, s)
      end select
    end associate
  end function function_value

  !> f, df/ds and d2f/ds2, at kinks and jumps those to the right; NaN where a formula has none.
  pure subroutine function_jet(f, s, jet)
    type(function_t), intent(in) :: f
    real(wp), intent(in) :: s
    real(wp), intent(out) :: jet(0:2)
    real(wp) :: rate

    jet = 0
    jet(0) = function_value(f, s)
    associate (p => f%parameter)
      select case (f%kind)
      case (function_ramp)
        if (s >= p(1) .and. s < p(2)) jet(1) = 1/(p(2) - p(1))
      case (function_sine)
        rate = 2.0_wp*pi*p(2)
        jet(1) = rate*p(1)*cos(rate*s + p(3))
        jet(2) = -rate**2*jet(0)
      case (function_step)
      case (function_table)
        jet(1) = table_slope(f%table, s)
      case (function_spline)
        call spline_jet(f%table, s, jet)
      case default
        call formula_jet(f%formula, s, jet)
      end select
    end associate
  end subroutine function_jet

end module model_functions
