!> Elements SLIDER and CARRIAGE on a chain of three beams between nodes 1 to 4; node 5 slides.
module test_slider
  use kinds, only: wp
  use check, only: run, expect, expect_close
  use element_base, only: element_t
  use element_differences, only: compare_with_differences
  use element_slider, only: track_t, new_element_slider
  use nodal_state, only: state_t, new_state, node_coordinates
  use rotation, only: rotated, turned, identity3
  implicit none
  private

  public :: run_slider_tests

  integer, parameter :: beams = 3, nodes = beams + 2, body = nodes
  real(wp), parameter :: pi = acos(-1.0_wp)
  real(wp), parameter :: straight(3, beams + 1) = reshape([0, 0, 0, 1, 0, 0, 3, 0, 0, 4, 0, 0] &
                                                          *1.0_wp, [3, beams + 1])
  real(wp), parameter :: bent(3, beams + 1) = reshape( &
    [0.2_wp, 0.1_wp, 0.0_wp, 1.1_wp, 0.4_wp, 0.1_wp, 1.9_wp, 1.0_wp, -0.1_wp, 2.3_wp, 1.9_wp, &
     0.2_wp], [3, beams + 1])

contains

  subroutine run_slider_tests()
    call run("slider: Jacobian and Hessian agree with differences", differences)
    call run("slider: a common rigid motion changes no strain", rigid_motion)
    call run("slider: coordinates along and across a straight beam", coordinates)
    call run("slider: strains and Jacobian go on over the ends of elements", passage)
    call run("slider: turn of a carriage through full turns", full_turns)
    call run("slider: a foot on the cubic of the mass", foot)
    call run("slider: not defined beyond the ends and behind the centre of curvature", limits)
  end subroutine run_slider_tests

  !> On a chain of these corners, the body drawn at `position`; with a rotation if `guided`.
  subroutine new_slider(corner, position, guided, element)
    real(wp), intent(in) :: corner(3, beams + 1), position(3)
    logical, intent(in) :: guided
    class(element_t), allocatable, intent(out) :: element
    type(track_t) :: track(beams)
    real(wp), parameter :: none(6) = 0
    integer :: k, n

    do k = 1, beams
      track(k)%node = spread([k, k + 1], 1, 3)
      track(k)%start = corner(:, k)
      track(k)%chord = corner(:, k + 1) - corner(:, k)
      track(k)%triad = triad_along(track(k)%chord)
      track(k)%shear_centre = [0.2_wp, -0.3_wp]
    end do
    n = merge(6, 3, guided)
    call new_element_slider([body, merge(body, 0, guided)], position, track, &
                            spread(.false., 1, n), none(:n), none(:n), 1, element)
  end subroutine new_slider

  !> Unit vectors along the chord, in the plane x y, and normal to it.
  function triad_along(chord) result(triad)
    real(wp), intent(in) :: chord(3)
    real(wp) :: triad(3, 3)

    triad(:, 1) = chord/norm2(chord)
    triad(:, 2) = [-chord(2), chord(1), 0.0_wp]/norm2(chord(:2))
    triad(:, 3) = [triad(2, 1)*triad(3, 2) - triad(3, 1)*triad(2, 2), &
                   triad(3, 1)*triad(1, 2) - triad(1, 1)*triad(3, 2), &
                   triad(1, 1)*triad(2, 2) - triad(2, 1)*triad(1, 2)]
  end function triad_along

  !> A chain that is bent, twisted, warped and stretched, the body beside it at `way` from where
  !> it was drawn, all turned and moved; different for each `i`.
  subroutine deformed(element, way, i, state)
    class(element_t), intent(in) :: element
    real(wp), intent(in) :: way
    integer, intent(in) :: i
    type(state_t), intent(out) :: state
    real(wp) :: increment(node_coordinates*nodes)
    integer :: k

    call new_state(nodes, 0, 2, state)
    state%angle(1) = way
    state%displacement(:, body) = way*[0.8_wp, 0.6_wp, 0.0_wp]
    increment = [(0.1_wp*sin(7.3_wp*k*i + i), k=1, size(increment))]
    call state%move(increment)
    call element%count_turns(state)
    call move_rigidly(state, [0.7_wp, -0.4_wp, 0.9_wp]*i, [3.0_wp, -2.0_wp, 1.0_wp])
  end subroutine deformed

  subroutine move_rigidly(state, theta, shift)
    type(state_t), intent(inout) :: state
    real(wp), intent(in) :: theta(3), shift(3)
    real(wp) :: drawn(3, nodes), turn(0:3), turn_matrix(3, 3)
    integer :: i

    drawn(:, :beams + 1) = bent
    drawn(:, body) = bent(:, 1)
    turn = turned([1.0_wp, 0.0_wp, 0.0_wp, 0.0_wp], theta)
    turn_matrix = rotated(turn, identity3)
    do i = 1, nodes
      state%euler(:, i) = turned(state%euler(:, i), theta)
      state%displacement(:, i) = matmul(turn_matrix, drawn(:, i) + state%displacement(:, i)) &
                                 + shift - drawn(:, i)
    end do
  end subroutine move_rigidly

  !> At places on each of the three elements.
  subroutine differences()
    class(element_t), allocatable :: element
    type(state_t) :: state
    real(wp), parameter :: way(5) = [0.2_wp, 0.7_wp, 1.3_wp, 1.7_wp, 2.3_wp]
    integer :: i, kind

    do kind = 1, 2
      call new_slider(bent, bent(:, 1), kind == 2, element)
      call expect(element%coordinates == merge(34, 31, kind == 2), "every coordinate once")
      do i = 1, 5
        call deformed(element, way(i), i, state)
        call compare_with_differences(element, state, &
                                      trim(merge("carriage", "slider  ", kind == 2)))
      end do
    end do
  end subroutine differences

  subroutine rigid_motion()
    class(element_t), allocatable :: element
    type(state_t) :: state, moved
    real(wp) :: before(6), after(6)
    integer :: i

    call new_slider(bent, bent(:, 1), .true., element)
    do i = 1, 5
      call deformed(element, 0.5_wp*i, i, state)
      moved = state
      call move_rigidly(moved, [2.0_wp, 0.3_wp*i, -1.1_wp], [-1.0_wp, 0.5_wp*i, 4.0_wp])
      before = strains(element, state)
      after = strains(element, moved)
      call expect_close(after, before, 200*epsilon(1.0_wp), "strains")
    end do
  end subroutine rigid_motion

  function strains(element, state, jacobian) result(strain)
    class(element_t), intent(in) :: element
    type(state_t), intent(in) :: state
    real(wp), intent(out), optional :: jacobian(:, :)
    real(wp) :: strain(element%strains)
    real(wp) :: b(element%strains, element%coordinates)
    real(wp) :: g(element%coordinates, element%coordinates), none(element%strains)
    logical :: valid

    none = 0
    call element%evaluate(state, none, strain, b, g, valid)
    call expect(valid, "valid")
    if (present(jacobian)) jacobian = b
  end function strains

  !> The body's place relative to where it was drawn, also off the line, however far it goes at
  !> once; a turned body.
  subroutine coordinates()
    class(element_t), allocatable :: element
    type(state_t) :: state
    real(wp) :: place(3)
    integer :: i

    call new_slider(straight, [0.5_wp, 0.0_wp, 0.0_wp], .true., element)
    do i = 1, 20
      call new_state(nodes, 0, 2, state)
      place = [1.5_wp + 1.9_wp*sin(2.7_wp*i), 0.3_wp*sin(4.0_wp*i), 0.5_wp*cos(3.0_wp*i)]
      state%displacement(:, body) = place
      state%euler(:, body) = turned(state%euler(:, body), [0.4_wp, 0.0_wp, 0.0_wp])
      call expect_close(strains(element, state), [place, 0.4_wp, 0.0_wp, 0.0_wp], 1.0e-14_wp, &
                        "way, distances, turn")
      state%euler(:, body) = turned([1.0_wp, 0.0_wp, 0.0_wp, 0.0_wp], [0.0_wp, 0.0_wp, 0.1_wp])
      call expect_close(strains(element, state), [place, 0.0_wp, -sin(0.1_wp), 0.0_wp], &
                        1.0e-14_wp, "tilt")
    end do
  end subroutine coordinates

  !> Just before and behind nodes 2 and 3 of a bent chain, on the line: the body is moved along
  !> by little.
  subroutine passage()
    class(element_t), allocatable :: element
    type(state_t) :: state
    real(wp), parameter :: little = 1.0e-7_wp
    real(wp) :: b(3, 31, 2), strain(3, 2), along(3)
    integer :: i, side

    do i = 2, 3
      call new_slider(bent, bent(:, i), .false., element)
      along = (bent(:, i) - bent(:, i - 1))/norm2(bent(:, i) - bent(:, i - 1)) &
              + (bent(:, i + 1) - bent(:, i))/norm2(bent(:, i + 1) - bent(:, i))
      along = along/norm2(along)
      do side = 1, 2
        call new_state(nodes, 0, 2, state)
        state%euler(:, i) = turned(state%euler(:, i), [0.2_wp, -0.1_wp, 0.3_wp])
        along = matmul(rotated(state%euler(:, i), identity3), along)
        state%displacement(:, body) = little*(2*side - 3)*along
        along = matmul(along, rotated(state%euler(:, i), identity3))
        strain(:, side) = strains(element, state, b(:, :, side))
      end do
      call expect_close(strain(1, :), little*[-1.0_wp, 1.0_wp], 1.0e-12_wp, "the way")
      call expect_close(strain(2:, :), 0*strain(2:, :), 1.0e-12_wp, "on the line")
      call expect_close(b(1, :, 2), b(1, :, 1), 100*little, "Jacobian of the way")
      call expect_close(matmul(transpose(b(2:, :, 2)), b(2:, 1:3, 2)), &
                        matmul(transpose(b(2:, :, 1)), b(2:, 1:3, 1)), 100*little, &
                        "Jacobian across")
    end do
  end subroutine passage

  subroutine full_turns()
    class(element_t), allocatable :: element
    type(state_t) :: state
    real(wp) :: strain(6)
    integer :: i

    call new_slider(straight, [0.5_wp, 0.0_wp, 0.0_wp], .true., element)
    call expect(element%counts_turns, "counts turns")
    call new_state(nodes, 0, 2, state)
    do i = 1, 60
      state%euler(:, body) = turned(state%euler(:, body), [0.3_wp, 0.0_wp, 0.0_wp])
      state%displacement(1, body) = 0.05_wp*i
      call element%count_turns(state)
      strain = strains(element, state)
      call expect_close(strain(1:4), [0.05_wp*i, 0.0_wp, 0.0_wp, 0.3_wp*i], 1.0e-13_wp, "turn")
    end do
  end subroutine full_turns

  !> Points of r = H1 r^p + H2 l0 d^p + H3 r^q + H4 l0 d^q, written out, have no distance from the
  !> line and the way l0 xi; a force across is that on the body, one along is per length l0.
  subroutine foot()
    class(element_t), allocatable :: element
    type(state_t) :: state
    real(wp) :: d(3, 2), r(3, 2), x, strain(3), b(3, 31), along(3)
    integer :: i, e

    call new_slider(straight, [1.0_wp, 0.0_wp, 0.0_wp], .false., element)
    do i = 1, 9
      call new_state(nodes, 0, 2, state)
      x = 0.1_wp*i
      do e = 1, 2
        state%displacement(:, 1 + e) = [0.1_wp, -0.2_wp, 0.3_wp]*e
        state%euler(:, 1 + e) = turned(state%euler(:, 1 + e), [0.3_wp, -0.2_wp, 0.4_wp]*(2 - e) &
                                       + [0.1_wp, 0.5_wp, 0.2_wp]*(e - 1))
        state%warping(1 + e) = 0.2_wp*e
        d(:, e) = matmul(rotated(state%euler(:, 1 + e), identity3), &
                         [1.0_wp, -0.3_wp*state%warping(1 + e), -0.2_wp*state%warping(1 + e)])
        r(:, e) = straight(:, 1 + e) + state%displacement(:, 1 + e)
      end do
      state%displacement(:, body) = (1 - 3*x**2 + 2*x**3)*r(:, 1) + (3*x**2 - 2*x**3)*r(:, 2) &
        + 2*(x - 2*x**2 + x**3)*d(:, 1) + 2*(x**3 - x**2)*d(:, 2) - [1.0_wp, 0.0_wp, 0.0_wp]
      strain = strains(element, state, b)
      call expect_close(strain, [2*x, 0.0_wp, 0.0_wp], 1.0e-13_wp, "a point of the line")
      along = 6*x*(1 - x)*(r(:, 2) - r(:, 1))/2 + (1 - 4*x + 3*x**2)*d(:, 1) &
              + (3*x**2 - 2*x)*d(:, 2)
      call expect_close(b(1, 1:3), along/dot_product(along, along), 1.0e-13_wp, "along the line")
      b(1, 1:3) = along/norm2(along)
      call expect_close(matmul(b(:, 1:3), transpose(b(:, 1:3))), identity3, 1.0e-13_wp, &
                        "unit vectors across")
    end do
  end subroutine foot

  subroutine limits()
    real(wp), parameter :: none(3) = 0

    call expect(is_valid([3.505_wp, 0.0_wp, 0.0_wp], none), "a little over the end")
    call expect(.not. is_valid([3.52_wp, 0.0_wp, 0.0_wp], none), "over the end")
    call expect(is_valid([-0.505_wp, 0.0_wp, 0.0_wp], none), "a little before the start")
    call expect(.not. is_valid([-0.52_wp, 0.0_wp, 0.0_wp], none), "before the start")
    call expect(is_valid(none, [0.0_wp, 0.0_wp, 0.49_wp*pi]), "less than a right angle")
    call expect(.not. is_valid(none, [0.0_wp, 0.0_wp, 0.51_wp*pi]), "more than a right angle")
  end subroutine limits

  !> Whether a carriage that starts at 0.5 may be moved and turned so.
  logical function is_valid(shift, theta)
    real(wp), intent(in) :: shift(3), theta(3)
    class(element_t), allocatable :: element
    type(state_t) :: state
    real(wp), allocatable :: strain(:), b(:, :), g(:, :)

    call new_slider(straight, [0.5_wp, 0.0_wp, 0.0_wp], .true., element)
    call new_state(nodes, 0, 2, state)
    state%displacement(:, body) = shift
    state%euler(:, body) = turned(state%euler(:, body), theta)
    allocate (strain(6), b(6, element%coordinates), g(element%coordinates, element%coordinates))
    strain = 0
    call element%evaluate(state, 0*strain, strain, b, g, is_valid)
  end function is_valid

end module test_slider
