!> Load cards to patterns, and the analyses with the pattern each of them ramps.
module deck_loads
  use kinds, only: wp
  use text, only: to_text, plural
  use diagnostics, only: place_t
  use model_data, only: load_t, marker_t, analysis_t, pattern_t, static_analyses, &
                        analysis_buckling, analysis_eigen, time_analyses
  use deck_draft, only: draft_t, record_t, record_load, record_gravity, record_strain, &
                        record_coordinate, record_rotation
  use deck_growth, only: grow
  use deck_modes, only: imply_analysis, implies_eigen, describe_analysis, check_timestep, &
                        mode_check, mode_static
  use deck_points, only: neighbours_t, resolve_point
  use deck_rotations, only: set_rotation, check_rotations
  use deck_select, only: choice_t, select_nodes, id_text
  implicit none
  private

  public :: set_analyses, set_loads

  integer, parameter :: base = 1, additional = 2
  integer, parameter :: loads(3) = [record_load, record_gravity, record_rotation]  !< kinds

contains

  !> Number the patterns, and put the analyses in order, the implied ones included. `pattern`
  !> is (base or additional, block); 0: no such loads.
  subroutine set_analyses(draft, pattern)
    type(draft_t), intent(inout) :: draft
    integer, allocatable, intent(out) :: pattern(:, :)
    type(analysis_t), allocatable :: analysis(:)
    integer :: r, block, n, kind, patterns, pending(2)

    allocate (pattern(2, draft%block), analysis(2*draft%block + 1))
    pattern = 0
    do r = 1, draft%records
      associate (record => draft%record(r))
        if (is_applied(record)) then
          pattern(merge(additional, base, record%additional), record%block) = 1
        end if
      end associate
    end do
    patterns = 0
    pending = 0
    n = 0
    do block = 1, draft%block
      if (block > draft%analyses .and. draft%analyses > 0) then
        pattern(:, block) = 0
        call warn_of_unused(draft, block)
        exit
      end if
      do kind = base, additional
        if (pattern(kind, block) == 0) cycle
        if (pending(kind) > 0) then
          call check_open(draft, block)
          pattern(kind, block) = pending(kind)
          cycle
        end if
        patterns = patterns + 1
        pattern(kind, block) = patterns
      end do
      pending = max(pending, pattern(:, block))
      where (draft%model%imperfection%block == block) draft%model%imperfection%analysis = n + 1
      call add_analyses(draft, pending, block, patterns, analysis, n)
      if (any([static_analyses, time_analyses] == analysis(n)%kind)) pending = 0
      if (all(pending > 0)) pending(base) = 0
    end do
    if (implies_eigen(draft, analysis(n))) then
      n = n + 1
      analysis(n)%kind = analysis_eigen
      analysis(n)%pattern = patterns
    end if
    allocate (draft%model%pattern(patterns))
    draft%model%analysis = analysis(:n)
    call check_timestep(draft)
    if (draft%analyses == 0) call tell_implied(draft, pattern(:, 1))
  end subroutine set_analyses

  !> Whether a card is of a pattern: a load, or a motion with values.
  pure logical function is_applied(record)
    type(record_t), intent(in) :: record

    is_applied = any(record%kind == loads) .or. &
                 (any(record%kind == [record_strain, record_coordinate]) .and. record%values > 0)
  end function is_applied

  !> Loads behind a BUCKLING or EIGEN belong to the pattern that STATIC has not yet applied;
  !> BUCKLING took it as a whole.
  subroutine check_open(draft, block)
    type(draft_t), intent(inout) :: draft
    integer, intent(in) :: block
    integer :: r

    if (draft%model%analysis(block - 1)%kind /= analysis_buckling) return
    do r = 1, draft%records
      associate (record => draft%record(r))
        if (record%block /= block .or. .not. is_applied(record)) cycle
        call draft%report%add_error(record%place, "this load comes behind BUCKLING, which"// &
          " scales the loads before it as a whole", "give all loads before BUCKLING, or apply"// &
          " the first ones by STATIC")
        return
      end associate
    end do
  end subroutine check_open

  !> The analysis that ends a block, and before it an implied STATIC where DELXF follows XF.
  !> Without a pattern that is pending STATIC and BUCKLING take the last one, motions in time none.
  subroutine add_analyses(draft, pattern, block, patterns, analysis, n)
    type(draft_t), intent(in) :: draft
    integer, intent(in) :: pattern(2)
    integer, intent(in) :: block, patterns
    type(analysis_t), intent(inout) :: analysis(:)
    integer, intent(inout) :: n

    if (pattern(base) > 0 .and. pattern(additional) > 0) then
      n = n + 1
      analysis(n)%pattern = pattern(base)
      analysis(n)%steps = draft%iteration%base_steps
      call set_defaults(draft, analysis(n))
    end if
    n = n + 1
    if (draft%analyses > 0) analysis(n) = draft%model%analysis(block)
    analysis(n)%pattern = merge(pattern(additional), pattern(base), pattern(additional) > 0)
    if (analysis(n)%pattern == 0 .and. all(time_analyses /= analysis(n)%kind)) then
      analysis(n)%pattern = patterns
    end if
    analysis(n)%steps = merge(draft%iteration%additional_steps, draft%iteration%base_steps, &
                              pattern(additional) > 0)
    if (draft%analyses > 0) then
      if (draft%analysis_steps(block) > 0) analysis(n)%steps = draft%analysis_steps(block)
    else
      call imply_analysis(draft, any(pattern > 0), analysis(n))
    end if
    call set_defaults(draft, analysis(n))
  end subroutine add_analyses

  subroutine set_defaults(draft, analysis)
    type(draft_t), intent(in) :: draft
    type(analysis_t), intent(inout) :: analysis

    if (analysis%iterations == 0) analysis%iterations = draft%iteration%iterations
    if (.not. analysis%tolerance > 0.0_wp) analysis%tolerance = draft%iteration%tolerance
  end subroutine set_defaults

  subroutine tell_implied(draft, pattern)
    type(draft_t), intent(inout) :: draft
    integer, intent(in) :: pattern(2)
    integer :: i
    character(len=:), allocatable :: steps

    if (draft%report%errors() > 0 .or. draft%members + draft%joints == 0) return
    steps = ""
    do i = 1, size(draft%model%analysis)
      if (i > 1) steps = steps//", then "
      steps = steps//describe_analysis(draft%model%analysis(i))
      if (draft%model%analysis(i)%kind == analysis_eigen .or. pattern(additional) == 0) cycle
      if (draft%model%analysis(i)%pattern == pattern(additional)) steps = steps//" (DELXF)"
    end do
    if (any(draft%spacar_mode == [mode_check, mode_static])) then
      steps = "no analysis given: "//steps
    else
      steps = "--mode "//to_text(draft%spacar_mode)//": "//steps
    end if
    call draft%report%add_note(place_t(file=1), steps)
  end subroutine tell_implied

  !> Loads behind the last analysis.
  subroutine warn_of_unused(draft, block)
    type(draft_t), intent(inout) :: draft
    integer, intent(in) :: block
    integer :: r

    do r = 1, draft%records
      associate (record => draft%record(r))
        if (record%block /= block .or. .not. is_applied(record)) cycle
        call draft%report%add_warning(record%place, "no analysis follows this "// &
          trim(merge("load  ", "motion", any(record%kind == loads)))//": it is not used")
      end associate
    end do
  end subroutine warn_of_unused

  !> Put the loads into their patterns.
  subroutine set_loads(draft, neighbours, pattern)
    type(draft_t), intent(inout) :: draft
    type(neighbours_t), intent(in) :: neighbours
    integer, intent(in) :: pattern(:, :)
    type(choice_t) :: choice
    integer :: r, i, p

    do p = 1, size(draft%model%pattern)
      allocate (draft%model%pattern(p)%load(8))
    end do
    do r = 1, draft%records
      associate (record => draft%record(r))
        if (all(record%kind /= loads)) cycle
        p = pattern(merge(additional, base, record%additional), record%block)
        if (p == 0) cycle
        if (record%kind == record_gravity) then
          draft%model%pattern(p)%gravity = record%value(:3)
        else if (record%kind == record_rotation) then
          call set_rotation(draft%report, record, draft%model%pattern(p)%rotation)
        else
          call select_nodes(draft, record%from, record%to, choice)
          do i = 1, choice%found
            call add_load(draft, neighbours, record, choice, i, p)
          end do
        end if
      end associate
    end do
    do p = 1, size(draft%model%pattern)
      associate (applied => draft%model%pattern(p))
        applied%load = applied%load(:applied%loads)
      end associate
    end do
    call check_rotations(draft%model, draft%report)
  end subroutine set_loads

  !> One load at one node or marker.
  subroutine add_load(draft, neighbours, record, choice, i, p)
    type(draft_t), intent(inout) :: draft
    type(neighbours_t), intent(in) :: neighbours
    type(record_t), intent(in) :: record
    type(choice_t), intent(in) :: choice
    integer, intent(in) :: i, p
    type(load_t) :: load
    type(marker_t) :: point
    logical :: ok

    ok = .true.
    load%node = choice%index(i)
    if (load%node < 0) then
      if (record%at_offset .or. record%at_point) then
        call draft%report%add_error(record%at_place, "a marker has its place: AT is too much")
        return
      end if
      point = draft%model%marker(-load%node)
      load%node = point%node
      if (load%node == 0) return
    end if
    call set_values(draft, record, choice, i, load, ok)
    if (.not. ok) return
    if (record%at_offset .or. record%at_point) then
      call resolve_point(draft, neighbours, record, load%node, point, ok)
    end if
    if (.not. ok) return
    if (point%node > 0) then
      draft%points = draft%points + 1
      call grow(draft%model%point, draft%points)
      draft%model%point(draft%points) = point
      load%marker = draft%points
    end if
    load%function = draft%functions%reference(record%function)
    load%follower = record%follower
    load%place = record%place
    associate (applied => draft%model%pattern(p))
      applied%loads = applied%loads + 1
      call grow(applied%load, applied%loads)
      applied%load(applied%loads) = load
    end associate
  end subroutine add_load

  !> What the numbers mean, by how many there are and what kinds of node there are.
  subroutine set_values(draft, record, choice, i, load, ok)
    type(draft_t), intent(inout) :: draft
    type(record_t), intent(in) :: record
    type(choice_t), intent(in) :: choice
    integer, intent(in) :: i
    type(load_t), intent(inout) :: load
    logical, intent(inout) :: ok
    character(len=:), allocatable :: name

    associate (node => draft%model%node(load%node), value => record%value)
      name = "node "//id_text(node%id, node%part)
      ok = any(node%exists)
      if (.not. ok) then
        if (.not. (draft%elements_incomplete .or. draft%node_broken(load%node))) then
          call draft%report%add_error(choice%place(i), "no element uses "//name)
        end if
        return
      end if
      select case (record%values)
      case (1)
        ok = node%exists(3) .and. count(node%exists) == 1
        load%bimoment = value(1)
      case (3)
        ok = node%exists(1) .or. node%exists(2)
        if (node%exists(1)) load%force = value(:3)
        if (.not. node%exists(1)) load%moment = value(:3)
      case default
        ok = node%exists(1) .and. node%exists(2) .and. (node%exists(3) .or. record%values == 6)
        load%force = value(:3)
        load%moment = value(4:6)
        if (record%values == 7) load%bimoment = value(7)
      end select
      if (ok .and. record%follower .and. record%values > 1 .and. .not. node%exists(2)) then
        ok = .false.
        if (.not. (choice%loose(i) .or. draft%elements_incomplete)) call draft%report%add_error( &
          choice%place(i), "FOLLOWER turns with the rotation of "//name//", which it does not have")
        return
      end if
      if (ok .or. choice%loose(i) .or. draft%elements_incomplete) return
      call draft%report%add_error(choice%place(i), plural(record%values, "value")// &
                                  " do not fit "//name//", which has "//kinds(node%exists), &
                                  "3: force, or moment if only rotation; 6: both; 7: with "// &
                                  "bimoment; 1: bimoment if only warping")
    end associate
  end subroutine set_values

  pure function kinds(exists) result(phrase)
    logical, intent(in) :: exists(3)
    character(len=:), allocatable :: phrase

    phrase = ""
    if (exists(1)) phrase = phrase//" translation"
    if (exists(2)) phrase = phrase//" rotation"
    if (exists(3)) phrase = phrase//" warping"
    phrase = phrase(2:)
  end function kinds

end module deck_loads
