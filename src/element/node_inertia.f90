!> Inertia of a node: a mass and a rotary inertia that turns with the node (XM, theory 7).
!>
!> Coordinates: r (3), spatial spin (3); velocities, accelerations and forces likewise.
module node_inertia
  use kinds, only: wp
  use rotation, only: rotation_matrix, identity3
  use rotary_inertia, only: rotary_moment
  implicit none
  private

  public :: node_inertia_t, node_inertia_forces, node_momentum, node_kinetic_energy

  !> What a node carries.
  type :: node_inertia_t
    real(wp) :: mass = 0.0_wp          !< [M]
    real(wp) :: tensor(3, 3) = 0.0_wp  !< about the node, in global axes at the start [M L^2]
  end type node_inertia_t

contains

  !> Forces m a and J w' + w x (J w), exact, and their derivatives to the acceleration (`mass`),
  !> to the velocity (`rate`) and to the place. That to the place holds velocity and acceleration
  !> as global components; a spin dphi turns the node by dR = skew(dphi) R. It is not symmetric.
  !> Where the other tangents are Hessians (theory 1), add skew(moment)/2 to the spins.
  pure subroutine node_inertia_forces(self, euler, velocity, acceleration, force, mass, rate, place)
    type(node_inertia_t), intent(in) :: self
    real(wp), intent(in) :: euler(0:3)
    real(wp), intent(in) :: velocity(6)      !< rate of r, angular velocity
    real(wp), intent(in) :: acceleration(6)  !< their derivatives to time
    real(wp), intent(out) :: force(6)
    real(wp), intent(out), dimension(6, 6) :: mass, rate, place
    real(wp), dimension(3, 3) :: tensor, to_spin, to_place

    tensor = turned_tensor(self, euler)
    call rotary_moment(tensor, velocity(4:6), acceleration(4:6), force(4:6), to_spin, to_place)
    force(1:3) = self%mass*acceleration(1:3)
    mass = 0
    mass(1:3, 1:3) = self%mass*identity3
    mass(4:6, 4:6) = tensor
    rate = 0
    rate(4:6, 4:6) = to_spin
    place = 0
    place(4:6, 4:6) = to_place
  end subroutine node_inertia_forces

  !> Momentum and, about the node, angular momentum.
  pure function node_momentum(self, euler, velocity) result(momentum)
    type(node_inertia_t), intent(in) :: self
    real(wp), intent(in) :: euler(0:3), velocity(6)
    real(wp) :: momentum(6)  !< [M L T^-1] and [M L^2 T^-1]
    real(wp) :: tensor(3, 3)

    tensor = turned_tensor(self, euler)
    momentum(1:3) = self%mass*velocity(1:3)
    momentum(4:6) = matmul(tensor, velocity(4:6))
  end function node_momentum

  !> Kinetic energy [F L].
  pure function node_kinetic_energy(self, euler, velocity) result(energy)
    type(node_inertia_t), intent(in) :: self
    real(wp), intent(in) :: euler(0:3), velocity(6)
    real(wp) :: energy

    energy = 0.5_wp*dot_product(velocity, node_momentum(self, euler, velocity))
  end function node_kinetic_energy

  !> The rotary inertia as the node stands.
  pure function turned_tensor(self, euler) result(tensor)
    type(node_inertia_t), intent(in) :: self
    real(wp), intent(in) :: euler(0:3)
    real(wp) :: tensor(3, 3), r(3, 3)

    r = rotation_matrix(euler)
    tensor = matmul(matmul(r, self%tensor), transpose(r))
  end function turned_tensor

end module node_inertia
