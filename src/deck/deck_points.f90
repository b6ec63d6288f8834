!> Points fixed to sections: markers and places of loads.
module deck_points
  use kinds, only: wp
  use text, only: to_text, quoted
  use section_data, only: section_geometry_t, principal_point, warping_at
  use model_data, only: marker_t, member_t
  use deck_draft, only: draft_t, record_t, record_marker
  use deck_select, only: choice_t, select_nodes, id_text
  implicit none
  private

  public :: neighbours_t, find_neighbours, set_markers, resolve_point

  !> The elements at each node: `member(first(k):first(k + 1) - 1)`.
  type :: neighbours_t
    integer, allocatable :: first(:), member(:)
  end type neighbours_t

contains

  subroutine find_neighbours(draft, neighbours)
    type(draft_t), intent(in) :: draft
    type(neighbours_t), intent(out) :: neighbours
    integer :: m, e, k
    integer, allocatable :: next(:)

    allocate (neighbours%first(draft%nodes + 1), neighbours%member(2*draft%members))
    allocate (next(draft%nodes + 1))
    next = 0
    do m = 1, draft%members
      do e = 1, 2
        k = draft%model%member(m)%node(1, e)
        next(k + 1) = next(k + 1) + 1
      end do
    end do
    next(1) = 1
    do k = 1, draft%nodes
      next(k + 1) = next(k) + next(k + 1)
    end do
    neighbours%first = next
    do m = 1, draft%members
      do e = 1, 2
        k = draft%model%member(m)%node(1, e)
        neighbours%member(next(k)) = m
        next(k) = next(k) + 1
      end do
    end do
  end subroutine find_neighbours

  !> Resolve the MARKER cards.
  subroutine set_markers(draft, neighbours)
    type(draft_t), intent(inout) :: draft
    type(neighbours_t), intent(in) :: neighbours
    type(choice_t) :: choice
    type(marker_t) :: point
    integer :: r, k
    logical :: ok

    do r = 1, draft%records
      if (draft%record(r)%kind /= record_marker) cycle
      call select_nodes(draft, draft%record(r)%from, draft%record(r)%to, choice)
      if (choice%found /= 1) cycle
      if (choice%index(1) < 0) cycle
      call resolve_point(draft, neighbours, draft%record(r), choice%index(1), point, ok)
      if (.not. ok) cycle
      k = draft%marker_of(draft%record(r)%marker)
      point%name = draft%model%marker(k)%name
      point%place = draft%model%marker(k)%place
      draft%model%marker(k) = point
    end do
  end subroutine set_markers

  !> The point that AT and OF of a card mean at a node.
  subroutine resolve_point(draft, neighbours, record, node, point, ok)
    type(draft_t), intent(inout) :: draft
    type(neighbours_t), intent(in) :: neighbours
    type(record_t), intent(in) :: record
    integer, intent(in) :: node
    type(marker_t), intent(out) :: point
    logical, intent(out) :: ok
    type(section_geometry_t) :: geometry
    integer :: section

    call choose_member(draft, neighbours, record, node, point%member)
    ok = point%member > 0
    if (.not. ok) return
    point%node = node
    point%place = record%at_place
    section = draft%model%member(point%member)%section
    ok = section >= 0
    if (section > 0) geometry = draft%model%section(section)%geometry
    if (ok .and. record%at_point) then
      call take_point(draft, record, section, geometry, point, ok)
    else if (ok) then
      point%offset = principal_point(geometry, record%offset)
      call warping_at(geometry, point%offset, point%omega, point%omega_known)
    end if
  end subroutine resolve_point

  !> AT POINT k
  subroutine take_point(draft, record, section, geometry, point, ok)
    type(draft_t), intent(inout) :: draft
    type(record_t), intent(in) :: record
    integer, intent(in) :: section
    type(section_geometry_t), intent(in) :: geometry
    type(marker_t), intent(inout) :: point
    logical, intent(out) :: ok
    character(len=:), allocatable :: name
    integer :: i

    name = "the element"
    if (section > 0) name = "section "//quoted(trim(draft%model%section(section)%name))
    ok = allocated(geometry%number)
    if (.not. ok) then
      call draft%report%add_error(record%at_place, name//" has no points", "AT oy oz")
      return
    end if
    do i = 1, size(geometry%number)
      if (geometry%number(i) /= record%point) cycle
      point%offset = geometry%principal(:, i)
      point%omega_known = geometry%warping_known
      if (geometry%warping_known) point%omega = geometry%omega(i)
      return
    end do
    ok = .false.
    call draft%report%add_error(record%at_place, name//" has no point "//to_text(record%point))
  end subroutine take_point

  !> The element whose section is meant; 0 and an error if that is not clear.
  subroutine choose_member(draft, neighbours, record, node, chosen)
    type(draft_t), intent(inout) :: draft
    type(neighbours_t), intent(in) :: neighbours
    type(record_t), intent(in) :: record
    integer, intent(in) :: node
    integer, intent(out) :: chosen
    character(len=:), allocatable :: name
    integer :: i, m

    chosen = 0
    name = "node "//id_text(draft%model%node(node)%id, draft%model%node(node)%part)
    do i = neighbours%first(node), neighbours%first(node + 1) - 1
      m = neighbours%member(i)
      if (record%of_given) then
        if (.not. is_meant(draft%model%member(m), record)) cycle
      end if
      if (chosen == 0) chosen = m
      if (same_section(draft%model%member(chosen), draft%model%member(m))) cycle
      call draft%report%add_error(record%at_place, "several sections meet at "//name, &
                                  "say whose with OF element")
      chosen = 0
      return
    end do
    if (chosen > 0 .or. draft%elements_incomplete) return
    if (record%of_given) then
      call draft%report%add_error(record%of_place, "element "//id_text(record%of_id, &
                                  record%of_part)//" does not end at "//name)
    else
      call draft%report%add_error(record%at_place, "no element ends at "//name)
    end if
  end subroutine choose_member

  pure logical function is_meant(member, record)
    type(member_t), intent(in) :: member
    type(record_t), intent(in) :: record

    is_meant = member%id == record%of_id .and. (record%of_part == 0 .or. &
                                                record%of_part == member%part)
  end function is_meant

  !> The same section in the same axes.
  pure logical function same_section(a, b)
    type(member_t), intent(in) :: a, b

    same_section = a%section == b%section .and. all(abs(a%triad - b%triad) <= 1.0e-6_wp)
  end function same_section

end module deck_points
