!> One pass over the elements: matrix, internal forces, strains and estimates of their round-off.
!>
!> Newton in mixed form (theory 8): the geometric stiffness takes the stress resultants that are
!> iterated beside the coordinates, the forces those of the strains.
module system_assembly
  use kinds, only: wp
  use nodal_state, only: state_t, new_state, coordinate_number, node_coordinates
  use element_base, only: element_t, max_strains, max_coordinates
  use system_data, only: system_t
  use system_pattern, only: add_block
  use system_loads, only: add_loads
  use system_motion, only: set_targets
  use system_rotation, only: add_rotation, spin_at
  implicit none
  private

  public :: iterate_t, new_iterate, assemble, assemble_elements, assemble_loads, multiply

  !> Where the iteration stands; what `assemble` leaves is about `state` as it was then.
  type :: iterate_t
    type(state_t) :: state
    real(wp), allocatable :: stress(:)      !< iterated stress resultants and multipliers, by strain
    real(wp), allocatable :: strain(:)      !< by strain, of the last assembly [L]
    real(wp), allocatable :: target(:)      !< by strain: where a held one is to be
    real(wp), allocatable :: elastic(:)     !< law times strain, zero for fixed strains
    real(wp), allocatable :: jacobian(:)    !< of all elements, one behind the other
    real(wp), allocatable :: internal(:)    !< by coordinate: forces of the strains' stresses
    real(wp), allocatable :: constraint(:)  !< by coordinate: forces of the multipliers
    real(wp), allocatable :: external(:)    !< by coordinate: loads
    real(wp), allocatable :: noise(:)       !< by coordinate: round-off of the forces, at rest only
    real(wp), allocatable :: values(:)      !< entries of the matrix
    !> Only of a motion in time, else not allocated: velocities by coordinate, given; rates of the
    !> strains and their viscous stress resultants, found.
    real(wp), allocatable :: velocity(:), rate(:), viscous(:)
    real(wp) :: velocity_share = 0.0_wp     !< change of the velocities with the coordinates [1/T]
    real(wp), allocatable :: inertial(:)    !< by coordinate: inertia forces, of a motion in time
    logical :: keeps_matrix = .false.       !< the next assembly leaves `values` and `noise` alone
    !> and takes strains and Jacobian as `advance` left them, of elements that hold no strain
    logical :: keeps_strains = .false.
    integer :: invalid = 0                  !< an element rotated beyond its range; 0: none
  end type iterate_t

