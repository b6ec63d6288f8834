!> FUNCTION cards: functions of the load factor or of time.
module deck_function_cards
  use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
  use kinds, only: wp
  use formula, only: formula_t, formula_value, push_variable
  use model_data, only: function_t, function_ramp, function_sine, function_step, function_table, &
                        function_formula, function_spline
  use model_tables, only: spline_curvatures
  use errors, only: error_t
  use deck_card, only: card_t
  use deck_draft, only: draft_t
  use deck_growth, only: grow
  use deck_expression, only: scope_t
  use deck_values, only: formula_of
  use deck_model_cards, only: define_name
  implicit none
  private

  public :: read_ramp, read_sine, read_step, read_table, read_spline, read_formula

contains

  !> FUNCTION name RAMP s0 s1
  subroutine read_ramp(card, draft)
    type(card_t), intent(in) :: card
    type(draft_t), intent(inout) :: draft

    if (card%number(5) <= card%number(4)) then
      call draft%report%add_error(card%place(5), "a ramp must end after it starts")
    end if
    call store(card, draft, function_ramp, card%number(4:5))
  end subroutine read_ramp

  !> FUNCTION name SINE amplitude cycles [phase]
  subroutine read_sine(card, draft)
    type(card_t), intent(in) :: card
    type(draft_t), intent(inout) :: draft

    call store(card, draft, function_sine, card%number(4:card%positional + 1))
  end subroutine read_sine

  !> FUNCTION name STEP s0
  subroutine read_step(card, draft)
    type(card_t), intent(in) :: card
    type(draft_t), intent(inout) :: draft

    call store(card, draft, function_step, card%number(4:4))
  end subroutine read_step

  !> FUNCTION name TABLE s v s v ...
  subroutine read_table(card, draft)
    type(card_t), intent(in) :: card
    type(draft_t), intent(inout) :: draft
    real(wp), allocatable :: table(:, :)
    integer :: i

    call read_pairs(card, draft, 2, table)
    do i = 2, size(table, 2)
      if (table(1, i) >= table(1, i - 1)) cycle
      call draft%report%add_error(card%place(2 + 2*i), "the abscissas of a TABLE must not fall")
      return
    end do
    if (size(table) > 0) call store(card, draft, function_table, table=table)
  end subroutine read_table

  !> FUNCTION name SPLINE s v s v ...
  subroutine read_spline(card, draft)
    type(card_t), intent(in) :: card
    type(draft_t), intent(inout) :: draft
    type(error_t), allocatable :: error
    real(wp), allocatable :: table(:, :)
    integer :: i

    call read_pairs(card, draft, 3, table)
    do i = 2, size(table, 2)
      if (table(1, i) > table(1, i - 1)) cycle
      call draft%report%add_error(card%place(2 + 2*i), "the abscissas of a SPLINE must rise")
      return
    end do
    if (size(table, 2) == 1) then
      call draft%report%add_error(card%place(4), "a SPLINE has two points or more")
    else if (size(table, 2) > 1) then
      call spline_curvatures(table(1, :), table(2, :), table(3, :), error)
      if (allocated(error)) call draft%report%add_error(card%place(3), error%message)
      call store(card, draft, function_spline, table=table)
    end if
  end subroutine read_spline

  !> Pairs of abscissa and value; nothing if one is left over.
  subroutine read_pairs(card, draft, rows, table)
    type(card_t), intent(in) :: card
    type(draft_t), intent(inout) :: draft
    integer, intent(in) :: rows                        !< of the table, zero from the third on
    real(wp), allocatable, intent(out) :: table(:, :)  !< rows x n
    integer :: n

    n = (card%positional - 2)/2
    if (card%positional /= 2*n + 2) then
      call draft%report%add_error(card%place(card%positional + 1), "an abscissa without value: "// &
                                  "a "//trim(card%word(3))//" has pairs of numbers")
      n = 0
    end if
    allocate (table(rows, n))
    table = 0
    table(1:2, :) = reshape(card%number(4:3 + 2*n), [2, n])
  end subroutine read_pairs

  !> FUNCTION name EXPR {expression in t}
  subroutine read_formula(card, draft)
    type(card_t), intent(in) :: card
    type(draft_t), intent(inout) :: draft
    type(function_t) :: function
    character(len=:), allocatable :: word
    logical :: ok
    integer :: k

    word = card%word(4)
    ok = word(1:1) == "{" .and. index(word, "}") == len(word)
    if (.not. ok) then
      call draft%report%add_error(card%place(4), "an expression in t between braces expected", &
                                  "FUNCTION wave EXPR {sin(2*pi*t)}")
    else
      draft%scope = scope_t(has_t=.true.)
      call formula_of(word, card%place(4), draft, function%formula, ok)
      draft%scope = scope_t()
      if (ok) call check_constant(card, draft, function%formula, ok)
    end if
    function%kind = function_formula
    call define_name(card, 2, draft%report, draft%functions, ok, k)
    if (k > 0) call put(card, draft, k, function)
  end subroutine read_formula

  !> An expression without t must have a finite value.
  subroutine check_constant(card, draft, program, ok)
    type(card_t), intent(in) :: card
    type(draft_t), intent(inout) :: draft
    type(formula_t), intent(in) :: program
    logical, intent(out) :: ok

    ok = any(program%code(:program%steps) == push_variable)
    if (.not. ok) ok = ieee_is_finite(formula_value(program, 0.0_wp))
    if (.not. ok) call draft%report%add_error(card%place(4), "the expression has no finite value")
  end subroutine check_constant

  subroutine store(card, draft, kind, parameter, table)
    type(card_t), intent(in) :: card
    type(draft_t), intent(inout) :: draft
    integer, intent(in) :: kind
    real(wp), intent(in), optional :: parameter(:), table(:, :)
    type(function_t) :: function
    integer :: k

    function%kind = kind
    if (present(parameter)) function%parameter(:size(parameter)) = parameter
    if (present(table)) function%table = table
    call define_name(card, 2, draft%report, draft%functions, .true., k)
    if (k > 0) call put(card, draft, k, function)
  end subroutine store

  subroutine put(card, draft, k, function)
    type(card_t), intent(in) :: card
    type(draft_t), intent(inout) :: draft
    integer, intent(in) :: k
    type(function_t), intent(in) :: function

    call grow(draft%model%function, k)
    draft%model%function(k) = function
    draft%model%function(k)%name = card%word(2)
    draft%model%function(k)%place = card%place(2)
  end subroutine put

end module deck_function_cards
