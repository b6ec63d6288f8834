!> Values as JSON.
module output_json
  use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
  use kinds, only: wp
  use text, only: to_text
  implicit none
  private

  public :: json_string, json_number, json_logical

contains

  !> A text between quotes, with what JSON cannot hold written otherwise.
  pure function json_string(text) result(phrase)
    character(len=*), intent(in) :: text
    character(len=:), allocatable :: phrase
    character(len=4) :: code
    integer :: i

    phrase = """"
    do i = 1, len(text)
      select case (text(i:i))
      case ("""", "\")
        phrase = phrase//"\"//text(i:i)
      case (achar(0):achar(31))
        write (code, "(z4.4)") iachar(text(i:i))
        phrase = phrase//"\u"//code
      case default
        phrase = phrase//text(i:i)
      end select
    end do
    phrase = phrase//""""
  end function json_string

  !> A number in full precision; null if it is none.
  pure function json_number(number) result(phrase)
    real(wp), intent(in) :: number
    character(len=:), allocatable :: phrase

    phrase = "null"
    if (ieee_is_finite(number)) phrase = to_text(number, 17)
  end function json_number

  pure function json_logical(yes) result(phrase)
    logical, intent(in) :: yes
    character(len=:), allocatable :: phrase

    phrase = trim(merge("true ", "false", yes))
  end function json_logical

end module output_json
