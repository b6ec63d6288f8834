!> The numbers of a deck: [sign] digits[.digits][(e|E|d|D)[sign]digits], and nothing else.
module deck_number
  use kinds, only: wp, i8
  use text, only: to_text
  implicit none
  private

  public :: scan_number, parse_number, parse_digits

  character(len=*), parameter :: digits = "0123456789"
  integer, parameter, public :: number_ok = 0, number_malformed = 1, number_too_large = 2

  !> Powers of ten that are exact.
  integer :: power
  real(wp), parameter :: ten(0:22) = [(10.0_wp**power, power=0, 22)]

contains

  !> Index of the last character of the unsigned number that starts at `from`; 0 if none does.
  pure integer function scan_number(word, from) result(last)
    character(len=*), intent(in) :: word
    integer, intent(in) :: from
    integer :: at, mantissa

    last = 0
    at = after_digits(word, from)
    mantissa = at - from
    if (at <= len(word)) then
      if (word(at:at) == ".") then
        mantissa = mantissa + after_digits(word, at + 1) - at - 1
        at = after_digits(word, at + 1)
      end if
    end if
    if (mantissa == 0) return
    last = at - 1
    if (at >= len(word)) return
    if (index("eEdD", word(at:at)) == 0) return
    at = at + 1
    if (index("+-", word(at:at)) > 0) at = at + 1
    if (after_digits(word, at) > at) last = after_digits(word, at) - 1
  end function scan_number

  !> Index of the first character from `from` on that is no digit.
  pure integer function after_digits(word, from) result(at)
    character(len=*), intent(in) :: word
    integer, intent(in) :: from

    at = from
    do while (at <= len(word))
      if (word(at:at) < "0" .or. word(at:at) > "9") exit
      at = at + 1
    end do
  end function after_digits

  !> A word as a number.
  pure subroutine parse_number(word, value, status)
    character(len=*), intent(in) :: word
    real(wp), intent(out) :: value
    integer, intent(out) :: status
    integer :: from
    logical :: easy

    value = 0.0_wp
    status = number_malformed
    if (len(word) == 0) return
    from = 1
    if (index("+-", word(1:1)) > 0) from = 2
    if (scan_number(word, from) /= len(word)) return
    status = number_ok
    call read_easy(word(from:), value, easy)
    if (.not. easy) call read_any(word(from:), value, status)
    if (word(1:1) == "-") value = -value
  end subroutine parse_number

  !> A number of at most 15 digits times an exact power of ten: one exact step, so exactly rounded.
  pure subroutine read_easy(word, value, easy)
    character(len=*), intent(in) :: word
    real(wp), intent(out) :: value
    logical, intent(out) :: easy
    integer(i8) :: mantissa
    integer :: i, figures, places, raised, digit
    logical :: fraction

    mantissa = 0
    figures = 0
    places = 0
    fraction = .false.
    easy = .false.
    value = 0.0_wp
    raised = 0
    do i = 1, len(word)
      digit = ichar(word(i:i)) - ichar("0")
      if (word(i:i) == ".") then
        fraction = .true.
      else if (digit < 0 .or. digit > 9) then
        call parse_digits(word(i + merge(2, 1, scan(word(i + 1:i + 1), "+-") > 0):), raised)
        if (word(i + 1:i + 1) == "-") raised = -raised
        exit
      else
        if (mantissa > 0 .or. digit > 0) figures = figures + 1
        if (figures > 15) return
        mantissa = 10*mantissa + digit
        if (fraction) places = places + 1
      end if
    end do
    easy = abs(raised - places) <= 22
    if (.not. easy) return
    value = real(mantissa, wp)
    if (raised > places) value = value*ten(raised - places)
    if (raised < places) value = value/ten(places - raised)
  end subroutine read_easy

  !> Any other number, by the run-time library; what is out of range must not get there, where it
  !> would raise an exception.
  pure subroutine read_any(word, value, status)
    character(len=*), intent(in) :: word
    real(wp), intent(out) :: value
    integer, intent(out) :: status
    integer :: magnitude, stat

    status = number_ok
    value = 0.0_wp
    magnitude = decimal_magnitude(word)
    if (magnitude < -400) return
    if (magnitude <= 308) then
      read (word, "(f"//to_text(len(word))//".0)", iostat=stat) value
      if (stat /= 0) status = number_malformed
    else
      status = number_too_large
    end if
  end subroutine read_any

  !> The m of a number in [10**(m-1), 10**m).
  pure integer function decimal_magnitude(word) result(magnitude)
    character(len=*), intent(in) :: word
    integer, parameter :: limit = 100000000
    integer :: mantissa_end, point, leading, raised, at

    magnitude = -huge(1)
    mantissa_end = scan(word//"e", "eEdD") - 1
    leading = verify(word(:mantissa_end), "0.")
    if (leading == 0) return
    raised = 0
    if (mantissa_end < len(word)) then
      at = mantissa_end + 2
      if (scan(word(at:at), "+-") > 0) at = at + 1
      call parse_digits(word(at:), raised)
      raised = min(raised, limit)
      if (word(at - 1:at - 1) == "-") raised = -raised
    end if
    point = index(word(:mantissa_end)//".", ".")
    magnitude = raised + point - leading
    if (leading > point) magnitude = magnitude + 1
  end function decimal_magnitude

  !> Digits as a whole number: -1 if there is anything else, the largest integer if too large.
  pure subroutine parse_digits(word, value)
    character(len=*), intent(in) :: word
    integer, intent(out) :: value
    integer :: i, digit

    value = -1
    if (len(word) == 0 .or. verify(word, digits) > 0) return
    value = 0
    do i = 1, len(word)
      digit = ichar(word(i:i)) - ichar("0")
      if (value > (huge(value) - digit)/10) then
        value = huge(value)
        return
      end if
      value = 10*value + digit
    end do
  end subroutine parse_digits

end module deck_number
