!> `spar section` as its users meet it, and sections in the result file.
module test_section_command
  use kinds, only: wp
  use text, only: newline
  use check, only: run, expect, expect_close
  use json_numbers, only: member, elements, numbers, word
  use section_data, only: section_geometry_t, section_constants_t
  use section_shapes, only: shape_dimensions_t, shape_section
  use errors, only: error_t
  use output_sketch, only: sketch_t, draw_section
  use program_runs, only: outcome_t, run_spar, scratch, make_file
  use result_reader, only: get_reals, get_integers
  implicit none
  private

  public :: run_section_command_tests

  character(len=*), parameter :: deck = "decks/sections.deck"

contains

  subroutine run_section_command_tests()
    call run("section command: tables", test_tables)
    call run("section command: a deck of sections only", test_parts)
    call run("section command: JSON", test_json)
    call run("section command: what is asked in vain", test_refusals)
    call run("section command: drawings", test_sketch)
    call run("section command: check tells the defaults", test_defaults)
    call run("section command: drawings and stresses in the result file", test_file)
  end subroutine run_section_command_tests

  subroutine expect_status(arguments, status, outcome)
    character(len=*), intent(in) :: arguments
    integer, intent(in) :: status
    type(outcome_t), intent(out) :: outcome

    call run_spar(arguments, outcome)
    call expect(outcome%status == status, "the status of: spar "//arguments//newline// &
                outcome%errors)
  end subroutine expect_status

  subroutine expect_text(text, part)
    character(len=*), intent(in) :: text, part

    call expect(index(text, part) > 0, "'"//part//"' in:"//newline//text)
  end subroutine expect_text

  subroutine test_tables()
    type(outcome_t) :: outcome

    call expect_status("section "//deck, 0, outcome)
    call expect_text(outcome%output, "SECTION channel C H 30 B 10 T 1.6 TW 1")
    call expect_text(outcome%output, "    A    58.8            L^2")
    call expect_text(outcome%output, "    IY   8038.7147       L^4")
    call expect_text(outcome%output, "defaults taken: B2 = B, T2 = T, no LIP, OUTER sizes")
    call expect_text(outcome%output, "SECTION column PLATES of 4 points and 3 plates")
    call expect_text(outcome%output, "    DW   rigid")
    call expect_text(outcome%output, "SECTION tube CONSTANTS")
    call expect(index(outcome%output, "E-1") == 0, "no round-off is shown")
    call expect_status("section "//deck//" zed", 0, outcome)
    call expect_text(outcome%output, "SECTION zed Z")
    call expect_text(outcome%output, "X is C and S")
    call expect(index(outcome%output, "SECTION channel") == 0, "one section only")
  end subroutine test_tables

  subroutine test_parts()
    type(outcome_t) :: outcome
    character(len=:), allocatable :: path

    path = scratch("parts.deck")
    call make_file(path, "SET h 2"//newline//"SECTION plate RECT H {h} B 1"//newline)
    call expect_status("section "//path//" -D h=4", 0, outcome)
    call expect_text(outcome%output, "A    4 ")
    call expect_text(outcome%output, "Poisson's ratio 0.3")
    call make_file(path, "SECTION plate RECT H -1 B 1"//newline)
    call expect_status("section "//path, 3, outcome)
    call expect_text(outcome%errors, "H has to be positive")
  end subroutine test_parts

  !> The numbers of JSON have all digits.
  subroutine test_json()
    type(outcome_t) :: outcome
    character(len=:), allocatable :: list, angle
    real(wp), parameter :: b = 5.0_wp, t = 0.25_wp
    character(len=:), allocatable :: path

    path = scratch("angle.deck")
    call make_file(path, "SECTION first CIRC D 2"//newline// &
                   "SECTION ""a\b"" L H 5 B 5 T 0.25 MIDLINE"//newline)
    call expect_status("section "//path//" --json", 0, outcome)
    list = member(outcome%output, "sections")
    call expect(elements(list, 2) /= "" .and. elements(list, 3) == "", "two sections")
    angle = elements(list, 2)
    call expect(word(member(angle, "name")) == "a\\b", "a backslash is doubled")
    call expect(word(member(angle, "shape")) == "L", "the shape")
    call expect_close(value("IY"), t*b**3/3, 1.0e-13_wp, "IY")
    call expect_close(value("IZ"), t*b**3/12, 1.0e-13_wp, "IZ")
    call expect_close(value("YS"), -b/sqrt(8.0_wp), 1.0e-14_wp, "YS")
    call expect_close(numbers(member(angle, "angle")), [0.25_wp*acos(-1.0_wp)], 1.0e-14_wp, "turn")
    call expect_close(numbers(member(angle, "centroid")), [1.25_wp, 1.25_wp], 1.0e-14_wp, "centre")
    call expect(word(member(member(angle, "units"), "DYW")) == "L3", "units")
    call expect_close(numbers(member(elements(member(angle, "points"), 3), "place")), &
                      [5.0_wp, 0.0_wp], 0.0_wp, "a point")

  contains

    function value(name)
      character(len=*), intent(in) :: name
      real(wp) :: value, all(1)

      all = numbers(member(member(angle, "constants"), name))
      value = all(1)
    end function value
  end subroutine test_json

  subroutine test_refusals()
    type(outcome_t) :: outcome

    call expect_status("section "//deck//" chanel", 2, outcome)
    call expect_text(outcome%errors, "did you mean channel?")
    call expect_status("section "//deck//" channel zed", 2, outcome)
    call expect_status("section", 2, outcome)
    call expect_status("section "//deck//" -o x", 2, outcome)
    call expect_status("section decks/none.deck", 5, outcome)
    call expect_status("section --help", 0, outcome)
    call expect_text(outcome%output, "--json")
  end subroutine test_refusals

  !> A square has twice as many columns as rows; walls, C and S stand where they are.
  subroutine test_sketch()
    type(sketch_t) :: sketch
    type(section_constants_t) :: c
    type(section_geometry_t) :: g
    type(error_t), allocatable :: error
    integer :: row, i

    call shape_section("BOX", shape_dimensions_t(h=10.0_wp, b=10.0_wp, t=0.1_wp, tw=0.1_wp, &
                                                 midline=.true.), 0.3_wp, c, g, error)
    call draw_section(g, [c%ys, c%zs], sketch)
    call expect(sketch%rows == 24 .and. sketch%columns == 47, "24 rows, 1 + 2*23 columns")
    call expect(all(sketch%line([1, 24]) == repeat("#", 47)), "flanges")
    call expect(sketch%line(2) == "#"//repeat(" ", 45)//"#", "webs")
    call expect(sketch%together .and. any(sketch%line(12:13)(24:24) == "X"), "C and S")
    call shape_section("C", shape_dimensions_t(h=10.0_wp, b=50.0_wp, t=0.1_wp, tw=0.1_wp, &
                                               midline=.true.), 0.3_wp, c, g, error)
    call draw_section(g, [c%ys, c%zs], sketch)
    call expect(sketch%columns == 60 .and. sketch%rows <= 24, "60 columns")
    row = 0
    do i = 1, sketch%rows
      if (index(sketch%line(i), "S") > 0) row = i
    end do
    associate (line => sketch%line(max(row, 1)))
      call expect(index(line, "S") < index(line, "#") .and. index(line, "#") < index(line, "C"), &
                  "shear centre, web, centroid")
      call expect_close((index(line, "C") - index(line, "#"))*sketch%width, 25.0_wp*100/110, &
                        sketch%width, "the centroid from the web")
    end associate
    call shape_section("CIRC", shape_dimensions_t(d=3.0_wp), 0.3_wp, c, g, error)
    call draw_section(g, [c%ys, c%zs], sketch)
    call expect_close(sum([(count_of(sketch%line(i)), i=1, sketch%rows)])*2*sketch%width**2, &
                      c%a, 0.1_wp*c%a, "a filled circle")

  contains

    pure real(wp) function count_of(line)
      character(len=*), intent(in) :: line

      count_of = len_trim(line) - verify(line, " ") + 1
    end function count_of
  end subroutine test_sketch

  subroutine test_defaults()
    type(outcome_t) :: outcome

    call expect_status("check "//deck, 0, outcome)
    call expect_text(outcome%output, "defaults of SECTION tube: IW = YS = ZS = BY = BZ = BW = ")
    call expect_text(outcome%output, "rigid in shear: no DY, DZ")
    call expect_status("run "//deck//" --quiet -o "//scratch("sections.h5"), 0, outcome)
  end subroutine test_defaults

  !> Corners of the rectangle, and N/A at all of them.
  subroutine test_file()
    type(outcome_t) :: outcome
    character(len=:), allocatable :: path
    real(wp), allocatable :: x(:)
    integer, allocatable :: extents(:), rows(:)
    character(len=*), parameter :: sections = "/model/sections/drawings/a_b/"

    path = scratch("stress.deck")
    call make_file(path, "SECTION a/b RECT H 4 B 2"//newline//"MATERIAL m E 100 NU 0"//newline// &
                   "NODE 1:2 {9*i} 0 0"//newline//"BEAMW 1 1 2 SECTION a/b MATERIAL m"//newline// &
                   "FIX 1"//newline//"XF 2 1e-3 0 0"//newline//"STATIC STEPS 2"//newline)
    call expect_status("run "//path//" --quiet -o "//scratch("stress.h5"), 0, outcome)
    path = scratch("stress.h5")
    call get_reals(path, sections//"points", x, extents)
    call expect_close(x, [1, 2, -1, 2, -1, -2, 1, -2]*1.0_wp, 0.0_wp, "points")
    call get_reals(path, sections//"outline", x, extents)
    call expect_close(x, [1, 2, -1, 2, -1, -2, 1, -2]*1.0_wp, 0.0_wp, "outline")
    call get_integers(path, "/model/stress_points/end", rows, extents)
    call expect(all(rows == [0, 0, 0, 0, 1, 1, 1, 1]), "ends")
    call get_reals(path, "/analysis/01_static/elements/point_stress", x, extents)
    call expect(all(extents == [16, 4]), "two steps of eight places")
    if (size(x) /= 64) return
    associate (stress => reshape(x, [4, 8, 2]))
      call expect_close(stress(1, :, 2), spread(1.25e-4_wp, 1, 8), 1.0e-12_wp, "total")
      call expect_close(stress(2, :, 1), spread(0.625e-4_wp, 1, 8), 1.0e-12_wp, "axial")
      call expect_close(stress(3, :, 2), spread(0.0_wp, 1, 8), 1.0e-12_wp, "bending")
    end associate
  end subroutine test_file

end module test_section_command
