!> What spar run --restart refuses: files without a restart point, decks that say something else.
module test_restart_refused
  use text, only: newline
  use check, only: run, expect
  use program_runs, only: outcome_t, run_shell, scratch, read_text, make_file, file_there
  use restart_runs, only: expect_status, mechanism, fresh, frame
  implicit none
  private

  public :: run_restart_refused_tests

contains

  subroutine run_restart_refused_tests()
    call run("restart: files that do not do", test_wrong_files)
    call run("restart: decks that differ", test_wrong_decks)
  end subroutine run_restart_refused_tests

  subroutine expect_refused(arguments, status, words)
    character(len=*), intent(in) :: arguments, words
    integer, intent(in) :: status
    type(outcome_t) :: outcome
    character(len=:), allocatable :: path

    path = fresh("refused.h5")
    call expect_status(arguments//" --quiet -o "//path, status, outcome)
    call expect(index(outcome%errors, words) > 0, "'"//words//"' in: "//outcome%errors)
    call expect(.not. file_there(path), "no file")
    call expect(.not. file_there(path//".part"), "no part of it")
  end subroutine expect_refused

  subroutine test_wrong_files()
    type(outcome_t) :: outcome
    character(len=:), allocatable :: path, deck

    path = fresh("source.h5")
    deck = mechanism("TRANSIENT TEND 0.1 STEP 0.01")
    call expect_refused(deck//" --restart "//path, 5, "there is no such file")
    call expect_status(deck//" --restart", 2, outcome)
    call expect(index(outcome%errors, "needs a value") > 0, outcome%errors)
    call expect_refused(deck//" --restart a.h5 --restart b.h5", 2, "given twice")
    call make_file(path, "no result file")
    call expect_refused(deck//" --restart "//path, 5, "it is no HDF5 file")
    call expect_status("tests/cases/program/cantilever.deck --quiet -o "//path, 0, outcome)
    call expect_refused("tests/cases/program/cantilever.deck --restart "//path, 5, &
                        "holds no restart point")
    call expect_status(deck//" --quiet -o "//path, 0, outcome)
    call run_shell("exec 9<"//path//"; flock 9; ${SPAR_PROGRAM:-build/spar} run "//deck// &
                   " --quiet --restart "//path//" -o "//scratch("refused.h5"), outcome)
    call expect(outcome%status == 5 .and. index(outcome%errors, "still writing it") > 0, &
                "a file in use: "//outcome%errors)
  end subroutine test_wrong_files

  !> What differs is named; what may differ does not count.
  subroutine test_wrong_decks()
    type(outcome_t) :: outcome
    character(len=:), allocatable :: path, go_on

    path = scratch("source.h5")
    go_on = " --restart "//path
    call expect_status(frame//" --quiet -o "//path, 0, outcome)
    call expect_refused(frame//" -D parts=4"//go_on, 3, "it has 7 nodes, the deck 5")
    call expect_refused(frame//" -D push=21"//go_on, 3, "loads of the deck differ")
    call expect_refused(frame//" -D second=0.09"//go_on, 3, "behind TEND 0.09")
    call expect_refused(frame//" -D first=0.06"//go_on, 3, "analyses before")
    call expect_edited("T 0.002 TW 0.002", "T 0.002 TW 0.003", 3, "model/sections")
    call expect_edited("SINE 1 15", "SINE 1 16", 3, "functions of the deck differ")
    call expect_edited("DAMP 0.1", "DAMP 0.2", 3, "damping of the deck")
    call expect_edited("IMPERFECTION 1 0.01", "IMPERFECTION 1 0.02", 3, "analyses before")
    call expect_edited("STATIC STEPS 2", "STATIC STEPS 3", 3, "analyses before")
    call expect_edited("TRANSIENT TEND {second} STEP 0.0005 EVERY 0.001", "STATIC", 3, &
                       "is no TRANSIENT")
    call expect_edited("EVERY 0.001", "EVERY 0.001"//newline//"OUTPUT NODES 1", 3, "OUTPUT NODES")
    call expect_edited("FIX 1", "FIX 1  # and nothing else", 0, "")
    call expect_edited("EIGEN MODES 2", "EIGEN MODES 1", 0, "")
    call expect_edited("EIGEN MODES 2", "XF 2 0 0 9"//newline//"STATIC STEPS 1", 0, "")

  contains

    !> With one phrase of the deck replaced.
    subroutine expect_edited(old, new, status, words)
      character(len=*), intent(in) :: old, new, words
      integer, intent(in) :: status
      character(len=:), allocatable :: text, deck
      integer :: at

      call read_text(frame, text)
      at = index(text, old)
      call expect(at > 0, "'"//old//"' is in the deck")
      deck = scratch("edited.deck")
      call make_file(deck, text(:at - 1)//new//text(at + len(old):))
      if (status > 0) call expect_refused(deck//go_on, status, words)
      if (status == 0) call expect_status(deck//" --quiet -o "//scratch("rest.h5")//go_on, 0, &
                                          outcome)
    end subroutine expect_edited

  end subroutine test_wrong_decks

end module test_restart_refused
