!> What differs between two result files, and how it is told.
module output_differences
  use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
  use kinds, only: wp, i8
  use text, only: to_text
  use output_json, only: json_string, json_number, json_logical
  use output_reader, only: dataset_t
  implicit none
  private

  public :: differences_t, tolerance_t, print_differences, print_differences_json
  public :: index_text

  !> Round-off: numbers that differ by this part of the relative tolerance, measured against the
  !> largest entry of their dimension in the dataset, are equal.
  real(wp), parameter, public :: noise = 1.0e-3_wp

  !> Lines for one dataset, at most.
  integer, parameter :: most_lines = 20

  type :: tolerance_t
    real(wp) :: relative = 1.0e-6_wp, absolute = 0.0_wp
  end type tolerance_t

  !> One difference, as words; numbers in `error`.
  type :: difference_t
    character(len=:), allocatable :: path, kind, place, first, second
    real(wp) :: error = -1.0_wp        !< relative; negative: has none
    logical :: quoted = .false.        !< the values are texts
  end type difference_t

  type :: differences_t
    type(difference_t), allocatable :: item(:)
    integer :: listed = 0
    integer(i8) :: all = 0
    integer :: of_dataset = 0          !< found in the present dataset
  contains
    procedure :: start_dataset
    procedure :: add
    procedure :: add_values
  end type differences_t

contains

  subroutine start_dataset(self)
    class(differences_t), intent(inout) :: self

    self%of_dataset = 0
  end subroutine start_dataset

  !> Add a difference; only the first ones of a dataset are kept.
  subroutine add(self, path, kind, place, first, second, error, quoted)
    class(differences_t), intent(inout) :: self
    character(len=*), intent(in) :: path, kind, place, first, second
    real(wp), intent(in), optional :: error
    logical, intent(in), optional :: quoted
    type(difference_t), allocatable :: more(:)
    integer :: i

    self%all = self%all + 1
    self%of_dataset = self%of_dataset + 1
    if (self%of_dataset > most_lines) return
    if (.not. allocated(self%item)) allocate (self%item(16))
    if (self%listed == size(self%item)) then
      allocate (more(2*self%listed))
      do i = 1, self%listed
        more(i) = self%item(i)
      end do
      call move_alloc(more, self%item)
    end if
    self%listed = self%listed + 1
    associate (item => self%item(self%listed))
      item%path = path
      item%kind = kind
      item%place = place
      item%first = first
      item%second = second
      if (present(error)) item%error = error
      if (present(quoted)) item%quoted = quoted
    end associate
  end subroutine add

  !> Two numbers that differ.
  subroutine add_values(self, path, place, first, second)
    class(differences_t), intent(inout) :: self
    character(len=*), intent(in) :: path, place
    real(wp), intent(in) :: first, second

    call self%add(path, "value", place, to_text(first, 17), to_text(second, 17), &
                  relative_error(first, second))
  end subroutine add_values

  !> Difference over the larger magnitude; 1 where one is not a number.
  pure real(wp) function relative_error(a, b)
    real(wp), intent(in) :: a, b

    relative_error = 1
    if (.not. (ieee_is_finite(a) .and. ieee_is_finite(b))) return
    relative_error = abs(a - b)/max(abs(a), abs(b), tiny(1.0_wp))
  end function relative_error

  !> "[3, 0]" for entry `i` of a dataset, counted from 1.
  pure function index_text(dataset, i) result(place)
    type(dataset_t), intent(in) :: dataset
    integer(i8), intent(in) :: i
    character(len=:), allocatable :: place
    integer(i8) :: rest
    integer :: k

    place = ""
    rest = i - 1
    do k = size(dataset%extents), 1, -1
      if (place /= "") place = ", "//place
      place = to_text(int(modulo(rest, dataset%extents(k))))//place
      rest = rest/dataset%extents(k)
    end do
    if (place /= "") place = "["//place//"]"
  end function index_text

  !> A line for each difference and one for their number.
  subroutine print_differences(unit, self, first, second)
    integer, intent(in) :: unit
    type(differences_t), intent(in) :: self
    character(len=*), intent(in) :: first, second   !< names of the files
    integer :: i

    do i = 1, self%listed
      associate (d => self%item(i))
        select case (d%kind)
        case ("missing", "extra")
          write (unit, "(a)") d%path//"  only in "//trim(merge("the first file ", &
                              "the second file", d%kind == "missing"))
        case default
          if (d%error >= 0) then
            write (unit, "(a)") d%path//d%place//"  "//d%first//"  "//d%second// &
              "  relative error "//to_text(d%error, 3)
          else
            write (unit, "(a)") d%path//d%place//"  "//d%kind//" "//d%first//" and "//d%second
          end if
        end select
      end associate
    end do
    if (self%all == 0) then
      write (unit, "(a)") "no differences between "//first//" and "//second
    else if (self%all > self%listed) then
      write (unit, "(i0, a, i0, a, i0, a)") self%all, " differences, ", self%listed, &
        " of them shown (at most ", most_lines, " for each dataset)"
    else
      write (unit, "(i0, a)") self%all, merge(" difference ", " differences", self%all == 1)
    end if
  end subroutine print_differences

  subroutine print_differences_json(unit, self, first, second)
    integer, intent(in) :: unit
    type(differences_t), intent(in) :: self
    character(len=*), intent(in) :: first, second
    character(len=20) :: number
    integer :: i

    write (number, "(i0)") self%all
    write (unit, "(a)") "{""first"": "//json_string(first)//", ""second"": "// &
      json_string(second)//", ""equal"": "//json_logical(self%all == 0)//","
    write (unit, "(a)") " ""number"": "//trim(number)//", ""differences"": ["
    do i = 1, self%listed
      associate (d => self%item(i))
        write (unit, "(a)", advance="no") "  {""path"": "//json_string(d%path)//", ""kind"": "// &
          json_string(d%kind)//", ""index"": "//json_index(d%place)//", ""first"": "// &
          json_value(d%first, d)//", ""second"": "//json_value(d%second, d)
        if (d%error >= 0) write (unit, "(a)", advance="no") ", ""relative_error"": "// &
          json_number(d%error)
      end associate
      write (unit, "(a)") "}"//trim(merge(",", " ", i < self%listed))
    end do
    write (unit, "(a)") " ]}"
  end subroutine print_differences_json

  pure function json_index(place) result(phrase)
    character(len=*), intent(in) :: place
    character(len=:), allocatable :: phrase

    phrase = "null"
    if (place /= "") phrase = place
  end function json_index

  !> Numbers as they are, but for those that JSON has not; all else quoted.
  pure function json_value(word, d) result(phrase)
    character(len=*), intent(in) :: word
    type(difference_t), intent(in) :: d
    character(len=:), allocatable :: phrase

    phrase = json_string(word)
    if (d%error < 0 .or. d%quoted) return
    phrase = word
    if (verify(word, "+-.0123456789E") > 0) phrase = json_string(word)
  end function json_value

end module output_differences
