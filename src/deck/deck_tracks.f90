!> The beams that a SLIDER or CARRIAGE runs along: a chain, with the node beside it.
module deck_tracks
  use kinds, only: wp
  use text, only: to_text
  use model_data, only: joint_names, model_t, joint_t, translational
  use diagnostics, only: place_t
  use deck_draft, only: draft_t, record_slider
  use deck_elements, only: element_name, is_whole, find_range
  use deck_select, only: choice_t, select_beams, id_text
  implicit none
  private

  public :: set_tracks

  !> How far a node may be drawn beyond the ends, in lengths of the beam there.
  real(wp), parameter :: slack = 1.0e-6_wp

contains

  subroutine set_tracks(draft)
    type(draft_t), intent(inout) :: draft
    integer :: r

    do r = 1, draft%records
      if (draft%record(r)%kind /= record_slider) cycle
      call set_track(draft, r, draft%record(r)%joint)
    end do
  end subroutine set_tracks

  !> The members of one list, if it has no errors.
  subroutine set_track(draft, r, j)
    type(draft_t), intent(inout) :: draft
    integer, intent(in) :: r, j
    type(choice_t) :: choice
    integer, allocatable :: track(:)
    integer :: i, first, last, k
    logical :: ok

    allocate (track(0))
    call select_beams(draft, draft%record(r)%from, draft%record(r)%to, choice)
    ok = .true.
    do i = 1, choice%found
      if (.not. is_whole(draft, choice%index(i))) then
        ok = .false.
      else if (draft%beam(choice%index(i))%joint > 0) then
        if (choice%loose(i)) cycle
        ok = .false.
        call draft%report%add_error(choice%place(i), "a "//kind_of(draft%model%joint(j))// &
          " runs along beams: "//element_name(draft, choice%index(i)))
      else
        call find_range(draft, choice%index(i), choice%part(i), first, last)
        track = [track, [(k, k=first, last)]]
      end if
    end do
    draft%model%joint(j)%track = track
    if (.not. ok .or. size(track) == 0) return
    call check_chain(draft, draft%model%joint(j), choice%place(1), ok)
    if (ok) call check_place(draft, draft%model%joint(j))
  end subroutine set_track

  pure function kind_of(joint) result(name)
    type(joint_t), intent(in) :: joint
    character(len=:), allocatable :: name

    name = trim(joint_names(joint%kind))
  end function kind_of

  !> Each beam starts where the one before ends, and goes on in about its direction.
  subroutine check_chain(draft, joint, place, ok)
    type(draft_t), intent(inout) :: draft
    type(joint_t), intent(in) :: joint
    type(place_t), intent(in) :: place
    logical, intent(inout) :: ok
    character(len=:), allocatable :: names
    integer :: k

    do k = 2, size(joint%track)
      associate (before => draft%model%member(joint%track(k - 1)), &
                 here => draft%model%member(joint%track(k)))
        names = id_text(here%id, here%part)//" does not start where element "// &
                id_text(before%id, before%part)//" ends"
        if (here%node(translational, 1) /= before%node(translational, 2)) then
          ok = .false.
          call draft%report%add_error(place, "element "//names, "the beams of a "// &
            kind_of(joint)//" follow each other, from p to q")
          return
        end if
        if (dot_product(here%chord, before%chord) > 0) cycle
        if (.not. norm2(here%chord)*norm2(before%chord) > 0) cycle
        ok = .false.
        call draft%report%add_error(place, "elements "//id_text(before%id, before%part)//" and "// &
          id_text(here%id, here%part)//" meet at a right angle or more: a "//kind_of(joint)// &
          " cannot turn the corner")
        return
      end associate
    end do
  end subroutine check_chain

  !> The node is none of the beams', and was drawn beside them, not before or behind.
  subroutine check_place(draft, joint)
    type(draft_t), intent(inout) :: draft
    type(joint_t), intent(in) :: joint
    character(len=:), allocatable :: end
    real(wp) :: beyond
    integer :: k, node

    node = joint%node(translational, 2)
    associate (model => draft%model, name => "node "//id_text(draft%model%node(node)%id, &
                                                              draft%model%node(node)%part))
      do k = 1, size(joint%track)
        if (all(model%member(joint%track(k))%node(translational, :) /= node)) cycle
        call draft%report%add_error(joint%place, name//" is a node of the beams that "// &
          kind_of(joint)//" "//to_text(joint%id)//" runs along", "the node that runs along "// &
          "them is another one, at the same place or between their nodes")
        return
      end do
      if (.not. model%node(node)%placed) return
      call find_overrun(model, joint, beyond, end)
      if (beyond > 0) call draft%report%add_error(joint%place, name//" lies "// &
        to_text(beyond, 4)//" beyond the "//end//" of the beams that "//kind_of(joint)//" "// &
        to_text(joint%id)//" runs along")
    end associate
  end subroutine check_place

  !> How far the node lies beyond the end that it is nearest to; 0: beside the beams.
  pure subroutine find_overrun(model, joint, beyond, end)
    type(model_t), intent(in) :: model
    type(joint_t), intent(in) :: joint
    real(wp), intent(out) :: beyond
    character(len=:), allocatable, intent(out) :: end
    real(wp) :: away(3), nearest, share, length
    integer :: k

    nearest = huge(nearest)
    beyond = 0
    end = ""
    do k = 1, size(joint%track)
      associate (member => model%member(joint%track(k)))
        away = model%node(joint%node(translational, 2))%position &
               - model%node(member%node(translational, 1))%position
        length = norm2(member%chord)
        if (.not. length > 0) return
        share = dot_product(away, member%chord)/length**2
        away = away - min(1.0_wp, max(0.0_wp, share))*member%chord
        if (.not. norm2(away) < nearest) cycle
        nearest = norm2(away)
        beyond = 0
        if (k == 1 .and. share < -slack) then
          beyond = -share*length
          end = "start"
        else if (k == size(joint%track) .and. share > 1 + slack) then
          beyond = (share - 1)*length
          end = "end"
        end if
      end associate
    end do
  end subroutine find_overrun

end module deck_tracks
