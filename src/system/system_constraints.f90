!> Constraints that repeat others, and motions that nothing resists.
module system_constraints
  use kinds, only: wp
  use errors, only: error_t
  use nodal_state, only: state_t, node_coordinates
  use element_base, only: element_t
  use linalg_dense, only: rank_revealing
  use linalg_rank, only: dependent_rows
  use linalg_solver, only: solver_t
  use system_data, only: system_t
  use system_build, only: number_multipliers
  use system_assembly, only: iterate_t
  use system_unknowns, only: by_coordinate
  implicit none
  private

  public :: drop_redundant, free_motions, coordinate_scale
  public :: constraint_entries, scaled_jacobian, null_vector, is_rigid, resisted

  !> A constraint row depends on others if what is left of it is this small: round-off of sums of
  !> some ten products leaves 1e-15, rows that differ by design 1e-6 and more.
  real(wp), parameter :: dependent_tolerance = 1.0e-10_wp
  integer, parameter :: dense_rows = 300

contains

  !> Size of a coordinate that means a motion as large as the model: length, one radian, 1/length.
  pure function coordinate_scale(system, coordinate) result(scale)
    type(system_t), intent(in) :: system
    integer, intent(in) :: coordinate
    real(wp) :: scale
    integer :: component

    component = modulo(coordinate - 1, node_coordinates) + 1
    scale = 1
    if (component <= 3 .or. coordinate > node_coordinates*system%nodes) scale = system%length
    if (component == 7 .and. coordinate <= node_coordinates*system%nodes) scale = 1/system%length
  end function coordinate_scale

  !> Take out the fixed strains that follow from others in a state, that of the start; `dropped`
  !> lists them. With few constraints the later ones of the deck go.
  subroutine drop_redundant(system, state, dropped, error)
    type(system_t), intent(inout) :: system
    type(state_t), intent(in) :: state
    integer, allocatable, intent(out) :: dropped(:)
    type(error_t), allocatable, intent(out) :: error
    integer, allocatable :: row(:), column(:), strain(:), dependent(:)
    real(wp), allocatable :: values(:)
    integer :: k

    dropped = [integer ::]
    if (system%multipliers == 0) return
    call constraint_entries(system, state, row, column, values)
    if (system%multipliers <= dense_rows) then
      call dense_dependent(system, row, column, values, dependent)
    else
      call dependent_rows(system%multipliers, system%unknowns, row, column, values, &
                          dependent_tolerance, dependent, error)
      if (allocated(error)) return
    end if
    strain = pack([(k, k=1, size(system%multiplier))], system%multiplier > 0)
    dropped = strain(dependent)
    if (size(dropped) == 0) return
    system%dropped(dropped) = .true.
    call number_multipliers(system)
  end subroutine drop_redundant

  !> The Jacobian of the fixed strains in scaled coordinates: rows are multipliers, from 1.
  subroutine constraint_entries(system, state, row, column, values)
    type(system_t), intent(in) :: system
    type(state_t), intent(in) :: state
    integer, allocatable, intent(out) :: row(:), column(:)
    real(wp), allocatable, intent(out) :: values(:)
    integer :: e, n

    n = 0
    do e = 1, size(system%element)
      n = n + count(system%element(e)%e%fixed)*system%element(e)%e%coordinates
    end do
    allocate (row(n), column(n), values(n))
    n = 0
    do e = 1, size(system%element)
      if (.not. any(system%element(e)%e%fixed)) cycle
      call element_entries(system, e, system%element(e)%e, state, row, column, values, n)
    end do
    row = row(:n)
    column = column(:n)
    values = values(:n)
  end subroutine constraint_entries

  subroutine element_entries(system, e, element, state, row, column, values, n)
    type(system_t), intent(in) :: system
    integer, intent(in) :: e
    class(element_t), intent(in) :: element
    type(state_t), intent(in) :: state
    integer, intent(inout) :: row(:), column(:), n
    real(wp), intent(inout) :: values(:)
    real(wp) :: jacobian(element%strains, element%coordinates), largest
    integer :: i, j

    call scaled_jacobian(system, element, state, jacobian)
    do i = 1, element%strains
      associate (at => system%multiplier(system%first(e) + i))
        if (at == 0) cycle
        largest = maxval(abs(jacobian(i, :)))
        do j = 1, element%coordinates
          if (system%unknown(element%coordinate(j)) == 0) cycle
          if (abs(jacobian(i, j)) <= 0) cycle
          n = n + 1
          row(n) = at - system%unknowns
          column(n) = system%unknown(element%coordinate(j))
          values(n) = jacobian(i, j)/largest
        end do
      end associate
    end do
  end subroutine element_entries

  !> The Jacobian of an element in scaled coordinates.
  pure subroutine scaled_jacobian(system, element, state, jacobian)
    type(system_t), intent(in) :: system
    class(element_t), intent(in) :: element
    type(state_t), intent(in) :: state
    real(wp), intent(out) :: jacobian(element%strains, element%coordinates)
    real(wp) :: strain(element%strains), none(element%strains)
    real(wp) :: unused(element%coordinates, element%coordinates)
    integer :: j
    logical :: valid

    none = 0
    call element%evaluate(state, none, strain, jacobian, unused, valid)
    do j = 1, element%coordinates
      jacobian(:, j) = jacobian(:, j)*coordinate_scale(system, element%coordinate(j))
    end do
  end subroutine scaled_jacobian

  subroutine dense_dependent(system, row, column, values, dependent)
    type(system_t), intent(in) :: system
    integer, intent(in) :: row(:), column(:)
    real(wp), intent(in) :: values(:)
    integer, allocatable, intent(out) :: dependent(:)
    real(wp), allocatable :: a(:, :)
    integer, allocatable :: compact(:)
    integer :: k, columns

    allocate (compact(system%unknowns))
    compact = 0
    columns = 0
    do k = 1, size(column)
      if (compact(column(k)) > 0) cycle
      columns = columns + 1
      compact(column(k)) = columns
    end do
    allocate (a(system%multipliers, columns))
    a = 0
    do k = 1, size(row)
      a(row(k), compact(column(k))) = a(row(k), compact(column(k))) + values(k)
    end do
    call rank_revealing(a, dependent_tolerance, dependent)
  end subroutine dense_dependent

  !> Coordinates that stand for motions without strain, from the null pivots of a factorized
  !> matrix of an unloaded state: of each null vector the coordinate that moves most.
  subroutine free_motions(system, iterate, solver, coordinates, error)
    type(system_t), intent(in) :: system
    type(iterate_t), intent(in) :: iterate
    type(solver_t), intent(inout) :: solver
    integer, allocatable, intent(out) :: coordinates(:)
    type(error_t), allocatable, intent(out) :: error
    integer, allocatable :: null(:)
    real(wp), allocatable :: motion(:)
    integer :: i, k, largest

    coordinates = [integer ::]
    allocate (null, source=solver%null_pivots())
    do i = 1, size(null)
      call null_vector(system, iterate, solver, null(i), motion, error)
      if (allocated(error)) return
      largest = 0
      do k = 1, system%coordinates
        if (system%unknown(k) == 0) cycle
        motion(k) = motion(k)/coordinate_scale(system, k)
        if (any(coordinates == k)) cycle
        if (largest == 0) largest = k
        if (abs(motion(k)) > (1 + 1.0e-6_wp)*abs(motion(largest))) largest = k
      end do
      if (is_rigid(system, iterate, motion)) coordinates = [coordinates, largest]
    end do
  end subroutine free_motions

  !> The null vector whose entry `null` is 1, by coordinate: A (e + y) = 0 with y(null) = 0.
  subroutine null_vector(system, iterate, solver, null, motion, error)
    type(system_t), intent(in) :: system
    type(iterate_t), intent(in) :: iterate
    type(solver_t), intent(inout) :: solver
    integer, intent(in) :: null
    real(wp), allocatable, intent(out) :: motion(:)
    type(error_t), allocatable, intent(out) :: error
    real(wp) :: x(system%equations())
    integer :: k

    x = 0
    associate (p => system%pattern)
      do k = 1, size(p%row)
        if (p%column(k) == null) then
          x(p%row(k)) = x(p%row(k)) - iterate%values(k)
        else if (p%row(k) == null .and. p%symmetric) then
          x(p%column(k)) = x(p%column(k)) - iterate%values(k)
        end if
      end do
    end associate
    call solver%solve(x, error)
    if (allocated(error)) return
    x(null) = 1
    motion = by_coordinate(system, x)
  end subroutine null_vector

  !> Whether a motion (scaled) leaves all strains that have a stiffness or are fixed at zero: a
  !> small pivot alone may also come from a long chain of stiff elements.
  pure logical function is_rigid(system, iterate, motion)
    type(system_t), intent(in) :: system
    type(iterate_t), intent(in) :: iterate
    real(wp), intent(in) :: motion(:)
    real(wp) :: largest, strain
    integer :: e, i, j, k

    largest = maxval(abs(motion))
    is_rigid = largest > 0
    do e = 1, size(system%element)
      associate (element => system%element(e)%e)
        do i = 1, element%strains
          strain = 0
          do j = 1, element%coordinates
            k = system%jacobian(e) + (j - 1)*element%strains + i
            strain = strain + iterate%jacobian(k)*motion(element%coordinate(j)) &
                     *coordinate_scale(system, element%coordinate(j))
          end do
          if (resisted(element, i) .and. &
              abs(strain) > 1.0e-9_wp*largest*max(element%size, 0.0_wp)) is_rigid = .false.
        end do
      end associate
    end do
  end function is_rigid

  !> Whether a strain is fixed or has a stiffness.
  pure logical function resisted(element, i)
    class(element_t), intent(in) :: element
    integer, intent(in) :: i
    real(wp) :: law(element%strains, element%strains)

    resisted = element%fixed(i)
    if (resisted) return
    call element%law(law)
    resisted = law(i, i) > 0
  end function resisted

end module system_constraints
