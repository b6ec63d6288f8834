!> Decks for the tests of the reader, written as text with `|` between lines.
module deck_samples
  use check, only: expect
  use diagnostics, only: report_t
  use model_data, only: model_t, setting_t
  use text, only: newline
  use deck_reader, only: read_deck_text
  implicit none
  private

  public :: read_sample, read_sound, frame

  !> Two nodes, a material, a section and a beam between the nodes; lines 1 to 5.
  character(len=*), parameter :: frame = &
    "MATERIAL steel E 200 NU 0.25|SECTION bar CONSTANTS A 1 IY 2 IZ 3 IT 4|"// &
    "NODE 1 0 0 0|NODE 2 4 0 0|BEAMW 1 1 2 0 1 0 SECTION bar MATERIAL steel|"

contains

  !> Read a deck.
  subroutine read_sample(cards, model, report, settings, mode)
    character(len=*), intent(in) :: cards
    type(model_t), intent(out) :: model
    type(report_t), intent(out) :: report
    type(setting_t), intent(in), optional :: settings(:)
    integer, intent(in), optional :: mode   !< of SPACAR
    type(setting_t) :: none(0)
    character(len=:), allocatable :: text
    integer :: i

    text = cards
    do i = 1, len(text)
      if (text(i:i) == "|") text(i:i) = newline
    end do
    if (present(settings)) then
      call read_deck_text("sample.deck", text, settings, model, report, mode=mode)
    else
      call read_deck_text("sample.deck", text, none, model, report, mode=mode)
    end if
  end subroutine read_sample

  !> Read a deck that must have no errors.
  subroutine read_sound(cards, model, mode)
    character(len=*), intent(in) :: cards
    type(model_t), intent(out) :: model
    integer, intent(in), optional :: mode   !< of SPACAR
    type(report_t) :: report
    integer :: i

    call read_sample(cards, model, report, mode=mode)
    call expect(report%errors() == 0, "no errors")
    if (report%errors() == 0) return
    do i = 1, report%items
      call expect(.false., report%heading(report%item(i)))
    end do
  end subroutine read_sound

end module deck_samples
