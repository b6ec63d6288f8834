!> Errors as values: a procedure that can fail has
!> `type(error_t), allocatable, intent(out) :: error` as its last argument.
!> Unallocated means success. Only the main program stops.
module errors
  implicit none
  private

  public :: error_t, fail, annotate

  !> What went wrong; the values are the exit statuses of the program.
  integer, parameter, public :: exit_different = 1, exit_usage = 2, exit_deck = 3, &
                                exit_solve = 4, exit_io = 5, exit_interrupt = 130

  type :: error_t
    integer :: status = 1                     !< exit status, one of `exit_*`
    character(len=:), allocatable :: message  !< one sentence, no trailing period
  end type error_t

contains

  !> Report a failure.
  subroutine fail(error, status, message)
    type(error_t), allocatable, intent(out) :: error
    integer, intent(in) :: status
    character(len=*), intent(in) :: message

    allocate (error)
    error%status = status
    error%message = message
  end subroutine fail

  !> Put what the caller was doing in front of an error that passes through it.
  subroutine annotate(error, context)
    type(error_t), allocatable, intent(inout) :: error
    character(len=*), intent(in) :: context

    if (allocated(error)) error%message = context//": "//error%message
  end subroutine annotate

end module errors
