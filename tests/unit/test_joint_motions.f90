module test_joint_motions
  use kinds, only: wp
  use check, only: run, expect, expect_close
  use element_base, only: element_t, element_slot_t
  use element_hinge, only: new_element_hinge
  use element_universal, only: new_element_universal
  use joint_samples, only: new_joint, turn, move_rigidly, measure, truss, hinge, universal, &
                           spherical, cylindrical, gear, shared_gear, nodes, slots, pi, a, b, &
                           second, ratio, chord, stiffness, damping
  use nodal_state, only: state_t, new_state
  use rotation, only: rotated
  implicit none
  private

  public :: run_joint_motions_tests

  logical, parameter :: free(6) = .false.
  integer, parameter :: wide = selected_real_kind(30)

contains

  subroutine run_joint_motions_tests()
    call run("joints: truss, elongation without cancellation", small_elongation)
    call run("joints: hinge, five turns of a perfect hinge", five_turns)
    call run("joints: universal, a turn about each axis", two_turns)
    call run("joints: universal, angles of two shafts", two_shafts)
    call run("joints: spherical, the gap", gap)
    call run("joints: cylindrical, slide and turn", slide)
    call run("joints: gear, hinges that turn by its ratio", geared_hinges)
  end subroutine run_joint_motions_tests

  !> Against arithmetic with 33 digits.
  subroutine small_elongation()
    class(element_t), allocatable :: element
    type(state_t) :: state
    real(wp), allocatable :: strain(:)
    real(wide) :: exact
    logical :: valid
    integer :: i

    call new_joint(truss, free, element)
    do i = 1, 20
      call new_state(nodes, 0, slots, state)
      state%displacement(:, 2) = 1.0e-9_wp*norm2(chord)*(a + [0.0_wp, 0.0_wp, 0.05_wp*i])
      exact = norm2(real(chord, wide) + real(state%displacement(:, 2), wide)) &
              - norm2(real(chord, wide))
      call measure(element, state, strain, valid)
      call expect_close(strain(1)/real(exact, wp), 1.0_wp, 1.0e-14_wp, "elongation")
    end do
  end subroutine small_elongation

  !> Forward, then backward through zero, while both bodies turn in space.
  subroutine five_turns()
    integer, parameter :: steps = 40
    real(wp), parameter :: angle = 10*pi/steps
    class(element_t), allocatable :: element
    type(state_t) :: state
    real(wp), allocatable :: strain(:)
    logical :: valid
    integer :: i, k

    call new_joint(hinge, free, element)
    call expect(element%counts_turns, "counts turns")
    call new_state(nodes, 0, slots, state)
    k = 0
    do i = 1, 3*steps
      k = k + merge(1, -1, i <= steps)
      call turn(state, 2, merge(angle, -angle, i <= steps)*on_node(state, 1, a))
      call move_rigidly(state, [0.1_wp, -0.3_wp, 0.2_wp], 0*a)
      call measure(element, state, strain, valid)
      call expect_close(strain, [k*angle, 0.0_wp, 0.0_wp], 1.0e-13_wp, "angle of a hinge")
    end do
    call expect(k == -steps, "five turns backward")
  end subroutine five_turns

  !> Where a vector fixed to a node points.
  function on_node(state, node, vector) result(v)
    type(state_t), intent(in) :: state
    integer, intent(in) :: node
    real(wp), intent(in) :: vector(3)
    real(wp) :: v(3), triad(3, 3)

    triad = rotated(state%euler(:, node), spread(vector, 2, 3))
    v = triad(:, 1)
  end function on_node

  !> q follows from p by a turn about a, then one about b that has turned with the cross.
  subroutine two_turns()
    class(element_t), allocatable :: element
    type(state_t) :: state
    real(wp), allocatable :: strain(:)
    real(wp) :: e(2)
    logical :: valid
    integer :: i

    call new_joint(universal, free, element)
    call new_state(nodes, 0, slots, state)
    e = 0
    do i = 1, 60
      e = e + [0.9_wp, -0.7_wp]
      state%euler(:, 2) = state%euler(:, 1)
      call turn(state, 2, e(1)*on_node(state, 1, a))
      call turn(state, 2, e(2)*on_node(state, 2, b/norm2(b)))
      call move_rigidly(state, [0.1_wp, -0.3_wp, 0.2_wp], 0*a)
      call measure(element, state, strain, valid)
      call expect_close(strain, [e, 0.0_wp], 2.0e-13_wp, "angles of a universal joint")
    end do
  end subroutine two_turns

  !> Shafts 0.6 rad apart: with a in their plane tan(out) = tan(in)/cos(0.6), with a normal to it
  !> tan(out) = tan(in) cos(0.6). The cross comes back after every turn.
  subroutine two_shafts()
    real(wp), parameter :: angle = 0.6_wp
    real(wp), parameter :: in(3) = [1.0_wp, 0.0_wp, 0.0_wp], normal(3) = [0.0_wp, 0.0_wp, 1.0_wp]
    real(wp), parameter :: out(3) = [cos(angle), sin(angle), 0.0_wp]

    call turn_shafts(in, out, [0.0_wp, 1.0_wp, 0.0_wp], normal, 1/cos(angle))
    call turn_shafts(in, out, normal, [-sin(angle), cos(angle), 0.0_wp], cos(angle))
  end subroutine two_shafts

  subroutine turn_shafts(in, out, a_axis, b_axis, factor)
    real(wp), intent(in) :: in(3), out(3), a_axis(3), b_axis(3), factor
    class(element_t), allocatable :: element
    type(state_t) :: state
    real(wp), allocatable :: strain(:)
    real(wp) :: t
    logical :: valid
    integer :: i

    call new_element_universal([1, 2], reshape([a_axis, b_axis], [3, 2]), free(:3), stiffness(:3), &
                               damping(:3), [1, 2], element)
    call new_state(nodes, 0, slots, state)
    do i = 0, 48
      t = pi*i/12
      state%euler(:, 1) = [1, 0, 0, 0]
      state%euler(:, 2) = [1, 0, 0, 0]
      call turn(state, 1, t*in)
      call turn(state, 2, atan2(factor*sin(t), cos(t))*out)
      call measure(element, state, strain, valid)
      call expect_close(strain(3), 0.0_wp, 1.0e-14_wp, "a and b stay normal")
      if (modulo(i, 24) == 0) call expect_close(strain, 0*strain, 1.0e-13_wp, "cross is back")
    end do
  end subroutine turn_shafts

  subroutine gap()
    class(element_t), allocatable :: element
    type(state_t) :: state
    real(wp), allocatable :: strain(:)
    logical :: valid

    call new_joint(spherical, free, element)
    call new_state(nodes, 0, slots, state)
    call measure(element, state, strain, valid)
    call expect_close(strain, chord, 0.0_wp, "initial gap")
    state%displacement(:, 1) = [1, 2, 3]
    state%displacement(:, 2) = [5, 7, 11]
    call measure(element, state, strain, valid)
    call expect_close(strain, chord + [4, 5, 8], 1.0e-15_wp, "gap")
  end subroutine gap

  !> The gap at the start lies oblique to the axis: only its part along it is no strain.
  subroutine slide()
    class(element_t), allocatable :: element
    type(state_t) :: state
    real(wp), allocatable :: start(:), strain(:)
    real(wp) :: q(3)
    logical :: valid
    integer :: i

    call new_joint(cylindrical, free, element)
    call new_state(nodes, 0, slots, state)
    call measure(element, state, start, valid)
    call expect_close([start(1:2), start(5:6)], [0, 0, 0, 0]*1.0_wp, 1.0e-15_wp, "start")
    call expect_close(norm2(start(3:4)), norm2(chord - dot_product(chord, a)*a), 1.0e-15_wp, &
                      "distance from the axis")
    do i = 1, 30
      call turn(state, 2, -0.8_wp*on_node(state, 1, a))
      state%displacement(:, 2) = state%displacement(:, 2) + 0.05_wp*on_node(state, 1, a)
      call move_rigidly(state, [0.1_wp, -0.3_wp, 0.2_wp], [0.2_wp, 0.3_wp, -0.4_wp])
      call measure(element, state, strain, valid)
      call expect_close(strain - start, [0.05_wp*i, -0.8_wp*i, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp], &
                        1.0e-13_wp, "slide and angle")
    end do
    call new_state(nodes, 0, slots, state)
    q = 1.0e-12_wp*[1.0_wp, 2.0_wp, 3.0_wp]
    state%displacement(:, 2) = q
    call measure(element, state, strain, valid)
    call expect_close(strain(1), dot_product(a, q), 1.0e-27_wp, "small slide")
  end subroutine slide

  !> Over several turns of both, with and without a common body; `ratio` is that of `second`.
  subroutine geared_hinges()
    type(element_slot_t) :: joint(2), geared
    type(state_t) :: state
    real(wp), allocatable :: strain(:)
    logical :: valid
    integer :: kind, i, base

    do kind = gear, shared_gear
      base = merge(1, 3, kind == shared_gear)
      call new_joint(hinge, free, joint(1)%e)
      call new_element_hinge([base, 4], second, free(:3), stiffness(:3), damping(:3), 3, joint(2)%e)
      call new_joint(kind, free, geared%e)
      call expect(.not. geared%e%counts_turns, "a gear does not count")
      call expect(geared%e%coordinates == merge(9, 12, base == 1), "every coordinate once")
      call new_state(nodes, 0, slots, state)
      do i = 1, 60
        call turn(state, 2, 0.7_wp*on_node(state, 1, a))
        call turn(state, 4, 0.7_wp*ratio*on_node(state, base, second))
        call move_rigidly(state, [0.1_wp, -0.3_wp, 0.2_wp], 0*a)
        call measure(geared%e, state, strain, valid)
        call expect_close(strain, [0.0_wp], 1.0e-12_wp, "gear before its hinges count")
        call joint(1)%e%count_turns(state)
        call joint(2)%e%count_turns(state)
        call measure(geared%e, state, strain, valid)
        call expect_close(strain, [0.0_wp], 1.0e-12_wp, "gear")
      end do
      call expect_close(state%angle([1, 3]), 42*[1.0_wp, ratio], 1.0e-12_wp, "angles of the hinges")
      call turn(state, 4, 0.3_wp*on_node(state, base, second))
      call measure(geared%e, state, strain, valid)
      call expect_close(strain, [0.3_wp], 1.0e-12_wp, "one hinge alone")
    end do
  end subroutine geared_hinges

end module test_joint_motions
