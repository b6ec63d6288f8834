!> KINEMATIC and INVERSE against the closed forms of planar mechanisms.
module test_kinematic
  use kinds, only: wp
  use check, only: run, expect, expect_close
  use errors, only: error_t, exit_deck
  use model_data, only: model_t, analysis_kinematic, analysis_inverse
  use memory_recorder, only: memory_t
  use mechanism_kit, only: new_mechanism, add_node, add_bar, add_hinge, add_mass, drive, &
                           add_analysis, run_mechanism
  implicit none
  private

  public :: run_kinematic_tests

  real(wp), parameter :: pi = acos(-1.0_wp)
  integer, parameter :: x = 1, y = 2, z = 3, rx = 4, ry = 5, rz = 6

contains

  subroutine run_kinematic_tests()
    call run("kinematic: slider-crank (MBD-10)", slider_crank)
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

end module test_kinematic
