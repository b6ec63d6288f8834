!> The manual: what is shipped is what the program says, and every example is a sound deck.
module test_manual
  use check, only: run, expect
  use text, only: newline
  use diagnostics, only: report_t
  use model_data, only: model_t, setting_t
  use deck_handler, only: keyword_t
  use deck_keywords, only: keywords
  use deck_reader, only: read_deck_text
  use program_runs, only: outcome_t, run_shell
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
    integer :: i

    deck = surroundings(trim(row%name))
    deck = deck//trim(row%example)
    do i = 1, len(deck)
      if (deck(i:i) == "|") deck(i:i) = newline
    end do
    call read_deck_text("decks/example.deck", deck, none, model, report)
  end subroutine read_example

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
