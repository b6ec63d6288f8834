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
    call run("run log: a model drawn with a gap starts elsewhere", gap)
    call run("check: axes that beams without an orientation take", orientations)
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

  !> The nearest place on the line of a node drawn 0.05 beside it is 0.05 away.
  subroutine gap()
    character(len=*), parameter :: rail = "MATERIAL m E 2e11 NU 0.3"//newline// &
      "SECTION s RECT H 0.1 B 0.2"//newline//"NODE 1 0 0 0"//newline//"NODE 2 1 0 0"//newline// &
      "BEAM 1 1 2 SECTION s MATERIAL m"//newline//"FIX 1"//newline//"SLIDER 2 3 ALONG 1"// &
      newline// &
      "INPUTE 2 1 0.1"//newline//"STATIC"//newline
    type(outcome_t) :: outcome
    character(len=:), allocatable :: path

    path = scratch("log_gap.deck")
    call make_file(path, "NODE 3 0.5 0.05 0"//newline//rail)
    call run_spar("run "//path//" -o "//scratch("log_gap.h5"), outcome)
    call expect(outcome%status == 0, "a node beside a rail: "//outcome%errors)
    call expect_text(outcome%output, "starts off the drawing, as constraints, drives or STARTX "// &
                     "ask: node 3 by 0.05"//newline)
    call make_file(path, "NODE 3 0.5 0 0"//newline//rail)
    call run_spar("run "//path//" -o "//scratch("log_gap.h5"), outcome)
    call expect(outcome%status == 0 .and. index(outcome%output, "starts off") == 0, "no gap")
  end subroutine gap

  !> Along (1, 1, 0) Z is the least global axis, along X and Z it is Y and X; a square has none.
  subroutine orientations()
    character(len=*), parameter :: beams = "MATERIAL m E 2e11 NU 0.3"//newline// &
      "SECTION s RECT H 0.1 B 0.2"//newline//"SECTION q RECT H 0.1 B 0.1"//newline// &
      "NODE 1 0 0 0"//newline//"NODE 2 1 1 0"//newline//"NODE 3 2 1 0"//newline// &
      "NODE 4 2 1 1"//newline//"NODE 5 2 2 1"//newline//"NODE 6 3 2 1"//newline// &
      "BEAM 1 1 2 SECTION s MATERIAL m DIVIDE 2"//newline// &
      "BEAM 2:3 {i} {i+1} SECTION s MATERIAL m"//newline//"BEAM 4 4 5 SECTION q MATERIAL m"// &
      newline//"BEAM 5 5 6 0 1 0 SECTION s MATERIAL m"//newline//"FIX 1"//newline
    type(outcome_t) :: outcome
    character(len=:), allocatable :: path

    path = scratch("log_axes.deck")
    call make_file(path, beams)
    call run_spar("check "//path, outcome)
    call expect(outcome%status == 0, "beams in space: "//outcome%errors)
    call expect_text(outcome%output, "default of element 3: the section's y axis along X"// &
                     newline//"default of element 2: the section's y axis along Y"//newline// &
                     "default of element 1: the section's y axis along Z"//newline)
  end subroutine orientations

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
