!> Between two instants of a smooth motion: positions from the fifth-degree polynomials that have
!> the velocities and accelerations of both, rotations by their vectors from the first instant.
!>
!> Through a singular position of a mechanism nothing else is determined; halfway, the polynomials
!> err by (w T)^6/46080 of the motion, w its frequency, T the time between the instants.
module motion_bridge
  use kinds, only: wp
  use nodal_state, only: state_t, node_coordinates
  use rotation, only: turned, rotation_vector, cross
  use dynamic_equilibrium, only: dynamics_t
  use motion_instant, only: instant_t
  implicit none
  private

  public :: bridge, increment_between

  !> Coefficients of s, ..., s^5 that the end value, then velocity and acceleration at the start and
  !> at the end are taken with, times from 0 to 1.
  real(wp), parameter :: shape_of(5, 5) = reshape([ &
    0.0_wp, 0.0_wp, 10.0_wp, -15.0_wp, 6.0_wp, &
    1.0_wp, 0.0_wp, -6.0_wp, 8.0_wp, -3.0_wp, &
    0.0_wp, 0.5_wp, -1.5_wp, 1.5_wp, -0.5_wp, &
    0.0_wp, 0.0_wp, -4.0_wp, 7.0_wp, -3.0_wp, &
    0.0_wp, 0.0_wp, 0.5_wp, -1.0_wp, 0.5_wp], [5, 5])

contains

  !> Put the motion where it is at a time between the instants `a` and `b`; not assembled.
  !> Stress resultants are interpolated linearly.
  subroutine bridge(a, b, time, motion)
    type(instant_t), intent(in) :: a, b
    real(wp), intent(in) :: time
    type(dynamics_t), intent(inout) :: motion
    real(wp) :: jet(0:2, size(a%flow%velocity)), ends(size(a%flow%velocity), 5), span, s
    integer :: i, k

    span = b%time - a%time
    s = (time - a%time)/span
    ends(:, 1) = increment_between(a%state, b%state)
    ends(:, 2) = span*a%flow%velocity
    ends(:, 3) = span**2*a%flow%acceleration
    ends(:, 4) = span*b%flow%velocity
    ends(:, 5) = span**2*b%flow%acceleration
    do i = 1, motion%system%nodes
      k = node_coordinates*i - 3
      call to_vector(ends(k:k + 2, 1), ends(k:k + 2, 4), ends(k:k + 2, 5))
    end do
    do k = 1, size(ends, 1)
      jet(:, k) = polynomial(matmul(shape_of, ends(k, :)), s)
    end do
    motion%iterate%state = a%state
    call motion%iterate%state%move(jet(0, :))
    do i = 1, size(motion%system%element)
      associate (e => motion%system%element(i)%e)
        if (e%counts_turns) call e%count_turns(motion%iterate%state)
      end associate
    end do
    do i = 1, motion%system%nodes
      k = node_coordinates*i - 3
      call to_spin(jet(0, k:k + 2), jet(1, k:k + 2), jet(2, k:k + 2))
    end do
    motion%iterate%stress = a%stress + s*(b%stress - a%stress)
    motion%flow%velocity = jet(1, :)/span
    motion%flow%acceleration = jet(2, :)/span**2
  end subroutine bridge

  !> What moves one state to the other, by coordinate.
  pure function increment_between(a, b) result(increment)
    type(state_t), intent(in) :: a, b
    real(wp) :: increment(node_coordinates*size(a%warping) + size(a%release))
    real(wp) :: back(0:3), p(0:3), q(0:3)
    integer :: i, k

    do i = 1, size(a%warping)
      k = node_coordinates*(i - 1)
      increment(k + 1:k + 3) = b%displacement(:, i) - a%displacement(:, i)
      p = a%euler(:, i)
      q = b%euler(:, i)
      back(0) = dot_product(p, q)  ! of q p'
      back(1:3) = p(0)*q(1:3) - q(0)*p(1:3) - cross(q(1:3), p(1:3))
      increment(k + 4:k + 6) = rotation_vector(back)
      increment(k + 7) = b%warping(i) - a%warping(i)
    end do
    increment(node_coordinates*size(a%warping) + 1:) = b%release - a%release
  end function increment_between

  !> Value and two derivatives of the sum of c(k) s^k.
  pure function polynomial(c, s) result(jet)
    real(wp), intent(in) :: c(5), s
    real(wp) :: jet(0:2)

    jet(0) = s*(c(1) + s*(c(2) + s*(c(3) + s*(c(4) + s*c(5)))))
    jet(1) = c(1) + s*(2*c(2) + s*(3*c(3) + s*(4*c(4) + s*5*c(5))))
    jet(2) = 2*c(2) + s*(6*c(3) + s*(12*c(4) + s*20*c(5)))
  end function polynomial

  !> From angular velocity and acceleration to the derivatives of the rotation vector, up to terms
  !> of theta^4/720: theta' = w - theta x w/2 + theta x (theta x w)/12.
  pure subroutine to_vector(theta, first, second)
    real(wp), intent(in) :: theta(3)
    real(wp), intent(inout) :: first(3), second(3)
    real(wp) :: w(3), t(3)

    w = first
    t = cross(theta, w)
    first = w - 0.5_wp*t + cross(theta, t)/12
    second = second - 0.5_wp*(cross(first, w) + cross(theta, second)) &
             + (cross(first, t) + cross(theta, cross(first, w) + cross(theta, second)))/12
  end subroutine to_vector

  !> The way back: w = theta' + theta x theta'/2 + theta x (theta x theta')/6 + ...
  pure subroutine to_spin(theta, first, second)
    real(wp), intent(in) :: theta(3)
    real(wp), intent(inout) :: first(3), second(3)
    real(wp) :: rate(3), t(3)

    rate = first
    t = cross(theta, rate)
    first = rate + 0.5_wp*t + cross(theta, t)/6
    second = second + 0.5_wp*cross(theta, second) &
             + (cross(rate, t) + cross(theta, cross(theta, second)))/6
  end subroutine to_spin

end module motion_bridge
