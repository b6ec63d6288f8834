!> What a unit more of a load pattern adds to the tangent: the geometric stiffness of the stresses
!> it causes and the stiffness of the load itself (theory 8, buckling).
module system_geometric
  use kinds, only: wp
  use nodal_state, only: coordinate_number
  use element_base, only: element_t
  use system_data, only: system_t
  use system_assembly, only: iterate_t
  use system_pattern, only: add_block
  use system_loads, only: add_loads
  implicit none
  private

  public :: stress_increments, assemble_geometric, add_geometric, is_conservative

  real(wp), parameter :: parallel = 1.0e-12_wp

contains

  !> Stress resultants, by strain, of a solution of the tangent system: S D du, or a multiplier.
  pure subroutine stress_increments(system, iterate, solution, stress)
    type(system_t), intent(in) :: system
    type(iterate_t), intent(in) :: iterate   !< assembled: holds the Jacobians
    real(wp), intent(in) :: solution(:)
    real(wp), intent(out) :: stress(:)
    integer :: e, i

    do e = 1, size(system%element)
      associate (element => system%element(e)%e, first => system%first(e), &
                 jacobian => iterate%jacobian(system%jacobian(e) + 1:system%jacobian(e + 1)))
        call stresses_of(element, strains_of(system, element, jacobian, solution), &
                         stress(first + 1:first + element%strains))
        do i = first + 1, first + element%strains
          if (system%multiplier(i) > 0) stress(i) = solution(system%multiplier(i))
        end do
      end associate
    end do
  end subroutine stress_increments

  !> D du of an element.
  pure function strains_of(system, element, jacobian, solution) result(strain)
    type(system_t), intent(in) :: system
    class(element_t), intent(in) :: element
    real(wp), intent(in) :: jacobian(element%strains, element%coordinates), solution(:)
    real(wp) :: strain(element%strains)
    integer :: j

    strain = 0
    do j = 1, element%coordinates
      associate (at => system%unknown(element%coordinate(j)))
        if (at > 0) strain = strain + jacobian(:, j)*solution(at)
      end associate
    end do
  end function strains_of

  pure subroutine stresses_of(element, strain, stress)
    class(element_t), intent(in) :: element
    real(wp), intent(in) :: strain(element%strains)
    real(wp), intent(out) :: stress(element%strains)
    real(wp) :: law(element%strains, element%strains)

    call element%law(law)
    stress = matmul(law, strain)
  end subroutine stresses_of

  !> Sum of stress(i) times the Hessian of strain i at the present state, and the stiffness of the
  !> pattern's loads at the level 1.
  pure subroutine assemble_geometric(system, iterate, stress, pattern, patterns, values)
    type(system_t), intent(in) :: system
    type(iterate_t), intent(in) :: iterate
    real(wp), intent(in) :: stress(:)        !< by strain
    integer, intent(in) :: pattern, patterns !< which, and how many there are
    real(wp), intent(out) :: values(:)
    real(wp) :: level(patterns), unused(system%coordinates)

    values = 0
    call add_geometric(system, iterate, stress, values)
    level = 0
    level(pattern) = 1
    unused = 0
    call add_loads(system, iterate%state, level, unused, values)
  end subroutine assemble_geometric

  !> Add the sum of stress(i) times the Hessian of strain i at the present state.
  pure subroutine add_geometric(system, iterate, stress, values)
    type(system_t), intent(in) :: system
    type(iterate_t), intent(in) :: iterate
    real(wp), intent(in) :: stress(:)        !< by strain
    real(wp), intent(inout) :: values(:)
    integer :: e

    do e = 1, size(system%element)
      associate (element => system%element(e)%e, &
                 mine => stress(system%first(e) + 1:system%first(e + 1)))
        if (allocated(element%part)) then
          call add_part(system, e, size(element%part, 1), iterate, mine, values)
        else
          call add_element(system, e, element, iterate, mine, values)
        end if
      end associate
    end do
  end subroutine add_geometric

  pure subroutine add_element(system, e, element, iterate, stress, values)
    type(system_t), intent(in) :: system
    integer, intent(in) :: e
    class(element_t), intent(in) :: element
    type(iterate_t), intent(in) :: iterate
    real(wp), intent(in) :: stress(element%strains)
    real(wp), intent(inout) :: values(:)
    real(wp) :: strain(element%strains), jacobian(element%strains, element%coordinates)
    real(wp) :: geometric(element%coordinates, element%coordinates)
    logical :: valid

    call element%evaluate(iterate%state, stress, strain, jacobian, geometric, valid)
    if (valid) call add_block(system%pattern, e, geometric, values)
  end subroutine add_element

  !> The same of an element with parts.
  pure subroutine add_part(system, e, n, iterate, stress, values)
    type(system_t), intent(in) :: system
    integer, intent(in) :: e, n              !< n: coordinates of a part
    type(iterate_t), intent(in) :: iterate
    real(wp), intent(in) :: stress(:)
    real(wp), intent(inout) :: values(:)
    real(wp) :: strain(size(stress)), jacobian(size(stress), n), geometric(n, n)
    integer :: part
    logical :: valid

    call system%element(e)%e%evaluate_part(iterate%state, stress, part, strain, jacobian, &
                                           geometric, valid)
    if (valid) call add_block(system%pattern, system%parts(e) + part, geometric, values)
  end subroutine add_part

  !> Whether the tangent is symmetric for all motions that the supports allow, although dead
  !> moments act: an element that holds rotations leaves only turns about one axis, or turns about
  !> two axes whose plane a moment lies in; a moment T does no work on the commutator of these.
  pure logical function is_conservative(system, iterate) result(conservative)
    type(system_t), intent(in) :: system
    type(iterate_t), intent(in) :: iterate
    integer :: i, at(3)

    conservative = .true.
    if (system%pattern%symmetric) return
    do i = 1, size(system%load)
      associate (load => system%load(i))
        at = coordinate_number(load%node(2), [4, 5, 6])
        if (load%follower) conservative = .false.
        if (.not. any(abs(load%moment) > 0) .or. count(system%unknown(at) > 0) <= 1) cycle
        if (.not. harmless(system, iterate, load%node(2), load%moment)) conservative = .false.
      end associate
    end do
  end function is_conservative

  !> Whether a moment is conservative for the rotations of a node.
  pure logical function harmless(system, iterate, node, moment)
    type(system_t), intent(in) :: system
    type(iterate_t), intent(in) :: iterate
    integer, intent(in) :: node
    real(wp), intent(in) :: moment(3)
    real(wp) :: held(3)
    integer :: e, k

    harmless = .false.
    e = maxval(system%holder(4:6, node))
    if (e == 0) return
    associate (element => system%element(e)%e)
      do k = 1, 3
        held(k) = iterate%jacobian(system%jacobian(e) + (k - 1)*element%strains + 1)
      end do
      harmless = element%strains >= 2 .or. &
                 abs(dot_product(held, moment)) <= parallel*norm2(held)*norm2(moment)
    end associate
  end function harmless

end module system_geometric
