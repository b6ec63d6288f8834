!> Cards about motion and mass: INPUTX, INPUTE, their DEL forms, STARTX, STARTDX, STARTDE, XM.
module deck_motion_cards
  use kinds, only: wp
  use deck_card, only: card_t
  use deck_usage, only: kind_real
  use deck_draft, only: draft_t, record_t, record_coordinate, record_strain, record_start, &
                        record_start_strain, record_mass
  use deck_element_cards, only: add_record, add_item
  use model_inertia, only: inertia_matrix, inertia_fault, inertia_negative, inertia_triangle
  implicit none
  private

  public :: read_inputx, read_inpute, read_delinpx, read_delinpe, read_startx, read_startdx, &
            read_startde, read_xm, settle_inputs

contains

  !> INPUTX node component value [velocity [acceleration]] [FUNCTION f] or node [components]
  subroutine read_inputx(card, draft)
    type(card_t), intent(in) :: card
    type(draft_t), intent(inout) :: draft

    call add_input(card, draft, record_coordinate, .false.)
  end subroutine read_inputx

  !> INPUTE element mode value [velocity [acceleration]] [FUNCTION f] or element modes
  subroutine read_inpute(card, draft)
    type(card_t), intent(in) :: card
    type(draft_t), intent(inout) :: draft

    call add_input(card, draft, record_strain, .false.)
  end subroutine read_inpute

  !> An increment after an implied STATIC.
  subroutine read_delinpx(card, draft)
    type(card_t), intent(in) :: card
    type(draft_t), intent(inout) :: draft

    call add_input(card, draft, record_coordinate, .true.)
  end subroutine read_delinpx

  !> An increment after an implied STATIC.
  subroutine read_delinpe(card, draft)
    type(card_t), intent(in) :: card
    type(draft_t), intent(inout) :: draft

    call add_input(card, draft, record_strain, .true.)
  end subroutine read_delinpe

  !> Keep what a card says if its words are values, and what if they are components or modes:
  !> which of them counts is known when all cards are read, see `settle_inputs`.
  subroutine add_input(card, draft, kind, additional)
    type(card_t), intent(in) :: card
    type(draft_t), intent(inout) :: draft
    integer, intent(in) :: kind
    logical, intent(in) :: additional
    type(record_t) :: record
    character(len=:), allocatable :: name
    integer :: w

    record%kind = kind
    record%additional = additional
    record%before_halt = .not. (draft%halted .or. additional)
    record%item_from = draft%items + 1
    do w = 3, card%positional + 1
      call add_item(card, w, draft)
      if (card%kind(w) /= kind_real) cycle
      record%values = record%values + 1
      record%value(record%values) = card%number(w)
      draft%item(draft%items)%value = as_item(kind, card%number(w))
    end do
    record%item_to = draft%items
    if (card%option(1) > 0) then
      name = card%word(card%option(1) + 1)
      call draft%functions%refer(name, card%place(card%option(1) + 1), record%function)
    end if
    call add_record(card, 2, draft, record)
  end subroutine add_input

  !> A number as mode, or as SPACAR's number of a component; 0 if it is none.
  pure integer function as_item(kind, number)
    integer, intent(in) :: kind
    real(wp), intent(in) :: number

    as_item = 0
    if (abs(number - anint(number)) > 0 .or. number < 1 .or. number > 8) return
    as_item = nint(number)
    if (kind == record_coordinate) as_item = merge(-as_item, 0, as_item <= 4)
  end function as_item

  !> In a deck with HALT the cards before it declare, all others give values; a record whose words
  !> do not say that is dropped. The items left are the components or modes.
  subroutine settle_inputs(draft)
    type(draft_t), intent(inout) :: draft
    character(len=:), allocatable :: name
    logical :: ok
    integer :: r

    do r = 1, draft%records
      associate (record => draft%record(r))
        if (record%kind /= record_coordinate .and. record%kind /= record_strain) cycle
        name = trim(merge("INPUTX", "INPUTE", record%kind == record_coordinate))
        if (record%before_halt .and. draft%halted) then
          ok = all(draft%item(record%item_from:record%item_to)%value /= 0) .and. &
               record%function == 0
          if (.not. ok) call draft%report%add_error(record%place, name//" before HALT names "// &
            trim(merge("components", "modes     ", record%kind == record_coordinate))// &
            " only", "its values stand behind HALT")
          record%values = 0
        else
          ok = record%values > 0
          if (.not. ok) call draft%report%add_error(record%place, name//" without a value", &
            name//trim(merge(" node component value", " element mode value  ", &
                             record%kind == record_coordinate)))
          record%item_to = record%item_from
        end if
        if (.not. ok) record%kind = 0
      end associate
    end do
  end subroutine settle_inputs

  !> STARTX node component value
  subroutine read_startx(card, draft)
    type(card_t), intent(in) :: card
    type(draft_t), intent(inout) :: draft

    call add_start(card, draft, record_start, .false.)
  end subroutine read_startx

  !> STARTDX node component rate
  subroutine read_startdx(card, draft)
    type(card_t), intent(in) :: card
    type(draft_t), intent(inout) :: draft

    call add_start(card, draft, record_start, .true.)
  end subroutine read_startdx

  !> STARTDE element mode rate
  subroutine read_startde(card, draft)
    type(card_t), intent(in) :: card
    type(draft_t), intent(inout) :: draft

    call add_start(card, draft, record_start_strain, .true.)
  end subroutine read_startde

  subroutine add_start(card, draft, kind, rate)
    type(card_t), intent(in) :: card
    type(draft_t), intent(inout) :: draft
    integer, intent(in) :: kind
    logical, intent(in) :: rate
    type(record_t) :: record

    record%kind = kind
    record%rate = rate
    record%value(1) = card%number(4)
    record%item_from = draft%items + 1
    call add_item(card, 3, draft)
    record%item_to = draft%items
    call add_record(card, 2, draft, record)
  end subroutine add_start

  !> XM nodes m, six inertias, or both
  subroutine read_xm(card, draft)
    type(card_t), intent(in) :: card
    type(draft_t), intent(inout) :: draft
    type(record_t) :: record
    integer :: w

    record%kind = record_mass
    record%values = card%positional - 1
    record%value(:record%values) = card%number(3:2 + record%values)
    if (record%values /= 6 .and. record%value(1) < 0) then
      call draft%report%add_error(card%place(3), "a mass cannot be negative")
      return
    end if
    if (record%values >= 6) then
      w = record%values - 3
      select case (inertia_fault(inertia_matrix(card%number(w:w + 5))))
      case (inertia_triangle)
        call draft%report%add_warning(card%place(w), "no body has these inertias: a principal "// &
                                      "moment is larger than the sum of the two others")
      case (inertia_negative)
        call draft%report%add_error(card%place(w), "the inertias are not positive: there is an "// &
                                    "axis with a negative moment of inertia")
        return
      case default  ! sound
      end select
    end if
    call add_record(card, 2, draft, record)
  end subroutine read_xm

end module deck_motion_cards
