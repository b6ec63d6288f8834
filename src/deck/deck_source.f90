!> Files of a deck: reading them whole, and their paths.
module deck_source
  use, intrinsic :: iso_fortran_env, only: iostat_end
  use kinds, only: i8
  use errors, only: error_t, fail, exit_io
  implicit none
  private

  public :: load_text, beside

  character(len=*), parameter :: byte_order_mark = char(239)//char(187)//char(191)
  integer(i8), parameter :: longest = 2000000000_i8  !< bytes: places are default integers

contains

  !> All bytes of a text file; a NUL byte tells a binary one.
  subroutine load_text(path, text, error)
    character(len=*), intent(in) :: path
    character(len=:), allocatable, intent(out) :: text
    type(error_t), allocatable, intent(out) :: error
    character(len=200) :: reason
    integer(i8) :: length
    integer :: unit, stat

    open (newunit=unit, file=path, status="old", action="read", access="stream", &
          form="unformatted", iostat=stat, iomsg=reason)
    if (stat /= 0) then
      call fail(error, exit_io, "cannot read '"//path//"': "//short(reason))
      return
    end if
    inquire (unit=unit, size=length)
    if (length > longest) then
      call fail(error, exit_io, "cannot read '"//path//"': larger than 2 GB")
    else if (length > 0) then
      allocate (character(len=length) :: text, stat=stat)
      if (stat == 0) read (unit, iostat=stat, iomsg=reason) text
      if (stat /= 0) call fail(error, exit_io, "cannot read '"//path//"': "//short(reason))
    else
      call read_bytes(unit, text, stat)
      if (stat /= iostat_end) call fail(error, exit_io, "cannot read '"//path//"'")
    end if
    close (unit)
    if (allocated(error)) return
    if (index(text, achar(0)) > 0) then
      call fail(error, exit_io, "'"//path//"' is not a text file: it contains a NUL byte")
    end if
    if (index(text, byte_order_mark) == 1) text = text(4:)
  end subroutine load_text

  !> What a file gives whose size is not known beforehand: a pipe, or nothing.
  subroutine read_bytes(unit, text, stat)
    integer, intent(in) :: unit
    character(len=:), allocatable, intent(out) :: text
    integer, intent(out) :: stat
    character(len=:), allocatable :: buffer
    character(len=1) :: byte
    integer :: n

    buffer = repeat(" ", 4096)
    n = 0
    do
      read (unit, iostat=stat) byte
      if (stat /= 0) exit
      if (n == len(buffer)) buffer = buffer//buffer
      n = n + 1
      buffer(n:n) = byte
    end do
    text = buffer(:n)
  end subroutine read_bytes

  !> The system's reason behind the last colon of a message.
  pure function short(message) result(reason)
    character(len=*), intent(in) :: message
    character(len=:), allocatable :: reason

    reason = trim(adjustl(message(index(message, ":", back=.true.) + 1:)))
  end function short

  !> The path of a file named in another file: relative to that file's folder.
  pure function beside(path, name) result(full)
    character(len=*), intent(in) :: path, name
    character(len=:), allocatable :: full

    full = name
    if (index(name, "/") /= 1) full = path(:index(path, "/", back=.true.))//name
    full = simplified(full)
  end function beside

  !> A path without `./` and `folder/..`.
  pure function simplified(path) result(short_path)
    character(len=*), intent(in) :: path
    character(len=:), allocatable :: short_path, piece
    integer :: from, slash, parent

    short_path = ""
    from = 1
    if (index(path, "/") == 1) then
      short_path = "/"
      from = 2
    end if
    do while (from <= len(path))
      slash = index(path(from:)//"/", "/")
      piece = path(from:from + slash - 2)
      from = from + slash
      if (piece == "" .or. piece == ".") cycle
      parent = index(short_path(:max(0, len(short_path) - 1)), "/", back=.true.)
      if (piece == ".." .and. len(short_path) > 1 .and. &
          short_path(parent + 1:) /= "../") then
        short_path = short_path(:parent)
      else
        short_path = short_path//piece//"/"
      end if
    end do
    short_path = short_path(:max(0, len(short_path) - 1))
  end function simplified

end module deck_source
