!> Cards about what is put out: COMPLIANCE, OUTPUT; and DAMP.
module deck_output_cards
  use text, only: to_text
  use model_data, only: analysis_t, analysis_compliance, translational
  use deck_card, only: card_t
  use deck_draft, only: draft_t, record_t, record_compliance, record_kept_nodes, &
                        record_kept_elements
  use deck_growth, only: grow
  use deck_model_cards, only: add_selection
  use deck_load_cards, only: begin_analysis, read_name
  use deck_select, only: choice_t, select_nodes, select_beams, id_text
  use deck_targets, only: same_place
  implicit none
  private

  public :: read_compliance, read_kept_nodes, read_kept_elements, read_damp, read_ignored
  public :: set_output

contains

  !> COMPLIANCE nodes ... [NAME name]
  subroutine read_compliance(card, draft)
    type(card_t), intent(in) :: card
    type(draft_t), intent(inout) :: draft
    type(analysis_t) :: analysis
    integer :: k

    call add_lists(card, 2, record_compliance, draft)
    call begin_analysis(card, 1, draft, analysis, k)
    analysis%kind = analysis_compliance
    call read_name(card, 1, k, draft, analysis)
    draft%model%analysis(k) = analysis
  end subroutine read_compliance

  !> OUTPUT NODES list ...
  subroutine read_kept_nodes(card, draft)
    type(card_t), intent(in) :: card
    type(draft_t), intent(inout) :: draft

    call add_lists(card, 3, record_kept_nodes, draft)
  end subroutine read_kept_nodes

  !> OUTPUT ELEMENTS list ...
  subroutine read_kept_elements(card, draft)
    type(card_t), intent(in) :: card
    type(draft_t), intent(inout) :: draft

    call add_lists(card, 3, record_kept_elements, draft)
  end subroutine read_kept_elements

  !> Keep the lists from word `first` to the last positional one.
  subroutine add_lists(card, first, kind, draft)
    type(card_t), intent(in) :: card
    integer, intent(in) :: first, kind
    type(draft_t), intent(inout) :: draft
    type(record_t) :: record
    integer :: w
    logical :: ok

    ok = .true.
    record%kind = kind
    record%place = card%place(1)
    record%block = draft%block
    record%from = draft%selections + 1
    do w = first, card%positional + 1
      call add_selection(card, w, draft, ok)
    end do
    record%to = draft%selections
    draft%records = draft%records + 1
    call grow(draft%record, draft%records)
    draft%record(draft%records) = record
  end subroutine add_lists

  !> DAMP alpha beta
  subroutine read_damp(card, draft)
    type(card_t), intent(in) :: card
    type(draft_t), intent(inout) :: draft
    integer :: i

    if (draft%damp_place%line > 0) call draft%report%add_error( &
      card%place(1), "DAMP is given twice", "first at "//draft%report%location(draft%damp_place))
    draft%damp_place = card%place(1)
    do i = 1, 2
      if (card%number(1 + i) < 0) call draft%report%add_error( &
        card%place(1 + i), "a damping factor cannot be negative")
      draft%model%rayleigh(i) = card%number(1 + i)
    end do
  end subroutine read_damp

  !> SPACAR's cards for its linearization.
  subroutine read_ignored(card, draft)
    type(card_t), intent(in) :: card
    type(draft_t), intent(inout) :: draft

    call draft%report%add_note(card%place(1), card%word(1)// &
                               " is ignored: there is no linearization to state space yet")
  end subroutine read_ignored

  !> Resolve the lists.
  subroutine set_output(draft)
    type(draft_t), intent(inout) :: draft
    logical :: node(draft%nodes), kept_node(draft%nodes), kept_member(draft%members)
    integer :: r, k

    kept_node = .false.
    kept_member = .false.
    do r = 1, draft%records
      associate (record => draft%record(r))
        select case (record%kind)
        case (record_compliance)
          node = .false.
          call mark_nodes(draft, record, node)
          do k = 1, size(draft%model%analysis)
            if (.not. same_place(draft%model%analysis(k)%place, record%place)) cycle
            draft%model%analysis(k)%node = marked(node)
          end do
        case (record_kept_nodes)
          call mark_nodes(draft, record, kept_node)
        case (record_kept_elements)
          call mark_members(draft, record, kept_member)
        case default  ! others are resolved elsewhere
        end select
      end associate
    end do
    draft%model%kept_node = marked(kept_node)
    draft%model%kept_member = marked(kept_member)
  end subroutine set_output

  pure function marked(mark) result(index)
    logical, intent(in) :: mark(:)
    integer, allocatable :: index(:)
    integer :: i, n

    allocate (index(count(mark)))
    n = 0
    do i = 1, size(mark)
      if (.not. mark(i)) cycle
      n = n + 1
      index(n) = i
    end do
  end function marked

  !> Mark the nodes of a record; those of COMPLIANCE must translate.
  subroutine mark_nodes(draft, record, mark)
    type(draft_t), intent(inout) :: draft
    type(record_t), intent(in) :: record
    logical, intent(inout) :: mark(:)
    type(choice_t) :: choice
    integer :: i, k
    logical :: ok

    call select_nodes(draft, record%from, record%to, choice)
    do i = 1, choice%found
      k = choice%index(i)
      if (k < 0) then
        call draft%report%add_error(choice%place(i), "a node expected, not a marker", &
                                    "the displacements of markers are always kept")
        cycle
      end if
      associate (node => draft%model%node(k))
        ok = any(node%exists)
        if (record%kind == record_compliance) ok = node%exists(translational)
        mark(k) = mark(k) .or. ok
        if (ok .or. choice%loose(i) .or. draft%elements_incomplete .or. draft%node_broken(k)) cycle
        if (any(node%exists)) then
          call draft%report%add_error(choice%place(i), "node "//id_text(node%id, node%part)// &
                                      " has no translation")
        else
          call draft%report%add_error(choice%place(i), "no element uses node "// &
                                      id_text(node%id, node%part))
        end if
      end associate
    end do
  end subroutine mark_nodes

  !> Mark the elements of a record, all parts of a divided one.
  subroutine mark_members(draft, record, mark)
    type(draft_t), intent(inout) :: draft
    type(record_t), intent(in) :: record
    logical, intent(inout) :: mark(:)
    type(choice_t) :: choice
    integer :: i, first

    call select_beams(draft, record%from, record%to, choice)
    do i = 1, choice%found
      associate (beam => draft%beam(choice%index(i)))
        first = beam%first_member
        if (beam%joint > 0 .and. .not. choice%loose(i)) call draft%report%add_error( &
          choice%place(i), "element "//to_text(beam%id)//" is a joint: those are always kept", &
          "OUTPUT ELEMENTS chooses among beams")
        if (first == 0) cycle
        if (choice%part(i) > 0) then
          mark(first + choice%part(i) - 1) = .true.
        else
          mark(first:first + beam%divide - 1) = .true.
        end if
      end associate
    end do
  end subroutine mark_members

end module deck_output_cards
