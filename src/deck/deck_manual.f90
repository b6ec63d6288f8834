!> The keyword table for people: `spar keywords` and the keyword part of the manual.
module deck_manual
  use text, only: upper, joined, nearest_word
  use deck_handler, only: keyword_t
  use deck_keywords, only: keywords
  use deck_wording, only: alternatives, form_text
  use deck_usage, only: usage_t, argument_t, parse_usage, kind_real, kind_choice, &
                        kind_id, kind_node, kind_element, kind_nodes, kind_elements, kind_count, &
                        kind_mode, kind_component, kind_literal
  implicit none
  private

  public :: list_keywords, describe_keyword, keywords_markdown

contains

  !> One line per keyword: its name and what it is for.
  subroutine list_keywords(unit)
    integer, intent(in) :: unit
    type(keyword_t), allocatable :: table(:)
    character(len=20) :: name
    integer :: i

    allocate (table, source=keywords())
    do i = 1, size(table)
      name = title(table(i))
      write (unit, "(a)") name//first_clause(trim(table(i)%help))
    end do
    write (unit, "(/, a)") "spar keywords KEYWORD shows one in full, with an example."
  end subroutine list_keywords

  !> A keyword and, of one with variants, the word that tells them apart: `SECTION C`.
  function title(keyword)
    type(keyword_t), intent(in) :: keyword
    character(len=:), allocatable :: title
    type(usage_t) :: usage

    call parse_usage(keyword%name, keyword%forms, keyword%options, usage)
    title = trim(keyword%name)
    if (usage%literal > 0) then
      title = title//" "//trim(usage%form(1)%argument(usage%literal)%name)
    end if
  end function title

  !> A help text up to its first full stop, semicolon or colon.
  pure function first_clause(help) result(clause)
    character(len=*), intent(in) :: help
    character(len=:), allocatable :: clause
    character(len=2), parameter :: ends(3) = ["; ", ". ", ": "]
    integer :: stop_at, i

    stop_at = len(help)
    do i = 1, size(ends)
      if (index(help, ends(i)) > 0) stop_at = min(stop_at, index(help, ends(i)) - 1)
    end do
    clause = help(:stop_at)
  end function first_clause

  !> Everything about one keyword; `found` is false if there is none, `near` the one meant.
  subroutine describe_keyword(unit, name, found, near)
    integer, intent(in) :: unit
    character(len=*), intent(in) :: name
    logical, intent(out) :: found
    character(len=:), allocatable, intent(out), optional :: near
    type(keyword_t), allocatable :: table(:)
    integer :: i

    allocate (table, source=keywords())
    found = .false.
    do i = 1, size(table)
      if (table(i)%name /= upper(name)) cycle
      if (found) write (unit, "(a)")
      found = .true.
      call describe(unit, table(i))
    end do
    if (present(near)) near = nearest_word(name, table%name)
  end subroutine describe_keyword

  subroutine describe(unit, keyword)
    integer, intent(in) :: unit
    type(keyword_t), intent(in) :: keyword
    type(usage_t) :: usage
    type(argument_t), allocatable :: arguments(:)
    integer :: i

    call parse_usage(keyword%name, keyword%forms, keyword%options, usage)
    do i = 1, size(usage%form)
      write (unit, "(a)") form_text(usage, i, with_options=.true.)
    end do
    write (unit, "(4x, a)") trim(keyword%name)//" "//trim(keyword%help)//"."
    allocate (arguments, source=arguments_of(usage))
    do i = 1, size(arguments)
      write (unit, "(4x, a)") arguments(i)%name//kind_text(arguments(i))
    end do
    do i = 1, size(usage%option)
      write (unit, "(4x, a)") option_line(usage, i)
    end do
    if (keyword%spacar /= "") write (unit, "(4x, a)") "SPACAR: "//trim(keyword%spacar)
    write (unit, "(a)") "  example:"
    call write_example(unit, keyword%example, "    ")
  end subroutine describe

  !> The arguments of all forms, each name once.
  pure function arguments_of(usage) result(arguments)
    type(usage_t), intent(in) :: usage
    type(argument_t), allocatable :: arguments(:)
    integer :: i, k

    allocate (arguments(0))
    do i = 1, size(usage%form)
      do k = 1, usage%form(i)%arguments
        associate (argument => usage%form(i)%argument(k))
          if (.not. any(arguments%name == argument%name)) arguments = [arguments, argument]
        end associate
      end do
    end do
  end function arguments_of

  !> What an argument must be, in words.
  function kind_text(argument) result(phrase)
    type(argument_t), intent(in) :: argument
    character(len=:), allocatable :: phrase

    select case (argument%kind)
    case (kind_real)
      phrase = "number"//dimension_text(argument%unit)
    case (kind_choice)
      phrase = alternatives(trim(argument%unit))
    case (kind_id)
      phrase = "the card's own id, or a range a:b or a:b:s"
    case (kind_node)
      phrase = "node"
    case (kind_element)
      phrase = "element"
    case (kind_nodes)
      phrase = "list of nodes: id, a:b, a:b:s, ALL or a group"
    case (kind_elements)
      phrase = "list of elements: id, a:b, a:b:s, ALL or a group"
    case (kind_count)
      phrase = "whole number"
    case (kind_mode)
      phrase = "mode, 1 to 8"
    case (kind_component)
      phrase = "X Y Z RX RY RZ W, or SPACAR's number"
    case (kind_literal)
      phrase = "the word itself"
    case default
      phrase = "word"
    end select
  end function kind_text

  !> ` [F L^-2]`; nothing for a number without dimension.
  pure function dimension_text(unit) result(phrase)
    character(len=*), intent(in) :: unit
    character(len=:), allocatable :: phrase
    integer :: i

    phrase = ""
    if (unit == "1") return
    phrase = " ["//trim(unit)//"]"
    do i = 1, len(phrase)
      if (phrase(i:i) == "*") phrase(i:i) = " "
    end do
  end function dimension_text

  !> `E e         number [F L^-2], required`.
  function option_line(usage, k) result(line)
    type(usage_t), intent(in) :: usage
    integer, intent(in) :: k
    character(len=:), allocatable :: line, name, kind
    character(len=20) :: column
    integer :: i

    associate (option => usage%option(k))
      name = trim(option%name)
      kind = ""
      do i = 1, option%values
        name = name//" "//trim(option%value(i)%name)
        if (kind == kind_text(option%value(i))) cycle
        kind = joined(kind, ", ", kind_text(option%value(i)))
      end do
      select case (option%name)
      case ("AT")
        kind = "numbers [L], or POINT and the number of a section's point"
      case ("DISPLACEMENT", "STOP")
        kind = "node or marker, X Y Z RX RY RZ W or SPACAR's number, number [L, 1 or L^-1]"
      case default
      end select
      if (option%required) kind = joined(kind, ", ", "required")
      if (option%default /= "") kind = joined(kind, ", ", "default "//trim(option%default))
      column = name
      line = trim(column//"  "//kind)
      if (len(name) > len(column)) line = trim(name//"  "//kind)
    end associate
  end function option_line

  !> The cards of an example, one a line.
  subroutine write_example(unit, example, indent)
    integer, intent(in) :: unit
    character(len=*), intent(in) :: example, indent
    integer :: at, bar

    at = 1
    do while (at <= len_trim(example))
      bar = index(example(at:), "|")
      if (bar == 0) bar = len_trim(example) - at + 2
      write (unit, "(a)") indent//example(at:at + bar - 2)
      at = at + bar
    end do
  end subroutine write_example

  !> The keyword chapter of the manual: an index, then every keyword.
  subroutine keywords_markdown(unit)
    integer, intent(in) :: unit
    type(keyword_t), allocatable :: table(:)
    integer :: i

    allocate (table, source=keywords())
    write (unit, "(a)") "| keyword | | may stand |", "|---|---|---|"
    do i = 1, size(table)
      write (unit, "(a)") "| ["//title(table(i))//"](#"//anchor(title(table(i)))//") | "// &
        first_clause(trim(table(i)%help))//" | "//stage_text(trim(table(i)%stage))//" |"
    end do
    do i = 1, size(table)
      call markdown_keyword(unit, table(i))
    end do
  end subroutine keywords_markdown

  !> What a heading's link is called: small letters, hyphens for blanks.
  pure function anchor(heading)
    character(len=*), intent(in) :: heading
    character(len=len(heading)) :: anchor
    integer :: i

    anchor = heading
    do i = 1, len(heading)
      if (heading(i:i) >= "A" .and. heading(i:i) <= "Z") anchor(i:i) = &
        achar(iachar(heading(i:i)) + 32)
      if (heading(i:i) == " ") anchor(i:i) = "-"
    end do
  end function anchor

  !> Where in a deck the cards of a stage may stand.
  pure function stage_text(stage) result(phrase)
    character(len=*), intent(in) :: stage
    character(len=:), allocatable :: phrase

    phrase = "anywhere"
    if (stage == "model") phrase = "before the first analysis"
  end function stage_text

  subroutine markdown_keyword(unit, keyword)
    integer, intent(in) :: unit
    type(keyword_t), intent(in) :: keyword
    type(usage_t) :: usage
    integer :: k

    call parse_usage(keyword%name, keyword%forms, keyword%options, usage)
    write (unit, "(/, a, /)") "### "//title(keyword)
    do k = 1, size(usage%form)
      write (unit, "(a)") "    "//form_text(usage, k, with_options=.true.)
    end do
    write (unit, "(/, a)") "`"//trim(keyword%name)//"` "//trim(keyword%help)//"."
    call markdown_table(unit, usage)
    if (keyword%spacar /= "") write (unit, "(/, a)") "SPACAR: `"//trim(keyword%spacar)//"`."
    write (unit, "(/, a, /)") "Example:"
    call write_example(unit, keyword%example, "    ")
  end subroutine markdown_keyword

  subroutine markdown_table(unit, usage)
    integer, intent(in) :: unit
    type(usage_t), intent(in) :: usage
    type(argument_t), allocatable :: arguments(:)
    character(len=:), allocatable :: line
    integer :: i

    allocate (arguments, source=arguments_of(usage))
    if (size(arguments) + size(usage%option) == 0) return
    write (unit, "(/, a, /, a)") "| | |", "|---|---|"
    do i = 1, size(arguments)
      write (unit, "(a)") "| `"//trim(arguments(i)%name)//"` | "//kind_text(arguments(i))//" |"
    end do
    do i = 1, size(usage%option)
      line = option_line(usage, i)
      call split_column(line)
      write (unit, "(a)") "| "//line//" |"
    end do
  end subroutine markdown_table

  !> Put a column bar between the name and the text of an option's line.
  subroutine split_column(line)
    character(len=:), allocatable, intent(inout) :: line
    integer :: gap

    gap = index(line, "  ")
    if (gap == 0) then
      line = "`"//line//"` |"
    else
      line = "`"//line(:gap - 1)//"` | "//trim(adjustl(line(gap:)))
    end if
  end subroutine split_column

end module deck_manual
