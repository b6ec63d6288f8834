!> Cards about supports, loads and markers, and the analyses.
module deck_load_cards
  use text, only: quoted, upper
  use diagnostics, only: place_t
  use deck_card, only: card_t
  use deck_draft, only: draft_t, record_t, iteration_t, record_fix, record_load, record_marker, &
                        record_gravity, record_stop, record_rotation, &
                        record_compliance
  use deck_growth, only: grow
  use deck_settings, only: is_identifier
  use deck_model_cards, only: define_name
  use deck_element_cards, only: add_record, add_item
  use deck_targets, only: read_control, read_target
  use model_data, only: analysis_t, control_displacement, control_arc, stability_on, &
                        analysis_buckling, analysis_eigen, analysis_static, analysis_stationary
  implicit none
  private

  public :: read_fix, read_marker, read_xf, read_delxf, read_gravity, read_rotation, read_static, &
            read_stationary, read_iterstep, read_buckling, read_eigen
  public :: begin_analysis, read_name, check_count, check_tolerance

  integer, parameter, public :: most_steps = 1000000

contains

  !> FIX nodes [components]
  subroutine read_fix(card, draft)
    type(card_t), intent(in) :: card
    type(draft_t), intent(inout) :: draft
    type(record_t) :: record
    integer :: w

    record%kind = record_fix
    record%item_from = draft%items + 1
    do w = 3, card%words
      call add_item(card, w, draft)
    end do
    record%item_to = draft%items
    call add_record(card, 2, draft, record)
  end subroutine read_fix

  !> MARKER name node AT oy oz [OF element]
  subroutine read_marker(card, draft)
    type(card_t), intent(in) :: card
    type(draft_t), intent(inout) :: draft
    type(record_t) :: record
    logical :: ok

    ok = is_identifier(card%word(2)) .and. upper(card%word(2)) /= "ALL"
    if (.not. ok) then
      call draft%report%add_error(card%place(2), quoted(card%word(2))// &
                                  " cannot be the name of a marker", &
                                  "names have letters, digits and _, no digit first")
      return
    end if
    call define_name(card, 2, draft%report, draft%labels, ok, record%marker)
    if (record%marker == 0) return
    record%kind = record_marker
    call read_point(card, 1, record)
    draft%markers = draft%markers + 1
    call grow(draft%model%marker, draft%markers)
    draft%model%marker(draft%markers)%name = card%word(2)
    draft%model%marker(draft%markers)%place = card%place(2)
    call grow(draft%marker_of, record%marker)
    draft%marker_of(record%marker) = draft%markers
    call add_record(card, 3, draft, record)
  end subroutine read_marker

  !> AT oy oz, AT POINT k and OF element; `AT` is option `first`, `OF` the next.
  subroutine read_point(card, first, record)
    type(card_t), intent(in) :: card
    integer, intent(in) :: first
    type(record_t), intent(inout) :: record
    integer :: w

    w = card%option(first)
    if (w > 0) then
      record%at_place = card%place(w + 1)
      record%at_place%width = card%column(w + 2) + card%last(w + 2) - card%first(w + 2) + 1 &
                              - card%column(w + 1)
      if (card%line(w + 2) /= card%line(w + 1)) record%at_place = card%place(w + 1)
      record%at_point = card%whole(w + 1) == 1
      record%at_offset = .not. record%at_point
      if (record%at_point) record%point = nint(card%number(w + 2))
      if (record%at_offset) record%offset = card%number(w + 1:w + 2)
    end if
    w = card%option(first + 1)
    if (w == 0) return
    record%of_given = .true.
    record%of_id = card%whole(w + 1)
    record%of_part = card%part(w + 1)
    record%of_place = card%place(w + 1)
  end subroutine read_point

  !> XF nodes values [FUNCTION f] [AT oy oz] [OF element] [FOLLOWER]
  subroutine read_xf(card, draft)
    type(card_t), intent(in) :: card
    type(draft_t), intent(inout) :: draft

    call add_load(card, draft, .false.)
  end subroutine read_xf

  !> The same after an implied STATIC.
  subroutine read_delxf(card, draft)
    type(card_t), intent(in) :: card
    type(draft_t), intent(inout) :: draft

    call add_load(card, draft, .true.)
  end subroutine read_delxf

  subroutine add_load(card, draft, additional)
    type(card_t), intent(in) :: card
    type(draft_t), intent(inout) :: draft
    logical, intent(in) :: additional
    type(record_t) :: record
    character(len=:), allocatable :: name

    record%kind = record_load
    record%additional = additional
    record%values = card%positional - 1
    record%value(:record%values) = card%number(3:2 + record%values)
    if (card%option(1) > 0) then
      name = card%word(card%option(1) + 1)
      call draft%functions%refer(name, card%place(card%option(1) + 1), record%function)
    end if
    call read_point(card, 2, record)
    if (record%of_given .and. card%option(2) == 0) call draft%report%add_error( &
      card%place(card%option(3)), "OF names the section that AT refers to: AT is missing")
    record%follower = card%option(4) > 0
    if (record%follower .and. record%values == 1) call draft%report%add_error( &
      card%place(card%option(4)), "a bimoment has no direction that could follow")
    if (card%option(2) > 0 .and. record%values == 1) call draft%report%add_error( &
      card%place(card%option(2)), "a bimoment alone acts at the node, not AT a point")
    call add_record(card, 2, draft, record)
  end subroutine add_load

  !> GRAVITY gx gy gz
  subroutine read_gravity(card, draft)
    type(card_t), intent(in) :: card
    type(draft_t), intent(inout) :: draft

    call add_field(card, record_gravity, draft)
  end subroutine read_gravity

  !> ROTATION w ax ay az [ox oy oz]
  subroutine read_rotation(card, draft)
    type(card_t), intent(in) :: card
    type(draft_t), intent(inout) :: draft

    if (.not. any(abs(card%number(3:5)) > 0)) then
      call draft%report%add_error(card%place(3), "the axis of a ROTATION has no direction", &
                                  "ROTATION w ax ay az: 0 0 1 is the z axis")
      return
    end if
    call add_field(card, record_rotation, draft)
  end subroutine read_rotation

  !> A card of numbers that acts on all mass, once before an analysis.
  subroutine add_field(card, kind, draft)
    type(card_t), intent(in) :: card
    integer, intent(in) :: kind
    type(draft_t), intent(inout) :: draft
    type(record_t) :: record
    integer :: i

    do i = 1, draft%records
      if (draft%record(i)%kind /= kind .or. draft%record(i)%block /= draft%block) cycle
      call draft%report%add_error(card%place(1), upper(card%word(1))// &
                                  " is given twice before an analysis", &
                                  "first at "//draft%report%location(draft%record(i)%place))
      return
    end do
    record%kind = kind
    record%place = card%place(1)
    record%block = draft%block
    record%value(:card%positional) = card%number(2:card%positional + 1)
    draft%records = draft%records + 1
    call grow(draft%record, draft%records)
    draft%record(draft%records) = record
  end subroutine add_field

  !> STATIC [STEPS n] [TO factor] [CONTROL ...] ...
  subroutine read_static(card, draft)
    type(card_t), intent(in) :: card
    type(draft_t), intent(inout) :: draft

    call read_equilibria(card, draft, analysis_static)
  end subroutine read_static

  !> STATIONARY has the same options.
  subroutine read_stationary(card, draft)
    type(card_t), intent(in) :: card
    type(draft_t), intent(inout) :: draft

    call read_equilibria(card, draft, analysis_stationary)
  end subroutine read_stationary

  !> STATIC or STATIONARY with its options, in the order of the keyword table.
  subroutine read_equilibria(card, draft, kind)
    type(card_t), intent(in) :: card
    type(draft_t), intent(inout) :: draft
    integer, intent(in) :: kind
    type(analysis_t) :: analysis
    integer :: k

    call begin_analysis(card, 0, draft, analysis, k)
    analysis%kind = kind
    associate (option => card%option)
      if (option(1) > 0) then
        draft%analysis_steps(k) = card%whole(option(1) + 1)
        call check_count(card, option(1) + 1, most_steps, draft)
      end if
      if (option(2) > 0) analysis%factor = card%number(option(2) + 1)
      call read_control(card, 3, draft, analysis)
      if (option(7) > 0) then
        analysis%first_increment = card%number(option(7) + 1)
        if (.not. analysis%first_increment > 0) call draft%report%add_error( &
          card%place(option(7) + 1), "a positive increment of the load factor expected")
      end if
      if (option(8) > 0) then
        analysis%most_steps = card%whole(option(8) + 1)
        call check_count(card, option(8) + 1, most_steps, draft)
      end if
      analysis%stops = option(9) > 0
      if (analysis%stops) call read_target(card, option(9), record_stop, draft)
      if (option(10) > 0) then
        analysis%tolerance = card%number(option(10) + 1)
        call check_tolerance(card, option(10) + 1, draft)
      end if
      if (option(11) > 0) then
        analysis%iterations = card%whole(option(11) + 1)
        call check_count(card, option(11) + 1, most_steps, draft)
      end if
      if (option(12) > 0) analysis%stability = card%whole(option(12) + 1) - 1
      call read_name(card, 13, k, draft, analysis)
      if (option(14) > 0) analysis%branch = card%whole(option(14) + 1) == 2
      if (analysis%branch) analysis%stability = max(analysis%stability, stability_on)
      call check_arc_options(card, analysis, draft)
      if (option(15) > 0) call add_record(card, option(15) + 1, draft, &
                                          record_t(kind=record_compliance))
    end associate
    draft%model%analysis(k) = analysis
  end subroutine read_equilibria

  !> Options that only a path by its arc length has.
  subroutine check_arc_options(card, analysis, draft)
    type(card_t), intent(in) :: card
    type(analysis_t), intent(in) :: analysis
    type(draft_t), intent(inout) :: draft
    integer :: i

    do i = 7, 14
      if (all([7, 8, 9, 14] /= i)) cycle
      if (card%option(i) == 0 .or. analysis%control == control_arc) cycle
      call draft%report%add_error(card%place(card%option(i)), card%word(card%option(i))// &
                                  " belongs to CONTROL ARC")
    end do
    if (card%option(1) > 0 .and. analysis%control == control_arc) call draft%report%add_error( &
      card%place(card%option(1)), "CONTROL ARC chooses its steps", "MAXSTEPS n limits them")
    if (card%option(2) > 0 .and. analysis%control == control_displacement) then
      call draft%report%add_error(card%place(card%option(2)), &
                                  "the value of CONTROL DISPLACEMENT replaces TO")
    end if
  end subroutine check_arc_options

  !> BUCKLING [MODES n] [NAME name]
  subroutine read_buckling(card, draft)
    type(card_t), intent(in) :: card
    type(draft_t), intent(inout) :: draft

    call read_linearized(card, draft, analysis_buckling)
  end subroutine read_buckling

  !> EIGEN [MODES n] [NAME name] [DAMPED] [MATRICES ON]
  subroutine read_eigen(card, draft)
    type(card_t), intent(in) :: card
    type(draft_t), intent(inout) :: draft

    call read_linearized(card, draft, analysis_eigen)
  end subroutine read_eigen

  subroutine read_linearized(card, draft, kind)
    type(card_t), intent(in) :: card
    type(draft_t), intent(inout) :: draft
    integer, intent(in) :: kind
    type(analysis_t) :: analysis
    integer :: k

    call begin_analysis(card, 1, draft, analysis, k)
    analysis%kind = kind
    associate (option => card%option)
      if (option(1) > 0) then
        analysis%modes = card%whole(option(1) + 1)
        call check_count(card, option(1) + 1, most_steps, draft)
      end if
      call read_name(card, 2, k, draft, analysis)
      analysis%damped = option(3) > 0
      if (option(4) > 0) analysis%matrices = card%whole(option(4) + 1) == 2
    end associate
    draft%model%analysis(k) = analysis
  end subroutine read_linearized

  !> Start analysis number `k`: loads behind it are for the next one.
  subroutine begin_analysis(card, steps, draft, analysis, k)
    type(card_t), intent(in) :: card
    integer, intent(in) :: steps          !< 0: the default of the deck
    type(draft_t), intent(inout) :: draft
    type(analysis_t), intent(inout) :: analysis
    integer, intent(out) :: k

    k = draft%analyses + 1
    draft%analyses = k
    draft%block = draft%block + 1
    call grow(draft%model%analysis, k)
    call grow(draft%analysis_steps, k)
    draft%analysis_steps(k) = steps
    analysis%place = card%place(1)
  end subroutine begin_analysis

  !> NAME, option number `i`, of analysis number `k`.
  subroutine read_name(card, i, k, draft, analysis)
    type(card_t), intent(in) :: card
    integer, intent(in) :: i, k
    type(draft_t), intent(inout) :: draft
    type(analysis_t), intent(inout) :: analysis

    if (card%option(i) == 0) return
    analysis%name = card%word(card%option(i) + 1)
    call check_name(card, card%option(i) + 1, k, analysis%name, draft)
  end subroutine read_name

  !> A result group's name must be a plain word, once.
  subroutine check_name(card, w, k, name, draft)
    type(card_t), intent(in) :: card
    integer, intent(in) :: w, k
    character(len=*), intent(in) :: name
    type(draft_t), intent(inout) :: draft
    integer :: i

    if (.not. is_identifier(trim(name))) then
      call draft%report%add_error(card%place(w), quoted(card%word(w))//" cannot be a name", &
                                  "names have letters, digits and _, no digit first")
      return
    end if
    do i = 1, k - 1
      if (draft%model%analysis(i)%name /= name) cycle
      call draft%report%add_error(card%place(w), "an analysis has this name already", "at "// &
                                  draft%report%location(draft%model%analysis(i)%place))
      return
    end do
  end subroutine check_name

  subroutine check_count(card, w, most, draft)
    type(card_t), intent(in) :: card
    integer, intent(in) :: w, most
    type(draft_t), intent(inout) :: draft

    if (card%whole(w) >= 1 .and. card%whole(w) <= most) return
    call draft%report%add_error(card%place(w), "a number from 1 to 1000000 expected")
  end subroutine check_count

  subroutine check_tolerance(card, w, draft)
    type(card_t), intent(in) :: card
    integer, intent(in) :: w
    type(draft_t), intent(inout) :: draft

    if (card%number(w) > 0 .and. card%number(w) < 1) return
    call draft%report%add_error(card%place(w), "a tolerance lies between 0 and 1")
  end subroutine check_tolerance

  !> ITERSTEP iterations n tolerance - - m: defaults of all analyses.
  subroutine read_iterstep(card, draft)
    type(card_t), intent(in) :: card
    type(draft_t), intent(inout) :: draft
    type(iteration_t) :: iteration

    if (draft%iteration%place%line > 0) call draft%report%add_error( &
      card%place(1), "ITERSTEP is given twice", &
      "first at "//draft%report%location(draft%iteration%place))
    iteration%place = card%place(1)
    iteration%iterations = card%whole(2)
    call check_count(card, 2, most_steps, draft)
    if (card%positional >= 2) then
      iteration%additional_steps = card%whole(3)
      call check_count(card, 3, most_steps, draft)
    end if
    if (card%positional >= 3) then
      iteration%tolerance = card%number(4)
      call check_tolerance(card, 4, draft)
    end if
    if (card%positional >= 6) then
      iteration%base_steps = card%whole(7)
      call check_count(card, 7, most_steps, draft)
    end if
    draft%iteration = iteration
  end subroutine read_iterstep

end module deck_load_cards
