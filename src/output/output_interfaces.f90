!> Procedures of the C library: files, the environment, memory.
module output_interfaces
  use, intrinsic :: iso_c_binding, only: c_int, c_char, c_ptr, c_size_t
  implicit none
  private

  public :: c_realpath, c_rename, c_remove, c_fopen, c_fclose, c_fileno, c_flock, c_isatty, &
            c_memcpy, c_setenv, c_unsetenv

  interface
    !> The path without links, dots and the like; null if there is nothing.
    type(c_ptr) function c_realpath(path, resolved) bind(c, name="realpath")
      import :: c_char, c_ptr
      implicit none
      character(kind=c_char), intent(in) :: path(*)
      character(kind=c_char), intent(out) :: resolved(*)
    end function c_realpath

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

    !> Copy `bytes` bytes.
    type(c_ptr) function c_memcpy(to, from, bytes) bind(c, name="memcpy")
      import :: c_ptr, c_size_t
      implicit none
      type(c_ptr), value :: to, from
      integer(c_size_t), value :: bytes
    end function c_memcpy

    integer(c_int) function c_setenv(name, value, overwrite) bind(c, name="setenv")
      import :: c_int, c_char
      implicit none
      character(kind=c_char), intent(in) :: name(*), value(*)
      integer(c_int), value :: overwrite
    end function c_setenv

    integer(c_int) function c_unsetenv(name) bind(c, name="unsetenv")
      import :: c_int, c_char
      implicit none
      character(kind=c_char), intent(in) :: name(*)
    end function c_unsetenv
  end interface

end module output_interfaces
