!> ESTIFF, EM, EDAMP and ESIG cards: what they give to which element.
module deck_properties
  use text, only: to_text, plural
  use model_data, only: joint_truss, type_beam
  use deck_draft, only: draft_t, record_t, record_stiffness, record_inertia, record_damping, &
                        record_stress
  use deck_elements, only: is_whole, element_name, modes_of, find_range
  use deck_select, only: choice_t, select_beams, id_text
  implicit none
  private

  public :: set_properties

  integer, parameter :: kinds(4) = [record_stiffness, record_inertia, record_damping, &
                                    record_stress]
  character(len=6), parameter :: names(4) = ["ESTIFF", "EM    ", "EDAMP ", "ESIG  "]

  !> How many values a card has for an element, and which.
  type :: arity_t
    integer :: least = 0, most = 0   !< 0: it does not apply
    character(len=:), allocatable :: values
  end type arity_t

contains

  !> Apply the cards; each once for an element.
  subroutine set_properties(draft)
    type(draft_t), intent(inout) :: draft
    type(choice_t) :: choice
    logical, allocatable :: given(:, :)
    integer :: r, k

    allocate (given(size(kinds), draft%members + draft%joints))
    given = .false.
    do r = 1, draft%records
      k = findloc(kinds, draft%record(r)%kind, 1)
      if (k == 0) cycle
      call select_beams(draft, draft%record(r)%from, draft%record(r)%to, choice)
      if (choice%found > 0) call apply_card(draft, draft%record(r), choice, k, given(k, :))
    end do
  end subroutine set_properties

  !> One card; elements of a range, group or ALL that it does not fit are passed over, unless it
  !> fits none.
  subroutine apply_card(draft, record, choice, k, given)
    type(draft_t), intent(inout) :: draft
    type(record_t), intent(in) :: record
    type(choice_t), intent(in) :: choice
    integer, intent(in) :: k
    logical, intent(inout) :: given(:)
    type(arity_t) :: arity
    integer :: i
    logical :: fits

    fits = .false.
    do i = 1, choice%found
      if (.not. is_whole(draft, choice%index(i))) then
        fits = .true.
        cycle
      end if
      call find_arity(draft, choice%index(i), k, arity)
      if (record%values >= arity%least .and. record%values <= arity%most) then
        fits = .true.
        call give_values(draft, record, choice, i, given)
      else if (.not. choice%listed(i)) then
        fits = .true.
        call complain(draft, record, choice, i, k, arity)
      end if
    end do
    if (.not. fits) call draft%report%add_error(record%place, trim(names(k))//" with "// &
      plural(record%values, "value")//" fits no element of the list")
  end subroutine apply_card

  pure subroutine find_arity(draft, card, k, arity)
    type(draft_t), intent(in) :: draft
    integer, intent(in) :: card, k
    type(arity_t), intent(out) :: arity
    character(len=*), parameter :: beam(3) = [character(len=30) :: &
      "EA GIt EIy EIz cy cz", "rhoA rhoIp rhoIy rhoIz rhoIyz", "EA GIt EIy EIz"]
    character(len=*), parameter :: warping(3) = [character(len=6) :: " EIw", " rhoIw", " [EIw]"]
    character(len=*), parameter :: truss(3) = [character(len=4) :: "EA", "rhoA", "EA"]
    integer, parameter :: values(3) = [6, 5, 4]
    logical :: simple

    simple = draft%beam(card)%kind == type_beam
    arity%values = "one for each mode"
    arity%most = modes_of(draft, card)
    arity%least = min(1, arity%most)
    if (kinds(k) == record_stress) return
    if (draft%beam(card)%joint == 0) then
      arity%most = values(k) + merge(0, 1, simple)
      arity%least = values(k) + merge(0, 1, simple .or. kinds(k) == record_damping)
      if (simple .and. kinds(k) /= record_damping) arity%least = 4  ! what is left out is zero
      arity%values = trim(beam(k))
      if (.not. simple) arity%values = trim(beam(k))//trim(warping(k))
    else if (draft%model%joint(draft%beam(card)%joint)%kind == joint_truss) then
      arity%values = trim(truss(k))
    else if (kinds(k) == record_inertia) then
      arity = arity_t(values="")
    end if
  end subroutine find_arity

  subroutine complain(draft, record, choice, i, k, arity)
    type(draft_t), intent(inout) :: draft
    type(record_t), intent(in) :: record
    type(choice_t), intent(in) :: choice
    integer, intent(in) :: i, k
    type(arity_t), intent(in) :: arity
    character(len=:), allocatable :: expected

    if (arity%most == 0) then
      call draft%report%add_error(choice%place(i), element_name(draft, choice%index(i))// &
                                  ", which has no mass of its own: EM does not apply", &
                                  "XM node m gives mass to a node")
      return
    end if
    expected = to_text(arity%least)
    if (arity%most > arity%least) expected = expected//" to "//to_text(arity%most)
    call draft%report%add_error(choice%place(i), element_name(draft, choice%index(i))//": "// &
      trim(names(k))//" takes "//expected//trim(merge(" value ", " values", arity%most == 1))// &
      ", "//arity%values//"; "//to_text(record%values)//" given")
  end subroutine complain

  subroutine give_values(draft, record, choice, i, given)
    type(draft_t), intent(inout) :: draft
    type(record_t), intent(in) :: record
    type(choice_t), intent(in) :: choice
    integer, intent(in) :: i
    logical, intent(inout) :: given(:)
    integer :: e, first, last

    call find_range(draft, choice%index(i), choice%part(i), first, last)
    do e = first, last
      if (has_section(draft, e) .and. any(record%kind == [record_stiffness, record_inertia])) then
        if (.not. choice%loose(i)) call draft%report%add_error(choice%place(i), "element "// &
          id_text(draft%beam(choice%index(i))%id, choice%part(i))// &
          " has a SECTION, which gives its stiffness and mass")
        return
      end if
      if (given(e)) then
        call draft%report%add_error(choice%place(i), "element "// &
          id_text(draft%beam(choice%index(i))%id, choice%part(i))//" has this card already")
        return
      end if
      given(e) = .true.
      if (e <= draft%members) then
        call give_to_member(draft, record, e)
      else
        call give_to_joint(draft, record, e - draft%members)
      end if
    end do
  end subroutine give_values

  pure logical function has_section(draft, e)
    type(draft_t), intent(in) :: draft
    integer, intent(in) :: e

    if (e <= draft%members) then
      has_section = draft%model%member(e)%section /= 0
    else
      has_section = draft%model%joint(e - draft%members)%section /= 0
    end if
  end function has_section

  pure subroutine give_to_member(draft, record, m)
    type(draft_t), intent(inout) :: draft
    type(record_t), intent(in) :: record
    integer, intent(in) :: m

    associate (member => draft%model%member(m))
      select case (record%kind)
      case (record_stiffness)
        member%has_stiffness = .true.
        member%stiffness = record%value(:7)
      case (record_inertia)
        member%has_inertia = .true.
        member%inertia = record%value(:6)
      case (record_damping)
        member%has_damping = .true.
        member%damping = record%value(:5)
      case default
        member%initial_stress = record%value
      end select
    end associate
  end subroutine give_to_member

  pure subroutine give_to_joint(draft, record, j)
    type(draft_t), intent(inout) :: draft
    type(record_t), intent(in) :: record
    integer, intent(in) :: j

    associate (joint => draft%model%joint(j))
      select case (record%kind)
      case (record_stiffness)
        joint%has_stiffness = .true.
        joint%stiffness = record%value(:6)
      case (record_inertia)
        joint%has_inertia = .true.
        joint%inertia = record%value(1)
      case (record_damping)
        joint%has_damping = .true.
        joint%damping = record%value(:6)
      case default
        joint%initial_stress = record%value(:6)
      end select
    end associate
  end subroutine give_to_joint

end module deck_properties
