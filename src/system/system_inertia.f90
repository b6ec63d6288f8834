!> The mass of a system: of its beams, trusses and nodes, and the matrix of it in the system's
!> sparsity (theory 7).
module system_inertia
  use kinds, only: wp
  use model_data, only: model_t, member_t, joint_t, mass_none, mass_consistent, joint_truss, &
                        type_beam
  use nodal_state, only: state_t, coordinate_number
  use rotation, only: cross, identity3
  use beamw_inertia, only: inertia_t, new_inertia, inertia_mass
  use node_inertia, only: node_inertia_forces
  use truss_inertia, only: truss_mass
  use system_data, only: system_t, masses_t, body_size
  use system_pattern, only: add_block
  implicit none
  private

  public :: masses_t, new_masses, assemble_mass, mass_product, rigid_motion, mass_centre
  public :: truss_density, line_densities, mass_shear_centre, body_size, find_massive

contains

  !> Gather what has mass.
  pure subroutine new_masses(model, system, masses)
    type(model_t), intent(in) :: model
    type(system_t), intent(in) :: system
    type(masses_t), intent(out) :: masses
    integer, allocatable :: member(:), joint(:)
    integer :: i, n

    allocate (member, source=pack([(i, i=1, size(model%member))], &
                                  [(has_mass(model, i), i=1, size(model%member))]))
    allocate (joint, source=pack([(i, i=1, size(model%joint))], &
                                 truss_density(model, model%joint) > 0))
    masses%beams = size(member)
    masses%trusses = size(joint)
    n = size(member) + size(joint) + size(system%mass_node)
    masses%bodies = n
    allocate (masses%block(n), masses%coordinates(n), masses%coordinate(body_size, n))
    allocate (masses%node(3, 2, n), masses%beam(size(member)), masses%truss(6, 6, size(joint)))
    allocate (masses%point(size(system%mass_node)), masses%position(3, size(model%node)))
    masses%node = 0
    masses%coordinate = 0
    do i = 1, size(model%node)
      masses%position(:, i) = model%node(i)%position
    end do
    call add_beams(model, member, masses)
    call add_trusses(model, system, joint, masses)
    call add_points(model, system, masses)
  end subroutine new_masses

  pure subroutine add_beams(model, member, masses)
    type(model_t), intent(in) :: model
    integer, intent(in) :: member(:)
    type(masses_t), intent(inout) :: masses
    integer :: k

    do k = 1, size(member)
      associate (m => model%member(member(k)))
        masses%beam(k) = member_inertia(model, m)
        masses%block(k) = member(k)
        masses%node(:, :, k) = m%node
        masses%total = masses%total + sum(masses%beam(k)%line([1, 3], [1, 3]))
        masses%coordinates(k) = 14
        masses%coordinate(:, k) = &
          coordinate_number(reshape(m%node([1, 1, 1, 2, 2, 2, 3], :), [14]), &
                            [1, 2, 3, 4, 5, 6, 7, 1, 2, 3, 4, 5, 6, 7])
      end associate
    end do
  end subroutine add_beams

  pure subroutine add_trusses(model, system, joint, masses)
    type(model_t), intent(in) :: model
    type(system_t), intent(in) :: system
    integer, intent(in) :: joint(:)
    type(masses_t), intent(inout) :: masses
    integer :: k, b
    real(wp) :: density

    do k = 1, size(joint)
      b = masses%beams + k
      associate (truss => model%joint(joint(k)))
        density = truss_density(model, truss)
        masses%truss(:, :, k) = truss_mass(density, norm2(truss%chord), &
                                           truss%mass == mass_consistent)
        masses%node(1, :, b) = truss%node(1, :)
        masses%total = masses%total + density*norm2(truss%chord)
      end associate
      masses%block(b) = system%members + joint(k)
      masses%coordinates(b) = 6
      masses%coordinate(:6, b) = system%element(system%members + joint(k))%e%coordinate
    end do
  end subroutine add_trusses

  !> All XM cards of a node together.
  pure subroutine add_points(model, system, masses)
    type(model_t), intent(in) :: model
    type(system_t), intent(in) :: system
    type(masses_t), intent(inout) :: masses
    integer :: point_of(size(model%node)), k, b, i, j

    point_of(system%mass_node) = [(k, k=1, size(system%mass_node))]
    do i = 1, size(model%mass)
      associate (point => masses%point(point_of(model%mass(i)%node)))
        point%mass = point%mass + model%mass(i)%mass
        point%tensor = point%tensor + model%mass(i)%inertia
      end associate
    end do
    do k = 1, size(system%mass_node)
      b = masses%beams + masses%trusses + k
      masses%total = masses%total + masses%point(k)%mass
      masses%block(b) = size(system%element) + size(system%load) + k
      masses%node(:, 1, b) = system%mass_node(k)
      masses%coordinates(b) = 6
      masses%coordinate(:6, b) = coordinate_number(system%mass_node(k), [(j, j=1, 6)])
    end do
  end subroutine add_points

  pure logical function has_mass(model, i)
    type(model_t), intent(in) :: model
    integer, intent(in) :: i

    has_mass = model%member(i)%mass /= mass_none .and. &
               any(abs(line_densities(model, model%member(i))) > 0)
  end function has_mass

  !> Mass per length of a TRUSS, else zero [M L^-1].
  pure elemental function truss_density(model, joint) result(density)
    type(model_t), intent(in) :: model
    type(joint_t), intent(in) :: joint
    real(wp) :: density

    density = 0
    if (joint%kind /= joint_truss .or. joint%mass == mass_none) return
    density = joint%inertia
    if (joint%section > 0 .and. joint%material > 0) then
      density = model%section(joint%section)%constants%a*model%material(joint%material)%rho
    end if
  end function truss_density

  !> rho A, rho Ip, Iy, Iz, Iyz, rho Iw: those of EM, else of section and material.
  pure function line_densities(model, member) result(density)
    type(model_t), intent(in) :: model
    type(member_t), intent(in) :: member
    real(wp) :: density(6)

    density = 0
    if (member%has_inertia) then
      density = member%inertia
    else if (member%section > 0 .and. member%material > 0) then
      associate (c => model%section(member%section)%constants)
        density = model%material(member%material)%rho*[c%a, c%ip(), c%iy, c%iz, 0.0_wp, c%iw]
      end associate
    end if
  end function line_densities

  !> Inertia of a beam.
  pure function member_inertia(model, member) result(inertia)
    type(model_t), intent(in) :: model
    type(member_t), intent(in) :: member
    type(inertia_t) :: inertia

    inertia = new_inertia(line_densities(model, member), norm2(member%chord), member%triad, &
                          mass_shear_centre(model, member), member%mass == mass_consistent, &
                          member%rotary)
  end function member_inertia

  !> The shear centre of a beam's section where its mass has to know it: where alpha moves the line
  !> of centroids [L].
  pure function mass_shear_centre(model, member) result(centre)
    type(model_t), intent(in) :: model
    type(member_t), intent(in) :: member
    real(wp) :: centre(2)

    centre = 0
    if (member%section == 0 .or. member%has_stiffness .or. member%rigid .or. &
        member%kind == type_beam) return
    associate (c => model%section(member%section)%constants)
      centre = [c%ys, c%zs]
    end associate
  end function mass_shear_centre

  !> The mass matrix at a state, by entry of the system's pattern.
  pure subroutine assemble_mass(system, masses, state, values)
    type(system_t), intent(in) :: system
    type(masses_t), intent(in) :: masses
    type(state_t), intent(in) :: state
    real(wp), intent(out) :: values(:)
    real(wp) :: mass(body_size, body_size)
    integer :: k

    values = 0
    do k = 1, masses%bodies
      call body_mass(masses, k, state, mass)
      associate (n => masses%coordinates(k))
        call add_block(system%pattern, masses%block(k), mass(:n, :n), values)
      end associate
    end do
  end subroutine assemble_mass

  !> By coordinate: whether any mass resists its acceleration alone.
  pure subroutine find_massive(masses, state, massive)
    type(masses_t), intent(in) :: masses
    type(state_t), intent(in) :: state
    logical, intent(out) :: massive(:)
    real(wp) :: mass(body_size, body_size)
    integer :: k, i

    massive = .false.
    do k = 1, masses%bodies
      call body_mass(masses, k, state, mass)
      do i = 1, masses%coordinates(k)
        if (mass(i, i) > 0) massive(masses%coordinate(i, k)) = .true.
      end do
    end do
  end subroutine find_massive

  !> Mass matrix of a body in its first coordinates.
  pure subroutine body_mass(masses, k, state, mass)
    type(masses_t), intent(in) :: masses
    integer, intent(in) :: k
    type(state_t), intent(in) :: state
    real(wp), intent(out) :: mass(body_size, body_size)
    real(wp), parameter :: still(6) = 0
    real(wp) :: force(6), rate(6, 6), place(6, 6)

    if (k <= masses%beams) then
      call inertia_mass(masses%beam(k), state%euler(:, masses%node(2, :, k)), &
                        state%warping(masses%node(3, :, k)), mass)
    else if (k <= masses%beams + masses%trusses) then
      mass(:6, :6) = masses%truss(:, :, k - masses%beams)
    else
      call node_inertia_forces(masses%point(k - masses%beams - masses%trusses), &
                               state%euler(:, masses%node(2, 1, k)), still, still, force, &
                               mass(:6, :6), rate, place)
    end if
  end subroutine body_mass

  !> Mass times motions, by coordinate, held ones included.
  pure subroutine mass_product(masses, state, motion, product)
    type(masses_t), intent(in) :: masses
    type(state_t), intent(in) :: state
    real(wp), intent(in) :: motion(:, :)     !< (coordinates, motions)
    real(wp), intent(out) :: product(:, :)
    real(wp) :: mass(body_size, body_size)
    integer :: k, n

    product = 0
    do k = 1, masses%bodies
      call body_mass(masses, k, state, mass)
      n = masses%coordinates(k)
      associate (at => masses%coordinate(:n, k))
        product(at, :) = product(at, :) + matmul(mass(:n, :n), motion(at, :))
      end associate
    end do
  end subroutine mass_product

  !> Centre of the mass of the members' lines: each end counts with its place and, as it is the
  !> slope d of the line that carries the rest, with d, half the sum of e x (d x e).
  pure function mass_centre(masses, state) result(centre)
    type(masses_t), intent(in) :: masses
    type(state_t), intent(in) :: state
    real(wp) :: centre(3), unit(size(state%warping)*7, 3), product(size(state%warping)*7, 3)
    integer :: i, j

    centre = 0
    if (.not. masses%total > 0) return
    unit = 0
    do j = 1, 3
      unit(j::7, j) = 1
    end do
    call mass_product(masses, state, unit, product)
    do i = 1, size(state%warping)
      centre = centre + (masses%position(:, i) + state%displacement(:, i))*product(7*i - 6, 1)
      do j = 1, 3
        centre = centre + 0.5_wp*cross(identity3(:, j), product(7*i - 3:7*i - 1, j))
      end do
    end do
    centre = centre/masses%total
  end function mass_centre

  !> Displacement and rotation of all nodes by the three translations, then the three rotations
  !> about a point.
  pure function rigid_motion(masses, state, point, coordinates) result(motion)
    type(masses_t), intent(in) :: masses
    type(state_t), intent(in) :: state
    real(wp), intent(in) :: point(3)
    integer, intent(in) :: coordinates
    real(wp) :: motion(coordinates, 6), arm(3)
    integer :: i, j, k, l

    motion = 0
    do i = 1, size(state%warping)
      arm = masses%position(:, i) + state%displacement(:, i) - point
      do j = 1, 3
        k = 1 + modulo(j, 3)
        l = 1 + modulo(k, 3)
        motion(7*i - 7 + j, j) = 1
        motion(7*i - 4 + j, 3 + j) = 1
        motion(7*i - 7 + k, 3 + j) = -arm(l)   ! e_j x arm
        motion(7*i - 7 + l, 3 + j) = arm(k)
      end do
    end do
  end function rigid_motion

end module system_inertia
