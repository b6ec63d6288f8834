!> What a STATIC card controls and where it stops: displacements of nodes or markers.
module deck_targets
  use text, only: to_text
  use diagnostics, only: place_t
  use model_data, only: target_t, analysis_t, imperfection_t, control_load, control_displacement, &
                        control_arc, analysis_buckling
  use deck_card, only: card_t
  use deck_draft, only: draft_t, record_t, record_control, record_stop
  use deck_element_cards, only: add_record
  use deck_form, only: component_names
  use deck_select, only: choice_t, select_nodes
  use deck_supports, only: kind_of
  implicit none
  private

  public :: read_control, read_target, set_targets, read_imperfection, same_place

contains

  !> CONTROL LOAD | ARC | DISPLACEMENT node component value: the words are options number `first`
  !> (CONTROL) and the three behind it.
  subroutine read_control(card, first, draft, analysis)
    type(card_t), intent(in) :: card
    integer, intent(in) :: first
    type(draft_t), intent(inout) :: draft
    type(analysis_t), intent(inout) :: analysis
    integer, parameter :: kinds(3) = [control_load, control_arc, control_displacement]
    integer :: i, given

    given = count(card%option(first + 1:first + 3) > 0)
    if (given == 0 .and. card%option(first) == 0) return
    if (given /= 1) then
      call draft%report%add_error(card%place(maxval(card%option(first:first + 3))), &
                                  "CONTROL takes one of LOAD, ARC, "// &
                                  "DISPLACEMENT node component value")
      return
    end if
    do i = 1, 3
      if (card%option(first + i) > 0) analysis%control = kinds(i)
    end do
    if (analysis%control == control_displacement) then
      call read_target(card, card%option(first + 3), record_control, draft)
    end if
  end subroutine read_control

  !> Keep the words `node component value` behind word `w` until the nodes are known.
  subroutine read_target(card, w, kind, draft)
    type(card_t), intent(in) :: card
    integer, intent(in) :: w, kind
    type(draft_t), intent(inout) :: draft
    type(record_t) :: record

    record%kind = kind
    record%point = card%whole(w + 2)
    record%value(1) = card%number(w + 3)
    record%at_place = card%place(w + 1)
    call add_record(card, w + 1, draft, record)
  end subroutine read_target

  !> IMPERFECTION mode scale
  subroutine read_imperfection(card, draft)
    type(card_t), intent(in) :: card
    type(draft_t), intent(inout) :: draft
    type(imperfection_t), allocatable :: more(:)
    integer :: n, k

    k = 0
    if (draft%analyses > 0) then
      k = findloc(draft%model%analysis(:draft%analyses)%kind, analysis_buckling, 1, back=.true.)
    end if
    if (k == 0) then
      call draft%report%add_error(card%place(1), "IMPERFECTION needs a BUCKLING before it")
      return
    end if
    if (card%whole(2) < 1 .or. card%whole(2) > 2*draft%model%analysis(k)%modes) then
      call draft%report%add_error(card%place(2), "the number of a mode of BUCKLING expected")
    end if
    n = size(draft%model%imperfection)
    allocate (more(n + 1))
    more(:n) = draft%model%imperfection
    more(n + 1)%mode = card%whole(2)
    more(n + 1)%scale = card%number(3)
    more(n + 1)%block = draft%block
    more(n + 1)%place = card%place(1)
    call move_alloc(more, draft%model%imperfection)
  end subroutine read_imperfection

  !> Resolve them.
  subroutine set_targets(draft)
    type(draft_t), intent(inout) :: draft
    type(choice_t) :: choice
    type(target_t) :: target
    integer :: r, k
    logical :: ok

    do r = 1, draft%records
      associate (record => draft%record(r))
        if (record%kind /= record_control .and. record%kind /= record_stop) cycle
        call select_nodes(draft, record%from, record%to, choice)
        if (choice%found == 0) cycle
        call resolve_target(draft, record, choice, target, ok)
        if (.not. ok) cycle
        do k = 1, size(draft%model%analysis)
          if (.not. same_place(draft%model%analysis(k)%place, record%place)) cycle
          if (record%kind == record_control) draft%model%analysis(k)%controlled = target
          if (record%kind == record_stop) draft%model%analysis(k)%stop = target
        end do
      end associate
    end do
  end subroutine set_targets

  pure logical function same_place(a, b)
    type(place_t), intent(in) :: a, b

    same_place = a%file == b%file .and. a%line == b%line .and. a%column == b%column
  end function same_place

  subroutine resolve_target(draft, record, choice, target, ok)
    type(draft_t), intent(inout) :: draft
    type(record_t), intent(in) :: record
    type(choice_t), intent(in) :: choice
    type(target_t), intent(out) :: target
    logical, intent(out) :: ok

    ok = .false.
    target%value = record%value(1)
    target%component = record%point
    if (choice%found > 1) then
      call draft%report%add_error(record%at_place, "one node or marker expected, this means "// &
                                  to_text(choice%found))
    else if (target%component < 1) then
      call draft%report%add_error(record%at_place, "a component's name expected behind the node", &
                                  "components are X Y Z RX RY RZ W")
    else if (choice%index(1) < 0) then
      target%marker = -choice%index(1)
      ok = target%component <= 3
      if (.not. ok) call draft%report%add_error(record%at_place, "a marker has components X Y Z")
    else
      target%node = choice%index(1)
      ok = draft%model%node(target%node)%exists(kind_of(target%component))
      if (.not. ok) call draft%report%add_error(record%at_place, "no element uses "// &
        trim(component_names(target%component))//" of this node")
    end if
  end subroutine resolve_target

end module deck_targets
