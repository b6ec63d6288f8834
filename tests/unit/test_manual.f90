!> The manual: what is shipped is what the program says, and every example is a sound deck.
module test_manual
  use check, only: run, expect
  use text, only: newline, to_text
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

  !> A text as long as its variable was probably cut off.
  subroutine complete()
    type(keyword_t), allocatable :: table(:)
    integer :: i

    allocate (table, source=keywords())
    do i = 1, size(table)
      associate (row => table(i), name => trim(table(i)%name))
        call expect(row%help /= "", name//" has help")
        call expect(index("|"//row%example, "|"//name) > 0, name//" has an example of itself")
        call expect(len_trim(row%forms) < len(row%forms), name//": forms are cut off")
        call expect(len_trim(row%options) < len(row%options), name//": options are cut off")
        call expect(len_trim(row%help) < len(row%help), name//": help is cut off")
        call expect(len_trim(row%example) < len(row%example), name//": example is cut off")
      end associate
    end do
  end subroutine complete

  subroutine sound()
    type(keyword_t), allocatable :: table(:)
    type(model_t) :: model
    type(report_t) :: report
    type(setting_t) :: none(0)
    character(len=:), allocatable :: deck
    integer :: i, k

    allocate (table, source=keywords())
    do i = 1, size(table)
      associate (name => trim(table(i)%name))
        deck = lines(surroundings(name)//table(i)%example)
        call read_deck_text("decks/example.deck", deck, none, model, report)
        call expect(report%errors() == 0, name//" example: "//to_text(report%errors())//" errors")
        if (report%errors() == 0) cycle
        do k = 1, report%items
          call expect(.false., name//" example: "//report%item(k)%message)
        end do
      end associate
    end do
  end subroutine sound

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
          "SECTION", "POINT", "PLATE", "BEAMW", "FUNCTION")
      cards = small
    case default
      cards = large
    end select
  end function surroundings

  !> Cards separated by `|` as lines.
  pure function lines(cards) result(deck)
    character(len=*), intent(in) :: cards
    character(len=len(cards)) :: deck
    integer :: i

    deck = cards
    do i = 1, len(deck)
      if (deck(i:i) == "|") deck(i:i) = newline
    end do
  end function lines

end module test_manual
