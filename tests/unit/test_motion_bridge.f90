!> The motion between two instants against a known one.
module test_motion_bridge
  use kinds, only: wp
  use check, only: run, expect, expect_close
  use nodal_state, only: new_state
  use rotation, only: turned, rotation_matrix, cross, no_rotation
  use dynamic_equilibrium, only: dynamics_t
  use motion_instant, only: instant_t
  use motion_bridge, only: bridge, increment_between
  implicit none
  private

  public :: run_motion_bridge_tests

  real(wp), parameter :: spin(3) = [0.3_wp, -1.1_wp, 0.7_wp], nod(3) = [-0.8_wp, 0.5_wp, 1.3_wp]

contains

  subroutine run_motion_bridge_tests()
    call run("motion bridge: a rotation about two axes, fifth order", rotation_about_two)
    call run("motion bridge: increment from one state to another", increments)
  end subroutine run_motion_bridge_tests

  !> R = exp(t spin) exp(t nod): w = spin + exp(t spin) nod. The displacement is (sin t, t^5, 1).
  subroutine set_instant(time, instant)
    real(wp), intent(in) :: time
    type(instant_t), intent(out) :: instant
    real(wp) :: carried(3)

    instant%time = time
    call new_state(1, 0, 0, instant%state)
    allocate (instant%flow%velocity(7), instant%flow%acceleration(7), instant%stress(1))
    instant%state%euler(:, 1) = turned(turned(no_rotation, time*nod), time*spin)
    carried = matmul(rotation_matrix(turned(no_rotation, time*spin)), nod)
    instant%state%displacement(:, 1) = [sin(time), time**5, 1.0_wp]
    instant%flow%velocity = [cos(time), 5*time**4, 0.0_wp, spin + carried, 0.0_wp]
    instant%flow%acceleration = [-sin(time), 20*time**3, 0.0_wp, cross(spin, carried), 0.0_wp]
    instant%stress = time
  end subroutine set_instant

  subroutine rotation_about_two()
    type(instant_t) :: a, b, exact
    type(dynamics_t) :: motion
    real(wp) :: error(3, 2), span
    integer :: i

    motion%system%nodes = 1
    allocate (motion%system%element(0))
    do i = 1, 2
      span = 0.4_wp/2**i
      call set_instant(0.5_wp, a)
      call set_instant(0.5_wp + span, b)
      call set_instant(0.5_wp + 0.45_wp*span, exact)
      call bridge(a, b, exact%time, motion)
      error(1, i) = maxval(abs(increment_between(exact%state, motion%iterate%state)))
      error(2, i) = maxval(abs(motion%flow%velocity - exact%flow%velocity))
      error(3, i) = maxval(abs(motion%flow%acceleration - exact%flow%acceleration))
      call expect_close(motion%iterate%stress(1), exact%time, 1.0e-14_wp, "stress, linear")
      call expect_close(motion%iterate%state%displacement(2, 1), exact%time**5, 1.0e-14_wp, &
                        "fifth power exactly")
    end do
    ! the end's rates of the rotation vector, theta = 0.4, err by theta**5/720
    call expect(all(error(:, 1) < 0.4_wp**5/720*[1.0_wp, 2/0.2_wp, 8/0.2_wp**2]), "small errors")
    call expect(error(1, 2) < error(1, 1)/25, "position of fifth order at least")
    call expect(error(2, 2) < error(2, 1)/12, "velocity of fourth")
    call expect(error(3, 2) < error(3, 1)/6, "acceleration of third")
  end subroutine rotation_about_two

  subroutine increments()
    type(instant_t) :: a, b

    call set_instant(0.2_wp, a)
    call set_instant(1.1_wp, b)
    call a%state%move(increment_between(a%state, b%state))
    call expect_close(a%state%displacement, b%state%displacement, 1.0e-15_wp, "displacement")
    call expect_close(abs(dot_product(a%state%euler(:, 1), b%state%euler(:, 1))), 1.0_wp, &
                      1.0e-15_wp, "rotation")
  end subroutine increments

end module test_motion_bridge
