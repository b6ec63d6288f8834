!> Hash tables that number things in the order they come: ids with parts, and names.
module lookup_tables
  use kinds, only: i8
  implicit none
  private

  public :: id_table_t, name_table_t

  integer, parameter, public :: longest_name = 64

  !> Numbers pairs (id, part).
  type :: id_table_t
    integer :: entries = 0
    integer, allocatable :: key(:, :)        !< (2, entries) id and part
    integer, allocatable, private :: slot(:) !< open addressing; 0: free
  contains
    procedure :: find => find_id
    procedure :: add => add_id
  end type id_table_t

  !> Numbers names.
  type :: name_table_t
    integer :: entries = 0
    character(len=longest_name), allocatable :: name(:)
    integer, allocatable, private :: slot(:)
  contains
    procedure :: find => find_name
    procedure :: add => add_name
  end type name_table_t

contains

  !> Number of (id, part); 0 if it has none.
  pure integer function find_id(self, id, part)
    class(id_table_t), intent(in) :: self
    integer, intent(in) :: id, part

    find_id = 0
    if (self%entries > 0) find_id = self%slot(slot_of_id(self, id, part))
  end function find_id

  !> Number of (id, part), new or not.
  pure subroutine add_id(self, id, part, number)
    class(id_table_t), intent(inout) :: self
    integer, intent(in) :: id, part
    integer, intent(out) :: number
    integer, allocatable :: more(:, :)
    integer :: i, at

    if (.not. allocated(self%slot)) then
      allocate (self%key(2, 32), self%slot(64))
      self%slot = 0
    end if
    at = slot_of_id(self, id, part)
    number = self%slot(at)
    if (number > 0) return
    if (self%entries == size(self%key, 2)) then
      allocate (more(2, 2*self%entries))
      more(:, :self%entries) = self%key
      call move_alloc(more, self%key)
      deallocate (self%slot)
      allocate (self%slot(4*self%entries))
      self%slot = 0
      do i = 1, self%entries
        self%slot(slot_of_id(self, self%key(1, i), self%key(2, i))) = i
      end do
      at = slot_of_id(self, id, part)
    end if
    self%entries = self%entries + 1
    number = self%entries
    self%key(:, number) = [id, part]
    self%slot(at) = number
  end subroutine add_id

  !> The slot that holds (id, part), or the free one where it belongs.
  pure integer function slot_of_id(table, id, part) result(at)
    type(id_table_t), intent(in) :: table
    integer, intent(in) :: id, part
    integer :: number

    at = hashed(int(id, i8), int(part, i8), size(table%slot))
    do
      number = table%slot(at)
      if (number == 0) return
      if (table%key(1, number) == id .and. table%key(2, number) == part) return
      at = 1 + modulo(at, size(table%slot))
    end do
  end function slot_of_id

  !> Number of a name; 0 if it has none.
  pure integer function find_name(self, name)
    class(name_table_t), intent(in) :: self
    character(len=*), intent(in) :: name

    find_name = 0
    if (self%entries > 0) find_name = self%slot(slot_of_name(self, name))
  end function find_name

  !> Number of a name, new or not.
  pure subroutine add_name(self, name, number)
    class(name_table_t), intent(inout) :: self
    character(len=*), intent(in) :: name
    integer, intent(out) :: number
    character(len=longest_name), allocatable :: more(:)
    integer :: i, at

    if (.not. allocated(self%slot)) then
      allocate (self%name(32), self%slot(64))
      self%slot = 0
    end if
    at = slot_of_name(self, name)
    number = self%slot(at)
    if (number > 0) return
    if (self%entries == size(self%name)) then
      allocate (more(2*self%entries))
      more(:self%entries) = self%name
      call move_alloc(more, self%name)
      deallocate (self%slot)
      allocate (self%slot(4*self%entries))
      self%slot = 0
      do i = 1, self%entries
        self%slot(slot_of_name(self, trim(self%name(i)))) = i
      end do
      at = slot_of_name(self, name)
    end if
    self%entries = self%entries + 1
    number = self%entries
    self%name(number) = name
    self%slot(at) = number
  end subroutine add_name

  pure integer function slot_of_name(table, name) result(at)
    type(name_table_t), intent(in) :: table
    character(len=*), intent(in) :: name
    integer(i8) :: code
    integer :: i, number

    code = 0
    do i = 1, len_trim(name)
      code = modulo(131_i8*code + ichar(name(i:i), i8), 2305843009213_i8)
    end do
    at = hashed(code, 0_i8, size(table%slot))
    do
      number = table%slot(at)
      if (number == 0) return
      if (table%name(number) == name) return
      at = 1 + modulo(at, size(table%slot))
    end do
  end function slot_of_name

  !> A slot from 1 to `slots` for two numbers, well spread, without integer overflow.
  pure integer function hashed(a, b, slots)
    integer(i8), intent(in) :: a, b
    integer, intent(in) :: slots
    integer(i8), parameter :: prime = 2147483647_i8
    integer(i8) :: mixed

    mixed = modulo(a*48271_i8 + modulo(b*69621_i8, prime), prime)
    mixed = modulo(ieor(mixed, ishft(mixed, -15))*40692_i8, prime)
    hashed = 1 + int(modulo(ieor(mixed, ishft(mixed, -13)), int(slots, i8)))
  end function hashed

end module lookup_tables
