!> Initial assembly: gaps that close, and nearest; loops that cannot.
module test_start_assembly
  use kinds, only: wp
  use check, only: run, expect, expect_close
  use errors, only: error_t, exit_deck
  use deck_samples, only: read_sound
  use memory_recorder, only: memory_t, run_model
  use model_data, only: model_t, joint_t, motion_t, start_t, joint_spherical, joint_hinge, &
                        mode_released
  use nodal_state, only: state_t
  use system_data, only: system_t
  use start_models, only: frame_of_nodes, add_truss, add_joint, add_mass, add_motion, add_start, &
                          start, expect_error
  implicit none
  private

  public :: run_start_assembly_tests

  !> Crank 1-2, coupler 2-3, rocker 5-4; nodes 3 and 5 are to meet.
  real(wp), parameter :: linkage(3, 5) = reshape( &
    [0.0_wp, 0.0_wp, 0.0_wp, 0.3_wp, 2.0_wp, 0.0_wp, 2.8_wp, 2.7_wp, 0.0_wp, 3.0_wp, 0.2_wp, &
     0.0_wp, 2.9_wp, 2.3_wp, 0.0_wp], [3, 5])

contains

  subroutine run_start_assembly_tests()
    call run("start: a four-bar linkage drawn with a gap closes, nearest", four_bar)
    call run("start: a closed model is not touched", closed)
    call run("start: a loop that cannot close", broken_loop)
    call run("start: STARTX turns a linkage", given_position)
    call run("start: STARTX bends a beam as a force would", bent_beam)
    call run("start: STARTX turns a node", given_angle)
    call run("start: STARTX that the constraints do not allow", impossible_position)
    call run("start: constraints are redundant where they are assembled", bent_pair)
    call run("start: a linkage of bodies in space, redundantly hinged, driven in a hinge", hinged)
    call run("start: a long chain", chain)
    call run("start: a motion that jumps after a STATIC", late_motion)
    call run("start: an angle of a half turn", half_turn)
  end subroutine run_start_assembly_tests

  subroutine new_linkage(model)
    type(model_t), intent(out) :: model
    type(joint_t) :: ball

    call frame_of_nodes(linkage, [1, 4], model)
    call add_truss(model, 1, 2)
    call add_truss(model, 2, 3)
    call add_truss(model, 5, 4)
    ball%kind = joint_spherical
    ball%node(1, :) = [3, 5]
    ball%chord = linkage(:, 5) - linkage(:, 3)
    call add_joint(model, ball)
  end subroutine new_linkage

  !> Where the linkage is with its crank at an angle: the ends of coupler and rocker meet on two
  !> circles, on the side they were drawn.
  pure function posture(angle) result(at)
    real(wp), intent(in) :: angle
    real(wp) :: at(2, 5), line(2), r(3), d, along, height

    at = linkage(:2, :)
    r = [norm2(at(:, 2)), norm2(at(:, 3) - at(:, 2)), norm2(at(:, 5) - at(:, 4))]
    at(:, 2) = r(1)*[cos(angle), sin(angle)]
    line = at(:, 4) - at(:, 2)
    d = norm2(line)
    line = line/d
    along = (d**2 + r(2)**2 - r(3)**2)/(2*d)
    height = sqrt(r(2)**2 - along**2)
    at(:, 3) = at(:, 2) + along*line + height*[-line(2), line(1)]
    at(:, 5) = at(:, 3)
  end function posture

  !> Sum of the squares of the displacements.
  pure real(wp) function effort(angle)
    real(wp), intent(in) :: angle

    effort = sum((posture(angle) - linkage(:2, :))**2)
  end function effort

  !> The nearest posture by thirds, against the one found.
  subroutine four_bar()
    type(model_t) :: model
    type(system_t) :: system
    type(state_t) :: state
    type(error_t), allocatable :: error
    real(wp), allocatable :: velocity(:)
    real(wp) :: low, high, a, b
    integer :: i

    call new_linkage(model)
    call start(model, system, state, velocity, error)
    if (allocated(error)) call expect(.false., "no error, got: "//error%message)
    if (allocated(error)) return
    low = 1.2_wp
    high = 1.7_wp
    do i = 1, 60
      a = low + (high - low)/3
      b = high - (high - low)/3
      if (effort(a) < effort(b)) then
        high = b
      else
        low = a
      end if
    end do
    associate (at => linkage + state%displacement)
      call expect_close(norm2(at(:, 2)), norm2(linkage(:, 2)), 3.0e-12_wp, "crank")
      call expect_close(norm2(at(:, 3) - at(:, 2)), norm2(linkage(:, 3) - linkage(:, 2)), &
                        3.0e-12_wp, "coupler")
      call expect_close(norm2(at(:, 4) - at(:, 5)), norm2(linkage(:, 4) - linkage(:, 5)), &
                        3.0e-12_wp, "rocker")
      call expect_close(at(:, 3), at(:, 5), 3.0e-12_wp, "joint")
      call expect_close(at(:2, :), posture(atan2(at(2, 2), at(1, 2))), 1.0e-11_wp, "its posture")
      ! a minimum found by comparing values is known to the root of round-off
      call expect_close(atan2(at(2, 2), at(1, 2)), low, 1.0e-7_wp, "nearest posture")
    end associate
    call system%free()
  end subroutine four_bar

  subroutine closed()
    type(model_t) :: model
    type(system_t) :: system
    type(state_t) :: state
    type(error_t), allocatable :: error
    real(wp), allocatable :: velocity(:)

    call new_linkage(model)
    model%node(3)%position = model%node(5)%position
    model%joint(2)%chord = model%node(3)%position - model%node(2)%position
    model%joint(4)%chord = 0
    call start(model, system, state, velocity, error)
    if (allocated(error)) call expect(.false., "no error, got: "//error%message)
    call expect(.not. any(abs(state%displacement) > 0), "nothing moved")
    call expect(.not. any(abs(velocity) > 0), "velocities are zero")
    call system%free()
  end subroutine closed

  !> Two bars of sqrt(1.25) over a span of 2, one shortened by 0.3: 2 - (2 sqrt(1.25) - 0.3) is
  !> missing, half of it to each.
  subroutine broken_loop()
    type(model_t) :: model
    type(memory_t) :: memory
    type(error_t), allocatable :: error

    call frame_of_nodes(reshape([0.0_wp, 0.0_wp, 0.0_wp, 1.0_wp, 0.5_wp, 0.0_wp, 2.0_wp, 0.0_wp, &
                                 0.0_wp], [3, 3]), [1, 3], model)
    call add_truss(model, 1, 2)
    call add_truss(model, 2, 3)
    call add_motion(model, motion_t(joint=1, mode=1, value=-0.3_wp))
    call run_model(model, memory, error)
    call expect_error(error, "the loop does not close: element ")
    call expect_error(error, " mode 1 (elongation) is off by 0.032")
    if (allocated(error)) call expect(error%status == exit_deck, "status 3")
  end subroutine broken_loop

  !> The crank's end is put where a posture has it.
  subroutine given_position()
    type(model_t) :: model
    type(system_t) :: system
    type(state_t) :: state
    type(error_t), allocatable :: error
    real(wp), allocatable :: velocity(:)
    real(wp) :: at(2, 5)

    call new_linkage(model)
    at = posture(0.9_wp)
    call add_start(model, start_t(node=2, component=1, value=at(1, 2)))
    call start(model, system, state, velocity, error)
    if (allocated(error)) call expect(.false., "no error, got: "//error%message)
    if (allocated(error)) return
    call expect_close(linkage(:2, :) + state%displacement(:2, :), at, 1.0e-11_wp, "posture")
    call system%free()
  end subroutine given_position

  !> w = (3 x^2 L - x^3)/(2 L^3) of the tip's, to the order of its slope squared.
  subroutine bent_beam()
    real(wp), parameter :: tip = 1.0e-4_wp
    type(model_t) :: model
    type(system_t) :: system
    type(state_t) :: state
    type(error_t), allocatable :: error
    real(wp), allocatable :: velocity(:)
    integer :: i

    call read_sound("MATERIAL m E 2e11 G 8e10 RHO 7800|"// &
                    "SECTION s CONSTANTS A 1e-4 IY 1e-9 IZ 1e-9 IT 2e-9|"// &
                    "NODE 1 0 0 0|NODE 2 1 0 0|BEAMW 1 1 2 SECTION s MATERIAL m DIVIDE 4 "// &
                    "SHEAR OFF|FIX 1|TRANSIENT TEND 1 STEP 0.1", model)
    call add_start(model, start_t(node=2, component=3, value=tip))
    call start(model, system, state, velocity, error)
    if (allocated(error)) call expect(.false., "no error, got: "//error%message)
    if (allocated(error)) return
    do i = 1, size(model%node)
      associate (x => model%node(i)%position(1))
        call expect_close(state%displacement(3, i), tip*(3*x**2 - x**3)/2, 1.0e-5_wp*tip, &
                          "deflection")
      end associate
    end do
    call system%free()
  end subroutine bent_beam

  !> A body on a pin, turned by 3 radians; the far end follows.
  subroutine given_angle()
    type(model_t) :: model
    type(system_t) :: system
    type(state_t) :: state
    type(error_t), allocatable :: error
    real(wp), allocatable :: velocity(:)

    call read_sound("NODE 1 0 0 0|NODE 2 2 0 0|BEAMW 1 1 2 0 0 1|EM 1 3 0 0 0 0 0|"// &
                    "FIX 1 X Y Z RX RY|TRANSIENT TEND 1 STEP 0.1", model)
    call add_start(model, start_t(node=1, component=6, value=3.0_wp))
    call start(model, system, state, velocity, error)
    if (allocated(error)) call expect(.false., "no error, got: "//error%message)
    if (allocated(error)) return
    call expect_close(state%euler(:, 1), [cos(1.5_wp), 0.0_wp, 0.0_wp, sin(1.5_wp)], 1.0e-12_wp, &
                      "angle")
    call expect_close(state%displacement(:, 2), 2*[cos(3.0_wp) - 1, sin(3.0_wp), 0.0_wp], &
                      1.0e-11_wp, "far end")
    call system%free()
  end subroutine given_angle

  subroutine impossible_position()
    type(model_t) :: model
    type(system_t) :: system
    type(state_t) :: state
    type(error_t), allocatable :: error
    real(wp), allocatable :: velocity(:)

    call new_linkage(model)
    call add_start(model, start_t(node=2, component=2, value=4.0_wp))
    call start(model, system, state, velocity, error)
    call expect_error(error, "the constraints do not let STARTX be met: node 2 Y is off by ")
    call system%free()
  end subroutine impossible_position

  !> Two bars drawn in line, where three constraints are two; bent they are independent.
  subroutine bent_pair()
    type(model_t) :: model
    type(memory_t) :: memory
    type(error_t), allocatable :: error

    call frame_of_nodes(reshape([0, 0, 0, 1, 0, 0, 2, 0, 0]*1.0_wp, [3, 3]), [1], model)
    model%node(3)%fixed(2) = .true.
    call add_truss(model, 1, 2)
    call add_truss(model, 2, 3)
    call add_mass(model, 2, 1.0_wp)
    call add_mass(model, 3, 1.0_wp)
    call add_motion(model, motion_t(node=3, component=1, value=-0.1_wp))
    call add_start(model, start_t(node=2, component=2, value=sqrt(1 - 0.95_wp**2)))
    call run_model(model, memory, error)
    if (allocated(error)) call expect(.false., "no error, got: "//error%message)
    if (allocated(error)) return
    call expect(size(memory%remarks) == 1, "no warnings")
    if (size(memory%remarks) /= 1) return
    call expect(memory%remarks(1)%s == "starts off the drawing, as constraints, drives or "// &
                "STARTX ask: node 2 by 0.3162", memory%remarks(1)%s)   ! the root of 0.1
    call expect_close(memory%results(memory%steps)%displacement(:, 2), &
                      [-0.05_wp, sqrt(1 - 0.95_wp**2), 0.0_wp], 1.0e-10_wp, "they stay")
  end subroutine bent_pair

  !> Four bars in a plane with axes that are all held normal to it; the second turns against
  !> the first by 0.3 radians.
  subroutine hinged()
    real(wp), parameter :: at(3, 4) = reshape([0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 2.0_wp, 0.0_wp, &
      3.0_wp, 3.0_wp, 0.0_wp, 3.5_wp, 0.0_wp, 0.0_wp], [3, 4]), bit = 0.3_wp, pi = acos(-1.0_wp)
    type(model_t) :: model
    type(system_t) :: system
    type(state_t) :: state
    type(error_t), allocatable :: error
    real(wp), allocatable :: velocity(:)
    real(wp) :: now(3, 4), turned(3, 2)
    integer :: i

    call read_sound("NODE 1 0 0 0|NODE 2 0 2 0|NODE 3 3 3 0|NODE 4 3.5 0 0|NODE 5 0 2 0|"// &
                    "NODE 6 3 3 0|NODE 7 3 3 0|NODE 8 3.5 0 0|BEAMW 1 1 1 1 2 2 2 0 0 1|"// &
                    "BEAMW 2 2 5 5 3 6 6 0 0 1|BEAMW 3 3 7 7 4 8 8 0 0 1|EM 1:3 1 0 0 0 0 0|"// &
                    "FIX 1 X Y Z RX RY|FIX 4 X Y Z|FIX 8 RX RY|XF 2 0 0 0|"// &
                    "TRANSIENT TEND 1 STEP 0.1", model)
    call add_hinge(model, [2, 5])
    call add_hinge(model, [6, 7])
    call add_motion(model, motion_t(joint=1, mode=1, value=bit))
    call start(model, system, state, velocity, error)
    if (allocated(error)) call expect(.false., "no error, got: "//error%message)
    if (allocated(error)) return
    now = at + state%displacement(:, :4)
    do i = 1, 3
      call expect_close(norm2(now(:, i + 1) - now(:, i)), norm2(at(:, i + 1) - at(:, i)), &
                        1.0e-11_wp, "length")
    end do
    call expect_close(now(3, :), spread(0.0_wp, 1, 4), 1.0e-11_wp, "in the plane")
    turned(:, 1) = at(:, 3) - at(:, 2)
    turned(:, 2) = now(:, 3) - now(:, 2)
    associate (a => turned(:, 1), b => turned(:, 2), crank => now(:, 2))
      call expect_close(modulo(atan2(b(2), b(1)) - atan2(a(2), a(1)) + pi/2 &
                               - atan2(crank(2), crank(1)) + pi, 2*pi) - pi, bit, 1.0e-11_wp, &
                        "relative angle")
    end associate
    call system%free()
  end subroutine hinged

  subroutine add_hinge(model, nodes)
    type(model_t), intent(inout) :: model
    integer, intent(in) :: nodes(2)
    type(joint_t) :: hinge

    hinge%kind = joint_hinge
    hinge%node(2, :) = nodes
    hinge%axis(:, 1) = [0.0_wp, 0.0_wp, 1.0_wp]
    hinge%status(1) = mode_released
    call add_joint(model, hinge)
  end subroutine add_hinge

  !> Bars along a zigzag, the last end moved: the lengths stay, in many unknowns.
  subroutine chain()
    integer, parameter :: bars = 200
    type(model_t) :: model
    type(system_t) :: system
    type(state_t) :: state
    type(error_t), allocatable :: error
    real(wp), allocatable :: velocity(:)
    real(wp) :: at(3, bars + 1), now(3, bars + 1)
    integer :: i

    do i = 1, bars + 1
      at(:, i) = [real(i - 1, wp), 0.5_wp*modulo(i, 2), 0.0_wp]
    end do
    call frame_of_nodes(at, [1], model)
    do i = 1, bars
      call add_truss(model, i, i + 1)
      call add_mass(model, i + 1, 1.0_wp)
    end do
    call add_start(model, start_t(node=bars + 1, component=1, value=bars - 2.0_wp))
    call add_start(model, start_t(node=bars + 1, component=2, rate=.true., value=1.0_wp))
    call start(model, system, state, velocity, error)
    if (allocated(error)) call expect(.false., "no error, got: "//error%message)
    if (allocated(error)) return
    now = at + state%displacement
    call expect_close(now(1, bars + 1), bars - 2.0_wp, 1.0e-9_wp, "its end")
    do i = 1, bars
      call expect_close(norm2(now(:, i + 1) - now(:, i)), norm2(at(:, i + 1) - at(:, i)), &
                        1.0e-12_wp*bars, "length")
      associate (v => velocity(7*i + 1:7*i + 3) - velocity(7*i - 6:7*i - 4))
        call expect_close(dot_product(v, now(:, i + 1) - now(:, i)), 0.0_wp, 1.0e-12_wp, "rigid")
      end associate
    end do
    call expect_close(velocity(7*bars + 2), 1.0_wp, 1.0e-12_wp, "the end's velocity")
    call system%free()
  end subroutine chain

  !> The tip of a beam is held during a STATIC and let start elsewhere.
  subroutine late_motion()
    real(wp), parameter :: tip = 1.0e-3_wp
    type(model_t) :: model
    type(memory_t) :: memory
    type(error_t), allocatable :: error

    call read_sound("MATERIAL m E 1000 G 400 RHO 1|SECTION s CONSTANTS A 1 IY 1 IZ 2 IT 1|"// &
                    "NODE 1 0 0 0|NODE 2 3 0 0|BEAMW 1 1 2 SECTION s MATERIAL m|FIX 1|"// &
                    "XF 2 1 0 0|STATIC STEPS 1|XF 2 2 0 0|TRANSIENT TEND 0.1 STEP 0.1", model)
    call expect(size(model%pattern) == 2, "two patterns")
    model%pattern(2)%motion = [motion_t(node=2, component=3, value=tip)]
    model%pattern(2)%motions = 1
    call run_model(model, memory, error)
    if (allocated(error)) call expect(.false., "no error, got: "//error%message)
    if (allocated(error)) return
    call expect_close(memory%results(1)%displacement(3, 2), 0.0_wp, 1.0e-15_wp, "held")
    call expect_close(memory%results(2)%displacement(3, 2), tip, 1.0e-13_wp, "at the start")
    call expect_close(memory%results(2)%displacement(1, 2), 3.0e-3_wp, 1.0e-5_wp, "still stretched")
  end subroutine late_motion

  !> Steps up to 2.4 of 4 radians; the next passes pi.
  subroutine half_turn()
    type(model_t) :: model
    type(memory_t) :: memory
    type(error_t), allocatable :: error

    call read_sound("MATERIAL m E 1000 G 400|SECTION s CONSTANTS A 1 IY 1 IZ 2 IT 1|"// &
                    "NODE 1 0 0 0|NODE 2 3 0 0|BEAMW 1 1 2 SECTION s MATERIAL m|"// &
                    "FIX 1 X Y Z RY RZ|XF 2 0 0 0|STATIC STEPS 5", model)
    call add_motion(model, motion_t(node=1, component=4, value=4.0_wp))
    call run_model(model, memory, error)
    call expect_error(error, "node 1 RX is prescribed an angle of 3.2, and INPUTX turns a node "// &
                      "by less than pi; a HINGE with INPUTE makes full turns")
    call expect(memory%steps == 3, "three steps are kept")
    if (memory%steps < 3) return
    call expect_close(memory%results(3)%euler(:, 2), [cos(1.2_wp), sin(1.2_wp), 0.0_wp, 0.0_wp], &
                      1.0e-9_wp, "the beam turns with its end")
  end subroutine half_turn

end module test_start_assembly
