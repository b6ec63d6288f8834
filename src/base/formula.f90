!> A compiled expression: a postfix program of numbers, one variable and functions.
module formula
  use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan, ieee_is_finite
  use kinds, only: wp
  implicit none
  private

  public :: formula_t, emit, formula_value, combine, apply

  integer, parameter, public :: push_number = 1, push_variable = 2, negate = 3, add = 4, &
                                subtract = 5, multiply = 6, divide = 7, raise = 8
  !> Code of the first of `function_names`; from `first_of_two` on they take two arguments.
  integer, parameter, public :: first_function = 11, first_of_two = 21
  character(len=5), parameter, public :: function_names(13) = &
    ["sqrt ", "sin  ", "cos  ", "tan  ", "asin ", "acos ", "atan ", "exp  ", "log  ", "abs  ", &
     "atan2", "min  ", "max  "]

  real(wp), parameter :: largest_exponent = 709.0_wp  !< exp of more overflows

  !> A postfix program; the reader of expressions makes it, `formula_value` runs it.
  type :: formula_t
    integer, allocatable :: code(:)       !< operations
    real(wp), allocatable :: constant(:)  !< operand of each "push a number", else 0
    integer :: steps = 0                  !< operations in use
    integer :: height = 0                 !< numbers on the stack after the last step
    integer :: depth = 0                  !< most numbers on the stack
  end type formula_t

contains

  !> Append an operation.
  pure subroutine emit(program, code, constant)
    type(formula_t), intent(inout) :: program
    integer, intent(in) :: code
    real(wp), intent(in), optional :: constant

    if (.not. allocated(program%code)) allocate (program%code(16), program%constant(16))
    if (program%steps == size(program%code)) then
      program%code = [program%code, program%code]
      program%constant = [program%constant, program%constant]
    end if
    program%steps = program%steps + 1
    program%code(program%steps) = code
    program%constant(program%steps) = 0.0_wp
    if (present(constant)) program%constant(program%steps) = constant
    select case (code)
    case (push_number, push_variable)
      program%height = program%height + 1
    case (add:raise, first_of_two:)
      program%height = program%height - 1
    case default  ! functions of one argument leave it
    end select
    program%depth = max(program%depth, program%height)
  end subroutine emit

  !> Value of a formula; NaN where it has none (division by zero, overflow, root of a negative
  !> number). No floating-point exception is raised.
  pure function formula_value(program, variable) result(value)
    type(formula_t), intent(in) :: program
    real(wp), intent(in) :: variable
    real(wp) :: value
    real(wp) :: stack(program%depth)
    integer :: i, top
    logical :: valid

    top = 0
    valid = program%steps > 0 .and. ieee_is_finite(variable)
    do i = 1, program%steps
      if (.not. valid) exit
      select case (program%code(i))
      case (push_number, push_variable)
        top = top + 1
        stack(top) = variable
        if (program%code(i) == push_number) stack(top) = program%constant(i)
      case (negate)
        stack(top) = -stack(top)
      case (add:raise, first_of_two:)
        top = top - 1
        call combine(program%code(i), stack(top), stack(top + 1), valid)
      case default
        call apply(program%code(i), stack(top), valid)
      end select
    end do
    if (valid) then
      value = stack(1)
    else
      value = ieee_value(value, ieee_quiet_nan)
    end if
  end function formula_value

  !> a <- a operation b.
  pure subroutine combine(code, a, b, valid)
    integer, intent(in) :: code
    real(wp), intent(inout) :: a
    real(wp), intent(in) :: b
    logical, intent(out) :: valid

    valid = .true.
    select case (code)
    case (add, subtract)
      valid = max(exponent(a), exponent(b)) < maxexponent(a)
      if (valid) a = a + merge(b, -b, code == add)
    case (multiply)
      valid = exponent(a) + exponent(b) <= maxexponent(a)
      if (valid) a = a*b
    case (divide)
      valid = abs(b) > 0.0_wp .and. exponent(a) - exponent(b) < maxexponent(a)
      if (valid) a = a/b
    case (raise)
      call power(a, b, valid)
    case (first_of_two)
      if (abs(a) > 0.0_wp .or. abs(b) > 0.0_wp) a = atan2(a, b)
    case (first_of_two + 1)
      a = min(a, b)
    case default
      a = max(a, b)
    end select
  end subroutine combine

  !> a <- a**b; a negative a needs a whole b.
  pure subroutine power(a, b, valid)
    real(wp), intent(inout) :: a
    real(wp), intent(in) :: b
    logical, intent(out) :: valid
    logical :: whole

    whole = .not. abs(b - anint(b)) > 0.0_wp
    if (.not. abs(a) > 0.0_wp) then
      valid = b >= 0.0_wp
      if (valid) a = merge(0.0_wp, 1.0_wp, b > 0.0_wp)
      return
    end if
    valid = (a > 0.0_wp .or. whole) .and. abs(b) < 1.0e15_wp
    if (valid) valid = b*log(abs(a)) < largest_exponent
    if (.not. valid) return
    if (whole .and. abs(b) <= 64.0_wp) then
      a = a**nint(b)
    else
      a = merge(-1.0_wp, 1.0_wp, a < 0.0_wp .and. modulo(b, 2.0_wp) > 0.5_wp)*abs(a)**b
    end if
  end subroutine power

  !> a <- function(a).
  pure subroutine apply(code, a, valid)
    integer, intent(in) :: code
    real(wp), intent(inout) :: a
    logical, intent(out) :: valid

    valid = .true.
    select case (function_names(code - first_function + 1))
    case ("sqrt")
      valid = a >= 0.0_wp
      if (valid) a = sqrt(a)
    case ("sin")
      a = sin(a)
    case ("cos")
      a = cos(a)
    case ("tan")
      a = tan(a)
    case ("asin")
      valid = abs(a) <= 1.0_wp
      if (valid) a = asin(a)
    case ("acos")
      valid = abs(a) <= 1.0_wp
      if (valid) a = acos(a)
    case ("atan")
      a = atan(a)
    case ("exp")
      valid = a < largest_exponent
      if (valid) a = exp(a)
    case ("log")
      valid = a > 0.0_wp
      if (valid) a = log(a)
    case default
      a = abs(a)
    end select
  end subroutine apply

end module formula
