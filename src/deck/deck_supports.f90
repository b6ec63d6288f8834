!> FIX cards: which coordinates of which nodes are held.
module deck_supports
  use text, only: to_text
  use diagnostics, only: place_t
  use model_data, only: translational, rotational, warping
  use deck_draft, only: draft_t, record_t, item_t, record_fix
  use deck_form, only: component_names
  use deck_select, only: choice_t, select_nodes, id_text
  implicit none
  private

  public :: set_supports, is_used, find_component

  !> The kind of node that each component X Y Z RX RY RZ W belongs to.
  integer, parameter, public :: kind_of(7) = [1, 1, 1, 2, 2, 2, 3]
  character(len=*), parameter :: kind_names(3) = ["translation", "rotation   ", "warping    "]
  character(len=*), parameter :: kind_numbers(3) = &
    ["translation (1 to 3)", "rotation (2 to 4)   ", "warping (1)         "]

contains

  !> Apply all FIX cards.
  subroutine set_supports(draft)
    type(draft_t), intent(inout) :: draft
    type(choice_t) :: choice
    integer :: r, i

    do r = 1, draft%records
      if (draft%record(r)%kind /= record_fix) cycle
      call select_nodes(draft, draft%record(r)%from, draft%record(r)%to, choice)
      do i = 1, choice%found
        call fix_node(draft, draft%record(r), choice, i)
      end do
    end do
  end subroutine set_supports

  subroutine fix_node(draft, record, choice, i)
    type(draft_t), intent(inout) :: draft
    type(record_t), intent(in) :: record
    type(choice_t), intent(in) :: choice
    integer, intent(in) :: i
    integer :: k, item, component

    k = choice%index(i)
    if (k < 0) then
      call draft%report%add_error(choice%place(i), "FIX holds nodes, not markers")
      return
    end if
    if (.not. is_used(draft, k, choice%place(i))) return
    draft%model%node(k)%fix_place = record%place
    do item = record%item_from, record%item_to
      call find_component(draft, draft%item(item), k, choice%loose(i), component)
      if (component > 0) draft%model%node(k)%fixed(component) = .true.
    end do
    if (record%item_to >= record%item_from) return
    associate (node => draft%model%node(k))
      node%fixed = node%fixed .or. node%exists(kind_of)
    end associate
  end subroutine fix_node

  !> Whether an element uses a node; else an error.
  logical function is_used(draft, k, place)
    type(draft_t), intent(inout) :: draft
    integer, intent(in) :: k
    type(place_t), intent(in) :: place

    associate (node => draft%model%node(k))
      is_used = any(node%exists)
      if (is_used .or. draft%elements_incomplete .or. draft%node_broken(k)) return
      call draft%report%add_error(place, "no element uses node "//id_text(node%id, node%part))
    end associate
  end function is_used

  !> The component of a node that a word means, 1 to 7; 0 if the node does not have it, which is an
  !> error unless `loose`.
  subroutine find_component(draft, item, k, loose, component)
    type(draft_t), intent(inout) :: draft
    type(item_t), intent(in) :: item
    integer, intent(in) :: k
    logical, intent(in) :: loose
    integer, intent(out) :: component

    associate (node => draft%model%node(k))
      component = item%value
      if (component < 0) call component_of_number(draft, item, k, component)
      if (component == 0) return
      if (node%exists(kind_of(component))) return
      if (.not. (loose .or. draft%elements_incomplete)) then
        call draft%report%add_error(item%place, "node "//id_text(node%id, node%part)//" has no "// &
                                    trim(component_names(component))//": no element uses its "// &
                                    trim(kind_names(kind_of(component))))
      end if
      component = 0
    end associate
  end subroutine find_component

  !> SPACAR's numbers: translational 1-3, rotational 2-4, warping 1; 0 if it is none.
  subroutine component_of_number(draft, item, k, component)
    type(draft_t), intent(inout) :: draft
    type(item_t), intent(in) :: item
    integer, intent(in) :: k
    integer, intent(out) :: component
    integer, parameter :: first(3) = [1, 2, 1], last(3) = [3, 4, 1], offset(3) = [0, 2, 6]
    integer :: kind, number
    character(len=:), allocatable :: hint

    component = 0
    number = -item%value
    hint = ""
    associate (node => draft%model%node(k))
      if (count(node%exists) > 1) then
        if (.not. draft%elements_incomplete) call draft%report%add_error(item%place, &
          "node "//id_text(node%id, node%part)//" is of several kinds: numbers are for one", &
          "write X Y Z RX RY RZ W; other nodes take a card of their own, a range or a GROUP")
        return
      end if
      do kind = translational, warping
        if (.not. node%exists(kind)) cycle
        if (kind == rotational .and. number == 1) hint = "Euler parameter 1 follows from 2 3 4"
        if (number >= first(kind) .and. number <= last(kind)) then
          component = number + offset(kind)
        else
          call draft%report%add_error(item%place, "node "//id_text(node%id, node%part)// &
            " has no component "//to_text(number)//": it has "//trim(kind_numbers(kind)), hint)
        end if
      end do
    end associate
  end subroutine component_of_number

end module deck_supports
