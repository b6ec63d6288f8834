!> KINEMATIC and INVERSE against the closed forms of planar mechanisms.
module test_kinematic
  use kinds, only: wp
  use check, only: run, expect, expect_close
  use errors, only: error_t, exit_deck
  use model_data, only: model_t, analysis_kinematic, analysis_inverse, analysis_transient
  use memory_recorder, only: memory_t
  use mechanism_kit, only: new_mechanism, add_node, add_bar, add_hinge, add_mass, drive, &
                           add_analysis, run_mechanism, make_four_bar, four_bar_angles, unit, &
                           across
  implicit none
  private

  public :: run_kinematic_tests

  real(wp), parameter :: pi = acos(-1.0_wp)
  integer, parameter :: x = 1, y = 2, z = 3, rx = 4, ry = 5, rz = 6

contains

  subroutine run_kinematic_tests()
    call run("kinematic: slider-crank (MBD-10)", slider_crank)
    call run("kinematic: four-bar, a full turn of the crank", four_bar)
    call run("kinematic: parallelogram through its change points", parallelogram)
    call run("kinematic: a time just beside a change point", beside_change_point)
    call run("kinematic: two parallelograms in a row, very small steps", double_parallelogram)
    call run("kinematic: a start away from the drawing", far_start)
    call run("kinematic: then INVERSE, then TRANSIENT", in_turn)
    call run("kinematic: a motion that nothing prescribes", undriven)
    call run("kinematic: a position out of reach", out_of_reach)
    call run("inverse: driven compound pendulum", pendulum)
    call run("inverse: slider-crank, forces at the slider and the crank", driven_slider)
    call run("inverse: whirling mass on a spring", whirling)
  end subroutine run_kinematic_tests

  subroutine solve(model, memory)
    type(model_t), intent(inout) :: model
    type(memory_t), intent(out) :: memory
    type(error_t), allocatable :: error

    call run_mechanism(model, memory, error)
    if (allocated(error)) call expect(.false., "no error, got: "//error%message)
  end subroutine solve

  !> Crank and rod along x, the slider at `slider`; hinge 1 drives.
  subroutine make_slider_crank(crank, rod, speed, model, slider)
    real(wp), intent(in) :: crank, rod, speed
    type(model_t), intent(out) :: model
    integer, intent(out) :: slider
    integer :: ground, pin, pin_of_rod, base, i

    call new_mechanism(model)
    ground = add_node(model, [0.0_wp, 0.0_wp, 0.0_wp], [x, y, z])
    pin = add_node(model, [crank, 0.0_wp, 0.0_wp])
    slider = add_node(model, [crank + rod, 0.0_wp, 0.0_wp], [y])
    pin_of_rod = add_node(model, [crank, 0.0_wp, 0.0_wp])
    base = add_node(model, [0.0_wp, 0.0_wp, 0.0_wp], [rx, ry, rz])
    i = add_bar(model, ground, pin, ground, pin)
    i = add_bar(model, pin, slider, pin_of_rod, slider)
    i = add_hinge(model, base, ground, .true.)
    call drive(model, i, 0.0_wp, speed, 0.0_wp)
    i = add_hinge(model, pin, pin_of_rod, .false.)
  end subroutine make_slider_crank

  !> Place of the slider, and its derivatives to the crank's angle.
  pure function slider_jet(r, l, angle) result(jet)
    real(wp), intent(in) :: r, l, angle
    real(wp) :: jet(0:2), q

    q = sqrt(l**2 - (r*sin(angle))**2)
    jet(0) = r*cos(angle) + q
    jet(1) = -r*sin(angle) - r**2*sin(angle)*cos(angle)/q
    jet(2) = -r*cos(angle) - r**2*cos(2*angle)/q - (r**2*sin(angle)*cos(angle))**2/q**3
  end function slider_jet

  subroutine slider_crank()
    real(wp), parameter :: r = 0.15_wp, l = 0.3_wp, w = 150
    real(wp), parameter :: place(6) = [0.45_wp, 0.4203775615332221_wp, 0.3454163456597992_wp, &
                                       0.2598076211353316_wp, 0.1954163456597992_wp, 0.15_wp]
    integer, parameter :: degrees(6) = [0, 30, 60, 90, 120, 180]
    type(model_t) :: model
    type(memory_t) :: memory
    real(wp) :: jet(0:2)
    integer :: i, slider

    call make_slider_crank(r, l, w, model, slider)
    call add_analysis(model, analysis_kinematic, 2*pi/w, 2*pi/w/360)
    call solve(model, memory)
    call expect(memory%steps == 361, "the start and 360 steps")
    if (memory%steps /= 361) return
    do i = 1, 361
      jet = slider_jet(r, l, (i - 1)*pi/180)
      associate (now => memory%results(i))
        call expect_close(r + l + now%displacement(1, slider), jet(0), 1.0e-8_wp*r, "place")
        call expect_close(now%velocity(1, slider), w*jet(1), 1.0e-8_wp*w*r, "velocity")
        call expect_close(now%acceleration(1, slider), w**2*jet(2), 1.0e-8_wp*w**2*r, &
                          "acceleration")
        call expect_close(now%joint_strain(1, 1), (i - 1)*pi/180, 1.0e-12_wp, "angle of the crank")
        call expect_close(now%joint_rate(1, 1), w, 1.0e-10_wp*w, "its rate")
      end associate
      call expect_close(memory%record(i)%time, (i - 1)*pi/180/w, 1.0e-12_wp/w, "time")
      call expect(memory%record(i)%last%constraint <= 1.0e-12_wp, "constraints hold")
    end do
    do i = 1, 6
      call expect_close(r + l + memory%results(degrees(i) + 1)%displacement(1, slider), place(i), &
                        1.0e-8_wp*place(i), "published place")
    end do
    call expect_close([memory%results(1)%acceleration(1, slider), &
                       memory%results(181)%acceleration(1, slider)], [-5062.5_wp, 1687.5_wp], &
                      1.0e-8_wp*1687.5_wp, "published accelerations at the dead points")
  end subroutine slider_crank

  !> Rates of coupler and rocker from the rates of the loop, at unit speed of the crank:
  !> crank i e1 + coupler w i e - rocker w i e = 0 and its derivative.
  pure subroutine four_bar_rates(crank, coupler, rocker, angle, others, w, dw)
    real(wp), intent(in) :: crank, coupler, rocker, angle, others(2)
    real(wp), intent(out) :: w(2), dw(2)
    real(wp) :: right(3)

    w = solved(-crank*across(angle))
    right = crank*unit(angle) + coupler*w(1)**2*unit(others(1)) - rocker*w(2)**2*unit(others(2))
    dw = solved(right)

  contains

    !> a of coupler*a(1)*across(1) - rocker*a(2)*across(2) = b.
    pure function solved(b) result(a)
      real(wp), intent(in) :: b(3)
      real(wp) :: a(2), p(3), q(3), determinant

      p = coupler*across(others(1))
      q = -rocker*across(others(2))
      determinant = p(1)*q(2) - p(2)*q(1)
      a = [b(1)*q(2) - b(2)*q(1), p(1)*b(2) - p(2)*b(1)]/determinant
    end function solved
  end subroutine four_bar_rates

  subroutine four_bar()
    real(wp), parameter :: base = 4, crank = 1, coupler = 3.5_wp, rocker = 2.5_wp, start = 0.7_wp
    type(model_t) :: model
    type(memory_t) :: memory
    real(wp) :: angle, others(2), w(2), dw(2)
    integer :: i, b, c

    call make_four_bar(base, crank, coupler, rocker, start, model, b, c)
    call add_analysis(model, analysis_kinematic, 2*pi, 2*pi/72)
    call solve(model, memory)
    call expect(memory%steps == 73, "the start and 72 steps")
    do i = 1, memory%steps
      angle = start + (i - 1)*pi/36
      others = four_bar_angles(base, crank, coupler, rocker, angle)
      call four_bar_rates(crank, coupler, rocker, angle, others, w, dw)
      associate (now => memory%results(i))
        call expect_close(model%node(c)%position + now%displacement(:, c), &
                          base*unit(0.0_wp) + rocker*unit(others(2)), 1.0e-9_wp, "joint")
        call expect_close(now%velocity(1:3, c), rocker*w(2)*across(others(2)), 1.0e-9_wp, &
                          "velocity")
        call expect_close(now%acceleration(1:3, c), &
                          rocker*(dw(2)*across(others(2)) - w(2)**2*unit(others(2))), 1.0e-9_wp, &
                          "acceleration")
        call expect_close(now%velocity(4:6, c), [0.0_wp, 0.0_wp, w(2)], 1.0e-9_wp, "spin")
        call expect_close(now%acceleration(4:6, c), [0.0_wp, 0.0_wp, dw(2)], 1.0e-9_wp, &
                          "its change")
        call expect_close(now%joint_rate(2, 1), 0.0_wp, 1.0e-9_wp, "no rate of what is fixed")
      end associate
      call expect(memory%record(i)%cutbacks == 0, "no cut-back")
    end do
  end subroutine four_bar

  !> The coupler only translates: at every change point the antiparallelogram branches off.
  !> Accelerations have the round-off times the cube of what a strain moves, some 1e3 at the banks.
  subroutine expect_parallelogram(memory, start, rate, coupler, accuracy)
    type(memory_t), intent(in) :: memory
    real(wp), intent(in) :: start, rate, accuracy
    integer, intent(in) :: coupler(:)
    real(wp) :: angle
    integer :: i, j

    do i = 1, memory%steps
      angle = start + rate*memory%record(i)%time
      associate (now => memory%results(i))
        do j = 1, size(coupler)
          associate (n => coupler(j))
            call expect_close(now%displacement(:, n), unit(angle) - unit(start), 1.0e-10_wp, "place")
            call expect_close(now%velocity(1:3, n), rate*across(angle), 1.0e-9_wp, "velocity")
            call expect_close(now%acceleration(1:3, n), -rate**2*unit(angle), accuracy, &
                              "acceleration")
          end associate
        end do
      end associate
      call expect(memory%record(i)%last%constraint <= 1.0e-10_wp, "constraints hold")
    end do
  end subroutine expect_parallelogram

  !> Every ninth step of ten degrees is a change point.
  subroutine parallelogram()
    type(model_t) :: model
    type(memory_t) :: memory
    integer :: b, c

    call make_four_bar(2.0_wp, 1.0_wp, 2.0_wp, 1.0_wp, pi/2, model, b, c)
    call add_analysis(model, analysis_kinematic, 4*pi, pi/18)
    call solve(model, memory)
    call expect(memory%steps == 73, "two turns")
    call expect_parallelogram(memory, pi/2, 1.0_wp, [b, c], 1.0e-6_wp)
  end subroutine parallelogram

  !> Steps end 1e-2 ... 1e-13 from the change point.
  subroutine beside_change_point()
    type(model_t) :: model
    type(memory_t) :: memory
    real(wp) :: start
    integer :: b, c, i

    do i = 2, 13
      start = pi/2 + 10.0_wp**(-i)
      call make_four_bar(2.0_wp, 1.0_wp, 2.0_wp, 1.0_wp, start, model, b, c)
      call add_analysis(model, analysis_kinematic, pi, pi/18)
      call solve(model, memory)
      call expect(memory%steps == 19, "half a turn")
      call expect_parallelogram(memory, start, 1.0_wp, [b, c], 1.0e-6_wp)
    end do
  end subroutine beside_change_point

  !> Three cranks on one line and two couplers: both loops are singular at once. Steps of a tenth
  !> of a degree: the singular stretch has many.
  subroutine double_parallelogram()
    type(model_t) :: model
    type(memory_t) :: memory
    integer :: b, c, d, e, i, ground, c_of_coupler, e_of_coupler

    call make_four_bar(2.0_wp, 1.0_wp, 2.0_wp, 1.0_wp, 3.0_wp, model, b, c)
    d = add_node(model, [4.0_wp, 0.0_wp, 0.0_wp], [x, y, z])
    e = add_node(model, [4.0_wp, 0.0_wp, 0.0_wp] + unit(3.0_wp))
    c_of_coupler = add_node(model, model%node(c)%position)
    e_of_coupler = add_node(model, model%node(e)%position)
    ground = add_node(model, model%node(d)%position, [rx, ry, rz])
    i = add_bar(model, c, e, c_of_coupler, e_of_coupler)
    i = add_bar(model, d, e, d, e)
    i = add_hinge(model, c, c_of_coupler, .false.)
    i = add_hinge(model, e, e_of_coupler, .false.)
    i = add_hinge(model, ground, d, .false.)
    call add_analysis(model, analysis_kinematic, 0.3_wp, pi/1800)
    call solve(model, memory)
    call expect(memory%steps == 173, "to the end")
    call expect_parallelogram(memory, 3.0_wp, 1.0_wp, [b, c, e], 1.0e-5_wp)
  end subroutine double_parallelogram

  !> The crank is drawn at 0.7 and starts at 2.7, where it turns at once.
  subroutine far_start()
    real(wp), parameter :: base = 4, crank = 1, coupler = 3.5_wp, rocker = 2.5_wp
    type(model_t) :: model
    type(memory_t) :: memory
    real(wp) :: others(2)
    integer :: b, c

    call make_four_bar(base, crank, coupler, rocker, 0.7_wp, model, b, c)
    call drive(model, 1, 2.0_wp, 0.0_wp, 0.0_wp)
    call add_analysis(model, analysis_kinematic, 0.1_wp, 0.1_wp)
    call solve(model, memory)
    if (memory%steps < 2) return
    others = four_bar_angles(base, crank, coupler, rocker, 2.7_wp)
    call expect_close(model%node(c)%position + memory%results(1)%displacement(:, c), &
                      base*unit(0.0_wp) + rocker*unit(others(2)), 1.0e-9_wp, "start")
    others = four_bar_angles(base, crank, coupler, rocker, 2.8_wp)
    call expect_close(model%node(c)%position + memory%results(2)%displacement(:, c), &
                      base*unit(0.0_wp) + rocker*unit(others(2)), 1.0e-9_wp, "end")
  end subroutine far_start

  !> Each goes on from the other's time and state; TRANSIENT keeps the drive.
  subroutine in_turn()
    real(wp), parameter :: r = 0.15_wp, l = 0.3_wp, w = 2, m = 0.8_wp
    type(model_t) :: model
    type(memory_t) :: memory
    real(wp) :: jet(0:2)
    integer :: i, slider

    call make_slider_crank(r, l, w, model, slider)
    call add_mass(model, slider, m)
    call add_mass(model, 2, m)
    call add_analysis(model, analysis_kinematic, 0.3_wp, 0.1_wp)
    call add_analysis(model, analysis_inverse, 0.6_wp, 0.1_wp)
    call add_analysis(model, analysis_transient, 0.7_wp, 0.001_wp)
    call solve(model, memory)
    call expect(memory%steps == 4 + 4 + 101, "all steps")
    if (memory%steps < 9) return
    do i = 1, memory%steps
      jet = slider_jet(r, l, w*memory%record(i)%time)
      associate (now => memory%results(i))
        ! generalized-alpha errs by w**2 h**2 at most
        call expect_close(r + l + now%displacement(1, slider), jet(0), 1.0e-9_wp*r, "place")
        call expect_close(now%velocity(1, slider), w*jet(1), 1.0e-5_wp*w*r, "velocity")
      end associate
    end do
    call expect_close(memory%record([4, 5, 8, 9])%time, [0.3_wp, 0.3_wp, 0.6_wp, 0.6_wp], &
                      1.0e-12_wp, "times in a row")
    call expect_close(memory%results(9)%joint_stress(1, 1), memory%results(8)%joint_stress(1, 1), &
                      1.0e-4_wp*m*(w*r)**2, "the torque of INVERSE goes on")
  end subroutine in_turn

  subroutine undriven()
    type(model_t) :: model
    type(memory_t) :: memory
    type(error_t), allocatable :: error
    integer :: b, c

    call make_four_bar(4.0_wp, 1.0_wp, 3.5_wp, 2.5_wp, 0.7_wp, model, b, c)
    model%joint(1)%status(1) = model%joint(2)%status(1)
    model%pattern(1)%motions = 0
    call add_analysis(model, analysis_kinematic, 1.0_wp, 0.1_wp)
    call run_mechanism(model, memory, error)
    call expect(allocated(error), "an error")
    if (.not. allocated(error)) return
    call expect(error%status == exit_deck, "exit status of a model error")
    call expect(index(error%message, "KINEMATIC: the motion of node ") == 1 .and. &
                index(error%message, "INPUTE or INPUTX prescribes it") > 0, &
                "a node to prescribe, got: "//error%message)
    call expect(memory%steps == 0, "nothing recorded")
  end subroutine undriven

  !> Crank and coupler together are too short beyond an angle of the crank.
  subroutine out_of_reach()
    type(model_t) :: model
    type(memory_t) :: memory
    type(error_t), allocatable :: error
    integer :: b, c

    call make_four_bar(4.0_wp, 3.0_wp, 2.0_wp, 2.0_wp, 0.3_wp, model, b, c)
    call add_analysis(model, analysis_kinematic, 3.0_wp, 0.1_wp)
    call run_mechanism(model, memory, error)
    call expect(allocated(error), "an error")
    if (.not. allocated(error)) return
    call expect(index(error%message, "no position found beyond time ") == 1, &
                "how far it goes, got: "//error%message)
    ! base**2 + crank**2 - 2 base crank cos = (coupler + rocker)**2
    call expect(memory%steps == 1 + floor((acos(9.0_wp/24) - 0.3_wp)/0.1_wp), &
                "all steps up to there")
  end subroutine out_of_reach

  !> A bar of mass m and length l, its rotary inertia included, turned from level up with gravity:
  !> torque of the drive m l**2/3 a + J a + m g l/2 cos; forces m (a_c + g).
  subroutine pendulum()
    real(wp), parameter :: l = 1.2_wp, density = 2.5_wp, rotary = 0.3_wp, g = 9.81_wp
    real(wp), parameter :: v0 = 0.4_wp, a0 = 1.7_wp, m = density*l
    type(model_t) :: model
    type(memory_t) :: memory
    real(wp) :: t, angle, v, torque, force(3), kinetic
    integer :: a, b, base, i

    call new_mechanism(model)
    a = add_node(model, [0.0_wp, 0.0_wp, 0.0_wp], [x, y, z])
    b = add_node(model, [l, 0.0_wp, 0.0_wp])
    base = add_node(model, [0.0_wp, 0.0_wp, 0.0_wp], [rx, ry, rz])
    i = add_bar(model, a, b, a, b)
    model%member(i)%has_inertia = .true.
    model%member(i)%inertia = [density, 2*rotary, rotary, rotary, 0.0_wp, 0.0_wp]
    i = add_hinge(model, base, a, .true.)
    call drive(model, i, 0.0_wp, v0, a0)
    model%pattern(1)%gravity = [0.0_wp, -g, 0.0_wp]
    call add_analysis(model, analysis_inverse, 2.0_wp, 0.01_wp)
    call solve(model, memory)
    call expect(memory%steps == 201, "all steps")
    do i = 1, memory%steps
      t = memory%record(i)%time
      angle = v0*t + 0.5_wp*a0*t**2
      v = v0 + a0*t
      torque = (m*l**2/3 + rotary*l)*a0 + 0.5_wp*m*g*l*cos(angle)
      force = m*(0.5_wp*l*(a0*across(angle) - v**2*unit(angle)) + [0.0_wp, g, 0.0_wp])
      kinetic = 0.5_wp*(m*l**2/3 + rotary*l)*v**2
      associate (now => memory%results(i))
        call expect_close(now%joint_stress(1, 1), -torque, 1.0e-9_wp*m*g*l, "torque")
        call expect_close(now%reaction(1:3, a), force, 1.0e-9_wp*m*g, "force of the pivot")
        call expect_close(now%reaction(6, base), torque, 1.0e-9_wp*m*g*l, "torque on the base")
        call expect_close(now%energy(1), kinetic, 1.0e-10_wp*kinetic, "kinetic energy")
        call expect_close(now%momentum(1:3), 0.5_wp*m*l*v*across(angle), 1.0e-10_wp*m*l*v, &
                          "momentum")
        ! trapezoidal rule over angles of 0.038 at most: 0.038**2/12 times twice m g l/2
        call expect_close(now%energy(6), 0.0_wp, 1.2e-4_wp*m*g*l, "balance of energies")
      end associate
    end do
  end subroutine pendulum

  !> All mass at the slider: it is pushed along x by m a, held by the rod and the guide, and the
  !> crank gives the power m a v.
  subroutine driven_slider()
    real(wp), parameter :: r = 0.15_wp, l = 0.3_wp, w = 150, m = 0.8_wp
    type(model_t) :: model
    type(memory_t) :: memory
    real(wp) :: jet(0:2), force, angle, slope
    integer :: i, slider

    call make_slider_crank(r, l, w, model, slider)
    call add_mass(model, slider, m)
    call add_analysis(model, analysis_inverse, 2*pi/w, 2*pi/w/90)
    call solve(model, memory)
    call expect(memory%steps == 91, "all steps")
    do i = 1, memory%steps
      angle = (i - 1)*pi/45
      jet = slider_jet(r, l, angle)
      force = m*w**2*jet(2)
      slope = -r*sin(angle)/sqrt(l**2 - (r*sin(angle))**2)
      associate (now => memory%results(i), unit_force => m*w**2*r)
        call expect_close(now%joint_stress(1, 1), -force*jet(1), 1.0e-9_wp*unit_force*r, "torque")
        call expect_close(now%reaction(1:3, 1), [force, force*slope, 0.0_wp], &
                          1.0e-9_wp*unit_force, "bearing of the crank")
        call expect_close(now%reaction(2, slider), -force*slope, 1.0e-9_wp*unit_force, "guide")
      end associate
    end do
  end subroutine driven_slider

  !> k d = m w**2 (l + d).
  subroutine whirling()
    real(wp), parameter :: l = 2, k = 50, m = 1.5_wp, w = 3
    type(model_t) :: model
    type(memory_t) :: memory
    real(wp) :: stretch, angle
    integer :: a, b, base, i

    call new_mechanism(model)
    a = add_node(model, [0.0_wp, 0.0_wp, 0.0_wp], [x, y, z])
    b = add_node(model, [l, 0.0_wp, 0.0_wp])
    base = add_node(model, [0.0_wp, 0.0_wp, 0.0_wp], [rx, ry, rz])
    i = add_bar(model, a, b, a, b)
    model%member(i)%status(1) = 1
    model%member(i)%has_stiffness = .true.
    model%member(i)%stiffness(1:4) = [k*l, 1.0_wp, 1.0_wp, 1.0_wp]
    i = add_hinge(model, base, a, .true.)
    call drive(model, i, 0.0_wp, w, 0.0_wp)
    call add_mass(model, b, m)
    call add_analysis(model, analysis_inverse, 1.0_wp, 0.1_wp)
    call solve(model, memory)
    call expect(memory%steps == 11, "all steps")
    stretch = m*w**2*l/(k - m*w**2)
    do i = 1, memory%steps
      angle = w*memory%record(i)%time
      associate (now => memory%results(i))
        call expect_close(now%displacement(:, b), (l + stretch)*unit(angle) - l*unit(0.0_wp), &
                          1.0e-9_wp*l, "place of the mass")
        call expect_close(now%velocity(1:3, b), w*(l + stretch)*across(angle), 1.0e-8_wp*w*l, &
                          "velocity")
        call expect_close(now%reaction(1:3, a), -m*w**2*(l + stretch)*unit(angle), &
                          1.0e-8_wp*m*w**2*l, "force of the pivot")
        call expect_close(now%stress(1, 1), k*stretch, 1.0e-8_wp*k*l, "force of the spring")
      end associate
    end do
  end subroutine whirling

end module test_kinematic
