!> A row of the keyword table.
module deck_handler
  use deck_card, only: card_t
  use deck_draft, only: draft_t
  implicit none
  private

  public :: keyword_t, card_handler

  abstract interface
    !> Store what a card says; its words have been checked and evaluated.
    subroutine card_handler(card, draft)
      import :: card_t, draft_t
      implicit none
      type(card_t), intent(in) :: card
      type(draft_t), intent(inout) :: draft
    end subroutine card_handler
  end interface

  !> A keyword, or one variant of it (FUNCTION name RAMP). Where it may stand: a "model" card only
  !> before the first analysis, the others anywhere.
  type :: keyword_t
    character(len=16) :: name = ""
    character(len=8) :: stage = ""       !< "model", "load", "analysis" or "form"
    character(len=400) :: forms = ""     !< see deck_usage
    character(len=400) :: options = ""   !< see deck_usage
    character(len=600) :: help = ""
    character(len=400) :: example = ""   !< cards separated by `|`
    character(len=80) :: spacar = ""     !< SPACAR's equivalent, if any
    procedure(card_handler), pointer, nopass :: apply => null()
  end type keyword_t

end module deck_handler
