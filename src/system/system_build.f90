!> From the model to the system: elements, unknowns, loads, sparsity.
module system_build
  use kinds, only: wp
  use model_data, only: model_t, member_t, load_t, mode_released, mass_none, mass_consistent, &
                        components
  use nodal_state, only: coordinate_number, node_coordinates
  use system_data, only: system_t, dead_load_t
  use system_elements, only: make_elements
  use system_motion, only: make_motions
  use system_pattern, only: find_pattern
  implicit none
  private

  public :: build_system, find_system_pattern, number_multipliers

contains

  !> The system of a checked model; its pattern is found later, when the constraints are known.
  subroutine build_system(model, system)
    type(model_t), intent(in) :: model
    type(system_t), intent(out) :: system
    logical, allocatable :: twists(:)

    system%nodes = size(model%node)
    system%members = size(model%member)
    system%length = model_size(model)
    system%joints = size(model%joint)
    allocate (twists(system%nodes), system%timed(size(model%pattern)))
    system%timed = .false.
    call make_elements(model, system, twists)
    call number_strains(system)
    if (allocated(model%function)) then
      system%function = model%function
    else
      allocate (system%function(0))
    end if
    call make_motions(model, system)
    call number_coordinates(model, twists, system)
    call number_multipliers(system)
    call make_loads(model, system)
  end subroutine build_system

  !> Largest extent of the nodes' positions [L].
  pure function model_size(model) result(length)
    type(model_t), intent(in) :: model
    real(wp) :: length
    integer :: i

    length = 0
    do i = 1, 3
      length = max(length, maxval(model%node%position(i)) - minval(model%node%position(i)))
    end do
    do i = 1, size(model%member)
      length = max(length, maxval(abs(model%member(i)%chord)))
    end do
    if (.not. length > 0) length = 1  ! rotational nodes only
  end function model_size

  pure subroutine number_strains(system)
    type(system_t), intent(inout) :: system
    integer :: i

    allocate (system%first(size(system%element) + 1), system%jacobian(size(system%element) + 1))
    system%first(1) = 0
    system%jacobian(1) = 0
    do i = 1, size(system%element)
      associate (element => system%element(i)%e)
        system%first(i + 1) = system%first(i) + element%strains
        system%jacobian(i + 1) = system%jacobian(i) + element%strains*element%coordinates
      end associate
    end do
    allocate (system%multiplier(system%first(size(system%first))))
    allocate (system%dropped(size(system%multiplier)))
    system%multiplier = 0
    system%dropped = .false.
  end subroutine number_strains

  !> An unknown for every coordinate that an element uses and nothing holds.
  pure subroutine number_coordinates(model, twists, system)
    type(model_t), intent(in) :: model
    logical, intent(in) :: twists(:)
    type(system_t), intent(inout) :: system
    integer :: i, k

    allocate (system%unknown(system%coordinates), system%used(system%coordinates))
    system%used = .false.
    system%unknown = 0
    do i = 1, size(system%element)
      system%used(system%element(i)%e%coordinate) = .true.
    end do
    do i = 1, system%nodes
      system%used(coordinate_number(i, components)) = twists(i)
    end do
    do k = 1, system%coordinates
      if (.not. system%used(k)) cycle
      if (is_held(model, system, k)) cycle
      system%unknowns = system%unknowns + 1
      system%unknown(k) = system%unknowns
    end do
  end subroutine number_coordinates

  !> Fixed directly; of a rotation two components at least, and no motion: the third is then a turn
  !> about an axis that does not move, and the two hold without a constraint.
  pure logical function is_held(model, system, coordinate)
    type(model_t), intent(in) :: model
    type(system_t), intent(in) :: system
    integer, intent(in) :: coordinate
    integer :: node, component

    is_held = .false.
    if (coordinate > node_coordinates*size(model%node)) return
    node = (coordinate - 1)/node_coordinates + 1
    component = coordinate - node_coordinates*(node - 1)
    is_held = model%node(node)%fixed(component)
    if (component >= 4 .and. component <= 6) then
      is_held = is_held .and. all(system%holder(4:6, node) == 0)
    end if
  end function is_held

  !> A multiplier for each fixed strain that is not dropped.
  pure subroutine number_multipliers(system)
    type(system_t), intent(inout) :: system
    integer :: e, i

    system%multipliers = 0
    system%multiplier = 0
    do e = 1, size(system%element)
      do i = 1, system%element(e)%e%strains
        if (.not. system%element(e)%e%fixed(i) .or. system%dropped(system%first(e) + i)) cycle
        system%multipliers = system%multipliers + 1
        system%multiplier(system%first(e) + i) = system%unknowns + system%multipliers
      end do
    end do
  end subroutine number_multipliers

  !> Loads of all patterns; gravity becomes one load at each end of each member with mass.
  subroutine make_loads(model, system)
    type(model_t), intent(in) :: model
    type(system_t), intent(inout) :: system
    integer :: p, i, n

    n = 0
    do p = 1, size(model%pattern)
      n = n + model%pattern(p)%loads
      if (has_gravity(model, p)) n = n + 2*count(line_mass_given(model, [(i, i=1, system%members)]))
    end do
    allocate (system%load(n))
    n = 0
    do p = 1, size(model%pattern)
      do i = 1, model%pattern(p)%loads
        n = n + 1
        system%load(n) = point_load(model, model%pattern(p)%load(i), p)
      end do
      if (.not. has_gravity(model, p)) cycle
      do i = 1, system%members
        if (.not. line_mass_given(model, i)) cycle
        system%load(n + 1:n + 2) = weight_loads(model, model%member(i), p)
        call lean_with_releases(model%member(i), system%element(i)%e%coordinate, &
                                system%load(n + 1:n + 2))
        n = n + 2
      end do
    end do
  end subroutine make_loads

  pure logical function has_gravity(model, p)
    type(model_t), intent(in) :: model
    integer, intent(in) :: p

    has_gravity = any(abs(model%pattern(p)%gravity) > 0)
  end function has_gravity

  !> Whether a member has mass.
  elemental logical function line_mass_given(model, i)
    type(model_t), intent(in) :: model
    integer, intent(in) :: i

    line_mass_given = model%member(i)%mass /= mass_none .and. line_mass(model, model%member(i)) > 0
  end function line_mass_given

  !> Mass per length [M L^-1].
  pure function line_mass(model, member)
    type(model_t), intent(in) :: model
    type(member_t), intent(in) :: member
    real(wp) :: line_mass

    line_mass = 0
    if (member%has_inertia) then
      line_mass = member%inertia(1)
    else if (member%section > 0 .and. member%material > 0) then
      line_mass = model%section(member%section)%constants%a*model%material(member%material)%rho
    end if
  end function line_mass

  !> Dead weight: half at each end; with the consistent mass at the arms l0/6 d that stand for
  !> the end moments of the Hermite interpolation, d = eX + alpha s (theory 6, 7).
  pure function weight_loads(model, member, pattern) result(load)
    type(model_t), intent(in) :: model
    type(member_t), intent(in) :: member
    integer, intent(in) :: pattern
    type(dead_load_t) :: load(2)
    real(wp) :: length, s(3)
    integer :: e

    length = norm2(member%chord)
    s = 0
    if (member%section > 0 .and. .not. member%has_stiffness) then
      associate (c => model%section(member%section)%constants)
        s = c%zs*member%triad(:, 2) - c%ys*member%triad(:, 3)
      end associate
    end if
    do e = 1, 2
      load(e)%pattern = pattern
      load(e)%node = member%node(:, e)
      load(e)%force = 0.5_wp*length*line_mass(model, member)*model%pattern(pattern)%gravity
      if (member%mass /= mass_consistent) cycle
      load(e)%arm = (3 - 2*e)*length/6*member%triad(:, 1)
      load(e)%warp = (3 - 2*e)*length/6*s
    end do
  end function weight_loads

  !> At an end with released bending the beam's own direction is not that of the node: the arm leans
  !> by the released angles, ay = rel5/l0, az = -rel3/l0 at p and opposite at q.
  pure subroutine lean_with_releases(member, coordinate, load)
    type(member_t), intent(in) :: member
    integer, intent(in) :: coordinate(:)  !< its element: 14 of the nodes, then the releases
    type(dead_load_t), intent(inout) :: load(2)
    integer :: e, i, mode

    if (member%mass /= mass_consistent .or. size(coordinate) == 14) return
    do e = 1, 2
      do i = 1, 2
        mode = 6 + e - 2*i  ! towards y: 5, 6; towards z: 3, 4
        if (member%status(mode) /= mode_released) cycle
        load(e)%lean(i) = coordinate(14 + count(member%status(:mode) == mode_released))
        load(e)%lean_rate(i) = (3 - 2*e)*(3 - 2*i)/norm2(member%chord)
      end do
      load(e)%axes = (3 - 2*e)*norm2(member%chord)/6*member%triad(:, 2:3)
    end do
  end subroutine lean_with_releases

  !> A load of a card.
  pure function point_load(model, card, pattern) result(load)
    type(model_t), intent(in) :: model
    type(load_t), intent(in) :: card
    integer, intent(in) :: pattern
    type(dead_load_t) :: load

    load%pattern = pattern
    load%function = card%function
    load%node = card%node
    load%force = card%force
    load%moment = card%moment
    load%bimoment = card%bimoment
    load%follower = card%follower
    if (card%marker == 0) return
    associate (point => model%point(card%marker))
      if (point%member == 0) return
      associate (m => model%member(point%member))
        load%node = m%node(:, merge(1, 2, m%node(1, 1) == card%node))
        load%arm = point%offset(1)*m%triad(:, 2) + point%offset(2)*m%triad(:, 3)
        if (point%omega_known) load%warp = -point%omega*m%triad(:, 1)
      end associate
    end associate
  end function point_load

  !> Sparsity with a block for each element, coordinates then multipliers, and for each load, the
  !> rotation and alpha of its node and the releases it leans by, or the translation of a follower.
  !> Followers, and dead moments where more than one axis is free, make the tangent unsymmetric
  !> (theory 6).
  pure subroutine find_system_pattern(system)
    type(system_t), intent(inout) :: system
    integer, allocatable :: start(:), member(:)
    integer :: e, i, n, blocks
    logical :: symmetric

    blocks = size(system%element) + size(system%load)
    allocate (start(blocks + 1), member(sum([(width(system, e), e=1, size(system%element))]) &
                                        + 7*size(system%load)))
    n = 0
    do e = 1, size(system%element)
      start(e) = n + 1
      associate (element => system%element(e)%e)
        member(n + 1:n + element%coordinates) = system%unknown(element%coordinate)
        n = n + element%coordinates
        do i = 1, element%strains
          if (system%multiplier(system%first(e) + i) == 0) cycle
          n = n + 1
          member(n) = system%multiplier(system%first(e) + i)
        end do
      end associate
    end do
    symmetric = .true.
    do i = 1, size(system%load)
      start(size(system%element) + i) = n + 1
      associate (load => system%load(i))
        member(n + 1:n + 4) = &
          system%unknown(coordinate_number(load%node([2, 2, 2, 3]), [4, 5, 6, 7]))
        if (any(abs(load%moment) > 0) .and. count(member(n + 1:n + 3) > 0) > 1) symmetric = .false.
        n = n + 4
        if (load%follower) then
          symmetric = .false.
          member(n + 1:n + 3) = system%unknown(coordinate_number(load%node(1), [1, 2, 3]))
          n = n + 3
        end if
        if (all(load%lean == 0)) cycle
        member(n + 1:n + 2) = 0
        where (load%lean > 0) member(n + 1:n + 2) = system%unknown(max(1, load%lean))
        n = n + 2
      end associate
    end do
    start(blocks + 1) = n + 1
    call find_pattern(system%equations(), start, member(:n), symmetric, system%pattern)
  end subroutine find_system_pattern

  !> Size of an element's block at the most.
  pure integer function width(system, e)
    type(system_t), intent(in) :: system
    integer, intent(in) :: e

    width = system%element(e)%e%coordinates + count(system%element(e)%e%fixed)
  end function width

end module system_build