contains

  !> The undeformed state, without stress.
  pure subroutine new_iterate(system, iterate)
    type(system_t), intent(in) :: system
    type(iterate_t), intent(out) :: iterate
    integer :: strains

    call new_state(system%nodes, system%coordinates - node_coordinates*system%nodes, &
                   system%angles, iterate%state)
    strains = size(system%multiplier)
    allocate (iterate%stress(strains), iterate%strain(strains), iterate%elastic(strains))
    allocate (iterate%target(strains))
    allocate (iterate%jacobian(system%jacobian(size(system%jacobian))))
    allocate (iterate%internal(system%coordinates))
    allocate (iterate%constraint(system%coordinates), iterate%external(system%coordinates))
    allocate (iterate%noise(system%coordinates), iterate%values(size(system%pattern%row)))
    iterate%stress = 0
    iterate%strain = 0
    iterate%elastic = 0
    iterate%target = 0
  end subroutine new_iterate

  !> Evaluate all elements and loads at the present state with the patterns at `level`.
  pure subroutine assemble(system, level, iterate)
    type(system_t), intent(in) :: system
    real(wp), intent(in) :: level(:)
    type(iterate_t), intent(inout) :: iterate

    call assemble_elements(system, iterate)
    if (iterate%invalid > 0) return
    if (size(system%drive) > 0) call set_targets(system, level, iterate%target)
    call assemble_loads(system, level, iterate%state, iterate%external, iterate%values)
  end subroutine assemble

  !> The elements alone: what their strains and stresses make, no loads.
  pure subroutine assemble_elements(system, iterate)
    type(system_t), intent(in) :: system
    type(iterate_t), intent(inout) :: iterate
    integer :: e

    iterate%internal = 0
    iterate%constraint = 0
    iterate%external = 0
    if (.not. iterate%keeps_matrix) then
      iterate%noise = 0
      iterate%values = 0
    end if
    iterate%invalid = 0
    do e = 1, size(system%element)
      associate (jacobian => iterate%jacobian(system%jacobian(e) + 1:system%jacobian(e + 1)))
        call assemble_element(system, e, system%element(e)%e, jacobian, iterate)
      end associate
      if (iterate%invalid > 0) return
    end do
  end subroutine assemble_elements

  !> Add the loads and, in a frame that turns, the centrifugal forces, and their tangent.
  pure subroutine assemble_loads(system, level, state, external, values)
    type(system_t), intent(in) :: system
    real(wp), intent(in) :: level(:)
    type(state_t), intent(in) :: state
    real(wp), intent(inout) :: external(:), values(:)

    call add_loads(system, state, level, external, values)
    if (size(system%rotor) == 0) return
    call add_rotation(system, state, spin_at(system, level), external, values)
  end subroutine assemble_loads

  !> One element. The work arrays have a fixed size, because automatic ones would be allocated.
  pure subroutine assemble_element(system, e, element, jacobian, iterate)
    type(system_t), intent(in) :: system
    integer, intent(in) :: e
    class(element_t), intent(in) :: element
    real(wp), intent(inout) :: jacobian(element%strains, element%coordinates)
    type(iterate_t), intent(inout) :: iterate
    real(wp), dimension(max_strains) :: strain, stress
    real(wp) :: law(max_strains**2), tangent(max_coordinates**2)
    integer :: first, last, n, part
    logical :: valid, holds

    n = element%strains
    first = system%first(e) + 1
    last = system%first(e + 1)
    holds = any(element%fixed)
    if (iterate%keeps_strains .and. .not. holds) then
      strain(:n) = iterate%strain(first:last)
    else
      stress = 0
      if (.not. iterate%keeps_matrix) stress(:n) = iterate%stress(first:last)
      if (allocated(element%part)) then
        call evaluate_part(element, size(element%part, 1), iterate%state, stress, part, strain, &
                           jacobian, tangent, valid)
      else
        call element%evaluate(iterate%state, stress, strain, jacobian, tangent, valid)
      end if
      if (.not. valid) then
        iterate%invalid = e
        return
      end if
      iterate%strain(first:last) = strain(:n)
    end if
    call element%law(law)
    call multiply(n, law, strain, stress)
    stress(:n) = stress(:n) + system%initial_stress(first:last)
    iterate%elastic(first:last) = stress(:n)
    if (allocated(iterate%velocity)) then
      if (element%damped .or. holds .or. e > system%members) then
        call add_damping(element, first, jacobian, iterate, law)
      end if
      if (element%damped) stress(:n) = stress(:n) + iterate%viscous(first:last)
    end if
    call add_forces(system, element, first, jacobian, stress, iterate)
    if (iterate%keeps_matrix) return
    if (allocated(element%part)) then
      associate (at => element%part(:, part))
        call add_tangent(system, e, system%parts(e) + part, size(at), element%coordinate(at), &
                         jacobian(:, at), law, tangent, iterate)
      end associate
    else
      call add_tangent(system, e, e, element%coordinates, element%coordinate, jacobian, law, &
                       tangent, iterate)
    end if
  end subroutine assemble_element

  !> One part of an element; its Jacobian among that of all coordinates.
  pure subroutine evaluate_part(element, n, state, stress, part, strain, jacobian, tangent, valid)
    class(element_t), intent(in) :: element
    integer, intent(in) :: n               !< coordinates of a part
    type(state_t), intent(in) :: state
    real(wp), intent(in) :: stress(element%strains)
    integer, intent(out) :: part
    real(wp), intent(out) :: strain(element%strains)
    real(wp), intent(out) :: jacobian(element%strains, element%coordinates), tangent(n, n)
    logical, intent(out) :: valid
    real(wp) :: mine(element%strains, n)

    call element%evaluate_part(state, stress, part, strain, mine, tangent, valid)
    if (.not. valid) return
    jacobian = 0
    jacobian(:, element%part(:, part)) = mine
  end subroutine evaluate_part

  !> Add the tangent of an element, for its coordinates or those of a part.
  pure subroutine add_tangent(system, e, block, n, at, jacobian, law, tangent, iterate)
    type(system_t), intent(in) :: system
    integer, intent(in) :: e, block
    integer, intent(in) :: n, at(n)        !< coordinates, and their numbers
    real(wp), intent(in) :: jacobian(system%element(e)%e%strains, n)
    real(wp), intent(in) :: law(system%element(e)%e%strains**2)
    real(wp), intent(inout) :: tangent(n, n)
    type(iterate_t), intent(inout) :: iterate

    associate (element => system%element(e)%e)
      call add_stiffness(element%strains, n, jacobian, law, tangent)
      if (.not. allocated(iterate%velocity)) then
        call add_noise(element, system%first(e) + 1, n, at, jacobian, tangent, iterate)
      end if
      call add_element(system, e, block, n, tangent, jacobian, iterate%values)
    end associate
  end subroutine add_tangent

  !> Matrix times vector of an element, most of whose entries are zero.
  pure subroutine multiply(n, matrix, vector, product)
    integer, intent(in) :: n
    real(wp), intent(in) :: matrix(n, n), vector(n)
    real(wp), intent(out) :: product(n)
    integer :: j

    product = 0
    do j = 1, n
      if (abs(vector(j)) > 0) product = product + matrix(:, j)*vector(j)
    end do
  end subroutine multiply

  !> Forces of the stresses and of the multipliers.
  pure subroutine add_forces(system, element, first, jacobian, stress, iterate)
    type(system_t), intent(in) :: system
    class(element_t), intent(in) :: element
    integer, intent(in) :: first
    real(wp), intent(in) :: jacobian(element%strains, element%coordinates)
    real(wp), intent(in) :: stress(element%strains)
    type(iterate_t), intent(inout) :: iterate
    integer :: i, j

    associate (at => element%coordinate)
      do j = 1, element%coordinates
        iterate%internal(at(j)) = iterate%internal(at(j)) + dot_product(stress, jacobian(:, j))
      end do
      do i = 1, element%strains
        if (system%multiplier(first + i - 1) == 0) cycle
        do j = 1, element%coordinates
          iterate%constraint(at(j)) = iterate%constraint(at(j)) &
                                      + iterate%stress(first + i - 1)*jacobian(i, j)
        end do
      end do
    end associate
  end subroutine add_forces

  !> tangent + D' S D, column by column below the diagonal; most entries of S are zero.
  pure subroutine add_stiffness(strains, n, jacobian, law, tangent)
    integer, intent(in) :: strains, n
    real(wp), intent(in) :: jacobian(strains, n)
    real(wp), intent(in) :: law(strains, strains)
    real(wp), intent(inout) :: tangent(n, n)
    real(wp), dimension(max_coordinates, max_strains) :: row, product
    integer :: i, j

    do j = 1, n
      row(j, :strains) = jacobian(:, j)
    end do
    do j = 1, strains
      product(:n, j) = 0
      do i = 1, strains
        if (abs(law(i, j)) > 0) product(:n, j) = product(:n, j) + row(:n, i)*law(i, j)
      end do
    end do
    do j = 1, n
      do i = 1, strains
        if (abs(row(j, i)) > 0) tangent(j:, j) = tangent(j:, j) + product(j:n, i)*row(j, i)
      end do
      do i = j + 1, n
        tangent(j, i) = tangent(i, j)
      end do
    end do
  end subroutine add_stiffness

  !> Round-off to expect in the forces of an element: from its coordinates by the tangent, and from
  !> the stresses and multipliers that the forces add up.
  pure subroutine add_noise(element, first, n, at, jacobian, tangent, iterate)
    class(element_t), intent(in) :: element
    integer, intent(in) :: first
    integer, intent(in) :: n, at(n)        !< coordinates, and their numbers
    real(wp), intent(in) :: jacobian(element%strains, n)
    real(wp), intent(in) :: tangent(n, n)
    type(iterate_t), intent(inout) :: iterate
    real(wp) :: size_of(max_coordinates), stress(max_strains)
    integer :: j

    call coordinate_sizes(element, n, at, iterate%state, size_of)
    stress(:element%strains) = epsilon(1.0_wp)* &
                               abs(iterate%stress(first:first + element%strains - 1))
    do j = 1, n
      associate (noise => iterate%noise(at(j)))
        noise = noise + dot_product(abs(tangent(:, j)), size_of(:n)) &
                + dot_product(abs(jacobian(:, j)), stress(:element%strains))
      end associate
    end do
  end subroutine add_noise

  !> Rates of the strains and viscous stresses; the law gains what the velocities add to it.
  pure subroutine add_damping(element, first, jacobian, iterate, law)
    class(element_t), intent(in) :: element
    integer, intent(in) :: first
    real(wp), intent(in) :: jacobian(element%strains, element%coordinates)
    type(iterate_t), intent(inout) :: iterate
    real(wp), intent(inout) :: law(element%strains, element%strains)
    real(wp) :: viscosity(max_strains**2), rate(max_strains)
    integer :: i, n

    n = element%strains
    rate = 0
    do i = 1, element%coordinates
      rate(:n) = rate(:n) + jacobian(:, i)*iterate%velocity(element%coordinate(i))
    end do
    iterate%rate(first:first + n - 1) = rate(:n)
    if (.not. element%damped) return
    call element%damping(viscosity)
    call multiply(n, viscosity, rate, iterate%viscous(first))
    law = law + iterate%velocity_share*reshape(viscosity(:n**2), [n, n])
  end subroutine add_damping

  !> What round-off in a coordinate is relative to: displacements and the element's size, one
  !> radian, alpha.
  pure subroutine coordinate_sizes(element, n, at, state, size_of)
    class(element_t), intent(in) :: element
    integer, intent(in) :: n, at(n)
    type(state_t), intent(in) :: state
    real(wp), intent(out) :: size_of(n)
    integer :: i, node, component

    do i = 1, n
      node = (at(i) - 1)/node_coordinates + 1
      component = at(i) - node_coordinates*(node - 1)
      size_of(i) = 1
      if (node > size(state%warping)) then
        size_of(i) = element%size
      else if (component <= 3) then
        size_of(i) = element%size + abs(state%displacement(component, node))
      else if (component == 7) then
        size_of(i) = abs(state%warping(node))
      end if
    end do
    size_of = epsilon(1.0_wp)*size_of
  end subroutine coordinate_sizes

  !> Add an element's tangent and constraint rows to the entries.
  pure subroutine add_element(system, e, block, n, tangent, jacobian, values)
    type(system_t), intent(in) :: system
    integer, intent(in) :: e, block, n
    real(wp), intent(in) :: tangent(n, n)
    real(wp), intent(in) :: jacobian(:, :)
    real(wp), intent(inout) :: values(:)
    real(wp) :: bordered(max_coordinates + max_strains, max_coordinates + max_strains)
    integer :: i, j, row, width

    width = system%pattern%width(block)
    if (width == n) then
      call add_block(system%pattern, block, tangent, values)
      return
    end if
    do j = 1, n
      bordered(:n, j) = tangent(:, j)
    end do
    bordered(n + 1:width, n + 1:width) = 0
    row = n
    do i = 1, size(jacobian, 1)
      if (system%multiplier(system%first(e) + i) == 0) cycle
      row = row + 1
      bordered(row, :n) = jacobian(i, :)
      bordered(:n, row) = jacobian(i, :)
    end do
    call add_block(system%pattern, block, bordered(:width, :width), values)
  end subroutine add_element

end module system_assembly
