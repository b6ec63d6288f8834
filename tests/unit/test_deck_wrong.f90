!> Wrong decks: each says in its first lines what the reader must answer.
!>
!> `# expect: status N`; then per message `# expect: line:column: message`, in order, without the
!> deck's own name, and `# expect: hint words` for words that its hint must contain.
module test_deck_wrong
  use check, only: run, expect
  use errors, only: error_t, exit_deck
  use diagnostics, only: report_t, diagnostic_t, severity_note
  use model_data, only: model_t, setting_t
  use text, only: to_text
  use deck_reader, only: read_deck
  implicit none
  private

  public :: run_deck_wrong_tests

  character(len=*), parameter :: folder = "tests/cases/wrong/"

contains

  subroutine run_deck_wrong_tests()
    call run("wrong decks: messages, positions and hints", all_decks)
  end subroutine run_deck_wrong_tests

  subroutine all_decks()
    character(len=80) :: name
    integer :: unit, stat, decks

    open (newunit=unit, file=folder//"LIST", status="old", action="read", iostat=stat)
    call expect(stat == 0, "the list of wrong decks")
    if (stat /= 0) return
    decks = 0
    do
      read (unit, "(a)", iostat=stat) name
      if (stat /= 0) exit
      decks = decks + 1
      call one_deck(trim(name))
    end do
    close (unit)
    call expect(decks >= 100, "at least 100 decks")
  end subroutine all_decks

  !> Read a deck and compare what is said of it with what its first lines expect.
  subroutine one_deck(name)
    character(len=*), intent(in) :: name
    type(model_t) :: model
    type(report_t) :: report
    type(error_t), allocatable :: error
    type(setting_t) :: overrides(0)
    character(len=200) :: wanted(20), hint(20)
    integer :: status, actual, n, item, said

    call expectations(name, status, wanted, hint, n)
    call read_deck(folder//name, overrides, model, report, error)
    actual = 0
    if (report%errors() > 0) actual = exit_deck
    if (allocated(error)) then
      actual = error%status
      call expect(error%message == wanted(1), name//": "//error%message)
    end if
    call expect(actual == status, name//": status "//to_text(status)//", not "//to_text(actual))
    if (allocated(error)) return
    said = 0
    do item = 1, report%items
      if (report%item(item)%severity == severity_note) cycle
      said = said + 1
      if (said <= n) then
        call compare(name, report, report%item(item), trim(wanted(said)), trim(hint(said)))
      else
        call expect(.false., name//": nothing more than expected, but "// &
                    report%heading(report%item(item)))
      end if
    end do
    call expect(said >= n, name//": "//to_text(n)//" messages, not "//to_text(said))
  end subroutine one_deck

  subroutine compare(name, report, item, wanted, hint)
    character(len=*), intent(in) :: name
    type(report_t), intent(in) :: report
    type(diagnostic_t), intent(in) :: item
    character(len=*), intent(in) :: wanted, hint
    character(len=:), allocatable :: heading

    heading = report%heading(item)
    if (index(heading, folder) == 1) heading = heading(len(folder) + 1:)
    if (index(heading, name//":") == 1) heading = adjustl(heading(len(name) + 2:))
    call expect(trim(heading) == wanted, name//": '"//wanted//"', not '"//trim(heading)//"'")
    call expect(index(item%hint, hint) > 0, name//": hint '"//hint//"', not '"//item%hint//"'")
  end subroutine compare

  !> The `# expect:` lines at the top of a deck.
  subroutine expectations(name, status, wanted, hint, n)
    character(len=*), intent(in) :: name
    integer, intent(out) :: status, n
    character(len=*), intent(out) :: wanted(:), hint(:)
    character(len=*), parameter :: sign = "# expect: "
    character(len=250) :: line
    integer :: unit, stat

    n = 0
    status = -1
    wanted = ""
    hint = ""
    open (newunit=unit, file=folder//name, status="old", action="read", iostat=stat)
    call expect(stat == 0, "the deck "//name)
    do while (stat == 0)
      read (unit, "(a)", iostat=stat) line
      if (stat /= 0 .or. index(line, sign) /= 1) exit
      line = line(len(sign) + 1:)
      if (index(line, "status ") == 1) then
        read (line(8:), *) status
      else if (index(line, "hint ") == 1) then
        hint(n) = line(6:)
      else
        n = n + 1
        wanted(n) = line(:len(wanted))
      end if
    end do
    close (unit)
  end subroutine expectations

end module test_deck_wrong
