!> INPUTX and INPUTE cards to the motions of the patterns.
module deck_motions
  use kinds, only: wp
  use text, only: to_text
  use diagnostics, only: place_t
  use lookup_tables, only: id_table_t
  use model_data, only: motion_t, static_analyses, time_analyses, control_displacement
  use model_functions, only: function_value
  use deck_draft, only: draft_t, record_t, record_coordinate, record_strain
  use deck_elements, only: modes_of, find_range, is_whole
  use deck_form, only: component_names
  use deck_growth, only: grow
  use deck_select, only: choice_t, select_nodes, select_beams, id_text
  use deck_supports, only: is_used, find_component, kind_of
  implicit none
  private

  public :: set_motions

  !> The motions of the patterns by what they move.
  type :: targets_t
    type(id_table_t) :: table          !< numbers (target, pattern)
    integer, allocatable :: motion(:)  !< by that number: index in its pattern
  end type targets_t

contains

  !> Put the motions into their patterns; `pattern` is that of `set_analyses`. What is declared
  !> and gets no value is held where it is, by the first pattern.
  subroutine set_motions(draft, pattern)
    type(draft_t), intent(inout) :: draft
    integer, intent(in) :: pattern(:, :)
    type(targets_t) :: targets
    integer :: p, r

    allocate (targets%motion(64))
    do p = 1, size(draft%model%pattern)
      allocate (draft%model%pattern(p)%motion(8))
      do r = 1, draft%records
        if (.not. is_input(draft%record(r)) .or. draft%record(r)%values == 0) cycle
        if (pattern(merge(2, 1, draft%record(r)%additional), draft%record(r)%block) /= p) cycle
        call add_inputs(draft, draft%record(r), p, targets)
      end do
    end do
    do r = 1, draft%records
      if (.not. is_input(draft%record(r)) .or. draft%record(r)%values > 0) cycle
      if (size(draft%model%pattern) == 0) then
        deallocate (draft%model%pattern)
        allocate (draft%model%pattern(1))
        allocate (draft%model%pattern(1)%motion(8), draft%model%pattern(1)%load(0))
      end if
      call add_inputs(draft, draft%record(r), 0, targets)
    end do
    do p = 1, size(draft%model%pattern)
      associate (moved => draft%model%pattern(p))
        moved%motion = moved%motion(:moved%motions)
      end associate
    end do
  end subroutine set_motions

  pure logical function is_input(record)
    type(record_t), intent(in) :: record

    is_input = record%kind == record_coordinate .or. record%kind == record_strain
  end function is_input

  !> The motions of one card; `p` = 0: declared.
  subroutine add_inputs(draft, record, p, targets)
    type(draft_t), intent(inout) :: draft
    type(record_t), intent(in) :: record
    integer, intent(in) :: p
    type(targets_t), intent(inout) :: targets
    type(choice_t) :: choice
    integer :: i

    if (record%kind == record_strain) then
      call select_beams(draft, record%from, record%to, choice)
    else
      call select_nodes(draft, record%from, record%to, choice)
    end if
    do i = 1, choice%found
      if (record%kind == record_strain) then
        call add_strains(draft, record, choice, i, p, targets)
      else
        call add_coordinates(draft, record, choice, i, p, targets)
      end if
    end do
  end subroutine add_inputs

  !> Modes of one element; those it does not have are known by now to be left out.
  subroutine add_strains(draft, record, choice, i, p, targets)
    type(draft_t), intent(inout) :: draft
    type(record_t), intent(in) :: record
    type(choice_t), intent(in) :: choice
    integer, intent(in) :: i, p
    type(targets_t), intent(inout) :: targets
    type(motion_t) :: motion
    integer :: item, e, first, last

    if (.not. is_whole(draft, choice%index(i))) return
    call find_range(draft, choice%index(i), choice%part(i), first, last)
    do item = record%item_from, record%item_to
      motion%mode = draft%item(item)%value
      motion%place = draft%item(item)%place
      if (motion%mode > min(6, modes_of(draft, choice%index(i)))) cycle
      do e = first, last
        motion%member = merge(e, 0, e <= draft%members)
        motion%joint = merge(0, e - draft%members, e <= draft%members)
        call add_motion(draft, record, motion, "mode "//to_text(motion%mode)//" of element "// &
                        id_text(draft%beam(choice%index(i))%id, choice%part(i)), p, targets)
      end do
    end do
  end subroutine add_strains

  !> Components of one node; a card without components declares all that exist.
  subroutine add_coordinates(draft, record, choice, i, p, targets)
    type(draft_t), intent(inout) :: draft
    type(record_t), intent(in) :: record
    type(choice_t), intent(in) :: choice
    integer, intent(in) :: i, p
    type(targets_t), intent(inout) :: targets
    integer :: item, component, k

    k = choice%index(i)
    if (k < 0) then
      call draft%report%add_error(choice%place(i), "INPUTX moves nodes, not markers")
      return
    end if
    if (.not. is_used(draft, k, choice%place(i))) return
    do item = record%item_from, record%item_to
      call find_component(draft, draft%item(item), k, choice%loose(i), component)
      if (component == 0) cycle
      call add_coordinate(draft, record, k, component, draft%item(item)%value < 0, &
                          choice%loose(i), draft%item(item)%place, p, targets)
    end do
    if (record%item_to >= record%item_from) return
    do component = 1, size(kind_of)
      if (.not. draft%model%node(k)%exists(kind_of(component))) cycle
      call add_coordinate(draft, record, k, component, .false., choice%loose(i), choice%place(i), &
                          p, targets)
    end do
  end subroutine add_coordinates

  !> One component, unless FIX holds it.
  subroutine add_coordinate(draft, record, k, component, numbered, loose, place, p, targets)
    type(draft_t), intent(inout) :: draft
    type(record_t), intent(in) :: record
    integer, intent(in) :: k, component, p
    logical, intent(in) :: numbered         !< given by SPACAR's number
    logical, intent(in) :: loose
    type(place_t), intent(in) :: place
    type(targets_t), intent(inout) :: targets
    type(motion_t) :: motion
    character(len=:), allocatable :: name

    associate (node => draft%model%node(k))
      name = trim(component_names(component))//" of node "//id_text(node%id, node%part)
      if (node%fixed(component)) then
        if (.not. loose) call draft%report%add_error(place, "INPUTX prescribes "//name// &
          ", which FIX holds", "FIX is at "//draft%report%location(node%fix_place))
        return
      end if
      motion%node = k
      motion%component = component
      motion%euler = numbered .and. kind_of(component) == 2
      motion%place = place
      if (component <= 3) motion%value = -node%position(component)
    end associate
    call add_motion(draft, record, motion, name, p, targets)
  end subroutine add_coordinate

  !> Keep a motion, once in a pattern. Its value is the card's, less where the motion starts if the
  !> card gives the coordinate or strain itself; `motion%value` is minus the initial one.
  subroutine add_motion(draft, record, motion, name, p, targets)
    type(draft_t), intent(inout) :: draft
    type(record_t), intent(in) :: record
    type(motion_t), intent(in) :: motion
    character(len=*), intent(in) :: name
    integer, intent(in) :: p
    type(targets_t), intent(inout) :: targets
    type(motion_t) :: new
    integer :: q, n

    if (p == 0 .and. is_moved(draft, motion, targets)) return
    q = max(p, 1)
    n = targets%table%find(target_code(draft, motion), q)
    if (n > 0) then
      call draft%report%add_error(motion%place, name//" is prescribed twice", "first at "// &
        draft%report%location(draft%model%pattern(q)%motion(targets%motion(n))%place))
      return
    end if
    new = motion
    new%function = draft%functions%reference(record%function)
    new%velocity = record%value(2)
    new%acceleration = record%value(3)
    new%value = record%value(1)
    if (p == 0) new%value = 0
    if (p > 0 .and. record%function == 0 .and. .not. record%additional) then
      new%value = record%value(1) + motion%value
      call subtract_earlier(draft, name, p, targets, new)
    end if
    associate (pattern => draft%model%pattern(q))
      pattern%motions = pattern%motions + 1
      call grow(pattern%motion, pattern%motions)
      pattern%motion(pattern%motions) = new
      call targets%table%add(target_code(draft, motion), q, n)
      call grow(targets%motion, n)
      targets%motion(n) = pattern%motions
    end associate
  end subroutine add_motion

  !> A number for what a motion moves: positive for a coordinate, negative for a strain.
  pure integer function target_code(draft, motion) result(code)
    type(draft_t), intent(in) :: draft
    type(motion_t), intent(in) :: motion

    code = 8*motion%node + motion%component
    if (motion%node > 0) return
    code = -8*(motion%member + merge(draft%members, 0, motion%joint > 0) + motion%joint) &
           - motion%mode
  end function target_code

  !> Whether any pattern moves what a motion moves.
  pure logical function is_moved(draft, motion, targets)
    type(draft_t), intent(in) :: draft
    type(motion_t), intent(in) :: motion
    type(targets_t), intent(in) :: targets
    integer :: q

    is_moved = .false.
    do q = 1, size(draft%model%pattern)
      is_moved = is_moved .or. targets%table%find(target_code(draft, motion), q) > 0
    end do
  end function is_moved

  !> Take what the patterns before `p` have added off a motion's value.
  subroutine subtract_earlier(draft, name, p, targets, motion)
    type(draft_t), intent(inout) :: draft
    character(len=*), intent(in) :: name
    integer, intent(in) :: p
    type(targets_t), intent(in) :: targets
    type(motion_t), intent(inout) :: motion
    character(len=:), allocatable :: problem
    real(wp) :: factor
    integer :: q, n
    logical :: known

    do q = 1, p - 1
      n = targets%table%find(target_code(draft, motion), q)
      if (n == 0) cycle
      associate (earlier => draft%model%pattern(q)%motion(targets%motion(n)))
        call find_factor(draft, q, factor, known)
        problem = ""
        if (earlier%function > 0 .and. in_time(draft, q)) problem = "what its earlier motion "// &
          "has added changes with time"
        if (.not. known) problem = "what its earlier motion has added is not known, since that "// &
                                   "STATIC does not end at a given factor"
        if (earlier%euler .neqv. motion%euler) problem = "an earlier motion gives "// &
          trim(merge("the Euler parameter", "the angle          ", earlier%euler))
        if (problem /= "") call draft%report%add_error(motion%place, name//": "//problem, &
                                                       "DELINPX and DELINPE give increments")
        if (earlier%function > 0) factor = function_value( &
          draft%model%function(earlier%function), factor)
        motion%value = motion%value - factor*earlier%value
      end associate
    end do
  end subroutine subtract_earlier

  !> Whether a motion in time took a pattern as its own.
  pure logical function in_time(draft, pattern)
    type(draft_t), intent(in) :: draft
    integer, intent(in) :: pattern
    integer :: k

    in_time = .false.
    do k = 1, size(draft%model%analysis)
      associate (analysis => draft%model%analysis(k))
        if (analysis%pattern == pattern .and. any(time_analyses == analysis%kind)) in_time = .true.
      end associate
    end do
  end function in_time

  !> The factor that a pattern keeps; not known where a displacement decides.
  pure subroutine find_factor(draft, pattern, factor, known)
    type(draft_t), intent(in) :: draft
    integer, intent(in) :: pattern
    real(wp), intent(out) :: factor
    logical, intent(out) :: known
    integer :: k

    factor = 1
    known = .true.
    do k = 1, size(draft%model%analysis)
      associate (analysis => draft%model%analysis(k))
        if (analysis%pattern /= pattern .or. all(static_analyses /= analysis%kind)) cycle
        factor = analysis%factor
        known = analysis%control /= control_displacement .and. .not. analysis%stops
      end associate
    end do
  end subroutine find_factor

end module deck_motions
