!> One joint of each kind, and states for them.
module joint_samples
  use kinds, only: wp
  use element_base, only: element_t, element_slot_t
  use element_truss, only: new_element_truss
  use element_hinge, only: new_element_hinge
  use element_universal, only: new_element_universal
  use element_spherical, only: new_element_spherical
  use element_cylindrical, only: new_element_cylindrical
  use element_gear, only: new_element_gear
  use nodal_state, only: state_t, new_state, node_coordinates
  use rotation, only: rotated, turned
  implicit none
  private

  public :: new_joint, far_state, turn, move_rigidly, measure

  real(wp), parameter, public :: pi = acos(-1.0_wp)

  integer, parameter, public :: truss = 1, hinge = 2, universal = 3, spherical = 4, &
                                cylindrical = 5, gear = 6, shared_gear = 7, kinds_of_joints = 7
  character(len=11), parameter, public :: joint_names(kinds_of_joints) = &
    ["truss      ", "hinge      ", "universal  ", "spherical  ", "cylindrical", "gear       ", &
     "shared gear"]
  integer, parameter, public :: nodes = 4, slots = 3
  real(wp), parameter, public :: ratio = -2.5_wp

  real(wp), parameter, public :: position(3, nodes) = reshape( &
    [0.3_wp, -0.2_wp, 0.5_wp, 1.4_wp, 0.6_wp, -0.4_wp, 0.1_wp, 1.0_wp, 0.2_wp, 2.0_wp, 0.3_wp, &
     0.7_wp], [3, nodes])
  real(wp), parameter, public :: chord(3) = position(:, 2) - position(:, 1)
  real(wp), parameter, public :: a(3) = [0.48_wp, -0.6_wp, 0.64_wp]
  real(wp), parameter, public :: b(3) = [0.8_wp, 0.64_wp, 0.0_wp]
  real(wp), parameter, public :: second(3) = [-0.36_wp, 0.48_wp, 0.8_wp]
  real(wp), parameter, public :: stiffness(6) = [3, 5, 7, 11, 13, 17]*1.0_wp
  real(wp), parameter, public :: damping(6) = 0.1_wp*stiffness

contains

  !> One of each kind, between nodes 1 and 2; of the gear's hinges the second is between nodes 3
  !> and 4, or 1 and 4 where they share a node.
  subroutine new_joint(kind, fixed, element)
    integer, intent(in) :: kind
    logical, intent(in) :: fixed(6)
    class(element_t), allocatable, intent(out) :: element

    select case (kind)
    case (truss)
      call new_element_truss([1, 2], chord, fixed(:1), stiffness(:1), damping(:1), element)
    case (hinge)
      call new_element_hinge([1, 2], 3*a, fixed(:3), stiffness(:3), damping(:3), 1, element)
    case (universal)
      call new_element_universal([1, 2], reshape([a, b], [3, 2]), fixed(:3), stiffness(:3), &
                                 damping(:3), [1, 2], element)
    case (spherical)
      call new_element_spherical([1, 2], chord, fixed(:3), stiffness(:3), damping(:3), element)
    case (cylindrical)
      call new_element_cylindrical(reshape([1, 1, 2, 2], [2, 2]), chord, a, fixed, stiffness, &
                                   damping, 1, element)
    case (gear)
      call new_element_gear(reshape([1, 2, 3, 4], [2, 2]), reshape([a, second], [3, 2]), [1, 3], &
                            ratio, fixed(:1), stiffness(:1), damping(:1), element)
    case default  ! shared_gear
      call new_element_gear(reshape([1, 2, 1, 4], [2, 2]), reshape([a, second], [3, 2]), [1, 3], &
                            ratio, fixed(:1), stiffness(:1), damping(:1), element)
    end select
  end subroutine new_joint

  !> A state far from the start: nodes 2 and 4 turned several times about their hinges, which are
  !> misaligned then, and all turned and moved; different for each `i`.
  subroutine far_state(i, state)
    integer, intent(in) :: i
    type(state_t), intent(out) :: state
    type(element_slot_t) :: joint(2)
    real(wp) :: increment(node_coordinates*nodes)
    integer :: k

    call new_state(nodes, 0, slots, state)
    call new_joint(universal, spread(.false., 1, 6), joint(1)%e)
    call new_element_hinge([1, 4], second, spread(.false., 1, 3), stiffness(:3), damping(:3), 3, &
                           joint(2)%e)
    do k = 1, 7 + i
      call turn(state, 2, 1.9_wp*a)
      call turn(state, 4, -1.3_wp*second)
      call joint(1)%e%count_turns(state)
      call joint(2)%e%count_turns(state)
    end do
    increment = [(0.35_wp*sin(7.3_wp*k*i + i), k=1, size(increment))]
    call state%move(increment)
    call joint(1)%e%count_turns(state)
    call joint(2)%e%count_turns(state)
    call move_rigidly(state, [0.7_wp, -0.4_wp, 0.9_wp]*i, [3.0_wp, -2.0_wp, 1.0_wp])
  end subroutine far_state

  subroutine turn(state, node, theta)
    type(state_t), intent(inout) :: state
    integer, intent(in) :: node
    real(wp), intent(in) :: theta(3)

    state%euler(:, node) = turned(state%euler(:, node), theta)
  end subroutine turn

  !> Turn all nodes about the origin, then shift them.
  subroutine move_rigidly(state, theta, shift)
    type(state_t), intent(inout) :: state
    real(wp), intent(in) :: theta(3), shift(3)
    integer :: i

    do i = 1, nodes
      call turn(state, i, theta)
      state%displacement(:, i) = image(theta, position(:, i) + state%displacement(:, i)) &
                                 + shift - position(:, i)
    end do
  end subroutine move_rigidly

  !> exp(theta) v.
  function image(theta, v)
    real(wp), intent(in) :: theta(3), v(3)
    real(wp) :: image(3)

    image = reshape(rotated(turned([1.0_wp, 0.0_wp, 0.0_wp, 0.0_wp], theta), &
                            spread(v, 2, 3)), [3])
  end function image

  !> The strains, after counting.
  subroutine measure(element, state, strain, valid)
    class(element_t), intent(in) :: element
    type(state_t), intent(inout) :: state
    real(wp), allocatable, intent(out) :: strain(:)
    logical, intent(out) :: valid
    real(wp) :: b(element%strains, element%coordinates)
    real(wp) :: g(element%coordinates, element%coordinates)

    allocate (strain(element%strains))
    strain = 0
    call element%count_turns(state)
    call element%evaluate(state, 0*strain, strain, b, g, valid)
  end subroutine measure

end module joint_samples
