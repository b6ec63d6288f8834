!> Constraints that depend on others only where the model stands, in a singular position, and not
!> beside it.
!>
!> The independent constraints leave positions that make a smooth surface. A constraint that follows
!> from them everywhere holds on all of it; one that only has the same gradient here does not: one
!> small step along the surface, in an irregular direction, tells. Where several do not hold, the
!> rank of their gradients beside this position tells how many of them count. Steps are free
!> motions: what is elastic keeps its shape, or two crossed leaf springs would hold each other only
!> as long as they are flat.
module system_singular
  use kinds, only: wp
  use errors, only: error_t
  use nodal_state, only: state_t, node_coordinates
  use element_base, only: element_t
  use linalg_dense, only: rank_revealing
  use linalg_solver, only: solver_t
  use system_data, only: system_t
  use system_build, only: number_multipliers
  use system_constraints, only: constraint_entries, coordinate_scale, resisted
  use system_unknowns, only: by_coordinate
  use system_unstressed, only: unstressed_t, new_unstressed
  implicit none
  private

  public :: find_singular

  !> Steps aside, in radians or lengths of the shortest rigid element.
  real(wp), parameter :: step = 1.0e-2_wp

  !> Gaps of rows with the largest entry 1: closed, and round-off; and what a step opens at least of
  !> a constraint that does not follow from others, in the units of steps.
  real(wp), parameter :: closed = 1.0e-15_wp, no_gap = 1.0e-12_wp, opened = 1.0e-6_wp*step**2

  !> Projected gradients that are smaller depend, as do smaller parts of them.
  real(wp), parameter :: no_gradient = 1.0e-4_wp*step, no_part = 1.0e-7_wp

  !> Compliance of the constraints on the way back, to the largest gap (Levenberg, Marquardt).
  real(wp), parameter :: damping = 1.0e-2_wp

  integer, parameter :: most_iterations = 30, most_attempts = 4

