!> The manual: what is shipped is what the program says, and every example is a sound deck.
module test_manual
  use check, only: run, expect
  use text, only: newline
  use diagnostics, only: report_t
  use model_data, only: model_t, setting_t
  use deck_handler, only: keyword_t
  use deck_keywords, only: keywords
  use deck_reader, only: read_deck_text
  use program_runs, only: outcome_t, run_shell, run_spar, make_file, scratch
  implicit none
  private

  public :: run_manual_tests

  character(len=*), parameter :: parts = "MATERIAL mat E 200 NU 0.25 RHO 1|"// &
    "SECTION sec CONSTANTS A 1 IY 2 IZ 3 IT 4 IW 5|"

  !> A beam with ids that no example has.
  character(len=*), parameter :: small = parts//"NODE 101 0 0 0|NODE 102 4 0 0|"// &
    "BEAMW 101 101 102 SECTION sec MATERIAL mat|FIX 101|XF 102 0 0 1|"

  !> What examples refer to: nodes 1 to 40, elements 1 to 39 of which 7 is divided, a function.
  character(len=*), parameter :: large = parts//"NODE 1:40 {10*i} 0 0|"// &
    "BEAMW 1:6 {i} {i+1} SECTION sec MATERIAL mat|"// &
    "BEAMW 7 7 8 SECTION sec MATERIAL mat DIVIDE 3|"// &
    "BEAMW 8:39 {i} {i+1} SECTION sec MATERIAL mat|FIX 40|FUNCTION wave SINE 1 1|"

  !> A beam without section.
  character(len=*), parameter :: bare = "NODE 1 0 0 0|NODE 2 4 0 0|BEAMW 1 1 2|"// &
    "DYNE 1 1 2 3 4 5 6|FIX 1|XF 2 0 0 1|"

