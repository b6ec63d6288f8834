!> Cards that name things: nodes, materials, groups, settings.
module deck_model_cards
  use kinds, only: wp
  use text, only: quoted, to_text, upper
  use diagnostics, only: place_t, report_t
  use deck_card, only: card_t
  use deck_draft, only: draft_t, selection_t, group_t
  use deck_growth, only: grow
  use deck_registry, only: registry_t
  use deck_settings, only: is_identifier, reserved_names
  use deck_number, only: parse_number, number_ok
  use deck_values, only: read_number, add_list
  implicit none
  private

  public :: read_title, read_set, read_include, read_nothing, read_halt, read_visualization
  public :: read_outlevel
  public :: read_node, read_material, read_group_nodes, read_group_elements
  public :: node_number, define_name, add_selection

contains

  subroutine read_title(card, draft)
    type(card_t), intent(in) :: card
    type(draft_t), intent(inout) :: draft

    if (draft%model%title /= "") then
      call draft%report%add_warning(card%place(1), "a second TITLE replaces the first")
    end if
    draft%model%title = card%raw(2)
  end subroutine read_title

  !> END: a separator without meaning.
  subroutine read_nothing(card, draft)
    type(card_t), intent(in) :: card
    type(draft_t), intent(inout) :: draft

    if (card%words == 0) draft%finished = .true.
  end subroutine read_nothing

  !> HALT: from here on INPUTX and INPUTE give values, before it they declare.
  subroutine read_halt(card, draft)
    type(card_t), intent(in) :: card
    type(draft_t), intent(inout) :: draft

    draft%halted = card%words > 0
  end subroutine read_halt

  subroutine read_visualization(card, draft)
    type(card_t), intent(in) :: card
    type(draft_t), intent(inout) :: draft

    draft%finished = card%words > 0
  end subroutine read_visualization

  subroutine read_outlevel(card, draft)
    type(card_t), intent(in) :: card
    type(draft_t), intent(inout) :: draft

    call draft%report%add_note(card%place(1), "OUTLEVEL is ignored: all results are written")
  end subroutine read_outlevel

  !> Leaves the path to the reader.
  subroutine read_include(card, draft)
    type(card_t), intent(in) :: card
    type(draft_t), intent(inout) :: draft

    draft%include_path = card%word(2)
    draft%include_place = card%place(2)
  end subroutine read_include

  !> SET name value; -D replaces the value.
  subroutine read_set(card, draft)
    type(card_t), intent(in) :: card
    type(draft_t), intent(inout) :: draft
    character(len=:), allocatable :: name, word
    logical :: overridden
    integer :: i

    name = card%word(2)
    word = card%word(3)
    i = draft%settings%table%find(name)
    if (.not. is_identifier(name)) then
      call draft%report%add_error(card%place(2), quoted(name)//" cannot be a name", &
                                  "names have letters, digits and _, no digit first")
    else if (any(reserved_names == name)) then
      call draft%report%add_error(card%place(2), quoted(name)//" is reserved")
    else if (i > 0) then
      call draft%report%add_error(card%place(2), quoted(name)//" is already set", &
                                  "first set at "//draft%report%location(draft%settings%place(i)))
    else
      overridden = .false.
      do i = 1, size(draft%override)
        if (draft%override(i)%name /= name) cycle
        word = draft%override(i)%value
        draft%override_used(i) = .true.
        overridden = .true.
      end do
      call define_setting(card, draft, name, word, overridden)
    end if
  end subroutine read_set

  !> What starts like a number or is an expression must be one.
  subroutine define_setting(card, draft, name, word, overridden)
    type(card_t), intent(in) :: card
    type(draft_t), intent(inout) :: draft
    character(len=*), intent(in) :: name, word
    logical, intent(in) :: overridden
    real(wp) :: number
    integer :: status
    logical :: numeric, ok

    ok = .true.
    numeric = (overridden .or. .not. card%is_quoted(3)) .and. scan(word//" ", "0123456789.+-{") == 1
    number = 0.0_wp
    if (numeric .and. overridden) then
      call parse_number(word, number, status)
      if (status /= number_ok) call draft%report%add_error(place_t(), "-D "//name//"="//word// &
                                                     ": "//quoted(word)//" is not a number")
    else if (numeric) then
      call read_number(word, card%place(3), draft, number, ok)
    end if
    if (index(word, "{") == 1) then
      call draft%settings%define(name, to_text(number, 17), numeric, number, card%place(2))
    else
      call draft%settings%define(name, word, numeric, number, card%place(2))
    end if
  end subroutine define_setting

  !> NODE id x y z
  subroutine read_node(card, draft)
    type(card_t), intent(in) :: card
    type(draft_t), intent(inout) :: draft
    integer :: k

    call node_number(draft, card%whole(2), 0, card%place(2), k)
    associate (node => draft%model%node(k))
      if (node%placed .or. draft%node_broken(k)) then
        call draft%report%add_error(card%place(2), "node "//to_text(node%id)// &
                                    " has a position already", &
                                    "first given at "//draft%report%location(node%place))
        return
      end if
      node%position = card%number(3:5)
      node%placed = .true.
      node%place = card%place(2)
    end associate
  end subroutine read_node

  !> Number of a node in the model, new or not.
  subroutine node_number(draft, id, part, place, number)
    type(draft_t), intent(inout) :: draft
    integer, intent(in) :: id, part
    type(place_t), intent(in) :: place
    integer, intent(out) :: number

    call draft%node_ids%add(id, part, number)
    if (number <= draft%nodes) return
    draft%nodes = number
    call grow(draft%model%node, number)
    call grow(draft%node_broken, number)
    draft%node_broken(number) = .false.
    draft%model%node(number)%id = id
    draft%model%node(number)%part = part
    draft%model%node(number)%place = place
  end subroutine node_number

  !> MATERIAL name E e (G g | NU nu) [RHO rho] [DAMPING beta]
  subroutine read_material(card, draft)
    type(card_t), intent(in) :: card
    type(draft_t), intent(inout) :: draft
    integer :: k
    real(wp) :: nu
    logical :: ok

    if (card%option(2) > 0 .and. card%option(3) > 0) call draft%report%add_error( &
      card%place(card%option(3)), "G and NU are both given", "G = E/(2(1 + NU)): one is enough")
    if (card%option(2) == 0 .and. card%option(3) == 0) then
      call draft%report%add_error(card%place(1), "MATERIAL needs G or NU")
    end if
    ok = (card%option(2) > 0) .neqv. (card%option(3) > 0)
    call define_name(card, 2, draft%report, draft%materials, ok, k)
    if (k == 0) return
    call grow(draft%model%material, k)
    associate (material => draft%model%material(k))
      material%name = card%word(2)
      material%place = card%place(2)
      material%e = card%number(card%option(1) + 1)
      material%g = material%e/2.0_wp
      if (card%option(2) > 0) material%g = card%number(card%option(2) + 1)
      if (card%option(3) > 0) then
        nu = card%number(card%option(3) + 1)
        if (nu <= -1.0_wp .or. nu > 0.5_wp) then
          call draft%report%add_error(card%place(card%option(3) + 1), &
                                      "NU must be above -1 and not above 0.5")
        else
          material%g = material%e/(2.0_wp*(1.0_wp + nu))
        end if
      end if
      if (card%option(4) > 0) material%rho = card%number(card%option(4) + 1)
      if (card%option(5) > 0) material%damping = card%number(card%option(5) + 1)
    end associate
  end subroutine read_material

  !> Number of a name that a card defines; 0 and an error if it was defined before.
  subroutine define_name(card, w, report, registry, usable, number)
    type(card_t), intent(in) :: card
    integer, intent(in) :: w
    type(report_t), intent(inout) :: report
    type(registry_t), intent(inout) :: registry
    logical, intent(in) :: usable
    integer, intent(out) :: number
    type(place_t) :: first

    call registry%define(card%word(w), card%place(w), usable, number, first)
    if (first%line == 0) return
    number = 0
    call report%add_error(card%place(w), trim(registry%noun)//" "//quoted(card%word(w))// &
                                " is already defined", "first at "//report%location(first))
  end subroutine define_name

  subroutine read_group_nodes(card, draft)
    type(card_t), intent(in) :: card
    type(draft_t), intent(inout) :: draft

    call read_group(card, draft, .true.)
  end subroutine read_group_nodes

  subroutine read_group_elements(card, draft)
    type(card_t), intent(in) :: card
    type(draft_t), intent(inout) :: draft

    call read_group(card, draft, .false.)
  end subroutine read_group_elements

  !> GROUP name NODES|ELEMENTS list ...
  subroutine read_group(card, draft, of_nodes)
    type(card_t), intent(in) :: card
    type(draft_t), intent(inout) :: draft
    logical, intent(in) :: of_nodes
    type(group_t) :: group
    integer :: k, w
    logical :: ok

    group%of_nodes = of_nodes
    group%from = draft%selections + 1
    ok = is_identifier(card%word(2)) .and. upper(card%word(2)) /= "ALL"
    if (.not. ok) call draft%report%add_error(card%place(2), quoted(card%word(2))// &
                                              " cannot be the name of a group", &
                                              "names have letters, digits and _, no digit first")
    do w = 4, card%words
      call add_selection(card, w, draft, ok)
    end do
    group%to = draft%selections
    call define_name(card, 2, draft%report, draft%labels, ok, k)
    if (k == 0) return
    call grow(draft%group, k)
    draft%group(k) = group
  end subroutine read_group

  !> Keep a list word of a card.
  subroutine add_selection(card, w, draft, ok)
    type(card_t), intent(in) :: card
    integer, intent(in) :: w
    type(draft_t), intent(inout) :: draft
    logical, intent(inout) :: ok
    type(selection_t) :: selection
    logical :: good

    good = .true.
    call add_list(card, w, draft, selection, good)
    ok = ok .and. good
    if (.not. good) return
    draft%selections = draft%selections + 1
    call grow(draft%selection, draft%selections)
    draft%selection(draft%selections) = selection
  end subroutine add_selection

end module deck_model_cards
