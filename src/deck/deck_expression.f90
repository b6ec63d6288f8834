!> The expressions between braces, compiled to postfix programs.
!>
!> sum = product {(+|-) product};  product = factor {(*|/) factor};
!> factor = (+|-) factor | power;  power = atom [^ factor];
!> atom = number | name | function(sum, ...) | (sum)
module deck_expression
  use kinds, only: wp
  use text, only: quoted, nearest_word
  use formula, only: formula_t, emit, push_number, push_variable, negate, add, subtract, &
                     multiply, divide, raise, first_function, first_of_two, function_names
  use deck_settings, only: settings_t
  use deck_number, only: scan_number, parse_number, number_ok
  implicit none
  private

  public :: compile_expression, scope_t, problem_t

  integer, parameter :: deepest = 200  !< of nested parentheses, signs and powers
  character(len=*), parameter :: name_signs = &
    "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_0123456789"
  real(wp), parameter :: pi = acos(-1.0_wp)

  !> What `t` and `i` mean where the expression stands.
  type :: scope_t
    logical :: has_t = .false.
    logical :: has_i = .false.
    integer :: i = 0
  end type scope_t

  !> What is wrong with an expression, and where; no message: nothing.
  type :: problem_t
    character(len=:), allocatable :: message, hint
    integer :: at = 0       !< index in the text
    integer :: width = 1
  end type problem_t

  type :: parser_t
    character(len=:), allocatable :: text
    integer :: at = 1
    integer :: depth = 0
    type(scope_t) :: scope
    type(formula_t) :: program
    type(problem_t) :: problem
  end type parser_t

