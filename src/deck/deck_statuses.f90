!> DYNE, RLSE and INPUTE cards: the status of the modes of beams and joints.
module deck_statuses
  use text, only: to_text
  use model_data, only: mode_fixed, mode_flexible, mode_released, mode_prescribed
  use deck_draft, only: draft_t, record_t, record_flexible, record_release, record_strain
  use deck_elements, only: is_whole, modes_of, find_range, set_status, complain_of_mode
  use deck_select, only: choice_t, select_beams, id_text
  implicit none
  private

  public :: set_modes

  !> Which card gave a mode of an element its status, as the kind of its record; 0: none.
  type :: origin_t
    integer, allocatable :: card(:, :)     !< (8, elements)
    logical, allocatable :: listed(:)      !< DYNE has replaced "all" by its list
  end type origin_t

contains

  !> Apply DYNE, RLSE and INPUTE in the order of the cards; then let modes 7 and 8 follow mode 2.
  subroutine set_modes(draft)
    type(draft_t), intent(inout) :: draft
    type(choice_t) :: choice
    type(origin_t) :: origin
    integer :: r, k

    allocate (origin%card(8, draft%members + draft%joints))
    allocate (origin%listed(draft%members + draft%joints))
    origin%card = 0
    origin%listed = .false.
    do r = 1, draft%records
      associate (record => draft%record(r))
        if (all(record%kind /= [record_flexible, record_release, record_strain])) cycle
        call select_beams(draft, record%from, record%to, choice)
        if (choice%found == 0) cycle
        if (record%kind == record_flexible) call clear_defaults(draft, record, choice, origin)
        do k = record%item_from, record%item_to
          call apply_mode(draft, record, k, choice, origin)
        end do
      end associate
    end do
    call follow_twist(draft, origin)
  end subroutine set_modes

  !> The first DYNE of a beam with SECTION replaces "all"; a RIGID beam has none.
  subroutine clear_defaults(draft, record, choice, origin)
    type(draft_t), intent(inout) :: draft
    type(record_t), intent(in) :: record
    type(choice_t), intent(in) :: choice
    type(origin_t), intent(inout) :: origin
    integer :: i, e, first, last

    do i = 1, choice%found
      if (draft%beam(choice%index(i))%joint > 0) cycle
      if (draft%beam(choice%index(i))%rigid) then
        if (.not. choice%loose(i)) call complain_of_rigid(draft, record, choice%index(i))
        cycle
      end if
      call find_range(draft, choice%index(i), choice%part(i), first, last)
      do e = first, last
        if (origin%listed(e)) cycle
        origin%listed(e) = .true.
        where (draft%model%member(e)%status == mode_flexible)
          draft%model%member(e)%status = mode_fixed
        end where
      end do
    end do
  end subroutine clear_defaults

  subroutine complain_of_rigid(draft, record, k)
    type(draft_t), intent(inout) :: draft
    type(record_t), intent(in) :: record
    integer, intent(in) :: k

    call draft%report%add_error(record%place, "element "//to_text(draft%beam(k)%id)// &
                                " is RIGID: "//card_name(record%kind)//" contradicts")
  end subroutine complain_of_rigid

  pure function card_name(kind) result(name)
    integer, intent(in) :: kind
    character(len=:), allocatable :: name

    select case (kind)
    case (record_flexible)
      name = "DYNE"
    case (record_release)
      name = "RLSE"
    case default
      name = "INPUTE"
    end select
  end function card_name

  !> One mode of a card, for all elements of its list. Elements of a range, group or ALL that do
  !> not have it are passed over, unless none has it.
  subroutine apply_mode(draft, record, item, choice, origin)
    type(draft_t), intent(inout) :: draft
    type(record_t), intent(in) :: record
    integer, intent(in) :: item
    type(choice_t), intent(in) :: choice
    type(origin_t), intent(inout) :: origin
    integer :: i
    logical :: fits

    fits = .false.
    associate (mode => draft%item(item)%value, place => draft%item(item)%place)
      do i = 1, choice%found
        if (.not. is_whole(draft, choice%index(i)) .or. &
            mode <= modes_of(draft, choice%index(i))) then
          fits = .true.
          call apply_to_element(draft, record, item, choice, i, origin)
        else if (.not. choice%listed(i)) then
          fits = .true.
          call draft%report%add_error(place, complain_of_mode(draft, choice%index(i)))
        end if
      end do
      if (.not. fits) call draft%report%add_error(place, "no element of the list has a mode "// &
                                                  to_text(mode))
    end associate
  end subroutine apply_mode

  subroutine apply_to_element(draft, record, item, choice, i, origin)
    type(draft_t), intent(inout) :: draft
    type(record_t), intent(in) :: record
    integer, intent(in) :: item, i
    type(choice_t), intent(in) :: choice
    type(origin_t), intent(inout) :: origin
    integer, parameter :: status(3) = [mode_flexible, mode_released, mode_prescribed]
    integer :: e, first, last
    logical :: ok

    call find_range(draft, choice%index(i), choice%part(i), first, last)
    call check_mode(draft, record, item, choice%index(i), first, last, choice%loose(i), ok)
    if (.not. ok) return
    associate (mode => draft%item(item)%value)
      do e = first, last
        associate (card => origin%card(mode, e))
          if (card /= 0 .and. card /= record%kind) then
            call complain_of_origin(draft, item, choice%index(i), card)
            exit
          end if
          card = record%kind
        end associate
        call set_status(draft, e, mode, status(findloc([record_flexible, record_release, &
                                                       record_strain], record%kind, 1)))
      end do
    end associate
  end subroutine apply_to_element

  !> Modes that a card may not name: any of a RIGID beam, end modes of a divided one, prescribed
  !> warping.
  subroutine check_mode(draft, record, item, k, first, last, loose, ok)
    type(draft_t), intent(inout) :: draft
    type(record_t), intent(in) :: record
    integer, intent(in) :: item, k, first, last
    logical, intent(in) :: loose
    logical, intent(out) :: ok
    character(len=:), allocatable :: name

    associate (beam => draft%beam(k), mode => draft%item(item)%value, &
               place => draft%item(item)%place)
      ok = .not. (beam%rigid .and. record%kind /= record_release)
      if (.not. ok .and. record%kind == record_strain .and. .not. loose) then
        call complain_of_rigid(draft, record, k)
      end if
      if (.not. ok) return
      name = "element "//to_text(beam%id)
      ok = record%kind == record_flexible .or. last <= first .or. mode <= 2
      if (.not. ok) then
        call draft%report%add_error(place, name//" is divided: mode "//to_text(mode)// &
          " is an end mode, of its parts "//id_text(beam%id, 1)//" (3 5 7, end p) and "// &
          id_text(beam%id, beam%divide)//" (4 6 8, end q)", card_name(record%kind)//" "// &
          id_text(beam%id, merge(1, beam%divide, modulo(mode, 2) == 1))//" "//to_text(mode))
      else if (record%kind == record_strain .and. mode > 6) then
        ok = .false.
        call draft%report%add_error(place, "mode "//to_text(mode)//" of "//name// &
                                    " follows mode 2 and cannot be prescribed", &
                                    "INPUTX node W prescribes warping at a node")
      end if
    end associate
  end subroutine check_mode

  !> A mode has got its status from another card before.
  subroutine complain_of_origin(draft, item, k, card)
    type(draft_t), intent(inout) :: draft
    integer, intent(in) :: item, k, card
    character(len=:), allocatable :: said

    said = " is made flexible by DYNE"
    if (card == record_release) said = " is released by RLSE"
    if (card == record_strain) said = " is prescribed by INPUTE"
    call draft%report%add_error(draft%item(item)%place, "mode "// &
                                to_text(draft%item(item)%value)//" of element "// &
                                to_text(draft%beam(k)%id)//said)
  end subroutine complain_of_origin

  !> Modes 7 and 8 are flexible if mode 2 is, else fixed, unless released.
  subroutine follow_twist(draft, origin)
    type(draft_t), intent(inout) :: draft
    type(origin_t), intent(in) :: origin
    integer :: m, mode

    do m = 1, draft%members
      associate (member => draft%model%member(m))
        do mode = 7, 8
          if (member%status(mode) == mode_released) cycle
          if (origin%card(mode, m) == record_flexible .and. member%status(2) /= mode_flexible &
              .and. member%part <= 1 .and. member%section >= 0) call draft%report%add_error( &
            member%place, "DYNE makes mode "//to_text(mode)//" of element "//to_text(member%id)// &
            " flexible without mode 2, which it follows")
          member%status(mode) = merge(mode_flexible, mode_fixed, member%status(2) == mode_flexible)
        end do
      end associate
    end do
  end subroutine follow_twist

end module deck_statuses
