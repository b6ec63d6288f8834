!> Derivatives of formulas and of the functions of decks: against algebra and differences.
module test_formula_derivatives
  use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
  use check, only: run, expect, expect_close
  use kinds, only: wp
  use formula, only: formula_t, formula_value, function_names, first_of_two, first_function
  use formula_derivatives, only: formula_jet
  use model_data, only: function_t, function_ramp, function_sine, function_step, function_table, &
                        function_formula, function_spline
  use model_functions, only: function_jet, function_value, next_kink
  use model_tables, only: spline_curvatures
  use errors, only: error_t
  use deck_expression, only: compile_expression, scope_t, problem_t
  use deck_settings, only: settings_t
  implicit none
  private

  public :: run_formula_derivatives_tests

  real(wp), parameter :: pi = acos(-1.0_wp)

contains

  subroutine run_formula_derivatives_tests()
    call run("formula derivatives: algebra", algebra)
    call run("formula derivatives: every operator, by differences", by_differences)
    call run("formula derivatives: values are those of the formula", same_values)
    call run("formula derivatives: to the right of kinks", kinks)
    call run("formula derivatives: splines", splines)
    call run("formula derivatives: undefined or too large", undefined)
    call run("formula derivatives: RAMP, SINE, STEP, TABLE, EXPR", functions)
  end subroutine run_formula_derivatives_tests

  function compiled(text) result(program)
    character(len=*), intent(in) :: text
    type(formula_t) :: program
    type(settings_t) :: none
    type(problem_t) :: problem

    call compile_expression(text, none, scope_t(has_t=.true.), program, problem)
    call expect(.not. allocated(problem%message), text//" is an expression")
  end function compiled

  !> The jet at t is this, in round-off.
  subroutine has_jet(text, t, wanted)
    character(len=*), intent(in) :: text
    real(wp), intent(in) :: t, wanted(0:2)
    real(wp) :: jet(0:2)

    call formula_jet(compiled(text), t, jet)
    call expect_close(jet, wanted, 40*epsilon(1.0_wp)*max(1.0_wp, maxval(abs(wanted))), text)
  end subroutine has_jet

  subroutine algebra()
    real(wp), parameter :: t = 0.7_wp, s = sin(2*t), c = cos(2*t)

    call has_jet("3", t, [3.0_wp, 0.0_wp, 0.0_wp])
    call has_jet("t", t, [t, 1.0_wp, 0.0_wp])
    call has_jet("-t^2", t, [-t**2, -2*t, -2.0_wp])
    call has_jet("5 - 3*t + t^3/2", t, [5 - 3*t + t**3/2, -3 + 1.5_wp*t**2, 3*t])
    call has_jet("t*sin(2*t)", t, [t*s, s + 2*t*c, 4*c - 4*t*s])
    call has_jet("1/(1 + t)", t, [1/(1 + t), -1/(1 + t)**2, 2/(1 + t)**3])
    call has_jet("exp(-2*t)", t, exp(-2*t)*[1.0_wp, -2.0_wp, 4.0_wp])
    call has_jet("sqrt(t)", t, [sqrt(t), 0.5_wp/sqrt(t), -0.25_wp/sqrt(t)**3])
    call has_jet("log(3*t)", t, [log(3*t), 1/t, -1/t**2])
    call has_jet("t^t", t, t**t*[1.0_wp, log(t) + 1, (log(t) + 1)**2 + 1/t])
    call has_jet("2^t", t, 2**t*[1.0_wp, log(2.0_wp), log(2.0_wp)**2])
    call has_jet("(-t)^3", t, [-t**3, -3*t**2, -6*t])
    call has_jet("atan2(sin(2*t), cos(2*t))", t, [2*t, 2.0_wp, 0.0_wp])
    call has_jet("asin(sin(t)) + acos(cos(t)) + atan(tan(t))", t, [3*t, 3.0_wp, 0.0_wp])
    call has_jet("t^2", 0.0_wp, [0.0_wp, 0.0_wp, 2.0_wp])
    call has_jet("t^1 + t^0 + t^5", 0.0_wp, [1.0_wp, 1.0_wp, 0.0_wp])
    call has_jet("sqrt(0) + atan2(0, 0) + abs(0) + 0^0.5 + t", 0.0_wp, [0.0_wp, 1.0_wp, 0.0_wp])
  end subroutine algebra

  !> Each operator once and several nested: derivatives against central differences of the value
  !> and of the first derivative. Their error is h**2/6 times the third derivative, below 100
  !> here, and round-off over h.
  subroutine by_differences()
    character(len=*), parameter :: text(22) = [character(len=40) :: &
      "sqrt(2 + t)", "sin(3*t)", "cos(t^2)", "tan(t/2)", "asin(t/3)", "acos(t/3)", "atan(2*t)", &
      "exp(t/2)", "log(3 + t)", "abs(t - 5)*t", "atan2(2 + t, 4 - t^2)", "min(t^2, 9 - t)", &
      "max(t^3, t - 7, sin(t))", "t - t^3", "(t + 1)*(t^2 - 2)", "(t + 1)/(t^2 + 2)", &
      "(3 + t)^(1 + t/2)", "(t - 4)^3", "(5 + t)^-1.5", "-sin(t)*exp(-t)/(1 + t^2)", &
      "sin(cos(t))^2 + sqrt(1 + t^4)", "atan2(sin(t), 2 + cos(t))*log(4 + t)"]
    real(wp), parameter :: h = 1.0e-4_wp, t(4) = [-1.3_wp, -0.2_wp, 0.45_wp, 1.1_wp]
    real(wp) :: jet(0:2), left(0:2), right(0:2), slope(2)
    type(formula_t) :: program
    integer :: i, k

    do i = 1, size(text)
      program = compiled(trim(text(i)))
      do k = 1, size(t)
        call formula_jet(program, t(k), jet)
        call formula_jet(program, t(k) - h, left)
        call formula_jet(program, t(k) + h, right)
        slope = [formula_value(program, t(k) + h) - formula_value(program, t(k) - h), &
                 right(1) - left(1)]/(2*h)
        call expect_close(jet(1:2), slope, 100*h**2/6, trim(text(i)))
      end do
    end do
  end subroutine by_differences

  !> Bit for bit, of every operator and function, at points where it has a value or none.
  subroutine same_values()
    real(wp), parameter :: points(16) = [0.0_wp, 1.0_wp, -1.0_wp, 0.5_wp, -0.5_wp, 2.0_wp, &
      -2.0_wp, 3.7_wp, -3.7_wp, 1.0e-200_wp, 1.0e-320_wp, 1.0e200_wp, -1.0e200_wp, 800.0_wp, &
      huge(1.0_wp), -tiny(1.0_wp)]
    character(len=*), parameter :: second(4) = [character(len=8) :: "2", "t", "0.5-t", "(-t)^3"]
    character(len=1), parameter :: operators(5) = ["+", "-", "*", "/", "^"]
    integer :: i, k, code

    do k = 1, size(second)
      do i = 1, size(operators)
        call compare(trim(second(k))//operators(i)//"t", points)
        call compare("t"//operators(i)//"("//trim(second(k))//")", points)
      end do
      do i = 1, size(function_names)
        code = first_function + i - 1
        if (code < first_of_two) call compare(trim(function_names(i))//"("//trim(second(k))//")", &
                                              points)
        if (code >= first_of_two) call compare(trim(function_names(i))//"("//trim(second(k))// &
                                               ", t)", points)
      end do
    end do
  end subroutine same_values

  subroutine compare(text, points)
    character(len=*), intent(in) :: text
    real(wp), intent(in) :: points(:)
    type(formula_t) :: program
    real(wp) :: jet(0:2), value
    integer :: i

    program = compiled(text)
    do i = 1, size(points)
      call formula_jet(program, points(i), jet)
      value = formula_value(program, points(i))
      call expect(ieee_is_nan(value) .eqv. ieee_is_nan(jet(0)), text//": a value or none")
      if (ieee_is_nan(value) .and. ieee_is_nan(jet(0))) then
        call expect(all(ieee_is_nan(jet)), text//": no derivatives without a value")
      else
        call expect_close(jet(0), value, 0.0_wp, text)
      end if
    end do
  end subroutine compare

  subroutine kinks()
    call has_jet("abs(t)", 0.0_wp, [0.0_wp, 1.0_wp, 0.0_wp])
    call has_jet("abs(-t)", 0.0_wp, [0.0_wp, 1.0_wp, 0.0_wp])
    call has_jet("abs(t^3 - t^2)", 0.0_wp, [0.0_wp, 0.0_wp, 2.0_wp])
    call has_jet("abs(t^2 - 1)", 1.0_wp, [0.0_wp, 2.0_wp, 2.0_wp])
    call has_jet("min(t, 1)", 1.0_wp, [1.0_wp, 0.0_wp, 0.0_wp])
    call has_jet("max(t, 1)", 1.0_wp, [1.0_wp, 1.0_wp, 0.0_wp])
    call has_jet("min(t^2, t)", 0.0_wp, [0.0_wp, 0.0_wp, 2.0_wp])
    call has_jet("max(t^2, -t^2)", 0.0_wp, [0.0_wp, 0.0_wp, 2.0_wp])
    call has_jet("max(min(t, 2), 1)", 2.0_wp, [2.0_wp, 0.0_wp, 0.0_wp])
  end subroutine kinks

  !> So many derivatives exist at t, and the first of them are these.
  subroutine has_order(text, t, wanted)
    character(len=*), intent(in) :: text
    real(wp), intent(in) :: t, wanted(:)
    real(wp) :: jet(0:2)
    integer :: i, n

    call formula_jet(compiled(text), t, jet)
    n = size(wanted)
    call expect_close(jet(:n - 1), wanted, 1.0e-14_wp*max(1.0_wp, maxval(abs(wanted))), text)
    do i = n, 2
      call expect(ieee_is_nan(jet(i)), text//" has no such derivative")
    end do
  end subroutine has_order

  subroutine undefined()
    real(wp) :: none(0)

    call has_order("sqrt(t)", 0.0_wp, [0.0_wp])
    call has_order("t^1.5", 0.0_wp, [0.0_wp, 0.0_wp])
    call has_order("2 + 3*t^1.5", 0.0_wp, [2.0_wp, 0.0_wp])
    call has_order("asin(t)", 1.0_wp, [pi/2])
    call has_order("t^t", 0.0_wp, [1.0_wp])
    call has_order("atan2(t, t)", 0.0_wp, [0.0_wp])
    call has_order("max(sqrt(t), 1)", 0.0_wp, [1.0_wp, 0.0_wp, 0.0_wp])
    call has_order("max(sqrt(t), 0)", 0.0_wp, [0.0_wp])
    call has_order("1e100*t", 1.0_wp, [1.0e100_wp])
    call has_order("exp(500*t)*0", 1.0_wp, [0.0_wp])
    call has_order("log(t)", 1.0e-60_wp, [log(1.0e-60_wp), 1.0e60_wp])
    call has_order("1/t", 0.0_wp, none)
    call has_order("sqrt(t)", -1.0_wp, none)
  end subroutine undefined

  subroutine functions()
    type(function_t) :: f
    real(wp), parameter :: t = 0.3_wp, w = 6*pi

    f%kind = function_ramp
    f%parameter = [1.0_wp, 3.0_wp, 0.0_wp]
    call expect_jets("RAMP", f, [0.9_wp, 1.0_wp, 2.0_wp, 3.0_wp], &
                     [0.0_wp, 0.0_wp, 0.5_wp, 1.0_wp], [0.0_wp, 0.5_wp, 0.5_wp, 0.0_wp])
    f%kind = function_step
    call expect_jets("STEP", f, [0.9_wp, 1.0_wp, 2.0_wp], [0.0_wp, 1.0_wp, 1.0_wp], &
                     [0.0_wp, 0.0_wp, 0.0_wp])
    f%kind = function_table
    f%table = reshape([0.0_wp, 1.0_wp, 1.0_wp, 3.0_wp, 1.0_wp, -1.0_wp, 3.0_wp, 0.0_wp], [2, 4])
    call expect_jets("TABLE", f, [-1.0_wp, 0.0_wp, 0.5_wp, 1.0_wp, 2.0_wp, 3.0_wp, 4.0_wp], &
                     [1.0_wp, 1.0_wp, 2.0_wp, -1.0_wp, -0.5_wp, 0.0_wp, 0.0_wp], &
                     [0.0_wp, 2.0_wp, 2.0_wp, 0.5_wp, 0.5_wp, 0.0_wp, 0.0_wp])
    f%kind = function_sine
    f%parameter = [2.0_wp, 3.0_wp, 0.4_wp]
    call expect_jet("SINE", f, t, 2*[sin(w*t + 0.4_wp), w*cos(w*t + 0.4_wp), &
                                     -w**2*sin(w*t + 0.4_wp)])
    f%kind = function_formula
    f%formula = compiled("t^2*(3 - 2*t)")
    call expect_jet("EXPR", f, t, [t**2*(3 - 2*t), 6*t - 6*t**2, 6 - 12*t])
  end subroutine functions

  !> Cubics are their own splines, of three points parabolas, of two lines; others come near with a
  !> fourth power of the distance of points, ends included.
  subroutine splines()
    real(wp), parameter :: s(5) = [-1.0_wp, 0.0_wp, 0.4_wp, 1.5_wp, 2.0_wp], t = 0.9_wp
    type(function_t) :: f
    real(wp) :: miss(2), jet(0:2)
    integer :: i, k, n

    f = spline_of(s, s**3 - 2*s**2 + s)
    do i = 1, 8
      associate (x => -0.9_wp + 0.4_wp*(i - 1))
        call expect_jet("SPLINE, a cubic", f, x, [x**3 - 2*x**2 + x, 3*x**2 - 4*x + 1, 6*x - 4])
      end associate
    end do
    call expect_jet("before", f, -1.5_wp, [-4.0_wp, 0.0_wp, 0.0_wp])
    call expect_jet("behind", f, 2.5_wp, [2.0_wp, 0.0_wp, 0.0_wp])
    call expect_close([next_kink(f, -3.0_wp), next_kink(f, 0.0_wp)], [-1.0_wp, 2.0_wp], 0.0_wp, &
                      "kinks at its ends")
    f = spline_of(s(2:4), s(2:4)**2)
    call expect_jet("SPLINE, three points", f, t, [t**2, 2*t, 2.0_wp])
    f = spline_of(s(2:5:3), [1.0_wp, 5.0_wp])
    call expect_jet("SPLINE, two points", f, t, [1 + 2*t, 2.0_wp, 0.0_wp])
    miss = 0
    do k = 1, 2
      n = 20*k
      f = spline_of([(real(i, wp)/n, i=0, n)], [(exp(real(i, wp)/n), i=0, n)])
      do i = 0, 999
        call function_jet(f, i/1000.0_wp, jet)
        miss(k) = max(miss(k), abs(jet(0) - exp(i/1000.0_wp)))
      end do
    end do
    call expect_close(log(miss(1)/miss(2))/log(2.0_wp), 4.0_wp, 0.3_wp, "order")
  end subroutine splines

  function spline_of(s, v) result(f)
    real(wp), intent(in) :: s(:), v(:)
    type(function_t) :: f
    type(error_t), allocatable :: error

    f%kind = function_spline
    allocate (f%table(3, size(s)))
    f%table(1, :) = s
    f%table(2, :) = v
    call spline_curvatures(s, v, f%table(3, :), error)
    call expect(.not. allocated(error), "curvatures")
  end function spline_of

  !> A function of straight pieces.
  subroutine expect_jets(name, f, s, value, slope)
    character(len=*), intent(in) :: name
    type(function_t), intent(in) :: f
    real(wp), intent(in) :: s(:), value(:), slope(:)
    integer :: i

    do i = 1, size(s)
      call expect_jet(name, f, s(i), [value(i), slope(i), 0.0_wp])
    end do
  end subroutine expect_jets

  subroutine expect_jet(name, f, s, wanted)
    character(len=*), intent(in) :: name
    type(function_t), intent(in) :: f
    real(wp), intent(in) :: s, wanted(0:2)
    real(wp) :: jet(0:2)

    call function_jet(f, s, jet)
    call expect_close(jet, wanted, 8*epsilon(1.0_wp)*max(1.0_wp, maxval(abs(wanted))), name)
    call expect_close(jet(0), function_value(f, s), 0.0_wp, name//": the value")
  end subroutine expect_jet

end module test_formula_derivatives
