!> Motions that nothing resists, drives or holds: which nodes move and which strains let them.
module system_mobility
  use kinds, only: wp
  use errors, only: error_t
  use model_data, only: model_t
  use nodal_state, only: node_coordinates
  use element_base, only: element_t
  use linalg_solver, only: solver_t
  use system_data, only: system_t
  use system_assembly, only: iterate_t
  use system_constraints, only: coordinate_scale, null_vector, is_rigid, resisted
  use system_elements, only: number_releases
  implicit none
  private

  public :: free_motion_t, find_free_motions

  !> One motion: a null vector of [K; C].
  type :: free_motion_t
    integer :: coordinate = 0              !< stands for the motion: 1 in it, 0 in the others
    integer, allocatable :: moves(:)       !< coordinates of nodes, the largest first
    integer, allocatable :: strain(:)      !< released ones that change
    real(wp), allocatable :: shape(:)      !< by coordinate [L], radians, [1/L]
  end type free_motion_t

  !> Smaller parts of a motion are round-off.
  real(wp), parameter :: no_part = 1.0e-6_wp
  integer, parameter :: most_listed = 50   !< coordinates and strains of a motion

contains

  !> The free motions of a factorized matrix of an unloaded state, as many as there are, so combined
  !> that each has a coordinate of its own.
  subroutine find_free_motions(model, system, iterate, solver, found, error)
    type(model_t), intent(in) :: model
    type(system_t), intent(in) :: system
    type(iterate_t), intent(in) :: iterate
    type(solver_t), intent(inout) :: solver
    type(free_motion_t), allocatable, intent(out) :: found(:)
    type(error_t), allocatable, intent(out) :: error
    integer, allocatable :: null(:), own(:)
    real(wp), allocatable :: motion(:), shape(:, :)
    integer :: i, k, n

    allocate (null, source=solver%null_pivots())
    allocate (shape(system%coordinates, size(null)))
    n = 0
    do i = 1, size(null)
      call null_vector(system, iterate, solver, null(i), motion, error)
      if (allocated(error)) return
      do k = 1, system%coordinates
        motion(k) = motion(k)/coordinate_scale(system, k)
      end do
      if (.not. is_rigid(system, iterate, motion)) cycle
      n = n + 1
      shape(:, n) = motion
    end do
    call separate(system, shape(:, :n), own)
    allocate (found(n))
    do i = 1, n
      found(i)%coordinate = own(i)
      call describe(model, system, iterate, shape(:, i), found(i))
    end do
  end subroutine find_free_motions

  !> Combine motions so that each has a coordinate that no other moves: elimination, with the
  !> largest entry as the pivot, of equal ones the first, nodes before released strains.
  pure subroutine separate(system, shape, own)
    type(system_t), intent(in) :: system
    real(wp), intent(inout) :: shape(:, :)
    integer, allocatable, intent(out) :: own(:)
    integer :: i, j, k, best

    allocate (own(size(shape, 2)))
    do i = 1, size(shape, 2)
      do j = i, size(shape, 2)
        shape(:, j) = shape(:, j)/maxval(abs(shape(:, j)))
      end do
      best = i
      do j = i + 1, size(shape, 2)
        if (abs(shape(leader(system, shape(:, j)), j)) > &
            (1 + 1.0e-6_wp)*abs(shape(leader(system, shape(:, best)), best))) best = j
      end do
      k = leader(system, shape(:, best))
      own(i) = k
      shape(:, [i, best]) = shape(:, [best, i])
      shape(:, i) = shape(:, i)/shape(k, i)
      do j = 1, size(shape, 2)
        if (j == i) cycle
        shape(:, j) = shape(:, j) - shape(k, j)*shape(:, i)
        shape(k, j) = 0
      end do
    end do
  end subroutine separate

  !> The coordinate of a node that moves most, or the released strain if no node moves.
  pure integer function leader(system, shape)
    type(system_t), intent(in) :: system
    real(wp), intent(in) :: shape(:)
    integer :: last

    last = node_coordinates*system%nodes
    if (maxval(abs(shape(:last))) <= no_part*maxval(abs(shape))) last = size(shape)
    leader = first_largest(shape(:last))
  end function leader

  !> The first of the largest entries.
  pure integer function first_largest(values) result(at)
    real(wp), intent(in) :: values(:)
    integer :: k

    at = 1
    do k = 2, size(values)
      if (abs(values(k)) > (1 + 1.0e-6_wp)*abs(values(at))) at = k
    end do
  end function first_largest

  !> What a motion moves, and by which strains.
  pure subroutine describe(model, system, iterate, shape, found)
    type(model_t), intent(in) :: model
    type(system_t), intent(in) :: system
    type(iterate_t), intent(in) :: iterate
    real(wp), intent(in) :: shape(:)   !< scaled
    type(free_motion_t), intent(inout) :: found
    real(wp) :: left(node_coordinates*system%nodes), largest
    integer :: k

    found%moves = [integer ::]
    found%shape = shape
    largest = maxval(abs(shape))
    left = shape(:size(left))
    do while (size(found%moves) < most_listed)
      k = first_largest(left)
      if (abs(left(k)) <= no_part*largest) exit
      found%moves = [found%moves, k]
      left(k) = 0
    end do
    call find_strains(model, system, iterate, shape, found%strain)
    do k = 1, size(shape)
      found%shape(k) = shape(k)*coordinate_scale(system, k)
    end do
  end subroutine describe

  !> Strains that a motion changes and nothing resists; releases of beams with a stiffness are
  !> coordinates.
  pure subroutine find_strains(model, system, iterate, shape, strain)
    type(model_t), intent(in) :: model
    type(system_t), intent(in) :: system
    type(iterate_t), intent(in) :: iterate
    real(wp), intent(in) :: shape(:)
    integer, allocatable, intent(out) :: strain(:)
    integer :: release(8), releases, e, i

    strain = [integer ::]
    releases = 0
    do e = 1, size(system%element)
      if (size(strain) >= most_listed) return
      call add_unresisted(system, iterate, e, system%element(e)%e, shape, strain)
      if (e > system%members) cycle
      call number_releases(model%member(e), releases, release)
      do i = 1, 8
        if (release(i) == 0) cycle
        if (abs(shape(node_coordinates*system%nodes + release(i))) <= &
            no_part*maxval(abs(shape))) cycle
        strain = [strain, system%first(e) + i]
      end do
    end do
  end subroutine find_strains

  pure subroutine add_unresisted(system, iterate, e, element, shape, strain)
    type(system_t), intent(in) :: system
    type(iterate_t), intent(in) :: iterate
    integer, intent(in) :: e
    class(element_t), intent(in) :: element
    real(wp), intent(in) :: shape(:)
    integer, allocatable, intent(inout) :: strain(:)
    real(wp) :: rate, largest
    integer :: i, j

    do i = 1, element%strains
      if (resisted(element, i)) cycle
      rate = 0
      largest = 0
      do j = 1, element%coordinates
        associate (entry => iterate%jacobian(system%jacobian(e) + (j - 1)*element%strains + i) &
                   *coordinate_scale(system, element%coordinate(j)))
          rate = rate + entry*shape(element%coordinate(j))
          largest = max(largest, abs(entry))
        end associate
      end do
      if (abs(rate) <= no_part*largest*maxval(abs(shape))) cycle
      strain = [strain, system%first(e) + i]
    end do
  end subroutine add_unresisted

end module system_mobility
