!> The program: the only place that ends the process.
program main
  use, intrinsic :: iso_c_binding, only: c_int
  use app_commands, only: run_program
  implicit none

  interface
    !> `stop` would print a line on standard error; the exit of C does not.
    subroutine c_exit(status) bind(c, name="exit")
      import :: c_int
      implicit none
      integer(c_int), value :: status
    end subroutine c_exit
  end interface
  integer :: status

  call run_program(status)
  call c_exit(int(status, c_int))
end program main