contains

  subroutine run_manual_tests()
    call run("manual: docs/manual.md is up to date", up_to_date)
    call run("manual: every keyword has help and an example of itself", complete)
    call run("manual: every example is read without errors", sound)
    call run("manual: every example is run or, without an analysis, checked", solved)
    call run("manual: every keyword stands in a deck of the tests", used)
  end subroutine run_manual_tests

  subroutine up_to_date()
    type(outcome_t) :: outcome

    call run_shell("tools/manual ${SPAR_PROGRAM:-build/spar} | diff docs/manual.md - | head -20", &
                   outcome)
    call expect(outcome%errors == "", "tools/manual runs"//newline//outcome%errors)
    call expect(outcome%output == "", "docs/manual.md is old, `make docs` writes it anew:"// &
                newline//outcome%output)
  end subroutine up_to_date

  subroutine complete()
    type(keyword_t), allocatable :: table(:)
    integer :: i

    allocate (table, source=keywords())
    do i = 1, size(table)
      call expect(table(i)%help /= "", trim(table(i)%name)//" has help")
      call expect(index("|"//table(i)%example, "|"//trim(table(i)%name)) > 0, &
                  trim(table(i)%name)//" has an example of itself")
      call expect(fits(table(i)%forms) .and. fits(table(i)%options) .and. fits(table(i)%help) &
                  .and. fits(table(i)%example), trim(table(i)%name)//": a text is cut off")
    end do
  end subroutine complete

  !> A text as long as its variable was probably cut off.
  pure logical function fits(text)
    character(len=*), intent(in) :: text

    fits = len_trim(text) < len(text)
  end function fits

  subroutine sound()
    type(keyword_t), allocatable :: table(:)
    type(report_t) :: report
    integer :: i, k

    allocate (table, source=keywords())
    do i = 1, size(table)
      call read_example(table(i), report)
      if (report%errors() == 0) cycle
      do k = 1, report%items
        call expect(.false., trim(table(i)%name)//" example: "//report%item(k)%message)
      end do
    end do
  end subroutine sound

  !> Read an example; it includes decks/sections.deck.
  subroutine read_example(row, report)
    type(keyword_t), intent(in) :: row
    type(report_t), intent(out) :: report
    type(model_t) :: model
    type(setting_t) :: none(0)
    character(len=:), allocatable :: deck

    deck = whole_deck(row)
    call read_deck_text("decks/example.deck", deck, none, model, report)
  end subroutine read_example

  !> All examples as decks of their own. Some are mechanisms, for which STATIC would not do.
  subroutine solved()
    type(keyword_t), allocatable :: table(:)
    type(outcome_t) :: outcome
    character(len=:), allocatable :: deck
    integer :: i

    allocate (table, source=keywords())
    call run_shell("cp decks/sections.deck "//scratch("sections.deck"), outcome)
    do i = 1, size(table)
      deck = whole_deck(table(i))
      call make_file(scratch("example.deck"), deck)
      if (has_analysis(table, deck)) then
        call run_spar("run "//scratch("example.deck")//" --quiet -o "//scratch("example.h5"), &
                      outcome)
      else
        call run_spar("check "//scratch("example.deck"), outcome)
        if (index(outcome%errors, "free motion") > 0) outcome%status = 0
      end if
      call expect(outcome%status == 0, trim(table(i)%name)//" example runs"//newline// &
                  outcome%errors//newline//deck)
    end do
  end subroutine solved

  !> In decks/ or tests/cases, wrong ones apart, or in a deck within a test.
  subroutine used()
    type(keyword_t), allocatable :: table(:)
    type(outcome_t) :: outcome
    character(len=:), allocatable :: word, cards
    integer :: i

    call run_shell("{ cat decks/*.deck $(ls tests/cases/*/*.deck | grep -v /wrong/);"// &
      " ls tests/unit/*.f90 | grep -v test_manual |"// &
      " xargs grep -ho '[""|][A-Z][A-Z]*[^""|]*' | cut -c 2-; } | sed 's/#.*//' |"// &
      " awk '{ print $1; print $1, $2; print $1, $3 }' | sort -u", outcome)
    cards = newline//outcome%output
    allocate (table, source=keywords())
    do i = 1, size(table)
      word = trim(table(i)%name)//variant(table(i)%forms)
      call expect(index(cards, newline//word//newline) > 0, word//" stands in a deck of the tests")
    end do
  end subroutine used

  !> The word that tells one variant of a keyword from others: it stands first or behind a name.
  pure function variant(forms) result(word)
    character(len=*), intent(in) :: forms
    character(len=:), allocatable :: word
    integer :: i, at, last

    at = 1
    do i = 1, 2
      last = index(forms(at:)//" ", " ") + at - 2
      word = " "//forms(at:last)
      if (index(word, ":") == 0 .and. word /= "") return
      at = min(last + 2, len(forms))
    end do
    word = ""
  end function variant

  !> Whether a card of the deck asks for an analysis.
  pure logical function has_analysis(table, deck)
    type(keyword_t), intent(in) :: table(:)
    character(len=*), intent(in) :: deck
    integer :: i

    has_analysis = .false.
    do i = 1, size(table)
      if (table(i)%stage /= "analysis") cycle
      has_analysis = has_analysis .or. index(newline//deck, newline//trim(table(i)%name)) > 0
    end do
  end function has_analysis

  !> An example with what it needs around it.
  pure function whole_deck(row) result(deck)
    type(keyword_t), intent(in) :: row
    character(len=:), allocatable :: deck
    integer :: i

    deck = surroundings(trim(row%name))//trim(row%example)
    do i = 1, len(deck)
      if (deck(i:i) == "|") deck(i:i) = newline
    end do
  end function whole_deck

  !> What an example needs to be a whole deck.
  pure function surroundings(name) result(cards)
    character(len=*), intent(in) :: name
    character(len=:), allocatable :: cards

    select case (name)
    case ("INCLUDE")
      cards = ""  ! decks/sections.deck is whole
    case ("ESTIFF")
      cards = bare
    case ("EM")
      cards = bare//"ESTIFF 1 1 1 1 1 0 0 1|"
    case ("TITLE", "SET", "END", "HALT", "VISUALIZATION", "OUTLEVEL", "NODE", "X", "MATERIAL", &
          "SECTION", "POINT", "PLATE", "BEAMW", "BEAM", "FUNCTION")
      cards = small
    case default
      cards = large
    end select
  end function surroundings

end module test_manual
