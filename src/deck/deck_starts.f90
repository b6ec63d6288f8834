!> STARTX, STARTDX, STARTDE and XM cards: what a motion in time starts from, masses of nodes.
module deck_starts
  use text, only: to_text
  use diagnostics, only: place_t
  use lookup_tables, only: id_table_t
  use model_data, only: start_t, mass_t, mode_flexible, mode_released, translational, rotational
  use model_inertia, only: inertia_matrix
  use deck_draft, only: draft_t, record_t, record_start, record_start_strain, record_mass
  use deck_elements, only: modes_of, find_range, mode_status, complain_of_mode, is_whole
  use deck_form, only: component_names
  use deck_growth, only: grow
  use deck_select, only: choice_t, select_nodes, select_beams, id_text
  use deck_supports, only: is_used, find_component, kind_of
  implicit none
  private

  public :: set_starts, set_masses

contains

  !> Needs the statuses of the modes, the supports and the motions.
  subroutine set_starts(draft)
    type(draft_t), intent(inout) :: draft
    type(choice_t) :: choice
    type(id_table_t) :: given
    integer :: r, i, starts

    starts = 0
    do r = 1, draft%records
      associate (record => draft%record(r))
        if (record%kind == record_start) then
          call select_nodes(draft, record%from, record%to, choice)
          do i = 1, choice%found
            call add_coordinate(draft, record, choice, i, given, starts)
          end do
        else if (record%kind == record_start_strain) then
          call select_beams(draft, record%from, record%to, choice)
          do i = 1, choice%found
            call add_strain(draft, record, choice, i, given, starts)
          end do
        end if
      end associate
    end do
    draft%model%start = draft%model%start(:starts)
  end subroutine set_starts

  subroutine add_coordinate(draft, record, choice, i, given, starts)
    type(draft_t), intent(inout) :: draft
    type(record_t), intent(in) :: record
    type(choice_t), intent(in) :: choice
    integer, intent(in) :: i
    type(id_table_t), intent(inout) :: given
    integer, intent(inout) :: starts
    type(start_t) :: start
    character(len=:), allocatable :: name

    start%node = choice%index(i)
    if (start%node < 0) then
      call draft%report%add_error(choice%place(i), "a start is given for nodes, not markers")
      return
    end if
    if (.not. is_used(draft, start%node, choice%place(i))) return
    associate (item => draft%item(record%item_from), node => draft%model%node(start%node))
      call find_component(draft, item, start%node, choice%loose(i), start%component)
      if (start%component == 0) return
      name = trim(component_names(start%component))//" of node "//id_text(node%id, node%part)
      if (item%value < 0 .and. kind_of(start%component) == rotational) then
        call draft%report%add_error(item%place, "a start of Euler parameters is not read", &
                                    "RX RY RZ: angles, and components of the angular velocity")
      else if (node%fixed(start%component)) then
        if (.not. choice%loose(i)) call draft%report%add_error(item%place, name// &
          " does not move: FIX holds it", "FIX is at "//draft%report%location(node%fix_place))
      else if (is_prescribed(draft, start)) then
        call draft%report%add_error(item%place, name//" moves as INPUTX says")
      else
        start%rate = record%rate
        start%value = record%value(1)
        call keep(draft, start, item%place, name, 16*start%node + start%component, given, starts)
      end if
    end associate
  end subroutine add_coordinate

  !> Whether INPUTX moves a coordinate.
  pure logical function is_prescribed(draft, start)
    type(draft_t), intent(in) :: draft
    type(start_t), intent(in) :: start
    integer :: p

    is_prescribed = .false.
    do p = 1, size(draft%model%pattern)
      associate (motion => draft%model%pattern(p)%motion)
        is_prescribed = is_prescribed .or. any(motion%node == start%node .and. &
                                               motion%component == start%component)
      end associate
    end do
  end function is_prescribed

  subroutine add_strain(draft, record, choice, i, given, starts)
    type(draft_t), intent(inout) :: draft
    type(record_t), intent(in) :: record
    type(choice_t), intent(in) :: choice
    integer, intent(in) :: i
    type(id_table_t), intent(inout) :: given
    integer, intent(inout) :: starts
    type(start_t) :: start
    character(len=:), allocatable :: name
    integer :: e, first, last, k

    k = choice%index(i)
    if (.not. is_whole(draft, k)) return
    call find_range(draft, k, choice%part(i), first, last)
    associate (item => draft%item(record%item_from))
      if (item%value > modes_of(draft, k)) then
        if (.not. choice%listed(i)) then
          call draft%report%add_error(item%place, complain_of_mode(draft, k))
        end if
        return
      end if
      start%mode = item%value
      start%rate = .true.
      start%value = record%value(1)
      name = "mode "//to_text(start%mode)//" of element "//id_text(draft%beam(k)%id, choice%part(i))
      do e = first, last
        if (all(mode_status(draft, e, start%mode) /= [mode_flexible, mode_released])) then
          if (.not. choice%listed(i)) call draft%report%add_error(item%place, name// &
            " is not free to move: it is fixed or prescribed")
          return
        end if
        start%member = merge(e, 0, e <= draft%members)
        start%joint = merge(0, e - draft%members, e <= draft%members)
        call keep(draft, start, item%place, name, -(16*e + start%mode), given, starts)
      end do
    end associate
  end subroutine add_strain

  !> Keep a start, once for what `code` stands for.
  subroutine keep(draft, start, place, name, code, given, starts)
    type(draft_t), intent(inout) :: draft
    type(start_t), intent(in) :: start
    type(place_t), intent(in) :: place
    character(len=*), intent(in) :: name
    integer, intent(in) :: code
    type(id_table_t), intent(inout) :: given
    integer, intent(inout) :: starts
    integer :: number

    call given%add(code, merge(1, 0, start%rate), number)
    if (number <= starts) then
      call draft%report%add_error(place, "the start of "//name//" is given twice", "first at "// &
                                  draft%report%location(draft%model%start(number)%place))
      return
    end if
    starts = number
    call grow(draft%model%start, starts)
    draft%model%start(starts) = start
    draft%model%start(starts)%place = place
  end subroutine keep

  !> Masses of nodes; the cards of one node add up.
  subroutine set_masses(draft)
    type(draft_t), intent(inout) :: draft
    type(choice_t) :: choice
    integer, allocatable :: mass_of(:)
    integer :: r, i, masses

    allocate (mass_of(draft%nodes))
    mass_of = 0
    masses = 0
    do r = 1, draft%records
      if (draft%record(r)%kind /= record_mass) cycle
      call select_nodes(draft, draft%record(r)%from, draft%record(r)%to, choice)
      do i = 1, choice%found
        call add_mass(draft, draft%record(r), choice, i, mass_of, masses)
      end do
    end do
    draft%model%mass = draft%model%mass(:masses)
  end subroutine set_masses

  subroutine add_mass(draft, record, choice, i, mass_of, masses)
    type(draft_t), intent(inout) :: draft
    type(record_t), intent(in) :: record
    type(choice_t), intent(in) :: choice
    integer, intent(in) :: i
    integer, intent(inout) :: mass_of(:), masses
    type(mass_t) :: more
    integer :: k

    k = choice%index(i)
    if (k < 0) then
      call draft%report%add_error(choice%place(i), "XM gives mass to nodes, not markers")
      return
    end if
    if (.not. is_used(draft, k, choice%place(i))) return
    if (record%values /= 6) more%mass = record%value(1)
    if (record%values >= 6) more%inertia = inertia_matrix(record%value(record%values - 5: &
                                                                       record%values))
    if (.not. fits(draft, k, record%values, choice, i)) return
    if (mass_of(k) == 0) then
      masses = masses + 1
      mass_of(k) = masses
      call grow(draft%model%mass, masses)
      draft%model%mass(masses) = mass_t(node=k, place=record%place)
    end if
    associate (mass => draft%model%mass(mass_of(k)))
      mass%mass = mass%mass + more%mass
      mass%inertia = mass%inertia + more%inertia
    end associate
  end subroutine add_mass

  !> A mass needs a translation, inertias a rotation; what ALL means and has them not is left out.
  logical function fits(draft, k, values, choice, i)
    type(draft_t), intent(inout) :: draft
    integer, intent(in) :: k, values, i
    type(choice_t), intent(in) :: choice
    character(len=:), allocatable :: name

    associate (node => draft%model%node(k))
      name = "node "//id_text(node%id, node%part)
      fits = (node%exists(translational) .or. values == 6) .and. &
             (node%exists(rotational) .or. values == 1)
      if (fits .or. choice%loose(i) .or. draft%elements_incomplete) return
      if (values /= 6 .and. .not. node%exists(translational)) then
        call draft%report%add_error(choice%place(i), name//" cannot have mass: no element uses "// &
                                    "its translation", "six values: inertias")
      else
        call draft%report%add_error(choice%place(i), name//" cannot have inertias: no element "// &
                                    "uses its rotation", "one value: mass")
      end if
    end associate
  end function fits

end module deck_starts
