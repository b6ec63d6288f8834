!> From the model to the system: elements, unknowns, loads, sparsity.
module system_build
  use kinds, only: wp
  use model_data, only: model_t, components, mode_flexible
  use nodal_state, only: coordinate_number, node_coordinates
  use system_data, only: system_t
  use system_elements, only: make_elements
  use system_forces, only: make_loads
  use system_motion, only: make_motions
  use system_pattern, only: find_pattern
  use system_rotation, only: make_rotors
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
    call set_initial_stress(model, system)
    call make_motions(model, system)
    call number_coordinates(model, twists, system)
    call number_multipliers(system)
    call make_loads(model, system)
    system%mass_node = mass_nodes(model)
    call make_rotors(model, system)
  end subroutine build_system

  !> Stress resultants of ESIG, of strains that have a law.
  pure subroutine set_initial_stress(model, system)
    type(model_t), intent(in) :: model
    type(system_t), intent(inout) :: system
    integer :: i, e, n

    allocate (system%initial_stress(size(system%multiplier)))
    system%initial_stress = 0
    do i = 1, system%members
      system%initial_stress(system%first(i) + 1:system%first(i) + 8) = &
        merge(model%member(i)%initial_stress, 0.0_wp, &
              model%member(i)%status == mode_flexible .and. .not. model%member(i)%rigid)
    end do
    do i = 1, system%joints
      e = system%members + i
      n = system%element(e)%e%strains
      system%initial_stress(system%first(e) + 1:system%first(e) + n) = &
        merge(model%joint(i)%initial_stress(:n), 0.0_wp, model%joint(i)%status(:n) == mode_flexible)
    end do
  end subroutine set_initial_stress

  !> Nodes with XM cards, each once.
  pure function mass_nodes(model) result(node)
    type(model_t), intent(in) :: model
    integer, allocatable :: node(:)
    logical, allocatable :: heavy(:)
    integer :: i

    node = [integer ::]
    if (size(model%mass) == 0) return
    allocate (heavy(size(model%node)))
    heavy = .false.
    heavy(model%mass%node) = .true.
    node = pack([(i, i=1, size(heavy))], heavy)
  end function mass_nodes

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
    allocate (system%dropped(size(system%multiplier)), system%singular(size(system%multiplier)))
    system%multiplier = 0
    system%dropped = .false.
    system%singular = .false.
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

  !> Sparsity with a block for each element, coordinates then multipliers, for each node with mass
  !> of its own, translation and rotation, for each part of elements of many nodes, and for each
  !> load, the
  !> rotation and alpha of its node and the releases it leans by, or the translation of a follower.
  !> Followers, and dead moments where more than one axis is free, make the tangent unsymmetric
  !> (theory 6).
  pure subroutine find_system_pattern(system, unsymmetric)
    type(system_t), intent(inout) :: system
    logical, intent(in), optional :: unsymmetric  !< ask for all entries anyway
    integer, allocatable :: start(:), member(:)
    integer :: e, i, n, blocks
    logical :: symmetric

    call number_parts(system, blocks)
    allocate (start(blocks + 1), member(sum([(width(system, e), e=1, size(system%element))]) &
                                        + 7*size(system%load) + 6*size(system%mass_node)))
    n = 0
    do e = 1, size(system%element)
      start(e) = n + 1
      associate (element => system%element(e)%e)
        if (allocated(element%part)) cycle
        call add_members(system, e, element%coordinate, member, n)
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
    do i = 1, size(system%mass_node)
      start(size(system%element) + size(system%load) + i) = n + 1
      member(n + 1:n + 6) = system%unknown(coordinate_number(system%mass_node(i), [(e, e=1, 6)]))
      n = n + 6
    end do
    do e = 1, size(system%element)
      associate (element => system%element(e)%e)
        if (.not. allocated(element%part)) cycle
        do i = 1, size(element%part, 2)
          start(system%parts(e) + i) = n + 1
          call add_members(system, e, element%coordinate(element%part(:, i)), member, n)
        end do
      end associate
    end do
    start(blocks + 1) = n + 1
    if (present(unsymmetric)) symmetric = symmetric .and. .not. unsymmetric
    call find_pattern(system%equations(), start, member(:n), symmetric, system%pattern)
  end subroutine find_system_pattern

  !> Blocks of elements, which are empty for those that have parts, of loads and nodes with mass,
  !> and those of the parts behind them.
  pure subroutine number_parts(system, blocks)
    type(system_t), intent(inout) :: system
    integer, intent(out) :: blocks
    integer :: e

    blocks = size(system%element) + size(system%load) + size(system%mass_node)
    system%parts = spread(0, 1, size(system%element))
    do e = 1, size(system%element)
      if (.not. allocated(system%element(e)%e%part)) cycle
      system%parts(e) = blocks
      blocks = blocks + size(system%element(e)%e%part, 2)
    end do
  end subroutine number_parts

  !> The unknowns of coordinates and the multipliers of an element, as members of a block.
  pure subroutine add_members(system, e, coordinate, member, n)
    type(system_t), intent(in) :: system
    integer, intent(in) :: e, coordinate(:)
    integer, intent(inout) :: member(:), n
    integer :: i

    member(n + 1:n + size(coordinate)) = system%unknown(coordinate)
    n = n + size(coordinate)
    do i = system%first(e) + 1, system%first(e + 1)
      if (system%multiplier(i) == 0) cycle
      n = n + 1
      member(n) = system%multiplier(i)
    end do
  end subroutine add_members

  !> Size of an element's block, or of those of its parts together, at the most.
  pure integer function width(system, e)
    type(system_t), intent(in) :: system
    integer, intent(in) :: e

    associate (element => system%element(e)%e)
      width = element%coordinates + count(element%fixed)
      if (allocated(element%part)) width = size(element%part) &
                                           + size(element%part, 2)*count(element%fixed)
    end associate
  end function width

end module system_build
