!> The names that SET and -D define.
module deck_settings
  use kinds, only: wp
  use text, only: string_t
  use lookup_tables, only: name_table_t
  use diagnostics, only: place_t
  implicit none
  private

  public :: settings_t, is_identifier

  integer, parameter, public :: override_unused = 0, override_used = 1

  character(len=*), parameter :: letters = &
    "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_"
  character(len=2), parameter, public :: reserved_names(3) = ["t ", "i ", "pi"]

  !> Names with their values: a word, and the number if it is one.
  type :: settings_t
    type(name_table_t) :: table
    type(string_t), allocatable :: word(:)
    real(wp), allocatable :: number(:)
    logical, allocatable :: numeric(:)
    type(place_t), allocatable :: place(:)   !< of the SET card
  contains
    procedure :: define
    procedure :: names
  end type settings_t

contains

  !> Define a name that is not yet defined.
  subroutine define(self, name, word, numeric, number, place)
    class(settings_t), intent(inout) :: self
    character(len=*), intent(in) :: name, word
    logical, intent(in) :: numeric
    real(wp), intent(in) :: number
    type(place_t), intent(in) :: place
    integer :: i

    call self%table%add(name, i)
    call reserve(self, i)
    self%word(i)%s = word
    self%numeric(i) = numeric
    self%number(i) = number
    self%place(i) = place
  end subroutine define

  subroutine reserve(self, n)
    type(settings_t), intent(inout) :: self
    integer, intent(in) :: n
    type(settings_t) :: more
    integer :: old

    old = 0
    if (allocated(self%word)) old = size(self%word)
    if (n <= old) return
    allocate (more%word(max(8, 2*old)), more%number(max(8, 2*old)))
    allocate (more%numeric(max(8, 2*old)), more%place(max(8, 2*old)))
    if (old > 0) then
      more%word(:old) = self%word
      more%number(:old) = self%number
      more%numeric(:old) = self%numeric
      more%place(:old) = self%place
    end if
    call move_alloc(more%word, self%word)
    call move_alloc(more%number, self%number)
    call move_alloc(more%numeric, self%numeric)
    call move_alloc(more%place, self%place)
  end subroutine reserve

  !> All names, for suggestions.
  function names(self)
    class(settings_t), intent(in) :: self
    character(len=64), allocatable :: names(:)

    allocate (names(self%table%entries))
    if (size(names) > 0) names = self%table%name(:self%table%entries)
  end function names

  !> Letters, digits and underscores, no digit first, at most 64.
  pure logical function is_identifier(word)
    character(len=*), intent(in) :: word

    is_identifier = .false.
    if (len(word) == 0 .or. len(word) > 64) return
    is_identifier = verify(word, letters//"0123456789") == 0 .and. verify(word(1:1), letters) == 0
  end function is_identifier

end module deck_settings
