!> Just enough JSON for the reference files of the tests: numbers, words and arrays of numbers
!> found by their key inside an object given as text.
module json_numbers
  use kinds, only: wp
  implicit none
  private

  public :: read_text, member, elements, numbers, word

contains

  !> A whole file as text; empty if it cannot be read.
  function read_text(path) result(content)
    character(len=*), intent(in) :: path
    character(len=:), allocatable :: content
    integer :: unit, stat, length

    open (newunit=unit, file=path, access="stream", form="unformatted", status="old", &
          action="read", iostat=stat)
    content = ""
    if (stat /= 0) return
    inquire (unit, size=length)
    deallocate (content)
    allocate (character(len=length) :: content)
    read (unit, iostat=stat) content
    if (stat /= 0) content = ""
    close (unit)
  end function read_text

  !> The text of the value of a key at the top level of an object.
  function member(object, key) result(value)
    character(len=*), intent(in) :: object, key
    character(len=:), allocatable :: value
    integer :: i, depth, last, at

    value = ""
    depth = 0
    i = 1
    do while (i <= len(object))
      select case (object(i:i))
      case ("{", "[")
        depth = depth + 1
      case ("}", "]")
        depth = depth - 1
      case ('"')
        last = i + index(object(i + 1:), '"')
        if (depth == 1 .and. object(i + 1:last - 1) == key) then
          at = last + verify(object(last + 1:), " ")
          if (object(at:at) == ":") then
            value = first_value(object(at + 1:))
            return
          end if
        end if
        i = last
      case default
      end select
      i = i + 1
    end do
  end function member

  !> The i-th object of an array.
  function elements(array, i) result(value)
    character(len=*), intent(in) :: array
    integer, intent(in) :: i
    character(len=:), allocatable :: value
    integer :: at, n

    at = 2
    value = ""
    do n = 1, i
      at = at + verify(array(at:), " ,"//achar(10)) - 1
      if (array(at:at) == "]") then
        value = ""
        return
      end if
      value = first_value(array(at:))
      at = at + len(value)
    end do
  end function elements

  !> One value from the start of a text.
  function first_value(text) result(value)
    character(len=*), intent(in) :: text
    character(len=:), allocatable :: value
    integer :: i, start, depth

    start = verify(text, " "//achar(10))
    depth = 0
    do i = start, len(text)
      if (index("{[", text(i:i)) > 0) depth = depth + 1
      if (index("}]", text(i:i)) > 0) depth = depth - 1
      if (depth < 0 .or. (depth == 0 .and. text(i:i) == ",")) exit
      if (depth == 0 .and. index("}]", text(i:i)) > 0) then
        value = text(start:i)
        return
      end if
    end do
    value = trim(text(start:i - 1))
  end function first_value

  !> All numbers of an array of any depth, in the order of the file.
  function numbers(value) result(x)
    character(len=*), intent(in) :: value
    real(wp), allocatable :: x(:)
    real(wp) :: buffer(2000)
    integer :: n, at, last, stat
    character(len=*), parameter :: separators = "[], "//achar(10)

    n = 0
    at = 1
    do
      if (at > len(value)) exit
      last = verify(value(at:), separators)
      if (last == 0) exit
      at = at + last - 1
      last = scan(value(at:)//" ", separators) + at - 2
      n = n + 1
      read (value(at:last), *, iostat=stat) buffer(n)
      if (stat /= 0) buffer(n) = huge(1.0_wp)
      at = last + 1
    end do
    x = buffer(:n)
  end function numbers

  !> A quoted word without its quotes.
  function word(value)
    character(len=*), intent(in) :: value
    character(len=:), allocatable :: word

    word = value(2:len(value) - 1)
  end function word

end module json_numbers
