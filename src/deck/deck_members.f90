!> From BEAMW and BEAM cards to the elements of the model: parts and inner nodes.
module deck_members
  use text, only: to_text
  use kinds, only: wp
  use model_data, only: member_t, mode_flexible, type_beamw
  use deck_draft, only: draft_t, beam_t
  use deck_model_cards, only: node_number
  implicit none
  private

  public :: expand_beams

contains

  !> Make the elements and the inner nodes of divided ones.
  subroutine expand_beams(draft)
    type(draft_t), intent(inout) :: draft
    integer :: b, total

    total = 0
    do b = 1, draft%beams
      if (draft%beam(b)%joint > 0) cycle
      if (draft%beam(b)%node(1, 1) == 0) then
        draft%elements_incomplete = .true.
      else
        total = total + draft%beam(b)%divide
      end if
    end do
    allocate (draft%model%member(total))
    do b = 1, draft%beams
      if (draft%beam(b)%node(1, 1) > 0) call expand(draft, draft%beam(b))
    end do
  end subroutine expand_beams

  subroutine expand(draft, beam)
    type(draft_t), intent(inout) :: draft
    type(beam_t), intent(inout) :: beam
    type(member_t) :: member
    real(wp) :: start(3)
    integer :: part, node(3)

    beam%first_member = draft%members + 1
    member%id = beam%id
    member%kind = beam%kind
    member%place = beam%place
    member%orientation = beam%orientation
    member%section = draft%sections%reference(beam%section)
    member%material = draft%materials%reference(beam%material)
    member%second = beam%second
    member%mass = beam%mass
    member%shear = beam%shear .and. shear_known(draft, member%section)
    if (beam%shear_asked .and. .not. member%shear) call draft%report%add_error(beam%place, &
      "SHEAR ON of element "//to_text(beam%id)//": its section has no shear rigidities DY DZ")
    member%rotary = beam%rotary
    member%rigid = beam%rigid
    start = draft%model%node(beam%node(1, 1))%position
    member%chord = (draft%model%node(beam%node(1, 2))%position - start)/beam%divide
    if (member%section > 0 .and. member%material > 0 .and. .not. beam%rigid) then
      member%status = mode_flexible
    end if
    node = beam%node(:, 1)
    do part = 1, beam%divide
      member%node(:, 1) = node
      if (part == beam%divide) then
        node = beam%node(:, 2)
      else
        call add_inner_node(draft, beam, part, start + part*member%chord, node)
      end if
      member%node(:, 2) = node
      if (beam%divide > 1) member%part = part
      call add_member(draft, member)
    end do
  end subroutine expand

  !> Keep an element; its nodes exist from now on.
  subroutine add_member(draft, member)
    type(draft_t), intent(inout) :: draft
    type(member_t), intent(in) :: member
    integer :: kind

    draft%members = draft%members + 1
    draft%model%member(draft%members) = member
    do kind = 1, merge(3, 2, member%kind == type_beamw)
      draft%model%node(member%node(kind, 1))%exists(kind) = .true.
      draft%model%node(member%node(kind, 2))%exists(kind) = .true.
    end do
  end subroutine add_member

  pure logical function shear_known(draft, section)
    type(draft_t), intent(in) :: draft
    integer, intent(in) :: section

    shear_known = .true.
    if (section > 0) shear_known = draft%model%section(section)%constants%shear_given
  end function shear_known

  !> Node `part` inside a divided element.
  subroutine add_inner_node(draft, beam, part, position, node)
    type(draft_t), intent(inout) :: draft
    type(beam_t), intent(in) :: beam
    integer, intent(in) :: part
    real(wp), intent(in) :: position(3)
    integer, intent(out) :: node(3)
    integer :: k

    call node_number(draft, beam%id, part, beam%place, k)
    draft%model%node(k)%position = position
    draft%model%node(k)%placed = .true.
    node = k
  end subroutine add_inner_node

end module deck_members
