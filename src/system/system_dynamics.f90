!> Inertia in the equations of motion: forces M a + h(x, v), their exact tangent, momentum.
!>
!> Velocities and accelerations are by coordinate: of X Y Z, the spatial angular velocity and its
!> derivative to time, of alpha.
module system_dynamics
  use kinds, only: wp
  use nodal_state, only: state_t
  use beamw_inertia, only: inertia_force
  use beamw_inertia_tangent, only: inertia_step_tangent
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
    real(wp) :: euler(0:3, 2), warping(2)
    integer :: k

    force = 0
    do k = 1, masses%bodies
      call gather(masses, k, velocity, acceleration, v, a)
      if (k <= masses%beams) then
        call gather_ends(masses, k, state, euler, warping)
        call inertia_force(masses%beam(k), euler, warping, v, a, f)
      else
        call other_body(masses, k, state, v(:6), a(:6), f(:6), mass, rate, place)
      end if
      call scatter(masses, k, f, force)
    end do
  end subroutine inertia_forces

  !> Velocities and accelerations of a body. Loops, as vector subscripts would be allocated.
  pure subroutine gather(masses, k, velocity, acceleration, v, a)
    type(masses_t), intent(in) :: masses
    integer, intent(in) :: k
    real(wp), intent(in) :: velocity(:), acceleration(:)
    real(wp), intent(out) :: v(body_size), a(body_size)
    integer :: i

    do i = 1, masses%coordinates(k)
      v(i) = velocity(masses%coordinate(i, k))
      a(i) = acceleration(masses%coordinate(i, k))
    end do
  end subroutine gather

  !> Rotations and warping of a beam's ends.
  pure subroutine gather_ends(masses, k, state, euler, warping)
    type(masses_t), intent(in) :: masses
    integer, intent(in) :: k
    type(state_t), intent(in) :: state
    real(wp), intent(out) :: euler(0:3, 2), warping(2)
    integer :: e

    do e = 1, 2
      euler(:, e) = state%euler(:, masses%node(2, e, k))
      warping(e) = state%warping(masses%node(3, e, k))
    end do
  end subroutine gather_ends

  pure subroutine scatter(masses, k, f, force)
    type(masses_t), intent(in) :: masses
    integer, intent(in) :: k
    real(wp), intent(in) :: f(body_size)
    real(wp), intent(inout) :: force(:)
    integer :: i

    do i = 1, masses%coordinates(k)
      force(masses%coordinate(i, k)) = force(masses%coordinate(i, k)) + f(i)
    end do
  end subroutine scatter

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
    real(wp) :: euler(0:3, 2), warping(2), turn(3, 3, 2)
    integer :: k, n, e

    force = 0
    do k = 1, masses%bodies
      n = masses%coordinates(k)
      call gather(masses, k, velocity, acceleration, v, a)
      if (k <= masses%beams) then
        call gather_ends(masses, k, state, euler, warping)
        do e = 1, 2
          turn(:, :, e) = shares%turn(:, :, masses%node(2, e, k))
        end do
        call inertia_step_tangent(masses%beam(k), euler, warping, v, a, &
                                  [shares%velocity, shares%acceleration], turn, f, place)
      else
        call other_body(masses, k, state, v(:6), a(:6), f(:6), mass(:6, :6), rate(:6, :6), &
                        place(:6, :6))
        call add_rates(masses, k, shares, mass, rate, place)
      end if
      call scatter(masses, k, f, force)
      call symmetrize_place(masses, k, f, place)
      call add_block(system%pattern, masses%block(k), place(:n, :n), values)
    end do
  end subroutine add_inertia

  !> The derivative to the place as that of the elements, with second derivatives along exp(theta):
  !> half the skew of a moment less than that of its components; with all moments in balance the
  !> difference vanishes.
  pure subroutine symmetrize_place(masses, k, force, place)
    type(masses_t), intent(in) :: masses
    integer, intent(in) :: k
    real(wp), intent(in) :: force(body_size)
    real(wp), intent(inout) :: place(body_size, body_size)
    integer :: e, i, j, l

    do e = 1, 2
      if (masses%node(2, e, k) == 0) cycle
      do i = 1, 3
        j = 1 + modulo(i, 3)
        l = 1 + modulo(j, 3)
        associate (half => 0.5_wp*force(7*e - 4 + i))
          place(7*e - 4 + l, 7*e - 4 + j) = place(7*e - 4 + l, 7*e - 4 + j) + half
          place(7*e - 4 + j, 7*e - 4 + l) = place(7*e - 4 + j, 7*e - 4 + l) - half
        end associate
      end do
    end do
  end subroutine symmetrize_place

  !> What an increment of a truss or node changes through velocity and acceleration; columns of
  !> rotations go from rotation vectors of the step to spins.
  pure subroutine add_rates(masses, k, shares, mass, rate, place)
    type(masses_t), intent(in) :: masses
    integer, intent(in) :: k
    type(shares_t), intent(in) :: shares
    real(wp), intent(in), dimension(body_size, body_size) :: mass, rate
    real(wp), intent(inout) :: place(body_size, body_size)
    real(wp), dimension(6, 6) :: both
    integer :: j

    both = shares%velocity*rate(:6, :6) + shares%acceleration*mass(:6, :6)
    associate (node => masses%node(2, 1, k))
      if (node > 0) both(:, 4:6) = matmul(both(:, 4:6), shares%turn(:, :, node))
    end associate
    do j = 1, 6
      place(:6, j) = place(:6, j) + both(:, j)
    end do
  end subroutine add_rates

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
