!> What a card with errors would have defined, so that its users are not reported as well.
module deck_broken
  use kinds, only: wp
  use diagnostics, only: place_t
  use deck_card, only: card_t
  use deck_draft, only: draft_t, selection_t
  use deck_growth, only: grow
  use deck_registry, only: registry_t
  use deck_settings, only: is_identifier
  use deck_values, only: read_range
  use deck_model_cards, only: node_number
  use deck_section_cards, only: open_drawing
  implicit none
  private

  public :: mark_broken, mark_all_broken

contains

  !> Define what the card was to define, without value. `keyword` is what it is or may have been
  !> meant to be, empty if not even that is known.
  subroutine mark_broken(card, draft, keyword)
    type(card_t), intent(in) :: card
    type(draft_t), intent(inout) :: draft
    character(len=*), intent(in) :: keyword

    select case (keyword)
    case ("NODE", "X")
      call mark_nodes(card, draft)
    case ("BEAMW", "BEAM", "TRUSS", "HINGE", "UNIVERSAL", "SPHERICAL", "CYLINDRICAL", &
          "PRISMATIC", "GEAR", "SLIDER", "CARRIAGE", "")
      call mark_elements(card, draft)
      if (keyword == "") call mark_nodes(card, draft)
    case ("MATERIAL")
      call mark_name(card, draft%materials)
    case ("SECTION")
      call mark_name(card, draft%sections)
      call open_drawing(draft, 0)
    case ("POINT", "PLATE")
      if (draft%drawn > 0) draft%drawing(draft%drawn)%broken = .true.
    case ("FUNCTION")
      call mark_name(card, draft%functions)
    case ("GROUP", "MARKER")
      call mark_name(card, draft%labels)
    case ("SET")
      call mark_setting(card, draft)
    case default  ! other cards define nothing
    end select
  end subroutine mark_broken

  !> Anything may have been defined in a file that could not be read.
  subroutine mark_all_broken(draft)
    type(draft_t), intent(inout) :: draft

    draft%nodes_incomplete = .true.
    draft%elements_incomplete = .true.
    draft%materials%incomplete = .true.
    draft%sections%incomplete = .true.
    draft%functions%incomplete = .true.
    draft%labels%incomplete = .true.
  end subroutine mark_all_broken

  subroutine mark_nodes(card, draft)
    type(card_t), intent(in) :: card
    type(draft_t), intent(inout) :: draft
    type(selection_t) :: range
    integer :: id, k
    logical :: ok

    call range_quietly(card, draft, range, ok)
    if (.not. ok) then
      draft%nodes_incomplete = .true.
      return
    end if
    do id = range%first, range%last, range%step
      call node_number(draft, id, 0, card%place(2), k)
      draft%node_broken(k) = .true.
    end do
  end subroutine mark_nodes

  subroutine mark_elements(card, draft)
    type(card_t), intent(in) :: card
    type(draft_t), intent(inout) :: draft
    type(selection_t) :: range
    integer :: id, k
    logical :: ok

    draft%elements_incomplete = .true.
    call range_quietly(card, draft, range, ok)
    if (.not. ok) return
    do id = range%first, range%last, range%step
      call draft%beam_ids%add(id, 0, k)
      if (k <= draft%beams) cycle
      draft%beams = k
      call grow(draft%beam, k)
      draft%beam(k)%id = id
      draft%beam(k)%place = card%place(2)
    end do
  end subroutine mark_elements

  !> The card's own ids, without complaints.
  subroutine range_quietly(card, draft, range, ok)
    type(card_t), intent(in) :: card
    type(draft_t), intent(inout) :: draft
    type(selection_t), intent(out) :: range
    logical, intent(out) :: ok
    integer :: items, said(3)

    ok = card%words > 1
    if (.not. ok) return
    items = draft%report%items
    said = draft%report%said
    call read_range(card%text(card%first(2):card%last(2)), card%place(2), draft, range, ok)
    draft%report%items = items
    draft%report%said = said
    ok = ok .and. range%id == 0 .and. abs(range%last - range%first) < 1000000
  end subroutine range_quietly

  subroutine mark_name(card, registry)
    type(card_t), intent(in) :: card
    type(registry_t), intent(inout) :: registry
    type(place_t) :: first
    integer :: k

    if (card%words < 2) then
      registry%incomplete = .true.
    else
      call registry%define(card%word(2), card%place(2), .false., k, first)
    end if
  end subroutine mark_name

  subroutine mark_setting(card, draft)
    type(card_t), intent(in) :: card
    type(draft_t), intent(inout) :: draft

    if (card%words < 2) return
    if (.not. is_identifier(card%word(2))) return
    if (draft%settings%table%find(card%word(2)) > 0) return
    call draft%settings%define(card%word(2), "1", .true., 1.0_wp, card%place(2))
  end subroutine mark_setting

end module deck_broken
