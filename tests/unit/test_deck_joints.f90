!> Beams without warping, joints, motions, starts and masses: what their cards make of the model.
module test_deck_joints
  use check, only: run, expect, expect_close
  use kinds, only: wp
  use diagnostics, only: report_t
  use model_data, only: model_t, type_beam, type_beamw, mass_lumped, &
                        mode_fixed, mode_flexible, mode_released, mode_prescribed, joint_truss, &
                        joint_hinge, joint_universal, joint_spherical, joint_cylindrical, &
                        joint_prismatic, joint_gear
  use deck_samples, only: read_sample, read_sound, frame
  implicit none
  private

  public :: run_deck_joints_tests

  integer, parameter :: f = mode_fixed, e = mode_flexible, r = mode_released, p = mode_prescribed

  !> Two beams whose rotations at node 2 are apart (2 and 12), on lines 6 to 8.
  character(len=*), parameter :: pair = frame//"NODE 3 4 3 0|"// &
    "BEAM 2 2 12 3 3 SECTION bar MATERIAL steel|FIX 1|"

contains

  subroutine run_deck_joints_tests()
    call run("deck: BEAM, both forms", beams)
    call run("deck: values of a BEAM", beam_values)
    call run("deck: TRUSS", trusses)
    call run("deck: joints, their nodes, axes and free modes", joints)
    call run("deck: GEAR", gears)
    call run("deck: status of the modes of joints, lists", statuses)
    call run("deck: ESTIFF, EDAMP, ESIG of joints, lists", properties)
    call run("deck: INPUTE", strains)
    call run("deck: INPUTX, values and components", coordinates)
    call run("deck: motions of later patterns add up", patterns)
    call run("deck: INPUTX and INPUTE before and behind HALT", halt)
    call run("deck: XM", masses)
    call run("deck: STARTX, STARTDX, STARTDE", starts)
    call run("deck: FOLLOWER", followers)
    call run("deck: a damper needs no stiffness", damper)
    call run("deck: joints alone, mass of nodes", alone)
  end subroutine run_deck_joints_tests

  subroutine beams()
    type(model_t) :: model

    call read_sound("MATERIAL m E 1 G 1|SECTION s CONSTANTS A 1 IY 1 IZ 1 IT 1|"// &
                    "NODE 1:4 {i} 0 0|BEAM 1 1 2 SECTION s MATERIAL m DIVIDE 2|"// &
                    "BEAM 2 2 3 0 0 1|BEAM 3 3 13 4 14|BEAM 4 3 13 4 15 0 0 2|"// &
                    "BEAMW 5 4 14 24 1 16 26|FIX 1", model)
    call expect(size(model%member) == 6, "six elements")
    if (size(model%member) /= 6) return
    call expect(all(model%member%kind == [type_beam, type_beam, type_beam, type_beam, type_beam, &
                                          type_beamw]), "kinds")
    call expect(.not. any(exists(1) .neqv. [.true., .true., .false.]), "no warping of a BEAM")
    call expect(.not. any(exists(13) .neqv. [.false., .true., .false.]), "only a rotation")
    call expect(.not. any(exists(24) .neqv. [.false., .false., .true.]), "only a warping")
    call expect(.not. any(model%node%exists(3) .and. model%node%part > 0), "nor of inner nodes")
    call expect(all(model%node(model%member(4)%node(1, :))%id == [3, 4]), "translations")
    call expect(all(model%node(model%member(4)%node(2, :))%id == [13, 14]), "rotations")
    call expect(all(model%member(4)%node(3, :) == model%member(4)%node(2, :)), "a placeholder")
    call expect_close(model%member(5)%triad(:, 2), [0.0_wp, 0.0_wp, 1.0_wp], 0.0_wp, "o, long form")
    call expect_close(model%member(3)%triad(:, 2), [0.0_wp, 0.0_wp, 1.0_wp], 0.0_wp, "o, short")
    call expect(all(model%member(2)%status == e) .and. all(model%member(3)%status == f), "status")
    call expect(count(model%node(node_of(model, 1))%fixed) == 6, "FIX holds what exists")

  contains

    function exists(id)
      integer, intent(in) :: id
      logical :: exists(3)

      exists = model%node(node_of(model, id))%exists
    end function exists
  end subroutine beams

  pure integer function node_of(model, id) result(k)
    type(model_t), intent(in) :: model
    integer, intent(in) :: id

    do k = 1, size(model%node)
      if (model%node(k)%id == id .and. model%node(k)%part == 0) return
    end do
    k = 1
  end function node_of

  subroutine beam_values()
    type(model_t) :: model

    call read_sound("NODE 1:3 {i} 0 0|BEAM 1 1 2|BEAMW 2 2 3|DYNE ALL 1 2 3 4 5 6|"// &
                    "ESTIFF 1:2 1 2 3 4 5 6|ESTIFF 1:2 7 6 5 4 3 2 1|EM 1 1 2 3 4 -1|"// &
                    "EM 2 5 6 7 8 0 9|EDAMP 1 1 2 3 4|EDAMP 2 5 6 7 8 9|ESIG ALL 9 8 7|"// &
                    "FIX 1", model)
    call expect(size(model%member) == 2, "the sizes")
    if (size(model%member) /= 2) return
    associate (a => model%member(1), b => model%member(2))
      call expect_close(a%stiffness, [1.0_wp, 2.0_wp, 3.0_wp, 4.0_wp, 5.0_wp, 6.0_wp, 0.0_wp], &
                        0.0_wp, "six values are for the BEAM of a list")
      call expect_close(b%stiffness, [7.0_wp, 6.0_wp, 5.0_wp, 4.0_wp, 3.0_wp, 2.0_wp, 1.0_wp], &
                        0.0_wp, "seven for the BEAMW")
      call expect_close(a%inertia, [1.0_wp, 2.0_wp, 3.0_wp, 4.0_wp, -1.0_wp, 0.0_wp], 0.0_wp, "EM")
      call expect_close(b%inertia(6), 9.0_wp, 0.0_wp, "EM, six values")
      call expect(a%has_damping .and. b%has_damping, "damped")
      call expect_close(a%damping, [1.0_wp, 2.0_wp, 3.0_wp, 4.0_wp, 0.0_wp], 0.0_wp, "EDAMP")
      call expect_close(b%damping, [5.0_wp, 6.0_wp, 7.0_wp, 8.0_wp, 9.0_wp], 0.0_wp, "EDAMP, five")
      call expect_close(a%initial_stress, [9.0_wp, 8.0_wp, 7.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, &
                                           0.0_wp], 0.0_wp, "ESIG")
      call expect(all(a%status(:6) == e), "DYNE")
    end associate
  end subroutine beam_values

  subroutine trusses()
    type(model_t) :: model

    call read_sound(frame//"FIX 1|NODE 3 1 2 2|TRUSS 2 1 3 SECTION bar MATERIAL steel MASS "// &
                    "LUMPED|TRUSS 3 2 3|DYNE 3 1|ESTIFF 3 50|EM 3 4|EDAMP 3 6|ESIG 3 -7", model)
    call expect(size(model%joint) == 2, "the sizes")
    if (size(model%joint) /= 2) return
    associate (a => model%joint(1), b => model%joint(2))
      call expect(a%kind == joint_truss .and. a%id == 2 .and. b%id == 3, "kind and id")
      call expect(a%section == 1 .and. a%material == 1 .and. a%mass == mass_lumped, "options")
      call expect(a%status(1) == e .and. b%status(1) == e, "flexible")
      call expect_close(a%chord, [1.0_wp, 2.0_wp, 2.0_wp], 0.0_wp, "chord")
      call expect(all(a%node == reshape([1, 0, 3, 0], [2, 2])), "translational nodes")
      call expect(.not. any(model%node(3)%exists .neqv. [.true., .false., .false.]), "exists")
      call expect(b%has_stiffness .and. b%has_damping .and. b%has_inertia, "given")
      call expect_close([b%stiffness(1), b%inertia, b%damping(1), b%initial_stress(1)], &
                        [50.0_wp, 4.0_wp, 6.0_wp, -7.0_wp], 0.0_wp, "its values")
    end associate
  end subroutine trusses

  subroutine joints()
    type(model_t) :: model
    integer :: k

    call read_sound(frame//"NODE 3 4 1 0|NODE 4 4 0 0|FIX 1|HINGE 2 2 22 0 3 4|"// &
                    "UNIVERSAL 3 22 23 0 0 2 5 0 0|SPHERICAL 4 2 4|CYLINDRICAL 5 2 3 0 -1 0|"// &
                    "PRISMATIC 6 2 3 1e200 0 1e200|RLSE 2 1|BEAM 7 4 3", model)
    call expect(size(model%joint) == 5, "the sizes")
    if (size(model%joint) /= 5) return
    call expect(all(model%joint%kind == [joint_hinge, joint_universal, joint_spherical, &
                                         joint_cylindrical, joint_prismatic]), "kinds")
    call expect_close(model%joint(1)%axis(:, 1), [0.0_wp, 0.6_wp, 0.8_wp], 1.0e-15_wp, "an axis")
    call expect_close(model%joint(2)%axis, reshape([0.0_wp, 0.0_wp, 1.0_wp, 1.0_wp, 0.0_wp, &
                                                    0.0_wp], [3, 2]), 0.0_wp, "two axes")
    call expect_close(model%joint(5)%axis(:, 1), [sqrt(0.5_wp), 0.0_wp, sqrt(0.5_wp)], 1.0e-15_wp, &
                      "a long vector")
    call expect(all(model%joint(1)%node(1, :) == 0) .and. model%joint(1)%node(2, 1) == 2, "hinge")
    k = model%joint(1)%node(2, 2)
    call expect(model%node(k)%id == 22 .and. .not. model%node(k)%placed, "needs no position")
    call expect(.not. any(model%node(k)%exists .neqv. [.false., .true., .false.]), "rotation only")
    call expect(all(model%joint(3)%node(2, :) == 0), "a ball has no rotations")
    call expect(all(model%joint(4)%node(1, :) == model%joint(4)%node(2, :)), "both kinds")
    call expect_close(model%joint(4)%chord, [0.0_wp, 1.0_wp, 0.0_wp], 0.0_wp, "chord")
    call expect(all(model%joint(1)%status(:3) == [r, f, f]), "HINGE")
    call expect(all(model%joint(2)%status(:3) == [r, r, f]), "UNIVERSAL")
    call expect(all(model%joint(3)%status == f), "SPHERICAL")
    call expect(all(model%joint(4)%status == [r, r, f, f, f, f]), "CYLINDRICAL")
    call expect(all(model%joint(5)%status == [r, f, f, f, f, f]), "PRISMATIC")
    call nearly_perpendicular()
  end subroutine joints

  !> Axes that are perpendicular within the tolerance are made so exactly.
  subroutine nearly_perpendicular()
    type(model_t) :: model

    call read_sound(pair//"UNIVERSAL 3 2 12 1 0 0 5e-7 1 0", model)
    call expect(size(model%joint) == 1, "a universal joint")
    if (size(model%joint) /= 1) return
    call expect_close(dot_product(model%joint(1)%axis(:, 1), model%joint(1)%axis(:, 2)), 0.0_wp, &
                      1.0e-16_wp, "perpendicular")
    call expect_close(norm2(model%joint(1)%axis(:, 2)), 1.0_wp, 1.0e-15_wp, "a unit vector")
  end subroutine nearly_perpendicular

  subroutine gears()
    type(model_t) :: model

    call read_sound(frame//"FIX 1|GEAR 4 3 2 -0.5|HINGE 2 2 12 0 0 1|HINGE 3 2 13 0 0 1|"// &
                    "RLSE 2:3 1|BEAM 5 2 12 6 13|NODE 6 4 4 0", model)
    call expect(size(model%joint) == 3, "the sizes")
    if (size(model%joint) /= 3) return
    associate (gear => model%joint(1))
      call expect(gear%kind == joint_gear, "a gear")
      call expect(all(model%joint(gear%gear)%id == [3, 2]), "its hinges, given behind it")
      call expect_close(gear%ratio, -0.5_wp, 0.0_wp, "its ratio")
      call expect(all(gear%status == f) .and. all(gear%node == 0), "one fixed mode, no nodes")
    end associate
  end subroutine gears

  subroutine statuses()
    type(model_t) :: model

    call read_sound(pair//"HINGE 3 2 12 0 0 1|UNIVERSAL 4 2 12 1 0 0 0 1 0|"// &
                    "CYLINDRICAL 5 2 3 0 1 0|GROUP all_joints ELEMENTS 3:5|RLSE all_joints 1|"// &
                    "RLSE 3:5 5|DYNE 4 2|"// &
                    "INPUTE 5 2 0.3|ESTIFF 4 0 6|RLSE ALL 7|DYNE 2 1 2|RLSE 1 2", model)
    call expect(size(model%joint) == 3, "the sizes")
    if (size(model%joint) /= 3) return
    call expect(all(model%joint(1)%status(:3) == [r, f, f]), "a group")
    call expect(all(model%joint(2)%status(:3) == [r, e, f]), "DYNE replaces a released mode")
    call expect(all(model%joint(3)%status == [r, p, f, f, r, f]), "so does INPUTE; a range")
    call expect(all(model%member(2)%status(:6) == [e, e, f, f, f, f]), "DYNE of a BEAM")
    call expect(all(model%member(1)%status == [e, r, e, e, e, e, r, f]), "ALL: where it applies")
  end subroutine statuses

  subroutine properties()
    type(model_t) :: model

    call read_sound(pair//"HINGE 3 2 12 0 0 1|PRISMATIC 4 2 3 0 1 0|TRUSS 5 1 3|DYNE 3:5 1|"// &
                    "ESTIFF 3:5 7|EDAMP 3:4 1 2|EDAMP 5 8|ESIG 3:4 -1 2 3|ESIG 5 4", model)
    call expect(size(model%joint) == 3, "the sizes")
    if (size(model%joint) /= 3) return
    call expect_close(model%joint%stiffness(1), [7.0_wp, 7.0_wp, 7.0_wp], 0.0_wp, "ESTIFF")
    call expect_close(model%joint(2)%damping, [1.0_wp, 2.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp], &
                      0.0_wp, "EDAMP")
    call expect_close(model%joint(1)%initial_stress(:3), [-1.0_wp, 2.0_wp, 3.0_wp], 0.0_wp, "ESIG")
    call expect_close([model%joint(3)%damping(1), model%joint(3)%initial_stress(1)], &
                      [8.0_wp, 4.0_wp], 0.0_wp, "of the TRUSS")
  end subroutine properties

  subroutine strains()
    type(model_t) :: model

    call read_sound(pair//"HINGE 3 2 12 0 0 1|INPUTE 3 1 0.5 0.25 -2 FUNCTION g|"// &
                    "FUNCTION g RAMP 0 1|INPUTE 1:2 3 0.125|INPUTE 2 1 0.1 4|"// &
                    "BEAMW 4 1 3 SECTION bar MATERIAL steel DIVIDE 2|INPUTE 4 2 0.5|"// &
                    "INPUTE 4.2 6 -0.5", model)
    call expect(size(model%pattern) == 1, "one pattern")
    if (size(model%pattern) /= 1) return
    associate (m => model%pattern(1)%motion)
      call expect(size(m) == 7 .and. model%pattern(1)%motions == 7, "seven motions")
      if (size(m) /= 7) return
      call expect(m(1)%joint == 1 .and. m(1)%member == 0 .and. m(1)%mode == 1, "of the hinge")
      call expect_close([m(1)%value, m(1)%velocity, m(1)%acceleration], &
                        [0.5_wp, 0.25_wp, -2.0_wp], 0.0_wp, "value, velocity, acceleration")
      call expect(m(1)%function == 1 .and. m(2)%function == 0, "a function")
      call expect(all(m(2:7)%member == [1, 2, 2, 3, 4, 4]), "of beams, a range, parts")
      call expect(all(m(2:7)%mode == [3, 3, 1, 2, 2, 6]), "modes")
      call expect_close(m(7)%value, -0.5_wp, 0.0_wp, "of a part")
    end associate
    call expect(model%joint(1)%status(1) == p .and. all(model%joint(1)%status(2:3) == f), "hinge")
    call expect(all(model%member(2)%status(:6) == [p, e, p, e, e, e]), "instead of flexible")
    call expect(all(model%member(4)%status == [e, p, e, e, e, p, f, f]), "7 and 8 follow mode 2")
  end subroutine strains

  subroutine coordinates()
    type(model_t) :: model

    call read_sound(pair//"BEAMW 3 2 32 33 3 42 43|FUNCTION g RAMP 0 1|INPUTX 3 X 5 2|"// &
                    "INPUTX 2:3 Z -0.5 0 3|INPUTX 2 RY 0.25|INPUTX 33 1 0.125|INPUTX 42 3 0.5|"// &
                    "INPUTX 32 RZ -0.5|INPUTX 3 Y 2 FUNCTION g|INPUTX 43 w 0.75|"// &
                    "NODE 7 0 0 2.5|BEAM 7 3 7|INPUTX 7 Z 3", model)
    call expect(size(model%pattern) == 1, "one pattern")
    if (size(model%pattern) /= 1) return
    associate (m => model%pattern(1)%motion)
      call expect(size(m) == 10, "ten motions")
      if (size(m) /= 10) return
      call expect(all(m%component == [1, 3, 3, 5, 7, 5, 6, 2, 7, 3]), "components")
      call expect(all(model%node(m%node)%id == [3, 2, 3, 2, 33, 42, 32, 3, 43, 7]), "nodes")
      call expect(.not. any(m%euler .neqv. [.false., .false., .false., .false., .false., .true., &
                                            .false., .false., .false., .false.]), "by number")
      call expect_close(m%value, [1.0_wp, -0.5_wp, -0.5_wp, 0.25_wp, 0.125_wp, 0.5_wp, -0.5_wp, &
                                  2.0_wp, 0.75_wp, 0.5_wp], 0.0_wp, "less the position")
      call expect_close(m(1)%velocity, 2.0_wp, 0.0_wp, "velocity")
      call expect_close(m(3)%acceleration, 3.0_wp, 0.0_wp, "acceleration")
      call expect(all(m%member == 0) .and. all(m%joint == 0), "of no element")
    end associate
  end subroutine coordinates

  !> The coordinate that INPUTX gives is reached: position + sum of value times factor.
  subroutine patterns()
    type(model_t) :: model

    call read_sound(pair//"FUNCTION g TABLE 0 0 1 0.5|INPUTX 3 X 6|INPUTE 1 1 0.5|INPUTX 3 Z 9|"// &
                    "INPUTX 2 Z 3 FUNCTION g|STATIC TO 0.5|INPUTX 3 X 7|DELINPX 3 Z 1|"// &
                    "DELINPE 1 1 0.25|STATIC|EIGEN|INPUTX 3 Z 2|INPUTE 1 1 1|INPUTX 2 Z 4|"// &
                    "INPUTX 3 X 7|STATIC", model)
    call expect(size(model%pattern) == 4, "four patterns")
    if (size(model%pattern) /= 4) return
    call expect(all(model%analysis%pattern == [1, 2, 3, 3, 4]), "which analysis ramps which")
    associate (p1 => model%pattern(1)%motion, p2 => model%pattern(2)%motion, &
               p3 => model%pattern(3)%motion, p4 => model%pattern(4)%motion)
      call expect(all([size(p1), size(p2), size(p3), size(p4)] == [4, 1, 2, 4]), "their motions")
      if (any([size(p1), size(p2), size(p3), size(p4)] /= [4, 1, 2, 4])) return
      call expect_close(4 + 0.5_wp*p1(1)%value + p2(1)%value + p4(4)%value, 7.0_wp, 1.0e-15_wp, "X")
      call expect_close(p2(1)%value, 2.0_wp, 1.0e-15_wp, "X at the half of its first motion")
      call expect_close(p4(4)%value, 0.0_wp, 1.0e-15_wp, "X is there")
      call expect_close(p3%value, [1.0_wp, 0.25_wp], 0.0_wp, "increments")
      call expect_close(0.5_wp*9 + 1 + p4(1)%value, 2.0_wp, 1.0e-15_wp, "Z")
      call expect_close(0.5_wp*0.5_wp + 0.25_wp + p4(2)%value, 1.0_wp, 1.0e-15_wp, "strain")
      call expect_close(3*0.25_wp + p4(3)%value, 4.0_wp, 1.0e-15_wp, "behind a FUNCTION")
    end associate
  end subroutine patterns

  subroutine halt()
    call declared()
    call only_declared()
  end subroutine halt

  !> Before HALT numbers are components and modes; what gets no value is held.
  subroutine declared()
    type(model_t) :: model

    call read_sound("NODE 1 0 0 0|NODE 2 1 2 3|BEAM 1 1 11 2 12|DYNE 1 1 2|HINGE 2 12 13 0 0 1|"// &
                    "INPUTX 2 1 3|INPUTX 12 2 3|INPUTE 2 1 3|INPUTE 1 3|FIX 1|END|HALT|"// &
                    "ESTIFF 1 1 1 1 1 0 0|INPUTX 2 1 3|INPUTE 2 1 2 3|XF 2 0 1 0|"// &
                    "DELINPX 12 2 0.25|END|END", model)
    call expect(size(model%pattern) == 2, "two patterns")
    if (size(model%pattern) /= 2) return
    associate (m => model%pattern(1)%motion, d => model%pattern(2)%motion)
      call expect(size(m) == 6 .and. size(d) == 1, "the sizes")
      if (size(m) /= 6 .or. size(d) /= 1) return
      call expect(m(1)%component == 1 .and. m(2)%mode == 1, "what has values")
      call expect_close([m(1)%value, m(2)%value, m(2)%velocity], [2.0_wp, 2.0_wp, 3.0_wp], 0.0_wp, &
                        "values behind HALT")
      call expect(all(m(3:)%component == [3, 5, 0, 0]), "declared coordinates")
      call expect(all(m(3:)%mode == [0, 0, 3, 3]), "declared strains")
      call expect_close(m(3:)%value, [0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp], 0.0_wp, "are held")
      call expect(m(4)%euler .and. d(1)%euler .and. .not. m(1)%euler, "Euler parameters")
      call expect(d(1)%component == 4, "declared for the second pattern only")
    end associate
    call expect(all(model%joint(1)%status(:3) == [p, f, p]), "hinge")
    call expect(all(model%member(1)%status(:6) == [e, e, p, f, f, f]), "beam")
  end subroutine declared

  !> A declaration without components is of all that exist; it needs no loads.
  subroutine only_declared()
    type(model_t) :: model
    type(report_t) :: report

    call read_sound("NODE 1 0 0 0|NODE 2 1 2 3|BEAM 1 1 2|FIX 1|INPUTX 2|HALT|EIGEN", model)
    call expect(size(model%pattern) == 1, "a pattern to hold them")
    if (size(model%pattern) /= 1) return
    call expect(model%analysis(1)%pattern == 0, "that no analysis ramps")
    associate (m => model%pattern(1)%motion)
      call expect(size(m) == 6 .and. model%pattern(1)%loads == 0, "six coordinates")
      if (size(m) /= 6) return
      call expect(all(m%component == [1, 2, 3, 4, 5, 6]) .and. .not. any(m%euler), "components")
      call expect(.not. any(abs(m%value) > 0), "held")
    end associate
    call read_sample("NODE 1 0 0 0|NODE 2 1 2 3|BEAM 1 1 2|FIX 1|INPUTX 2 1 3|HALT|INPUTX 2 4 1", &
                     model, report)
    call expect(report%errors() == 3, "numbers on an id of several kinds")
  end subroutine only_declared

  subroutine masses()
    type(model_t) :: model

    call read_sound(pair//"XM 2 5|XM 2:3 1 10 1 2 20 3 30|XM 12 1 0 0 1 0 1|XM 2 4 0 0 4 0 4|"// &
                    "XM ALL 0.5", model)
    call expect(size(model%mass) == 4, "one entry a node")
    if (size(model%mass) /= 4) return
    call expect(all(model%node(model%mass%node)%id == [2, 3, 12, 1]), "nodes")
    call expect_close(model%mass%mass, [6.5_wp, 1.5_wp, 0.0_wp, 0.5_wp], 0.0_wp, "masses add up")
    call expect_close(model%mass(1)%inertia, reshape([14.0_wp, 1.0_wp, 2.0_wp, 1.0_wp, 24.0_wp, &
                                                      3.0_wp, 2.0_wp, 3.0_wp, 34.0_wp], [3, 3]), &
                      0.0_wp, "inertias too")
    call expect_close(model%mass(3)%inertia(3, 3), 1.0_wp, 0.0_wp, "of a rotational node")
    call inertias()
  end subroutine masses

  !> A thin rod along (1, 1, 1) and a plate are at the edge of what a body can have; one step
  !> further is not.
  subroutine inertias()
    type(report_t) :: report
    type(model_t) :: model

    call read_sample(pair//"XF 3 0 0 1|XM 2 2 -1 -1 2 -1 2|XM 3 0.1 0 0 0.2 0 {0.1+0.2}", model, &
                     report)
    call expect(report%errors() == 0 .and. report%warnings() == 0, "a rod, a plate")
    call read_sample(pair//"XF 3 0 0 1|XM 2 2 -1.001 -1 2 -1 2", model, report)
    call expect(report%errors() == 1, "a negative principal moment")
    call read_sample(pair//"XF 3 0 0 1|XM 2 0.1 0 0 0.2 0 0.301", model, report)
    call expect(report%errors() == 0 .and. report%warnings() == 1, "more than the sum")
  end subroutine inertias

  subroutine starts()
    type(model_t) :: model

    call read_sound(pair//"STARTX 3 Z 0.5|STARTDX 3 Z -2|STARTDX 2:3 RY 4|STARTX 12 RX 0.1|"// &
                    "HINGE 3 2 12 0 0 1|RLSE 3 1|STARTDE 3 1 7|STARTDE 1 2 8|"// &
                    "STARTDX ALL X 1", model)
    call expect(size(model%start) == 9, "the sizes")
    if (size(model%start) /= 9) return
    associate (s => model%start)
      call expect(all(s%component == [3, 3, 5, 5, 4, 0, 0, 1, 1]), "components")
      call expect(all(s%mode == [0, 0, 0, 0, 0, 1, 2, 0, 0]), "modes")
      call expect(.not. any(s%rate .neqv. [.false., .true., .true., .true., .false., .true., &
                                           .true., .true., .true.]), "position or velocity")
      call expect_close(s%value, [0.5_wp, -2.0_wp, 4.0_wp, 4.0_wp, 0.1_wp, 7.0_wp, 8.0_wp, 1.0_wp, &
                                  1.0_wp], 0.0_wp, "values as given")
      call expect(s(6)%joint == 1 .and. s(6)%member == 0 .and. s(7)%member == 1, "elements")
      call expect(all(model%node(s([1, 3, 5, 8, 9])%node)%id == [3, 2, 12, 2, 3]), "nodes")
    end associate
  end subroutine starts

  subroutine followers()
    type(model_t) :: model

    call read_sound(pair//"MARKER tip 3 AT 1 0|XF 3 0 0 1|XF 3 1 0 0 FOLLOWER AT 0 1|"// &
                    "XF 12 0 0 1 FOLLOWER|XF tip 1 0 0 FOLLOWER|DELXF 3 0 1 0 FOLLOWER", model)
    call expect(size(model%pattern) == 2, "two patterns")
    if (size(model%pattern) /= 2) return
    call expect(.not. any(model%pattern(1)%load%follower .neqv. &
                          [.false., .true., .true., .true.]), "XF")
    call expect(model%pattern(2)%load(1)%follower, "DELXF")
  end subroutine followers

  !> Stiffness 0 is not worth a word where there is damping.
  subroutine damper()
    type(model_t) :: model
    type(report_t) :: report

    call read_sample(frame//"FIX 1|XF 2 0 0 1|TRUSS 2 1 3|NODE 3 4 3 0|TRUSS 3 2 3|DYNE 2:3 1|"// &
                     "EDAMP 2 5|ESTIFF 3 0|EDAMP 3 1|BEAM 4 2 3|DYNE 4 1|ESTIFF 4 0 0 0 0 0 0|"// &
                     "EDAMP 4 1 0 0 0", model, report)
    call expect(report%errors() == 0 .and. report%warnings() == 0, "nothing to say")
    call expect(all(model%joint%status(1) == e), "flexible")
  end subroutine damper

  !> A pendulum of a bar and a mass is a model, and gravity has something to act on.
  subroutine alone()
    type(model_t) :: model
    type(report_t) :: report
    character(len=*), parameter :: pendulum = "NODE 1 0 0 0|NODE 2 1 0 0|TRUSS 1 1 2|FIX 1|"// &
      "DYNE 1 1|ESTIFF 1 5|GRAVITY 0 0 -9.81|"

    call read_sample(pendulum//"XM 2 3", model, report)
    call expect(report%errors() == 0 .and. report%warnings() == 0, "a pendulum")
    call expect(size(model%member) == 0 .and. size(model%joint) == 1, "without beams")
    call read_sample(pendulum//"EM 1 3", model, report)
    call expect(report%errors() == 0 .and. report%warnings() == 0, "a heavy bar")
    call read_sample(pendulum, model, report)
    call expect(report%errors() == 0 .and. report%warnings() == 1, "a weightless one is warned of")
  end subroutine alone

end module test_deck_joints
