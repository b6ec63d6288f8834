!> TRANSIENT: work and dampers, loads that jump, steps chosen by their error.
module test_transient_power
  use kinds, only: wp
  use check, only: run, expect, expect_close
  use model_data, only: model_t
  use motion_recorder, only: motion_t, follow, setting, observed_order
  use exact_motions, only: swing
  implicit none
  private

  public :: run_transient_power_tests

  real(wp), parameter :: pi = acos(-1.0_wp), g = 9.81_wp

contains

  subroutine run_transient_power_tests()
    call run("transient: balance of energy with work of all kinds", balance)
    call run("transient: damped oscillator", oscillator)
    call run("transient: Rayleigh damping by the logarithmic decrement", rayleigh)
    call run("transient: impulse of loads that jump within steps", jump)
    call run("transient: adaptive steps follow their tolerance", adaptive)
  end subroutine run_transient_power_tests

  !> What is missing is of the trapezoidal rule and of the integration: h**2.
  subroutine balance()
    type(motion_t) :: motion
    type(model_t) :: model
    real(wp) :: missing(1, 3)
    integer :: r, k

    do r = 1, 2
      do k = 1, 3
        call follow("work", motion, model, [setting("h", 0.02_wp/2**k), &
                                            setting("rho", merge(1.0_wp, 0.8_wp, r == 1))])
        if (motion%steps < 2) return
        missing(1, k) = motion%results(motion%steps)%energy(6)
      end do
      call expect_close(observed_order(missing(:, 1), missing(:, 2)), 2.0_wp, 0.1_wp, "order")
      call expect_close(observed_order(missing(:, 2), missing(:, 3)), 2.0_wp, 0.1_wp, "order")
      associate (energy => motion%results(motion%steps)%energy)
        call expect(all(abs(energy(1:5)) > 1), "all kinds of energy and work")
        call expect_close(missing(1, 3)/energy(3), 0.0_wp, 1.0e-4_wp, "what is missing at last")
      end associate
    end do
  end subroutine balance

  !> x = F/k (1 - exp(-d t) (cos(w t) + d/w sin(w t))); its force, its losses c times the integral
  !> of the velocity squared.
  subroutine oscillator()
    real(wp), parameter :: mass = 2, damping = 0.4_wp, stiffness = 50, force = 10
    real(wp), parameter :: d = damping/(2*mass), w = sqrt(stiffness/mass - d**2)
    type(motion_t) :: motion
    type(model_t) :: model
    real(wp) :: worst(2), x, t
    integer :: i, k

    do k = 1, 2
      call follow("oscillator", motion, model, [setting("h", 0.01_wp/k)])
      if (motion%steps < 2) return
      worst(k) = 0
      do i = 1, motion%steps
        t = motion%time(i)
        x = force/stiffness*(1 - exp(-d*t)*(cos(w*t) + d/w*sin(w*t)))
        worst(k) = max(worst(k), abs(motion%results(i)%displacement(1, 2) - x))
      end do
    end do
    call expect_close(worst(2)*stiffness/force, 0.0_wp, 2.0e-3_wp, "over the static place")
    call expect_close(observed_order(worst(1:1), worst(2:2)), 2.0_wp, 0.1_wp, "order")
    associate (r => motion%results(motion%steps))
      call expect_close(r%energy(3), force*r%displacement(1, 2), 1.0e-12_wp, "work of the force")
      call expect_close(r%energy(2), 0.5_wp*stiffness*r%displacement(1, 2)**2, 1.0e-12_wp, &
                        "energy of the spring")
      call expect_close(r%energy(5), r%energy(3) - r%energy(1) - r%energy(2), 1.0e-3_wp, "lost")
    end associate
  end subroutine oscillator

  !> Ratio of damping alpha/(2 w) + beta w/2; overshoot exp(-pi zeta/sqrt(1 - zeta**2)).
  subroutine rayleigh()
    real(wp), parameter :: w = 5, static = 0.2_wp
    type(motion_t) :: motion
    type(model_t) :: model
    real(wp) :: alpha, beta, ratio, highest, decrement
    integer :: i, k

    do k = 1, 3
      alpha = merge(0.3_wp, 0.0_wp, k /= 2)
      beta = merge(0.02_wp, 0.0_wp, k /= 1)
      call follow("oscillator", motion, model, [setting("h", 1.0e-3_wp), setting("end", 1.0_wp), &
                  setting("d", 0.0_wp), setting("alpha", alpha), setting("beta", beta)])
      if (motion%steps < 2) return
      highest = maxval([(motion%results(i)%displacement(1, 2), i=1, motion%steps)])
      decrement = -log(highest/static - 1)
      ratio = alpha/(2*w) + beta*w/2
      call expect_close(decrement/(pi*ratio/sqrt(1 - ratio**2)), 1.0_wp, 1.0e-3_wp, "decrement")
    end do
  end subroutine rayleigh

  !> A force of 3 from 0.313 to 1.037, one of 2 from 1.555 on, on a mass of 2: all integrals of
  !> a motion with constant acceleration between jumps are exact.
  subroutine jump()
    real(wp), parameter :: on = 1.037_wp - 0.313_wp
    type(motion_t) :: motion
    type(model_t) :: model
    integer :: i

    do i = 1, 3
      call follow("jump", motion, model, [setting("h", 0.05_wp*(i + 1)), &
                                          setting("rho", merge(1.0_wp, 0.4_wp*i - 0.4_wp, i == 1))])
      if (motion%steps < 2) return
      associate (r => motion%results(motion%steps))
        call expect_close(r%momentum(1), 3*on + 2*0.445_wp, 1.0e-12_wp, "momentum")
        call expect_close(r%displacement(1, 2), 0.75_wp*on**2 + 1.5_wp*on*(2 - 1.037_wp) &
                          + 0.5_wp*0.445_wp**2, 1.0e-12_wp, "way")
        call expect_close(r%energy(6), 0.0_wp, 1.0e-12_wp, "balance of energy")
      end associate
    end do
  end subroutine jump

  !> The error of a step is held, which goes with h**3; that of the motion goes with h**2, so with
  !> the tolerance to the power 2/3. So does that of the force in the bar, w**2 - g y, although
  !> steps change their length.
  subroutine adaptive()
    type(motion_t) :: motion
    type(model_t) :: model
    real(wp) :: error(2, 6), exact(2), bar(2), force
    integer :: i, k

    error = 0
    do k = 1, 6
      call follow("adaptive", motion, model, [setting("tol", 10.0_wp**(-k - 2))])
      call expect(motion%steps == 41, "a result each 0.1 s")
      if (motion%steps /= 41) return
      call expect_close(motion%time(:41), [(0.1_wp*i, i=0, 40)], 1.0e-12_wp, "times of results")
      do i = 2, 41
        exact = swing(g, motion%time(i))
        bar = [sin(exact(1)), -cos(exact(1))]
        force = exact(2)**2 - g*bar(2)
        associate (r => motion%results(i))
          error(1, k) = max(error(1, k), norm2(r%displacement(1:2, 2) - [1, 0] - bar))
          error(2, k) = max(error(2, k), norm2(r%reaction(1:2, 1) + force*bar)/(3*g))
        end associate
      end do
    end do
    call expect(all(error(:, 2:) < error(:, :5)), "a tenth of the tolerance has a smaller error")
    call expect_close(log10(error(:, 2:3)/error(:, 5:6)), spread([2.0_wp, 2.0_wp], 2, 2), &
                      0.4_wp, "a thousandth has a hundredth of the error")
    call expect(all(error(2, :) < 3*error(1, :)), "of the force as of the place")
    call expect(motion%refused > 0, "refused steps are counted")
  end subroutine adaptive

end module test_transient_power
