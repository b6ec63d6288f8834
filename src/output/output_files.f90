!> What HDF5 and Fortran do not offer: renaming and removing files, asking for a terminal.
module output_files
  use, intrinsic :: iso_c_binding, only: c_int, c_char, c_null_char, c_ptr, c_associated
  use errors, only: error_t, fail, exit_io
  implicit none
  private

  public :: file_exists, folder_exists, check_writable, check_unused, rename_file, remove_file, &
            error_is_terminal

  integer(c_int), parameter :: lock_at_once = 6, unlock = 8   !< LOCK_EX + LOCK_NB, LOCK_UN

  interface
    integer(c_int) function c_rename(from, to) bind(c, name="rename")
      import :: c_int, c_char
      implicit none
      character(kind=c_char), intent(in) :: from(*), to(*)
    end function c_rename

    integer(c_int) function c_remove(path) bind(c, name="remove")
      import :: c_int, c_char
      implicit none
      character(kind=c_char), intent(in) :: path(*)
    end function c_remove

    type(c_ptr) function c_fopen(path, mode) bind(c, name="fopen")
      import :: c_ptr, c_char
      implicit none
      character(kind=c_char), intent(in) :: path(*), mode(*)
    end function c_fopen

    integer(c_int) function c_fclose(file) bind(c, name="fclose")
      import :: c_ptr, c_int
      implicit none
      type(c_ptr), value :: file
    end function c_fclose

    integer(c_int) function c_fileno(file) bind(c, name="fileno")
      import :: c_ptr, c_int
      implicit none
      type(c_ptr), value :: file
    end function c_fileno

    integer(c_int) function c_flock(descriptor, operation) bind(c, name="flock")
      import :: c_int
      implicit none
      integer(c_int), value :: descriptor, operation
    end function c_flock

    integer(c_int) function c_isatty(descriptor) bind(c, name="isatty")
      import :: c_int
      implicit none
      integer(c_int), value :: descriptor
    end function c_isatty
  end interface

contains

  logical function file_exists(path)
    character(len=*), intent(in) :: path

    inquire (file=path, exist=file_exists)
  end function file_exists

  logical function folder_exists(path)
    character(len=*), intent(in) :: path

    inquire (file=path//"/.", exist=folder_exists)
  end function folder_exists

  !> Try to open a file for writing, which makes it if it is new, for the system's own words.
  subroutine check_writable(path, error)
    character(len=*), intent(in) :: path
    type(error_t), allocatable, intent(out) :: error
    character(len=200) :: message
    integer :: unit, status

    open (newunit=unit, file=path, status="unknown", action="write", access="stream", &
          form="unformatted", iostat=status, iomsg=message)
    if (status == 0) then
      close (unit, iostat=status)
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
    if (used .and. status == 0) &
      call fail(error, exit_io, "cannot write '"//path//"': another run is writing it")
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

    if (c_rename(from//c_null_char, to//c_null_char) /= 0) &
      call fail(error, exit_io, "cannot rename '"//from//"' to '"//to//"'")
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

end module output_files