contains

  !> Compile the text between the braces.
  subroutine compile_expression(text, settings, scope, program, problem)
    character(len=*), intent(in) :: text
    type(settings_t), intent(in) :: settings
    type(scope_t), intent(in) :: scope
    type(formula_t), intent(out) :: program
    type(problem_t), intent(out) :: problem
    type(parser_t) :: p

    p%text = text
    p%scope = scope
    call move_to(p, 1)
    call read_sum(p, settings)
    if (.not. failed(p) .and. next(p) /= " ") then
      call complain(p, "unexpected "//quoted(next(p))//" in an expression", p%at, 1)
    end if
    program = p%program
    problem = p%problem
  end subroutine compile_expression

  recursive subroutine read_sum(p, settings)
    type(parser_t), intent(inout) :: p
    type(settings_t), intent(in) :: settings
    integer :: code

    call read_product(p, settings)
    do while (.not. failed(p))
      select case (next(p))
      case ("+")
        code = add
      case ("-")
        code = subtract
      case default
        return
      end select
      call move_to(p, p%at + 1)
      call read_product(p, settings)
      call emit(p%program, code)
    end do
  end subroutine read_sum

  recursive subroutine read_product(p, settings)
    type(parser_t), intent(inout) :: p
    type(settings_t), intent(in) :: settings
    integer :: code

    call read_factor(p, settings)
    do while (.not. failed(p))
      select case (next(p))
      case ("*")
        code = multiply
      case ("/")
        code = divide
      case default
        return
      end select
      call move_to(p, p%at + 1)
      call read_factor(p, settings)
      call emit(p%program, code)
    end do
  end subroutine read_product

  !> Signs bind weaker than ^, so that -2^2 is -4.
  recursive subroutine read_factor(p, settings)
    type(parser_t), intent(inout) :: p
    type(settings_t), intent(in) :: settings
    logical :: minus

    p%depth = p%depth + 1
    if (p%depth > deepest) call complain(p, "an expression nested too deeply", p%at, 1)
    if (failed(p)) return
    if (next(p) == "+" .or. next(p) == "-") then
      minus = next(p) == "-"
      call move_to(p, p%at + 1)
      call read_factor(p, settings)
      if (minus) call emit(p%program, negate)
    else
      call read_atom(p, settings)
      if (.not. failed(p) .and. next(p) == "^") then
        call move_to(p, p%at + 1)
        call read_factor(p, settings)
        call emit(p%program, raise)
      end if
    end if
    p%depth = p%depth - 1
  end subroutine read_factor

  recursive subroutine read_atom(p, settings)
    type(parser_t), intent(inout) :: p
    type(settings_t), intent(in) :: settings
    character(len=1) :: c

    c = next(p)
    if (index("0123456789.", c) > 0) then
      call read_constant(p)
    else if (index(name_signs, c) > 0) then
      call read_name(p, settings)
    else if (c == "(") then
      call move_to(p, p%at + 1)
      call read_sum(p, settings)
      call close_parenthesis(p)
    else if (c == " ") then
      call complain(p, "the expression ends too early", len(p%text) + 1, 1)
    else
      call complain(p, "unexpected "//quoted(c)//" in an expression", p%at, 1)
    end if
  end subroutine read_atom

  subroutine read_constant(p)
    type(parser_t), intent(inout) :: p
    integer :: last, behind, status
    real(wp) :: value

    last = scan_number(p%text, p%at)
    behind = verify(p%text(p%at:)//" ", name_signs//".") + p%at - 2
    if (last < behind) then
      call complain(p, quoted(p%text(p%at:behind))//" is not a number", p%at, behind - p%at + 1)
      return
    end if
    call parse_number(p%text(p%at:last), value, status)
    if (status /= number_ok) then
      call complain(p, quoted(p%text(p%at:last))//" is too large", p%at, last - p%at + 1)
    end if
    call emit(p%program, push_number, value)
    call move_to(p, last + 1)
  end subroutine read_constant

  recursive subroutine read_name(p, settings)
    type(parser_t), intent(inout) :: p
    type(settings_t), intent(in) :: settings
    character(len=:), allocatable :: name
    integer :: start, i

    start = p%at
    i = verify(p%text(start:)//" ", name_signs) + start - 1
    name = p%text(start:i - 1)
    call move_to(p, i)
    if (next(p) == "(") then
      call read_call(p, settings, name, start)
      return
    end if
    i = settings%table%find(name)
    if (name == "pi") then
      call emit(p%program, push_number, pi)
    else if (name == "t" .and. p%scope%has_t) then
      call emit(p%program, push_variable)
    else if (name == "i" .and. p%scope%has_i) then
      call emit(p%program, push_number, real(p%scope%i, wp))
    else if (i == 0) then
      call undefined_name(p, settings, name, start)
    else if (settings%numeric(i)) then
      call emit(p%program, push_number, settings%number(i))
    else
      call complain(p, quoted(name)//" is set to "//quoted(settings%word(i)%s)// &
                    ", which is not a number", start, len(name))
    end if
  end subroutine read_name

  !> Say that a name means nothing here.
  subroutine undefined_name(p, settings, name, start)
    type(parser_t), intent(inout) :: p
    type(settings_t), intent(in) :: settings
    character(len=*), intent(in) :: name
    integer, intent(in) :: start
    character(len=:), allocatable :: best

    call complain(p, "undefined name "//quoted(name), start, len(name))
    best = nearest_word(name, [settings%names(), ["pi"//repeat(" ", 62)]])
    if (name == "t") then
      p%problem%hint = "t is the variable of FUNCTION ... EXPR"
    else if (name == "i") then
      p%problem%hint = "i is the id of a card whose own id is a range"
    else if (any(function_names == name)) then
      p%problem%hint = name//" is a function: "//name//"(...)"
    else if (best /= "") then
      p%problem%hint = "did you mean "//best//"?"
    end if
  end subroutine undefined_name

  !> The arguments of a function; min and max take two or more.
  recursive subroutine read_call(p, settings, name, start)
    type(parser_t), intent(inout) :: p
    type(settings_t), intent(in) :: settings
    character(len=*), intent(in) :: name
    integer, intent(in) :: start
    integer :: code, given, i, wanted
    character(len=:), allocatable :: best

    code = 0
    do i = 1, size(function_names)
      if (function_names(i) == name) code = first_function + i - 1
    end do
    if (code == 0) then
      call complain(p, "unknown function "//quoted(name), start, len(name))
      best = nearest_word(name, function_names)
      if (best /= "") p%problem%hint = "did you mean "//best//"?"
      return
    end if
    call move_to(p, p%at + 1)
    given = 0
    do
      call read_sum(p, settings)
      if (failed(p)) return
      given = given + 1
      if (given > 1 .and. code > first_of_two) call emit(p%program, code)
      if (next(p) /= ",") exit
      call move_to(p, p%at + 1)
    end do
    call close_parenthesis(p)
    if (code <= first_of_two) call emit(p%program, code)
    wanted = merge(2, 1, code >= first_of_two)
    if (given < wanted .or. (given > wanted .and. code <= first_of_two)) then
      call complain(p, name//" takes "//trim(merge("one argument ", "two arguments", &
                                                   wanted == 1)), start, len(name))
    end if
  end subroutine read_call

  subroutine close_parenthesis(p)
    type(parser_t), intent(inout) :: p

    if (failed(p)) return
    if (next(p) == ")") then
      call move_to(p, p%at + 1)
    else
      call complain(p, "')' expected", p%at, 1)
    end if
  end subroutine close_parenthesis

  !> Go on at a position or at the first character behind it that is not blank.
  pure subroutine move_to(p, at)
    type(parser_t), intent(inout) :: p
    integer, intent(in) :: at

    p%at = at
    do while (p%at <= len(p%text))
      if (ichar(p%text(p%at:p%at)) > 32) exit
      p%at = p%at + 1
    end do
  end subroutine move_to

  !> The character to read next; a blank at the end.
  pure character(len=1) function next(p)
    type(parser_t), intent(in) :: p

    next = " "
    if (p%at <= len(p%text)) next = p%text(p%at:p%at)
  end function next

  pure logical function failed(p)
    type(parser_t), intent(in) :: p

    failed = allocated(p%problem%message)
  end function failed

  !> Note the first problem.
  subroutine complain(p, message, at, width)
    type(parser_t), intent(inout) :: p
    character(len=*), intent(in) :: message
    integer, intent(in) :: at, width

    if (allocated(p%problem%message)) return
    p%problem%message = message
    p%problem%hint = ""
    p%problem%at = at
    p%problem%width = width
  end subroutine complain

end module deck_expression
