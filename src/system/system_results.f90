!> What a state of the system means to its user: reactions, strains, stresses, section forces.
module system_results
  use kinds, only: wp
  use model_data, only: model_t, marker_t
  use nodal_state, only: coordinate_number, node_coordinates
  use element_base, only: element_t, max_coordinates
  use rotation, only: rotated
  use system_data, only: system_t
  use system_assembly, only: iterate_t
  use system_stress, only: point_stress
  implicit none
  private

  public :: results_t, get_results, shear_centre_shift

  integer, parameter, public :: result_modes = 8  !< strains kept of a member
  integer, parameter, public :: joint_strains = 6 !< strains kept of a joint
  character(len=10), parameter, public :: energy_names(6) = &
    ["kinetic   ", "strain    ", "loads     ", "motion    ", "dissipated", "imbalance "]

  !> Results at one state; arrays by node and by member in the order of the model.
  type :: results_t
    real(wp), allocatable :: displacement(:, :)   !< (3, nodes) [L]
    real(wp), allocatable :: euler(:, :)          !< (4, nodes) Euler parameters, scalar first
    real(wp), allocatable :: warping(:)           !< (nodes) alpha [1/L]
    real(wp), allocatable :: reaction(:, :)       !< (7, nodes) on held coordinates, else 0
    real(wp), allocatable :: load(:, :)           !< (7, nodes) forces, moments, bimoment applied
    real(wp), allocatable :: strain(:, :)         !< (8, members) generalized strains [L]
    real(wp), allocatable :: stress(:, :)         !< (8, members) their stress resultants [F]
    real(wp), allocatable :: force_p(:, :)        !< (7, members) N Vy Vz T My Mz B at end p
    real(wp), allocatable :: force_q(:, :)        !< the same at end q, on the positive face
    real(wp), allocatable :: point_stress(:, :)   !< (4, places) total, axial, bending, warping
    real(wp), allocatable :: marker(:, :)         !< (3, markers) displacement [L]
    real(wp), allocatable :: joint_strain(:, :)   !< (6, joints) [L] or [1], 0 behind the last mode
    real(wp), allocatable :: joint_stress(:, :)   !< (6, joints) [F] or [F L]
    !> Only of a motion in time, else not allocated:
    real(wp), allocatable :: velocity(:, :)       !< (7, nodes) of X Y Z, angular, of alpha
    real(wp), allocatable :: acceleration(:, :)   !< (7, nodes) their derivatives to time
    real(wp), allocatable :: joint_rate(:, :)     !< (6, joints) derivative of the strains to time
    !> Kinetic and strain energy; work since the start of loads, of prescribed motion, lost in
    !> dampers; what is missing in their balance [F L].
    real(wp), allocatable :: energy(:)
    real(wp), allocatable :: momentum(:)          !< linear and, about the origin, angular (6)
  end type results_t

