!> Values of words: numbers, whole numbers, ids, and the lists of nodes and elements.
module deck_values
  use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
  use kinds, only: wp
  use text, only: quoted, upper
  use diagnostics, only: place_t
  use formula, only: formula_t, formula_value
  use lookup_tables, only: longest_name
  use deck_card, only: card_t
  use deck_usage, only: kind_id, kind_node, kind_element, kind_count, kind_mode, kind_place, &
                        kind_real, kind_word
  use deck_draft, only: draft_t, selection_t, select_all, select_name, select_range
  use deck_expression, only: compile_expression, problem_t
  use deck_settings, only: is_identifier
  use deck_number, only: parse_number, parse_digits, number_ok, number_too_large
  implicit none
  private

  public :: evaluate_card, read_number, read_range, read_id, formula_of, add_list, is_braced

  integer, parameter :: largest_id = 999999999

contains

  !> Evaluate the words of a card; `card%kind` says what they must be. The card's own id is
  !> `draft%scope%i` where it is a range.
  subroutine evaluate_card(card, draft, ok)
    type(card_t), intent(inout) :: card
    type(draft_t), intent(inout) :: draft
    logical, intent(inout) :: ok
    logical :: word_ok
    integer :: w

    do w = 2, card%words
      word_ok = .true.
      associate (word => card%text(card%first(w):card%last(w)))
        select case (card%kind(w))
        case (kind_id)
          card%whole(w) = draft%scope%i
        case (kind_node, kind_element)
          call read_id(word, card%place(w), draft, card%whole(w), card%part(w), word_ok)
        case (kind_count)
          call read_whole(word, card%place(w), draft, card%whole(w), word_ok)
        case (kind_mode)
          call read_mode(word, card%place(w), draft, card%whole(w), word_ok)
        case (kind_place)
          card%whole(w) = merge(1, 0, upper(word) == "POINT")
          if (card%whole(w) == 0) then
            call read_number(word, card%place(w), draft, card%number(w), word_ok)
          end if
        case (kind_real)
          call read_number(word, card%place(w), draft, card%number(w), word_ok)
        case (kind_word)
          word_ok = card%last(w) - card%first(w) < longest_name .and. len(card%word(w)) > 0
          if (.not. word_ok) call draft%report%add_error(card%place(w), &
                                                   "a name has 1 to 64 characters")
        case default  ! has no value
        end select
      end associate
      ok = ok .and. word_ok
    end do
  end subroutine evaluate_card

  !> A number, or an expression between braces.
  subroutine read_number(word, place, draft, value, ok)
    character(len=*), intent(in) :: word
    type(place_t), intent(in) :: place
    type(draft_t), intent(inout) :: draft
    real(wp), intent(out) :: value
    logical, intent(inout) :: ok
    integer :: status

    if (is_braced(word)) then
      call read_expression(word, place, draft, value, ok)
      return
    end if
    call parse_number(word, value, status)
    if (status == number_ok) return
    ok = .false.
    if (status == number_too_large) then
      call draft%report%add_error(place, quoted(word)//" is too large")
    else
      call draft%report%add_error(place, quoted(word)//" is not a number", number_hint(word, draft))
    end if
  end subroutine read_number

  function number_hint(word, draft) result(hint)
    character(len=*), intent(in) :: word
    type(draft_t), intent(in) :: draft
    character(len=:), allocatable :: hint

    hint = ""
    if (index(word, ",") > 0) then
      hint = "a decimal point, and blanks between numbers"
    else if (draft%settings%table%find(word) > 0) then
      hint = "write {"//word//"}"
    else if (scan(word, "*/+-^(") > 1) then
      hint = "expressions stand between braces: {...}"
    end if
  end function number_hint

  pure logical function is_braced(word)
    character(len=*), intent(in) :: word

    is_braced = .false.
    if (len(word) < 2) return
    is_braced = word(1:1) == "{" .and. index(word, "}") == len(word)
  end function is_braced

  !> The value of an expression that must have one.
  subroutine read_expression(word, place, draft, value, ok)
    character(len=*), intent(in) :: word
    type(place_t), intent(in) :: place
    type(draft_t), intent(inout) :: draft
    real(wp), intent(out) :: value
    logical, intent(inout) :: ok
    type(formula_t) :: program

    value = 0.0_wp
    call formula_of(word, place, draft, program, ok)
    if (.not. ok) return
    value = formula_value(program, 0.0_wp)
    if (ieee_is_finite(value)) return
    ok = .false.
    value = 0.0_wp
    call draft%report%add_error(place, "the expression has no finite value")
  end subroutine read_expression

  !> The program of an expression between braces.
  subroutine formula_of(word, place, draft, program, ok)
    character(len=*), intent(in) :: word
    type(place_t), intent(in) :: place
    type(draft_t), intent(inout) :: draft
    type(formula_t), intent(out) :: program
    logical, intent(inout) :: ok
    type(problem_t) :: problem
    type(place_t) :: here

    call compile_expression(word(2:len(word) - 1), draft%settings, draft%scope, program, problem)
    if (.not. allocated(problem%message)) return
    ok = .false.
    here = place
    here%column = place%column + problem%at
    here%width = problem%width
    call draft%report%add_error(here, problem%message, problem%hint)
  end subroutine formula_of

  !> A whole number, not negative, or an expression with such a value.
  subroutine read_whole(word, place, draft, value, ok)
    character(len=*), intent(in) :: word
    type(place_t), intent(in) :: place
    type(draft_t), intent(inout) :: draft
    integer, intent(out) :: value
    logical, intent(inout) :: ok
    real(wp) :: number
    logical :: good

    good = .true.
    if (is_braced(word)) then
      call read_expression(word, place, draft, number, good)
      ok = ok .and. good
      if (.not. good) return
      value = -1
      if (abs(number) <= largest_id) then
        if (abs(number - anint(number)) <= 1.0e-9_wp*max(1.0_wp, abs(number))) value = nint(number)
      end if
    else
      call parse_digits(word, value)
    end if
    if (value >= 0 .and. value <= largest_id) return
    ok = .false.
    if (value > largest_id) then
      call draft%report%add_error(place, quoted(word)//" is too large")
    else
      call draft%report%add_error(place, quoted(word)//" is not a whole number")
    end if
  end subroutine read_whole

  subroutine read_mode(word, place, draft, mode, ok)
    character(len=*), intent(in) :: word
    type(place_t), intent(in) :: place
    type(draft_t), intent(inout) :: draft
    integer, intent(out) :: mode
    logical, intent(inout) :: ok

    call read_whole(word, place, draft, mode, ok)
    if (.not. ok .or. (mode >= 1 .and. mode <= 8)) return
    ok = .false.
    call draft%report%add_error(place, "modes are 1 to 8 at most, not "//word)
  end subroutine read_mode

  !> An id `5`, or a part of an element or one of its inner nodes, `5.2`.
  subroutine read_id(word, place, draft, id, part, ok)
    character(len=*), intent(in) :: word
    type(place_t), intent(in) :: place
    type(draft_t), intent(inout) :: draft
    integer, intent(out) :: id, part
    logical, intent(inout) :: ok
    integer :: dot
    logical :: good

    part = 0
    good = .true.
    dot = position_outside(word, ".")
    call read_whole(word(:dot - 1), shifted(place, 0, dot - 1), draft, id, good)
    if (good .and. dot <= len(word)) then
      call read_whole(word(dot + 1:), shifted(place, dot, len(word) - dot), draft, part, good)
    end if
    if (good .and. (id < 1 .or. (part < 1 .and. dot <= len(word)))) then
      good = .false.
      call draft%report%add_error(place, quoted(word)//" is not an id", "ids count from 1")
    end if
    ok = ok .and. good
  end subroutine read_id

  !> Where a sign stands outside of braces; one past the end if nowhere.
  pure integer function position_outside(word, sign) result(at)
    character(len=*), intent(in) :: word, sign
    integer :: depth

    depth = 0
    do at = 1, len(word)
      if (word(at:at) == "{") depth = depth + 1
      if (word(at:at) == "}") depth = depth - 1
      if (depth == 0 .and. word(at:at) == sign) return
    end do
  end function position_outside

  pure type(place_t) function shifted(place, by, width)
    type(place_t), intent(in) :: place
    integer, intent(in) :: by, width

    shifted = place_t(place%file, place%line, place%column + by, max(1, width))
  end function shifted

  !> `5`, `a:b` or `a:b:s`, of ids or of the parts of one element.
  subroutine read_range(word, place, draft, range, ok)
    character(len=*), intent(in) :: word
    type(place_t), intent(in) :: place
    type(draft_t), intent(inout) :: draft
    type(selection_t), intent(out) :: range
    logical, intent(inout) :: ok
    integer :: from, colon, n, id(3), part(3)

    from = 1
    id = 1
    part = 0
    range%place = place
    do n = 1, 3
      colon = position_outside(word(from:), ":")
      associate (piece => word(from:from + colon - 2), here => shifted(place, from - 1, colon - 1))
        if (n < 3) call read_id(piece, here, draft, id(n), part(n), ok)
        if (n == 3) call read_step(piece, here, draft, id(n), ok)
      end associate
      from = from + colon
      if (.not. ok .or. from > len(word) + 1) exit
    end do
    if (.not. ok) return
    if (from <= len(word) + 1) n = 4
    range%is_range = n > 1
    if (n == 1) id(2) = id(1)
    if (n == 1) part(2) = part(1)
    if (n == 4 .or. (part(1) > 0 .neqv. part(2) > 0) .or. (part(1) > 0 .and. id(1) /= id(2))) then
      call draft%report%add_error(place, quoted(word)//" is not a range", "ranges are a:b or a:b:s")
      ok = .false.
      return
    end if
    if (part(1) > 0) range%id = id(1)
    range%first = merge(part(1), id(1), part(1) > 0)
    range%last = merge(part(2), id(2), part(1) > 0)
    range%step = id(3)
    if ((range%last - range%first)*sign(1, range%step) >= 0) return
    call draft%report%add_error(place, "the range "//quoted(word)//" is empty")
    ok = .false.
  end subroutine read_range

  !> The step of a range: a whole number other than 0.
  subroutine read_step(word, place, draft, step, ok)
    character(len=*), intent(in) :: word
    type(place_t), intent(in) :: place
    type(draft_t), intent(inout) :: draft
    integer, intent(out) :: step
    logical, intent(inout) :: ok
    integer :: from

    from = 1
    step = 0
    if (index(word, "-") == 1) from = 2
    call read_whole(word(from:), place, draft, step, ok)
    if (ok .and. step == 0) then
      call draft%report%add_error(place, "the step of a range cannot be 0")
      ok = .false.
    end if
    if (from == 2) step = -step
  end subroutine read_step

  !> What a list word selects: ALL, a name, an id or a range.
  subroutine add_list(card, w, draft, selection, ok)
    type(card_t), intent(in) :: card
    integer, intent(in) :: w
    type(draft_t), intent(inout) :: draft
    type(selection_t), intent(out) :: selection
    logical, intent(inout) :: ok
    character(len=:), allocatable :: word

    word = card%word(w)
    if (upper(word) == "ALL") then
      selection%kind = select_all
    else if (is_identifier(word)) then
      selection%kind = select_name
      call draft%labels%refer(word, card%place(w), selection%name)
    else
      call read_range(word, card%place(w), draft, selection, ok)
    end if
    selection%place = card%place(w)
  end subroutine add_list

end module deck_values
