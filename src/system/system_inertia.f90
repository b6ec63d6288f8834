!> The mass of a system: inertia of its members, and the matrix of it in the system's sparsity
!> (theory 7).
module system_inertia
  use kinds, only: wp
  use model_data, only: model_t, member_t, mass_none, mass_consistent
  use nodal_state, only: state_t, coordinate_number
  use rotation, only: cross, identity3
  use beamw_inertia, only: inertia_t, new_inertia, inertia_mass
  use system_data, only: system_t
  use system_pattern, only: add_block
  implicit none
  private

  public :: masses_t, new_masses, assemble_mass, mass_product, rigid_motion, mass_centre

  !> Inertia of the members that have any.
  type :: masses_t
    integer, allocatable :: member(:)          !< their numbers
    type(inertia_t), allocatable :: inertia(:)
    integer, allocatable :: node(:, :, :)      !< (kind, end, entry)
    real(wp), allocatable :: position(:, :)    !< (3, nodes) initial
    real(wp) :: total = 0.0_wp                 !< [M]
  end type masses_t

contains

  !> Gather what has mass.
  pure subroutine new_masses(model, masses)
    type(model_t), intent(in) :: model
    type(masses_t), intent(out) :: masses
    integer :: i, k

    masses%member = pack([(i, i=1, size(model%member))], [(has_mass(model, i), i=1, &
                                                           size(model%member))])
    allocate (masses%inertia(size(masses%member)), masses%node(3, 2, size(masses%member)))
    allocate (masses%position(3, size(model%node)))
    do i = 1, size(model%node)
      masses%position(:, i) = model%node(i)%position
    end do
    do k = 1, size(masses%member)
      associate (m => model%member(masses%member(k)))
        masses%inertia(k) = member_inertia(model, m)
        masses%node(:, :, k) = m%node
        masses%total = masses%total + sum(masses%inertia(k)%line([1, 3], [1, 3]))
      end associate
    end do
  end subroutine new_masses

  pure logical function has_mass(model, i)
    type(model_t), intent(in) :: model
    integer, intent(in) :: i

    has_mass = model%member(i)%mass /= mass_none .and. &
               any(abs(line_densities(model, model%member(i))) > 0)
  end function has_mass

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

  !> The shear centre matters where alpha does: to a beam that bends and twists by a section.
  pure function member_inertia(model, member) result(inertia)
    type(model_t), intent(in) :: model
    type(member_t), intent(in) :: member
    type(inertia_t) :: inertia
    real(wp) :: centre(2)

    centre = 0
    if (member%section > 0 .and. .not. member%has_stiffness .and. .not. member%rigid) then
      centre = [model%section(member%section)%constants%ys, &
                model%section(member%section)%constants%zs]
    end if
    inertia = new_inertia(line_densities(model, member), norm2(member%chord), member%triad, &
                          centre, &
                          member%mass == mass_consistent, member%rotary)
  end function member_inertia

  !> The mass matrix at a state, by entry of the system's pattern.
  pure subroutine assemble_mass(system, masses, state, values)
    type(system_t), intent(in) :: system
    type(masses_t), intent(in) :: masses
    type(state_t), intent(in) :: state
    real(wp), intent(out) :: values(:)
    real(wp) :: mass(14, 14)
    integer :: k

    values = 0
    do k = 1, size(masses%member)
      call mass_of(masses, k, state, mass)
      call add_block(system%pattern, masses%member(k), mass, values)
    end do
  end subroutine assemble_mass

  pure subroutine mass_of(masses, k, state, mass)
    type(masses_t), intent(in) :: masses
    integer, intent(in) :: k
    type(state_t), intent(in) :: state
    real(wp), intent(out) :: mass(14, 14)

    call inertia_mass(masses%inertia(k), state%euler(:, masses%node(2, :, k)), &
                      state%warping(masses%node(3, :, k)), mass)
  end subroutine mass_of

  !> Mass times motions, by coordinate, held ones included.
  pure subroutine mass_product(masses, state, motion, product)
    type(masses_t), intent(in) :: masses
    type(state_t), intent(in) :: state
    real(wp), intent(in) :: motion(:, :)     !< (coordinates, motions)
    real(wp), intent(out) :: product(:, :)
    real(wp) :: mass(14, 14)
    integer :: k, at(14)

    product = 0
    do k = 1, size(masses%member)
      call mass_of(masses, k, state, mass)
      at = coordinate_number(reshape(masses%node([1, 1, 1, 2, 2, 2, 3], :, k), [14]), &
                             [1, 2, 3, 4, 5, 6, 7, 1, 2, 3, 4, 5, 6, 7])
      product(at, :) = product(at, :) + matmul(mass, motion(at, :))
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