contains

  !> Of the redundant constraints those that are not so beside the present position. `beside` is a
  !> position there, not allocated if no constraint is singular. `leads`: a motion leads away that
  !> satisfies all constraints, where every drive is let go.
  subroutine find_singular(system, state, dropped, singular, beside, leads, error)
    type(system_t), intent(in) :: system       !< redundant constraints dropped
    type(state_t), intent(in) :: state
    integer, intent(in) :: dropped(:)
    integer, allocatable, intent(out) :: singular(:)
    type(state_t), allocatable, intent(out) :: beside
    logical, intent(out) :: leads
    type(error_t), allocatable, intent(out) :: error
    type(unstressed_t) :: here
    type(system_t) :: stiff, loose

    singular = [integer ::]
    leads = .false.
    if (size(dropped) == 0 .or. system%unknowns <= system%multipliers) return
    loose = system
    call let_go(loose)
    call new_unstressed(loose, state, here, error)
    call here%solver%free()
    if (allocated(error)) return
    if (size(here%free, 2) == 0) return
    stiff = system
    call stiffen(stiff)
    call stiffen(loose)
    call look_beside(stiff, loose, state, here%free, dropped, singular, beside, leads, error)
  end subroutine find_singular

  !> The same for systems of what is held or elastic, and what moves freely.
  subroutine look_beside(stiff, loose, state, free, dropped, singular, beside, leads, error)
    type(system_t), intent(inout) :: stiff, loose   !< with drives and without
    type(state_t), intent(in) :: state
    real(wp), intent(in) :: free(:, :)
    integer, intent(in) :: dropped(:)
    integer, allocatable, intent(inout) :: singular(:)
    type(state_t), allocatable, intent(out) :: beside
    logical, intent(inout) :: leads
    type(error_t), allocatable, intent(out) :: error
    type(state_t) :: near
    real(wp) :: gap(size(stiff%multiplier))
    integer :: attempt

    call walk(loose, state, free, 1, near, leads, error)
    leads = .false.
    if (allocated(error)) return
    call find_gaps(stiff, state, near, gap)
    singular = pack(dropped, abs(gap(dropped)) > opened)
    if (size(singular) == 0) return
    call leave_out_dependent(stiff, near, singular, error)
    if (size(singular) == 0 .or. allocated(error)) return
    allocate (beside, source=near)
    loose%dropped(singular) = .false.
    call number_multipliers(loose)
    do attempt = 1, most_attempts
      if (allocated(error) .or. leads) return
      call walk(loose, state, free, attempt, near, leads, error)
    end do
  end subroutine look_beside

  !> Let what is driven move freely.
  pure subroutine let_go(system)
    type(system_t), intent(inout) :: system
    integer :: i, e

    do i = 1, size(system%drive)
      associate (strain => system%drive(i)%strain)
        e = findloc(system%first < strain, .true., 1, back=.true.)
        system%element(e)%e%fixed(strain - system%first(e)) = .false.
      end associate
    end do
    call number_multipliers(system)
  end subroutine let_go

  !> Hold what is elastic.
  pure subroutine stiffen(system)
    type(system_t), intent(inout) :: system
    integer :: e, i

    do e = 1, size(system%element)
      associate (element => system%element(e)%e)
        element%fixed = [(resisted(element, i), i=1, element%strains)]
      end associate
    end do
    call number_multipliers(system)
  end subroutine stiffen

  !> The length of the shortest rigid beam; of the model if there is none.
  pure real(wp) function shortest(system)
    type(system_t), intent(in) :: system
    integer :: e

    shortest = system%length
    do e = 1, system%members
      associate (element => system%element(e)%e)
        if (any(element%fixed)) shortest = min(shortest, element%size)
      end associate
    end do
  end function shortest

  !> A step along an irregular combination of free motions, and back to where no constraint has
  !> changed. Not `found` if that does not end, or ends where it began.
  subroutine walk(system, state, free, attempt, near, found, error)
    type(system_t), intent(in) :: system
    type(state_t), intent(in) :: state
    real(wp), intent(in) :: free(:, :)     !< by coordinate
    integer, intent(in) :: attempt         !< another combination for each
    type(state_t), intent(out) :: near
    logical, intent(out) :: found
    type(error_t), allocatable, intent(out) :: error
    real(wp) :: x(system%equations()), total(system%unknowns), gap(size(system%multiplier)), largest
    real(wp) :: motion(system%coordinates)
    integer :: i, k

    found = .false.
    near = state
    motion = 0
    do i = 1, size(free, 2)
      motion = motion + sin(real(i*(2*attempt + 1), wp) + 0.1_wp*i*i)*free(:, i)
    end do
    motion = motion/step_units(system)
    do k = 1, system%coordinates
      if (system%unknown(k) > 0) total(system%unknown(k)) = motion(k)
    end do
    total = step/maxval(abs(total))*total
    call move_scaled(system, total, near)
    do i = 1, most_iterations
      call find_gaps(system, state, near, gap)
      largest = maxval(abs(gap), system%multiplier > 0)
      if (.not. largest > closed) exit
      x(:system%unknowns) = 0
      x(system%unknowns + 1:) = -pack(gap, system%multiplier > 0)
      call solve_rows(system, near, max(damping*largest, no_gap**2), x, error)
      if (allocated(error)) return
      x = x*min(1.0_wp, step/max(maxval(abs(x(:system%unknowns))), tiny(1.0_wp)))
      total = total + x(:system%unknowns)
      call move_scaled(system, x(:system%unknowns), near)
      if (largest <= no_gap) exit
    end do
    found = largest <= no_gap .and. maxval(abs(total)) > 0.1_wp*step
  end subroutine walk

  !> By coordinate: the shortest rigid beam, a radian.
  pure function step_units(system) result(unit)
    type(system_t), intent(in) :: system
    real(wp) :: unit(system%coordinates)
    integer :: k

    unit = shortest(system)
    do k = 1, node_coordinates*system%nodes
      if (modulo(k - 1, node_coordinates) >= 3) unit(k) = coordinate_scale(system, k)
    end do
  end function step_units

  !> Gradients of the constraints that count, in units of steps, the largest entry of each 1.
  subroutine find_rows(system, state, row, column, values)
    type(system_t), intent(in) :: system
    type(state_t), intent(in) :: state
    integer, allocatable, intent(out) :: row(:), column(:)
    real(wp), allocatable, intent(out) :: values(:)
    real(wp) :: unit(system%coordinates), of_column(system%unknowns), largest(system%multipliers)
    integer :: k

    unit = step_units(system)
    do k = 1, system%coordinates
      if (system%unknown(k) > 0) of_column(system%unknown(k)) = unit(k)/coordinate_scale(system, k)
    end do
    call constraint_entries(system, state, row, column, values)
    values = values*of_column(column)
    largest = 0
    do k = 1, size(row)
      largest(row(k)) = max(largest(row(k)), abs(values(k)))
    end do
    values = values/largest(row)
  end subroutine find_rows

  !> [1, C'; C, -compliance] x, right-hand side in, solution out; scaled coordinates.
  subroutine solve_rows(system, state, compliance, x, error)
    type(system_t), intent(in) :: system
    type(state_t), intent(in) :: state
    real(wp), intent(in) :: compliance
    real(wp), intent(inout) :: x(:)
    type(error_t), allocatable, intent(out) :: error
    type(solver_t) :: solver

    call factorize_rows(system, state, compliance, solver, error)
    if (.not. allocated(error)) call solver%solve(x, error)
    call solver%free()
  end subroutine solve_rows

  subroutine factorize_rows(system, state, compliance, solver, error)
    type(system_t), intent(in) :: system
    type(state_t), intent(in) :: state
    real(wp), intent(in) :: compliance
    type(solver_t), intent(inout) :: solver
    type(error_t), allocatable, intent(out) :: error
    integer, allocatable :: row(:), column(:)
    integer :: diagonal(system%equations())
    real(wp), allocatable :: values(:)
    integer :: i, n

    n = system%unknowns
    call find_rows(system, state, row, column, values)
    diagonal = [(i, i=1, system%equations())]
    call solver%prepare(size(diagonal), [diagonal, row + n], [diagonal, column], .true., error)
    if (allocated(error)) return
    call solver%factorize([(1.0_wp, i=1, n), (-compliance, i=1, system%multipliers), values], error)
  end subroutine factorize_rows

  pure subroutine move_scaled(system, x, state)
    type(system_t), intent(in) :: system
    real(wp), intent(in) :: x(:)           !< by unknown, in units of steps
    type(state_t), intent(inout) :: state

    call state%move(by_coordinate(system, x)*step_units(system))
  end subroutine move_scaled

  !> How far fixed strains are from what they are at another state, in units in which their
  !> gradients there have the largest entry 1; zero for others.
  subroutine find_gaps(system, from, state, gap)
    type(system_t), intent(in) :: system
    type(state_t), intent(in) :: from, state
    real(wp), intent(out) :: gap(:)
    real(wp) :: unit(system%coordinates)
    integer :: e

    gap = 0
    unit = step_units(system)
    do e = 1, size(system%element)
      if (any(system%element(e)%e%fixed)) call element_gaps( &
        system%element(e)%e, unit, from, state, gap(system%first(e) + 1:system%first(e + 1)))
    end do
  end subroutine find_gaps

  pure subroutine element_gaps(element, unit, from, state, gap)
    class(element_t), intent(in) :: element
    real(wp), intent(in) :: unit(:)        !< by coordinate
    type(state_t), intent(in) :: from, state
    real(wp), intent(inout) :: gap(element%strains)
    real(wp), dimension(element%strains) :: before, now, none
    real(wp) :: jacobian(element%strains, element%coordinates)
    real(wp) :: unused(element%coordinates, element%coordinates)
    integer :: i
    logical :: valid

    none = 0
    call element%evaluate(state, none, now, jacobian, unused, valid)
    call element%evaluate(from, none, before, jacobian, unused, valid)
    do i = 1, element%strains
      if (element%fixed(i)) gap(i) = (now(i) - before(i)) &
                                     /max(tiny(1.0_wp), &
                                          maxval(abs(jacobian(i, :)*unit(element%coordinate))))
    end do
  end subroutine element_gaps

  !> Take those out that follow from the others at a position beside, later ones first.
  subroutine leave_out_dependent(system, near, singular, error)
    type(system_t), intent(inout) :: system
    type(state_t), intent(in) :: near
    integer, allocatable, intent(inout) :: singular(:)
    type(error_t), allocatable, intent(out) :: error
    type(solver_t) :: solver
    real(wp) :: x(system%equations()), gradient(size(singular), system%unknowns)
    logical :: counts(size(singular))
    integer, allocatable :: dependent(:)
    integer :: i

    call find_gradients(system, near, singular, gradient)
    call factorize_rows(system, near, no_gap**2, solver, error)
    if (allocated(error)) return
    do i = 1, size(singular)
      x(:system%unknowns) = gradient(i, :)
      x(system%unknowns + 1:) = 0
      call solver%solve(x, error)
      if (allocated(error)) exit
      gradient(i, :) = x(:system%unknowns)
      counts(i) = norm2(gradient(i, :)) > no_gradient
    end do
    call solver%free()
    if (allocated(error)) return
    singular = pack(singular, counts)
    call rank_revealing(gradient(pack([(i, i=1, size(counts))], counts), :), no_part, dependent)
    counts(:size(singular)) = .true.
    counts(dependent) = .false.
    singular = pack(singular, counts(:size(singular)))
  end subroutine leave_out_dependent

  !> Rows of dropped constraints, by unknown.
  subroutine find_gradients(system, state, strain, gradient)
    type(system_t), intent(inout) :: system
    type(state_t), intent(in) :: state
    integer, intent(in) :: strain(:)
    real(wp), intent(out) :: gradient(:, :)
    integer, allocatable :: row(:), column(:)
    real(wp), allocatable :: values(:)
    integer :: row_of(size(system%multiplier)), k, i

    system%dropped(strain) = .false.
    call number_multipliers(system)
    call find_rows(system, state, row, column, values)
    row_of = 0
    do i = 1, size(strain)
      row_of(system%multiplier(strain(i)) - system%unknowns) = i
    end do
    gradient = 0
    do k = 1, size(row)
      i = row_of(row(k))
      if (i > 0) gradient(i, column(k)) = gradient(i, column(k)) + values(k)
    end do
    system%dropped(strain) = .true.
    call number_multipliers(system)
  end subroutine find_gradients

end module system_singular
