!> TRANSIENT from initial velocities: rotating bodies and a mechanism, against closed forms.
module test_transient_start
  use kinds, only: wp
  use check, only: run, expect, expect_close
  use model_data, only: model_t
  use rotation, only: rotated, identity3, cross
  use motion_recorder, only: motion_t, follow, setting, observed_order
  implicit none
  private

  public :: run_transient_start_tests

  real(wp), parameter :: pi = acos(-1.0_wp), g = 9.81_wp

contains

  subroutine run_transient_start_tests()
    call run("start: free rigid body near its intermediate axis (MBD-04)", free_body)
    call run("start: order 2 of the free rigid body", free_body_order)
    call run("start: steady precession of the top (MBD-06)", top)
    call run("start: spatial slider-crank (MBD-13)", slider_crank)
    call run("start: drift through many outputs", drift)
    call run("start: a motion behind an imperfection starts anew", reshaped)
  end subroutine run_transient_start_tests

  !> Uniform motion; a step that an output cuts short must not make the next ones grow without end.
  subroutine drift()
    type(motion_t) :: motion
    type(model_t) :: model

    call follow("drift", motion, model, [character(len=1) ::])
    call expect(motion%steps == 1201, "all outputs")
    if (motion%steps /= 1201) return
    call expect_close(motion%results(1201)%displacement(1, 1), 1.2_wp, 1.0e-12_wp, "way")
    call expect(all(motion%size(2:) <= 1.0_wp), "steps reach from output to output at most")
  end subroutine drift

  !> The second motion has the velocities of STARTDX, not those that the first one ended with.
  subroutine reshaped()
    type(motion_t) :: motion
    type(model_t) :: model

    call follow("reshaped", motion, model, [character(len=1) ::])
    call expect(motion%steps == 11 + 11, "both motions")
    if (motion%steps /= 22) return
    call expect_close(motion%results(12)%velocity, motion%results(1)%velocity, 1.0e-6_wp, &
                      "the same start")
    call expect_close(motion%results(12)%velocity(2, 3), 1.0_wp, 1.0e-9_wp, "as given")
  end subroutine reshaped

  !> Angular velocity in the body's axes.
  function body_rates(motion, i) result(rate)
    type(motion_t), intent(in) :: motion
    integer, intent(in) :: i
    real(wp) :: rate(3), triad(3, 3)

    triad = rotated(motion%results(i)%euler(:, 1), identity3)
    rate = matmul(motion%results(i)%velocity(4:6, 1), triad)
  end function body_rates

  !> Jacobi's elliptic functions; values extrapolated to h = 0.
  subroutine free_body()
    real(wp), parameter :: times(4) = [1.0_wp, 2.0_wp, 5.0_wp, 10.0_wp]
    real(wp), parameter :: rates(3, 4) = reshape([-0.0732633081956996_wp, 2.001157786800487_wp, &
      0.0919556275743532_wp, -0.35351428080210523_wp, 1.9710473493219238_wp, &
      0.21982746774916392_wp, -1.2067742211780754_wp, -1.5980287791838734_wp, &
      0.7014993516033949_wp, 1.1050666344173845_wp, -1.669978363182415_wp, &
      0.6432138748769247_wp], [3, 4])
    real(wp), parameter :: euler(4, 4) = reshape([0.5387215007418475_wp, 0.004434720882900643_wp, &
      0.8410541959862915_wp, 0.04886018116043412_wp, -0.41713672760889087_wp, &
      -0.009818383897256762_wp, 0.8990887901939842_wp, 0.1324382768119696_wp, &
      0.07412350700324086_wp, 0.20907947706036495_wp, -0.27272372604130535_wp, &
      -0.9361694543381558_wp, -0.29796696110858667_wp, 0.9453572901864264_wp, &
      0.11484622844043701_wp, -0.06576950503158047_wp], [4, 4])
    type(motion_t) :: motion
    type(model_t) :: model
    real(wp) :: rate(3, 4, 2), place(4, 4, 2), change(2)
    integer :: i, k

    do k = 1, 2
      call follow("free_body", motion, model, [setting("h", 0.01_wp/k)])
      if (motion%steps < 2) return
      do i = 1, 4
        associate (n => motion%at(times(i)))
          rate(:, i, k) = body_rates(motion, n)
          place(:, i, k) = motion%results(n)%euler(:, 1)
          place(:, i, k) = place(:, i, k)*sign(1.0_wp, dot_product(place(:, i, k), euler(:, i)))
        end associate
      end do
      change(k) = 0
      do i = 1, motion%steps
        associate (r => motion%results(i))
          change(k) = max(change(k), abs(r%energy(1)/4.02_wp - 1), &
                          norm2(r%momentum(4:6) - [0.1_wp, 4.0_wp, 0.3_wp])/4.012480529547776_wp)
        end associate
      end do
    end do
    rate(:, :, 2) = (4*rate(:, :, 2) - rate(:, :, 1))/3
    place(:, :, 2) = (4*place(:, :, 2) - place(:, :, 1))/3
    call expect_close(rate(:, :, 2), rates, 1.0e-4_wp, "angular velocity in the body")
    call expect_close(place(:, :, 2), euler, 1.0e-3_wp, "Euler parameters")
    call expect_close(change(2), 0.0_wp, 1.0e-3_wp, "energy and angular momentum")
    call expect(change(2) < 0.3_wp*change(1), "they stay with h**2")
  end subroutine free_body

  subroutine free_body_order()
    real(wp), parameter :: radius(3) = [1.0_wp, 0.8_wp, 0.5_wp]
    real(wp), parameter :: rates(3) = [-0.35351428080210523_wp, 1.9710473493219238_wp, &
                                       0.21982746774916392_wp]
    real(wp), parameter :: euler(4) = [-0.41713672760889087_wp, -0.009818383897256762_wp, &
                                       0.8990887901939842_wp, 0.1324382768119696_wp]
    type(motion_t) :: motion
    type(model_t) :: model
    real(wp) :: error(7, 2)
    integer :: r, k

    do r = 1, 3
      do k = 1, 2
        call follow("free_body", motion, model, [setting("h", 0.01_wp/2**k), &
                    setting("rho", radius(r)), setting("end", 2.0_wp)])
        if (motion%steps < 2) return
        associate (p => motion%results(motion%steps)%euler(:, 1))
          error(1:4, k) = p*sign(1.0_wp, dot_product(p, euler)) - euler
        end associate
        error(5:7, k) = body_rates(motion, motion%steps) - rates
      end do
      call expect_close(observed_order(error(1:4, 1), error(1:4, 2)), 2.0_wp, 0.1_wp, "rotation")
      call expect_close(observed_order(error(5:7, 1), error(5:7, 2)), 2.0_wp, 0.1_wp, "rates")
    end do
  end subroutine free_body_order

  !> The axis goes round at constant height: at 90 degrees, and slowly and fast at 60.
  subroutine top()
    real(wp), parameter :: theta(3) = [90.0_wp, 60.0_wp, 60.0_wp]
    real(wp), parameter :: rate(3) = [2.0928_wp, 3.105309340559323_wp, 6.418500183250199_wp]
    type(motion_t) :: motion
    type(model_t) :: model
    real(wp) :: angle
    integer :: k

    do k = 1, 3
      call follow("top", motion, model, [setting("theta", theta(k)), setting("w", rate(k)), &
                                         setting("h", 2.5e-4_wp), setting("end", 0.5_wp)])
      if (motion%steps < 2) return
      associate (r => motion%results(motion%steps), start => model%node(2)%position)
        angle = modulo(atan2(r%displacement(2, 2), r%displacement(1, 2) + start(1)), 2*pi)
        call expect_close(angle/(0.5_wp*rate(k)), 1.0_wp, 1.0e-4_wp, "precession")
        call expect_close(r%displacement(3, 2), 0.0_wp, 1.0e-4_wp, "height")
      end associate
    end do
  end subroutine top

  !> The rod's angular velocity turns its ends: w x (C - B) = vC - vB, and has no part along the
  !> normal of its joint's axes. With the slider's velocity four equations for four unknowns; what
  !> moves with the crank at the rate 1 has the energy that its rate must have.
  subroutine slider_crank()
    type(motion_t) :: motion
    type(model_t) :: model
    real(wp) :: most(2), total
    integer :: i, k

    do k = 1, 2
      call follow("slider_crank", motion, model, [setting("h", 1.0e-3_wp/k)])
      if (motion%steps < 2) return
      associate (r => motion%results(1))
        call expect_close(r%velocity(1, 3), 0.24_wp, 1.0e-10_wp, "the slider's first velocity")
        call expect_close(r%velocity(4:6, 5), [1.92_wp, -0.96_wp, 0.48_wp], 1.0e-9_wp, &
                          "the rod's first angular velocity")
        total = r%energy(1)
        call expect_close(total, energy(0.0_wp, 6.0_wp), 1.0e-9_wp, "the first energy")
      end associate
      most(k) = 0
      do i = 1, motion%steps
        associate (r => motion%results(i))
          most(k) = max(most(k), abs(energy(r%joint_strain(1, 1), r%joint_rate(1, 1))/total - 1))
        end associate
      end do
    end do
    call expect(motion%results(motion%steps)%joint_strain(1, 1) > pi, "half a turn and more")
    call expect_close(most(2), 0.0_wp, 2.0e-3_wp, "energy by the crank's angle and rate")
    call expect(most(2) < 0.3_wp*most(1), "what is missing goes with h**2")
  end subroutine slider_crank

  !> Kinetic energy and height's energy above the start, of crank, rod and slider.
  pure real(wp) function energy(angle, rate)
    real(wp), intent(in) :: angle, rate
    real(wp) :: arm(3), b(3), c(3), rod(3), normal(3), spin(3), slide, middle(3), inertia, axial

    arm = 0.08_wp*[0.0_wp, -sin(angle), cos(angle)]
    b = [0.0_wp, 0.1_wp, 0.12_wp] + arm
    c = [sqrt(0.09_wp - b(2)**2 - b(3)**2), 0.0_wp, 0.0_wp]
    rod = c - b
    slide = dot_product(rod, [0.0_wp, -arm(3), arm(2)])/rod(1)
    normal = cross([1.0_wp, 0.0_wp, 0.0_wp], cross([1.0_wp, 0.0_wp, 0.0_wp], rod))
    ! spin = rod x (vC - vB)/L**2 + a rod, a from spin.normal = 0
    spin = cross(rod, [slide, arm(3), -arm(2)])/0.09_wp
    spin = spin - rod*dot_product(spin, normal)/dot_product(rod, normal)
    middle = 0.5_wp*[slide, -arm(3), arm(2)]
    axial = dot_product(spin, rod)/0.3_wp
    inertia = (1.0e-4_wp + 0.12_wp*0.04_wp**2) + 2*slide**2 + 0.5_wp*dot_product(middle, middle) &
              + 4.0e-3_wp*dot_product(spin, spin) - 3.6e-3_wp*axial**2
    energy = 0.5_wp*inertia*rate**2 + g*(0.12_wp*0.5_wp*(arm(3) - 0.08_wp) &
                                         + 0.5_wp*0.5_wp*(b(3) - 0.2_wp))
  end function energy

end module test_transient_start
