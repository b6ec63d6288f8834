!> Motions to compare with: ordinary differential equations by Runge-Kutta steps so small that only
!> round-off is left, and series.
module exact_motions
  use kinds, only: wp
  implicit none
  private

  public :: rates_interface, integrate, swing, double_swing, elastic_swing, cantilever_series

  real(wp), parameter :: pi = acos(-1.0_wp), g = 9.81_wp

  abstract interface
    !> Rates of a state y; c: a constant of the motion's equation.
    pure function rates_interface(y, c) result(rate)
      import :: wp
      implicit none
      real(wp), intent(in) :: y(:), c
      real(wp) :: rate(size(y))
    end function rates_interface
  end interface

contains

  !> From a state to that a time later, in `steps` of fourth order.
  pure function integrate(rates, c, y, time, steps) result(end_state)
    procedure(rates_interface) :: rates
    real(wp), intent(in) :: c, y(:), time
    integer, intent(in) :: steps
    real(wp), dimension(size(y)) :: end_state, p, q, r, s
    real(wp) :: h
    integer :: i

    h = time/steps
    end_state = y
    do i = 1, steps
      p = rates(end_state, c)
      q = rates(end_state + 0.5_wp*h*p, c)
      r = rates(end_state + 0.5_wp*h*q, c)
      s = rates(end_state + h*r, c)
      end_state = end_state + h/6*(p + 2*q + 2*r + s)
    end do
  end function integrate

  !> Angle from the vertical below the pivot and its rate, of a pendulum released horizontally:
  !> angle'' = -k sin(angle); of a point mass on a length 1, k = g.
  pure function swing(k, time) result(y)
    real(wp), intent(in) :: k, time
    real(wp) :: y(2)

    y = integrate(swing_rates, k, [-0.5_wp*pi, 0.0_wp], time, 4000)
  end function swing

  pure function swing_rates(y, c) result(rate)
    real(wp), intent(in) :: y(:), c
    real(wp) :: rate(size(y))

    rate = [y(2), -c*sin(y(1))]
  end function swing_rates

  !> Angles from the vertical and their rates of a double pendulum with unit masses on unit
  !> lengths, released horizontally.
  pure function double_swing(time) result(y)
    real(wp), intent(in) :: time
    real(wp) :: y(4)

    y = integrate(double_swing_rates, g, [0.5_wp*pi, 0.5_wp*pi, 0.0_wp, 0.0_wp], time, 8000)
  end function double_swing

  !> 2 a1'' + e a2'' = -s w2**2 - 2 g sin a1, e a1'' + a2'' = s w1**2 - g sin a2, with e and s of
  !> a1 - a2.
  pure function double_swing_rates(y, c) result(rate)
    real(wp), intent(in) :: y(:), c
    real(wp) :: rate(size(y)), e, s, p, q

    e = cos(y(1) - y(2))
    s = sin(y(1) - y(2))
    p = -s*y(4)**2 - 2*c*sin(y(1))
    q = s*y(3)**2 - c*sin(y(2))
    rate = [y(3), y(4), (p - e*q)/(2 - e**2), (2*q - e*p)/(2 - e**2)]
  end function double_swing_rates

  !> Place and velocity of a unit mass on a spring of unit length whose force is EA times its
  !> elongation, released horizontally.
  pure function elastic_swing(ea, time) result(y)
    real(wp), intent(in) :: ea, time
    real(wp) :: y(4)

    y = integrate(elastic_rates, ea, [-1.0_wp, 0.0_wp, 0.0_wp, 0.0_wp], time, 8000)
  end function elastic_swing

  pure function elastic_rates(y, c) result(rate)
    real(wp), intent(in) :: y(:), c
    real(wp) :: rate(size(y)), length

    length = norm2(y(1:2))
    rate = [y(3:4), -c*(length - 1)*y(1:2)/length - [0.0_wp, g]]
  end function elastic_rates

  !> Deflection of the tip of a cantilever by a tip force from the time 0 on: modes of a beam
  !> without shear and rotary inertia, whose square at the tip is four times its mean.
  pure real(wp) function cantilever_series(stiffness, density, length, force, time) result(tip)
    real(wp), intent(in) :: stiffness, density, length, force, time
    real(wp) :: b, w
    integer :: k, i

    tip = 0
    do k = 1, 40
      b = (k - 0.5_wp)*pi
      do i = 1, 20  ! cos b cosh b = -1
        b = b + (cos(b) + 1/cosh(b))/(sin(b) + tanh(b)/cosh(b))
      end do
      w = b**2*sqrt(stiffness/(density*length**4))
      tip = tip + 4*force/(density*length*w**2)*(1 - cos(w*time))
    end do
  end function cantilever_series

end module exact_motions
