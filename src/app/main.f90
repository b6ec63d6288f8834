!> The program: the only place that ends the process.
program main
  use, intrinsic :: iso_c_binding, only: c_int, c_funptr, c_size_t, c_char, c_funloc
  use errors, only: exit_io
  use app_commands, only: run_program
  implicit none

  interface
    !> `stop` would print a line on standard error; the exit of C does not.
    subroutine c_exit(status) bind(c, name="exit")
      import :: c_int
      implicit none
      integer(c_int), value :: status
    end subroutine c_exit

    subroutine c_exit_now(status) bind(c, name="_exit")
      import :: c_int
      implicit none
      integer(c_int), value :: status
    end subroutine c_exit_now

    !> Needs no memory, unlike the Fortran library.
    integer(c_size_t) function c_write(file, text, length) bind(c, name="write")
      import :: c_int, c_size_t, c_char
      implicit none
      integer(c_int), value :: file
      character(kind=c_char), intent(in) :: text(80)
      integer(c_size_t), value :: length
    end function c_write

    integer(c_int) function c_atexit(handler) bind(c, name="atexit")
      import :: c_int, c_funptr
      implicit none
      type(c_funptr), value :: handler
    end function c_atexit
  end interface
  logical :: done
  integer :: status
  data done /.false./  ! makes it static, which a handler needs

  status = c_atexit(c_funloc(end_early))
  call run_program(status)
  done = .true.
  call c_exit(int(status, c_int))

contains

  !> The Fortran library ends the process by itself, with status 1, where memory runs out.
  subroutine end_early() bind(c)
    character(len=80), parameter :: sorry = &
      "the program could not go on, most likely for lack of memory"//new_line("a")

    if (done) return
    if (c_write(2_c_int, sorry, len_trim(sorry, c_size_t)) < 0) continue
    call c_exit_now(int(exit_io, c_int))
  end subroutine end_early

end program main