contains

  !> Results of an iterate that `assemble` has just evaluated.
  pure subroutine get_results(model, system, iterate, results)
    type(model_t), intent(in) :: model
    type(system_t), intent(in) :: system
    type(iterate_t), intent(in) :: iterate
    type(results_t), intent(out) :: results
    integer :: i

    results%displacement = iterate%state%displacement
    allocate (results%euler(4, system%nodes))
    results%euler(:, :) = iterate%state%euler
    results%warping = iterate%state%warping
    call get_forces(system, iterate, results)
    call get_members(model, system, iterate, results)
    call get_joints(system, iterate, results)
    results%point_stress = point_stress(model, results%force_p, results%force_q)
    allocate (results%marker(3, size(model%marker)))
    do i = 1, size(model%marker)
      results%marker(:, i) = marker_displacement(model, model%marker(i), iterate)
    end do
  end subroutine get_results

  !> Loads and, where coordinates are held, what the support adds to balance them.
  pure subroutine get_forces(system, iterate, results)
    type(system_t), intent(in) :: system
    type(iterate_t), intent(in) :: iterate
    type(results_t), intent(inout) :: results
    real(wp) :: reaction(node_coordinates*system%nodes)
    integer :: k, e, n

    n = node_coordinates*system%nodes
    reaction = iterate%internal(:n) + iterate%constraint(:n) - iterate%external(:n)
    if (allocated(iterate%inertial)) reaction = reaction + iterate%inertial(:n)
    do k = 1, n
      if (system%unknown(k) > 0) reaction(k) = 0
    end do
    do e = system%members + system%joints + 1, size(system%element)
      associate (at => system%element(e)%e%coordinate)
        reaction(at) = reaction(at) - nodal_force(system, iterate, e, system%element(e)%e)
      end associate
    end do
    results%reaction = reshape(reaction, [node_coordinates, system%nodes])
    results%load = reshape(iterate%external(:n), [node_coordinates, system%nodes])
  end subroutine get_forces

  !> Strains and forces of the members. Strains are about the centroid: those of the shear centre
  !> ("s") taken back by the inverse of E, their stresses by its transpose (theory 4).
  pure subroutine get_members(model, system, iterate, results)
    type(model_t), intent(in) :: model
    type(system_t), intent(in) :: system
    type(iterate_t), intent(in) :: iterate
    type(results_t), intent(inout) :: results
    real(wp) :: stress(result_modes), force(max_coordinates), shift(4)
    integer :: e, first, i

    allocate (results%strain(result_modes, system%members))
    allocate (results%stress(result_modes, system%members))
    allocate (results%force_p(7, system%members), results%force_q(7, system%members))
    do e = 1, system%members
      first = system%first(e)
      stress = [(stress_resultant(system, iterate, first + i), i=1, result_modes)]
      shift = shear_centre_shift(model, e)
      results%strain(:, e) = iterate%strain(first + 1:first + result_modes)
      results%strain(3:6, e) = results%strain(3:6, e) - shift*results%strain(2, e)
      results%stress(:, e) = stress
      results%stress(2, e) = stress(2) + dot_product(shift, stress(3:6))
      force(:system%element(e)%e%coordinates) = nodal_force(system, iterate, e, system%element(e)%e)
      results%force_p(:, e) = -in_section(iterate, system%element(e)%e, 1, force(1:7))
      results%force_q(:, e) = in_section(iterate, system%element(e)%e, 2, force(8:14))
    end do
  end subroutine get_members

  !> Strains of the joints and their stress resultants.
  pure subroutine get_joints(system, iterate, results)
    type(system_t), intent(in) :: system
    type(iterate_t), intent(in) :: iterate
    type(results_t), intent(inout) :: results
    integer :: i, j, k

    allocate (results%joint_strain(joint_strains, system%joints))
    allocate (results%joint_stress(joint_strains, system%joints))
    results%joint_strain = 0
    results%joint_stress = 0
    do j = 1, system%joints
      k = system%first(system%members + j)
      do i = 1, system%element(system%members + j)%e%strains
        results%joint_strain(i, j) = iterate%strain(k + i)
        results%joint_stress(i, j) = stress_resultant(system, iterate, k + i)
      end do
    end do
  end subroutine get_joints

  !> Stress resultant of a strain: its multiplier, or the elastic part and the viscous one.
  pure real(wp) function stress_resultant(system, iterate, k) result(stress)
    type(system_t), intent(in) :: system
    type(iterate_t), intent(in) :: iterate
    integer, intent(in) :: k

    stress = iterate%elastic(k)
    if (allocated(iterate%viscous)) stress = stress + iterate%viscous(k)
    if (system%multiplier(k) > 0) stress = iterate%stress(k)
  end function stress_resultant

  !> Column 2 of E, rows 3 to 6.
  pure function shear_centre_shift(model, e) result(shift)
    type(model_t), intent(in) :: model
    integer, intent(in) :: e
    real(wp) :: shift(4)

    shift = 0
    associate (m => model%member(e))
      if (m%section == 0 .or. m%has_stiffness .or. m%rigid) return
      associate (c => model%section(m%section)%constants)
        shift = [-c%ys, c%ys, -c%zs, c%zs]/norm2(m%chord)
      end associate
    end associate
  end function shear_centre_shift

  !> Forces of an element on its coordinates, multipliers included.
  pure function nodal_force(system, iterate, e, element) result(force)
    type(system_t), intent(in) :: system
    type(iterate_t), intent(in) :: iterate
    integer, intent(in) :: e
    class(element_t), intent(in) :: element
    real(wp) :: force(element%coordinates), stress(element%strains)
    integer :: i, k, offset

    offset = system%jacobian(e)
    k = system%first(e)
    stress = [(stress_resultant(system, iterate, k + i), i=1, element%strains)]
    do i = 1, element%coordinates
      force(i) = dot_product(stress, iterate%jacobian(offset + 1:offset + element%strains))
      offset = offset + element%strains
    end do
  end function nodal_force

  !> Force, moment, bimoment on an end in the axes of its section as it is turned now.
  pure function in_section(iterate, element, e, force) result(local)
    type(iterate_t), intent(in) :: iterate
    class(element_t), intent(in) :: element
    integer, intent(in) :: e
    real(wp), intent(in) :: force(7)
    real(wp) :: local(7), triad(3, 3)

    triad = rotated(iterate%state%euler(:, element%section_node(e)), element%triad)
    local(1:3) = matmul(force(1:3), triad)
    local(4:6) = matmul(force(4:6), triad)
    local(7) = force(7)
  end function in_section

  !> Displacement of a point fixed to a section, warping included where omega is known.
  pure function marker_displacement(model, marker, iterate) result(u)
    type(model_t), intent(in) :: model
    type(marker_t), intent(in) :: marker
    type(iterate_t), intent(in) :: iterate
    real(wp) :: u(3), triad(3, 3), start(3)
    integer :: e, node(3)

    node = marker%node
    if (marker%member > 0) then
      associate (m => model%member(marker%member))
        e = merge(1, 2, m%node(1, 1) == marker%node)
        node = m%node(:, e)
        triad = rotated(iterate%state%euler(:, node(2)), m%triad)
        start = marker%offset(1)*m%triad(:, 2) + marker%offset(2)*m%triad(:, 3)
        u = iterate%state%displacement(:, node(1)) - start &
            + marker%offset(1)*triad(:, 2) + marker%offset(2)*triad(:, 3)
        if (marker%omega_known) u = u - marker%omega*iterate%state%warping(node(3))*triad(:, 1)
      end associate
    else
      u = iterate%state%displacement(:, node(1))
    end if
  end function marker_displacement

end module system_results
