!> Completes the joints: references, nodes, the status of their modes without DYNE and RLSE.
module deck_joints
  use model_data, only: joint_t, joint_hinge, joint_universal, joint_cylindrical, &
                        joint_prismatic, joint_slider, joint_carriage, mode_flexible, &
                        mode_released, translational, rotational
  use deck_draft, only: draft_t, record_gear
  use deck_elements, only: element_name, is_whole
  use deck_select, only: choice_t, select_beams
  use deck_tracks, only: set_tracks
  implicit none
  private

  public :: expand_joints

contains

  subroutine expand_joints(draft)
    type(draft_t), intent(inout) :: draft
    integer :: j, kind, end

    draft%model%joint = draft%model%joint(:draft%joints)
    do j = 1, draft%joints
      associate (joint => draft%model%joint(j), node => draft%model%node)
        joint%section = draft%sections%reference(joint%section)
        joint%material = draft%materials%reference(joint%material)
        do end = 1, 2
          do kind = translational, rotational
            if (joint%node(kind, end) > 0) node(joint%node(kind, end))%exists(kind) = .true.
          end do
        end do
        if (joint%node(translational, 1) > 0) then
          joint%chord = node(joint%node(translational, 2))%position &
                        - node(joint%node(translational, 1))%position
        end if
        call set_free_modes(joint)
      end associate
    end do
    call set_gears(draft)
    call set_tracks(draft)
  end subroutine expand_joints

  !> What a joint is made for: its modes that are free unless a card says otherwise.
  pure subroutine set_free_modes(joint)
    type(joint_t), intent(inout) :: joint

    select case (joint%kind)
    case (joint_universal, joint_cylindrical)
      joint%status(:2) = mode_released
    case (joint_prismatic, joint_slider, joint_carriage)
      joint%status(1) = mode_released
    case default
      if (joint%section > 0 .and. joint%material > 0) joint%status(1) = mode_flexible
    end select
  end subroutine set_free_modes

  !> The hinges that gears join.
  subroutine set_gears(draft)
    type(draft_t), intent(inout) :: draft
    type(choice_t) :: choice
    integer :: r, i

    do r = 1, draft%records
      if (draft%record(r)%kind /= record_gear) cycle
      call select_beams(draft, draft%record(r)%from, draft%record(r)%to, choice)
      if (choice%found < 2) cycle
      do i = 1, 2
        if (.not. is_whole(draft, choice%index(i))) cycle
        associate (gear => draft%model%joint(draft%record(r)%joint), &
                   hinge => draft%beam(choice%index(i))%joint)
          if (hinge > 0) gear%gear(i) = hinge
          if (hinge > 0) then
            if (draft%model%joint(hinge)%kind == joint_hinge) cycle
          end if
          call draft%report%add_error(choice%place(i), "a GEAR joins two hinges: "// &
                                      element_name(draft, choice%index(i)))
        end associate
      end do
    end do
  end subroutine set_gears

end module deck_joints
