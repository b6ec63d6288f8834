!> First and second derivatives of formulas, by arithmetic with jets: value, first and second
!> derivative with respect to the variable.
module formula_derivatives
  use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan, ieee_is_finite
  use kinds, only: wp
  use formula, only: formula_t, combine, apply, push_number, push_variable, negate, add, &
                     subtract, multiply, divide, raise, first_function, first_of_two, &
                     function_names
  implicit none
  private

  public :: formula_jet

  !> Derivatives from 2**300 on count as undefined: products of three of them stay finite.
  integer, parameter :: largest_exponent = 300

  !> A quantity and its derivatives; those above `order` are undefined, and 0 here.
  type :: jet_t
    real(wp) :: d(0:2) = 0.0_wp
    integer :: order = 2
    logical :: constant = .false.  !< for any value of the variable
  end type jet_t

contains

  !> Value, first and second derivative of a formula; NaN where they are undefined or beyond 2e90.
  !> At kinks of abs, min and max the derivatives are those to the right. The value is that of
  !> `formula_value`; no floating-point exception is raised.
  pure subroutine formula_jet(program, variable, jet)
    type(formula_t), intent(in) :: program
    real(wp), intent(in) :: variable
    real(wp), intent(out) :: jet(0:2)
    type(jet_t) :: stack(program%depth)
    integer :: i, top
    logical :: valid

    top = 0
    valid = program%steps > 0 .and. ieee_is_finite(variable)
    do i = 1, program%steps
      if (.not. valid) exit
      select case (program%code(i))
      case (push_number)
        top = top + 1
        stack(top) = jet_t([program%constant(i), 0.0_wp, 0.0_wp], constant=.true.)
      case (push_variable)
        top = top + 1
        stack(top) = jet_t([variable, 1.0_wp, 0.0_wp])
      case (negate)
        stack(top)%d = -stack(top)%d
      case (add:raise, first_of_two:)
        top = top - 1
        call combine_jets(program%code(i), stack(top), stack(top + 1), valid)
      case default
        call apply_to_jet(program%code(i), stack(top), valid)
      end select
    end do
    jet = ieee_value(1.0_wp, ieee_quiet_nan)
    if (valid) jet(:stack(1)%order) = stack(1)%d(:stack(1)%order)
  end subroutine formula_jet

  !> a <- a operation b.
  pure subroutine combine_jets(code, a, b, valid)
    integer, intent(in) :: code
    type(jet_t), intent(inout) :: a
    type(jet_t), intent(in) :: b
    logical, intent(out) :: valid
    type(jet_t) :: c

    c%d(0) = a%d(0)
    call combine(code, c%d(0), b%d(0), valid)
    c%constant = a%constant .and. b%constant
    if (valid .and. .not. c%constant) then
      c%order = min(a%order, b%order)
      select case (code)
      case (add, subtract)
        c%d(1:2) = a%d(1:2) + merge(b%d(1:2), -b%d(1:2), code == add)
      case (multiply)
        call multiply_jets(a, b, c)
      case (divide)
        call divide_jets(a, b, c)
      case (raise)
        call raise_jet(a, b, c)
      case (first_of_two)
        call angle_of_jets(a, b, c)
      case default
        call choose_jet(a, b, code == first_of_two + 1, c)
      end select
      call settle(c)
    end if
    a = c
  end subroutine combine_jets

  !> Numbers small enough for products of three.
  pure logical function calm(x)
    real(wp), intent(in) :: x(:)

    calm = all(exponent(x) <= largest_exponent)
  end function calm

  !> Leave out derivatives that are too large or undefined.
  pure subroutine settle(a)
    type(jet_t), intent(inout) :: a

    if (.not. calm(a%d(2:2))) a%order = min(a%order, 1)
    if (.not. calm(a%d(1:1))) a%order = 0
    a%d(a%order + 1:) = 0.0_wp
  end subroutine settle

  !> Derivatives of c = a b.
  pure subroutine multiply_jets(a, b, c)
    type(jet_t), intent(in) :: a, b
    type(jet_t), intent(inout) :: c

    if (.not. calm([a%d(0), b%d(0)])) then
      c%order = 0
    else
      c%d(1) = a%d(1)*b%d(0) + a%d(0)*b%d(1)
      c%d(2) = a%d(2)*b%d(0) + 2*a%d(1)*b%d(1) + a%d(0)*b%d(2)
    end if
  end subroutine multiply_jets

  !> Derivatives of c = a/b, from c b = a.
  pure subroutine divide_jets(a, b, c)
    type(jet_t), intent(in) :: a, b
    type(jet_t), intent(inout) :: c

    if (.not. calm(c%d(0:0)) .or. exponent(b%d(0)) < -largest_exponent) then
      c%order = 0
      return
    end if
    c%d(1) = (a%d(1) - c%d(0)*b%d(1))/b%d(0)
    call settle(c)
    c%d(2) = (a%d(2) - 2*c%d(1)*b%d(1) - c%d(0)*b%d(2))/b%d(0)
  end subroutine divide_jets

  !> Derivatives of c = a**b.
  pure subroutine raise_jet(a, b, c)
    type(jet_t), intent(in) :: a, b
    type(jet_t), intent(inout) :: c
    real(wp) :: outer(2), l(0:2), m(2)
    integer :: i, order

    if (b%constant) then
      order = 2
      outer = 0
      do i = 1, 2
        call power_derivative(a%d(0), b%d(0), i, outer(i), order)
      end do
      call chain(a, outer, order, c)
    else if (a%d(0) > 0.0_wp .and. calm(c%d(0:0)) .and. calm(b%d(0:0)) .and. &
             exponent(a%d(0)) >= -largest_exponent) then
      l(0) = log(a%d(0))       ! c = exp(m), m = b l
      l(1) = a%d(1)/a%d(0)
      if (.not. calm(l(1:1))) c%order = 0
      if (c%order == 0) return
      l(2) = a%d(2)/a%d(0) - l(1)**2
      m(1) = b%d(1)*l(0) + b%d(0)*l(1)
      if (.not. calm([l(2), m(1)])) c%order = 0
      if (c%order == 0) return
      m(2) = b%d(2)*l(0) + 2*b%d(1)*l(1) + b%d(0)*l(2)
      c%d(1) = c%d(0)*m(1)
      if (calm(m(2:2))) then
        c%d(2) = c%d(0)*(m(2) + m(1)**2)
      else
        c%order = min(c%order, 1)
      end if
    else
      c%order = 0
    end if
  end subroutine raise_jet

  !> Derivative number n of x**p to x; `order` falls below n where there is none.
  pure subroutine power_derivative(x, p, n, value, order)
    real(wp), intent(in) :: x, p
    integer, intent(in) :: n
    real(wp), intent(out) :: value
    integer, intent(inout) :: order
    real(wp) :: factor
    logical :: valid

    value = 0
    factor = p
    if (n == 2) factor = p*(p - 1)
    if (.not. abs(factor) > 0.0_wp) return
    value = x
    call combine(raise, value, p - n, valid)
    if (valid) call combine(multiply, value, factor, valid)
    if (valid) return
    value = 0
    order = min(order, n - 1)
  end subroutine power_derivative

  !> Derivatives of c = atan2(a, b).
  pure subroutine angle_of_jets(a, b, c)
    type(jet_t), intent(in) :: a, b
    type(jet_t), intent(inout) :: c
    real(wp) :: r, s, co

    c%order = 0
    if (.not. calm([a%d(0), b%d(0)])) return
    r = hypot(a%d(0), b%d(0))
    if (.not. r > 0.0_wp .or. exponent(r) < -largest_exponent) return
    c%order = min(a%order, b%order)
    s = a%d(0)/r
    co = b%d(0)/r
    c%d(1) = (co*a%d(1) - s*b%d(1))/r
    call settle(c)
    c%d(2) = (co*a%d(2) - s*b%d(2) - 2*c%d(1)*(s*a%d(1) + co*b%d(1)))/r
  end subroutine angle_of_jets

  !> c <- the smaller or larger of two, to the right of where they are equal.
  pure subroutine choose_jet(a, b, smaller, c)
    type(jet_t), intent(in) :: a, b
    logical, intent(in) :: smaller
    type(jet_t), intent(inout) :: c
    integer :: i, least

    least = min(a%order, b%order)
    do i = 0, least
      if (a%d(i) < b%d(i) .or. a%d(i) > b%d(i)) exit
    end do
    c%order = least
    c%d(1:2) = a%d(1:2)
    if (i > least) return
    if (a%d(i) < b%d(i) .eqv. smaller) then
      c%order = a%order
    else
      c%d(1:2) = b%d(1:2)
      c%order = b%order
    end if
  end subroutine choose_jet

  !> a <- function(a).
  pure subroutine apply_to_jet(code, a, valid)
    integer, intent(in) :: code
    type(jet_t), intent(inout) :: a
    logical, intent(out) :: valid
    type(jet_t) :: c
    real(wp) :: outer(2)
    integer :: order

    c = a
    call apply(code, c%d(0), valid)
    if (valid .and. .not. a%constant) then
      if (function_names(code - first_function + 1) == "abs") then
        c%d = a%d*sign(1.0_wp, right_of(a))
      else
        call outer_derivatives(code, a%d(0), c%d(0), outer, order)
        call chain(a, outer, order, c)
        call settle(c)
      end if
    end if
    a = c
  end subroutine apply_to_jet

  !> A number with the sign that a has to the right of the variable.
  pure real(wp) function right_of(a)
    type(jet_t), intent(in) :: a
    integer :: i

    right_of = 0
    do i = 0, a%order
      right_of = a%d(i)
      if (abs(right_of) > 0.0_wp) return
    end do
  end function right_of

  !> Derivatives of c = f(a), those of f given up to `order`.
  pure subroutine chain(a, outer, order, c)
    type(jet_t), intent(in) :: a
    real(wp), intent(in) :: outer(2)
    integer, intent(in) :: order
    type(jet_t), intent(inout) :: c

    c%order = min(a%order, order)
    if (.not. calm(outer(2:2))) c%order = min(c%order, 1)
    if (.not. calm(outer(1:1))) c%order = 0
    c%d(1:2) = 0
    if (c%order >= 1) c%d(1) = outer(1)*a%d(1)
    if (c%order == 2) c%d(2) = outer(2)*a%d(1)**2 + outer(1)*a%d(2)
  end subroutine chain

  !> First and second derivative of a function of one argument at x, where its value is y.
  pure subroutine outer_derivatives(code, x, y, outer, order)
    integer, intent(in) :: code
    real(wp), intent(in) :: x, y
    real(wp), intent(out) :: outer(2)
    integer, intent(out) :: order
    real(wp) :: root
    logical :: valid

    order = 2
    outer = 0
    select case (function_names(code - first_function + 1))
    case ("sqrt")
      call power_derivative(x, 0.5_wp, 1, outer(1), order)
      call power_derivative(x, 0.5_wp, 2, outer(2), order)
    case ("log")
      outer(1) = 1
      call combine(divide, outer(1), x, valid)
      if (valid) valid = calm(outer(1:1))
      if (valid) outer(2) = -outer(1)**2
      if (.not. valid) order = 0
    case ("sin")
      outer = [cos(x), -y]
    case ("cos")
      outer = [-sin(x), -y]
    case ("tan")
      outer = [1 + y**2, 2*y*(1 + y**2)]
    case ("asin", "acos")
      root = sqrt((1 - x)*(1 + x))
      if (root > 0.0_wp) then
        outer = [1/root, x/root**3]
        if (function_names(code - first_function + 1) == "acos") outer = -outer
      else
        order = 0
      end if
    case ("atan")
      outer(1) = 1/(1 + min(abs(x), 1.0e150_wp)**2)
      outer(2) = -2*(x*outer(1))*outer(1)
    case default  ! exp
      outer = y
    end select
  end subroutine outer_derivatives

end module formula_derivatives
