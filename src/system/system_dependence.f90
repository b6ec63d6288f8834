!> Why constraints are redundant: which ones hold each other, and whose release would end that.
!>
!> A redundant constraint is a combination of others: weights y with y'C = 0. Those with a weight
!> hold each other; a stress of this kind in them is felt by nothing else. Without any one of them
!> the rank of C is as before: no motion is set free, and one redundancy is gone.
module system_dependence
  use kinds, only: wp
  use errors, only: error_t
  use model_data, only: model_t, mode_flexible, mode_prescribed, joint_hinge, &
                        joint_universal, joint_cylindrical, joint_prismatic, joint_truss, &
                        joint_carriage
  use nodal_state, only: state_t, node_coordinates
  use element_base, only: element_t
  use linalg_solver, only: solver_t
  use system_data, only: system_t
  use system_constraints, only: scaled_jacobian
  use system_motion, only: target_direction, mark_timed
  use system_names, only: locate_strain
  implicit none
  private

  public :: dependence_t, find_dependences, find_contradiction, is_driven

  !> What holds each other, once.
  type :: dependence_t
    integer :: dropped = 0                 !< the strain left out
    integer :: partners = 0                !< how many take part
    integer, allocatable :: strain(:)      !< those with the largest weights, in their order
    real(wp), allocatable :: weight(:)     !< of rows with the largest entry 1, lengths of the model
    integer, allocatable :: held(:)        !< nodes whose FIX takes part
    integer :: release = 0                 !< strain that RLSE may release to end it; 0: none
  end type dependence_t

  !> Rows of the constraints in scaled coordinates, the independent ones first.
  type :: rows_t
    integer, allocatable :: strain(:)              !< by row
    real(wp), allocatable :: largest(:)            !< by row: its largest entry, which is made 1
    integer, allocatable :: row(:), coordinate(:)  !< of each entry, held coordinates included
    real(wp), allocatable :: value(:)
    integer :: independent = 0
    logical :: solvable = .false.                  !< there is something to solve
    type(solver_t) :: solver                       !< of [1, C'; C, 0], independent rows
  end type rows_t

  !> More redundancies are counted, but not explained.
  integer, parameter, public :: most_explained = 20

  integer, parameter :: most_listed = 50   !< of those that take part

  !> Smaller weights and rates are round-off.
  real(wp), parameter :: no_weight = 1.0e-6_wp, no_rate = 1.0e-7_wp

  !> A release is looked for among weights of this part of the largest.
  real(wp), parameter :: worthwhile = 0.05_wp

contains

  !> Explain redundant constraints, `most_explained` at the most. Each holds after the releases of
  !> those before it, so that all releases together end all of them.
  subroutine find_dependences(model, system, state, dropped, found, error)
    type(model_t), intent(in) :: model
    type(system_t), intent(in) :: system         !< redundant constraints dropped
    type(state_t), intent(in) :: state
    integer, intent(in) :: dropped(:)
    type(dependence_t), allocatable, intent(out) :: found(:)
    type(error_t), allocatable, intent(out) :: error
    type(rows_t) :: rows
    real(wp), allocatable :: y(:, :)
    integer :: i, j, k

    allocate (found(min(size(dropped), most_explained)))
    if (size(found) == 0) return
    call new_rows(system, state, dropped, rows, error)
    allocate (y(size(rows%strain), size(found)))
    do i = 1, size(found)
      if (.not. allocated(error)) call find_weights(system, rows, i, y(:, i), error)
    end do
    call rows%solver%free()
    if (allocated(error)) return
    do i = 1, size(found)
      found(i)%dropped = dropped(i)
      call describe(system, rows, y(:, i), found(i))
      k = best_release(model, system, rows, y(:, i))
      if (k == 0) cycle
      found(i)%release = rows%strain(k)
      do j = i + 1, size(found)
        y(:, j) = y(:, j) - (y(k, j)/y(k, i))*y(:, i)
        y(k, j) = 0
      end do
    end do
  end subroutine find_dependences

  !> Prescribed motions that cannot be: the velocities that the independent constraints ask for at
  !> the start, or accelerations where there are none yet, are not those of the redundant ones.
  subroutine find_contradiction(model, system, state, dropped, found, exists, error)
    type(model_t), intent(in) :: model
    type(system_t), intent(inout) :: system      !< redundant constraints dropped
    type(state_t), intent(in) :: state
    integer, intent(in) :: dropped(:)
    type(dependence_t), intent(out) :: found
    logical, intent(out) :: exists
    type(error_t), allocatable, intent(out) :: error
    type(rows_t) :: rows
    real(wp), dimension(size(system%multiplier)) :: first, second
    real(wp) :: level(size(model%pattern))
    real(wp), allocatable :: y(:)
    logical, allocatable :: timed(:)
    integer :: p, at
    logical :: at_speed

    exists = .false.
    if (size(dropped) == 0 .or. size(system%drive) == 0) return
    call new_rows(system, state, dropped, rows, error)
    timed = system%timed
    call mark_timed(model, 1, size(model%analysis), system%timed)
    level = 0
    at = 0
    do p = 1, size(model%pattern)
      if (allocated(error) .or. at > 0) exit
      call target_direction(system, level, p, first, second)
      at_speed = any(abs(first) > 0)
      if (.not. at_speed) first = second
      if (any(abs(first) > 0)) call find_refused(system, rows, first, at_speed, at, error)
    end do
    system%timed = timed
    exists = at > 0
    if (exists .and. .not. allocated(error)) then
      allocate (y(size(rows%strain)))
      call find_weights(system, rows, at, y, error)
      found%dropped = dropped(at)
      call describe(system, rows, y, found)
    end if
    call rows%solver%free()
  end subroutine find_contradiction

  !> Whether a motion prescribes a strain.
  pure logical function is_driven(system, strain)
    type(system_t), intent(in) :: system
    integer, intent(in) :: strain

    is_driven = any(system%drive%strain == strain)
  end function is_driven

  !> All rows, and the factors that give the weights.
  subroutine new_rows(system, state, dropped, rows, error)
    type(system_t), intent(in) :: system
    type(state_t), intent(in) :: state
    integer, intent(in) :: dropped(:)
    type(rows_t), intent(out) :: rows
    type(error_t), allocatable, intent(out) :: error
    integer :: row_of(size(system%multiplier)), e, n, k

    rows%independent = system%multipliers
    row_of = max(0, system%multiplier - system%unknowns)
    do k = 1, size(dropped)
      row_of(dropped(k)) = rows%independent + k
    end do
    allocate (rows%strain(rows%independent + size(dropped)))
    allocate (rows%largest(size(rows%strain)))
    n = 0
    do e = 1, size(system%element)
      n = n + count(system%element(e)%e%fixed)*system%element(e)%e%coordinates
    end do
    allocate (rows%row(n), rows%coordinate(n), rows%value(n))
    n = 0
    do e = 1, size(system%element)
      if (any(system%element(e)%e%fixed)) call add_rows(system, e, system%element(e)%e, state, &
                                                        row_of, rows, n)
    end do
    rows%row = rows%row(:n)
    rows%coordinate = rows%coordinate(:n)
    rows%value = rows%value(:n)
    call factorize_rows(system, rows, error)
  end subroutine new_rows

  subroutine add_rows(system, e, element, state, row_of, rows, n)
    type(system_t), intent(in) :: system
    integer, intent(in) :: e, row_of(:)
    class(element_t), intent(in) :: element
    type(state_t), intent(in) :: state
    type(rows_t), intent(inout) :: rows
    integer, intent(inout) :: n
    real(wp) :: jacobian(element%strains, element%coordinates)
    integer :: i, j

    call scaled_jacobian(system, element, state, jacobian)
    do i = 1, element%strains
      associate (at => row_of(system%first(e) + i))
        if (at == 0) cycle
        rows%strain(at) = system%first(e) + i
        rows%largest(at) = maxval(abs(jacobian(i, :)))
        do j = 1, element%coordinates
          if (abs(jacobian(i, j)) <= 0) cycle
          n = n + 1
          rows%row(n) = at
          rows%coordinate(n) = element%coordinate(j)
          rows%value(n) = jacobian(i, j)/rows%largest(at)
        end do
      end associate
    end do
  end subroutine add_rows

  !> [1, C'; C, 0] of the independent rows and the free coordinates.
  subroutine factorize_rows(system, rows, error)
    type(system_t), intent(in) :: system
    type(rows_t), intent(inout) :: rows
    type(error_t), allocatable, intent(out) :: error
    logical :: counts(size(rows%row))
    integer :: n, i

    n = system%unknowns
    rows%solvable = n > 0 .and. rows%independent > 0
    if (.not. rows%solvable) return
    counts = rows%row <= rows%independent .and. system%unknown(rows%coordinate) > 0
    call rows%solver%prepare(n + rows%independent, [(i, i=1, n), pack(rows%row, counts) + n], &
      [(i, i=1, n), pack(system%unknown(rows%coordinate), counts)], .true., error)
    if (allocated(error)) return
    call rows%solver%factorize([(1.0_wp, i=1, n), pack(rows%value, counts)], error)
  end subroutine factorize_rows

  !> Weights by row of the combination that the i-th redundant row is, its own being 1.
  subroutine find_weights(system, rows, i, y, error)
    type(system_t), intent(in) :: system
    type(rows_t), intent(inout) :: rows
    integer, intent(in) :: i
    real(wp), intent(out) :: y(:)
    type(error_t), allocatable, intent(out) :: error
    real(wp) :: x(system%unknowns + rows%independent)
    integer :: k

    x = 0
    do k = 1, size(rows%row)
      if (rows%row(k) /= rows%independent + i) cycle
      associate (at => system%unknown(rows%coordinate(k)))
        if (at > 0) x(at) = rows%value(k)
      end associate
    end do
    if (rows%solvable) call rows%solver%solve(x, error)
    y = 0
    if (rows%solvable) y(:rows%independent) = -x(system%unknowns + 1:)
    y(rows%independent + i) = 1
    where (abs(y) <= no_weight*maxval(abs(y))) y = 0
  end subroutine find_weights

  !> The first redundant row that does not have the rate its strain is to have, where the others
  !> have theirs; 0: none. Singular rows are refused nothing but velocities: those may turn them.
  subroutine find_refused(system, rows, rate, at_speed, refused, error)
    type(system_t), intent(in) :: system
    type(rows_t), intent(inout) :: rows
    real(wp), intent(in) :: rate(:)      !< by strain
    logical, intent(in) :: at_speed      !< they are velocities, not accelerations from rest
    integer, intent(out) :: refused
    type(error_t), allocatable, intent(out) :: error
    real(wp) :: x(system%unknowns + rows%independent), demand(size(rows%strain)), largest
    real(wp) :: lack(size(rows%strain))
    integer :: k

    refused = 0
    demand = rate(rows%strain)/rows%largest
    x(:system%unknowns) = 0
    x(system%unknowns + 1:) = demand(:rows%independent)
    if (rows%solvable) call rows%solver%solve(x, error)
    if (allocated(error)) return
    lack = demand
    largest = maxval(abs(demand))
    do k = 1, size(rows%row)
      associate (at => system%unknown(rows%coordinate(k)))
        if (at == 0) cycle
        lack(rows%row(k)) = lack(rows%row(k)) - rows%value(k)*x(at)
        largest = max(largest, abs(rows%value(k)*x(at)))
      end associate
    end do
    do k = rows%independent + 1, size(lack)
      if (abs(lack(k)) <= no_rate*largest) cycle
      if (system%singular(rows%strain(k)) .and. .not. at_speed) cycle
      refused = k - rows%independent
      return
    end do
  end subroutine find_refused

  !> Who takes part, by weight, and which nodes hold against them.
  pure subroutine describe(system, rows, y, found)
    type(system_t), intent(in) :: system
    type(rows_t), intent(in) :: rows
    real(wp), intent(in) :: y(:)
    type(dependence_t), intent(inout) :: found
    real(wp) :: reaction(system%coordinates), left(size(y))
    logical :: holds(system%nodes)
    integer :: i, k, n, node

    found%partners = count(abs(y) > no_weight*maxval(abs(y)))
    n = min(found%partners, most_listed)
    allocate (found%strain(n), found%weight(n))
    left = abs(y)
    do i = 1, n
      k = maxloc(merge(1.0_wp, 0.0_wp, left >= (1 - 1.0e-6_wp)*maxval(left)), 1)
      found%strain(i) = rows%strain(k)
      found%weight(i) = y(k)
      left(k) = 0
    end do
    reaction = 0
    do i = 1, size(rows%row)
      associate (at => rows%coordinate(i))
        if (system%unknown(at) == 0) reaction(at) = reaction(at) + y(rows%row(i))*rows%value(i)
      end associate
    end do
    do node = 1, system%nodes
      k = node_coordinates*(node - 1)
      holds(node) = any(abs(reaction(k + 1:k + 6)) > 10*no_weight*maxval(abs(y)))
    end do
    found%held = pack([(i, i=1, system%nodes)], holds)
  end subroutine describe

  !> The row whose release is the least loss: modes that bend and twist before others, then the
  !> largest weight; 0: nothing that takes part can be released.
  pure integer function best_release(model, system, rows, y) result(best)
    type(model_t), intent(in) :: model
    type(system_t), intent(in) :: system
    type(rows_t), intent(in) :: rows
    real(wp), intent(in) :: y(:)
    integer :: loss(size(y)), k
    real(wp) :: largest

    loss = huge(1)
    do k = 1, size(y)
      if (abs(y(k)) > 0) loss(k) = loss_by_release(model, system, rows%strain(k))
    end do
    best = 0
    largest = maxval(abs(y), loss < huge(1))
    do k = 1, size(y)
      if (loss(k) == huge(1) .or. abs(y(k)) < worthwhile*largest) cycle
      if (best == 0) best = k
      if (loss(k) > loss(best)) cycle
      if (loss(k) < loss(best) .or. abs(y(k)) > (1 + 1.0e-6_wp)*abs(y(best))) best = k
    end do
  end function best_release

  !> What is lost by a release: 1 a flexible beam twists, 2 it bends or a joint tilts, 3 a rigid
  !> beam does, 4 something gets longer or slides, 5 a joint is none any more; huge: no card could
  !> release the mode.
  pure integer function loss_by_release(model, system, strain) result(loss)
    type(model_t), intent(in) :: model
    type(system_t), intent(in) :: system
    integer, intent(in) :: strain
    integer :: e, mode

    call locate_strain(system, strain, e, mode)
    loss = huge(1)
    if (e <= system%members) then
      associate (m => model%member(e))
        if (m%status(mode) == mode_prescribed .or. mode > 6) return
        loss = 2
        if (mode == 2) loss = 1
        if (m%rigid .or. .not. any(m%status == mode_flexible)) loss = 3
        if (mode == 1) loss = 4
      end associate
    else if (e <= system%members + system%joints) then
      associate (joint => model%joint(e - system%members))
        if (joint%status(mode) == mode_prescribed) return
        loss = 5
        select case (joint%kind)
        case (joint_hinge, joint_universal)
          if (mode >= 2) loss = 2
        case (joint_cylindrical, joint_prismatic)
          loss = merge(2, 4, mode > 4)
        case (joint_carriage)
          if (mode >= 4) loss = 2
        case (joint_truss)
          loss = 4
        case default
        end select
      end associate
    end if
  end function loss_by_release

end module system_dependence
