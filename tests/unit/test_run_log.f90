!> What a run prints beside its results: counts, columns, and where a path ends.
module test_run_log
  use check, only: run, expect
  use program_runs, only: outcome_t, run_spar, scratch, make_file
  implicit none
  private

  public :: run_log_tests

  character(len=*), parameter :: newline = new_line("a")

contains

  subroutine run_log_tests()
    call run("run log: joints count as elements, motions show their constraints", motions)
    call run("run log: a path by ARC ends at TO or STOP", arc)
  end subroutine run_log_tests

  !> Four beams and four hinges; KINEMATIC and INVERSE measure no unbalanced forces.
  subroutine motions()
    type(outcome_t) :: outcome
    character(len=:), allocatable :: path

    path = scratch("log_four_bar.h5")
    call run_spar("run decks/four_bar.deck -o "//path, outcome)
    call expect(outcome%status == 0, "four-bar linkage: "//outcome%errors)
    call expect_text(outcome%output, "9 nodes, 8 elements, ")
    call expect_text(outcome%output, "iterations constraint   increment   largest")
    call expect(index(outcome%output, "residual") == 0, "no residual")
    call run_spar("info "//path, outcome)
    call expect_text(outcome%output, "9 nodes, 8 elements, ")
    call run_spar("run decks/channel.deck -o "//path, outcome)
    call expect_text(outcome%output, "iterations   residual   increment   largest")
  end subroutine motions

  !> A bar of EA = 100, 2 long: a force f stretches it by f/50, to 0.008 before f = 1 is reached.
  subroutine arc()
    character(len=*), parameter :: bar = "NODE 1 0 0 0"//newline//"NODE 2 2 0 0"//newline// &
      "TRUSS 1 1 2"//newline//"DYNE 1 1"//newline//"ESTIFF 1 100"//newline//"FIX 1"//newline// &
      "FIX 2 Y Z"//newline//"XF 2 1 0 0"//newline//"STATIC CONTROL ARC STOP 2 X "
    type(outcome_t) :: outcome
    character(len=:), allocatable :: path

    path = scratch("log_arc.deck")
    call make_file(path, bar//"0.008"//newline)
    call run_spar("run "//path//" -o "//scratch("log_arc.h5"), outcome)
    call expect(outcome%status == 0, "a bar: "//outcome%errors)
    call expect_text(outcome%output, "along the path, to load factor 1 or displacement 0.008")
    call expect_text(outcome%output, "           0.4            ")
    call make_file(path, bar//"0.08"//newline)
    call run_spar("run "//path//" -o "//scratch("log_arc.h5"), outcome)
    call expect_text(outcome%output, "0.02 at node 2")
  end subroutine arc

  subroutine expect_text(text, part)
    character(len=*), intent(in) :: text, part

    call expect(index(text, part) > 0, "'"//part//"' in:"//newline//text)
  end subroutine expect_text

end module test_run_log
