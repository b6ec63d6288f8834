module test_section_topology
  use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_positive_inf
  use kinds, only: wp
  use check, only: run, expect
  use errors, only: error_t, exit_deck
  use section_data, only: section_constants_t, section_geometry_t
  use section_topology, only: plate_fault_t, tree_t, walk_tree, thick_plates
  use section_plates, only: plates_section
  use test_section_kit, only: zed_points, zed_plates, zed_thickness
  implicit none
  private

  public :: run_section_topology_tests

  integer, parameter :: bar(2, 1) = reshape([1, 2], [2, 1])
  integer, parameter :: two(2, 2) = reshape([1, 2, 3, 4], [2, 2])

contains

  subroutine run_section_topology_tests()
    call run("section drawing: plates without thickness or length", bad_plates)
    call run("section drawing: points that are wrong", bad_points)
    call run("section drawing: loops and loose parts", bad_tree)
    call run("section drawing: plates that meet between their ends", bad_overlaps)
    call run("section drawing: what is right", sound_drawings)
    call run("section drawing: each plate of the walk starts where one ended", walk_order)
    call run("section drawing: thick walls", thick_walls)
  end subroutine run_section_topology_tests

  !> The drawing is refused, with these words and about these indices.
  subroutine refused(points, plates, thickness, words, point, plate, other)
    real(wp), intent(in) :: points(:), thickness(:)
    integer, intent(in) :: plates(:, :)
    character(len=*), intent(in) :: words
    integer, intent(in) :: point, plate, other
    type(section_constants_t) :: constants
    type(section_geometry_t) :: geometry
    type(plate_fault_t) :: fault
    type(error_t), allocatable :: error

    call plates_section(reshape(points, [2, size(points)/2]), plates, thickness, constants, &
                        geometry, fault, error)
    call expect(allocated(error), "an error: "//words)
    if (.not. allocated(error)) return
    call expect(index(error%message, words) > 0, "'"//words//"', got '"//error%message//"'")
    call expect(error%status == exit_deck, words//": status of a deck error")
    call expect(all([fault%point, fault%plate, fault%other] == [point, plate, other]), &
                words//": the place")
  end subroutine refused

  subroutine bad_plates()
    real(wp), parameter :: square(8) = [0, 0, 9, 0, 9, 9, 0, 9]
    integer, parameter :: chain(2, 3) = reshape([1, 2, 2, 3, 3, 4], [2, 3])
    integer :: plates(2, 3)

    call refused(square(:0), chain(:, :0), square(:0), "at least one plate", 0, 0, 0)
    call refused(square, chain, [1.0_wp, 0.0_wp, 1.0_wp], "has to be positive", 0, 2, 0)
    call refused(square, chain, [1.0_wp, 1.0_wp, -1.0_wp], "has to be positive", 0, 3, 0)
    call refused(square, chain, [1.0_wp, 1.0_wp, ieee_value(1.0_wp, ieee_positive_inf)], &
                 "not a finite number", 0, 3, 0)
    plates = chain
    plates(:, 1) = [1, 1]
    call refused(square, plates, [1.0_wp, 1.0_wp, 1.0_wp], "no length", 0, 1, 0)
    plates(:, 1) = [1, 5]
    call refused(square, plates, [1.0_wp, 1.0_wp, 1.0_wp], "does not exist", 0, 1, 0)
    plates(:, 1) = [1, 2]
    plates(2, 3) = 0
    call refused(square, reshape([plates, 1, 4], [2, 4]), [1.0_wp, 1.0_wp, 1.0_wp, 1.0_wp], &
                 "does not exist", 0, 3, 0)
  end subroutine bad_plates

  subroutine bad_points()
    real(wp), parameter :: t(2) = [1, 1]
    real(wp) :: points(6)

    points = [0, 0, 9, 0, 0, 9]
    call refused(points, bar, t(:1), "belongs to no plate", 3, 0, 0)
    points(5:6) = [9.0_wp, 1.0e-12_wp]
    call refused(points, reshape([1, 2, 2, 3], [2, 2]), t, "lies where another", 3, 0, 2)
    points(5) = ieee_value(1.0_wp, ieee_positive_inf)
    call refused(points, reshape([1, 2, 2, 3], [2, 2]), t, "not a finite number", 3, 0, 0)
  end subroutine bad_points

  subroutine bad_tree()
    real(wp), parameter :: square(8) = [0, 0, 9, 0, 9, 9, 0, 9]
    real(wp), parameter :: t(4) = 1

    call refused(square, reshape([1, 2, 2, 3, 3, 4, 4, 1], [2, 4]), t, "closes a loop", 0, 3, 0)
    call refused(square, two, t(:2), "not connected with the first", 0, 2, 0)
    ! a loop apart from the first plate, three plates of which cannot be reached
    call refused([square, -9.0_wp, 0.0_wp], reshape([5, 1, 2, 3, 3, 4, 4, 2], [2, 4]), t, &
                 "not connected with the first", 0, 2, 0)
  end subroutine bad_tree

  subroutine bad_overlaps()
    real(wp), parameter :: t(2) = 1
    character(len=*), parameter :: words = "elsewhere than in a common end point"

    call refused(real([0, 0, 9, 9, 0, 9, 9, 0], wp), two, t, words, 0, 2, 1)
    ! a tee without a point where the web ends
    call refused(real([-9, 0, 9, 0, 0, 0, 0, 9], wp), two, t, words, 0, 2, 1)
    ! on one line: partly, wholly, from a common end
    call refused(real([0, 0, 6, 0, 4, 0, 9, 0], wp), two, t, words, 0, 2, 1)
    call refused(real([0, 0, 9, 0, 2, 0, 4, 0], wp), two, t, words, 0, 2, 1)
    call refused(real([0, 0, 9, 0, 4, 0], wp), reshape([1, 2, 1, 3], [2, 2]), t, words, 0, 2, 1)
    ! the same plate twice, the other way round
    call refused(real([0, 0, 9, 0], wp), reshape([1, 2, 2, 1], [2, 2]), t, words, 0, 2, 1)
  end subroutine bad_overlaps

  !> Nearly touching, and sharp corners, are fine.
  subroutine sound_drawings()
    type(section_constants_t) :: constants
    type(section_geometry_t) :: geometry
    type(plate_fault_t) :: fault
    type(error_t), allocatable :: error
    real(wp), parameter :: points(8) = [0.0_wp, 0.0_wp, 9.0_wp, 0.0_wp, 9.0_wp, 9.0_wp, &
                                        0.0_wp, 1.0e-5_wp]

    call plates_section(reshape(points, [2, 4]), reshape([1, 2, 2, 3, 3, 4], [2, 3]), &
                        [1.0_wp, 1.0_wp, 1.0_wp], constants, geometry, fault, error)
    call expect(.not. allocated(error), "an open triangle is no error")
    call expect(all([fault%point, fault%plate, fault%other] == 0), "no fault")
    call plates_section(zed_points, zed_plates, zed_thickness, constants, geometry, fault, error)
    call expect(.not. allocated(error), "a zed is no error")
  end subroutine sound_drawings

  !> A comb of 30 teeth, its plates in a shuffled order.
  subroutine walk_order()
    integer, parameter :: n = 30
    integer :: plates(2, 2*n - 1), i, k
    logical :: reached(2*n)
    type(tree_t) :: tree
    type(plate_fault_t) :: fault
    type(error_t), allocatable :: error

    do i = 1, 2*n - 1
      k = mod(17*i, 2*n - 1) + 1
      if (i <= n) plates(:, k) = [i + n, i]
      if (i > n) plates(:, k) = [i - n, i - n + 1]
    end do
    call walk_tree(2*n, plates, tree, fault, error)
    call expect(.not. allocated(error), "a comb is a tree")
    if (allocated(error)) return
    reached = .false.
    reached(tree%near(1)) = .true.
    do i = 1, size(tree%plate)
      call expect(reached(tree%near(i)) .and. .not. reached(tree%far(i)), "from reached to new")
      reached(tree%far(i)) = .true.
      associate (ends => plates(:, tree%plate(i)))
        call expect(minval(ends) == min(tree%near(i), tree%far(i)) &
                    .and. maxval(ends) == max(tree%near(i), tree%far(i)), "the plate's ends")
      end associate
    end do
    call expect(all(reached), "all points reached")
  end subroutine walk_order

  subroutine thick_walls()
    call expect(all(thick_plates(zed_points, zed_plates, [15.9_wp, 40.1_wp, 12.1_wp]) &
                    .eqv. [.false., .true., .true.]), "thicker than a fifth of the width")
    call expect(.not. any(thick_plates(zed_points, zed_plates, zed_thickness)), "none is thick")
  end subroutine thick_walls

end module test_section_topology
