!> Beams and joints under one roof: what their cards and modes have in common.
!>
!> An element here is a number: beams (parts of divided ones each) by their index in
!> `model%member`, then joints, which count on from there.
module deck_elements
  use text, only: to_text
  use model_data, only: joint_names, joint_modes, type_beam
  use deck_draft, only: draft_t
  implicit none
  private

  public :: is_whole, kind_name, element_name, modes_of, find_range, mode_status, set_status, &
            complain_of_mode

contains

  !> Whether the card of an element, by its number among the cards, had no errors.
  pure logical function is_whole(draft, k)
    type(draft_t), intent(in) :: draft
    integer, intent(in) :: k

    is_whole = draft%beam(k)%first_member > 0 .or. draft%beam(k)%joint > 0
  end function is_whole

  !> BEAMW, HINGE, ...
  pure function kind_name(draft, k) result(name)
    type(draft_t), intent(in) :: draft
    integer, intent(in) :: k
    character(len=:), allocatable :: name

    if (draft%beam(k)%joint > 0) then
      name = trim(joint_names(draft%model%joint(draft%beam(k)%joint)%kind))
    else if (draft%beam(k)%kind == type_beam) then
      name = "BEAM"
    else
      name = "BEAMW"
    end if
  end function kind_name

  !> "element 3 is a HINGE"
  pure function element_name(draft, k) result(phrase)
    type(draft_t), intent(in) :: draft
    integer, intent(in) :: k
    character(len=:), allocatable :: phrase

    phrase = "element "//to_text(draft%beam(k)%id)//" is a "//kind_name(draft, k)
  end function element_name

  pure integer function modes_of(draft, k)
    type(draft_t), intent(in) :: draft
    integer, intent(in) :: k

    if (draft%beam(k)%joint > 0) then
      modes_of = joint_modes(draft%model%joint(draft%beam(k)%joint)%kind)
    else
      modes_of = merge(6, 8, draft%beam(k)%kind == type_beam)
    end if
  end function modes_of

  !> The elements that a card made, or the one of them that `part` means; none if it had errors.
  pure subroutine find_range(draft, k, part, first, last)
    type(draft_t), intent(in) :: draft
    integer, intent(in) :: k, part
    integer, intent(out) :: first, last

    associate (card => draft%beam(k))
      first = card%first_member
      last = first + card%divide - 1
      if (card%joint > 0) then
        first = draft%members + card%joint
        last = first
      else if (card%first_member == 0) then
        first = 1
        last = 0
      else if (part > 0) then
        first = first + part - 1
        last = first
      end if
    end associate
  end subroutine find_range

  pure integer function mode_status(draft, e, mode)
    type(draft_t), intent(in) :: draft
    integer, intent(in) :: e, mode

    if (e <= draft%members) then
      mode_status = draft%model%member(e)%status(mode)
    else
      mode_status = draft%model%joint(e - draft%members)%status(mode)
    end if
  end function mode_status

  pure subroutine set_status(draft, e, mode, status)
    type(draft_t), intent(inout) :: draft
    integer, intent(in) :: e, mode, status

    if (e <= draft%members) then
      draft%model%member(e)%status(mode) = status
    else
      draft%model%joint(e - draft%members)%status(mode) = status
    end if
  end subroutine set_status

  !> What to say of a mode that an element does not have.
  pure function complain_of_mode(draft, k) result(message)
    type(draft_t), intent(in) :: draft
    integer, intent(in) :: k
    character(len=:), allocatable :: message

    message = element_name(draft, k)//": it has "
    if (modes_of(draft, k) == 1) then
      message = message//"mode 1 only"
    else
      message = message//"modes 1 to "//to_text(modes_of(draft, k))
    end if
  end function complain_of_mode

end module deck_elements
