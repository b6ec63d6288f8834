!> The program as its users meet it: commands, files, exit statuses, interruptions.
module test_program
  use kinds, only: wp
  use text, only: newline
  use check, only: run, expect, expect_close
  use program_runs, only: outcome_t, run_spar, run_shell, scratch, read_text, make_file, &
                          file_there, same_bytes
  use result_reader, only: get_integers, get_numbers, get_reals
  implicit none
  private

  public :: run_program_tests

  character(len=*), parameter :: cases = "tests/cases/program/", deck = cases//"cantilever.deck"
  character(len=*), parameter :: old = "an older file"

contains

  subroutine run_program_tests()
    call run("program: help and version", test_help)
    call run("program: wrong command lines", test_usage)
    call run("program: hints", test_hints)
    call run("program: keywords", test_keywords)
    call run("program: a run", test_run)
    call run("program: quiet and verbose", test_levels)
    call run("program: -D", test_settings)
    call run("program: check", test_check)
    call run("program: wrong decks leave no file", test_wrong_deck)
    call run("program: no solution", test_no_solution)
    call run("program: existing results", test_existing)
    call run("program: places that cannot be written", test_unwritable)
    call run("program: the default result file", test_default_output)
    call run("program: two runs, equal bytes", test_equal_bytes)
    call run("program: full disk", test_full_disk)
    call run("program: too little memory", test_memory)
    call run("program: interrupted", test_interrupt)
    call run("program: interrupted at once", test_early_interrupt)
    call run("program: killed", test_kill)
    call run("program: two runs into one file", test_concurrent)
    call run("program: nobody reads what is printed", test_closed_pipe)
  end subroutine run_program_tests

  !> Run and compare the exit status.
  subroutine expect_status(arguments, status, outcome, front)
    character(len=*), intent(in) :: arguments
    integer, intent(in) :: status
    type(outcome_t), intent(out) :: outcome
    character(len=*), intent(in), optional :: front
    character(len=60) :: detail

    call run_spar(arguments, outcome, front)
    write (detail, "('status ', i0, ' instead of ', i0, ' of: spar ')") outcome%status, status
    call expect(outcome%status == status, trim(detail)//" "//arguments//newline//outcome%errors)
  end subroutine expect_status

  subroutine expect_text(text, part)
    character(len=*), intent(in) :: text, part

    call expect(index(text, part) > 0, "'"//part//"' in:"//newline//text)
  end subroutine expect_text

  !> Path of a result file that is not there.
  function fresh(name) result(path)
    character(len=*), intent(in) :: name
    character(len=:), allocatable :: path

    path = scratch(name)
    call execute_command_line("rm -f "//path//" "//path//".part")
  end function fresh

  subroutine test_help()
    type(outcome_t) :: outcome

    call expect_status("--version", 0, outcome)
    call expect(outcome%output == "spar 0.1.0"//newline, "name and version, nothing else")
    call expect_status("--help", 0, outcome)
    call expect_text(outcome%output, "spar check DECK")
    call expect_status("run --help", 0, outcome)
    call expect_text(outcome%output, "--no-overwrite")
    call expect(outcome%errors == "", "help is no error")
    call expect_status("help check", 0, outcome)
    call expect_text(outcome%output, "exit status 3")
    call expect_status("keywords -h", 0, outcome)
    call expect_text(outcome%output, "--markdown")
  end subroutine test_help

  subroutine test_usage()
    type(outcome_t) :: outcome

    call expect_status("", 2, outcome)
    call expect(outcome%output == "", "errors go to standard error")
    call expect_status("run", 2, outcome)
    call expect_status("run ''", 2, outcome)
    call expect_status("run "//deck//" "//deck, 2, outcome)
    call expect_status("run "//deck//" -o", 2, outcome)
    call expect_status("run "//deck//" -o a.h5 -o b.h5", 2, outcome)
    call expect_status("run "//deck//" -D", 2, outcome)
    call expect_status("run "//deck//" -D steps", 2, outcome)
    call expect_status("run "//deck//" -D =3", 2, outcome)
    call expect_status("run "//deck//" -D 3=3", 2, outcome)
    call expect_status("run "//deck//" -D steps=3 -Dsteps=4", 2, outcome)
    call expect_status("run "//deck//" --quiet --verbose", 2, outcome)
    call expect_status("run "//deck//" --mode 7", 2, outcome)
    call expect_status("check "//deck//" --verbose", 2, outcome)
    call expect_status("run "//deck//" -o "//deck, 2, outcome)
    call expect_text(outcome%errors, "replace the deck")
    call expect_status("keywords BEAMV", 2, outcome)
    call expect_text(outcome%errors, "BEAMW")
  end subroutine test_usage

  subroutine test_hints()
    type(outcome_t) :: outcome

    call expect_status(deck, 2, outcome)
    call expect_text(outcome%errors, "hint: spar run "//deck)
    call expect_status("chekc "//deck, 2, outcome)
    call expect_text(outcome%errors, "did you mean check?")
    call expect_status("run "//deck//" --verbos", 2, outcome)
    call expect_text(outcome%errors, "did you mean --verbose?")
    call expect_status("--verison", 2, outcome)
    call expect_text(outcome%errors, "spar --help")
  end subroutine test_hints

  subroutine test_keywords()
    type(outcome_t) :: outcome

    call expect_status("keywords", 0, outcome)
    call expect_text(outcome%output, newline//"BEAMW ")
    call expect_status("keywords beamw", 0, outcome)
    call expect_text(outcome%output, "DIVIDE")
    call expect_status("keywords --markdown", 0, outcome)
    call expect_text(outcome%output, "BEAMW")
  end subroutine test_keywords

  !> Euler-Bernoulli: 10 l^3/(3 E I) = 0.41667 in z, small against the length; the second analysis
  !> adds as much.
  subroutine test_run()
    type(outcome_t) :: outcome
    character(len=:), allocatable :: path
    real(wp), allocatable :: tip(:)
    integer, allocatable :: extents(:), numbers(:)

    path = fresh("run.h5")
    call expect_status("run "//deck//" -o "//path, 0, outcome)
    call expect(outcome%errors == "", "nothing on standard error")
    call expect_text(outcome%output, "Analysis 1 STATIC: 4 steps")
    call expect_text(outcome%output, "Analysis 2 STATIC more: 2 steps")
    call expect_text(outcome%output, "Results in "//path)
    call expect(.not. file_there(path//".part"), "no partial file is left")
    call get_numbers(path, "/", "complete", numbers)
    call expect(size(numbers) == 1 .and. all(numbers == 1), "complete = 1")
    call get_reals(path, "analysis/01_static/markers/tip", tip, extents)
    call expect(all(extents == [4, 3]), "a row for each step")
    if (size(tip) == 12) call expect_close(tip(12), -10*125/3000.0_wp, 0.01_wp, "deflection")
    call get_reals(path, "analysis/02_more/markers/tip", tip, extents)
    if (size(tip) == 6) call expect_close(tip(6), -20*125/3000.0_wp, 0.04_wp, "deflection")
    call expect(size(tip) == 6, "a group named by NAME")
  end subroutine test_run

  subroutine test_levels()
    type(outcome_t) :: quiet, normal, verbose
    character(len=:), allocatable :: path

    path = fresh("levels.h5")
    call expect_status("run "//deck//" --quiet -o "//path, 0, quiet)
    call expect(quiet%output == "" .and. quiet%errors == "", "--quiet prints nothing")
    call expect(file_there(path), "and writes the file")
    call expect_status("run "//deck//" -o "//path, 0, normal)
    call expect_status("run "//deck//" --verbose --no-progress -o "//path, 0, verbose)
    call expect(len(verbose%output) > len(normal%output), "--verbose prints more")
    call expect_status("run "//deck//" -o "//path//" -Dsteps=1000", 0, normal)
    call expect(count_lines(normal%output) < 60, "a long table is shortened")
    call expect_text(normal%output, newline//"    1000 ")
    call expect_text(normal%output, newline//"       1 ")
  end subroutine test_levels

  pure integer function count_lines(text)
    character(len=*), intent(in) :: text
    integer :: i

    count_lines = 0
    do i = 1, len(text)
      if (text(i:i) == newline) count_lines = count_lines + 1
    end do
  end function count_lines

  subroutine test_settings()
    type(outcome_t) :: outcome
    character(len=:), allocatable :: path
    integer, allocatable :: values(:), extents(:)

    path = fresh("settings.h5")
    call expect_status("run "//deck//" -D steps=7 -Dparts=2 -o "//path, 0, outcome)
    call get_integers(path, "analysis/01_static/step", values, extents)
    call expect(size(values) == 7, "seven steps by -D")
    call get_integers(path, "model/elements/part", values, extents)
    call expect(size(values) == 2, "two parts by -D")
    path = fresh("settings.h5")
    call expect_status("run "//deck//" -D setps=7 -o "//path, 3, outcome)
    call expect_text(outcome%errors, "setps")
    call expect(.not. file_there(path), "no file")
  end subroutine test_settings

  subroutine test_check()
    type(outcome_t) :: outcome

    call expect_status("check "//deck, 0, outcome)
    call expect_text(outcome%output, "degrees of freedom")
    call expect_status("check -D parts=5 "//deck, 0, outcome)
    call expect_status("check "//cases//"wrong.deck", 3, outcome)
    call expect_status("check tests/cases/static/mechanism.deck", 3, outcome)
    call expect_status("check "//cases//"missing.deck", 5, outcome)
  end subroutine test_check

  subroutine test_wrong_deck()
    type(outcome_t) :: outcome
    character(len=:), allocatable :: path

    path = fresh("wrong.h5")
    call expect_status("run "//cases//"wrong.deck --quiet -o "//path, 3, outcome)
    call expect_text(outcome%errors, "wrong.deck:2:")
    call expect_text(outcome%errors, "wrong.deck:4:")
    call expect_text(outcome%errors, "^")
    call expect_status("run "//cases//"missing.deck -o "//path, 5, outcome)
    call expect_text(outcome%errors, "No such file")
    call expect_status("run tests/cases/static/mechanism.deck -o "//path, 3, outcome)
    call expect(.not. file_there(path), "no file is left")
    call expect(.not. file_there(path//".part"), "no partial file is left")
  end subroutine test_wrong_deck

  !> After converged steps the file is kept, before the first it is not.
  subroutine test_no_solution()
    type(outcome_t) :: outcome
    character(len=:), allocatable :: path
    integer, allocatable :: values(:), extents(:)

    path = fresh("limit.h5")
    call expect_status("run "//cases//"limit.deck -o "//path, 4, outcome)
    call expect_text(outcome%errors, "no equilibrium")
    call expect_text(outcome%output, "not complete")
    call get_numbers(path, "/", "complete", values)
    call expect(size(values) == 1 .and. all(values == 0), "complete = 0")
    call get_integers(path, "analysis/01_static/step", values, extents)
    call expect(size(values) == 3, "the three converged steps")
    call make_file(path, old)
    call expect_status("run "//cases//"limit.deck -Diterations=1 -o "//path, 4, outcome)
    call expect_old(path)
  end subroutine test_no_solution

  !> The older file is untouched and nothing is beside it.
  subroutine expect_old(path)
    character(len=*), intent(in) :: path
    character(len=:), allocatable :: text

    call read_text(path, text)
    call expect(text == old, "an older file is left alone")
    call expect(.not. file_there(path//".part"), "no partial file is left")
  end subroutine expect_old

  subroutine test_existing()
    type(outcome_t) :: outcome
    character(len=:), allocatable :: path

    path = fresh("existing.h5")
    call make_file(path, old)
    call expect_status("run "//deck//" --no-overwrite -o "//path, 5, outcome)
    call expect_text(outcome%errors, "exists")
    call expect_old(path)
    call expect_status("run "//cases//"wrong.deck -o "//path, 3, outcome)
    call expect_old(path)
    call expect_status("run "//deck//" -o "//path, 0, outcome)
    call expect(.not. same_text(path, old), "replaced by default")
    path = fresh("existing.h5")
    call make_file(path//".part", old)
    call expect_status("run "//deck//" --no-overwrite -o "//path, 0, outcome)
    call expect(.not. file_there(path//".part"), "a part left by a killed run is no obstacle")
  end subroutine test_existing

  logical function same_text(path, text)
    character(len=*), intent(in) :: path, text
    character(len=:), allocatable :: found

    call read_text(path, found)
    same_text = found == text
  end function same_text

  subroutine test_unwritable()
    type(outcome_t) :: outcome

    call expect_status("run "//deck//" -o "//scratch("missing/out.h5"), 5, outcome)
    call expect_text(outcome%errors, "No such file or directory")
    call execute_command_line("mkdir -p "//scratch("folder.h5"))
    call expect_status("run "//deck//" -o "//scratch("folder.h5"), 5, outcome)
    call expect_text(outcome%errors, "folder")
    call expect(.not. file_there(scratch("folder.h5.part")), "no partial file is left")
    call expect_status("run "//deck//" -o /dev/null", 5, outcome)
  end subroutine test_unwritable

  !> The deck's name with .h5 in the current folder.
  subroutine test_default_output()
    type(outcome_t) :: outcome
    character(len=:), allocatable :: path

    path = fresh("cantilever.h5")
    call run_shell('program=$(realpath "$SPAR_PROGRAM") && deck=$(realpath '//deck//") && cd "// &
                   scratch("")//' && "$program" run "$deck" --quiet', outcome)
    call expect(outcome%status == 0, "status 0")
    call expect(file_there(path), "cantilever.h5 here")
  end subroutine test_default_output

  subroutine test_equal_bytes()
    type(outcome_t) :: outcome

    call expect_status("run "//deck//" -o "//fresh("first.h5"), 0, outcome)
    call execute_command_line("sleep 1.1")
    call expect_status("run "//deck//" --quiet -o "//fresh("second.h5"), 0, outcome)
    call expect(same_bytes(scratch("first.h5"), scratch("second.h5")), "equal bytes")
  end subroutine test_equal_bytes

  !> Limits of the file size stand for a full disk: in the head, in the steps.
  subroutine test_full_disk()
    type(outcome_t) :: outcome
    character(len=:), allocatable :: path
    character(len=*), parameter :: limits(3) = ["1  ", "20 ", "300"]
    integer :: i

    path = fresh("full.h5")
    call make_file(path, old)
    do i = 1, size(limits)
      call expect_status("run "//deck//" --quiet -Dsteps=200 -o "//path, 5, outcome, &
                         "ulimit -f "//trim(limits(i))//"; trap '' XFSZ;")
      call expect_text(outcome%errors, "cannot write")
      call expect_old(path)
    end do
  end subroutine test_full_disk

  !> Less memory than a large model needs. Sanitizers do not even start under a limit of the
  !> address space; they have a limit of their own.
  subroutine test_memory()
    type(outcome_t) :: outcome
    character(len=:), allocatable :: path
    character(len=*), parameter :: limit = "ulimit -v 400000;", &
      sanitizer_limit = "ASAN_OPTIONS=allocator_may_return_null=1:max_allocation_size_mb=10"

    path = fresh("memory.h5")
    call make_file(path, old)
    call run_spar("--version", outcome, limit)
    if (outcome%status == 0) then
      call expect_status("run "//deck//" -Dparts=200000 -o "//path, 5, outcome, limit)
    else
      call expect_status("run "//deck//" -Dparts=200000 -o "//path, 5, outcome, sanitizer_limit)
    end if
    call expect_text(outcome%errors, "memory")
    call expect(same_text(path, old), "the older file is still there")
  end subroutine test_memory

  subroutine test_interrupt()
    type(outcome_t) :: outcome
    character(len=:), allocatable :: path
    integer, allocatable :: values(:), extents(:), numbers(:)
    character(len=4), parameter :: signals(2) = ["INT ", "TERM"]
    integer :: i, k

    do i = 1, 2
      path = fresh("interrupt.h5")
      call expect_status("run "//deck//" -Dsteps=1000000 -o "//path, 130, outcome, &
                         "timeout --preserve-status -s "//trim(signals(i))//" 0.5")
      call expect_text(outcome%errors, "interrupted")
      call expect_text(outcome%output, "not complete")
      call get_numbers(path, "/", "complete", numbers)
      call expect(size(numbers) == 1 .and. all(numbers == 0), "complete = 0")
      call get_integers(path, "analysis/01_static/step", values, extents)
      call expect(size(values) > 0, "some steps")
      call expect(all(values == [(k, k=1, size(values))]), "steps without gaps")
    end do
  end subroutine test_interrupt

  !> Before the first converged step nothing is kept.
  subroutine test_early_interrupt()
    type(outcome_t) :: outcome
    character(len=:), allocatable :: path

    path = fresh("early.h5")
    call make_file(path, old)
    call expect_status("run "//deck//" -Dsteps=1 -Dparts=20000 -o "//path, 130, outcome, &
                       "timeout --preserve-status -s INT 0.4")
    call expect_old(path)
  end subroutine test_early_interrupt

  !> What `kill -9` leaves can be read up to the last step.
  subroutine test_kill()
    type(outcome_t) :: outcome
    character(len=:), allocatable :: path
    integer, allocatable :: values(:), extents(:), numbers(:)

    path = fresh("kill.h5")
    call make_file(path, old)
    call run_spar("run "//deck//" --quiet -Dsteps=1000000 -o "//path, outcome, &
                  "timeout --foreground -s KILL 0.5")
    call expect(outcome%status == 137, "killed")
    call expect(same_text(path, old), "the older file is still there")
    call get_numbers(path//".part", "/", "complete", numbers)
    call expect(size(numbers) == 1 .and. all(numbers == 0), "complete = 0")
    call get_integers(path//".part", "analysis/01_static/step", values, extents)
    call expect(size(values) > 0, "some steps")
  end subroutine test_kill

  !> The second of two runs gives up and does no harm to the first.
  subroutine test_concurrent()
    type(outcome_t) :: outcome
    character(len=:), allocatable :: path
    integer, allocatable :: values(:), extents(:)

    path = fresh("both.h5")
    call run_shell('timeout --preserve-status -s INT 2 "$SPAR_PROGRAM" run '//deck// &
                   " --quiet -Dsteps=1000000 -o "//path//" & sleep 0.8;"// &
                   ' "$SPAR_PROGRAM" run '//deck//" -o "//path//"; status=$?; wait;"// &
                   " exit $status", outcome)
    call expect(outcome%status == 5, "the second run fails")
    call expect_text(outcome%errors, "another run")
    call get_integers(path, "analysis/01_static/step", values, extents)
    call expect(size(values) > 0, "the first run's file is whole")
  end subroutine test_concurrent

  !> A reader that goes away does not end the run.
  subroutine test_closed_pipe()
    type(outcome_t) :: outcome
    character(len=:), allocatable :: path
    integer, allocatable :: numbers(:)

    path = fresh("pipe.h5")
    call run_spar("run "//deck//" --verbose -Dsteps=2000 -o "//path//" | head -n 1", outcome)
    call expect(outcome%status == 0, "status 0")
    call get_numbers(path, "/", "complete", numbers)
    call expect(size(numbers) == 1 .and. all(numbers == 1), "the run has ended as usual")
  end subroutine test_closed_pipe

end module test_program
