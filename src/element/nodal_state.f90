!> Where the nodes are: displacements, not positions, so that small differences stay exact.
module nodal_state
  use kinds, only: wp
  use rotation, only: turned, no_rotation
  implicit none
  private

  public :: state_t, new_state, coordinate_number

  integer, parameter, public :: node_coordinates = 7  !< X Y Z RX RY RZ W

  !> The configuration of a model. Coordinates are numbered 7 (node - 1) + component; the
  !> coordinates of released strains follow behind those of all nodes.
  type :: state_t
    real(wp), allocatable :: displacement(:, :)  !< 3 x nodes, from the initial position [L]
    real(wp), allocatable :: euler(:, :)         !< 0:3 x nodes, Euler parameters, scalar first
    real(wp), allocatable :: warping(:)          !< alpha, the rate of twist [1/L]
    real(wp), allocatable :: release(:)          !< values of the released strains [L]
    !> Angles of hinges as last counted, so that they go on through full turns [rad].
    real(wp), allocatable :: angle(:)
  contains
    procedure :: move
  end type state_t

contains

  !> The undeformed state.
  pure subroutine new_state(nodes, releases, angles, state)
    integer, intent(in) :: nodes, releases, angles
    type(state_t), intent(out) :: state

    allocate (state%displacement(3, nodes), state%euler(0:3, nodes))
    allocate (state%warping(nodes), state%release(releases), state%angle(angles))
    state%displacement = 0
    state%euler = spread(no_rotation, 2, nodes)
    state%warping = 0
    state%release = 0
    state%angle = 0
  end subroutine new_state

  !> Number of a node's coordinate; `component` counts X Y Z RX RY RZ W.
  pure elemental function coordinate_number(node, component) result(number)
    integer, intent(in) :: node, component
    integer :: number

    number = node_coordinates*(node - 1) + component
  end function coordinate_number

  !> Add an increment; rotations are spatial rotation vectors (theory 1).
  pure subroutine move(self, increment)
    class(state_t), intent(inout) :: self
    real(wp), intent(in) :: increment(:)  !< by coordinate number
    integer :: i, k

    do i = 1, size(self%warping)
      k = node_coordinates*(i - 1)
      self%displacement(:, i) = self%displacement(:, i) + increment(k + 1:k + 3)
      if (any(abs(increment(k + 4:k + 6)) > 0)) then
        self%euler(:, i) = turned(self%euler(:, i), increment(k + 4:k + 6))
      end if
      self%warping(i) = self%warping(i) + increment(k + 7)
    end do
    self%release = self%release + increment(node_coordinates*size(self%warping) + 1:)
  end subroutine move

end module nodal_state
