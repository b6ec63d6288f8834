!> Modes for their user: motion of the nodes, strains and stresses of the elements, and by which
!> kinds of strain the energy is stored.
module mode_results
  use kinds, only: wp
  use text, only: string_t, to_text
  use nodal_state, only: node_coordinates
  use element_base, only: element_t
  use beamw_rigidity, only: rigidity_t
  use beamw_constants, only: beamw_t, new_beamw, beamw_none, beamw_consistent
  use model_data, only: model_t, mode_fixed, mode_flexible, second_consistent
  use system_data, only: system_t
  use system_constants, only: member_rigidity
  use system_assembly, only: iterate_t
  use system_constraints, only: coordinate_scale
  use system_results, only: result_modes, joint_strains, shear_centre_shift
  use system_geometric, only: stress_increments
  use system_linear, only: matrices_t
  use system_unknowns, only: by_coordinate
  implicit none
  private

  public :: modes_t, shapes_t, new_modes, add_mode, add_complex_mode, unit_factor
  public :: largest_component, mode_kind, mode_lines

  integer, parameter, public :: energy_kinds = 6
  character(len=9), parameter, public :: energy_names(energy_kinds) = &
    ["axial    ", "torsion  ", "bending y", "bending z", "warping  ", "joints   "]

  character(len=*), parameter, public :: symmetric_part = &
    "dead moments on free rotations are not conservative: the modes are those of semitangential"// &
    " moments, with the symmetric part of the tangent"

  !> Motion and strains of modes, the mode last.
  type :: shapes_t
    real(wp), allocatable :: displacement(:, :, :)  !< (3, nodes, modes)
    real(wp), allocatable :: rotation(:, :, :)      !< (3, nodes, modes) spatial
    real(wp), allocatable :: warping(:, :)          !< (nodes, modes)
    real(wp), allocatable :: strain(:, :, :)        !< (8, members, modes)
    real(wp), allocatable :: stress(:, :, :)        !< (8, members, modes)
    real(wp), allocatable :: joint_strain(:, :, :)  !< (6, joints, modes) 0 behind the last strain
    real(wp), allocatable :: joint_stress(:, :, :)  !< (6, joints, modes)
  end type shapes_t

  !> Modes of a BUCKLING or EIGEN analysis, arrays with the mode last.
  type :: modes_t
    integer :: modes = 0
    real(wp), allocatable :: multiplier(:)          !< BUCKLING: from the present state
    real(wp), allocatable :: load_factor(:)         !< BUCKLING: present factor and multiplier
    real(wp), allocatable :: eigenvalue(:)          !< EIGEN: omega squared [T^-2]
    complex(wp), allocatable :: lambda(:)           !< EIGEN, complex: motion as exp(lambda t) [1/T]
    real(wp), allocatable :: frequency(:)           !< EIGEN: real part [1/T]; 0 if unstable
    real(wp), allocatable :: imaginary(:)           !< EIGEN: imaginary part of an unstable one
    real(wp), allocatable :: damping(:)             !< EIGEN: ratio to critical damping
    real(wp), allocatable :: displacement(:, :, :)  !< (3, nodes, modes)
    real(wp), allocatable :: rotation(:, :, :)      !< (3, nodes, modes) spatial
    real(wp), allocatable :: warping(:, :)          !< (nodes, modes)
    real(wp), allocatable :: strain(:, :, :)        !< (8, members, modes)
    real(wp), allocatable :: stress(:, :, :)        !< (8, members, modes)
    real(wp), allocatable :: joint_strain(:, :, :)  !< (6, joints, modes) 0 behind the last strain
    real(wp), allocatable :: joint_stress(:, :, :)  !< (6, joints, modes)
    real(wp), allocatable :: energy(:, :)           !< (6, modes) shares of the strain energy
    real(wp), allocatable :: participation(:, :)    !< EIGEN: (6, modes)
    real(wp), allocatable :: effective_mass(:, :)   !< EIGEN: (6, modes) [M], [M L^2]
    real(wp) :: rigid_mass(6) = 0.0_wp              !< EIGEN: all mass, inertia about the centre
    real(wp) :: centre(3) = 0.0_wp                  !< EIGEN: centre of mass [L]
    logical :: complete = .true.                    !< no eigenvalue is missing between them
    logical :: cut(2) = .false.                     !< first, last one has an equal not in the list
    type(shapes_t), allocatable :: quadrature       !< EIGEN, complex: imaginary parts
    type(matrices_t), allocatable :: matrices       !< EIGEN with MATRICES ON
    character(len=40), allocatable :: unknown(:)    !< names of their rows
    integer, allocatable :: unknown_of(:, :)        !< (2, rows) index of the node, or 0; component
  end type modes_t

