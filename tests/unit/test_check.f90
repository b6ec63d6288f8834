!> `spar check`: models whose overconstraints and free motions are known from theory.
module test_check
  use kinds, only: wp
  use errors, only: error_t
  use text, only: newline
  use check, only: run, expect, expect_close
  use json_numbers, only: member, elements, numbers, word
  use linalg_rank, only: dependent_rows
  use program_runs, only: outcome_t, run_spar, scratch, make_file, read_text, file_there
  use result_reader, only: get_reals, get_integers
  implicit none
  private

  public :: run_check_tests

  character(len=*), parameter :: cases = "tests/cases/check/"

contains

  subroutine run_check_tests()
    call run("check: overconstraints and motions known from theory", test_theory)
    call run("check: releases that it suggests remove the overconstraints", test_releases)
    call run("check: who holds whom", test_names)
    call run("check: free motions", test_motions)
    call run("check: free motions of bodies and released beams", test_bodies)
    call run("check: what the analyses need", test_soundness)
    call run("check: prescribed motions that contradict each other", test_contradictions)
    call run("check: counts", test_counts)
    call run("check: the example of the manual", test_manual_example)
    call run("check: free motions in the result file", test_file)
    call run("check: dependent rows of a large matrix", test_rank)
    call run("check: large models", test_large)
  end subroutine run_check_tests

  !> Check a deck and compare the exit status; the report as JSON.
  subroutine inspect(arguments, status, report, errors)
    character(len=*), intent(in) :: arguments
    integer, intent(in) :: status
    character(len=:), allocatable, intent(out) :: report
    character(len=:), allocatable, intent(out), optional :: errors
    type(outcome_t) :: outcome
    character(len=30) :: detail

    call run_spar("check --json "//arguments, outcome)
    write (detail, "('status ', i0, ' instead of ', i0)") outcome%status, status
    call expect(outcome%status == status, trim(detail)//": "//arguments//newline//outcome%errors)
    report = outcome%output
    if (present(errors)) errors = outcome%errors
  end subroutine inspect

  !> A number of an object in the report.
  integer function number_of(report, object, key) result(number)
    character(len=*), intent(in) :: report, object, key
    real(wp) :: found(1)

    found = numbers(member(member(report, object), key)//" ")
    number = nint(found(1))
  end function number_of

  subroutine expect_number(report, object, key, number, what)
    character(len=*), intent(in) :: report, object, key, what
    integer, intent(in) :: number

    call expect_close(real(number_of(report, object, key), wp), real(number, wp), 0.1_wp, &
                      what//": "//object//" "//key)
  end subroutine expect_number

  subroutine expect_text(text, part)
    character(len=*), intent(in) :: text, part

    call expect(index(text, part) > 0, "'"//part//"' in:"//newline//text)
  end subroutine expect_text

  !> A deck of these lines, in a file of the scratch folder.
  subroutine make_deck(name, text, path)
    character(len=*), intent(in) :: name, text
    character(len=:), allocatable, intent(out) :: path

    path = scratch(name//".deck")
    call make_file(path, text)
  end subroutine make_deck

  !> The deck of a case with cards before and behind its own.
  subroutine extend(name, front, back, path)
    character(len=*), intent(in) :: name, front, back
    character(len=:), allocatable, intent(out) :: path
    character(len=:), allocatable :: text

    call read_text(cases//name//".deck", text)
    call make_deck(name, front//newline//text//back//newline, path)
  end subroutine extend

  !> Kutzbach's count against the mobility that the geometry gives; of the spring hinge the rank of
  !> the six planar and spatial constraints by hand (see the decks' titles).
  subroutine test_theory()
    call expect_counts("four_bar", 3, 3, 1)
    call expect_counts("bricard", 3, 1, 1)
    call expect_counts("slider_crank", 3, 3, 1)
    call expect_counts("double_pendulum", 0, 0, 2)
    call expect_counts("cross_hinge", 0, 1, 0)
    call expect_counts("cross_hinge_stiff", 0, 3, 0)
    call expect_counts("clamped", 0, 6, 0)
    call expect_counts("clamped_one", 0, 6, 0)
  end subroutine test_theory

  subroutine expect_counts(name, status, redundant, motions)
    character(len=*), intent(in) :: name
    integer, intent(in) :: status, redundant, motions
    character(len=:), allocatable :: report

    call inspect(cases//name//".deck", status, report)
    call expect_number(report, "constraints", "redundant", redundant, name)
    call expect_number(report, "degrees_of_freedom", "free_motions", motions, name)
    call expect(number_of(report, "degrees_of_freedom", "all") == &
                number_of(report, "coordinates", "free") - &
                number_of(report, "constraints", "all") + redundant, name//": freedoms")
  end subroutine expect_counts

  subroutine test_releases()
    call expect_released("four_bar", 3)
    call expect_released("bricard", 3)
    call expect_released("slider_crank", 3)
    call expect_released("cross_hinge", 0)
    call expect_released("cross_hinge_stiff", 0)
    call expect_released("clamped", 0)
    call expect_released("clamped_one", 0)
  end subroutine test_releases

  !> One release after the other, each removes one constraint too many and lets nothing move.
  subroutine expect_released(name, status)
    character(len=*), intent(in) :: name
    integer, intent(in) :: status
    character(len=:), allocatable :: first, report, path, cards, card
    integer :: i, redundant, motions

    call inspect(cases//name//".deck", status, first)
    redundant = number_of(first, "constraints", "redundant")
    motions = number_of(first, "degrees_of_freedom", "free_motions")
    cards = ""
    do i = 1, redundant
      card = word(member(elements(member(first, "overconstrained"), i), "release"))
      call expect(index(card, "RLSE ") == 1, name//": a release, got '"//card//"'")
      cards = cards//card//newline
      call extend(name, cards, "", path)
      call inspect(path, status, report)
      call expect_number(report, "constraints", "redundant", redundant - i, name//", "//card)
      call expect_number(report, "degrees_of_freedom", "free_motions", motions, name//", "//card)
    end do
  end subroutine expect_released

  !> Of the spring hinge, the plane's normal is held by both springs: their bending across it and
  !> the body between them, by symmetry of equal weight in both.
  subroutine test_names()
    character(len=:), allocatable :: report, one
    type(outcome_t) :: outcome
    real(wp), allocatable :: weight(:)
    integer :: i

    call inspect(cases//"cross_hinge.deck", 0, report)
    one = elements(member(report, "overconstrained"), 1)
    allocate (weight, source=numbers(member(one, "weights")))
    call expect(size(weight) >= 4 .and. all(abs(weight) > 1.0e-6_wp), "weights")
    do i = 2, size(weight)
      call expect(abs(weight(i)) < (1 + 1.0e-5_wp)*abs(weight(i - 1)), "the largest come first")
    end do
    call expect_text(member(one, "strains"), """element 1 mode 5 (bending)""")
    call expect_text(member(one, "strains"), """element 2 mode 6 (bending)""")
    call expect(index(member(one, "strains"), "mode 1 ") == 0, "no elongation takes part")
    call expect(index(member(one, "strains"), "element 1 mode 2") == 0, "nor a flexible mode")
    call expect(member(one, "fixed_nodes") == "[""node 1"", ""node 2""]", "the fixed nodes")
    call run_spar("check "//cases//"cross_hinge.deck", outcome)
    call expect_text(outcome%output, "overconstrained once: element ")
    call expect_text(outcome%output, " hold each other with FIX of nodes 1, 2; RLSE ")
    call run_spar("check "//cases//"clamped_one.deck", outcome)
    call expect_text(outcome%output, "element 1 mode 2 (torsion) is held already by FIX of nodes")
    call expect_text(outcome%output, "overconstrained, 6 of 6: ")
    call run_spar("check "//cases//"cross_hinge_stiff.deck", outcome)
    call expect_text(outcome%output, "    RLSE 1 2"//newline)
  end subroutine test_names

  subroutine test_motions()
    character(len=:), allocatable :: report, one
    type(outcome_t) :: outcome
    real(wp), allocatable :: value(:)

    call inspect(cases//"double_pendulum.deck", 0, report)
    call expect(word(member(report, "refusal")) == "", "TRANSIENT may have free motions")
    one = elements(member(report, "motions"), 2)
    call expect(member(one, "released") == "[""element 4 mode 1 (hinge)""]", "the lower hinge")
    call expect(index(member(one, "coordinates"), "node 2 ") == 0, "the upper bob stands")
    allocate (value, source=numbers(member(one, "values")))
    call expect(size(value) == 3, "node 3 and the rotations of both ends of the lower beam")
    call run_spar("check "//cases//"double_pendulum.deck", outcome)
    call expect_text(outcome%output, "INPUTE 4 1 drive it")
    call run_spar("run "//cases//"four_bar.deck -o "//scratch("four_bar.h5"), outcome)
    call expect(outcome%status == 3, "run refuses a mechanism under STATIC")
    call expect_text(outcome%errors, "by element 4 mode 1 (hinge)")
    call expect_text(outcome%errors, "STATIC needs a structure")
  end subroutine test_motions

  !> A body that nothing holds has six motions; a cantilever whose bending at the clamp is released
  !> in one plane turns there.
  subroutine test_bodies()
    character(len=:), allocatable :: report, path, one
    character(len=*), parameter :: beam = "NODE 1 0 0 0"//newline//"NODE 2 2 0 0"//newline// &
      "BEAM 1 1 2 0 0 1 SECTION s MATERIAL m"//newline//"SECTION s RECT H 0.1 B 0.2"//newline// &
      "MATERIAL m E 1e9 NU 0.3 RHO 1000"//newline

    call make_deck("body", beam//"EIGEN MODES 2"//newline, path)
    call inspect(path, 0, report)
    call expect_number(report, "degrees_of_freedom", "free_motions", 6, "a free body")
    call expect_number(report, "degrees_of_freedom", "flexible", 6, "a free body")
    call make_deck("body", beam//"STATIC"//newline, path)
    call inspect(path, 3, report)
    call make_deck("released", beam//"RLSE 1 3"//newline//"FIX 1"//newline//"STATIC"//newline, path)
    call inspect(path, 3, report)
    call expect_number(report, "degrees_of_freedom", "free_motions", 1, "a hinge at the clamp")
    one = elements(member(report, "motions"), 1)
    call expect(member(one, "released") == "[""element 1 mode 3 (bending)""]", "the hinge is named")
    call make_deck("released", beam//"RLSE 1 3 4"//newline//"FIX 1"//newline//"STATIC"//newline, &
                   path)
    call inspect(path, 3, report)
    call expect_number(report, "degrees_of_freedom", "free_motions", 2, "bending is free")
    one = elements(member(report, "motions"), 1)
    call expect_text(member(one, "released"), "element 1 mode ")
  end subroutine test_bodies

  subroutine test_soundness()
    character(len=:), allocatable :: report, path, errors

    call extend("four_bar", "", "STATIC", path)
    call inspect(path, 3, report, errors)
    call expect_text(errors, "STATIC needs a structure")
    call expect(word(member(report, "refusal")) /= "", "the reason is in the report")
    call expect(member(report, "sound") == "false", "unsound")
    call extend("four_bar", "", "TRANSIENT TEND 1 STEP 0.1", path)
    call inspect(path, 0, report)
    call expect(member(report, "sound") == "true", "sound")
    call expect_number(report, "degrees_of_freedom", "free_motions", 1, "TRANSIENT")
    call extend("four_bar", "", "EIGEN", path)
    call inspect(path, 0, report)
    call extend("four_bar", "", "KINEMATIC TEND 1 STEP 0.1", path)
    call inspect(path, 3, report, errors)
    call expect_text(errors, "KINEMATIC needs every motion prescribed")
    call drive("INPUTE 4 1 0.1"//newline//"STATIC")
    call drive("INPUTE 4 1 0 0.1"//newline//"KINEMATIC TEND 1 STEP 0.1")
    call drive("DYNE 4 1"//newline//"ESTIFF 4 1"//newline//"STATIC")

  contains

    !> The four-bar with the crank driven or held by a spring.
    subroutine drive(cards)
      character(len=*), intent(in) :: cards
      character(len=:), allocatable :: text
      integer :: at

      call read_text(cases//"four_bar.deck", text)
      at = index(text, "RLSE 4:7 1")
      call make_deck("driven", text(:at - 1)//"RLSE 5:7 1"//text(at + 10:)//cards//newline, path)
      call inspect(path, 0, report)
      call expect_number(report, "degrees_of_freedom", "free_motions", 0, cards)
      call expect_number(report, "constraints", "redundant", 3, cards)
    end subroutine drive

  end subroutine test_soundness

  !> Bars on a line: what two of them get longer the third has to as well.
  subroutine test_contradictions()
    character(len=:), allocatable :: report, errors, text, path
    type(outcome_t) :: outcome

    call inspect(cases//"lengths.deck", 0, report)
    call expect_number(report, "constraints", "redundant", 1, "lengths that agree")
    call expect(word(member(report, "contradiction")) == "", "no contradiction")
    call inspect("-D third=0.2 "//cases//"lengths.deck", 3, report, errors)
    call expect_text(errors, "the motions prescribed for element 1 mode 1 (elongation), "// &
                     "element 3 mode 1 (elongation) contradict each other: element 2 mode 1 "// &
                     "(elongation) connects them")
    call expect_text(report, """contradiction"": ""the motions")
    call run_spar("run -D third=0.2 "//cases//"lengths.deck -o "//scratch("lengths.h5"), outcome)
    call expect(outcome%status == 3, "status 3 of the run")
    call expect_text(outcome%errors, "contradict each other")
    call run_spar("run "//cases//"lengths.deck -o "//scratch("lengths.h5"), outcome)
    call expect(outcome%status == 0, "lengths that agree are solved: "//outcome%errors)
    call expect_text(outcome%errors, "warning: overconstrained once: element 1 mode 1 (elongation)")
    call inspect("-D first=0 "//cases//"lengths.deck", 3, report, errors)

    call read_text(cases//"lengths.deck", text)
    text = text(:index(text, "INPUTE 1") - 1)
    call make_deck("one", text//"INPUTE 3 1 0.1"//newline//"RLSE 2 1"//newline//"STATIC", path)
    call inspect(path, 0, report)
    call make_deck("one", text//"INPUTE 3 1 0.1"//newline//"STATIC"//newline, path)
    call make_deck("rates", text//"INPUTE 1 1 0 0.1"//newline//"INPUTE 3 1 0 0.2"//newline// &
                   "KINEMATIC TEND 1 STEP 0.1"//newline, path)
    call inspect(path, 3, report, errors)
    call expect_text(errors, "contradict each other")
    call make_deck("rates", text//"INPUTE 1 1 0 0 0.1"//newline//"INPUTE 3 1 0 0 0.2"//newline// &
                   "KINEMATIC TEND 1 STEP 0.1"//newline, path)
    call inspect(path, 3, report, errors)
    call make_deck("rates", text//"INPUTE 1 1 0 0 0.2"//newline//"INPUTE 3 1 0 0 0.2"//newline// &
                   "KINEMATIC TEND 1 STEP 0.1"//newline, path)
    call inspect(path, 0, report)
  end subroutine test_contradictions

  subroutine test_counts()
    character(len=:), allocatable :: report

    call inspect(cases//"cross_hinge.deck", 0, report)
    call expect_number(report, "nodes", "translational", 4, "cross hinge")
    call expect_number(report, "nodes", "rotational", 4, "cross hinge")
    call expect_number(report, "nodes", "warping", 4, "cross hinge")
    call expect_number(report, "elements", "BEAMW", 2, "cross hinge")
    call expect_number(report, "elements", "BEAM", 1, "cross hinge")
    call expect_number(report, "elements", "HINGE", 0, "cross hinge")
    call expect_number(report, "strains", "all", 2*8 + 6, "cross hinge")
    call expect_number(report, "strains", "flexible", 2*5, "modes 2, 3, 4, and 7, 8 with 2")
    call expect_number(report, "constraints", "all", 2*3 + 6, "cross hinge")
    call inspect(cases//"slider_crank.deck", 3, report)
    call expect_number(report, "elements", "PRISMATIC", 1, "slider")
    call expect_number(report, "strains", "released", 4, "slider")
    call inspect(cases//"lengths.deck", 0, report)
    call expect_number(report, "strains", "prescribed", 2, "bars")
    call expect_number(report, "strains", "fixed", 1, "bars")
  end subroutine test_counts

  !> What docs/manual_program.md shows is what the program prints.
  subroutine test_manual_example()
    character(len=*), parameter :: command = "    $ spar check cross_hinge.deck"//newline
    character(len=:), allocatable :: manual, line
    type(outcome_t) :: outcome
    integer :: lines

    call run_spar("check "//cases//"cross_hinge.deck", outcome)
    call read_text("docs/manual_program.md", manual)
    manual = manual(index(manual, command) + len(command):)
    lines = 0
    do while (index(manual, "    ") == 1)
      line = manual(5:index(manual, newline))
      call expect(index(newline//outcome%output, newline//line) > 0, "printed: "//line)
      manual = manual(index(manual, newline) + 1:)
      lines = lines + 1
    end do
    call expect(lines > 15, "the example is there")
  end subroutine test_manual_example

  !> The four-bar's motion: crank and rocker turn about their pivots, the coupler keeps its length.
  subroutine test_file()
    character(len=:), allocatable :: report, path
    type(outcome_t) :: outcome
    real(wp), allocatable :: u(:)
    integer, allocatable :: id(:), shape(:)
    real(wp) :: crank(3), rocker(3)
    integer :: n

    path = scratch("motions.h5")
    call execute_command_line("rm -f "//path)
    call inspect(cases//"four_bar.deck", 3, report)
    call expect(.not. file_there(path), "no file unless asked for")
    call inspect(cases//"four_bar.deck -o "//path, 3, report)
    call get_reals(path, "analysis/01_check/modes/nodes/displacement", u, shape)
    call get_integers(path, "model/nodes/id", id, shape)
    call expect(size(u) == 3*size(id), "one mode")
    if (size(u) /= 3*size(id)) return
    n = findloc(id, 2, 1)
    crank = u(3*n - 2:3*n)
    n = findloc(id, 3, 1)
    rocker = u(3*n - 2:3*n)
    call expect_close(maxval(abs(u)), 1.0_wp, 1.0e-12_wp, "the largest displacement is 1")
    call expect_close(0.2_wp*crank(1) + crank(2), 0.0_wp, 1.0e-12_wp, "the crank turns")
    call expect_close(rocker(2), 0.0_wp, 1.0e-12_wp, "the rocker turns")
    call expect_close(2.8_wp*(rocker(1) - crank(1)) + rocker(2) - crank(2), 0.0_wp, 1.0e-12_wp, &
                      "the coupler keeps its length")
    call expect_close(abs(crank(3)) + abs(rocker(3)), 0.0_wp, 1.0e-12_wp, "in the plane")
    call run_spar("info "//path, outcome)
    call expect_text(outcome%output, "check, 1 mode")
    call expect_text(outcome%output, "/VTKHDF  1 step")
    call inspect(cases//"clamped.deck -o "//path, 0, report)
    call run_spar("info "//path, outcome)
    call expect(outcome%status == 0, "a file without motions can be read")
  end subroutine test_file

  !> Random rows, the last of which are combinations of the others: as many as are found, and the
  !> rest has full rank, as Gram and Schmidt find.
  subroutine test_rank()
    integer, parameter :: rows = 180, columns = 240, extra = 11
    real(wp), allocatable :: a(:, :), q(:, :)
    integer, allocatable :: dependent(:), row(:), column(:)
    type(error_t), allocatable :: error
    integer :: i, j, k

    allocate (a(rows, columns))
    do i = 1, rows
      do j = 1, columns
        a(i, j) = sin(real(i*j, wp) + 3.7_wp*real(i + j*j, wp))
      end do
    end do
    do i = 1, extra
      a(rows + 1 - i, :) = (a(i, :) - a(2*i + 30, :) + 0.5_wp*a(70 + i, :))/2.5_wp
    end do
    row = [((i, i=1, rows), j=1, columns)]
    column = [((j, i=1, rows), j=1, columns)]
    call dependent_rows(rows, columns, row, column, reshape(a, [rows*columns]), 1.0e-10_wp, &
                        dependent, error)
    call expect(.not. allocated(error), "no error")
    call expect_close(real(size(dependent), wp), real(extra, wp), 0.1_wp, "as many as were made")
    allocate (q(columns, rows))
    k = 0
    do i = 1, rows
      if (any(dependent == i)) cycle
      k = k + 1
      q(:, k) = a(i, :)
      do j = 1, k - 1
        q(:, k) = q(:, k) - dot_product(q(:, j), q(:, k))*q(:, j)
      end do
      call expect(norm2(q(:, k)) > 1.0e-4_wp*norm2(a(i, :)), "the others are independent")
      q(:, k) = q(:, k)/norm2(q(:, k))
    end do
  end subroutine test_rank

  !> A ring of rigid beams closes six times too often, wherever round-off hides it; a chain not at
  !> all.
  subroutine test_large()
    character(len=:), allocatable :: report, path, text, card
    character(len=*), parameter :: closing = "BEAM 1000 1000 1"//newline

    call inspect(cases//"loop.deck", 0, report)
    call expect_number(report, "constraints", "redundant", 6, "a ring of 1000")
    call expect_number(report, "degrees_of_freedom", "all", 0, "a ring of 1000")
    call expect_number(report, "degrees_of_freedom", "free_motions", 0, "a ring of 1000")
    card = word(member(elements(member(report, "overconstrained"), 1), "release"))
    call extend("loop", card, "", path)
    call inspect(path, 0, report)
    call expect_number(report, "constraints", "redundant", 5, "with "//card)
    call read_text(cases//"loop.deck", text)
    call make_deck("chain", text(:index(text, closing) - 1)//text(index(text, closing) &
                   + len(closing):), path)
    call inspect(path, 0, report)
    call expect_number(report, "constraints", "redundant", 0, "a chain of 999")
  end subroutine test_large

end module test_check
