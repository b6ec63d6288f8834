!> KINEMATIC against the closed forms of planar mechanisms.
module test_kinematic
  use kinds, only: wp
  use check, only: run, expect, expect_close
  use errors, only: error_t, exit_deck
  use model_data, only: model_t, analysis_kinematic, analysis_inverse, analysis_transient, &
                        function_ramp
  use memory_recorder, only: memory_t
  use mechanism_kit, only: add_node, add_bar, add_hinge, add_mass, drive, add_analysis, &
                           run_mechanism, make_slider_crank, slider_jet, make_four_bar, &
                           four_bar_angles, unit, across
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
    call run("kinematic: four-bar through its stretched position", stretched)
    call run("kinematic: a time just beside a change point", beside_change_point)
    call run("kinematic: parallelograms in a row, very small steps", row_of_parallelograms)
    call run("kinematic: a start away from the drawing", far_start)
    call run("kinematic: a drive that starts and stops at once", kinks)
    call run("kinematic: then INVERSE, then TRANSIENT", in_turn)
    call run("kinematic: a motion that nothing prescribes", undriven)
    call run("kinematic: a position out of reach", out_of_reach)
  end subroutine run_kinematic_tests

  subroutine solve(model, memory)
    type(model_t), intent(inout) :: model
    type(memory_t), intent(out) :: memory
    type(error_t), allocatable :: error

    call run_mechanism(model, memory, error)
    if (allocated(error)) call expect(.false., "no error, got: "//error%message)
  end subroutine solve

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
        call expect(size(now%energy) == 6 .and. size(now%momentum) == 6, "energies and momentum")
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
            call expect_close(now%displacement(:, n), unit(angle) - unit(start), 1.0e-10_wp, &
                              "place")
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

  !> Stretched to base + crank = coupler + rocker the elbow goes over to the other side. Steps of 36
  !> and 45 degrees, some to just behind that point, where the other branch is nearer than the error
  !> of the prediction.
  subroutine stretched()
    real(wp), parameter :: base = 3, crank = 1, coupler = 2.2_wp, rocker = 1.8_wp
    type(model_t) :: model
    type(memory_t) :: memory
    real(wp) :: start, angle
    integer :: b, c, i, j

    do i = -12, 12
      start = 0.01_wp*i
      call make_four_bar(base, crank, coupler, rocker, start, model, b, c)
      call add_analysis(model, analysis_kinematic, 4*pi, pi/merge(4, 5, modulo(i, 2) == 0))
      call solve(model, memory)
      call expect(memory%steps >= 17, "two turns")
      do j = 1, memory%steps
        angle = start + memory%record(j)%time
        call expect_close(model%node(c)%position + memory%results(j)%displacement(:, c), &
                          elbow(angle), 1.0e-9_wp, "elbow")
        call expect(memory%record(j)%last%constraint <= 1.0e-10_wp, "constraints hold")
      end do
    end do

  contains

    !> Law of cosines with half angles: 1 - cos = 2 sin**2, and the diagonal d comes to
    !> base + crank like the square of cos(angle/2), whose sign is the side.
    pure function elbow(angle) result(place)
      real(wp), intent(in) :: angle
      real(wp) :: place(3), diagonal(3), d, turn

      diagonal = base*unit(0.0_wp) - crank*unit(angle)
      d = norm2(diagonal)
      turn = 2*asin(cos(0.5_wp*angle)*sqrt((rocker - coupler + d)*base*crank &
                                           /(coupler*d*(base + crank + d))))
      place = crank*unit(angle) + coupler*unit(atan2(diagonal(2), diagonal(1)) + turn)
    end function elbow
  end subroutine stretched

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

  !> Cranks on one line and couplers between: all loops are singular at once, and with many the
  !> matrix is sparse. Steps of a fifth of a degree: the singular stretch has several.
  subroutine row_of_parallelograms()
    integer, parameter :: loops(2) = [2, 8]
    type(model_t) :: model
    type(memory_t) :: memory
    integer :: b, c, i, j

    do i = 1, 2
      call make_four_bar(2.0_wp, 1.0_wp, 2.0_wp, 1.0_wp, 3.0_wp, model, b, c)
      do j = 2, loops(i)
        call add_parallelogram(model, 2.0_wp*j, c)
      end do
      call add_analysis(model, analysis_kinematic, 0.3_wp, pi/900)
      call solve(model, memory)
      call expect(memory%steps == 87, "to the end")
      call expect_parallelogram(memory, 3.0_wp, 1.0_wp, [b, c], 1.0e-4_wp)
    end do
  end subroutine row_of_parallelograms

  !> A crank at the end of the last coupler, by another one; `last` is its end.
  subroutine add_parallelogram(model, place, last)
    type(model_t), intent(inout) :: model
    real(wp), intent(in) :: place
    integer, intent(inout) :: last
    integer :: d, e, i, ground, p_of_coupler, q_of_coupler

    d = add_node(model, [place, 0.0_wp, 0.0_wp], [x, y, z])
    e = add_node(model, [place, 0.0_wp, 0.0_wp] + unit(3.0_wp))
    p_of_coupler = add_node(model, model%node(last)%position)
    q_of_coupler = add_node(model, model%node(e)%position)
    ground = add_node(model, model%node(d)%position, [rx, ry, rz])
    i = add_bar(model, last, e, p_of_coupler, q_of_coupler)
    i = add_bar(model, d, e, d, e)
    i = add_hinge(model, last, p_of_coupler, .false.)
    i = add_hinge(model, e, q_of_coupler, .false.)
    i = add_hinge(model, ground, d, .false.)
    last = e
  end subroutine add_parallelogram

  !> The crank is drawn at 0.7 and starts at 5.7, where it turns at once.
  subroutine far_start()
    real(wp), parameter :: base = 4, crank = 1, coupler = 3.5_wp, rocker = 2.5_wp
    type(model_t) :: model
    type(memory_t) :: memory
    real(wp) :: others(2)
    integer :: b, c

    call make_four_bar(base, crank, coupler, rocker, 0.7_wp, model, b, c)
    call drive(model, 1, 5.0_wp, 0.0_wp, 0.0_wp)
    call add_analysis(model, analysis_kinematic, 0.1_wp, 0.1_wp)
    call solve(model, memory)
    call expect(memory%steps == 2, "start and end")
    if (memory%steps < 2) return
    others = four_bar_angles(base, crank, coupler, rocker, 5.7_wp)
    call expect_close(model%node(c)%position + memory%results(1)%displacement(:, c), &
                      base*unit(0.0_wp) + rocker*unit(others(2)), 1.0e-9_wp, "start")
    others = four_bar_angles(base, crank, coupler, rocker, 5.8_wp)
    call expect_close(model%node(c)%position + memory%results(2)%displacement(:, c), &
                      base*unit(0.0_wp) + rocker*unit(others(2)), 1.0e-9_wp, "end")
  end subroutine far_start

  !> A ramp from 0.25 to 0.75, amid steps: velocities jump because the drive's do.
  subroutine kinks()
    type(model_t) :: model
    type(memory_t) :: memory
    real(wp) :: jet(0:2), t, angle, speed
    integer :: i, slider

    call make_slider_crank(0.15_wp, 0.3_wp, 0.0_wp, model, slider)
    deallocate (model%function)
    allocate (model%function(1))
    model%function(1)%kind = function_ramp
    model%function(1)%parameter(1:2) = [0.25_wp, 0.75_wp]
    model%pattern(1)%motion(1)%function = 1
    model%pattern(1)%motion(1)%value = 1.2_wp
    call add_analysis(model, analysis_kinematic, 1.0_wp, 0.1_wp)
    call solve(model, memory)
    call expect(memory%steps == 11, "all steps")
    do i = 1, memory%steps
      t = memory%record(i)%time
      angle = 1.2_wp*min(1.0_wp, max(0.0_wp, (t - 0.25_wp)/0.5_wp))
      speed = merge(2.4_wp, 0.0_wp, t > 0.25_wp .and. t < 0.75_wp)
      jet = slider_jet(0.15_wp, 0.3_wp, angle)
      associate (now => memory%results(i))
        call expect_close(0.45_wp + now%displacement(1, slider), jet(0), 1.0e-11_wp, "place")
        call expect_close(now%velocity(1, slider), speed*jet(1), 1.0e-9_wp, "velocity")
      end associate
      call expect(memory%record(i)%cutbacks == 0, "no cut-back")
    end do
  end subroutine kinks

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

end module test_kinematic
