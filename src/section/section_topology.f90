!> The drawing of an open section as a graph: what is wrong with it, and a walk along its tree.
module section_topology
  use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
  use kinds, only: wp
  use errors, only: error_t, fail, exit_deck
  implicit none
  private

  public :: plate_fault_t, tree_t, check_drawing, walk_tree, thick_plates

  !> Coordinates closer than this part of the drawing's size are one place.
  real(wp), parameter :: same_place = 1.0e-9_wp

  !> What an error is about, as indices; 0: not about one. The message says "this point" where
  !> `point` is set, else "this plate", and "another" for `other`, so that the caller points.
  type :: plate_fault_t
    integer :: point = 0
    integer :: plate = 0
    integer :: other = 0  !< the second point or plate, of the same sort
  end type plate_fault_t

  !> The plates in an order in which each starts at a point reached before.
  type :: tree_t
    integer, allocatable :: plate(:)  !< index of the i-th plate of the walk
    integer, allocatable :: near(:)   !< its end point nearer to the root
    integer, allocatable :: far(:)    !< its other end point
  end type tree_t

contains

  !> Refuse what is not a drawing of separate straight plates; loops are found by `walk_tree`.
  subroutine check_drawing(points, plates, thickness, fault, error)
    real(wp), intent(in) :: points(:, :)   !< (2, points) [L]
    integer, intent(in) :: plates(:, :)    !< (2, plates) indices of points
    real(wp), intent(in) :: thickness(:)   !< (plates) [L]
    type(plate_fault_t), intent(out) :: fault
    type(error_t), allocatable, intent(out) :: error

    if (size(thickness) == 0) then
      call fail(error, exit_deck, "a section needs at least one plate")
      return
    end if
    call check_points(points, plates, fault, error)
    if (allocated(error)) return
    call check_plates(points, plates, thickness, fault, error)
    if (allocated(error)) return
    call check_overlaps(points, plates, fault, error)
  end subroutine check_drawing

  !> Points are finite, apart from each other, and belong to a plate.
  subroutine check_points(points, plates, fault, error)
    real(wp), intent(in) :: points(:, :)
    integer, intent(in) :: plates(:, :)
    type(plate_fault_t), intent(out) :: fault
    type(error_t), allocatable, intent(out) :: error
    real(wp) :: near
    integer :: i, j

    do i = 1, size(points, 2)
      fault%point = i
      if (all(ieee_is_finite(points(:, i)))) cycle
      call fail(error, exit_deck, "a coordinate of this point is not a finite number")
      return
    end do
    near = same_place*extent(points)
    do i = 1, size(points, 2)
      fault%point = i
      do j = 1, i - 1
        fault%other = j
        if (any(abs(points(:, i) - points(:, j)) > near)) cycle
        call fail(error, exit_deck, "this point lies where another one does")
        return
      end do
      fault%other = 0
      if (.not. any(plates == i)) then
        call fail(error, exit_deck, "this point belongs to no plate")
        return
      end if
    end do
    fault%point = 0
  end subroutine check_points

  !> Plates name points that exist, and have a length and a thickness.
  subroutine check_plates(points, plates, thickness, fault, error)
    real(wp), intent(in) :: points(:, :), thickness(:)
    integer, intent(in) :: plates(:, :)
    type(plate_fault_t), intent(out) :: fault
    type(error_t), allocatable, intent(out) :: error
    integer :: i

    do i = 1, size(thickness)
      fault%plate = i
      if (any(plates(:, i) < 1 .or. plates(:, i) > size(points, 2))) then
        call fail(error, exit_deck, "this plate names a point that does not exist")
      else if (plates(1, i) == plates(2, i)) then
        call fail(error, exit_deck, "this plate has no length")
      else if (.not. ieee_is_finite(thickness(i))) then
        call fail(error, exit_deck, "the thickness of this plate is not a finite number")
      else if (thickness(i) <= 0.0_wp) then
        call fail(error, exit_deck, "the thickness of this plate has to be positive")
      end if
      if (allocated(error)) return
    end do
    fault%plate = 0
  end subroutine check_plates

  !> Plates meet in their end points only.
  subroutine check_overlaps(points, plates, fault, error)
    real(wp), intent(in) :: points(:, :)
    integer, intent(in) :: plates(:, :)
    type(plate_fault_t), intent(out) :: fault
    type(error_t), allocatable, intent(out) :: error
    real(wp) :: near
    integer :: i, j

    near = same_place*extent(points)
    do i = 2, size(plates, 2)
      do j = 1, i - 1
        if (.not. overlap(points, plates(:, i), plates(:, j), near)) cycle
        fault%plate = i
        fault%other = j
        call fail(error, exit_deck, "this plate meets another one elsewhere than in a common &
                                    &end point")
        return
      end do
    end do
  end subroutine check_overlaps

  !> Larger side of the rectangle around points [L].
  pure function extent(points)
    real(wp), intent(in) :: points(:, :)
    real(wp) :: extent

    extent = maxval(maxval(points, dim=2) - minval(points, dim=2))
  end function extent

  !> Whether two plates touch other than in an end point they share.
  pure function overlap(points, p, q, near)
    real(wp), intent(in) :: points(:, :)
    integer, intent(in) :: p(2), q(2)
    real(wp), intent(in) :: near  !< distance that counts as touching [L]
    logical :: overlap
    real(wp) :: a(2, 2), b(2, 2)
    integer :: i

    a = points(:, p)
    b = points(:, q)
    overlap = .false.
    if (any(maxval(a, 2) < minval(b, 2) - near .or. maxval(b, 2) < minval(a, 2) - near)) return
    overlap = all(p == q) .or. all(p == q([2, 1]))
    do i = 1, 2
      if (all(p(i) /= q)) overlap = overlap .or. distance(a(:, i), b) <= near
      if (all(q(i) /= p)) overlap = overlap .or. distance(b(:, i), a) <= near
    end do
    if (overlap .or. any(p(1) == q) .or. any(p(2) == q)) return
    overlap = side(a, b(:, 1))*side(a, b(:, 2)) < 0.0_wp &
              .and. side(b, a(:, 1))*side(b, a(:, 2)) < 0.0_wp
  end function overlap

  !> Distance of a point from a straight piece [L].
  pure function distance(point, ends)
    real(wp), intent(in) :: point(2), ends(2, 2)
    real(wp) :: distance, along(2), xi

    along = ends(:, 2) - ends(:, 1)
    xi = dot_product(point - ends(:, 1), along)/dot_product(along, along)
    distance = norm2(point - ends(:, 1) - min(max(xi, 0.0_wp), 1.0_wp)*along)
  end function distance

  !> On which side of a line a point lies: 1, -1, or 0 on it.
  pure function side(line, point)
    real(wp), intent(in) :: line(2, 2), point(2)
    real(wp) :: side, along(2), to(2)

    along = line(:, 2) - line(:, 1)
    to = point - line(:, 1)
    side = along(1)*to(2) - along(2)*to(1)
    if (abs(side) > 0.0_wp) side = sign(1.0_wp, side)
  end function side

  !> Walk from the first point along all plates, in a time linear in their number.
  !> Errors: a closed loop, a plate that cannot be reached.
  subroutine walk_tree(points, plates, tree, fault, error)
    integer, intent(in) :: points        !< number of points
    integer, intent(in) :: plates(:, :)  !< (2, plates), checked by `check_drawing`
    type(tree_t), intent(out) :: tree
    type(plate_fault_t), intent(out) :: fault
    type(error_t), allocatable, intent(out) :: error
    integer :: first(points + 1), at(size(plates))
    logical :: reached(points), walked(size(plates, 2))
    integer :: next, found, k, here, there

    call plates_at_points(points, plates, first, at)
    allocate (tree%plate(size(walked)), tree%near(size(walked)), tree%far(size(walked)))
    reached = .false.
    walked = .false.
    here = plates(1, 1)
    reached(here) = .true.
    found = 0
    do next = 0, size(walked)
      if (next > found) exit
      if (next > 0) here = tree%far(next)
      do k = first(here), first(here + 1) - 1
        if (walked(at(k))) cycle
        walked(at(k)) = .true.
        there = sum(plates(:, at(k))) - here
        if (reached(there)) then
          fault%plate = at(k)
          call fail(error, exit_deck, "this plate closes a loop, but the walls of a section have &
                                      &to be open")
          return
        end if
        reached(there) = .true.
        found = found + 1
        tree%plate(found) = at(k)
        tree%near(found) = here
        tree%far(found) = there
      end do
    end do
    if (found == size(walked)) return
    fault%plate = findloc_false(walked)
    call fail(error, exit_deck, "this plate is not connected with the first one")
  end subroutine walk_tree

  !> The plates at point i are at(first(i):first(i+1)-1).
  pure subroutine plates_at_points(points, plates, first, at)
    integer, intent(in) :: points, plates(:, :)
    integer, intent(out) :: first(points + 1), at(size(plates))
    integer :: i, k, total

    first = 0
    do i = 1, size(plates, 2)
      first(plates(:, i)) = first(plates(:, i)) + 1
    end do
    total = 1
    do i = 1, points + 1
      total = total + first(i)
      first(i) = total
    end do
    do i = size(plates, 2), 1, -1
      do k = 1, 2
        first(plates(k, i)) = first(plates(k, i)) - 1
        at(first(plates(k, i))) = i
      end do
    end do
  end subroutine plates_at_points

  !> Index of the first false.
  pure function findloc_false(flags) result(i)
    logical, intent(in) :: flags(:)
    integer :: i

    do i = 1, size(flags)
      if (.not. flags(i)) return
    end do
  end function findloc_false

  !> Which plates are thicker than a fifth of their width, where the error of thin-wall theory, of
  !> order (t/b)**2, passes some per cent: worth a warning.
  pure function thick_plates(points, plates, thickness) result(thick)
    real(wp), intent(in) :: points(:, :), thickness(:)
    integer, intent(in) :: plates(:, :)
    logical :: thick(size(thickness))
    integer :: i

    do i = 1, size(thickness)
      thick(i) = thickness(i) > norm2(points(:, plates(2, i)) - points(:, plates(1, i)))/5.0_wp
    end do
  end function thick_plates

end module section_topology