contains

  !> Room for up to `most` modes.
  pure subroutine new_modes(system, most, modes)
    type(system_t), intent(in) :: system
    integer, intent(in) :: most
    type(modes_t), intent(out) :: modes

    allocate (modes%displacement(3, system%nodes, most), modes%rotation(3, system%nodes, most))
    allocate (modes%warping(system%nodes, most), modes%energy(energy_kinds, most))
    allocate (modes%strain(result_modes, system%members, most))
    allocate (modes%stress(result_modes, system%members, most))
    allocate (modes%joint_strain(joint_strains, system%joints, most))
    allocate (modes%joint_stress(joint_strains, system%joints, most))
  end subroutine new_modes

  !> Add a mode: a solution of the system, motion and multipliers.
  pure subroutine add_mode(model, system, iterate, solution, modes)
    type(model_t), intent(in) :: model
    type(system_t), intent(in) :: system
    type(iterate_t), intent(in) :: iterate
    real(wp), intent(in) :: solution(:)
    type(modes_t), intent(inout) :: modes

    call add_shape(model, system, iterate, solution, modes)
    modes%energy(:, modes%modes) = shares(modes%energy(:, modes%modes))
  end subroutine add_mode

  !> Add a complex mode; the shares of the energy are those of a period.
  pure subroutine add_complex_mode(model, system, iterate, solution, modes)
    type(model_t), intent(in) :: model
    type(system_t), intent(in) :: system
    type(iterate_t), intent(in) :: iterate
    complex(wp), intent(in) :: solution(:)
    type(modes_t), intent(inout) :: modes
    type(modes_t) :: part

    if (.not. allocated(modes%quadrature)) call new_quadrature(modes)
    call add_shape(model, system, iterate, real(solution), modes)
    call new_modes(system, 1, part)
    call add_shape(model, system, iterate, aimag(solution), part)
    associate (n => modes%modes, quadrature => modes%quadrature)
      quadrature%displacement(:, :, n) = part%displacement(:, :, 1)
      quadrature%rotation(:, :, n) = part%rotation(:, :, 1)
      quadrature%warping(:, n) = part%warping(:, 1)
      quadrature%strain(:, :, n) = part%strain(:, :, 1)
      quadrature%stress(:, :, n) = part%stress(:, :, 1)
      quadrature%joint_strain(:, :, n) = part%joint_strain(:, :, 1)
      quadrature%joint_stress(:, :, n) = part%joint_stress(:, :, 1)
      modes%energy(:, n) = shares(modes%energy(:, n) + part%energy(:, 1))
    end associate
  end subroutine add_complex_mode

  pure subroutine new_quadrature(modes)
    type(modes_t), intent(inout) :: modes

    allocate (modes%quadrature)
    allocate (modes%quadrature%displacement, mold=modes%displacement)
    allocate (modes%quadrature%rotation, mold=modes%rotation)
    allocate (modes%quadrature%warping, mold=modes%warping)
    allocate (modes%quadrature%strain, mold=modes%strain)
    allocate (modes%quadrature%stress, mold=modes%stress)
    allocate (modes%quadrature%joint_strain, mold=modes%joint_strain)
    allocate (modes%quadrature%joint_stress, mold=modes%joint_stress)
  end subroutine new_quadrature

  pure function shares(energy)
    real(wp), intent(in) :: energy(energy_kinds)
    real(wp) :: shares(energy_kinds)

    shares = energy
    if (sum(energy) > 0) shares = energy/sum(energy)
  end function shares

  !> Motion, strains, stresses, and twice the energies.
  pure subroutine add_shape(model, system, iterate, solution, modes)
    type(model_t), intent(in) :: model
    type(system_t), intent(in) :: system
    type(iterate_t), intent(in) :: iterate
    real(wp), intent(in) :: solution(:)
    type(modes_t), intent(inout) :: modes
    real(wp) :: motion(system%coordinates), stress(size(system%multiplier))
    integer :: i, k

    modes%modes = modes%modes + 1
    motion = by_coordinate(system, solution)
    do i = 1, system%nodes
      k = node_coordinates*(i - 1)
      modes%displacement(:, i, modes%modes) = motion(k + 1:k + 3)
      modes%rotation(:, i, modes%modes) = motion(k + 4:k + 6)
      modes%warping(i, modes%modes) = motion(k + 7)
    end do
    call stress_increments(system, iterate, solution, stress)
    call add_members(model, system, iterate, motion, stress, modes)
    call add_joints(system, iterate, motion, stress, modes)
  end subroutine add_shape

  !> Strains and stresses about the centroid, as of a state, and the shares of the energy, half
  !> strain times stress, about the shear centre: what St. Venant's torsion has not of the modes 2,
  !> 7 and 8 is that of warping.
  pure subroutine add_members(model, system, iterate, motion, stress, modes)
    type(model_t), intent(in) :: model
    type(system_t), intent(in) :: system
    type(iterate_t), intent(in) :: iterate
    real(wp), intent(in) :: motion(:), stress(:)
    type(modes_t), intent(inout) :: modes
    real(wp) :: strain(result_modes), force(result_modes), share(energy_kinds), shift(4)
    real(wp) :: twist(3, 3), product(result_modes), torque
    integer :: e

    share = 0
    twist = 0
    do e = 1, system%members
      associate (element => system%element(e)%e, first => system%first(e), &
                 jacobian => iterate%jacobian(system%jacobian(e) + 1:system%jacobian(e + 1)))
        strain = mode_strain(element, jacobian, motion, result_modes)
        force = stress(first + 1:first + result_modes)
      end associate
      product = strain*force
      where (system%multiplier(system%first(e) + 1:system%first(e) + result_modes) > 0) product = 0
      if (.not. like_previous(model, e)) twist = torsion_stiffness(model, e)
      torque = product(2)
      product(2) = dot_product(strain([2, 7, 8]), matmul(twist, strain([2, 7, 8])))
      share(1:2) = share(1:2) + product(1:2)
      share(3) = share(3) + sum(product(3:4))
      share(4) = share(4) + sum(product(5:6))
      share(5) = share(5) + torque + sum(product(7:8)) - product(2)
      shift = shear_centre_shift(model, e)
      strain(3:6) = strain(3:6) - shift*strain(2)
      force(2) = force(2) + dot_product(shift, force(3:6))
      modes%strain(:, e, modes%modes) = strain
      modes%stress(:, e, modes%modes) = force
    end do
    modes%energy(:, modes%modes) = share
  end subroutine add_members

  !> Whether a member has the torsion stiffness of the one before it.
  pure logical function like_previous(model, e)
    type(model_t), intent(in) :: model
    integer, intent(in) :: e

    like_previous = .false.
    if (e == 1) return
    associate (a => model%member(e - 1), b => model%member(e))
      if (a%section /= b%section .or. a%material /= b%material .or. a%second /= b%second) return
      if (a%has_stiffness .or. b%has_stiffness .or. (a%shear .neqv. b%shear)) return
      if (any(a%status /= b%status) .or. (a%rigid .neqv. b%rigid)) return
      like_previous = abs(norm2(a%chord) - norm2(b%chord)) <= 1.0e-9_wp*norm2(a%chord)
    end associate
  end function like_previous

  !> St. Venant's part of the stiffness of the modes 2, 7 and 8: what it loses without GIt.
  pure function torsion_stiffness(model, e) result(stiffness)
    type(model_t), intent(in) :: model
    integer, intent(in) :: e
    real(wp) :: stiffness(3, 3)
    type(rigidity_t) :: rigidity
    type(beamw_t) :: constants

    stiffness = 0
    associate (m => model%member(e))
      if (m%rigid .or. m%status(2) == mode_fixed .or. .not. any(m%status == mode_flexible)) return
      rigidity = member_rigidity(model, m)
      constants = new_beamw(rigidity, norm2(m%chord), &
                            merge(beamw_consistent, beamw_none, m%second == second_consistent))
      stiffness = constants%s([2, 7, 8], [2, 7, 8])
      rigidity%git = 0
      constants = new_beamw(rigidity, norm2(m%chord), &
                            merge(beamw_consistent, beamw_none, m%second == second_consistent))
      stiffness = stiffness - constants%s([2, 7, 8], [2, 7, 8])
    end associate
  end function torsion_stiffness

  !> Strains, stresses and energies of the joints.
  pure subroutine add_joints(system, iterate, motion, stress, modes)
    type(system_t), intent(in) :: system
    type(iterate_t), intent(in) :: iterate
    real(wp), intent(in) :: motion(:), stress(:)
    type(modes_t), intent(inout) :: modes
    real(wp) :: product(joint_strains)
    integer :: j, e

    modes%joint_strain(:, :, modes%modes) = 0
    modes%joint_stress(:, :, modes%modes) = 0
    do j = 1, system%joints
      e = system%members + j
      associate (element => system%element(e)%e, first => system%first(e), &
                 jacobian => iterate%jacobian(system%jacobian(e) + 1:system%jacobian(e + 1)), &
                 n => system%element(e)%e%strains)
        modes%joint_strain(:n, j, modes%modes) = mode_strain(element, jacobian, motion, n)
        modes%joint_stress(:n, j, modes%modes) = stress(first + 1:first + n)
        product = modes%joint_strain(:, j, modes%modes)*modes%joint_stress(:, j, modes%modes)
        where (system%multiplier(first + 1:first + n) > 0) product(:n) = 0
      end associate
      modes%energy(6, modes%modes) = modes%energy(6, modes%modes) + sum(product)
    end do
  end subroutine add_joints

  !> The first strains of an element.
  pure function mode_strain(element, jacobian, motion, strains) result(strain)
    class(element_t), intent(in) :: element
    real(wp), intent(in) :: jacobian(element%strains, element%coordinates), motion(:)
    integer, intent(in) :: strains
    real(wp) :: strain(strains)
    integer :: j

    strain = 0
    do j = 1, element%coordinates
      strain = strain + jacobian(:strains, j)*motion(element%coordinate(j))
    end do
  end function mode_strain

  !> Factor that makes the largest displacement 1 [L], or the largest rotation where nothing is
  !> displaced; its sign makes the largest component positive, of equal ones the first.
  pure real(wp) function unit_factor(system, solution) result(factor)
    type(system_t), intent(in) :: system
    real(wp), intent(in) :: solution(:)
    integer :: at

    at = largest_component(system, abs(solution))
    factor = 1
    if (at > 0) factor = 1/solution(at)
  end function unit_factor

  !> The unknown of the largest displacement, of equal ones the first, or of the largest rotation
  !> where nothing is displaced; 0: all are zero.
  pure integer function largest_component(system, magnitude) result(at)
    type(system_t), intent(in) :: system
    real(wp), intent(in) :: magnitude(:)   !< by unknown
    real(wp) :: scaled, largest(3)
    integer :: k, kind, first(3)

    largest = 0
    first = 0
    do k = 1, system%coordinates
      if (system%unknown(k) == 0) cycle
      kind = min(3, modulo(k - 1, node_coordinates)/3 + 1)
      if (k > node_coordinates*system%nodes) kind = 3
      scaled = magnitude(system%unknown(k))/coordinate_scale(system, k)
      if (scaled <= (1 + 1.0e-6_wp)*largest(kind)) cycle
      largest(kind) = scaled
      first(kind) = system%unknown(k)
    end do
    kind = 1
    if (largest(2) > 1.0e6_wp*largest(1)) kind = 2
    if (all(largest(1:2) <= 0)) kind = 3
    at = first(kind)
  end function largest_component

  !> "bending y 62 %, torsion 38 %": kinds with 5 % and more of the energy, the largest first.
  pure function mode_kind(energy) result(words)
    real(wp), intent(in) :: energy(energy_kinds)
    character(len=:), allocatable :: words
    real(wp) :: left(energy_kinds)
    character(len=8) :: percent
    integer :: k

    words = ""
    left = energy
    do
      k = maxloc(left, 1)
      if (left(k) < 0.05_wp) exit
      write (percent, "(i0)") nint(100*left(k))
      if (words /= "") words = words//", "
      words = words//trim(energy_names(k))//" "//trim(percent)//" %"
      left(k) = 0
    end do
    if (words == "") words = "rigid"
  end function mode_kind

  !> A table of the modes as lines of text.
  pure subroutine mode_lines(modes, line)
    type(modes_t), intent(in) :: modes
    type(string_t), allocatable, intent(out) :: line(:)
    character(len=38) :: numbers
    integer :: i

    allocate (line(modes%modes + 1))
    if (allocated(modes%multiplier)) then
      line(1)%s = "  mode     multiplier    load factor   strain energy"
    else if (allocated(modes%lambda)) then
      line(1)%s = "  mode      frequency  damping ratio   strain energy"
    else if (.not. allocated(modes%frequency)) then
      line(1)%s = "  mode   strain energy"
    else
      line(1)%s = "  mode      frequency   participation of mass in X, Y, Z   strain energy"
    end if
    do i = 1, modes%modes
      if (allocated(modes%multiplier)) then
        write (numbers, "(i6, 2a15)") i, right(modes%multiplier(i)), right(modes%load_factor(i))
        line(i + 1)%s = numbers(:36)//"   "//mode_kind(modes%energy(:, i))
      else if (allocated(modes%lambda)) then
        line(i + 1)%s = complex_line(modes, i)
      else if (.not. allocated(modes%frequency)) then
        write (numbers, "(i6)") i
        line(i + 1)%s = numbers(:6)//"   "//mode_kind(modes%energy(:, i))
      else
        line(i + 1)%s = frequency_line(modes, i)
      end if
    end do
  end subroutine mode_lines

  pure function frequency_line(modes, i) result(line)
    type(modes_t), intent(in) :: modes
    integer, intent(in) :: i
    character(len=:), allocatable :: line
    character(len=64) :: numbers
    character(len=1) :: unit

    unit = " "
    if (modes%imaginary(i) > 0) unit = "i"
    write (numbers, "(i6, 2a, 3(f9.3, ' %'))") i, right(modes%frequency(i) + modes%imaginary(i)), &
      unit, &
      100*modes%effective_mass(1:3, i)/max(modes%rigid_mass(1:3), tiny(1.0_wp))
    line = trim(numbers)//"   "//mode_kind(modes%energy(:, i))
  end function frequency_line

  pure function complex_line(modes, i) result(line)
    type(modes_t), intent(in) :: modes
    integer, intent(in) :: i
    character(len=:), allocatable :: line
    character(len=36) :: numbers

    write (numbers, "(i6, 2a15)") i, right(modes%frequency(i)), right(modes%damping(i))
    line = numbers//"   "//mode_kind(modes%energy(:, i))
    if (real(modes%lambda(i)) > 0) line = line//", grows"
  end function complex_line

  pure function right(number)
    real(wp), intent(in) :: number
    character(len=15) :: right

    right = to_text(number, 8)
    right = adjustr(right)
  end function right

end module mode_results
