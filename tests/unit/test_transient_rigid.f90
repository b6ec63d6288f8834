!> TRANSIENT with rigid bodies, against ordinary differential equations and published numbers.
module test_transient_rigid
  use kinds, only: wp
  use check, only: run, expect, expect_close
  use model_data, only: model_t
  use motion_recorder, only: motion_t, follow, setting, observed_order
  use exact_motions, only: swing, double_swing
  implicit none
  private

  public :: run_transient_rigid_tests

  real(wp), parameter :: pi = acos(-1.0_wp), g = 9.81_wp

contains

  subroutine run_transient_rigid_tests()
    call run("transient: simple pendulum for 10 s (MBD-01)", pendulum)
    call run("transient: order 2 in places and reactions of a pendulum", pendulum_order)
    call run("transient: double pendulum (MBD-03)", double_pendulum)
    call run("transient: rigid beam is a rigid body, both kinds of mass", rigid_beam)
    call run("transient: constraints hold for 1e5 steps", long_run)
    call run("transient: Bricard mechanism, overconstrained (MBD-11)", bricard)
    call run("transient: spatial slider-crank from rest", slider_crank)
  end subroutine run_transient_rigid_tests

  !> Elliptic integrals; bars of two kinds. The error grows with time and falls with h**2:
  !> numbers are of extrapolation to h = 0. Period from the motion's symmetry: at rest at 4 T.
  subroutine pendulum()
    real(wp), parameter :: times(4) = [1.0_wp, 2.0_wp, 5.0_wp, 10.0_wp]
    real(wp), parameter :: wanted(2, 4) = reshape([0.9862917511318741_wp, -0.1650108531255489_wp, &
      -0.7935661953432699_wp, -0.6084839304438592_wp, -0.9423054350438163_wp, &
      -0.3347543384138348_wp, -0.2750874625766221_wp, -0.9614192050989805_wp], [2, 4])
    type(motion_t) :: motion
    type(model_t) :: model
    real(wp) :: place(2, 4, 2), drift(2)
    integer :: i, k

    do k = 1, 2
      call follow(merge("pendulum      ", "truss_pendulum", k == 1), motion, model, &
                  [setting("h", 2.0e-3_wp/k), setting("rho", 0.9_wp)])
      if (motion%steps < 2) return
      do i = 1, 4
        associate (r => motion%results(motion%at(times(i))))
          place(:, i, k) = r%displacement(1:2, 2) - [1, 0]
        end associate
      end do
      drift(k) = abs(motion%results(motion%steps)%energy(6))
      call expect_close(motion%constraint, 0.0_wp, 1.0e-13_wp, "length of the bar")
    end do
    do i = 1, 4
      call expect_close((4*place(:, i, 2) - place(:, i, 1))/3, wanted(:, i), 1.0e-4_wp, &
                        "place of the mass")
    end do
    call expect_close(drift(2), 0.0_wp, 1.0e-4_wp, "energy after 10 s")
    call expect(drift(2) < 0.3_wp*drift(1), "energy is lost with h**2")
  end subroutine pendulum

  !> Place, velocity and support's force at rest's first second, from halved steps.
  subroutine pendulum_order()
    real(wp), parameter :: radius(3) = [1.0_wp, 0.8_wp, 0.5_wp], times(2) = [0.5_wp, 1.0_wp]
    type(motion_t) :: motion
    type(model_t) :: model
    real(wp) :: error(2, 3, 2, 3), exact(2), down(2), along(2)
    character(len=8), parameter :: what(3) = ["place   ", "velocity", "reaction"]
    integer :: r, k, i

    do r = 1, 3
      do k = 1, 3
        call follow("pendulum", motion, model, [setting("h", 0.01_wp/2**k), &
                    setting("rho", radius(r)), setting("end", 1.0_wp)])
        if (motion%steps < 2) return
        do i = 1, 2
          exact = swing(g, times(i))
          down = [sin(exact(1)), -cos(exact(1))]
          along = [cos(exact(1)), sin(exact(1))]
          associate (s => motion%results(motion%at(times(i))))
            error(:, 1, i, k) = s%displacement(1:2, 2) - [1, 0] - down
            error(:, 2, i, k) = s%velocity(1:2, 2) - exact(2)*along
            error(:, 3, i, k) = s%reaction(1:2, 1) + (exact(2)**2 - g*down(2))*down
          end associate
        end do
      end do
      do i = 1, 3
        do k = 1, 2
          call expect_close(observed_order(error(:, i, k, 2), error(:, i, k, 3)), 2.0_wp, &
                            0.1_wp, "order of the "//trim(what(i)))
        end do
      end do
    end do
  end subroutine pendulum_order

  subroutine double_pendulum()
    real(wp), parameter :: times(4) = [0.5_wp, 1.0_wp, 2.0_wp, 3.0_wp]
    real(wp), parameter :: published(2, 4) = reshape([0.5704720512329653_wp, &
      1.203875111158268_wp, -0.6250876998063707_wp, -1.0345850856800576_wp, &
      -0.4829715342517715_wp, -1.3240487123022953_wp, 1.7857955220773694_wp, &
      1.1181074612052702_wp], [2, 4])
    type(motion_t) :: motion
    type(model_t) :: model
    real(wp) :: angle(4), place(2, 2, 2)
    integer :: i, k

    do i = 1, 4
      angle = double_swing(times(i))
      call expect_close(angle(1:2), published(:, i), 1.0e-6_wp, "the equations of this test")
    end do
    do i = 1, 4
      do k = 1, 2
        call follow("double_pendulum", motion, model, [setting("h", 2.0e-3_wp/k), &
                    setting("end", times(i)), setting("rho", 0.9_wp)])
        if (motion%steps < 2) return
        place(:, :, k) = motion%results(motion%steps)%displacement(1:2, 2:3)
        place(1, :, k) = place(1, :, k) + [1, 2]
      end do
      place(:, :, 2) = (4*place(:, :, 2) - place(:, :, 1))/3
      associate (a => published(1, i), b => published(2, i))
        call expect_close(place(:, 1, 2), [sin(a), -cos(a)], 1.0e-3_wp, "first mass")
        call expect_close(place(:, 2, 2), [sin(a) + sin(b), -cos(a) - cos(b)], 1.0e-3_wp, &
                          "second mass")
      end associate
    end do
  end subroutine double_pendulum

  !> J = m L**2/3 + rho Iz L of the consistent mass (cubic fields are exact for rigid motion),
  !> m L**2/2 + rho Iz L of the lumped one; the weight's moment is the same. Errors in h**2, h**3,
  !> h**4 are removed by halvings.
  subroutine rigid_beam()
    real(wp), parameter :: mass = 5.0_wp, rotary = 1000*0.1_wp*0.05_wp**3/12
    type(motion_t) :: motion
    type(model_t) :: model
    real(wp) :: angle(4), inertia, exact(2)
    integer :: k, p, kind

    do kind = 1, 2
      inertia = mass/merge(3, 2, kind == 1) + rotary
      exact = swing(0.5_wp*mass*g/inertia, 0.5_wp)
      do k = 1, 4
        call follow("rigid_beam", motion, model, [setting("h", 0.01_wp/2**(k - 1)), &
                    setting("mass", merge("CONSISTENT", "LUMPED    ", kind == 1))])
        if (motion%steps < 2) return
        associate (d => motion%results(motion%steps)%displacement(:, 2))
          angle(k) = atan2(d(2), d(1) + 1)
        end associate
      end do
      do p = 2, 4
        angle(:5 - p) = (2**p*angle(2:6 - p) - angle(:5 - p))/(2**p - 1)
      end do
      call expect_close(-angle(1), exact(1) + 0.5_wp*pi, 1.0e-8_wp, "angle after 0.5 s")
    end do
  end subroutine rigid_beam

  !> 1e5 steps, each of them looked at.
  subroutine long_run()
    type(motion_t) :: motion
    type(model_t) :: model

    motion%kept = .false.
    call follow("truss_pendulum", motion, model, [setting("h", 1.0e-3_wp), &
                setting("end", 100.0_wp), setting("rho", 0.9_wp)])
    call expect(motion%complete, "the end is reached")
    call expect_close(motion%time(1), 100.0_wp, 1.0e-9_wp, "time")
    call expect_close(motion%constraint, 0.0_wp, 1.0e-10_wp, "gap over the model's length")
  end subroutine long_run

  !> Six hinges hold once more than they need to, which is said. All rods are as at the start, the
  !> work of the weight is what moves them.
  subroutine bricard()
    type(motion_t) :: motion
    type(model_t) :: model
    real(wp) :: lost(2), height
    integer :: i, k

    do k = 1, 2
      call follow("bricard", motion, model, [setting("h", 0.02_wp/k), setting("end", 10.0_wp)])
      if (motion%steps < 2) return
      lost(k) = 0
      do i = 1, motion%steps
        associate (r => motion%results(i))
          height = r%displacement(2, 2) + r%displacement(2, 3) + r%displacement(2, 4) &
                   + r%displacement(2, 5)
          call expect_close(r%energy(3), -g*height, 1.0e-9_wp, "work of the weight")
          lost(k) = max(lost(k), abs(r%energy(1) - r%energy(3)))
        end associate
      end do
      call expect_close(motion%constraint, 0.0_wp, 1.0e-12_wp, "hinges and rods")
      call expect(size(motion%remarks) == 1, "one remark")
      if (size(motion%remarks) /= 1) return
      call expect(index(motion%remarks(1)%s, "overconstrained") > 0, "that it is overconstrained")
    end do
    call expect(maxval([(abs(motion%results(i)%displacement(1, 4)), i=1, motion%steps)]) > 1.9_wp, &
                "it moves far")
    call expect_close(lost(2), 0.0_wp, 1.0e-3_wp*5*g, "energy over m g L")
    call expect(lost(2) < 0.3_wp*lost(1), "what is missing goes with h**2")
  end subroutine bricard

  !> Pushed off by a gravity that is inclined: the place of the slider from the crank's angle.
  subroutine slider_crank()
    type(motion_t) :: motion
    type(model_t) :: model
    real(wp) :: lost(2)
    integer :: i, k

    do k = 1, 2
      call follow("slider_crank", motion, model, [setting("w", 0.0_wp), setting("gy", -5.0_wp), &
                  setting("h", 4.0e-3_wp/2**k)])
      if (motion%steps < 2) return
      lost(k) = 0
      do i = 1, motion%steps
        associate (r => motion%results(i))
          call expect_close(0.2_wp + r%displacement(1, 3), &
                            sqrt(0.09_wp - (0.1_wp - 0.08_wp*sin(r%joint_strain(1, 1)))**2 &
                                 - (0.12_wp + 0.08_wp*cos(r%joint_strain(1, 1)))**2), &
                            1.0e-12_wp, "the slider's place by the crank's angle")
          lost(k) = max(lost(k), abs(r%energy(6)))
        end associate
      end do
    end do
    call expect(motion%results(motion%steps)%joint_strain(1, 1) > 3, "half a turn and more")
    call expect_close(lost(2)/0.5_wp, 0.0_wp, 1.0e-3_wp, "energy over the largest kinetic energy")
    call expect(lost(2) < 0.3_wp*lost(1), "what is missing goes with h**2")
  end subroutine slider_crank

end module test_transient_rigid
