!> How a keyword is written, in words for messages.
module deck_wording
  use text, only: to_text, joined
  use deck_usage, only: usage_t, kind_choice
  implicit none
  private

  public :: alternatives, option_values, counts, usage_text, form_text

contains

  !> `A/B/C` as "A, B or C".
  pure function alternatives(choices) result(phrase)
    character(len=*), intent(in) :: choices
    character(len=:), allocatable :: phrase
    integer :: i, last, n

    phrase = ""
    n = len_trim(choices)
    if (choices(n:n) == "/") n = n - 1
    last = index(choices(:n), "/", back=.true.)
    do i = 1, n
      if (choices(i:i) /= "/") then
        phrase = phrase//choices(i:i)
      else if (i == last) then
        phrase = phrase//" or "
      else
        phrase = phrase//", "
      end if
    end do
  end function alternatives

  !> What stands behind an option's name.
  function option_values(usage, k) result(phrase)
    type(usage_t), intent(in) :: usage
    integer, intent(in) :: k
    character(len=:), allocatable :: phrase
    integer :: i

    phrase = ""
    do i = 1, usage%option(k)%values
      if (usage%option(k)%value(i)%kind == kind_choice) then
        phrase = joined(phrase, " ", alternatives(usage%option(k)%value(i)%unit))
      else
        phrase = joined(phrase, " ", trim(usage%option(k)%value(i)%name))
      end if
    end do
  end function option_values

  !> "3, 6, 7 or 10 values".
  function counts(usage) result(phrase)
    type(usage_t), intent(in) :: usage
    character(len=:), allocatable :: phrase
    integer :: i, n

    phrase = ""
    n = size(usage%form)
    do i = 1, n
      associate (form => usage%form(i))
        if (i > 1) phrase = phrase//trim(merge(" or", ",  ", i == n))//" "
        if (form%repeats) phrase = phrase//"at least "
        phrase = phrase//to_text(form%least)
        if (form%arguments > form%least .and. .not. form%repeats) then
          phrase = phrase//" to "//to_text(form%arguments)
        end if
      end associate
    end do
    phrase = phrase//merge(" arguments", " argument ", phrase /= "1" .and. phrase /= "at least 1")
    phrase = trim(phrase)
  end function counts

  !> How a keyword is written, all forms: `BEAM id p q [ox oy oz] [options] | BEAM ...`.
  function usage_text(usage) result(phrase)
    type(usage_t), intent(in) :: usage
    character(len=:), allocatable :: phrase
    integer :: k

    phrase = ""
    do k = 1, size(usage%form)
      if (k > 1) phrase = phrase//" | "
      phrase = phrase//form_text(usage, k, with_options=k == size(usage%form))
    end do
  end function usage_text

  !> How one form of a keyword is written, with the options that it must have: `TRANSIENT TEND t
  !> [options]`.
  function form_text(usage, k, with_options) result(phrase)
    type(usage_t), intent(in) :: usage
    integer, intent(in) :: k
    logical, intent(in) :: with_options
    character(len=:), allocatable :: phrase
    integer :: i, j

    phrase = trim(usage%name)
    associate (form => usage%form(k))
      do i = 1, form%arguments
        if (i > form%least) then
          phrase = phrase//" ["//trim(form%argument(i)%name)//"]"
        else
          phrase = phrase//" "//trim(form%argument(i)%name)
        end if
      end do
      if (form%repeats) phrase = phrase//" ..."
    end associate
    if (.not. with_options) return
    do i = 1, size(usage%option)
      associate (option => usage%option(i))
        if (.not. option%required) cycle
        phrase = phrase//" "//trim(option%name)
        do j = 1, option%values
          phrase = phrase//" "//trim(option%value(j)%name)
        end do
      end associate
    end do
    if (.not. all(usage%option%required)) phrase = phrase//" [options]"
  end function form_text

end module deck_wording
