!> Small string helpers: numbers to words, case, a string that can live in an array.
module text
  use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
  use kinds, only: wp
  implicit none
  private

  public :: string_t, to_text, upper, lower, plural, quoted, edit_distance, nearest_word, joined

  character(len=*), parameter, public :: newline = achar(10)

  !> A string of any length, for arrays of strings.
  type :: string_t
    character(len=:), allocatable :: s
  end type string_t

  !> A number as a word without blanks. Reals: `digits` significant digits (default 6),
  !> fixed-point where that is short, else with an exponent; never "-0".
  interface to_text
    module procedure :: integer_to_text, real_to_text
  end interface to_text

contains

  pure function integer_to_text(i) result(word)
    integer, intent(in) :: i
    character(len=:), allocatable :: word
    character(len=12) :: buffer

    write (buffer, "(i0)") i
    word = trim(buffer)
  end function integer_to_text

  pure function real_to_text(x, digits) result(word)
    real(wp), intent(in) :: x
    integer, intent(in), optional :: digits
    character(len=:), allocatable :: word
    character(len=40) :: buffer, form
    integer :: n

    n = 6
    if (present(digits)) n = digits
    if (ieee_is_nan(x)) then
      word = "NaN"
      return
    end if
    if (.not. abs(x) > 0.0_wp) then
      word = "0"
      return
    end if
    if (abs(x) >= 1.0e-3_wp .and. abs(x) < 10.0_wp**n) then
      write (form, "('(f40.', i0, ')')") max(0, n - 1 - floor(log10(abs(x))))
      write (buffer, form) x
      word = without_trailing_zeros(trim(adjustl(buffer)))
    else
      write (form, "('(es40.', i0, ')')") n - 1
      write (buffer, form) x
      word = trim(adjustl(buffer))
    end if
  end function real_to_text

  !> `2.500` becomes `2.5`, `3.` becomes `3`.
  pure function without_trailing_zeros(word) result(short)
    character(len=*), intent(in) :: word
    character(len=:), allocatable :: short
    integer :: last

    last = len(word)
    if (index(word, ".") > 0) then
      last = verify(word, "0", back=.true.)
      if (word(last:last) == ".") last = last - 1
    end if
    short = word(:last)
  end function without_trailing_zeros

  !> ASCII letters in upper case.
  pure function upper(word)
    character(len=*), intent(in) :: word
    character(len=len(word)) :: upper
    integer :: i, code

    do i = 1, len(word)
      code = iachar(word(i:i))
      if (code >= iachar("a") .and. code <= iachar("z")) code = code - 32
      upper(i:i) = achar(code)
    end do
  end function upper

  !> ASCII letters in lower case.
  pure function lower(word)
    character(len=*), intent(in) :: word
    character(len=len(word)) :: lower
    integer :: i, code

    do i = 1, len(word)
      code = iachar(word(i:i))
      if (code >= iachar("A") .and. code <= iachar("Z")) code = code + 32
      lower(i:i) = achar(code)
    end do
  end function lower

  !> "1 node", "3 nodes".
  pure function plural(n, noun) result(phrase)
    integer, intent(in) :: n
    character(len=*), intent(in) :: noun
    character(len=:), allocatable :: phrase

    phrase = to_text(n)//" "//noun
    if (n /= 1) phrase = phrase//"s"
  end function plural

  !> A word in quotes for a message: at most 40 characters, without control characters.
  pure function quoted(word) result(phrase)
    character(len=*), intent(in) :: word
    character(len=:), allocatable :: phrase
    integer :: i

    phrase = word
    if (len(word) > 40) phrase = word(:37)//"..."
    do i = 1, len(phrase)
      if (iachar(phrase(i:i)) < 32) phrase(i:i) = "?"
    end do
    phrase = "'"//phrase//"'"
  end function quoted

  !> Two parts of a phrase with a separator between them, if there are two.
  pure function joined(front, separator, back) result(phrase)
    character(len=*), intent(in) :: front, separator, back
    character(len=:), allocatable :: phrase

    phrase = front//back
    if (len(front) > 0 .and. len(back) > 0) phrase = front//separator//back
  end function joined

  !> Fewest insertions, deletions, replacements and swaps of neighbours that turn one word into
  !> the other, in any case.
  pure function edit_distance(a, b) result(distance)
    character(len=*), intent(in) :: a, b
    integer :: distance
    character(len=len(a)) :: p
    character(len=len(b)) :: q
    integer :: row(0:len(b), 0:2), i, j

    p = upper(a)
    q = upper(b)
    row(:, 0) = 0
    row(:, 1) = [(j, j=0, len(b))]
    row(:, 2) = row(:, 1)
    do i = 1, len(p)
      row(0, 2) = i
      do j = 1, len(q)
        row(j, 2) = min(row(j, 1) + 1, row(j - 1, 2) + 1, &
                        row(j - 1, 1) + merge(0, 1, p(i:i) == q(j:j)))
        if (i < 2 .or. j < 2) cycle
        if (p(i:i) == q(max(j - 1, 1):j - 1) .and. p(i - 1:i - 1) == q(j:j)) then
          row(j, 2) = min(row(j, 2), row(max(j - 2, 0), 0) + 1)
        end if
      end do
      row(:, 0) = row(:, 1)
      row(:, 1) = row(:, 2)
    end do
    distance = row(len(q), 2)
  end function edit_distance

  !> The candidate that a mistyped word most likely means; empty if none is near.
  pure function nearest_word(word, candidates) result(best)
    character(len=*), intent(in) :: word, candidates(:)
    character(len=:), allocatable :: best
    integer :: i, distance, least

    best = ""
    if (len(word) > 64) return
    least = max(1, (len(word) + 1)/3) + 1
    do i = 1, size(candidates)
      if (abs(len_trim(candidates(i)) - len(word)) >= least) cycle
      distance = edit_distance(word, trim(candidates(i)))
      if (distance >= least .or. distance >= len(word)) cycle
      least = distance
      best = trim(candidates(i))
    end do
  end function nearest_word

end module text
