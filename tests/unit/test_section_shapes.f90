module test_section_shapes
  use kinds, only: wp
  use check, only: run, expect, expect_close
  use errors, only: error_t, exit_deck
  use section_data, only: section_constants_t, section_geometry_t
  use section_shapes, only: shape_dimensions_t, shape_rule_t, shape_rules, shape_rule, &
    set_dimension, shape_section
  use test_section_kit, only: draw, expect_same
  implicit none
  private

  public :: run_section_shapes_tests

contains

  subroutine run_section_shapes_tests()
    call run("section shapes: channels as plates", channels)
    call run("section shapes: zeds as plates", zeds)
    call run("section shapes: I, tee, angle, hat as plates", other_shapes)
    call run("section shapes: outer sizes are over the faces", outer_sizes)
    call run("section shapes: sizes by name", names)
    call run("section shapes: wrong sizes", wrong_sizes)
  end subroutine run_section_shapes_tests

  !> The shape has the constants of this drawing, its points are where the drawing's are (both
  !> from the centroid), and it is placed by its centroid.
  subroutine expect_drawing(shape, size, points, plates, thickness)
    character(len=*), intent(in) :: shape
    type(shape_dimensions_t), intent(in) :: size
    real(wp), intent(in) :: points(:, :), thickness(:)
    integer, intent(in) :: plates(:, :)
    type(section_constants_t) :: c, wanted
    type(section_geometry_t) :: geometry, drawn
    type(error_t), allocatable :: error
    real(wp) :: shift(2)
    integer :: i

    call shape_section(shape, size, 0.3_wp, c, geometry, error)
    if (allocated(error)) then
      call expect(.false., "no error, got "//error%message)
      return
    end if
    call draw(points, plates, thickness, wanted, drawn)
    call expect_same(c, wanted, 1.0e-11_wp, shape)
    shift = drawn%centroid - geometry%centroid
    do i = 1, ubound(points, 2)
      call expect_close(geometry%points(:, i) + shift, points(:, i), 1.0e-11_wp, shape//": point")
    end do
    call expect(geometry%origin_at_centroid, shape//": placed by its centroid")
  end subroutine expect_drawing

  !> Unequal flanges, lips, defaults.
  subroutine channels()
    type(shape_dimensions_t) :: size
    integer, parameter :: plates(2, 5) = reshape([1, 2, 2, 3, 3, 4, 1, 5, 4, 6], [2, 5])
    real(wp) :: points(2, 6)

    size = shape_dimensions_t(h=200.0_wp, b=80.0_wp, t=6.0_wp, tw=4.0_wp, b2=60.0_wp, t2=8.0_wp, &
                              midline=.true.)
    points(:, 1:4) = reshape([80, 200, 0, 200, 0, 0, 60, 0]*1.0_wp, [2, 4])
    call expect_drawing("C", size, points(:, :4), plates(:, :3), [6.0_wp, 4.0_wp, 8.0_wp])
    size%lip = 20
    points(:, 5:6) = reshape([80, 180, 60, 20]*1.0_wp, [2, 2])
    call expect_drawing("C", size, points, plates, [6.0_wp, 4.0_wp, 8.0_wp, 6.0_wp, 8.0_wp])
    size = shape_dimensions_t(h=600.0_wp, b=600.0_wp, t=30.0_wp, tw=20.0_wp, midline=.true.)
    points(:, 1:4) = reshape([600, 300, 0, 300, 0, -300, 600, -300]*1.0_wp, [2, 4])
    call expect_drawing("C", size, points(:, :4), plates(:, :3), [30.0_wp, 20.0_wp, 30.0_wp])
  end subroutine channels

  !> The zed of beamw_element.json, and one with lips: the upper one down, the lower one up.
  subroutine zeds()
    type(shape_dimensions_t) :: size
    integer, parameter :: plates(2, 5) = reshape([1, 2, 2, 3, 3, 4, 1, 5, 4, 6], [2, 5])
    real(wp) :: points(2, 6)

    size = shape_dimensions_t(h=200.0_wp, b=80.0_wp, t=8.0_wp, tw=6.0_wp, b2=60.0_wp, t2=10.0_wp, &
                              midline=.true.)
    points = reshape([-80, 100, 0, 100, 0, -100, 60, -100, -80, 85, 60, -85]*1.0_wp, [2, 6])
    call expect_drawing("Z", size, points(:, :4), plates(:, :3), [8.0_wp, 6.0_wp, 10.0_wp])
    size%lip = 15
    call expect_drawing("Z", size, points, plates, [8.0_wp, 6.0_wp, 10.0_wp, 8.0_wp, 10.0_wp])
  end subroutine zeds

  subroutine other_shapes()
    type(shape_dimensions_t) :: size

    size = shape_dimensions_t(h=300.0_wp, b=200.0_wp, t=20.0_wp, tw=10.0_wp, b2=100.0_wp, &
                              t2=15.0_wp, midline=.true.)
    call expect_drawing("I", size, reshape([-100, 300, 0, 300, 100, 300, -50, 0, 0, 0, 50, 0] &
                                           *1.0_wp, [2, 6]), &
                        reshape([1, 2, 2, 3, 2, 5, 4, 5, 5, 6], [2, 5]), &
                        [20.0_wp, 20.0_wp, 10.0_wp, 15.0_wp, 15.0_wp])
    size = shape_dimensions_t(h=90.0_wp, b=60.0_wp, t=5.0_wp, tw=4.0_wp, midline=.true.)
    call expect_drawing("T", size, reshape([-30, 90, 0, 90, 30, 90, 0, 0]*1.0_wp, [2, 4]), &
                        reshape([1, 2, 2, 3, 2, 4], [2, 3]), [5.0_wp, 5.0_wp, 4.0_wp])
    size = shape_dimensions_t(h=90.0_wp, b=60.0_wp, t=5.0_wp, t2=7.0_wp, midline=.true.)
    call expect_drawing("L", size, reshape([0, 90, 0, 0, 60, 0]*1.0_wp, [2, 3]), &
                        reshape([1, 2, 2, 3], [2, 2]), [5.0_wp, 7.0_wp])
    size = shape_dimensions_t(h=90.0_wp, b=60.0_wp, t=2.0_wp, c=25.0_wp, midline=.true.)
    call expect_drawing("HAT", size, reshape([-55, 0, -30, 0, -30, 90, 30, 90, 30, 0, 55, 0] &
                                             *1.0_wp, [2, 6]), &
                        reshape([1, 2, 2, 3, 3, 4, 4, 5, 5, 6], [2, 5]), spread(2.0_wp, 1, 5))
  end subroutine other_shapes

  !> The faces of the outline are where the outer sizes say: its extent at tips and corners, where a
  !> wall's rectangle ends at the midline of the next and so half a thickness inside the face.
  subroutine outer_sizes()
    type(shape_dimensions_t) :: size

    size = shape_dimensions_t(h=308.0_wp, b=97.0_wp, t=16.0_wp, tw=10.0_wp)
    call expect_extent("C", size, 0.0_wp, 92.0_wp, 292.0_wp)
    call expect_extent("I", size, -48.5_wp, 48.5_wp, 292.0_wp)
    call expect_extent("Z", size, -92.0_wp, 92.0_wp, 292.0_wp)
    call expect_extent("T", size, -48.5_wp, 48.5_wp, 300.0_wp)
    size%t2 = 12
    size%b2 = 57
    call expect_extent("C", size, 0.0_wp, 92.0_wp, 294.0_wp)
    call expect_extent("Z", size, -92.0_wp, 52.0_wp, 294.0_wp)
    size%lip = 30
    call expect_extent("Z", size, -84.0_wp, 46.0_wp, 294.0_wp)
    size = shape_dimensions_t(h=80.0_wp, b=60.0_wp, t=6.0_wp, t2=8.0_wp)
    call expect_extent("L", size, 0.0_wp, 57.0_wp, 76.0_wp)
    size = shape_dimensions_t(h=80.0_wp, b=60.0_wp, t=6.0_wp, c=20.0_wp)
    call expect_extent("HAT", size, -44.0_wp, 44.0_wp, 74.0_wp)
  end subroutine outer_sizes

  !> Where the midline begins and ends along y, and its height.
  subroutine expect_extent(shape, size, first, last, height)
    character(len=*), intent(in) :: shape
    type(shape_dimensions_t), intent(in) :: size
    real(wp), intent(in) :: first, last, height
    type(section_constants_t) :: c
    type(section_geometry_t) :: geometry
    type(error_t), allocatable :: error

    call shape_section(shape, size, 0.3_wp, c, geometry, error)
    call expect(.not. allocated(error), shape//": no error")
    if (allocated(error)) return
    associate (y => geometry%points(1, :), z => geometry%points(2, :))
      call expect_close([minval(y), maxval(y), maxval(z) - minval(z)], [first, last, height], &
                        1.0e-12_wp, shape//": extent of the midline")
    end associate
  end subroutine expect_extent

  !> Every name of every rule can be set and then makes a shape.
  subroutine names()
    type(shape_dimensions_t) :: size
    type(section_constants_t) :: c
    type(section_geometry_t) :: geometry
    type(shape_rule_t) :: rule
    type(error_t), allocatable :: error
    character(len=3) :: all(7)
    logical :: known
    integer :: i, k

    do i = 1, ubound(shape_rules, 1)
      rule = shape_rule(trim(shape_rules(i)%name))
      size = shape_dimensions_t()
      all = [rule%required, rule%optional]
      do k = 1, 7
        if (all(k) == "") cycle
        call set_dimension(size, trim(all(k)), 40.0_wp, known)
        call expect(known, trim(all(k))//" of "//rule%name)
        if (all(k)(1:1) == "T") call set_dimension(size, trim(all(k)), 2.0_wp, known)
        if (all(k) == "LIP") size%lip = 10
      end do
      call shape_section(trim(rule%name), size, 0.3_wp, c, geometry, error)
      call expect(.not. allocated(error), "all of "//rule%name)
      call expect(c%a > 0 .and. c%it > 0, "constants of "//rule%name)
      call expect(size_of_outline(geometry) > 0, "outline of "//rule%name)
    end do
    call set_dimension(size, "HH", 1.0_wp, known)
    call expect(.not. known, "HH is no size")
    rule = shape_rule("U")
    call expect(rule%name == "", "U is no shape")

  contains

    pure function size_of_outline(geometry) result(n)
      type(section_geometry_t), intent(in) :: geometry
      integer :: n

      n = 0
      if (allocated(geometry%outline)) n = geometry%outline_last(ubound(geometry%outline_last, 1))
    end function size_of_outline

  end subroutine names

  subroutine wrong_sizes()
    type(shape_dimensions_t) :: size

    call refused("U", size, "'U' is not a shape")
    size = shape_dimensions_t(h=100.0_wp, b=50.0_wp, t=4.0_wp)
    call refused("C", size, "C needs TW")
    size%tw = 0
    call refused("C", size, "TW has to be positive")
    size%tw = -3
    call refused("C", size, "TW has to be positive")
    size%tw = 4
    size%c = 20
    call refused("C", size, "C has no C")
    size%c = shape_default()
    size%b2 = 0
    call refused("C", size, "B2 has to be positive")
    size%b2 = 2
    call refused("C", size, "B2 is too small")
    size%b2 = 50
    size%lip = 2
    call refused("C", size, "LIP is too small")
    size%lip = 60
    call refused("C", size, "the lips of this C meet")
    size%lip = shape_default()
    size%h = 4
    call refused("I", size, "H is too small")
    call refused("T", shape_dimensions_t(h=2.0_wp, b=9.0_wp, t=4.0_wp, tw=1.0_wp), "H is too small")
    call refused("L", shape_dimensions_t(h=9.0_wp, b=2.0_wp, t=4.0_wp), "B is too small")
    call refused("HAT", shape_dimensions_t(h=9.0_wp, b=9.0_wp, t=2.0_wp, c=1.0_wp), &
                 "C is too small")
    call refused("BOX", shape_dimensions_t(h=8.0_wp, b=9.0_wp, t=4.0_wp, tw=1.0_wp), &
                 "H is too small")
    call refused("BOX", shape_dimensions_t(h=9.0_wp, b=8.0_wp, t=1.0_wp, tw=4.0_wp), &
                 "B is too small")
    call refused("TUBE", shape_dimensions_t(d=8.0_wp, t=4.0_wp), "D is too small")
    call refused("CIRC", shape_dimensions_t(), "CIRC needs D")
  end subroutine wrong_sizes

  !> A size that is not given.
  pure function shape_default() result(none)
    real(wp) :: none
    type(shape_dimensions_t) :: size

    none = size%h
  end function shape_default

  subroutine refused(shape, size, words)
    character(len=*), intent(in) :: shape, words
    type(shape_dimensions_t), intent(in) :: size
    type(section_constants_t) :: c
    type(section_geometry_t) :: geometry
    type(error_t), allocatable :: error

    call shape_section(shape, size, 0.3_wp, c, geometry, error)
    call expect(allocated(error), "an error: "//words)
    if (.not. allocated(error)) return
    call expect(error%status == exit_deck, words//": status of a deck error")
    call expect(index(error%message, words) == 1, "'"//words//"', got '"//error%message//"'")
  end subroutine refused

end module test_section_shapes
