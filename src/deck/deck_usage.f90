!> The usage of a keyword, written as text in the keyword table, taken apart.
!>
!> Forms are separated by `|`; an argument is `name:kind`, with `?` if it may be left out and `*` or
!> `+` if it may be repeated; an argument without kind is a word to be written as it stands.
!> Options are separated by `|`: `NAME value:kind ...`, with `=default` or `!` (required) at the
!> end. A kind is one of `kind_names`, a dimension such as `F*L^-2` or `1` (a real number), or
!> alternatives `ON/OFF`.
module deck_usage
  use deck_card, only: most_options
  implicit none
  private

  public :: argument_t, form_t, option_t, usage_t, parse_usage

  integer, parameter, public :: kind_option = 0, kind_id = 1, kind_node = 2, kind_element = 3, &
    kind_nodes = 4, kind_elements = 5, kind_word = 6, kind_count = 7, kind_mode = 8, &
    kind_component = 9, kind_text = 10, kind_place = 11, kind_real = 12, kind_choice = 13, &
    kind_literal = 14
  character(len=9), parameter :: kind_names(11) = &
    ["id       ", "node     ", "element  ", "nodes    ", "elements ", "word     ", "count    ", &
     "mode     ", "component", "text     ", "place    "]

  type :: argument_t
    character(len=16) :: name = ""
    integer :: kind = kind_text
    character(len=40) :: unit = ""     !< dimension of a real, alternatives of a choice
  end type argument_t

  !> One way to write the positional arguments.
  type :: form_t
    integer :: arguments = 0
    integer :: least = 0               !< fewest words
    logical :: repeats = .false.       !< the last argument may be repeated
    type(argument_t) :: argument(12)
  end type form_t

  type :: option_t
    character(len=12) :: name = ""
    integer :: values = 0
    type(argument_t) :: value(3)
    character(len=24) :: default = ""
    logical :: required = .false.
  end type option_t

  !> What may follow a keyword.
  type :: usage_t
    character(len=16) :: name = ""     !< the keyword
    integer :: literal = 0             !< which argument is a word to be written as it stands
    integer :: lead = 0                !< arguments in front that are words or lists
    type(form_t), allocatable :: form(:)
    type(option_t), allocatable :: option(:)
  end type usage_t

contains

  !> Take the usage text of a keyword apart.
  subroutine parse_usage(name, forms, options, usage)
    character(len=*), intent(in) :: name, forms, options
    type(usage_t), intent(out) :: usage
    integer :: i, n, at, end_at

    usage%name = name
    n = 1 + count_of(forms, "|")
    allocate (usage%form(n))
    at = 1
    do i = 1, n
      end_at = at + index(forms(at:)//"|", "|") - 2
      call parse_form(forms(at:end_at), usage%form(i))
      at = end_at + 2
    end do
    n = 0
    if (options /= "") n = 1 + count_of(options, "|")
    allocate (usage%option(n))
    at = 1
    do i = 1, min(n, most_options)
      end_at = at + index(options(at:)//"|", "|") - 2
      call parse_option(options(at:end_at), usage%option(i))
      at = end_at + 2
    end do
    associate (form => usage%form(1))
      do i = 1, form%arguments
        if (form%argument(i)%kind == kind_literal) usage%literal = i
        if (.not. is_lead(form%argument(i)%kind)) exit
        usage%lead = i
      end do
    end associate
  end subroutine parse_usage

  !> Arguments that are taken as they come; the others must look like numbers.
  pure logical function is_lead(kind)
    integer, intent(in) :: kind

    is_lead = any(kind == [kind_nodes, kind_elements, kind_word, kind_text, kind_literal, &
                           kind_component])
  end function is_lead

  subroutine parse_form(text, form)
    character(len=*), intent(in) :: text
    type(form_t), intent(out) :: form
    character(len=:), allocatable :: word, rest

    rest = trim(adjustl(text))
    do while (rest /= "")
      call split_off(rest, word)
      form%arguments = form%arguments + 1
      form%least = form%least + 1
      form%repeats = scan(word, "*+", back=.true.) == len(word)
      if (scan(word, "?*", back=.true.) == len(word)) form%least = form%least - 1
      if (scan(word, "?*+", back=.true.) == len(word)) word = word(:len(word) - 1)
      call parse_argument(word, form%argument(form%arguments))
    end do
  end subroutine parse_form

  subroutine parse_option(text, option)
    character(len=*), intent(in) :: text
    type(option_t), intent(out) :: option
    character(len=:), allocatable :: word, rest
    integer :: equals

    rest = trim(adjustl(text))
    option%required = index(rest, "!") > 0
    if (option%required) rest = rest(:index(rest, "!") - 1)
    equals = index(rest, "=")
    if (equals > 0) then
      option%default = rest(equals + 1:)
      rest = rest(:equals - 1)
    end if
    call split_off(rest, word)
    option%name = word
    do while (rest /= "")
      call split_off(rest, word)
      option%values = option%values + 1
      call parse_argument(word, option%value(option%values))
    end do
  end subroutine parse_option

  subroutine parse_argument(word, argument)
    character(len=*), intent(in) :: word
    type(argument_t), intent(out) :: argument
    integer :: colon, i

    colon = index(word, ":")
    argument%kind = kind_literal
    argument%name = word
    if (colon == 0) return
    argument%name = word(:colon - 1)
    do i = 1, size(kind_names)
      if (kind_names(i) /= word(colon + 1:)) cycle
      argument%kind = i
      return
    end do
    argument%unit = word(colon + 1:)
    argument%kind = merge(kind_choice, kind_real, index(argument%unit, "/") > 0)
  end subroutine parse_argument

  !> Take the first word off a phrase.
  subroutine split_off(rest, word)
    character(len=:), allocatable, intent(inout) :: rest
    character(len=:), allocatable, intent(out) :: word
    integer :: blank

    blank = index(rest//" ", " ")
    word = rest(:blank - 1)
    rest = adjustl(rest(min(blank, len(rest) + 1):))
    rest = trim(rest)
  end subroutine split_off

  pure integer function count_of(text, sign)
    character(len=*), intent(in) :: text
    character(len=1), intent(in) :: sign
    integer :: i

    count_of = 0
    do i = 1, len(text)
      if (text(i:i) == sign) count_of = count_of + 1
    end do
  end function count_of

end module deck_usage
