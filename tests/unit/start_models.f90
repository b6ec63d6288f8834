!> Models for the tests of what a motion starts from: what decks say, and joints, motions and starts
!> added by hand.
module start_models
  use kinds, only: wp
  use errors, only: error_t
  use check, only: expect
  use deck_samples, only: read_sound
  use model_data, only: model_t, joint_t, mass_t, motion_t, start_t, pattern_t, joint_truss, &
                        joint_hinge, joint_spherical, mode_fixed, mode_prescribed, mode_flexible
  use nodal_state, only: state_t
  use system_data, only: system_t
  use system_build, only: build_system
  use system_constraints, only: drop_redundant
  use start_assembly, only: assemble_start
  use start_velocity, only: find_velocities
  implicit none
  private

  public :: frame_of_nodes, add_truss, add_joint, add_mass, add_motion, add_start, start
  public :: expect_error

contains

  !> Nodes that only translate, at the columns of `position`, Z fixed; a TRANSIENT with a pattern.
  subroutine frame_of_nodes(position, grounded, model)
    real(wp), intent(in) :: position(:, :)
    integer, intent(in) :: grounded(:)   !< nodes that are fixed
    type(model_t), intent(out) :: model
    integer :: i

    call read_sound("NODE 1 0 0 0|NODE 2 1 0 0|BEAMW 1 1 2 0 0 1|XF 2 0 0 0|"// &
                    "TRANSIENT TEND 1 STEP 0.1", model)
    model%member = model%member(:0)
    model%node = [(model%node(1), i=1, size(position, 2))]
    do i = 1, size(position, 2)
      model%node(i)%id = i
      model%node(i)%position = position(:, i)
      model%node(i)%fixed = .false.
      model%node(i)%fixed(3) = .true.
    end do
    do i = 1, size(grounded)
      model%node(grounded(i))%fixed(:3) = .true.
    end do
  end subroutine frame_of_nodes

  subroutine add_joint(model, joint)
    type(model_t), intent(inout) :: model
    type(joint_t), intent(in) :: joint
    type(joint_t), allocatable :: more(:)

    allocate (more(size(model%joint) + 1))
    more(:size(more) - 1) = model%joint
    more(size(more)) = joint
    more(size(more))%id = size(model%member) + size(more)
    call move_alloc(more, model%joint)
  end subroutine add_joint

  !> A bar between two nodes, rigid unless it has a stiffness.
  subroutine add_truss(model, p, q, stiffness)
    type(model_t), intent(inout) :: model
    integer, intent(in) :: p, q
    real(wp), intent(in), optional :: stiffness
    type(joint_t) :: joint

    joint%kind = joint_truss
    joint%node(1, :) = [p, q]
    joint%chord = model%node(q)%position - model%node(p)%position
    if (present(stiffness)) then
      joint%status(1) = mode_flexible
      joint%stiffness(1) = stiffness
    end if
    call add_joint(model, joint)
  end subroutine add_truss

  subroutine add_mass(model, node, mass)
    type(model_t), intent(inout) :: model
    integer, intent(in) :: node
    real(wp), intent(in) :: mass

    model%mass = [model%mass, mass_t(node=node, mass=mass)]
  end subroutine add_mass

  !> A motion of the first pattern; that of a joint's mode makes it prescribed.
  subroutine add_motion(model, motion)
    type(model_t), intent(inout) :: model
    type(motion_t), intent(in) :: motion

    type(motion_t), allocatable :: more(:)

    associate (pattern => model%pattern(1))
      allocate (more(pattern%motions + 1))
      if (pattern%motions > 0) more(:pattern%motions) = pattern%motion(:pattern%motions)
      pattern%motions = size(more)
      more(pattern%motions) = motion
      call move_alloc(more, pattern%motion)
    end associate
    if (motion%joint > 0) model%joint(motion%joint)%status(motion%mode) = mode_prescribed
  end subroutine add_motion

  subroutine add_start(model, given)
    type(model_t), intent(inout) :: model
    type(start_t), intent(in) :: given

    model%start = [model%start, given]
  end subroutine add_start

  !> The system with the state and velocities a motion starts from. The caller frees the system.
  subroutine start(model, system, state, velocity, error)
    type(model_t), intent(in) :: model
    type(system_t), intent(out) :: system
    type(state_t), intent(out) :: state
    real(wp), allocatable, intent(out) :: velocity(:)
    type(error_t), allocatable, intent(out) :: error
    integer, allocatable :: dropped(:)
    real(wp) :: level(size(model%pattern))

    level = 0
    call build_system(model, system)
    allocate (velocity(system%coordinates))
    velocity = 0
    call assemble_start(model, system, state, error)
    if (.not. allocated(error)) call drop_redundant(system, state, dropped, error)
    if (.not. allocated(error)) then
      call find_velocities(model, system, state, level, velocity, error)
    end if
  end subroutine start

  subroutine expect_error(error, message)
    type(error_t), allocatable, intent(in) :: error
    character(len=*), intent(in) :: message

    call expect(allocated(error), "an error: "//message)
    if (.not. allocated(error)) return
    call expect(index(error%message, message) > 0, "'"//message//"', got '"//error%message//"'")
  end subroutine expect_error

end module start_models
