!> The elements of joints, from what the model says of them.
module system_joints
  use kinds, only: wp
  use model_data, only: model_t, joint_t, mode_fixed, mode_flexible, mode_prescribed, joint_modes, &
                        joint_truss, joint_hinge, joint_universal, joint_spherical, joint_gear, &
                        joint_slider, joint_carriage
  use element_base, only: element_t
  use element_truss, only: new_element_truss
  use element_hinge, only: new_element_hinge
  use element_universal, only: new_element_universal
  use element_spherical, only: new_element_spherical
  use element_cylindrical, only: new_element_cylindrical
  use element_gear, only: new_element_gear
  use element_slider, only: track_t, new_element_slider
  use system_inertia, only: mass_shear_centre
  use system_data, only: system_t
  implicit none
  private

  public :: make_joints

contains

  !> Elements behind those of the members; angles that count turns get their slots.
  subroutine make_joints(model, system)
    type(model_t), intent(in) :: model
    type(system_t), intent(inout) :: system
    integer :: slot(size(model%joint)), i

    system%angles = 0
    do i = 1, size(model%joint)
      slot(i) = system%angles + 1
      select case (model%joint(i)%kind)
      case (joint_truss, joint_spherical, joint_gear)
      case (joint_universal, joint_carriage)
        system%angles = system%angles + 2
      case default
        system%angles = system%angles + 1
      end select
    end do
    do i = 1, size(model%joint)
      associate (element => system%element(system%members + i))
        call make_joint(model, model%joint(i), slot, slot(i), element%e)
        if (.not. element%e%size > 0) element%e%size = system%length
      end associate
    end do
  end subroutine make_joints

  subroutine make_joint(model, joint, slots, slot, element)
    type(model_t), intent(in) :: model
    type(joint_t), intent(in) :: joint
    integer, intent(in) :: slots(:), slot
    class(element_t), allocatable, intent(out) :: element
    real(wp) :: stiffness(6), damping(6)
    logical :: fixed(6)
    integer :: n

    n = joint_modes(joint%kind)
    fixed = joint%status == mode_fixed .or. joint%status == mode_prescribed
    call laws(model, joint, stiffness, damping)
    select case (joint%kind)
    case (joint_truss)
      call new_element_truss(joint%node(1, :), joint%chord, fixed(:n), stiffness(:n), damping(:n), &
                             element)
    case (joint_hinge)
      call new_element_hinge(joint%node(2, :), joint%axis(:, 1), fixed(:n), stiffness(:n), &
                             damping(:n), slot, element)
    case (joint_universal)
      call new_element_universal(joint%node(2, :), joint%axis, fixed(:n), stiffness(:n), &
                                 damping(:n), [slot, slot + 1], element)
    case (joint_spherical)
      call new_element_spherical(joint%node(1, :), joint%chord, fixed(:n), stiffness(:n), &
                                 damping(:n), element)
    case (joint_gear)
      associate (a => model%joint(joint%gear(1)), b => model%joint(joint%gear(2)))
        call new_element_gear(reshape([a%node(2, :), b%node(2, :)], [2, 2]), &
                              reshape([a%axis(:, 1), b%axis(:, 1)], [3, 2]), slots(joint%gear), &
                              joint%ratio, fixed(:n), stiffness(:n), damping(:n), element)
      end associate
    case (joint_slider, joint_carriage)
      call new_element_slider(joint%node(:, 2), model%node(joint%node(1, 2))%position, &
                              track_of(model, joint), fixed(:n), stiffness(:n), damping(:n), slot, &
                              element)
    case default
      call new_element_cylindrical(joint%node, joint%chord, joint%axis(:, 1), fixed, stiffness, &
                                   damping, slot, element)
    end select
  end subroutine make_joint

  !> The beams that a slider runs along.
  pure function track_of(model, joint) result(track)
    type(model_t), intent(in) :: model
    type(joint_t), intent(in) :: joint
    type(track_t) :: track(size(joint%track))
    integer :: k

    do k = 1, size(track)
      associate (member => model%member(joint%track(k)))
        track(k)%node = member%node
        track(k)%start = model%node(member%node(1, 1))%position
        track(k)%chord = member%chord
        track(k)%triad = member%triad
        track(k)%shear_centre = mass_shear_centre(model, member)
      end associate
    end do
  end function track_of

  !> Stiffness and damping by mode, zero where it is not flexible; of a truss over its length, with
  !> the damping of its material and Rayleigh's.
  pure subroutine laws(model, joint, stiffness, damping)
    type(model_t), intent(in) :: model
    type(joint_t), intent(in) :: joint
    real(wp), intent(out) :: stiffness(6), damping(6)
    real(wp) :: beta

    stiffness = joint%stiffness
    damping = joint%damping
    beta = model%rayleigh(2)
    if (joint%kind == joint_truss) then
      if (joint%section > 0 .and. joint%material > 0) then
        associate (material => model%material(joint%material))
          stiffness(1) = material%e*model%section(joint%section)%constants%a
          beta = beta + material%damping
        end associate
      end if
      stiffness = stiffness/norm2(joint%chord)
      damping = damping/norm2(joint%chord)
    end if
    damping = damping + beta*stiffness
    where (joint%status /= mode_flexible)
      stiffness = 0
      damping = 0
    end where
  end subroutine laws

end module system_joints
