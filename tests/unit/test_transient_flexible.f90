!> TRANSIENT with flexible beams, against series, published numbers, another program, and what a
!> free motion conserves.
module test_transient_flexible
  use kinds, only: wp
  use check, only: run, expect, expect_close
  use model_data, only: model_t
  use rotation, only: rotated, identity3
  use motion_recorder, only: motion_t, follow, setting, observed_order
  use exact_motions, only: cantilever_series, elastic_swing
  implicit none
  private

  public :: run_transient_flexible_tests

  real(wp), parameter :: pi = acos(-1.0_wp)

contains

  subroutine run_transient_flexible_tests()
    call run("transient: cantilever, step force (FLX-01)", step_force)
    call run("transient: I beam on forks, step torque (FLX-03)", step_torque)
    call run("transient: spin-up (FLX-04)", spin_up)
    call run("transient: flying spaghetti (FLX-05, FLX-10)", spaghetti)
    call run("transient: energy decays with numerical damping", decay)
    call run("transient: order 2 of a mass on a spring", elastic_order)
    call run("transient: order 2 of a driven beam with dampers", driven_order)
  end subroutine run_transient_flexible_tests

  !> The series of modes, at all times; and values of it.
  subroutine step_force()
    real(wp), parameter :: times(5) = [0.005_wp, 0.01_wp, 0.02_wp, 0.03_wp, 0.05_wp]
    real(wp), parameter :: series(5) = [6.600924864521168e-05_wp, 0.0002203323558410875_wp, &
      0.0004391972658341468_wp, 0.0002639963916350435_wp, 0.00017598090776771964_wp]
    type(motion_t) :: motion
    type(model_t) :: model
    real(wp) :: got(5), worst
    integer :: i

    call follow("step_force", motion, model, [setting("n", "8")])
    if (motion%steps < 2) return
    got = [(motion%results(motion%at(times(i)))%displacement(2, 2), i=1, 5)]
    call expect_close(got/series, spread(1.0_wp, 1, 5), 0.01_wp, "tip over the series")
    worst = 0
    do i = 1, motion%steps
      worst = max(worst, abs(motion%results(i)%displacement(2, 2) &
        - cantilever_series(210e9_wp*5.625e-6_wp, 7850*0.00503_wp, 2.0_wp, 100.0_wp, &
                            motion%time(i))))
    end do
    call expect_close(worst/maxval(series), 0.0_wp, 4.0e-3_wp, "at all times, over the largest")
  end subroutine step_force

  !> Vlasov; the load at the nodes stands for the one along the beam with an error of n**(-2).
  subroutine step_torque()
    real(wp), parameter :: times(5) = [0.005_wp, 0.01_wp, 0.0125_wp, 0.02_wp, 0.025_wp]
    real(wp), parameter :: wanted(5) = [0.002101366657327644_wp, 0.0055529062982646645_wp, &
      0.006110630159538763_wp, 0.0020136355618718196_wp, -1.1722367413277456e-05_wp]
    type(motion_t) :: motion
    type(model_t) :: model
    real(wp) :: got(5)
    integer :: i

    call follow("step_torque", motion, model, [setting("n", "20")])
    if (motion%steps < 2) return
    got = [(2*asin(motion%results(motion%at(times(i)))%euler(2, 11)), i=1, 5)]
    call expect_close(got/maxval(wanted), wanted/maxval(wanted), 5.0e-3_wp, &
                      "rotation of the middle")
    call expect_close(got(:4)/wanted(:4), spread(1.0_wp, 1, 4), 0.01_wp, "rotation over the series")
    call expect(any(abs(motion%frequency/40.231294125005405_wp - 1) < 1.0e-3_wp), &
                "that EIGEN finds the frequency of the first torsion")
  end subroutine step_torque

  !> Simo and Vu-Quoc 1986; another program for the curve, to 2 % of the largest deflection.
  subroutine spin_up()
    real(wp), parameter :: other(2, 6) = reshape([-0.00133_wp, -0.15198_wp, -0.01268_wp, &
      -0.46895_wp, -0.0177_wp, -0.55845_wp, -0.00719_wp, -0.36576_wp, -0.00024_wp, -0.1138_wp, &
      0.00051_wp, 0.00279_wp], [2, 6])
    type(motion_t) :: motion
    type(model_t) :: model
    real(wp) :: tip(2), steady, lowest, when
    integer :: i, n

    call follow("spin_up", motion, model, [setting("n", "8"), setting("h", 0.01_wp)])
    if (motion%steps < 2) return
    do i = 1, 6
      tip = in_turning_axes(motion%at(2.5_wp*i))
      call expect_close(tip, other(:, i), 0.02_wp*0.57557_wp, "tip seen from the hub")
    end do
    steady = 0
    lowest = 0
    n = 0
    do i = 1, motion%steps
      tip = in_turning_axes(i)
      if (tip(2) < lowest) then
        lowest = tip(2)
        when = motion%time(i)
      end if
      if (motion%time(i) < 16) cycle
      steady = steady + tip(1)
      n = n + 1
    end do
    call expect_close([lowest/(-0.57557_wp), when/6.78773_wp], [1.0_wp, 1.0_wp], 0.02_wp, &
                      "largest deflection and its time")
    call expect_close(steady/n/0.0005143174550426011_wp, 1.0_wp, 2.0e-3_wp, &
                      "mean extension by the centrifugal force, tan(k L)/k - L")
    call expect_close(motion%constraint, 0.0_wp, 1.0e-12_wp, "the hub's angle")

  contains

    function in_turning_axes(i) result(tip)
      integer, intent(in) :: i
      real(wp) :: tip(2), angle, t

      t = min(motion%time(i), 15.0_wp)
      angle = 0.4_wp*(0.5_wp*t**2 + (7.5_wp/pi)**2*(cos(2*pi*t/15) - 1)) &
              + 6*(motion%time(i) - t)
      associate (x => motion%results(i)%displacement(1:2, 2) + [10, 0])
        tip = [cos(angle)*x(1) + sin(angle)*x(2) - 10, cos(angle)*x(2) - sin(angle)*x(1)]
      end associate
    end function in_turning_axes

  end subroutine spin_up

  !> Places to 1 % of the length. The momentum is that of the pulse, which ends at 2.5 s; later it
  !> and the energy stay.
  subroutine spaghetti()
    real(wp), parameter :: other(6, 4) = reshape([4.43013_wp, -0.78514_wp, 5.94529_wp, 8.97066_wp, &
      5.58869_wp, 3.98125_wp, 5.6214_wp, 4.76525_wp, 15.41001_wp, 4.26215_wp, 10.47205_wp, &
      3.60827_wp, 15.5474_wp, 8.99469_wp, 15.75417_wp, -0.97223_wp, 15.51316_wp, 3.99561_wp, &
      25.41356_wp, 4.7851_wp, 15.62803_wp, 4.15537_wp, 20.50718_wp, 3.80771_wp], [6, 4])
    type(motion_t) :: motion
    type(model_t) :: model
    real(wp) :: centre(3), start(3), pulse(6), energy, moved(6), drift
    integer :: i, middle, first

    call follow("spaghetti", motion, model, [setting("n", "16"), setting("h", 0.01_wp), &
                                             setting("end", 12.5_wp)])
    if (motion%steps < 2) return
    middle = findloc(model%node%id == 1 .and. model%node%part == 8, .true., 1)
    start = mass_centre(1)
    do i = 1, 4
      associate (d => motion%results(motion%at(2.5_wp*i))%displacement)
        call expect_close([d(1:2, 1) + [6, 0], d(1:2, 2) + [0, 8], d(1:2, middle) + [3, 4]], &
                          other(:, i), 0.1_wp, "places of the ends and the middle")
      end associate
      centre = mass_centre(motion%at(2.5_wp*i))
      call expect_close(centre - start, [5*i - 2.5_wp, 0.0_wp, 0.0_wp], 2.5e-4_wp, &
                        "way of the centre of mass")
    end do
    first = motion%at(2.5_wp)
    pulse = motion%results(first)%momentum
    call expect_close(pulse(1:3), [20.0_wp, 0.0_wp, 0.0_wp], 20*1.0e-6_wp, "momentum of the pulse")
    energy = sum(motion%results(first)%energy(1:2))
    moved = 0
    drift = 0
    do i = first, motion%steps
      moved = max(moved, abs(motion%results(i)%momentum - pulse))
      drift = max(drift, abs(sum(motion%results(i)%energy(1:2))/energy - 1))
    end do
    call expect_close(drift, 0.0_wp, 1.0e-4_wp, "energy for 10 s after the pulse")
    call expect_close(moved(1:3)/20, [0, 0, 0]*1.0_wp, 5.0e-6_wp, "momentum after the pulse")
    call expect_close(moved(6)/abs(pulse(6)), 0.0_wp, 1.0e-4_wp, "angular momentum")

  contains

    !> By Euler and Maclaurin: the trapezoidal rule over the nodes, corrected by the end slopes.
    function mass_centre(i) result(centre)
      integer, intent(in) :: i
      real(wp) :: centre(3), weight, first_end(3, 3), last_end(3, 3)
      real(wp), parameter :: along(3) = [-0.6_wp, 0.8_wp, 0.0_wp], piece = 10.0_wp/16
      integer :: n

      centre = 0
      associate (r => motion%results(i))
        do n = 1, size(model%node)
          weight = merge(0.5_wp, 1.0_wp, n <= 2)/16
          centre = centre + weight*(model%node(n)%position + r%displacement(:, n))
        end do
        first_end = rotated(r%euler(:, 1), identity3)
        last_end = rotated(r%euler(:, 2), identity3)
        centre = centre + piece**2/120*matmul(first_end - last_end, along)
      end associate
    end function mass_centre

  end subroutine spaghetti

  !> The energy that a place and its velocity have may rise from one step to the next by what
  !> oscillates with h**2, about 2e-5 of it here; over 1 s, 50 steps, it always falls.
  subroutine decay()
    type(motion_t) :: motion
    type(model_t) :: model
    real(wp), allocatable :: energy(:)
    integer :: i, n

    call follow("spaghetti", motion, model, [setting("n", "8"), setting("h", 0.02_wp), &
                                             setting("end", 12.5_wp), setting("rho", 0.5_wp)])
    if (motion%steps < 2) return
    energy = [(sum(motion%results(i)%energy(1:2)), i=motion%at(2.5_wp), motion%steps)]
    n = size(energy)
    call expect(n == 501, "10 s of steps")
    call expect(all(energy(2:) < energy(:n - 1)*(1 + 5.0e-5_wp)), "no step gains much")
    call expect(all(energy(51:) < energy(:n - 50)), "energy falls in each second")
    call expect(energy(n) < 0.998_wp*energy(1), "much is lost")
  end subroutine decay

  !> A mass on a spring that swings: without multipliers, place, velocity and spring's force.
  subroutine elastic_order()
    real(wp), parameter :: radius(3) = [1.0_wp, 0.8_wp, 0.5_wp]
    type(motion_t) :: motion
    type(model_t) :: model
    real(wp) :: error(5, 3), exact(4)
    integer :: r, k

    exact = elastic_swing(200.0_wp, 1.0_wp)
    do r = 1, 3
      do k = 1, 3
        call follow("elastic_pendulum", motion, model, [setting("h", 0.01_wp/2**k), &
                                                        setting("rho", radius(r))])
        if (motion%steps < 2) return
        associate (s => motion%results(motion%steps))
          error(1:2, k) = s%displacement(1:2, 2) - [1, 0] - exact(1:2)
          error(3:4, k) = s%velocity(1:2, 2) - exact(3:4)
          error(5, k) = s%joint_stress(1, 1) - 200*(norm2(exact(1:2)) - 1)
        end associate
      end do
      call expect_close(observed_order(error(1:2, 2), error(1:2, 3)), 2.0_wp, 0.1_wp, "place")
      call expect_close(observed_order(error(3:4, 2), error(3:4, 3)), 2.0_wp, 0.1_wp, "velocity")
      call expect_close(observed_order(error(5:5, 2), error(5:5, 3)), 2.0_wp, 0.1_wp, "force")
    end do
  end subroutine elastic_order

  !> Differences between halvings: places, forces of beams, reactions, the moment of the drive.
  subroutine driven_order()
    real(wp), parameter :: radius(3) = [1.0_wp, 0.8_wp, 0.5_wp]
    type(motion_t) :: motion
    type(model_t) :: model
    real(wp) :: found(13, 4)
    integer :: r, k

    do r = 1, 3
      do k = 1, 4
        call follow("work", motion, model, [setting("h", 0.005_wp/2**(k - 1)), &
                                            setting("rho", radius(r)), setting("end", 0.5_wp)])
        if (motion%steps < 2) return
        associate (s => motion%results(motion%steps))
          found(:, k) = [s%displacement(:, 3), s%velocity(1:3, 3), s%force_p(5, 1), &
                         s%force_p(6, 2), s%reaction(1:3, 1), s%joint_stress(1:2, 2)]
        end associate
      end do
      found(:, :3) = found(:, 2:) - found(:, :3)
      call expect_close(observed_order(found(1:3, 2), found(1:3, 3)), 2.0_wp, 0.1_wp, "place")
      call expect_close(observed_order(found(4:6, 2), found(4:6, 3)), 2.0_wp, 0.1_wp, "velocity")
      call expect_close(observed_order(found(7:8, 2), found(7:8, 3)), 2.0_wp, 0.1_wp, "moments")
      call expect_close(observed_order(found(9:11, 2), found(9:11, 3)), 2.0_wp, 0.1_wp, &
                        "reactions")
      call expect_close(observed_order(found(12:13, 2), found(12:13, 3)), 2.0_wp, 0.1_wp, &
                        "drive")
    end do
  end subroutine driven_order

end module test_transient_flexible
