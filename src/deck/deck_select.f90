!> The nodes and elements that the lists of a card mean.
module deck_select
  use text, only: quoted, to_text
  use diagnostics, only: place_t
  use deck_draft, only: draft_t, selection_t, select_all, select_name
  use deck_growth, only: grow
  implicit none
  private

  public :: choice_t, select_nodes, select_beams, id_text

  !> What was selected.
  type :: choice_t
    integer :: found = 0
    integer, allocatable :: index(:)   !< number of the node or beam; a marker as its negative
    integer, allocatable :: part(:)    !< part of the beam; 0: all
    logical, allocatable :: loose(:)   !< selected by ALL: what does not apply is passed over
    logical, allocatable :: listed(:)  !< selected by ALL, a range or a group
    type(place_t), allocatable :: place(:)
  end type choice_t

contains

  !> The nodes that selections `from` to `to` of the draft mean.
  subroutine select_nodes(draft, from, to, choice)
    type(draft_t), intent(inout) :: draft
    integer, intent(in) :: from, to
    type(choice_t), intent(inout) :: choice

    choice%found = 0
    call collect(draft, from, to, .true., choice)
  end subroutine select_nodes

  !> The elements that selections `from` to `to` of the draft mean.
  subroutine select_beams(draft, from, to, choice)
    type(draft_t), intent(inout) :: draft
    integer, intent(in) :: from, to
    type(choice_t), intent(inout) :: choice

    choice%found = 0
    call collect(draft, from, to, .false., choice)
  end subroutine select_beams

  recursive subroutine collect(draft, from, to, of_nodes, choice)
    type(draft_t), intent(inout) :: draft
    integer, intent(in) :: from, to
    logical, intent(in) :: of_nodes
    type(choice_t), intent(inout) :: choice
    integer :: i, k

    do i = from, to
      select case (draft%selection(i)%kind)
      case (select_all)
        do k = 1, merge(draft%nodes, draft%beams, of_nodes)
          if (of_nodes) then
            if (any(draft%model%node(k)%exists)) then
              call append(choice, k, 0, draft%selection(i), .true.)
            end if
          else
            call append(choice, k, 0, draft%selection(i), .true.)
          end if
        end do
      case (select_name)
        call collect_label(draft, draft%selection(i), of_nodes, choice)
      case default
        call collect_range(draft, draft%selection(i), of_nodes, choice)
      end select
    end do
  end subroutine collect

  !> A group, or a marker where nodes are meant.
  recursive subroutine collect_label(draft, selection, of_nodes, choice)
    type(draft_t), intent(inout) :: draft
    type(selection_t), intent(in) :: selection
    logical, intent(in) :: of_nodes
    type(choice_t), intent(inout) :: choice
    character(len=:), allocatable :: name
    integer :: before

    if (.not. draft%labels%usable(selection%name)) return
    name = quoted(trim(draft%labels%table%name(selection%name)))
    associate (group => draft%group(selection%name))
      if (draft%marker_of(selection%name) > 0) then
        if (of_nodes) then
          call append(choice, -draft%marker_of(selection%name), 0, selection, .false.)
        else
          call draft%report%add_error(selection%place, name//" is a marker, not elements")
        end if
      else if (group%of_nodes .neqv. of_nodes) then
        call draft%report%add_error(selection%place, name// &
          trim(merge(" is a group of nodes, not of elements", &
                     " is a group of elements, not of nodes", group%of_nodes)))
      else if (group%open) then
        call draft%report%add_error(selection%place, "group "//name//" contains itself")
      else
        group%open = .true.
        before = choice%found
        call collect(draft, group%from, group%to, of_nodes, choice)
        if (choice%found > before) choice%listed(before + 1:choice%found) = .true.
        group%open = .false.
      end if
    end associate
  end subroutine collect_label

  !> Ids or parts; the first that is missing ends the range.
  subroutine collect_range(draft, selection, of_nodes, choice)
    type(draft_t), intent(inout) :: draft
    type(selection_t), intent(in) :: selection
    logical, intent(in) :: of_nodes
    type(choice_t), intent(inout) :: choice
    integer :: i, id, part, k

    do i = selection%first, selection%last, selection%step
      id = i
      part = 0
      if (selection%id > 0) then
        id = selection%id
        part = i
      end if
      if (of_nodes) then
        k = draft%node_ids%find(id, part)
        if (k > 0) call append(choice, k, 0, selection, .false.)
        if (k == 0 .and. draft%nodes_incomplete) return
      else
        k = draft%beam_ids%find(id, 0)
        if (k > 0) then
          if (part > 0 .and. draft%beam(k)%joint > 0) k = 0
        end if
        if (k > 0) then
          if (part > draft%beam(k)%divide .and. draft%beam(k)%node(1, 1) > 0) k = 0
        end if
        if (k > 0) call append(choice, k, part, selection, .false.)
      end if
      if (k > 0) cycle
      if (part > 0 .and. draft%elements_incomplete) return
      call complain(draft, selection, id, part, of_nodes)
      return
    end do
  end subroutine collect_range

  subroutine complain(draft, selection, id, part, of_nodes)
    type(draft_t), intent(inout) :: draft
    type(selection_t), intent(in) :: selection
    integer, intent(in) :: id, part
    logical, intent(in) :: of_nodes
    character(len=:), allocatable :: hint

    hint = ""
    if (part > 0) then
      if (draft%beam_ids%find(id, 0) == 0) then
        hint = "there is no element "//to_text(id)
      else
        associate (beam => draft%beam(draft%beam_ids%find(id, 0)))
          hint = "element "//to_text(id)//" is not divided"
          if (beam%divide > 1) hint = "element "//to_text(id)//" has "//to_text(beam%divide)// &
                                      " parts, so inner nodes "//to_text(id)//".1 to "// &
                                      id_text(id, beam%divide - 1)
        end associate
      end if
    end if
    call draft%report%add_error(selection%place, "there is no "//trim(merge("node   ", "element", &
                                                 of_nodes))//" "//id_text(id, part), hint)
  end subroutine complain

  !> `5` or `5.2`.
  pure function id_text(id, part) result(phrase)
    integer, intent(in) :: id, part
    character(len=:), allocatable :: phrase

    phrase = to_text(id)
    if (part > 0) phrase = phrase//"."//to_text(part)
  end function id_text

  subroutine append(choice, index, part, selection, loose)
    type(choice_t), intent(inout) :: choice
    integer, intent(in) :: index, part
    type(selection_t), intent(in) :: selection
    logical, intent(in) :: loose
    type(place_t), allocatable :: more(:)
    integer :: n

    n = choice%found + 1
    if (.not. allocated(choice%index)) then
      allocate (choice%index(16), choice%part(16), choice%loose(16), choice%place(16))
      allocate (choice%listed(16))
    end if
    if (n > size(choice%place)) then
      allocate (more(2*n))
      more(:n - 1) = choice%place
      call move_alloc(more, choice%place)
      call grow(choice%index, 2*n)
      call grow(choice%part, 2*n)
      call grow(choice%loose, 2*n)
      call grow(choice%listed, 2*n)
    end if
    choice%index(n) = index
    choice%part(n) = part
    choice%loose(n) = loose
    choice%listed(n) = loose .or. selection%is_range
    choice%place(n) = selection%place
    choice%found = n
  end subroutine append

end module deck_select
