!> Finds the row of the keyword table that a card is written by, and what each word must be.
module deck_form
  use text, only: upper, quoted, nearest_word, to_text, joined, plural
  use diagnostics, only: report_t
  use deck_card, only: card_t
  use deck_wording, only: alternatives, option_values, counts, usage_text
  use deck_usage, only: usage_t, form_t, argument_t, kind_option, kind_choice, kind_component, &
                        kind_literal, kind_real
  implicit none
  private

  public :: find_row, match_card

  character(len=*), parameter :: number_starts = "0123456789+-.{"
  character(len=2), parameter, public :: component_names(7) = &
    ["X ", "Y ", "Z ", "RX", "RY", "RZ", "W "]

contains

  !> The row for a card, 0 if there is none; `near` is the row it may have meant.
  subroutine find_row(card, usage, report, row, near)
    type(card_t), intent(in) :: card
    type(usage_t), intent(in) :: usage(:)
    type(report_t), intent(inout) :: report
    integer, intent(out) :: row, near
    character(len=:), allocatable :: name, best

    name = upper(card%word(1))
    near = first_row(usage, name)
    row = near
    if (row > 0) then
      if (usage(row)%literal > 0) call choose_variant(card, usage, report, row)
      return
    end if
    best = ""
    if (report%errors() < 1000) best = nearest_word(name, usage%name)
    if (best == "") then
      call report%add_error(card%place(1), "unknown keyword "//quoted(card%word(1)))
    else
      near = first_row(usage, best)
      call report%add_error(card%place(1), "unknown keyword "//quoted(card%word(1)), &
                            "did you mean "//best//"?")
    end if
  end subroutine find_row

  pure integer function first_row(usage, name)
    type(usage_t), intent(in) :: usage(:)
    character(len=*), intent(in) :: name
    integer :: i

    first_row = 0
    do i = 1, size(usage)
      if (usage(i)%name /= name) cycle
      first_row = i
      return
    end do
  end function first_row

  !> Among the rows of one keyword, the one whose literal word the card has.
  subroutine choose_variant(card, usage, report, row)
    type(card_t), intent(in) :: card
    type(usage_t), intent(in) :: usage(:)
    type(report_t), intent(inout) :: report
    integer, intent(inout) :: row
    character(len=16), allocatable :: literals(:)
    character(len=:), allocatable :: best, all
    integer :: at, i

    at = usage(row)%literal
    allocate (literals(count(usage%name == usage(row)%name)))
    all = ""
    do i = 1, size(literals)
      literals(i) = usage(row + i - 1)%form(1)%argument(at)%name
      if (i == size(literals)) then
        all = joined(all, " or ", trim(literals(i)))
      else
        all = joined(all, ", ", trim(literals(i)))
      end if
      if (card%words <= at) cycle
      if (upper(card%word(at + 1)) /= literals(i)) cycle
      row = row + i - 1
      return
    end do
    if (card%words <= at) then
      if (at > 1) all = "a name and "//all
      call report%add_error(card%place(1), trim(usage(row)%name)//" needs "//all)
    else
      best = nearest_word(card%word(at + 1), literals)
      if (best /= "") best = "did you mean "//best//"?"
      call report%add_error(card%place(at + 1), &
                            quoted(card%word(at + 1))//" instead of "//all, best)
    end if
    row = 0
  end subroutine choose_variant

  !> Say for each word what it must be, and where the options are.
  subroutine match_card(card, usage, report, ok)
    type(card_t), intent(inout) :: card
    type(usage_t), intent(in) :: usage
    type(report_t), intent(inout) :: report
    logical, intent(out) :: ok
    integer :: given, i

    call count_positional(card, usage, given)
    card%positional = given
    card%option = 0
    ok = .false.
    do i = 1, size(usage%form)
      if (.not. fits(usage%form(i), given)) cycle
      if (.not. agrees(card, usage%form(i))) cycle
      ok = .true.
      call match_positional(card, usage%form(i), report, ok)
      exit
    end do
    if (i > size(usage%form)) then
      call complain_about_number(card, usage, report)
    else
      call match_options(card, usage, report, ok)
    end if
  end subroutine match_card

  pure logical function fits(form, given)
    type(form_t), intent(in) :: form
    integer, intent(in) :: given

    fits = given >= form%least .and. (given <= form%arguments .or. form%repeats)
  end function fits

  !> Whether no word stands for a number that cannot be one: that tells `INPUTX 2 X Y` from
  !> `INPUTX 2 X 0.5`.
  pure logical function agrees(card, form)
    type(card_t), intent(in) :: card
    type(form_t), intent(in) :: form
    integer :: i

    agrees = .true.
    do i = 1, card%positional
      if (form%argument(min(i, form%arguments))%kind /= kind_real) cycle
      if (may_be_number(card, i + 1)) cycle
      agrees = agrees .and. component_number(card%word(i + 1)) == 0
    end do
  end function agrees

  pure logical function may_be_number(card, w)
    type(card_t), intent(in) :: card
    integer, intent(in) :: w

    may_be_number = scan(card%text(card%first(w):card%first(w)), number_starts) > 0
  end function may_be_number

  !> How many words behind the keyword are positional arguments.
  subroutine count_positional(card, usage, given)
    type(card_t), intent(in) :: card
    type(usage_t), intent(in) :: usage
    integer, intent(out) :: given
    logical :: open_end, components
    integer :: w

    open_end = usage%form(1)%repeats .and. usage%lead == usage%form(1)%arguments
    components = .false.
    do w = 2, size(usage%form)
      associate (form => usage%form(w))
        components = components .or. (form%repeats .and. &
                                      form%argument(form%arguments)%kind == kind_component)
      end associate
    end do
    given = 0
    do w = 2, card%words
      if (open_end) then
        if (w - 1 >= usage%lead .and. option_number(usage, card%word(w)) > 0) exit
      else if (w - 1 > usage%lead) then
        if (.not. (may_be_number(card, w) .or. (components .and. &
          component_number(card%word(w)) > 0))) exit
      else if (w - 1 > 1 .and. usage%literal /= w - 1) then
        if (option_number(usage, card%word(w)) > 0) exit
      end if
      given = w - 1
    end do
  end subroutine count_positional

  subroutine match_positional(card, form, report, ok)
    type(card_t), intent(inout) :: card
    type(form_t), intent(in) :: form
    type(report_t), intent(inout) :: report
    logical, intent(inout) :: ok
    integer :: i

    do i = 1, card%positional
      call match_word(card, i + 1, form%argument(min(i, form%arguments)), report, ok)
    end do
  end subroutine match_positional

  !> Record what a word must be; words that are not numbers are checked here.
  subroutine match_word(card, w, argument, report, ok)
    type(card_t), intent(inout) :: card
    integer, intent(in) :: w
    type(argument_t), intent(in) :: argument
    type(report_t), intent(inout) :: report
    logical, intent(inout) :: ok
    character(len=:), allocatable :: word, choices

    card%kind(w) = argument%kind
    select case (argument%kind)
    case (kind_choice)
      word = upper(card%word(w))
      choices = "/"//trim(argument%unit)//"/"
      card%whole(w) = index(choices, "/"//word//"/")
      if (card%whole(w) > 0) then
        card%whole(w) = 1 + count_before(choices, card%whole(w))
      else
        call report%add_error(card%place(w), quoted(card%word(w))//" instead of "// &
                              alternatives(argument%unit))
        ok = .false.
      end if
    case (kind_component)
      call match_component(card, w, report, ok)
    case default  ! numbers, ids and names are read later
    end select
  end subroutine match_word

  !> Which alternative starts behind the slash at `at`, counted from 0.
  pure integer function count_before(choices, at)
    character(len=*), intent(in) :: choices
    integer, intent(in) :: at
    integer :: i

    count_before = 0
    do i = 2, at
      if (choices(i:i) == "/") count_before = count_before + 1
    end do
  end function count_before

  !> X Y Z RX RY RZ W as 1 to 7, SPACAR's numbers 1 to 4 as their negative; else 0.
  pure integer function component_number(word)
    character(len=*), intent(in) :: word
    integer :: i

    component_number = 0
    do i = 1, size(component_names)
      if (upper(word) == component_names(i)) component_number = i
    end do
    if (len(word) == 1) component_number = component_number - index("1234", word)
  end function component_number

  subroutine match_component(card, w, report, ok)
    type(card_t), intent(inout) :: card
    integer, intent(in) :: w
    type(report_t), intent(inout) :: report
    logical, intent(inout) :: ok

    card%whole(w) = component_number(card%word(w))
    if (card%whole(w) /= 0) return
    ok = .false.
    call report%add_error(card%place(w), quoted(card%word(w))//" is not a component", &
                          "components are X Y Z RX RY RZ W, or SPACAR's numbers 1 to 4")
  end subroutine match_component

  !> The options behind the positional arguments.
  subroutine match_options(card, usage, report, ok)
    type(card_t), intent(inout) :: card
    type(usage_t), intent(in) :: usage
    type(report_t), intent(inout) :: report
    logical, intent(inout) :: ok
    integer :: w, k, i

    w = card%positional + 2
    do while (w <= card%words)
      k = option_number(usage, card%word(w))
      if (k == 0) then
        call complain_about_option(card, w, usage, report)
        ok = .false.
        return
      end if
      if (card%option(k) > 0) then
        call report%add_error(card%place(w), trim(usage%option(k)%name)//" is given twice")
        ok = .false.
      end if
      card%option(k) = w
      card%kind(w) = kind_option
      do i = 1, usage%option(k)%values
        if (w + i > card%words) then
          call report%add_error(card%place(w), trim(usage%option(k)%name)//" needs "// &
                                option_values(usage, k))
          ok = .false.
          return
        end if
        call match_word(card, w + i, usage%option(k)%value(i), report, ok)
      end do
      w = w + 1 + usage%option(k)%values
    end do
    do k = 1, size(usage%option)
      if (card%option(k) > 0 .or. .not. usage%option(k)%required) cycle
      call report%add_error(card%place(1), trim(usage%name)//" needs "// &
                            trim(usage%option(k)%name)//" "//option_values(usage, k))
      ok = .false.
    end do
  end subroutine match_options

  pure integer function option_number(usage, word) result(number)
    type(usage_t), intent(in) :: usage
    character(len=*), intent(in) :: word
    character(len=12) :: name
    integer :: i

    number = 0
    if (len(word) > len(name)) return
    name = upper(word)
    do i = 1, size(usage%option)
      if (usage%option(i)%name == name) number = i
    end do
  end function option_number

  subroutine complain_about_option(card, w, usage, report)
    type(card_t), intent(in) :: card
    integer, intent(in) :: w
    type(usage_t), intent(in) :: usage
    type(report_t), intent(inout) :: report
    character(len=:), allocatable :: best

    if (size(usage%option) == 0) then
      call report%add_error(card%place(w), "unexpected "//quoted(card%word(w)), &
                            "usage: "//usage_text(usage))
      return
    end if
    best = nearest_word(card%word(w), usage%option%name)
    if (best /= "") best = "did you mean "//best//"?"
    if (best == "") best = option_before(card, w, usage)
    call report%add_error(card%place(w), trim(usage%name)//" has no option "// &
                          quoted(card%word(w)), best)
  end subroutine complain_about_option

  !> "ALONG takes 1 value: elements", of the option before a word that is one too many.
  function option_before(card, w, usage) result(hint)
    type(card_t), intent(in) :: card
    integer, intent(in) :: w
    type(usage_t), intent(in) :: usage
    character(len=:), allocatable :: hint
    integer :: i, k

    hint = ""
    if (verify(card%word(w), "+-.:0123456789eEdD") > 0) return
    do i = w - 1, 2, -1
      k = option_number(usage, card%word(i))
      if (k == 0) cycle
      hint = trim(usage%option(k)%name)//" takes "//plural(usage%option(k)%values, "value")
      if (usage%option(k)%values > 0) hint = hint//": "//option_values(usage, k)
      return
    end do
  end function option_before

  !> Too few or too many positional arguments, unless a word in their place is to blame.
  subroutine complain_about_number(card, usage, report)
    type(card_t), intent(in) :: card
    type(usage_t), intent(in) :: usage
    type(report_t), intent(inout) :: report
    integer :: w, most

    w = card%positional + 2
    most = maxval(usage%form%arguments)
    if (w <= card%words .and. card%positional < most) then
      if (option_number(usage, card%word(w)) == 0 .and. &
          nearest_word(card%word(w), usage%option%name) == "") then
        call report%add_error(card%place(w), quoted(card%word(w))//" is not a number", &
                              "usage: "//usage_text(usage))
        return
      end if
    end if
    w = merge(most + 2, 1, card%positional > most)
    call report%add_error(card%place(w), trim(usage%name)//" takes "//counts(usage)//", "// &
                          to_text(card%positional)//" given", "usage: "//usage_text(usage))
  end subroutine complain_about_number

end module deck_form
