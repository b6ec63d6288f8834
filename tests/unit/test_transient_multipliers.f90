!> TRANSIENT: forces of constraints and velocities across them, of both forms of the constraints.
module test_transient_multipliers
  use kinds, only: wp
  use check, only: run, expect, expect_close
  use model_data, only: model_t
  use motion_recorder, only: motion_t, follow, setting, observed_order
  implicit none
  private

  public :: run_transient_multipliers_tests

  real(wp), parameter :: pi = acos(-1.0_wp), g = 9.81_wp
  character(len=*), parameter :: forms(2) = ["ON ", "OFF"]

contains

  subroutine run_transient_multipliers_tests()
    call run("multipliers: order 2 from a start at speed, a top", top_order)
    call run("multipliers: order 2 behind a jump of the load", jump_order)
    call run("multipliers: order 2 of a driving torque, at speed from the start on", drive_order)
    call run("multipliers: order 2 across kinks of a drive, whose blows are its work", kinks)
    call run("multipliers: a drive that jumps is told", jumping_drive)
    call run("multipliers: a mass on a spring whose support jumps", jumping_support)
    call run("multipliers: torque of a measured motion, as SPLINE and as TABLE", measured)
    call run("multipliers: velocities satisfy the constraints", exact_velocities)
    call run("multipliers: no growth without numerical damping", no_growth)
    call run("multipliers: order 2 with hinges of bars without mass, in space", gimbal)
    call run("multipliers: a blow passes by a damper", damped_blow)
    call run("multipliers: stiff arms in long steps", stiff_arms)
    call run("multipliers: misaligned four-bar linkage as INVERSE finds it (FLX-08)", misaligned)
  end subroutine run_transient_multipliers_tests

  !> In steady precession the centre of mass goes round with w, which the support's force makes it
  !> do: m w**2 sin(theta), and it carries the weight.
  subroutine top_order()
    real(wp), parameter :: radius(3) = [1.0_wp, 0.8_wp, 0.0_wp], w = 3.105309340559323_wp
    real(wp), parameter :: mass = 15.0_wp, theta = pi/3
    type(motion_t) :: motion
    type(model_t) :: model
    real(wp) :: error(2), force(3)
    integer :: i, k, r, form

    do form = 1, 2
      do r = form, 3  ! of places alone, errors of RHOINF 1 do not fade
        error = 0
        do k = 1, 2
          call follow("top", motion, model, [setting("theta", 60.0_wp), setting("w", w), &
                      setting("h", 4.0e-4_wp/2**k), setting("end", 0.02_wp), &
                      setting("rho", radius(r)), setting("form", forms(form))])
          if (motion%steps < 2) return
          do i = 2, motion%steps
            force = mass*[-w**2*sin(theta)*cos(w*motion%time(i)), &
                          -w**2*sin(theta)*sin(w*motion%time(i)), g]
            error(k) = max(error(k), maxval(abs(motion%results(i)%reaction(:3, 1) - force)))
          end do
        end do
        call expect_close(observed_order(error(1:1), error(2:2)), 2.0_wp, 0.1_wp, &
                          "order, STABILISED "//trim(forms(form)))
        call expect(error(2) < mass*w**2*(2.0e-4_wp*150)**2, "error of h**2 spin**2")
      end do
    end do
  end subroutine top_order

  !> Force of a simple pendulum's bar from its place and velocity, with the load that acts from
  !> 0.3 s on: w**2 + (load + weight).bar.
  pure real(wp) function bar_force_error(motion, i, push) result(error)
    type(motion_t), intent(in) :: motion
    integer, intent(in) :: i
    real(wp), intent(in) :: push
    real(wp) :: bar(2)

    associate (r => motion%results(i))
      bar = r%displacement(1:2, 2) - [1, 0]
      error = norm2(r%reaction(1:2, 1) + (dot_product(r%velocity(1:2, 2), r%velocity(1:2, 2)) &
                    + push*bar(1) - g*bar(2))*bar)
    end associate
  end function bar_force_error

  subroutine jump_order()
    real(wp), parameter :: radius(3) = [1.0_wp, 0.7_wp, 0.2_wp], push = 40.0_wp
    type(motion_t) :: motion
    type(model_t) :: model
    real(wp) :: error(2)
    integer :: i, k, r, form

    do form = 1, 2
      do r = form, 3  ! of places alone, errors of RHOINF 1 do not fade
        error = 0
        do k = 1, 2
          call follow("pushed_pendulum", motion, model, [setting("h", 5.0e-3_wp/2**k), &
                      setting("rho", radius(r)), setting("form", forms(form))])
          if (motion%steps < 2) return
          do i = 2, motion%steps
            error(k) = max(error(k), bar_force_error(motion, i, &
                             merge(push, 0.0_wp, motion%time(i) > 0.2999999_wp)))
          end do
        end do
        call expect_close(observed_order(error(1:1), error(2:2)), 2.0_wp, 0.1_wp, &
                          "order, STABILISED "//trim(forms(form)))
      end do
    end do
  end subroutine jump_order

  !> m r**2 angle'' + m g r cos(angle), and less than it the stress of the strain that is driven.
  subroutine drive_order()
    real(wp), parameter :: radius(3) = [1.0_wp, 0.8_wp, 0.0_wp], mass = 1.5_wp, arm = 0.8_wp
    real(wp), parameter :: amplitude = 0.7_wp, rate = pi
    type(motion_t) :: motion
    type(model_t) :: model
    real(wp) :: error(2), angle, torque
    integer :: i, k, r, form

    do form = 1, 2
      do r = form, 3  ! of places alone, errors of RHOINF 1 do not fade
        error = 0
        do k = 1, 2
          call follow("driven_pendulum", motion, model, [setting("h", 0.01_wp/2**k), &
                      setting("rho", radius(r)), setting("form", forms(form))])
          if (motion%steps < 2) return
          do i = 2, motion%steps
            angle = amplitude*sin(rate*motion%time(i))
            torque = -mass*arm**2*rate**2*angle + mass*g*arm*cos(angle)
            error(k) = max(error(k), abs(abs(motion%results(i)%joint_stress(1, 1)) - abs(torque)))
          end do
        end do
        call expect_close(observed_order(error(1:1), error(2:2)), 2.0_wp, 0.1_wp, &
                          "order, STABILISED "//trim(forms(form)))
      end do
    end do
  end subroutine drive_order

  !> A mass set in motion and stopped at once, in the middle of a step and at its end: in between
  !> its weight alone takes a torque. The drive gives and takes m r**2 w**2/2.
  subroutine kinks()
    real(wp), parameter :: mass = 1.5_wp, arm = 0.8_wp, start(2) = [0.305_wp, 0.3_wp]
    type(motion_t) :: motion
    type(model_t) :: model
    real(wp) :: error(2), balance(2), angle, rate
    integer :: i, j, k

    do j = 1, 2
      rate = 1/(0.7_wp - start(j))
      error = 0
      do k = 1, 2
        call follow("ramped_pendulum", motion, model, [setting("h", 0.02_wp/2**k), &
                                                       setting("t0", start(j))])
        if (motion%steps < 2) return
        do i = 1, motion%steps
          associate (r => motion%results(i), t => motion%time(i))
            angle = rate*min(max(t - start(j), 0.0_wp), 0.7_wp - start(j))
            error(k) = max(error(k), abs(abs(r%joint_stress(1, 1)) - mass*g*arm*cos(angle)))
            if (t < start(j) + 1.0e-6_wp .or. t > 0.7_wp - 1.0e-6_wp) cycle
            call expect_close(r%energy(1), 0.5_wp*mass*(arm*rate)**2, 1.0e-10_wp, "kinetic")
          end associate
        end do
        balance(k) = abs(motion%results(motion%steps)%energy(6))
      end do
      call expect(error(2) < 0.3_wp*error(1), "the torque's error goes with h**2")
      call expect(error(1) < mass*g*arm*(rate*0.01_wp)**2, "and is of its order")
      call expect(balance(2) < 0.3_wp*balance(1), "so does what is missing in the account")
      call expect(balance(1) < mass*g*arm*(rate*0.01_wp)**2, "and is of its order")
    end do
  end subroutine kinks

  subroutine jumping_drive()
    type(motion_t) :: motion
    type(model_t) :: model

    call follow("jumping_drive", motion, model, [character(len=1) ::])
    call expect(size(motion%remarks) == 1, "one remark")
    if (size(motion%remarks) /= 1) return
    call expect(index(motion%remarks(1)%s, "element 2 mode 1 (hinge) jumps at time 0.305") > 0, &
                "what jumps, and when")
  end subroutine jumping_drive

  !> x = d (1 - cos(w t)) from the jump on; it puts k d**2/2 into the spring.
  subroutine jumping_support()
    real(wp), parameter :: d = 0.01_wp, w = 5, k = 50
    type(motion_t) :: motion
    type(model_t) :: model
    real(wp) :: error(2), balance(2), x
    integer :: i, j

    error = 0
    balance = 0
    do j = 1, 2
      call follow("jumping_support", motion, model, [setting("h", 0.02_wp/2**j)])
      if (motion%steps < 2) return
      do i = 1, motion%steps
        x = d*(1 - cos(w*max(motion%time(i) - 0.2_wp, 0.0_wp)))
        associate (r => motion%results(i))
          error(j) = max(error(j), abs(r%displacement(1, 2) - x))
          balance(j) = max(balance(j), abs(r%energy(6)))
        end associate
      end do
      call expect_close(motion%results(motion%steps)%energy(4), 0.5_wp*k*d**2, &
                        1.0e-6_wp*0.5_wp*k*d**2, "work of the jump")
    end do
    call expect_close(observed_order(error(1:1), error(2:2)), 2.0_wp, 0.1_wp, "order of the place")
    call expect(balance(2) < 0.3_wp*balance(1), "what is missing in the account goes with h**2")
  end subroutine jumping_support

  !> Through points of a sine 0.05 apart a spline's second derivative is off by 0.05**2/12 of the
  !> fourth one, away from the ends; a table has none, which is told.
  subroutine measured()
    real(wp), parameter :: mass = 1.5_wp, arm = 0.8_wp, off = 0.05_wp**2/12*0.7_wp*pi**4
    type(motion_t) :: motion
    type(model_t) :: model
    real(wp) :: angle, torque
    integer :: i

    call follow("measured_pendulum", motion, model, [character(len=1) ::])
    call expect(motion%steps == 101 .and. size(motion%remarks) == 0, "runs, no remarks")
    if (motion%steps /= 101) return
    do i = 21, 81
      angle = 0.7_wp*sin(pi*motion%time(i))
      torque = mass*arm*(g*cos(angle) - arm*pi**2*angle)
      call expect_close(abs(motion%results(i)%joint_stress(1, 1)), torque, &
                        1.5_wp*mass*arm**2*off, "torque")
    end do
    call follow("measured_pendulum", motion, model, ["drive=straight"])
    call expect(size(motion%remarks) == 1, "one remark")
    if (size(motion%remarks) /= 1) return
    call expect(index(motion%remarks(1)%s, "kinks at each point") > 0, "of the kinks")
  end subroutine measured

  !> A bar's velocity has no part along it; places alone leave one of the order of h**2.
  subroutine exact_velocities()
    type(motion_t) :: motion
    type(model_t) :: model
    real(wp) :: along(2)
    integer :: i, form

    along = 0
    do form = 1, 2
      call follow("pendulum", motion, model, [setting("h", 0.01_wp), setting("end", 2.0_wp), &
                                              setting("rho", 0.9_wp), setting("form", forms(form))])
      if (motion%steps < 2) return
      do i = 1, motion%steps
        associate (r => motion%results(i))
          along(form) = max(along(form), abs(dot_product(r%velocity(1:2, 2), &
                                                         r%displacement(1:2, 2) - [1, 0])))
        end associate
      end do
    end do
    call expect_close(along(1), 0.0_wp, 1.0e-13_wp, "velocity along the bar")
    call expect(along(2) > 1.0e-6_wp, "this test can fail")
  end subroutine exact_velocities

  !> With RHOINF 1 the error of the bar's force stays what it is in the first swing.
  subroutine no_growth()
    type(motion_t) :: motion
    type(model_t) :: model
    real(wp) :: error(2)
    integer :: i, half

    call follow("pendulum", motion, model, [setting("h", 0.01_wp), setting("end", 40.0_wp)])
    call expect(motion%steps == 4001 .and. size(motion%remarks) == 0, "runs, without a warning")
    if (motion%steps /= 4001) return
    error = 0
    do i = 2, motion%steps
      half = merge(1, 2, i < motion%steps/2)
      error(half) = max(error(half), bar_force_error(motion, i, 0.0_wp))
    end do
    call expect(error(2) < 1.1_wp*error(1), "no growth")
    call expect(error(1) < 3*g*0.01_wp**2*3*g, "of the order of h**2")
  end subroutine no_growth

  !> The support's force as INVERSE finds it; with the recorded acceleration it balances the weight,
  !> but for the increments that Newton leaves, 1e-10 of the length.
  subroutine gimbal()
    real(wp), parameter :: radius(2) = [0.5_wp, 0.0_wp], mass = 1.5_wp, h = 0.01_wp
    type(motion_t) :: motion, driven
    type(model_t) :: model
    real(wp) :: error(2), left(3)
    integer :: i, k, r, form

    call follow("../kinematic/gimbal", driven, model, [setting("h", h/2)])
    do form = 1, 2
      do r = 1, 2
        error = 0
        do k = 1, 2
          call follow("gimbal", motion, model, [setting("h", h/k), setting("rho", radius(r)), &
                                                setting("form", forms(form))])
          if (motion%steps < 2 .or. driven%steps < 2) return
          do i = 2, motion%steps
            associate (now => motion%results(i), &
                       force => driven%results(1 + (3 - k)*(i - 1))%reaction(:3, 1))
              error(k) = max(error(k), maxval(abs(now%reaction(:3, 1) - force)))
              left = now%reaction(:3, 1) - mass*(now%acceleration(:3, 3) + [0.0_wp, 0.0_wp, g])
              if (k == 2) call expect_close(left, 0*left, mass*1.0e-10_wp/(h/2)**2, "balance")
            end associate
          end do
        end do
        call expect_close(observed_order(error(1:1), error(2:2)), 2.0_wp, 0.1_wp, &
                          "order, STABILISED "//trim(forms(form)))
      end do
    end do
  end subroutine gimbal

  !> What is at rest at the far end of a hinged bar stays so when the near end is struck, however
  !> strong the damper: it takes a part h c/(m r**2)/100 of the blow in the matrix of the start, of
  !> which a second solution leaves the square.
  subroutine damped_blow()
    real(wp), parameter :: c = 5, mass(2) = [2.0_wp, 1.5_wp], arm(2) = [1.0_wp, 0.6_wp]
    real(wp), parameter :: rate = 2.5_wp, h = 0.01_wp
    type(motion_t) :: motion
    type(model_t) :: model
    real(wp) :: part

    call follow("damped_blow", motion, model, [setting("h", h)])
    if (motion%steps /= 21) return
    part = 0.01_wp*h*c*(1/arm(1) + 1/arm(2))/(mass(2)*arm(2))
    associate (r => motion%results(11))
      call expect_close(r%velocity(2, 2), rate*arm(1), 1.0e-12_wp, "what is struck")
      call expect_close(r%velocity(2, 3), 0.0_wp, 4*part**2*rate, "what is not")
      call expect_close(r%energy(1), 0.5_wp*mass(1)*(rate*arm(1))**2, 4*part**2*rate**2, "energy")
      call expect_close(r%energy(4), r%energy(1), 1.0e-12_wp, "which is the drive's work")
    end associate
  end subroutine damped_blow

  !> The law of energy holds as well as in the classical form, and strains are those of the motion.
  subroutine stiff_arms()
    type(motion_t) :: motion
    type(model_t) :: model
    real(wp) :: kinetic, missing(2), strain(2)
    integer :: i, form

    missing = 0
    strain = 0
    do form = 1, 2
      call follow("stiff_arm", motion, model, [setting("form", forms(form))])
      call expect(motion%steps == 51, "runs, STABILISED "//trim(forms(form)))
      if (motion%steps /= 51) return
      kinetic = 0
      do i = 1, motion%steps
        kinetic = max(kinetic, motion%results(i)%energy(1))
        strain(form) = max(strain(form), motion%results(i)%energy(2))
        missing(form) = max(missing(form), abs(motion%results(i)%energy(6)))
      end do
      call expect(missing(form) < 1.0e-3_wp*kinetic, "energy")
    end do
    call expect_close(strain(1)/strain(2), 1.0_wp, 0.05_wp, "energy of the strains")
  end subroutine stiff_arms

  !> At 0.6 rad/s inertia forces are small, and what a run in time finds is what the driven motion
  !> has without integration; in line the linkage stays in its plane.
  subroutine misaligned()
    character(len=*), parameter :: deck = "misaligned_four_bar"
    type(motion_t) :: motion, driven
    type(model_t) :: model
    integer :: i

    call follow("../../../decks/"//deck, motion, model, [setting("end", 3.0_wp)])
    call follow("../kinematic/"//deck, driven, model, [setting("end", 3.0_wp)])
    call expect(motion%steps == 151 .and. driven%steps == 151, "both runs")
    if (motion%steps /= 151 .or. driven%steps /= 151) return
    do i = 51, 151, 50
      associate (a => motion%results(i), b => driven%results(i))
        call expect_close(a%displacement, b%displacement, 1.0e-6_wp, "places")
        call expect_close(a%joint_stress(1, 1)/b%joint_stress(1, 1), 1.0_wp, 1.0e-3_wp, "drive")
        call expect_close(a%stress/maxval(abs(b%stress)), b%stress/maxval(abs(b%stress)), &
                          1.0e-3_wp, "stress resultants")
      end associate
    end do
    call follow("../../../decks/"//deck, motion, model, [setting("end", 2.0_wp), &
                                                         setting("angle", 0.0_wp)])
    call expect(all(abs(motion%results(101)%displacement(3, :)) <= 1.0e-14_wp), "in its plane")
  end subroutine misaligned

end module test_transient_multipliers
