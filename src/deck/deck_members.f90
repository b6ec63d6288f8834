!> From BEAMW cards to the elements of the model: parts, inner nodes, status of the modes.
module deck_members
  use text, only: to_text
  use kinds, only: wp
  use model_data, only: member_t, mode_fixed, mode_flexible, mode_released, type_beamw
  use deck_draft, only: draft_t, beam_t, record_t, record_flexible, record_release, &
                        record_stiffness, record_inertia
  use deck_model_cards, only: node_number
  use deck_select, only: choice_t, select_beams, id_text
  implicit none
  private

  public :: expand_beams, set_modes

contains

  !> Make the elements and the inner nodes of divided ones.
  subroutine expand_beams(draft)
    type(draft_t), intent(inout) :: draft
    integer :: b, total

    total = 0
    do b = 1, draft%beams
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
    member%kind = type_beamw
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
    do kind = 1, 3
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

  !> Apply DYNE, RLSE, ESTIFF and EM; then let modes 7 and 8 follow mode 2.
  subroutine set_modes(draft)
    type(draft_t), intent(inout) :: draft
    type(choice_t) :: choice
    logical, allocatable :: listed(:)
    integer :: r, i

    allocate (listed(draft%members))
    listed = .false.
    do r = 1, draft%records
      if (draft%record(r)%kind < record_flexible .or. draft%record(r)%kind > record_inertia) cycle
      call select_beams(draft, draft%record(r)%from, draft%record(r)%to, choice)
      do i = 1, choice%found
        associate (beam => draft%beam(choice%index(i)))
          if (beam%first_member == 0) cycle
          call apply_record(draft, draft%record(r), beam, choice, i, listed)
        end associate
      end do
    end do
    call follow_twist(draft)
  end subroutine set_modes

  subroutine apply_record(draft, record, beam, choice, i, listed)
    type(draft_t), intent(inout) :: draft
    type(record_t), intent(in) :: record
    type(beam_t), intent(in) :: beam
    type(choice_t), intent(in) :: choice
    integer, intent(in) :: i
    logical, intent(inout) :: listed(:)
    integer :: first, last

    first = beam%first_member
    last = first + beam%divide - 1
    if (choice%part(i) > 0) then
      first = first + choice%part(i) - 1
      last = first
    end if
    select case (record%kind)
    case (record_flexible)
      call make_flexible(draft, record, beam, first, last, listed, choice%loose(i))
    case (record_release)
      call release(draft, record, beam, first, last, listed)
    case default
      call give_values(draft, record, choice, i, first, last)
    end select
  end subroutine apply_record

  !> DYNE: on a beam with SECTION the first such card replaces "all".
  subroutine make_flexible(draft, record, beam, first, last, listed, loose)
    type(draft_t), intent(inout) :: draft
    type(record_t), intent(in) :: record
    type(beam_t), intent(in) :: beam
    integer, intent(in) :: first, last
    logical, intent(inout) :: listed(:)
    logical, intent(in) :: loose
    integer :: m, k

    if (beam%rigid) then
      if (.not. loose) call draft%report%add_error(record%place, "element "//to_text(beam%id)// &
                                                   " is RIGID: DYNE contradicts")
      return
    end if
    do m = first, last
      associate (member => draft%model%member(m))
        if (.not. listed(m)) where (member%status == mode_flexible) member%status = mode_fixed
        listed(m) = .true.
        do k = record%item_from, record%item_to
          associate (mode => draft%item(k)%value)
            if (member%status(mode) == mode_released) then
              call draft%report%add_error(draft%item(k)%place, "mode "//to_text(mode)// &
                " of element "//to_text(beam%id)//" is released by RLSE")
              return
            end if
            member%status(mode) = mode_flexible
          end associate
        end do
      end associate
    end do
  end subroutine make_flexible

  !> RLSE; of a divided element, end modes belong to one part each.
  subroutine release(draft, record, beam, first, last, listed)
    type(draft_t), intent(inout) :: draft
    type(record_t), intent(in) :: record
    type(beam_t), intent(in) :: beam
    integer, intent(in) :: first, last
    logical, intent(in) :: listed(:)
    integer :: k, m

    do k = record%item_from, record%item_to
      associate (mode => draft%item(k)%value)
        if (last > first .and. mode > 2) then
          m = merge(1, beam%divide, modulo(mode, 2) == 1)
          call draft%report%add_error(draft%item(k)%place, "element "//to_text(beam%id)// &
            " is divided: mode "//to_text(mode)//" is an end mode, of its parts "// &
            id_text(beam%id, 1)//" (3 5 7, end p) and "//id_text(beam%id, beam%divide)// &
            " (4 6 8, end q)", "RLSE "//id_text(beam%id, m)//" "//to_text(mode))
          cycle
        end if
        do m = first, last
          if (listed(m) .and. draft%model%member(m)%status(mode) == mode_flexible) then
            call draft%report%add_error(draft%item(k)%place, "mode "//to_text(mode)// &
              " of element "//to_text(beam%id)//" is made flexible by DYNE")
            exit
          end if
          draft%model%member(m)%status(mode) = mode_released
        end do
      end associate
    end do
  end subroutine release

  !> ESTIFF or EM, once per element and not beside a SECTION.
  subroutine give_values(draft, record, choice, i, first, last)
    type(draft_t), intent(inout) :: draft
    type(record_t), intent(in) :: record
    type(choice_t), intent(in) :: choice
    integer, intent(in) :: i, first, last
    integer :: m
    logical :: given

    do m = first, last
      associate (member => draft%model%member(m))
        if (member%section /= 0) then
          if (.not. choice%loose(i)) call draft%report%add_error(choice%place(i), "element "// &
            id_text(member%id, choice%part(i))// &
            " has a SECTION, which gives its stiffness and mass")
          return
        end if
        if (record%kind == record_stiffness) then
          given = member%has_stiffness
          member%has_stiffness = .true.
          member%stiffness = record%value
        else
          given = member%has_inertia
          member%has_inertia = .true.
          member%inertia = record%value(:6)
        end if
        if (given) then
          call draft%report%add_error(choice%place(i), "element "// &
            id_text(member%id, choice%part(i))//" has this card already")
          return
        end if
      end associate
    end do
  end subroutine give_values

  !> Modes 7 and 8 are flexible if mode 2 is, else fixed, unless released.
  subroutine follow_twist(draft)
    type(draft_t), intent(inout) :: draft
    integer :: m, mode

    do m = 1, draft%members
      associate (member => draft%model%member(m))
        do mode = 7, 8
          if (member%status(mode) == mode_released) cycle
          if (member%status(mode) == mode_flexible .and. member%status(2) /= mode_flexible .and. &
              member%part <= 1 .and. member%section >= 0) call draft%report%add_error( &
            member%place, "DYNE makes mode "//to_text(mode)//" of element "//to_text(member%id)// &
            " flexible without mode 2, which it follows")
          member%status(mode) = merge(mode_flexible, mode_fixed, member%status(2) == mode_flexible)
        end do
      end associate
    end do
  end subroutine follow_twist

end module deck_members
