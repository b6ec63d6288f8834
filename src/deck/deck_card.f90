!> One card of a deck: a logical line split into words that know their place.
!>
!> `#`, `%`, `;` and `!` start a comment, a trailing `&` continues the card, `"..."` and `{...}`
!> belong to one word whatever they contain.
module deck_card
  use kinds, only: wp
  use diagnostics, only: place_t
  implicit none
  private

  public :: card_t, next_card

  character(len=*), parameter :: comment_signs = "#%;!"
  integer, parameter, public :: most_options = 24

  !> A card; its arrays are kept and reused from card to card.
  type :: card_t
    integer :: words = 0                     !< number of words, the keyword first
    logical :: replaced = .false.            !< some words now stand behind the typed text
    integer :: file = 0                      !< file number of the report
    character(len=:), allocatable :: text    !< from the first word to the last, as typed
    integer, allocatable :: first(:)         !< where in `text` each word starts
    integer, allocatable :: last(:)          !< where it ends
    integer, allocatable :: line(:)          !< line of each word
    integer, allocatable :: column(:)        !< column where it starts
    integer, allocatable :: kind(:)          !< what it must be, `kind_*` of deck_usage
    real(wp), allocatable :: number(:)       !< its value, if a number
    integer, allocatable :: whole(:)         !< its value, if a whole number, an id, a choice
    integer, allocatable :: part(:)          !< the 2 of an id `5.2`
    integer :: positional = 0                !< number of positional arguments
    integer :: option(most_options) = 0      !< word of each option of the keyword; 0: not given
    character(len=:), allocatable :: problem !< what is wrong with its form, if anything
    type(place_t) :: problem_place
  contains
    procedure :: word
    procedure :: is_quoted
    procedure :: place
    procedure :: raw
    procedure :: replace
  end type card_t

