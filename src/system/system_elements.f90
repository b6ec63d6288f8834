!> The elements of a system: of the members, of the joints, and those that hold or drive nodes.
module system_elements
  use kinds, only: wp
  use model_data, only: model_t, member_t, mode_fixed, mode_flexible, mode_released, &
                        mode_prescribed, type_beam, components
  use nodal_state, only: node_coordinates
  use element_beamw, only: new_element_beamw, add_damping, modes
  use element_coordinate, only: new_element_coordinate
  use element_rotation, only: new_element_rotation
  use beamw_constants, only: beamw_t
  use system_constants, only: constants_table_t, member_damping
  use system_data, only: system_t
  use system_joints, only: make_joints
  implicit none
  private

  public :: make_elements, number_releases

contains

  !> Elements of all members, of all joints, then those that prescribe coordinates of a node and
  !> those that hold or prescribe its rotation. `twists(i)`: the warping coordinate of node i has a
  !> bimoment.
  subroutine make_elements(model, system, twists)
    type(model_t), intent(in) :: model
    type(system_t), intent(inout) :: system
    logical, intent(out) :: twists(:)
    logical, allocatable :: held(:, :)
    logical :: linear(components)
    integer :: i, n

    linear = .true.
    linear(4:6) = .false.
    call find_driven(model, held)
    do i = 1, system%nodes
      held(4:6, i) = rotation_constraints(model%node(i)%fixed(4:6), held(4:6, i))
    end do
    n = system%members + system%joints
    allocate (system%holder(components, system%nodes))
    system%holder = 0
    do i = 1, system%nodes
      if (any(held(:, i) .and. linear)) n = n + 1
      where (held(:, i) .and. linear) system%holder(:, i) = n
      if (any(held(4:6, i))) n = n + 1
      where (held(4:6, i)) system%holder(4:6, i) = n
    end do
    allocate (system%element(n))
    call make_beams(model, system, twists)
    call make_joints(model, system)
    do i = 1, system%nodes
      if (.not. any(held(:, i))) cycle
      n = maxval(merge(system%holder(:, i), 0, linear))
      if (n > 0) call new_element_coordinate(i, held(:, i) .and. linear, system%element(n)%e)
      if (held(7, i)) twists(i) = .true.
      n = maxval(system%holder(4:6, i))
      if (n > 0) call new_element_rotation(i, held(4:6, i), system%element(n)%e)
    end do
  end subroutine make_elements

  !> Coordinates of the nodes that some motion prescribes.
  pure subroutine find_driven(model, driven)
    type(model_t), intent(in) :: model
    logical, allocatable, intent(out) :: driven(:, :)
    integer :: p, i

    allocate (driven(components, size(model%node)))
    driven = .false.
    do p = 1, size(model%pattern)
      do i = 1, model%pattern(p)%motions
        associate (motion => model%pattern(p)%motion(i))
          if (motion%node > 0) driven(motion%component, motion%node) = .true.
        end associate
      end do
    end do
  end subroutine find_driven

  !> Components of a node's rotation that need a constraint: those prescribed and, beside them or
  !> if it is the only one, those fixed.
  pure function rotation_constraints(fixed, driven) result(constrained)
    logical, intent(in) :: fixed(3), driven(3)
    logical :: constrained(3)

    constrained = fixed .or. driven
    if (.not. any(driven) .and. count(fixed) /= 1) constrained = .false.
  end function rotation_constraints

  subroutine make_beams(model, system, twists)
    type(model_t), intent(in) :: model
    type(system_t), intent(inout) :: system
    logical, intent(inout) :: twists(:)
    type(constants_table_t) :: table
    type(beamw_t), pointer :: constants
    real(wp), allocatable :: viscosity(:, :)
    integer :: i, release(modes), releases

    twists = .false.
    releases = 0
    do i = 1, system%members
      associate (m => model%member(i))
        call table%get(model, m, constants)
        call number_releases(m, releases, release)
        if (constants%warping .and. m%status(2) /= mode_fixed) twists(m%node(3, :)) = .true.
        call new_element_beamw(m%node, system%nodes, m%chord, m%triad, held_modes(m), release, &
                               constants, system%element(i)%e)
        call member_damping(model, m, constants, viscosity)
        if (allocated(viscosity)) call add_damping(viscosity, system%element(i)%e)
      end associate
    end do
    do i = 1, system%members
      associate (m => model%member(i))
        if (any(m%status(7:8) == mode_fixed) .or. m%rigid) call hold_warping(m, twists)
      end associate
    end do
    if (allocated(table%constants)) call move_alloc(table%constants, system%constants)
    system%constants_used = table%entries
    system%coordinates = node_coordinates*system%nodes + releases
  end subroutine make_beams

  !> Modes that are constraints, fixed or prescribed.
  pure function held_modes(member) result(held)
    type(member_t), intent(in) :: member
    logical :: held(modes)

    held = member%status == mode_fixed .or. member%status == mode_prescribed
    if (member%rigid) held = member%status /= mode_released
  end function held_modes

  !> Modes 7 and 8 of a rigid torsion hold alpha; a BEAM has no part in it.
  pure subroutine hold_warping(member, twists)
    type(member_t), intent(in) :: member
    logical, intent(inout) :: twists(:)
    integer :: e

    if (member%kind == type_beam) return
    do e = 1, 2
      if (member%status(6 + e) == mode_fixed .or. member%rigid) twists(member%node(3, e)) = .false.
    end do
  end subroutine hold_warping

  !> A released mode of a beam with stiffness has a coordinate of its own; one of a beam without
  !> is just not constrained.
  pure subroutine number_releases(member, releases, release)
    type(member_t), intent(in) :: member
    integer, intent(inout) :: releases
    integer, intent(out) :: release(modes)
    integer :: i

    release = 0
    if (member%rigid .or. .not. any(member%status == mode_flexible)) return
    do i = 1, modes
      if (member%status(i) /= mode_released) cycle
      if (member%kind == type_beam .and. i > 6) cycle
      releases = releases + 1
      release(i) = releases
    end do
  end subroutine number_releases

end module system_elements
