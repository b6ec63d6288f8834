!> Cards about elements: BEAMW, BEAM, DYNE, RLSE, ESTIFF, EM, EDAMP, ESIG.
module deck_element_cards
  use text, only: to_text
  use errors, only: error_t
  use diagnostics, only: place_t
  use section_check, only: check_product
  use model_data, only: second_none, second_jonker, second_consistent, mass_none, mass_lumped, &
                        mass_consistent, type_beamw, type_beam
  use deck_card, only: card_t
  use deck_draft, only: draft_t, beam_t, record_t, record_flexible, record_release, &
                        record_stiffness, record_inertia, record_damping, record_stress
  use deck_growth, only: grow
  use deck_model_cards, only: node_number, add_selection
  implicit none
  private

  public :: read_beamw, read_beam, read_dyne, read_rlse, read_estiff, read_em, read_edamp, read_esig
  public :: beam_number, add_record, add_item

contains

  !> BEAMW id p q [ox oy oz] [options] or BEAMW id Xp Rp Wp Xq Rq Wq [ox oy oz] [options]
  subroutine read_beamw(card, draft)
    type(card_t), intent(in) :: card
    type(draft_t), intent(inout) :: draft

    call add_beam(card, draft, type_beamw)
  end subroutine read_beamw

  !> BEAM id p q [ox oy oz] [options] or BEAM id Xp Rp Xq Rq [ox oy oz] [options]
  subroutine read_beam(card, draft)
    type(card_t), intent(in) :: card
    type(draft_t), intent(inout) :: draft

    call add_beam(card, draft, type_beam)
  end subroutine read_beam

  subroutine add_beam(card, draft, kind)
    type(card_t), intent(in) :: card
    type(draft_t), intent(inout) :: draft
    integer, intent(in) :: kind
    type(beam_t) :: beam
    integer :: k, last_node

    call beam_number(draft, card%whole(2), card%place(2), k)
    if (k == 0) return
    beam%id = card%whole(2)
    beam%kind = kind
    beam%place = card%place(2)
    call read_ends(card, draft, beam, last_node)
    if (last_node == 0) return
    if (card%positional > last_node - 1) beam%orientation = card%number(last_node + 1:last_node + 3)
    if (card%positional > last_node - 1 .and. .not. any(abs(beam%orientation) > 0)) then
      call draft%report%add_error(card%place(last_node + 1), "the orientation cannot be 0 0 0", &
        "without it, the section's y axis is along the global axis least along the beam")
      return
    end if
    call read_options(card, draft, beam)
    draft%beam(k) = beam
  end subroutine add_beam

  !> The nodes of a beam, one word an end or one for each kind of node; `last_node` is the word of
  !> the last, 0 after an error. A BEAM has no warping node: it has the rotational one there.
  subroutine read_ends(card, draft, beam, last_node)
    type(card_t), intent(in) :: card
    type(draft_t), intent(inout) :: draft
    type(beam_t), intent(inout) :: beam
    integer, intent(out) :: last_node
    integer :: kinds, words, kind, end, w

    kinds = merge(3, 2, beam%kind == type_beamw)
    words = merge(1, kinds, card%positional == 3 .or. card%positional == 6)
    last_node = 2 + 2*words
    do w = 3, last_node
      end = 1 + (w - 3)/words
      kind = 1 + modulo(w - 3, words)
      call node_number(draft, card%whole(w), card%part(w), card%place(w), beam%node(kind, end))
      beam%node(kind + 1:, end) = beam%node(kind, end)
    end do
    do kind = 1, kinds
      if (beam%node(kind, 1) /= beam%node(kind, 2)) cycle
      w = 2 + words + min(kind, words)
      call draft%report%add_error(card%place(w), "both ends of the element are at node "// &
                                  to_text(card%whole(w)))
      last_node = 0
      return
    end do
  end subroutine read_ends

  !> SECTION MATERIAL SECOND SHEAR MASS ROTARY DIVIDE RIGID, in the order of the table.
  subroutine read_options(card, draft, beam)
    type(card_t), intent(in) :: card
    type(draft_t), intent(inout) :: draft
    type(beam_t), intent(inout) :: beam
    integer, parameter :: second(0:2) = [second_consistent, second_jonker, second_none]
    integer, parameter :: mass(0:2) = [mass_consistent, mass_lumped, mass_none]
    character(len=:), allocatable :: name

    associate (option => card%option, choice => card%whole)
      if (option(1) > 0) then
        name = card%word(option(1) + 1)
        call draft%sections%refer(name, card%place(option(1) + 1), beam%section)
      end if
      if (option(2) > 0) then
        name = card%word(option(2) + 1)
        call draft%materials%refer(name, card%place(option(2) + 1), beam%material)
      end if
      if (option(3) > 0) beam%second = second(choice(option(3) + 1) - 1)
      if (option(4) > 0) beam%shear = choice(option(4) + 1) == 1
      beam%shear_asked = beam%shear .and. option(4) > 0
      if (option(5) > 0) beam%mass = mass(choice(option(5) + 1) - 1)
      if (option(6) > 0) beam%rotary = choice(option(6) + 1) == 1
      if (option(7) > 0) beam%divide = choice(option(7) + 1)
      beam%rigid = option(8) > 0
    end associate
    if (beam%divide >= 1 .and. beam%divide <= 1000000) return
    call draft%report%add_error(card%place(card%option(7) + 1), &
                                "an element is divided into 1 to 1000000 parts")
    beam%divide = 1
  end subroutine read_options

  !> Number of a new element; 0 and an error if the id is taken.
  subroutine beam_number(draft, id, place, number)
    type(draft_t), intent(inout) :: draft
    integer, intent(in) :: id
    type(place_t), intent(in) :: place
    integer, intent(out) :: number

    call draft%beam_ids%add(id, 0, number)
    if (number > draft%beams) then
      draft%beams = number
      call grow(draft%beam, number)
      draft%beam(number)%id = id
      draft%beam(number)%place = place
    else
      call draft%report%add_error(place, "element "//to_text(id)//" is already defined", &
                                  "first at "//draft%report%location(draft%beam(number)%place))
      number = 0
    end if
  end subroutine beam_number

  !> DYNE elements modes
  subroutine read_dyne(card, draft)
    type(card_t), intent(in) :: card
    type(draft_t), intent(inout) :: draft

    call add_modes(card, draft, record_flexible)
  end subroutine read_dyne

  !> RLSE elements modes
  subroutine read_rlse(card, draft)
    type(card_t), intent(in) :: card
    type(draft_t), intent(inout) :: draft

    call add_modes(card, draft, record_release)
  end subroutine read_rlse

  subroutine add_modes(card, draft, kind)
    type(card_t), intent(in) :: card
    type(draft_t), intent(inout) :: draft
    integer, intent(in) :: kind
    type(record_t) :: record
    integer :: w

    record%kind = kind
    record%item_from = draft%items + 1
    do w = 3, card%words
      call add_item(card, w, draft)
    end do
    record%item_to = draft%items
    call add_record(card, 2, draft, record)
  end subroutine add_modes

  !> Keep a mode or component of a card.
  subroutine add_item(card, w, draft)
    type(card_t), intent(in) :: card
    integer, intent(in) :: w
    type(draft_t), intent(inout) :: draft

    draft%items = draft%items + 1
    call grow(draft%item, draft%items)
    draft%item(draft%items)%value = card%whole(w)
    draft%item(draft%items)%place = card%place(w)
  end subroutine add_item

  !> ESTIFF elements values
  subroutine read_estiff(card, draft)
    type(card_t), intent(in) :: card
    type(draft_t), intent(inout) :: draft

    call add_values(card, draft, record_stiffness)
  end subroutine read_estiff

  !> EM elements values
  subroutine read_em(card, draft)
    type(card_t), intent(in) :: card
    type(draft_t), intent(inout) :: draft

    call add_values(card, draft, record_inertia)
  end subroutine read_em

  !> EDAMP elements values
  subroutine read_edamp(card, draft)
    type(card_t), intent(in) :: card
    type(draft_t), intent(inout) :: draft

    call add_values(card, draft, record_damping)
  end subroutine read_edamp

  !> ESIG elements values
  subroutine read_esig(card, draft)
    type(card_t), intent(in) :: card
    type(draft_t), intent(inout) :: draft

    call add_values(card, draft, record_stress)
  end subroutine read_esig

  subroutine add_values(card, draft, kind)
    type(card_t), intent(in) :: card
    type(draft_t), intent(inout) :: draft
    integer, intent(in) :: kind
    type(record_t) :: record
    type(error_t), allocatable :: error
    integer :: i

    record%kind = kind
    record%values = card%positional - 1
    do i = 1, record%values
      record%value(i) = card%number(2 + i)
      if (record%value(i) >= 0 .or. kind == record_stress) cycle
      if (kind == record_inertia .and. i == 5) cycle
      call draft%report%add_error(card%place(2 + i), trim(merge("damping          ", &
        "stiffness or mass", kind == record_damping))//" cannot be negative")
      return
    end do
    if (kind == record_inertia) then
      call check_product(record%value(3), record%value(4), record%value(5), error)
      if (allocated(error)) then
        call draft%report%add_error(card%place(7), "rho "//error%message)
        return
      end if
    end if
    call add_record(card, 2, draft, record)
  end subroutine add_values

  !> Keep a card about the nodes or elements of its list, word `w`.
  subroutine add_record(card, w, draft, record)
    type(card_t), intent(in) :: card
    integer, intent(in) :: w
    type(draft_t), intent(inout) :: draft
    type(record_t), intent(in) :: record
    logical :: ok

    ok = .true.
    draft%records = draft%records + 1
    call grow(draft%record, draft%records)
    draft%record(draft%records) = record
    associate (kept => draft%record(draft%records))
      kept%place = card%place(1)
      kept%block = draft%block
      kept%from = draft%selections + 1
      call add_selection(card, w, draft, ok)
      kept%to = draft%selections
    end associate
  end subroutine add_record

end module deck_element_cards
