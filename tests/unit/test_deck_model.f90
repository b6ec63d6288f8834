!> Every keyword stores what it says; statuses, lists, supports, loads and analyses.
module test_deck_model
  use check, only: run, expect, expect_close
  use kinds, only: wp
  use diagnostics, only: report_t
  use model_data, only: model_t, second_jonker, second_consistent, mass_lumped, mass_consistent, &
                        function_ramp, function_table
  use model_functions, only: function_value
  use text, only: newline
  use deck_handler, only: keyword_t
  use deck_keywords, only: keywords
  use deck_samples, only: read_sample, read_sound, frame
  implicit none
  private

  public :: run_deck_model_tests

contains

  subroutine run_deck_model_tests()
    call run("deck: MATERIAL and SECTION", materials)
    call run("deck: BEAMW and its options", beams)
    call run("deck: DIVIDE", divided)
    call run("deck: DYNE, RLSE and modes 7 and 8", modes)
    call run("deck: ESTIFF and EM", stiffness)
    call run("deck: FIX", supports)
    call run("deck: groups and lists", groups)
    call run("deck: loads and load points", loads)
    call run("deck: a load point in turned section axes", markers)
    call run("deck: FUNCTION", functions)
    call run("deck: patterns and analyses", patterns)
    call run("deck: SPACAR's form", spacar)
    call run("deck: cards in any order", any_order)
    call run("deck: every example of the keyword table has the right form", examples)
    call run("deck: notes and warnings do not stop", notes)
  end subroutine run_deck_model_tests

  subroutine materials()
    type(model_t) :: model

    call read_sound("MATERIAL a E 200 NU 0.25 RHO 7 DAMPING 0.5|MATERIAL b G 3 E 8|"// &
                    "SECTION s CONSTANTS A 1 IY 2 IZ 3 IT 4 IW 5 YS 6 ZS -7 DY 8 DZ 9 DW 10 "// &
                    "DYZ 0.1 DYW 0.2 DZW 0.3 BY 11 BZ 12 BW 13 IR 14|NODE 1:2 {i} 0 0|"// &
                    "BEAMW 1 1 2 SECTION s MATERIAL a|FIX 1|XF 2 1 0 0", model)
    call expect(size(model%section) == 1, "the sizes")
    if (size(model%section) /= 1) return
    call expect_close(model%material(1)%g, 80.0_wp, 1.0e-13_wp, "G = E/(2(1+NU))")
    call expect_close([model%material(1)%e, model%material(1)%rho, model%material(1)%damping, &
                       model%material(2)%e, model%material(2)%g], &
                      [200.0_wp, 7.0_wp, 0.5_wp, 8.0_wp, 3.0_wp], 0.0_wp, "materials")
    associate (c => model%section(1)%constants)
      call expect_close([c%a, c%iy, c%iz, c%it, c%iw, c%ys, c%zs, c%by, c%bz, c%bw, c%ir], &
                        [1.0_wp, 2.0_wp, 3.0_wp, 4.0_wp, 5.0_wp, 6.0_wp, -7.0_wp, 11.0_wp, &
                         12.0_wp, 13.0_wp, 14.0_wp], 0.0_wp, "constants")
      call expect_close(c%d, reshape([8.0_wp, 0.1_wp, 0.2_wp, 0.1_wp, 9.0_wp, 0.3_wp, &
                                      0.2_wp, 0.3_wp, 10.0_wp], [3, 3]), 0.0_wp, "shear rigidities")
      call expect(c%shear_given, "given")
    end associate
  end subroutine materials

  subroutine beams()
    type(model_t) :: model

    call read_sound(frame//"BEAMW 2 2 1 0 0 3 SECTION bar MATERIAL steel SECOND JONKER "// &
                    "MASS LUMPED ROTARY OFF RIGID|FIX 1|XF 2 1 0 0", model)
    call expect(size(model%member) == 2, "the sizes")
    if (size(model%member) /= 2) return
    associate (a => model%member(1), b => model%member(2))
      call expect(a%second == second_consistent .and. a%mass == mass_consistent .and. &
          a%rotary .and. &
                  .not. a%rigid .and. all(a%status == 1), "defaults")
      call expect(.not. a%shear, "no shear without shear rigidities")
      call expect(b%second == second_jonker .and. b%mass == mass_lumped .and. .not. b%rotary .and. &
                  b%rigid .and. all(b%status == 0), "options")
      call expect_close(b%chord, [-4.0_wp, 0.0_wp, 0.0_wp], 0.0_wp, "chord")
      call expect_close(b%triad, reshape([-1.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 1.0_wp, &
                                          0.0_wp, 1.0_wp, 0.0_wp], [3, 3]), 1.0e-15_wp, "triad")
    end associate
    call expect(all(model%node(1)%exists), "three nodes")
  end subroutine beams

  subroutine divided()
    type(model_t) :: model

    call read_sound("MATERIAL m E 1 G 1|SECTION s CONSTANTS A 1 IY 1 IZ 1 IT 1|NODE 1 1 0 0|"// &
                    "NODE 2 9 4 -4|BEAMW 5 1 2 SECTION s MATERIAL m DIVIDE 4|FIX 1|FIX 5.2 Y|"// &
                    "XF 5.3 1 0 0|RLSE 5.4 6", model)
    call expect(size(model%member) == 4, "the sizes")
    if (size(model%member) /= 4) return
    call expect(all(model%member%part == [1, 2, 3, 4]), "parts")
    call expect(size(model%node) == 5, "inner nodes")
    call expect(model%node(4)%id == 5 .and. model%node(4)%part == 2, "the second inner node")
    call expect_close(model%node(4)%position, [5.0_wp, 2.0_wp, -2.0_wp], 1.0e-15_wp, "its position")
    call expect_close(model%member(3)%chord, [2.0_wp, 1.0_wp, -1.0_wp], 0.0_wp, "a part's chord")
    call expect(all(model%member(3)%node(:, 1) == 4), "a part begins at an inner node")
    call expect(all(model%member(4)%node(:, 2) == 2), "the last ends at q")
    call expect(model%node(4)%fixed(2) .and. count(model%node(4)%fixed) == 1, "FIX 5.2 Y")
    call expect(model%pattern(1)%load(1)%node == 5, "a load at an inner node")
    call expect(model%member(4)%status(6) == 2 .and. model%member(3)%status(6) == 1, "a release")
  end subroutine divided

  subroutine modes()
    type(model_t) :: model

    call read_sound(frame//"NODE 3:6 {4*i} 0 0|BEAMW 2:3 {i} {i+1} SECTION bar MATERIAL steel|"// &
                    "BEAMW 4:5 {i} {i+1}|DYNE 2 3 4|DYNE 2 2|RLSE 3 7 5|RLSE 5 1|"// &
                    "DYNE 4 1|ESTIFF 4 1 1 1 1 0 0 0|FIX 1|XF 2 1 0 0", model)
    call expect(size(model%member) == 5, "the sizes")
    if (size(model%member) /= 5) return
    call expect(all(model%member(1)%status == 1), "all flexible")
    call expect(all(model%member(2)%status == [0, 1, 1, 1, 0, 0, 1, 1]), "DYNE replaces all")
    call expect(all(model%member(3)%status == [1, 1, 1, 1, 2, 1, 2, 1]), "RLSE")
    call expect(all(model%member(4)%status == [1, 0, 0, 0, 0, 0, 0, 0]), "7 and 8 follow 2")
    call expect(all(model%member(5)%status == [2, 0, 0, 0, 0, 0, 0, 0]), "a rigid beam released")
  end subroutine modes

  subroutine stiffness()
    type(model_t) :: model

    call read_sound("NODE 1:2 {i} 0 0|BEAMW 1 1 2 DIVIDE 2|DYNE 1 1 2 3 4 5 6|FIX 1|XF 2 1 0 0|"// &
                    "ESTIFF 1 1 2 3 4 5 6 7|EM ALL 8 9 10 11 -10 13", model)
    call expect(size(model%member) == 2, "the sizes")
    if (size(model%member) /= 2) return
    call expect(all(model%member%has_stiffness) .and. all(model%member%has_inertia), "given")
    call expect_close(model%member(2)%stiffness, [1.0_wp, 2.0_wp, 3.0_wp, 4.0_wp, 5.0_wp, 6.0_wp, &
                                                  7.0_wp], 0.0_wp, "stiffness")
    call expect_close(model%member(2)%inertia, [8.0_wp, 9.0_wp, 10.0_wp, 11.0_wp, -10.0_wp, &
                                                13.0_wp], 0.0_wp, "inertia")
  end subroutine stiffness

  subroutine supports()
    type(model_t) :: model
    logical, parameter :: t = .true., f = .false.

    call read_sound(frame//"NODE 3 8 0 0|BEAMW 2 2 32 33 3 42 43|FIX 1|FIX 2 Y RZ w|FIX 42 3|"// &
                    "FIX 43 1|FIX 3 2|FIX 32 ry|FIX ALL X|XF 2 1 0 0", model)
    call expect(size(model%member) == 2, "the sizes")
    if (size(model%member) /= 2) return
    call expect(all(model%node(1)%fixed), "all that exist")
    call expect(all(model%node(2)%fixed .eqv. [t, t, f, f, f, t, t]), "by name")
    call expect(all(model%node(3)%fixed .eqv. [t, t, f, f, f, f, f]), "number of a translation")
    call expect(all(fixed_of(42) .eqv. [f, f, f, f, t, f, f]), "number of a rotation")
    call expect(all(fixed_of(43) .eqv. [f, f, f, f, f, f, t]), "number of a warping")
    call expect(all(fixed_of(32) .eqv. [f, f, f, f, t, f, f]), "name of a rotation")

  contains

    function fixed_of(id) result(fixed)
      integer, intent(in) :: id
      logical :: fixed(7)
      integer :: i

      fixed = .false.
      do i = 1, size(model%node)
        if (model%node(i)%id == id) fixed = model%node(i)%fixed
      end do
    end function fixed_of
  end subroutine supports

  subroutine groups()
    type(model_t) :: model

    call read_sound("FIX two|GROUP two NODES 2 one|GROUP one NODES 5:9:2|"// &
        "GROUP legs ELEMENTS 1 3:4|"// &
                    "NODE 1:9 {i} 0 0|MATERIAL m E 1 G 1|"// &
                        "SECTION s CONSTANTS A 1 IY 1 IZ 1 IT 1|"// &
                    "BEAMW 1:8 {i} {i+1} SECTION s MATERIAL m|RLSE legs 6|XF 1 1 0 0", model)
    call expect(size(model%node) == 9, "the sizes")
    if (size(model%node) /= 9) return
    call expect(all(model%node%fixed(1) .eqv. [.false., .true., .false., .false., .true., .false., &
                                               .true., .false., .true.]), "a group of a group")
    call expect(all((model%member%status(6) == 2) .eqv. [.true., .false., .true., .true., .false., &
                                                         .false., .false., .false.]), "elements")
  end subroutine groups

  subroutine loads()
    type(model_t) :: model

    call read_sound(frame//"NODE 3 8 0 0|BEAMW 2 2 32 33 3 42 43|FIX 1|FUNCTION f RAMP 0 1|"// &
                    "XF 2 1 2 3|XF 2 1 2 3 4 5 6|XF 2 1 2 3 4 5 6 7 FUNCTION f|XF 42 7 8 9|"// &
                        "XF 43 5|"// &
                    "XF 3 0 0 1 AT 0.5 -0.25|XF 2 0 0 1 AT 0.1 0.2 OF 1|MARKER tip 3 AT 9 8|"// &
                    "XF tip 1 0 0|GRAVITY 0 1 -9", model)
    call expect(size(model%pattern) == 1, "the sizes")
    if (size(model%pattern) /= 1) return
    associate (p => model%pattern(1))
      call expect(p%loads == 8 .and. size(p%load) == 8, "eight loads")
      if (p%loads /= 8) return
      call expect_close([p%load(1)%force, p%load(1)%moment], [1.0_wp, 2.0_wp, 3.0_wp, 0.0_wp, &
                                                              0.0_wp, 0.0_wp], 0.0_wp, "a force")
      call expect_close([p%load(3)%force, p%load(3)%moment, p%load(3)%bimoment], &
                        [1.0_wp, 2.0_wp, 3.0_wp, 4.0_wp, 5.0_wp, 6.0_wp, 7.0_wp], 0.0_wp, "seven")
      call expect(p%load(3)%function == 1 .and. p%load(2)%function == 0, "a function")
      call expect_close([p%load(4)%force, p%load(4)%moment], [0.0_wp, 0.0_wp, 0.0_wp, 7.0_wp, &
                                                              8.0_wp, 9.0_wp], 0.0_wp, "a moment")
      call expect_close(p%load(5)%bimoment, 5.0_wp, 0.0_wp, "a bimoment")
      call expect_close(p%gravity, [0.0_wp, 1.0_wp, -9.0_wp], 0.0_wp, "gravity")
      call expect(p%load(6)%marker == 1 .and. p%load(1)%marker == 0, "a load point")
      call expect_close(model%point(1)%offset, [0.5_wp, -0.25_wp], 0.0_wp, "its offset")
      call expect(model%point(1)%member == 2 .and. model%point(2)%member == 1, "its section")
      call expect(model%marker(1)%name == "tip", "a marker")
      call expect_close(model%point(3)%offset, [9.0_wp, 8.0_wp], 0.0_wp, "a load at a marker")
    end associate
  end subroutine loads

  subroutine markers()
    type(model_t) :: model
    type(report_t) :: report

    call read_sample(frame//"NODE 3 4 4 0|BEAMW 2 2 3 1 0 0 SECTION bar MATERIAL steel|FIX 1|"// &
                     "MARKER m 2 AT 1 0|XF m 1 0 0", model, report)
    call expect(report%errors() == 1, "sections in different axes: OF is asked for")
    call read_sample(frame//"NODE 3 8 0 0|BEAMW 2 2 3 0 1 0 SECTION bar MATERIAL steel|FIX 1|"// &
                     "MARKER m 2 AT 1 0|XF m 1 0 0", model, report)
    call expect(report%errors() == 0, "the same section in the same axes: clear")
  end subroutine markers

  subroutine functions()
    type(model_t) :: model

    call read_sound(frame//"FIX 1|FUNCTION a RAMP 0.2 0.7|FUNCTION b SINE 3 2 0.5|"// &
        "FUNCTION c STEP 0.4|"// &
                    "FUNCTION d TABLE 0 0 0.5 1 0.5 0.8 1 0.2|FUNCTION e EXPR {t^2*(3-2*t)}|"// &
                    "XF 2 1 0 0 FUNCTION e", model)
    call expect(size(model%function) == 5, "the sizes")
    if (size(model%function) /= 5) return
    call expect(model%pattern(1)%load(1)%function == 5, "the load's function")
    call expect_close(function_value(named("a"), 0.45_wp), 0.5_wp, 1.0e-15_wp, "half up the ramp")
    call expect_close(function_value(named("a"), 9.0_wp), 1.0_wp, 0.0_wp, "behind the ramp")
    call expect_close(function_value(named("b"), 0.3_wp), 3*sin(4*acos(-1.0_wp)*0.3_wp + 0.5_wp), &
                      1.0e-14_wp, "sine")
    call expect_close(function_value(named("c"), 0.4_wp), 1.0_wp, 0.0_wp, "on the step")
    call expect_close(function_value(named("c"), 0.39_wp), 0.0_wp, 0.0_wp, "before the step")
    call expect_close(function_value(named("d"), 0.25_wp), 0.5_wp, 1.0e-15_wp, "in the table")
    call expect_close(function_value(named("d"), 0.5_wp), 0.8_wp, 0.0_wp, "at a jump")
    call expect_close(function_value(named("d"), 2.0_wp), 0.2_wp, 0.0_wp, "behind the table")
    call expect_close(function_value(named("d"), -2.0_wp), 0.0_wp, 0.0_wp, "before the table")
    call expect_close(function_value(named("e"), 0.25_wp), 0.15625_wp, 1.0e-15_wp, "expression")

  contains

    function named(name) result(f)
      use model_data, only: function_t
      character(len=*), intent(in) :: name
      type(function_t) :: f
      integer :: i

      do i = 1, size(model%function)
        if (model%function(i)%name == name) f = model%function(i)
      end do
    end function named
  end subroutine functions

  subroutine patterns()
    type(model_t) :: model

    call read_sound(frame//"FIX 1|XF 2 1 0 0|STATIC STEPS 3 TO 0.5 NAME up|"// &
        "STATIC TO 2 MAXITER 7 TOL 1e-6|"// &
                    "DELXF 2 0 1 0|XF 2 0 0 1|STATIC", model)
    call expect(size(model%analysis) == 4, "the sizes")
    if (size(model%analysis) /= 4) return
    call expect(all(model%analysis%pattern == [1, 1, 2, 3]), "which pattern is ramped")
    call expect(all(model%analysis%steps == [3, 10, 10, 10]), "steps")
    call expect_close(model%analysis%factor, [0.5_wp, 2.0_wp, 1.0_wp, 1.0_wp], 0.0_wp, "factors")
    call expect(model%analysis(1)%name == "up" .and. model%analysis(2)%name == "", "names")
    call expect(model%analysis(2)%iterations == 7, "iterations")
    call expect_close(model%analysis(2)%tolerance, 1.0e-6_wp, 0.0_wp, "tolerance")
    call expect_close(model%pattern(2)%load(1)%force, [0.0_wp, 0.0_wp, 1.0_wp], 0.0_wp, "base")
    call expect_close(model%pattern(3)%load(1)%force, [0.0_wp, 1.0_wp, 0.0_wp], 0.0_wp, "DELXF")
  end subroutine patterns

  subroutine spacar()
    type(model_t) :: model

    call read_sound("X 1 0 0 0|X 4 1 0 0|BEAMW 1 1 2 3 4 5 6 0 1 0|FIX 1|FIX 2|FIX 3 1|"// &
                    "DYNE 1 1 2 3 4 5 6|END|HALT|ESTIFF 1 1 1 1 1 0 0 1|EM 1 1 1 1 1 0 0|"// &
                    "XF 4 1 0 0|DELXF 4 0 1 0|ITERSTEP 25 12 1e-5 - - 7|OUTLEVEL 0 1|END|END|"// &
                    "VISUALIZATION|BEAMVIS 3 4|LIGHT 1", model)
    call expect(size(model%analysis) == 2, "the sizes")
    if (size(model%analysis) /= 2) return
    call expect(all(model%analysis%steps == [7, 12]), "steps of XF and DELXF")
    call expect(all(model%analysis%iterations == 25), "iterations")
    call expect_close(model%analysis%tolerance, [1.0e-5_wp, 1.0e-5_wp], 0.0_wp, "tolerance")
    call expect(all(model%analysis%pattern == [1, 2]), "patterns")
    call expect(model%node(3)%id == 2 .and. all(model%node(3)%fixed .eqv. [.false., .false., &
        .false., &
                                               .true., .true., .true., .false.]), "FIX of a "// &
                                                   "rotational node")
    call expect(.not. any(model%node(3)%exists .neqv. [.false., .true., .false.]), "kinds")
  end subroutine spacar

  subroutine any_order()
    type(model_t) :: model, usual

    call read_sound("XF 2 0 0 1 AT 1 2|FIX 1|RLSE 1 6|"// &
        "BEAMW 1 1 2 0 1 0 SECTION bar MATERIAL steel|"// &
                    "NODE 2 4 0 0|NODE 1 0 0 0|SECTION bar CONSTANTS IT 4 A 1 IZ 3 IY 2|"// &
                    "MATERIAL steel NU 0.25 E 200", model)
    call read_sound(frame//"RLSE 1 6|FIX 1|XF 2 0 0 1 AT 1 2", usual)
    call expect(size(model%member) == 1 .and. size(usual%member) == 1, "the sizes")
    if (size(model%member) /= 1 .or. size(usual%member) /= 1) return
    call expect_close(model%member(1)%triad, usual%member(1)%triad, 0.0_wp, "triad")
    call expect(all(model%member(1)%status == usual%member(1)%status), "status")
    call expect_close(model%member(1)%chord, usual%member(1)%chord, 0.0_wp, "chord")
    call expect(all(model%node(model%member(1)%node(1, 1))%fixed), "support")
    call expect_close(model%point(1)%offset, usual%point(1)%offset, 0.0_wp, "load point")
  end subroutine any_order

  !> No example may be wrong in form: only what it refers to may be missing.
  subroutine examples()
    type(keyword_t), allocatable :: table(:)
    type(model_t) :: model
    type(report_t) :: report
    integer :: i, k

    allocate (table, source=keywords())
    do i = 1, size(table)
      call read_sample("SET R 1|"//trim(table(i)%example), model, report)
      do k = 1, report%items
        associate (message => report%item(k)%message)
          call expect(index(message, "there is no") + index(message, "has no position") + &
                      index(message, "named") + index(message, "no elements") + &
                      index(message, "no loads") + &
                      index(message, "implied") + index(message, "ignored") + &
                      index(message, "STATIC STEPS") + index(message, "cannot read") > 0, &
                      trim(table(i)%name)//" example: "//message)
        end associate
      end do
      call expect(len_trim(table(i)%example) > 0 .and. len_trim(table(i)%help) > 0, "help, example")
    end do
  end subroutine examples

  subroutine notes()
    type(model_t) :: model
    type(report_t) :: report

    call read_sample(frame//"NODE 7 0 0 9|FIX 1|XF 2 0 0 1|OUTLEVEL 0", model, report)
    call expect(report%errors() == 0 .and. report%warnings() == 1, "a warning")
    call expect(report%items == 3, "and two notes")
    call expect(index(model%deck, "NODE 7 0 0 9"//newline) > 0, "the deck's text is kept")
  end subroutine notes

end module test_deck_model
