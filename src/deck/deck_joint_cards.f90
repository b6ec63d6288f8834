!> Cards of the elements that are not beams: TRUSS and the joints.
module deck_joint_cards
  use kinds, only: wp
  use text, only: to_text
  use model_data, only: joint_t, joint_truss, joint_hinge, joint_universal, joint_spherical, &
                        joint_cylindrical, joint_prismatic, joint_gear, joint_slider, &
                        joint_carriage, mass_none, mass_lumped, mass_consistent, translational, &
                        rotational
  use deck_card, only: card_t
  use deck_draft, only: draft_t, record_t, record_gear, record_slider
  use deck_growth, only: grow
  use deck_model_cards, only: node_number, add_selection
  use deck_element_cards, only: beam_number, add_record
  implicit none
  private

  public :: read_truss, read_hinge, read_universal, read_spherical, read_cylindrical, &
            read_prismatic, read_gear, read_slider, read_carriage

  real(wp), parameter :: perpendicular = 1.0e-6_wp  !< largest cosine between two such axes

contains

  !> TRUSS id p q [SECTION name] [MATERIAL name] [MASS kind]
  subroutine read_truss(card, draft)
    type(card_t), intent(in) :: card
    type(draft_t), intent(inout) :: draft
    integer, parameter :: mass(3) = [mass_consistent, mass_lumped, mass_none]
    type(joint_t) :: joint
    character(len=:), allocatable :: name

    associate (option => card%option)
      if (option(1) > 0) then
        name = card%word(option(1) + 1)
        call draft%sections%refer(name, card%place(option(1) + 1), joint%section)
      end if
      if (option(2) > 0) then
        name = card%word(option(2) + 1)
        call draft%materials%refer(name, card%place(option(2) + 1), joint%material)
      end if
      if (option(3) > 0) joint%mass = mass(card%whole(option(3) + 1))
    end associate
    call add_joint(card, draft, joint_truss, joint)
  end subroutine read_truss

  !> HINGE id Rp Rq ax ay az
  subroutine read_hinge(card, draft)
    type(card_t), intent(in) :: card
    type(draft_t), intent(inout) :: draft
    type(joint_t) :: joint

    call add_joint(card, draft, joint_hinge, joint)
  end subroutine read_hinge

  !> UNIVERSAL id Rp Rq ax ay az bx by bz
  subroutine read_universal(card, draft)
    type(card_t), intent(in) :: card
    type(draft_t), intent(inout) :: draft
    type(joint_t) :: joint

    call add_joint(card, draft, joint_universal, joint)
  end subroutine read_universal

  !> SPHERICAL id p q
  subroutine read_spherical(card, draft)
    type(card_t), intent(in) :: card
    type(draft_t), intent(inout) :: draft
    type(joint_t) :: joint

    call add_joint(card, draft, joint_spherical, joint)
  end subroutine read_spherical

  !> CYLINDRICAL id p q ax ay az
  subroutine read_cylindrical(card, draft)
    type(card_t), intent(in) :: card
    type(draft_t), intent(inout) :: draft
    type(joint_t) :: joint

    call add_joint(card, draft, joint_cylindrical, joint)
  end subroutine read_cylindrical

  !> PRISMATIC id p q ax ay az
  subroutine read_prismatic(card, draft)
    type(card_t), intent(in) :: card
    type(draft_t), intent(inout) :: draft
    type(joint_t) :: joint

    call add_joint(card, draft, joint_prismatic, joint)
  end subroutine read_prismatic

  !> GEAR id hinge1 hinge2 ratio
  subroutine read_gear(card, draft)
    type(card_t), intent(in) :: card
    type(draft_t), intent(inout) :: draft
    type(joint_t) :: joint
    type(record_t) :: record
    integer :: k
    logical :: ok

    call beam_number(draft, card%whole(2), card%place(2), k)
    if (k == 0) return
    ok = abs(card%number(5)) > 0
    if (.not. ok) call draft%report%add_error(card%place(5), "the ratio of a GEAR cannot be 0")
    if (card%whole(3) == card%whole(4)) then
      ok = .false.
      call draft%report%add_error(card%place(4), "a GEAR joins two hinges, not element "// &
                                  to_text(card%whole(4))//" to itself")
    end if
    if (.not. ok) return
    joint%ratio = card%number(5)
    call keep_joint(card, draft, k, joint_gear, joint)
    record%kind = record_gear
    record%joint = draft%joints
    call add_record(card, 3, draft, record)
    call add_selection(card, 4, draft, ok)
    draft%record(draft%records)%to = draft%selections
  end subroutine read_gear

  !> SLIDER id node ALONG elements
  subroutine read_slider(card, draft)
    type(card_t), intent(in) :: card
    type(draft_t), intent(inout) :: draft

    call add_slider(card, draft, joint_slider)
  end subroutine read_slider

  !> CARRIAGE id node ALONG elements
  subroutine read_carriage(card, draft)
    type(card_t), intent(in) :: card
    type(draft_t), intent(inout) :: draft

    call add_slider(card, draft, joint_carriage)
  end subroutine read_carriage

  !> The node is that of end q; the beams are found when all cards are read.
  subroutine add_slider(card, draft, kind)
    type(card_t), intent(in) :: card
    type(draft_t), intent(inout) :: draft
    integer, intent(in) :: kind
    type(joint_t) :: joint
    type(record_t) :: record
    integer :: k, node

    call beam_number(draft, card%whole(2), card%place(2), k)
    if (k == 0) return
    call node_number(draft, card%whole(3), card%part(3), card%place(3), node)
    joint%node(translational, 2) = node
    if (kind == joint_carriage) joint%node(rotational, 2) = node
    call keep_joint(card, draft, k, kind, joint)
    record%kind = record_slider
    record%joint = draft%joints
    call add_record(card, card%option(1) + 1, draft, record)
  end subroutine add_slider

  !> The nodes and axes that a joint of this kind has on its card.
  subroutine add_joint(card, draft, kind, joint)
    type(card_t), intent(in) :: card
    type(draft_t), intent(inout) :: draft
    integer, intent(in) :: kind
    type(joint_t), intent(inout) :: joint
    integer :: k, end, node, axis
    logical :: ok

    call beam_number(draft, card%whole(2), card%place(2), k)
    if (k == 0) return
    do end = 1, 2
      call node_number(draft, card%whole(2 + end), card%part(2 + end), card%place(2 + end), node)
      if (kind /= joint_hinge .and. kind /= joint_universal) joint%node(translational, end) = node
      if (kind /= joint_truss .and. kind /= joint_spherical) joint%node(rotational, end) = node
    end do
    ok = any(joint%node(:, 1) /= joint%node(:, 2))
    if (.not. ok) call draft%report%add_error(card%place(4), "both ends of the element are at "// &
                                              "node "//to_text(card%whole(4)))
    do axis = 1, (card%positional - 3)/3
      call read_axis(card, 2 + 3*axis, draft, joint%axis(:, axis), ok)
    end do
    if (ok .and. kind == joint_universal) call check_angle(card, draft, joint, ok)
    if (ok) call keep_joint(card, draft, k, kind, joint)
  end subroutine add_joint

  !> The direction at words `w` to `w + 2`.
  subroutine read_axis(card, w, draft, axis, ok)
    type(card_t), intent(in) :: card
    integer, intent(in) :: w
    type(draft_t), intent(inout) :: draft
    real(wp), intent(out) :: axis(3)
    logical, intent(inout) :: ok

    axis = card%number(w:w + 2)
    if (any(abs(axis) > 0)) then
      axis = axis/maxval(abs(axis))
      axis = axis/norm2(axis)
    else
      ok = .false.
      call draft%report%add_error(card%place(w), "an axis cannot be 0 0 0")
    end if
  end subroutine read_axis

  !> The axes of a universal joint are perpendicular, exactly so inside the program.
  subroutine check_angle(card, draft, joint, ok)
    type(card_t), intent(in) :: card
    type(draft_t), intent(inout) :: draft
    type(joint_t), intent(inout) :: joint
    logical, intent(inout) :: ok
    real(wp) :: cosine

    associate (a => joint%axis(:, 1), b => joint%axis(:, 2))
      cosine = dot_product(a, b)
      ok = abs(cosine) <= perpendicular
      if (ok) then
        b = b - cosine*a
        b = b/norm2(b)
      else
        call draft%report%add_error(card%place(8), "the axes of a universal joint must be "// &
          "perpendicular: a and b are at "// &
          to_text(acos(max(-1.0_wp, min(1.0_wp, cosine)))*180.0_wp/acos(-1.0_wp), 4)//" degrees")
      end if
    end associate
  end subroutine check_angle

  subroutine keep_joint(card, draft, k, kind, joint)
    type(card_t), intent(in) :: card
    type(draft_t), intent(inout) :: draft
    integer, intent(in) :: k, kind
    type(joint_t), intent(in) :: joint

    draft%joints = draft%joints + 1
    call grow(draft%model%joint, draft%joints)
    draft%model%joint(draft%joints) = joint
    draft%model%joint(draft%joints)%kind = kind
    draft%model%joint(draft%joints)%id = card%whole(2)
    draft%model%joint(draft%joints)%place = card%place(2)
    draft%beam(k)%joint = draft%joints
  end subroutine keep_joint

end module deck_joint_cards
