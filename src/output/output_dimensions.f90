!> Dimensions of quantities: "F L2" in words, powers of force, length, time, mass in numbers.
module output_dimensions
  implicit none
  private

  public :: get_powers

  character(len=*), parameter :: letters = "FLTM"

contains

  !> Powers of F L T M for each blank-separated word: letters with an optional exponent, as in
  !> "FL2" or "ML-3"; "1" has none.
  pure subroutine get_powers(words, powers)
    character(len=*), intent(in) :: words
    integer, allocatable, intent(out) :: powers(:, :)   !< (4, words)
    integer :: i, n, letter, digit, sign

    n = 1
    do i = 1, len(words)
      if (words(i:i) == " ") n = n + 1
    end do
    allocate (powers(4, n))
    powers = 0
    n = 1
    letter = 0
    sign = 1
    do i = 1, len(words)
      digit = index("0123456789", words(i:i)) - 1
      if (words(i:i) == " ") then
        n = n + 1
        letter = 0
      else if (words(i:i) == "-") then
        sign = -1
      else if (digit < 0) then
        letter = index(letters, words(i:i))
        powers(letter, n) = 1
        sign = 1
      else if (letter > 0) then
        powers(letter, n) = sign*digit
      end if
    end do
  end subroutine get_powers

end module output_dimensions
