!> What HDF5 and Fortran do not offer: renaming and removing files, asking for a terminal.
module output_files
  use, intrinsic :: iso_c_binding, only: c_int, c_char, c_null_char, c_ptr, c_associated
  use errors, only: error_t, fail, exit_io
  use output_interfaces, only: c_realpath, c_rename, c_remove, c_fopen, c_fclose, c_fileno, &
                               c_flock, c_isatty
  implicit none
  private

  public :: file_exists, folder_exists, check_writable, check_unused, rename_file, remove_file, &
            error_is_terminal, link_name, same_file

  integer(c_int), parameter :: lock_at_once = 6, unlock = 8   !< LOCK_EX + LOCK_NB, LOCK_UN

  integer, parameter :: longest_path = 4097   !< of the system, with a zero behind

contains

  logical function file_exists(path)
    character(len=*), intent(in) :: path

    inquire (file=path, exist=file_exists)
  end function file_exists

  logical function folder_exists(path)
    character(len=*), intent(in) :: path

    inquire (file=path//"/.", exist=folder_exists)
  end function folder_exists

  !> Whether two paths lead to one file, which exists.
  logical function same_file(first, second)
    character(len=*), intent(in) :: first, second
    character(kind=c_char) :: a(longest_path), b(longest_path)

    same_file = c_associated(c_realpath(first//c_null_char, a))
    if (same_file) same_file = c_associated(c_realpath(second//c_null_char, b))
    if (same_file) same_file = all(a(:zero(a)) == b(:zero(a)))
  end function same_file

  pure integer function zero(text)
    character(kind=c_char), intent(in) :: text(:)

    do zero = 1, size(text) - 1
      if (text(zero) == c_null_char) exit
    end do
  end function zero

  !> Try to open a file for writing, which makes it if it is new, for the system's own words.
  subroutine check_writable(path, error)
    character(len=*), intent(in) :: path
    type(error_t), allocatable, intent(out) :: error
    character(len=200) :: message
    integer :: unit, status

    open (newunit=unit, file=path, status="unknown", action="write", access="stream", &
          form="unformatted", iostat=status, iomsg=message)
    if (status == 0) then
      close (unit)
    else
      call fail(error, exit_io, "cannot write '"//path//"': "//reason(trim(message)))
    end if
  end subroutine check_writable

  !> Another run that writes to the same file holds a lock on it, which HDF5 makes.
  subroutine check_unused(path, error)
    character(len=*), intent(in) :: path   !< a file that exists
    type(error_t), allocatable, intent(out) :: error
    type(c_ptr) :: file
    integer(c_int) :: status
    logical :: used

    file = c_fopen(path//c_null_char, "r"//c_null_char)
    if (.not. c_associated(file)) return
    used = c_flock(c_fileno(file), lock_at_once) /= 0
    status = c_flock(c_fileno(file), unlock)
    if (used .and. status == 0) then
      call fail(error, exit_io, "cannot write '"//path//"': another run is writing it")
    end if
    status = c_fclose(file)
  end subroutine check_unused

  !> The system's part of a message of the Fortran library, "Cannot open file 'x': Why".
  pure function reason(message)
    character(len=*), intent(in) :: message
    character(len=:), allocatable :: reason

    reason = message(index(message, "': ", back=.true.) + 1:)
    if (reason(1:1) == ":") reason = reason(3:)
  end function reason

  !> Put a file in the place of another in one go.
  subroutine rename_file(from, to, error)
    character(len=*), intent(in) :: from, to
    type(error_t), allocatable, intent(out) :: error

    if (c_rename(from//c_null_char, to//c_null_char) /= 0) then
      call fail(error, exit_io, "cannot rename '"//from//"' to '"//to//"'")
    end if
  end subroutine rename_file

  !> Remove a file if it is there.
  subroutine remove_file(path)
    character(len=*), intent(in) :: path
    integer(c_int) :: status

    status = c_remove(path//c_null_char)
  end subroutine remove_file

  !> Whether a person looks at standard error.
  logical function error_is_terminal()
    error_is_terminal = c_isatty(2_c_int) == 1
  end function error_is_terminal

  !> A name as it may stand in a path.
  pure function link_name(name)
    character(len=*), intent(in) :: name
    character(len=len(name)) :: link_name
    integer :: i

    link_name = name
    do i = 1, len(name)
      if (name(i:i) == "/") link_name(i:i) = "_"
    end do
    if (link_name == "." .or. link_name == "..") link_name = repeat("_", len(name))
  end function link_name

end module output_files
