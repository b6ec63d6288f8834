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
  use system_results, only: result_modes, shear_centre_shift
  use system_geometric, only: stress_increments
  implicit none
  private

  public :: modes_t, new_modes, add_mode, by_coordinate, unit_factor, mode_kind, mode_lines

  integer, parameter, public :: energy_kinds = 5
  character(len=9), parameter, public :: energy_names(energy_kinds) = &
    ["axial    ", "torsion  ", "bending y", "bending z", "warping  "]

  character(len=*), parameter, public :: symmetric_part = &
    "dead moments on free rotations are not conservative: the modes are those of semitangential"// &
    " moments, with the symmetric part of the tangent"

  !> Modes of a BUCKLING or EIGEN analysis, arrays with the mode last.
  type :: modes_t
    integer :: modes = 0
    real(wp), allocatable :: multiplier(:)          !< BUCKLING: from the present state
    real(wp), allocatable :: load_factor(:)         !< BUCKLING: present factor and multiplier
    real(wp), allocatable :: eigenvalue(:)          !< EIGEN: omega squared [T^-2]
    real(wp), allocatable :: frequency(:)           !< EIGEN: real part [1/T]; 0 if unstable
    real(wp), allocatable :: imaginary(:)           !< EIGEN: imaginary part of an unstable one
    real(wp), allocatable :: displacement(:, :, :)  !< (3, nodes, modes)
    real(wp), allocatable :: rotation(:, :, :)      !< (3, nodes, modes) spatial
    real(wp), allocatable :: warping(:, :)          !< (nodes, modes)
    real(wp), allocatable :: strain(:, :, :)        !< (8, members, modes)
    real(wp), allocatable :: stress(:, :, :)        !< (8, members, modes)
    real(wp), allocatable :: energy(:, :)           !< (5, modes) shares of the strain energy
    real(wp), allocatable :: participation(:, :)    !< EIGEN: (6, modes)
    real(wp), allocatable :: effective_mass(:, :)   !< EIGEN: (6, modes) [M], [M L^2]
    real(wp) :: rigid_mass(6) = 0.0_wp              !< EIGEN: all mass, inertia about the centre
    real(wp) :: centre(3) = 0.0_wp                  !< EIGEN: centre of mass [L]
    logical :: complete = .true.                    !< no eigenvalue is missing between them
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
  end subroutine new_modes

  !> Add a mode: a solution of the system, motion and multipliers.
  pure subroutine add_mode(model, system, iterate, solution, modes)
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
  end subroutine add_mode

  !> A solution's entries of the coordinates, zero where held.
  pure function by_coordinate(system, solution) result(motion)
    type(system_t), intent(in) :: system
    real(wp), intent(in) :: solution(:)
    real(wp) :: motion(system%coordinates)
    integer :: k

    do k = 1, system%coordinates
      motion(k) = 0
      if (system%unknown(k) > 0) motion(k) = solution(system%unknown(k))
    end do
  end function by_coordinate

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
    real(wp) :: twist(3, 3), product(result_modes)
    integer :: e

    share = 0
    twist = 0
    do e = 1, system%members
      associate (element => system%element(e)%e, first => system%first(e), &
                 jacobian => iterate%jacobian(system%jacobian(e) + 1:system%jacobian(e + 1)))
        strain = mode_strain(element, jacobian, motion)
        force = stress(first + 1:first + result_modes)
      end associate
      product = strain*force
      if (.not. like_previous(model, e)) twist = torsion_stiffness(model, e)
      product(2) = dot_product(strain([2, 7, 8]), matmul(twist, strain([2, 7, 8])))
      share(1:2) = share(1:2) + product(1:2)
      share(3) = share(3) + sum(product(3:4))
      share(4) = share(4) + sum(product(5:6))
      share(5) = share(5) + strain(2)*force(2) + sum(product(7:8)) - product(2)
      shift = shear_centre_shift(model, e)
      strain(3:6) = strain(3:6) - shift*strain(2)
      force(2) = force(2) + dot_product(shift, force(3:6))
      modes%strain(:, e, modes%modes) = strain
      modes%stress(:, e, modes%modes) = force
    end do
    if (sum(share) > 0) share = share/sum(share)
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

  pure function mode_strain(element, jacobian, motion) result(strain)
    class(element_t), intent(in) :: element
    real(wp), intent(in) :: jacobian(element%strains, element%coordinates), motion(:)
    real(wp) :: strain(result_modes)
    integer :: j

    strain = 0
    do j = 1, element%coordinates
      strain = strain + jacobian(:result_modes, j)*motion(element%coordinate(j))
    end do
  end function mode_strain

  !> Factor that makes the largest displacement 1 [L], or the largest rotation where nothing is
  !> displaced; its sign makes the largest component positive, of equal ones the first.
  pure function unit_factor(system, solution) result(factor)
    type(system_t), intent(in) :: system
    real(wp), intent(in) :: solution(:)
    real(wp) :: factor, scaled, largest(3), signed(3)
    integer :: k, kind

    largest = 0
    signed = 1
    do k = 1, system%coordinates
      if (system%unknown(k) == 0) cycle
      kind = min(3, modulo(k - 1, node_coordinates)/3 + 1)
      if (k > node_coordinates*system%nodes) kind = 3
      scaled = solution(system%unknown(k))/coordinate_scale(system, k)
      if (abs(scaled) <= (1 + 1.0e-6_wp)*largest(kind)) cycle
      largest(kind) = abs(scaled)
      signed(kind) = solution(system%unknown(k))
    end do
    kind = 1
    if (largest(2) > 1.0e6_wp*largest(1)) kind = 2
    if (all(largest(1:2) <= 0)) kind = 3
    factor = 1/signed(kind)
  end function unit_factor

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
    else if (.not. allocated(modes%frequency)) then
      line(1)%s = "  mode   strain energy"
    else
      line(1)%s = "  mode      frequency   participation of mass in X, Y, Z   strain energy"
    end if
    do i = 1, modes%modes
      if (allocated(modes%multiplier)) then
        write (numbers, "(i6, 2a15)") i, right(modes%multiplier(i)), right(modes%load_factor(i))
        line(i + 1)%s = numbers(:36)//"   "//mode_kind(modes%energy(:, i))
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

  pure function right(number)
    real(wp), intent(in) :: number
    character(len=15) :: right

    right = to_text(number, 8)
    right = adjustr(right)
  end function right

end module mode_results