contains

  !> The next card of a file's text, from position `at` in line `line`; no words at the end.
  subroutine next_card(text, at, line, card)
    character(len=*), intent(in) :: text
    integer, intent(inout) :: at, line
    type(card_t), intent(inout) :: card
    logical :: more
    integer :: n

    card%words = 0
    card%replaced = .false.
    if (allocated(card%problem)) deallocate (card%problem)
    more = .false.
    do while (at <= len(text) .and. (more .or. card%words == 0))
      call split_line(text, at, line, card, more)
    end do
    n = card%words
    if (more .and. at > len(text) .and. n > 0 .and. .not. allocated(card%problem)) then
      card%problem = "the file ends after a '&'"
      card%problem_place = card%place(n)
    end if
    if (n == 0) return
    card%text = text(card%first(1):card%last(n))
    card%last(:n) = card%last(:n) - card%first(1) + 1
    card%first(:n) = card%first(:n) - card%first(1) + 1
  end subroutine next_card

  !> Add the words of one line; `more` says whether the card goes on after it.
  subroutine split_line(text, at, line, card, more)
    character(len=*), intent(in) :: text
    integer, intent(inout) :: at, line
    type(card_t), intent(inout) :: card
    logical, intent(inout) :: more
    integer :: start, before, n

    start = at
    before = card%words
    do while (at <= len(text))
      if (text(at:at) == achar(10) .or. index(comment_signs, text(at:at)) > 0) exit
      if (is_blank(text(at:at))) then
        at = at + 1
      else
        call add_word(text, at, line, start, card)
      end if
    end do
    n = index(text(at:), achar(10))
    at = merge(at + n, len(text) + 1, n > 0)
    line = line + 1
    n = card%words
    if (n == before) return
    more = text(card%last(n):card%last(n)) == "&"
    if (.not. more) return
    card%last(n) = card%last(n) - 1
    if (card%last(n) < card%first(n)) card%words = n - 1
  end subroutine split_line

  !> Add the word at `at` and move behind it.
  subroutine add_word(text, at, line, start, card)
    character(len=*), intent(in) :: text
    integer, intent(inout) :: at
    integer, intent(in) :: line, start
    type(card_t), intent(inout) :: card
    integer :: n, length
    character(len=1) :: closing

    call reserve_words(card)
    n = card%words + 1
    card%words = n
    card%first(n) = at
    card%line(n) = line
    card%column(n) = at - start + 1
    do while (at <= len(text))
      if (is_blank(text(at:at)) .or. index(comment_signs, text(at:at)) > 0) exit
      if (text(at:at) == achar(10)) exit
      if (text(at:at) == '"' .or. text(at:at) == "{") then
        closing = merge('"', "}", text(at:at) == '"')
        length = scan(text(at + 1:), closing//achar(10))
        if (length > 0) then
          if (text(at + length:at + length) /= closing) length = 0
        end if
        if (length == 0) then
          call complain(card, place_t(card%file, line, at - start + 1, 1), &
                        "no closing "//closing//" on this line")
          length = scan(text(at + 1:)//achar(10), achar(10)) - 1
        end if
        at = at + length
      end if
      at = at + 1
    end do
    card%last(n) = at - 1
  end subroutine add_word

  !> Note the first problem of a card.
  subroutine complain(card, place, message)
    type(card_t), intent(inout) :: card
    type(place_t), intent(in) :: place
    character(len=*), intent(in) :: message

    if (allocated(card%problem)) return
    card%problem = message
    card%problem_place = place
  end subroutine complain

  pure logical function is_blank(c)
    character(len=1), intent(in) :: c

    is_blank = ichar(c) <= 32 .and. c /= achar(10)
  end function is_blank

  !> Room for one more word.
  subroutine reserve_words(card)
    type(card_t), intent(inout) :: card
    integer :: n

    if (.not. allocated(card%first)) then
      allocate (card%first(16), card%last(16), card%line(16), card%column(16))
      allocate (card%kind(16), card%number(16), card%whole(16), card%part(16))
    end if
    n = size(card%first)
    if (card%words < n) return
    call double(card%first)
    call double(card%last)
    call double(card%line)
    call double(card%column)
    deallocate (card%kind, card%number, card%whole, card%part)
    allocate (card%kind(2*n), card%number(2*n), card%whole(2*n), card%part(2*n))
  end subroutine reserve_words

  subroutine double(array)
    integer, allocatable, intent(inout) :: array(:)
    integer, allocatable :: more(:)

    allocate (more(2*size(array)))
    more(:size(array)) = array
    call move_alloc(more, array)
  end subroutine double

  !> The i-th word; quotes around it are taken off.
  pure function word(self, i)
    class(card_t), intent(in) :: self
    integer, intent(in) :: i
    character(len=:), allocatable :: word

    if (self%is_quoted(i)) then
      word = self%text(self%first(i) + 1:self%last(i) - 1)
    else
      word = self%text(self%first(i):self%last(i))
    end if
  end function word

  pure logical function is_quoted(self, i)
    class(card_t), intent(in) :: self
    integer, intent(in) :: i

    is_quoted = .false.
    if (self%last(i) <= self%first(i)) return
    is_quoted = self%text(self%first(i):self%first(i)) == '"' .and. &
                self%text(self%last(i):self%last(i)) == '"'
  end function is_quoted

  !> Where the i-th word stands.
  pure type(place_t) function place(self, i)
    class(card_t), intent(in) :: self
    integer, intent(in) :: i

    place = place_t(self%file, self%line(i), self%column(i), self%last(i) - self%first(i) + 1)
  end function place

  !> Let another text stand for the i-th word; its place stays.
  pure subroutine replace(self, i, text)
    class(card_t), intent(inout) :: self
    integer, intent(in) :: i
    character(len=*), intent(in) :: text

    self%first(i) = len(self%text) + 1
    self%text = self%text//text
    self%last(i) = len(self%text)
    self%replaced = .true.
  end subroutine replace

  !> The words from the i-th to the last, separated by single blanks where a line ends.
  pure function raw(self, i) result(phrase)
    class(card_t), intent(in) :: self
    integer, intent(in) :: i
    character(len=:), allocatable :: phrase
    integer :: j

    phrase = ""
    if (i == self%words) phrase = self%word(i)
    if (i >= self%words) return
    phrase = self%text(self%first(i):self%last(i))
    do j = i + 1, self%words
      if (self%line(j) == self%line(j - 1) .and. .not. self%replaced) then
        phrase = phrase//self%text(self%last(j - 1) + 1:self%last(j))
      else
        phrase = phrase//" "//self%text(self%first(j):self%last(j))
      end if
    end do
  end function raw

end module deck_card
