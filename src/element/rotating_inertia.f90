!> Inertia in a frame that turns steadily: what a model feels that rests in it, and what small
!> motions in it add (theory 8, stationary rotation).
!>
!> With u the coordinates in the frame, all vectors as components in the frame's axes, the inertia
!> forces are M u'' + G u' + force(u), G skew-symmetric. They come from those in an inertial frame
!> by the velocities v + W x r and w + W and the accelerations a + 2 W x v + W x (W x r) and
!> w' + W x w. `force` stands on the side of the internal forces: the centrifugal forces are
!> -force; `centrifugal` is its derivative to the place. That is not symmetric: it becomes so, a
!> Hessian (theory 1), with skew(moment)/2 added to the spins of each node.
module rotating_inertia
  use kinds, only: wp
  use rotation, only: cross, skew
  use beamw_inertia, only: inertia_t
  use beamw_inertia_tangent, only: inertia_force_and_tangents
  use node_inertia, only: node_inertia_t, node_inertia_forces
  implicit none
  private

  public :: rotating_beamw, rotating_node, rotating_truss

contains

  !> Of a BEAMW element; coordinates as in `beamw_inertia`.
  pure subroutine rotating_beamw(self, euler, warping, position, spin, force, mass, gyroscopic, &
                                 centrifugal)
    type(inertia_t), intent(in) :: self
    real(wp), intent(in) :: euler(0:3, 2), warping(2)
    real(wp), intent(in) :: position(3, 2)  !< of p and q, from a point of the axis [L]
    real(wp), intent(in) :: spin(3)         !< W, angular velocity of the frame [T^-1]
    real(wp), intent(out) :: force(7, 2)
    real(wp), intent(out), dimension(14, 14) :: mass, gyroscopic, centrifugal
    real(wp) :: velocity(7, 2), acceleration(7, 2)
    integer :: e

    do e = 1, 2
      velocity(:, e) = [cross(spin, position(:, e)), spin, 0.0_wp]
      acceleration(:, e) = [cross(spin, velocity(1:3, e)), 0*spin, 0.0_wp]
    end do
    call inertia_force_and_tangents(self, euler, warping, velocity, acceleration, force, mass, &
                                    gyroscopic, centrifugal)
    do e = 0, 7, 7
      call add_frame_to_position(e, spin, mass, gyroscopic, centrifugal)
      call add_frame_to_spin(e + 3, spin, mass, gyroscopic)
    end do
  end subroutine rotating_beamw

  !> Of a node; coordinates as in `node_inertia`.
  pure subroutine rotating_node(self, euler, position, spin, force, mass, gyroscopic, centrifugal)
    type(node_inertia_t), intent(in) :: self
    real(wp), intent(in) :: euler(0:3)
    real(wp), intent(in) :: position(3)  !< from a point of the axis [L]
    real(wp), intent(in) :: spin(3)      !< W, angular velocity of the frame [T^-1]
    real(wp), intent(out) :: force(6)
    real(wp), intent(out), dimension(6, 6) :: mass, gyroscopic, centrifugal
    real(wp) :: velocity(6), acceleration(6)

    velocity = [cross(spin, position), spin]
    acceleration = [cross(spin, velocity(1:3)), 0*spin]
    call node_inertia_forces(self, euler, velocity, acceleration, force, mass, gyroscopic, &
                             centrifugal)
    call add_frame_to_position(0, spin, mass, gyroscopic, centrifugal)
    call add_frame_to_spin(3, spin, mass, gyroscopic)
  end subroutine rotating_node

  !> Of a TRUSS with the mass matrix of `truss_mass`.
  pure subroutine rotating_truss(mass, position, spin, force, gyroscopic, centrifugal)
    real(wp), intent(in) :: mass(6, 6)
    real(wp), intent(in) :: position(3, 2)  !< of p and q, from a point of the axis [L]
    real(wp), intent(in) :: spin(3)         !< W, angular velocity of the frame [T^-1]
    real(wp), intent(out) :: force(6)
    real(wp), intent(out), dimension(6, 6) :: gyroscopic, centrifugal

    gyroscopic = 0
    centrifugal = 0
    call add_frame_to_position(0, spin, mass, gyroscopic, centrifugal)
    call add_frame_to_position(3, spin, mass, gyroscopic, centrifugal)
    force = matmul(centrifugal, [position(:, 1), position(:, 2)])
  end subroutine rotating_truss

  !> Accelerations 2 W x v and W x (W x r) of the position whose coordinates follow `at`.
  pure subroutine add_frame_to_position(at, spin, mass, gyroscopic, centrifugal)
    integer, intent(in) :: at
    real(wp), intent(in) :: spin(3), mass(:, :)
    real(wp), intent(inout), dimension(:, :) :: gyroscopic, centrifugal
    real(wp) :: coriolis(size(mass, 1), 3), w(3, 3)

    w = skew(spin)
    coriolis = matmul(mass(:, at + 1:at + 3), w)
    gyroscopic(:, at + 1:at + 3) = gyroscopic(:, at + 1:at + 3) + 2*coriolis
    centrifugal(:, at + 1:at + 3) = centrifugal(:, at + 1:at + 3) + matmul(coriolis, w)
  end subroutine add_frame_to_position

  !> Angular acceleration W x w of the node whose spins follow `at`.
  pure subroutine add_frame_to_spin(at, spin, mass, gyroscopic)
    integer, intent(in) :: at
    real(wp), intent(in) :: spin(3), mass(:, :)
    real(wp), intent(inout) :: gyroscopic(:, :)
    real(wp) :: w(3, 3)

    w = skew(spin)
    gyroscopic(:, at + 1:at + 3) = gyroscopic(:, at + 1:at + 3) + matmul(mass(:, at + 1:at + 3), w)
  end subroutine add_frame_to_spin

end module rotating_inertia
