!> Inertia in the equations of motion: forces M a + h(x, v), their exact tangent, momentum.
!>
!> Velocities and accelerations are by coordinate: of X Y Z, the spatial angular velocity and its
!> derivative to time, of alpha.
module system_dynamics
  use kinds, only: wp
  use nodal_state, only: state_t
  use rotation, only: skew
  use beamw_inertia, only: inertia_force
  use beamw_inertia_tangent, only: inertia_force_and_tangents
  use node_inertia, only: node_inertia_forces
  use system_data, only: system_t
  use system_pattern, only: add_block
  use system_inertia, only: masses_t, rigid_motion, body_size
  implicit none
  private

  public :: shares_t, inertia_forces, add_inertia, kinetic_energy, momentum

  !> What an increment of the coordinates does to velocity and acceleration.
  type :: shares_t
    real(wp) :: velocity = 0.0_wp      !< [1/T]
    real(wp) :: acceleration = 0.0_wp  !< [1/T^2]
    !> (3, 3, nodes) from a spin to the change of the rotation vector of the step.
    real(wp), allocatable :: turn(:, :, :)
  end type shares_t

contains

  !> Inertia forces by coordinate.
  pure subroutine inertia_forces(masses, state, velocity, acceleration, force)
    type(masses_t), intent(in) :: masses
    type(state_t), intent(in) :: state
    real(wp), intent(in) :: velocity(:), acceleration(:)
    real(wp), intent(out) :: force(:)
    real(wp), dimension(body_size) :: v, a, f
    real(wp), dimension(6, 6) :: mass, rate, place
    integer :: k, n

    force = 0
    do k = 1, masses%bodies
      n = masses%coordinates(k)
      associate (at => masses%coordinate(:n, k))
        v(:n) = velocity(at)
        a(:n) = acceleration(at)
        if (k <= masses%beams) then
          call inertia_force(masses%beam(k), state%euler(:, masses%node(2, :, k)), &
                             state%warping(masses%node(3, :, k)), v, a, f)
        else
          call other_body(masses, k, state, v(:6), a(:6), f(:6), mass, rate, place)
        end if
        force(at) = force(at) + f(:n)
      end associate
    end do
  end subroutine inertia_forces

  !> Forces and tangents of a truss or a node.
  pure subroutine other_body(masses, k, state, v, a, f, mass, rate, place)
    type(masses_t), intent(in) :: masses
    integer, intent(in) :: k
    type(state_t), intent(in) :: state
    real(wp), intent(in) :: v(6), a(6)
    real(wp), intent(out) :: f(6), mass(6, 6), rate(6, 6), place(6, 6)
    integer :: i

    i = k - masses%beams
    if (i <= masses%trusses) then
      mass = masses%truss(:, :, i)
      f = matmul(mass, a)
      rate = 0
      place = 0
    else
      call node_inertia_forces(masses%point(i - masses%trusses), &
                               state%euler(:, masses%node(2, 1, k)), v, a, f, mass, rate, place)
    end if
  end subroutine other_body

  !> Inertia forces, and their tangent added to the entries: what an increment of the coordinates
  !> changes directly and through velocity and acceleration.
  pure subroutine add_inertia(system, masses, shares, state, velocity, acceleration, force, values)
    type(system_t), intent(in) :: system
    type(masses_t), intent(in) :: masses
    type(shares_t), intent(in) :: shares
    type(state_t), intent(in) :: state
    real(wp), intent(in) :: velocity(:), acceleration(:)
    real(wp), intent(out) :: force(:)
    real(wp), intent(inout) :: values(:)
    real(wp), dimension(body_size) :: v, a, f
    real(wp), dimension(body_size, body_size) :: mass, rate, place
    integer :: k, n

    force = 0
    do k = 1, masses%bodies
      n = masses%coordinates(k)
      associate (at => masses%coordinate(:n, k))
        v(:n) = velocity(at)
        a(:n) = acceleration(at)
        if (k <= masses%beams) then
          call inertia_force_and_tangents(masses%beam(k), state%euler(:, masses%node(2, :, k)), &
                                          state%warping(masses%node(3, :, k)), v, a, f, mass, &
                                          rate, place)
        else
          call other_body(masses, k, state, v(:6), a(:6), f(:6), mass(:6, :6), rate(:6, :6), &
                          place(:6, :6))
        end if
        force(at) = force(at) + f(:n)
        rate(:n, :n) = shares%velocity*rate(:n, :n) + shares%acceleration*mass(:n, :n)
        call turn_columns(masses, k, shares, rate(:n, :n))
        call symmetrize_place(masses, k, f(:n), place(:n, :n))
        place(:n, :n) = place(:n, :n) + rate(:n, :n)
        call add_block(system%pattern, masses%block(k), place(:n, :n), values)
      end associate
    end do
  end subroutine add_inertia

  !> The derivative to the place as that of the elements, with second derivatives along exp(theta):
  !> half the skew of a moment less than that of its components; with all moments in balance the
  !> difference vanishes.
  pure subroutine symmetrize_place(masses, k, force, place)
    type(masses_t), intent(in) :: masses
    integer, intent(in) :: k
    real(wp), intent(in) :: force(:)
    real(wp), intent(inout) :: place(:, :)
    integer :: e

    do e = 1, 2
      if (masses%node(2, e, k) == 0) cycle
      associate (spin => [7*e - 3, 7*e - 2, 7*e - 1])
        place(spin, spin) = place(spin, spin) + 0.5_wp*skew(force(spin))
      end associate
    end do
  end subroutine symmetrize_place

  !> Columns of rotations, from rotation vectors of the step to spins.
  pure subroutine turn_columns(masses, k, shares, tangent)
    type(masses_t), intent(in) :: masses
    integer, intent(in) :: k
    type(shares_t), intent(in) :: shares
    real(wp), intent(inout) :: tangent(:, :)
    integer :: e

    do e = 1, 2
      associate (node => masses%node(2, e, k))
        if (node == 0) cycle
        tangent(:, 7*e - 3:7*e - 1) = matmul(tangent(:, 7*e - 3:7*e - 1), shares%turn(:, :, node))
      end associate
    end do
  end subroutine turn_columns

  !> Of all masses [F L].
  pure real(wp) function kinetic_energy(system, masses, state, velocity) result(energy)
    type(system_t), intent(in) :: system
    type(masses_t), intent(in) :: masses
    type(state_t), intent(in) :: state
    real(wp), intent(in) :: velocity(:)
    real(wp) :: product(system%coordinates)

    call mass_times(masses, state, velocity, product)
    energy = 0.5_wp*dot_product(velocity, product)
  end function kinetic_energy

  !> M v: the inertia forces of accelerations v at rest.
  pure subroutine mass_times(masses, state, velocity, product)
    type(masses_t), intent(in) :: masses
    type(state_t), intent(in) :: state
    real(wp), intent(in) :: velocity(:)
    real(wp), intent(out) :: product(:)
    real(wp) :: rest(size(velocity))

    rest = 0
    call inertia_forces(masses, state, rest, velocity, product)
  end subroutine mass_times

  !> Kinetic energy, and linear and angular momentum about the origin.
  pure subroutine momentum(system, masses, state, velocity, energy, total)
    type(system_t), intent(in) :: system
    type(masses_t), intent(in) :: masses
    type(state_t), intent(in) :: state
    real(wp), intent(in) :: velocity(:)
    real(wp), intent(out) :: energy, total(6)
    real(wp) :: product(system%coordinates)
    real(wp), parameter :: origin(3) = 0

    call mass_times(masses, state, velocity, product)
    energy = 0.5_wp*dot_product(velocity, product)
    total = matmul(product, rigid_motion(masses, state, origin, system%coordinates))
  end subroutine momentum

end module system_dynamics
