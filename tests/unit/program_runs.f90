!> Runs the built program ($SPAR_PROGRAM) in tests; files go to the folder `scratch` beside it.
module program_runs
  implicit none
  private

  public :: scratch, run_spar, run_shell, read_text, make_file, file_there, same_bytes, outcome_t

  !> What a run left behind.
  type :: outcome_t
    integer :: status = -1
    character(len=:), allocatable :: output, errors
  end type outcome_t

contains

  !> The program, as the tests' makefile names it.
  function program_path() result(path)
    character(len=:), allocatable :: path
    integer :: length

    call get_environment_variable("SPAR_PROGRAM", length=length)
    allocate (character(len=length) :: path)
    if (length > 0) call get_environment_variable("SPAR_PROGRAM", path)
    if (length == 0) path = "build/spar"
  end function program_path

  !> Path of a file in the scratch folder, which exists then.
  function scratch(name) result(path)
    character(len=*), intent(in) :: name
    character(len=:), allocatable :: path
    logical :: exists

    path = program_path()
    path = path(:index(path, "/", back=.true.))//"scratch/"
    inquire (file=path//".", exist=exists)
    if (.not. exists) call execute_command_line("mkdir -p "//path)
    path = path//name
  end function scratch

  !> Run the program with arguments as a shell takes them; `front` stands before the program.
  subroutine run_spar(arguments, outcome, front)
    character(len=*), intent(in) :: arguments
    type(outcome_t), intent(out) :: outcome
    character(len=*), intent(in), optional :: front
    character(len=:), allocatable :: command

    command = program_path()//" "//arguments
    if (present(front)) command = front//" "//command
    call run_shell(command, outcome)
  end subroutine run_spar

  !> Run a command of the shell.
  subroutine run_shell(command, outcome)
    character(len=*), intent(in) :: command
    type(outcome_t), intent(out) :: outcome
    character(len=:), allocatable :: output, errors

    output = scratch("stdout")
    errors = scratch("stderr")
    call execute_command_line("{ "//command//"; } >"//output//" 2>"//errors, &
                              exitstat=outcome%status)
    call read_text(output, outcome%output)
    call read_text(errors, outcome%errors)
  end subroutine run_shell

  !> All of a file; empty if it is not there.
  subroutine read_text(path, text)
    character(len=*), intent(in) :: path
    character(len=:), allocatable, intent(out) :: text
    integer :: unit, length, status

    text = ""
    open (newunit=unit, file=path, access="stream", form="unformatted", status="old", &
          action="read", iostat=status)
    if (status /= 0) return
    inquire (unit=unit, size=length)
    deallocate (text)
    allocate (character(len=length) :: text)
    if (length > 0) read (unit) text
    close (unit)
  end subroutine read_text

  !> Write a file with these bytes.
  subroutine make_file(path, text)
    character(len=*), intent(in) :: path, text
    integer :: unit

    open (newunit=unit, file=path, access="stream", form="unformatted", status="replace", &
          action="write")
    write (unit) text
    close (unit)
  end subroutine make_file

  logical function file_there(path)
    character(len=*), intent(in) :: path

    inquire (file=path, exist=file_there)
  end function file_there

  !> Whether two files exist and are equal.
  logical function same_bytes(first, second)
    character(len=*), intent(in) :: first, second
    character(len=:), allocatable :: a, b

    call read_text(first, a)
    call read_text(second, b)
    same_bytes = len(a) > 0 .and. len(a) == len(b)
    if (same_bytes) same_bytes = a == b
  end function same_bytes

end module program_runs
