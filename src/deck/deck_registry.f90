!> Names that cards define and other cards, also earlier ones, refer to.
module deck_registry
  use text, only: quoted, nearest_word
  use lookup_tables, only: name_table_t, longest_name
  use diagnostics, only: place_t, report_t
  implicit none
  private

  public :: registry_t

  !> Numbers names in the order they come up; each knows where it was defined and first used.
  type :: registry_t
    character(len=16) :: noun = ""               !< what it names, for messages
    logical :: incomplete = .false.              !< a card with an unreadable name was skipped
    type(name_table_t) :: table
    type(place_t), allocatable :: defined(:)     !< `line = 0`: nowhere
    type(place_t), allocatable :: used(:)        !< `line = 0`: nowhere
    logical, allocatable :: usable(:)            !< defined by a card without errors
  contains
    procedure :: refer
    procedure :: define
    procedure :: report_undefined
    procedure :: reference
  end type registry_t

contains

  !> Number of a name that a card uses.
  subroutine refer(self, name, place, number)
    class(registry_t), intent(inout) :: self
    character(len=*), intent(in) :: name
    type(place_t), intent(in) :: place
    integer, intent(out) :: number

    call self%table%add(name, number)
    call reserve(self, number)
    if (self%used(number)%line == 0) self%used(number) = place
  end subroutine refer

  !> Number of a name that a card defines; `first` is where it was defined before, if it was.
  subroutine define(self, name, place, usable, number, first)
    class(registry_t), intent(inout) :: self
    character(len=*), intent(in) :: name
    type(place_t), intent(in) :: place
    logical, intent(in) :: usable
    integer, intent(out) :: number
    type(place_t), intent(out) :: first

    call self%table%add(name, number)
    call reserve(self, number)
    first = self%defined(number)
    if (first%line > 0) return
    self%defined(number) = place
    self%usable(number) = usable
  end subroutine define

  subroutine reserve(self, n)
    type(registry_t), intent(inout) :: self
    integer, intent(in) :: n
    type(place_t), allocatable :: defined(:), used(:)
    logical, allocatable :: usable(:)
    integer :: old

    old = 0
    if (allocated(self%used)) old = size(self%used)
    if (n <= old) return
    allocate (defined(max(8, 2*old)), used(max(8, 2*old)), usable(max(8, 2*old)))
    usable = .false.
    if (old > 0) then
      defined(:old) = self%defined
      used(:old) = self%used
      usable(:old) = self%usable
    end if
    call move_alloc(defined, self%defined)
    call move_alloc(used, self%used)
    call move_alloc(usable, self%usable)
  end subroutine reserve

  !> An error for each name that is used but nowhere defined.
  subroutine report_undefined(self, report)
    class(registry_t), intent(in) :: self
    type(report_t), intent(inout) :: report
    character(len=longest_name), allocatable :: known(:)
    character(len=:), allocatable :: best, hint
    integer :: i

    if (self%incomplete .or. self%table%entries == 0) return
    known = pack(self%table%name(:self%table%entries), &
                 self%defined(:self%table%entries)%line > 0)
    do i = 1, self%table%entries
      if (self%defined(i)%line > 0 .or. self%used(i)%line == 0) cycle
      best = ""
      if (report%errors() < 1000) best = nearest_word(trim(self%table%name(i)), known)
      hint = ""
      if (best /= "") hint = "did you mean "//best//"?"
      call report%add_error(self%used(i), "no "//trim(self%noun)//" named "// &
                            quoted(trim(self%table%name(i))), hint)
    end do
  end subroutine report_undefined

  !> The number as a reference: -1 if nothing usable stands behind it, 0 stays 0.
  pure integer function reference(self, number)
    class(registry_t), intent(in) :: self
    integer, intent(in) :: number

    reference = number
    if (number == 0) return
    if (.not. self%usable(number)) reference = -1
  end function reference

end module deck_registry
