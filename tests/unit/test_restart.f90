!> spar run --restart: a run that stopped and goes on leaves what one that never stopped does, bit
!> by bit.
module test_restart
  use kinds, only: wp
  use errors, only: error_t
  use text, only: string_t, newline, to_text
  use check, only: run, expect
  use output_reader, only: reader_t, dataset_t
  use program_runs, only: outcome_t, scratch, read_text, make_file, file_there, same_bytes
  use restart_runs, only: cases, expect_status, mechanism, pendulum, fresh, frame
  use result_reader, only: get_reals, get_integers, get_numbers
  implicit none
  private

  public :: run_restart_tests

contains

  subroutine run_restart_tests()
    call run("restart: a later end, equal steps", test_later_end)
    call run("restart: an end between two outputs", test_odd_end)
    call run("restart: a later end, steps by their error", test_adaptive)
    call run("restart: interrupted", test_interrupted)
    call run("restart: interrupted between two outputs", test_between)
    call run("restart: killed", test_killed)
    call run("restart: after no solution, with shorter steps", test_no_solution)
    call run("restart: several analyses", test_analyses)
    call run("restart: OUTPUT keeps a part", test_choice)
    call run("restart: nothing left to do", test_complete)
    call run("restart: into the same file", test_in_place)
    call run("restart: a point that was written in part", test_torn)
    call run("restart: without /VTKHDF", test_no_drawing)
  end subroutine run_restart_tests

  !> All datasets of two files are equal bit by bit, but for the text of the deck.
  subroutine expect_same(first, second, what)
    character(len=*), intent(in) :: first, second, what
    type(reader_t) :: a, b
    type(error_t), allocatable :: error
    type(string_t), allocatable :: paths(:), others(:)
    integer :: i, compared

    call a%open(first, error)
    if (.not. allocated(error)) call b%open(second, error)
    call expect(.not. allocated(error), what//": both files are there")
    if (allocated(error)) return
    call a%list("", paths)
    call b%list("", others)
    call expect(size(paths) == size(others), what//": as many datasets")
    compared = 0
    do i = 1, size(paths)
      if (index(paths(i)%s, "/deck/") == 1) cycle
      call expect(same_dataset(a, b, paths(i)%s), what//": "//paths(i)%s)
      if (index(paths(i)%s, "/analysis/") == 1) compared = compared + 1
    end do
    call expect(compared > 20, what//": there are results")
    call a%close()
    call b%close()
  end subroutine expect_same

  logical function same_dataset(a, b, path) result(same)
    type(reader_t), intent(in) :: a, b
    character(len=*), intent(in) :: path
    type(dataset_t) :: first, second
    type(error_t), allocatable :: error

    call a%read(path, first, error)
    if (.not. allocated(error)) call b%read(path, second, error)
    same = .not. allocated(error)
    if (same) same = size(first%value) == size(second%value) .and. &
                     size(first%extents) == size(second%extents)
    if (same) same = all(first%extents == second%extents)
    if (same) same = all(transfer(first%value, [0]) == transfer(second%value, [0]))
  end function same_dataset

  !> Run with an early end and go on to the late one: the same as at once.
  subroutine expect_continued(front, early, late, tail)
    character(len=*), intent(in) :: front, early, late, tail   !< of the TRANSIENT card, the ends
    type(outcome_t) :: outcome
    character(len=:), allocatable :: whole, part, rest

    whole = fresh("whole.h5")
    part = fresh("begun.h5")
    rest = fresh("rest.h5")
    call expect_status(mechanism(front//"TRANSIENT TEND "//late//tail)//" --quiet -o "//whole, 0, &
                       outcome)
    call expect_status(mechanism(front//"TRANSIENT TEND "//early//tail)//" --quiet -o "//part, 0, &
                       outcome)
    call expect_status(mechanism(front//"TRANSIENT TEND "//late//tail)//" -o "//rest// &
                       " --restart "//part, 0, outcome)
    call expect(index(outcome%output, "Goes on from "//part//" at time "//early) > 0, &
                "where it goes on is said: "//outcome%output)
    call expect_same(whole, rest, "TEND "//early//", "//late//tail)
  end subroutine expect_continued

  !> The angle of the shaft is the known 40 t**2, beyond a full turn: the test covers what it says.
  subroutine test_later_end()
    real(wp), allocatable :: strain(:)
    integer, allocatable :: extents(:)

    call expect_continued("", "0.3", "0.6", " STEP 0.002")
    call expect_described(scratch("rest.h5"))
    call get_reals(scratch("rest.h5"), "analysis/01_transient/joints/strain", strain, extents)
    call expect(size(strain) > 18, "strains are there")
    if (size(strain) <= 18) return
    call expect(abs(strain(size(strain) - 17) - 40*0.36_wp) < 1.0e-9_wp, "two rounds")
    call get_reals(scratch("begun.h5"), "analysis/01_transient/joints/strain", strain, extents)
    call expect(size(strain) > 18 .and. maxval(strain) < 6.0_wp, &
                "the second begins behind the restart")
    call expect_continued("", "0.12", "0.6", " STEP 0.003 RHOINF 0.5")
  end subroutine test_later_end

  !> The early end is no multiple of EVERY: its state is not kept; Times are not
  !> sums of steps, which would be rounded.
  subroutine test_odd_end()
    real(wp), allocatable :: time(:)
    integer, allocatable :: extents(:)
    integer :: i

    call expect_continued("", "0.304", "0.6", " STEP 0.002 EVERY 0.05")
    call get_reals(scratch("rest.h5"), "analysis/01_transient/time", time, extents)
    call expect(size(time) == 13, "no state more")
    call get_reals(scratch("begun.h5"), "analysis/01_transient/time", time, extents)
    call expect(size(time) == 8, "with the end's")
    call expect_continued("", "0.1", "0.34", " STEP 0.01")
    call get_reals(scratch("rest.h5"), "analysis/01_transient/time", time, extents)
    call expect(all(abs(time - [(i/100.0_wp, i=0, 34)]) <= 0), "times are round numbers")
  end subroutine test_odd_end

  !> Every dataset of /restart has its row in docs/results.md, with its own words.
  subroutine expect_described(path)
    character(len=*), intent(in) :: path
    type(reader_t) :: reader
    type(error_t), allocatable :: error
    type(string_t), allocatable :: paths(:)
    character(len=:), allocatable :: page, words
    integer :: i

    call read_text("docs/results.md", page)
    call reader%open(path, error)
    call expect(.not. allocated(error), "the file is read")
    if (allocated(error)) return
    call reader%list("/restart", paths)
    call expect(size(paths) > 2, "there are datasets in /restart")
    do i = 1, size(paths)
      call reader%get_text(paths(i)%s, "description", words)
      words = "| `"//paths(i)%s//"` | (numbers) | `1` | number | "//words//" |"
      call expect(index(page, words) > 0, "docs/results.md has the row "//words)
    end do
    call reader%close()
  end subroutine expect_described

  subroutine test_adaptive()
    call expect_continued("", "0.3", "0.5", " TOL 1e-3 EVERY 0.05")
  end subroutine test_adaptive

  !> Stop a pendulum that would swing for long by a signal; the time that it has reached.
  subroutine stop_pendulum(path, signal, status, tail, time)
    character(len=*), intent(in) :: path, signal, tail
    integer, intent(in) :: status
    real(wp), intent(out) :: time
    type(outcome_t) :: outcome
    real(wp), allocatable :: times(:)
    integer, allocatable :: extents(:)

    call expect_status(pendulum("TRANSIENT TEND 5e4"//tail)//" --quiet -o "//path, status, &
                       outcome, "timeout --preserve-status --foreground -s "//signal//" 1")
    call get_reals(path//trim(merge(".part", "     ", signal == "KILL")), &
                   "analysis/01_transient/time", times, extents)
    time = maxval([times, 0.0_wp])   ! the last rows may be missing where a kill met their writing
    call expect(time > 0, "some steps before "//signal)
  end subroutine stop_pendulum

  !> Go on from a file to a bit behind a time, and compare with a run to there.
  subroutine expect_pendulum(from, time, tail)
    character(len=*), intent(in) :: from, tail
    real(wp), intent(in) :: time
    type(outcome_t) :: outcome
    character(len=:), allocatable :: card, whole

    card = "TRANSIENT TEND "//to_text(ceiling(time) + 1)//tail
    whole = fresh("whole.h5")
    call expect_status(pendulum(card)//" --quiet -o "//whole, 0, outcome)
    call expect_status(pendulum(card)//" --quiet -o "//scratch("swing.h5")//" --restart "//from, &
                       0, outcome)
    call expect_same(whole, scratch("swing.h5"), card)
  end subroutine expect_pendulum

  subroutine test_interrupted()
    character(len=:), allocatable :: path
    type(outcome_t) :: outcome
    real(wp) :: time
    real(wp), allocatable :: before(:), behind(:)
    integer, allocatable :: numbers(:), extents(:)

    path = fresh("swing.h5")
    call stop_pendulum(path, "INT", 130, " STEP 0.002", time)
    call expect_status(pendulum("TRANSIENT TEND 5e4 STEP 0.002")//" -o "// &
                       scratch("other.h5"), 130, &
                       outcome, "timeout --preserve-status --foreground -s INT 0.5")
    call expect(index(outcome%output, "with --restart "//scratch("other.h5")) > 0, &
                "how to go on is said: "//outcome%output)
    call get_numbers(path, "/", "complete", numbers)
    call expect(size(numbers) == 1 .and. all(numbers == 0), "complete = 0")
    call expect_pendulum(path, time, " STEP 0.002")
    path = fresh("swing.h5")
    call stop_pendulum(path, "TERM", 130, " TOL 1e-5", time)
    call expect_status(scratch("pendulum.deck")//" --quiet -o "//scratch("longer.h5")// &
                       " --restart "//path, 130, outcome, &
                       "timeout --preserve-status --foreground -s TERM 1")
    call get_reals(path, "analysis/01_transient/time", before, extents)
    call get_reals(scratch("longer.h5"), "analysis/01_transient/time", behind, extents)
    call expect(size(behind) > size(before), "twice interrupted")
    if (size(behind) > size(before)) then
      call expect(all(abs(behind(:size(before)) - before) <= 0), "the same states first")
    end if
  end subroutine test_interrupted

  !> Within an interval of the output no step is lost: the run goes on from the last one. Intervals
  !> are so long that no block of states is written in the time given.
  subroutine test_between()
    type(outcome_t) :: outcome
    character(len=:), allocatable :: path
    real(wp) :: time

    path = fresh("swing.h5")
    call stop_pendulum(path, "TERM", 130, " STEP 0.0001 EVERY 0.2", time)
    call expect_status(pendulum("TRANSIENT TEND "//to_text(ceiling(time) + 1)// &
                                " STEP 0.0001 EVERY 0.2")//" -o "//scratch("other.h5")// &
                       " --restart "//path, 0, outcome)
    call expect(index(outcome%output, "at time "//to_text(time)//" of") == 0, &
                "not only from the last state recorded")
    call expect_pendulum(path, time, " STEP 0.0001 EVERY 0.2")
    path = fresh("swing.h5")
    call stop_pendulum(path, "INT", 130, " TOL 1e-6 EVERY 0.1", time)
    call expect_pendulum(path, time, " TOL 1e-6 EVERY 0.1")
  end subroutine test_between

  !> What `kill -9` leaves is enough; its remains are gone when the run has gone on.
  subroutine test_killed()
    type(outcome_t) :: outcome
    character(len=:), allocatable :: path
    character(len=*), parameter :: place(2) = ["first ", "second"]
    real(wp) :: time
    real(wp), allocatable :: point(:)
    integer, allocatable :: extents(:)
    integer :: i

    path = fresh("swing.h5")
    call stop_pendulum(path, "KILL", 137, " STEP 0.001", time)
    do i = 1, 2
      call get_reals(path//".part", "restart/01_transient/"//trim(place(i)), point, extents)
      call expect(any(point > 0), "there is a point in the "//trim(place(i))//" place")
    end do
    call expect_status(scratch("pendulum.deck")//" --restart "//path, 5, outcome)
    call expect(index(outcome%errors, "hint: --restart "//path//".part") > 0, outcome%errors)
    call expect_pendulum(path//".part", time, " STEP 0.001")
    call expect(.not. file_there(path//".part"), "the part is gone")
    call expect(.not. file_there(path//".restart.part"), "and the other one")
  end subroutine test_killed

  !> A force that no large step can follow: the steps before are kept, shorter ones get on.
  subroutine test_no_solution()
    type(outcome_t) :: outcome
    character(len=:), allocatable :: path
    character(len=*), parameter :: kick = "FUNCTION kick STEP 0.5"//newline// &
                                          "XF 2 0 1e9 0 FUNCTION kick"//newline
    real(wp), allocatable :: before(:), behind(:)
    integer, allocatable :: extents(:)

    path = fresh("stuck.h5")
    call expect_status(pendulum(kick//"TRANSIENT TEND 0.501 STEP 0.1")//" --quiet -o "//path, 4, &
                       outcome)
    call get_reals(path, "analysis/01_transient/time", before, extents)
    call expect_status(pendulum(kick//"TRANSIENT TEND 0.501 STEP 1e-6 EVERY 1e-4")// &
                       " --quiet -o "//path//" --restart "//path, 0, outcome)
    call get_reals(path, "analysis/01_transient/time", behind, extents)
    call expect(size(before) > 4 .and. size(behind) > size(before), "goes on")
    if (size(behind) < size(before)) return
    call expect(all(abs(behind(:size(before)) - before) <= 0), "behind what was there")
  end subroutine test_no_solution

  !> Modes, imperfections and static steps before; modes and a second motion behind; in the first
  !> motion and in the second.
  subroutine test_analyses()
    type(outcome_t) :: outcome
    character(len=:), allocatable :: whole, part, rest, text, deck

    whole = fresh("whole.h5")
    part = fresh("begun.h5")
    rest = fresh("rest.h5")
    call expect_status(frame//" --quiet -o "//whole, 0, outcome)
    call expect_status(frame//" --quiet -D second=0.07 -o "//part, 0, outcome)
    call expect_status(frame//" --quiet -o "//rest//" --restart "//part, 0, outcome)
    call expect_same(whole, rest, "in the second motion")
    call read_text(frame, text)
    deck = scratch("swing.deck")
    call make_file(deck, text(:index(text, "EIGEN") - 1))
    call expect_status(deck//" --quiet -D first=0.02 -D second=1 -o "//part, 0, outcome)
    call expect_status(frame//" --quiet -o "//rest//" --restart "//part, 0, outcome)
    call expect_same(whole, rest, "in the first")
    call expect_status(deck//" --quiet -D second=1 -o "//part, 0, outcome)
    call expect_status(frame//" --quiet -o "//rest//" --restart "//part, 0, outcome)
    call expect_same(whole, rest, "behind the first")
    call expect_status(cases//"driven.deck --quiet -o "//whole, 0, outcome)
    call expect_status(cases//"driven.deck --quiet -D end=1.5 -o "//part, 0, outcome)
    call expect_status(cases//"driven.deck --quiet -o "//rest//" --restart "//part, 0, outcome)
    call expect_same(whole, rest, "behind a KINEMATIC")
  end subroutine test_analyses

  !> Nodes that histories do not keep are drawn all the same.
  subroutine test_choice()
    integer, allocatable :: values(:), extents(:)

    call expect_continued("OUTPUT NODES 5 2"//newline//"OUTPUT ELEMENTS 3"//newline, "0.2", "0.4", &
                          " STEP 0.004")
    call get_integers(scratch("rest.h5"), "analysis/01_transient/nodes/index", values, extents)
    call expect(size(values) == 6, "two nodes")
  end subroutine test_choice

  subroutine test_complete()
    type(outcome_t) :: outcome
    character(len=:), allocatable :: part, rest

    part = fresh("begun.h5")
    rest = fresh("rest.h5")
    call expect_status(frame//" --quiet -o "//part, 0, outcome)
    call expect_status(frame//" -o "//rest//" --restart "//part, 0, outcome)
    call expect(index(outcome%output, "is already at its end") > 0, outcome%output)
    call expect_same(part, rest, "nothing left to do")
    call expect_status(mechanism("TRANSIENT TEND 0.101 STEP 0.002 EVERY 0.01")//" -o "//part, 0, &
                       outcome)
    call expect_status(scratch("mechanism.deck")//" --quiet -o "//rest//" --restart "//part, 0, &
                       outcome)
    call expect_same(part, rest, "with its odd end")
  end subroutine test_complete

  !> By default the file is replaced, and only when all is there.
  subroutine test_in_place()
    type(outcome_t) :: outcome
    character(len=:), allocatable :: path, copy
    integer, allocatable :: extents(:)
    real(wp), allocatable :: time(:)

    path = fresh("place.h5")
    copy = scratch("copy.h5")
    call expect_status(mechanism("TRANSIENT TEND 0.1 STEP 0.002")//" --quiet -o "//path, 0, outcome)
    call execute_command_line("cp "//path//" "//copy)
    call expect_status(mechanism("TRANSIENT TEND 0.05 STEP 0.002")//" --quiet -o "//path// &
                       " --restart "//path, 3, outcome)
    call expect(same_bytes(path, copy), "untouched after an error")
    call expect(.not. file_there(path//".part"), "nothing beside it")
    call expect_status(mechanism("TRANSIENT TEND 0.2 STEP 0.002")//" --quiet -o "//path// &
                       " --restart "//path//" --no-overwrite", 5, outcome)
    call expect(same_bytes(path, copy), "untouched with --no-overwrite")
    call expect_status(scratch("mechanism.deck")//" --quiet -o "//path//" --restart "//path, 0, &
                       outcome)
    call get_reals(path, "analysis/01_transient/time", time, extents)
    call expect(size(time) == 101, "goes on in its place")
    call expect(.not. file_there(path//".part"), "nothing beside it")
  end subroutine test_in_place

  !> A kill while a point is being written leaves the one before: here its last number is spoilt.
  subroutine test_torn()
    type(outcome_t) :: outcome
    character(len=:), allocatable :: path, text
    real(wp), allocatable :: point(:)
    integer, allocatable :: extents(:)
    character(len=8) :: bytes
    integer :: at

    path = fresh("torn.h5")
    call expect_status(pendulum("TRANSIENT TEND 1 STEP 0.01")//" --quiet -o "//path, 0, outcome)
    call get_reals(path, "restart/01_transient/first", point, extents)
    call expect(size(point) > 20, "a point")
    if (size(point) < 20) return
    bytes = transfer(point(1), bytes)
    call expect(abs(point(1) - 1) <= 0 .and. abs(point(size(point)) - 1) <= 0, "between its times")
    call read_text(path, text)
    at = index(text, transfer(point(5:), repeat(" ", 8*size(point(5:)))))
    call expect(at > 0, "its bytes are found")
    if (at == 0) return
    at = at + 8*(size(point) - 5)
    text(at:at + 7) = transfer(0.99_wp, bytes)
    call make_file(path, text)
    call expect_status(scratch("pendulum.deck")//" --restart "//path, 5, outcome)
    call expect(index(outcome%errors, "holds no restart point") > 0, outcome%errors)
  end subroutine test_torn

  subroutine test_no_drawing()
    type(outcome_t) :: outcome
    character(len=:), allocatable :: part, rest
    integer, allocatable :: numbers(:)

    part = fresh("begun.h5")
    rest = fresh("rest.h5")
    call expect_status(mechanism("TRANSIENT TEND 0.1 STEP 0.01")//" --quiet --no-vtk -o "//part, &
                       0, outcome)
    call expect_status(mechanism("TRANSIENT TEND 0.2 STEP 0.01")//" --quiet -o "//rest// &
                       " --restart "//part, 0, outcome)
    call get_numbers(rest, "VTKHDF/Steps", "NSteps", numbers)
    call expect(size(numbers) == 1 .and. all(numbers == 21), "all states are drawn")
    call expect_status(mechanism("TRANSIENT TEND 0.3 STEP 0.01")//" --quiet --no-vtk -o "//part// &
                       " --restart "//rest, 0, outcome)
    call get_numbers(part, "VTKHDF/Steps", "NSteps", numbers)
    call expect(size(numbers) == 0, "none is")
  end subroutine test_no_drawing

end module test_restart
