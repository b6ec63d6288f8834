!> A model in a frame that turns steadily: centrifugal forces, their tangent and the gyroscopic
!> matrix (theory 8, stationary rotation). All coordinates are those in the frame.
module system_rotation
  use kinds, only: wp
  use model_data, only: model_t
  use nodal_state, only: state_t
  use rotation, only: skew
  use rotating_inertia, only: rotating_beamw, rotating_node, rotating_truss
  use system_data, only: system_t, rotor_t, body_size
  use system_inertia, only: new_masses
  use system_pattern, only: add_block
  implicit none
  private

  public :: make_rotors, spin_at, add_rotation, assemble_gyroscopic

contains

  !> The turns of the model's patterns, and the masses that feel them; loads are numbered.
  pure subroutine make_rotors(model, system)
    type(model_t), intent(in) :: model
    type(system_t), intent(inout) :: system
    integer :: p

    allocate (system%rotor(0))
    do p = 1, size(model%pattern)
      associate (card => model%pattern(p)%rotation)
        if (.not. any(abs(card%axis) > 0)) cycle
        system%rotor = [system%rotor, rotor_t(p, card%rate*card%axis)]
        system%axis_point = card%origin
      end associate
    end do
    if (size(system%rotor) > 0) call new_masses(model, system, system%masses)
  end subroutine make_rotors

  !> Angular velocity of the frame with the patterns at `level` [1/T].
  pure function spin_at(system, level) result(spin)
    type(system_t), intent(in) :: system
    real(wp), intent(in) :: level(:)
    real(wp) :: spin(3)
    integer :: i

    spin = 0
    do i = 1, size(system%rotor)
      spin = spin + level(system%rotor(i)%pattern)*system%rotor(i)%spin
    end do
  end function spin_at

  !> Add the centrifugal forces to the loads `total` (by coordinate) and their tangent to `values`.
  pure subroutine add_rotation(system, state, spin, total, values)
    type(system_t), intent(in) :: system
    type(state_t), intent(in) :: state
    real(wp), intent(in) :: spin(3)
    real(wp), intent(inout) :: total(:), values(:)
    real(wp) :: force(body_size), gyroscopic(body_size, body_size)
    real(wp) :: centrifugal(body_size, body_size)
    integer :: k, n

    do k = 1, system%masses%bodies
      call turn_body(system, k, state, spin, force, gyroscopic, centrifugal)
      n = system%masses%coordinates(k)
      associate (at => system%masses%coordinate(:n, k))
        total(at) = total(at) - force(:n)
      end associate
      call add_block(system%pattern, system%masses%block(k), centrifugal(:n, :n), values)
    end do
  end subroutine add_rotation

  !> Add the gyroscopic matrix, skew-symmetric, to the entries of a square pattern.
  pure subroutine assemble_gyroscopic(system, state, spin, values)
    type(system_t), intent(in) :: system
    type(state_t), intent(in) :: state
    real(wp), intent(in) :: spin(3)
    real(wp), intent(inout) :: values(:)
    real(wp) :: force(body_size), gyroscopic(body_size, body_size)
    real(wp) :: centrifugal(body_size, body_size)
    integer :: k, n

    do k = 1, system%masses%bodies
      call turn_body(system, k, state, spin, force, gyroscopic, centrifugal)
      n = system%masses%coordinates(k)
      call add_block(system%pattern, system%masses%block(k), gyroscopic(:n, :n), values)
    end do
  end subroutine assemble_gyroscopic

  !> Force, on the side of the internal forces, and matrices of a body in its first coordinates;
  !> the derivative to the place as a Hessian, like those of the elements.
  pure subroutine turn_body(system, k, state, spin, force, gyroscopic, centrifugal)
    type(system_t), intent(in) :: system
    integer, intent(in) :: k
    type(state_t), intent(in) :: state
    real(wp), intent(in) :: spin(3)
    real(wp), intent(out) :: force(body_size)
    real(wp), intent(out), dimension(body_size, body_size) :: gyroscopic, centrifugal
    real(wp) :: mass(body_size, body_size), place(3, 2), ends(7, 2)
    integer :: i, e

    associate (masses => system%masses, node => system%masses%node(:, :, k))
      place = 0
      do e = 1, 2
        if (node(1, e) == 0) cycle
        place(:, e) = masses%position(:, node(1, e)) + state%displacement(:, node(1, e)) &
                      - system%axis_point
      end do
      i = k - masses%beams
      if (i <= 0) then
        call rotating_beamw(masses%beam(k), state%euler(:, node(2, :)), &
                            state%warping(node(3, :)), place, spin, ends, mass, gyroscopic, &
                            centrifugal)
        force = reshape(ends, [14])
      else if (i <= masses%trusses) then
        call rotating_truss(masses%truss(:, :, i), place, spin, force(:6), gyroscopic(:6, :6), &
                            centrifugal(:6, :6))
      else
        call rotating_node(masses%point(i - masses%trusses), state%euler(:, node(2, 1)), &
                           place(:, 1), spin, force(:6), mass(:6, :6), gyroscopic(:6, :6), &
                           centrifugal(:6, :6))
      end if
      do e = 1, 2
        if (node(2, e) == 0) cycle
        associate (at => [7*e - 3, 7*e - 2, 7*e - 1])
          centrifugal(at, at) = centrifugal(at, at) + 0.5_wp*skew(force(at))
        end associate
      end do
    end associate
  end subroutine turn_body

end module system_rotation
