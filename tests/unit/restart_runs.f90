!> Decks and runs that tests of --restart share.
module restart_runs
  use text, only: newline, to_text
  use check, only: expect
  use program_runs, only: outcome_t, run_spar, scratch, read_text, make_file
  implicit none
  private

  public :: expect_status, mechanism, pendulum, fresh

  character(len=*), parameter, public :: cases = "tests/cases/restart/", frame = cases//"frame.deck"

contains

  !> Run and compare the exit status.
  subroutine expect_status(arguments, status, outcome, front)
    character(len=*), intent(in) :: arguments
    integer, intent(in) :: status
    type(outcome_t), intent(out) :: outcome
    character(len=*), intent(in), optional :: front

    call run_spar("run "//arguments, outcome, front)
    call expect(outcome%status == status, "status "//to_text(outcome%status)//" instead of "// &
                to_text(status)//" of: spar run "//arguments//newline//outcome%errors)
  end subroutine expect_status

  !> Path of a deck: a mechanism with a shaft that turns through two rounds, a hinge that is free, a
  !> released strain, dampers, loads that jump; then these cards.
  function mechanism(cards) result(path)
    character(len=*), intent(in) :: cards
    character(len=:), allocatable :: path, text

    call read_text(cases//"mechanism.txt", text)
    path = scratch("mechanism.deck")
    call make_file(path, text//cards//newline)
  end function mechanism

  !> Path of a deck of a pendulum that runs fast: many steps in little time.
  function pendulum(cards) result(path)
    character(len=*), intent(in) :: cards
    character(len=:), allocatable :: path
    character(len=*), parameter :: n = newline

    path = scratch("pendulum.deck")
    call make_file(path, "NODE 1 0 0 0"//n//"NODE 2 -1 0 0"//n//"TRUSS 1 1 2"//n//"XM 2 1"//n// &
                   "FIX 1"//n//"FIX 2 Z"//n//"GRAVITY 0 -9.81 0"//n//cards//n)
  end function pendulum

  !> Path of a result file that is not there.
  function fresh(name) result(path)
    character(len=*), intent(in) :: name
    character(len=:), allocatable :: path

    path = scratch(name)
    call execute_command_line("rm -f "//path//" "//path//".part "//path//".restart.part")
  end function fresh

end module restart_runs
